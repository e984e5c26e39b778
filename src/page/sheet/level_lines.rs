//! Detection of lines of text, rules and left margins in a photo flattened by a sheet.

use super::place_table::PlaceTable;
use super::problem::LevelLine;
use super::view::PhotoView;
use crate::dewarp::Photo;
use crate::page::text::{PageView, find_on_view};

/// Maximum number of points of one detected line that are used.
const MAX_LINE_POINTS: usize = 16;

/// Maximum number of detected lines in each direction (across or down the page) that are used: more cost time and add
/// nothing.
const MAX_LINES_PER_DIRECTION: usize = 40;

/// Detects the lines across and down the page in the photo as flattened by a sheet. `table` gives the photo's places of
/// the flat page, `ratio` is the page's height over its width.
pub(super) fn find_level_lines(
    table: &PlaceTable,
    view: &PhotoView,
    photo: &Photo<'_>,
    ratio: f64,
) -> Vec<LevelLine> {
    let mut lines = Vec::new();
    for vertical in [false, true] {
        // Turned by a right angle, the lower edge of a line is its left side.
        let turned = |[x, y]: [f64; 2]| if vertical { [1.0 - y, x] } else { [x, y] };
        let turned_view = PageView::from_places(|share| Some(table.at(turned(share))));
        let found = find_on_view(&turned_view, photo, false).unwrap_or_default();
        let step = found.len().div_ceil(MAX_LINES_PER_DIRECTION).max(1);
        for line in found.iter().step_by(step) {
            let thin = line.len().div_ceil(MAX_LINE_POINTS).max(1);
            let shares: Vec<_> = line.iter().step_by(thin).map(|p| turned(*p)).collect();
            let level = |p: &[f64; 2]| if vertical { p[0] } else { p[1] };
            let span = (line[line.len() - 1][0] - line[0][0]) * if vertical { ratio } else { 1.0 };
            lines.push(LevelLine {
                level: shares.iter().map(level).sum::<f64>() / shares.len() as f64,
                points: (shares.iter())
                    .map(|share| view.to_normalised(table.at(*share)))
                    .collect(),
                vertical,
                length: span,
            });
        }
    }
    lines
}
