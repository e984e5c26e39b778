//! Decoders of height and depth images other than PNG and NPY.

mod colmap;
mod exr;
mod map_pixels;
mod npz;
mod pfm;
pub(super) mod samples;
mod text_grid;
mod tiff;
pub(super) mod tiff_tags;
pub(super) mod webp;

use super::decoded::Decoded;
use super::format::Format;
use super::jpeg;
use crate::error::{Error, Result};

pub use exr::write_exr;
pub use npz::{NpzArray, decode_npz, npz_arrays};
pub use tiff::write_tiff;

/// Decodes the heights of a file that begins like one of the given image format; of an NPZ archive the only array.
///
/// # Errors
/// As [`decode`](super::decode); [`Error::Unsupported`] for PNG and NPY.
pub fn decode(bytes: &[u8], format: Format) -> Result<Decoded> {
    match format {
        Format::Tiff => tiff::decode(bytes),
        Format::Exr => exr::decode(bytes),
        Format::Pfm => pfm::decode(bytes),
        Format::Npz => npz::decode_npz(bytes, None),
        Format::Jpeg => jpeg::decode(bytes),
        Format::WebP => webp::decode(bytes),
        Format::Text => text_grid::decode(bytes),
        Format::Colmap => colmap::decode(bytes),
        Format::Png | Format::Npy => Err(Error::Unsupported {
            format: format.title(),
            reason: "it is decoded elsewhere".into(),
        }),
    }
}
