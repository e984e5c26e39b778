//! Bands of consecutive rows of a domain's arrays, which threads work on side by side.
//!
//! A domain is divided by its number of vertices alone, never by the number of threads, and sums are added band by
//! band, so that results do not depend on the number of threads.

use super::runs::{RowRuns, Run};
use crate::math::fork::HAS_POOLS;

/// Number of active vertices in a band: large enough that handing a band to another thread costs little beside the work
/// on it, and few enough that the arrays of a band stay in a core's cache.
const BAND_VERTICES: usize = 4096;

/// Maximum number of bands of a domain.
const MAX_BANDS: usize = 32;

/// Minimum number of rows in a band: the values in the outermost row on each side follow after all bands' others.
const MIN_BAND_ROWS: usize = 8;

/// Division of the rows of a domain's arrays into bands of about equal numbers of vertices.
#[derive(Debug, Clone)]
pub(crate) struct Bands {
    /// First row of each band after the first band, which begins with the first row.
    starts: Vec<usize>,
    /// Number of cells in a row.
    stride: usize,
}

impl Bands {
    /// The division of arrays of any length into one band.
    pub(crate) const SINGLE: Bands = Bands {
        starts: Vec::new(),
        stride: 0,
    };

    /// Divides rows 1 to `rows` of arrays with rows of `stride` cells, where `active` are the runs of active vertices.
    /// Without threads there is one band, whose outermost rows need no second pass.
    pub(crate) fn new(active: &RowRuns, rows: usize, stride: usize) -> Self {
        if !HAS_POOLS {
            return Bands::SINGLE;
        }
        let most = MAX_BANDS.min(rows / MIN_BAND_ROWS).max(1);
        Bands::with_number(
            (active.len() / BAND_VERTICES).clamp(1, most),
            active,
            rows,
            stride,
        )
    }

    /// Divides rows into about a number of bands.
    pub(super) fn with_number(number: usize, active: &RowRuns, rows: usize, stride: usize) -> Self {
        let mut starts = Vec::new();
        let mut seen = 0;
        for row in 1..=rows {
            let last = starts.last().copied().unwrap_or(1);
            let is_full = seen * number >= active.len() * (starts.len() + 1);
            if is_full && row >= last + MIN_BAND_ROWS && row + MIN_BAND_ROWS <= rows + 1 {
                starts.push(row);
            }
            seen += active
                .rows(row..row + 1)
                .iter()
                .map(Run::len)
                .sum::<usize>();
        }
        Bands { starts, stride }
    }

    /// Number of bands.
    pub(crate) fn len(&self) -> usize {
        self.starts.len() + 1
    }

    /// Returns the rows of a band, of a domain with rows 1 to `rows`, without the rows of padding.
    pub(crate) fn rows(&self, band: usize, rows: usize) -> std::ops::Range<usize> {
        let start = band.checked_sub(1).map_or(1, |before| self.starts[before]);
        start..self.starts.get(band).copied().unwrap_or(rows + 1)
    }

    /// Returns the runs in a band.
    pub(crate) fn runs<'a>(&self, runs: &'a RowRuns, band: usize) -> &'a [Run] {
        let start = band.checked_sub(1).map_or(0, |before| self.starts[before]);
        let end = self.starts.get(band).copied();
        runs.rows(start..end.unwrap_or(runs.row_count()))
    }

    /// Splits an array into the slices of its bands, in their order.
    pub(crate) fn split<'a, T>(
        &'a self,
        mut rest: &'a mut [T],
    ) -> impl Iterator<Item = BandSlice<'a, T>> + 'a {
        let mut first = 0;
        (0..self.len()).map(move |band| {
            let all = std::mem::take(&mut rest);
            let end = self.starts.get(band).map(|row| row * self.stride);
            let (values, behind) = all.split_at_mut(end.map_or(all.len(), |end| end - first));
            rest = behind;
            let slice = BandSlice { first, values };
            first = end.unwrap_or(first);
            slice
        })
    }
}

/// The part of an array that belongs to one band; cells are given by their index in the whole array.
#[derive(Debug)]
pub(crate) struct BandSlice<'a, T> {
    /// Index of the first value in the whole array.
    first: usize,
    values: &'a mut [T],
}

impl<T> BandSlice<'_, T> {
    /// Returns the values of a run's cells, to be changed.
    #[inline(always)]
    pub(crate) fn run_mut(&mut self, run: Run) -> &mut [T] {
        &mut self.values[run.start - self.first..run.end - self.first]
    }

    /// Index of the band's first cell in the whole array.
    pub(crate) fn first(&self) -> usize {
        self.first
    }

    /// All values of the band.
    pub(crate) fn values(&mut self) -> &mut [T] {
        self.values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_is_in_one_band() {
        let stride = 7;
        for rows in [1usize, 7, 8, 15, 16, 17, 100, 333] {
            // Rows without vertices at the top and at the bottom, as of a domain with a wide hole.
            let is_active: Vec<bool> = (0..(rows + 2) * stride)
                .map(|cell| (3..=rows.max(9) - 5).contains(&(cell / stride)))
                .collect();
            let active = RowRuns::new(&is_active, stride, |is_active| is_active);
            for number in [1, 2, 3, 16, 32] {
                let bands = Bands::with_number(number, &active, rows, stride);
                assert!(bands.len() <= number);
                let all: Vec<usize> = (0..bands.len())
                    .flat_map(|band| bands.rows(band, rows))
                    .collect();
                assert!(all.into_iter().eq(1..=rows));
                for band in 0..bands.len() {
                    let height = bands.rows(band, rows).len();
                    assert!(bands.len() == 1 || height >= MIN_BAND_ROWS);
                }
                let runs = (0..bands.len()).flat_map(|band| bands.runs(&active, band));
                assert!(runs.eq(active.all()));
                let mut cells: Vec<usize> = (0..is_active.len()).collect();
                let mut next = 0;
                for mut slice in bands.split(&mut cells) {
                    assert_eq!(slice.first(), next);
                    let len = slice.values.len();
                    assert!(slice.values().iter().copied().eq(next..next + len));
                    next += len;
                }
                assert_eq!(next, is_active.len());
            }
        }
    }

    #[test]
    fn bands_have_about_as_many_vertices_each() {
        let stride = 502;
        let mut is_active = vec![true; 502 * stride];
        // The rows of padding.
        is_active[..stride].fill(false);
        is_active[501 * stride..].fill(false);
        let active = RowRuns::new(&is_active, stride, |is_active| is_active);
        let bands = Bands::new(&active, 500, stride);
        assert_eq!(bands.len(), 32);
        for band in 0..bands.len() {
            assert!((15..=17).contains(&bands.rows(band, 500).len()), "{band}");
        }
    }
}
