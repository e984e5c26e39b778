//! Photo at the resolution at which pages are found in it, which does not depend on the resolution that it comes with.

use std::borrow::Cow;

use super::edges::{Edges, Trace};
use super::options::{FocalLength, PageOptions, Ruler};
use crate::dewarp::{BoxReduction, Photo};

/// Maximum length of the longer side of a photo in which a page is found, in pixels: lines of body text on A4 are 20 pixels
/// apart there, which is what their detection needs, and twelve megapixels cost a fourth.
const MAX_WORKING_SIDE: usize = 3072;

/// A photo, halved as often as its longer side is above 3072 pixels, so that a photo of another resolution of the same
/// picture, as readers and pages reduce it, becomes the same one.
pub(super) struct WorkingPhoto<'a> {
    width: usize,
    height: usize,
    rgba: Cow<'a, [u8]>,
    /// Scale of this photo to the one that it was made from.
    pub scale: PhotoScale,
}

/// Scale of a photo to its working photo: number of pixels along the side of one pixel of the latter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PhotoScale {
    pub block: f64,
    /// Width and height of the photo, in its own pixels.
    pub photo: [usize; 2],
}

impl<'a> WorkingPhoto<'a> {
    /// Reduces a photo by the means of square blocks of pixels. Costs one pass over the photo, or nothing where it is small
    /// enough.
    pub fn new(photo: &Photo<'a>) -> Self {
        let size = [photo.width(), photo.height()];
        let mut block = 1;
        while size[0].max(size[1]) / block > MAX_WORKING_SIDE {
            block *= 2;
        }
        let reduction = BoxReduction::new(size, block);
        let [width, height] = reduction.size();
        WorkingPhoto {
            width,
            height,
            rgba: match block {
                1 => Cow::Borrowed(photo.rgba()),
                _ => Cow::Owned(reduction.reduce(photo.rgba())),
            },
            scale: PhotoScale {
                block: block as f64,
                photo: size,
            },
        }
    }

    /// Number of columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// RGBA bytes, row by row from the top.
    pub fn rgba(&self) -> &[u8] {
        &self.rgba
    }
}

impl PhotoScale {
    /// Converts a point from pixels of the photo to pixels of the working photo.
    fn to_working(self, point: [f64; 2]) -> [f64; 2] {
        point.map(|at| (at + 0.5) / self.block - 0.5)
    }

    /// Converts a point from pixels of the working photo to pixels of the photo.
    pub fn to_photo(self, point: [f64; 2]) -> [f64; 2] {
        point.map(|at| (at + 0.5) * self.block - 0.5)
    }

    /// Converts traced edges from pixels of the photo to pixels of the working photo.
    pub fn working_edges(self, edges: &Edges) -> Edges {
        edges.map_traces(|trace, _| self.working_trace(trace))
    }

    /// Converts a trace from pixels of the photo to pixels of the working photo.
    pub fn working_trace(self, trace: &Trace) -> Trace {
        trace.map_points(|point| self.to_working(point))
    }

    /// Converts what is known of page and camera from pixels of the photo to pixels of the working photo.
    pub fn working_options(self, options: &PageOptions) -> PageOptions {
        PageOptions {
            focal_length: match options.focal_length {
                FocalLength::Pixels(focal) => FocalLength::Pixels(focal / self.block),
                other => other,
            },
            ruler: options.ruler.map(|ruler| Ruler {
                from: self.to_working(ruler.from),
                to: self.to_working(ruler.to),
                ..ruler
            }),
            centre: options.centre.map(|centre| self.to_working(centre)),
            ..*options
        }
    }
}
