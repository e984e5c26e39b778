//! From the pixels of the flat image to places in the photo.

use std::ops::Range;

use super::photo::Photo;
use super::registration::Places;
use super::trim::largest_rectangle;
use super::{DewarpOptions, Registration, Verdict};
use crate::error::{Error, Result, checked_cells, positive, try_filled};
use crate::flat::unroll::{UnrollReport, Unrolling};

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
    /// The map for a photo of `photo` (width and height) pixels, in which the surface's points are
    /// where the registration says: an [`Extent`](super::Extent) of the plane, a camera, texture
    /// coordinates.
    ///
    /// Within each triangle of the sheet the point of the surface is linear, and so is the place in
    /// the photo but for a camera's perspective. Where parts of the sheet lie on each
    /// other the larger one is seen; where one lies on itself, the upper left triangle of the
    /// surface. Costs `O(pixels + triangles)`.
    ///
    /// # Errors
    /// [`Error::Option`] for a resolution that is not positive and finite, [`Error::Empty`] for an
    /// extent or a photo without area, those of [`Camera::for_size`](crate::Camera::for_size), [`Error::Shape`] for
    /// texture coordinates of another lattice,
    /// [`Error::TooLarge`] for an image of more than
    /// [`MAX_CELLS`](crate::MAX_CELLS) pixels, [`Error::Unsupported`] if no pixel's centre lies on
    /// the sheet, [`Error::OutOfMemory`].
    pub fn new<'a>(
        sheet: &Unrolling,
        registration: impl Into<Registration<'a>>,
        photo: [usize; 2],
        options: &DewarpOptions,
    ) -> Result<Self> {
        let places = Places::new(registration.into(), photo, sheet.mesh())?;
        let resolution = match options.dots {
            Some(dots) => positive("dots", dots)?,
            None => resolution(sheet, &places)?,
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
                let [x, y] = sheet.places()[v as usize];
                Corner {
                    // Whole numbers at pixels' centres, downwards.
                    at: [
                        (x - min[0]) * resolution - 0.5,
                        (max[1] - y) * resolution - 0.5,
                    ],
                    from: places.of_vertex(v as usize, mesh.positions()[v as usize]),
                }
            });
            map.fill(corners, part, &places, &mut parts);
        }
        if parts.iter().all(|part| *part == NO_PART) {
            return Err(Error::Unsupported {
                format: "flat image",
                reason: "no pixel lies on the sheet; choose a higher resolution".into(),
            });
        }
        if options.trim { map.trimmed() } else { Ok(map) }
    }

    /// A map whose places are known, row by row.
    pub(crate) fn of_places(
        [width, height]: [usize; 2],
        resolution: f64,
        corner: [f64; 2],
        places: Vec<[f32; 2]>,
    ) -> Self {
        debug_assert_eq!(places.len(), width * height);
        WarpMap {
            width,
            height,
            resolution,
            corner,
            places,
        }
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

    /// How far places in the photo are from those in the flat image after the best turn, scaling and
    /// shift, as the root of the mean square in shares of the root of the sheet's area: what the
    /// photo itself is wrong by as a picture of the page.
    pub fn displacement(&self) -> f64 {
        // Over complex numbers: the least squares of |p - (a q + b)|².
        let pairs = || {
            (self.places.iter().enumerate())
                .filter(|(_, place)| !place[0].is_nan())
                .map(|(i, place)| {
                    let q = [(i % self.width) as f64, (i / self.width) as f64];
                    (q, place.map(f64::from))
                })
        };
        let count = pairs().count() as f64;
        let (mut from, mut to) = ([0.0; 2], [0.0; 2]);
        for (q, p) in pairs() {
            for k in 0..2 {
                from[k] += q[k] / count;
                to[k] += p[k] / count;
            }
        }
        let (mut qq, mut pp, mut pq) = (0.0, 0.0, [0.0; 2]);
        for (q, p) in pairs() {
            let [q, p] = [
                [q[0] - from[0], q[1] - from[1]],
                [p[0] - to[0], p[1] - to[1]],
            ];
            qq += q[0] * q[0] + q[1] * q[1];
            pp += p[0] * p[0] + p[1] * p[1];
            pq[0] += p[0] * q[0] + p[1] * q[1];
            pq[1] += p[1] * q[0] - p[0] * q[1];
        }
        let fitted = pq[0] * pq[0] + pq[1] * pq[1];
        if qq == 0.0 || fitted == 0.0 {
            return 0.0;
        }
        // In pixels of the flat image.
        let rest = (pp - fitted / qq).max(0.0) * qq * qq / fitted;
        (rest / count).sqrt() / count.sqrt()
    }

    /// Whether the flat image is to be trusted: stretched if the sheet is, see
    /// [`Verdict::of`]; flat if the photo itself is right to 0.2 %, as
    /// [`WarpMap::displacement`] measures it.
    pub fn verdict(&self, sheet: &UnrollReport) -> Verdict {
        const FLAT: f64 = 0.002;
        match Verdict::of(sheet) {
            Verdict::Stretched => Verdict::Stretched,
            _ if self.displacement() < FLAT => Verdict::Flat,
            _ => Verdict::Unrolled,
        }
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
    fn fill(&mut self, corners: [Corner; 3], part: u32, places: &Places, parts: &mut [u32]) {
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
                    let from = [0, 1, 2].map(|k| {
                        let sum: f64 = (corners.iter().zip(weights))
                            .map(|(corner, weight)| weight * corner.from[k])
                            .sum();
                        sum / area
                    });
                    if let Some(place) = places.of(from) {
                        parts[i] = part;
                        self.places[i] = place;
                    }
                }
            }
        }
    }

    /// The largest upright rectangle that is all sheet.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn trimmed(mut self) -> Result<Self> {
        let inside = |i: usize| !self.places[i][0].is_nan();
        let [rows, cols] = largest_rectangle(self.width, self.height, inside)?;
        self.keep(rows, cols)?;
        Ok(self)
    }

    pub(super) fn places_mut(&mut self) -> &mut [[f32; 2]] {
        &mut self.places
    }

    /// Only some rows and columns.
    pub(super) fn keep(&mut self, rows: Range<usize>, cols: Range<usize>) -> Result<()> {
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

/// A corner of a triangle: where it is in the flat image, in pixels, and what its place in the photo
/// comes from.
#[derive(Clone, Copy)]
struct Corner {
    at: [f64; 2],
    from: [f64; 3],
}

/// As many pixels per unit of length as the photo has on the mean over the sheet.
fn resolution(sheet: &Unrolling, places: &Places) -> Result<f64> {
    if let Places::Plane([across, up], _) = places {
        return Ok((across * up).sqrt());
    }
    let mesh = sheet.mesh();
    let area = |[a, b, c]: [[f64; 2]; 3]| {
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
    };
    let (mut seen, mut flat) = (0.0, 0.0);
    for triangle in mesh.triangles() {
        let corners =
            triangle.map(|v| places.of(places.of_vertex(v as usize, mesh.positions()[v as usize])));
        if let [Some(a), Some(b), Some(c)] = corners {
            seen += area([a, b, c].map(|place| place.map(f64::from)));
            flat += area(triangle.map(|v| sheet.places()[v as usize]));
        }
    }
    let resolution = (seen / flat).sqrt();
    if resolution > 0.0 && resolution.is_finite() {
        return Ok(resolution);
    }
    Err(Error::Unsupported {
        format: "photo",
        reason:
            "nothing of the surface is in it: the camera looks elsewhere, or there are no texture \
                 coordinates"
                .into(),
    })
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
