//! What the tags of TIFF files say of heights: size, place, unit and no data.

use std::io::Cursor;

use ::tiff::encoder::colortype::{Gray8, Gray32Float};
use ::tiff::encoder::{ImageEncoder, Rational, TiffEncoder, TiffKindStandard};
use ::tiff::tags::{ResolutionUnit, Tag};
use developable::files::Unit;
use developable::files::images::{
    DecodeOptions, Decoded, Format, decode, decode_with, write_image,
};
use developable::{HeightImage, Result};

/// A file of 3 × 3 grey pixels for each kind of image, as the tag `NewSubfileType` numbers it.
fn images(kinds: &[u32]) -> Result<Decoded> {
    let mut file = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut file).unwrap();
    for kind in kinds {
        let mut image = encoder.new_image::<Gray8>(3, 3).unwrap();
        let tags = image.encoder();
        tags.write_tag(Tag::NewSubfileType, *kind).unwrap();
        image.write_data(&[1, 2, 3, 4, 5, 6, 7, 8, 9]).unwrap();
    }
    decode(&file.into_inner(), None)
}

type Image<'a, 'b> = ImageEncoder<'a, &'b mut Cursor<Vec<u8>>, Gray32Float, TiffKindStandard>;

/// A file of heights in rows of `width`, with what a function writes of tags.
fn file(width: usize, heights: &[f32], write: impl FnOnce(&mut Image<'_, '_>)) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut file).unwrap();
    let rows = heights.len() / width;
    let mut image = encoder
        .new_image::<Gray32Float>(width as u32, rows as u32)
        .unwrap();
    write(&mut image);
    image.write_data(heights).unwrap();
    file.into_inner()
}

/// A file of 3 × 2 heights with tags of numbers.
fn on_map(tags: &[(Tag, &[f64])]) -> Vec<u8> {
    file(3, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], |image| {
        for (tag, numbers) in tags {
            image.encoder().write_tag(*tag, *numbers).unwrap();
        }
    })
}

fn has(read: &Decoded, code: &str) -> bool {
    read.assumptions.iter().any(|one| one.code == code)
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
        let read = decode(&on_map(&[scale, (Tag::ModelTiepointTag, tie)]), None).unwrap();
        let told = (
            read.pixel_size,
            has(&read, "place"),
            read.georeference.is_none(),
        );
        assert_eq!(told, (2.0, is_said, is_said), "{tie:?}");
    }
}

#[test]
fn several_tie_points_say_how_large_pixels_are() {
    let corner = |i: f64, j: f64| [i, j, 0.0, 4e5 + 2.0 * i, 5e6 - 2.0 * j, 0.0];
    let ties = [
        corner(0.0, 0.0),
        corner(3.0, 0.0),
        corner(0.0, 2.0),
        corner(3.0, 2.0),
    ];
    let read = |ties: &[[f64; 6]]| {
        decode(
            &on_map(&[(Tag::ModelTiepointTag, ties.as_flattened())]),
            None,
        )
        .unwrap()
    };
    let map = read(&ties).georeference.unwrap().transformation;
    for (found, known) in map.into_iter().zip([2.0, 0.0, 4e5, 0.0, -2.0, 5e6]) {
        assert!((found - known).abs() < 1e-9, "{map:?}");
    }
    // On a line.
    assert!(read(&ties[..2]).georeference.is_none());
}

#[test]
fn a_sign_of_the_height_of_pixels_turns_nothing() {
    let scale = (Tag::ModelPixelScaleTag, &[2.0, -2.0, 0.0][..]);
    let tie = (Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, 7.0, 9.0, 0.0][..]);
    let read = decode(&on_map(&[scale, tie]), None).unwrap();
    assert_eq!(read.values[..3], [1.0, 2.0, 3.0]);
    assert_eq!(
        read.georeference.unwrap().transformation,
        [2.0, 0.0, 7.0, 0.0, -2.0, 9.0]
    );
}

#[test]
fn strips_that_are_left_out_are_no_heights() {
    let mut bytes = on_map(&[]);
    // The directory's entry of the places of strips, as two bytes for its tag, two for its type, four for their number.
    let entry = [0x11, 0x01, 4, 0, 1, 0, 0, 0];
    let place = bytes.windows(8).position(|there| there == entry).unwrap();
    bytes[place + 8..place + 12].fill(0);
    let error = decode(&bytes, None).unwrap_err();
    assert!(error.to_string().contains("left out"), "{error}");
}

#[test]
fn pixels_have_the_size_that_a_microscope_says() {
    let per_unit = |unit: u16, description: &'static str| {
        let bytes = file(3, &[1.0, 1.001, -9999.5], |image| {
            image.resolution(ResolutionUnit::Inch, Rational { n: 4, d: 1 });
            let tags = image.encoder();
            tags.write_tag(Tag::ResolutionUnit, unit).unwrap();
            tags.write_tag(Tag::ImageDescription, description).unwrap();
            tags.write_tag(Tag::GdalNodata, "-9999,5").unwrap();
        });
        decode(&bytes, None).unwrap()
    };
    // The last one as tifffile writes it, with an attribute whose name is the beginning of another's.
    for (unit, description) in [
        (5, ""),
        (2, "ImageJ=1.53\nunit=um\n"),
        (
            2,
            r#"<?xml version="1.0"?><OME><Image><Pixels SizeX="3" PhysicalSizeXUnit="nm" PhysicalSizeX="250" PhysicalSizeY="0.25"/></Image></OME>"#,
        ),
    ] {
        let read = per_unit(unit, description);
        assert!(
            (read.pixel_size - 2.5e-4).abs() < 1e-12,
            "{description}: {}",
            read.pixel_size
        );
        assert_eq!(read.unit, Some(Unit::Millimetre));
        assert!(read.values[2].is_nan(), "a decimal comma");
    }
    // Without a unit resolutions are proportions.
    let heights: Vec<f32> = (0..24).map(|i| 0.001 * i as f32).collect();
    let bytes = file(8, &heights, |image| {
        image.resolution(ResolutionUnit::None, Rational { n: 72, d: 1 });
        image.y_resolution(Rational { n: 36, d: 1 });
    });
    let read = decode(&bytes, None).unwrap();
    assert_eq!((read.width, read.height, read.unit), (8, 6, None));
    assert!(has(&read, "squarePixels") && has(&read, "pixelSize"));
}

#[test]
fn heights_have_the_unit_of_the_pixels_which_is_told() {
    let read = |description: &str, pixel_size: Option<f64>| {
        let options = DecodeOptions {
            pixel_size,
            ..DecodeOptions::default()
        };
        let heights: Vec<f32> = (0..24).map(|i| i as f32).collect();
        let bytes = file(8, &heights, |image| {
            image.resolution(ResolutionUnit::Inch, Rational { n: 254, d: 1 });
            let tags = image.encoder();
            tags.write_tag(Tag::ImageDescription, description).unwrap();
        });
        let read = decode_with(&bytes, None, &options).unwrap();
        let told = read.assumptions.into_iter().map(|one| one.words);
        (read.pixel_size, read.height_scale, told.collect::<Vec<_>>())
    };
    let (size, scale, told) = read("a scan", None);
    assert!((size - 0.1).abs() < 1e-12 && scale == 1.0, "{size} {scale}");
    assert_eq!(told, ["heights are in millimetres"]);
    let (size, scale, told) = read("ImageJ=1.53\nunit=um\n", None);
    assert!(
        (size - 1e-3 / 254.0).abs() < 1e-12 && scale == 1e-3,
        "{size} {scale}"
    );
    assert_eq!(told, ["heights are in the unit of the pixels' size"]);
    // Pixels of another size have another unit, too.
    let (size, scale, told) = read("ImageJ=1.53\nunit=um\n", Some(0.5));
    assert_eq!((size, scale, told.len()), (0.5, 1.0, 1));
    assert!(told[0].contains("which was given"), "{}", told[0]);
}

/// As a map without a coordinate system has it.
#[test]
fn a_tie_point_alone_is_kept() {
    let map = decode(
        b"ncols 2\nnrows 2\nxllcorner 432100\nyllcorner 5412299\ncellsize 0.5\n1 2 3 4\n",
        None,
    );
    let map = map.unwrap().georeference;
    let image = HeightImage::new(2, 2, vec![1.0, 2.0, 3.0, 4.0]).unwrap();
    let image = image.with_pixel_size(0.5).unwrap();
    for map in [map, None] {
        let read = decode(
            &write_image(&image, Format::Tiff, map.as_ref()).unwrap(),
            None,
        )
        .unwrap();
        assert_eq!(read.georeference, map);
        assert_eq!(
            (read.pixel_size, read.height_scale, read.unit),
            (0.5, 1.0, None)
        );
    }
}

#[test]
fn the_first_of_several_images_is_said_but_no_overview() {
    // GDAL's overview, its mask, and that of the image itself, which has data everywhere.
    for (kinds, is_said) in [
        (&[0][..], false),
        (&[0, 0], true),
        (&[0, 4, 1, 5], false),
        (&[0, 1, 2], true),
    ] {
        let read = images(kinds).unwrap();
        assert_eq!(has(&read, "firstImage"), is_said, "{kinds:?}");
        assert!(!read.values.iter().any(|value| value.is_nan()));
    }
    // As in DNG and NEF, whose full image lies in a directory below.
    let error = images(&[1]).unwrap_err();
    assert_eq!(error.code(), "UNSUPPORTED");
    assert!(error.to_string().contains("raw photo"), "{error}");
}
