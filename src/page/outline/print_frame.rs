//! Outlines around the print, for pages on a ground of their own colour: in a frame that is turned like the lines of print,
//! each edge of the page is a path across the photo, outside of all print, along which contrast stands out from the texture
//! around.

use std::f64::consts::{FRAC_PI_2, PI};

use super::corners::{CUT_END_LENGTH_SHARE, is_outside};
use super::edge_path::AVERAGING_RADIUS;
use super::morphology::{box_mean, vertical_mean};
use super::planes::Planes;
use super::print::Print;
use super::quadrilateral::rectangularity;
use crate::math::planar::polygon_area;
use crate::page::best_path::{best_path, smooth_path};

/// Number of directions among which that of the lines of print is searched, over half a turn.
const PRINT_DIRECTIONS: usize = 90;

/// Slopes of edges relative to the frame at which contrast is averaged: perspective turns edges from the lines of print.
/// Its row: `benches/page.md`, Constants of the outline.
const EDGE_SLOPES: [f64; 5] = [-0.3, -0.15, 0.0, 0.15, 0.3];

/// Half the side, in pixels, of the square whose mean contrast is that of the texture around an edge.
const TEXTURE_RADIUS: usize = AVERAGING_RADIUS * 2;

/// Minimum texture, in logarithmic colour: about the noise of a reduced photo.
/// Its row: `benches/page.md`, Constants of the outline.
const MIN_TEXTURE: f32 = 0.002;

/// Contrast of an edge that is surely seen, as a multiple of the texture around it.
/// Its row: `benches/page.md`, Constants of the outline.
const CLEAR_EDGE_RATIO: f32 = 5.0;

/// Strength, as a share of that of an edge that is surely seen, below which a place lessens the worth of a path.
/// Its row: `benches/page.md`, Constants of the outline.
const MIN_EDGE_STRENGTH: f32 = 0.5;

/// Worth that a path loses at each place for each pixel of print beyond it.
/// Its row: `benches/page.md`, Constants of the outline.
const PRINT_OUTSIDE_COST: f32 = 0.1;

/// Worth that a path loses by a sideways step of one pixel.
/// Its row: `benches/page.md`, Constants of the outline.
const STEP_COST: f32 = 0.05;

/// Number of paths that are tried on each side of the print.
const PATHS_PER_SIDE: usize = 4;

/// Length, in pixels, over which an edge's contrast keeps its sign, and half of that over which print beyond a path is averaged.
/// Its row: `benches/page.md`, Constants of the outline.
const SEGMENT_LENGTH: usize = AVERAGING_RADIUS * 4;

/// Penalty, from 0 to 1, of an edge that continues with full strength beyond a corner, as joints of tiles and folds do.
/// Its row: `benches/page.md`, Constants of the outline.
const BEYOND_CORNER_PENALTY: f64 = 0.8;

/// Distance from the photo's rim, in pixels, within which no contrast is measured.
/// Its row: `benches/page.md`, Constants of the outline.
const PRINT_FRAME_RIM_PIXELS: f64 = 2.0;

/// An outline: four arcs, clockwise, in pixels of the reduced photo.
pub(super) type Arcs = [Vec<[f64; 2]>; 4];

/// Direction of the lines of print, in radians from −π/4 to π/4 off the photo's rows or columns: that in which the print's
/// profile changes most.
fn print_direction(print: &[[f64; 2]]) -> f64 {
    let contrast = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let mut profile = std::collections::BTreeMap::<i64, f64>::new();
        for [x, y] in print {
            let row = (0.5 * (y * cos - x * sin)).floor() as i64;
            *profile.entry(row).or_default() += 1.0;
        }
        (profile.iter())
            .map(|(row, count)| (count - profile.get(&(row + 1)).unwrap_or(&0.0)).powi(2))
            .sum::<f64>()
    };
    let (_, angle) = (0..PRINT_DIRECTIONS)
        .map(|k| PI * k as f64 / PRINT_DIRECTIONS as f64)
        .map(|angle| (contrast(angle), angle))
        .max_by(|one, other| one.0.total_cmp(&other.0))
        .unwrap_or_default();
    angle - FRAC_PI_2 * (angle / FRAC_PI_2).round()
}

/// One side of the frame: rows across it, from one end of the frame to the other, with places outwards from the middle of the
/// print.
struct Side {
    rows: usize,
    reach: usize,
    /// Strength of an edge at each place, as a vector of colour: its length is 1 where the edge is surely seen.
    steps: Vec<[f32; 3]>,
    /// Worth of a path through each place.
    worth: Vec<f32>,
}

impl Side {
    /// Finds the best paths that keep apart from each other by the averaging radius; each beside a smooth one if `is_smooth`.
    fn best_paths(&self, is_smooth: bool) -> [Vec<usize>; PATHS_PER_SIDE] {
        let mut worth = self.worth.clone();
        std::array::from_fn(|_| {
            let mut searched = worth.clone();
            if is_smooth {
                let guide = smooth_path(&worth, self.reach, AVERAGING_RADIUS);
                for (row, at) in searched.chunks_exact_mut(self.reach).zip(guide) {
                    row[..at.saturating_sub(AVERAGING_RADIUS)].fill(f32::NEG_INFINITY);
                    row[(at + AVERAGING_RADIUS + 1).min(self.reach)..].fill(f32::NEG_INFINITY);
                }
            }
            let path = best_path(searched.chunks_exact(self.reach), STEP_COST);
            for (row, r) in worth.chunks_exact_mut(self.reach).zip(&path) {
                let near =
                    r.saturating_sub(AVERAGING_RADIUS)..(r + AVERAGING_RADIUS + 1).min(row.len());
                row[near].fill(-1.0);
            }
            path
        })
    }

    /// Mean strength of the edge along a path in some rows, from 0 to 1: contrast of changing signs is none.
    fn strength(&self, path: &[usize], rows: std::ops::Range<usize>) -> f64 {
        let mut total = 0.0;
        for start in rows.clone().step_by(SEGMENT_LENGTH) {
            let end = (start + SEGMENT_LENGTH).min(rows.end);
            let mut sum = [0.0_f32; 3];
            for (t, place) in path.iter().enumerate().take(end).skip(start) {
                let step = self.steps[t * self.reach + place];
                (0..3).for_each(|k| sum[k] += step[k]);
            }
            let largest = sum.iter().fold(0.0_f32, |most, s| most.max(s.abs()));
            total += f64::from(largest.min((end - start) as f32));
        }
        total / rows.len().max(1) as f64
    }
}

/// A photo's contrast in a frame that is turned like the lines of print.
pub(super) struct PrintFrame {
    /// Size of the reduced photo.
    photo: [usize; 2],
    axes: [[f64; 2]; 2],
    /// Coordinates along the axes at which the frame begins.
    start: [f64; 2],
    /// Middle of the print, in pixels of the frame.
    middle: [usize; 2],
    /// Upper, right, lower and left side.
    sides: [Side; 4],
}

/// Axis along which a side of the frame runs, and the sign of its places along the other axis.
const fn side_axes(side: usize) -> (usize, isize) {
    (side % 2, [-1, 1, 1, -1][side])
}

impl PrintFrame {
    /// Measures the contrast in a reduced photo; None if there is no print.
    pub fn new(raw: &Planes, print: &Print) -> Option<Self> {
        print.pixels.first()?;
        let (sin, cos) = print_direction(&print.pixels).sin_cos();
        let axes = [[cos, sin], [-sin, cos]];
        let along = |p: [f64; 2], k: usize| axes[k][0] * p[0] + axes[k][1] * p[1];
        let photo = [raw.width, raw.height];
        let [right, bottom] = photo.map(|n| n as f64 - 1.0);
        let ends = [[0.0, 0.0], [right, 0.0], [right, bottom], [0.0, bottom]];
        let limit = |k: usize, sign: f64| {
            let places = ends.iter().map(|p| sign * along(*p, k));
            places.fold(f64::MIN, f64::max)
        };
        let start = [0, 1].map(|k| -limit(k, -1.0));
        let [width, height] = [0, 1].map(|k| (limit(k, 1.0) - start[k]) as usize + 1);
        let middle = [0, 1].map(|k| {
            let places = print.pixels.iter().map(|p| along(*p, k) - start[k]);
            let mut places: Vec<f64> = places.collect();
            places.sort_by(f64::total_cmp);
            let trim = places.len() / 50;
            (0.5 * (places[trim] + places[places.len() - 1 - trim])) as usize
        });
        let len = width * height;
        let place = |i: usize| {
            let (u, v) = (start[0] + (i % width) as f64, start[1] + (i / width) as f64);
            [0, 1].map(|k| u * axes[0][k] + v * axes[1][k])
        };
        let is_seen: Vec<bool> = (0..len)
            .map(|i| !is_outside(place(i), photo, -PRINT_FRAME_RIM_PIXELS))
            .collect();
        let is_print: Vec<bool> = (0..len)
            .map(|i| is_seen[i] && print.is_among_letters(place(i).map(|at| at.round() as usize)))
            .collect();
        let colours: Vec<[f32; 3]> = (0..len).map(|i| raw.colour(place(i))).collect();
        let counts = |i: usize| is_seen[i] && !is_print[i];
        let contrasts = [width, 1].map(|step| contrast(&colours, [width, height], step, counts));
        let sides = [0, 1, 2, 3].map(|side| {
            let (axis, sign) = side_axes(side);
            let (rows, across) = ([width, height][axis], [width, height][1 - axis]);
            let before = middle[1 - axis];
            let reach = if sign > 0 {
                across - before
            } else {
                before + 1
            };
            let index = |i: usize| {
                let at = frame_place(middle, side, i / reach, i % reach);
                at[1] * width + at[0]
            };
            let mut beyond = vec![0.0_f32; rows * reach];
            for i in (0..beyond.len()).rev().filter(|i| i % reach + 1 < reach) {
                beyond[i] = beyond[i + 1] + f32::from(u8::from(is_print[index(i + 1)]));
            }
            vertical_mean(&mut beyond, reach, SEGMENT_LENGTH);
            let (strengths, steps) = &contrasts[axis];
            let worth = |i: usize| {
                let at = index(i);
                if !is_seen[at] {
                    return 0.0;
                }
                strengths[at] - MIN_EDGE_STRENGTH - PRINT_OUTSIDE_COST * beyond[i]
            };
            Side {
                rows,
                reach,
                worth: (0..rows * reach).map(worth).collect(),
                steps: (0..rows * reach).map(|i| steps[index(i)]).collect(),
            }
        });
        Some(PrintFrame {
            photo,
            axes,
            start,
            middle,
            sides,
        })
    }

    /// Point in the reduced photo of a place beside the print; places outside of the photo are moved to its rim.
    fn point(&self, side: usize, row: usize, place: usize) -> [f64; 2] {
        let at = frame_place(self.middle, side, row, place);
        let [u, v] = [0, 1].map(|k| self.start[k] + at[k] as f64);
        [0, 1].map(|k| {
            (u * self.axes[0][k] + v * self.axes[1][k]).clamp(0.0, self.photo[k] as f64 - 1.0)
        })
    }

    /// First rows, from the middle on, at which the path of a side meets that of one of its neighbours.
    fn meeting(&self, [side, next]: [usize; 2], paths: [&[usize]; 2]) -> Option<[usize; 2]> {
        let (axis, _) = side_axes(side);
        let (_, sign) = side_axes(next);
        let mut row = self.middle[axis];
        loop {
            let at = frame_place(self.middle, side, row, paths[0][row]);
            let other_row = at[1 - axis];
            let other = frame_place(self.middle, next, other_row, paths[1][other_row])[axis];
            if sign * (row as isize - other as isize) >= 0 {
                return Some([row, other_row]);
            }
            row = row
                .checked_add_signed(sign)
                .filter(|row| *row < paths[0].len())?;
        }
    }

    /// Finds the outline around the print that is seen best, and its score from 0 to 1: the geometric mean over its edges of
    /// their strength, less what continues beyond the corners, and of its likeness to a page by shape and the share of the print within.
    /// Paper is smooth and crumpled ground is not, but some pages are crumpled, too: both kinds of paths are tried.
    pub fn best_outline(&self, print: &Print) -> Option<(f64, Arcs)> {
        [true, false]
            .into_iter()
            .filter_map(|is_smooth| self.outline_by_paths(is_smooth, print))
            .max_by(|one, other| one.0.total_cmp(&other.0))
    }

    /// Finds the best outline of those that the paths of one kind make.
    fn outline_by_paths(&self, is_smooth: bool, print: &Print) -> Option<(f64, Arcs)> {
        let paths = (self.sides.each_ref()).map(|side| side.best_paths(is_smooth));
        let mut best: Option<(f64, Arcs)> = None;
        for n in 0..PATHS_PER_SIDE.pow(4) {
            let chosen: [&[usize]; 4] = std::array::from_fn(|k| {
                &paths[k][n / PATHS_PER_SIDE.pow(k as u32) % PATHS_PER_SIDE][..]
            });
            let meet = |k: usize| self.meeting([(k + 3) % 4, k], [chosen[(k + 3) % 4], chosen[k]]);
            let (Some(a), Some(b), Some(c), Some(d)) = (meet(0), meet(1), meet(2), meet(3)) else {
                continue;
            };
            let corners = [a, b, c, d];
            let mut worth = 1.0;
            let arcs = [0, 1, 2, 3].map(|k| {
                let (side, path) = (&self.sides[k], chosen[k]);
                let (from, to) = (corners[k][1], corners[(k + 1) % 4][0]);
                let (low, high) = (from.min(to), from.max(to));
                let reach = (CUT_END_LENGTH_SHARE * (high - low) as f64) as usize;
                let before = side.strength(path, low.saturating_sub(reach)..low);
                let after = side.strength(path, high..(high + reach).min(side.rows));
                let beyond = before.max(after);
                worth *= side.strength(path, low..high) * (1.0 - BEYOND_CORNER_PENALTY * beyond);
                let points = (low..=high).map(|row| self.point(k, row, path[row]));
                let mut arc: Vec<[f64; 2]> = points.collect();
                if from > to {
                    arc.reverse();
                }
                arc
            });
            let ends = arcs.each_ref().map(|arc| arc[0]);
            worth *= rectangularity(&ends) * print.share_within(&ends);
            if polygon_area(&ends) > 0.0 && best.as_ref().is_none_or(|(most, _)| worth > *most) {
                best = Some((worth, arcs));
            }
        }
        best.map(|(worth, arcs)| (worth.powf(0.25), arcs))
    }
}

/// Pixel of the frame of a place beside the print.
fn frame_place(middle: [usize; 2], side: usize, row: usize, place: usize) -> [usize; 2] {
    let (axis, sign) = side_axes(side);
    let mut at = [row; 2];
    at[1 - axis] = middle[1 - axis].wrapping_add_signed(sign * place as isize);
    at
}

/// Contrast in an image of `colours` across edges: `across` is the difference of a pixel's index to that of the next pixel
/// across. Returns how clear an edge is at each pixel, from 0 to 1, and the step of colour there in the same unit; none where
/// not `counts`.
fn contrast(
    colours: &[[f32; 3]],
    [width, height]: [usize; 2],
    across: usize,
    counts: impl Fn(usize) -> bool,
) -> (Vec<f32>, Vec<[f32; 3]>) {
    let along = width + 1 - across;
    let (len, margin) = (colours.len(), AVERAGING_RADIUS * along);
    let mut steps: Vec<[f32; 3]> = (0..len)
        .map(|i| {
            if i < across || i + across >= len || !counts(i) {
                return [0.0; 3];
            }
            [0, 1, 2].map(|k| colours[i + across][k] - colours[i - across][k])
        })
        .collect();
    let averaged = |i: usize, slope: f64| {
        let mut sum = [0.0_f32; 3];
        for k in (0..=2 * AVERAGING_RADIUS).step_by(2) {
            let shift = ((k as f64 - AVERAGING_RADIUS as f64) * slope).round() as isize;
            let j = (i + k * along - margin).wrapping_add_signed(shift * across as isize);
            let step = steps.get(j).copied().unwrap_or_default();
            (0..3).for_each(|c| sum[c] += step[c]);
        }
        sum.iter().fold(0.0_f32, |most, s| most.max(s.abs())) / (AVERAGING_RADIUS + 1) as f32
    };
    let mut strengths: Vec<f32> = (0..len)
        .map(|i| {
            if i < margin || i + margin >= len || !counts(i) {
                return 0.0;
            }
            let slopes = EDGE_SLOPES.iter().map(|slope| averaged(i, *slope));
            slopes.fold(0.0, f32::max)
        })
        .collect();
    let mut texture = strengths.clone();
    box_mean(&mut texture, width, height, TEXTURE_RADIUS);
    let mut share: Vec<f32> = (0..len).map(|i| f32::from(u8::from(counts(i)))).collect();
    box_mean(&mut share, width, height, TEXTURE_RADIUS);
    for (i, (texture, share)) in texture.iter().zip(&share).enumerate() {
        let unit = CLEAR_EDGE_RATIO * (texture / share.max(0.1) + MIN_TEXTURE);
        strengths[i] = (strengths[i] / unit).min(1.0);
        steps[i] = steps[i].map(|step| step / unit);
    }
    (strengths, steps)
}
