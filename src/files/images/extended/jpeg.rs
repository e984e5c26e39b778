//! Decodes JPEG pictures by the `zune-jpeg` crate, and reads their orientation by `kamadak-exif`.

use exif::{Exif, In, Tag};
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;
use zune_jpeg::errors::DecodeErrors;

use super::samples::{check_length, damaged, picture, rgba_of, unsupported};
use super::tiff_tags::oriented;
use crate::error::{Error, Result, checked_cells, try_filled};
use crate::files::images::decoded::Decoded;
use crate::files::images::format::Format;
use crate::files::images::photo::PhotoFile;
use crate::scene::camera::has_camera_proportions;

/// Maximum number of pixel samples that one byte of a JPEG file can stand for: an even block of 64 takes a few
/// bits, and in a progressive file a run of such blocks does.
const MAX_SAMPLES_PER_BYTE: usize = 4096;

/// Bytes of the marker that ends a JPEG file.
const JPEG_END_MARKER: [u8; 2] = [0xff, 0xd9];

/// Second byte of the JPEG marker that image data follow.
const JPEG_SCAN_MARKER: u8 = 0xda;

pub(super) fn decode(bytes: &[u8]) -> Result<Decoded> {
    let mut file = OpenedJpeg::new(bytes)?;
    let (colours, stride) = file.stored;
    let mut samples = try_filled("JPEG image", stride * file.len, 0u8)?;
    file.decode(colours, &mut samples)?;
    let stored = picture(Format::Jpeg, file.size, &samples, stride)?;
    let (values, (width, height)) = oriented(stored.values, file.size, file.orientation())?;
    Ok(Decoded {
        width,
        height,
        values,
        ..stored
    })
}

pub(super) fn decode_photo(bytes: &[u8]) -> Result<PhotoFile> {
    let mut file = OpenedJpeg::new(bytes)?;
    let rgba = match file.stored {
        (ColorSpace::RGB, _) => {
            // Converted in place, since photos are large. (The decoder's own RGBA is wrong in places without SIMD, as
            // in wasm.)
            let mut rgba = try_filled("JPEG image", file.len, [0; 4])?;
            let samples = rgba.as_flattened_mut();
            file.decode(ColorSpace::RGB, &mut samples[..3 * file.len])?;
            for i in (0..file.len).rev() {
                samples.copy_within(3 * i..3 * i + 3, 4 * i);
                samples[4 * i + 3] = u8::MAX;
            }
            rgba
        }
        (colours, stride) => {
            let mut samples = try_filled("JPEG image", stride * file.len, 0u8)?;
            file.decode(colours, &mut samples)?;
            rgba_of(Format::Jpeg, &samples, stride)?
        }
    };
    let (rgba, size) = oriented(rgba, file.size, file.orientation())?;
    Ok(PhotoFile {
        orientation: file.orientation(),
        film35: file.exif().and_then(|exif| film35(&exif, file.size)),
        ..PhotoFile::new(size, rgba)
    })
}

/// A JPEG file whose headers have been read.
struct OpenedJpeg<'a> {
    decoder: JpegDecoder<ZCursor<&'a [u8]>>,
    options: DecoderOptions,
    size: (usize, usize),
    /// Number of pixels of the picture.
    len: usize,
    /// Colour space of the samples stored in the JPEG file, and number of samples per pixel.
    stored: (ColorSpace, usize),
}

impl<'a> OpenedJpeg<'a> {
    fn new(bytes: &'a [u8]) -> Result<Self> {
        // The decoder fills in missing data at the end.
        if !ends(bytes) {
            return Err(damaged(Format::Jpeg, "it is cut short"));
        }
        let options = DecoderOptions::default()
            .set_strict_mode(true)
            .set_max_width(usize::from(u16::MAX))
            .set_max_height(usize::from(u16::MAX));
        let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
        decoder.decode_headers().map_err(failed)?;
        let info = decoder
            .info()
            .ok_or_else(|| damaged(Format::Jpeg, "it has no header"))?;
        let size = (usize::from(info.width), usize::from(info.height));
        let len = checked_cells("JPEG image", size.1, size.0)?;
        if len == 0 {
            return Err(Error::Empty { what: "JPEG image" });
        }
        let stored = match info.components {
            1 => (ColorSpace::Luma, 1),
            3 => (ColorSpace::RGB, 3),
            other => {
                return Err(unsupported(
                    Format::Jpeg,
                    format!("pixels of {other} components; grey and RGB are read"),
                ));
            }
        };
        check_length(Format::Jpeg, bytes, stored.1 * len, MAX_SAMPLES_PER_BYTE)?;
        Ok(OpenedJpeg {
            decoder,
            options,
            size,
            len,
            stored,
        })
    }

    fn decode(&mut self, colours: ColorSpace, samples: &mut [u8]) -> Result<()> {
        let options = self.options.jpeg_set_out_colorspace(colours);
        self.decoder.set_options(options);
        self.decoder.decode_into(samples).map_err(failed)
    }

    fn exif(&self) -> Option<Exif> {
        let exif = self.decoder.exif()?;
        exif::Reader::new().read_raw(exif.to_vec()).ok()
    }

    /// Reads how the camera was held, as TIFF's orientation number from 1 (upright) to 8; 1 without Exif data.
    fn orientation(&self) -> u16 {
        self.exif().as_ref().map_or(1, orientation)
    }
}

fn failed(error: DecodeErrors) -> Error {
    damaged(Format::Jpeg, format!("{error:?}"))
}

/// Reads how the camera was held from Exif data, as TIFF's orientation number from 1 (upright) to 8. An invalid number
/// counts as 1, since damaged metadata need not mean a damaged picture.
fn orientation(exif: &Exif) -> u16 {
    match number(exif, Tag::Orientation) {
        Some(number @ 1..=8) => number as u16,
        _ => 1,
    }
}

/// Reads the focal length for 35 mm film from Exif data; `None` if the photo was cropped: its proportions are no camera's, or
/// the photo's size in the Exif data has others. Programs that crop a photo keep the data of its camera, and some state
/// the new size.
fn film35(exif: &Exif, (width, height): (usize, usize)) -> Option<f64> {
    let length = number(exif, Tag::FocalLengthIn35mmFilm).filter(|length| *length > 0)?;
    let stated = [Tag::PixelXDimension, Tag::PixelYDimension].map(|tag| number(exif, tag));
    if let [Some(w @ 1..), Some(h @ 1..)] = stated {
        let ratio = |a: f64, b: f64| a.max(b) / a.min(b);
        let off = ratio(width as f64, height as f64) / ratio(f64::from(w), f64::from(h));
        if (off - 1.0).abs() > 0.01 {
            return None;
        }
    }
    has_camera_proportions([width, height]).then_some(f64::from(length))
}

fn number(exif: &Exif, tag: Tag) -> Option<u32> {
    exif.get_field(tag, In::PRIMARY)?.value.get_uint(0)
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
