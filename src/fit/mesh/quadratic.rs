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
    /// Inverse of the matrix of the normal equations.
    inverse: [[f64; COEFFICIENT_COUNT]; COEFFICIENT_COUNT],
    coefficients: [f64; COEFFICIENT_COUNT],
    scale: f64,
}

/// A neighbour's contribution to the fit of a quadratic, in units of the quadratic's `scale`.
#[derive(Debug, Clone)]
struct Sample {
    /// Terms of the quadratic at the neighbour.
    terms: [f64; COEFFICIENT_COUNT],
    /// Height of the neighbour above the tangent plane.
    height: f64,
    weight: f64,
}

/// Returns the terms `½x²`, `xy`, `½y²`, `x` and `y` of a quadratic at the point `(x, y)`.
#[inline]
fn terms([x, y]: [f64; 2]) -> [f64; COEFFICIENT_COUNT] {
    [0.5 * x * x, x * y, 0.5 * y * y, x, y]
}

/// Returns the inner product of two coefficient vectors.
#[inline]
fn inner(a: &[f64; COEFFICIENT_COUNT], b: &[f64; COEFFICIENT_COUNT]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4]
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
        // The lower triangle of the matrix is enough, because it is symmetric.
        let mut matrix = [[0.0; COEFFICIENT_COUNT]; COEFFICIENT_COUNT];
        let mut right = [0.0; COEFFICIENT_COUNT];
        let mut samples = Vec::with_capacity(neighbours.len());
        for Neighbour { offset, weight } in neighbours {
            let [x, y, height] = frame.coordinates(*offset).map(|x| x / scale);
            let terms = terms([x, y]);
            for (i, row) in matrix.iter_mut().enumerate() {
                let weighted = weight * terms[i];
                right[i] += weighted * height;
                for (entry, term) in row.iter_mut().zip(&terms[..=i]) {
                    *entry += weighted * term;
                }
            }
            samples.push(Sample {
                terms,
                height,
                weight: *weight,
            });
        }
        let inverse = inverse(&matrix)?;
        Some(Quadratic {
            samples,
            coefficients: inverse.map(|row| inner(&row, &right)),
            inverse,
            scale,
        })
    }

    /// Returns the noise variance of the second derivatives, relative to that on the six-ring of a hexagonal lattice.
    pub(super) fn amplification(&self) -> f64 {
        let squares = self.samples.iter().map(|sample| {
            let [xx, xy, yy, ..] = self.inverse.map(|row| inner(&row, &sample.terms));
            sample.weight.powi(2) * (xx * xx + 2.0 * xy * xy + yy * yy)
        });
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
    #[inline]
    pub(super) fn change(&self, frame: &Frame, k: usize, v: Point) -> Sym2 {
        self.solve(self.right_change(&self.samples[k], frame.coordinates(v)))
    }

    /// Returns the change of the second derivatives, to first order, when the vertex itself moves by `v`.
    pub(super) fn change_at_centre(&self, frame: &Frame, v: Point) -> Sym2 {
        let back = frame.coordinates(-v);
        let mut sum = [0.0; COEFFICIENT_COUNT];
        for sample in &self.samples {
            let change = self.right_change(sample, back);
            (0..COEFFICIENT_COUNT).for_each(|k| sum[k] += change[k]);
        }
        self.solve(sum)
    }

    /// Returns the change of the normal equations' residual, to first order, when a neighbour moves by `[dx, dy, dz]` in
    /// the frame's coordinates.
    #[inline]
    fn right_change(&self, sample: &Sample, [dx, dy, dz]: [f64; 3]) -> [f64; COEFFICIENT_COUNT] {
        let Sample {
            terms,
            height,
            weight,
        } = sample;
        let [.., x, y] = *terms;
        let along = [x * dx, x * dy + y * dx, y * dy, dx, dy];
        let rise = weight * (dz - inner(&along, &self.coefficients));
        let pull = weight * (height - inner(terms, &self.coefficients));
        std::array::from_fn(|k| terms[k] * rise + along[k] * pull)
    }

    /// Solves the normal equations for a right-hand side, and returns the second derivatives of the solution.
    #[inline]
    fn solve(&self, right: [f64; COEFFICIENT_COUNT]) -> Sym2 {
        let [xx, xy, yy] = std::array::from_fn(|row| inner(&self.inverse[row], &right));
        Sym2::new(xx, xy, yy).scale(self.scale.powi(-2))
    }
}

/// Inverts a symmetric matrix, given by its lower triangle, by Cholesky's factorisation; `None` unless the matrix is well
/// positive definite.
fn inverse(
    matrix: &[[f64; COEFFICIENT_COUNT]; COEFFICIENT_COUNT],
) -> Option<[[f64; COEFFICIENT_COUNT]; COEFFICIENT_COUNT]> {
    // The factor and the inverse of the factor, both lower triangles.
    let mut l = [[0.0; COEFFICIENT_COUNT]; COEFFICIENT_COUNT];
    let mut m = l;
    for i in 0..COEFFICIENT_COUNT {
        for j in 0..i {
            let sum: f64 = matrix[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>();
            l[i][j] = sum * m[j][j];
        }
        let pivot = matrix[i][i] - (0..i).map(|k| l[i][k] * l[i][k]).sum::<f64>();
        if pivot.is_nan() || pivot <= MIN_PIVOT_SHARE * matrix[i][i] {
            return None;
        }
        m[i][i] = 1.0 / pivot.sqrt();
        for j in 0..i {
            m[i][j] = -m[i][i] * (j..i).map(|k| l[i][k] * m[k][j]).sum::<f64>();
        }
    }
    let entry = |i: usize, j: usize| {
        (i.max(j)..COEFFICIENT_COUNT)
            .map(|k| m[k][i] * m[k][j])
            .sum()
    };
    Some(std::array::from_fn(|i| {
        std::array::from_fn(|j| entry(i, j))
    }))
}
