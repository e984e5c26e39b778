//! Normalised coordinates, in which λ and curvatures are stated (paper, Sec. 4.1): scaled so that the longer side is 1.

use super::heightfield::Heightfield;

/// How the input's coordinates are scaled for the energy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(from = "bool"))]
#[non_exhaustive]
pub enum Normalization {
    /// All of x, y and z are multiplied by one factor that makes the longer side of the valid vertices' bounding box 1;
    /// results come back in the user's units.
    #[default]
    UnitSquare,
    /// Coordinates are taken as they are.
    Off,
}

impl From<bool> for Normalization {
    /// Converts from whether coordinates are normalised to the unit square.
    fn from(normalize: bool) -> Self {
        match normalize {
            true => Normalization::UnitSquare,
            false => Normalization::Off,
        }
    }
}

impl Normalization {
    /// Factor that converts lengths from the field's units to normalised coordinates.
    pub(crate) fn factor(self, field: &Heightfield) -> f64 {
        match self {
            Normalization::Off => 1.0,
            Normalization::UnitSquare => 1.0 / longer_side(field),
        }
    }
}

/// Longer side of the bounding box, in the plane, of the vertices with a height.
fn longer_side(field: &Heightfield) -> f64 {
    let [min, max] = bounds(field);
    (max[0] - min[0]).max(max[1] - min[1])
}

/// Lower left and upper right corner of the bounding box, in the plane, of the vertices with a height.
pub(crate) fn bounds(field: &Heightfield) -> [[f64; 2]; 2] {
    let lattice = field.lattice();
    let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for row in 0..lattice.rows() {
        for col in (0..lattice.cols()).filter(|col| !field.height(row, *col).is_nan()) {
            for (k, x) in lattice.position(row, col).into_iter().enumerate() {
                min[k] = min[k].min(x);
                max[k] = max[k].max(x);
            }
        }
    }
    [min, max]
}
