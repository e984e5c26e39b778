//! The matrix of the z-step's linear system on one lattice, and the passes that multigrid and conjugate gradients make
//! with it:
//!
//! ```text
//! A = 2λ + ρ CᵀC
//! ```
//!
//! It is in single precision and scaled to a unit diagonal away from the boundary, so that no λ, ρ or spacing
//! leaves the range of `f32`.

use std::sync::Arc;

use crate::error::{Result, try_filled};
use crate::lattice::domain::{Domain, Role};
use crate::lattice::per_cell::PerCell;
use crate::lattice::runs::Run;
use crate::lattice::stencil::{Gather, HessianMap, Ring, Rolling, Weights, weights_of};
use crate::math::{fork, lanes};

/// The matrix `A = 2λw + ρ CᵀC` of the z-step on one lattice, scaled to a unit diagonal away from the boundary.
#[derive(Debug, Clone)]
pub(crate) struct Grid {
    pub domain: Arc<Domain>,
    map: HessianMap,
    /// Diagonal entry of the unscaled matrix away from the boundary, by which the matrix is divided.
    pub diagonal: f64,
    /// Scaled fidelity weight `2λw` of each vertex, with the springs that hold coarse vertices in place of constrained
    /// ones.
    fidelity: PerCell<f32>,
    /// Constrained vertices, whose heights are no unknowns.
    constrained: Vec<u32>,
    /// Weight of each second difference `d_k` in `ρ CᵀC`, beside the weight `sum` of all three.
    own: f32,
    sum: f32,
    /// Weight of each interior vertex's stencil: 1 on the finest lattice, more at the border of a coarse one.
    pub stencils: PerCell<f32>,
    /// Jacobi preconditioner: one over the scaled diagonal; 0 at constrained vertices.
    pub inverse_diagonal: Vec<f32>,
    rolling: Rolling<f32>,
}

/// Upper bound of the eigenvalues of `diag(A)⁻¹A` for the z-step's matrix `A` on every domain: the largest eigenvalue
/// for a single stencil, because `A` and its diagonal are sums over stencils. (A stencil has 36 on the diagonal at its
/// centre and 5 at each neighbour in units of 2/9 h⁻⁴; the deviatoric rows give 12/5, the mean 11/5; `benches/choices.md`, One constant at a time.)
pub(crate) const LARGEST_EIGENVALUE: f32 = 2.4;

impl Grid {
    /// Allocates the matrix on a domain; if `varied`, its fidelity weight differs from vertex to vertex.
    pub(crate) fn new(
        domain: Arc<Domain>,
        spacing: f64,
        constrained: Vec<u32>,
        varied: bool,
    ) -> Result<Self> {
        Ok(Grid {
            map: HessianMap::new(spacing),
            diagonal: 1.0,
            fidelity: if varied {
                PerCell::Each(try_filled("multigrid", domain.cells(), 0.0)?)
            } else {
                PerCell::same(domain.stride(), 0.0)
            },
            constrained,
            own: 0.0,
            sum: 0.0,
            stencils: PerCell::same(domain.stride(), 1.0),
            inverse_diagonal: try_filled("diagonal", domain.cells(), 0.0)?,
            rolling: Rolling::new(&domain),
            domain,
        })
    }

    /// Diagonal entry of `ρ CᵀC` away from the boundary.
    pub(crate) fn stiffness(&self, rho: f64) -> f64 {
        let [own, other, _] = self.map.normal([1.0, 0.0, 0.0]).map(|q| rho * q);
        4.0 * (3.0 * own + 6.0 * other) + 6.0 * own
    }

    /// Sets ρ, a typical fidelity weight `2λw`, by which the matrix is scaled, and the weight of `each` vertex.
    pub(crate) fn set(&mut self, rho: f64, typical: f64, each: impl Fn(usize) -> f64 + Sync) {
        let [own, other, _] = self.map.normal([1.0, 0.0, 0.0]).map(|q| rho * q);
        let as_centre = 4.0 * (3.0 * own + 6.0 * other);
        self.diagonal = typical + self.stiffness(rho);
        self.own = ((own - other) / self.diagonal) as f32;
        self.sum = (other / self.diagonal) as f32;
        match &mut self.fidelity {
            PerCell::Same(row) => row.fill((typical / self.diagonal) as f32),
            PerCell::Each(values) => {
                for cell in self.domain.active().cells() {
                    values[cell] = lanes::single(each(cell) / self.diagonal);
                }
            }
        }
        let roles = self.domain.roles();
        let interior = |cell: usize| roles[cell] == Role::Interior;
        // If all stencils have the same weight, their number is enough.
        let same = match &self.stencils {
            PerCell::Same(values) => Some(lanes::double(values[0])),
            PerCell::Each(_) => None,
        };
        let (domain, stencils, diagonal) = (&*self.domain, &self.stencils, self.diagonal);
        let bands = domain.bands();
        let mut inverses: Vec<_> = bands.split(&mut self.inverse_diagonal).collect();
        fork::for_each(&mut inverses, |band, inverses| {
            let runs = (bands.rows(band, domain.rows()))
                .flat_map(|row| domain.active().row(row).iter().map(move |run| (row, *run)));
            for (row, run) in runs {
                let offsets = domain.neighbour_offsets(row);
                let inverse = inverses.run_mut(run);
                let Run { start, end } = run;
                if let Some(count) = same {
                    let n = end - start;
                    let here = &roles[start..end];
                    let around = offsets.map(|o| &roles[start.wrapping_add_signed(o)..][..n]);
                    let one = |role: Role| u8::from(role == Role::Interior);
                    for i in 0..n {
                        let others: u8 = around.iter().map(|roles| one(roles[i])).sum();
                        let centre = f64::from(one(here[i])) * count * as_centre;
                        let entry = each(start + i) + centre + f64::from(others) * count * own;
                        inverse[i] = lanes::single(diagonal / entry);
                    }
                    continue;
                }
                for (cell, inverse) in (start..end).zip(inverse) {
                    let around = offsets.iter().map(|o| cell.wrapping_add_signed(*o));
                    let count = |cell: usize| lanes::double(stencils.at(cell));
                    let others: f64 = around.filter(|n| interior(*n)).map(count).sum();
                    let centre = if interior(cell) {
                        count(cell) * as_centre
                    } else {
                        0.0
                    };
                    let entry = each(cell) + centre + others * own;
                    *inverse = lanes::single(diagonal / entry);
                }
            }
        });
        // With 0 in its place, smoothing leaves a constrained cell alone.
        for cell in &self.constrained {
            self.inverse_diagonal[*cell as usize] = 0.0;
        }
    }

    /// Sets `x` to 0 at constrained vertices.
    pub(crate) fn pin(&self, x: &mut [f32]) {
        for cell in &self.constrained {
            x[*cell as usize] = 0.0;
        }
    }

    /// Constrained vertices, whose heights are no unknowns.
    pub(crate) fn constrained(&self) -> &[u32] {
        &self.constrained
    }

    /// Returns an upper bound of the condition number of `diag(A)⁻¹A`.
    pub(crate) fn condition(&self) -> f32 {
        let least = match &self.fidelity {
            PerCell::Same(values) => values[0],
            PerCell::Each(values) => {
                let cells = self.domain.active().cells();
                cells.fold(f32::INFINITY, |least, cell| least.min(values[cell]))
            }
        };
        LARGEST_EIGENVALUE / least.max(f32::MIN_POSITIVE)
    }

    /// Returns the scaled matrix as dense columns, with unknowns in the order of the domain's active vertices: for few
    /// unknowns.
    pub(crate) fn dense(&mut self) -> Vec<Vec<f32>> {
        let cells: Vec<usize> = self.domain.active().cells().collect();
        let mut unit = vec![0.0; self.domain.cells()];
        let mut image = vec![0.0; self.domain.cells()];
        let mut columns = Vec::with_capacity(cells.len());
        for cell in &cells {
            unit[*cell] = 1.0;
            self.apply(&unit, &mut image);
            unit[*cell] = 0.0;
            columns.push(cells.iter().map(|c| image[*c]).collect());
        }
        columns
    }

    /// Splits the matrix into what [`fill_weights`] reads of it and the rows of weights.
    fn split(&mut self) -> (PenaltyMatrix<'_>, &mut Rolling<f32>) {
        let factors = [self.own, self.sum];
        ((&*self.domain, factors, &self.stencils), &mut self.rolling)
    }

    /// Computes `ρCᵀCx` in one pass down the rows of `x`: `after(state, run, sums)` gets its values in each run of a row,
    /// with the state of the row's band.
    #[inline(always)]
    fn pass<S: Send>(
        &mut self,
        x: &[f32],
        states: &mut [S],
        after: impl Fn(&mut S, Run, &Gather<'_, f32>) + Sync,
    ) {
        let (matrix, rolling) = self.split();
        let (domain, ..) = matrix;
        rolling.sweep(
            domain,
            states,
            |_, row, weights| fill_weights(matrix, x, row, weights),
            |state, row, sums| {
                for run in domain.active().row(row) {
                    after(state, *run, sums);
                }
            },
        );
    }

    /// Computes `ρCᵀCx` in one pass down the rows of `x`, on the calling thread: `after(x, run, sums)` gets its values in each
    /// run of a row, and may write `x` there, because no later row reads it.
    #[inline(always)]
    fn pass_in_place(
        &mut self,
        mut x: &mut [f32],
        after: impl FnMut(&mut [f32], Run, &Gather<'_, f32>),
    ) {
        let (matrix, rolling) = self.split();
        let (domain, ..) = matrix;
        let mut state = (&mut x, after);
        rolling.sweep_serially(
            domain,
            &mut state,
            |(x, _), row, weights| fill_weights(matrix, x, row, weights),
            |(x, after), row, sums| {
                for run in domain.active().row(row) {
                    after(x, *run, sums);
                }
            },
        );
    }

    /// Computes `image = A x` and returns the product `x·Ax`.
    pub(crate) fn apply(&mut self, x: &[f32], image: &mut [f32]) -> f64 {
        let fidelity = self.take_fidelity();
        let domain = self.domain.clone();
        let images = domain.bands().split(image);
        let mut states: Vec<_> = images.map(|image| (image, 0.0)).collect();
        self.pass(x, &mut states, |(image, product), run, sums| {
            let sum = sums.run(run);
            let fidelity = fidelity.run(run);
            let x = part(x, run);
            let image = image.run_mut(run);
            for i in 0..x.len() {
                image[i] = fidelity[i] * x[i] + sum.at(i);
            }
            *product += lanes::dot(x, image);
        });
        self.fidelity = fidelity;
        states.iter().map(|(_, product)| product).sum()
    }

    /// Computes `residual = b − A x`.
    pub(crate) fn residual(&mut self, x: &[f32], b: &[f32], residual: &mut [f32]) {
        let fidelity = self.take_fidelity();
        let domain = self.domain.clone();
        let mut states: Vec<_> = domain.bands().split(residual).collect();
        self.pass(x, &mut states, |residual, run, sums| {
            let sum = sums.run(run);
            let fidelity = fidelity.run(run);
            let x = part(x, run);
            let b = part(b, run);
            let residual = residual.run_mut(run);
            for i in 0..x.len() {
                residual[i] = b[i] - (fidelity[i] * x[i] + sum.at(i));
            }
        });
        self.fidelity = fidelity;
    }

    /// Takes one step of Chebyshev's iteration for `A x = b` with Jacobi's preconditioner `M`: `d ← momentum · d +
    /// weight · M(b − A x)`, `x ← x + d`. On one thread `x` changes in place; else the sum is written to `next`, since bands
    /// read rows of their neighbours, and changes places with `x`.
    pub(crate) fn smooth(
        &mut self,
        (x, next): (&mut Vec<f32>, &mut Vec<f32>),
        b: &[f32],
        d: &mut [f32],
        momentum: f32,
        weight: f32,
    ) {
        let fidelity = self.take_fidelity();
        let inverse = std::mem::take(&mut self.inverse_diagonal);
        let step = |x: &[f32], d: &mut [f32], run: Run, sums: &Gather<'_, f32>| {
            let sum = sums.run(run);
            let fidelity = fidelity.run(run);
            let b = part(b, run);
            let m = part(&inverse, run);
            for i in 0..x.len() {
                let residual = b[i] - (fidelity[i] * x[i] + sum.at(i));
                d[i] = momentum * d[i] + weight * (m[i] * residual);
            }
        };
        if fork::is_serial() {
            self.pass_in_place(x, |x, run, sums| {
                let x = part_mut(x, run);
                let d = part_mut(d, run);
                step(x, d, run, sums);
                x.iter_mut().zip(d).for_each(|(x, d)| *x += *d);
            });
        } else {
            next.resize(x.len(), 0.0);
            let domain = self.domain.clone();
            let bands = domain.bands();
            let mut states: Vec<_> = bands.split(next).zip(bands.split(d)).collect();
            self.pass(x, &mut states, |(next, d), run, sums| {
                let x = part(x, run);
                let d = d.run_mut(run);
                step(x, d, run, sums);
                let next = next.run_mut(run);
                for i in 0..x.len() {
                    next[i] = x[i] + d[i];
                }
            });
            std::mem::swap(x, next);
        }
        self.inverse_diagonal = inverse;
        self.fidelity = fidelity;
    }

    /// Moves the fidelity weights out of the matrix for the length of a pass, which borrows the rest mutably.
    fn take_fidelity(&mut self) -> PerCell<f32> {
        std::mem::replace(&mut self.fidelity, PerCell::Same(Vec::new()))
    }
}

/// The matrix `ρCᵀC`: its domain, the factors of a second difference itself and of the sum of all three, and the numbers of
/// stencils.
type PenaltyMatrix<'a> = (&'a Domain, [f32; 2], &'a PerCell<f32>);

/// Writes the weights of second differences of a row of `x` whose adjoint is `ρCᵀCx`.
#[inline(always)]
fn fill_weights(
    (domain, [own, sum], stencils): PenaltyMatrix<'_>,
    x: &[f32],
    row: usize,
    weights: &mut Weights<f32>,
) {
    for run in domain.interior().row(row) {
        let ring = Ring::new(x, domain, row, *run);
        let [w1, w2, w3] = weights_of(weights, domain, row, *run);
        let count = stencils.run(*run);
        for i in 0..w1.len() {
            let [d1, d2, d3] = ring.differences(i);
            let common = sum * (d1 + d2 + d3);
            w1[i] = count[i] * (own * d1 + common);
            w2[i] = count[i] * (own * d2 + common);
            w3[i] = count[i] * (own * d3 + common);
        }
    }
}

/// Returns the values of a run's cells.
#[inline(always)]
pub(crate) fn part<T>(values: &[T], run: Run) -> &[T] {
    &values[run.start..run.end]
}

/// Returns the values of a run's cells, to be changed.
#[inline(always)]
pub(crate) fn part_mut<T>(values: &mut [T], run: Run) -> &mut [T] {
    &mut values[run.start..run.end]
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
    use crate::HessianOperator;
    use crate::lattice::domain::tests::{arbitrary_field, single_ring};
    use proptest::prelude::*;

    fn values(domain: &Domain) -> Vec<f32> {
        let mut x = 0.37;
        let mut values = vec![0.0; domain.cells()];
        for cell in domain.active().cells() {
            x = 3.9 * x * (1.0 - x);
            values[cell] = x - 0.5;
        }
        values
    }

    /// Against `C` and `Cᵀ` themselves, in double precision.
    fn check(domain: Domain, lambda: f64, rho: f64) {
        let domain = Arc::new(domain);
        let spacing = domain.lattice().spacing();
        let mut grid = Grid::new(domain.clone(), spacing, Vec::new(), false).unwrap();
        grid.set(rho, 2.0 * lambda, |_| 2.0 * lambda);
        let mut x = values(&domain);
        let mut heights = vec![0.0; domain.lattice().len()];
        for cell in domain.active().cells() {
            heights[domain.lattice_index(cell)] = f64::from(x[cell]);
        }
        let c = HessianOperator::new(&domain);
        let normal = c.adjoint(&c.apply(&heights));
        let mut image = vec![0.0; domain.cells()];
        let product = grid.apply(&x, &mut image);
        let mut expected_product = 0.0;
        for cell in domain.active().cells() {
            let i = domain.lattice_index(cell);
            let expected = (2.0 * lambda * heights[i] + rho * normal[i]) / grid.diagonal;
            assert!((f64::from(image[cell]) - expected).abs() < 1e-5);
            expected_product += expected * heights[i];
        }
        assert!((product - expected_product).abs() < 1e-4 * domain.active().len() as f64);

        // The diagonal, by unit vectors; the eigenvalues, by Rayleigh quotients of a power iteration.
        for cell in domain.active().cells().take(10) {
            let mut unit = vec![0.0; domain.cells()];
            unit[cell] = 1.0;
            let entry = grid.apply(&unit, &mut image) as f32;
            assert!((entry * grid.inverse_diagonal[cell] - 1.0).abs() < 1e-5);
        }
        for _ in 0..30 {
            grid.apply(&x, &mut image);
            let mut size = 0.0f32;
            for cell in domain.active().cells() {
                x[cell] = grid.inverse_diagonal[cell] * image[cell];
                size = size.max(x[cell].abs());
            }
            x.iter_mut().for_each(|v| *v /= size);
        }
        let curvature = grid.apply(&x, &mut image);
        let cells = domain.active().cells();
        let square: f64 = cells
            .map(|c| f64::from(x[c] * x[c] / grid.inverse_diagonal[c]))
            .sum();
        let largest = curvature / square;
        assert!(
            largest <= f64::from(LARGEST_EIGENVALUE) * 1.0001,
            "{largest}"
        );
    }

    #[test]
    fn one_interior_vertex() {
        check(Domain::new(&single_ring()).unwrap(), 1e-3, 1.0);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn the_matrix_is_the_one_it_says(
            field in arbitrary_field(), lambda in 1e-3..1e3f64, rho in 1e-3..1e1f64,
        ) {
            if let Ok(domain) = Domain::new(&field) {
                check(domain, lambda, rho);
            }
        }
    }
}
