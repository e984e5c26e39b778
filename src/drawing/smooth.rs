//! Makes the outlines and folds found on the lattice smooth: straight pieces and curves between corners.

use super::curve::Curve;
use super::spline::fit_spline;
use crate::math::planar::{distance, nearest_on_segment, polyline_length};
use crate::pattern::Sheet;
use crate::unroll::flat_triangle::Point;
use crate::unroll::overlap::crossings;

/// Distance between the sample points of an outline to which curves are fitted, in lattice spacings.
const SAMPLE_DISTANCE_SPACINGS: f64 = 0.25;

/// Minimum angle of a corner of an outline, in radians: between the line's directions before and after it.
const CORNER_ANGLE: f64 = 0.44;

/// Length of an outline before and after a corner, in lattice spacings, over which the corner's angle is measured.
const CORNER_ARM_SPACINGS: f64 = 4.0;

/// Minimum share of a corner's angle that remains when it is measured over half the length before and after it; at a
/// smooth bend half of the angle remains.
const CORNER_CONCENTRATION: f64 = 0.62;

/// Minimum length of an outline's piece that is smoothed, in lattice spacings.
const MIN_SMOOTHED_LENGTH_SPACINGS: f64 = 3.0;

/// Minimum length of a span of the fitted spline, in lattice spacings.
const MIN_SPAN_SPACINGS: f64 = 1.5;

/// Root mean square distance of a fitted curve from the sample points, in lattice spacings, below which the fit counts
/// as exact.
const NEGLIGIBLE_RESIDUAL_SPACINGS: f64 = 0.03;

/// Tolerances of a smooth line, as shares of [`DrawingOptions::smoothing`](super::DrawingOptions::smoothing), tried in
/// this order: the next is used where the line crosses another or itself.
const TOLERANCE_SHARES: [f64; 4] = [1.0, 0.5, 0.2, 0.0];

/// The smooth outlines and folds of one sheet, in the surface's units.
pub(super) struct Smooth {
    /// The sheet's outlines, each as a list of smooth curves, one for each run (piece along one side of a crease or
    /// along the border).
    pub outlines: Vec<Vec<Curve>>,
    pub folds: Vec<Curve>,
}

/// Makes a sheet's outlines and folds smooth, within a tolerance in lattice spacings. Ends of an outline's runs (pieces
/// along one crease each) keep their positions, so that the two sides of a seam keep common ends. Smoothing adds no
/// intersections of outlines.
pub(super) fn smooth_lines(sheet: &Sheet, tolerance: f64) -> Smooth {
    let spacing = sheet.spacing;
    let runs: Vec<&[[f64; 2]]> = (sheet.outlines.iter().flatten())
        .map(|run| &run.points[..])
        .collect();
    let mut levels = vec![0; runs.len()];
    let mut curves: Vec<Curve> = (runs.iter())
        .map(|run| smooth(run, tolerance * spacing, spacing))
        .collect();
    loop {
        let wrong = crossing_curves(&curves, spacing);
        let mut changed = false;
        for run in wrong {
            if levels[run] + 1 < TOLERANCE_SHARES.len() {
                levels[run] += 1;
                let tolerance = TOLERANCE_SHARES[levels[run]] * tolerance;
                curves[run] = smooth(runs[run], tolerance * spacing, spacing);
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
    let folds = (sheet.folds.iter())
        .map(|fold| {
            smooth(
                &extend_fold(&fold.points, &curves, tolerance * spacing),
                tolerance * spacing,
                spacing,
            )
        })
        .collect();
    let mut curves = curves.into_iter();
    let outlines = (sheet.outlines.iter())
        .map(|outline| curves.by_ref().take(outline.len()).collect())
        .collect();
    Smooth { outlines, folds }
}

/// Finds the curves that cross each other or themselves; returns their indices.
pub(super) fn crossing_curves(curves: &[Curve], spacing: f64) -> Vec<usize> {
    let (mut places, mut edges, mut owners) = (Vec::new(), Vec::new(), Vec::new());
    for (owner, curve) in curves.iter().enumerate() {
        for p in curve.points(0.02 * spacing).windows(2) {
            // Divide curves into short segments, because the index compares these faster.
            let steps = (distance(p[0], p[1]) / (4.0 * spacing)).ceil().max(1.0);
            let at = |i: f64| {
                Point::new(p[0][0], p[0][1]) * (1.0 - i / steps)
                    + Point::new(p[1][0], p[1][1]) * (i / steps)
            };
            for i in 0..steps as usize {
                let from = places.len() as u32;
                places.extend([at(i as f64), at(i as f64 + 1.0)]);
                edges.push([from, from + 1]);
                owners.push(owner);
            }
        }
    }
    let touch = |a: usize, b: usize| {
        let ends = |e: usize| edges[e].map(|v| places[v as usize]);
        ends(a)
            .iter()
            .any(|p| ends(b).iter().any(|q| (p - q).norm() < 1e-9 * spacing))
    };
    let pairs = crossings(&places, &edges).into_iter();
    let mut wrong: Vec<usize> = pairs
        .filter(|[a, b]| !touch(*a, *b))
        .flat_map(|pair| pair.map(|edge| owners[edge]))
        .collect();
    wrong.sort_unstable();
    wrong.dedup();
    wrong
}

/// Moves the ends of a fold onto the sheet's smooth outline, if the ends are near the outline.
fn extend_fold(points: &[[f64; 2]], outlines: &[Curve], tolerance: f64) -> Vec<[f64; 2]> {
    let mut out = points.to_vec();
    let last = out.len() - 1;
    if out[0] == out[last] {
        return out;
    }
    for end in [0, last] {
        let nearest = outlines.iter().flat_map(|curve| {
            let points = curve.points(0.01 * tolerance.max(f64::MIN_POSITIVE));
            let feet: Vec<[f64; 2]> = points
                .windows(2)
                .map(|p| nearest_on_segment(out[end], [p[0], p[1]]))
                .collect();
            feet
        });
        let nearest =
            nearest.min_by(|p, q| distance(*p, out[end]).total_cmp(&distance(*q, out[end])));
        if let Some(place) = nearest.filter(|p| distance(*p, out[end]) <= 1.5 * tolerance) {
            out[end] = place;
        }
    }
    out
}

/// A sample point of a line that is smoothed: its position, its distance along the line, and whether it is one of the
/// line's given points.
#[derive(Clone, Copy)]
struct Sample {
    along: f64,
    place: Point,
    given: bool,
}

/// Fits a smooth curve within a tolerance to a polyline; a closed polyline repeats its first point at the end.
pub(crate) fn smooth(points: &[[f64; 2]], tolerance: f64, spacing: f64) -> Curve {
    if tolerance <= 0.0 || polyline_length(points) < MIN_SMOOTHED_LENGTH_SPACINGS * spacing {
        return Curve::through(points);
    }
    let closed = points.len() > 3 && points[0] == points[points.len() - 1];
    let mut line = samples(points, SAMPLE_DISTANCE_SPACINGS * spacing);
    let mut corners = corners(&line, closed, spacing);
    if closed {
        let Some(first) = corners.first().copied() else {
            return section(&line, true, tolerance, spacing)
                .unwrap_or_else(|| Curve::through(points));
        };
        // Begin at a corner.
        line = rotated(&line, first);
        let ring = line.len() - 1;
        for corner in &mut corners {
            *corner -= first;
        }
        corners.push(ring);
    } else {
        corners.insert(0, 0);
        corners.push(line.len() - 1);
    }
    let sections = || corners.windows(2).map(|ends| &line[ends[0]..=ends[1]]);
    let mut curves: Vec<Option<Curve>> = sections()
        .map(|own| section(own, false, tolerance, spacing))
        .collect();
    // The corner between two straight pieces is their intersection, even if the lattice has cut it off.
    let count = curves.len();
    let straight: Vec<Option<[Point; 2]>> = sections()
        .zip(&curves)
        .map(|(own, curve)| {
            let plain = curve.as_ref().is_some_and(|c| {
                c.controls().len() == 4
                    && c.pieces()
                        .all(|p| matches!(p, super::curve::Piece::Line(_)))
            });
            plain.then(|| axis(own))
        })
        .collect();
    let mut ends: Vec<[f64; 2]> = corners.iter().map(|i| pair(line[*i].place)).collect();
    for k in 0..count {
        let next = match k + 1 < count {
            true => k + 1,
            false if closed => 0,
            false => continue,
        };
        if let (Some(a), Some(b)) = (straight[k], straight[next]) {
            let corner = line[corners[k + 1]].place;
            let near = |p: &Point| (p - corner).norm() <= 1.5 * tolerance;
            if let Some(place) = meeting(a, b).filter(near) {
                ends[k + 1] = pair(place);
                if next == 0 {
                    ends[0] = pair(place);
                }
            }
        }
    }
    let mut out = Curve::of(vec![ends[0]]);
    for (k, own) in sections().enumerate() {
        match (straight[k], curves[k].take()) {
            (Some(_), _) => out.line_to(ends[k + 1]),
            (_, Some(curve)) => out.append(&curve),
            // No spline is within the tolerance: keep the polyline.
            _ => own
                .iter()
                .skip(1)
                .filter(|s| s.given)
                .for_each(|s| out.line_to(pair(s.place))),
        }
    }
    out
}

fn section(line: &[Sample], closed: bool, tolerance: f64, spacing: f64) -> Option<Curve> {
    let points: Vec<(f64, Point)> = line.iter().map(|s| (s.along, s.place)).collect();
    fit_spline(
        &points,
        closed,
        tolerance,
        NEGLIGIBLE_RESIDUAL_SPACINGS * spacing,
        MIN_SPAN_SPACINGS * spacing,
    )
}

fn samples(points: &[[f64; 2]], step: f64) -> Vec<Sample> {
    let at = |[x, y]: [f64; 2]| Point::new(x, y);
    let mut along = 0.0;
    let mut out = vec![Sample {
        along,
        place: at(points[0]),
        given: true,
    }];
    for p in points.windows(2) {
        let (from, to) = (at(p[0]), at(p[1]));
        let long = (to - from).norm();
        if long == 0.0 {
            continue;
        }
        let steps = (long / step).ceil().max(1.0) as usize;
        out.extend((1..=steps).map(|i| {
            let share = i as f64 / steps as f64;
            let place = if i == steps {
                to
            } else {
                from + (to - from) * share
            };
            Sample {
                along: along + share * long,
                place,
                given: i == steps,
            }
        }));
        along += long;
    }
    out
}

/// Rotates the list of a closed line's samples so that it begins at sample `first`.
fn rotated(line: &[Sample], first: usize) -> Vec<Sample> {
    let last = line.len() - 1;
    let whole = line[last].along;
    let start = line[first].along;
    let shifted = |s: &Sample, by: f64| Sample {
        along: s.along - start + by,
        ..*s
    };
    let before = line[first..].iter().map(|s| shifted(s, 0.0));
    before
        .chain(line[1..=first].iter().map(|s| shifted(s, whole)))
        .collect()
}

/// Finds the samples at corners of a line; returns their indices, ascending, without the ends of an open line.
fn corners(line: &[Sample], closed: bool, spacing: f64) -> Vec<usize> {
    let last = line.len() - 1;
    let whole = line[last].along;
    let turn = |i: usize, arm: f64| -> f64 {
        let [back, on] = [-1.0, 1.0].map(|way| heading(line, i, way * arm, closed));
        match (back, on) {
            (Some(back), Some(on)) => ((-back).conj() * on).arg().abs(),
            _ => 0.0,
        }
    };
    let end = |i: usize| {
        !closed
            && (line[i].along < 0.5 * MIN_SMOOTHED_LENGTH_SPACINGS * spacing
                || whole - line[i].along < 0.5 * MIN_SMOOTHED_LENGTH_SPACINGS * spacing)
    };
    let turns: Vec<f64> = (0..last)
        .map(|i| {
            if end(i) {
                0.0
            } else {
                turn(i, CORNER_ARM_SPACINGS * spacing)
            }
        })
        .collect();
    let apart = |i: usize, k: usize| {
        let d = (line[i].along - line[k].along).abs();
        if closed { d.min(whole - d) } else { d }
    };
    let mut order: Vec<usize> = (0..last).filter(|i| turns[*i] > CORNER_ANGLE).collect();
    order.sort_by(|a, b| turns[*b].total_cmp(&turns[*a]));
    let mut found: Vec<usize> = Vec::new();
    for i in order {
        if found
            .iter()
            .any(|k| apart(i, *k) < 0.75 * CORNER_ARM_SPACINGS * spacing)
        {
            continue;
        }
        // Corners are given points of the line.
        let near = (0..last).filter(|k| line[*k].given && !end(*k) && apart(i, *k) < spacing);
        let corner = near
            .max_by(|a, b| turns[*a].total_cmp(&turns[*b]))
            .unwrap_or(i);
        if turn(corner, 0.5 * CORNER_ARM_SPACINGS * spacing) > CORNER_CONCENTRATION * turns[i] {
            found.push(corner);
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// Computes the direction of a line after one of its samples, or before it for a negative `arm`: that of the
/// least-squares line through the samples within the length `arm`.
fn heading(line: &[Sample], i: usize, arm: f64, closed: bool) -> Option<Point> {
    let last = line.len() - 1;
    let whole = line[last].along;
    let step = if arm > 0.0 { 1 } else { last - 1 };
    let mut count = 0.0;
    let (mut s1, mut s2, mut p1, mut sp) = (0.0, 0.0, Point::new(0.0, 0.0), Point::new(0.0, 0.0));
    let mut k = i;
    for _ in 0..last {
        let mut s = line[k].along - line[i].along;
        if closed && s * arm < 0.0 {
            s += whole * arm.signum();
        }
        if s.abs() > arm.abs() || (!closed && s * arm < 0.0) {
            break;
        }
        let place = line[k].place;
        (count, s1, s2, p1, sp) = (count + 1.0, s1 + s, s2 + s * s, p1 + place, sp + place * s);
        if !closed && ((arm > 0.0 && k == last) || (arm < 0.0 && k == 0)) {
            break;
        }
        k = match closed {
            true => (k + step) % last,
            false if arm > 0.0 => k + 1,
            false => k - 1,
        };
    }
    let spread = s2 - s1 * s1 / count;
    (count > 2.0 && spread > 0.0).then(|| (sp - p1 * (s1 / count)) * arm.signum())
}

/// Fits the least-squares line to samples, and returns two points on it.
fn axis(line: &[Sample]) -> [Point; 2] {
    let count = line.len() as f64;
    let middle = line.iter().map(|s| s.place).sum::<Point>() / count;
    // Squares of complex numbers, so that opposite directions count as one.
    let square: Point = line
        .iter()
        .map(|s| (s.place - middle) * (s.place - middle))
        .sum();
    let along = square.sqrt();
    [middle, middle + along / along.norm().max(f64::MIN_POSITIVE)]
}

/// Computes the intersection of two straight lines; `None` where they are nearly parallel.
fn meeting([p, q]: [Point; 2], [r, s]: [Point; 2]) -> Option<Point> {
    let (u, v) = (q - p, s - r);
    let cross = (u.conj() * v).im;
    (cross.abs() > 0.2 * u.norm() * v.norm()).then(|| p + u * (((r - p).conj() * v).im / cross))
}

fn pair(place: Point) -> [f64; 2] {
    [place.re, place.im]
}
