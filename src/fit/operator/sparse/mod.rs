//! The operator `C` as a sparse matrix, for meshes and other domains that are no lattice.

pub(crate) mod gradients;
pub(crate) mod matrix;
#[cfg(all(test, not(target_arch = "wasm32")))] // clarabel is native
mod tests;
pub(crate) mod v_cycle;

use std::sync::Arc;

use self::matrix::SparseMatrix;
use super::{Hessians, Matrices, Operator, Sums};
use crate::error::{Result, try_filled};
use crate::lattice::bands::Bands;
use crate::lattice::runs::{RowRuns, Run};
use crate::math::lanes;
use crate::math::real::Real;
use crate::math::sym2::Sym2;

/// Maximum length of a run of vertices or stencils, so that what kernels store for one run stays in the cache.
const MAX_RUN_LENGTH: usize = 256;

/// Number of power iterations that estimate the operator's norm. Only the speed of dual ascent depends on their
/// accuracy, not the validity of its dual bound; with fewer the estimate is not an upper bound on a lattice.
const POWER_ITERATIONS: usize = 8;
/// Factor that turns the power iterations' lower estimate of the operator's norm into an upper bound.
const NORM_ESTIMATE_MARGIN: f32 = 1.1;

/// Number of entries of a matrix row that are computed together: the numbers in a SIMD vector of single precision.
const ROW_GROUP_ENTRIES: usize = 4;

/// Rows of the sparse operator `C`: for each stencil its vertices, with the factors of their heights in the coordinates
/// of [`Sym2`]. Entries are stored in groups, filled up with zeros.
///
/// The adjoint is computed from the same rows, by adding to the vertices of one stencil after the other: this halves
/// the memory, and `CᵀC` takes one pass.
#[derive(Debug, Clone)]
pub(crate) struct Rows<T> {
    /// Index of each row's first group of entries.
    first: Vec<u32>,
    fours: Vec<EntryGroup<T>>,
}

/// Group of entries of a matrix row that are computed together.
#[derive(Debug, Clone)]
struct EntryGroup<T> {
    vertices: [u32; ROW_GROUP_ENTRIES],
    entries: [[T; ROW_GROUP_ENTRIES]; 3],
}

impl<T: Real> Rows<T> {
    /// Makes a matrix without rows.
    pub(crate) fn new() -> Self {
        Rows {
            first: vec![0],
            fours: Vec::new(),
        }
    }

    /// Reserves memory for the rows of a number of stencils with a number of vertices each.
    pub(crate) fn reserve(&mut self, stencils: usize, vertices: usize) {
        self.first.reserve(stencils);
        self.fours
            .reserve(stencils * vertices.div_ceil(ROW_GROUP_ENTRIES));
    }

    /// Appends the row of one more stencil: its vertices, each with the factors of its height in the Hessian's
    /// coordinates.
    pub(crate) fn push(&mut self, entries: impl IntoIterator<Item = (u32, [T; 3])>) {
        let mut lane = ROW_GROUP_ENTRIES;
        for (vertex, entry) in entries {
            if lane == ROW_GROUP_ENTRIES {
                lane = 0;
                self.fours.push(EntryGroup {
                    vertices: [vertex; ROW_GROUP_ENTRIES],
                    entries: [[T::default(); ROW_GROUP_ENTRIES]; 3],
                });
            }
            if let Some(four) = self.fours.last_mut() {
                four.vertices[lane] = vertex;
                for (row, entry) in four.entries.iter_mut().zip(entry) {
                    row[lane] = entry;
                }
            }
            lane += 1;
        }
        self.first.push(self.fours.len() as u32);
    }

    /// Multiplies each column of the matrix by a factor that depends on its vertex.
    pub(crate) fn scale_columns(&mut self, factor: impl Fn(u32) -> T) {
        for EntryGroup { vertices, entries } in &mut self.fours {
            for lane in 0..ROW_GROUP_ENTRIES {
                let factor = factor(vertices[lane]);
                for row in entries.iter_mut() {
                    row[lane] = factor * row[lane];
                }
            }
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.first.len() - 1
    }

    /// Iterates over the vertices of all rows' entries, with repetitions.
    fn vertices(&self) -> impl Iterator<Item = u32> + '_ {
        self.fours.iter().flat_map(|four| four.vertices)
    }

    /// Returns the groups of entries of a stencil's row.
    #[inline(always)]
    fn row(&self, stencil: usize) -> &[EntryGroup<T>] {
        &self.fours[self.first[stencil] as usize..self.first[stencil + 1] as usize]
    }

    /// Returns the Hessian `Cx` at a stencil, by the coordinates of [`Sym2`].
    #[inline(always)]
    fn apply(&self, stencil: usize, x: &[T]) -> [T; 3] {
        let zero = T::four([T::default(); ROW_GROUP_ENTRIES]);
        let (mut mean, mut diff, mut off) = (zero, zero, zero);
        for EntryGroup { vertices, entries } in self.row(stencil) {
            let [v0, v1, v2, v3] = *vertices;
            let x = [
                x[v0 as usize],
                x[v1 as usize],
                x[v2 as usize],
                x[v3 as usize],
            ];
            let x = T::four(x);
            let [a, b, c] = entries;
            mean = mean + T::four(*a) * x;
            diff = diff + T::four(*b) * x;
            off = off + T::four(*c) * x;
        }
        [
            sum_of_lanes::<T>(mean),
            sum_of_lanes::<T>(diff),
            sum_of_lanes::<T>(off),
        ]
    }

    /// Adds the adjoint `Cᵀ` of the matrix at one stencil, which includes the stencil's weight, to the heights `to`.
    #[inline(always)]
    fn add_adjoint(&self, stencil: usize, [mean, diff, off]: [T; 3], to: &mut [T]) {
        let mean = T::four([mean; ROW_GROUP_ENTRIES]);
        let diff = T::four([diff; ROW_GROUP_ENTRIES]);
        let off = T::four([off; ROW_GROUP_ENTRIES]);
        for EntryGroup { vertices, entries } in self.row(stencil) {
            let [a, b, c] = entries;
            let more = T::four(*a) * mean + T::four(*b) * diff + T::four(*c) * off;
            let [v0, v1, v2, v3] = *vertices;
            let [v0, v1, v2, v3] = [v0 as usize, v1 as usize, v2 as usize, v3 as usize];
            let [m0, m1, m2, m3] = T::lanes(more);
            to[v0] = to[v0] + m0;
            to[v1] = to[v1] + m1;
            to[v2] = to[v2] + m2;
            to[v3] = to[v3] + m3;
        }
    }
}

/// Returns the sum of the numbers in a SIMD vector.
#[inline(always)]
fn sum_of_lanes<T: Real>(four: T::Four) -> T {
    let [a, b, c, d] = T::lanes(four);
    (a + b) + (c + d)
}

/// The components that a [`SparseOperator`] is made of.
#[derive(Debug, Clone)]
pub(crate) struct SparseOperatorParts {
    pub rows: Rows<f64>,
    /// Area of each stencil, its weight in every sum over stencils; empty if each is 1.
    pub areas: Vec<f64>,
    /// Indices of the neighbouring stencils of each stencil.
    pub beside: SparseMatrix<()>,
    /// Vertex whose height is constant and so makes `C` affine; its column does not count for the operator's norm.
    pub constant: Option<u32>,
    pub places: Vec<[f64; 2]>,
    pub spacing: f64,
    /// Distance from one end of the domain to the other, in the unit of the places.
    pub size: f64,
}

/// Operator `C` from heights to Hessians that is given as a sparse matrix.
#[derive(Debug, Clone)]
pub(crate) struct SparseOperator {
    double: Arc<Rows<f64>>,
    /// Rows of `h²C` in single precision, where `h` is the spacing.
    single: Arc<Rows<f32>>,
    /// Twice the area of each stencil, its weight in inner products: the coordinates of a matrix count twice in its
    /// Frobenius product.
    weights: Vec<f64>,
    single_weights: Vec<f32>,
    /// Factor by which ADMM's ρ is multiplied at each stencil.
    rho_shares: Vec<f64>,
    /// Weight of each stencil times its factor of ρ.
    rho_weights: Vec<f64>,
    single_rho_weights: Vec<f32>,
    vertices: RowRuns,
    stencils: RowRuns,
    beside: Arc<SparseMatrix<()>>,
    places: Vec<[f64; 2]>,
    spacing: f64,
    size: f64,
    norm: f32,
}

impl SparseOperator {
    /// Makes the operator of given rows, whose values are taken for second fundamental forms. Vertices that no row has
    /// are no unknowns.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn new(parts: SparseOperatorParts) -> Result<Self> {
        let SparseOperatorParts {
            rows,
            areas,
            beside,
            constant,
            places,
            spacing,
            size,
        } = parts;
        let mut touched = try_filled("vertices", places.len(), false)?;
        for vertex in rows.vertices() {
            touched[vertex as usize] = true;
        }
        let all = try_filled("stencils", rows.len(), true)?;
        let weights: Vec<f64> = if areas.is_empty() {
            try_filled("areas", rows.len(), 2.0)?
        } else {
            areas.iter().map(|area| 2.0 * area).collect()
        };
        let unit = spacing * spacing;
        let narrow = |four: &EntryGroup<f64>| {
            let scaled = four.entries.map(|row| row.map(|entry| unit * entry));
            let mut entries = [[0.0; ROW_GROUP_ENTRIES]; 3];
            lanes::narrow(scaled.as_flattened(), entries.as_flattened_mut());
            EntryGroup {
                vertices: four.vertices,
                entries,
            }
        };
        let mut single_weights = try_filled("areas", rows.len(), 0.0)?;
        lanes::narrow(&weights, &mut single_weights);
        let mut operator = SparseOperator {
            single: Arc::new(Rows {
                first: rows.first.clone(),
                fours: rows.fours.iter().map(narrow).collect(),
            }),
            rho_shares: try_filled("rho_shares", rows.len(), 1.0)?,
            rho_weights: weights.clone(),
            single_rho_weights: single_weights.clone(),
            double: Arc::new(rows),
            single_weights,
            weights,
            stencils: RowRuns::new(&all, MAX_RUN_LENGTH, |stencil| stencil),
            vertices: RowRuns::new(&touched, MAX_RUN_LENGTH, |touched| touched),
            beside: Arc::new(beside),
            places,
            spacing,
            size,
            norm: 1.0,
        };
        operator.norm = NORM_ESTIMATE_MARGIN * operator.power(constant)?;
        Ok(operator)
    }

    /// Estimates the norm `h⁴‖CᵀC‖` from below by power iterations; the height of the vertex `constant` does not count.
    fn power(&self, constant: Option<u32>) -> Result<f32> {
        let mut x = try_filled("vertices", self.vertex_cells(), 0.0f32)?;
        let mut image = x.clone();
        let mut random = oorandom::Rand32::new(1);
        for vertex in self.vertices.cells() {
            x[vertex] = random.rand_float() - 0.5;
        }
        let mut norm = 1.0;
        for _ in 0..POWER_ITERATIONS {
            if let Some(constant) = constant {
                x[constant as usize] = 0.0;
            }
            let size = x.iter().map(|x| x * x).sum::<f32>().sqrt();
            x.iter_mut().for_each(|x| *x /= size);
            normal(&self.single, &self.single_weights, &x, &mut image);
            std::mem::swap(&mut x, &mut image);
            norm = x.iter().map(|x| x * x).sum::<f32>().sqrt();
        }
        Ok(norm)
    }

    /// Sets the factor by which ρ is multiplied at each stencil.
    pub(crate) fn set_rho_shares(&mut self, share: impl Fn(usize) -> f64) {
        for stencil in 0..self.weights.len() {
            let rho_share = share(stencil);
            self.rho_shares[stencil] = rho_share;
            self.rho_weights[stencil] = rho_share * self.weights[stencil];
            self.single_rho_weights[stencil] = lanes::single(self.rho_weights[stencil]);
        }
    }

    /// Adds to `bound` a diagonal matrix that is an upper bound of `CᵀC` in single precision, with the stencils weighted by
    /// their factors of ρ: `(Σ c x)² ≤ Σ|c| Σ|c| x²` for every row of `C`.
    fn bound_normal(&self, bound: &mut [f32]) {
        for (stencil, weight) in self.single_rho_weights.iter().enumerate() {
            let row = self.single.row(stencil);
            let mut totals = [0.0; 3];
            for EntryGroup { entries, .. } in row {
                for (total, entries) in totals.iter_mut().zip(entries) {
                    *total += entries.iter().map(|entry| entry.abs()).sum::<f32>();
                }
            }
            for EntryGroup { vertices, entries } in row {
                for (lane, vertex) in vertices.iter().enumerate() {
                    let terms = entries.iter().zip(totals);
                    let sum: f32 = terms.map(|(row, total)| row[lane].abs() * total).sum();
                    bound[*vertex as usize] += weight * sum;
                }
            }
        }
    }

    /// Returns the diagonal of `CᵀC`, with the stencils weighted by their factors of ρ.
    fn normal_diagonal(&self) -> Result<Vec<f64>> {
        let mut diagonal = try_filled("diagonal", self.vertex_cells(), 0.0)?;
        for (stencil, weight) in self.rho_weights.iter().enumerate() {
            for EntryGroup { vertices, entries } in self.double.row(stencil) {
                for (lane, vertex) in vertices.iter().enumerate() {
                    let squares = entries.iter().map(|row| row[lane] * row[lane]);
                    diagonal[*vertex as usize] += weight * squares.sum::<f64>();
                }
            }
        }
        Ok(diagonal)
    }
}

/// Computes `image = CᵀC x` for an operator's rows and its stencils' weights.
fn normal<T: Real>(rows: &Rows<T>, weights: &[T], x: &[T], image: &mut [T]) {
    image.fill(T::default());
    for (stencil, weight) in weights.iter().enumerate() {
        let [a, b, c] = rows.apply(stencil, x);
        rows.add_adjoint(stencil, [*weight * a, *weight * b, *weight * c], image);
    }
}

pub(crate) struct RunHessians<'a, T> {
    rows: &'a Rows<T>,
    first: usize,
    heights: &'a [T],
}

impl<T: Real> Hessians<T> for RunHessians<'_, T> {
    #[inline(always)]
    fn at(&self, i: usize) -> [T; 3] {
        self.rows.apply(self.first + i, self.heights)
    }
}

pub(crate) struct RunMatrices<'a, T> {
    weights: &'a [T],
    rows: &'a Rows<T>,
    first: usize,
    sums: &'a mut [T],
}

impl<T: Real> Matrices<T> for RunMatrices<'_, T> {
    #[inline(always)]
    fn set(&mut self, i: usize, matrix: [T; 3]) {
        let ([a, b, c], weight) = (matrix, self.weights[i]);
        let matrix = [weight * a, weight * b, weight * c];
        self.rows.add_adjoint(self.first + i, matrix, self.sums);
    }
}

pub(crate) struct RunSums<'a, T> {
    sums: &'a [T],
}

impl<T: Real> Sums<T> for RunSums<'_, T> {
    #[inline(always)]
    fn at(&self, i: usize) -> T {
        self.sums[i]
    }
}

impl Operator for SparseOperator {
    /// Values of `CᵀY` at all vertices.
    type Scratch<T: Real> = Vec<T>;
    type Hessians<'a, T: Real> = RunHessians<'a, T>;
    type Matrices<'a, T: Real> = RunMatrices<'a, T>;
    type Sums<'a, T: Real> = RunSums<'a, T>;

    fn vertices(&self) -> &RowRuns {
        &self.vertices
    }

    fn stencils(&self) -> &RowRuns {
        &self.stencils
    }

    fn bands(&self) -> &Bands {
        static ONE: Bands = Bands::SINGLE;
        &ONE
    }

    fn vertex_cells(&self) -> usize {
        self.places.len()
    }

    fn stencil_cells(&self) -> usize {
        self.double.len()
    }

    fn longest_run(&self) -> usize {
        MAX_RUN_LENGTH
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

    #[inline(always)]
    fn area(&self, stencil: usize) -> f64 {
        0.5 * self.weights[stencil]
    }

    #[inline(always)]
    fn rho_share(&self, stencil: usize) -> f64 {
        self.rho_shares[stencil]
    }

    fn place(&self, vertex: usize) -> [f64; 2] {
        self.places[vertex]
    }

    fn scratch<T: Real>(&self) -> Result<Vec<T>> {
        try_filled("matrices", self.vertex_cells(), T::default())
    }

    fn band_hessians(&self, _: usize, z: &[f64], mut visit: impl FnMut(usize, Sym2)) {
        for stencil in 0..self.stencil_cells() {
            visit(
                stencil,
                Sym2::from_coordinates(self.double.apply(stencil, z)),
            );
        }
    }

    #[inline(always)]
    fn sweep<S: Send>(
        &self,
        sums: &mut Vec<f64>,
        z: &[f64],
        states: &mut [S],
        at_stencils: impl Fn(&mut S, Run, RunHessians<'_, f64>, RunMatrices<'_, f64>) + Sync,
        at_vertices: impl Fn(&mut S, Run, RunSums<'_, f64>) + Sync,
    ) {
        let [state] = states else { return };
        let (rows, heights) = (&self.double, z);
        sums.fill(0.0);
        for run in self.stencils.all() {
            let Run { start: first, end } = *run;
            let hessians = RunHessians {
                rows,
                first,
                heights,
            };
            let matrices = RunMatrices {
                weights: &self.weights[first..end],
                rows,
                first,
                sums,
            };
            at_stencils(state, *run, hessians, matrices);
        }
        for run in self.vertices.all() {
            let sums = &sums[run.start..run.end];
            at_vertices(state, *run, RunSums { sums });
        }
    }

    #[inline(always)]
    fn sweep_back<S: Send>(
        &self,
        sums: &mut Vec<f32>,
        heights: &mut [f32],
        states: &mut [S],
        at_stencils: impl Fn(&mut S, Run, RunMatrices<'_, f32>) + Sync,
        at_vertices: impl Fn(&mut S, Run, RunSums<'_, f32>, &mut [f32]) + Sync,
        follow: impl Fn(&mut S, Run, RunHessians<'_, f32>) + Sync,
    ) {
        let [state] = states else { return };
        let rows = &self.single;
        sums.fill(0.0);
        for run in self.stencils.all() {
            let Run { start: first, end } = *run;
            let matrices = RunMatrices {
                weights: &self.single_weights[first..end],
                rows,
                first,
                sums,
            };
            at_stencils(state, *run, matrices);
        }
        for run in self.vertices.all() {
            let sums = &sums[run.start..run.end];
            at_vertices(
                state,
                *run,
                RunSums { sums },
                &mut heights[run.start..run.end],
            );
        }
        for run in self.stencils.all() {
            let first = run.start;
            let hessians = RunHessians {
                rows,
                first,
                heights,
            };
            follow(state, *run, hessians);
        }
    }

    fn normals(&self, _: &[f64], to: &mut [f64]) {
        to.fill(1.0);
    }

    fn spread(&self, values: &mut [f64]) {
        let old = values.to_vec();
        for stencil in 0..self.beside.rows() {
            let start = (2.0 * old[stencil], 2.0);
            let beside = self.beside.row(stencil).iter();
            let (sum, weight) = beside.fold(start, |(sum, weight), (other, ())| {
                (sum + old[*other as usize], weight + 1.0)
            });
            values[stencil] = sum / weight;
        }
    }
}
