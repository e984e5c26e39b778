//! Meshes laid flat together, tied to each other along lines: what is cut and joined is no lattice,
//! so that its global step is a sparse matrix's.
//!
//! Minimised is the energy of all pieces, as for one lattice, and for each tie the square of the
//! distance between its two places, times [`TIE`].

use nalgebra::Vector3;
use sprs::{CsMat, TriMat};

use super::pieces::{Piece, Point};
use crate::error::{Result, try_filled};

/// What a tie weighs; an edge between two equilateral triangles weighs 0.58.
const TIE: f64 = 8.0;

/// Steps of conjugate gradients in each global step.
const INNER: usize = 16;

/// How far a global step's residual falls.
const REDUCTION: f64 = 1e-3;

/// A place as a mean of vertices with weights; a vertex without a weight stands for none.
pub(crate) type Mean = [(u32, f64); 3];

/// Pieces by the numbers of their corners, and pairs of places that are to be one.
pub(crate) struct Joint {
    pieces: Vec<(Piece, [u32; 3])>,
    ties: Vec<[Mean; 2]>,
    matrix: CsMat<f64>,
    /// Inverse of its diagonal.
    inverse: Vec<f64>,
    area: f64,
}

/// When to stop.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Until {
    /// Change of the energy in one step, over the area, that is none.
    pub tolerance: f64,
    /// Energy over area that is little enough, or 0: an end is also made where all steps, at the rate of the
    /// last ones, would not get there.
    pub enough: f64,
    /// Energy over area above which an end is made where steps hardly change it.
    pub hopeless: f64,
    /// Most local and global steps.
    pub steps: usize,
}

/// A change of the energy, as a share, that is hardly one, after so many steps.
const STALLED: f64 = 0.02;
const PATIENCE: usize = 5;

/// What a change of the energy counts for in the next step.
const RECENT: f64 = 0.8;

impl Joint {
    /// Of so many vertices.
    pub(crate) fn new(
        count: usize,
        pieces: Vec<(Piece, [u32; 3])>,
        ties: Vec<[Mean; 2]>,
    ) -> Result<Joint> {
        let area = pieces.iter().map(|(piece, _)| piece.area()).sum();
        let matrix = matrix(count, &pieces, &ties);
        let mut inverse = try_filled("unrolling", count, 0.0)?;
        for (row, entries) in matrix.outer_iterator().enumerate() {
            let own = entries.get(row).copied().unwrap_or(0.0);
            inverse[row] = if own > 0.0 { 1.0 / own } else { 0.0 };
        }
        Ok(Joint {
            pieces,
            ties,
            matrix,
            inverse,
            area,
        })
    }

    /// Moves the vertices to where pieces and ties fit best; the number of steps that took.
    pub(crate) fn relax(&self, places: &mut [Point], until: Until) -> Result<usize> {
        let mut gradients = Gradients::new(&self.matrix, &self.inverse)?;
        let area = self.area;
        let mut last = places.to_vec();
        let (mut energy, mut momentum, mut calm) = (f64::INFINITY, 1.0f64, 0);
        let mut recent = 0.0;
        let mut steps = 0;
        while steps < until.steps {
            let found = self.pull(places, &mut gradients.right) / area;
            if found > energy {
                momentum = 1.0;
            }
            let change = (found - energy).abs();
            if steps > PATIENCE && change < STALLED * found && found > until.hopeless {
                break;
            }
            calm = match change < until.tolerance {
                true => calm + 1,
                false => 0,
            };
            energy = found;
            // The energy does not fall at an even rate.
            recent = change.max(RECENT * recent);
            let to_come = recent * (until.steps - steps) as f64;
            let out_of_reach = steps > PATIENCE && to_come < found - until.enough;
            if calm == 3 || found < until.enough || until.enough > 0.0 && out_of_reach {
                break;
            }
            steps += 1;
            gradients.solve();
            let next = 0.5 + (0.25 + momentum * momentum).sqrt();
            let ahead = (momentum - 1.0) / next;
            momentum = next;
            let moves = places.iter_mut().zip(&mut last).zip(&gradients.solution);
            for ((place, last), step) in moves {
                let moved = *place + step;
                *place = moved + (moved - *last) * ahead;
                *last = moved;
            }
        }
        places.copy_from_slice(&last);
        Ok(steps)
    }

    /// Bends what the pieces make up to where these fit best in space: from places that are near to
    /// those.
    pub(crate) fn bend(&self, places: &mut [Vector3<f64>], until: Until) -> Result<()> {
        let mut gradients = Gradients::new(&self.matrix, &self.inverse)?;
        let mut pull = try_filled("refolding", places.len(), Vector3::zeros())?;
        let mut last = places.to_vec();
        let (mut energy, mut momentum, mut calm) = (f64::INFINITY, 1.0f64, 0);
        for _ in 0..until.steps {
            let found = self.pull_in_space(places, &mut pull) / self.area;
            if found > energy {
                momentum = 1.0;
            }
            calm = match (found - energy).abs() < until.tolerance {
                true => calm + 1,
                false => 0,
            };
            energy = found;
            if calm == 3 {
                break;
            }
            let next = 0.5 + (0.25 + momentum * momentum).sqrt();
            let ahead = (momentum - 1.0) / next;
            momentum = next;
            // Two coordinates, then the third.
            let mut steps = try_filled("refolding", places.len(), Vector3::zeros())?;
            for (right, pull) in gradients.right.iter_mut().zip(&pull) {
                *right = Point::new(pull.x, pull.y);
            }
            gradients.solve();
            for (step, solved) in steps.iter_mut().zip(&gradients.solution) {
                (step.x, step.y) = (solved.re, solved.im);
            }
            for (right, pull) in gradients.right.iter_mut().zip(&pull) {
                *right = Point::new(pull.z, 0.0);
            }
            gradients.solve();
            for (step, solved) in steps.iter_mut().zip(&gradients.solution) {
                step.z = solved.re;
            }
            for ((place, last), step) in places.iter_mut().zip(&mut last).zip(&steps) {
                let moved = *place + step;
                *place = moved + (moved - *last) * ahead;
                *last = moved;
            }
        }
        places.copy_from_slice(&last);
        Ok(())
    }

    /// What is left of strain there: root of the mean square.
    pub(crate) fn strain_in_space(&self, places: &[Vector3<f64>]) -> f64 {
        let mut pull = vec![Vector3::zeros(); places.len()];
        let energy: f64 = (self.pieces.iter())
            .map(|(piece, corners)| {
                piece.pull_in_space(places, &mut pull, corners.map(|corner| corner as usize))
            })
            .sum();
        (0.5 * energy / self.area).sqrt()
    }

    fn pull_in_space(&self, places: &[Vector3<f64>], pull: &mut [Vector3<f64>]) -> f64 {
        pull.fill(Vector3::zeros());
        let mut energy = 0.0;
        for (piece, corners) in &self.pieces {
            energy += piece.pull_in_space(places, pull, corners.map(|corner| corner as usize));
        }
        for tie in &self.ties {
            let terms = difference(tie).into_iter().filter(|(_, w)| *w != 0.0);
            let apart: Vector3<f64> = terms.clone().map(|(v, w)| places[v as usize] * w).sum();
            energy += TIE * apart.norm_squared();
            for (v, w) in terms {
                pull[v as usize] -= apart * (TIE * w);
            }
        }
        energy
    }

    /// The energy; `pull` becomes minus half its gradient.
    fn pull(&self, places: &[Point], pull: &mut [Point]) -> f64 {
        pull.fill(Point::default());
        let mut energy = 0.0;
        for (piece, corners) in &self.pieces {
            energy += piece.pull(places, pull, corners.map(|corner| corner as usize));
        }
        for tie in &self.ties {
            let terms = difference(tie).into_iter().filter(|(_, w)| *w != 0.0);
            let apart: Point = terms.clone().map(|(v, w)| places[v as usize] * w).sum();
            energy += TIE * apart.norm_sqr();
            for (v, w) in terms {
                pull[v as usize] -= apart * (TIE * w);
            }
        }
        energy
    }
}

fn matrix(count: usize, pieces: &[(Piece, [u32; 3])], ties: &[[Mean; 2]]) -> CsMat<f64> {
    let room = 12 * pieces.len() + 36 * ties.len();
    let mut entries = TriMat::with_capacity((count, count), room);
    for (piece, corners) in pieces {
        for (k, weight) in piece.weights.into_iter().enumerate() {
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
                    entries.add_triplet(a as usize, b as usize, TIE * wa * wb);
                }
            }
        }
    }
    entries.to_csr()
}

/// One place less the other.
fn difference([one, other]: &[Mean; 2]) -> [(u32, f64); 6] {
    let [a, b, c] = *one;
    let [d, e, f] = other.map(|(v, w)| (v, -w));
    [a, b, c, d, e, f]
}

/// Conjugate gradients with Jacobi's preconditioner, for both coordinates at once: the plane is that
/// of the complex numbers, and the matrix is real.
struct Gradients<'a> {
    matrix: &'a CsMat<f64>,
    inverse: &'a [f64],
    right: Vec<Point>,
    solution: Vec<Point>,
    direction: Vec<Point>,
    image: Vec<Point>,
}

impl<'a> Gradients<'a> {
    fn new(matrix: &'a CsMat<f64>, inverse: &'a [f64]) -> Result<Self> {
        let blank = || try_filled("unrolling", inverse.len(), Point::default());
        Ok(Gradients {
            right: blank()?,
            solution: blank()?,
            direction: blank()?,
            image: blank()?,
            matrix,
            inverse,
        })
    }

    /// From 0; `right` becomes the residual.
    fn solve(&mut self) {
        self.solution.fill(Point::default());
        self.direction.fill(Point::default());
        let (mut last, mut first) = (0.0, None);
        let starts = self.matrix.indptr();
        let starts = starts.raw_storage();
        let (columns, weights) = (self.matrix.indices(), self.matrix.data());
        for _ in 0..INNER {
            let pairs = self.right.iter().zip(self.inverse);
            let square: f64 = pairs.clone().map(|(r, d)| r.norm_sqr() * d).sum();
            let goal = *first.get_or_insert(REDUCTION * REDUCTION * square);
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
