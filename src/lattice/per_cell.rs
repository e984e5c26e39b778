//! Values for each cell of a domain that are mostly the same for all cells.

use super::runs::Run;
use crate::error::{Result, try_filled};
use crate::math::lanes::narrow;

/// A value for each cell, or the same for all. Kernels get a slice for each run in both cases; a value that is
/// the same for all is one row that stays in the cache.
#[derive(Debug, Clone)]
pub(crate) enum PerCell<T> {
    /// The same value for all cells, repeated for the longest run.
    Same(Vec<T>),
    /// A value for each cell.
    Each(Vec<T>),
}

impl<T: Copy> PerCell<T> {
    /// The same value for all cells, in runs of up to `longest` cells.
    pub(crate) fn same(longest: usize, value: T) -> Self {
        PerCell::Same(vec![value; longest])
    }

    /// The values of a run.
    #[inline(always)]
    pub(crate) fn run(&self, run: Run) -> &[T] {
        let n = run.end - run.start;
        match self {
            PerCell::Same(values) => &values[..n],
            PerCell::Each(values) => &values[run.start..][..n],
        }
    }

    /// The value of a cell.
    pub(crate) fn at(&self, cell: usize) -> T {
        match self {
            PerCell::Same(values) => values[0],
            PerCell::Each(values) => values[cell],
        }
    }
}

impl PerCell<f64> {
    /// Writes the values to `to`, in single precision.
    ///
    /// # Errors
    /// Out of memory.
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
