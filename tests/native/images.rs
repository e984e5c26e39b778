//! Height and depth images: those of other programs, exact round trips, damage.

use std::io::{Cursor, Write};

use developable::dewarp::Photo;
use developable::files::Unit;
use developable::files::images::{
    DecodeOptions, Decoded, DepthEvidence, Format, PhotoOptions, decode, decode_photo, decode_with,
    format_name, npz_arrays, write_image, write_npy, write_photo_jpeg,
};
use developable::{Error, HeightImage};
use proptest::prelude::*;

use crate::native::common::files;

use files::{file, holes, of_every_type, ramp, read};

fn times(factor: f64) -> Vec<f64> {
    ramp().iter().map(|v| v * factor).collect()
}

fn without(mut values: Vec<f64>, pixel: usize) -> Vec<f64> {
    values[pixel] = f64::NAN;
    values
}

fn same(a: f64, b: f64) -> bool {
    a == b || a.is_nan() && b.is_nan()
}

/// A file of 3 rows of 4 with these values.
fn check(name: &str, data_type: &str, expected: &[f64]) -> Decoded {
    let found = read(name);
    assert_eq!((found.width, found.height), (4, 3), "{name}");
    assert_eq!(found.data_type, data_type, "{name}");
    let wrong = (0..12).find(|i| !same(found.values[*i], expected[*i]));
    assert_eq!(wrong, None, "{name}: {:?}", found.values);
    found
}

fn refused(name: &str, code: &str, hint: &str) {
    let error = decode(&file(name), None).unwrap_err();
    assert_eq!(error.code(), code, "{name}: {error}");
    assert!(error.to_string().contains(hint), "{name}: {error}");
}

fn refused_for_its_size(bytes: &[u8], what: &str) {
    let error = decode(bytes, None).unwrap_err();
    assert!(
        matches!(
            error,
            Error::Format { .. }
                | Error::TooLarge { .. }
                | Error::Empty { .. }
                | Error::Unsupported { .. }
        ),
        "{what}: {error:?}"
    );
}

#[test]
fn tiffs_of_every_type() {
    for (name, data_type, expected) in of_every_type() {
        let found = check(&format!("{name}.tif"), data_type, &expected);
        // A quarter of 4 pixels for the whole range of grey levels; other numbers are heights, here steep ones where they are whole.
        let (scale, side) = match data_type {
            "u8" => (1.0 / 255.0, 1.0),
            "u16" => (1.0 / 65535.0, 1.0),
            _ if name.starts_with('f') => (1.0, 1.0),
            _ => (1.0, 60.0),
        };
        let told = (
            found.format,
            found.height_scale,
            found.pixel_size,
            found.unit,
        );
        assert_eq!(told, (Format::Tiff, scale, side, None), "{name}");
    }
}

#[test]
fn tiffs_of_every_layout() {
    for name in ["f4-be", "big", "strips", "tiles", "deflate", "zstd-be"] {
        check(&format!("{name}.tif"), "f32", &holes());
    }
    check("lzw.tif", "u16", &times(700.0));
    check("pages.tif", "f32", &ramp());
    for name in ["packbits", "rgb-grey"] {
        check(&format!("{name}.tif"), "u8", &times(2.0));
    }
    for name in ["rgba-grey", "grey-alpha"] {
        check(&format!("{name}.tif"), "u8", &without(times(2.0), 1));
    }
    let tiles: Vec<f64> = (0..400).map(|i| f64::from((7 * i + 3) % 251)).collect();
    assert_eq!(read("gdal-lzw.tif").values, tiles);
    check("gdal-mask.tif", "f32", &without(ramp(), 1));
    let inverted: Vec<f64> = ramp().iter().map(|v| 255.0 - 2.0 * v).collect();
    check("white-is-zero.tif", "u8", &inverted);
    refused("rgb-colour.tif", "UNSUPPORTED", "row 2, column 1");
    refused("complex.tif", "UNSUPPORTED", "TIFF");
}

#[test]
fn tiffs_are_seen_the_way_their_orientation_says() {
    for orientation in 2..=8 {
        check(&format!("orientation{orientation}.tif"), "f32", &ramp());
    }
}

#[test]
fn tiffs_say_how_large_a_pixel_is_and_what_is_no_data() {
    let close = |name: &str, size: f64, unit| {
        let found = check(name, "f32", &holes());
        assert!((found.pixel_size - size).abs() < 1e-12, "{name}");
        assert_eq!(found.unit, unit, "{name}");
    };
    close("dpi.tif", 0.1, Some(Unit::Millimetre)); // 254 to the inch
    close("per-cm.tif", 0.2, Some(Unit::Millimetre)); // 50 to the centimetre
    close("imagej.tif", 0.25, Some(Unit::Millimetre)); // 4 to the millimetre, named in its description
    close("geo-metres.tif", 0.5, Some(Unit::Metre));
    close("geo.tif", 0.5, None);
    close("no-data.tif", 1.0, None);
    // 0.254 wide and 0.127 high, and 0.5 and 0.25 on a map: there are two pixels for each.
    for (name, side) in [("unequal.tif", 0.127), ("geo-unequal.tif", 0.25)] {
        let found = read(name);
        assert_eq!((found.width, found.height), (8, 3), "{name}");
        assert!((found.pixel_size - side).abs() < 1e-12, "{name}");
        assert_eq!(
            found.assumptions.last().unwrap().code,
            "squarePixels",
            "{name}"
        );
    }
    let degrees = read("geo-degrees.tif");
    assert_eq!(degrees.unit, Some(Unit::Metre));
    assert_eq!(degrees.assumptions[0].code, "degrees");
}

#[test]
fn exrs_of_every_compression_and_channel() {
    for name in [
        "none",
        "rle",
        "zips",
        "zip",
        "piz",
        "luminance",
        "only",
        "among",
        "rgb-grey",
    ] {
        let found = check(&format!("{name}.exr"), "f32", &holes());
        assert_eq!((found.format, found.height_scale), (Format::Exr, 1.0));
    }
    check("half.exr", "f16", &holes());
    check("uint.exr", "u32", &ramp());
    check("alpha.exr", "f32", &without(ramp(), 1));
    refused("rgb-colour.exr", "UNSUPPORTED", "row 0, column 0");
    refused("neither.exr", "UNSUPPORTED", "`u`, `v`");
}

#[test]
fn pfms_of_either_byte_order() {
    for name in ["le.pfm", "be.pfm", "grey.pfm"] {
        assert_eq!(check(name, "f32", &holes()).format, Format::Pfm);
    }
    refused("colour.pfm", "UNSUPPORTED", "row 0, column 0");
    for head in ["Pf\n1 2\n-2.5\n", "Pf\r\n1 2\r\n-2.5\r\n", "Pf 1 2 -2.5 "] {
        let file = [head.as_bytes(), b"\0\0\x80\x3f\0\0\0\x40"].concat();
        let scaled = decode(&file, None).unwrap();
        assert_eq!((scaled.height_scale, scaled.values), (2.5, vec![2.0, 1.0]));
    }
}

#[test]
fn strips_of_zstandard_with_prediction() {
    let signed: Vec<f64> = ramp().iter().map(|v| v - 50.0).collect();
    check("zstd.tif", "i16", &signed);
}

#[test]
fn a_square_of_srtm_lies_where_its_name_says() {
    let side = 1201;
    let mut file = vec![0; 2 * side * side];
    // 258 m in the north-west, below the sea beside it, and a void in the south-east.
    file[..4].copy_from_slice(&[1, 2, 0xff, 0xfe]);
    file[2 * side * side - 2..].copy_from_slice(&[0x80, 0]);
    assert_eq!(Format::detect(&file), Some(Format::Hgt));
    let options = |name: &str| DecodeOptions::default().name(name);
    // Which leaves the pixels as they are.
    let size = options("S34W071.SRTMGL3.hgt").pixel_size(80.0);
    let found = decode_with(&file, None, &size).unwrap();
    assert_eq!(
        (found.width, found.height, found.values.len()),
        (side, side, side * side)
    );
    assert_eq!(found.values[..2], [258.0, -2.0]);
    assert!(found.values[side * side - 1].is_nan());
    // A degree at 33.5 degrees of latitude, by the usual series in kilometres: of longitude 111.412 cos φ − 0.0935 cos 3φ, of
    // latitude 111.133 − 0.5598 cos 2φ + 0.0012 cos 4φ.
    let map = found.georeference.unwrap();
    assert!((1200.0 * map.pixel_size((side, side)) - 0.5 * (92_922.0 + 110_913.0)).abs() < 20.0);
    assert_eq!(
        [map.transformation[2], map.transformation[5]],
        [-71.0, -33.0]
    );
    let unknown = decode_with(&file, None, &options("tile.hgt")).unwrap();
    assert!(unknown.georeference.is_none());
    assert!(unknown.assumptions[0].words.contains("equator"));
}

#[test]
fn depth_maps_of_colmap_are_depths_in_a_unit_of_their_own() {
    let map = |head: &str, depths: &[f32]| {
        let numbers = depths.iter().flat_map(|depth| depth.to_le_bytes());
        decode(&head.bytes().chain(numbers).collect::<Vec<_>>(), None)
    };
    let found = map("3&2&1&", &[1.5, 0.0, 2.5, 3.0, 4.0, 5.0]).unwrap();
    assert_eq!(
        (found.format, found.width, found.height),
        (Format::Colmap, 3, 2)
    );
    assert!(found.values[1].is_nan() && found.values[2] == 2.5);
    // Not in millimetres, however large they are.
    let large = map("3&2&1&", &[300.0; 6]).unwrap();
    assert_eq!(
        (large.depths, large.depth_unit),
        (DepthEvidence::Certain, Unit::Metre)
    );
    let error = map("3&2&1&", &[1.5; 5]).unwrap_err();
    assert!(error.to_string().contains("it is cut short"), "{error}");
    assert_eq!(map("3&2&3&", &[]).unwrap_err().code(), "UNSUPPORTED");
}

#[test]
fn pgms_of_bytes_and_text() {
    let read =
        |bytes: &[u8]| decode(bytes, None).map(|file| (file.format, file.data_type, file.values));
    let levels = vec![1.0, 2.0, 3.0, 255.0];
    let found = (Format::Pgm, "u8", levels.clone());
    assert_eq!(
        read(b"P5\n# of a camera\n2 2\n255\n\x01\x02\x03\xff").unwrap(),
        found
    );
    assert_eq!(read(b"P2 2 2 255 1 2\n3 255").unwrap(), found);
    for file in [
        &b"P5\r\n2 2\r\n255\r\n\x01\x02\x03\xff"[..],
        b"P5\t2 2\t255\t\x01\x02\x03\xff",
    ] {
        assert_eq!(read(file).unwrap(), found);
    }
    let deep = read(b"P5 2 1 65535\n\x01\x02\x03\x04").unwrap();
    assert_eq!(deep, (Format::Pgm, "u16", vec![258.0, 772.0]));
    for damaged in [
        &b"P5 2 2 255\n\x01\x02\x03"[..],
        b"P2 2 2 255 1 2 3",
        b"P2 2 1 255 1 256",
        b"P5 2 1 0\n\0\0",
        b"P5\n# ",
    ] {
        assert_eq!(read(damaged).unwrap_err().code(), "FORMAT", "{damaged:?}");
    }
}

#[test]
fn meshes_are_told_from_images() {
    let name = |bytes: &[u8]| format_name(bytes);
    let mut stl = [0; 134];
    stl[80] = 1;
    assert_eq!(name(&stl), Some("stl"));
    assert_eq!(name(b"OFF\n3 1 0\n"), Some("off"));
    assert_eq!(name(b"# a mesh\nv 1 2 3\n"), Some("obj"));
    assert_eq!(name(b"1 2 3\n4 5 6\n"), Some("text"));
    assert_eq!(name(&file("one.npz")), Some("npz"));
    assert_eq!(name(&file("f4.tif")), Some("tiff"));
    assert_eq!(name(b"hello"), None);
    let error = decode(&stl, None).unwrap_err().to_string();
    assert!(
        error.starts_with("STL: ") && error.contains("a name that ends in .stl"),
        "{error}"
    );
}

#[test]
fn npz_archives_by_name() {
    assert_eq!(check("one.npz", "f32", &holes()).format, Format::Npz);
    check("deflated.npz", "f64", &holes());
    refused(
        "several.npz",
        "UNSUPPORTED",
        "`depth`, `confidence`, `name`",
    );
    refused("none.npz", "UNSUPPORTED", "no arrays");
    let several = file("several.npz");
    let chosen = decode_with(
        &several,
        None,
        &DecodeOptions::default().array("confidence"),
    )
    .unwrap();
    assert_eq!((chosen.data_type, chosen.values), ("u8", ramp()));
    let error = decode_with(&several, None, &DecodeOptions::default().array("colour")).unwrap_err();
    assert!(error.to_string().contains("no array `colour`"), "{error}");
    let error = decode_with(&several, None, &DecodeOptions::default().array("name")).unwrap_err();
    assert!(error.to_string().contains("array `name`"), "{error}");
    let arrays = npz_arrays(&several).unwrap();
    let told: Vec<_> = arrays
        .iter()
        .map(|a| (a.name.as_str(), a.shape.as_slice(), a.data_type.as_str()))
        .collect();
    assert_eq!(
        told,
        [
            ("depth", &[3, 4][..], "f64"),
            ("confidence", &[3, 4], "u8"),
            ("name", &[1], "<U1")
        ]
    );
}

#[test]
fn the_only_image_beside_a_camera_is_read_and_said() {
    let arrays = |names: &[(&str, [usize; 2])]| {
        let mut file = zip::ZipWriter::new(Cursor::new(Vec::new()));
        for (name, [rows, cols]) in names {
            let array = write_npy(*rows, *cols, &vec![1.5; rows * cols]).unwrap();
            let stored = zip::write::SimpleFileOptions::default();
            file.start_file(format!("{name}.npy"), stored).unwrap();
            file.write_all(&array).unwrap();
        }
        decode(&file.finish().unwrap().into_inner(), None)
    };
    let read = arrays(&[("K", [3, 3]), ("depth", [5, 6]), ("pose", [4, 4])]).unwrap();
    assert_eq!((read.width, read.assumptions[0].code), (6, "array"));
    assert!(read.assumptions[0].words.contains("`depth` is meant"));
    let error = arrays(&[("near", [5, 6]), ("far", [5, 6])]).unwrap_err();
    assert!(
        error.to_string().contains("`near`, `far`; choose one"),
        "{error}"
    );
}

#[test]
fn pictures_are_read_where_they_are_grey() {
    // Blocks of 8 by 8 with one level each, which JPEG keeps to a level or so.
    for (name, tolerance) in [
        ("grey.jpg", 1.0),
        ("progressive.jpg", 1.0),
        ("rgb-grey.jpg", 1.0),
        ("lossy.webp", 4.0),
    ] {
        let found = read(name);
        assert_eq!((found.width, found.height), (16, 16), "{name}");
        assert_eq!((found.data_type, found.height_scale), ("u8", 4.0 / 255.0));
        for (i, level) in found.values.iter().enumerate() {
            let expected = 4.0 * ramp()[i / 128 * 4 + i % 16 / 8];
            assert!(
                (level - expected).abs() <= tolerance,
                "{name}, {i}: {level}"
            );
        }
    }
    assert_eq!(check("grey.webp", "u8", &times(2.0)).format, Format::WebP);
    check("alpha.webp", "u8", &without(times(2.0), 1));
    refused("colour.webp", "UNSUPPORTED", "row 2, column 1");
    refused("colour.jpg", "UNSUPPORTED", "row 0, column 0");
}

#[test]
fn jpegs_are_seen_the_way_their_exif_says() {
    for orientation in 2..=8 {
        let name = format!("exif{orientation}.jpg");
        let found = read(&name);
        assert_eq!((found.width, found.height), (24, 16), "{name}");
        for (i, level) in found.values.iter().enumerate() {
            let expected = 4.0 * ramp()[i / 24 / 8 * 4 + i % 24 / 8];
            assert!((level - expected).abs() <= 1.0, "{name}, {i}: {level}");
        }
    }
    // Damage to what Exif says is none to the picture.
    let mut bytes = file("exif6.jpg");
    let at = bytes.windows(4).position(|w| w == b"Exif").unwrap();
    bytes[at + 6..at + 8].copy_from_slice(b"??");
    let found = decode(&bytes, None).unwrap();
    assert_eq!((found.width, found.height), (16, 24));
}

/// A JPEG file with Exif data: the focal length in 35 mm film, and the photo's size.
fn with_exif(jpeg: &[u8], film35: u16, [width, height]: [u32; 2]) -> Vec<u8> {
    let mut tiff = b"II*\0\x08\0\0\0".to_vec();
    let entry = |tag: u16, kind: u16, value: u32| {
        let mut entry = [tag.to_le_bytes(), kind.to_le_bytes()].concat();
        entry.extend(1u32.to_le_bytes());
        entry.extend(value.to_le_bytes());
        entry
    };
    // One directory that names the other, which begins at byte 26.
    for directory in [
        vec![entry(0x8769, 4, 26)],
        vec![
            entry(0xa002, 4, width),
            entry(0xa003, 4, height),
            entry(0xa405, 3, film35.into()),
        ],
    ] {
        tiff.extend((directory.len() as u16).to_le_bytes());
        tiff.extend(directory.concat());
        tiff.extend([0; 4]);
    }
    let length = (2 + 6 + tiff.len()) as u16;
    let segment = [&[0xff, 0xe1], &length.to_be_bytes()[..], b"Exif\0\0", &tiff].concat();
    [&jpeg[..2], &segment, &jpeg[2..]].concat()
}

#[test]
fn photos_know_their_focal_length_unless_they_were_cropped() {
    let jpeg = file("colour.jpg");
    let plain = decode_photo(&jpeg).unwrap();
    assert_eq!(plain.film35, None);
    let size = [plain.width as u32, plain.height as u32];
    let read = |film35, size| decode_photo(&with_exif(&jpeg, film35, size)).unwrap();
    assert_eq!(read(26, size).film35, Some(26.0));
    assert_eq!(read(26, size).rgba, plain.rgba);
    // A smaller one of the same proportions, and turned.
    assert_eq!(read(26, size.map(|n| 10 * n)).film35, Some(26.0));
    assert_eq!(read(26, [size[1], size[0]]).film35, Some(26.0));
    // Zero stands for unknown.
    assert_eq!(read(0, size).film35, None);
    assert_eq!(read(26, [2 * size[0], 3 * size[1]]).film35, None);
}

#[test]
fn a_photo_whose_exif_data_state_the_cropped_size_has_no_focal_length() {
    let read = |size: [usize; 2]| {
        let rgba = vec![200; 4 * size[0] * size[1]];
        let photo = Photo::new(size[0], size[1], &rgba).unwrap();
        let jpeg = write_photo_jpeg(&photo, &PhotoOptions::default()).unwrap();
        let stated = size.map(|n| n as u32);
        decode_photo(&with_exif(&jpeg, 26, stated)).unwrap().film35
    };
    for size in [[400, 300], [300, 400], [300, 200], [320, 180]] {
        assert_eq!(read(size), Some(26.0), "{size:?}");
    }
    for size in [[188, 242], [206, 152], [400, 320]] {
        assert_eq!(read(size), None, "{size:?}");
    }
}

#[test]
fn photos_have_their_colours() {
    let colour = |name: &str, i: usize| {
        let photo = decode_photo(&file(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(photo.rgba.len(), 4 * photo.width * photo.height, "{name}");
        <[u8; 4]>::try_from(&photo.rgba[4 * i..][..4]).unwrap()
    };
    let grey = |i: usize| 2 * ramp()[i] as u8;
    assert_eq!(colour("colour.webp", 9), [200, 10, 10, 255]);
    assert_eq!(
        colour("colour.webp", 10),
        [grey(10), grey(10), grey(10), 255]
    );
    assert_eq!(colour("alpha.webp", 1)[3], 0);
    assert_eq!(colour("alpha.webp", 11), [grey(11), grey(11), grey(11), 90]);
    // Red falls as green and blue grow: in steps of 8 pixels, as `make-images.py` has them.
    let [r, g, b, a] = colour("colour.jpg", 0);
    assert!(r > 230 && g < 25 && b < 25 && a == 255, "{r} {g} {b}");
    for name in ["grey.jpg", "grey.webp", "progressive.jpg"] {
        let values = read(name).values;
        let found = (0..values.len()).map(|i| colour(name, i));
        for ([r, g, b, a], value) in found.zip(values) {
            assert_eq!((r, g, b, a), (r, r, r, 255), "{name}");
            assert_eq!(f64::from(r), value, "{name}");
        }
    }
    // The way up is that of the heights.
    let seen = decode_photo(&file("exif6.jpg")).unwrap();
    let heights = read("exif6.jpg");
    assert_eq!((seen.width, seen.height), (heights.width, heights.height));
    let reds: Vec<f64> = seen.rgba.chunks(4).map(|p| p[0].into()).collect();
    assert_eq!(reds, heights.values);
    let refused = |name: &str| decode_photo(&file(name)).unwrap_err().code();
    assert_eq!(refused("half.exr"), "UNSUPPORTED");
    for name in ["colour.jpg", "colour.webp"] {
        let bytes = file(name);
        for length in 0..bytes.len() - 2 {
            assert!(
                decode_photo(&bytes[..length]).is_err(),
                "{name} cut to {length}"
            );
        }
    }
}

/// A file of each kind, as small as it gets.
const ALL: [&str; 23] = [
    "f4-be.tif",
    "big.tif",
    "tiles.tif",
    "lzw.tif",
    "zstd.tif",
    "zstd-be.tif",
    "packbits.tif",
    "geo-metres.tif",
    "rgba-grey.tif",
    "none.exr",
    "rle.exr",
    "zip.exr",
    "piz.exr",
    "among.exr",
    "le.pfm",
    "one.npz",
    "deflated.npz",
    "grey.jpg",
    "progressive.jpg",
    "exif6.jpg",
    "grey.webp",
    "alpha.webp",
    "lossy.webp",
];

#[test]
fn files_cut_short_anywhere_are_errors() {
    for name in ALL {
        let bytes = file(name);
        let whole = decode(&bytes, None).unwrap();
        let mut harmless = 0;
        for length in 0..bytes.len() {
            match decode(&bytes[..length], None) {
                Ok(part) => {
                    // Padding and metadata at the end may be missed by nobody.
                    assert!(
                        part.values
                            .iter()
                            .zip(&whole.values)
                            .all(|(a, b)| same(*a, *b)),
                        "{name} {length}"
                    );
                    harmless += 1;
                }
                Err(error) => assert!(
                    matches!(error, Error::Format { .. } | Error::Unsupported { .. }),
                    "{name}, {length}: {error:?}"
                ),
            }
        }
        assert!(
            harmless < 16,
            "{name}: {harmless} of {} lengths",
            bytes.len()
        );
    }
}

#[test]
fn sizes_that_cannot_be_are_refused() {
    let code = |bytes: &[u8]| decode(bytes, None).unwrap_err().code();
    assert_eq!(code(b"Pf\n0 4\n-1\n"), "EMPTY");
    assert_eq!(code(b"Pf\n99999 99999\n-1\n"), "TOO_LARGE");
    assert_eq!(code(b"Pf\n4096 4096\n-1\n"), "FORMAT");
    assert_eq!(code(b"Pf\n-1 4\n-1\n"), "FORMAT");
    assert_eq!(code(b"Pf\n1 1\n0\n\0\0\0\0"), "FORMAT");
    assert_eq!(code(b"Pf\n99999999999999999999 1\n-1\n"), "FORMAT");

    // Width and length are the values of the tags 256 and 257, of type LONG or SHORT.
    let sized = |width: u32, height: u32| {
        let mut bytes = file("f4.tif");
        for (tag, value) in [(256u16, width), (257, height)] {
            let place = bytes
                .windows(2)
                .position(|pair| pair == tag.to_le_bytes())
                .unwrap();
            bytes[place + 2..place + 4].copy_from_slice(&4u16.to_le_bytes());
            bytes[place + 8..place + 12].copy_from_slice(&value.to_le_bytes());
        }
        bytes
    };
    for (width, height) in [
        (u32::MAX, u32::MAX),
        (65_535, 65_535),
        (4096, 4096),
        (0, 3),
        (4, 0),
        (4096, 3),
        (3, 4096),
    ] {
        refused_for_its_size(&sized(width, height), &format!("{width} × {height}"));
    }

    // The data window of an EXR is named in its header: four 32-bit integers.
    let windowed = |right: i32, bottom: i32| {
        let mut bytes = file("zip.exr");
        let name = b"dataWindow\0box2i\0";
        let place = bytes.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 4;
        bytes[place + 8..place + 12].copy_from_slice(&right.to_le_bytes());
        bytes[place + 12..place + 16].copy_from_slice(&bottom.to_le_bytes());
        bytes
    };
    for (right, bottom) in [
        (i32::MAX, i32::MAX),
        (99_999, 99_999),
        (4095, 4095),
        (-1, 2),
        (3, -1),
        (3, i32::MAX),
    ] {
        refused_for_its_size(&windowed(right, bottom), &format!("{right}, {bottom}"));
    }
}

fn heights() -> impl Strategy<Value = (usize, Vec<f32>)> {
    (1usize..9).prop_flat_map(|cols| {
        (1usize..9).prop_flat_map(move |rows| {
            let height = prop_oneof![
                4 => prop::num::f32::NORMAL | prop::num::f32::SUBNORMAL | prop::num::f32::ZERO,
                1 => Just(f32::NAN)
            ];
            (Just(cols), prop::collection::vec(height, rows * cols))
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    /// Damage anywhere gives a value or an error, whichever it deserves.
    #[test]
    fn flipped_bytes_give_heights_or_an_error(
        which in 0..ALL.len(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let mut bytes = file(ALL[which]);
        for (place, byte) in damage {
            let length = bytes.len();
            bytes[place.index(length)] = byte;
        }
        crate::native::common::files::check_decoded(&bytes)?;
        if let Err(error) = npz_arrays(&bytes) {
            prop_assert!(["FORMAT", "UNSUPPORTED"].contains(&error.code()), "{}", error);
        }
    }

    #[test]
    fn round_trips_are_exact_for_32_bits((cols, values) in heights(), side in 1e-3f64..1e3) {
        let rows = values.len() / cols;
        let image = HeightImage::new(cols, rows, values.iter().map(|z| f64::from(*z)).collect())
            .and_then(|image| image.with_pixel_size(side))
            .unwrap();
        for format in [Format::Tiff, Format::Exr] {
            let bytes = write_image(&image, format, None).unwrap();
            // Zeros far from all other values would be no data.
            let options = DecodeOptions::default().assume_no_data(false);
            let back = decode_with(&bytes, Some(format), &options).unwrap();
            prop_assert_eq!((back.width, back.height, back.data_type), (cols, rows, "f32"));
            prop_assert_eq!((back.pixel_size, back.height_scale), (side, 1.0));
            for (a, b) in back.values.iter().zip(image.values()) {
                prop_assert!(same(*a, *b), "{} {}", a, b);
            }
        }
    }
}

#[test]
fn heights_beyond_32_bits_are_refused() {
    let image = HeightImage::new(2, 1, vec![1.0, 1e39]).unwrap();
    for format in [Format::Tiff, Format::Exr] {
        let error = write_image(&image, format, None).unwrap_err();
        assert_eq!(error.code(), "NOT_FINITE");
        assert!(error.to_string().contains("column 1"), "{error}");
    }
}

/// Red on the left, green in the middle, white above blue on the right: `tests/data/make-photos.py`.
#[test]
fn photos_of_other_kinds_have_their_colours() {
    let [red, green, blue, white] = [[220, 30, 30], [30, 200, 40], [40, 50, 210], [250; 3]];
    for name in ["photo.bmp", "photo.gif", "photo-lzw.tif", "photo-cmyk.jpg"] {
        let photo = decode_photo(&file(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!((photo.width, photo.height), (24, 16), "{name}");
        for ([x, y], colour) in [
            ([3, 3], red),
            ([12, 9], green),
            ([20, 12], blue),
            ([20, 3], white),
        ] {
            let [r, g, b, a] = photo.rgba.as_chunks::<4>().0[24 * y + x];
            let off = [r, g, b]
                .iter()
                .zip(colour)
                .map(|(a, b)| a.abs_diff(b))
                .max();
            assert!(
                off < Some(12) && a == 255,
                "{name} at {x}, {y}: {r} {g} {b} {a}"
            );
        }
    }
    let bits = decode_photo(&file("photo-bits.tif")).unwrap();
    assert!(bits.rgba.iter().all(|value| *value == 255));
}

#[test]
fn exif_data_of_png_and_webp_turn_the_photo_and_tell_the_focal_length() {
    for name in ["photo-exif6.png", "photo-exif6.webp"] {
        let photo = decode_photo(&file(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!((photo.width, photo.height), (16, 24), "{name}");
        assert_eq!((photo.orientation, photo.film35), (6, Some(26.0)), "{name}");
        // Turned by 90° clockwise: what was on the left is above.
        assert_eq!(photo.rgba[..4], [220, 30, 30, 255], "{name}");
    }
}

#[test]
fn a_photo_with_too_many_pixels_is_reduced_and_says_so() {
    let photo = decode_photo(&file("photo-33mp.png")).unwrap();
    assert_eq!((photo.width, photo.height), (4096, 2048));
    let line = &photo.rgba[..4 * 4096];
    assert_eq!(
        (line[0], line[4 * 2047], line[4 * 2048], line[4 * 4095]),
        (0, 0, 255, 255)
    );
    let [assumed] = &photo.assumptions[..] else {
        panic!("{:?}", photo.assumptions)
    };
    assert_eq!(assumed.code, "reducedPhoto");
    assert!(
        assumed
            .words
            .contains("4096 × 2048 of the photo's 8192 × 4096")
    );
    assert!(
        decode_photo(&file("photo.bmp"))
            .unwrap()
            .assumptions
            .is_empty()
    );
}

#[test]
fn photos_that_are_not_read_are_named_with_what_to_do() {
    let message = |bytes: &[u8]| decode_photo(bytes).unwrap_err().to_string();
    // Heights of a map, which are no photo, whatever they are called.
    let floats = message(&file("f4.tif"));
    assert!(floats.contains("read them as heights"), "{floats}");
    for (bytes, name, advice) in [
        (&b"\0\0\0\x18ftypheic\0\0\0\0"[..], "HEIC", "as JPEG"),
        (b"\0\0\0\x1cftypavif\0\0\0\0", "AVIF", "as JPEG"),
        (b"%PDF-1.7\n", "PDF", "pdftoppm"),
        (
            b"\x93NUMPY\x01\0",
            "NPY",
            "it has heights, and is no photo: read it as heights; photos are read from JPEG",
        ),
    ] {
        let message = message(bytes);
        assert!(
            message.starts_with(name) && message.contains(advice),
            "{message}"
        );
    }
}

/// A Windows bitmap of 3 × 2 grey pixels in 24 bits, the bottom row first and each padded to four bytes.
fn bitmap(top: [u8; 3], bottom: [u8; 3]) -> Vec<u8> {
    let mut file = b"BM".to_vec();
    file.extend(78_u32.to_le_bytes());
    file.extend([0; 4]);
    file.extend([54_u32, 40, 3, 2].map(u32::to_le_bytes).concat());
    file.extend([1_u16, 24].map(u16::to_le_bytes).concat());
    file.extend([0_u32, 24, 2835, 2835, 0, 0].map(u32::to_le_bytes).concat());
    for row in [bottom, top] {
        file.extend(row.iter().flat_map(|level| [*level; 3]));
        file.extend([0; 3]);
    }
    file
}

#[test]
fn levels_of_a_bitmap_are_heights() {
    let file = bitmap([10, 20, 30], [40, 50, 60]);
    let found = decode(&file, None).unwrap();
    assert_eq!(
        (found.format, found.width, found.height),
        (Format::Bmp, 3, 2)
    );
    assert_eq!(found.values, [10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
    assert_eq!(found.assumptions[0].code, "heightScale");
    let mut coloured = file;
    coloured[54] = 99;
    assert_eq!(decode(&coloured, None).unwrap_err().code(), "UNSUPPORTED");
}

/// A chunk of a PNG file: its length, name, bytes, and their CRC-32.
fn chunk(name: &[u8; 4], bytes: &[u8]) -> Vec<u8> {
    let named: Vec<u8> = name.iter().chain(bytes).copied().collect();
    let crc = named.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg())
        })
    });
    let length = bytes.len() as u32;
    [&length.to_be_bytes()[..], &named, &(!crc).to_be_bytes()].concat()
}

/// An interlaced PNG file of black pixels in 1 bit, without compression, of a width and height divisible by 8.
fn interlaced(width: u32, height: u32) -> Vec<u8> {
    let head = [
        &width.to_be_bytes()[..],
        &height.to_be_bytes(),
        &[1, 0, 0, 0, 1],
    ]
    .concat();
    // The columns and rows of Adam7's passes are every 8th, 8th, 4th, 4th, 2nd, 2nd and each one.
    let passes = [(8, 8), (8, 8), (4, 8), (4, 4), (2, 4), (2, 2), (1, 2)];
    let bytes = |(x, y): (u32, u32)| (height / y) * (1 + (width / x).div_ceil(8));
    let zeros = vec![0; passes.into_iter().map(bytes).sum::<u32>() as usize];
    let mut data = vec![0x78, 1];
    let blocks = zeros.chunks(65_535);
    let last = blocks.len() - 1;
    for (i, block) in blocks.enumerate() {
        let length = block.len() as u16;
        data.push(u8::from(i == last));
        data.extend([length.to_le_bytes(), (!length).to_le_bytes()].concat());
        data.extend(block);
    }
    // Adler-32 of zeros.
    data.extend(((zeros.len() % 65_521) as u32 * 65_536 + 1).to_be_bytes());
    let parts = [
        chunk(b"IHDR", &head),
        chunk(b"IDAT", &data),
        chunk(b"IEND", b""),
    ];
    [b"\x89PNG\r\n\x1a\n".to_vec(), parts.concat()].concat()
}

#[test]
fn large_interlaced_photos_are_read_and_larger_ones_named_in_words_about_photos() {
    let photo = decode_photo(&interlaced(5600, 4000)).unwrap();
    assert_eq!((photo.width, photo.height), (5600, 4000));
    assert_eq!(photo.rgba[..4], [0, 0, 0, 255]);
    // So many bytes could hold the pixels that the head states.
    let mut huge = interlaced(1024, 1024);
    let head = [
        &40_000_u32.to_be_bytes()[..],
        &20_000_u32.to_be_bytes(),
        &[1, 0, 0, 0, 1],
    ];
    huge.splice(8..33, chunk(b"IHDR", &head.concat()));
    let error = decode_photo(&huge).unwrap_err().to_string();
    assert!(
        error.contains("megapixels") && !error.contains("cells"),
        "{error}"
    );
}
