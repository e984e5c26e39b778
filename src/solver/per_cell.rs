//! A number for each cell, which mostly is the same for all.

use crate::domain::{Domain, Run};

/// Kernels see a slice for each run either way; where all cells have the same
/// value it is one row that stays in the cache.
#[derive(Debug, Clone)]
pub(crate) enum PerCell<T> {
    /// One row of the value.
    Same(Vec<T>),
    /// The padded box.
    Each(Vec<T>),
}

impl<T: Copy> PerCell<T> {
    pub(crate) fn same(domain: &Domain, value: T) -> Self {
        PerCell::Same(vec![value; domain.stride()])
    }

    /// The values of `run` in `row`.
    #[inline(always)]
    pub(crate) fn run(&self, domain: &Domain, row: usize, run: Run) -> &[T] {
        let n = run.end - run.start;
        match self {
            PerCell::Same(values) => &values[run.start - row * domain.stride()..][..n],
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
