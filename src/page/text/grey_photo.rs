//! Brightness of a photo, reduced by averages of square blocks of pixels to about the resolution of the ink image.

use crate::dewarp::{BoxReduction, Photo, bilinear};
use crate::math::lanes;
use crate::page::working_photo::WorkingPhoto;

/// Maximum width of a page in a grey photo, in pixels: the x-height of body text on A4 is 8 pixels then.
pub(super) const MAX_PAGE_WIDTH: f64 = 1000.0;

/// Brightness of a photo at a reduced resolution, from 0 to 255; NaN where the photo is transparent. Places are given in
/// the photo's own pixels.
pub(in crate::page) struct GreyPhoto {
    /// Numbers of columns and rows.
    size: [usize; 2],
    /// Side of the square of the photo's pixels that is one pixel here.
    block: usize,
    /// Side of the square of the photo's pixels that is one pixel of the photo in which pages are found.
    pub working_block: usize,
    data: Vec<f32>,
}

impl GreyPhoto {
    /// Averages the photo's brightness over squares, of which about 1000 are across a page that is seen `page_width` pixels wide.
    pub fn new(photo: &Photo<'_>, page_width: f64) -> Self {
        let photo = WorkingPhoto::new(photo);
        let squares = page_width / photo.block as f64 / MAX_PAGE_WIDTH;
        let block = squares.round().max(1.0) as usize;
        let reduction = BoxReduction::new(photo.size, block);
        let size @ [width, height] = reduction.size();
        let mut data = Vec::with_capacity(width * height);
        reduction.for_each_mean(&photo.rgba, |[r, g, b]| {
            data.push(lanes::single(0.299 * r + 0.587 * g + 0.114 * b));
        });
        GreyPhoto {
            size,
            block: photo.block * block,
            working_block: photo.block,
            data,
        }
    }

    /// Interpolates the brightness bilinearly at a place in the photo, in pixels; NaN outside of the photo.
    pub fn at(&self, place: [f64; 2]) -> f32 {
        let half = 0.5 * (self.block as f64 - 1.0);
        let [x, y] = place.map(|at| (at - half) / self.block as f64);
        bilinear([x, y], self.size, |i| [f64::from(self.data[i])])
            .map_or(f32::NAN, |[value]| value as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_ramp_is_interpolated_exactly_for_any_block() {
        let (width, height) = (23, 17);
        let level = |x: f64, y: f64| 10.0 + 4.0 * x + 7.0 * y;
        let rgba: Vec<u8> = (0..width * height)
            .flat_map(|i| {
                let grey = level((i % width) as f64, (i / width) as f64) as u8;
                [grey, grey, grey, 255]
            })
            .collect();
        let photo = Photo::new(width, height, &rgba).unwrap();
        for block in [1, 2, 3] {
            let grey = GreyPhoto::new(&photo, f64::from(block) * MAX_PAGE_WIDTH);
            for place in [[5.0, 6.0], [7.25, 3.5], [11.9, 8.1]] {
                let expected = level(place[0], place[1]);
                assert!((f64::from(grey.at(place)) - expected).abs() < 1e-3);
            }
            assert!(grey.at([-1.0, 3.0]).is_nan() && grey.at([3.0, 17.0]).is_nan());
        }
    }

    #[test]
    fn transparent_pixels_have_no_brightness() {
        let photo = [[90, 90, 90, 255], [250, 250, 250, 0]].concat().repeat(8);
        let photo = Photo::new(2, 8, &photo).unwrap();
        assert!(
            GreyPhoto::new(&photo, MAX_PAGE_WIDTH)
                .at([1.0, 4.0])
                .is_nan()
        );
        assert!((GreyPhoto::new(&photo, 2.0 * MAX_PAGE_WIDTH).at([0.5, 4.0]) - 90.0).abs() < 1e-3);
    }
}
