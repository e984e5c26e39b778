//! A number for each cell, which mostly is the same for all.

use super::runs::Run;
use crate::error::{Result, try_filled};
use crate::math::lanes::narrow;

/// Kernels see a slice for each run either way; where all cells have the same
/// value it is one row that stays in the cache.
#[derive(Debug, Clone)]
pub(crate) enum PerCell<T> {
    /// As many as in the longest run.
    Same(Vec<T>),
    /// All cells.
    Each(Vec<T>),
}

impl<T: Copy> PerCell<T> {
    /// For runs of up to `longest` cells.
    pub(crate) fn same(longest: usize, value: T) -> Self {
        PerCell::Same(vec![value; longest])
    }

    /// The values of `run`.
    #[inline(always)]
    pub(crate) fn run(&self, run: Run) -> &[T] {
        let n = run.end - run.start;
        match self {
            PerCell::Same(values) => &values[..n],
            PerCell::Each(values) => &values[run.start..][..n],
        }
    }

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
