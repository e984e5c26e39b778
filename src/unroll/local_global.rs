//! The accelerated local/global iteration by which surfaces are laid flat (Ligang Liu et al., *A Local/Global Approach to
//! Mesh Parameterization*, 2008, Sec. 4).

use super::flat_triangle::Position;
use crate::error::{Result, try_filled};

/// Number of consecutive steps with a change of the energy below the tolerance after which the iteration has
/// converged. One alone may be an extremum between two accelerated steps. `benches/patterns.md` has what others give.
const CONVERGED_STEPS: usize = 3;

/// What an iteration has reached when it stops.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Progress {
    /// Number of local and global steps.
    pub steps: usize,
    /// Energy over the area, without unit, and its decrease by the last global step.
    pub energy: f64,
    pub decrease: f64,
}

/// State of an iteration of local and global steps, which are extrapolated by Nesterov's momentum. It restarts whenever
/// the energy rises. The number of steps depends on the shape, hardly on the number of vertices.
pub(super) struct Iteration<P> {
    /// Number of global steps made so far in laying the surface flat.
    pub steps: usize,
    /// Energy of the layout over its area, without unit, from the last local step.
    pub energy: f64,
    /// Decrease of the energy over the area by the last global step; infinite before the first one.
    pub decrease: f64,
    /// Positions of the vertices after the last global step, without extrapolation by the momentum.
    last: Vec<P>,
    momentum: f64,
    /// Number of steps in a row that changed the energy by less than the tolerance.
    calm_steps: usize,
}

impl<P: Position> Iteration<P> {
    /// Creates an iteration of local and global steps that starts from given positions.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(positions: &[P]) -> Result<Self> {
        let mut last = try_filled("unrolling", positions.len(), P::default())?;
        last.copy_from_slice(positions);
        Ok(Iteration {
            steps: 0,
            energy: f64::INFINITY,
            decrease: 0.0,
            last,
            momentum: 1.0,
            calm_steps: 0,
        })
    }

    /// Records the energy over the area that a local step has found. Returns whether the iteration has converged:
    /// the energy changes by less than `tolerance`.
    pub(super) fn converges(&mut self, energy: f64, tolerance: f64) -> bool {
        self.decrease = self.energy - energy;
        self.energy = energy;
        if self.decrease < 0.0 {
            self.momentum = 1.0;
        }
        self.calm_steps = match self.decrease.abs() < tolerance {
            true => self.calm_steps + 1,
            false => 0,
        };
        self.calm_steps == CONVERGED_STEPS
    }

    /// Moves the vertices by the corrections of a global step, and further by Nesterov's momentum.
    pub(super) fn advance(
        &mut self,
        positions: &mut [P],
        corrections: impl IntoIterator<Item = P>,
    ) {
        self.steps += 1;
        let next = 0.5 + (0.25 + self.momentum * self.momentum).sqrt();
        let ahead = (self.momentum - 1.0) / next;
        self.momentum = next;
        let moves = positions.iter_mut().zip(&mut self.last);
        for ((position, last), correction) in moves.zip(corrections) {
            let moved = *position + correction;
            *position = moved + (moved - *last) * ahead;
            *last = moved;
        }
    }

    /// Moves the vertices to where the last global step put them, without extrapolation by the momentum.
    pub(super) fn finish(self, positions: &mut [P]) -> Progress {
        positions.copy_from_slice(&self.last);
        Progress {
            steps: self.steps,
            energy: self.energy,
            decrease: self.decrease,
        }
    }
}
