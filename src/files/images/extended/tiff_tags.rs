//! Reads what the tags of a TIFF file say about its pixels: size, unit, no data, orientation.

use ::tiff::decoder::BufferLayoutPreference;
use ::tiff::decoder::ifd::Value;
use ::tiff::tags::Tag;
use nalgebra::{Matrix3, Matrix3x2, RowVector2, Vector3};

use super::tiff_file::{self, File, REDUCED_IMAGE_BIT, failed, unpacked_bits};
use crate::error::Result;
use crate::files::failure::{damaged, not_read};
use crate::files::images::decode_options::DecodeOptions;
use crate::files::images::decoded::StoredImage;
use crate::files::images::georeference::Georeference;
use crate::files::number_type::NumberType;
use crate::files::unit::millimetres_in;
use crate::files::{Assumption, Unit};

/// Checks that the channels of each pixel are stored together, and returns the layout of the image in memory.
pub(crate) fn chunky_layout(file: &mut File) -> Result<BufferLayoutPreference> {
    let layout = file.image_buffer_layout().map_err(failed)?;
    if layout.planes > 1 {
        let reason = "channels stored one after the other; `gdal_translate -co INTERLEAVE=PIXEL IN.tif OUT.tif` \
                      writes them pixel by pixel";
        return Err(not_read(reason));
    }
    Ok(layout)
}

/// Bit of the TIFF tag `NewSubfileType` of the mask of an image, in which 0 stands for no data.
const MASK_BIT: u16 = 4;

/// What follows the first image of a TIFF file.
#[derive(Default)]
pub(super) struct FurtherImages {
    /// Whether there are images of their own; overviews and masks are none.
    pub(super) has_others: bool,
    /// For each pixel of the first image 0 if it has no data, if there is a mask.
    pub(super) mask: Option<Vec<u8>>,
}

/// Reads what follows the first image of a TIFF file, which has `width` columns and `height` rows.
pub(super) fn further_images(
    file: &mut File,
    (width, height): (usize, usize),
) -> Result<FurtherImages> {
    let mut found = FurtherImages::default();
    for index in 1.. {
        if !file.more_images() || file.next_image().is_err() {
            break;
        }
        let kind = unsigned(file, Tag::NewSubfileType).ok().flatten();
        match kind.unwrap_or(0) & (REDUCED_IMAGE_BIT | MASK_BIT) {
            0 => found.has_others = true,
            MASK_BIT => {
                let mut bytes = tiff_file::mask(file, index)?;
                if bytes.len() != width * height {
                    bytes = unpacked_bits(&bytes, width);
                }
                found.mask = Some(bytes);
            }
            _ => {}
        }
    }
    Ok(found)
}

/// Value of the tag `ResolutionUnit` of the TIFF format for no unit.
const RESOLUTION_UNIT_NONE: u16 = 1;
/// Lengths in millimetres of the units that the tag `ResolutionUnit` of the TIFF format numbers from 2: inches and centimetres, and
/// what microscopes add, millimetres and micrometres.
const RESOLUTION_UNITS: [f64; 4] = [25.4, 10.0, 1.0, 1e-3];

/// Number of the TIFF tag `GDAL_METADATA`, an XML text with the scale, the offset and the unit of heights.
pub(super) const GDAL_METADATA: Tag = Tag::Unknown(42112);

/// The tags of a TIFF file that are about its pixels.
pub(super) struct PixelTags {
    /// The image as it is stored, still without its values.
    pub(super) image: StoredImage,
    /// Orientation of the image, from 1 to 8, as the TIFF tag `Orientation` numbers it.
    pub(super) orientation: u16,
}

pub(super) fn read(
    file: &mut File,
    size: (usize, usize),
    number_type: NumberType,
    options: &DecodeOptions,
) -> Result<PixelTags> {
    let mut assumptions = Vec::new();
    let georeference = georeference(file, &mut assumptions)?;
    let mut own_unit = None;
    let (sides, unit) = match &georeference {
        Some(map) => {
            let (sides, unit) = map_sides(map, size, &mut assumptions)?;
            // Without a unit and a place 1 is what is written of pixels of unknown size.
            let is_known = unit.is_some() || map.has_place() || sides != [1.0; 2];
            (Some(sides).filter(|_| is_known), unit)
        }
        None => {
            let resolution = resolution_sides(file)?;
            own_unit = resolution
                .map(|(_, unit)| unit)
                .filter(|_| number_type.is_float() && options.pixel_size.is_none());
            resolution
                .map(|(sides, _)| (sides, Unit::Millimetre))
                .unzip()
        }
    };
    let aspect = match unsigned(file, Tag::ResolutionUnit)? {
        Some(RESOLUTION_UNIT_NONE) => resolutions(file)?.map_or(1.0, |[x, y]| x / y),
        _ => 1.0,
    };
    let (mut height_scale, mut offset) = gdal_heights(file)?;
    if let Some(map) = georeference.as_ref().filter(|map| map.has_system()) {
        let unit = height_unit(file, map)?;
        let of_map = map.linear_unit().filter(|unit| *unit != 1.0);
        if unit.is_none() {
            let words = match of_map {
                Some(_) => "heights are in the unit of the map",
                None => "heights are in metres",
            };
            assumptions.push(Assumption::new("heightUnit", words, "heightScale"));
        }
        let unit = unit.or(of_map).unwrap_or(1.0);
        height_scale = Some(unit * height_scale.unwrap_or(1.0));
        offset *= unit;
    }
    if let (None, Some(unit)) = (height_scale, own_unit) {
        height_scale = Some(unit);
        offset *= unit;
        let words = match unit {
            1.0 => "heights are in millimetres",
            _ => "heights are in the unit of the pixels' size",
        };
        assumptions.push(Assumption::new("heightUnit", words, "heightScale"));
    }
    let no_data = no_data(file)?;
    let inverted = unsigned(file, Tag::PhotometricInterpretation)? == Some(0);
    let is_unsigned = number_type.name().starts_with('u');
    let is_on_map = georeference.as_ref().is_some_and(Georeference::has_system);
    if inverted && (no_data.is_some() || !is_unsigned || is_on_map) {
        return Err(not_read(
            "heights that count from white (WhiteIsZero); write them as BlackIsZero",
        ));
    }
    let orientation = unsigned(file, Tag::Orientation)?.unwrap_or(1);
    if !(1..=8).contains(&orientation) {
        return Err(damaged(format!(
            "its orientation is {orientation}, where 1 to 8 are known"
        )));
    }
    Ok(PixelTags {
        image: StoredImage {
            no_data,
            sides,
            aspect,
            unit,
            height_scale,
            offset,
            georeference,
            assumptions,
            ..StoredImage::new(size, Vec::new(), number_type)
        },
        orientation,
    })
}

/// Returns whether the pixels of a TIFF file have exactly one extra sample and this is an alpha.
pub(super) fn has_alpha(file: &mut File) -> Result<bool> {
    Ok(matches!(unsigned(file, Tag::ExtraSamples)?, Some(1 | 2)))
}

/// Reads where the pixels lie on a map; `None` if no tag says how large they are there.
fn georeference(
    file: &mut File,
    assumptions: &mut Vec<Assumption>,
) -> Result<Option<Georeference>> {
    let mut numbers = |tag| -> Result<Option<Vec<f64>>> {
        let value = file.find_tag(tag).map_err(failed)?;
        value
            .map(|value| value.into_f64_vec().map_err(failed))
            .transpose()
    };
    let mut transformation = match (
        numbers(Tag::ModelTransformationTag)?,
        numbers(Tag::ModelPixelScaleTag)?,
    ) {
        (Some(m), _) if m.len() >= 8 => [m[0], m[1], m[3], m[4], m[5], m[7]],
        (_, Some(sides)) => {
            let [x, y, ..] = sides[..] else {
                return Err(damaged("its pixel scale lacks a number"));
            };
            // Without a tie point the pixels lie anywhere.
            let tie = numbers(Tag::ModelTiepointTag)?.unwrap_or_default();
            let [i, j, u, v] = match tie[..] {
                [i, j, _, u, v, ..] => [i, j, u, v],
                [] => [0.0; 4],
                _ => [f64::NAN; 4],
            };
            // GDAL leaves out a sign of y, which programs write by mistake.
            [x, 0.0, u - i * x, 0.0, -y.abs(), v + j * y.abs()]
        }
        (Some(_), None) => {
            return Err(damaged("its transformation to the map lacks a number"));
        }
        (None, None) => {
            let ties = numbers(Tag::ModelTiepointTag)?.unwrap_or_default();
            let Some(fitted) = fitted(ties.as_chunks().0) else {
                return Ok(None);
            };
            let words = "the image lies on the map as its tie points say on the whole";
            assumptions.push(Assumption::new("place", words, None));
            fitted
        }
    };
    let [_, _, x, _, _, y] = &mut transformation;
    if !(x.is_finite() && y.is_finite()) {
        (*x, *y) = (0.0, 0.0);
        let words = "the image lies at the origin of the map: its tie point is not sound";
        assumptions.push(Assumption::new("place", words, None));
    }
    let doubles = numbers(Tag::GeoDoubleParamsTag)?.unwrap_or_default();
    let keys = match file.find_tag(Tag::GeoKeyDirectoryTag).map_err(failed)? {
        Some(directory) => directory.into_u16_vec().map_err(failed)?,
        None => Vec::new(),
    };
    let text = match file.find_tag(Tag::GeoAsciiParamsTag).map_err(failed)? {
        Some(text) => text.into_string().map_err(failed)?,
        None => String::new(),
    };
    Ok(Some(Georeference {
        transformation,
        keys,
        doubles,
        text,
        size: None,
    }))
}

/// Fits the affine transformation of tie points (column, row, and x, y on the map) by least squares; `None` if they lie on a line.
fn fitted(ties: &[[f64; 6]]) -> Option<[f64; 6]> {
    let (mut normal, mut right) = (Matrix3::zeros(), Matrix3x2::zeros());
    // From the first one, whose place may have many digits.
    let [i0, j0, _, x0, y0, _] = *ties.first()?;
    for [i, j, _, x, y, _] in ties {
        let row = Vector3::new(i - i0, j - j0, 1.0);
        normal += row * row.transpose();
        right += row * RowVector2::new(x - x0, y - y0);
    }
    let [[a, b, x], [d, e, y]] = (normal.try_inverse()? * right).data.0;
    Some([
        a,
        b,
        x0 + x - a * i0 - b * j0,
        d,
        e,
        y0 + y - d * i0 - e * j0,
    ])
}

/// Width and height of the pixels of an image on a map, and their unit.
pub(super) fn map_sides(
    map: &Georeference,
    size: (usize, usize),
    assumptions: &mut Vec<Assumption>,
) -> Result<([f64; 2], Option<Unit>)> {
    let sides = map.pixel_sides(size);
    if !sides.iter().all(|side| side.is_finite() && *side > 0.0) {
        let [x, y] = sides;
        let reason = format!("its pixels are {x} wide and {y} high, no sound numbers");
        return Err(damaged(reason));
    }
    if let Some(latitude) = map.latitude(size) {
        let (code, what) = match (map.is_geographic(), map.angular_unit()) {
            (true, 1.0) => ("degrees", "degrees".to_owned()),
            (true, unit) => ("degrees", format!("angles in units of {unit} degrees")),
            (false, _) => ("webMercator", "lengths on the Web Mercator map".to_owned()),
        };
        let words = format!("{what} are metres at the latitude {latitude:.4} of the middle");
        assumptions.push(Assumption::new(code, words, "pixelSize"));
        return Ok((sides, Some(Unit::Metre)));
    }
    // Without a coordinate system nothing is known of the unit.
    if !map.has_system() {
        return Ok((sides, None));
    }
    let unit = map.linear_unit();
    if unit.is_none() {
        assumptions.push(Assumption::new(
            "mapUnit",
            "map coordinates are in metres",
            "pixelSize",
        ));
    }
    Ok((
        sides.map(|side| side * unit.unwrap_or(1.0)),
        Some(Unit::Metre),
    ))
}

/// Width and height of the pixels by the resolution of a picture, and the unit in which it is stated, all in millimetres; a
/// resolution per inch or centimetre stands for 1.
fn resolution_sides(file: &mut File) -> Result<Option<([f64; 2], f64)>> {
    if let Some(found) = described(file).as_deref().and_then(ome_sides) {
        return Ok(Some(found));
    }
    let Some([x, y]) = resolutions(file)? else {
        return Ok(None);
    };
    if let Some(unit) = described(file).as_deref().and_then(imagej_unit) {
        return Ok(Some(([unit / x, unit / y], unit)));
    }
    let unit = unsigned(file, Tag::ResolutionUnit)?.unwrap_or(2);
    if unit == RESOLUTION_UNIT_NONE {
        // Then resolutions state the proportions of a pixel only.
        return Ok(None);
    }
    let place = usize::from(unit).checked_sub(2);
    let Some(per) = place.and_then(|place| RESOLUTION_UNITS.get(place)) else {
        let reason = format!("its unit of resolution is {unit}, where 1 to 5 are known");
        return Err(damaged(reason));
    };
    Ok(Some(([per / x, per / y], 1.0)))
}

/// Numbers of pixels per unit of length across and down a picture, if it states both.
fn resolutions(file: &mut File) -> Result<Option<[f64; 2]>> {
    let [x, y] = [Tag::XResolution, Tag::YResolution].map(|tag| resolution(file, tag));
    Ok(x?.zip(y?).map(<[f64; 2]>::from))
}

/// The description of a picture. One that is no text is nobody's error: the heights do not depend on it.
fn described(file: &mut File) -> Option<String> {
    file.find_tag(Tag::ImageDescription)
        .ok()??
        .into_string()
        .ok()
}

/// Length in millimetres of the unit that ImageJ names in its description of a picture: its resolutions are pixels per unit.
fn imagej_unit(description: &str) -> Option<f64> {
    let lines = || description.lines().map(str::trim);
    lines().find(|line| line.starts_with("ImageJ="))?;
    lines().find_map(|line| millimetres_in(line.strip_prefix("unit=")?))
}

/// Width and height of a pixel and the unit of the width in millimetres by a microscope's description of a picture (OME-XML),
/// where micrometres are the unit that goes without saying.
fn ome_sides(description: &str) -> Option<([f64; 2], f64)> {
    let attribute = |name: &str| {
        let (_, value) = description.split_once(&format!(" {name}=\""))?;
        value.split('"').next()
    };
    let unit = |name: &str| attribute(&format!("{name}Unit")).map_or(Some(1e-3), millimetres_in);
    let side = |name: &str| {
        let side = unit(name)? * attribute(name)?.parse::<f64>().ok()?;
        (side.is_finite() && side > 0.0).then_some(side)
    };
    let [x, y] = ["PhysicalSizeX", "PhysicalSizeY"];
    (description.contains("<OME")).then_some(([side(x)?, side(y)?], unit(x)?))
}

/// Length of the unit of heights in metres, by the coordinate system or GDAL's metadata.
fn height_unit(file: &mut File, map: &Georeference) -> Result<Option<f64>> {
    let named = gdal_item(file, "unittype")?.and_then(|name| millimetres_in(&name));
    let named = named.map(|length| length / Unit::Metre.millimetres());
    Ok(named.or(map.vertical_unit()))
}

/// Scale and offset of heights by GDAL's metadata: `height = scale · stored + offset`, in the unit of the pixel size.
fn gdal_heights(file: &mut File) -> Result<(Option<f64>, f64)> {
    let mut number = |role| -> Result<Option<f64>> {
        let text = gdal_item(file, role)?;
        Ok(text
            .and_then(|text| text.parse().ok())
            .filter(|value: &f64| value.is_finite()))
    };
    let offset = number("offset")?;
    let scale = number("scale")?.filter(|scale| *scale != 0.0);
    // GDAL's scale beside an offset is 1 where the file names none.
    Ok((scale.or(offset.map(|_| 1.0)), offset.unwrap_or(0.0)))
}

/// Text of an item of GDAL's metadata with the given role, of the first channel or of all.
fn gdal_item(file: &mut File, role: &str) -> Result<Option<String>> {
    let Some(metadata) = file.find_tag(GDAL_METADATA).map_err(failed)? else {
        return Ok(None);
    };
    let metadata = metadata.into_string().map_err(failed)?;
    let role = format!("role=\"{role}\"");
    let item = metadata.split("<Item").skip(1).find_map(|item| {
        let (attributes, rest) = item.split_once('>')?;
        let is_first = !attributes.contains("sample=") || attributes.contains("sample=\"0\"");
        (is_first && attributes.contains(&role)).then(|| rest.split('<').next().unwrap_or_default())
    });
    Ok(item.map(|text| text.trim().to_owned()))
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

fn no_data(file: &mut File) -> Result<Option<f64>> {
    let Some(text) = file.find_tag(Tag::GdalNodata).map_err(failed)? else {
        return Ok(None);
    };
    let text = text.into_string().map_err(failed)?;
    let text = text.trim_matches(['\0', ' ']);
    let value: f64 = text
        .replace(',', ".")
        .parse()
        .map_err(|_| damaged(format!("its tag GDAL_NODATA is `{text}`, no number")))?;
    Ok(Some(value))
}

fn unsigned(file: &mut File, tag: Tag) -> Result<Option<u16>> {
    file.find_tag_unsigned(tag).map_err(failed)
}
