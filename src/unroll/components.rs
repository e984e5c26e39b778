//! Connected components of a surface, each rotated to its place in the view from above.

use super::flat_triangle::Point;
use crate::error::{Result, try_filled};
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
    let mut numbers = try_filled("parts of the surface", vertices, 0)?;
    let mut sizes: Vec<usize> = Vec::new();
    for i in 0..vertices as u32 {
        let first = sets.find(i);
        if first == i {
            numbers[i as usize] = sizes.len() as u32;
            sizes.push(0);
        }
        numbers[i as usize] = numbers[first as usize];
        sizes[numbers[i as usize] as usize] += 1;
    }
    let largest = (0..sizes.len()).rev().max_by_key(|part| sizes[*part]);
    let largest = largest.unwrap_or(0) as u32;
    for number in &mut numbers {
        *number = match *number {
            n if n == largest => 0,
            n if n < largest => n + 1,
            n => n,
        };
    }
    Ok((numbers, sizes.len()))
}

/// Rotates and translates each component of the flat layout to its position in the view from above, by least squares
/// (the Procrustes problem without scaling).
pub(super) fn align_to_plan(
    mesh: &Triangulation,
    parts: &[u32],
    count: usize,
    places: &mut [Point],
) {
    #[derive(Clone, Copy, Default)]
    struct Sums {
        vertices: f64,
        place: Point,
        plan: Point,
        correlation: Point,
    }
    let plan = |i: usize| Point::new(mesh.positions()[i][0], mesh.positions()[i][1]);
    let mut sums = vec![Sums::default(); count];
    for (i, (part, place)) in parts.iter().zip(&*places).enumerate() {
        let sum = &mut sums[*part as usize];
        sum.vertices += 1.0;
        sum.place += place;
        sum.plan += plan(i);
    }
    for sum in &mut sums {
        sum.place /= sum.vertices;
        sum.plan /= sum.vertices;
    }
    for (i, (part, place)) in parts.iter().zip(&*places).enumerate() {
        let sum = &mut sums[*part as usize];
        let term = (place - sum.place).conj() * (plan(i) - sum.plan);
        sum.correlation += term;
    }
    for (part, place) in parts.iter().zip(places) {
        let sum = &sums[*part as usize];
        let size = sum.correlation.norm();
        let turn = if size > 0.0 {
            sum.correlation / size
        } else {
            Point::new(1.0, 0.0)
        };
        *place = sum.plan + turn * (*place - sum.place);
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
