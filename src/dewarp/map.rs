//! From the pixels of the flat image to places in the photo.

use std::ops::Range;

use super::photo::Photo;
use super::raster::{Canvas, draw};
use super::registration::Places;
use super::trim::largest_rectangle;
use super::{DewarpOptions, Registration, Verdict};
use crate::error::{Error, Result, checked_cells, positive, try_filled};
use crate::unroll::{UnrollReport, Unrolling};

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
        let canvas = Canvas {
            size: [width, height],
            resolution,
            corner: [min[0], max[1]],
        };
        let mut found = try_filled("flat image", width * height, NOWHERE)?;
        draw(sheet, &places, &canvas, &mut found)?;
        if found.iter().all(|place| place[0].is_nan()) {
            return Err(Error::Unsupported {
                format: "flat image",
                reason: "no pixel lies on the sheet; choose a higher resolution".into(),
            });
        }
        let map = WarpMap::of_places(canvas.size, resolution, canvas.corner, found);
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
        // Over complex numbers: the least squares of |p - (a q + b)|², with both from about the middle.
        let middle = [self.width, self.height].map(|n| 0.5 * n as f64);
        let Some(about) = self.places.iter().find(|place| !place[0].is_nan()) else {
            return 0.0;
        };
        let about = about.map(f64::from);
        let (mut count, mut from, mut to) = (0.0, [0.0; 2], [0.0; 2]);
        let (mut qq, mut pp, mut pq) = (0.0, 0.0, [0.0; 2]);
        for (row, places) in self.places.chunks_exact(self.width).enumerate() {
            for (col, place) in places.iter().enumerate() {
                if place[0].is_nan() {
                    continue;
                }
                let q = [col as f64 - middle[0], row as f64 - middle[1]];
                let p = [0, 1].map(|k| f64::from(place[k]) - about[k]);
                count += 1.0;
                for k in 0..2 {
                    from[k] += q[k];
                    to[k] += p[k];
                }
                qq += q[0] * q[0] + q[1] * q[1];
                pp += p[0] * p[0] + p[1] * p[1];
                pq[0] += p[0] * q[0] + p[1] * q[1];
                pq[1] += p[1] * q[0] - p[0] * q[1];
            }
        }
        qq -= (from[0] * from[0] + from[1] * from[1]) / count;
        pp -= (to[0] * to[0] + to[1] * to[1]) / count;
        pq[0] -= (to[0] * from[0] + to[1] * from[1]) / count;
        pq[1] -= (to[1] * from[0] - to[0] * from[1]) / count;
        let fitted = pq[0] * pq[0] + pq[1] * pq[1];
        if qq <= 0.0 || fitted == 0.0 {
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
        self.image_rows(photo, 0..self.height, &mut out);
        Ok(out)
    }

    /// Some rows of the [image](WarpMap::image), in the bytes for just these, of what is transparent so far.
    ///
    /// # Panics
    /// If there are not four bytes for each pixel of these rows, or not as many rows.
    pub fn image_rows(&self, photo: &Photo<'_>, rows: Range<usize>, rgba: &mut [u8]) {
        let (width, height) = (self.width, self.height);
        assert_eq!(rgba.len(), 4 * width * rows.len());
        let pixels = rgba.as_chunks_mut().0;
        for (row, line) in rows.zip(pixels.chunks_exact_mut(width)) {
            for (col, pixel) in line.iter_mut().enumerate() {
                let i = row * width + col;
                let place = self.places[i];
                if place[0].is_nan() {
                    continue;
                }
                let steps = [
                    self.step(
                        i,
                        (col + 1 < width).then_some(i + 1),
                        col.checked_sub(1).map(|_| i - 1),
                    ),
                    self.step(
                        i,
                        (row + 1 < height).then_some(i + width),
                        i.checked_sub(width),
                    ),
                ];
                *pixel = photo.sample(place, steps);
            }
        }
    }

    /// How far the place moves from this pixel to the next one, or from the one before.
    fn step(&self, i: usize, next: Option<usize>, previous: Option<usize>) -> [f32; 2] {
        let way = |from: usize, to: usize| {
            let (from, to) = (self.places[from], self.places[to]);
            let step = [to[0] - from[0], to[1] - from[1]];
            (!step[0].is_nan()).then_some(step)
        };
        let forth = next.and_then(|next| way(i, next));
        let back = || previous.and_then(|previous| way(previous, i));
        forth.or_else(back).unwrap_or([0.0; 2])
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
