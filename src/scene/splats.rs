//! Sampling of a point cloud as seen from a view: at each lattice vertex the points in front that lie around
//! it.
//!
//! A vertex sees the points within one spacing of it. Those more than three spacings below the highest of them are
//! hidden, so that a surface steeper than 56° loses points. The height is that of the plane fitted to the others by
//! least squares, in which near points have larger weights, so that a tilt causes no bias. Where they lie to one side
//! of the vertex (their weighted centroid is more than half a spacing away) there is no height: holes stay holes, and
//! the outline grows by less than half a spacing.

use nalgebra::{Matrix3, Vector3};

use crate::error::{Result, try_filled};
use crate::lattice::hexagonal::{Lattice, shift};

/// Radius around a lattice vertex within which points contribute to its height, in lattice spacings.
const SPLAT_RADIUS_SPACINGS: f64 = 1.0;

/// Depth below the highest point around a lattice vertex down to which points contribute to its height, in lattice
/// spacings.
const SPLAT_DEPTH_SPACINGS: f64 = 3.0;
/// Maximum distance between a lattice vertex and the centroid of its points for it to have a height, in lattice
/// spacings.
const MAX_CENTROID_OFFSET_SPACINGS: f64 = 0.5;

/// Computes height and nearest visible point of a point cloud at each lattice vertex; NaN and `miss` where there is
/// none.
pub(crate) fn splat(
    lattice: &Lattice,
    points: impl Iterator<Item = [f64; 3]> + Clone,
    miss: u32,
) -> Result<(Vec<f64>, Vec<u32>)> {
    let vertices = lattice.len();
    let mut highest = try_filled("point cloud", vertices, f64::NEG_INFINITY)?;
    for point in points.clone() {
        around(lattice, point, |vertex, _| {
            highest[vertex] = highest[vertex].max(point[2]);
        });
    }
    let mut sums = try_filled("point cloud", vertices, Sums::default())?;
    let mut nearest = try_filled("point cloud", vertices, (miss, f64::INFINITY))?;
    for (i, point) in points.enumerate() {
        around(lattice, point, |vertex, [dx, dy]| {
            // Offsets are in spacings, so that all sums have about the same magnitude.
            let below = (highest[vertex] - point[2]) / lattice.spacing();
            if below > SPLAT_DEPTH_SPACINGS {
                return;
            }
            let away = dx * dx + dy * dy;
            if away < nearest[vertex].1 {
                nearest[vertex] = (i as u32, away);
            }
            sums[vertex].add([dx, dy], -below);
        });
    }
    let mut heights = highest;
    for (vertex, height) in heights.iter_mut().enumerate() {
        *height = match sums[vertex].height() {
            Some(above) => *height + above * lattice.spacing(),
            None => {
                nearest[vertex].0 = miss;
                f64::NAN
            }
        };
    }
    Ok((heights, nearest.into_iter().map(|(i, _)| i).collect()))
}

/// Calls `visit` with each lattice vertex within the splat radius of a point, and with the offset from the vertex to
/// the point in spacings.
fn around(lattice: &Lattice, [x, y, _]: [f64; 3], mut visit: impl FnMut(usize, [f64; 2])) {
    let [left, top] = lattice.origin();
    let step = lattice.row_spacing() / lattice.spacing();
    let (along, down) = (
        (x - left) / lattice.spacing(),
        (top - y) / lattice.spacing(),
    );
    let rows = range(
        (down - SPLAT_RADIUS_SPACINGS) / step,
        (down + SPLAT_RADIUS_SPACINGS) / step,
        lattice.rows(),
    );
    for row in rows {
        let dy = row as f64 * step - down;
        let shift = shift(row);
        let reach = (SPLAT_RADIUS_SPACINGS * SPLAT_RADIUS_SPACINGS - dy * dy)
            .max(0.0)
            .sqrt();
        for col in range(along + shift - reach, along + shift + reach, lattice.cols()) {
            let dx = along - (col as f64 - shift);
            visit(lattice.index(row, col), [dx, dy]);
        }
    }
}

/// Range of the integers from `from` to `to` that are at least 0 and below `count`.
fn range(from: f64, to: f64, count: usize) -> std::ops::Range<usize> {
    // Casts saturate.
    from.ceil().max(0.0) as usize..(to.floor() + 1.0).max(0.0).min(count as f64) as usize
}

/// Sums over the points around a lattice vertex for fitting a plane: weights, first and second moments.
#[derive(Clone, Copy, Default)]
struct Sums {
    weight: f64,
    first: [f64; 2],
    /// Weighted sums of x², xy and y² over the points.
    second: [f64; 3],
    height: f64,
    tilt: [f64; 2],
}

impl Sums {
    fn add(&mut self, [x, y]: [f64; 2], height: f64) {
        let near = 1.0 - (x * x + y * y) / (SPLAT_RADIUS_SPACINGS * SPLAT_RADIUS_SPACINGS);
        let w = near * near;
        self.weight += w;
        self.height += w * height;
        for (k, v) in [x, y].into_iter().enumerate() {
            self.first[k] += w * v;
            self.tilt[k] += w * v * height;
        }
        for (k, v) in [x * x, x * y, y * y].into_iter().enumerate() {
            self.second[k] += w * v;
        }
    }

    /// Height of the fitted plane at the lattice vertex itself; `None` if the points lie to one side of it, or there
    /// are none.
    fn height(&self) -> Option<f64> {
        let [x, y] = self.first.map(|v| v / self.weight);
        // Without any points both are NaN.
        let around = x.hypot(y) <= MAX_CENTROID_OFFSET_SPACINGS;
        if !around {
            return None;
        }
        let [xx, xy, yy] = self.second;
        let [sx, sy] = self.first;
        let normal = Matrix3::new(self.weight, sx, sy, sx, xx, xy, sy, xy, yy);
        let right = Vector3::new(self.height, self.tilt[0], self.tilt[1]);
        // The spread of the points in their narrowest direction: on a line it is 0, and a plane
        // through them could have any tilt.
        let (vx, vy) = (xx / self.weight - x * x, yy / self.weight - y * y);
        let cross = xy / self.weight - x * y;
        let narrowest = (vx + vy) / 2.0 - ((vx - vy) / 2.0).hypot(cross);
        let plane = (narrowest > 1e-3)
            .then(|| normal.try_inverse().map(|inverse| (inverse * right).x))
            .flatten();
        Some(plane.unwrap_or(self.height / self.weight))
    }
}
