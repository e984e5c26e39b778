//! Detection of folds across a page: steps of brightness that run from the left edge to the right one in the flattened
//! photo. A sheet bends freely along them. Outline and lines of print leave open where along the page the print is; a page
//! that is folded once across is folded in its middle, which tells it. `benches/page.md`, Folds, says how the constants were
//! chosen.

use super::place_table::PlaceTable;
use super::problem::LevelLine;
use super::view::PhotoView;
use crate::page::best_path::best_path;
use crate::page::outline::vertical_extreme;
use crate::page::text::GreyPhoto;

/// Number of vertical strips of the page in each of which steps of brightness are searched.
const STRIP_COUNT: usize = 40;

/// Number of columns of each strip at which the brightness is sampled.
/// Its row: `benches/page.md`, One rule at a time.
const SAMPLES_PER_STRIP: usize = 6;

/// Number of rows of the page at which the brightness is sampled.
const PROFILE_ROWS: usize = 480;

/// Width of the margin at the upper and lower edge, and around each fold, without folds, in rows: edges are traced with errors.
/// Its row: `benches/page.md`, Models.
const FOLD_FREE_MARGIN_ROWS: usize = 29;

/// Half width, in rows, of the window of the grey closing by which print is removed.
const PRINT_RADIUS_ROWS: usize = 4;

/// Standard deviation of the Gaussian by which the brightness is smoothed along a strip, in rows.
const SMOOTHING_DEVIATION_ROWS: f64 = 1.7;

/// Number of rows on either side that the smoothing reaches: three standard deviations.
const KERNEL_ROWS: usize = (SMOOTHING_DEVIATION_ROWS * 3.0) as usize + 1;

/// Step of brightness at which a fold is fully visible, as a multiple of the strip's median one.
/// Its row: `benches/page.md`, One rule at a time.
const VISIBLE_STEP_RATIO: f32 = 6.0;

/// Addition to a strip's median step of logarithmic brightness: noise of evenly bright paper.
/// Its row: `benches/page.md`, Models.
const MIN_STEP_NOISE: f32 = 0.004;

/// Cost of a change by one row from strip to strip, where a fully visible fold earns 1 in each strip.
/// Its row: `benches/page.md`, One rule at a time.
const ROW_CHANGE_COST: f32 = 0.04;

/// Minimum mean visibility of a fold, from 0 to 1.
/// Chosen by `benches/page.md`, Folds.
const MIN_FOLD_VISIBILITY: f32 = 0.8;

/// Minimum mean visibility of a fold in the outer strips: bars of tables end before them.
/// Chosen by `benches/page.md`, Folds.
const MIN_OUTER_VISIBILITY: f32 = 0.7;

/// Number of strips at the left and at the right edge in which a fold is visible and print is not.
/// Chosen by `benches/page.md`, Folds.
const OUTER_STRIP_COUNT: usize = 3;

/// Standard deviation of a fold that halves the page from its middle, as a share of the page's height, if the fit of the
/// sheet has a cost of 1; it is divided by the square root of the cost (`benches/page.md`, Folds). A fold within three of these
/// deviations is one that halves the page.
const HALF_FOLD_DEVIATION: f64 = 0.02;

/// Length, in widths of the page, by which a fold at an unknown position counts as a line across the page: folds by hand are
/// neither quite straight nor quite parallel to the edge. Chosen by `benches/page.md`, Folds.
const UNKNOWN_FOLD_LENGTH: f64 = 0.2;

/// Path of a fold across the page: its row in each strip.
type FoldPath = Vec<usize>;

/// Finds the folds across the page in the photo as flattened by a sheet. `table` gives the photo's places of the flat page;
/// `cost` is that of the sheet's fit.
pub(super) fn find_folds(
    table: &PlaceTable,
    view: &PhotoView,
    photo: &GreyPhoto,
    cost: f64,
) -> Vec<LevelLine> {
    let half_deviation = HALF_FOLD_DEVIATION / cost.max(1e-9).sqrt();
    let paths = visible_paths(strips(|share| photo.at(table.at(share))));
    let level =
        |path: &FoldPath| path.iter().map(|row| row_share(*row)).sum::<f64>() / STRIP_COUNT as f64;
    let halves = paths.len() == 1 && (level(&paths[0]) - 0.5).abs() < 3.0 * HALF_FOLD_DEVIATION;
    (paths.iter())
        .map(|path| LevelLine {
            points: (path.iter().enumerate())
                .map(|(strip, row)| [(strip as f64 + 0.5) / STRIP_COUNT as f64, row_share(*row)])
                .map(|share| view.to_normalised(table.at(share)))
                .collect(),
            level: if halves { 0.5 } else { level(path) },
            level_deviation: halves.then_some(half_deviation),
            length: if halves { 1.0 } else { UNKNOWN_FOLD_LENGTH },
        })
        .collect()
}

/// Computes how visible a fold is in each strip and row of the page. `brightness` gives the flattened photo's, by shares of
/// the page's width and height.
fn strips(brightness: impl Fn([f64; 2]) -> f32) -> Vec<Vec<f32>> {
    (0..STRIP_COUNT)
        .map(|strip| {
            visibility(|sample, row| {
                let across = strip as f64 + (sample as f64 + 0.5) / SAMPLES_PER_STRIP as f64;
                brightness([across / STRIP_COUNT as f64, row_share(row)])
            })
        })
        .collect()
}

/// Finds the paths across all strips along which a fold is visible, the most visible one first.
fn visible_paths(mut strips: Vec<Vec<f32>>) -> Vec<FoldPath> {
    let mut folds = Vec::new();
    loop {
        let path = best_path(strips.iter().map(Vec::as_slice), ROW_CHANGE_COST);
        let mut visible = [0.0; STRIP_COUNT];
        for ((row, strip), visible) in path.iter().zip(&mut strips).zip(&mut visible) {
            *visible = strip[*row];
            let end = (row + FOLD_FREE_MARGIN_ROWS + 1).min(PROFILE_ROWS);
            strip[row.saturating_sub(FOLD_FREE_MARGIN_ROWS)..end].fill(0.0);
        }
        let outer = [
            &visible[..OUTER_STRIP_COUNT],
            &visible[STRIP_COUNT - OUTER_STRIP_COUNT..],
        ]
        .concat();
        if mean(&visible) < MIN_FOLD_VISIBILITY {
            return folds;
        }
        if mean(&outer) >= MIN_OUTER_VISIBILITY {
            folds.push(path);
        }
    }
}

/// Position of the middle of a row on the page: share of the page's height.
fn row_share(row: usize) -> f64 {
    (row as f64 + 0.5) / PROFILE_ROWS as f64
}

/// Computes how visible a fold is in each row of a strip, from 0 to 1: the steps of the paper's logarithmic brightness
/// relative to the strip's median one. `brightness` gives the photo's by numbers of sample and row.
fn visibility(brightness: impl Fn(usize, usize) -> f32) -> Vec<f32> {
    let mut bright: Vec<f32> = (0..PROFILE_ROWS)
        .map(|row| {
            // The second brightest sample is paper, unless print covers the strip.
            let mut samples: [f32; SAMPLES_PER_STRIP] =
                std::array::from_fn(|sample| brightness(sample, row).max(0.0));
            let second = samples.select_nth_unstable_by(SAMPLES_PER_STRIP - 2, f32::total_cmp);
            match *second.1 {
                second if second > 0.0 => (second + 1.0).ln(),
                _ => f32::NAN,
            }
        })
        .collect();
    if bright.iter().all(|value| value.is_nan()) {
        return vec![0.0; PROFILE_ROWS];
    }
    // Beyond the photo the brightness goes on as at its rim, so that the rim is no step.
    for row in 1..PROFILE_ROWS {
        if bright[row].is_nan() {
            bright[row] = bright[row - 1];
        }
    }
    for row in (1..PROFILE_ROWS).rev() {
        if bright[row - 1].is_nan() {
            bright[row - 1] = bright[row];
        }
    }
    let mut paper = bright;
    vertical_extreme(&mut paper, 1, PRINT_RADIUS_ROWS, f32::max);
    vertical_extreme(&mut paper, 1, PRINT_RADIUS_ROWS, f32::min);
    let kernel: Vec<f32> = (0..=KERNEL_ROWS)
        .map(|i| (i as f64 * (-0.5 * (i as f64 / SMOOTHING_DEVIATION_ROWS).powi(2)).exp()) as f32)
        .collect();
    let norm: f32 = kernel.iter().sum();
    let steps: Vec<f32> = (0..PROFILE_ROWS)
        .map(|row| {
            let differences = (kernel.iter().enumerate()).map(|(i, weight)| {
                weight * (paper[(row + i).min(PROFILE_ROWS - 1)] - paper[row.saturating_sub(i)])
            });
            differences.sum::<f32>().abs() / norm
        })
        .collect();
    let mut sorted = steps.clone();
    let (_, median, _) = sorted.select_nth_unstable_by(PROFILE_ROWS / 2, f32::total_cmp);
    let visible = VISIBLE_STEP_RATIO * (*median + MIN_STEP_NOISE);
    let mut found = vec![0.0; PROFILE_ROWS];
    for row in FOLD_FREE_MARGIN_ROWS..PROFILE_ROWS - FOLD_FREE_MARGIN_ROWS {
        found[row] = (steps[row] / visible).min(1.0);
    }
    found
}

/// Mean of some values.
fn mean(values: &[f32]) -> f32 {
    values.iter().sum::<f32>() / values.len() as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Brightness of evenly lit paper with noise, rows of print and a filled bar from margin to margin.
    fn printed([x, y]: [f64; 2]) -> f32 {
        let noise = ((1e4 * x).sin() * (1e4 * y).cos()) as f32;
        let is_printed =
            (0.1..0.9).contains(&x) && (y * 40.0).fract() < 0.2 && (x * 60.0).fract() < 0.7;
        let is_bar = (0.1..0.9).contains(&x) && (0.3..0.36).contains(&y);
        let paper = if is_bar || is_printed { 60.0 } else { 200.0 };
        paper + noise
    }

    #[test]
    fn folds_from_edge_to_edge_are_found_and_print_is_not() {
        assert!(visible_paths(strips(printed)).is_empty());
        // A page that leaves the photo below ends there without a step.
        let cut = |share: [f64; 2]| {
            if share[1] < 0.8 {
                printed(share)
            } else {
                f32::NAN
            }
        };
        assert!(visible_paths(strips(cut)).is_empty());
        // The fold's light changes sides where a second fold crosses it.
        let at = |x: f64| 0.52 + 0.03 * x;
        let folded =
            |[x, y]: [f64; 2]| printed([x, y]) * if (y < at(x)) == (x < 0.4) { 1.0 } else { 0.9 };
        let found = visible_paths(strips(folded));
        assert_eq!(found.len(), 1);
        for (strip, row) in found[0].iter().enumerate() {
            let expected = at((strip as f64 + 0.5) / STRIP_COUNT as f64);
            let row = row_share(*row);
            // Rows of print beside the fold move it by up to the radius of the closing.
            let tolerance = (PRINT_RADIUS_ROWS + 1) as f64 / PROFILE_ROWS as f64;
            assert!(
                (row - expected).abs() < tolerance,
                "{strip}: {row} {expected}"
            );
        }
    }
}
