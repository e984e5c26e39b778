//! Makes the outlines and folds found on the lattice smooth: straight pieces and curves between corners.

use super::border_side::{MAX_STRAIGHTENING_TOLERANCES, axis, is_straight_side, side_ends};
use super::curve::Curve;
use super::line_corners::{MIN_SMOOTHED_LENGTH_SPACINGS, Sample, corners, rotated, samples};
use super::spline::fit_spline;
use crate::math::planar::{distance, line_intersection, nearest_on_segment, polyline_length};
use crate::pattern::{Run, Sheet};
use crate::unroll::flat_triangle::Point;
use crate::unroll::overlap::crossings;

/// Distance between the sample points of an outline to which curves are fitted, in lattice spacings.
const SAMPLE_DISTANCE_SPACINGS: f64 = 0.25;

/// Minimum length of a span of the fitted spline, in lattice spacings. `benches/patterns.md` has what others give.
const MIN_SPAN_SPACINGS: f64 = 1.5;

/// Root mean square distance of a fitted curve from the sample points, in lattice spacings, below which the fit counts
/// as exact. `benches/patterns.md` has what others give.
const NEGLIGIBLE_RESIDUAL_SPACINGS: f64 = 0.03;

/// Maximum distance of the intersection of two sides of the surface's border from the corner that it replaces, as a multiple
/// of the tolerance: the lattice may have cut off a cell there.
const MAX_SIDE_CORNER_TOLERANCES: f64 = 4.0;

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
    let runs: Vec<&Run> = sheet.outlines.iter().flatten().collect();
    let smooth_run = |run: &Run, tolerance: f64| {
        let is_border = run.seam.is_none();
        smooth_line(&run.points, tolerance * spacing, spacing, is_border)
    };
    let mut levels = vec![0; runs.len()];
    let mut curves: Vec<Curve> = (runs.iter())
        .map(|run| smooth_run(run, tolerance))
        .collect();
    loop {
        let wrong = crossing_curves(&curves, spacing);
        let mut changed = false;
        for run in wrong {
            if levels[run] + 1 < TOLERANCE_SHARES.len() {
                levels[run] += 1;
                curves[run] = smooth_run(runs[run], TOLERANCE_SHARES[levels[run]] * tolerance);
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

/// Fits a smooth curve within a tolerance to a polyline; a closed polyline repeats its first point at the end.
pub(crate) fn smooth(points: &[[f64; 2]], tolerance: f64, spacing: f64) -> Curve {
    smooth_line(points, tolerance, spacing, false)
}

/// Fits a smooth curve within a tolerance to a polyline, as [`smooth`] does; sides of the surface's border that are
/// straight but for the lattice's steps become straight lines.
fn smooth_line(points: &[[f64; 2]], tolerance: f64, spacing: f64, is_border: bool) -> Curve {
    if tolerance <= 0.0 || polyline_length(points) < MIN_SMOOTHED_LENGTH_SPACINGS * spacing {
        return Curve::through(points);
    }
    let closed = points.len() > 3 && points[0] == points[points.len() - 1];
    let mut line = samples(points, SAMPLE_DISTANCE_SPACINGS * spacing);
    let mut corners = corners(&line, closed, spacing);
    let mut ends = match is_border {
        true => side_ends(&line, &corners, closed, spacing),
        false => Vec::new(),
    };
    let last = line.len() - 1;
    if closed {
        let Some(first) = ends.first().or(corners.first()).copied() else {
            return section(&line, true, tolerance, spacing)
                .unwrap_or_else(|| Curve::through(points));
        };
        // Begin at a corner, at the end of a side if there is one.
        line = rotated(&line, first);
        for list in [&mut corners, &mut ends] {
            for corner in list.iter_mut() {
                *corner = (*corner + last - first) % last;
            }
            list.sort_unstable();
        }
        corners.push(last);
    } else {
        corners.insert(0, 0);
        corners.push(last);
        ends.insert(0, 0);
    }
    ends.push(last);
    let sides: Vec<[usize; 2]> = (ends.windows(2).map(|pair| [pair[0], pair[1]]))
        .filter(|[from, to]| is_border && is_straight_side(&line[*from..=*to], tolerance, spacing))
        .collect();
    corners.retain(|i| !sides.iter().any(|[from, to]| from < i && i < to));
    let sections = || corners.windows(2).map(|ends| &line[ends[0]..=ends[1]]);
    let mut curves: Vec<Option<Curve>> = sections()
        .zip(corners.windows(2))
        .map(
            |(own, ends)| match sides.iter().any(|side| side[..] == *ends) {
                true => Some(Curve::through(&[
                    pair(own[0].place),
                    pair(own[own.len() - 1].place),
                ])),
                false => section(own, false, tolerance, spacing),
            },
        )
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
    // Fewer than three straight pieces enclose no area.
    if closed && count < 3 && straight.iter().all(Option::is_some) {
        return Curve::through(points);
    }
    let mut ends: Vec<[f64; 2]> = corners.iter().map(|i| pair(line[*i].place)).collect();
    for k in 0..count {
        let next = match k + 1 < count {
            true => k + 1,
            false if closed => 0,
            false => continue,
        };
        if let (Some(a), Some(b)) = (straight[k], straight[next]) {
            let corner = line[corners[k + 1]].place;
            let is_side = |k: usize| sides.contains(&[corners[k], corners[k + 1]]);
            let reach = match is_side(k) || is_side(next) {
                true => MAX_SIDE_CORNER_TOLERANCES,
                false => MAX_STRAIGHTENING_TOLERANCES,
            };
            let near = |p: &Point| (p - corner).norm() <= reach * tolerance;
            if let Some(place) = line_intersection(a, b, 0.0).filter(near) {
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

fn pair(place: Point) -> [f64; 2] {
    [place.re, place.im]
}

#[cfg(test)]
mod tests {
    use super::super::curve::Piece;
    use super::*;

    /// A rectangle's border with a tooth of the lattice every `pitch` along one of its long sides, turned by an angle.
    fn rectangle(wide: f64, high: f64, pitch: f64, depth: f64, angle: f64) -> Vec<[f64; 2]> {
        let mut points = vec![[0.0, 0.0]];
        points.extend((1..=wide as usize).map(|i| [i as f64, 0.0]));
        let teeth = (high / pitch) as usize;
        for k in 0..teeth {
            // Along the side the border leans outwards, and steps back by one edge of the lattice.
            points.extend((1..=pitch as usize).map(|i| {
                [
                    wide + depth * (i as f64 / pitch - 0.5),
                    k as f64 * pitch + i as f64 - 0.5,
                ]
            }));
            points.push([wide - 0.5 * depth, (k + 1) as f64 * pitch]);
        }
        points.extend((0..=wide as usize).map(|i| [wide - i as f64, high]));
        points.extend((1..=high as usize).map(|i| [0.0, high - i as f64]));
        let (sin, cos) = angle.sin_cos();
        (points.iter())
            .map(|[x, y]| [cos * x - sin * y, sin * x + cos * y])
            .collect()
    }

    #[test]
    fn a_rectangle_with_steps_along_a_side_has_four_straight_lines() {
        for (angle, depth) in [(0.0, 1.2), (0.4, 1.2), (2.0, 0.9)] {
            let border = rectangle(60.0, 80.0, 8.0, depth, angle);
            let curve = smooth_line(&border, 0.5, 1.0, true);
            let pieces: Vec<Piece> = curve.pieces().collect();
            assert_eq!(pieces.len(), 4, "{angle}, {depth}: {pieces:?}");
            let mut lengths: Vec<f64> = (pieces.iter())
                .map(|piece| match piece {
                    Piece::Line([p, q]) => distance(*p, *q),
                    Piece::Bezier(_) => f64::NAN,
                })
                .collect();
            lengths.sort_by(f64::total_cmp);
            // The sides keep their lengths but for a fraction of a cell.
            for (length, side) in lengths.iter().zip([60.0, 60.0, 80.0, 80.0]) {
                assert!((length - side).abs() < 0.5, "{lengths:?}");
            }
            // Within the sheet the same line is a crease, and stays as it is.
            assert!(smooth(&border, 0.5, 1.0).pieces().count() > 4);
        }
    }

    #[test]
    fn a_rectangle_of_few_long_edges_encloses_an_area() {
        // A roof of four strips, whose edges are about as long as the roof.
        let points = [0.0, 56.5, 135.8, 215.1, 271.6];
        let mut border: Vec<[f64; 2]> = points.iter().map(|x| [*x, 0.0]).collect();
        border.extend(points.iter().rev().map(|x| [*x, 220.4]));
        border.push([0.0, 0.0]);
        for spacing in 20..300 {
            let spacing = f64::from(spacing);
            for first in 0..10 {
                let mut turned = border[..10].to_vec();
                turned.rotate_left(first);
                turned.push(turned[0]);
                let points = smooth_line(&turned, 0.5 * spacing, spacing, true).points(1e-3);
                let doubled_area: f64 = (points.windows(2))
                    .map(|p| p[0][0] * p[1][1] - p[1][0] * p[0][1])
                    .sum();
                let share = 0.5 * doubled_area / (271.6 * 220.4);
                assert!(share > 0.9, "{spacing} {first}: {share}");
            }
        }
    }

    #[test]
    fn a_side_that_bends_stays_a_curve() {
        // An arc of which half a spacing rises above the chord, and one that rises by a spacing over ten times the length.
        for (long, rise) in [(40.0f64, 0.5), (400.0, 1.0)] {
            let border: Vec<[f64; 2]> = (0..=long as usize)
                .map(|i| {
                    let t = i as f64 / long;
                    [i as f64, 4.0 * rise * t * (1.0 - t)]
                })
                .collect();
            let curve = smooth_line(&border, 0.5, 1.0, true);
            assert!(curve.pieces().any(|p| matches!(p, Piece::Bezier(_))));
            let middle = curve.points(1e-3).iter().map(|p| p[1]).fold(0.0, f64::max);
            assert!((middle - rise).abs() < 0.1, "{middle}");
        }
    }

    #[test]
    fn a_narrow_hole_keeps_its_area() {
        for wide in [8.0, 20.0] {
            let mut hole = rectangle(wide, 1.0, 1.0, 0.0, 0.3);
            hole.dedup();
            let curve = smooth_line(&hole, 0.5, 1.0, true);
            let points = curve.points(1e-3);
            let twice: f64 = (points.windows(2))
                .map(|p| p[0][0] * p[1][1] - p[1][0] * p[0][1])
                .sum();
            assert!((0.5 * twice - wide).abs() < 0.4 * wide, "{wide}: {twice}");
        }
    }
}
