//! Triangle meshes laid flat, or bent in space, as rigidly as possible and tied to each other along lines.
//!
//! The global step's matrix is sparse, for these meshes are no lattices. The energy is the sum of `area · ‖J − R‖²` over
//! the triangles and, for each tie, of the squared distance between its two points times [`TIE_WEIGHT`].

use nalgebra::Vector3;
use sprs::{CsMat, TriMat};

use super::flat_triangle::{FlatTriangle, Point, Position};
use super::local_global::Iteration;
use crate::error::{Result, try_filled};

/// Weight, in the energy of a mesh, of the squared distance between two points that are tied, that is, should coincide.
/// An edge between two equilateral triangles has the weight 0.58, so that tied points meet before triangles are
/// strained.
const TIE_WEIGHT: f64 = 8.0;

/// Maximum number of conjugate-gradient iterations in each global step of laying a mesh.
const MAX_CG_ITERATIONS: usize = 16;

/// Factor by which conjugate gradients reduce the residual in each global step of laying a mesh.
const CG_RESIDUAL_REDUCTION: f64 = 1e-3;

/// Relative change of a mesh layout's energy in one iteration below which the layout counts as stalled.
const STALLED_RELATIVE_CHANGE: f64 = 0.02;

/// Number of iterations (a local and a global step each) that are made before the layout of a mesh may be given up.
const MIN_STEPS_BEFORE_GIVING_UP: usize = 5;

/// Factor by which an earlier decrease of the energy counts less after each iteration. The next decrease is estimated
/// by the largest recent one, because the energy does not fall at an even rate.
const CHANGE_DECAY: f64 = 0.8;

/// A point on a mesh: vertices with barycentric weights; a vertex of weight 0 does not count.
pub(crate) type BarycentricPoint = [(u32, f64); 3];

/// The problem of laying a mesh with the least as-rigid-as-possible energy: its triangles in their own planes, and
/// ties, which are pairs of points that should coincide.
pub(crate) struct ArapMesh {
    /// Triangles of the mesh, each with the numbers of its corners.
    triangles: Vec<(FlatTriangle, [u32; 3])>,
    /// Ties: pairs of points of the mesh that should coincide.
    ties: Vec<[BarycentricPoint; 2]>,
    matrix: CsMat<f64>,
    /// Inverse of the diagonal of the global step's matrix, the preconditioner of conjugate gradients.
    inverse_diagonal: Vec<f64>,
    area: f64,
}

/// Stopping criteria for minimising the energy of a mesh.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StoppingCriteria {
    /// Change of the energy over the area in one iteration, without unit, below which the mesh has converged.
    pub tolerance: f64,
    /// Energy over area, without unit, at which the solver stops, or 0. The solver also gives up if at the rate of the
    /// last iterations it would not reach this energy in `max_steps`.
    pub target_energy: f64,
    /// Energy over area, without unit, above which the solver gives up a layout that stalls.
    pub hopeless_energy: f64,
    /// Maximum number of iterations, a local and a global step each.
    pub max_steps: usize,
}

impl ArapMesh {
    /// Creates the problem for a mesh of `count` vertices.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn new(
        count: usize,
        triangles: Vec<(FlatTriangle, [u32; 3])>,
        ties: Vec<[BarycentricPoint; 2]>,
    ) -> Result<ArapMesh> {
        let area = triangles.iter().map(|(triangle, _)| triangle.area()).sum();
        let matrix = matrix(count, &triangles, &ties);
        let mut inverse_diagonal = try_filled("unrolling", count, 0.0)?;
        for (row, entries) in matrix.outer_iterator().enumerate() {
            let own = entries.get(row).copied().unwrap_or(0.0);
            inverse_diagonal[row] = if own > 0.0 { 1.0 / own } else { 0.0 };
        }
        Ok(ArapMesh {
            triangles,
            ties,
            matrix,
            inverse_diagonal,
            area,
        })
    }

    /// Moves the mesh's vertices in the plane to positions of least energy. Returns the number of local and global
    /// steps.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn minimise_in_plane(
        &self,
        positions: &mut [Point],
        criteria: StoppingCriteria,
    ) -> Result<usize> {
        let mut gradients = ConjugateGradients::new(&self.matrix, &self.inverse_diagonal)?;
        let mut iteration = Iteration::new(positions)?;
        let mut recent_change = 0.0;
        while iteration.steps < criteria.max_steps {
            let energy = self.energy(positions, &mut gradients.right) / self.area;
            let converges = iteration.converges(energy, criteria.tolerance);
            let change = iteration.decrease.abs();
            recent_change = change.max(CHANGE_DECAY * recent_change);
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
            gradients.solve();
            iteration.advance(positions, gradients.solution.iter().copied());
        }
        iteration.finish(positions);
        Ok(iteration.steps)
    }

    /// Moves the mesh's vertices in space, from positions near the solution, to positions of least energy. The
    /// tolerance and the maximum number of iterations alone decide when it stops.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn minimise_in_space(
        &self,
        positions: &mut [Vector3<f64>],
        criteria: StoppingCriteria,
    ) -> Result<()> {
        let mut gradients = ConjugateGradients::new(&self.matrix, &self.inverse_diagonal)?;
        let mut descent = try_filled("refolding", positions.len(), Vector3::zeros())?;
        let mut corrections = descent.clone();
        let mut iteration = Iteration::new(positions)?;
        while iteration.steps < criteria.max_steps {
            let energy = self.energy(positions, &mut descent) / self.area;
            if iteration.converges(energy, criteria.tolerance) {
                break;
            }
            // Two coordinates at once, then the third.
            for (right, descent) in gradients.right.iter_mut().zip(&descent) {
                *right = Point::new(descent.x, descent.y);
            }
            gradients.solve();
            for (correction, solved) in corrections.iter_mut().zip(&gradients.solution) {
                (correction.x, correction.y) = (solved.re, solved.im);
            }
            for (right, descent) in gradients.right.iter_mut().zip(&descent) {
                *right = Point::new(descent.z, 0.0);
            }
            gradients.solve();
            for (correction, solved) in corrections.iter_mut().zip(&gradients.solution) {
                correction.z = solved.re;
            }
            iteration.advance(positions, corrections.iter().copied());
        }
        iteration.finish(positions);
        Ok(())
    }

    /// Computes the root mean square of the triangles' strains at given vertex positions in space.
    pub(crate) fn strain_in_space(&self, positions: &[Vector3<f64>]) -> f64 {
        let mut descent = vec![Vector3::zeros(); positions.len()];
        (0.5 * self.triangle_energy(positions, &mut descent) / self.area).sqrt()
    }

    /// Computes the as-rigid-as-possible energy of the triangles, without that of ties. Adds minus half the energy's
    /// gradient to `descent`.
    fn triangle_energy<P: Position>(&self, positions: &[P], descent: &mut [P]) -> f64 {
        let mut energy = 0.0;
        for (triangle, corners) in &self.triangles {
            let corners = corners.map(|corner| corner as usize);
            energy += P::local_step(triangle, positions, descent, corners);
        }
        energy
    }

    /// Computes the energy of the triangles and of the ties, which are points that should coincide. Writes minus half
    /// the energy's gradient to `descent`.
    fn energy<P: Position>(&self, positions: &[P], descent: &mut [P]) -> f64 {
        descent.fill(P::default());
        let mut energy = self.triangle_energy(positions, descent);
        for tie in &self.ties {
            let terms = difference(tie).into_iter().filter(|(_, w)| *w != 0.0);
            let apart: P = terms.clone().map(|(v, w)| positions[v as usize] * w).sum();
            energy += TIE_WEIGHT * apart.squared_norm();
            for (v, w) in terms {
                descent[v as usize] -= apart * (TIE_WEIGHT * w);
            }
        }
        energy
    }
}

/// Creates the matrix of the global step: the cotangent Laplacian of the triangles, and the squared distances of ties.
fn matrix(
    count: usize,
    triangles: &[(FlatTriangle, [u32; 3])],
    ties: &[[BarycentricPoint; 2]],
) -> CsMat<f64> {
    let room = 12 * triangles.len() + 36 * ties.len();
    let mut entries = TriMat::with_capacity((count, count), room);
    for (triangle, corners) in triangles {
        for (k, weight) in triangle.weights.into_iter().enumerate() {
            let [a, b] = [k, (k + 1) % 3].map(|k| corners[k] as usize);
            entries.add_triplet(a, a, weight);
            entries.add_triplet(b, b, weight);
            entries.add_triplet(a, b, -weight);
            entries.add_triplet(b, a, -weight);
        }
    }
    for tie in ties {
        let terms = difference(tie);
        for (a, wa) in terms {
            for (b, wb) in terms {
                if wa != 0.0 && wb != 0.0 {
                    entries.add_triplet(a as usize, b as usize, TIE_WEIGHT * wa * wb);
                }
            }
        }
    }
    entries.to_csr()
}

/// Returns vertices with weights whose weighted sum of positions is the vector from the second point of a tie to the
/// first.
fn difference([one, other]: &[BarycentricPoint; 2]) -> [(u32, f64); 6] {
    let [a, b, c] = *one;
    let [d, e, f] = other.map(|(v, w)| (v, -w));
    [a, b, c, d, e, f]
}

/// Conjugate gradients with Jacobi's preconditioner, for both coordinates at once as complex numbers: the matrix is
/// real.
struct ConjugateGradients<'a> {
    matrix: &'a CsMat<f64>,
    inverse_diagonal: &'a [f64],
    right: Vec<Point>,
    solution: Vec<Point>,
    direction: Vec<Point>,
    image: Vec<Point>,
}

impl<'a> ConjugateGradients<'a> {
    fn new(matrix: &'a CsMat<f64>, inverse_diagonal: &'a [f64]) -> Result<Self> {
        let blank = || try_filled("unrolling", inverse_diagonal.len(), Point::default());
        Ok(ConjugateGradients {
            right: blank()?,
            solution: blank()?,
            direction: blank()?,
            image: blank()?,
            matrix,
            inverse_diagonal,
        })
    }

    /// Solves the linear system for the right-hand side `right`, starting from 0; `right` becomes the residual.
    fn solve(&mut self) {
        self.solution.fill(Point::default());
        self.direction.fill(Point::default());
        let (mut last, mut first) = (0.0, None);
        let starts = self.matrix.indptr();
        let starts = starts.raw_storage();
        let (columns, weights) = (self.matrix.indices(), self.matrix.data());
        for _ in 0..MAX_CG_ITERATIONS {
            let pairs = self.right.iter().zip(self.inverse_diagonal);
            let square: f64 = pairs.clone().map(|(r, d)| r.norm_sqr() * d).sum();
            let goal = *first.get_or_insert(CG_RESIDUAL_REDUCTION * CG_RESIDUAL_REDUCTION * square);
            if square <= goal || square <= f64::MIN_POSITIVE {
                return;
            }
            let share = if last > 0.0 { square / last } else { 0.0 };
            last = square;
            for (direction, (r, d)) in self.direction.iter_mut().zip(pairs) {
                *direction = r * *d + *direction * share;
            }
            let mut curvature = 0.0;
            let direction = &self.direction[..];
            for ((image, own), row) in self.image.iter_mut().zip(direction).zip(starts.windows(2)) {
                let row = row[0]..row[1];
                let terms = columns[row.clone()].iter().zip(&weights[row]);
                let sum: Point = terms.map(|(k, w)| direction[*k] * *w).sum();
                curvature += own.re * sum.re + own.im * sum.im;
                *image = sum;
            }
            if curvature <= 0.0 {
                return;
            }
            let step = square / curvature;
            for k in 0..self.right.len() {
                self.solution[k] += self.direction[k] * step;
                self.right[k] -= self.image[k] * step;
            }
        }
    }
}
