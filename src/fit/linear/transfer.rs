//! Transfer of multigrid corrections between a lattice and the one of twice the spacing.
//!
//! Prolongation is Loop's subdivision, `P = A L`: linear interpolation `L` from the coarse vertices, then the average
//! `A` of each vertex (weight 2) with its neighbours (weight 1). Linear interpolation alone fails for a fourth-order
//! operator, because its kinks cost more energy than the correction saves. [`border`](super::border) has both at the
//! border.

use super::border::{Averages, Extension};
use crate::lattice::bands::BandSlice;
use crate::lattice::domain::Domain;
use crate::lattice::runs::Run;
use crate::lattice::stencil::Ring;
use crate::math::fork;

/// Transfer of corrections (prolongation) and residuals (restriction) between a lattice and the one of twice the
/// spacing.
#[derive(Debug, Clone)]
pub(crate) struct Transfer {
    averages: Averages,
    extension: Extension,
    /// Row of the fine domain's padded box that coarse row 0 falls on.
    row: isize,
    col: [isize; 2],
}

impl Transfer {
    pub(crate) fn new(fine: &Domain, coarse: &Domain) -> Self {
        // Box row 1 and column 1 are the corner; coarse vertex (r, c) is fine (2r, 2c − (r odd)).
        let (frow, fcol) = fine.corner();
        let (crow, ccol) = coarse.corner();
        let first = |coarse: usize, fine: usize| 2 * (coarse as isize - 1) - fine as isize + 1;
        let (averages, extension) =
            fork::join(|| Averages::new(fine), || Extension::new(fine, coarse));
        Transfer {
            averages,
            extension,
            row: first(crow, frow),
            col: [first(ccol, fcol), first(ccol, fcol) - 1],
        }
    }

    /// Restricts a residual: writes `scale · Pᵀ from`, with the prolongation `P`, to the coarse `to`; `work` is zero
    /// outside the fine domain and stays so.
    pub(crate) fn restrict(
        &self,
        (fine, from, work): (&Domain, &[f32], &mut [f32]),
        (coarse, to): (&Domain, &mut [f32]),
        scale: f32,
    ) {
        self.average(fine, from, work, |to, average| *to = average);
        self.averages.complete_transposed(fine, from, work);
        let bands = coarse.bands();
        let mut states: Vec<_> = bands.split(to).collect();
        fork::for_each(&mut states, |band, to| {
            for row in bands.rows(band, coarse.rows()) {
                let Some((middle, first)) = self.fine_row(fine, coarse, row) else {
                    continue;
                };
                let stride = fine.stride();
                for run in coarse.active().row(row) {
                    let col = run.start - row * coarse.stride();
                    let at = (2 * col as isize + first) as usize;
                    let span = |row: usize| &work[row * stride + at - 1..][..2 * run.len() + 1];
                    let (up, mid, down) = (span(middle - 1), span(middle), span(middle + 1));
                    for (i, to) in to.run_mut(*run).iter_mut().enumerate() {
                        let j = 2 * i + 1;
                        let ring = (mid[j - 1] + mid[j + 1])
                            + (up[j] + up[j + 1])
                            + (down[j] + down[j + 1]);
                        *to = scale * (mid[j] + 0.5 * ring);
                    }
                }
            }
        });
        self.extension.extend_transposed(work, to, scale);
    }

    /// Prolongs a correction: adds `P from` to the fine `to`, where `from` is zero outside the coarse domain;
    /// overwrites `work`.
    pub(crate) fn prolong(
        &self,
        (coarse, from): (&Domain, &[f32]),
        (fine, to, work): (&Domain, &mut [f32], &mut [f32]),
    ) {
        let bands = fine.bands();
        let mut states: Vec<_> = bands.split(work).collect();
        fork::for_each(&mut states, |band, work| {
            work.values().fill(0.0);
            for row in bands.rows(band, fine.rows()) {
                self.interpolate((coarse, from), (fine, row, work));
            }
        });
        self.extension.extend(from, work);
        self.average(fine, work, to, |to, average| *to += average);
        self.averages.complete(fine, work, to);
    }

    /// Interpolates linearly in one row of the fine domain's padded box.
    fn interpolate(
        &self,
        (coarse, from): (&Domain, &[f32]),
        (fine, fine_row, to): (&Domain, usize, &mut BandSlice<'_, f32>),
    ) {
        let stride = coarse.stride();
        let Ok(row) = usize::try_from((fine_row as isize - self.row).div_euclid(2)) else {
            return;
        };
        if row > coarse.rows() {
            return;
        }
        let parity = usize::from(row.is_multiple_of(2));
        let first = self.col[parity];
        let top = &from[row * stride..][..stride];
        let below = &from[(row + 1) * stride..][..stride];
        // Columns whose two fine cells lie in the box and whose neighbours exist.
        let low = (1 - first).div_euclid(2).max(1);
        let high = ((fine.stride() as isize - first).div_euclid(2)).min(stride as isize - 1);
        if high <= low {
            return;
        }
        let (low, n) = (low as usize, (high - low) as usize);
        let start = fine_row * fine.stride() + (2 * low as isize + first) as usize;
        let end = start + 2 * n;
        let out = to.run_mut(Run { start, end }).chunks_exact_mut(2);
        let a = &top[low..][..n];
        if 2 * row as isize + self.row == fine_row as isize {
            let b = &top[low + 1..][..n];
            for (i, out) in out.enumerate() {
                out[0] = a[i];
                out[1] = 0.5 * (a[i] + b[i]);
            }
        } else {
            let (sw, se) = (&below[low - parity..][..n], &below[low + 1 - parity..][..n]);
            for (i, out) in out.enumerate() {
                out[0] = 0.5 * (a[i] + sw[i]);
                out[1] = 0.5 * (a[i] + se[i]);
            }
        }
    }

    /// Returns the fine row that a coarse row falls on, and the fine column of its column 0; `None` outside of the fine
    /// box.
    fn fine_row(&self, fine: &Domain, coarse: &Domain, row: usize) -> Option<(usize, isize)> {
        debug_assert!(row <= coarse.rows());
        let at = 2 * row as isize + self.row;
        let inside = (1..=fine.rows() as isize).contains(&at);
        inside.then(|| (at as usize, self.col[usize::from(row.is_multiple_of(2))]))
    }

    /// Computes the average `A from` of each vertex of the fine domain with its neighbours, to be stored or added by
    /// `store`. At boundary vertices it is the vertex's own value, which [`Averages`] completes.
    #[inline(always)]
    fn average(
        &self,
        domain: &Domain,
        from: &[f32],
        to: &mut [f32],
        store: impl Fn(&mut f32, f32) + Sync,
    ) {
        let bands = domain.bands();
        let mut states: Vec<_> = bands.split(to).collect();
        fork::for_each(&mut states, |band, to| {
            for row in bands.rows(band, domain.rows()) {
                for run in domain.interior().row(row) {
                    let ring = Ring::new(from, domain, row, *run);
                    for (i, to) in to.run_mut(*run).iter_mut().enumerate() {
                        store(to, 0.25 * ring.centre(i) + 0.125 * ring.sum(i));
                    }
                }
            }
        });
        for cell in self.averages.cells() {
            store(&mut to[cell], from[cell]);
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
    use crate::Heightfield;
    use crate::fit::coarsen::coarsen;
    use crate::lattice::domain::tests::arbitrary_field;
    use proptest::prelude::*;

    fn fill(domain: &Domain, seed: f32) -> Vec<f32> {
        let mut values = vec![0.0; domain.cells()];
        let mut x = seed;
        for cell in domain.active().cells() {
            x = 3.9 * x * (1.0 - x);
            values[cell] = x - 0.5;
        }
        values
    }

    fn dot(domain: &Domain, a: &[f32], b: &[f32]) -> f64 {
        let cells = domain.active().cells();
        cells.map(|c| f64::from(a[c]) * f64::from(b[c])).sum()
    }

    /// Of the field's lattice and of the next coarser one, if both have stencils.
    fn domains(field: &Heightfield) -> Option<(Domain, Domain)> {
        let fine = Domain::new(field).ok()?;
        let coarse = coarsen(&field.into(), &fine).unwrap();
        Some((fine, coarse.domain().ok()?))
    }

    /// The difference between ⟨Px, y⟩ and ⟨x, Pᵀy⟩; None where a lattice has no stencils.
    fn asymmetry(field: &Heightfield) -> Option<f64> {
        let (fine, coarse) = domains(field)?;
        let transfer = Transfer::new(&fine, &coarse);
        let (x, y) = (fill(&coarse, 0.3), fill(&fine, 0.4));
        let (mut px, mut work) = (vec![0.0; fine.cells()], vec![0.0; fine.cells()]);
        transfer.prolong((&coarse, &x), (&fine, &mut px, &mut work));
        let mut pty = vec![0.0; coarse.cells()];
        let mut clean = vec![0.0; fine.cells()];
        transfer.restrict((&fine, &y, &mut clean), (&coarse, &mut pty), 1.0);
        Some((dot(&fine, &px, &y) - dot(&coarse, &x, &pty)).abs())
    }

    proptest! {
        #[test]
        fn restriction_is_the_transposed_prolongation(field in arbitrary_field()) {
            let off = asymmetry(&field);
            prop_assert!(off.is_none_or(|off| off < 1e-5), "{off:?}");
        }
    }

    #[test]
    fn restriction_is_the_transposed_prolongation_beside_a_bay_of_the_border() {
        // Once found by the test above: the upper left corner and the end of a row are missing.
        const PRESENT: [&str; 7] = [
            ".......", ".......", "...x.x.", ".xxxxxx", "xxxxxxx", "xx..xxx", "xxxxxxx",
        ];
        let present = PRESENT.concat();
        let heights = present.char_indices().map(|(i, cell)| match cell {
            'x' => (1.7 * i as f64).sin(),
            _ => f64::NAN,
        });
        let lattice = crate::Lattice::new(7, 7, 1.8622251202170843).unwrap();
        let field = Heightfield::new(lattice, heights.collect()).unwrap();
        assert!(asymmetry(&field).unwrap() < 1e-5);
    }

    #[test]
    fn a_plane_is_prolonged_to_the_same_plane() {
        for (rows, cols) in [(17, 18), (18, 17), (20, 20)] {
            let lattice = crate::Lattice::new(rows, cols, 1.0).unwrap();
            let plane = |x: f64, y: f64| 0.25 * x - 0.5 * y + 1.0;
            let holed = |x: f64, y: f64| {
                if (x - 6.0).hypot(y + 7.0) < 2.5 {
                    f64::NAN
                } else {
                    plane(x, y)
                }
            };
            let field = Heightfield::from_fn(lattice, holed).unwrap();
            let fine = Domain::new(&field).unwrap();
            let coarse_input = coarsen(&field.clone().into(), &fine).unwrap();
            let coarse = coarse_input.domain().unwrap();
            let coarse_field = coarse_input.field;
            let mut x = vec![0.0; coarse.cells()];
            for cell in coarse.active().cells() {
                x[cell] = coarse_field.heights()[coarse.lattice_index(cell)] as f32;
            }
            let (mut to, mut work) = (vec![0.0; fine.cells()], vec![0.0; fine.cells()]);
            Transfer::new(&fine, &coarse).prolong((&coarse, &x), (&fine, &mut to, &mut work));
            for cell in fine.active().cells() {
                let (row, col) = fine.lattice_vertex(cell);
                let expected = field.height(row, col) as f32;
                assert!(
                    (to[cell] - expected).abs() < 1e-4,
                    "{row} {col} {}",
                    to[cell]
                );
            }
        }
    }
}
