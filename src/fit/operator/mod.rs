//! The operator `C` from heights to Hessians, as the energy and ADMM see it: which vertices and
//! stencils there are, and the two sweeps over them.
//!
//! Heights are arrays over the operator's vertices, Hessians and duals over its stencils. Both may
//! have gaps: what counts are the runs.

pub(crate) mod lattice;
pub(crate) mod sparse;

use std::fmt::Debug;

use crate::error::Result;
use crate::lattice::runs::{RowRuns, Run};
use crate::math::real::Real;
use crate::math::sym2::Sym2;

/// A linear operator `C` from a height at each vertex to a symmetric 2×2 matrix at each stencil.
///
/// Kernels are closures that get one run at a time, with views of that run only, so that their loops
/// vectorise. A method that takes several calls each of them in one place, so that it is inlined.
pub(crate) trait Operator: Clone + Debug + 'static {
    /// What a sweep works with.
    type Scratch<T: Real>: Clone + Debug;
    type Hessians<'a, T: Real>: Hessians<T>;
    type Matrices<'a, T: Real>: Matrices<T>;
    type Sums<'a, T: Real>: Sums<T>;

    /// The unknowns.
    fn vertices(&self) -> &RowRuns;
    /// Where Hessians are.
    fn stencils(&self) -> &RowRuns;
    /// Length of an array over the vertices.
    fn vertex_cells(&self) -> usize;
    /// Length of an array over the stencils.
    fn stencil_cells(&self) -> usize;
    /// No run is longer.
    fn longest_run(&self) -> usize;

    /// From a vertex to the next, in normalised coordinates, and from one end to the other.
    fn spacing(&self) -> f64;
    fn size(&self) -> f64;
    /// At least `h⁴‖CᵀC‖`, `h` being the spacing.
    fn norm(&self) -> f32;
    /// What a stencil counts in sums over stencils, and in `Cᵀ`: its area, in units of their mean.
    #[inline(always)]
    fn area(&self, _stencil: usize) -> f64 {
        1.0
    }
    /// What a stencil counts in `‖Cz − H‖²`, besides its area: its share of ρ.
    #[inline(always)]
    fn rho_share(&self, _stencil: usize) -> f64 {
        1.0
    }
    /// The coordinates of a vertex, whose linear functions `C` does not see.
    fn place(&self, vertex: usize) -> [f64; 2];

    /// For sweeps in one precision.
    ///
    /// # Errors
    /// Out of memory.
    fn scratch<T: Real>(&self) -> Result<Self::Scratch<T>>;

    /// Calls `visit` with each stencil and `Cz` there, in order.
    fn hessians(&self, z: &[f64], visit: impl FnMut(usize, Sym2));

    /// One pass over `Cz` and `CᵀY`: `at_stencils` gets each run's Hessians and must write its `Y`
    /// everywhere, `at_vertices` gets each run of `CᵀY` as soon as it is complete, which may be before
    /// the last stencils have had their turn.
    fn sweep<S: ?Sized>(
        &self,
        scratch: &mut Self::Scratch<f64>,
        z: &[f64],
        state: &mut S,
        at_stencils: impl FnMut(&mut S, Run, Self::Hessians<'_, f64>, Self::Matrices<'_, f64>),
        at_vertices: impl FnMut(&mut S, Run, Self::Sums<'_, f64>),
    );

    /// The same the other way round, in single precision and with `h²C` in the place of `C`:
    /// `at_stencils` writes `Y`, `at_vertices` turns `CᵀY` into heights, and `follow` gets the Hessians
    /// of these.
    fn sweep_back<S: ?Sized>(
        &self,
        scratch: &mut Self::Scratch<f32>,
        heights: &mut [f32],
        state: &mut S,
        at_stencils: impl FnMut(&mut S, Run, Self::Matrices<'_, f32>),
        at_vertices: impl FnMut(&mut S, Run, Self::Sums<'_, f32>, &mut [f32]),
        follow: impl FnMut(&mut S, Run, Self::Hessians<'_, f32>),
    );

    /// What turns `Cz` into the second fundamental form, at each stencil: the upward part of the
    /// surface's unit normal for heights (paper, Eq. 24), 1 for what is that form already.
    fn normals(&self, z: &[f64], to: &mut [f64]);

    /// The mean over each stencil (weight 2) and those at its neighbours (weight 1).
    fn spread(&self, values: &mut [f64]);
}

/// The Hessians of one run, by the coordinates of [`Sym2`].
pub(crate) trait Hessians<T> {
    fn at(&self, i: usize) -> [T; 3];
}

/// The matrices `Y` of one run, likewise.
pub(crate) trait Matrices<T> {
    fn set(&mut self, i: usize, matrix: [T; 3]);
}

/// `CᵀY` of one run.
pub(crate) trait Sums<T> {
    fn at(&self, i: usize) -> T;
}
