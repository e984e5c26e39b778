//! Focal lengths and page formats from the options, converted to the units of the fit.

use super::options::{FocalLength, Format};
use crate::error::{Error, Result, positive};
use crate::scene::camera::focal_length_of;

/// Diagonal of 35 mm film (36 by 24 mm), in millimetres.
const FILM_DIAGONAL_MM: f64 = 43.266_615;

/// Assumed relative standard deviation of a focal length that is given in pixels, as from a calibration.
const FOCAL_PIXELS_DEVIATION: f64 = 0.003;

/// Assumed relative standard deviation of a focal length that is given as a field of view.
const FIELD_OF_VIEW_DEVIATION: f64 = 0.01;

/// Assumed relative standard deviation of a focal length that is given for 35 mm film: Exif rounds it to millimetres.
const FOCAL_FILM35_DEVIATION: f64 = 0.02;

/// Minimum focal length that is accepted, as a multiple of the photo's longer side.
const MIN_FOCAL_RATIO: f64 = 0.05;

/// Maximum focal length that is accepted, as a multiple of the photo's longer side.
const MAX_FOCAL_RATIO: f64 = 100.0;

/// Maximum ratio of a page's longer to its shorter side that is accepted.
const MAX_SIDE_RATIO: f64 = 50.0;

/// Converts a given focal length to pixels, with its relative standard deviation; None if it is unknown. `longer` and
/// `diagonal` are the photo's longer side and diagonal in pixels.
///
/// # Errors
/// [`Error::Option`].
pub(super) fn focal_length(
    given: FocalLength,
    longer: f64,
    diagonal: f64,
) -> Result<Option<[f64; 2]>> {
    let (name, value, found, deviation) = match given {
        FocalLength::Unknown => return Ok(None),
        FocalLength::Pixels(pixels) => ("focal_length", pixels, pixels, FOCAL_PIXELS_DEVIATION),
        FocalLength::FieldOfView(degrees) => {
            let pixels = focal_length_of(degrees, longer)?;
            ("field_of_view", degrees, pixels, FIELD_OF_VIEW_DEVIATION)
        }
        FocalLength::Film35(length) => (
            "film35",
            length,
            length * diagonal / FILM_DIAGONAL_MM,
            FOCAL_FILM35_DEVIATION,
        ),
    };
    positive(name, value)?;
    if !(MIN_FOCAL_RATIO * longer..=MAX_FOCAL_RATIO * longer).contains(&found) {
        let requirement =
            "must give between 1/20 of the photo's longer side and 100 times that, in pixels";
        return Err(Error::option(name, value, requirement));
    }
    Ok(Some([found, deviation]))
}

/// Ratio and lengths of the sides of a page whose format is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides {
    /// Ratio of the page's height to its width.
    ratio: f64,
    /// Whether the page may also be turned by a quarter (portrait or landscape).
    either: bool,
    /// Width and height of the page in millimetres, if known.
    pub millimetres: Option<[f64; 2]>,
}

impl Sides {
    /// Returns the format's ratio of height to width: portrait or landscape, whichever is nearer to the observed ratio
    /// `seen`.
    pub fn ratio(&self, seen: f64) -> f64 {
        if self.either && (seen > 1.0) != (self.ratio > 1.0) {
            1.0 / self.ratio
        } else {
            self.ratio
        }
    }
}

/// Returns the sides of a page of the given format; None if the format is unknown.
///
/// # Errors
/// [`Error::Option`].
pub(super) fn sides(format: Format) -> Result<Option<Sides>> {
    let (sides, either) = match format {
        Format::Unknown => return Ok(None),
        Format::A4 => ([210.0, 297.0], true),
        Format::Letter => ([215.9, 279.4], true),
        Format::Millimetres(sides) => (sides, false),
        Format::Ratio(ratio) => ([1.0, ratio], false),
    };
    for side in sides {
        positive("format", side)?;
    }
    let ratio = sides[1] / sides[0];
    if !(1.0 / MAX_SIDE_RATIO..=MAX_SIDE_RATIO).contains(&ratio) {
        let requirement = "must not be more than 50 times as long as wide";
        return Err(Error::option("format", sides, requirement));
    }
    Ok(Some(Sides {
        ratio,
        either,
        millimetres: (!matches!(format, Format::Ratio(_))).then_some(sides),
    }))
}
