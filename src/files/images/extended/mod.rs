//! Decoders of height and depth images other than PNG and NPY.

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
use super::photo::decode_other_photo;
use crate::error::Result;
use crate::files::failure::{in_format, not_read};
use crate::files::image_format::Format;

pub use exr::write_exr;
pub use npz::{NpzArray, npz_arrays};
pub use tiff::write_tiff;

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
