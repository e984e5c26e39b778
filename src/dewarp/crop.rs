//! Cropping of a flat image to a page or to a polygon in the photo.

use std::ops::Range;

use nalgebra::{Matrix2, Vector2};

use super::WarpMap;
use super::deskew::polygon_skew;
use super::local_quadratic::LocalQuadratic;
use crate::error::{Error, Result};
use crate::math::planar::{polygon_area, polygon_contains};
use crate::scene::region::check_crop;

/// Maximum distance by which the sheet is continued beyond its border, as a share of the longer side of the cropped
/// image. Limits how much of a flat image is extrapolated.
const MAX_CONTINUATION_SHARE: f64 = 0.06;

impl WarpMap {
    /// Crops the map to a polygon in the photo, given by its corners in pixels, `[0, 0]` the centre of the upper left
    /// one. The sheet is continued to the polygon's sides, by up to 6 % of the cropped image's longer side, and the
    /// flat image ends there, with straight edges; it is the smallest one that holds the polygon. Four corners are
    /// those of a page: its edges are straight on the sheet, however bent they are in the photo. Costs `O(pixels ·
    /// corners)`.
    ///
    /// # Errors
    /// [`Error::Option`] for fewer than three corners or one that is not finite,
    /// [`Error::Unsupported`] if nothing of the sheet lies within it, [`Error::OutOfMemory`].
    pub fn crop(self, polygon: &[[f64; 2]]) -> Result<Self> {
        self.cut(Some(polygon), false, false)
    }

    /// [Crops](WarpMap::crop) the map, turns it upright (`deskew`), and cuts it to a rectangle without margins
    /// (`trim`).
    ///
    /// Deskewing turns the sides of the polygon upright, on average, or without a polygon the smallest rectangle around
    /// the sheet; [`corner`](WarpMap::corner) is then in axes turned about the sheet's origin. Trimming to a polygon
    /// with four corners, such as those of a page, gives the rectangle whose sides pass through the midpoints between
    /// two corners, whether its edges are seen straight or bent; what is not known of the page, and farther from the
    /// sheet than that is continued, stays transparent. Otherwise it gives the largest upright rectangle within the
    /// sheet.
    ///
    /// [`loss`](WarpMap::loss) then tells how much of the sheet or page the image leaves out.
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
        let is_inside = |place: &[f32; 2]| {
            !place[0].is_nan() && polygon_contains(polygon, place.map(f64::from))
        };
        let [rows, cols] = map.bounds(is_inside).ok_or_else(|| Error::Unsupported {
            format: "flat image",
            reason: "nothing of the sheet lies within the part of the photo that is wanted: its corners are in pixels of \
                     the photo, from its upper left"
                .into(),
        })?;
        let margin = (MAX_CONTINUATION_SHARE * rows.len().max(cols.len()) as f64).ceil() as usize;
        let near = |range: Range<usize>, end: usize| {
            range.start.saturating_sub(margin)..(range.end + margin).min(end)
        };
        let (rows, cols) = (near(rows, map.height()), near(cols, map.width()));
        map.crop_to(rows, cols)?;
        map = map.with_continued_sheet(margin)?;
        let window = 2.0 * margin as f64;
        if deskew {
            let corners: Vec<_> = (polygon.iter())
                .map(|corner| map.pixel_of(*corner, window))
                .map(|[x, y]| [x, -y])
                .collect();
            map = map.rotated(polygon_skew(&corners))?;
        }
        if let [a, b, c, d] = *polygon {
            let outline = [a, b, c, d].map(|corner| map.pixel_of(corner, window));
            let wanted = polygon_area(&outline).abs();
            if trim {
                let [rows, cols] = map.upright_rectangle(outline);
                if !rows.is_empty() && !cols.is_empty() {
                    map.crop_to(rows, cols)?;
                    map.set_page_loss(wanted);
                    return Ok(map);
                }
            }
            map.clear_outside(&outline);
            map.set_page_loss(wanted);
        } else {
            for place in map.places_mut() {
                if !polygon_contains(polygon, place.map(f64::from)) {
                    *place = [f32::NAN; 2];
                }
            }
        }
        if let Some([rows, cols]) = map.bounds(|place| !place[0].is_nan()) {
            map.crop_to(rows, cols)?;
        }
        if trim { map.trimmed() } else { Ok(map) }
    }

    /// Clears all pixels of the flat image outside of a polygon on it; pixels whose centres are on its sides stay.
    fn clear_outside(&mut self, corners: &[[f64; 2]]) {
        let middle =
            [0, 1].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / corners.len() as f64);
        // Half a pixel farther out, since corners are at pixels' centres.
        let outline: Vec<[f64; 2]> = (corners.iter())
            .map(|p| [0, 1].map(|k| p[k] + 0.5 * (p[k] - middle[k]).signum()))
            .collect();
        let width = self.width();
        for (i, place) in self.places_mut().iter_mut().enumerate() {
            if !polygon_contains(&outline, [(i % width) as f64, (i / width) as f64]) {
                *place = [f32::NAN; 2];
            }
        }
    }

    /// Finds the rows and columns of the flat image that show wanted places in the photo; None if there are none.
    fn bounds(&self, is_wanted: impl Fn(&[f32; 2]) -> bool) -> Option<[Range<usize>; 2]> {
        let (mut first, mut last) = ([usize::MAX; 2], [0; 2]);
        for (i, _) in (self.places().iter().enumerate()).filter(|(_, place)| is_wanted(place)) {
            for (k, at) in [i / self.width(), i % self.width()].into_iter().enumerate() {
                first[k] = first[k].min(at);
                last[k] = last[k].max(at + 1);
            }
        }
        (first[0] < last[0]).then(|| [0, 1].map(|k| first[k]..last[k]))
    }

    /// Finds the pixel of the flat image whose place in the photo is nearest to the place `wanted`.
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

    /// Position on the flat image, in pixels, that shows the place `wanted` of the photo: the nearest pixel, corrected
    /// to the exact place by the derivative of the quadratic that fits the map within `window` pixels. So it may lie
    /// beyond the sheet.
    fn pixel_of(&self, wanted: [f64; 2], window: f64) -> [f64; 2] {
        let nearest = self.nearest_pixel(wanted);
        let Some(fit) = LocalQuadratic::new(self, nearest, window) else {
            return nearest;
        };
        let change = |step: [f64; 2]| {
            let [before, after] = [-0.5, 0.5]
                .map(|half| Vector2::from(fit.at([0, 1].map(|k| nearest[k] + half * step[k]))));
            after - before
        };
        let derivative = Matrix2::from_columns(&[change([1.0, 0.0]), change([0.0, 1.0])]);
        let [x, y] = nearest.map(|v| v as usize);
        let miss = Vector2::from(wanted)
            - Vector2::from(self.places()[y * self.width() + x].map(f64::from));
        let step = derivative.try_inverse().map(|inverse| inverse * miss);
        match step {
            Some(step) if step.iter().all(|v| v.is_finite()) => {
                [nearest[0] + step.x, nearest[1] + step.y]
            }
            _ => nearest,
        }
    }

    /// Rows and columns of the upright rectangle that replaces a quadrilateral on the flat image: each side passes
    /// through the midpoint of the two corners that lie farthest to that side.
    fn upright_rectangle(&self, corners: [[f64; 2]; 4]) -> [Range<usize>; 2] {
        [(1, self.height()), (0, self.width())].map(|(k, end)| {
            let mut at = corners.map(|corner| corner[k]);
            at.sort_by(f64::total_cmp);
            let [low, high] = [0.5 * (at[0] + at[1]), 0.5 * (at[2] + at[3])];
            // Corners are at pixels' centres.
            low.round() as usize..(high.round() as usize + 1).min(end)
        })
    }
}
