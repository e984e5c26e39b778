//! Least-squares normal equations of a band matrix with a dense border, solved by Cholesky factorisation and the Schur
//! complement.

use nalgebra::{DMatrix, DVector};

/// Normal equations `JᵀJ x = −Jᵀr` of a banded matrix with a dense border: the first unknowns couple only within a
/// band, the last ones, which form the border, with all unknowns.
pub(crate) struct BorderedSystem {
    size: usize,
    half_width: usize,
    /// Lower triangle of the band matrix, row by row, the diagonal entry last in each row.
    band: Vec<f64>,
    /// Columns that couple the border's unknowns with the band's, each of the band's size.
    border: Vec<Vec<f64>>,
    corner: DMatrix<f64>,
    /// Right-hand sides: of the band's and of the border's equations.
    right: (Vec<f64>, DVector<f64>),
}

impl BorderedSystem {
    /// Makes a system of zeros with `size` unknowns in the band, whose row `i` couples with `half_width` before it, and
    /// `border` further unknowns.
    pub(crate) fn new(size: usize, half_width: usize, border: usize) -> Self {
        BorderedSystem {
            size,
            half_width,
            band: vec![0.0; size * (half_width + 1)],
            border: vec![vec![0.0; size]; border],
            corner: DMatrix::zeros(border, border),
            right: (vec![0.0; size], DVector::zeros(border)),
        }
    }

    /// Adds one residual to the normal equations, with its derivatives as pairs of an unknown's number and the
    /// derivative by it: `banded` by unknowns of the band, `bordered` by those of the border.
    pub(crate) fn add(
        &mut self,
        banded: &[(usize, f64)],
        bordered: &[(usize, f64)],
        residual: f64,
    ) {
        let width = self.half_width + 1;
        for (i, a) in banded {
            let row = &mut self.band[i * width..(i + 1) * width];
            for (j, b) in banded {
                if j <= i {
                    row[self.half_width - (i - j)] += a * b;
                }
            }
            self.right.0[*i] -= a * residual;
            for (k, b) in bordered {
                self.border[*k][*i] += a * b;
            }
        }
        for (k, a) in bordered {
            for (l, b) in bordered {
                self.corner[(*k, *l)] += a * b;
            }
            self.right.1[*k] -= a * residual;
        }
    }

    /// Solves the normal equations with the diagonal increased by `damping` times itself; returns the unknowns of band
    /// and border. None if the matrix is not positive definite.
    pub(crate) fn solve(&self, damping: f64) -> Option<(Vec<f64>, Vec<f64>)> {
        let width = self.half_width + 1;
        let mut factor = self.band.clone();
        for i in 0..self.size {
            let diagonal = &mut factor[i * width + self.half_width];
            *diagonal += damping * *diagonal + 1e-12;
        }
        self.factorise(&mut factor)?;
        let forward: Vec<Vec<f64>> = (self.border.iter().chain([&self.right.0]))
            .map(|column| self.forward(&factor, column))
            .collect();
        let count = self.border.len();
        let mut schur = self.corner.clone();
        let mut right = self.right.1.clone();
        for k in 0..count {
            schur[(k, k)] += damping * schur[(k, k)] + 1e-12;
            right[k] -= dot(&forward[k], &forward[count]);
            for l in 0..=k {
                let product = dot(&forward[k], &forward[l]);
                schur[(k, l)] -= product;
                if l < k {
                    schur[(l, k)] -= product;
                }
            }
        }
        let bordered = schur.cholesky()?.solve(&right);
        let mut banded = forward[count].clone();
        for (column, value) in forward.iter().zip(bordered.iter()) {
            for (b, c) in banded.iter_mut().zip(column) {
                *b -= value * c;
            }
        }
        self.backward(&factor, &mut banded);
        Some((banded, bordered.as_slice().to_vec()))
    }

    /// Replaces the lower triangle of a band matrix by its Cholesky factor, in place. None if the matrix is not
    /// positive definite.
    fn factorise(&self, band: &mut [f64]) -> Option<()> {
        let (half, width) = (self.half_width, self.half_width + 1);
        for i in 0..self.size {
            let (before, rest) = band.split_at_mut(i * width);
            let row = &mut rest[..width];
            for at in half.saturating_sub(i)..half {
                let j = i + at - half;
                let other = &before[j * width..(j + 1) * width];
                let sum = dot(&row[..at], &other[half - at..half]);
                row[at] = (row[at] - sum) / other[half];
            }
            let rest = row[half] - dot(&row[..half], &row[..half]);
            if !(rest > 0.0 && rest.is_finite()) {
                return None;
            }
            row[half] = rest.sqrt();
        }
        Some(())
    }

    /// Solves the equations of the lower triangular Cholesky factor (forward substitution).
    fn forward(&self, factor: &[f64], right: &[f64]) -> Vec<f64> {
        let (half, width) = (self.half_width, self.half_width + 1);
        let mut found = right.to_vec();
        let first = right.iter().position(|v| *v != 0.0).unwrap_or(self.size);
        for i in first..self.size {
            let row = &factor[i * width..(i + 1) * width];
            let start = i.saturating_sub(half);
            let sum = dot(&row[half - (i - start)..half], &found[start..i]);
            found[i] = (found[i] - sum) / row[half];
        }
        found
    }

    /// Solves the equations of the transposed Cholesky factor, in place (backward substitution).
    fn backward(&self, factor: &[f64], found: &mut [f64]) {
        let (half, width) = (self.half_width, self.half_width + 1);
        for i in (0..self.size).rev() {
            let row = &factor[i * width..(i + 1) * width];
            let value = found[i] / row[half];
            found[i] = value;
            let start = i.saturating_sub(half);
            let coefficients = &row[half - (i - start)..half];
            for (f, c) in found[start..i].iter_mut().zip(coefficients) {
                *f -= value * c;
            }
        }
    }
}

/// Inner product of two vectors, by four partial sums that the compiler vectorises.
#[inline]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a4, a_rest) = a.as_chunks::<4>();
    let (b4, b_rest) = b.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (p, q) in a4.iter().zip(b4) {
        for k in 0..4 {
            sums[k] += p[k] * q[k];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(p, q)| p * q).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_is_that_of_the_dense_matrix() {
        let (size, half, border) = (17, 4, 3);
        let mut rng = oorandom::Rand64::new(7);
        let mut system = BorderedSystem::new(size, half, border);
        let mut rows = Vec::new();
        for i in 0..60 {
            let start = i % (size - half);
            let banded: Vec<_> = (start..=start + half)
                .map(|j| (j, rng.rand_float() - 0.5))
                .collect();
            let bordered = [(i % border, rng.rand_float() - 0.5)];
            let residual = rng.rand_float();
            system.add(&banded, &bordered, residual);
            let mut row = DVector::zeros(size + border);
            banded.iter().for_each(|(j, v)| row[*j] = *v);
            row[size + bordered[0].0] = bordered[0].1;
            rows.push((row, residual));
        }
        let matrix = DMatrix::from_fn(60, size + border, |i, j| rows[i].0[j]);
        let right = DVector::from_fn(60, |i, _| -rows[i].1);
        let expected = matrix.svd(true, true).solve(&right, 1e-12).unwrap();
        let (banded, bordered) = system.solve(0.0).unwrap();
        for (found, expected) in banded.iter().chain(&bordered).zip(expected.iter()) {
            assert!((found - expected).abs() < 1e-8, "{found} {expected}");
        }
    }
}
