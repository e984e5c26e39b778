//! Grids of heights that are text: of ESRI and Surfer, points on a grid, and matrices.

use developable::Result;
use developable::files::Unit;
use developable::files::images::{Decoded, Format};

fn decode(text: &str) -> Result<Decoded> {
    developable::files::images::decode(text.as_bytes(), Some(Format::Text))
}

/// Width, height, size of a pixel and values.
fn read(text: &str) -> (usize, usize, f64, Vec<f64>) {
    let read = decode(text).unwrap_or_else(|error| panic!("{error}: {text}"));
    (read.width, read.height, read.pixel_size, read.values)
}

fn codes(text: &str) -> Vec<&'static str> {
    let told = decode(text).unwrap().assumptions;
    told.into_iter().map(|one| one.code).collect()
}

/// Indices of the values without data.
fn missing(values: &[f64]) -> Vec<usize> {
    (0..values.len()).filter(|i| values[*i].is_nan()).collect()
}

#[test]
fn esri_grids_are_read() {
    let head = "ncols 3\nnrows 2\nxllcorner 4\nyllcorner 5\ncellsize 2.5\nNODATA_value -9999\n";
    let (width, height, side, values) = read(&format!("{head}1 2 3\n4 -9999 6.5\n"));
    assert_eq!((width, height, side), (3, 2, 2.5));
    assert_eq!((&values[..4], values[5]), (&[1.0, 2.0, 3.0, 4.0][..], 6.5));
    assert_eq!(missing(&values), [4]);
    // Windows' line ends, capitals, decimal commas, values in lines of any length.
    let odd =
        "NCOLS 2\r\nNROWS 2\r\nXLLCENTER 0,5\r\nYLLCENTER 0,5\r\nCELLSIZE 0,5\r\n1,5\r\n2 3 4\r\n";
    assert_eq!(read(odd), (2, 2, 0.5, vec![1.5, 2.0, 3.0, 4.0]));
    // Indented, with lines that end as on old Macs, and the largest number of 32 bits with more digits than its name.
    let old = format!("\n {head}1 2 3\n4 -3.4028234663852886e+38 6.5\n");
    let old = old.replace("-9999", "-3.4028235e+38");
    assert_eq!(Format::detect(old.as_bytes()), Some(Format::Text));
    assert_eq!(missing(&read(&old.replace('\n', "\r")).3), [4]);
    assert_eq!(
        codes("ncols 3\nnrows 2\n100 900 500\n300 200 700\n"),
        ["pixelSize"]
    );
}

#[test]
fn damaged_tables_are_told() {
    let surfer = "DSAA\n3 2\n10 11\n7 7.5\n1 6\n4 5 6";
    for (text, words) in [
        (
            "ncols 3\nnrows 2\n1 2 3\n4 5\n",
            "5 values, but 2 rows of 3",
        ),
        (
            "ncols 3\nnrows 2\ncellsize 1\nbyteorder LSBFIRST\n",
            "gdal_translate",
        ),
        (surfer, "3 values, but 2 rows of 3"),
        ("DSAA\n3 2\n0 1\n", "cut short"),
        ("DSAA\n2 2\n0 0\n0 1\n0 1\n1 2 3 4\n", "no size"),
        ("1 2\n3\n", "line 2 has 1 numbers"),
    ] {
        let error = decode(text).unwrap_err().to_string();
        assert!(error.contains(words), "{text}: {error}");
    }
    assert!(decode("a b\n").is_err());
}

#[test]
fn grids_keep_their_place_on_a_map() {
    let corner = "ncols 3\nnrows 2\nxllcorner 4\nyllcorner 5\ncellsize 2\n1 2 3\n4 5 6\n";
    let center = corner
        .replace("xllcorner 4", "xllcenter 5")
        .replace("yllcorner 5", "yllcenter 6");
    let surfer = "DSAA\n3 2\n5 9\n6 8\n1 6\n4 5 6\n1 2 3\n";
    let points = "5 6 4\n7 6 5\n9 6 6\n5 8 1\n7 8 2\n9 8 3\n";
    for text in [corner, &center, surfer, points] {
        let map = decode(text).unwrap().georeference.unwrap();
        assert_eq!(
            map.transformation,
            [2.0, 0.0, 4.0, 0.0, -2.0, 9.0],
            "{text}"
        );
    }
    assert_eq!(decode("1 2\n3 4\n").unwrap().georeference, None);
}

/// Heights of 1 to 5 beside a third without data are no needle, whichever number stands for these.
#[test]
fn what_means_no_data_makes_no_needle_of_a_grid() {
    let esri = |head: &str| {
        let place = "ncols 3\nnrows 3\nxllcorner 10\nyllcorner 20\ncellsize 0.5\n";
        format!("{place}{head}1 -9999 3\n-9999 5 -9999\n2 4 1\n")
    };
    // Some programs write more digits of the blank than others; rows go upwards.
    let surfer = "DSAA\n3 3\n10 11\n20 21\n1 5\n2 4 1\n1.71e38 5 1.70141e38\n1 1.7014118e38 3\n";
    for text in [&esri("NODATA_value -9999\n"), &esri(""), surfer] {
        let (width, height, side, values) = read(text);
        assert_eq!((width, height, side), (3, 3, 0.5), "{text}");
        assert_eq!(missing(&values), [1, 3, 5], "{text}");
    }
}

#[test]
fn degrees_are_told_by_the_needle_that_they_would_make_as_lengths() {
    // A minute of arc at 46.5° of latitude, by the usual series: 76.76 km and 111.16 km for a degree.
    let step = 1.0 / 60.0;
    let heights = "400 900 1500\n700 300 200\n800 650 720\n";
    let esri = |place: &str, heights: &str| {
        decode(&format!(
            "ncols 3\nnrows 3\n{place}\ncellsize {step}\n{heights}"
        ))
        .unwrap()
    };
    let place = "xllcorner 8.5\nyllcorner 46.475";
    let point = |i: i32| {
        let [x, y] = [i % 3, i / 3].map(|k| f64::from(k) * step);
        format!("{} {} {}\n", 8.5 + x, 46.475 + y, 99 * i)
    };
    let points: String = (0..9).map(point).collect();
    for grid in [esri(place, heights), decode(&points).unwrap()] {
        // Squares as wide as a minute of longitude.
        assert!(
            (grid.pixel_size / step - 76_760.0).abs() < 20.0,
            "{}",
            grid.pixel_size
        );
        assert_eq!(
            (grid.width, grid.height, grid.unit),
            (3, 4, Some(Unit::Metre))
        );
        let codes: Vec<&str> = grid.assumptions.iter().map(|one| one.code).collect();
        assert_eq!(codes, ["mapUnit", "degrees", "squarePixels"]);
    }
    // Heights that are no needle, and a model at the origin.
    let flat = esri(place, "0.01 0.02 0.01\n0 0 0\n0 0 0\n");
    let model = esri("xllcorner 0\nyllcorner 0", heights);
    assert_eq!([flat.pixel_size, model.pixel_size], [step; 2]);
}

#[test]
fn grids_of_surfer_are_read_from_below() {
    let grid = "DSAA\r\n3 2\r\n10 11\r\n7 7.5\r\n1 6\r\n4 5\r\n6\r\n1 2 1.70141e+38\r\n";
    let (width, height, side, values) = read(grid);
    assert_eq!((width, height, side), (3, 2, 0.5));
    assert_eq!(
        (&values[..2], &values[3..]),
        (&[1.0, 2.0][..], &[4.0, 5.0, 6.0][..])
    );
    assert_eq!(missing(&values), [2]);
}

#[test]
fn points_on_a_grid_are_read_in_any_order_and_with_colours() {
    let text = "x;y;z\n10,0;7,0;1,5\n10,5;7,0;2\n10,5;6,5;4\n11,0;6,5;5\n11,0;7,0;3\n";
    let (width, height, side, values) = read(text);
    assert_eq!((width, height, side), (3, 2, 0.5));
    assert_eq!(
        (&values[..3], &values[4..]),
        (&[1.5, 2.0, 3.0][..], &[4.0, 5.0][..])
    );
    let text = "0 0 5\n2 0 6\n0 2 7\n2 2 8\n4 2 9\n4 0 1\n6 0 1\n".replace('\n', " 9 9 9\n");
    let (width, height, side, values) = read(&text);
    assert_eq!((width, height, side), (4, 2, 2.0));
    assert_eq!(values[..3], [7.0, 8.0, 9.0]);
    // Thirds of a degree with six digits, whose steps are of two lengths.
    let places = (0..2).flat_map(|row| (0..2000).map(move |col| (col, row)));
    let text: String = places
        .map(|(col, row)| {
            format!(
                "{:.6} {} {}\n",
                f64::from(col) / 3000.0,
                f64::from(row) / 3000.0,
                1e-3 * f64::from(col % 9)
            )
        })
        .collect();
    let (width, height, side, _) = read(&text);
    assert_eq!((width, height), (2000, 2));
    assert!((side - 1.0 / 3000.0).abs() < 1e-6, "{side}");
}

#[test]
fn a_small_thing_before_a_background_has_a_size_of_pixels_that_is_told() {
    // A ridge 0.13 high in a corner of a render, whose background is far away.
    let value = |x: i32, y: i32| match x < 12 && y < 12 {
        true => 0.55 + 0.02 * f64::from((x - 6).abs()),
        false => 1e11,
    };
    let row = |y: i32| {
        (0..60)
            .map(move |x| format!("{} ", value(x, y)))
            .collect::<String>()
    };
    let text: String = (0..60).map(|y| row(y) + "\n").collect();
    assert_eq!(codes(&text), ["noData", "pixelSize"]);
}

#[test]
fn tables_of_other_programs_are_told() {
    let wide: Vec<u8> = ("\u{feff}1,5\t2\r\n3\t4\r\n".encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect();
    // Excel's text, and a name in an old encoding.
    assert_eq!(
        developable::files::images::decode(&wide, None)
            .unwrap()
            .values,
        [1.5, 2.0, 3.0, 4.0]
    );
    assert_eq!(Format::detect(b"H\xf6he;b\n1;2\n3;4\n"), Some(Format::Text));
    assert_eq!(Format::detect(b"\0\x01 2 3\n4 5\n"), None);
}

#[test]
fn cells_of_tables_may_be_empty_or_number_the_others() {
    for text in [
        "1,,3\n4,5,\n7,8,9\n",
        "1;;3;\n4;5;;\n7;8;9;\n",
        "1\t\t3\n4\t5\t \n7\t8\t9\n",
    ] {
        let (width, height, _, values) = read(text);
        let found = (width, height, values[0], values[8]);
        assert_eq!(found, (3, 3, 1.0, 9.0), "{text}");
        assert_eq!(missing(&values), [1, 5], "{text}");
    }
    // As pandas writes a table, with names or numbers of its columns, and as R does, which quotes them.
    for head in [",a,b", ",0,1", "\"\",\"V1\",\"V2\""] {
        let text = format!("{head}\n\"0\",5,6\n1,7,8\n");
        assert_eq!(read(&text).3, [5.0, 6.0, 7.0, 8.0], "{head}");
        assert_eq!(codes(&text)[0], "matrix");
    }
    // By R's `write.table`, with its name for a missing number; prose before a matrix names no columns.
    let r = "\"V1\" \"V2\" \"V3\"\n\"1\" 5 6 NA\n\"2\" 7 8 9\n";
    let prose = "three named columns\n2 5 6 NA\n1 7 8 9\n";
    for (text, numbers) in [(r, [5.0, 6.0, 7.0, 8.0]), (prose, [2.0, 5.0, 6.0, 1.0])] {
        let known: Vec<f64> = (read(text).3.into_iter()).filter(|v| !v.is_nan()).collect();
        assert_eq!(known[..4], numbers, "{text}");
        assert_eq!(Format::detect(text.as_bytes()), Some(Format::Text));
    }
}

#[test]
fn matrices_are_read() {
    for text in [
        "1.5 2 3 4\n5 6 7 8\n",
        "# heights\n1.5, 2, 3, 4\n5, 6, 7, 8",
        "1,5\t2\t3\t4\r\n5\t6\t7\t8\r\n",
        "1,5; 2; 3; 4;\n5; 6; 7; 8;\n",
        "1.5,2,3,4\n5,6,7,8\n",
        "1.5,\t2,\t3,\t4,\n5,\t6,\t7,\t8,\n",
        "1.5 2 3 4\n# more\n5 6 7 8\n",
    ] {
        let numbers = vec![1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
        assert_eq!(read(text), (4, 2, 1.0, numbers), "{text}");
    }
    // Three columns that are no places.
    assert_eq!(read("1 1 5\n1 1 6\n1 1 7\n1 1 8\n").0, 3);
}
