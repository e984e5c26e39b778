//! Converts the numbers of a mesh to fewer bits, as most file formats have them.

use crate::error::{Error, Result, try_filled};
use crate::math::lanes;
use crate::scene::mesh::Mesh;

/// Converts a mesh's positions to 32-bit floats, relative to an origin.
pub(super) fn narrowed(what: &'static str, mesh: &Mesh, origin: [f64; 3]) -> Result<Vec<[f32; 3]>> {
    let mut positions = try_filled(what, mesh.positions().len(), [0f32; 3])?;
    for (row, (narrow, wide)) in positions.iter_mut().zip(mesh.positions()).enumerate() {
        *narrow = std::array::from_fn(|k| lanes::single(wide[k] - origin[k]));
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

/// Maximum ratio of a mesh's distance from the origin to the mesh's size at which 32 bits hold positions to a
/// thousandth of the spacing of a mesh 4096 vertices across.
const MAX_ORIGIN_DISTANCE_RATIO: f64 = 8.0;

/// Chooses an origin near a mesh, in each coordinate in which the mesh is far from 0: 32-bit floats resolve the
/// differences from there, but not the fine detail of, for example, map coordinates.
///
/// Each coordinate is a number that both 32-bit floats and a few decimal digits hold exactly, so that all readers
/// agree on it.
pub(super) fn near_origin(mesh: &Mesh) -> [f64; 3] {
    let ([low, high], size) = (mesh.bounds(), mesh.longest_side());
    std::array::from_fn(|k| {
        let middle = low[k] / 2.0 + high[k] / 2.0;
        let far =
            middle.abs() > MAX_ORIGIN_DISTANCE_RATIO * size && middle.abs() < f64::from(f32::MAX);
        if far { rounded(middle) } else { 0.0 }
    })
}

/// Rounds a coordinate to a whole number nearby that 32-bit floats hold exactly, of at most 24 bits: multiples of 10ᵏ
/// up to 2²⁴⁺ᵏ.
fn rounded(value: f64) -> f64 {
    let (mut unit, mut limit) = (1.0, f64::from(1 << 24));
    while value.abs() >= limit {
        unit *= 10.0;
        limit *= 2.0;
    }
    (value / unit).round() * unit
}

/// Converts a colour component from 0 to 1 to a byte from 0 to 255.
pub(super) fn byte(color: f32) -> u8 {
    // Casts saturate; NaN becomes 0.
    (color * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn origins_are_exact_in_32_bits_and_as_they_are_printed() {
        for value in [
            0.4,
            -3.5,
            512_345.678,
            -5_412_345.1,
            16_777_215.4,
            2.5e7,
            1.3e8,
            7e12,
            3e38,
        ] {
            let origin = rounded(value);
            assert_eq!(f64::from(origin as f32), origin, "{value}");
            assert_eq!((origin as f32).to_string().parse(), Ok(origin), "{value}");
        }
        assert_eq!(rounded(512_345.678), 512_346.0);
        assert_eq!(rounded(123_456_789.0), 123_457_000.0);
    }
}
