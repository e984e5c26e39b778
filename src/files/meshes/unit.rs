//! Lengths in mesh files: their unit by what a file states, its size suggests, or the caller says, and how coarsely they are
//! rounded.

use super::mesh_file::MeshFile;
use crate::error::{Error, Result};
use crate::files::assumption::rounded;
use crate::files::unit::millimetres_in;
use crate::files::{Assumption, Unit};
use crate::scene::mesh::Mesh;

/// Minimum longest side of a mesh whose lengths are taken for millimetres: a smaller model cannot be cut out and folded.
const MIN_MILLIMETRE_SIDE: f64 = 10.0;

/// Maximum longest side of a mesh whose lengths are taken for millimetres: a larger model fits no workshop.
const MAX_MILLIMETRE_SIDE: f64 = 5000.0;

/// Minimum distance of a mesh from the origin of coordinates that are those of a map, in metres: northings of maps in use are
/// some thousand kilometres, and no model in millimetres lies a kilometre away.
const MIN_MAP_DISTANCE: f64 = 1e6;

/// A unit in which a mesh file may state lengths, with the unit that its mesh is read in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FileUnit {
    /// Factor from the file's lengths to those of the mesh.
    factor: f64,
    unit: Unit,
}

impl FileUnit {
    /// Returns the unit of a given name: `mm`, `cm`, `m` or `inch`, or as 3MF spells units. Lengths in metres stay
    /// metres, all others become millimetres.
    ///
    /// # Errors
    /// [`Error::Option`] for another name.
    pub fn new(name: &str) -> Result<Self> {
        let length = millimetres_in(name)
            .ok_or_else(|| Error::option("unit", name, "must be `mm`, `cm`, `m` or `inch`"))?;
        let (factor, unit) = match length == Unit::Metre.millimetres() {
            true => (1.0, Unit::Metre),
            false => (length, Unit::Millimetre),
        };
        Ok(FileUnit { factor, unit })
    }
}

impl MeshFile {
    /// Sets the unit in which the file's lengths are, whatever the reader assumed: the mesh is converted to
    /// millimetres, or stays in metres. Costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::NotFinite`] where a coordinate becomes too large.
    pub fn in_unit(mut self, given: FileUnit) -> Result<Self> {
        // The file's own unit is in the mesh already.
        let factor = given.factor / self.factor;
        if factor != 1.0 {
            let scaled = |p: &[f64; 3]| p.map(|v| v * factor);
            let positions = self.mesh.positions().iter().map(scaled).collect();
            self.mesh = self.mesh.moved_to(positions)?;
        }
        self.assumptions.retain(|known| known.code != CODE);
        self.unit = Some(given.unit);
        self.factor = given.factor;
        Ok(self)
    }
}

/// Code of the assumption about the unit.
const CODE: &str = "unit";

/// Chooses a unit by the place and size of a mesh whose file does not state one: metres on a map, else millimetres, or none
/// for what would be too small or too large a model.
pub(super) fn assumed_unit(mesh: &Mesh) -> (Option<Unit>, Assumption) {
    let longest = mesh.longest_side();
    let side = rounded(longest, 4);
    let [low, high] = mesh.bounds();
    let distance = (low.iter().zip(&high))
        .map(|(low, high)| low.max(-high))
        .fold(0.0, f64::max);
    let none = format!("lengths have no unit: a longest side of {side} is too");
    let (unit, words) = if distance > MIN_MAP_DISTANCE {
        let words = format!("lengths are metres: coordinates of {distance:.0} are those of a map");
        (Some(Unit::Metre), words)
    } else if longest > MAX_MILLIMETRE_SIDE {
        (None, format!("{none} long for millimetres"))
    } else if longest < MIN_MILLIMETRE_SIDE {
        (
            None,
            format!("{none} short for millimetres, and may be inches or metres"),
        )
    } else {
        let words = format!("lengths are millimetres: the longest side is {side} mm");
        (Some(Unit::Millimetre), words)
    };
    (unit, Assumption::new(CODE, words, CODE))
}

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
