//! Cropping of a flat image to a polygon in the photo.

use std::ops::Range;

use super::WarpMap;
use super::deskew::polygon_skew;
use crate::error::{Error, Result};
use crate::math::planar::polygon_contains;
use crate::scene::region::check_crop;

/// Maximum distance by which the sheet is continued beyond its border, as a share of the longer side of the cropped image.
/// Limits how much of a flat image is extrapolated.
const MAX_CONTINUATION_SHARE: f64 = 0.06;

impl WarpMap {
    /// Crops the map to a polygon in the photo, given by its corners in pixels, `[0, 0]`
    /// the centre of the upper left one. The sheet is continued to the polygon's sides, by up to 6 % of
    /// the cropped image's longer side, and the flat image ends there, with straight edges; it is the smallest one that
    /// holds the polygon. Costs `O(pixels · corners)`.
    ///
    /// # Errors
    /// [`Error::Option`] for fewer than three corners or one that is not finite,
    /// [`Error::Unsupported`] if nothing of the sheet lies within it, [`Error::OutOfMemory`].
    pub fn crop(self, polygon: &[[f64; 2]]) -> Result<Self> {
        self.cut(Some(polygon), false, false)
    }

    /// [Crops](WarpMap::crop) the map, turns it upright (`deskew`), and cuts it to a rectangle without margins (`trim`).
    ///
    /// Deskewing turns the sides of the polygon upright, on average, or without a polygon the smallest rectangle around the
    /// sheet; [`corner`](WarpMap::corner) is then in axes turned about the sheet's origin. Trimming to a polygon with four
    /// corners, such as those of a page, gives the rectangle whose sides pass
    /// through the midpoints between two corners: the sheet fills it whether its edges are seen straight
    /// or bent. Otherwise it gives the largest upright rectangle within the sheet.
    ///
    /// # Errors
    /// Those of [`WarpMap::crop`].
    pub fn cut(self, polygon: Option<&[[f64; 2]]>, deskew: bool, trim: bool) -> Result<Self> {
        let Some(polygon) = polygon else {
            let angle = if deskew { self.skew() } else { 0.0 };
            let map = if angle == 0.0 {
                self
            } else {
                self.rotated(angle)?
            };
            return if trim { map.trimmed() } else { Ok(map) };
        };
        check_crop(polygon)?;
        let mut map = self;
        let [rows, cols] = map.bounds(polygon)?;
        let margin = (MAX_CONTINUATION_SHARE * rows.len().max(cols.len()) as f64).ceil() as usize;
        let near = |range: Range<usize>, end: usize| {
            range.start.saturating_sub(margin)..(range.end + margin).min(end)
        };
        let (rows, cols) = (near(rows, map.height()), near(cols, map.width()));
        map.crop_to(rows, cols)?;
        map = map.with_continued_sheet(margin)?;
        if deskew {
            let corners: Vec<_> = (polygon.iter())
                .map(|corner| map.nearest_pixel(*corner))
                .map(|[x, y]| [x, -y])
                .collect();
            map = map.rotated(polygon_skew(&corners))?;
        }
        if trim && let [a, b, c, d] = *polygon {
            let [rows, cols] = map.upright_rectangle([a, b, c, d]);
            if !rows.is_empty() && !cols.is_empty() {
                map.crop_to(rows, cols)?;
                let whole = map.places().iter().all(|place| !place[0].is_nan());
                return if whole { Ok(map) } else { map.trimmed() };
            }
        }
        for place in map.places_mut() {
            if !polygon_contains(polygon, place.map(f64::from)) {
                *place = [f32::NAN; 2];
            }
        }
        let [rows, cols] = map.bounds(polygon)?;
        map.crop_to(rows, cols)?;
        if trim { map.trimmed() } else { Ok(map) }
    }

    /// Rows and columns of the flat image with places inside a polygon in the photo.
    fn bounds(&self, polygon: &[[f64; 2]]) -> Result<[Range<usize>; 2]> {
        let (mut first, mut last) = ([usize::MAX; 2], [0; 2]);
        for (row, line) in self.places().chunks_exact(self.width()).enumerate() {
            for (col, place) in line.iter().enumerate() {
                if !place[0].is_nan() && polygon_contains(polygon, place.map(f64::from)) {
                    for (k, at) in [row, col].into_iter().enumerate() {
                        first[k] = first[k].min(at);
                        last[k] = last[k].max(at + 1);
                    }
                }
            }
        }
        if first[0] >= last[0] {
            let reason = "nothing of the sheet lies within the part of the photo that is wanted: its \
                          corners are in pixels of the photo, from its upper left";
            return Err(Error::Unsupported {
                format: "flat image",
                reason: reason.into(),
            });
        }
        Ok([0, 1].map(|k| first[k]..last[k]))
    }

    /// The pixel of the flat image whose place is nearest to one in the photo.
    fn nearest_pixel(&self, wanted: [f64; 2]) -> [f64; 2] {
        let mut best = (f64::INFINITY, [0.0; 2]);
        for (row, line) in self.places().chunks_exact(self.width()).enumerate() {
            for (col, place) in line.iter().enumerate() {
                let [x, y] = [0, 1].map(|k| f64::from(place[k]) - wanted[k]);
                // Comparisons with NaN are false.
                if x * x + y * y < best.0 {
                    best = (x * x + y * y, [col as f64, row as f64]);
                }
            }
        }
        best.1
    }

    /// Rows and columns of the upright rectangle of a quadrilateral in the photo: each side passes through the midpoint
    /// of the two corners that lie farthest to that side.
    fn upright_rectangle(&self, corners: [[f64; 2]; 4]) -> [Range<usize>; 2] {
        let pixels = corners.map(|corner| self.nearest_pixel(corner));
        [(1, self.height()), (0, self.width())].map(|(k, end)| {
            let mut at = pixels.map(|pixel| pixel[k]);
            at.sort_by(f64::total_cmp);
            let [low, high] = [0.5 * (at[0] + at[1]), 0.5 * (at[2] + at[3])];
            // Corners are at pixels' centres.
            low.round() as usize..(high.round() as usize + 1).min(end)
        })
    }
}
