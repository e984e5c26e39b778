//! Detection of lines of text and rules across a page in a photo flattened by a sheet.

use super::place_table::PlaceTable;
use super::problem::LevelLine;
use super::view::PhotoView;
use crate::page::text::{GreyPhoto, PageView, find_on_view};

/// Maximum number of points of one detected line that are used.
const MAX_LINE_POINTS: usize = 16;

/// Maximum number of detected lines that are used: more cost time and add nothing.
const MAX_LINES: usize = 40;

/// Detects the lines across the page in the photo as flattened by a sheet. `table` gives the photo's places of the flat
/// page. Columns down the page are not searched: gaps between words look like them and are not straight.
pub(super) fn find_level_lines(
    table: &PlaceTable,
    view: &PhotoView,
    photo: &GreyPhoto,
) -> Vec<LevelLine> {
    let page = PageView::from_places(|share| Some(table.at(share)));
    let found = find_on_view(&page, photo, false).unwrap_or_default();
    let step = found.len().div_ceil(MAX_LINES).max(1);
    (found.iter().step_by(step))
        .map(|line| {
            let thin = line.len().div_ceil(MAX_LINE_POINTS).max(1);
            let shares: Vec<_> = line.iter().step_by(thin).collect();
            LevelLine {
                level: shares.iter().map(|p| p[1]).sum::<f64>() / shares.len() as f64,
                level_deviation: None,
                points: (shares.iter())
                    .map(|share| view.to_normalised(table.at(**share)))
                    .collect(),
                length: line[line.len() - 1][0] - line[0][0],
            }
        })
        .collect()
}
