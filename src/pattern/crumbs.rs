//! Sheets too small to be handled, which are left out of a pattern.

use super::cutting::MAX_OMITTED_SHARE;
use super::sheets::{Missing, Sheet};
use crate::shape::patches::Patch;

/// Maximum area of a crumb, as a share of the area of all sheets: a piece that is lost among the others. On a pattern as
/// large as a page of A4 it is 8 mm wide. `benches/patterns.md` has what others give.
const MAX_CRUMB_SHARE: f64 = 0.001;

/// Takes out the sheets that cannot be drawn, and the crumbs, the smallest first, up to the share of the area that may be
/// left out, of which `missing` has what is left out already, and gets what is taken out. Along it the other sheets have a
/// border.
pub(super) fn remove_crumbs(sheets: &mut Vec<Sheet>, patches: &[Patch], missing: &mut Missing) {
    let whole = missing.area + sheets.iter().map(|sheet| sheet.area).sum::<f64>();
    sheets.sort_by(|a, b| a.area.total_cmp(&b.area));
    let mut left_out = missing.area;
    let is_crumb = |sheet: &mut Sheet| {
        let is_small = sheet.area < MAX_CRUMB_SHARE * whole
            && left_out + sheet.area <= MAX_OMITTED_SHARE * whole;
        let is_out = is_small || !is_finite(sheet);
        left_out += f64::from(is_out) * sheet.area;
        is_out
    };
    let crumbs: Vec<Sheet> = sheets.extract_if(.., is_crumb).collect();
    let is_out = |patch: &u32| crumbs.iter().any(|crumb| crumb.patches.contains(patch));
    let runs = sheets
        .iter_mut()
        .flat_map(|sheet| sheet.outlines.iter_mut().flatten());
    for run in runs {
        if run.seam.is_some_and(|seam| seam.patches.iter().any(is_out)) {
            (run.seam, run.patch) = (None, None);
        }
    }
    for crumb in crumbs {
        missing.area += crumb.area;
        let own = crumb.patches.iter();
        missing.vertices += own.map(|p| patches[*p as usize].vertices).sum::<usize>();
    }
}

/// Whether all points of a sheet are finite.
fn is_finite(sheet: &Sheet) -> bool {
    let outlines = sheet.outlines.iter().flatten().map(|run| &run.points);
    let lines = outlines.chain(sheet.folds.iter().map(|fold| &fold.points));
    let places = sheet.spots.iter().map(|spot| &spot.place);
    (lines.flatten().chain(places).flatten()).all(|coordinate| coordinate.is_finite())
}
