//! Parts of textures that are printed on the sheets of a drawing, each by one affine map.

use super::arcs::less;
use crate::drawing::{DrawnSheet, PrintedTriangle};

/// A texture as a file, to be printed on the sheets of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureFile<'a> {
    /// JPEG file of three channels.
    pub jpeg: &'a [u8],
    /// Width and height in pixels.
    pub size: [u32; 2],
}

/// Most copies of a texture, which repeats itself, across one part; what lies beyond is left blank.
const MAX_COPIES: f64 = 64.0;

/// Largest difference of two affine maps that are one, as a share of their coefficients.
const MAP_TOLERANCE: f64 = 1e-6;

/// Triangles beside each other on which a texture is printed by one affine map, so that no line shows between them.
pub(super) struct PrintedPart {
    pub texture: usize,
    /// Columns of the map from texture coordinates to millimetres: along u, along v, and the origin.
    pub map: [[f64; 2]; 3],
    pub triangles: Vec<[[f64; 2]; 3]>,
    /// Ranges of the texture coordinates u and v.
    ranges: [[f64; 2]; 2],
}

impl PrintedPart {
    /// Collects the printed parts of a sheet; a triangle whose texture coordinates lie on a line has none.
    pub(super) fn all_of(sheet: &DrawnSheet) -> Vec<PrintedPart> {
        let mut parts: Vec<PrintedPart> = Vec::new();
        for triangle in &sheet.printed {
            let Some(map) = affine_map(triangle) else {
                continue;
            };
            let number = triangle.texture as usize;
            let largest = map
                .as_flattened()
                .iter()
                .fold(0.0, |most: f64, v| most.max(v.abs()));
            let is_same = |other: &[[f64; 2]; 3]| {
                let mut pairs = map.as_flattened().iter().zip(other.as_flattened());
                pairs.all(|(a, b)| (a - b).abs() <= MAP_TOLERANCE * largest)
            };
            let found = (parts
                .iter()
                .rposition(|part| part.texture == number && is_same(&part.map)))
            .unwrap_or_else(|| {
                parts.push(PrintedPart {
                    texture: number,
                    map,
                    triangles: Vec::new(),
                    ranges: [[f64::INFINITY, f64::NEG_INFINITY]; 2],
                });
                parts.len() - 1
            });
            let part = &mut parts[found];
            part.triangles.push(triangle.corners);
            for uv in triangle.uvs {
                for (range, value) in part.ranges.iter_mut().zip(uv) {
                    *range = [range[0].min(value), range[1].max(value)];
                }
            }
        }
        parts
    }

    /// The maps of the copies of the texture that the part shows.
    pub(super) fn copies(&self) -> Vec<[[f64; 2]; 3]> {
        let [us, vs] = self.ranges.map(|[low, high]| {
            let first = (low + MAP_TOLERANCE).floor();
            let count = ((high - MAP_TOLERANCE).ceil() - first).clamp(1.0, MAX_COPIES);
            (0..count as u32).map(move |k| first + f64::from(k))
        });
        let [along_u, along_v, origin] = self.map;
        us.flat_map(|u| vs.clone().map(move |v| [u, v]))
            .map(|[u, v]| {
                let moved = [0, 1].map(|k| origin[k] + u * along_u[k] + v * along_v[k]);
                [along_u, along_v, moved]
            })
            .collect()
    }
}

/// Computes the affine map from a triangle's texture coordinates to its corners.
fn affine_map(triangle: &PrintedTriangle) -> Option<[[f64; 2]; 3]> {
    let ([p, q, r], [a, b, c]) = (triangle.uvs, triangle.corners);
    let ([s, t], [d, e]) = ([less(q, p), less(r, p)], [less(b, a), less(c, a)]);
    let determinant = s[0] * t[1] - s[1] * t[0];
    let along_u = [0, 1].map(|k| (d[k] * t[1] - e[k] * s[1]) / determinant);
    let along_v = [0, 1].map(|k| (e[k] * s[0] - d[k] * t[0]) / determinant);
    let origin = [0, 1].map(|k| a[k] - p[0] * along_u[k] - p[1] * along_v[k]);
    let map = [along_u, along_v, origin];
    map.as_flattened()
        .iter()
        .all(|v| v.is_finite())
        .then_some(map)
}
