//! Connected components of a surface, each rotated to its place in the view from above.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::flat_triangle::Point;
use crate::error::{Result, try_filled};
use crate::math::motion::Motion;
use crate::math::union_find::UnionFind;
use crate::scene::triangulation::Triangulation;

/// Finds the connected components of a surface. Returns the component number of each vertex, and the number of
/// components. The component with the most vertices is 0; the others are in the order of their first vertices.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn components(mesh: &Triangulation) -> Result<(Vec<u32>, usize)> {
    let vertices = mesh.vertices().len();
    let mut sets = UnionFind::new("parts of the surface", vertices)?;
    for [a, b, c] in mesh.triangles() {
        sets.union(*a, *b);
        sets.union(*a, *c);
    }
    // Roots are the first vertices of their parts.
    let mut parts = try_filled("parts of the surface", vertices, 0)?;
    let mut sizes: BTreeMap<u32, usize> = BTreeMap::new();
    for vertex in 0..vertices as u32 {
        parts[vertex as usize] = sets.find(vertex);
        *sizes.entry(parts[vertex as usize]).or_default() += 1;
    }
    let mut order: Vec<(u32, usize)> = sizes.into_iter().collect();
    order.sort_by_key(|(_, size)| Reverse(*size));
    if let Some(others) = order.get_mut(1..) {
        others.sort_by_key(|(first, _)| *first);
    }
    let numbers: BTreeMap<u32, u32> = order.iter().map(|(first, _)| *first).zip(0..).collect();
    parts.iter_mut().for_each(|part| *part = numbers[part]);
    Ok((parts, order.len()))
}

/// Rotates and translates each component of the flat layout to its position in the view from above, by least squares.
pub(super) fn align_to_plan(
    mesh: &Triangulation,
    parts: &[u32],
    count: usize,
    places: &mut [Point],
) {
    let mut members = vec![Vec::new(); count];
    for (vertex, part) in parts.iter().enumerate() {
        members[*part as usize].push(vertex);
    }
    for own in members {
        let plan = own.iter().map(|v| mesh.positions()[*v]);
        let plan: Vec<Point> = plan.map(|[x, y, _]| Point::new(x, y)).collect();
        let flat: Vec<Point> = own.iter().map(|v| places[*v]).collect();
        let motion = Motion::between(&flat, &plan);
        own.iter()
            .for_each(|v| places[*v] = motion.apply(places[*v]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Frame, Heightfield, Lattice};

    #[test]
    fn parts_are_upright_again_however_they_were_turned() {
        let lattice = Lattice::new(9, 20, 0.5).unwrap();
        let field =
            Heightfield::from_fn(
                lattice,
                |x, _| {
                    if (x - 2.6).abs() < 0.6 { f64::NAN } else { 0.0 }
                },
            )
            .unwrap();
        let mesh = Triangulation::new(&field, &Frame::default()).unwrap();
        let (parts, count) = components(&mesh).unwrap();
        assert_eq!(count, 2);
        assert_eq!(parts[0], 1, "the one to the left is smaller");
        let turns = [Point::from_polar(1.0, 2.0), Point::from_polar(1.0, -0.7)];
        let plan = |i: usize| Point::new(mesh.positions()[i][0], mesh.positions()[i][1]);
        let mut places: Vec<Point> = (0..parts.len())
            .map(|i| turns[parts[i] as usize] * plan(i) + Point::new(3.0, 1.0))
            .collect();
        align_to_plan(&mesh, &parts, count, &mut places);
        for (i, place) in places.iter().enumerate() {
            assert!((place - plan(i)).norm() < 1e-12);
        }
    }
}
