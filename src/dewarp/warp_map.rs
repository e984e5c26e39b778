//! Warp maps: from the pixels of a flat image to places in the photo.

use std::ops::Range;

use super::largest_rectangle::largest_rectangle;
use super::options::DewarpOptions;
use super::photo::Photo;
use super::pixel_grid::PixelGrid;
use super::raster::rasterise;
use super::registration::{PhotoProjection, Registration};
use super::verdict::{MAX_FLAT_STRAIN, Verdict};
use crate::error::{Error, Result, checked_cells, positive, try_filled};
use crate::math::planar::{Point2, bounds, orientation};
use crate::unroll::{UnrollReport, Unrolling};

/// A warp map: for each pixel of a flat image its place in the photo.
#[derive(Debug, Clone, PartialEq)]
pub struct WarpMap {
    grid: PixelGrid,
    places: Vec<[f32; 2]>,
    loss: f64,
    /// Whether the loss is that of a page between four corners.
    page_cropped: bool,
    /// Share of the area of the flat sheet that overlaps another part of it.
    overlap: f64,
}

/// Maximum share of a sheet's area that covers another part of it for a verdict other than `Stretched`: a strip of 0.2
/// mm along the outline of a page of A4, as where a ragged border crosses itself.
const MAX_OVERLAP_SHARE: f64 = 0.003;

/// Maximum share of a page between four corners that may be lost where the flat image is not called doubtful. Of simulated
/// phone captures with corners on the page no more than 4 % were lost, see `benches/verdicts.md`.
const MAX_PAGE_LOSS: f64 = 0.05;

/// Place in the photo of a pixel of the flat image that shows no sheet: not a number.
const NO_PLACE: [f32; 2] = [f32::NAN; 2];

impl WarpMap {
    /// The map of an unrolled surface for a photo of `photo` (width and height) pixels. The registration tells where
    /// the photo shows the surface's points: by an [`Extent`](super::Extent) of the plane, a camera, or texture
    /// coordinates.
    ///
    /// Within each triangle of the sheet points of the surface are interpolated linearly, and so are places in the
    /// photo but for a camera's perspective. Where components of the sheet overlap, the map shows the larger one; where
    /// one overlaps itself, the upper left triangle of the surface. Costs `O(pixels + triangles)`.
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
        let projection = PhotoProjection::new(registration.into(), photo, sheet.mesh())?;
        let resolution = match options.dots {
            Some(dots) => positive("dots", dots)?,
            None => photo_resolution(sheet, &projection)?,
        };
        let [min, max] = bounds(sheet.places().iter());
        // Slightly less, so that a sheet of exactly n pixels has n pixels in spite of rounding.
        let pixels = |k: usize| ((max[k] - min[k]) * resolution - 1e-6).ceil().max(1.0) as usize;
        let grid = PixelGrid {
            width: pixels(0),
            height: pixels(1),
            resolution,
            corner: [min[0], max[1]],
        };
        let mut found = empty_places(&grid)?;
        let overlap = rasterise(sheet, &projection, &grid, &mut found)?;
        if found.iter().all(|place| place[0].is_nan()) {
            return Err(Error::Unsupported {
                format: "flat image",
                reason: "no pixel lies on the sheet; choose a higher resolution".into(),
            });
        }
        let mut map = WarpMap::from_places(grid, found);
        map.overlap = overlap;
        if options.trim { map.trimmed() } else { Ok(map) }
    }

    /// Makes a map from its places in the photo, one for each pixel of the flat image, row by row.
    pub(crate) fn from_places(grid: PixelGrid, places: Vec<[f32; 2]>) -> Self {
        debug_assert_eq!(places.len(), grid.width * grid.height);
        WarpMap {
            grid,
            places,
            loss: 0.0,
            page_cropped: false,
            overlap: 0.0,
        }
    }

    /// Returns this map with the overlap that was measured for another map of the same sheet.
    pub(super) fn with_overlap_of(mut self, other: &WarpMap) -> Self {
        self.overlap = other.overlap;
        self
    }

    /// Share of the sheet that trimming left out; after a crop to four corners, the share of the page between them that
    /// the flat image does not show. 0 without trimming or cropping.
    pub fn loss(&self) -> f64 {
        self.loss
    }

    /// Sets the loss to the share of the page's pixels that are not known.
    pub(super) fn set_page_loss(&mut self, wanted: f64) {
        self.page_cropped = true;
        self.set_loss(wanted);
    }

    /// Sets the loss: the share of `wanted`, the number of pixels that were to be shown, that the map does not have.
    fn set_loss(&mut self, wanted: f64) {
        let known = self.places.iter().filter(|place| !place[0].is_nan());
        self.loss = (1.0 - known.count() as f64 / wanted).max(0.0);
    }

    /// Number of columns of the flat image.
    pub fn width(&self) -> usize {
        self.grid.width
    }

    /// Number of rows of the flat image.
    pub fn height(&self) -> usize {
        self.grid.height
    }

    /// Resolution of the flat image, in pixels per unit of length of the surface.
    pub fn resolution(&self) -> f64 {
        self.grid.resolution
    }

    /// Position of the flat image's upper left corner on the sheet, in the surface's units.
    pub fn corner(&self) -> [f64; 2] {
        self.grid.corner
    }

    /// Place `[x, y]` in the photo of each pixel, row by row, in the photo's pixels: `[0, 0]` is the
    /// centre of the upper left one. NaN where there is no sheet.
    pub fn places(&self) -> &[[f32; 2]] {
        &self.places
    }

    /// Measures how much dewarping changes the photo: root mean square distance between the places in the photo and the
    /// pixels of the flat image, after the best similarity (rotation, scaling and translation), as a share of the
    /// square root of the sheet's area.
    pub fn displacement(&self) -> f64 {
        // The least squares of |p - (a q + b)|² over complex a and b, with p and q relative to about the middle.
        let middle = Point2::new(0.5 * self.width() as f64, 0.5 * self.height() as f64);
        let point = |[x, y]: [f32; 2]| Point2::new(x.into(), y.into());
        let Some(about) = self.places.iter().find(|place| !place[0].is_nan()) else {
            return 0.0;
        };
        let (mut count, mut from, mut to) = (0.0, Point2::default(), Point2::default());
        let (mut qq, mut pp, mut pq) = (0.0, 0.0, Point2::default());
        for (row, places) in self.places.chunks_exact(self.width()).enumerate() {
            for (col, place) in places.iter().enumerate() {
                if place[0].is_nan() {
                    continue;
                }
                let q = Point2::new(col as f64, row as f64) - middle;
                let p = point(*place) - point(*about);
                (count, from, to) = (count + 1.0, from + q, to + p);
                (qq, pp, pq) = (qq + q.norm_sqr(), pp + p.norm_sqr(), pq + p * q.conj());
            }
        }
        qq -= from.norm_sqr() / count;
        pp -= to.norm_sqr() / count;
        let fitted = (pq - to * from.conj() / count).norm_sqr();
        if qq <= 0.0 || fitted == 0.0 {
            return 0.0;
        }
        // In pixels of the flat image.
        let rest = (pp - fitted / qq).max(0.0) * qq * qq / fitted;
        (rest / count).sqrt() / count.sqrt()
    }

    /// Derives the verdict on the flat image: stretched if the sheet's strain is large, as [`Verdict::from_report`] says,
    /// or if more than 0.3 % of it lie on another part of it, triangles that are turned over included; flat if
    /// [`WarpMap::displacement`] is below 0.2 %; else unrolled. A page of which more than 5 % are lost is doubtful
    /// instead of flat or unrolled.
    pub fn verdict(&self, sheet: &UnrollReport) -> Verdict {
        let verdict = self.verdict_on_known(sheet);
        if self.page_cropped && self.loss > MAX_PAGE_LOSS {
            verdict.or_doubtful()
        } else {
            verdict
        }
    }

    /// Verdict on what the flat image shows, whatever is lost.
    fn verdict_on_known(&self, sheet: &UnrollReport) -> Verdict {
        if Verdict::has_large_strain(sheet) || self.overlap > MAX_OVERLAP_SHARE {
            Verdict::Stretched
        } else if self.displacement() < MAX_FLAT_STRAIN {
            Verdict::Flat
        } else {
            Verdict::Unrolled
        }
    }

    /// Resamples a photo to the flat image: returns RGBA bytes, row by row, transparent where there is no sheet or no
    /// photo.
    ///
    /// Bilinear, and the mean of several samples for each pixel where the photo is finer than the
    /// flat image. Colours are mixed by their alpha.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn image(&self, photo: &Photo<'_>) -> Result<Vec<u8>> {
        let mut out = try_filled("flat image", 4 * self.places.len(), 0)?;
        self.image_rows(photo, 0..self.height(), &mut out);
        Ok(out)
    }

    /// Resamples a photo to some rows of the [flat image](WarpMap::image). `rgba` holds the bytes of these rows alone
    /// and is transparent before the call.
    ///
    /// # Panics
    /// If there are not four bytes for each pixel of these rows, or not as many rows.
    pub fn image_rows(&self, photo: &Photo<'_>, rows: Range<usize>, rgba: &mut [u8]) {
        let (width, height) = (self.width(), self.height());
        assert_eq!(rgba.len(), 4 * width * rows.len());
        let pixels = rgba.as_chunks_mut().0;
        for (row, line) in rows.zip(pixels.chunks_exact_mut(width)) {
            for (col, pixel) in line.iter_mut().enumerate() {
                let i = row * width + col;
                let place = self.places[i];
                if place[0].is_nan() {
                    continue;
                }
                let across = self.step(i, 1, [col > 0, col + 1 < width]);
                let down = self.step(i, width, [row > 0, row + 1 < height]);
                *pixel = photo.sample(place, [across, down]);
            }
        }
    }

    /// Difference of the places in the photo, in pixels, between a pixel and its next neighbour along a row or column,
    /// `stride` pixel numbers away, or its previous one if the next has no place; 0 if neither has. The image has a previous and a
    /// next one or not.
    #[inline]
    fn step(&self, i: usize, stride: usize, [has_previous, has_next]: [bool; 2]) -> [f32; 2] {
        let from = |i: usize| {
            let (from, to) = (self.places[i], self.places[i + stride]);
            let step = [to[0] - from[0], to[1] - from[1]];
            (!step[0].is_nan()).then_some(step)
        };
        let next = has_next.then(|| from(i)).flatten();
        let previous = || has_previous.then(|| from(i - stride))?;
        next.or_else(previous).unwrap_or_default()
    }

    /// Crops the map to the largest upright rectangle within the sheet.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn trimmed(mut self) -> Result<Self> {
        let inside = |i: usize| !self.places[i][0].is_nan();
        let [rows, cols] = largest_rectangle(self.width(), self.height(), inside)?;
        let wanted = (0..self.places.len()).filter(|i| inside(*i)).count();
        self.crop_to(rows, cols)?;
        self.set_loss(wanted as f64);
        Ok(self)
    }

    /// Places in the photo, one for each pixel of the flat image, row by row, to be changed.
    pub(super) fn places_mut(&mut self) -> &mut [[f32; 2]] {
        &mut self.places
    }

    /// Crops the flat image to ranges of its rows and columns.
    pub(super) fn crop_to(&mut self, rows: Range<usize>, cols: Range<usize>) -> Result<()> {
        let first = [cols.start, rows.start].map(|pixel| pixel as isize);
        self.frame(first, [cols.len(), rows.len()])
    }

    /// Crops the flat image to a frame of `size` (width and height) pixels whose upper left pixel has the column and row `first`
    /// in it, or adds empty margins where the frame is outside of it.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub(super) fn frame(&mut self, first: [isize; 2], size: [usize; 2]) -> Result<()> {
        let grid = self.grid.framed(first, size);
        let mut places = try_filled("flat image", size[0] * size[1], NO_PLACE)?;
        let [left, top] = first.map(|pixel| pixel.min(0).unsigned_abs());
        let [col, row] = first.map(|pixel| pixel.max(0) as usize);
        let out = places.chunks_exact_mut(grid.width).skip(top);
        for (out, line) in out.zip(self.places.chunks_exact(self.grid.width).skip(row)) {
            let common = (out.len() - left).min(line.len() - col);
            out[left..][..common].copy_from_slice(&line[col..][..common]);
        }
        (self.grid, self.places) = (grid, places);
        Ok(())
    }
}

/// Places of all pixels of a flat image that shows nothing.
///
/// # Errors
/// [`Error::TooLarge`], [`Error::OutOfMemory`].
pub(super) fn empty_places(grid: &PixelGrid) -> Result<Vec<[f32; 2]>> {
    let pixels = checked_cells("flat image", grid.height, grid.width)?;
    try_filled("flat image", pixels, NO_PLACE)
}

/// Mean resolution of the photo over the sheet, in pixels per unit of length: the default resolution of the flat image.
///
/// # Errors
/// [`Error::Unsupported`] if nothing of the surface is in the photo.
fn photo_resolution(sheet: &Unrolling, projection: &PhotoProjection) -> Result<f64> {
    if let PhotoProjection::Plane([across, up], _) = projection {
        return Ok((across * up).sqrt());
    }
    let mesh = sheet.mesh();
    let area = |[a, b, c]: [[f64; 2]; 3]| orientation(a, b, c).abs();
    let (mut seen, mut flat) = (0.0, 0.0);
    for triangle in mesh.triangles() {
        let corners = triangle.map(|v| {
            projection.project(projection.attributes(v as usize, mesh.positions()[v as usize]))
        });
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
