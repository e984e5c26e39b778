//! Runs of consecutive cells of an array over a domain, which the kernels sweep over.

use std::ops::Range;

/// A run of consecutive cells (vertices) in one row of a domain's padded box: the indices from `start` to before `end`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Run {
    pub start: usize,
    pub end: usize,
}

impl Run {
    /// Number of cells in the run.
    pub(crate) fn len(&self) -> usize {
        self.end - self.start
    }
}

/// Runs of consecutive cells of a domain's padded box, sorted by row.
#[derive(Debug, Clone)]
pub(crate) struct RowRuns {
    /// Index of each row's first run in `runs`: the runs of `row` are `runs[first[row]..first[row + 1]]`.
    first: Vec<usize>,
    runs: Vec<Run>,
    len: usize,
}

impl RowRuns {
    /// Collects the runs of consecutive cells whose role `belongs`, of an array with rows of `stride` cells.
    pub(crate) fn new<R: Copy>(roles: &[R], stride: usize, belongs: impl Fn(R) -> bool) -> Self {
        let mut first = vec![0];
        let mut runs: Vec<Run> = Vec::new();
        for (row, cells) in roles.chunks(stride).enumerate() {
            let from = *first.last().unwrap_or(&0);
            for (col, role) in cells.iter().enumerate() {
                let cell = row * stride + col;
                if belongs(*role) {
                    match runs[from..].last_mut() {
                        Some(run) if run.end == cell => run.end += 1,
                        _ => runs.push(Run {
                            start: cell,
                            end: cell + 1,
                        }),
                    }
                }
            }
            first.push(runs.len());
        }
        let len = runs.iter().map(|run| run.end - run.start).sum();
        RowRuns { first, runs, len }
    }

    /// Number of cells in all runs together.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// Returns the runs of one row of the domain's padded box.
    pub(crate) fn row(&self, row: usize) -> &[Run] {
        self.rows(row..row + 1)
    }

    /// Returns the runs of consecutive rows of the domain's padded box.
    pub(crate) fn rows(&self, rows: Range<usize>) -> &[Run] {
        &self.runs[self.first[rows.start]..self.first[rows.end]]
    }

    /// Number of rows of the domain's padded box.
    pub(crate) fn row_count(&self) -> usize {
        self.first.len() - 1
    }

    /// Returns all runs, row by row.
    pub(crate) fn all(&self) -> &[Run] {
        &self.runs
    }

    /// Iterates over the indices of all cells in the runs, row by row.
    pub(crate) fn cells(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        self.runs.iter().flat_map(|run| run.start..run.end)
    }
}
