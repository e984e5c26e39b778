//! Reads heights of the Shuttle Radar Topography Mission (SRTM, `.hgt`): a square of one degree, in metres, as integers of 16 bits,
//! the larger byte first, from the north downwards. The file's name says where its south-west corner is.

use super::tiff_tags::map_sides;
use crate::error::Result;
use crate::files::Assumption;
use crate::files::image_format::hgt_side;
use crate::files::images::decoded::StoredImage;
use crate::files::images::georeference::Georeference;
use crate::files::images::raw_pixels::raw_pixels;
use crate::files::number_type::NumberType;

/// Height that means no data in the format.
const VOID_METRES: f64 = -32_768.0;

/// Decodes the file of a given name.
pub(super) fn decode(bytes: &[u8], name: &str) -> Result<StoredImage> {
    let side = hgt_side(bytes).unwrap_or_default();
    let values = raw_pixels((side, side), bytes, NumberType::I16, true)?;
    let place = south_west(name);
    let [latitude, longitude] = place.unwrap_or_default();
    let step = 1.0 / (side - 1) as f64;
    let map = Georeference::of_degrees([longitude, latitude + 1.0], [step; 2]);
    let mut assumptions = Vec::new();
    let (sides, unit) = map_sides(&map, (side, side), &mut assumptions)?;
    if place.is_none() {
        let words = "the file's name is not of the form N46E008.hgt, so that its latitude is not known: that of the equator is meant";
        assumptions = vec![Assumption::new("degrees", words, "pixelSize")];
    }
    Ok(StoredImage {
        no_data: Some(VOID_METRES),
        sides: Some(sides),
        unit,
        height_scale: Some(1.0),
        georeference: place.map(|_| map),
        assumptions,
        ..StoredImage::new((side, side), values, NumberType::I16)
    })
}

/// Latitude and longitude of the south-west corner in degrees, by a file's name such as `N46E008.hgt`.
fn south_west(name: &str) -> Option<[f64; 2]> {
    let degrees = |digits: &str| digits.parse::<u8>().ok().map(f64::from);
    let (latitude, longitude) = (degrees(name.get(1..3)?)?, degrees(name.get(4..7)?)?);
    Some([
        match name.get(..1)? {
            "N" | "n" => latitude,
            "S" | "s" => -latitude,
            _ => return None,
        },
        match name.get(3..4)? {
            "E" | "e" => longitude,
            "W" | "w" => -longitude,
            _ => return None,
        },
    ])
}
