//! Georeferences of GeoTIFF files: where the pixels of an image lie on a map.

/// Where the pixels of an image lie on a map. It is read from a GeoTIFF and written to one unchanged, but for the rows
/// or columns that were reversed or resampled.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Georeference {
    /// Affine transformation `[a, b, c, d, e, f]` from the column `i` and the row `j` of a pixel's upper left corner (of its
    /// middle, if the keys say so) to map coordinates: `x = a·i + b·j + c`, `y = d·i + e·j + f`, in the unit of the coordinate system.
    pub transformation: [f64; 6],
    /// Numbers of the tag `GeoKeyDirectory`, which names the coordinate system; empty if there is none.
    pub keys: Vec<u16>,
    /// Numbers of the tag `GeoDoubleParams`, to which keys refer.
    pub doubles: Vec<f64>,
    /// Text of the tag `GeoAsciiParams`, to which keys refer.
    pub text: String,
}
