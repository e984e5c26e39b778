//! Simplification of polylines with many points.

use super::planar::{Point2, distance_to_segment};

/// Simplifies a polyline: removes points so that all of them stay within a tolerance of the new line (Douglas and
/// Peucker 1973).
pub(crate) fn simplify_polyline(points: &[Point2], tolerance: f64) -> Vec<Point2> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut kept = vec![false; points.len()];
    let last = points.len() - 1;
    (kept[0], kept[last]) = (true, true);
    let mut stack = vec![(0, last)];
    while let Some((a, b)) = stack.pop() {
        let away = |i: usize| distance_to_segment(points[i], [points[a], points[b]]);
        let farthest = (a + 1..b).max_by(|i, k| away(*i).total_cmp(&away(*k)));
        if let Some(i) = farthest.filter(|i| away(*i) > tolerance) {
            kept[i] = true;
            stack.push((a, i));
            stack.push((i, b));
        }
    }
    // Some kept points were only needed before others were added: remove those without which the line is within the
    // tolerance.
    let mut out = vec![0];
    for i in (1..=last).filter(|i| kept[*i]) {
        if let [.., a, _] = out[..] {
            let straight = (a + 1..i)
                .all(|k| distance_to_segment(points[k], [points[a], points[i]]) <= tolerance);
            if straight {
                out.pop();
            }
        }
        out.push(i);
    }
    out.into_iter().map(|i| points[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_straight_has_two_ends_and_a_corner_stays() {
        let at = Point2::new;
        let line: Vec<Point2> = (0..10)
            .map(|i| at(f64::from(i), 0.001 * f64::from(i % 2)))
            .chain((1..10).map(|i| at(9.0, f64::from(i))))
            .collect();
        assert_eq!(
            simplify_polyline(&line, 0.01),
            [at(0.0, 0.0), line[9], at(9.0, 9.0)]
        );
    }
}
