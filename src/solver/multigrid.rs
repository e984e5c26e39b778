//! One multigrid V-cycle: the preconditioner of the z-step.
//!
//! The same energy on the lattices of spacing 2h, 4h, … gives the coarse
//! matrices (a coarse vertex stands for four fine ones, hence the factor ¼ in
//! the restriction), Chebyshev's polynomial of Jacobi's preconditioner smooths,
//! and the cycle ends where the fidelity term makes the system well conditioned,
//! two to five lattices down. Symmetric and positive definite, so conjugate
//! gradients may use it.

use std::sync::Arc;

use super::grid::{Grid, LARGEST_EIGENVALUE, part, part_mut};
use super::transfer::Transfer;
use crate::domain::Domain;
use crate::error::{Result, try_filled};

/// Smoothing steps before and after the coarse correction.
const STEPS: usize = 2;

/// The smoother works on eigenvalues down to the largest over this; the rest is for the coarse lattice.
const RANGE: f32 = 5.0;

/// A lattice with no larger condition number than this needs no coarser one.
const WELL_CONDITIONED: f32 = 8.0;

/// Most smoothing steps on the coarsest lattice.
const BOTTOM_STEPS: f32 = 40.0;

#[derive(Debug, Clone)]
pub(crate) struct Multigrid {
    /// The finest first.
    floors: Vec<Floor>,
    /// From each floor to the next.
    transfers: Vec<Transfer>,
    /// How many of them a cycle visits.
    depth: usize,
}

#[derive(Debug, Clone)]
struct Floor {
    grid: Grid,
    /// Right-hand side, solution, last step of the smoother, residual.
    b: Vec<f32>,
    x: Vec<f32>,
    step: Vec<f32>,
    residual: Vec<f32>,
}

impl Multigrid {
    /// For the first of `domains`, each of which has twice the spacing of the one before.
    pub(crate) fn new(
        domains: &[Arc<Domain>],
        spacing: f64,
        lambda: f64,
        rho: f64,
    ) -> Result<Self> {
        let mut floors = Vec::with_capacity(domains.len());
        let mut spacing = spacing;
        for domain in domains {
            let zeros = || try_filled("multigrid", domain.cells(), 0.0);
            floors.push(Floor {
                grid: Grid::new(domain.clone(), spacing, lambda, rho)?,
                b: zeros()?,
                x: zeros()?,
                step: zeros()?,
                residual: zeros()?,
            });
            spacing *= 2.0;
        }
        let pairs = domains.windows(2);
        let mut multigrid = Multigrid {
            floors,
            transfers: pairs
                .map(|pair| Transfer::new(&pair[0], &pair[1]))
                .collect(),
            depth: 1,
        };
        multigrid.find_depth();
        Ok(multigrid)
    }

    /// Changes the matrix.
    pub(crate) fn set(&mut self, lambda: f64, rho: f64) {
        for floor in &mut self.floors {
            floor.grid.set(lambda, rho);
        }
        self.find_depth();
    }

    fn find_depth(&mut self) {
        let good = |floor: &Floor| floor.grid.condition() <= WELL_CONDITIONED;
        let last = self.floors.len() - 1;
        self.depth = self.floors.iter().position(good).unwrap_or(last) + 1;
    }

    /// The matrix itself.
    pub(crate) fn matrix(&self) -> &Grid {
        &self.floors[0].grid
    }

    /// The matrix itself.
    pub(crate) fn matrix_mut(&mut self) -> &mut Grid {
        &mut self.floors[0].grid
    }

    /// An approximation of `A⁻¹ b`. `b` comes back as it was.
    pub(crate) fn precondition(&mut self, b: &mut Vec<f32>) -> &[f32] {
        std::mem::swap(b, &mut self.floors[0].b);
        cycle(&mut self.floors[..self.depth], &self.transfers);
        std::mem::swap(b, &mut self.floors[0].b);
        &self.floors[0].x
    }
}

/// Solves `A x = b` roughly on the first floor with the help of the others.
fn cycle(floors: &mut [Floor], transfers: &[Transfer]) {
    let Some((fine, below)) = floors.split_first_mut() else {
        return;
    };
    let (Some(coarse), Some((transfer, further))) = (below.first_mut(), transfers.split_first())
    else {
        return fine.solve();
    };
    let low = LARGEST_EIGENVALUE / RANGE;
    fine.start(low);
    fine.smooth(STEPS - 1, low, true);
    fine.grid.residual(&mut fine.x, &fine.b, &mut fine.residual);
    let scale = 0.25 * fine.grid.diagonal / coarse.grid.diagonal;
    transfer.restrict(
        (&fine.grid.domain, &fine.residual, &mut fine.step),
        (&coarse.grid.domain, &mut coarse.b),
        scale as f32,
    );
    cycle(below, further);
    let coarse = &below[0];
    transfer.prolong(
        (&coarse.grid.domain, &coarse.x),
        (&fine.grid.domain, &mut fine.x, &mut fine.residual),
    );
    fine.smooth(STEPS, low, false);
}

impl Floor {
    /// On the coarsest floor: Chebyshev's iteration on the whole spectrum.
    fn solve(&mut self) {
        let condition = self.grid.condition();
        let steps = (1.5 * condition.sqrt()).ceil().clamp(2.0, BOTTOM_STEPS);
        let low = LARGEST_EIGENVALUE / condition;
        self.start(low);
        self.smooth(steps as usize - 1, low, true);
    }

    /// The first step of Chebyshev's iteration from zero, which needs no matrix.
    fn start(&mut self, low: f32) {
        let weight = 2.0 / (LARGEST_EIGENVALUE + low);
        for run in self.grid.domain.active().all() {
            let x = part_mut(&mut self.x, *run);
            let step = part_mut(&mut self.step, *run);
            let b = part(&self.b, *run);
            let m = part(&self.grid.inverse_diagonal, *run);
            for i in 0..x.len() {
                let first = weight * (m[i] * b[i]);
                step[i] = first;
                x[i] = first;
            }
        }
    }

    /// Steps of Chebyshev's iteration for eigenvalues from `low` to the largest,
    /// going on after the first one or starting with it.
    fn smooth(&mut self, steps: usize, low: f32, started: bool) {
        let middle = 0.5 * (LARGEST_EIGENVALUE + low);
        let half = 0.5 * (LARGEST_EIGENVALUE - low);
        let sigma = middle / half;
        let mut ratio = 1.0 / sigma;
        for k in 0..steps {
            let (momentum, weight) = if k == 0 && !started {
                (0.0, 1.0 / middle)
            } else {
                let last = ratio;
                ratio = 1.0 / (2.0 * sigma - last);
                (ratio * last, 2.0 * ratio / half)
            };
            self.grid
                .smooth(&mut self.x, &self.b, &mut self.step, momentum, weight);
        }
    }
}
