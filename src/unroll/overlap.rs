//! Self-intersections of flat sheets.
//!
//! Where no triangle is flipped, a sheet covers parts of the plane twice only if its border crosses itself: the
//! number of layers changes at a border alone. So border edges are compared, with a spatial hash.

use super::flat_triangle::Point;
use crate::math::planar::segments_intersect;
use rustc_hash::FxHashMap;

/// Finds the pairs of border edges that cross, by the edges' indices in `border`; each edge is given by its two
/// vertices, indices into `places`. Costs `O(edges)` where edges are about equally long and few lie at one position.
pub(crate) fn crossings(places: &[Point], border: &[[u32; 2]]) -> Vec<[usize; 2]> {
    let ends = |edge: usize| border[edge].map(|v| places[v as usize]);
    let longest = (0..border.len()).map(|i| {
        let [a, b] = ends(i);
        (b - a).norm_sqr()
    });
    let size = longest.fold(0.0, f64::max).sqrt();
    if !(size > 0.0 && size.is_finite()) {
        return Vec::new();
    }
    let bucket = |place: Point| {
        (
            (place.re / size).floor() as i64,
            (place.im / size).floor() as i64,
        )
    };
    let mut buckets: FxHashMap<(i64, i64), Vec<usize>> = FxHashMap::default();
    for edge in 0..border.len() {
        let [a, b] = ends(edge);
        buckets.entry(bucket(0.5 * (a + b))).or_default().push(edge);
    }
    let mut found = Vec::new();
    for edge in 0..border.len() {
        let [a, b] = ends(edge);
        let (x, y) = bucket(0.5 * (a + b));
        for key in (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y))) {
            for other in buckets.get(&key).into_iter().flatten() {
                let apart = border[edge].iter().all(|v| !border[*other].contains(v));
                if *other > edge && apart && segments_intersect([a, b], ends(*other)) {
                    found.push([edge, *other]);
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_that_spirals_onto_itself_crosses_and_one_that_does_not_does_not() {
        // A ring strip of 400°, or of 300°, of unit width around radius 3.
        let strip = |degrees: f64| -> usize {
            let n = 80u32;
            let place = |i: u32, radius: f64| {
                Point::from_polar(radius, (degrees * f64::from(i) / f64::from(n)).to_radians())
            };
            let places: Vec<Point> = (0..=n)
                .flat_map(|i| [place(i, 3.0), place(i, 4.0)])
                .collect();
            let along = |i: u32| [[2 * i, 2 * i + 2], [2 * i + 1, 2 * i + 3]];
            let ends = [[0, 1], [2 * n, 2 * n + 1]];
            let border: Vec<[u32; 2]> = (0..n).flat_map(along).chain(ends).collect();
            crossings(&places, &border).len()
        };
        assert_eq!(strip(300.0), 0);
        assert!(strip(400.0) > 0);
    }
}
