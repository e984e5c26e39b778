//! Rasterisation of a sheet's triangles into the flat image.

use super::charts::ChartSeams;
use super::pixel_grid::PixelGrid;
use super::registration::PhotoProjection;
use crate::error::{Result, try_filled};
use crate::math::index::NO_INDEX;
use crate::math::planar::orientation;
use crate::unroll::Unrolling;

/// A corner of a triangle that is rasterised into the flat image.
#[derive(Clone, Copy)]
struct RasterCorner {
    /// Position in the flat image, in pixels.
    at: [f64; 2],
    /// Attributes that are interpolated linearly over the triangle; [`PhotoProjection::project`] makes the place in the
    /// photo of them.
    from: [f64; 3],
}

/// Pixels of the flat image, row by row.
struct Pixels<'a> {
    size: [usize; 2],
    /// Places in the photo.
    places: &'a mut [[f32; 2]],
    /// Index of the first triangle over each pixel; [`NO_INDEX`] where there is none.
    owners: Vec<u32>,
    /// Number of pixels that have an owner.
    covered: usize,
    /// Number of pixels' coverings by triangles apart from their owners.
    repeated: usize,
}

/// Rasterises the sheet's triangles: writes to `places`, for each pixel of the flat image that has no place yet, its
/// place in the photo. Where components of the sheet overlap, pixels show the larger one. Returns the share of the
/// sheet's pixels that lie on another part of it, whether they are in the photo or not. Triangles with a common vertex
/// overlap where one of them is turned over. Costs `O(pixels + n log n)` for `n` triangles.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn rasterise(
    sheet: &Unrolling,
    projection: &PhotoProjection,
    grid: &PixelGrid,
    places: &mut [[f32; 2]],
) -> Result<f64> {
    let mut pixels = Pixels {
        size: [grid.width, grid.height],
        owners: try_filled("flat image", places.len(), NO_INDEX)?,
        places,
        covered: 0,
        repeated: 0,
    };
    let is_turned_over = |t: &[u32; 3]| {
        let [p, q, r] = t.map(|v| sheet.places()[v as usize]);
        orientation(p, q, r) < 0.0
    };
    let mesh = sheet.mesh();
    let triangles = mesh.triangles();
    let part = |triangle: usize| sheet.parts()[triangles[triangle][0] as usize];
    // The larger part first.
    let mut order = try_filled("flat image", triangles.len(), 0)?;
    for (i, triangle) in order.iter_mut().enumerate() {
        *triangle = i;
    }
    order.sort_by_key(|triangle| part(*triangle));
    let seams = ChartSeams::new(sheet, projection)?;
    let overlap = |triangle: u32, owner: u32| {
        let [own, other] = [triangle, owner].map(|t| &triangles[t as usize]);
        !own.iter().any(|v| other.contains(v)) || is_turned_over(own) != is_turned_over(other)
    };
    for triangle in order {
        let corners = triangles[triangle].map(|v| {
            let [x, y] = sheet.places()[v as usize];
            RasterCorner {
                // Pixels' centres are at whole numbers, rows count downwards.
                at: [
                    (x - grid.corner[0]) * grid.resolution - 0.5,
                    (grid.corner[1] - y) * grid.resolution - 0.5,
                ],
                from: projection.attributes(v as usize, mesh.positions()[v as usize]),
            }
        });
        match seams.as_ref().filter(|seams| seams.crosses(triangle)) {
            None => pixels.cover(triangle as u32, &corners, projection, overlap),
            Some(seams) => {
                for piece in nearest_pieces(seams, grid, &triangles[triangle], &corners) {
                    pixels.cover(triangle as u32, &piece, projection, overlap);
                }
            }
        }
    }
    Ok(pixels.repeated as f64 / (pixels.covered + pixels.repeated).max(1) as f64)
}

/// Cuts a triangle that crosses from one chart of the texture to another into six pieces: the points of each are
/// nearest to one corner, and mapped by that corner's chart.
fn nearest_pieces(
    seams: &ChartSeams,
    grid: &PixelGrid,
    vertices: &[u32; 3],
    corners: &[RasterCorner; 3],
) -> [[RasterCorner; 3]; 6] {
    let mean = |of: &[usize]| {
        [0, 1].map(|k| of.iter().map(|i| corners[*i].at[k]).sum::<f64>() / of.len() as f64)
    };
    std::array::from_fn(|piece| {
        let (own, other) = (piece / 2, (piece / 2 + 1 + piece % 2) % 3);
        let corner = corners[own];
        let extrapolated = |at: [f64; 2]| {
            // Rows count downwards.
            let way = [at[0] - corner.at[0], corner.at[1] - at[1]];
            let way = way.map(|pixels| pixels / grid.resolution);
            RasterCorner {
                at,
                from: seams.extrapolate(vertices[own], corner.from, way),
            }
        };
        [
            corner,
            extrapolated(mean(&[own, other])),
            extrapolated(mean(&[0, 1, 2])),
        ]
    })
}

/// Tolerance for rounding errors of interpolation: distance outside of a triangle or of a grid, in pixels or nodes, so that no pixel
/// falls between two triangles, and weight of a missing value.
pub(super) const ROUNDING_TOLERANCE: f64 = 1e-6;

impl Pixels<'_> {
    /// Covers the pixels in one triangle: writes their places in the photo, where there is none yet. `overlap` says
    /// whether a triangle lies on another one where both cover a pixel.
    fn cover(
        &mut self,
        triangle: u32,
        corners: &[RasterCorner; 3],
        projection: &PhotoProjection,
        overlap: impl Fn(u32, u32) -> bool,
    ) {
        let [width, height] = self.size;
        let [a, b, c] = corners.map(|corner| corner.at);
        let area = orientation(a, b, c);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let slack = (ROUNDING_TOLERANCE * area.abs().sqrt() + 1e-12) / area.abs();
        // Barycentric coordinates are linear along a row, and so are the interpolated attributes.
        let edges = [(b, c), (c, a), (a, b)];
        let slopes = edges.map(|(from, to)| (from[1] - to[1]) / area);
        let along = interpolate(corners, slopes);
        let top = a[1].min(b[1]).min(c[1]) - ROUNDING_TOLERANCE;
        let bottom = a[1].max(b[1]).max(c[1]) + ROUNDING_TOLERANCE;
        // Casts saturate; an empty range is one that ends before it starts.
        let rows =
            top.ceil().max(0.0) as usize..(bottom.floor() + 1.0).clamp(0.0, height as f64) as usize;
        for row in rows {
            // From the corner that is nearest to the left, so that little is lost by rounding.
            let start = a[0].min(b[0]).min(c[0]).floor().max(0.0);
            let pixel = [start, row as f64];
            let weights = edges.map(|(from, to)| orientation(from, to, pixel) / area);
            let (mut first, mut last) = (0.0, width as f64 - 1.0 - start);
            for (weight, slope) in weights.into_iter().zip(slopes) {
                let end = -(weight + slack) / slope;
                if slope > 0.0 {
                    first = end.max(first);
                } else if slope < 0.0 {
                    last = end.min(last);
                } else if weight < -slack {
                    last = -1.0;
                }
            }
            let (first, last) = (first.ceil(), last.floor());
            if last < first {
                continue;
            }
            let mut from = interpolate(corners, weights);
            for k in 0..3 {
                from[k] += first * along[k];
            }
            let begin = row * width + (start + first) as usize;
            let pixels = begin..=begin + (last - first) as usize;
            for (place, owner) in
                (self.places[pixels.clone()].iter_mut()).zip(&mut self.owners[pixels])
            {
                if *owner == NO_INDEX {
                    *owner = triangle;
                    self.covered += 1;
                } else if *owner != triangle && overlap(triangle, *owner) {
                    self.repeated += 1;
                }
                if place[0].is_nan()
                    && let Some(found) = projection.project(from)
                {
                    *place = found;
                }
                for k in 0..3 {
                    from[k] += along[k];
                }
            }
        }
    }
}

/// Interpolates the attributes of a triangle's corners with barycentric weights.
fn interpolate(corners: &[RasterCorner; 3], weights: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let parts = corners.iter().zip(weights);
        parts.map(|(corner, weight)| weight * corner.from[k]).sum()
    })
}
