//! Height and depth images other than PNG and NPY.

mod colmap;
mod exr;
mod hgt;
mod map_pixels;
mod npz;
mod pfm;
pub(super) mod samples;
mod text_grid;
mod tiff;
pub(super) mod tiff_file;
pub(super) mod tiff_tags;
pub(super) mod webp;

use super::decode_options::DecodeOptions;
use super::decoded::Decoded;
use super::georeference::{Georeference, on_own_pixels};
use super::photo::decode_other_photo;
use crate::error::Result;
use crate::files::failure::{in_format, not_read, unsupported};
use crate::files::image_format::Format;
use crate::heights::heightfield::HeightImage;

pub use npz::{NpzArray, npz_arrays};

/// Decodes the heights of a file that begins like one of the given image format.
///
/// # Errors
/// As [`decode_with`](super::decode_with); [`Error::Unsupported`](crate::Error::Unsupported) for PNG and NPY.
pub fn decode(bytes: &[u8], format: Format, options: &DecodeOptions) -> Result<Decoded> {
    options.check(format)?;
    let stored = match format {
        Format::Tiff => tiff::decode(bytes, options),
        Format::Exr => exr::decode(bytes, options.array.as_deref()),
        Format::Pfm => pfm::decode(bytes),
        Format::Pgm => pfm::decode_pgm(bytes),
        Format::Npz => npz::decode(bytes, options.array.as_deref()),
        Format::Text => text_grid::decode(bytes),
        Format::Colmap => colmap::decode(bytes),
        Format::Hgt => hgt::decode(bytes, &options.name),
        Format::Jpeg | Format::WebP | Format::Gif | Format::Bmp => {
            samples::from_photo(&decode_other_photo(bytes)?)
        }
        Format::Png | Format::Npy => Err(not_read("it is decoded elsewhere")),
    };
    stored.map_err(in_format(format))?.finish(format, options)
}

/// Writes heights to a file of the given format.
///
/// # Errors
/// As [`write_image`](super::write_image); [`Error::Unsupported`](crate::Error::Unsupported) for PNG and NPY.
pub fn write(image: &HeightImage, format: Format, map: Option<&Georeference>) -> Result<Vec<u8>> {
    match format {
        Format::Tiff => {
            let own = on_own_pixels(map, image)?;
            tiff::write_tiff(own.as_ref().unwrap_or(image), map)
        }
        Format::Exr => exr::write_exr(image),
        _ => Err(unsupported(format, "it is not written here")),
    }
}
