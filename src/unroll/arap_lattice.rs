//! Heightfields laid flat as rigidly as possible, with a multigrid global step.

use super::flat_triangle::Point;
use super::laplacian::Laplacian;
use super::lattice_triangles::LatticeTriangles;
use super::local_global::Iteration;
use super::multigrid::GlobalStep;
use crate::error::{Result, try_filled};
use crate::math::lanes;

/// Conjugate-gradient iterations in each global step of the layout. With a multigrid V-cycle as preconditioner two
/// iterations are nearly exact; the rest of the residual enters the next step's right-hand side.
const CG_ITERATIONS: usize = 2;

/// Minimum ratio of a layout's energy to the wanted energy at which the solver gives up a layout whose energy hardly
/// falls any more.
const HOPELESS_ENERGY_FACTOR: f64 = 2.5;

/// Relative change of a heightfield layout's energy in one iteration below which the layout counts as stalled.
const STALLED_RELATIVE_CHANGE: f64 = 0.01;

/// Number of iterations (a local and a global step each) that are made before the layout of a heightfield may be given
/// up.
const MIN_STEPS_BEFORE_GIVING_UP: usize = 6;

/// Stopping criteria for laying a heightfield flat.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// Change of the layout's energy over its area in one iteration, without unit, below which the layout has
    /// converged.
    pub tolerance: f64,
    pub max_iterations: usize,
    /// Energy over area, without unit, that the layout should reach: a layout that stalls well above it is given up.
    /// Infinite if no energy is wanted.
    pub wanted_energy: f64,
    /// Change of the energy in one iteration, as a share of it, below which a layout of the wanted energy has converged.
    pub relative_tolerance: f64,
}

/// Moves the vertices of a flat layout from given positions, in units of the spacing, to those that minimise the
/// as-rigid-as-possible energy.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn minimise_energy(
    triangles: &LatticeTriangles,
    positions: &mut [Point],
    limits: Limits,
) -> Result<Iteration<Point>> {
    let mut global_step = GlobalStep::new(Laplacian::new(triangles)?)?;
    let mut descent = try_filled("unrolling", positions.len(), Point::default())?;
    let mut iteration = Iteration::new(positions)?;
    while iteration.steps < limits.max_iterations {
        let energy = triangles.energy(positions, &mut descent) / triangles.area;
        let tolerance = match energy < limits.wanted_energy {
            true => limits.tolerance.max(limits.relative_tolerance * energy),
            false => limits.tolerance,
        };
        let converges = iteration.converges(energy, tolerance);
        let stalls = iteration.steps > MIN_STEPS_BEFORE_GIVING_UP
            && iteration.decrease.abs() < STALLED_RELATIVE_CHANGE * energy;
        if converges || stalls && energy > HOPELESS_ENERGY_FACTOR * limits.wanted_energy {
            break;
        }
        let [right_x, right_y] = global_step.right_hand_side_mut();
        for ((x, y), descent) in right_x.iter_mut().zip(right_y).zip(&descent) {
            (*x, *y) = (lanes::single(descent.re), lanes::single(descent.im));
        }
        let [x, y] = global_step.solve(CG_ITERATIONS);
        let point = |(x, y): (&f32, &f32)| Point::new(lanes::double(*x), lanes::double(*y));
        iteration.advance(positions, x.iter().zip(y).map(point));
    }
    iteration.finish(positions);
    Ok(iteration)
}
