//! Values for each vertex of a domain, stored once where all are alike.

use super::runs::Run;
use crate::error::{Result, try_filled};
use crate::math::lanes::narrow;

/// A value for each cell of a domain's arrays, stored once if all are alike. Kernels get a slice for each run of cells
/// in both cases; a value that all share is one row that stays in the cache.
#[derive(Debug, Clone)]
pub(crate) enum PerCell<T> {
    /// One value that all cells share, repeated so often that the longest run of cells gets a slice of it.
    Same(Vec<T>),
    /// A value for each cell of the domain's arrays.
    Each(Vec<T>),
}

impl<T: Copy> PerCell<T> {
    /// Makes a value that all cells share, for runs of up to `longest` cells.
    pub(crate) fn same(longest: usize, value: T) -> Self {
        PerCell::Same(vec![value; longest])
    }

    /// Returns the values at a run of consecutive cells, as a slice of the run's length.
    #[inline(always)]
    pub(crate) fn run(&self, run: Run) -> &[T] {
        let n = run.end - run.start;
        match self {
            PerCell::Same(values) => &values[..n],
            PerCell::Each(values) => &values[run.start..][..n],
        }
    }

    /// Returns the value of a cell, given by its index in the domain's arrays.
    pub(crate) fn at(&self, cell: usize) -> T {
        match self {
            PerCell::Same(values) => values[0],
            PerCell::Each(values) => values[cell],
        }
    }
}

impl PerCell<f64> {
    /// Copies the values in single precision to `to`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn narrow_into(&self, to: &mut PerCell<f32>) -> Result<()> {
        match (self, &mut *to) {
            (PerCell::Each(from), PerCell::Each(to)) => narrow(from, to),
            (PerCell::Each(from), PerCell::Same(_)) => {
                let mut each = try_filled("weights", from.len(), 0.0)?;
                narrow(from, &mut each);
                *to = PerCell::Each(each);
            }
            (PerCell::Same(from), _) => *to = PerCell::same(from.len(), from[0] as f32),
        }
        Ok(())
    }
}
