//! The operator `C` of a lattice: the Hessian of each stencil's best-fit quadratic.

use std::ops::Range;
use std::sync::Arc;

use super::{Hessians, Matrices, Operator, Sums};
use crate::error::Result;
use crate::fit::coordinates::Coordinates;
use crate::lattice::bands::Bands;
use crate::lattice::domain::{Domain, Role};
use crate::lattice::runs::{RowRuns, Run};
use crate::lattice::stencil::{Gathered, HessianMap, Ring, Rolling, weights_of};
use crate::math::fork;
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

    fn bands(&self) -> &Bands {
        self.domain.bands()
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

    fn band_hessians(&self, band: usize, z: &[f64], mut visit: impl FnMut(usize, Sym2)) {
        for row in self.bands().rows(band, self.domain.rows()) {
            for run in self.domain.interior().row(row) {
                let ring = Ring::new(z, &self.domain, row, *run);
                for cell in run.start..run.end {
                    visit(cell, self.map.hessian(ring.differences(cell - run.start)));
                }
            }
        }
    }

    #[inline(always)]
    fn sweep<S: Send>(
        &self,
        rolling: &mut Rolling<f64>,
        z: &[f64],
        states: &mut [S],
        at_stencils: impl Fn(&mut S, Run, RunHessians<'_, f64>, RunMatrices<'_, f64>) + Sync,
        at_vertices: impl Fn(&mut S, Run, Gathered<'_, f64>) + Sync,
    ) {
        let (domain, map) = (&*self.domain, self.map);
        rolling.sweep(
            domain,
            states,
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

    /// Computes `CᵀY` and the Hessians of heights made of it in one pass down the rows of each band: the Hessians of a
    /// row follow as soon as the heights around it are there, and those of the outermost rows after all bands' heights.
    #[inline(always)]
    fn sweep_back<S: Send>(
        &self,
        rolling: &mut Rolling<f32>,
        heights: &mut [f32],
        states: &mut [S],
        at_stencils: impl Fn(&mut S, Run, RunMatrices<'_, f32>) + Sync,
        at_vertices: impl Fn(&mut S, Run, Gathered<'_, f32>, &mut [f32]) + Sync,
        follow: impl Fn(&mut S, Run, RunHessians<'_, f32>) + Sync,
    ) {
        let (domain, map) = (&*self.domain, HessianMap::unit());
        let bands = domain.bands();
        let rows_of = |band| bands.rows(band, domain.rows());
        // `heights` begin with the cell `first`.
        let follow = |state: &mut S, heights: &[f32], first: usize, row: usize| {
            for run in domain.interior().row(row) {
                let local = Run {
                    start: run.start - first,
                    end: run.end - first,
                };
                let ring = Ring::new(heights, domain, row, local);
                follow(state, *run, RunHessians { ring, map });
            }
        };
        let mut both: Vec<_> = states
            .iter_mut()
            .zip(bands.split(heights))
            .enumerate()
            .map(|(band, (state, heights))| {
                // The first row whose Hessians take no heights of the band above.
                let inner = rows_of(band).start + if band > 0 { 2 } else { 0 };
                (state, heights, inner)
            })
            .collect();
        rolling.sweep(
            domain,
            &mut both,
            |(state, ..), row, weights| {
                for run in domain.interior().row(row) {
                    let weights = weights_of(weights, domain, row, *run);
                    at_stencils(state, *run, RunMatrices { weights, map });
                }
            },
            |(state, heights, inner), row, sums| {
                for run in domain.active().row(row) {
                    at_vertices(state, *run, sums.run(*run), heights.run_mut(*run));
                }
                if row > *inner {
                    let first = heights.first();
                    follow(state, heights.values(), first, row - 1);
                }
            },
        );
        drop(both);
        if bands.len() == 1 {
            return;
        }
        let heights = &*heights;
        fork::for_each(states, |band, state| {
            let Range { start, end } = rows_of(band);
            let top = (band > 0).then_some([start, start + 1]);
            let bottom = (band + 1 < bands.len()).then_some(end - 1);
            for row in top.into_iter().flatten().chain(bottom) {
                follow(state, heights, 0, row);
            }
        });
    }

    /// Writes the upward component of the surface's unit normal at each stencil; heights are relative to a plane, whose
    /// slope is added.
    fn normals(&self, z: &[f64], to: &mut [f64]) {
        let domain = &self.domain;
        let bands = domain.bands();
        let mut states: Vec<_> = bands.split(to).collect();
        fork::for_each(&mut states, |band, to| {
            for row in bands.rows(band, domain.rows()) {
                for run in domain.interior().row(row) {
                    let ring = Ring::new(z, domain, row, *run);
                    for (i, factor) in to.run_mut(*run).iter_mut().enumerate() {
                        let [gx, gy] = ring.gradient(i, self.spacing);
                        let [sx, sy] = self.coordinates.slope();
                        let (gx, gy) = (gx + sx, gy + sy);
                        *factor = 1.0 / (1.0 + gx * gx + gy * gy).sqrt();
                    }
                }
            }
        });
    }

    fn spread(&self, values: &mut [f64]) {
        let domain = &self.domain;
        let old = values.to_vec();
        let bands = domain.bands();
        let mut states: Vec<_> = bands.split(values).collect();
        fork::for_each(&mut states, |band, values| {
            for row in bands.rows(band, domain.rows()) {
                let offsets = domain.neighbour_offsets(row);
                for run in domain.interior().row(row) {
                    for (cell, value) in (run.start..).zip(values.run_mut(*run)) {
                        let around = offsets
                            .map(|o| cell.wrapping_add_signed(o))
                            .into_iter()
                            .filter(|n| domain.roles()[*n] == Role::Interior);
                        let own = (2.0 * old[cell], 2.0);
                        let (sum, weight) =
                            around.fold(own, |(sum, weight), n| (sum + old[n], weight + 1.0));
                        *value = sum / weight;
                    }
                }
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::fork::Pool;
    use crate::{Heightfield, Input, Lattice};

    /// Results of the sweeps on a disk with holes that is divided into about a number of bands: Hessians, `CᵀY`, and the
    /// Hessians of `CᵀY`.
    fn swept(bands: usize) -> (usize, [Vec<[f64; 3]>; 2], Vec<f64>) {
        let lattice = Lattice::new(70, 40, 1.0).unwrap();
        let height = |x: f64, y: f64| (0.7 * x).sin() * (0.4 * y + 0.1 * x).cos();
        let field = Heightfield::from_fn(lattice, |x, y| {
            let is_outside = (x - 20.0).hypot(0.6 * (y + 30.0)) > 18.0;
            let is_hole = (x - 12.0).hypot(y + 28.0) < 4.0;
            if is_outside || is_hole {
                f64::NAN
            } else {
                height(x, y)
            }
        });
        let input = Input::new(field.unwrap());
        let domain = Arc::new(input.domain().unwrap().with_bands(bands));
        let operator =
            LatticeOperator::new(domain.clone(), &Coordinates::new(&input, &domain, 1.0));
        let mut z = vec![0.0; domain.cells()];
        for cell in domain.active().cells() {
            let [x, y] = position(&domain, cell);
            z[cell] = height(x, y);
        }
        let zeros = || vec![[0.0; 3]; domain.cells()];
        let (mut hessians, mut back) = (zeros(), zeros());
        let mut sums = vec![0.0; domain.cells()];
        let y = |cell: usize| [1.0, 3.0, 7.0].map(|factor| (factor * cell as f64).sin());
        let bands = domain.bands();
        let mut states: Vec<_> = bands
            .split(&mut hessians)
            .zip(bands.split(&mut sums))
            .collect();
        operator.sweep(
            &mut operator.scratch().unwrap(),
            &z,
            &mut states,
            |(to, _), run, hessians, mut matrices| {
                for (i, to) in to.run_mut(run).iter_mut().enumerate() {
                    *to = hessians.at(i);
                    matrices.set(i, y(run.start + i));
                }
            },
            |(_, to), run, sums| {
                for (i, to) in to.run_mut(run).iter_mut().enumerate() {
                    *to = sums.at(i);
                }
            },
        );
        drop(states);
        operator.sweep_back(
            &mut operator.scratch().unwrap(),
            &mut vec![0.0; domain.cells()],
            &mut bands.split(&mut back).collect::<Vec<_>>(),
            |_, run, mut matrices| {
                for i in 0..run.end - run.start {
                    matrices.set(i, y(run.start + i).map(|y| y as f32));
                }
            },
            |_, _, sums, heights| {
                for (i, height) in heights.iter_mut().enumerate() {
                    *height = sums.at(i);
                }
            },
            |to, run, hessians| {
                for (i, to) in to.run_mut(run).iter_mut().enumerate() {
                    *to = hessians.at(i).map(f64::from);
                }
            },
        );
        (bands.len(), [hessians, back], sums)
    }

    #[test]
    fn bands_change_nothing_at_any_vertex() {
        let (_, hessians, sums) = swept(1);
        assert!(
            hessians
                .iter()
                .flatten()
                .flatten()
                .all(|value| value.is_finite())
        );
        for number in 2..=7 {
            for threads in [1, 3] {
                let (bands, others, other_sums) = Pool::new(threads).run(|| swept(number));
                assert!(bands > 1 && bands <= number);
                assert!(
                    others == hessians && other_sums == sums,
                    "{number} {threads}"
                );
            }
        }
    }
}
