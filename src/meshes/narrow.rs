//! A mesh's numbers in fewer bits, as most formats have them.

use crate::error::{Error, Result, try_filled};
use crate::mesh::Mesh;

/// The positions in 32 bits.
pub(super) fn narrowed(what: &'static str, mesh: &Mesh) -> Result<Vec<[f32; 3]>> {
    let mut positions = try_filled(what, mesh.positions().len(), [0f32; 3])?;
    for (row, (narrow, wide)) in positions.iter_mut().zip(mesh.positions()).enumerate() {
        *narrow = wide.map(|v| v as f32);
        if let Some(col) = narrow.iter().position(|v| !v.is_finite()) {
            return Err(Error::NotFinite {
                what,
                value: f64::from(narrow[col]),
                row,
                col,
                advice: "coordinates beyond 3.4e38 do not fit into its 32-bit floats; scale them \
                         down or write PLY",
            });
        }
    }
    Ok(positions)
}

/// A colour from 0 to 1 as a byte.
pub(super) fn byte(color: f32) -> u8 {
    // Casts saturate, and make 0 of NaN.
    (color * 255.0).round() as u8
}
