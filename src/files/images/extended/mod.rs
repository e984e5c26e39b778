//! Decoders of height and depth images other than PNG and NPY.

mod colmap;
mod exr;
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
use super::format::Format;
use super::jpeg;
use super::photo::decode_photo;
use crate::error::{Error, Result};

pub use exr::write_exr;
pub use npz::{NpzArray, npz_arrays};
pub use tiff::write_tiff;

/// Decodes the heights of a file that begins like one of the given image format.
///
/// # Errors
/// As [`decode_with`](super::decode_with); [`Error::Unsupported`] for PNG and NPY.
pub fn decode(bytes: &[u8], format: Format, options: &DecodeOptions) -> Result<Decoded> {
    options.check(format)?;
    let stored = match format {
        Format::Tiff => tiff::decode(bytes),
        Format::Exr => exr::decode(bytes),
        Format::Pfm => pfm::decode(bytes),
        Format::Pgm => pfm::decode_pgm(bytes),
        Format::Npz => npz::decode(bytes, options.array.as_deref()),
        Format::Jpeg => jpeg::decode(bytes),
        Format::WebP => webp::decode(bytes),
        Format::Text => text_grid::decode(bytes),
        Format::Colmap => colmap::decode(bytes),
        Format::Gif | Format::Bmp => samples::from_photo(format, &decode_photo(bytes)?),
        Format::Png | Format::Npy => Err(Error::Unsupported {
            format: format.title(),
            reason: "it is decoded elsewhere".into(),
        }),
    };
    stored?.finish(options)
}
