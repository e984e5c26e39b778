//! Photo at the resolution at which pages are found in it, which does not depend on the resolution that it comes with.

use std::borrow::Cow;

use crate::dewarp::{BoxReduction, Photo};

/// Maximum length of the longer side of a photo in which a page is found, in pixels: lines of body text on A4 are 20 pixels
/// apart there, which is what their detection needs, and twelve megapixels cost a fourth.
const MAX_WORKING_SIDE: usize = 3072;

/// A photo, halved as often as its longer side is above 3072 pixels, so that a photo of another resolution of the same
/// picture, as readers and pages reduce it, becomes the same one.
pub(super) struct WorkingPhoto<'a> {
    /// RGBA bytes, row by row from the top.
    pub rgba: Cow<'a, [u8]>,
    /// Number of columns and rows.
    pub size: [usize; 2],
    /// Number of the photo's own pixels along the side of one pixel.
    pub block: usize,
}

impl<'a> WorkingPhoto<'a> {
    /// Reduces a photo by the means of square blocks of pixels. Costs one pass over the photo, or nothing where it is small
    /// enough.
    pub fn new(photo: &Photo<'a>) -> Self {
        let own = [photo.width(), photo.height()];
        let mut block = 1;
        while own[0].max(own[1]) / block > MAX_WORKING_SIDE {
            block *= 2;
        }
        let reduction = BoxReduction::new(own, block);
        WorkingPhoto {
            size: reduction.size(),
            block,
            rgba: match block {
                1 => Cow::Borrowed(photo.rgba()),
                _ => Cow::Owned(reduction.reduce(photo.rgba())),
            },
        }
    }
}
