//! Reads heights from one channel of TIFF images and writes them, by the `tiff` crate.

use std::io::{Cursor, Seek, Write};

use ::tiff::decoder::DecodingSampleType;
use ::tiff::encoder::{DirectoryEncoder, TiffEncoder, TiffKind, colortype};
use ::tiff::tags::Tag;
use ::tiff::{ColorType, TiffError};

use super::samples::narrowed;
use super::tiff_file::{File, failed, open};
use super::tiff_tags;
use crate::error::{Error, Result, checked_cells, try_filled};
use crate::files::Assumption;
use crate::files::buffer::reserve;
use crate::files::failure::{check_length, damaged, not_read};
use crate::files::images::decode_options::DecodeOptions;
use crate::files::images::decoded::StoredImage;
use crate::files::images::georeference::Georeference;
use crate::files::images::grey::{Channels, grey};
use crate::files::images::orientation::oriented;
use crate::files::number_type::NumberType;
use crate::heights::heightfield::HeightImage;

/// Maximum memory that the TIFF decoder itself may allocate, in bytes: a compressed strip, and the values of a tag.
const MAX_DECODER_BYTES: usize = 1 << 28;

pub(super) fn decode(bytes: &[u8], options: &DecodeOptions) -> Result<StoredImage> {
    let mut file = open(bytes, MAX_DECODER_BYTES)?;
    let (width, height) = file.dimensions().map_err(failed)?;
    let stored = (width as usize, height as usize);
    let len = checked_cells("TIFF image", stored.1, stored.0)?;
    if len == 0 {
        return Err(Error::Empty { what: "TIFF image" });
    }

    let color = file.colortype().map_err(failed)?;
    let (samples, bits, channels) = channels(&mut file, color)?;
    let layout = tiff_tags::chunky_layout(&mut file)?;
    let kind = (layout.sample_type.map(number_type)).filter(|kind| kind.bytes() * 8 == bits);
    let Some(kind) = kind else {
        return Err(not_read(format!(
            "samples of {bits} bits; integers of 8 to 64 bits and floats of 16 to 64 are read"
        )));
    };
    let size = kind.bytes();
    let needed = len.saturating_mul(samples * size);
    if layout.len != needed {
        return Err(damaged("its sizes contradict each other"));
    }
    check_length(bytes, needed)?;
    let tags = tiff_tags::read(&mut file, stored, kind, options)?;

    let mut raw = try_filled("TIFF image", needed, 0u8)?;
    file.read_image_bytes(&mut raw).map_err(failed)?;
    let mut values = grey(stored, &channels, |i, k| {
        kind.value(
            &raw[size * (samples * i + k)..][..size],
            cfg!(target_endian = "big"),
        )
    })?;
    let mut image = tags.image;
    let further = tiff_tags::further_images(&mut file, stored)?;
    let masked = values.iter_mut().zip(further.mask.unwrap_or_default());
    let without = masked.filter(|(_, mask)| *mask == 0);
    without.for_each(|(value, _)| *value = f64::NAN);
    if further.has_others {
        let words = "the first of several images is meant";
        (image.assumptions).push(Assumption::new("firstImage", words, None));
    }
    (image.values, image.size) = oriented(values, stored, tags.orientation)?;
    // What is turned after all lies elsewhere on the map, and the size of pixels alone is no place.
    image.georeference = (image.georeference)
        .filter(|map| tags.orientation == 1 && (map.has_system() || map.has_place()));
    if let Some(map) = image.georeference.as_mut().filter(|map| map.is_mirrored()) {
        map.reverse_rows(image.size.1);
        let rows: Vec<&[f64]> = image.values.chunks_exact(image.size.0).rev().collect();
        image.values = rows.concat();
    }
    if tags.orientation >= 5 {
        image.sides = image.sides.map(|[x, y]| [y, x]);
        image.aspect = 1.0 / image.aspect;
    }
    Ok(image)
}

/// Reads the layout of a TIFF file's pixels: the number of samples per pixel, the bits per sample, and what each sample
/// means.
fn channels(file: &mut File, color: ColorType) -> Result<(usize, usize, Channels)> {
    let plain = |colours, alpha| Channels { colours, alpha };
    let (samples, bits, channels) = match color {
        ColorType::Gray(bits) => (1, bits, plain(1, None)),
        ColorType::GrayA(bits) => (2, bits, plain(1, Some(1))),
        ColorType::RGB(bits) => (3, bits, plain(3, None)),
        ColorType::RGBA(bits) => (4, bits, plain(3, Some(3))),
        ColorType::Multiband {
            bit_depth,
            num_samples: 2,
        } if tiff_tags::has_alpha(file)? => (2, bit_depth, plain(1, Some(1))),
        other => {
            let reason = format!(
                "{} channels; one of grey is read, or grey RGB: `gdal_translate -b 1 IN.tif OUT.tif` writes the first",
                other.num_samples()
            );
            return Err(not_read(reason));
        }
    };
    Ok((samples, usize::from(bits), channels))
}

fn number_type(kind: DecodingSampleType) -> NumberType {
    match kind {
        DecodingSampleType::U8 => NumberType::U8,
        DecodingSampleType::U16 => NumberType::U16,
        DecodingSampleType::U32 => NumberType::U32,
        DecodingSampleType::U64 => NumberType::U64,
        DecodingSampleType::I8 => NumberType::I8,
        DecodingSampleType::I16 => NumberType::I16,
        DecodingSampleType::I32 => NumberType::I32,
        DecodingSampleType::I64 => NumberType::I64,
        DecodingSampleType::F16 => NumberType::F16,
        DecodingSampleType::F32 => NumberType::F32,
        DecodingSampleType::F64 => NumberType::F64,
    }
}

/// Writes a height image as a TIFF file, in which `GDAL_NODATA`, too, says that NaN is no data. A georeference is that of an image
/// with as many pixels in metres; where its pixels have another size than those of the image, they get this size, and the first
/// pixel stays in its place.
pub(super) fn write_tiff(image: &HeightImage, map: Option<&Georeference>) -> Result<Vec<u8>> {
    let heights = narrowed("TIFF image", image)?;
    // A strip has at least one row, and takes two numbers.
    let enough = 4 * heights.len() + 16 * image.height() + 4096;
    let mut file = Vec::new();
    reserve(&mut file, "TIFF file", enough)?;
    let mut file = Cursor::new(file);
    write(&mut file, image, &heights, map).map_err(failed)?;
    Ok(file.into_inner())
}

fn write(
    file: &mut Cursor<Vec<u8>>,
    image: &HeightImage,
    heights: &[f32],
    map: Option<&Georeference>,
) -> std::result::Result<(), TiffError> {
    let mut encoder = TiffEncoder::new(file)?;
    let mut picture =
        encoder.new_image::<colortype::Gray32Float>(image.width() as u32, image.height() as u32)?;
    let side = image.pixel_size();
    let tags = picture.encoder();
    match map {
        Some(map) if map.size.is_some() => write_map(tags, map)?,
        Some(map) => write_map(
            tags,
            &map.with_pixel_size((image.width(), image.height()), side),
        )?,
        None => tags.write_tag(Tag::ModelPixelScaleTag, &[side, side, 0.0][..])?,
    }
    tags.write_tag(Tag::GdalNodata, "nan")?;
    picture.write_data(heights)
}

/// GDAL's metadata of heights in metres.
const METRES_METADATA: &str =
    "<GDALMetadata><Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">m</Item></GDALMetadata>";

/// Writes the tags of a georeference.
fn write_map<W: Write + Seek, K: TiffKind>(
    tags: &mut DirectoryEncoder<'_, W, K>,
    map: &Georeference,
) -> std::result::Result<(), TiffError> {
    let [a, b, c, d, e, f] = map.transformation;
    if b == 0.0 && d == 0.0 && e < 0.0 {
        tags.write_tag(Tag::ModelPixelScaleTag, &[a, -e, 0.0][..])?;
        tags.write_tag(Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, c, f, 0.0][..])?;
    } else {
        let rows = [
            [a, b, 0.0, c],
            [d, e, 0.0, f],
            [0.0; 4],
            [0.0, 0.0, 0.0, 1.0],
        ];
        tags.write_tag(Tag::ModelTransformationTag, rows.as_flattened())?;
    }
    if map.has_system() {
        // Heights are in metres, whatever the keys say of those that were read.
        tags.write_tag(tiff_tags::GDAL_METADATA, METRES_METADATA)?;
        tags.write_tag(Tag::GeoKeyDirectoryTag, &map.keys[..])?;
    }
    if !map.doubles.is_empty() {
        tags.write_tag(Tag::GeoDoubleParamsTag, &map.doubles[..])?;
    }
    if !map.text.is_empty() {
        tags.write_tag(Tag::GeoAsciiParamsTag, map.text.as_str())?;
    }
    Ok(())
}
