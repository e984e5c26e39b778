//! Outlines and folds of a sheet, made from the nodes of its seams: grouped into runs, extended and simplified.

use super::junction::Junctions;
use super::line::{meeting, restore_corners, simplify_polyline, simplify_ring};
use super::outline::{Corner, Layout};
use super::outline_loops::{Runs, Side, remove_loops};
use super::seam_graph::{FOUR_WAY_JUNCTION_RADIUS, HEADING_NODES, SeamGraph, is_triangle};
use super::sheets::{Fold, Run, Seam};
use crate::math::planar::{polygon_area, polyline_length};
use crate::unroll::flat_triangle::Point;

/// Maximum distance between an outline or fold and its simplified polyline, in lattice spacings.
const SIMPLIFICATION_TOLERANCE_SPACINGS: f64 = 0.02;

/// Removes the closed lines around less than a least area, except the one around the largest; `least` may differ from
/// line to line.
pub(super) fn drop_empty_lines<T>(
    lines: &mut Vec<T>,
    least: impl Fn(&T) -> f64,
    ring: impl Fn(&T) -> Vec<Point>,
) {
    let areas: Vec<f64> = lines
        .iter()
        .map(|line| polygon_area(&ring(line)).abs())
        .collect();
    let largest = areas.iter().copied().fold(0.0, f64::max);
    let mut areas = areas.into_iter();
    lines.retain(|line| {
        let area = areas.next();
        area.is_some_and(|area| area >= least(line).min(largest))
    });
}

/// Finds the closed lines around a sheet and cuts off their small loops; returns the lines and the number of loops.
pub(super) fn lines(net: &SeamGraph, layout: &Layout, patches: &[u32]) -> (Vec<Runs>, usize) {
    let mut loops = 0;
    let lines = layout.outlines(net, patches).into_iter().map(|line| {
        let (runs, count) = remove_loops(runs(net, &line), net.decided);
        loops += count;
        runs
    });
    let mut lines: Vec<Runs> = lines.collect();
    // A cut within a sheet that opens by less than a square of the spacing is not drawn.
    let least = net.spacing.powi(2);
    drop_empty_lines(
        &mut lines,
        |_| least,
        |runs| {
            let points = runs.iter().map(|(_, points)| &points[..points.len() - 1]);
            points.flatten().copied().collect()
        },
    );
    (lines, loops)
}

/// Creates the outlines of a sheet, the longest first; returns them and the number of small loops that were cut off.
pub(super) fn outlines(
    net: &SeamGraph,
    layout: &Layout,
    patches: &[u32],
    junctions: &Junctions,
    seam: impl Fn(usize) -> Seam,
) -> (Vec<Vec<Run>>, usize) {
    let (lines, loops) = lines(net, layout, patches);
    let corners = junctions.corners(net, layout, patches);
    let end = |place: Point| {
        // The point may be missing from the outline, because a loop was cut off there.
        let away = |corner: &Point| (corner - place).norm();
        let here = corners
            .iter()
            .filter(|(corner, _)| away(corner) <= FOUR_WAY_JUNCTION_RADIUS * net.spacing);
        let here = here.min_by(|(a, _), (b, _)| away(a).total_cmp(&away(b)));
        here.map(|(_, junction)| *junction)
    };
    let mut out: Vec<(f64, Vec<Run>)> = (lines.into_iter())
        .map(|runs| {
            let long = runs.iter().map(|(_, p)| polyline_length(p)).sum();
            let run = |(side, points): (Option<Side>, Vec<Point>)| Run {
                seam: side.map(|(number, _)| seam(number)),
                patch: side.map(|(_, patch)| patch),
                ends: [points[0], points[points.len() - 1]].map(end),
                points: pairs(&points),
            };
            (long, runs.into_iter().map(run).collect())
        })
        .collect();
    out.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    (out.into_iter().map(|(_, runs)| runs).collect(), loops)
}

/// Lists the folds of a sheet, except those that only connect two nodes of one four-way junction.
pub(super) fn folds(
    net: &SeamGraph,
    layout: &Layout,
    patches: &[u32],
    outlines: &[Vec<Run>],
    junctions: &Junctions,
    seam: impl Fn(usize) -> Seam,
) -> Vec<Fold> {
    let own = |number: &usize| {
        let seam = &net.seams[*number];
        layout.folded[*number] && !seam.smooth && patches.contains(&seam.patches[0])
    };
    let fold = |number: usize| {
        let [one, other] = [0, 1].map(|side| layout.side(net, number, side));
        let mut points: Vec<Point> = one.iter().zip(other).map(|(p, q)| 0.5 * (p + q)).collect();
        let nodes = &net.seams[number].nodes;
        let last = points.len() - 1;
        if nodes[0] != nodes[last] {
            for (end, back) in [
                (0, HEADING_NODES.min(last)),
                (last, last.saturating_sub(HEADING_NODES)),
            ] {
                if !is_triangle(nodes[end]) {
                    points[end] =
                        extend_to_outline(points[end], points[back], outlines, net.spacing);
                }
            }
        }
        Fold {
            seam: seam(number),
            bend: None,
            ends: [nodes[0], nodes[last]].map(|node| junctions.at(node)),
            points: pairs(&simplify_polyline(
                &points,
                SIMPLIFICATION_TOLERANCE_SPACINGS * net.spacing,
            )),
        }
    };
    let long = |number: &usize| {
        polyline_length(&net.seams[*number].sides[0]) > FOUR_WAY_JUNCTION_RADIUS * net.spacing
    };
    (0..net.seams.len())
        .filter(|number| own(number) && long(number))
        .map(fold)
        .collect()
}

/// Computes the intersection of the straight line from `back` through `end` with the outlines, the one nearest to
/// `end`; `end` itself if none is within a spacing of it.
fn extend_to_outline(end: Point, back: Point, outlines: &[Vec<Run>], spacing: f64) -> Point {
    let pieces = outlines.iter().flatten().flat_map(|run| {
        let points = run.points.windows(2);
        points.map(|p| [p[0], p[1]].map(|[x, y]| Point::new(x, y)))
    });
    let crossings = pieces.filter_map(|[p, q]| {
        let place = meeting([back, end], [p, q])?;
        let share = ((q - p).conj() * (place - p)).re / (q - p).norm_sqr();
        ((-0.01..=1.01).contains(&share) && (place - end).norm() < spacing).then_some(place)
    });
    crossings
        .min_by(|p, q| (p - end).norm().total_cmp(&(q - end).norm()))
        .unwrap_or(end)
}

/// Divides a closed line around a sheet into runs, each along one side of a seam or along the surface's border.
fn runs(net: &SeamGraph, line: &[Corner]) -> Vec<(Option<Side>, Vec<Point>)> {
    let tolerance = SIMPLIFICATION_TOLERANCE_SPACINGS * net.spacing;
    let n = line.len();
    let kind = |i: usize| {
        let Corner { seam, patch, .. } = line[i % n];
        seam.map(|seam| (seam, patch))
    };
    let Some(first) = (0..n).find(|i| kind(*i) != kind(*i + n - 1)) else {
        let ring = match line[0].seam {
            Some(_) => simplify_ring(&places(line), tolerance),
            None => {
                let mut border = middles(line);
                border.extend(closing(line));
                restore_corners(&simplify_ring(&border, tolerance), short(line), true)
            }
        };
        let again = ring.first().copied();
        return vec![(kind(0), ring.into_iter().chain(again).collect())];
    };
    let mut groups: Vec<(Option<Side>, Vec<Corner>)> = Vec::new();
    for i in first..first + n {
        let corner = line[i % n];
        match groups.last_mut() {
            Some((_, group)) if kind(i) == kind(i - 1) && i > first => group.push(corner),
            _ => groups.push((kind(i), vec![corner])),
        }
    }
    // Append the first corner of the next group to each group.
    let starts: Vec<Corner> = groups.iter().map(|(_, group)| group[0]).collect();
    let count = groups.len();
    for (k, (_, group)) in groups.iter_mut().enumerate() {
        group.push(starts[(k + 1) % count]);
    }
    let mut out: Runs = (groups.iter())
        .map(|(seam, group)| match seam {
            Some(_) => (*seam, places(group)),
            None => {
                let mut points = vec![group[0].place];
                points.extend(middles(group));
                points.push(group[group.len() - 1].place);
                (None, points)
            }
        })
        .collect();
    for k in (0..count).filter(|k| groups[*k].0.is_none()) {
        meet(net, &groups, &mut out, k);
    }
    for ((seam, points), (_, group)) in out.iter_mut().zip(&groups) {
        *points = simplify_polyline(points, tolerance);
        if seam.is_none() {
            *points = restore_corners(points, short(group), false);
        }
    }
    out
}

/// Extends or shortens the two seams that end at run `k`, a piece of the surface's border, to their intersections with
/// the border's line.
fn meet(net: &SeamGraph, groups: &[(Option<Side>, Vec<Corner>)], runs: &mut Runs, k: usize) {
    let count = groups.len();
    for (other, starts) in [((k + count - 1) % count, true), ((k + 1) % count, false)] {
        if groups[other].0.is_none() {
            continue;
        }
        // Reverse both lines where needed, so that each begins at the intersection.
        let turned = |list: &[Corner], turn: bool| -> Vec<Corner> {
            match turn {
                true => list.iter().rev().copied().collect(),
                false => list.to_vec(),
            }
        };
        let corners = turned(&groups[other].1, starts);
        let back = HEADING_NODES.min(corners.len() - 1);
        let [from, end] = [&corners[back], &corners[0]];
        let place = net.end([from.node, end.node], [from.place, end.place]);
        let (mut seam, mut border) = (runs[other].1.clone(), runs[k].1.clone());
        if starts {
            seam.reverse();
        } else {
            border.reverse();
        }
        for line in [&mut seam, &mut border] {
            line[0] = place;
            // Remove points that lie before the new first point.
            while line.len() > 2 && ((line[2] - line[1]).conj() * (line[1] - place)).re < 0.0 {
                line.remove(1);
            }
        }
        if starts {
            seam.reverse();
        } else {
            border.reverse();
        }
        (runs[other].1, runs[k].1) = (seam, border);
    }
}

fn places(corners: &[Corner]) -> Vec<Point> {
    corners.iter().map(|corner| corner.place).collect()
}

/// Computes the maximum length, in the surface's units, of a border segment that counts as cutting off a corner of the
/// outline: it connects the midpoints of two edges, and is no longer than the longest edge.
fn short(corners: &[Corner]) -> f64 {
    let next = vertices(corners).skip(1);
    let edges = vertices(corners).zip(next).map(|(p, q)| (q - p).norm());
    edges.fold(0.0, f64::max)
}

/// Returns the positions of those corners of a border that are lattice vertices; the border goes from one to the
/// next.
fn vertices(corners: &[Corner]) -> impl Iterator<Item = Point> {
    let own = corners
        .iter()
        .filter(|corner| corner.node.0 == corner.node.1);
    own.map(|corner| corner.place)
}

/// Returns the midpoints of the edges of the surface's border: unlike the vertices these do not zigzag.
fn middles(corners: &[Corner]) -> Vec<Point> {
    let next = vertices(corners).skip(1);
    vertices(corners)
        .zip(next)
        .map(|(p, q)| 0.5 * (p + q))
        .collect()
}

/// Returns the midpoint of the edge from the last vertex of the surface's border to its first vertex.
fn closing(corners: &[Corner]) -> Option<Point> {
    let (first, last) = (vertices(corners).next()?, vertices(corners).last()?);
    Some(0.5 * (first + last))
}

fn pairs(points: &[Point]) -> Vec<[f64; 2]> {
    points.iter().map(|place| [place.re, place.im]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_there_and_back_is_no_outline_and_a_small_sheet_has_one() {
        let at = Point::new;
        let square = |size: f64| [at(0.0, 0.0), at(size, 0.0), at(size, size), at(0.0, size)];
        let there_and_back = [at(1.0, 1.0), at(2.0, 1.5), at(3.0, 2.0), at(2.0, 1.5)];
        let mut lines = vec![square(8.0), square(-2.0), there_and_back];
        drop_empty_lines(&mut lines, |_| 1.0, |line| line.to_vec());
        assert_eq!(lines, [square(8.0), square(-2.0)]);
        let mut lines = vec![square(0.5)];
        drop_empty_lines(&mut lines, |_| 1.0, |line| line.to_vec());
        assert_eq!(lines, [square(0.5)]);
    }
}
