//! The linear operator `C` from heights to Hessians: its vertices and stencils, and the sweeps over them.
//!
//! Heights are arrays over the operator's vertices, Hessians and duals arrays over its stencils. Both may have
//! gaps; the runs tell which entries count.

pub(crate) mod lattice;
pub(crate) mod sparse;

use std::fmt::Debug;

use crate::error::Result;
use crate::lattice::bands::Bands;
use crate::lattice::runs::{RowRuns, Run};
use crate::math::real::Real;
use crate::math::sym2::Sym2;

/// A linear operator `C` from a height at each vertex to a symmetric 2×2 matrix (Hessian) at each stencil.
///
/// Kernels are closures that get one run of vertices or stencils at a time, with views of that run only, so that their
/// loops vectorise. A method that takes several closures calls each of them in one place, so that it is inlined. Bands
/// of runs are swept side by side on several threads: a kernel writes only to the state of the band that it is called
/// for.
pub(crate) trait Operator: Clone + Debug + Send + Sync + 'static {
    /// Work memory of a sweep in single or double precision.
    type Scratch<T: Real>: Clone + Debug + Send + Sync;
    /// View of the Hessians of one run of stencils.
    type Hessians<'a, T: Real>: Hessians<T>;
    /// View of the matrices `Y` of one run of stencils, to be written.
    type Matrices<'a, T: Real>: Matrices<T>;
    /// View of the values of `CᵀY` at one run of vertices.
    type Sums<'a, T: Real>: Sums<T>;

    /// Runs of the vertices, whose heights are the unknowns.
    fn vertices(&self) -> &RowRuns;
    /// Runs of the stencils, each of which has a Hessian.
    fn stencils(&self) -> &RowRuns;
    /// Bands of the arrays over vertices and stencils.
    fn bands(&self) -> &Bands;
    /// Length of an array over the vertices.
    fn vertex_cells(&self) -> usize;
    /// Length of an array over the stencils.
    fn stencil_cells(&self) -> usize;
    /// Length of the longest run of vertices or stencils.
    fn longest_run(&self) -> usize;

    /// Distance between neighbouring vertices, in normalised coordinates.
    fn spacing(&self) -> f64;
    /// Distance from one end of the domain to the other, in normalised coordinates.
    fn size(&self) -> f64;
    /// Upper bound of the norm `h⁴‖CᵀC‖`, where `h` is the spacing.
    fn norm(&self) -> f32;
    /// Weight of a stencil in sums over stencils, and in `Cᵀ`: its area, in units of the mean area.
    #[inline(always)]
    fn area(&self, _stencil: usize) -> f64 {
        1.0
    }
    /// Factor by which ADMM's penalty parameter ρ is multiplied at a stencil. With the stencil's area it is the weight of
    /// its term in `‖Cz − H‖²`, the squared distance of the Hessians `Cz` of the heights `z` from ADMM's matrices `H`.
    #[inline(always)]
    fn rho_share(&self, _stencil: usize) -> f64 {
        1.0
    }
    /// Returns the planar coordinates of a vertex; `C` vanishes on linear functions of them.
    fn place(&self, vertex: usize) -> [f64; 2];

    /// Allocates the work memory for sweeps in single or double precision.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    fn scratch<T: Real>(&self) -> Result<Self::Scratch<T>>;

    /// Calls `visit` with each stencil of a band and its Hessian `Cz`, in order.
    fn band_hessians(&self, band: usize, z: &[f64], visit: impl FnMut(usize, Sym2));

    /// Calls `visit` with each stencil and its Hessian `Cz`, in order.
    fn hessians(&self, z: &[f64], mut visit: impl FnMut(usize, Sym2)) {
        for band in 0..self.bands().len() {
            self.band_hessians(band, z, &mut visit);
        }
    }

    /// Computes `Cz` and `CᵀY` in one pass, with one of the `states` for each band: `at_stencils` gets the Hessians of
    /// each run of stencils and writes all of its `Y`; `at_vertices` gets each run of `CᵀY` as soon as it is complete,
    /// which may be before the last stencils are visited.
    fn sweep<S: Send>(
        &self,
        scratch: &mut Self::Scratch<f64>,
        z: &[f64],
        states: &mut [S],
        at_stencils: impl Fn(&mut S, Run, Self::Hessians<'_, f64>, Self::Matrices<'_, f64>) + Sync,
        at_vertices: impl Fn(&mut S, Run, Self::Sums<'_, f64>) + Sync,
    );

    /// Computes `CᵀY` and then `Cz` in one pass, in single precision and with `h²C` in the place of `C`: `at_stencils`
    /// writes `Y`, `at_vertices` turns `CᵀY` into heights, and `follow` gets the Hessians of these heights.
    fn sweep_back<S: Send>(
        &self,
        scratch: &mut Self::Scratch<f32>,
        heights: &mut [f32],
        states: &mut [S],
        at_stencils: impl Fn(&mut S, Run, Self::Matrices<'_, f32>) + Sync,
        at_vertices: impl Fn(&mut S, Run, Self::Sums<'_, f32>, &mut [f32]) + Sync,
        follow: impl Fn(&mut S, Run, Self::Hessians<'_, f32>) + Sync,
    );

    /// Writes to `to` the factor that turns the Hessian `Cz` into the second fundamental form at each stencil: for
    /// heights the upward component of the surface's unit normal (paper, Eq. 24), and 1 where `Cz` is that form
    /// already.
    fn normals(&self, z: &[f64], to: &mut [f64]);

    /// Averages each stencil's value (weight 2) with the values at its neighbours (weight 1), in place.
    fn spread(&self, values: &mut [f64]);
}

/// Read access to the Hessians (symmetric 2×2 matrices of second differences of the heights) at consecutive stencils, each
/// of which is a vertex with its six neighbours.
pub(crate) trait Hessians<T> {
    /// Returns the `i`-th Hessian of the run, by the coordinates of [`Sym2`].
    fn at(&self, i: usize) -> [T; 3];
}

/// Write access to the dual matrices `Y` (symmetric, 2×2) at consecutive stencils.
pub(crate) trait Matrices<T> {
    /// Writes the `i`-th matrix of the run, by the coordinates of [`Sym2`].
    fn set(&mut self, i: usize, matrix: [T; 3]);
}

/// Read access to the values of `CᵀY`, the adjoint of the Hessian operator applied to the dual, at consecutive vertices.
pub(crate) trait Sums<T> {
    /// Returns the value at the `i`-th vertex of the run.
    fn at(&self, i: usize) -> T;
}
