//! Impulse noise: single heights far from all that is around them, as of dead or flying pixels.
//!
//! A spike sticks out of the line between each two opposite neighbours, to the same side and by the same height
//! whether these are one or two steps away. A ridge does not stick out along itself, and the tip of a cone sticks out
//! twice as far of neighbours at twice the distance. The spread of such differences around is the scale, so that smooth
//! noise, steps of rounding and rough ground are no spikes.

use std::iter;

use super::raster::Raster;
use crate::math::statistics::{MAD_TO_SIGMA, median};

/// Minimum height of a spike, in standard deviations of the heights' differences to the means of opposite neighbours
/// (`benches/scenes.md`, One constant at a time).
const MIN_SPIKE_DEVIATIONS: f64 = 5.0;

/// Maximum ratio of a spike's height over neighbours two steps away to that over neighbours one step away; the tip of a
/// cone has 2 (`benches/scenes.md`, One constant at a time).
const MAX_SPIKE_GROWTH: f64 = 1.5;

/// Number of passes: spikes side by side hide each other until one of them is known.
const SPIKE_PASSES: usize = 3;

/// Number of steps to each side from a spike within which the spread of differences is measured, and neighbours are looked for where
/// the nearest heights are missing, as between dead pixels (`benches/scenes.md`, One constant at a time).
const SPREAD_REACH: usize = 3;

/// Differences smaller than this share of the height range are rounding errors.
const MIN_DIFFERENCE_SHARE: f64 = 1e-9;

/// Height of a spike that was found. What was beside it may be alike, as along a step.
const REMOVED: f64 = f64::INFINITY;

/// Finds the cells of a padded raster whose heights are spikes, and makes these heights infinite.
pub(super) fn remove_spikes(raster: &Raster, heights: &mut [f64]) -> Vec<usize> {
    let mut all = Vec::new();
    for _ in 0..SPIKE_PASSES {
        let found = find_spikes(raster, heights);
        if found.is_empty() {
            break;
        }
        found.iter().for_each(|cell| heights[*cell] = REMOVED);
        all.extend(found);
    }
    all
}

fn find_spikes(raster: &Raster, heights: &[f64]) -> Vec<usize> {
    let cells = || (0..raster.cells()).filter(|cell| heights[*cell].is_finite());
    let [low, high] = cells().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], cell| {
        [low.min(heights[cell]), high.max(heights[cell])]
    });
    let rounding = MIN_DIFFERENCE_SHARE * (high - low);
    let usual = |cells: &mut dyn Iterator<Item = usize>, least: f64| {
        let differences = cells.map(|cell| difference(raster, heights, cell, 0, 1).abs());
        median(
            &mut differences
                .filter(|d| d.is_finite() && *d > least)
                .collect::<Vec<_>>(),
        )
    };
    let Some(floor) = usual(&mut cells(), rounding) else {
        return Vec::new();
    };
    let spread = |cell: usize| {
        let row_of = |row: usize| cell + row * raster.stride - SPREAD_REACH * raster.stride;
        let window = (0..=2 * SPREAD_REACH)
            .flat_map(|row| row_of(row) - SPREAD_REACH..=row_of(row) + SPREAD_REACH);
        let around = &mut window.filter(|other| raster.is_inside(*other));
        usual(around, -1.0).unwrap_or(0.0)
    };
    let least = |spread: f64| MIN_SPIKE_DEVIATIONS * MAD_TO_SIGMA * spread;
    let is_spike = |cell: &usize| {
        let height = spike_height(raster, heights, *cell);
        height > least(floor) && height > least(spread(*cell))
    };
    cells().filter(is_spike).collect()
}

/// Returns the least height by which a cell sticks out of the lines between its opposite neighbours; 0 where it does not
/// stick out of each of them to the same side, more than one of them is unknown, it is the tip of a cone, or as many
/// neighbours are off alike as along the edge of a step.
fn spike_height(raster: &Raster, heights: &[f64], cell: usize) -> f64 {
    let pairs = raster.directions() / 2;
    // A ridge that ends at the border sticks out there.
    if !raster.neighbours(cell).all(|other| raster.is_inside(other)) {
        return 0.0;
    }
    let differences = |steps: usize| {
        (0..pairs)
            .map(move |pair| difference(raster, heights, cell, pair, steps))
            .filter(|d| d.is_finite())
    };
    let (mut least, mut sum, mut count) = (f64::INFINITY, 0.0, 0);
    for d in differences(1) {
        (least, sum, count) = (least.min(d.abs()), sum + d, count + 1);
    }
    if count + 1 < pairs || differences(1).any(|d| d * sum <= 0.0) {
        return 0.0;
    }
    let is_alike = |other: &usize| {
        heights[*other] == REMOVED || (heights[cell] - heights[*other]).abs() < 0.5 * least
    };
    if raster.neighbours(cell).filter(is_alike).count() + 1 >= pairs {
        return 0.0;
    }
    let (mut far, mut far_count) = (0.0, 0);
    for d in differences(2) {
        (far, far_count) = (far + d, far_count + 1);
    }
    let [near, far] = [
        sum / f64::from(count as u32),
        far / f64::from(far_count.max(1)),
    ];
    match far_count > 0 && far / near > MAX_SPIKE_GROWTH {
        true => 0.0,
        false => least,
    }
}

/// Returns the difference of a cell's height to the line between two opposite cells, so many steps away or, where heights are
/// missing, up to [`SPREAD_REACH`]; NaN if there is none.
fn difference(raster: &Raster, heights: &[f64], cell: usize, pair: usize, steps: usize) -> f64 {
    let opposite = pair + raster.directions() / 2;
    let known = |direction| {
        let step = |cell: &usize| Some(raster.neighbour(*cell, direction));
        let ray = iter::successors(Some(cell), step).map(|cell| heights[cell]);
        let mut near = ray.zip(0..=SPREAD_REACH).skip(steps);
        near.find(|(height, _)| height.is_finite())
    };
    match (known(pair), known(opposite)) {
        (Some((a, to_a)), Some((b, to_b))) => {
            let [to_a, to_b] = [to_a, to_b].map(|steps| steps as f64);
            heights[cell] - (a * to_b + b * to_a) / (to_a + to_b)
        }
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spikes(hexagonal: bool, height: impl Fn(usize, usize) -> f64) -> Vec<usize> {
        let values: Vec<f64> = (0..900).map(|i| height(i / 30, i % 30)).collect();
        let raster = match hexagonal {
            true => Raster::hexagonal(30, 30, 4),
            false => Raster::square(30, 30, 4),
        };
        let raster = raster.unwrap();
        let mut heights = raster.padded(&values, f64::NAN).unwrap();
        let mut found: Vec<usize> = (remove_spikes(&raster, &mut heights).into_iter())
            .map(|cell| raster.index(cell))
            .collect();
        found.sort_unstable();
        found
    }

    fn noise(row: usize, col: usize) -> f64 {
        oorandom::Rand64::new((row * 31 + col) as u128).rand_float()
    }

    #[test]
    fn spikes_alone_and_side_by_side_are_found_in_noise() {
        let at = [4 * 30 + 7, 4 * 30 + 8, 20 * 30 + 20];
        for hexagonal in [false, true] {
            let height = |row: usize, col: usize| {
                noise(row, col)
                    + if at.contains(&(row * 30 + col)) {
                        20.0
                    } else {
                        0.0
                    }
            };
            assert_eq!(spikes(hexagonal, height), at, "{hexagonal}");
        }
    }

    /// With every seventh height missing, most cells have a missing neighbour.
    #[test]
    fn spikes_beside_missing_heights_are_found_and_ridges_are_none() {
        let at = [4 * 30 + 8, 5 * 30 + 20, 16 * 30 + 13, 20 * 30 + 21];
        for hexagonal in [false, true] {
            let height = |row: usize, col: usize| {
                let cell = row * 30 + col;
                let ridge = if row == 12 { 20.0 } else { 0.0 };
                match cell % 7 {
                    0 => f64::NAN,
                    _ if at.contains(&cell) => 20.0,
                    _ => noise(row, col) + ridge,
                }
            };
            assert_eq!(spikes(hexagonal, height), at, "{hexagonal}");
        }
    }

    #[test]
    fn ridges_tips_steps_and_rounding_are_no_spikes() {
        // Odd rows of a lattice are half a spacing to the left.
        let tip = |shift: f64| {
            move |row: usize, col: usize| {
                -(row as f64 - 15.3).hypot(col as f64 - shift * (row % 2) as f64 - 15.2)
            }
        };
        let ridge = |row: usize, col: usize| noise(row, col) + if row == 12 { 20.0 } else { 0.0 };
        let step = |row: usize, col: usize| noise(row, col) + if row > 14 { 20.0 } else { 0.0 };
        let slanted = |row: usize, col: usize| {
            noise(row, col) + 20.0 * ((row as f64 + 0.3 * col as f64) / 7.0).floor()
        };
        let rounded = |row: usize, col: usize| (noise(row, col) * 1.2 + 0.1 * row as f64).round();
        for hexagonal in [false, true] {
            let shift = if hexagonal { 0.5 } else { 0.0 };
            assert!(spikes(hexagonal, tip(shift)).is_empty());
            assert!(spikes(hexagonal, ridge).is_empty());
            assert!(spikes(hexagonal, step).is_empty());
            assert!(spikes(hexagonal, slanted).is_empty());
            assert!(spikes(hexagonal, rounded).is_empty());
        }
    }
}
