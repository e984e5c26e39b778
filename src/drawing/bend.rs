//! Applies the bend allowance of sheet metal to flat sheets: metal has a thickness and bends with a radius, so that the
//! flat length between two faces differs from what these have up to the crease.
//!
//! The bend allowance BA of a bend by an angle θ is the length of its neutral line, θ (r + k t), with the inner
//! radius r, the thickness t and the K-factor k. The bend begins at the setback S before the crease: r tan(θ/2) on
//! the inside of the bend, (r + t) tan(θ/2) on its outside. The surface is the upper side of the sheet: outside at
//! a mountain fold, inside at a valley fold. The strip within S of a fold, on either side, is therefore scaled to a
//! width of BA/2, and everything beyond is translated.

use super::options::DrawingOptions;
use crate::error::{Error, Result};
use crate::math::planar::{distance, nearest_on_segment, polygon_contains, polyline_length};
use crate::pattern::{Fold, Run, Sheet};
use crate::unroll::flat_triangle::Point;

/// Maximum distance of a fold's points from the straight line between the fold's ends, in lattice spacings, for a bend
/// allowance.
const MAX_FOLD_BOW_SPACINGS: f64 = 0.5;

/// Largest distance between a corner of the outline and the end of a fold there, as a share of the length of the fold that is bent.
const END_ROUNDING: f64 = 1e-6;

/// Largest distance of the pieces of a fold from one line, as a share of the length of one or of the distance of a bend's lines, and largest
/// difference of their angles and of those of parallel lines, as a share. No table chose it: they are equal up to rounding.
pub(super) const PIECE_ROUNDING: f64 = 1e-3;

/// Applies the bend allowance to all folds of a sheet; an error if a fold is not a straight line from edge to edge.
pub(super) fn apply_bend_allowance(
    number: usize,
    sheet: &Sheet,
    options: &DrawingOptions,
) -> Result<Sheet> {
    let mut out = sheet.clone();
    let Some(bending) = options.bending else {
        return Ok(out);
    };
    let mut is_applied = vec![false; sheet.folds.len()];
    for k in 0..sheet.folds.len() {
        let fold = out.folds[k].clone();
        if !fold.is_made() || is_applied[k] {
            continue;
        }
        if !is_straight(&fold, out.spacing) {
            return Err(Error::CurvedFold {
                sheet: number + 1,
                fold: k + 1,
            });
        }
        let (direction, angle) = (fold.seam.direction, fold.seam.angle);
        let zone = match fold.bend {
            Some(bend) => {
                let radii = [bend.radius, bend.chord_radius].map(|radius| options.scale * radius);
                bending.smooth_zone(direction, angle, radii)
            }
            None => bending.zone(direction, angle),
        };
        let zone = zone.map(|millimetres| millimetres / options.scale);
        let mut line = (vec![k], tips(&fold));
        let mut found = Bend::new(&out, &fold, line.1, zone);
        if found.is_err() {
            line = whole_line(&out, &fold);
            found = Bend::new(&out, &fold, line.1, zone);
        }
        let bend = found.map_err(|reason| Error::Unsupported {
            format: "pattern",
            reason: format!(
                "fold {} of sheet {} {reason}; without a thickness it is drawn as it is",
                k + 1,
                number + 1
            ),
        })?;
        for k in &line.0 {
            is_applied[*k] = true;
            out.area += polyline_length(&out.folds[*k].points) * 2.0 * (zone[1] - zone[0]);
        }
        bend.apply(&mut out, &line.0);
    }
    join_bends(&mut out);
    Ok(out)
}

/// Replaces the folds of each smooth bend by one in its middle.
fn join_bends(sheet: &mut Sheet) {
    let all = sheet.folds.clone();
    sheet.folds.retain_mut(|fold| {
        let Some(bend) = fold.bend else {
            return true;
        };
        if !bend.is_middle {
            return false;
        }
        // The middle between the outermost lines.
        let own = || {
            all.iter()
                .filter(|other| other.bend.is_some_and(|b| b.number == bend.number))
        };
        let [from, to] = tips(fold);
        let across = (to - from) / (to - from).norm() * Point::new(0.0, 1.0);
        let away = own().map(|other| (across.conj() * (point(&middle(&other.points)) - from)).re);
        let [low, high] = away.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], away| {
            [low.min(away), high.max(away)]
        });
        for place in &mut fold.points {
            let moved = point(place) + across * (0.5 * (low + high));
            *place = [moved.re, moved.im];
        }
        fold.seam.angle = bend.angle;
        true
    });
}

/// The folds along the line of a fold that turn as much, and the ends of the line: a hole divides it.
fn whole_line(sheet: &Sheet, fold: &Fold) -> (Vec<usize>, [Point; 2]) {
    let [from, to] = tips(fold);
    let along = (to - from) / (to - from).norm();
    let away = |tip: Point| along.conj() * (tip - from);
    let is_piece = |other: &Fold| {
        other.is_made()
            && other.seam.direction == fold.seam.direction
            && (other.seam.angle - fold.seam.angle).abs() <= PIECE_ROUNDING * fold.seam.angle
            && tips(other)
                .iter()
                .all(|tip| away(*tip).im.abs() <= PIECE_ROUNDING * (to - from).norm())
    };
    let pieces: Vec<usize> = (0..sheet.folds.len())
        .filter(|k| is_piece(&sheet.folds[*k]))
        .collect();
    let far = pieces
        .iter()
        .flat_map(|k| tips(&sheet.folds[*k]))
        .map(|tip| away(tip).re);
    let [low, high] = far.fold([f64::MAX, f64::MIN], |[low, high], far| {
        [low.min(far), high.max(far)]
    });
    (pieces, [low, high].map(|far| from + along * far))
}

/// The ends of a fold.
pub(super) fn tips(fold: &Fold) -> [Point; 2] {
    [fold.points[0], fold.points[fold.points.len() - 1]].map(|tip| point(&tip))
}

/// Whether all points of a fold are near the line between its ends.
fn is_straight(fold: &Fold, spacing: f64) -> bool {
    let ends = [fold.points[0], fold.points[fold.points.len() - 1]];
    let off = |p: &[f64; 2]| distance(*p, nearest_on_segment(*p, ends));
    (fold.points.iter()).all(|p| off(p) <= MAX_FOLD_BOW_SPACINGS * spacing)
}

/// The bend of a sheet of metal along one of the sheet's folds.
struct Bend {
    /// Positions of the fold's ends; `outline` is the number of the sheet's outline that both ends lie on.
    ends: [Point; 2],
    outline: usize,
    /// The two parts of the outline between the fold's ends, one on either side of the fold.
    sides: [Vec<Corner>; 2],
    setback: f64,
    half: f64,
}

/// A point of a sheet's outline, and the number of the run (piece of the outline) that the segment after the point
/// belongs to.
type Corner = (Point, usize);

impl Bend {
    /// The bend of a fold, whose line goes from edge to edge between two points.
    fn new(
        sheet: &Sheet,
        fold: &Fold,
        ends: [Point; 2],
        [setback, half]: [f64; 2],
    ) -> std::result::Result<Bend, &'static str> {
        let near = |p: Point, line: [Point; 2]| {
            let [x, y] = nearest_on_segment([p.re, p.im], line.map(|p| [p.re, p.im]));
            Point::new(x, y)
        };
        // Exact faces may leave room where their folds meet.
        let meets = |other: &Fold| {
            other.seam.crease != fold.seam.crease
                && tips(other).iter().any(|tip| tips(fold).contains(tip))
        };
        if !sheet.exact && sheet.folds.iter().any(meets) {
            return Err("meets another one, and a bend allowance needs folds from edge to edge");
        }
        // The nearest piece of an outline to each end.
        let nearest = |end: Point| {
            let outlines = sheet.outlines.iter().enumerate();
            let pieces = outlines.flat_map(|(number, outline)| {
                let line = ring(outline);
                let n = line.len();
                (0..n).map(move |k| (number, k, near(end, [line[k].0, line[(k + 1) % n].0])))
            });
            pieces.min_by(|a, b| (a.2 - end).norm().total_cmp(&(b.2 - end).norm()))
        };
        let (Some(from), Some(to)) = (nearest(ends[0]), nearest(ends[1])) else {
            return Err("is on no outline");
        };
        let far = |(_, _, p): (usize, usize, Point), end: Point| (p - end).norm() > sheet.spacing;
        if from.0 != to.0 || far(from, ends[0]) || far(to, ends[1]) {
            return Err(
                "does not part its sheet in two, and a bend allowance needs folds from edge to edge",
            );
        }
        let line = ring(&sheet.outlines[from.0]);
        let ends = [from.2, to.2];
        // Part of the outline from one end of the fold to the other.
        let arc = |(_, start, first): (usize, usize, Point),
                   (_, stop, last): (usize, usize, Point)| {
            let n = line.len();
            let count = (stop + n - start) % n;
            let mut arc = vec![(first, line[start].1)];
            arc.extend((1..=count).map(|k| line[(start + k) % n]));
            arc.push((last, line[stop].1));
            arc
        };
        let bend = Bend {
            ends,
            outline: from.0,
            sides: [arc(from, to), arc(to, from)],
            setback,
            half,
        };
        match [0, 1].iter().all(|side| bend.is_wide(*side)) {
            true => Ok(bend),
            false => Err("is nearer to an edge along it than its bend begins"),
        }
    }

    /// Returns the unit vector normal to the fold, towards one of the fold's two sides.
    fn normal(&self, side: usize) -> Point {
        // The sheet lies to the left of its outline, so that which begins at the fold's first end is to its right.
        let along = (self.ends[1] - self.ends[0]) / (self.ends[1] - self.ends[0]).norm();
        along * Point::new(0.0, if side == 0 { -1.0 } else { 1.0 })
    }

    fn away(&self, side: usize, place: Point) -> f64 {
        (self.normal(side).conj() * (place - self.ends[0])).re
    }

    /// Returns whether the outline on one side of the fold reaches beyond the zone in which the metal bends.
    fn is_wide(&self, side: usize) -> bool {
        let away = |corner: &Corner| self.away(side, corner.0);
        self.sides[side].iter().map(away).fold(0.0, f64::max) > self.setback
    }

    /// Computes the position that a point of the sheet has after the bend allowance was applied.
    fn moved(&self, side: usize, place: Point, is_beside: bool) -> Point {
        let away = self.away(side, place);
        let by = match is_beside && away < self.setback && self.setback > 0.0 {
            true => away.max(0.0) * (self.half / self.setback - 1.0),
            false => self.half - self.setback,
        };
        place + self.normal(side) * by
    }

    /// Moves all points of a sheet by the bend allowance, except those of the folds along its own line.
    fn apply(&self, sheet: &mut Sheet, own: &[usize]) {
        let arcs = [0, 1].map(|side| self.arc(side));
        let area =
            |side: usize| -> Vec<Point> { self.sides[side].iter().map(|(p, _)| *p).collect() };
        let areas = [0, 1].map(area);
        let side = |place: Point| match polygon_contains(&areas[0], place) {
            true => 0,
            false => 1,
        };
        let along = self.ends[1] - self.ends[0];
        let corners = [0, 1].map(|side| -> Vec<(Point, Point)> {
            let before = self.sides[side].iter().map(|(corner, _)| *corner);
            before.zip(self.moved_corners(side)).collect()
        });
        let to = |at: &[f64; 2], side: usize| {
            let place = point(at);
            let share = (along.conj() * (place - self.ends[0])).re / along.norm_sqr();
            // What ends at a corner of the outline goes with it.
            let near = END_ROUNDING * along.norm();
            let corner = corners[side]
                .iter()
                .find(|(corner, _)| (corner - place).norm() <= near);
            let moved = match corner {
                Some((_, moved)) => *moved,
                None => self.moved(side, place, (0.0..=1.0).contains(&share)),
            };
            [moved.re, moved.im]
        };
        for (number, outline) in sheet.outlines.iter_mut().enumerate() {
            if number == self.outline {
                rebuild(outline, &arcs.concat());
                continue;
            }
            for place in outline.iter_mut().flat_map(|run| &mut run.points) {
                *place = to(place, side(point(place)));
            }
        }
        for (k, fold) in sheet.folds.iter_mut().enumerate() {
            if !own.contains(&k) {
                let side = side(point(&middle(&fold.points)));
                fold.points
                    .iter_mut()
                    .for_each(|place| *place = to(place, side));
            } else if own.len() == 1 {
                fold.points = self.ends.map(|p| [p.re, p.im]).to_vec();
            }
        }
        for spot in &mut sheet.spots {
            spot.place = to(&spot.place, side(point(&spot.place)));
        }
    }

    /// The first and the last corner of the outline on one side of the fold beyond the zone that bends.
    fn beyond(&self, side: usize) -> [usize; 2] {
        let corners = &self.sides[side];
        let beyond = |(place, _): &Corner| self.away(side, *place) >= self.setback;
        let first = corners.iter().position(beyond).unwrap_or(0);
        [first, corners.iter().rposition(beyond).unwrap_or(0)]
    }

    /// The positions of the outline's corners on one side of the fold after the bend allowance was applied. Only the segments next to
    /// the fold's ends lie within the zone that bends.
    fn moved_corners(&self, side: usize) -> impl Iterator<Item = Point> {
        let [first, last] = self.beyond(side);
        let corners = self.sides[side].iter().enumerate();
        corners.map(move |(k, (place, _))| self.moved(side, *place, k < first || k > last))
    }

    /// Computes the part of the outline on one side of the fold after the bend allowance was applied.
    fn arc(&self, side: usize) -> Vec<Corner> {
        let corners = &self.sides[side];
        let [first, last] = self.beyond(side);
        let mut out = Vec::new();
        for (k, ((place, run), moved)) in corners.iter().zip(self.moved_corners(side)).enumerate() {
            if k > 0 && (k == first || k == last + 1) {
                let (before, _) = corners[k - 1];
                let [from, to] = [before, *place].map(|p| self.away(side, p));
                let share = (self.setback - from) / (to - from);
                if share > 0.0 && share < 1.0 {
                    let edge = before + (place - before) * share;
                    out.push((self.moved(side, edge, false), corners[k - 1].1));
                }
            }
            out.push((moved, *run));
        }
        out
    }
}

fn point(place: &[f64; 2]) -> Point {
    Point::new(place[0], place[1])
}

fn middle(points: &[[f64; 2]]) -> [f64; 2] {
    let (a, b) = (points[points.len() / 2], points[(points.len() - 1) / 2]);
    [0, 1].map(|k| 0.5 * (a[k] + b[k]))
}

fn ring(outline: &[Run]) -> Vec<Corner> {
    let runs = outline.iter().enumerate();
    let corners = runs.flat_map(|(number, run)| {
        let own = &run.points[..run.points.len() - 1];
        own.iter().map(move |place| (point(place), number))
    });
    corners.collect()
}

/// Replaces the points of a closed outline's runs (its pieces) by given points.
fn rebuild(outline: &mut [Run], corners: &[Corner]) {
    let n = corners.len();
    // Begin at the start of the first run, unless that is the whole outline.
    let start = (0..n).find(|k| corners[*k].1 == 0 && corners[(*k + n - 1) % n].1 != 0);
    let start = start.unwrap_or(0);
    for run in outline.iter_mut() {
        run.points.clear();
    }
    for k in 0..n {
        let (place, run) = corners[(start + k) % n];
        let place = [place.re, place.im];
        if outline[run].points.last() != Some(&place) {
            outline[run].points.push(place);
        }
    }
    let firsts: Vec<[f64; 2]> = outline.iter().map(|run| run.points[0]).collect();
    let count = outline.len();
    for (k, run) in outline.iter_mut().enumerate() {
        run.points.push(firsts[(k + 1) % count]);
    }
}
