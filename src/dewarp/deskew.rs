//! Rotation of a flat image, so that the sheet stands upright in it.

use super::warp_map::empty_places;
use super::{PixelGrid, WarpMap};
use crate::error::Result;
use crate::math::lanes;
use crate::math::planar::{LeastBox, bounds};

impl WarpMap {
    /// Rotates the map counter-clockwise by an angle in radians, on a larger image that holds it. Places are
    /// interpolated bilinearly, so that up to a pixel of the border is lost.
    ///
    /// # Errors
    /// [`Error::TooLarge`](crate::Error::TooLarge), [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn rotated(&self, angle: f64) -> Result<Self> {
        let (sin, cos) = angle.sin_cos();
        let resolution = self.resolution();
        let size = [self.width(), self.height()].map(|n| n as f64);
        // In pixels, y up, about the sheet's origin.
        let corner = self.corner().map(|v| v * resolution);
        let corners = [[0.0, 0.0], [size[0], 0.0], [0.0, size[1]], size].map(|[x, y]| {
            let [x, y] = [corner[0] + x, corner[1] - y];
            [cos * x - sin * y, sin * x + cos * y]
        });
        let [[left, bottom], [right, top]] = bounds(corners.iter());
        let [width, height] =
            [right - left, top - bottom].map(|side| side.ceil().max(1.0) as usize);
        let grid = PixelGrid {
            width,
            height,
            resolution,
            corner: [left / resolution, top / resolution],
        };
        let mut places = empty_places(&grid)?;
        for (row, line) in places.chunks_exact_mut(width).enumerate() {
            for (col, place) in line.iter_mut().enumerate() {
                let [x, y] = [left + col as f64 + 0.5, top - row as f64 - 0.5];
                let from = [cos * x + sin * y, cos * y - sin * x];
                let pixel = [from[0] - corner[0] - 0.5, corner[1] - from[1] - 0.5];
                if let Some(found) = self.interpolate(pixel) {
                    *place = found.map(lanes::single);
                }
            }
        }
        Ok(WarpMap::from_places(grid, places).with_overlap_of(self))
    }

    /// Angle, in radians, by which the sheet has to be rotated for the smallest rectangle around it to be upright.
    pub(super) fn skew(&self) -> f64 {
        let mut points = Vec::new();
        for (row, line) in self.places().chunks_exact(self.width()).enumerate() {
            let there = |place: &[f32; 2]| !place[0].is_nan();
            if let (Some(first), Some(last)) =
                (line.iter().position(there), line.iter().rposition(there))
            {
                // Rows count downwards, y upwards.
                points.extend([first, last].map(|col| [col as f64, -(row as f64)]));
            }
        }
        let (LeastBox { turn, .. }, _) = LeastBox::turned_and_upright(points);
        modulo_right_angle(turn[1].atan2(turn[0]))
    }
}

/// Angle, in radians, by which a polygon (y up) has to be rotated for its sides to be horizontal and vertical on
/// average: the circular mean of their directions modulo 90°, weighted by length.
pub(super) fn polygon_skew(polygon: &[[f64; 2]]) -> f64 {
    let mut sum = [0.0; 2];
    for (from, to) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let side = [to[0] - from[0], to[1] - from[1]];
        let (length, angle) = (side[0].hypot(side[1]), 4.0 * side[1].atan2(side[0]));
        sum = [sum[0] + length * angle.cos(), sum[1] + length * angle.sin()];
    }
    -sum[1].atan2(sum[0]) / 4.0
}

/// Reduces an angle in radians modulo 90°, to the range from −45° to 45°.
fn modulo_right_angle(angle: f64) -> f64 {
    use std::f64::consts::FRAC_PI_2;
    angle - (angle / FRAC_PI_2).round() * FRAC_PI_2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_rectangle_is_found_upright() {
        for angle in [-0.6f64, -0.1, 0.0, 0.3, 0.7] {
            let (sin, cos) = angle.sin_cos();
            let corners = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]]
                .map(|[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y]);
            assert!((polygon_skew(&corners) + angle).abs() < 1e-12, "{angle}");
        }
    }
}
