//! The operator `C` of a lattice: the Hessian of each stencil's best-fit quadratic.

use std::sync::Arc;

use super::{Hessians, Matrices, Operator, Sums};
use crate::error::Result;
use crate::fit::coordinates::Coordinates;
use crate::lattice::domain::{Domain, Role};
use crate::lattice::runs::{RowRuns, Run};
use crate::lattice::stencil::{Gathered, HessianMap, Ring, Rolling, weights_of};
use crate::math::real::Real;
use crate::math::sym2::Sym2;

/// Norm `h⁴‖CᵀC‖` of the operator on the unbounded lattice, where two of the three second differences are largest and
/// the third vanishes; the norm on a domain is no larger.
const SCALED_OPERATOR_NORM: f32 = 256.0 / 9.0;

/// Operator `C` from heights to Hessians over a domain of a lattice, in normalised coordinates. Vertices and stencils
/// are both numbered as cells of the domain's padded box.
#[derive(Debug, Clone)]
pub(crate) struct LatticeOperator {
    pub domain: Arc<Domain>,
    /// Normalised coordinates: their scale, and the plane that heights are relative to.
    pub coordinates: Coordinates,
    pub map: HessianMap,
    /// Spacing of the lattice in normalised coordinates.
    pub spacing: f64,
}

impl LatticeOperator {
    pub(crate) fn new(domain: Arc<Domain>, coordinates: &Coordinates) -> Self {
        let spacing = coordinates.scale * domain.lattice().spacing();
        LatticeOperator {
            domain,
            coordinates: *coordinates,
            map: HessianMap::new(spacing),
            spacing,
        }
    }
}

/// Returns the position of a vertex in the user's units; the vertex is given by its cell in the domain's padded box.
pub(crate) fn position(domain: &Domain, cell: usize) -> [f64; 2] {
    let (row, col) = domain.lattice_vertex(cell);
    domain.lattice().position(row, col)
}

/// Hessians of a run of stencils, computed on demand from second differences.
pub(crate) struct RunHessians<'a, T> {
    ring: Ring<'a, T>,
    map: HessianMap<T>,
}

impl<T: Real> Hessians<T> for RunHessians<'_, T> {
    #[inline(always)]
    fn at(&self, i: usize) -> [T; 3] {
        self.map.coordinates(self.ring.differences(i))
    }
}

/// Matrices `Y` of a run of stencils, stored as the weights of second differences in `Cᵀ`.
pub(crate) struct RunMatrices<'a, T> {
    weights: [&'a mut [T]; 3],
    map: HessianMap<T>,
}

impl<T: Real> Matrices<T> for RunMatrices<'_, T> {
    #[inline(always)]
    fn set(&mut self, i: usize, matrix: [T; 3]) {
        let [w1, w2, w3] = &mut self.weights;
        (w1[i], w2[i], w3[i]) = self.map.adjoint_of(matrix).into();
    }
}

impl<T: Real> Sums<T> for Gathered<'_, T> {
    #[inline(always)]
    fn at(&self, i: usize) -> T {
        Gathered::at(self, i)
    }
}

impl Operator for LatticeOperator {
    type Scratch<T: Real> = Rolling<T>;
    type Hessians<'a, T: Real> = RunHessians<'a, T>;
    type Matrices<'a, T: Real> = RunMatrices<'a, T>;
    type Sums<'a, T: Real> = Gathered<'a, T>;

    fn vertices(&self) -> &RowRuns {
        self.domain.active()
    }

    fn stencils(&self) -> &RowRuns {
        self.domain.interior()
    }

    fn vertex_cells(&self) -> usize {
        self.domain.cells()
    }

    fn stencil_cells(&self) -> usize {
        self.domain.cells()
    }

    fn longest_run(&self) -> usize {
        self.domain.stride()
    }

    fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Returns the longer side of the domain's padded box, in normalised coordinates.
    fn size(&self) -> f64 {
        self.spacing * self.domain.rows().max(self.domain.stride()) as f64
    }

    #[inline(always)]
    fn norm(&self) -> f32 {
        SCALED_OPERATOR_NORM
    }

    fn place(&self, vertex: usize) -> [f64; 2] {
        position(&self.domain, vertex).map(|x| self.coordinates.scale * x)
    }

    fn scratch<T: Real>(&self) -> Result<Rolling<T>> {
        Ok(Rolling::new(&self.domain))
    }

    fn hessians(&self, z: &[f64], mut visit: impl FnMut(usize, Sym2)) {
        for row in 1..=self.domain.rows() {
            for run in self.domain.interior().row(row) {
                let ring = Ring::new(z, &self.domain, row, *run);
                for cell in run.start..run.end {
                    visit(cell, self.map.hessian(ring.differences(cell - run.start)));
                }
            }
        }
    }

    #[inline(always)]
    fn sweep<S: ?Sized>(
        &self,
        rolling: &mut Rolling<f64>,
        z: &[f64],
        state: &mut S,
        mut at_stencils: impl FnMut(&mut S, Run, RunHessians<'_, f64>, RunMatrices<'_, f64>),
        mut at_vertices: impl FnMut(&mut S, Run, Gathered<'_, f64>),
    ) {
        let (domain, map) = (&*self.domain, self.map);
        rolling.sweep(
            domain,
            state,
            |state, row, weights| {
                for run in domain.interior().row(row) {
                    let ring = Ring::new(z, domain, row, *run);
                    let weights = weights_of(weights, domain, row, *run);
                    let hessians = RunHessians { ring, map };
                    at_stencils(state, *run, hessians, RunMatrices { weights, map });
                }
            },
            |state, row, sums| {
                for run in domain.active().row(row) {
                    at_vertices(state, *run, sums.run(*run));
                }
            },
        );
    }

    /// Computes `CᵀY` and the Hessians of heights made of it in one pass down the rows: the Hessians of a row follow as
    /// soon as the heights around it are there.
    #[inline(always)]
    fn sweep_back<S: ?Sized>(
        &self,
        rolling: &mut Rolling<f32>,
        heights: &mut [f32],
        state: &mut S,
        mut at_stencils: impl FnMut(&mut S, Run, RunMatrices<'_, f32>),
        mut at_vertices: impl FnMut(&mut S, Run, Gathered<'_, f32>, &mut [f32]),
        mut follow: impl FnMut(&mut S, Run, RunHessians<'_, f32>),
    ) {
        let (domain, map) = (&*self.domain, HessianMap::unit());
        let mut follow = |state: &mut S, heights: &[f32], row: usize| {
            for run in domain.interior().row(row) {
                let ring = Ring::new(heights, domain, row, *run);
                follow(state, *run, RunHessians { ring, map });
            }
        };
        let mut both = (state, heights);
        rolling.sweep(
            domain,
            &mut both,
            |(state, _), row, weights| {
                for run in domain.interior().row(row) {
                    let weights = weights_of(weights, domain, row, *run);
                    at_stencils(state, *run, RunMatrices { weights, map });
                }
            },
            |(state, heights), row, sums| {
                for run in domain.active().row(row) {
                    let Run { start, end } = *run;
                    at_vertices(state, *run, sums.run(*run), &mut heights[start..end]);
                }
                if row > 1 {
                    follow(state, heights, row - 1);
                }
            },
        );
        let (state, heights) = both;
        follow(state, heights, domain.rows());
    }

    /// Writes the upward component of the surface's unit normal at each stencil; heights are relative to a plane, whose
    /// slope is added.
    fn normals(&self, z: &[f64], to: &mut [f64]) {
        let domain = &self.domain;
        for row in 1..=domain.rows() {
            for run in domain.interior().row(row) {
                let ring = Ring::new(z, domain, row, *run);
                for (i, factor) in to[run.start..run.end].iter_mut().enumerate() {
                    let [gx, gy] = ring.gradient(i, self.spacing);
                    let [sx, sy] = self.coordinates.slope();
                    let (gx, gy) = (gx + sx, gy + sy);
                    *factor = 1.0 / (1.0 + gx * gx + gy * gy).sqrt();
                }
            }
        }
    }

    fn spread(&self, values: &mut [f64]) {
        let domain = &self.domain;
        let old = values.to_vec();
        for cell in domain.interior().cells() {
            let around = domain
                .neighbour_offsets(cell / domain.stride())
                .map(|o| cell.wrapping_add_signed(o))
                .into_iter()
                .filter(|n| domain.roles()[*n] == Role::Interior);
            let (sum, weight) = around.fold((2.0 * old[cell], 2.0), |(sum, weight), n| {
                (sum + old[n], weight + 1.0)
            });
            values[cell] = sum / weight;
        }
    }
}
