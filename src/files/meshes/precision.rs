//! Coordinates of 32 bits far from the origin, which are rounded coarsely: those of maps, for example.

use crate::files::Assumption;
use crate::scene::mesh::Mesh;

/// Minimum rounding of coordinates that is told, as a share of the mesh's longest side.
const MIN_TOLD_ROUNDING: f64 = 1e-5;

/// Tells how coarsely coordinates are rounded that are 32-bit floats far from the origin; `None` where that does not matter.
pub(super) fn coarse_coordinates(mesh: &Mesh) -> Option<Assumption> {
    let all = || mesh.positions().as_flattened().iter().copied();
    let largest = all().map(f64::abs).fold(0.0, f64::max);
    let longest = mesh.longest_side();
    let rounding = largest * f64::from(f32::EPSILON);
    (longest > 0.0 && rounding > MIN_TOLD_ROUNDING * longest && mesh.has_single_precision()).then(|| {
        let words = format!(
            "coordinates are 32-bit numbers up to {largest:.0}, rounded to {rounding:.1e}: write them from a nearer origin"
        );
        Assumption::new("coordinatePrecision", words, None)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coarse_coordinates_are_told_and_others_are_not() {
        let mesh = |offset: f64, step: f64| {
            let corner = |x: f64, y: f64| [offset + x, y, 0.0];
            let corners = vec![corner(0.0, 0.0), corner(step, 0.0), corner(0.0, step)];
            Mesh::new(corners, vec![[0, 1, 2]]).unwrap()
        };
        assert!(coarse_coordinates(&mesh(0.0, 10.0)).is_none());
        // A house of ten metres on a map, in 32 bits: half a metre between numbers.
        let told = coarse_coordinates(&mesh(5_412_345.0, 10.0)).unwrap();
        assert!(
            told.words.contains("5412355") && told.words.contains("6.5e-1"),
            "{}",
            told.words
        );
        // The same in 64 bits.
        assert!(coarse_coordinates(&mesh(5_412_345.678, 10.0)).is_none());
    }
}
