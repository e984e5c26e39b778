//! What is known of camera and page, in the terms of the search.

use super::options::{FocalLength, Format};
use crate::error::{Error, Result, positive};
use crate::scene::camera::focal_length_of;

/// A diagonal of film, in millimetres.
const FILM: f64 = 43.266_615;

/// In pixels, and its relative standard deviation.
pub(super) fn focal_length(
    given: FocalLength,
    longer: f64,
    diagonal: f64,
) -> Result<Option<[f64; 2]>> {
    let (name, value, found, deviation) = match given {
        FocalLength::Unknown => return Ok(None),
        FocalLength::Pixels(pixels) => ("focal_length", pixels, pixels, 0.003),
        FocalLength::FieldOfView(degrees) => {
            let pixels = focal_length_of(degrees, longer)?;
            ("field_of_view", degrees, pixels, 0.01)
        }
        FocalLength::Film35(length) => ("film35", length, length * diagonal / FILM, 0.02),
    };
    positive(name, value)?;
    if !(0.05 * longer..=100.0 * longer).contains(&found) {
        let requirement =
            "must give between 1/20 of the photo's longer side and 100 times that, in pixels";
        return Err(Error::option(name, value, requirement));
    }
    Ok(Some([found, deviation]))
}

/// A format.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides {
    /// Height over width.
    ratio: f64,
    /// Whether it may lie across.
    either: bool,
    pub millimetres: Option<[f64; 2]>,
}

impl Sides {
    /// Height over width, the way that is nearer to what is seen.
    pub fn ratio(&self, seen: f64) -> f64 {
        if self.either && (seen > 1.0) != (self.ratio > 1.0) {
            1.0 / self.ratio
        } else {
            self.ratio
        }
    }
}

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
    if !(0.02..=50.0).contains(&ratio) {
        let requirement = "must not be more than 50 times as long as wide";
        return Err(Error::option("format", format!("{sides:?}"), requirement));
    }
    Ok(Some(Sides {
        ratio,
        either,
        millimetres: (!matches!(format, Format::Ratio(_))).then_some(sides),
    }))
}
