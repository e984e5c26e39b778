//! Reads what the tags of a TIFF file say about its pixels: size, unit, no data, orientation.

use std::io::Cursor;

use ::tiff::TiffError;
use ::tiff::decoder::Decoder;
use ::tiff::decoder::ifd::Value;
use ::tiff::tags::Tag;

use super::samples::{damaged, unsupported};
use crate::error::{Error, Result, try_filled};
use crate::files::Unit;
use crate::files::images::format::Format;

pub(super) type File<'a> = Decoder<Cursor<&'a [u8]>>;

/// Length of an inch, in millimetres.
const INCH_MM: f64 = 25.4;

/// Length of a centimetre, in millimetres.
const CENTIMETRE_MM: f64 = 10.0;

/// Value of the TIFF tag `ResolutionUnit` for no unit.
const RESOLUTION_UNIT_NONE: u16 = 1;
const PER_INCH: u16 = 2;
const PER_CENTIMETRE: u16 = 3;

/// Number of the GeoTIFF key `GTModelTypeGeoKey`, which tells whether coordinates are lengths or degrees.
const MODEL_TYPE_KEY: u16 = 1024;

/// Value of the GeoTIFF key `GTModelTypeGeoKey` for degrees of longitude and latitude.
const MODEL_TYPE_GEOGRAPHIC: u16 = 2;
const LINEAR_UNIT: u16 = 3076;

/// Value of the GeoTIFF key `ProjLinearUnitsGeoKey` for metres.
const LINEAR_UNIT_METRE: u16 = 9001;

/// Maximum difference between a pixel's width and height, as a share of the larger one, at which the pixel counts as
/// square.
const NEGLIGIBLE_SIDE_DIFFERENCE: f64 = 1e-6;

/// What the tags of a TIFF file say about its pixels: their size and its unit, the value of no data, the orientation.
pub(super) struct PixelTags {
    pub(super) pixel_size: f64,
    pub(super) unit: Option<Unit>,
    pub(super) no_data: Option<f64>,
    /// Orientation of the image, from 1 to 8, as the TIFF tag `Orientation` numbers it.
    pub(super) orientation: u16,
}

pub(super) fn read(file: &mut File, data_type: &str) -> Result<PixelTags> {
    let (pixel_size, unit) = pixel_size(file)?;
    let no_data = no_data(file, data_type)?;
    let inverted = unsigned(file, Tag::PhotometricInterpretation)? == Some(0);
    if inverted && (no_data.is_some() || !data_type.starts_with('u')) {
        return Err(unsupported(
            Format::Tiff,
            "heights that count from white (WhiteIsZero); write them as BlackIsZero",
        ));
    }
    let orientation = unsigned(file, Tag::Orientation)?.unwrap_or(1);
    if !(1..=8).contains(&orientation) {
        return Err(damaged(
            Format::Tiff,
            format!("its orientation is {orientation}, where 1 to 8 are known"),
        ));
    }
    Ok(PixelTags {
        pixel_size,
        unit,
        no_data,
        orientation,
    })
}

/// Returns whether the pixels of a TIFF file have exactly one extra sample and this is an alpha.
pub(super) fn has_alpha(file: &mut File) -> Result<bool> {
    Ok(matches!(unsigned(file, Tag::ExtraSamples)?, Some(1 | 2)))
}

fn pixel_size(file: &mut File) -> Result<(f64, Option<Unit>)> {
    if let Some(scale) = file.find_tag(Tag::ModelPixelScaleTag).map_err(failed)? {
        let sides = scale.into_f64_vec().map_err(failed)?;
        let [x, y, ..] = sides[..] else {
            return Err(damaged(Format::Tiff, "its pixel scale lacks a number"));
        };
        return Ok((square(x, y)?, geographic_unit(file)?));
    }
    let (Some(x), Some(y)) = (
        resolution(file, Tag::XResolution)?,
        resolution(file, Tag::YResolution)?,
    ) else {
        return Ok((1.0, None));
    };
    let per = match unsigned(file, Tag::ResolutionUnit)?.unwrap_or(PER_INCH) {
        // Without a unit, resolutions state the proportions of a pixel only.
        RESOLUTION_UNIT_NONE => return square(1.0 / x, 1.0 / y).map(|_| (1.0, None)),
        PER_INCH => INCH_MM,
        PER_CENTIMETRE => CENTIMETRE_MM,
        other => {
            return Err(damaged(
                Format::Tiff,
                format!("its unit of resolution is {other}, where 1 to 3 are known"),
            ));
        }
    };
    Ok((square(per / x, per / y)?, Some(Unit::Millimetre)))
}

/// Checks that a pixel's width and height are equal, and returns them as the side length of the pixel.
fn square(x: f64, y: f64) -> Result<f64> {
    if !(x.is_finite() && x > 0.0 && y.is_finite() && y > 0.0) {
        return Err(damaged(
            Format::Tiff,
            format!("its pixels are {x} wide and {y} high, no sound numbers"),
        ));
    }
    if (x - y).abs() > NEGLIGIBLE_SIDE_DIFFERENCE * x.max(y) {
        return Err(unsupported(
            Format::Tiff,
            format!("its pixels are {x} wide and {y} high; only square ones are read: resample it"),
        ));
    }
    Ok(x)
}

/// Reads a TIFF tag that states the number of pixels per unit of length; programs that do not know it write 0, which
/// counts as no resolution.
fn resolution(file: &mut File, tag: Tag) -> Result<Option<f64>> {
    let Some(value) = file.find_tag(tag).map_err(failed)? else {
        return Ok(None);
    };
    let ratio = match value {
        Value::Rational(pixels, lengths) => f64::from(pixels) / f64::from(lengths),
        other => other.into_f64().map_err(failed)?,
    };
    Ok(Some(ratio).filter(|ratio| ratio.is_finite() && *ratio > 0.0))
}

fn geographic_unit(file: &mut File) -> Result<Option<Unit>> {
    let Some(directory) = file.find_tag(Tag::GeoKeyDirectoryTag).map_err(failed)? else {
        return Ok(None);
    };
    let numbers = directory.into_u16_vec().map_err(failed)?;
    // Four numbers each: key, where its value is (0: here), how many there are, the value.
    let key = |wanted| {
        numbers
            .chunks_exact(4)
            .skip(1)
            .find(|entry| entry[0] == wanted && entry[1] == 0)
            .map(|entry| entry[3])
    };
    if key(MODEL_TYPE_KEY) == Some(MODEL_TYPE_GEOGRAPHIC) {
        return Err(unsupported(
            Format::Tiff,
            "its pixels are degrees of longitude and latitude, which are no lengths: project it \
             to a map first",
        ));
    }
    Ok((key(LINEAR_UNIT) == Some(LINEAR_UNIT_METRE)).then_some(Unit::Metre))
}

fn no_data(file: &mut File, data_type: &str) -> Result<Option<f64>> {
    let Some(text) = file.find_tag(Tag::GdalNodata).map_err(failed)? else {
        return Ok(None);
    };
    let text = text.into_string().map_err(failed)?;
    let text = text.trim_matches(['\0', ' ']);
    let value: f64 = text.parse().map_err(|_| {
        damaged(
            Format::Tiff,
            format!("its tag GDAL_NODATA is `{text}`, no number"),
        )
    })?;
    // Rounded as the file stores it: -9999.9 is another number in 32 bits.
    Ok(Some(match data_type {
        "f32" => f64::from(value as f32),
        _ => value,
    }))
}

fn unsigned(file: &mut File, tag: Tag) -> Result<Option<u16>> {
    file.find_tag_unsigned(tag).map_err(failed)
}

/// Rotates or mirrors an image's values by its orientation number, so that the image is upright, and returns them with
/// the new width and height.
pub(super) fn oriented<T: Copy + Default>(
    values: Vec<T>,
    (width, height): (usize, usize),
    orientation: u16,
) -> Result<(Vec<T>, (usize, usize))> {
    if orientation == 1 {
        return Ok((values, (width, height)));
    }
    // In orientations from 5 on, stored rows are displayed as columns.
    let turned = orientation >= 5;
    let (cols, rows) = if turned {
        (height, width)
    } else {
        (width, height)
    };
    let mut seen = try_filled("turned image", values.len(), T::default())?;
    for (i, out) in seen.iter_mut().enumerate() {
        let (row, col) = (i / cols, i % cols);
        let (x, y) = (col, row);
        let (across, down) = (cols - 1 - col, rows - 1 - row);
        let (from_row, from_col) = match orientation {
            2 => (y, across),
            3 => (down, across),
            4 => (down, x),
            5 => (x, y),
            6 => (across, y),
            7 => (across, down),
            _ => (x, down),
        };
        *out = values[from_row * width + from_col];
    }
    Ok((seen, (cols, rows)))
}

pub(super) fn failed(error: TiffError) -> Error {
    match error {
        TiffError::UnsupportedError(what) => unsupported(Format::Tiff, what),
        other => damaged(Format::Tiff, other),
    }
}
