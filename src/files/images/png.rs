//! Reads and writes heights as grey PNG files by the `png` crate.

use std::io::{Cursor, ErrorKind};

use ::png::{
    BitDepth, ColorType, Decoder, DecodingError, Encoder, EncodingError, Limits, Reader,
    Transformations, text_metadata::TEXtChunk,
};

use super::decoded::{StoredImage, recorded_sides};
use super::grey::{Channels, grey};
use crate::error::{Error, MAX_CELLS, Result, try_filled};
use crate::files::buffer::Buffer;
use crate::files::failure::{check_length, damaged};
use crate::files::number_type::NumberType;
use crate::heights::heightfield::HeightImage;

/// Maximum memory that the PNG decoder itself may allocate, in bytes: two rows of the widest image and metadata.
const MAX_DECODER_BYTES: usize = 1 << 28;

/// Keyword of the PNG text chunk in which this library writes the height of one grey level: `height = scale · level +
/// offset`.
const HEIGHT_SCALE_KEYWORD: &str = "developable:heightScale";
const HEIGHT_OFFSET_KEYWORD: &str = "developable:heightOffset";
const PIXEL_SIZE: &str = "developable:pixelSize";
const NO_DATA: &str = "developable:noData";

/// Lowest level of 16 bits that [`write_png`] uses for heights; level 0 is no data.
const MIN_HEIGHT_LEVEL: f64 = 1.0;

/// Highest level of 16 bits.
const MAX_HEIGHT_LEVEL: f64 = 65535.0;

/// The decoded samples of a PNG file, its width and height in pixels, and the reader that holds its metadata.
pub(super) struct Pixels<'a> {
    pub reader: PixelReader<'a>,
    pub samples: Vec<u8>,
    pub width: usize,
    pub height: usize,
}

impl<'a> Pixels<'a> {
    /// Decodes a PNG file of at most `max_pixels` pixels.
    pub(super) fn decode(
        bytes: &'a [u8],
        transformations: Transformations,
        max_pixels: usize,
    ) -> Result<Self> {
        let (mut reader, [width, height]) = open(bytes, transformations, max_pixels)?;
        let size = reader
            .output_buffer_size()
            .ok_or_else(|| failed(DecodingError::LimitsExceeded))?;
        let mut samples = try_filled("PNG image", size, 0u8)?;
        reader.next_frame(&mut samples).map_err(failed)?;
        // Reads to the end of the file: text may follow the pixels, and a truncated file must be an error.
        reader.finish().map_err(failed)?;
        Ok(Pixels {
            reader,
            samples,
            width,
            height,
        })
    }
}

/// Reader of the pixels of a PNG file in memory.
type PixelReader<'a> = Reader<Cursor<&'a [u8]>>;

/// Opens a PNG file of at most `max_pixels` pixels; returns the reader of its pixels, and their width and height.
pub(super) fn open(
    bytes: &[u8],
    transformations: Transformations,
    max_pixels: usize,
) -> Result<(PixelReader<'_>, [usize; 2])> {
    let limits = Limits {
        bytes: MAX_DECODER_BYTES,
    };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(transformations);
    decoder.set_ignore_iccp_chunk(true);
    let info = decoder.read_header_info().map_err(failed)?;
    let (width, height) = (info.width as usize, info.height as usize);
    let requested = width.saturating_mul(height);
    if requested > max_pixels {
        return Err(Error::TooLarge {
            what: "PNG image",
            requested,
            limit: max_pixels,
        });
    }
    check_length(bytes, info.raw_bytes())?;
    Ok((decoder.read_info().map_err(failed)?, [width, height]))
}

pub(super) fn decode(bytes: &[u8]) -> Result<StoredImage> {
    let Pixels {
        reader,
        samples,
        width,
        height,
    } = Pixels::decode(bytes, Transformations::EXPAND, MAX_CELLS)?;
    let (color, depth) = reader.output_color_type();
    let number_type = match depth {
        BitDepth::Sixteen => NumberType::U16,
        _ => NumberType::U8,
    };
    let size = number_type.bytes();
    let stride = color.samples() * size;
    let (colours, alpha) = match color {
        ColorType::GrayscaleAlpha => (1, Some(1)),
        ColorType::Rgb => (3, None),
        ColorType::Rgba => (3, Some(3)),
        _ => (1, None),
    };
    let values = grey((width, height), &Channels { colours, alpha }, |i, k| {
        number_type.value(&samples[stride * i + size * k..], true)
    })?;
    let texts = &reader.info().uncompressed_latin1_text;
    Ok(StoredImage {
        sides: recorded(texts, PIXEL_SIZE, true)?.and_then(recorded_sides),
        no_data: recorded(texts, NO_DATA, false)?,
        height_scale: recorded(texts, HEIGHT_SCALE_KEYWORD, true)?,
        offset: recorded(texts, HEIGHT_OFFSET_KEYWORD, false)?.unwrap_or(0.0),
        ..StoredImage::new((width, height), values, number_type)
    })
}

/// The number that this library has recorded in a text chunk with a keyword, which may have to be positive.
fn recorded(chunks: &[TEXtChunk], keyword: &str, is_positive: bool) -> Result<Option<f64>> {
    let Some(chunk) = chunks.iter().rfind(|chunk| chunk.keyword == keyword) else {
        return Ok(None);
    };
    let text = &chunk.text;
    let number = text.trim().parse().ok();
    let number = number.filter(|v: &f64| v.is_finite() && (*v > 0.0 || !is_positive));
    let reason = || format!("its text `{keyword}` is `{text}`, no sound number");
    number.map(Some).ok_or_else(|| damaged(reason()))
}

pub(super) fn failed(error: DecodingError) -> Error {
    match error {
        DecodingError::IoError(cause) if cause.kind() == ErrorKind::UnexpectedEof => {
            damaged("it is cut short")
        }
        other => damaged(format!("its data were damaged ({other})")),
    }
}

/// Writes a height image as a 16-bit grey PNG file: heights are mapped evenly to the levels 1 to 65535, from the lowest
/// to the highest; level 0 is no data.
///
/// Text chunks record scale, offset, pixel size and the no-data level, so that
/// [`decode`](super::decode) gives back every height to half a level, which is
/// 1/131068 of the height range (and to the rounding of 64-bit floats, where
/// the range is tiny beside the heights). Other programs see plain grey levels.
pub(super) fn write_png(image: &HeightImage) -> Result<Vec<u8>> {
    let (scale, offset) = quantisation(image.values());
    let mut samples = try_filled("PNG image", 2 * image.values().len(), 0u8)?;
    for (sample, z) in samples.chunks_exact_mut(2).zip(image.values()) {
        if z.is_finite() {
            // Both are halved, so that the difference of two finite numbers is finite.
            let level = (0.5 * z - 0.5 * offset) / (0.5 * scale);
            let level = level.round().clamp(MIN_HEIGHT_LEVEL, MAX_HEIGHT_LEVEL);
            sample.copy_from_slice(&(level as u16).to_be_bytes());
        }
    }
    let mut file = Buffer::default();
    let written = write(&mut file, image, &samples, scale, offset);
    file.finish("PNG file", written.map_err(Into::into))
}

fn write(
    file: &mut Buffer,
    image: &HeightImage,
    samples: &[u8],
    scale: f64,
    offset: f64,
) -> std::result::Result<(), EncodingError> {
    let mut encoder = Encoder::new(file, image.width() as u32, image.height() as u32);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_depth(BitDepth::Sixteen);
    for (keyword, value) in [
        (HEIGHT_SCALE_KEYWORD, scale),
        (HEIGHT_OFFSET_KEYWORD, offset),
        (PIXEL_SIZE, image.pixel_size()),
        (NO_DATA, 0.0),
    ] {
        // Debug formatting: the shortest digits that read back as the same number.
        encoder.add_text_chunk(keyword.into(), format!("{value:?}"))?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(samples)?;
    writer.finish()
}

/// Computes scale and offset that put the lowest height of an image on grey level 1 and the highest on 65535.
fn quantisation(values: &[f64]) -> (f64, f64) {
    let (low, high) = values
        .iter()
        .filter(|z| z.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| {
            (low.min(*z), high.max(*z))
        });
    if low > high || (low == high && low == 0.0) {
        return (1.0, -MIN_HEIGHT_LEVEL); // no heights at all, or all 0
    }
    let scale = if low < high {
        // Both are divided first, because the difference of two finite numbers may not be finite.
        let steps = MAX_HEIGHT_LEVEL - MIN_HEIGHT_LEVEL;
        high / steps - low / steps
    } else {
        low.abs() / MAX_HEIGHT_LEVEL
    };
    let scale = scale.max(f64::MIN_POSITIVE);
    (scale, (low - scale * MIN_HEIGHT_LEVEL).max(f64::MIN))
}
