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
    let about = tiff_tags::read(&mut file, stored, kind, options)?;

    let mut raw = try_filled("TIFF image", needed, 0u8)?;
    file.read_image_bytes(&mut raw).map_err(failed)?;
    let mut values = grey(stored, &channels, |i, k| {
        kind.value(
            &raw[size * (samples * i + k)..][..size],
            cfg!(target_endian = "big"),
        )
    })?;
    let mut image = about.image;
    let further = tiff_tags::further_images(&mut file, stored)?;
    let masked = values.iter_mut().zip(further.mask.unwrap_or_default());
    masked
        .filter(|(_, has_data)| !has_data)
        .for_each(|(value, _)| *value = f64::NAN);
    if further.has_others {
        let words = "the first of several images is meant";
        (image.assumptions).push(Assumption::new("firstImage", words, None));
    }
    (image.values, image.size) = oriented(values, stored, about.orientation)?;
    // What is turned after all lies elsewhere on the map, and the size of pixels alone is no place.
    image.georeference = (image.georeference)
        .filter(|map| about.orientation == 1 && (map.has_system() || map.has_place()));
    if let Some(map) = image.georeference.as_mut().filter(|map| map.is_mirrored()) {
        map.reverse_rows(image.size.1);
        let rows: Vec<&[f64]> = image.values.chunks_exact(image.size.0).rev().collect();
        image.values = rows.concat();
    }
    if about.orientation >= 5 {
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

/// Writes a height image as a TIFF file of 32-bit floats, uncompressed, which are NaN where there is no data (which
/// `GDAL_NODATA` says too). Exact for heights that are 32-bit floats; others are rounded to the nearest one.
///
/// Tags record the pixel size, so that [`decode`](crate::files::images::decode) gives it back. A georeference is that of an image
/// with as many pixels in metres; where its pixels have another size than those of the image, they get this size, and the first
/// pixel stays in its place.
///
/// # Errors
/// [`Error::NotFinite`] for heights beyond 3.4·10³⁸, [`Error::OutOfMemory`].
pub fn write_tiff(image: &HeightImage, map: Option<&Georeference>) -> Result<Vec<u8>> {
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

#[cfg(test)]
mod tests {
    use ::tiff::encoder::{ImageEncoder, Rational, TiffKindStandard, TiffValue};
    use ::tiff::tags::ResolutionUnit;

    use super::*;
    use crate::files::image_format::Format;

    /// A file of 3 × 3 grey pixels for each kind of image, as the tag `NewSubfileType` numbers it.
    fn images(kinds: &[u32]) -> Vec<u8> {
        let mut file = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut file).unwrap();
        for kind in kinds {
            let mut image = encoder.new_image::<colortype::Gray8>(3, 3).unwrap();
            let tags = image.encoder();
            tags.write_tag(Tag::NewSubfileType, *kind).unwrap();
            image.write_data(&[1, 2, 3, 4, 5, 6, 7, 8, 9]).unwrap();
        }
        file.into_inner()
    }

    /// An image with what a function writes of tags.
    fn file<C: colortype::ColorType>(
        [width, height]: [u32; 2],
        pixels: &[C::Inner],
        write: impl FnOnce(&mut ImageEncoder<'_, &mut Cursor<Vec<u8>>, C, TiffKindStandard>),
    ) -> Vec<u8>
    where
        [C::Inner]: TiffValue,
    {
        let mut file = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut file).unwrap();
        let mut image = encoder.new_image::<C>(width, height).unwrap();
        write(&mut image);
        image.write_data(pixels).unwrap();
        file.into_inner()
    }

    /// An image of 3 × 2 heights with tags of numbers.
    fn on_map(tags: &[(Tag, &[f64])]) -> Vec<u8> {
        let heights = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        file::<colortype::Gray32Float>([3, 2], &heights, |image| {
            for (tag, numbers) in tags {
                image.encoder().write_tag(*tag, *numbers).unwrap();
            }
        })
    }

    #[test]
    fn unsound_places_on_a_map_are_said() {
        let scale = (Tag::ModelPixelScaleTag, &[2.0, 2.0, 0.0][..]);
        let ties: [(&[f64], bool); 4] = [
            (&[0.0, 0.0, 0.0, f64::NAN, 9.0, 0.0], true),
            (&[0.0, 0.0, 0.0], true),
            (&[0.0, 0.0, 0.0, 7.0, 9.0, 0.0], false),
            (&[0.0, 0.0, 0.0, 7.0, 9.0], false),
        ];
        for (tie, is_said) in ties {
            let bytes = on_map(&[scale, (Tag::ModelTiepointTag, tie)]);
            let read = decode(&bytes, &DecodeOptions::default()).unwrap();
            assert_eq!(read.sides, Some([2.0; 2]));
            let said = read.assumptions.iter().any(|one| one.code == "place");
            assert_eq!(
                (said, read.georeference.is_none()),
                (is_said, is_said),
                "{tie:?}"
            );
        }
    }

    #[test]
    fn several_tie_points_say_how_large_pixels_are() {
        let corner = |i: f64, j: f64| [i, j, 0.0, 4e5 + 2.0 * i, 5e6 - 2.5 * j, 0.0];
        let ties = [
            corner(0.0, 0.0),
            corner(3.0, 0.0),
            corner(0.0, 2.0),
            corner(3.0, 2.0),
        ];
        let read = |ties: &[[f64; 6]]| {
            let bytes = on_map(&[(Tag::ModelTiepointTag, ties.as_flattened())]);
            decode(&bytes, &DecodeOptions::default()).unwrap()
        };
        let map = read(&ties).georeference.unwrap().transformation;
        for (found, known) in map.into_iter().zip([2.0, 0.0, 4e5, 0.0, -2.5, 5e6]) {
            assert!((found - known).abs() < 1e-9, "{map:?}");
        }
        // On a line.
        assert!(read(&ties[..2]).georeference.is_none());
    }

    #[test]
    fn a_sign_of_the_height_of_pixels_turns_nothing() {
        let scale = (Tag::ModelPixelScaleTag, &[2.0, -2.0, 0.0][..]);
        let tie = (Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, 7.0, 9.0, 0.0][..]);
        let read = decode(&on_map(&[scale, tie]), &DecodeOptions::default()).unwrap();
        assert_eq!(read.values[..3], [1.0, 2.0, 3.0]);
        let map = read.georeference.unwrap().transformation;
        assert_eq!(map, [2.0, 0.0, 7.0, 0.0, -2.0, 9.0]);
    }

    #[test]
    fn strips_that_are_left_out_are_no_heights() {
        let mut bytes = on_map(&[]);
        // The directory's entry of the places of strips, as two bytes for its tag, two for its type, four for their number.
        let entry = [0x11, 0x01, 4, 0, 1, 0, 0, 0];
        let place = bytes.windows(8).position(|there| there == entry).unwrap();
        bytes[place + 8..place + 12].fill(0);
        let error = decode(&bytes, &DecodeOptions::default()).unwrap_err();
        assert!(error.to_string().contains("left out"), "{error}");
    }

    #[test]
    fn tags_of_microscopes_and_of_decimal_commas_are_read() {
        let bytes = file::<colortype::Gray32Float>([2, 1], &[1.0, -9999.5], |image| {
            image.resolution(ResolutionUnit::Inch, Rational { n: 1, d: 2 });
            let tags = image.encoder();
            tags.write_tag(Tag::ResolutionUnit, 5u16).unwrap();
            tags.write_tag(Tag::GdalNodata, "-9999,5").unwrap();
        });
        let read = decode(&bytes, &DecodeOptions::default()).unwrap();
        assert_eq!((read.sides, read.no_data), (Some([2e-3; 2]), Some(-9999.5)));
    }

    #[test]
    fn proportions_of_pixels_are_no_size() {
        // A relief of 0.01, beside which pixels 1 wide are a slab.
        let heights: Vec<f32> = (0..24).map(|i| 0.001 * i as f32).collect();
        let bytes = file::<colortype::Gray32Float>([8, 3], &heights, |image| {
            image.resolution(ResolutionUnit::None, Rational { n: 72, d: 1 });
            image.y_resolution(Rational { n: 36, d: 1 });
        });
        let stored = decode(&bytes, &DecodeOptions::default()).unwrap();
        assert_eq!(
            (stored.sides, stored.unit, stored.aspect),
            (None, None, 2.0)
        );
        let read = stored
            .finish(Format::Tiff, &DecodeOptions::default())
            .unwrap();
        assert_eq!((read.width, read.height), (4, 3));
        let told: Vec<&str> = read.assumptions.iter().map(|one| one.code).collect();
        assert_eq!(told, ["squarePixels", "pixelSize"]);
    }

    #[test]
    fn pixels_have_the_size_that_a_microscope_describes() {
        // As tifffile writes it, with an attribute whose name is the beginning of another's.
        let described = r#"<?xml version="1.0"?><OME><Image ID="Image:0"><Pixels SizeX="2" SizeY="1" PhysicalSizeXUnit="nm" PhysicalSizeX="250" PhysicalSizeY="0.25"/></Image></OME>"#;
        let bytes = file::<colortype::Gray8>([2, 1], &[1, 2], |image| {
            let tags = image.encoder();
            tags.write_tag(Tag::ImageDescription, described).unwrap();
        });
        let stored = decode(&bytes, &DecodeOptions::default()).unwrap();
        let [x, y] = stored.sides.unwrap();
        assert!(
            (x - 2.5e-4).abs() < 1e-12 && (y - 2.5e-4).abs() < 1e-12,
            "{x} {y}"
        );
        assert_eq!(stored.unit, Some(crate::files::Unit::Millimetre));
    }

    #[test]
    fn heights_have_the_unit_of_the_pixels_which_is_told() {
        let read = |description: &str, pixel_size: Option<f64>| {
            let options = DecodeOptions {
                pixel_size,
                ..DecodeOptions::default()
            };
            let heights: Vec<f32> = (0..24).map(|i| i as f32).collect();
            let bytes = file::<colortype::Gray32Float>([8, 3], &heights, |image| {
                image.resolution(ResolutionUnit::Inch, Rational { n: 254, d: 1 });
                let tags = image.encoder();
                tags.write_tag(Tag::ImageDescription, description).unwrap();
            });
            let stored = decode(&bytes, &options).unwrap();
            let read = stored.finish(Format::Tiff, &options).unwrap();
            let told = read.assumptions.iter().map(|one| one.words.clone());
            (read.pixel_size, read.height_scale, told.collect::<Vec<_>>())
        };
        let (size, scale, told) = read("a scan", None);
        assert!((size - 0.1).abs() < 1e-12 && scale == 1.0, "{size} {scale}");
        assert_eq!(told, ["heights are in millimetres"]);
        let (size, scale, told) = read("ImageJ=1.53\nunit=um\n", None);
        assert!((size - 1e-3 / 254.0).abs() < 1e-12, "{size}");
        assert_eq!(
            (scale, &told[0][..]),
            (1e-3, "heights are in the unit of the pixels' size")
        );
        // Pixels of another size have another unit, too.
        let (size, scale, told) = read("ImageJ=1.53\nunit=um\n", Some(0.5));
        assert_eq!((size, scale, told.len()), (0.5, 1.0, 1));
        assert!(told[0].contains("which was given"), "{}", told[0]);
    }

    /// As a map without a coordinate system has it.
    #[test]
    fn a_tie_point_alone_is_kept() {
        let map = Georeference::new([0.5, 0.0, 432_100.0, 0.0, -0.5, 5_412_300.0], &[]);
        let image = HeightImage::new(2, 2, vec![1.0, 2.0, 3.0, 4.0]).unwrap();
        let image = image.with_pixel_size(0.5).unwrap();
        let options = DecodeOptions::default();
        let file = write_tiff(&image, Some(&map)).unwrap();
        let read = decode(&file, &options)
            .unwrap()
            .finish(Format::Tiff, &options)
            .unwrap();
        assert_eq!(read.georeference, Some(map));
        assert_eq!(
            (read.pixel_size, read.height_scale, read.unit),
            (0.5, 1.0, None)
        );
        let file = write_tiff(&image, None).unwrap();
        let read = decode(&file, &options)
            .unwrap()
            .finish(Format::Tiff, &options)
            .unwrap();
        assert_eq!((read.pixel_size, read.georeference), (0.5, None));
    }

    #[test]
    fn a_reduced_first_image_is_that_of_a_raw_photo() {
        // As in DNG and NEF, whose full image lies in a directory below.
        let error = decode(&images(&[1]), &DecodeOptions::default()).unwrap_err();
        assert_eq!(error.code(), "UNSUPPORTED");
        assert!(error.to_string().contains("raw photo"), "{error}");
    }

    #[test]
    fn the_first_of_several_images_is_said_but_no_overview() {
        let told = |kinds: &[u32]| {
            let image = decode(&images(kinds), &DecodeOptions::default()).unwrap();
            image.assumptions.iter().any(|one| one.code == "firstImage")
        };
        assert!(!told(&[0]));
        assert!(told(&[0, 0]));
        // GDAL's overview, its mask, and that of the image itself.
        assert!(!told(&[0, 4, 1, 5]));
        assert!(told(&[0, 1, 2]));
    }
}
