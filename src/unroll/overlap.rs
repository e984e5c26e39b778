//! Self-intersections of flat sheets.
//!
//! Where no triangle is flipped, a sheet covers parts of the plane twice only if its border crosses itself: the
//! number of layers changes at a border alone. So border edges are compared, from one end of the sheet to the other.

use super::flat_triangle::Point;
use crate::math::planar::{Planar, bounds, segments_intersect};

/// Finds the pairs of border edges that cross, by the edges' indices in `border`, the smaller one first; each edge is given by its two
/// vertices, indices into `places`. Costs `O(edges · log(edges))` where few edges lie above each other.
pub(crate) fn crossings(places: &[Point], border: &[[u32; 2]]) -> impl Iterator<Item = [usize; 2]> {
    let ends = |edge: usize| border[edge].map(|v| places[v as usize]);
    let xy: Vec<[f64; 2]> = places.iter().map(|place| place.xy()).collect();
    let [low, high] = bounds(xy.iter());
    let axis = usize::from(high[1] - low[1] > high[0] - low[0]);
    let extent = move |edge: usize| {
        let [a, b] = ends(edge).map(|place| place.xy()[axis]);
        [a.min(b), a.max(b)]
    };
    let mut order: Vec<usize> = (0..border.len()).collect();
    order.sort_by(|a, b| extent(*a)[0].total_cmp(&extent(*b)[0]));
    (0..order.len()).flat_map(move |i| {
        let [_, end] = extent(order[i]);
        let beside = order[i + 1..].iter().copied();
        let beside: Vec<[usize; 2]> = beside
            .take_while(|other| extent(*other)[0] <= end)
            .map(|other| [order[i].min(other), order[i].max(other)])
            .filter(|[one, other]| {
                !border[*one].iter().any(|v| border[*other].contains(v))
                    && segments_intersect(ends(*one), ends(*other))
            })
            .collect();
        beside
    })
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;

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
            crossings(&places, &border).count()
        };
        assert_eq!(strip(300.0), 0);
        assert!(strip(400.0) > 0);
    }

    proptest! {
        /// Edges of very different lengths, in a strip that is wide or high.
        #[test]
        fn all_pairs_that_cross_are_found(
            ends in prop::collection::vec((0.0..9.0, 0.0..1.0, -3.0..0.0, 0.0..TAU), 2..60),
            turned in any::<bool>(),
        ) {
            let places: Vec<Point> = (ends.iter())
                .flat_map(|(x, y, size, angle): &(f64, f64, f64, f64)| {
                    let from = Point::new(*x, *y);
                    [from, from + Point::from_polar(10f64.powf(*size), *angle)]
                })
                .map(|p| if turned { p * Point::i() } else { p })
                .collect();
            let border: Vec<[u32; 2]> = (0..ends.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
            let edge = |i: usize| [places[2 * i], places[2 * i + 1]];
            let all = (0..ends.len()).flat_map(|i| (i + 1..ends.len()).map(move |j| [i, j]));
            let expected: Vec<[usize; 2]> = all.filter(|[i, j]| segments_intersect(edge(*i), edge(*j))).collect();
            let mut found: Vec<[usize; 2]> = crossings(&places, &border).collect();
            found.sort_unstable();
            prop_assert_eq!(found, expected);
        }
    }
}
