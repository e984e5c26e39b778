//! From the pixels of the flat image to places in the photo.

use super::photo::Photo;
use super::trim::largest_rectangle;
use super::{DewarpOptions, Extent};
use crate::error::{Error, Result, checked_cells, positive, try_filled};
use crate::flat::unroll::Unrolling;
use crate::math::lanes;

/// For every pixel of a flat image its place in the photo.
#[derive(Debug, Clone, PartialEq)]
pub struct WarpMap {
    width: usize,
    height: usize,
    resolution: f64,
    corner: [f64; 2],
    places: Vec<[f32; 2]>,
}

/// Marks a pixel without a place.
const NOWHERE: [f32; 2] = [f32::NAN; 2];

/// Marks a pixel that is of no part.
const NO_PART: u32 = u32::MAX;

impl WarpMap {
    /// The map for a photo of `photo` (width and height) pixels that shows an extent of the plane.
    ///
    /// Within each triangle of the sheet the map is linear. Where parts of the sheet lie on each
    /// other the larger one is seen; where one lies on itself, the upper left triangle of the
    /// surface. Costs `O(pixels + triangles)`.
    ///
    /// # Errors
    /// [`Error::Option`] for a resolution that is not positive and finite, [`Error::Empty`] for an
    /// extent or a photo without area, [`Error::TooLarge`] for an image of more than
    /// [`MAX_CELLS`](crate::MAX_CELLS) pixels, [`Error::Unsupported`] if no pixel's centre lies on
    /// the sheet, [`Error::OutOfMemory`].
    pub fn new(
        sheet: &Unrolling,
        extent: Extent,
        photo: [usize; 2],
        options: &DewarpOptions,
    ) -> Result<Self> {
        let sides = extent.sides()?;
        if photo.contains(&0) {
            return Err(Error::Empty { what: "photo" });
        }
        let per_unit = [0, 1].map(|k| photo[k] as f64 / sides[k]);
        let resolution = match options.dots {
            Some(dots) => positive("dots", dots)?,
            None => (per_unit[0] * per_unit[1]).sqrt(),
        };
        let (min, max) = bounds(sheet.places());
        // A hair less, so that a sheet of exactly n pixels has n, however it rounds.
        let pixels = |k: usize| ((max[k] - min[k]) * resolution - 1e-6).ceil().max(1.0) as usize;
        let (width, height) = (pixels(0), pixels(1));
        checked_cells("flat image", height, width)?;
        let mut map = WarpMap {
            width,
            height,
            resolution,
            corner: [min[0], max[1]],
            places: try_filled("flat image", width * height, NOWHERE)?,
        };
        let mut parts = try_filled("flat image", width * height, NO_PART)?;
        let mesh = sheet.mesh();
        for triangle in mesh.triangles() {
            let part = sheet.parts()[triangle[0] as usize];
            let corners = triangle.map(|v| {
                let ([x, y], [px, py, _]) =
                    (sheet.places()[v as usize], mesh.positions()[v as usize]);
                Corner {
                    // Whole numbers at pixels' centres, downwards.
                    at: [
                        (x - min[0]) * resolution - 0.5,
                        (max[1] - y) * resolution - 0.5,
                    ],
                    place: [
                        (px - extent.min[0]) * per_unit[0] - 0.5,
                        (extent.max[1] - py) * per_unit[1] - 0.5,
                    ],
                }
            });
            map.fill(corners, part, &mut parts);
        }
        if parts.iter().all(|part| *part == NO_PART) {
            return Err(Error::Unsupported {
                format: "flat image",
                reason: "no pixel lies on the sheet; choose a higher resolution".into(),
            });
        }
        if options.trim {
            map.trim()?;
        }
        Ok(map)
    }

    /// Number of columns of the flat image.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows of the flat image.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Pixels of the flat image per unit of length.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// Where the upper left corner of the flat image lies on the sheet, in the surface's units.
    pub fn corner(&self) -> [f64; 2] {
        self.corner
    }

    /// For each pixel, row by row, its place `[x, y]` in the photo, in its pixels: `[0, 0]` is the
    /// centre of the upper left one. NaN where there is no sheet.
    pub fn places(&self) -> &[[f32; 2]] {
        &self.places
    }

    /// The flat image: RGBA bytes, row by row, transparent where there is no sheet or no photo.
    ///
    /// Bilinear, and the mean of several samples for each pixel where the photo is finer than the
    /// flat image. Colours are mixed by their alpha.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn image(&self, photo: &Photo<'_>) -> Result<Vec<u8>> {
        let mut out = try_filled("flat image", 4 * self.places.len(), 0)?;
        for (i, pixel) in out.chunks_exact_mut(4).enumerate() {
            let place = self.places[i];
            if !place[0].is_nan() {
                let steps = [
                    self.step(i, 1, i % self.width),
                    self.step(i, self.width, i / self.width),
                ];
                pixel.copy_from_slice(&photo.sample(place, steps));
            }
        }
        Ok(out)
    }

    /// How far the place moves from this pixel to the next one, `offset` further, from the next or
    /// the one before.
    fn step(&self, i: usize, offset: usize, before: usize) -> [f32; 2] {
        let here = self.places[i];
        let next = self.places.get(i + offset).copied().unwrap_or(NOWHERE);
        let step = [next[0] - here[0], next[1] - here[1]];
        // At the end of a row the next pixel is one of another row.
        let last = offset == 1 && before + 1 == self.width;
        if !step[0].is_nan() && !last {
            return step;
        }
        let previous = if before > 0 {
            self.places[i - offset]
        } else {
            NOWHERE
        };
        let step = [here[0] - previous[0], here[1] - previous[1]];
        if step[0].is_nan() { [0.0; 2] } else { step }
    }

    /// Writes the places of the pixels in a triangle.
    fn fill(&mut self, corners: [Corner; 3], part: u32, parts: &mut [u32]) {
        let [a, b, c] = corners.map(|corner| corner.at);
        let cross = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let area = cross(a, b, c);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        /// How far outside a pixel may lie, in pixels, so that none falls between two triangles.
        const SLACK: f64 = 1e-6;
        let range = |k: usize, end: usize| {
            let low = a[k].min(b[k]).min(c[k]) - SLACK;
            let high = a[k].max(b[k]).max(c[k]) + SLACK;
            // Casts saturate; an empty range is one that ends before it starts.
            low.ceil().max(0.0) as usize..(high.floor() + 1.0).clamp(0.0, end as f64) as usize
        };
        let slack = SLACK * area.abs().sqrt() + 1e-12;
        let sign = area.signum();
        for row in range(1, self.height) {
            for col in range(0, self.width) {
                let p = [col as f64, row as f64];
                let weights = [cross(b, c, p), cross(c, a, p), cross(a, b, p)];
                if weights.iter().any(|weight| sign * weight < -slack) {
                    continue;
                }
                let i = row * self.width + col;
                if part < parts[i] {
                    parts[i] = part;
                    self.places[i] = [0, 1].map(|k| {
                        let sum: f64 = (corners.iter().zip(weights))
                            .map(|(corner, weight)| weight * corner.place[k])
                            .sum();
                        lanes::single(sum / area)
                    });
                }
            }
        }
    }

    fn trim(&mut self) -> Result<()> {
        let inside = |i: usize| !self.places[i][0].is_nan();
        let [rows, cols] = largest_rectangle(self.width, self.height, inside)?;
        let mut places = try_filled("flat image", rows.len() * cols.len(), NOWHERE)?;
        for (out, row) in places.chunks_exact_mut(cols.len()).zip(rows.clone()) {
            let start = row * self.width + cols.start;
            out.copy_from_slice(&self.places[start..start + cols.len()]);
        }
        self.corner[0] += cols.start as f64 / self.resolution;
        self.corner[1] -= rows.start as f64 / self.resolution;
        self.width = cols.len();
        self.height = rows.len();
        self.places = places;
        Ok(())
    }
}

/// A corner of a triangle: where it is in the flat image and in the photo, in pixels.
#[derive(Clone, Copy)]
struct Corner {
    at: [f64; 2],
    place: [f64; 2],
}

fn bounds(places: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for place in places {
        for k in 0..2 {
            min[k] = min[k].min(place[k]);
            max[k] = max[k].max(place[k]);
        }
    }
    (min, max)
}
