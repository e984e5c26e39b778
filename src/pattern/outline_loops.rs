//! Removes the small loops in which closed lines cross themselves.

use crate::math::planar::{line_intersection, polygon_area, polygon_perimeter};
use crate::unroll::flat_triangle::Point;
use crate::unroll::overlap::crossings;

/// Maximum area, in squared spacings, of a loop that is cut off a sheet's outline.
/// `benches/patterns.md` has what others give.
const MAX_LOOP_AREA: f64 = 6.0;

/// One side of a seam: the number of the seam, and the number of the patch on that side.
pub(crate) type Side = (usize, u32);

/// Consecutive pieces of a closed line, each with the side of the seam that it follows; `None` for the surface's
/// border.
pub(crate) type Runs = Vec<(Option<Side>, Vec<Point>)>;

/// Cuts off the small loops in which a closed line crosses itself. The line is given as runs (pieces along one side of
/// a seam or the border each), each of which begins where the one before ends. Returns the line and the number of loops
/// that were cut off.
pub(crate) fn remove_loops(runs: Runs, spacing: f64) -> (Runs, usize) {
    // Each point with the number of the run that the segment from this point to the next belongs to.
    let mut line: Vec<(Point, usize)> = Vec::new();
    for (number, (_, points)) in runs.iter().enumerate() {
        let own = &points[..points.len() - 1];
        line.extend(own.iter().map(|place| (*place, number)));
    }
    let mut loops = 0;
    // Each pass leaves fewer points.
    while let Some((next, count)) = pass(&line, spacing) {
        line = next;
        loops += count;
    }
    if loops == 0 || line.len() < 3 {
        return (runs, 0);
    }
    // Rotate the line so that it begins at the start of a run.
    let n = line.len();
    let start = (0..n).find(|i| line[*i].1 != line[(*i + n - 1) % n].1);
    line.rotate_left(start.unwrap_or(0));
    let mut out: Runs = Vec::new();
    let mut last = None;
    for (place, run) in &line {
        match out.last_mut() {
            Some((_, points)) if last == Some(*run) => points.push(*place),
            _ => out.push((runs[*run].0, vec![*place])),
        }
        last = Some(*run);
    }
    let starts: Vec<Point> = out.iter().map(|(_, points)| points[0]).collect();
    let count = out.len();
    for (k, (_, points)) in out.iter_mut().enumerate() {
        points.push(starts[(k + 1) % count]);
    }
    (out, loops)
}

/// Cuts off the small loops of a closed line, in one pass over it. Returns the line and the number of loops; `None` if
/// there is no loop.
fn pass(line: &[(Point, usize)], spacing: f64) -> Option<(Vec<(Point, usize)>, usize)> {
    let n = line.len();
    let places: Vec<Point> = line.iter().map(|(place, _)| *place).collect();
    let edges: Vec<[u32; 2]> = (0..n).map(|k| [k as u32, ((k + 1) % n) as u32]).collect();
    let mut gone = vec![false; n];
    // For each segment that ends a loop: the point that replaces the loop.
    let mut instead: Vec<Option<Point>> = vec![None; n];
    let mut count = 0;
    for [i, j] in crossings(&places, &edges) {
        let [a, b, c, d] = [i, i + 1, j, j + 1].map(|k| places[k % n]);
        let at = line_intersection([a, b], [c, d], 0.0).unwrap_or(0.5 * (b + c));
        // The loop from piece `a` to piece `b` or from `b` to `a`, whichever is shorter.
        let loops = [(i, j), (j, i)].map(|(a, b)| {
            let inner: Vec<usize> = (1..=(b + n - a) % n).map(|k| (a + k) % n).collect();
            let mut ring = vec![at];
            ring.extend(inner.iter().map(|k| places[*k]));
            (
                polygon_perimeter(&ring),
                polygon_area(&ring).abs(),
                b,
                inner,
            )
        });
        let [one, other] = loops;
        let (_, area, end, inner) = if one.0 < other.0 { one } else { other };
        let small = area <= MAX_LOOP_AREA * spacing * spacing;
        if small && inner.iter().all(|k| !gone[*k]) && instead[end].is_none() {
            inner.iter().for_each(|k| gone[*k] = true);
            instead[end] = Some(at);
            count += 1;
        }
    }
    let kept = (0..n).filter(|k| !gone[*k] || instead[*k].is_some());
    let out = kept
        .map(|k| (instead[k].unwrap_or(places[k]), line[k].1))
        .collect();
    (count > 0).then_some((out, count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_loop_goes_and_a_large_one_stays() {
        let at = Point::new;
        let square = |size: f64| {
            // The upper side curls.
            let (left, top) = (5.0 - size, 10.0 + size);
            let curl = [at(left, 10.0), at(left, top), at(5.0, top), at(5.0, 9.0)];
            let mut points = vec![at(0.0, 0.0), at(10.0, 0.0), at(10.0, 10.0)];
            points.extend(curl);
            points.extend([at(0.0, 9.0), at(0.0, 0.0)]);
            vec![(None, points)]
        };
        let (cleaned, loops) = remove_loops(square(1.0), 1.0);
        assert_eq!(loops, 1);
        let corners = &cleaned[0].1;
        assert!(corners.iter().all(|p| p.im <= 10.0), "{corners:?}");
        assert!(corners.contains(&at(5.0, 10.0)), "{corners:?}");
        let kept = remove_loops(square(3.0), 1.0);
        assert_eq!(kept, (square(3.0), 0));
    }
}
