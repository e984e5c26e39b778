//! The quadratic that fits the heights of a vertex's neighbours above its tangent plane best, and the change of its
//! second derivatives when vertices move.

use super::geometry::{Frame, Point};
use crate::math::sym2::Sym2;

/// Number of coefficients of a local quadratic: of `½x²`, `xy`, `½y²`, `x` and `y`.
const COEFFICIENT_COUNT: usize = 5;

/// Noise amplification of a quadratic's second derivatives on the six-ring of a hexagonal lattice of spacing `h`, in
/// units of `h⁻⁴`.
const HEXAGONAL_AMPLIFICATION: f64 = 20.0 / 3.0;

/// Minimum pivot of a quadratic fit's Cholesky factorisation, relative to the diagonal entry, at which the neighbours
/// determine the quadratic: half of the digits of double precision are left.
const MIN_PIVOT_SHARE: f64 = 1e-8;

/// Weight of a second-ring vertex in a quadratic fit, relative to a first-ring vertex.
pub(super) const SECOND_RING_FIT_WEIGHT: f64 = 0.03;

/// A neighbour of the vertex that a quadratic is fitted at: its offset from the vertex, and its weight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Neighbour {
    pub offset: Point,
    pub weight: f64,
}

/// Quadratic fitted to the surface at one vertex: height above the tangent plane.
#[derive(Debug, Clone)]
pub(crate) struct Quadratic {
    samples: Vec<Sample>,
    inverse: [[f64; COEFFICIENT_COUNT]; COEFFICIENT_COUNT],
    coefficients: [f64; COEFFICIENT_COUNT],
    scale: f64,
}

/// A neighbour's contribution to the fit of a quadratic.
#[derive(Debug, Clone)]
struct Sample {
    /// Derivatives of the quadratic's coefficients with respect to the neighbour's height.
    column: [f64; COEFFICIENT_COUNT],
    /// Coordinates of the neighbour in the tangent plane, in units of the quadratic's `scale`.
    place: [f64; 2],
    weight: f64,
    residual: f64,
}

/// Returns the terms `½x²`, `xy`, `½y²`, `x` and `y` of a quadratic at the point `(x, y)`.
fn terms([x, y]: [f64; 2]) -> [f64; COEFFICIENT_COUNT] {
    [0.5 * x * x, x * y, 0.5 * y * y, x, y]
}

/// Returns the inner product of two coefficient vectors.
fn inner(a: &[f64; COEFFICIENT_COUNT], b: &[f64; COEFFICIENT_COUNT]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Quadratic {
    /// Fits a quadratic through a vertex to its neighbours by least squares, over the tangent plane of `frame`; `None`
    /// where the neighbours do not determine one.
    pub(super) fn fit(frame: &Frame, neighbours: &[Neighbour]) -> Option<Self> {
        let full = neighbours.iter().filter(|n| n.weight == 1.0);
        let count = full.clone().count() as f64;
        let scale = (full.map(|n| n.offset.norm_squared()).sum::<f64>() / count).sqrt();
        if !(scale > 0.0 && scale.is_finite()) {
            return None;
        }
        let mut matrix = [[0.0; COEFFICIENT_COUNT]; COEFFICIENT_COUNT];
        let mut samples = Vec::with_capacity(neighbours.len());
        for Neighbour { offset, weight } in neighbours {
            let [x, y, height] = frame.coordinates(offset / scale);
            let q = terms([x, y]);
            for (row, a) in matrix.iter_mut().zip(q) {
                for (entry, b) in row.iter_mut().zip(q) {
                    *entry += weight * a * b;
                }
            }
            samples.push(Sample {
                column: [0.0; COEFFICIENT_COUNT],
                place: [x, y],
                weight: *weight,
                residual: height,
            });
        }
        let inverse = inverse(&matrix)?;
        let mut coefficients = [0.0; COEFFICIENT_COUNT];
        for sample in &mut samples {
            let q = terms(sample.place);
            sample.column = std::array::from_fn(|k| sample.weight * inner(&inverse[k], &q));
            for (coefficient, entry) in coefficients.iter_mut().zip(&sample.column) {
                *coefficient += entry * sample.residual;
            }
        }
        for sample in &mut samples {
            sample.residual -= inner(&coefficients, &terms(sample.place));
        }
        Some(Quadratic {
            samples,
            inverse,
            coefficients,
            scale,
        })
    }

    /// Returns the noise variance of the second derivatives, relative to that on the six-ring of a hexagonal lattice.
    pub(super) fn amplification(&self) -> f64 {
        let columns = self.samples.iter().map(|sample| sample.column);
        let squares = columns.map(|c| c[0] * c[0] + 2.0 * c[1] * c[1] + c[2] * c[2]);
        squares.sum::<f64>() / HEXAGONAL_AMPLIFICATION
    }

    /// Returns the second derivatives at the vertex.
    pub(crate) fn hessian(&self) -> Sym2 {
        let [xx, xy, yy, ..] = self.coefficients;
        Sym2::new(xx, xy, yy).scale(1.0 / self.scale)
    }

    /// Returns the first derivatives at the vertex.
    pub(super) fn slope(&self) -> [f64; 2] {
        let [.., x, y] = self.coefficients;
        [x, y]
    }

    /// Returns the quadratic's height above the tangent plane at a point of that plane.
    pub(super) fn height(&self, place: [f64; 2]) -> f64 {
        self.scale * inner(&self.coefficients, &terms(place.map(|x| x / self.scale)))
    }

    /// Returns the quadratic's first derivatives at a point of the tangent plane.
    pub(super) fn gradient(&self, place: [f64; 2]) -> [f64; 2] {
        let [x, y] = place.map(|x| x / self.scale);
        let [xx, xy, yy, a, b] = self.coefficients;
        [xx * x + xy * y + a, xy * x + yy * y + b]
    }

    /// Returns the change of the second derivatives, to first order, when the `k`-th neighbour moves by `v` relative to
    /// the vertex.
    pub(super) fn change(&self, frame: &Frame, k: usize, v: Point) -> Sym2 {
        let [dx, dy, dz] = frame.coordinates(v);
        let sample = &self.samples[k];
        let [x, y] = sample.place;
        let along = [x * dx, x * dy + y * dx, y * dy, dx, dy];
        let rise = dz - inner(&along, &self.coefficients);
        let pull = sample.weight * sample.residual;
        let [xx, xy, yy] = std::array::from_fn(|row| {
            sample.column[row] * rise + pull * inner(&self.inverse[row], &along)
        });
        Sym2::new(xx, xy, yy).scale(self.scale.powi(-2))
    }
}

/// Inverts a symmetric matrix by Cholesky's factorisation; `None` unless the matrix is well positive definite.
fn inverse(
    matrix: &[[f64; COEFFICIENT_COUNT]; COEFFICIENT_COUNT],
) -> Option<[[f64; COEFFICIENT_COUNT]; COEFFICIENT_COUNT]> {
    let mut l = [[0.0; COEFFICIENT_COUNT]; COEFFICIENT_COUNT];
    for i in 0..COEFFICIENT_COUNT {
        for j in 0..=i {
            let sum: f64 = matrix[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>();
            if i == j {
                if sum.is_nan() || sum <= MIN_PIVOT_SHARE * matrix[i][i] {
                    return None;
                }
                l[i][i] = sum.sqrt();
            } else {
                l[i][j] = sum / l[j][j];
            }
        }
    }
    let mut inverse = [[0.0; COEFFICIENT_COUNT]; COEFFICIENT_COUNT];
    for column in 0..COEFFICIENT_COUNT {
        let mut x = [0.0; COEFFICIENT_COUNT];
        for i in 0..COEFFICIENT_COUNT {
            let unit = f64::from(u8::from(i == column));
            x[i] = (unit - (0..i).map(|k| l[i][k] * x[k]).sum::<f64>()) / l[i][i];
        }
        for i in (0..COEFFICIENT_COUNT).rev() {
            x[i] = (x[i]
                - (i + 1..COEFFICIENT_COUNT)
                    .map(|k| l[k][i] * x[k])
                    .sum::<f64>())
                / l[i][i];
        }
        for (row, x) in inverse.iter_mut().zip(x) {
            row[column] = x;
        }
    }
    Some(inverse)
}
