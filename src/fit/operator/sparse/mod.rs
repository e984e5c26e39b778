//! An operator that is given as a sparse matrix, as for what is no lattice.

mod jacobi;
#[cfg(all(test, not(target_arch = "wasm32")))] // clarabel is native
mod tests;

use sprs::{CsMat, TriMat};

use self::jacobi::JacobiGradients;
use super::{Hessians, Matrices, Operator, Sums};
use crate::error::{Result, try_filled};
use crate::lattice::runs::{RowRuns, Run};
use crate::math::lanes;
use crate::math::real::Real;
use crate::math::sym2::Sym2;

/// Runs are at most so long: what kernels keep of one stays in the cache.
const LONGEST: usize = 256;

/// Power iterations for the norm, and by how much they may fall short of it. Only the speed of the
/// bound's ascent depends on it, not that it is one.
const POWER: usize = 30;
const MARGIN: f32 = 1.1;

/// `C` as a matrix, and its transpose, by the coordinates of [`Sym2`]: three rows, or columns, for each
/// stencil.
#[derive(Debug, Clone)]
struct Pair<T> {
    rows: CsMat<T>,
    /// Of the adjoint with respect to the Frobenius inner product, by rows, too.
    adjoint: CsMat<T>,
}

impl<T: Real> Pair<T> {
    fn hessians<'a>(&'a self, run: Run, heights: &'a [T]) -> RunHessians<'a, T> {
        RunHessians {
            rows: &self.rows,
            first: run.start,
            heights,
        }
    }

    fn sums<'a>(&'a self, run: Run, matrices: &'a [T]) -> RunSums<'a, T> {
        RunSums {
            adjoint: &self.adjoint,
            first: run.start,
            matrices,
        }
    }
}

#[derive(Debug, Clone)]
pub(crate) struct SparseOperator {
    double: Pair<f64>,
    /// `h²C`.
    single: Pair<f32>,
    vertices: RowRuns,
    stencils: RowRuns,
    /// The vertex in the middle of each stencil, and the stencil about each vertex, or [`NONE`].
    centres: Vec<usize>,
    about: Vec<usize>,
    places: Vec<[f64; 2]>,
    spacing: f64,
    size: f64,
    norm: f32,
}

const NONE: usize = usize::MAX;

impl SparseOperator {
    /// Of a matrix with three rows `h_xx, h_xy, h_yy` for each stencil, as
    /// [`crate::HessianOperator::to_sparse`] makes them, and a column for each vertex; columns of
    /// zeros are no unknowns. `centres` are the vertices in the middle of the stencils. What a row
    /// measures is taken for the second fundamental form.
    ///
    /// # Panics
    /// If the matrix does not have three rows for each centre and a column for each place.
    pub(crate) fn new(
        matrix: &CsMat<f64>,
        centres: Vec<usize>,
        places: Vec<[f64; 2]>,
        spacing: f64,
    ) -> Result<Self> {
        assert_eq!(matrix.shape(), (3 * centres.len(), places.len()));
        let rows = by_coordinates(matrix);
        let mut about = try_filled("stencils", places.len(), NONE)?;
        for (stencil, centre) in centres.iter().enumerate() {
            about[*centre] = stencil;
        }
        let mut touched = try_filled("vertices", places.len(), false)?;
        for vertex in rows.indices() {
            touched[*vertex] = true;
        }
        let vertices = RowRuns::new(&touched, LONGEST, |touched| touched);
        let all = try_filled("stencils", centres.len(), true)?;
        let extent = |k: usize| {
            let along = vertices.cells().map(|vertex| places[vertex][k]);
            let [least, most] = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| {
                [a.min(x), b.max(x)]
            });
            most - least
        };
        let size = extent(0).max(extent(1));
        let adjoint: CsMat<f64> = rows.transpose_view().to_csr().map(|entry| 2.0 * entry);
        let unit = spacing * spacing;
        let narrow = |matrix: &CsMat<f64>| matrix.map(|entry| lanes::single(unit * entry));
        let mut operator = SparseOperator {
            single: Pair {
                rows: narrow(&rows),
                adjoint: narrow(&adjoint),
            },
            double: Pair { rows, adjoint },
            stencils: RowRuns::new(&all, LONGEST, |stencil| stencil),
            vertices,
            centres,
            about,
            places,
            spacing,
            size,
            norm: 1.0,
        };
        operator.norm = MARGIN * operator.power()?;
        Ok(operator)
    }

    /// An estimate of `h⁴‖CᵀC‖`, from below.
    fn power(&self) -> Result<f32> {
        let Pair { rows, adjoint } = &self.single;
        let mut x = try_filled("vertices", self.vertex_cells(), 0.0f32)?;
        let mut y = try_filled("stencils", 3 * self.centres.len(), 0.0f32)?;
        let mut random = oorandom::Rand32::new(1);
        for vertex in self.vertices.cells() {
            x[vertex] = random.rand_float() - 0.5;
        }
        let mut norm = 1.0;
        for _ in 0..POWER {
            let size = x.iter().map(|x| x * x).sum::<f32>().sqrt();
            x.iter_mut().for_each(|x| *x /= size);
            apply(rows, &x, &mut y);
            apply(adjoint, &y, &mut x);
            norm = x.iter().map(|x| x * x).sum::<f32>().sqrt();
        }
        Ok(norm)
    }

    /// `image = CᵀC x`, by way of three numbers for each stencil.
    fn normal(&self, x: &[f64], matrices: &mut [f64], image: &mut [f64]) {
        apply(&self.double.rows, x, matrices);
        apply(&self.double.adjoint, matrices, image);
    }

    /// The diagonal of `CᵀC`.
    fn normal_diagonal(&self) -> Result<Vec<f64>> {
        let mut diagonal = try_filled("diagonal", self.vertex_cells(), 0.0)?;
        let Pair { rows, .. } = &self.double;
        for (entry, vertex) in rows.data().iter().zip(rows.indices()) {
            diagonal[*vertex] += 2.0 * entry * entry;
        }
        Ok(diagonal)
    }
}

/// From rows `h_xx, h_xy, h_yy` to the coordinates of [`Sym2`].
fn by_coordinates(matrix: &CsMat<f64>) -> CsMat<f64> {
    let mut triplets = TriMat::with_capacity(matrix.shape(), 5 * matrix.nnz() / 3);
    for (entry, (row, vertex)) in matrix {
        let stencil = row - row % 3;
        let mut add =
            |k: usize, share: f64| triplets.add_triplet(stencil + k, vertex, share * entry);
        match row % 3 {
            1 => add(2, 1.0),
            entry => {
                add(0, 0.5);
                add(1, if entry == 0 { 0.5 } else { -0.5 });
            }
        }
    }
    triplets.to_csr()
}

/// One entry of a product.
fn dot<T: Real>(matrix: &CsMat<T>, row: usize, x: &[T]) -> T {
    let entries = matrix.outer_view(row);
    let entries = entries.iter().flat_map(|entries| entries.iter());
    entries.fold(T::default(), |sum, (column, entry)| {
        sum + *entry * x[column]
    })
}

fn apply<T: Real>(matrix: &CsMat<T>, x: &[T], image: &mut [T]) {
    for (row, image) in image.iter_mut().enumerate() {
        *image = dot(matrix, row, x);
    }
}

pub(crate) struct RunHessians<'a, T> {
    rows: &'a CsMat<T>,
    first: usize,
    heights: &'a [T],
}

impl<T: Real> Hessians<T> for RunHessians<'_, T> {
    fn at(&self, i: usize) -> [T; 3] {
        [0, 1, 2].map(|k| dot(self.rows, 3 * (self.first + i) + k, self.heights))
    }
}

pub(crate) struct RunMatrices<'a, T> {
    values: &'a mut [T],
}

impl<T: Real> Matrices<T> for RunMatrices<'_, T> {
    fn set(&mut self, i: usize, matrix: [T; 3]) {
        self.values[3 * i..][..3].copy_from_slice(&matrix);
    }
}

pub(crate) struct RunSums<'a, T> {
    adjoint: &'a CsMat<T>,
    first: usize,
    matrices: &'a [T],
}

impl<T: Real> Sums<T> for RunSums<'_, T> {
    fn at(&self, i: usize) -> T {
        dot(self.adjoint, self.first + i, self.matrices)
    }
}

impl Operator for SparseOperator {
    /// The matrices `Y`.
    type Scratch<T: Real> = Vec<T>;
    type Hessians<'a, T: Real> = RunHessians<'a, T>;
    type Matrices<'a, T: Real> = RunMatrices<'a, T>;
    type Sums<'a, T: Real> = RunSums<'a, T>;
    type Solver = JacobiGradients;

    fn vertices(&self) -> &RowRuns {
        &self.vertices
    }

    fn stencils(&self) -> &RowRuns {
        &self.stencils
    }

    fn vertex_cells(&self) -> usize {
        self.places.len()
    }

    fn stencil_cells(&self) -> usize {
        self.centres.len()
    }

    fn longest_run(&self) -> usize {
        LONGEST
    }

    fn spacing(&self) -> f64 {
        self.spacing
    }

    fn size(&self) -> f64 {
        self.size
    }

    fn norm(&self) -> f32 {
        self.norm
    }

    fn place(&self, vertex: usize) -> [f64; 2] {
        self.places[vertex]
    }

    fn scratch<T: Real>(&self) -> Result<Vec<T>> {
        try_filled("matrices", 3 * self.centres.len(), T::default())
    }

    fn hessians(&self, z: &[f64], mut visit: impl FnMut(usize, Sym2)) {
        let (start, end) = (0, self.centres.len());
        let hessians = self.double.hessians(Run { start, end }, z);
        for stencil in start..end {
            visit(stencil, Sym2::from_coordinates(hessians.at(stencil)));
        }
    }

    fn sweep<S: ?Sized>(
        &self,
        matrices: &mut Vec<f64>,
        z: &[f64],
        state: &mut S,
        mut at_stencils: impl FnMut(&mut S, Run, RunHessians<'_, f64>, RunMatrices<'_, f64>),
        mut at_vertices: impl FnMut(&mut S, Run, RunSums<'_, f64>),
    ) {
        let pair = &self.double;
        for run in self.stencils.all() {
            let values = &mut matrices[3 * run.start..3 * run.end];
            at_stencils(state, *run, pair.hessians(*run, z), RunMatrices { values });
        }
        for run in self.vertices.all() {
            at_vertices(state, *run, pair.sums(*run, matrices));
        }
    }

    fn sweep_back<S: ?Sized>(
        &self,
        matrices: &mut Vec<f32>,
        heights: &mut [f32],
        state: &mut S,
        mut at_stencils: impl FnMut(&mut S, Run, RunMatrices<'_, f32>),
        mut at_vertices: impl FnMut(&mut S, Run, RunSums<'_, f32>, &mut [f32]),
        mut follow: impl FnMut(&mut S, Run, RunHessians<'_, f32>),
    ) {
        let pair = &self.single;
        for run in self.stencils.all() {
            let values = &mut matrices[3 * run.start..3 * run.end];
            at_stencils(state, *run, RunMatrices { values });
        }
        for run in self.vertices.all() {
            at_vertices(
                state,
                *run,
                pair.sums(*run, matrices),
                &mut heights[run.start..run.end],
            );
        }
        for run in self.stencils.all() {
            follow(state, *run, pair.hessians(*run, heights));
        }
    }

    fn normals(&self, _: &[f64], to: &mut [f64]) {
        to.fill(1.0);
    }

    /// A stencil's neighbours are the vertices that it takes heights of.
    fn spread(&self, values: &mut [f64]) {
        let old = values.to_vec();
        let mut around = Vec::new();
        for (stencil, centre) in self.centres.iter().enumerate() {
            around.clear();
            let rows = (0..3).filter_map(|k| self.double.rows.outer_view(3 * stencil + k));
            around.extend(rows.flat_map(|row| row.indices().to_vec()));
            around.sort_unstable();
            around.dedup();
            let others = around.iter().filter(|vertex| *vertex != centre);
            let others = others.map(|vertex| self.about[*vertex]);
            let start = (2.0 * old[stencil], 2.0);
            let (sum, weight) = others
                .filter(|other| *other != NONE)
                .fold(start, |(sum, weight), other| {
                    (sum + old[other], weight + 1.0)
                });
            values[stencil] = sum / weight;
        }
    }
}
