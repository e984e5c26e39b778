//! The part of a photo that is wanted, cut out straight.

use std::ops::Range;

use super::WarpMap;
use super::turn::skew_of;
use crate::error::{Error, Result};
use crate::math::planar::polygon_contains;
use crate::scene::region::check_crop;

/// How far beyond its border the sheet goes on, as a share of the longer side of what is wanted.
const BEYOND: f64 = 0.06;

impl WarpMap {
    /// The map of what lies within a polygon in the photo, given by its corners in pixels, `[0, 0]`
    /// the centre of the upper left one. The sheet is continued to the polygon's sides, by up to 6 % of
    /// what is wanted, and the flat image ends there, with straight edges; it is no
    /// larger than it has to be. Costs `O(pixels · corners)`.
    ///
    /// # Errors
    /// [`Error::Option`] for fewer than three corners or one that is not finite,
    /// [`Error::Unsupported`] if nothing of the sheet lies within it, [`Error::OutOfMemory`].
    pub fn crop(self, polygon: &[[f64; 2]]) -> Result<Self> {
        self.cut(Some(polygon), false, false)
    }

    /// The map as it is wanted: [cropped](WarpMap::crop), turned upright (`deskew`), and a clean rectangle
    /// (`trim`).
    ///
    /// Upright are the sides of the polygon as far as that goes, or else the smallest rectangle around the
    /// sheet; lengths of [`corner`](WarpMap::corner) are then in axes turned about the sheet's origin. The
    /// rectangle of a polygon with four corners, such as those of a page, is the one whose sides pass
    /// through the middles between two of them: the sheet fills it whether its edges are seen straight
    /// or bent. Of others it is the largest upright one that is all sheet.
    ///
    /// # Errors
    /// Those of [`WarpMap::crop`].
    pub fn cut(self, polygon: Option<&[[f64; 2]]>, deskew: bool, trim: bool) -> Result<Self> {
        let Some(polygon) = polygon else {
            let angle = if deskew { self.skew() } else { 0.0 };
            let map = if angle == 0.0 {
                self
            } else {
                self.turned(angle)?
            };
            return if trim { map.trimmed() } else { Ok(map) };
        };
        check_crop(polygon)?;
        let mut map = self;
        let [rows, cols] = map.bounds(polygon)?;
        let margin = (BEYOND * rows.len().max(cols.len()) as f64).ceil() as usize;
        let near = |range: Range<usize>, end: usize| {
            range.start.saturating_sub(margin)..(range.end + margin).min(end)
        };
        let (rows, cols) = (near(rows, map.height()), near(cols, map.width()));
        map.keep(rows, cols)?;
        map = map.continued(margin)?;
        if deskew {
            let corners: Vec<_> = (polygon.iter())
                .map(|corner| map.nearest_pixel(*corner))
                .map(|[x, y]| [x, -y])
                .collect();
            map = map.turned(skew_of(&corners))?;
        }
        if trim && let [a, b, c, d] = *polygon {
            let [rows, cols] = map.rectangle([a, b, c, d]);
            if !rows.is_empty() && !cols.is_empty() {
                map.keep(rows, cols)?;
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
        map.keep(rows, cols)?;
        if trim { map.trimmed() } else { Ok(map) }
    }

    /// The rows and columns in which places are within the polygon.
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

    /// The pixel whose place is nearest to one in the photo.
    fn nearest_pixel(&self, wanted: [f64; 2]) -> [f64; 2] {
        let mut best = (f64::INFINITY, [0.0; 2]);
        for (row, line) in self.places().chunks_exact(self.width()).enumerate() {
            for (col, place) in line.iter().enumerate() {
                let [x, y] = [0, 1].map(|k| f64::from(place[k]) - wanted[k]);
                // Of NaN nothing is less.
                if x * x + y * y < best.0 {
                    best = (x * x + y * y, [col as f64, row as f64]);
                }
            }
        }
        best.1
    }

    /// The rows and columns between the sides of a quadrangle: each of these passes through the middle
    /// between the two corners that lie farthest to that side.
    fn rectangle(&self, corners: [[f64; 2]; 4]) -> [Range<usize>; 2] {
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
