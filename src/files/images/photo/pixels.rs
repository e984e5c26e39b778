//! Pixels of photos: upright, and reduced while they are read if there are too many.

use super::exif::PhotoTags;
use crate::dewarp::BoxReduction;
use crate::error::{Error, MAX_PHOTO_PIXELS, Result};
use crate::files::Assumption;
use crate::files::buffer::reserve;
use crate::files::failure::not_read;
use crate::files::images::orientation::oriented;

/// Maximum number of pixels of a photo's file: a quarter of a gigapixel, of which the decoder holds three bytes each.
pub(super) const MAX_FILE_PIXELS: usize = 1 << 28;

/// A decoded photo: its pixels in colour, and what its metadata say about the camera.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PhotoFile {
    /// Number of pixel columns of the photo.
    pub width: usize,
    /// Number of pixel rows of the photo.
    pub height: usize,
    /// Red, green, blue and alpha of each pixel, row by row, top row first.
    pub rgba: Vec<u8>,
    /// Focal length of the camera, in millimetres for a film of 36 by 24 mm, from the file's Exif data. `None` if
    /// they have none, or if the photo's proportions differ from theirs, as after cropping.
    pub film35: Option<f64>,
    /// Orientation that the file's Exif data state, from 1 (upright) to 8; the pixels are upright already.
    pub orientation: u16,
    /// What the reader assumed because the file does not say it: that fewer pixels are enough, of a photo that has too many.
    pub assumptions: Vec<Assumption>,
}

/// Pixels of a photo as they are stored, while they are read: reduced if the photo has too many.
pub(crate) struct PhotoPixels {
    stored: [usize; 2],
    reduction: BoxReduction,
    rgba: Vec<u8>,
}

impl PhotoPixels {
    /// Prepares for a photo of `width` and `height` pixels, whose sides are divided by the smallest whole number that leaves at most
    /// 26 megapixels.
    ///
    /// # Errors
    /// [`Error::Empty`] for a photo without pixels, [`Error::Unsupported`] for one of more than a quarter of a gigapixel,
    /// [`Error::OutOfMemory`].
    pub fn new([width, height]: [usize; 2]) -> Result<Self> {
        if width == 0 || height == 0 {
            return Err(Error::Empty { what: "photo" });
        }
        if width.saturating_mul(height) > MAX_FILE_PIXELS {
            let reason = format!(
                "it has {width} × {height} pixels, and photos of up to 268 megapixels are read; save it at a lower resolution"
            );
            return Err(not_read(reason));
        }
        let mut block = 1;
        while (width / block).max(1) * (height / block).max(1) > MAX_PHOTO_PIXELS {
            block += 1;
        }
        let reduction = BoxReduction::new([width, height], block);
        let bytes = 4 * reduction.size()[0] * reduction.size()[1];
        let mut rgba = Vec::new();
        reserve(&mut rgba, "photo", bytes)?;
        Ok(PhotoPixels {
            stored: [width, height],
            reduction,
            rgba,
        })
    }

    /// Appends a row of 8-bit samples: of grey, grey and alpha, colours, or colours and alpha.
    pub fn push_row(&mut self, samples: &[u8], line: &mut Vec<u8>) {
        line.clear();
        let white = u8::MAX;
        match samples.len() / self.stored[0] {
            1 => line.extend(samples.iter().flat_map(|grey| [*grey, *grey, *grey, white])),
            2 => {
                let pixels = samples.as_chunks::<2>().0;
                line.extend(
                    pixels
                        .iter()
                        .flat_map(|[grey, a]| [*grey, *grey, *grey, *a]),
                );
            }
            3 => {
                let pixels = samples.as_chunks::<3>().0;
                line.extend(pixels.iter().flat_map(|[r, g, b]| [*r, *g, *b, white]));
            }
            _ => line.extend(samples),
        }
        if self.reduction.size() == self.stored {
            self.rgba.extend(&*line);
        } else {
            self.reduction.push_row(line, &mut self.rgba);
        }
    }

    /// Appends all rows of a photo.
    pub fn push_rows(&mut self, samples: &[u8]) {
        let mut line = Vec::new();
        for row in samples.chunks_exact((samples.len() / self.stored[1]).max(1)) {
            self.push_row(row, &mut line);
        }
    }

    /// Turns the photo upright and adds what its tags say.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn finish(self, tags: &PhotoTags) -> Result<PhotoFile> {
        let [w, h] = self.reduction.size();
        let (rgba, (width, height)) = match tags.orientation {
            1 => (self.rgba, (w, h)),
            turn => {
                let pixels = self.rgba.as_chunks::<4>().0.to_vec();
                let (pixels, size) = oriented(pixels, (w, h), turn)?;
                (pixels.into_flattened(), size)
            }
        };
        let [stored_width, stored_height] = self.stored;
        let reduced = ([w, h] != self.stored).then(|| {
            let words = format!(
                "{w} × {h} of the photo's {stored_width} × {stored_height} pixels are enough"
            );
            Assumption::new("reducedPhoto", words, None)
        });
        Ok(PhotoFile {
            width,
            height,
            rgba,
            film35: tags.film35((stored_width, stored_height)),
            orientation: tags.orientation,
            assumptions: reduced.into_iter().collect(),
        })
    }
}
