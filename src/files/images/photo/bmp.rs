//! Decodes BMP photos by the `zune-bmp` crate.

use zune_bmp::{BmpDecoder, BmpDecoderErrors};
use zune_core::bytestream::ZCursor;
use zune_core::options::DecoderOptions;

use super::exif::PhotoTags;
use super::pixels::{PhotoFile, PhotoPixels};
use crate::error::{Error, Result, try_filled};
use crate::files::failure::{check_length, damaged, undecodable};

pub(super) fn decode(bytes: &[u8]) -> Result<PhotoFile> {
    let options = DecoderOptions::default()
        .set_strict_mode(true)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX));
    let mut decoder = BmpDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(failed)?;
    let (width, height) = (decoder.dimensions()).ok_or_else(|| damaged("it has no header"))?;
    let mut pixels = PhotoPixels::new([width, height])?;
    let size = (decoder.output_buf_size()).ok_or_else(|| damaged("it has no pixels"))?;
    check_length(bytes, size)?;
    let mut samples = try_filled("BMP image", size, 0)?;
    decoder.decode_into(&mut samples).map_err(failed)?;
    pixels.push_rows(&samples);
    pixels.finish(&PhotoTags::read(None))
}

fn failed(error: BmpDecoderErrors) -> Error {
    undecodable(format!("{error:?}"))
}
