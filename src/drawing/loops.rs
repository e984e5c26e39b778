//! Removes the small loops in which closed lines cross themselves.

use crate::math::planar::{line_intersection, polygon_area, polygon_perimeter};
use crate::unroll::flat_triangle::Point;
use crate::unroll::overlap::crossings;

/// Maximum area, in squared lengths of the smallest detail, of a loop that is cut off.
/// `benches/patterns.md` has what others give.
const MAX_LOOP_AREA: f64 = 6.0;

/// Cuts off the small loops in which a closed line, whose last point is not its first, crosses itself; `detail` is the size of the
/// smallest detail that stays.
pub(super) fn remove_loops(mut line: Vec<Point>, detail: f64) -> Vec<Point> {
    // Each pass leaves fewer points.
    while let Some(next) = pass(&line, detail) {
        line = next;
    }
    line
}

/// Cuts off the small loops of a closed line, in one pass over it; `None` if there is no loop.
fn pass(places: &[Point], detail: f64) -> Option<Vec<Point>> {
    let n = places.len();
    let edges: Vec<[u32; 2]> = (0..n).map(|k| [k as u32, ((k + 1) % n) as u32]).collect();
    let mut gone = vec![false; n];
    // For each segment that ends a loop: the point that replaces the loop.
    let mut instead: Vec<Option<Point>> = vec![None; n];
    for [i, j] in crossings(places, &edges) {
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
        let small = area <= MAX_LOOP_AREA * detail * detail;
        if small && inner.iter().all(|k| !gone[*k]) && instead[end].is_none() {
            inner.iter().for_each(|k| gone[*k] = true);
            instead[end] = Some(at);
        }
    }
    let kept = (0..n).filter(|k| !gone[*k] || instead[*k].is_some());
    let out = kept.map(|k| instead[k].unwrap_or(places[k])).collect();
    gone.contains(&true).then_some(out)
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
            points.push(at(0.0, 9.0));
            points
        };
        let corners = remove_loops(square(1.0), 1.0);
        assert!(corners.iter().all(|p| p.im <= 10.0), "{corners:?}");
        assert!(corners.contains(&at(5.0, 10.0)), "{corners:?}");
        assert_eq!(remove_loops(square(3.0), 1.0), square(3.0));
    }
}
