//! Reduced photos as planes of logarithmic red, green and blue.

use crate::dewarp::{BoxReduction, Photo, bilinear};
use crate::page::working_photo::WorkingPhoto;

/// Maximum length of the longer side of a reduced photo or flat page, in pixels: a photo's edges are found to a tenth of such a
/// pixel, and the edge of a hard shadow is followed, as one is 0.4 mm on A4; twelve megapixels cost one pass.
pub(in crate::page) const MAX_REDUCED_SIDE: usize = 800;

/// Number added to a colour component (0 to 255) before its logarithm is taken, so that noise of dark pixels counts
/// little.
/// Its row: `benches/page.md`, Constants of the outline.
pub(in crate::page) const LOG_OFFSET: f32 = 8.0;

/// Share of a pixel's largest colour component that is added to each of its components before the logarithm is taken:
/// under coloured light a component is nearly black, and its logarithm would be noise.
/// Its row: `benches/page.md`, Constants of the outline.
const LARGEST_COMPONENT_SHARE: f64 = 0.3;

/// Distance from the rim, in pixels of a reduced photo or of one at half its resolution, within which what is beside an edge is not seen, and a region's
/// border may be the rim itself.
pub(super) const RIM_PIXELS: f64 = 1.5;

/// A reduced photo as three planes of one size: logarithms of red, green and blue, in which a change of the light adds
/// a constant.
#[derive(Clone)]
pub(in crate::page) struct Planes {
    /// Number of columns of the reduced photo.
    pub width: usize,
    /// Number of rows of the reduced photo.
    pub height: usize,
    /// Logarithms of red, green and blue, row by row.
    pub channels: [Vec<f32>; 3],
    /// Number of the photo's pixels along a side of one pixel of the reduced photo.
    pub scale: f64,
}

impl Planes {
    /// Reduces a photo by averages of square blocks of pixels, to a longer side of at most 800 pixels.
    pub fn from_photo(photo: &Photo<'_>) -> Self {
        let photo = WorkingPhoto::new(photo);
        let [w, h] = photo.size;
        let block = w.max(h).div_ceil(MAX_REDUCED_SIDE);
        let reduction = BoxReduction::new([w, h], block);
        let [width, height] = reduction.size();
        let mut channels = [const { Vec::new() }; 3];
        reduction.for_each_mean(&photo.rgba, |colour| {
            let colour = colour.map(|value| value.max(0.0));
            let largest = colour.iter().copied().fold(0.0, f64::max);
            let offset = f64::from(LOG_OFFSET) + LARGEST_COMPONENT_SHARE * largest;
            for (plane, value) in channels.iter_mut().zip(colour) {
                plane.push((value + offset).ln() as f32);
            }
        });
        Planes {
            width,
            height,
            channels,
            scale: (photo.block * block) as f64,
        }
    }

    /// Returns the reduced photo at half its resolution.
    pub fn halved(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let half = |plane: &Vec<f32>| {
            let at = |x: usize, y: usize| {
                plane[y.min(self.height - 1) * self.width + x.min(self.width - 1)]
            };
            let mean = |i: usize| {
                let (x, y) = (2 * (i % width), 2 * (i / width));
                0.25 * (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1))
            };
            (0..width * height).map(mean).collect()
        };
        Planes {
            width,
            height,
            channels: self.channels.each_ref().map(half),
            scale: 2.0 * self.scale,
        }
    }

    /// Number of pixels of the reduced photo.
    pub fn len(&self) -> usize {
        self.width * self.height
    }

    /// Length of the reduced photo's longer side, in pixels.
    pub fn longer_side(&self) -> f64 {
        self.width.max(self.height) as f64
    }

    /// Bilinear colour at a point; `[0, 0]` is the centre of the upper left pixel. The image continues beyond its rim.
    pub fn colour(&self, [x, y]: [f64; 2]) -> [f32; 3] {
        let size = [self.width, self.height];
        let at = [0, 1].map(|k| [x, y][k].clamp(0.0, size[k] as f64 - 1.0));
        let found = bilinear(at, size, |i| {
            self.channels.each_ref().map(|plane| f64::from(plane[i]))
        });
        found.map_or([f32::NAN; 3], |colour| colour.map(|value| value as f32))
    }

    /// Converts a point from the photo's pixels to the reduced photo's pixels.
    pub fn reduced_point(&self, point: [f64; 2]) -> [f64; 2] {
        point.map(|at| (at + 0.5) / self.scale - 0.5)
    }

    /// Converts a point from the reduced photo's pixels to the photo's pixels.
    pub fn to_photo(&self, point: [f64; 2]) -> [f64; 2] {
        point.map(|at| (at + 0.5) * self.scale - 0.5)
    }
}
