//! Triangle meshes laid flat, or bent in space, as rigidly as possible.
//!
//! The energy is the sum of `area · ‖J − R‖²` over the triangles.

use nalgebra::Vector3;

use super::cholesky::Cholesky;
use super::flat_triangle::{FlatTriangle, Point, Position};
use super::local_global::{Iteration, Progress};
use super::sparse_rows::SparseRows;
use super::unflip::unflip_triangles;
use crate::error::{Result, try_filled};
use crate::progress;

/// Relative change of a layout's energy in one iteration below which the layout counts as stalled.
const STALLED_RELATIVE_CHANGE: f64 = 0.01;

/// Number of iterations (a local and a global step each) that are made before a layout may be given up.
const MIN_STEPS_BEFORE_GIVING_UP: usize = 6;

/// Factor by which an earlier decrease of the energy counts less after each iteration. The next decrease is estimated
/// by the largest recent one, because the energy does not fall at an even rate.
const CHANGE_DECAY: f64 = 0.8;

/// The problem of laying a mesh with the least as-rigid-as-possible energy: its triangles in their own planes.
pub(crate) struct ArapMesh {
    /// Triangles of the mesh, each with the numbers of its corners.
    triangles: Vec<(FlatTriangle, [u32; 3])>,
    /// Cholesky factor of the global step's matrix.
    factor: Cholesky,
    area: f64,
}

/// Stopping criteria for minimising the energy of a mesh.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StoppingCriteria {
    /// Change of the energy over the area in one iteration, without unit, below which the mesh has converged.
    pub tolerance: f64,
    /// Change of the energy in one step, as a share of it, below which the mesh has converged.
    pub relative_tolerance: f64,
    /// Energy over area, without unit, at which the solver stops, or 0. The solver also gives up if at the rate of the
    /// last iterations it would not reach this energy in `max_steps`.
    pub target_energy: f64,
    /// Energy over area, without unit, above which the solver gives up a layout that stalls.
    pub hopeless_energy: f64,
    /// Maximum number of iterations, a local and a global step each.
    pub max_steps: usize,
}

impl ArapMesh {
    /// Creates the problem for a mesh whose vertices are near given places, by which they are ordered.
    /// Factorises its matrix.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn new(
        places: &[Point],
        triangles: Vec<(FlatTriangle, [u32; 3])>,
    ) -> Result<ArapMesh> {
        let matrix = matrix(places.len(), &triangles)?;
        Ok(ArapMesh {
            area: triangles.iter().map(|(triangle, _)| triangle.area()).sum(),
            factor: Cholesky::new(&matrix, places)?,
            triangles,
        })
    }

    /// Triangles of the mesh, each in a plane of its own, with the numbers of their corners.
    pub(super) fn triangles(&self) -> &[(FlatTriangle, [u32; 3])] {
        &self.triangles
    }

    pub(super) fn area(&self) -> f64 {
        self.area
    }

    /// Moves the mesh's vertices in the plane to positions of least energy, and then those around flipped triangles so
    /// that none is flipped.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn lay_flat(
        &mut self,
        positions: &mut [Point],
        criteria: StoppingCriteria,
    ) -> Result<Progress> {
        let mut progress = self.minimise(positions, criteria)?;
        let triangles: Vec<[u32; 3]> = self.triangles.iter().map(|(_, corners)| *corners).collect();
        if unflip_triangles(&triangles, positions)? {
            let mut descent = try_filled("unrolling", positions.len(), Point::default())?;
            progress.energy = self.energy(positions, &mut descent) / self.area;
        }
        Ok(progress)
    }

    /// Moves the mesh's vertices in the plane, or in space from positions near the solution, to positions of least energy.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn minimise<P: Position>(
        &mut self,
        positions: &mut [P],
        criteria: StoppingCriteria,
    ) -> Result<Progress> {
        let mut descent = try_filled("unrolling", positions.len(), P::default())?;
        let mut corrections = descent.clone();
        let mut iteration = Iteration::new(positions)?;
        let (mut recent_change, mut first_change) = (0.0, f64::NAN);
        while iteration.steps < criteria.max_steps {
            let energy = self.energy(positions, &mut descent) / self.area;
            let tolerance = criteria.tolerance.max(criteria.relative_tolerance * energy);
            let converges = iteration.converges(energy, tolerance);
            let change = iteration.decrease.abs();
            recent_change = change.max(CHANGE_DECAY * recent_change);
            if iteration.steps > 0 {
                // It falls by about the same factor in each step.
                first_change = first_change.max(change);
                progress::reach((first_change / change).ln() / (first_change / tolerance).ln());
            }
            let change_to_come = recent_change * (criteria.max_steps - iteration.steps) as f64;
            let stalls =
                change < STALLED_RELATIVE_CHANGE * energy && energy > criteria.hopeless_energy;
            let misses_target =
                criteria.target_energy > 0.0 && change_to_come < energy - criteria.target_energy;
            let may_give_up = iteration.steps > MIN_STEPS_BEFORE_GIVING_UP;
            if converges
                || energy < criteria.target_energy
                || may_give_up && (stalls || misses_target)
            {
                break;
            }
            P::solve(&mut self.factor, &descent, &mut corrections);
            iteration.advance(positions, corrections.iter().copied());
        }
        Ok(iteration.finish(positions))
    }

    /// Computes the root mean square of the triangles' strains at given vertex positions in space.
    pub(crate) fn strain_in_space(&self, positions: &[Vector3<f64>]) -> f64 {
        let mut descent = vec![Vector3::zeros(); positions.len()];
        (0.5 * self.energy(positions, &mut descent) / self.area).sqrt()
    }

    /// Computes the as-rigid-as-possible energy of the triangles. Writes minus half the energy's gradient to `descent`.
    fn energy<P: Position>(&self, positions: &[P], descent: &mut [P]) -> f64 {
        descent.fill(P::default());
        let mut energy = 0.0;
        for (triangle, corners) in &self.triangles {
            let corners = corners.map(|corner| corner as usize);
            energy += P::local_step(triangle, positions, descent, corners);
        }
        energy
    }
}

/// Creates the matrix of the global step: the cotangent Laplacian of the triangles.
fn matrix(count: usize, triangles: &[(FlatTriangle, [u32; 3])]) -> Result<SparseRows> {
    let mut diagonal = try_filled("unrolling", count, 0.0)?;
    let mut entries = Vec::with_capacity(6 * triangles.len() + count);
    for (triangle, corners) in triangles {
        for (k, weight) in triangle.weights.into_iter().enumerate() {
            let [a, b] = [k, (k + 1) % 3].map(|k| corners[k]);
            diagonal[a as usize] += weight;
            diagonal[b as usize] += weight;
            entries.extend([([a, b], -weight), ([b, a], -weight)]);
        }
    }
    entries.extend((0..).zip(diagonal).map(|(v, weight)| ([v, v], weight)));
    SparseRows::new(count, &entries)
}
