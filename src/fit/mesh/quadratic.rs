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

/// Number of neighbours for which memory is reserved: two rings of a hexagonal mesh, with room for a vertex and a constant.
pub(super) const STENCIL_ROW_CAPACITY: usize = 20;

/// Weight of a second-ring vertex in a quadratic fit, relative to a first-ring vertex (`benches/whole.md`).
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
    equations: NormalEquations,
    /// Inverse of the matrix of the normal equations.
    inverse: [[f64; COEFFICIENT_COUNT]; COEFFICIENT_COUNT],
    coefficients: [f64; COEFFICIENT_COUNT],
    scale: f64,
}

/// Normal equations of the fit of a quadratic, and the sums that its change is computed from when the vertex moves.
#[derive(Debug, Clone, Default)]
struct NormalEquations {
    /// Matrix `Σ w t tᵀ` of the terms `t`, whose lower triangle is enough because it is symmetric.
    matrix: [[f64; COEFFICIENT_COUNT]; COEFFICIENT_COUNT],
    /// Right-hand side `Σ w t z` for the heights `z`.
    right: [f64; COEFFICIENT_COUNT],
    /// Weighted sum of the terms.
    terms: [f64; COEFFICIENT_COUNT],
    /// Weighted sum of the heights.
    height: f64,
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
    pub(super) fn fit(
        frame: &Frame,
        neighbours: impl Iterator<Item = Neighbour> + Clone,
    ) -> Option<Self> {
        let full = neighbours.clone().filter(|n| n.weight == 1.0);
        let (sum, count) = full.fold((0.0, 0.0), |(sum, count), n| {
            (sum + n.offset.norm_squared(), count + 1.0)
        });
        let scale = f64::sqrt(sum / count);
        if !(scale > 0.0 && scale.is_finite()) {
            return None;
        }
        let fit = Quadratic {
            samples: Vec::with_capacity(STENCIL_ROW_CAPACITY),
            equations: NormalEquations::default(),
            inverse: [[0.0; COEFFICIENT_COUNT]; COEFFICIENT_COUNT],
            coefficients: [0.0; COEFFICIENT_COUNT],
            scale,
        };
        fit.with_neighbours(frame, neighbours)
    }

    /// Fits the quadratic to further neighbours as well, over the tangent plane of the same frame.
    pub(super) fn with_neighbours(
        mut self,
        frame: &Frame,
        neighbours: impl Iterator<Item = Neighbour>,
    ) -> Option<Self> {
        for Neighbour { offset, weight } in neighbours {
            let [x, y, height] = frame.coordinates(offset).map(|x| x / self.scale);
            let sample = Sample {
                terms: terms([x, y]),
                height,
                weight,
            };
            self.equations.add(&sample);
            self.samples.push(sample);
        }
        self.inverse = inverse(&self.equations.matrix)?;
        self.coefficients = self.inverse.map(|row| inner(&row, &self.equations.right));
        Some(self)
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

    /// Returns the change of the second derivatives, to first order, when the `k`-th neighbour moves by `v` relative to
    /// the vertex.
    #[inline]
    pub(super) fn change(&self, frame: &Frame, k: usize, v: Point) -> Sym2 {
        self.solve(self.right_change(&self.samples[k], frame.coordinates(v)))
    }

    /// Returns the change of the second derivatives, to first order, when the vertex itself moves by `v`: the sum of
    /// the changes when all neighbours move by `−v`, in which the moments of the residuals vanish.
    pub(super) fn change_at_centre(&self, frame: &Frame, v: Point) -> Sym2 {
        let [dx, dy, dz] = frame.coordinates(-v);
        let [xx, xy, yy, x, y] = self.coefficients;
        let NormalEquations {
            matrix: [.., m3, m4],
            terms,
            height,
            ..
        } = &self.equations;
        let rise = dz - dx * x - dy * y;
        let (along, across) = (dx * xx + dy * xy, dx * xy + dy * yy);
        let moments_x = [m3[0], m3[1], m3[2], m3[3], m4[3]];
        let mut right: [f64; COEFFICIENT_COUNT] =
            std::array::from_fn(|k| rise * terms[k] - along * moments_x[k] - across * m4[k]);
        let residual = height - inner(terms, &self.coefficients);
        right[3] += dx * residual;
        right[4] += dy * residual;
        self.solve(right)
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

impl NormalEquations {
    #[inline]
    fn add(&mut self, sample: &Sample) {
        let Sample {
            terms,
            height,
            weight,
        } = sample;
        for (i, row) in self.matrix.iter_mut().enumerate() {
            let weighted = weight * terms[i];
            self.terms[i] += weighted;
            self.right[i] += weighted * height;
            for (entry, term) in row.iter_mut().zip(&terms[..=i]) {
                *entry += weighted * term;
            }
        }
        self.height += weight * height;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_added_later_count_like_those_at_first() {
        let frame = Frame::from_normal(Point::z(), Point::x());
        let neighbours = (0..12).map(|k| {
            let (angle, weight) = (0.5 * f64::from(k), if k < 6 { 1.0f64 } else { 0.03 });
            Neighbour {
                offset: Point::new(angle.cos(), 2.0 * angle.sin(), (3.0 * angle).sin())
                    / weight.sqrt(),
                weight,
            }
        });
        let at_once = Quadratic::fit(&frame, neighbours.clone()).unwrap();
        let first = Quadratic::fit(&frame, neighbours.clone().take(6)).unwrap();
        let later = first.with_neighbours(&frame, neighbours.skip(6)).unwrap();
        assert_eq!(later.coefficients, at_once.coefficients);
        let v = Point::new(0.3, -0.2, 0.5);
        // The centre moves against all neighbours.
        let all = (0..12).map(|k| at_once.change(&frame, k, -v));
        let sum = all.fold(Sym2::default(), |sum, change| sum + change);
        let own = at_once.change_at_centre(&frame, v);
        assert!((own - sum).spectral_norm() < 1e-12 * (1.0 + sum.spectral_norm()));
    }
}
