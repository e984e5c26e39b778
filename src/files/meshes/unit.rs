//! Units of length of mesh files: what a file states, what its size suggests, and what the caller says.

use super::mesh_file::MeshFile;
use crate::error::{Error, Result};
use crate::files::{Assumption, Unit};
use crate::scene::mesh::Mesh;

/// Minimum longest side of a mesh whose lengths are taken for millimetres; below it they are taken for metres.
const MIN_MILLIMETRE_SIDE: f64 = 2.0;

/// Maximum longest side of a mesh whose lengths are taken for millimetres; above it no unit is assumed.
const MAX_MILLIMETRE_SIDE: f64 = 5000.0;

/// A unit in which a mesh file may state lengths, with the unit that its mesh is read in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FileUnit {
    /// Factor from the file's lengths to those of the mesh.
    factor: f64,
    unit: Unit,
}

impl FileUnit {
    /// Metres, as in every glTF file.
    pub(super) const METRES: FileUnit = FileUnit {
        factor: 1.0,
        unit: Unit::Metre,
    };

    /// Returns the unit of a given name: `mm`, `cm`, `m` or `inch`, or as 3MF spells units. Lengths in metres stay
    /// metres, all others become millimetres.
    ///
    /// # Errors
    /// [`Error::Option`] for another name.
    pub fn new(name: &str) -> Result<Self> {
        let (factor, unit) = match name {
            "mm" | "millimeter" => (1.0, Unit::Millimetre),
            "cm" | "centimeter" => (10.0, Unit::Millimetre),
            "m" | "meter" => (1.0, Unit::Metre),
            "inch" => (25.4, Unit::Millimetre),
            "foot" => (304.8, Unit::Millimetre),
            "micron" => (1e-3, Unit::Millimetre),
            _ => {
                let requirement = "must be `mm`, `cm`, `m` or `inch`";
                return Err(Error::option("unit", name, requirement));
            }
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

/// Chooses a unit by the size of a mesh whose file does not state one: millimetres unless that is absurd, metres for
/// what would be tiny, and none for what would be huge.
pub(super) fn assumed_unit(mesh: &Mesh) -> (Option<Unit>, Assumption) {
    let sides = [0, 1, 2].map(|k| {
        let values = mesh.positions().iter().map(|p| p[k]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        high - low
    });
    let longest = sides.into_iter().fold(0.0, f64::max);
    let (unit, words) = if longest > MAX_MILLIMETRE_SIDE {
        let words = format!(
            "lengths have no unit: a longest side of {} is too long for millimetres",
            rounded(longest)
        );
        (None, words)
    } else if longest < MIN_MILLIMETRE_SIDE {
        let words = format!(
            "lengths are metres: the longest side is {} m, too short for millimetres",
            rounded(longest)
        );
        (Some(Unit::Metre), words)
    } else {
        let words = format!(
            "lengths are millimetres: the longest side is {} mm",
            rounded(longest)
        );
        (Some(Unit::Millimetre), words)
    };
    (unit, Assumption::new(CODE, words, CODE))
}

/// Rounds a length to four digits for a sentence.
fn rounded(length: f64) -> f64 {
    format!("{length:.3e}").parse().unwrap_or(length)
}
