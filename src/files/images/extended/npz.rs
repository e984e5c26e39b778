//! Reads NumPy's archives of named arrays (NPZ) by the `zip` crate.

use std::io::{Cursor, Read};

use ::zip::ZipArchive;
use ::zip::result::ZipError;

use crate::MAX_CELLS;
use crate::error::{Error, Result};
use crate::files::Assumption;
use crate::files::buffer::reserve;
use crate::files::failure::{check_length, in_format, not_read, undecodable};
use crate::files::image_format::Format;
use crate::files::images::decoded::StoredImage;
use crate::files::images::npy;

/// Maximum size of an NPY file that is read from an archive, in bytes: 64-bit numbers, and a header.
const MAX_NPY_BYTES: usize = 8 * MAX_CELLS + 16_384;

/// Number of bytes that are read from an NPY file in the archive to learn the array's shape and type.
const MAX_HEADER_BYTES: u64 = 16_384;

/// Maximum number of arrays of an NPZ archive that is read.
const MAX_ARRAYS: usize = 1024;

/// Name, shape and type of one array of an NPZ file.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct NpzArray {
    /// Name of the array within the archive, without the ending `.npy`.
    pub name: String,
    /// Extents of the array along its axes; a height image has two, rows and columns.
    pub shape: Vec<u64>,
    /// Type of the array's elements: `"f32"` and the like, or NumPy's own name for elements that are not numbers.
    pub data_type: String,
    /// Whether the array may be an image of heights: it has rows and columns of numbers, and more than a camera's matrix or pose.
    pub may_be_image: bool,
}

/// Maximum number of rows and columns of the matrices of cameras, which lie beside images in files.
const MAX_CAMERA_MATRIX_SIDE: usize = 4;

/// Lists the arrays of an NPZ file, in the order of the file.
///
/// # Errors
/// [`Error::Format`] for a damaged file, [`Error::Unsupported`] for arrays
/// whose header cannot be read, and for more than 1024 of them.
pub fn npz_arrays(bytes: &[u8]) -> Result<Vec<NpzArray>> {
    headers(bytes).map_err(in_format(Format::Npz))
}

fn headers(bytes: &[u8]) -> Result<Vec<NpzArray>> {
    let mut archive = open(bytes)?;
    names(&archive)?
        .into_iter()
        .map(|name| {
            let mut head = Vec::new();
            let entry = archive.by_name(&member(&name)).map_err(failed)?;
            let whole = entry.take(MAX_HEADER_BYTES).read_to_end(&mut head);
            whole.map_err(undecodable)?;
            let (shape, data_type) = npy::describe(&head).map_err(|e| within(&name, e))?;
            let is_large = |(rows, cols): (usize, usize)| rows.min(cols) > MAX_CAMERA_MATRIX_SIDE;
            Ok(NpzArray {
                may_be_image: npy::rows_and_columns(&shape).is_some_and(is_large)
                    && data_type.starts_with(['u', 'i', 'f']),
                name,
                shape,
                data_type,
            })
        })
        .collect()
}

/// Decodes the array of the given name, or the only array that may be an image if no name is given.
pub(super) fn decode(bytes: &[u8], array: Option<&str>) -> Result<StoredImage> {
    let mut archive = open(bytes)?;
    let names = names(&archive)?;
    let mut assumption = None;
    let found = match (array, &names[..]) {
        (Some(wanted), names) => names.iter().find(|name| *name == wanted).cloned(),
        (None, [only]) => Some(only.clone()),
        (None, _) => {
            let mut images = headers(bytes)?.into_iter().filter(|one| one.may_be_image);
            let only = images.next().filter(|_| images.next().is_none());
            only.map(|NpzArray { name, .. }| {
                let words = format!("`{name}` is meant, the only array in it that may be an image");
                assumption = Some(Assumption::new("array", words, "array"));
                name
            })
        }
    };
    let name = &found.ok_or_else(|| {
        let there = format!("`{}`", names.join("`, `"));
        not_read(match array {
            Some(wanted) => format!("it has no array `{wanted}`, only {there}"),
            None => format!("it holds {there}; choose one by the option `array`"),
        })
    })?;
    let entry = archive.by_name(&member(name)).map_err(failed)?;
    let size = usize::try_from(entry.size()).unwrap_or(usize::MAX);
    if size > MAX_NPY_BYTES {
        return Err(Error::TooLarge {
            what: "NPZ array",
            requested: size / 8,
            limit: MAX_CELLS,
        });
    }
    check_length(bytes, size)?;
    let mut file = Vec::new();
    reserve(&mut file, "NPZ array", size)?;
    // The decoder never returns more than the header states, and the archive's checksum verifies it.
    let read = entry.take(size as u64 + 1).read_to_end(&mut file);
    read.map_err(undecodable)?;
    let mut image = crate::files::kind::announced(&file, Some(Format::Npy))
        .and_then(|_| npy::decode(&file))
        .map_err(|e| within(name, e))?;
    image.assumptions.extend(assumption);
    Ok(image)
}

fn open(bytes: &[u8]) -> Result<ZipArchive<Cursor<&[u8]>>> {
    ZipArchive::new(Cursor::new(bytes)).map_err(failed)
}

/// Names of the arrays in an archive, of which there is one at least.
fn names(archive: &ZipArchive<Cursor<&[u8]>>) -> Result<Vec<String>> {
    if archive.len() > MAX_ARRAYS {
        return Err(not_read(format!(
            "{} files in it; {MAX_ARRAYS} are the most",
            archive.len()
        )));
    }
    let names: Vec<String> = (archive.file_names())
        .filter_map(|name| name.strip_suffix(".npy"))
        .map(str::to_owned)
        .collect();
    match names.is_empty() {
        true => Err(not_read("there are no arrays in it")),
        false => Ok(names),
    }
}

fn member(name: &str) -> String {
    format!("{name}.npy")
}

/// Adds the name of an array in an NPZ archive to the text of an error about that array.
fn within(name: &str, mut error: Error) -> Error {
    if let Error::Format { reason, .. } | Error::Unsupported { reason, .. } = &mut error {
        *reason = format!("array `{name}`: {reason}");
    }
    error
}

fn failed(error: ZipError) -> Error {
    match error {
        ZipError::UnsupportedArchive(what) => not_read(what),
        other => undecodable(other),
    }
}
