//! Focal lengths and page formats from the options, converted to the units of the fit.

use super::options::{FocalLength, Format, PageOptions};
use crate::error::{Error, Result, positive};
use crate::scene::camera::focal_length_of;

/// Diagonal of the format of 35 mm film (36 by 24 mm), in millimetres.
const FILM_DIAGONAL_MM: f64 = 43.266_615;

/// Minimum focal length that is accepted, as a multiple of the photo's longer side.
const MIN_FOCAL_RATIO: f64 = 0.05;

/// Maximum ratio of two lengths of a page or a photo that is accepted: of a page's sides, of focal length and photo,
/// and of the principal point's coordinates to the photo's diagonal.
const MAX_LENGTH_RATIO: f64 = 50.0;

/// Returns the principal point in a photo of `size` (width and height) pixels: that of the options, or the photo's middle.
///
/// # Errors
/// [`Error::Option`].
pub(super) fn principal_point(options: &PageOptions, size: [f64; 2]) -> Result<[f64; 2]> {
    let centre = options.centre.unwrap_or(size.map(|n| (n - 1.0) / 2.0));
    let most = MAX_LENGTH_RATIO * size[0].hypot(size[1]);
    if centre.iter().all(|v| v.abs() <= most) {
        return Ok(centre);
    }
    let requirement = "must be two numbers, in pixels, not far outside of the photo";
    Err(Error::option("centre", centre, requirement))
}

/// Converts a given focal length to pixels; None if it is unknown. `size` is the photo's width and height in pixels.
///
/// # Errors
/// [`Error::Option`].
pub(super) fn focal_length(given: FocalLength, size: [f64; 2]) -> Result<Option<f64>> {
    let (longer, diagonal) = (size[0].max(size[1]), size[0].hypot(size[1]));
    let (name, value, found) = match given {
        FocalLength::Unknown => return Ok(None),
        FocalLength::Pixels(pixels) => ("focal_length", pixels, pixels),
        FocalLength::FieldOfView(degrees) => {
            ("field_of_view", degrees, focal_length_of(degrees, longer)?)
        }
        FocalLength::Film35(length) => ("film35", length, length * diagonal / FILM_DIAGONAL_MM),
    };
    positive(name, value)?;
    if !(MIN_FOCAL_RATIO * longer..=MAX_LENGTH_RATIO * longer).contains(&found) {
        let requirement =
            "must give between 1/20 of the photo's longer side and 50 times that, in pixels";
        return Err(Error::option(name, value, requirement));
    }
    Ok(Some(found))
}

/// Ratio and lengths of the sides of a page whose format is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides {
    /// Ratio of the page's height to its width.
    ratio: f64,
    /// Whether the page may also be turned by a quarter (portrait or landscape).
    either: bool,
    /// Width and height of the page in millimetres, if known.
    millimetres: Option<[f64; 2]>,
}

impl Sides {
    /// Ratios of height to width that the page may have: both of a format that may lie across.
    pub fn ratios(&self) -> Vec<f64> {
        match self.either {
            true => vec![self.ratio, 1.0 / self.ratio],
            false => vec![self.ratio],
        }
    }

    /// Width and height of a page in millimetres, if known, where its ratio of height to width is `ratio`.
    pub fn millimetres(&self, ratio: f64) -> Option<[f64; 2]> {
        let [width, height] = self.millimetres?;
        let is_across = self.either && (ratio > 1.0) != (height > width);
        Some(if is_across {
            [height, width]
        } else {
            [width, height]
        })
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
    if !(1.0 / MAX_LENGTH_RATIO..=MAX_LENGTH_RATIO).contains(&ratio) {
        let requirement = "must not be more than 50 times as long as wide";
        return Err(Error::option("format", sides, requirement));
    }
    Ok(Some(Sides {
        ratio,
        either,
        millimetres: (!matches!(format, Format::Ratio(_))).then_some(sides),
    }))
}
