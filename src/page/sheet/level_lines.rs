//! Detection of lines of text and rules across a page in a photo flattened by a sheet.

use super::place_table::PlaceTable;
use super::problem::LevelLine;
use super::view::PhotoView;
use crate::page::text::{GreyPhoto, find_baselines};

/// Maximum number of points of one detected line that are used.
/// Its row: `benches/page.md`, One rule at a time.
const MAX_LINE_POINTS: usize = 16;

/// Detects the lines across the page in the photo as flattened by a sheet. `table` gives the photo's places of the flat
/// page. Columns down the page are not searched: gaps between words look like them and are not straight.
pub(super) fn find_level_lines(
    table: &PlaceTable,
    view: &PhotoView,
    photo: &GreyPhoto,
) -> Vec<LevelLine> {
    let size = table
        .seen_size()
        .map(|side| side / photo.working_block as f64);
    let found = find_baselines(size, |share| photo.at(table.at(share)));
    let seen = |share: &[f64; 2]| (*share, view.to_normalised(table.at(*share)));
    (found.iter())
        .filter_map(|line| level_line(line.iter().map(seen).collect()))
        .collect()
}

/// Makes level lines of lines of text that were traced in the photo, `traced` in normalised image coordinates, at the places
/// where a sheet has them. Lines that are not on the sheet are left out.
pub(super) fn traced_level_lines(
    table: &PlaceTable,
    view: &PhotoView,
    traced: &[Vec<[f64; 2]>],
) -> Vec<LevelLine> {
    let on_page = |seen: &[f64; 2]| Some((table.back_project(view.to_pixels(*seen))?, *seen));
    (traced.iter())
        .filter_map(|line| level_line(line.iter().filter_map(on_page).collect()))
        .collect()
}

/// Makes the level line of a line of text, given by its places on the page (shares of width and height) with those in the
/// photo. None for fewer than two.
fn level_line(line: Vec<([f64; 2], [f64; 2])>) -> Option<LevelLine> {
    let ([(first, _), ..], [.., (last, _)]) = (&line[..], &line[..]) else {
        return None;
    };
    let length = (last[0] - first[0]).abs();
    let thin = line.len().div_ceil(MAX_LINE_POINTS).max(1);
    let (shares, points): (Vec<_>, Vec<_>) = line.into_iter().step_by(thin).unzip();
    (points.len() > 1 && length > 0.0).then(|| LevelLine {
        level: shares.iter().map(|share| share[1]).sum::<f64>() / shares.len() as f64,
        level_deviation: None,
        points,
        length,
    })
}
