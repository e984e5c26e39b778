//! Decodes TIFF photos, such as scans, by the `tiff` crate.

use ::tiff::ColorType;
use ::tiff::decoder::DecodingResult;
use ::tiff::tags::Tag;

use super::exif::PhotoTags;
use super::pixels::{PhotoFile, PhotoPixels};
use crate::error::Result;
use crate::files::failure::{check_length, not_read};
use crate::files::images::extended::tiff_file::{failed, open, unpacked_bits};
use crate::files::images::extended::tiff_tags::chunky_layout;

/// Maximum memory that the TIFF decoder may allocate, in bytes.
const MAX_DECODER_BYTES: usize = 1 << 30;

pub(super) fn decode(bytes: &[u8]) -> Result<PhotoFile> {
    let mut file = open(bytes, MAX_DECODER_BYTES)?;
    let (width, height) = file.dimensions().map_err(failed)?;
    let [width, height] = [width, height].map(|side| side as usize);
    let mut pixels = PhotoPixels::new([width, height])?;
    let colour = file.colortype().map_err(failed)?;
    let orientation = file
        .find_tag_unsigned::<u16>(Tag::Orientation)
        .map_err(failed)?;
    let layout = chunky_layout(&mut file)?;
    check_length(bytes, layout.len)?;
    let samples = match file.read_image().map_err(failed)? {
        DecodingResult::U8(samples) => samples,
        DecodingResult::U16(samples) => samples.iter().map(|v| (v >> 8) as u8).collect(),
        _ => {
            let reason = "floats, signed integers or integers of more than 16 bits, which are no photo's: read them as heights";
            return Err(not_read(reason));
        }
    };
    let samples = match colour {
        ColorType::Gray(8 | 16)
        | ColorType::GrayA(8 | 16)
        | ColorType::RGB(8 | 16)
        | ColorType::RGBA(8 | 16) => samples,
        ColorType::Gray(1) => unpacked_bits(&samples, width),
        ColorType::CMYK(8 | 16) => (samples.as_chunks::<4>().0.iter())
            .flat_map(|[c, m, y, k]| [c, m, y].map(|ink| printed(*ink, *k)))
            .collect(),
        other => {
            let reason = format!("pixels of kind {other:?}; photos have grey, RGB or CMYK ones");
            return Err(not_read(reason));
        }
    };
    pixels.push_rows(&samples);
    let mut tags = PhotoTags::read(None);
    if let Some(turn @ 1..=8) = orientation {
        tags.orientation = turn;
    }
    pixels.finish(&tags)
}

/// Light of one colour that is left by an ink and by black.
fn printed(ink: u8, black: u8) -> u8 {
    let [ink, black] = [ink, black].map(|ink| u32::from(u8::MAX - ink));
    ((ink * black + 127) / 255) as u8
}
