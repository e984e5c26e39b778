//! Quadrilaterals of straight lines of contrast (Hough transform), for pages on a background of their own colour.

use super::corners::{is_convex, is_outside};
use super::planes::Planes;
use super::print_cells::PrintCells;
use super::quadrilateral::rectangularity;
use crate::math::planar::{cross, distance, line_intersection, polygon_area};
use crate::math::statistics::median;
use crate::page::text::ranking::ranked;

/// Number of directions of lines in the Hough transform: one for each degree.
const LINE_DIRECTIONS: usize = 180;

/// Minimum number of votes in the Hough transform for a line.
const MIN_LINE_VOTES: f32 = 8.0;

/// Number of directions on either side of a pixel's own direction for which it votes in the Hough transform, because
/// gradients are noisy.
const VOTED_DIRECTIONS: usize = 2;

/// Difference of direction, in degrees, below which two lines may be the same.
const SAME_LINE_DEGREES: usize = 4;

/// Distance, in pixels, below which two lines of nearly equal direction are the same.
const SAME_LINE_DISTANCE: usize = 5;

/// Maximum number of lines that are combined to quadrilaterals; the cost is the fourth power of this.
const MAX_COMBINED_LINES: usize = 64;

/// Minimum gradient of an edge pixel, as a multiple of the image's median gradient.
const MIN_GRADIENT_RATIO: f64 = 3.0;

/// Minimum gradient of an edge pixel, in logarithmic colour per pixel: about the noise of a reduced photo.
const MIN_GRADIENT: f32 = 0.006;

/// Distance from a line, in pixels, within which an edge pixel supports it, so that slightly bent edges support
/// straight lines.
const LINE_RADIUS: i32 = 2;

/// Minimum cosine of the angle between an edge pixel's gradient and the normal of the line that it supports.
const MIN_ALIGNMENT: f32 = 0.9;

/// Support of a side along the photo's rim, from 0 to 1: a page may reach beyond the photo, but a side that is seen is
/// better.
const RIM_SUPPORT: f64 = 0.25;

/// Minimum share of the length of each of a quadrilateral's sides along which there are edge pixels.
const MIN_SIDE_SUPPORT: f64 = 0.45;

/// Length beyond a corner over which it is measured whether a side continues, as a share of the side.
const BEYOND_CORNER_SHARE: f64 = 0.12;

/// Penalty of a side that continues with full support beyond a corner, as do joints of tiles and folds of a page; from
/// 0 to 1.
const BEYOND_CORNER_PENALTY: f64 = 0.8;

/// Minimum sine of the angle between neighbouring sides of a page's quadrilateral.
const MIN_SIDE_SINE: f64 = 0.75;

/// Maximum sine of the angle between opposite sides of a page's quadrilateral.
const MAX_OPPOSITE_SINE: f64 = 0.5;

/// Gradients of an image: at each pixel the gradient of the colour channel in which it is largest; none at print.
struct Gradients {
    width: usize,
    height: usize,
    vectors: Vec<[f32; 2]>,
    threshold: f32,
}

impl Gradients {
    fn new(raw: &Planes, print: &PrintCells) -> Self {
        let (width, height) = (raw.width, raw.height);
        let mut vectors = vec![[0.0_f32; 2]; raw.len()];
        let square = |v: [f32; 2]| v[0] * v[0] + v[1] * v[1];
        for plane in &raw.channels {
            for y in 1..height.saturating_sub(1) {
                for x in 1..width.saturating_sub(1) {
                    let i = y * width + x;
                    // Sobel's filter.
                    let at = |dx: isize, dy: isize| {
                        plane[i.wrapping_add_signed(dy * width as isize + dx)]
                    };
                    let side = |dx: isize| at(dx, -1) + 2.0 * at(dx, 0) + at(dx, 1);
                    let row = |dy: isize| at(-1, dy) + 2.0 * at(0, dy) + at(1, dy);
                    let vector = [(side(1) - side(-1)) / 8.0, (row(1) - row(-1)) / 8.0];
                    if square(vector) > square(vectors[i]) {
                        vectors[i] = vector;
                    }
                }
            }
        }
        let mut sizes: Vec<f64> = (vectors.iter().step_by(7))
            .map(|v| f64::from(square(*v).sqrt()))
            .collect();
        let usual = median(&mut sizes).unwrap_or(0.0);
        for (i, vector) in vectors.iter_mut().enumerate() {
            if print.is_at_print([2 * (i % width), 2 * (i / width)]) {
                *vector = [0.0; 2];
            }
        }
        Gradients {
            width,
            height,
            vectors,
            threshold: ((MIN_GRADIENT_RATIO * usual) as f32).max(MIN_GRADIENT),
        }
    }

    /// Whether there is an edge pixel within two pixels of a point, along the unit vector `[nx, ny]`, whose gradient
    /// has about that direction.
    fn has_edge(&self, [x, y]: [f64; 2], [nx, ny]: [f32; 2]) -> bool {
        (-LINE_RADIUS..=LINE_RADIUS).any(|k| {
            let (col, row) = (
                (x + f64::from(nx) * f64::from(k)).round(),
                (y + f64::from(ny) * f64::from(k)).round(),
            );
            if col < 0.0 || row < 0.0 || col >= self.width as f64 || row >= self.height as f64 {
                return false;
            }
            let i = row as usize * self.width + col as usize;
            let [gx, gy] = self.vectors[i];
            let along = (gx * nx + gy * ny).abs();
            along > self.threshold && along > MIN_ALIGNMENT * (gx * gx + gy * gy).sqrt()
        })
    }
}

/// A line across the image, with the number of edge pixels along it.
struct Line {
    ends: [[f64; 2]; 2],
    /// Prefix sums: number of edge pixels along the line before each place, for places one pixel apart. None for a side of
    /// the photo.
    sums: Option<Vec<u32>>,
}

impl Line {
    /// Makes the part within the image of the line `x cos φ + y sin φ = offset`, with φ = `degrees`; `None` if the line
    /// does not cross the image.
    fn new(gradients: &Gradients, degrees: usize, offset: f64) -> Option<Self> {
        let (sin, cos) = (degrees as f64).to_radians().sin_cos();
        let (width, height) = (gradients.width as f64 - 1.0, gradients.height as f64 - 1.0);
        // The range of the parameter along (−sin, cos) inside of the image.
        let (mut from, mut to) = (f64::MIN, f64::MAX);
        for (start, step, size) in [(offset * cos, -sin, width), (offset * sin, cos, height)] {
            if step.abs() < 1e-9 {
                if !(0.0..=size).contains(&start) {
                    return None;
                }
            } else {
                let (a, b) = (-start / step, (size - start) / step);
                from = from.max(a.min(b));
                to = to.min(a.max(b));
            }
        }
        if to - from < 2.0 {
            return None;
        }
        let at = |t: f64| [offset * cos - t * sin, offset * sin + t * cos];
        let normal = [cos as f32, sin as f32];
        let mut sums = vec![0];
        for i in 0..(to - from) as usize {
            let hit = gradients.has_edge(at(from + i as f64 + 0.5), normal);
            sums.push(sums[i] + u32::from(hit));
        }
        Some(Line {
            ends: [at(from), at(to)],
            sums: Some(sums),
        })
    }

    fn direction(&self) -> [f64; 2] {
        let [a, b] = self.ends;
        let length = distance(a, b);
        [(b[0] - a[0]) / length, (b[1] - a[1]) / length]
    }

    /// Position along the line of the point on it that is nearest to `point`, in pixels from the line's start.
    fn place(&self, point: [f64; 2]) -> f64 {
        let d = self.direction();
        (point[0] - self.ends[0][0]) * d[0] + (point[1] - self.ends[0][1]) * d[1]
    }

    /// Share of the places along the line between positions `from` and `to` that have an edge pixel; only places in the
    /// image count, and 0 is returned if there are none.
    fn support(&self, from: f64, to: f64) -> f64 {
        let Some(sums) = &self.sums else {
            return 0.0;
        };
        let last = sums.len() - 1;
        let clamp = |t: f64| t.clamp(0.0, last as f64) as usize;
        let (i, j) = (clamp(from.min(to)), clamp(from.max(to)));
        if j > i {
            f64::from(sums[j] - sums[i]) / (j - i) as f64
        } else {
            0.0
        }
    }
}

/// Finds the lines with the most edge pixels along them, by the Hough transform, and the four sides of the
/// photo.
fn find_lines(gradients: &Gradients) -> Vec<Line> {
    let diagonal = (gradients.width as f64).hypot(gradients.height as f64);
    let offsets = 2 * diagonal as usize + 3;
    let middle = diagonal as usize + 1;
    let mut votes = vec![0.0_f32; LINE_DIRECTIONS * offsets];
    let turns: Vec<[f32; 2]> = (0..LINE_DIRECTIONS)
        .map(|k| {
            let (sin, cos) = (k as f64).to_radians().sin_cos();
            [cos as f32, sin as f32]
        })
        .collect();
    for (i, [gx, gy]) in gradients.vectors.iter().enumerate() {
        let size = (gx * gx + gy * gy).sqrt();
        if size <= gradients.threshold {
            continue;
        }
        let (x, y) = ((i % gradients.width) as f32, (i / gradients.width) as f32);
        let angle = f64::from(*gy).atan2(f64::from(*gx)).to_degrees();
        let degrees = (angle + 180.5) as usize % LINE_DIRECTIONS;
        for k in 0..=2 * VOTED_DIRECTIONS {
            let direction = (degrees + LINE_DIRECTIONS + k - VOTED_DIRECTIONS) % LINE_DIRECTIONS;
            let [cos, sin] = turns[direction];
            let offset = (x * cos + y * sin + middle as f32 + 0.5) as usize;
            votes[direction * offsets + offset] += 1.0;
        }
    }
    let peaks: Vec<usize> = (0..votes.len())
        .filter(|i| votes[*i] >= MIN_LINE_VOTES)
        .collect();
    let fewness: Vec<f64> = peaks.iter().map(|i| -f64::from(votes[*i])).collect();
    let mut taken: Vec<(usize, usize)> = Vec::new();
    let mut lines = Vec::new();
    for peak in ranked(&fewness).into_iter().map(|k| peaks[k]) {
        let (direction, offset) = (peak / offsets, peak % offsets);
        let same = |(other, at): &(usize, usize)| {
            let turn = direction.abs_diff(*other);
            // A line turned by 180 degrees has the opposite offset.
            let (turn, at) = if turn > LINE_DIRECTIONS / 2 {
                (LINE_DIRECTIONS - turn, 2 * middle - at)
            } else {
                (turn, *at)
            };
            turn < SAME_LINE_DEGREES && at.abs_diff(offset) < SAME_LINE_DISTANCE
        };
        if taken.iter().any(same) {
            continue;
        }
        taken.push((direction, offset));
        lines.extend(Line::new(
            gradients,
            direction,
            offset as f64 - middle as f64,
        ));
        if lines.len() == MAX_COMBINED_LINES {
            break;
        }
    }
    let [right, bottom] = [gradients.width, gradients.height].map(|n| n as f64 - 1.0);
    let corners = [[0.0, 0.0], [right, 0.0], [right, bottom], [0.0, bottom]];
    lines.extend((0..4).map(|k| Line {
        ends: [corners[k], corners[(k + 1) % 4]],
        sums: None,
    }));
    lines
}

/// Finds the quadrilateral of four straight lines that is most like a page; returns its corners, clockwise, and how clearly
/// it is seen, from 0 to 1: the mean support of its sides times its likeness to a page by its print.
/// `raw` is the photo at half the reduced size, `print` the print in the reduced photo. `None` if no
/// quadrilateral has enough edge pixels along each side, or there is no print.
pub(super) fn best_line_quadrilateral(
    raw: &Planes,
    print: &PrintCells,
    min_area: f64,
) -> Option<([[f64; 2]; 4], f64)> {
    let gradients = Gradients::new(raw, print);
    let lines = find_lines(&gradients);
    let size = [raw.width, raw.height];
    let sine = |i: usize, j: usize| cross(lines[i].direction(), lines[j].direction()).abs();
    let mut opposite = Vec::new();
    for i in 0..lines.len() {
        for j in i + 1..lines.len() {
            if sine(i, j) < MAX_OPPOSITE_SINE {
                opposite.push([i, j]);
            }
        }
    }
    let margin = 0.03 * raw.longer_side();
    let mut best: Option<([[f64; 2]; 4], f64, f64)> = None;
    for (n, [a, c]) in opposite.iter().enumerate() {
        for [b, d] in &opposite[n + 1..] {
            let sides = [*a, *b, *c, *d];
            if (0..4).any(|k| sine(sides[k], sides[(k + 1) % 4]) < MIN_SIDE_SINE) {
                continue;
            }
            let meet = |k: usize| {
                line_intersection(lines[sides[(k + 3) % 4]].ends, lines[sides[k]].ends, 0.0)
            };
            let (Some(p), Some(q), Some(r), Some(s)) = (meet(0), meet(1), meet(2), meet(3)) else {
                continue;
            };
            let mut corners = [p, q, r, s];
            if corners.iter().any(|p| is_outside(*p, size, margin)) {
                continue;
            }
            let area = polygon_area(&corners).abs();
            if area < min_area {
                continue;
            }
            let mut worth = (area / raw.len() as f64).sqrt();
            let (mut least, mut mean) = (1.0_f64, 0.0);
            for k in 0..4 {
                let line = &lines[sides[k]];
                let (from, to) = (line.place(corners[k]), line.place(corners[(k + 1) % 4]));
                let own = match line.sums {
                    Some(_) => line.support(from, to),
                    None => RIM_SUPPORT,
                };
                let reach = BEYOND_CORNER_SHARE * (to - from);
                let beyond = line
                    .support(from - reach, from)
                    .max(line.support(to, to + reach));
                if line.sums.is_some() {
                    least = least.min(own);
                }
                mean += 0.25 * own;
                worth *= own * (1.0 - BEYOND_CORNER_PENALTY * beyond);
            }
            if least < MIN_SIDE_SUPPORT {
                continue;
            }
            if polygon_area(&corners) < 0.0 {
                corners.reverse();
            }
            // The print, which costs most, is counted only where it can matter.
            if is_convex(&corners) && best.is_none_or(|(_, other, _)| worth > other) {
                let in_photo = corners.map(|p| p.map(|at| 2.0 * at + 0.5));
                let printed = print.likeness(&in_photo);
                worth *= printed * rectangularity(&corners);
                if worth > 0.0 && best.is_none_or(|(_, other, _)| worth > other) {
                    best = Some((corners, worth, mean * printed));
                }
            }
        }
    }
    best.map(|(corners, _, clarity)| (corners, clarity))
}
