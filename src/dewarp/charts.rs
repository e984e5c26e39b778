//! Texture coordinates across the seams of charts.
//!
//! A scanner's texture is an atlas: charts lie beside each other in any order. A triangle of the sheet whose corners
//! are in different charts must not interpolate between them, or it shows what lies in between. Each point of it is
//! mapped by its nearest corner's chart instead.

use nalgebra::{Matrix2, Vector2};

use super::registration::PhotoProjection;
use crate::error::{Result, try_filled};
use crate::math::statistics::median;
use crate::unroll::Unrolling;

/// Maximum factor by which a triangle's largest or smallest scale in the texture may differ from the median one, in
/// either direction, within one chart.
const MAX_SCALE_RATIO: f64 = 2.5;

/// Seams between a texture's charts on a sheet: which triangles cross them, and the charts' linear maps at the
/// vertices.
pub(super) struct ChartSeams {
    crossing: Vec<bool>,
    /// Derivative of the texture coordinates by the place on the sheet at each vertex: the mean over the vertex's
    /// triangles that lie within one chart.
    derivatives: Vec<Matrix2<f64>>,
}

impl ChartSeams {
    /// Finds the triangles of an unrolled sheet that cross from one chart of the texture to another. None without
    /// texture coordinates, or if no triangle does. Costs `O(n log n)` for `n` triangles.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(sheet: &Unrolling, projection: &PhotoProjection) -> Result<Option<Self>> {
        let PhotoProjection::Uvs(uvs, size) = projection else {
            return Ok(None);
        };
        let triangles = sheet.mesh().triangles();
        let mut maps: Vec<Option<(Matrix2<f64>, [f64; 2])>> =
            try_filled("flat image", triangles.len(), None)?;
        for (map, triangle) in maps.iter_mut().zip(triangles) {
            let place = |k: usize| Vector2::from(sheet.places()[triangle[k] as usize]);
            let uv = |k: usize| {
                let [u, v] = uvs[triangle[k] as usize].map(f64::from);
                Vector2::new(u, v)
            };
            let sides = |at: &dyn Fn(usize) -> Vector2<f64>| {
                Matrix2::from_columns(&[at(1) - at(0), at(2) - at(0)])
            };
            let Some(inverse) = sides(&place).try_inverse() else {
                continue;
            };
            let derivative = sides(&uv) * inverse;
            let pixels = Matrix2::from_diagonal(&Vector2::from(*size)) * derivative;
            let (squares, determinant) = (pixels.norm_squared(), pixels.determinant());
            // Both singular values, by the squares of their sum and difference; charts may be mirrored.
            let [sum, difference] =
                [2.0, -2.0].map(|sign| (squares + sign * determinant).max(0.0).sqrt());
            let scales = [0.5 * (sum + difference), 0.5 * (sum - difference).abs()];
            *map = derivative
                .iter()
                .all(|v| v.is_finite())
                .then_some((derivative, scales));
        }
        let usual = [0, 1].map(|k| {
            let all = maps.iter().flatten().map(|(_, scales)| scales[k]);
            // Without a triangle there are no scales that are compared with it.
            median(&mut all.collect::<Vec<f64>>()).unwrap_or_default()
        });
        let within = |scales: &[f64; 2]| {
            (0..2).all(|k| {
                let ratio = scales[k] / usual[k];
                (1.0 / MAX_SCALE_RATIO..=MAX_SCALE_RATIO).contains(&ratio)
            })
        };
        let crossing: Vec<bool> = (maps.iter())
            .map(|map| map.as_ref().is_some_and(|(_, scales)| !within(scales)))
            .collect();
        if !crossing.contains(&true) {
            return Ok(None);
        }
        let mut derivatives = try_filled("flat image", uvs.len(), Matrix2::zeros())?;
        let mut counts = try_filled("flat image", uvs.len(), 0.0)?;
        for ((map, crosses), triangle) in maps.iter().zip(&crossing).zip(triangles) {
            if let Some((derivative, _)) = map
                && !crosses
            {
                for corner in triangle {
                    derivatives[*corner as usize] += derivative;
                    counts[*corner as usize] += 1.0;
                }
            }
        }
        for (derivative, count) in derivatives.iter_mut().zip(counts) {
            if count > 0.0 {
                *derivative /= count;
            }
        }
        Ok(Some(ChartSeams {
            crossing,
            derivatives,
        }))
    }

    /// Whether the triangle with this number crosses a seam between charts.
    pub(super) fn crosses(&self, triangle: usize) -> bool {
        self.crossing[triangle]
    }

    /// Extrapolates texture coordinates from a vertex, with coordinates `uv`, to the point of the sheet at the offset
    /// `way` from that vertex, by the vertex's chart.
    pub(super) fn extrapolate(&self, vertex: u32, uv: [f64; 3], way: [f64; 2]) -> [f64; 3] {
        let step = self.derivatives[vertex as usize] * Vector2::from(way);
        [uv[0] + step.x, uv[1] + step.y, uv[2]]
    }
}
