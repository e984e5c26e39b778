//! Warp map of a flat page that holds for photos of any resolution of the same picture.

use std::ops::Range;

use super::sheet::cell_at;
use crate::dewarp::{DewarpOptions, Photo, PixelGrid, WarpMap};
use crate::error::{
    Error, MAX_PHOTO_PIXELS, Result, check_count, checked_pixels, positive, try_filled,
};
use crate::math::lanes;
use crate::math::planar::{cross, difference};

/// Warp map of a flat page by shares: places in the photo, in shares of its width and height, at the nodes of a grid over the
/// page, bilinear in between.
///
/// It holds for any resolution of the picture in which the page was found, and of the flat image.
#[derive(Debug, Clone, PartialEq)]
pub struct PageWarp {
    size: [f64; 2],
    millimetres: bool,
    columns: usize,
    rows: usize,
    places: Vec<[f32; 2]>,
}

impl PageWarp {
    /// Makes the warp map of a page of `size` (width and height, in millimetres or in widths of a page) from its places at
    /// the nodes of a grid, row by row: shares of the photo's width from the left and of its height from the top. The first
    /// node is the page's upper left corner, the last one its lower right one. A place that is not finite is outside of the
    /// photo.
    ///
    /// # Errors
    /// [`Error::Option`] for a size that is not positive and finite or fewer than two columns or rows, [`Error::Shape`] for
    /// another number of places.
    pub fn new(
        size: [f64; 2],
        millimetres: bool,
        [columns, rows]: [usize; 2],
        places: Vec<[f32; 2]>,
    ) -> Result<Self> {
        if !size.iter().all(|side| side.is_finite() && *side > 0.0) {
            return Err(Error::option("size", size, "must be two positive numbers"));
        }
        if columns < 2 || rows < 2 {
            let requirement = "must have two columns and rows or more";
            return Err(Error::option(
                "warp",
                [columns as f64, rows as f64],
                requirement,
            ));
        }
        check_count("warp", columns.saturating_mul(rows), 1, places.len())?;
        Ok(PageWarp {
            size,
            millimetres,
            columns,
            rows,
            places,
        })
    }

    /// Width and height of the flat page, in millimetres or in widths of a page.
    pub fn flat_size(&self) -> [f64; 2] {
        self.size
    }

    /// Whether lengths of the flat page are in millimetres; otherwise in widths of a page.
    pub fn is_millimetres(&self) -> bool {
        self.millimetres
    }

    /// Number of nodes in each row of the grid, and number of its rows.
    pub fn nodes(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// Places of the nodes in the photo, in shares of its width and height, row by row.
    pub fn places(&self) -> &[[f32; 2]] {
        &self.places
    }

    /// Makes the pixel grid of the flat image of a photo of `photo` (width and height) pixels. By default it has as many
    /// pixels as the photo has of the page.
    ///
    /// # Errors
    /// [`Error::Option`] for a resolution that is not positive and finite, [`Error::TooLarge`] for an image of more than
    /// [`MAX_CELLS`](crate::MAX_CELLS) pixels.
    pub fn pixel_grid(&self, photo: [usize; 2], options: &DewarpOptions) -> Result<PixelGrid> {
        let resolution = match options.dots {
            Some(dots) => positive("dots", dots)?,
            None => {
                // Less than what is allowed by as much as rounding adds.
                let pixels = self.seen_area(photo).min(0.999 * MAX_PHOTO_PIXELS as f64);
                (pixels / (self.size[0] * self.size[1])).sqrt()
            }
        };
        let [width, height] = (self.size).map(|side| (side * resolution).round().max(1.0) as usize);
        checked_pixels("flat image", height, width)?;
        Ok(PixelGrid {
            width,
            height,
            resolution,
            corner: [0.0, self.size[1]],
        })
    }

    /// Computes the warp map of the flat image: for each of its pixels the place in a photo of `photo` (width and height)
    /// pixels. `trim` has no effect, because the page fills its image.
    ///
    /// # Errors
    /// Those of [`PageWarp::pixel_grid`], [`Error::OutOfMemory`].
    pub fn warp_map(&self, photo: [usize; 2], options: &DewarpOptions) -> Result<WarpMap> {
        let flat = self.pixel_grid(photo, options)?;
        self.warp_rows(&flat, photo, 0..flat.height)
    }

    /// Resamples a photo to some rows of the flat image, as [`WarpMap::image_rows`] of the whole map does, with the map of
    /// these rows alone in memory.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    ///
    /// # Panics
    /// If `rgba` does not have four bytes for each pixel of these rows, or the image not as many rows.
    pub fn image_rows(
        &self,
        flat: &PixelGrid,
        photo: &Photo<'_>,
        rows: Range<usize>,
        rgba: &mut [u8],
    ) -> Result<()> {
        // How finely a pixel samples the photo depends on the next row's places.
        let band = rows.start.saturating_sub(1)..(rows.end + 1).min(flat.height);
        let within = rows.start - band.start..rows.end - band.start;
        let map = self.warp_rows(flat, [photo.width(), photo.height()], band)?;
        map.image_rows(photo, within, rgba);
        Ok(())
    }

    /// Computes some rows of the warp map.
    fn warp_rows(
        &self,
        flat: &PixelGrid,
        photo: [usize; 2],
        rows: Range<usize>,
    ) -> Result<WarpMap> {
        let scale = photo.map(|side| side as f32);
        let mut found = try_filled("flat image", flat.width * rows.len(), [f32::NAN; 2])?;
        let mut line = vec![[0.0; 2]; self.columns];
        let columns: Vec<(usize, f32)> = (0..flat.width)
            .map(|col| cell_place(col, flat.width, self.columns))
            .collect();
        for (out, row) in found.chunks_exact_mut(flat.width).zip(rows.clone()) {
            let (above, t) = cell_place(row, flat.height, self.rows);
            for (col, place) in line.iter_mut().enumerate() {
                let [p, q] = [above, above + 1].map(|row| self.places[row * self.columns + col]);
                *place = [0, 1].map(|k| scale[k] * (p[k] + t * (q[k] - p[k])) - 0.5);
            }
            for (place, (left, s)) in out.iter_mut().zip(&columns) {
                let (p, q) = (line[*left], line[*left + 1]);
                *place = [0, 1].map(|k| p[k] + s * (q[k] - p[k]));
            }
        }
        let band = flat.framed([0, rows.start as isize], [flat.width, rows.len()]);
        Ok(WarpMap::from_places(band, found))
    }

    /// Area of a photo of `photo` (width and height) pixels that the page covers, in pixels.
    fn seen_area(&self, photo: [usize; 2]) -> f64 {
        let mut area = 0.0;
        for i in 0..(self.columns - 1) * (self.rows - 1) {
            let first = i / (self.columns - 1) * self.columns + i % (self.columns - 1);
            let [a, b, c, d] = [0, 1, self.columns, self.columns + 1]
                .map(|step| self.places[first + step].map(f64::from));
            let cell = 0.5 * cross(difference(a, d), difference(b, c)).abs();
            area += if cell.is_finite() { cell } else { 0.0 };
        }
        (area * photo[0] as f64 * photo[1] as f64).max(1.0)
    }
}

/// Cell of a grid of `nodes` nodes along one axis in which the centre of a pixel of a flat image lies that has `pixels`
/// pixels, and the share of the cell before it.
fn cell_place(pixel: usize, pixels: usize, nodes: usize) -> (usize, f32) {
    let (cell, before) = cell_at((pixel as f64 + 0.5) / pixels as f64, nodes);
    (cell, lanes::single(before))
}
