//! Files in and out: those of other programs, exact round trips, damage.

use developable::dewarp::Photo;
use developable::files::images::{
    BookPage, BookWord, DecodeOptions, Format, PhotoOptions, decode, decode_photo, decode_with,
    write_book, write_image, write_npy, write_photo, write_photo_jpeg, write_photo_pdf,
};
use developable::files::wavefront::write_obj;
use developable::{
    Error, Frame, HeightImage, Heightfield, Lattice, MAX_CELLS, Result, Triangulation,
};
use proptest::prelude::*;

use crate::native::common::files;

use files::{file, holes, of_every_type, ramp, read};

fn assert_same(name: &str, found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{name}");
    for (i, (a, b)) in found.iter().zip(expected).enumerate() {
        assert!(
            a == b || a.is_nan() && b.is_nan(),
            "{name}, value {i}: {a} instead of {b}"
        );
    }
}

#[test]
fn numpy_arrays_of_every_type_and_byte_order() {
    for (name, data_type, expected) in of_every_type() {
        for order in if name.ends_with('1') {
            &["le"][..]
        } else {
            &["le", "be"]
        } {
            let name = format!("{name}-{order}.npy");
            let found = read(&name);
            assert_eq!((found.width, found.height), (4, 3), "{name}");
            assert_eq!(
                (found.format, found.data_type),
                (Format::Npy, data_type),
                "{name}"
            );
            assert_eq!(found.height_scale, 1.0, "{name}");
            assert_same(&name, &found.values, &expected);
        }
    }
    for name in ["fortran.npy", "third-axis.npy", "version2.npy"] {
        assert_same(name, &read(name).values, &holes());
    }
    let bools: Vec<f64> = ramp().iter().map(|v| f64::from(v % 3.0 == 0.0)).collect();
    assert_same("bool.npy", &read("bool.npy").values, &bools);
    assert_eq!(read("bool.npy").data_type, "bool");
}

#[test]
fn numpy_files_that_are_no_height_image_say_why() {
    for (name, code, hint) in [
        ("vector.npy", "UNSUPPORTED", "two-dimensional"),
        ("cube.npy", "UNSUPPORTED", "[2, 3, 4]"),
        ("complex.npy", "UNSUPPORTED", "<c16"),
        ("text.npy", "UNSUPPORTED", "<U2"),
        ("record.npy", "UNSUPPORTED", "records"),
        ("object.npy", "UNSUPPORTED", "|O"),
        ("empty.npy", "EMPTY", "empty"),
    ] {
        let error = decode(&file(name), None).unwrap_err();
        assert_eq!(error.code(), code, "{name}: {error}");
        assert!(error.to_string().contains(hint), "{name}: {error}");
    }
    let options = DecodeOptions::default().assume_no_data(false);
    let infinite = decode_with(&file("infinite.npy"), None, &options).unwrap();
    assert_eq!(infinite.values[1], f64::INFINITY);
    assert_eq!(infinite.into_image().unwrap_err().code(), "NOT_FINITE");
}

#[test]
fn grey_images_of_another_program() {
    let grey8: Vec<f64> = ramp().iter().map(|v| v * 2.0).collect();
    let without = |holes: &[usize]| {
        let mut values = grey8.clone();
        holes.iter().for_each(|i| values[*i] = f64::NAN);
        values
    };
    for (name, expected) in [
        ("grey8.png", grey8.clone()),
        ("grey8-alpha.png", without(&[1])),
        ("transparent-level.png", without(&[6])),
        ("rgb-grey.png", grey8.clone()),
        ("palette-grey.png", grey8.clone()),
        ("rgba-grey.png", without(&[1])),
        (
            "grey1.png",
            ramp()
                .iter()
                .map(|v| if v % 3.0 == 0.0 { 255.0 } else { 0.0 })
                .collect(),
        ),
    ] {
        let found = read(name);
        assert_eq!(
            (found.width, found.height, found.format),
            (4, 3, Format::Png),
            "{name}"
        );
        assert_eq!(found.data_type, "u8", "{name}");
        assert_eq!(found.height_scale, 1.0 / 255.0, "{name}"); // a quarter of 4 pixels
        assert_same(name, &found.values, &expected);
    }
    let grey16 = read("grey16.png");
    assert_eq!(
        (grey16.data_type, grey16.height_scale),
        ("u16", 1.0 / 65535.0)
    );
    let expected: Vec<f64> = ramp().iter().map(|v| v * 700.0).collect();
    assert_same("grey16.png", &grey16.values, &expected);

    let error = decode(&file("rgb-colour.png"), None).unwrap_err();
    assert_eq!(error.code(), "UNSUPPORTED");
    assert!(error.to_string().contains("row 2, column 1"), "{error}");
}

#[test]
fn recorded_scales_are_used() {
    let found = read("recorded.png");
    assert_eq!((found.pixel_size, found.height_scale), (0.25, 0.5));
    let image = found.into_image().unwrap();
    let mut expected: Vec<f64> = ramp().iter().map(|v| v * 700.0 * 0.5 - 100.0).collect();
    expected[0] = f64::NAN; // level 2100
    assert_same("recorded.png", image.values(), &expected);
    let error = decode(&file("recorded-badly.png"), None).unwrap_err();
    assert_eq!(error.code(), "FORMAT");
    assert!(error.to_string().contains("heightScale"), "{error}");
}

#[test]
fn files_cut_short_anywhere_are_errors() {
    let image = HeightImage::new(4, 3, holes()).unwrap();
    let ours = [
        write_image(&image, Format::Png, None).unwrap(),
        write_npy(3, 4, &holes()).unwrap(),
    ];
    let theirs = [
        "grey16.png",
        "recorded.png",
        "palette-grey.png",
        "f4-be.npy",
        "fortran.npy",
    ];
    for bytes in theirs.map(file).iter().chain(&ours) {
        for length in 0..bytes.len() {
            for format in [None, Format::detect(bytes)] {
                let error = decode(&bytes[..length], format).unwrap_err();
                assert!(!error.to_string().is_empty());
                assert!(
                    matches!(error, Error::Format { .. }) || length < 8 && format.is_none(),
                    "{length} of {}: {error}",
                    bytes.len()
                );
            }
        }
        assert!(decode(bytes, None).is_ok());
    }
}

/// A PNG file that stops after a header of its own choice, checksum included.
fn png_header(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_depth(png::BitDepth::Sixteen);
    drop(encoder.write_header().unwrap());
    bytes
}

fn npy_header(text: &str) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY\x01\0".to_vec();
    bytes.extend((text.len() as u16).to_le_bytes());
    bytes.extend(text.as_bytes());
    bytes
}

#[test]
fn numpy_headers_of_other_programs_are_read_or_damage() {
    let read = |header: &str| decode(&[npy_header(header), (1..=99).collect()].concat(), None);
    let array = |shape: &str, order: &str| {
        read(&format!(
            "{{'shape': {shape}, 'fortran_order': {order}, 'descr': '|u1'}}\n"
        ))
    };
    // Axes of length 1 around rows and columns are left out.
    for (order, expected) in [
        ("False", [1., 2., 3., 4., 5., 6.]),
        ("True", [1., 3., 5., 2., 4., 6.]),
    ] {
        for shape in [
            "(2, 3)",
            "(1, 2, 3)",
            "(2, 3, 1)",
            "(1, 1, 2, 3)",
            "(1, 2, 3, 1)",
            "(2L,3L)",
        ] {
            let found = array(shape, order).unwrap();
            assert_eq!((found.width, found.height), (3, 2), "{shape}");
            assert_eq!(found.values, expected, "{shape} {order}");
        }
    }
    for (shape, words) in [("(3, 2, 2)", "only two-dimensional"), ("(33, 3)", "points")] {
        let error = array(shape, "False").unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
    for header in [
        "",
        "{}",
        "{'descr': 3}",
        "{'descr': '<f8', 'fortran_order': 1, 'shape': (2, 2)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (2, x)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': 2}",
    ] {
        assert_eq!(read(header).unwrap_err().code(), "FORMAT", "{header}");
    }
}

#[test]
fn huge_declared_sizes_are_refused_before_they_are_allocated() {
    let code = |bytes: &[u8]| decode(bytes, None).unwrap_err().code();
    assert_eq!(code(&png_header(0x7fff_ffff, 0x7fff_ffff)), "TOO_LARGE");
    assert_eq!(code(&png_header(4096, 4096)), "FORMAT");
    assert_eq!(code(&png_header(1, MAX_CELLS as u32)), "FORMAT");
    let shaped = |shape: &str| {
        npy_header(&format!(
            "{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}\n"
        ))
    };
    assert_eq!(code(&shaped("(4096, 5120)")), "FORMAT");
    assert_eq!(code(&shaped("(4096, 5121)")), "TOO_LARGE");
    assert_eq!(
        code(&shaped("(18446744073709551615, 18446744073709551615)")),
        "TOO_LARGE"
    );
    assert_eq!(code(&shaped("(4294967296, 4294967297)")), "TOO_LARGE");
    assert_eq!(
        code(&shaped("(99999999999999999999999999, 0)")),
        "TOO_LARGE"
    );
    assert_eq!(code(&shaped("(-1, 4)")), "FORMAT");
    assert_eq!(code(&shaped("()")), "UNSUPPORTED");
    assert_eq!(code(&npy_header(&"(".repeat(9000))), "FORMAT");
    // Version 2 can claim a header of 4 GiB.
    assert_eq!(code(b"\x93NUMPY\x02\0\xff\xff\xff\xff{"), "FORMAT");
    assert_eq!(code(b"\x93NUMPY\x09\0\xff\xff{}"), "UNSUPPORTED");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Damage anywhere gives a value or an error, whichever it deserves.
    #[test]
    fn flipped_bytes_give_heights_or_an_error(
        which in 0usize..5,
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let names = ["grey16.png", "rgba-grey.png", "recorded.png", "f4-be.npy", "record.npy"];
        let mut bytes = file(names[which]);
        for (place, byte) in damage {
            let length = bytes.len();
            bytes[place.index(length)] = byte;
        }
        crate::native::common::files::check_decoded(&bytes)?;
    }

    #[test]
    fn npy_round_trips_are_exact(
        (cols, values) in (1usize..9).prop_flat_map(|cols| {
            (Just(cols), (1usize..9).prop_flat_map(move |rows| {
                prop::collection::vec(prop::num::f64::ANY, rows * cols)
            }))
        }),
    ) {
        let bytes = write_npy(values.len() / cols, cols, &values).unwrap();
        let as_stored = DecodeOptions::default().assume_no_data(false);
        let found = decode_with(&bytes, Some(Format::Npy), &as_stored).unwrap();
        prop_assert_eq!((found.width, found.height), (cols, values.len() / cols));
        prop_assert_eq!(found.data_type, "f64");
        for (a, b) in found.values.iter().zip(&values) {
            prop_assert!(a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan());
        }
    }

    #[test]
    fn png_round_trips_are_exact_to_half_a_level(
        (cols, values) in (1usize..9).prop_flat_map(|cols| {
            (Just(cols), (1usize..9).prop_flat_map(move |rows| {
                let height = prop_oneof![4 => -1.0f64..1.0, 1 => Just(f64::NAN)];
                prop::collection::vec(height, rows * cols)
            }))
        }),
        size in prop_oneof![Just(1.0), 1e-12f64..1e-3, 1e3f64..1e12],
        offset in prop_oneof![Just(0.0), -1e6f64..1e6],
        pixel_size in 1e-3f64..1e3,
    ) {
        let values: Vec<f64> = values.iter().map(|v| v * size + offset).collect();
        let image = HeightImage::new(cols, values.len() / cols, values.clone())
            .and_then(|i| i.with_pixel_size(pixel_size))
            .unwrap();
        let back = decode(&write_image(&image, Format::Png, None).unwrap(), None).unwrap();
        prop_assert_eq!(back.data_type, "u16");
        let back = back.into_image().unwrap();
        prop_assert_eq!(back.pixel_size(), pixel_size);
        prop_assert_eq!((back.width(), back.height()), (image.width(), image.height()));
        let range = 2.0 * size;
        let tolerance = 0.501 * range / 65534.0 + 1e-15 * (offset.abs() + size);
        for (a, b) in back.values().iter().zip(&values) {
            prop_assert!(a.is_nan() && b.is_nan() || (a - b).abs() <= tolerance, "{} {}", a, b);
        }
    }
}

#[test]
fn flat_empty_and_extreme_images_survive_png() {
    let back = |values: &[f64]| {
        let image = HeightImage::new(values.len(), 1, values.to_vec()).unwrap();
        let decoded = decode(&write_image(&image, Format::Png, None).unwrap(), None).unwrap();
        decoded.into_image().unwrap().into_values()
    };
    for z in [0.0, 7.25, -1e-20, 0.1, -123456.789, f64::MAX, 5e-324] {
        let found = back(&[z, f64::NAN, z]);
        assert!((found[0] - z).abs() <= 1e-15 * z.abs(), "{z}: {}", found[0]);
        assert_eq!(found[0], found[2]);
        assert!(found[1].is_nan());
    }
    // One level below the lowest height there is no number left for the offset.
    assert!((back(&[f64::MIN])[0] / f64::MIN - 1.0).abs() < 2e-5);
    assert!(back(&[f64::NAN; 3]).iter().all(|z| z.is_nan()));
    let wide = back(&[-1e308, 1e308, 0.9e308]);
    assert!((wide[2] / 0.9e308 - 1.0).abs() < 1e-4);
    assert!((wide[0] / 1e308 + 1.0).abs() < 1e-4 && (wide[1] / 1e308 - 1.0).abs() < 1e-4);
    let narrow = back(&[1.0, 1.0 + f64::EPSILON]);
    assert!(narrow.iter().all(|z| (z - 1.0).abs() < 1e-15));
}

#[test]
fn another_reader_sees_our_png_as_plain_16_bit_grey() {
    let image = HeightImage::new(2, 2, vec![-1.0, 1.0, f64::NAN, 0.0]).unwrap();
    let bytes = write_image(&image, Format::Png, None).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes))
        .read_info()
        .unwrap();
    let mut levels = vec![0; 8];
    reader.next_frame(&mut levels).unwrap();
    assert_eq!(levels, [0, 1, 255, 255, 0, 0, 128, 0]);
}

/// A surface that a flip or turn would change, with a hole.
fn surface() -> Heightfield {
    let lattice = Lattice::new(5, 6, 0.3)
        .unwrap()
        .with_origin([1.0, 2.0])
        .unwrap();
    let mut heights = Heightfield::from_fn(lattice, |x, y| 0.5 * x + 2.0 * y)
        .unwrap()
        .into_heights();
    heights[lattice.index(0, 5)] = f64::NAN;
    Heightfield::new(lattice, heights).unwrap()
}

fn load_obj(bytes: &[u8]) -> tobj::Mesh {
    let options = tobj::LoadOptions::default();
    let no_material = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut &bytes[..], &options, no_material).unwrap();
    assert_eq!(models.len(), 1);
    models.into_iter().next().unwrap().mesh
}

fn write_surface(surface: &Heightfield) -> Result<Vec<u8>> {
    write_obj(Triangulation::new(surface, &Frame::default())?.mesh(), None)
}

#[test]
fn another_reader_sees_the_surface_in_our_obj() {
    let surface = surface();
    let mesh = load_obj(&write_surface(&surface).unwrap());
    // 4 strips of 2 · 5 triangles; the missing corner takes the one that touches it.
    assert_eq!(mesh.indices.len() / 3, 40 - 1);
    assert_eq!(mesh.positions.len() / 3, 30 - 1);
    assert_eq!(mesh.normals.len(), mesh.positions.len());
    let vertex =
        |i: u32| -> [f64; 3] { std::array::from_fn(|k| mesh.positions[3 * i as usize + k]) };
    let mut area = 0.0;
    for t in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [vertex(t[0]), vertex(t[1]), vertex(t[2])];
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!(twice > 0.0, "counter-clockwise seen from +z");
        area += twice / 2.0;
        for [x, y, z] in [a, b, c] {
            assert!((z - 0.5 * x - 2.0 * y).abs() < 1e-6, "{x} {y} {z}");
        }
    }
    let triangle = 3f64.sqrt() / 4.0 * 0.09;
    assert!((area - 39.0 * triangle).abs() < 1e-6);
    let length = (1.0 + 0.25 + 4.0f64).sqrt();
    for n in mesh.normals.chunks_exact(3) {
        for (found, exact) in n.iter().zip([-0.5, -2.0, 1.0]) {
            assert!((*found - exact / length).abs() < 1e-5);
        }
    }
}

#[test]
fn obj_positions_read_back_exactly() {
    let surface = surface();
    let text = String::from_utf8(write_surface(&surface).unwrap()).unwrap();
    let written: Vec<[f64; 3]> = text
        .lines()
        .filter_map(|line| line.strip_prefix("v "))
        .map(|line| {
            let numbers: Vec<f64> = line.split(' ').map(|n| n.parse().unwrap()).collect();
            numbers.try_into().unwrap()
        })
        .collect();
    let lattice = surface.lattice();
    let expected: Vec<[f64; 3]> = (0..lattice.len())
        .filter(|i| surface.heights()[*i].is_finite())
        .map(|i| {
            let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
            [x, y, surface.heights()[i]]
        })
        .collect();
    assert_eq!(written, expected);
}

#[test]
fn writers_refuse_what_they_cannot_write() {
    let code = |r: Result<Vec<u8>>| r.unwrap_err().code();
    assert_eq!(code(write_npy(0, 3, &[])), "EMPTY");
    assert_eq!(code(write_npy(2, 3, &[0.0; 5])), "SHAPE");
    assert_eq!(code(write_npy(1 << 20, 1 << 20, &[])), "TOO_LARGE");
    let lattice = Lattice::new(4, 1, 1.0).unwrap();
    let column = Heightfield::new(lattice, vec![0.0; 4]).unwrap();
    assert_eq!(code(write_surface(&column)), "UNSUPPORTED");
}

/// A smooth photo with an edge, half of it half transparent.
fn picture([width, height]: [usize; 2]) -> Vec<u8> {
    (0..width * height)
        .flat_map(|i| {
            let (x, y) = (i % width, i / width);
            let dark = if x > width / 3 { 60 } else { 0 };
            let alpha = if y < height / 2 { 255 } else { 128 };
            [
                (200 * x / width) as u8,
                (200 * y / height) as u8,
                60 + dark,
                alpha,
            ]
        })
        .collect()
}

#[test]
fn jpegs_are_the_photo_on_white_paper() {
    let size = [61, 43];
    let rgba = picture(size);
    let photo = Photo::new(size[0], size[1], &rgba).unwrap();
    let options = PhotoOptions::default();
    let error = |quality: u8, dots: Option<f64>| {
        let mut options = options.quality(quality);
        options.dots_per_millimetre = dots;
        let file = write_photo_jpeg(&photo, &options).unwrap();
        // Another library's decoder.
        let found = decode_photo(&file).unwrap();
        assert_eq!([found.width, found.height], size);
        let on_white = |k: usize| {
            let alpha = f64::from(rgba[k / 4 * 4 + 3]) / 255.0;
            255.0 + alpha * (f64::from(rgba[k]) - 255.0)
        };
        let squares = (0..rgba.len())
            .filter(|k| k % 4 < 3)
            .map(|k| (f64::from(found.rgba[k]) - on_white(k)).powi(2));
        assert!(found.rgba.chunks(4).all(|pixel| pixel[3] == 255));
        (
            (squares.sum::<f64>() / (3.0 * 61.0 * 43.0)).sqrt(),
            // The JFIF segment: unit and density.
            (
                file[13],
                [14, 16].map(|i| u16::from_be_bytes([file[i], file[i + 1]])),
            ),
        )
    };
    let (fine, unknown) = error(95, None);
    let (coarse, inches) = error(20, Some(200.0 / 25.4));
    let (_, centimetres) = error(95, Some(8.0));
    assert!(fine < 3.0 && coarse > fine, "{fine} {coarse}");
    assert_eq!(unknown, (0, [1, 1]));
    assert_eq!(inches, (1, [200, 200]));
    assert_eq!(centimetres, (2, [80, 80]));
}

#[test]
fn photos_that_cannot_be_written_are_refused() {
    let rgba = vec![9; 4 * 70_000];
    let wide = Photo::new(70_000, 1, &rgba).unwrap();
    let options = PhotoOptions::default();
    let refusal = |written: Result<Vec<u8>>| {
        let error = written.unwrap_err();
        (error.code(), error.to_string())
    };
    let (code, message) = refusal(write_photo_jpeg(&wide, &options));
    assert!(
        code == "UNSUPPORTED" && message.contains("65535"),
        "{message}"
    );
    assert!(write_photo(&wide, &options).is_ok());
    let photo = Photo::new(70, 1000, &rgba).unwrap();
    for quality in [0, 101] {
        let options = options.quality(quality);
        assert_eq!(refusal(write_photo_jpeg(&photo, &options)).0, "OPTION");
    }
    let (code, message) = refusal(write_photo_pdf(&photo, &options, None));
    assert!(
        code == "OPTION" && message.contains("true size"),
        "{message}"
    );
    for dots in [0.1, 50.0] {
        let (code, message) = refusal(write_photo_pdf(
            &photo,
            &options.dots_per_millimetre(dots),
            None,
        ));
        assert!(
            code == "UNSUPPORTED" && message.contains("unit"),
            "{message}"
        );
    }
    for dots in [0.0, f64::NAN] {
        let options = options.dots_per_millimetre(dots);
        assert_eq!(refusal(write_photo(&photo, &options)).0, "OPTION");
    }
}

#[test]
fn photos_come_back_as_they_were_and_other_kinds_become_colours() {
    let rgba: Vec<u8> = (0..4 * 35).map(|i| (i * 37 % 256) as u8).collect();
    let photo = Photo::new(7, 5, &rgba).unwrap();
    let written = write_photo(&photo, &PhotoOptions::default()).unwrap();
    let photo = decode_photo(&written).unwrap();
    assert_eq!((photo.width, photo.height), (7, 5));
    assert_eq!(photo.rgba, rgba);
    for name in [
        "grey1.png",
        "grey16.png",
        "grey8-alpha.png",
        "rgb-colour.png",
        "palette-grey.png",
    ] {
        let photo = decode_photo(&file(name)).unwrap();
        assert_eq!(photo.rgba.len(), 4 * photo.width * photo.height, "{name}");
    }
    let colour = decode_photo(&file("rgb-colour.png")).unwrap();
    assert!(
        colour.rgba.chunks(4).any(|p| p[0] != p[1]) && colour.rgba.chunks(4).all(|p| p[3] == 255)
    );
    assert_eq!(decode_photo(b"no png").unwrap_err().code(), "UNSUPPORTED");
    let cut = &written[..written.len() - 20];
    assert_eq!(decode_photo(cut).unwrap_err().code(), "FORMAT");
}

/// Width, height, number of bits and kind of colours of the PNG in `file`.
fn read_png_header(file: &[u8]) -> (u32, u32, u8, u8) {
    let number = |at: usize| u32::from_be_bytes(file[at..at + 4].try_into().unwrap());
    (number(16), number(20), file[24], file[25])
}

#[test]
fn black_and_white_photos_have_one_bit_for_each_pixel() {
    let (width, height) = (37, 11);
    let rgba: Vec<u8> = (0..width * height)
        .flat_map(|i| match (i * i) % 7 < 3 {
            true => [0, 0, 0, 255],
            false => [255; 4],
        })
        .collect();
    let photo = Photo::new(width, height, &rgba).unwrap();
    let file = write_photo(&photo, &PhotoOptions::default()).unwrap();
    assert_eq!(read_png_header(&file), (37, 11, 1, 0));
    assert_eq!(decode_photo(&file).unwrap().rgba, rgba);
    // One grey pixel, and it is a photo as others are.
    let mut grey = rgba.clone();
    grey[..3].fill(128);
    let photo = Photo::new(width, height, &grey).unwrap();
    let file = write_photo(&photo, &PhotoOptions::default()).unwrap();
    assert_eq!(read_png_header(&file), (37, 11, 8, 2));
}

fn one_page_book(
    picture: &[u8],
    size: [f64; 2],
    words: &[BookWord<'_>],
) -> developable::Result<Vec<u8>> {
    write_book(
        &[BookPage {
            picture,
            size,
            words,
        }],
        None,
    )
}

#[test]
fn words_of_a_book_lie_over_their_boxes_unseen() {
    let photo = Photo::new(40, 30, &[255; 4800]).unwrap();
    let picture = &write_photo_jpeg(&photo, &PhotoOptions::default()).unwrap()[..];
    // A pixel is a point, and 20 points are below the picture.
    let size = [40.0, 70.0].map(|points| points * 25.4 / 72.0);
    let write = |words: &[BookWord<'_>]| one_page_book(picture, size, words);
    let word = |text, bounds| BookWord { text, bounds };
    let words = [
        word("aZ", [10.0, 5.0, 20.0, 4.0]),
        word(" \n", [0.0; 4]),
        word("Ω𝒳", [1.0, 10.0, 8.0, 16.0]),
    ];
    let book = write(&words).unwrap();
    assert!(book.windows(picture.len()).any(|part| part == picture));
    let file = String::from_utf8_lossy(&book);
    // The left and the lower end of a box, counted from the page's lower left corner; its height is the font's, and two
    // characters are one em wide before they are stretched.
    let operands = |operator: &str| -> Vec<Vec<f64>> {
        let lines = file
            .lines()
            .filter_map(|line| line.strip_suffix(operator)?.strip_suffix(' '));
        lines
            .map(|line| {
                line.split_whitespace()
                    .flat_map(str::parse)
                    .collect::<Vec<f64>>()
            })
            .collect()
    };
    let near = |operator: &str, expected: &[&[f64]]| {
        let found = operands(operator);
        assert_eq!(found.len(), expected.len(), "{operator}: {found:?}");
        for (found, expected) in found
            .iter()
            .flatten()
            .zip(expected.iter().copied().flatten())
        {
            assert!((found - expected).abs() < 1e-3, "{operator}: {found}");
        }
    };
    near(
        "Tm",
        &[
            &[1.0, 0.0, 0.0, 1.0, 10.0, 41.0],
            &[1.0, 0.0, 0.0, 1.0, 1.0, 24.0],
        ],
    );
    near("Tf", &[&[4.0], &[16.0]]);
    near("Tz", &[&[500.0], &[50.0]]);
    near("Tr", &[&[3.0]]);
    for mapping in [
        "<0001> <005A>",
        "<0002> <0061>",
        "<0003> <03A9>",
        "<0004> <D835DCB3>",
    ] {
        assert!(file.contains(mapping), "{mapping}");
    }
    // PDF has characters from left to right, with those of numbers in their order.
    let hebrew = write(&[word("שב 12", [0.0, 0.0, 9.0, 9.0])]).unwrap();
    assert!(
        String::from_utf8_lossy(&hebrew).contains(r"(\000\002\000\003\000\001\000\004\000\005) Tj")
    );
    assert!(!String::from_utf8_lossy(&write(&words[1..2]).unwrap()).contains("/Font"));
    // A box may hang over an edge by a pixel, since it is often rounded, and nothing else.
    assert!(write(&[word("a", [-1.0, 0.0, 42.0, 31.0])]).is_ok());
    for bounds in [
        [-2.0, 0.0, 9.0, 9.0],
        [0.0, 23.0, 9.0, 9.0],
        [f64::NAN, 0.0, 9.0, 9.0],
        [0.0, 0.0, f64::INFINITY, 9.0],
        [0.0, 0.0, 0.0, 9.0],
        [0.0, 0.0, 9.0, -9.0],
        [0.0, 0.0, 9.0, 1e-300],
    ] {
        let error = write(&[words[0], word("a", bounds)]).unwrap_err();
        assert_eq!(error.code(), "UNSUPPORTED", "{bounds:?}");
        let message = error.to_string();
        assert!(
            message.contains("word 2 of page 1") && message.contains("40 × 30 pixels"),
            "{message}"
        );
    }
    let all: String = ('\u{1}'..='\u{1FFFF}')
        .filter(|c| !c.is_whitespace())
        .collect();
    let error = write(&[word(&all, [0.0, 0.0, 40.0, 30.0])]).unwrap_err();
    assert_eq!(error.code(), "TOO_LARGE");
}

#[test]
fn books_take_pictures_as_they_are_and_refuse_others() {
    let rgba: Vec<u8> = (0..4 * 40 * 30)
        .map(|i| if i % 4 == 3 { 255 } else { (i % 251) as u8 })
        .collect();
    let photo = Photo::new(40, 30, &rgba).unwrap();
    let options = PhotoOptions::default();
    let pictures = [
        write_photo_jpeg(&photo, &options).unwrap(),
        write_photo(&photo, &options).unwrap(),
    ];
    let size = [210.0, 297.0];
    let pages: Vec<BookPage<'_>> = pictures
        .iter()
        .map(|picture| BookPage {
            picture,
            size,
            words: &[],
        })
        .collect();
    let book = write_book(&pages, None).unwrap();
    let has = |part: &[u8]| book.windows(part.len()).any(|window| window == part);
    assert!(has(&pictures[0]) && has(b"/Count 2") && has(b"/FlateDecode") && has(b"/DCTDecode"));
    let refused = |picture: &[u8], size| one_page_book(picture, size, &[]).unwrap_err().code();
    assert_eq!(refused(b"GIF89a", size), "UNSUPPORTED");
    assert_eq!(refused(&pictures[0], [1.0, 297.0]), "UNSUPPORTED");
    assert_eq!(refused(&pictures[0], [f64::NAN, 297.0]), "UNSUPPORTED");
    // What is transparent lies on white.
    let book_of = |rgba: &[u8]| {
        let picture = write_photo(&Photo::new(40, 30, rgba).unwrap(), &options).unwrap();
        one_page_book(&picture, size, &[]).unwrap()
    };
    let black = [0, 0, 0, 255].repeat(600);
    let see_through = [&black[..], &[90, 60, 30, 0].repeat(600)].concat();
    let on_white = [&black[..], &[255; 2400]].concat();
    assert!(book_of(&see_through) == book_of(&on_white));
    let half = book_of(&[100, 200, 0, 51].repeat(1200));
    assert!(half == book_of(&[224, 244, 204, 255].repeat(1200)));
    assert_eq!(write_book(&[], None).unwrap_err().code(), "EMPTY");
    // Cut off anywhere, a file is refused or goes in as it is, without a panic.
    for picture in &pictures {
        for length in 0..picture.len().min(700) {
            let page = BookPage {
                picture: &picture[..length],
                size,
                words: &[],
            };
            let _ = write_book(&[page], None);
        }
        assert_eq!(refused(&picture[..20], size), "FORMAT");
    }
}
