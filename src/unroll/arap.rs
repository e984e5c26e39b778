//! Local and global steps in turn until the sheet is at rest: as rigid as possible (Liu et al.
//! 2008, *A Local/Global Approach to Mesh Parameterization*, Sec. 4).

use super::laplacian::Laplacian;
use super::multigrid::GlobalStep;
use super::pieces::{Pieces, Point};
use crate::error::{Result, try_filled};
use crate::math::lanes;

/// Iterations of conjugate gradients in each global step, which with a V-cycle each is nearly exact;
/// what they leave is in the next step's right-hand side.
const INNER: usize = 2;

/// How often in a row the energy may hardly change before that counts as the end.
const CALM: usize = 3;

/// When to stop.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// Change of the energy in one iteration, over the area, that is none.
    pub tolerance: f64,
    pub iterations: usize,
    /// Energy over area that is too much: above [`FAR`] times it an end is made where steps hardly
    /// change it.
    pub hopeless: f64,
}

/// How far the energy is above what is wanted, and its largest change, as a share, where it is given
/// up, after so many steps.
const FAR: f64 = 2.5;
const STALLED: f64 = 0.01;
const PATIENCE: usize = 6;

/// How it went.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Course {
    pub iterations: usize,
    /// Energy over area: the mean of the squared strains.
    pub energy: f64,
    /// Change of that in the last iteration.
    pub change: f64,
}

/// Moves the vertices from where they are to where the pieces fit together best.
///
/// Steps are accelerated as Nesterov does it, with a fresh start whenever the energy rises. Their
/// number depends on the shape, hardly on the lattice, so that a start from a coarser one costs
/// more than it saves.
pub(super) fn relax(pieces: &Pieces, places: &mut [Point], limits: Limits) -> Result<Course> {
    let mut step = GlobalStep::new(Laplacian::new(pieces)?)?;
    let mut pull = try_filled("unrolling", places.len(), Point::default())?;
    let mut last = try_filled("unrolling", places.len(), Point::default())?;
    last.copy_from_slice(places);
    let mut course = Course {
        energy: f64::INFINITY,
        ..Course::default()
    };
    let (mut momentum, mut calm) = (1.0f64, 0);
    while course.iterations < limits.iterations {
        let energy = pieces.pull(places, &mut pull) / pieces.area;
        course.change = course.energy - energy;
        if course.change < 0.0 {
            momentum = 1.0;
        }
        calm = if course.change.abs() < limits.tolerance {
            calm + 1
        } else {
            0
        };
        course.energy = energy;
        let stalled = course.iterations > PATIENCE && course.change.abs() < STALLED * energy;
        if calm == CALM || (stalled && energy > FAR * limits.hopeless) {
            break;
        }
        course.iterations += 1;
        let [right_x, right_y] = step.right();
        for ((x, y), pull) in right_x.iter_mut().zip(right_y).zip(&pull) {
            (*x, *y) = (lanes::single(pull.re), lanes::single(pull.im));
        }
        let [dx, dy] = step.solve(INNER);
        let next = 0.5 + (0.25 + momentum * momentum).sqrt();
        let ahead = (momentum - 1.0) / next;
        momentum = next;
        let corrections = dx.iter().zip(dy);
        for ((place, last), (dx, dy)) in places.iter_mut().zip(&mut last).zip(corrections) {
            let moved = *place + Point::new(lanes::double(*dx), lanes::double(*dy));
            *place = moved + (moved - *last) * ahead;
            *last = moved;
        }
    }
    places.copy_from_slice(&last);
    Ok(course)
}
