//! Decodes JPEG pictures by the `zune-jpeg` crate.

use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;
use zune_jpeg::errors::DecodeErrors;

use super::photo::{PhotoFile, PhotoPixels, PhotoTags};
use crate::error::{Error, Result, try_filled};
use crate::files::failure::{check_length, damaged, not_read, undecodable};

/// Bytes of the marker that ends a JPEG file.
const JPEG_END_MARKER: [u8; 2] = [0xff, 0xd9];

/// Second of the two bytes of the JPEG marker that image data follow.
const JPEG_SCAN_MARKER: u8 = 0xda;

/// Decodes a photo in a JPEG file. It is decoded as a whole, three bytes for each pixel, before it is reduced.
pub(super) fn decode_photo(bytes: &[u8]) -> Result<PhotoFile> {
    let mut file = OpenedJpeg::new(bytes)?;
    let mut pixels = PhotoPixels::new([file.size.0, file.size.1])?;
    pixels.push_rows(&file.decode()?);
    pixels.finish(&file.tags())
}

/// A JPEG file whose headers have been read.
pub(super) struct OpenedJpeg<'a> {
    decoder: JpegDecoder<ZCursor<&'a [u8]>>,
    options: DecoderOptions,
    pub(super) size: (usize, usize),
    /// Number of components of each pixel as it is stored.
    pub(super) components: u8,
    /// Colour space of the samples stored in the JPEG file, and number of samples per pixel.
    stored: (ColorSpace, usize),
}

impl<'a> OpenedJpeg<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self> {
        // The decoder fills in missing data at the end.
        if !ends(bytes) {
            return Err(damaged("it is cut short"));
        }
        let options = DecoderOptions::default()
            .set_strict_mode(true)
            .set_max_width(usize::from(u16::MAX))
            .set_max_height(usize::from(u16::MAX));
        let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
        decoder.decode_headers().map_err(failed)?;
        let info = decoder.info().ok_or_else(|| damaged("it has no header"))?;
        let size = (usize::from(info.width), usize::from(info.height));
        let len = size.0 * size.1;
        if len == 0 {
            return Err(Error::Empty { what: "JPEG image" });
        }
        let stored = match info.components {
            1 => (ColorSpace::Luma, 1),
            // Of four inks (CMYK), the decoder makes colours.
            3 | 4 => (ColorSpace::RGB, 3),
            other => {
                return Err(not_read(format!(
                    "pixels of {other} components; grey, RGB and CMYK are read"
                )));
            }
        };
        check_length(bytes, stored.1 * len)?;
        Ok(OpenedJpeg {
            decoder,
            options,
            size,
            components: info.components,
            stored,
        })
    }

    /// Decodes the picture as it is stored: 8-bit samples of grey or of red, green and blue. (The decoder's own RGBA is wrong
    /// in places without SIMD, as in wasm.)
    fn decode(&mut self) -> Result<Vec<u8>> {
        let (colours, stride) = self.stored;
        let mut samples = try_filled("JPEG image", stride * self.size.0 * self.size.1, 0u8)?;
        let options = self.options.jpeg_set_out_colorspace(colours);
        self.decoder.set_options(options);
        self.decoder.decode_into(&mut samples).map_err(failed)?;
        Ok(samples)
    }

    fn tags(&self) -> PhotoTags {
        PhotoTags::read(self.decoder.exif().map(Vec::as_slice))
    }
}

fn failed(error: DecodeErrors) -> Error {
    undecodable(format!("{error:?}"))
}

/// Returns whether a JPEG file is complete: it has the marker of the image's end, not counting pictures within its
/// metadata.
fn ends(bytes: &[u8]) -> bool {
    let mut rest = &bytes[2..];
    while let [0xff, marker, high, low, ..] = *rest {
        let length = 2 + usize::from(u16::from_be_bytes([high, low]));
        let Some(next) = rest.get(length..) else {
            return false;
        };
        rest = next;
        if marker == JPEG_SCAN_MARKER {
            break;
        }
    }
    rest.windows(2).any(|pair| pair == JPEG_END_MARKER)
}
