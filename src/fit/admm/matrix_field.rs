//! Symmetric 2×2 matrices at the stencils of an operator, one array for each coordinate of [`Sym2`].

use crate::error::{Result, try_filled};
use crate::lattice::bands::{BandSlice, Bands};
use crate::lattice::runs::Run;
use crate::math::sym2::Sym2;

/// A symmetric 2×2 matrix for each stencil.
#[derive(Debug, Clone)]
pub(crate) struct MatrixField<T>(pub(super) [Vec<T>; 3]);

/// The part of a [`MatrixField`] that belongs to one band of stencils.
pub(crate) struct MatrixBand<'a, T>([BandSlice<'a, T>; 3]);

/// The part of a [`MatrixField`] that belongs to one run of stencils.
pub(crate) struct MatrixRun<'a, T>(pub(super) [&'a mut [T]; 3]);

impl<T: Copy + Default> MatrixField<T> {
    /// Makes a field of zero matrices.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(stencils: usize) -> Result<Self> {
        let zeros = || try_filled("Hessians and dual", stencils, T::default());
        Ok(MatrixField([zeros()?, zeros()?, zeros()?]))
    }

    /// Splits the field into the parts of its bands.
    pub(crate) fn split<'a>(
        &'a mut self,
        bands: &'a Bands,
    ) -> impl Iterator<Item = MatrixBand<'a, T>> + 'a {
        let [mean, diff, off] = self.0.each_mut().map(|values| bands.split(values));
        let all = mean.zip(diff.zip(off));
        all.map(|(mean, (diff, off))| MatrixBand([mean, diff, off]))
    }
}

impl MatrixField<f64> {
    pub(crate) fn get(&self, stencil: usize) -> Sym2 {
        Sym2::from_coordinates(self.0.each_ref().map(|values| values[stencil]))
    }

    pub(crate) fn set(&mut self, stencil: usize, value: Sym2) {
        for (values, coordinate) in self.0.iter_mut().zip(value.coordinates()) {
            values[stencil] = coordinate;
        }
    }
}

impl<T> MatrixBand<'_, T> {
    #[inline(always)]
    pub(crate) fn run(&mut self, run: Run) -> MatrixRun<'_, T> {
        MatrixRun(self.0.each_mut().map(|values| values.run_mut(run)))
    }
}

impl MatrixRun<'_, f64> {
    #[inline(always)]
    pub(super) fn get(&self, i: usize) -> Sym2 {
        let [mean, diff, off] = &self.0;
        Sym2::from_coordinates([mean[i], diff[i], off[i]])
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, i: usize, value: Sym2) {
        let [mean, diff, off] = &mut self.0;
        [mean[i], diff[i], off[i]] = value.coordinates();
    }
}
