//! Maps points of a flat sheet to the surface in space.

use crate::pattern::Faces;
use rustc_hash::FxHashMap;

/// A point on the surface in space, and whether the triangle that contains it faces up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spot {
    pub at: [f64; 3],
    pub up: bool,
}

/// Returns whether a triangle in space faces up, towards larger z.
pub(crate) fn faces_up([a, b, c]: [[f64; 3]; 3]) -> bool {
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]) > 0.0
}

/// Triangles of a flat sheet in a spatial index: a grid of squares as wide as the sheet's longest edge.
pub(crate) struct Built<'a> {
    faces: &'a Faces,
    width: f64,
    squares: FxHashMap<(i64, i64), Vec<u32>>,
}

impl<'a> Built<'a> {
    pub(crate) fn new(faces: &'a Faces) -> Built<'a> {
        let edges = faces
            .triangles
            .iter()
            .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        let length = |[a, b]: [&u32; 2]| {
            let [p, q] = [a, b].map(|v| faces.flat[*v as usize]);
            (p[0] - q[0]).hypot(p[1] - q[1])
        };
        let mut built = Built {
            faces,
            width: edges.map(length).fold(0.0, f64::max),
            squares: FxHashMap::default(),
        };
        for (number, corners) in faces.triangles.iter().enumerate() {
            let [a, b, c] = corners.map(|v| faces.flat[v as usize]);
            let square = built.square([0, 1].map(|k| (a[k] + b[k] + c[k]) / 3.0));
            built.squares.entry(square).or_default().push(number as u32);
        }
        built
    }

    fn square(&self, place: [f64; 2]) -> (i64, i64) {
        let [column, row] = place.map(|v| (v / self.width).floor() as i64);
        (column, row)
    }

    /// Maps a point on the flat sheet to the surface, by the triangle that contains it or else by the plane of the
    /// nearest one; `None` if no triangle is near. Costs the tests of a few triangles.
    pub(crate) fn at(&self, place: [f64; 2]) -> Option<Spot> {
        let (column, row) = self.square(place);
        let around = (-1..=1).flat_map(|i| (-1..=1).map(move |k| (column + i, row + k)));
        let near = around
            .filter_map(|square| self.squares.get(&square))
            .flatten();
        let shares = near.filter_map(|number| {
            let corners = self.faces.triangles[*number as usize];
            Some((corners, self.shares(corners, place)?))
        });
        let least = |shares: &[f64; 3]| shares.iter().copied().fold(f64::INFINITY, f64::min);
        let (corners, shares) = shares.max_by(|a, b| least(&a.1).total_cmp(&least(&b.1)))?;
        let corners = corners.map(|v| self.faces.built[v as usize]);
        Some(Spot {
            at: [0, 1, 2].map(|k| (0..3).map(|i| shares[i] * corners[i][k]).sum()),
            up: faces_up(corners),
        })
    }

    /// Computes the barycentric coordinates of a point in a flat triangle; `None` for a triangle without an area.
    fn shares(&self, corners: [u32; 3], place: [f64; 2]) -> Option<[f64; 3]> {
        let [a, b, c] = corners.map(|v| self.faces.flat[v as usize]);
        let area = |[a, b, c]: [[f64; 2]; 3]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        };
        let whole = area([a, b, c]);
        let shares = [[place, b, c], [a, place, c], [a, b, place]].map(|part| area(part) / whole);
        shares
            .iter()
            .all(|share| share.is_finite())
            .then_some(shares)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_where_their_triangle_is() {
        // A square folded along its diagonal, one half upright.
        let faces = Faces {
            flat: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            built: vec![
                [0.0; 3],
                [1.0, 0.0, 0.0],
                [1.0, 1.0, 0.0],
                [0.5, 0.5, 0.5f64.sqrt()],
            ],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Faces::default()
        };
        let built = Built::new(&faces);
        let spot = |at, up| Some(Spot { at, up });
        assert_eq!(built.at([0.75, 0.25]), spot([0.75, 0.25, 0.0], true));
        let upright = built.at([0.25, 0.75]).unwrap();
        let [x, y, z] = upright.at;
        assert!((x - 0.5).abs() < 1e-12 && (y - 0.5).abs() < 1e-12);
        assert!((z - 0.5 * 0.5f64.sqrt()).abs() < 1e-12 && !upright.up);
        // Just outside, as the triangle there goes on; far away nothing is.
        assert_eq!(built.at([1.125, 0.5]), spot([1.125, 0.5, 0.0], true));
        assert_eq!(built.at([9.0, 9.0]), None);
    }
}
