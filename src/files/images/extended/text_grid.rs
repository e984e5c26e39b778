//! Reads grids of heights that are text: grids of ESRI and Surfer, points on a grid (XYZ) and plain matrices.

use super::tiff_tags::map_sides;
use crate::error::{Result, checked_cells};
use crate::files::Assumption;
use crate::files::failure::{damaged, not_read};
use crate::files::images::decoded::StoredImage;
use crate::files::images::georeference::Georeference;
use crate::files::images::no_data;
use crate::files::images::scale::is_needle;
use crate::files::kind::CONVERT_RAW;
use crate::files::number_type::NumberType;
use crate::files::table::{Table, numbers};
use crate::files::text::decoded;

/// Value that means no data in Surfer's format.
const SURFER_BLANK: f64 = 1.701_41e38;

pub(super) fn decode(bytes: &[u8]) -> Result<StoredImage> {
    let text = decoded(bytes);
    match text.strip_prefix("DSAA") {
        Some(grid) => surfer_grid(grid),
        None => esri_grid(&text)?.map_or_else(|| table(&text), Ok),
    }
}

/// Makes an image of the values of a grid of columns and rows, whose cells have the given sides and whose south-west one has
/// its middle at the given place if these are known, as is the value that means no data.
///
/// # Errors
/// [`Error::Format`](crate::Error::Format) for another number of values, and for sides that are no lengths.
fn image(
    values: Vec<f64>,
    size: (usize, usize),
    sides: Option<[f64; 2]>,
    middle: Option<[f64; 2]>,
    no_data: Option<f64>,
) -> Result<StoredImage> {
    let count = checked_cells("text grid", size.1, size.0)?;
    if values.len() != count || count == 0 {
        let reason = format!(
            "it has {} values, but {} rows of {}",
            values.len(),
            size.1,
            size.0
        );
        return Err(damaged(reason));
    }
    if !(sides.iter().flatten()).all(|side| side.is_finite() && *side > 0.0) {
        return Err(damaged("its cells have no size"));
    }
    let mut image = StoredImage {
        sides,
        no_data,
        ..StoredImage::new(size, values, NumberType::F64)
    };
    let place = sides.zip(middle.filter(|place| place.iter().all(|v| v.is_finite())));
    if let Some(map) = place.and_then(|(sides, middle)| degrees(&image, sides, middle)) {
        let words = "coordinates are degrees of longitude and latitude, and heights are metres";
        image
            .assumptions
            .push(Assumption::new("mapUnit", words, "pixelSize"));
        let (sides, unit) = map_sides(&map, size, &mut image.assumptions)?;
        (image.sides, image.unit) = (Some(sides), unit);
        image.georeference = Some(map);
    } else if let Some(([dx, dy], [x, y])) = place {
        let north = y + dy * (size.1 as f64 - 0.5);
        let transformation = [dx, 0.0, x - 0.5 * dx, 0.0, -dy, north];
        image.georeference = Some(Georeference::new(transformation, &[]));
    }
    Ok(image)
}

/// Where a grid lies on the globe if its coordinates may be longitudes and latitudes, and would make a needle of it as lengths.
fn degrees(
    image: &StoredImage,
    [dx, dy]: [f64; 2],
    [west, south]: [f64; 2],
) -> Option<Georeference> {
    let (cols, rows) = image.size;
    let [width, height] = [(cols, dx), (rows, dy)].map(|(n, side)| (n - 1) as f64 * side);
    let north = south + height;
    let is_on_globe = west >= -180.0 && west + width <= 360.0 && south >= -90.0 && north <= 90.0;
    // A place of its own, and not the origin of a model.
    let is_map = is_on_globe && (west.abs() > 0.5 * dx || south.abs() > 0.5 * dy);
    let mut heights = is_map.then(|| image.values.clone())?;
    if let Some(missing) = image.no_data {
        no_data::remove(&mut heights, missing, image.number_type);
    }
    no_data::assume_no_data(&mut heights, image.no_data.is_some());
    is_needle(&heights, width.max(height))
        .then(|| Georeference::of_degrees([west, north], [dx, dy]))
}

/// Reads an ESRI ASCII grid; `None` if the text does not begin like one.
fn esri_grid(text: &str) -> Result<Option<StoredImage>> {
    let mut head = std::collections::HashMap::new();
    let mut rest = text.trim_start();
    while let Some((line, after)) = rest.split_once('\n') {
        let mut words = line.split_whitespace();
        let (Some(name), Some(value), None) = (words.next(), words.next(), words.next()) else {
            break;
        };
        if !name.starts_with(|letter: char| letter.is_ascii_alphabetic()) {
            break;
        }
        head.insert(name.to_ascii_lowercase(), value);
        rest = after;
    }
    let number = |name: &str| -> Result<Option<f64>> {
        let parsed = head.get(name).map(|value| value.replace(',', ".").parse());
        let wrong = |_| damaged(format!("its {name} is `{}`, no number", head[name]));
        parsed.transpose().map_err(wrong)
    };
    let (Some(cols), Some(rows)) = (number("ncols")?, number("nrows")?) else {
        return Ok(None);
    };
    let size = (cols as usize, rows as usize);
    let cell = number("cellsize")?;
    let [dx, dy] = [number("dx")?.or(cell), number("dy")?.or(cell)];
    let sides = dx.zip(dy).map(<[f64; 2]>::from);
    let values = numbers(rest, true)?;
    if values.is_empty() {
        return Err(not_read(CONVERT_RAW));
    }
    let no_data = number("nodata_value")?;
    let [x, y] = [("x", dx), ("y", dy)].map(|(axis, side)| -> Result<Option<f64>> {
        let corner = number(&format!("{axis}llcorner"))?.zip(side);
        let middle = corner.map(|(corner, side)| corner + 0.5 * side);
        Ok(middle.or(number(&format!("{axis}llcenter"))?))
    });
    let middle = x?.zip(y?).map(<[f64; 2]>::from);
    image(values, size, sides, middle, no_data).map(Some)
}

/// Reads what follows the first word of a grid of Surfer: numbers of columns and rows, ranges of x, y and z, and the rows
/// from the lowest y upwards.
fn surfer_grid(text: &str) -> Result<StoredImage> {
    let mut values = numbers(text, false)?;
    let cut_short = || damaged("its header is cut short");
    let head = *values.first_chunk::<8>().ok_or_else(cut_short)?;
    let [cols, rows, x0, x1, y0, y1, _, _] = head;
    if cols.fract() != 0.0 || rows.fract() != 0.0 {
        return Err(damaged("its rows and columns are no whole numbers"));
    }
    let size = (cols as usize, rows as usize);
    values.drain(..head.len());
    // Some programs write more digits of the blank than others.
    let blanks = values.iter_mut().filter(|value| **value >= SURFER_BLANK);
    blanks.for_each(|value| *value = f64::NAN);
    let rows_from_above = values.rchunks(size.0.max(1)).collect::<Vec<_>>().concat();
    // Of one row or column they are infinite.
    let sides = [(x1 - x0) / (cols - 1.0), (y1 - y0) / (rows - 1.0)];
    image(
        rows_from_above,
        size,
        Some(sides),
        Some([x0, y0]),
        Some(SURFER_BLANK),
    )
}

/// Reads a table: points on a grid if the first three numbers of its lines are their places, else a matrix.
fn table(text: &str) -> Result<StoredImage> {
    let table = Table::read(text)?;
    if let Some(grid) = table.points_on_grid()? {
        let [sides, corner] = [grid.sides, grid.corner].map(Some);
        return image(grid.values, grid.size, sides, corner, None);
    }
    let points = format!(
        "lines of {} numbers are rows of a matrix: they are no points on a grid",
        table.cols
    );
    let numbered = "the first row and the first column number the others".to_owned();
    let told = [
        (table.may_be_points(), points),
        (table.is_numbered, numbered),
    ]
    .into_iter()
    .filter(|(is_told, _)| *is_told);
    Ok(StoredImage {
        assumptions: told
            .map(|(_, words)| Assumption::new("matrix", words, None))
            .collect(),
        ..image(table.values, (table.cols, table.rows), None, None, None)?
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::image_format::Format;
    use crate::files::images::DecodeOptions;

    fn read(text: &str) -> (usize, usize, f64, Vec<f64>) {
        let file = decode(text.as_bytes())
            .and_then(|file| file.finish(Format::Text, &DecodeOptions::default()))
            .unwrap();
        (file.width, file.height, file.pixel_size, file.values)
    }

    #[test]
    fn an_esri_grid_without_a_size_of_cells_has_one_that_is_assumed() {
        let file = decode(b"ncols 3\nnrows 2\n100 900 500\n300 200 700\n").unwrap();
        assert_eq!(file.sides, None);
        let file = file
            .finish(Format::Text, &DecodeOptions::default())
            .unwrap();
        let assumed: Vec<&str> = file.assumptions.iter().map(|one| one.code).collect();
        assert_eq!(assumed, ["pixelSize"]);
    }

    #[test]
    fn esri_grids_are_read() {
        let head = "ncols 3\nnrows 2\nxllcorner 4\nyllcorner 5\ncellsize 2.5\nNODATA_value -9999\n";
        let (width, height, side, values) = read(&format!("{head}1 2 3\n4 -9999 6.5\n"));
        assert_eq!((width, height, side), (3, 2, 2.5));
        assert_eq!((&values[..4], values[5]), (&[1.0, 2.0, 3.0, 4.0][..], 6.5));
        assert!(values[4].is_nan());
        // Windows' line ends, capitals, decimal commas, values in lines of any length.
        let odd = "NCOLS 2\r\nNROWS 2\r\nXLLCENTER 0,5\r\nYLLCENTER 0,5\r\nCELLSIZE 0,5\r\n1,5\r\n2 3 4\r\n";
        assert_eq!(read(odd), (2, 2, 0.5, vec![1.5, 2.0, 3.0, 4.0]));
        // Indented, with lines that end as on old Macs, and the largest number of 32 bits with more digits than its name.
        let old = format!("\n {head}1 2 3\n4 -3.4028234663852886e+38 6.5\n")
            .replace("-9999", "-3.4028235e+38");
        assert_eq!(Format::detect(old.as_bytes()), Some(Format::Text));
        let values = read(&old.replace('\n', "\r")).3;
        assert!(values[4].is_nan() && values[5] == 6.5, "{values:?}");
        let error = decode(b"ncols 3\nnrows 2\n1 2 3\n4 5\n")
            .unwrap_err()
            .to_string();
        assert!(error.contains("5 values, but 2 rows of 3"), "{error}");
        let header = decode(b"ncols 3\nnrows 2\ncellsize 1\nbyteorder LSBFIRST\n").unwrap_err();
        assert!(header.to_string().contains("gdal_translate"), "{header}");
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
            let map = decode(text.as_bytes()).unwrap().georeference.unwrap();
            assert_eq!(
                map.transformation,
                [2.0, 0.0, 4.0, 0.0, -2.0, 9.0],
                "{text}"
            );
        }
        assert_eq!(decode(b"1 2\n3 4\n").unwrap().georeference, None);
    }

    /// Heights of 1 to 5 beside a third without data are no needle, whichever number stands for these.
    #[test]
    fn what_means_no_data_makes_no_needle_of_a_grid() {
        let esri = |head: &str, missing: &str| {
            let place = "ncols 3\nnrows 3\nxllcorner 10\nyllcorner 20\ncellsize 0.5\n";
            format!("{place}{head}1 {missing} 3\n{missing} 5 {missing}\n2 4 1\n")
        };
        let surfer =
            "DSAA\n3 3\n10 11\n20 21\n1 5\n1 1.7014118e38 3\n1.71e38 5 1.70141e38\n2 4 1\n";
        for text in [
            esri("NODATA_value -9999\n", "-9999"),
            esri("", "-9999"),
            surfer.to_owned(),
        ] {
            let (width, height, side, _) = read(&text);
            assert_eq!((width, height, side), (3, 3, 0.5), "{text}");
        }
        let values = read(surfer).3;
        assert_eq!(values.iter().filter(|value| value.is_nan()).count(), 3);
    }

    #[test]
    fn degrees_are_told_by_the_needle_that_they_would_make_as_lengths() {
        // Two minutes of arc at 46.5° of latitude, by the usual series: 76.76 km and 111.16 km for a degree.
        let step = 1.0 / 60.0;
        let heights = "400 900 1500\n700 300 200\n800 650 720\n";
        let esri = |place: &str, heights: &str| {
            decode(format!("ncols 3\nnrows 3\n{place}\ncellsize {step}\n{heights}").as_bytes())
                .unwrap()
        };
        let place = "xllcorner 8.5\nyllcorner 46.475";
        let points: String = (0..9)
            .map(|i| {
                format!(
                    "{} {} {}\n",
                    8.5 + f64::from(i % 3) * step,
                    46.475 + f64::from(i / 3) * step,
                    99 * i
                )
            })
            .collect();
        for grid in [esri(place, heights), decode(points.as_bytes()).unwrap()] {
            let [x, y] = grid.sides.unwrap().map(|side| side / step);
            assert!(
                (x - 76_760.0).abs() < 20.0 && (y - 111_160.0).abs() < 20.0,
                "{x} {y}"
            );
            assert_eq!(grid.unit, Some(crate::files::Unit::Metre));
            let codes: Vec<&str> = grid.assumptions.iter().map(|one| one.code).collect();
            assert_eq!(codes, ["mapUnit", "degrees"]);
        }
        // Heights that are no needle, and a model at the origin.
        let flat = esri(place, "0.01 0.02 0.01\n0 0 0\n0 0 0\n");
        let model = esri("xllcorner 0\nyllcorner 0", heights);
        assert_eq!([flat.sides, model.sides], [Some([step; 2]); 2]);
    }

    #[test]
    fn grids_of_surfer_are_read_from_below() {
        let head = "DSAA\r\n3 2\r\n10 11\r\n7 7.5\r\n1 6\r\n";
        let (width, height, side, values) = read(&format!("{head}4 5\r\n6\r\n1 2 1.70141e+38\r\n"));
        assert_eq!((width, height, side), (3, 2, 0.5));
        assert_eq!(values[..2], [1.0, 2.0]);
        assert!(values[2].is_nan());
        assert_eq!(values[3..], [4.0, 5.0, 6.0]);
        let error = decode(format!("{head}4 5 6").as_bytes()).unwrap_err();
        assert!(error.to_string().contains("3 values, but 2 rows of 3"));
        assert!(decode(b"DSAA 3 2 0 1").is_err());
        assert!(decode(b"DSAA 2 2 0 0 0 1 0 1 1 2 3 4").is_err());
    }

    #[test]
    fn points_on_a_grid_are_read_in_any_order() {
        let text = "x;y;z\n10,0;7,0;1,5\n10,5;7,0;2\n10,5;6,5;4\n11,0;6,5;5\n11,0;7,0;3\n";
        let (width, height, side, values) = read(text);
        assert_eq!((width, height, side), (3, 2, 0.5));
        assert_eq!(values[..3], [1.5, 2.0, 3.0]);
        assert!(values[3].is_nan());
        assert_eq!(values[4..], [4.0, 5.0]);
    }

    #[test]
    fn points_may_have_colours() {
        let (width, height, side, values) = read(
            "0 0 5 9 9 9\n2 0 6 9 9 9\n0 2 7 9 9 9\n2 2 8 9 9 9\n4 2 9 9 9 9\n4 0 1 9 9 9\n6 0 1 9 9 9\n",
        );
        assert_eq!((width, height, side), (4, 2, 2.0));
        assert_eq!(values[..3], [7.0, 8.0, 9.0]);
    }

    #[test]
    fn a_small_thing_before_a_background_has_a_size_of_pixels_that_is_told() {
        // A ridge 0.13 high in a corner of a render, whose background is far away.
        let row = |y: i32| {
            (0..60).map(move |x| {
                if x < 12 && y < 12 {
                    0.55 + 0.02 * f64::from((x - 6_i32).abs())
                } else {
                    1e11
                }
            })
        };
        let text: String = (0..60)
            .map(|y| row(y).map(|value| format!("{value} ")).collect::<String>() + "\n")
            .collect();
        let read = decode(text.as_bytes())
            .and_then(|file| file.finish(Format::Text, &DecodeOptions::default()))
            .unwrap();
        let told: Vec<&str> = read.assumptions.iter().map(|one| one.code).collect();
        assert_eq!(told, ["noData", "pixelSize"]);
    }

    #[test]
    fn rounded_coordinates_are_a_grid() {
        // Thirds of a degree with six digits, whose steps are of two lengths.
        let places = |rows: i32| (0..rows).flat_map(|row| (0..2000).map(move |col| (col, row)));
        let text: String = places(2)
            .map(|(col, row)| format!("{:.6} {row} {}\n", f64::from(col) / 3000.0, col % 9))
            .collect();
        let found = decode(text.as_bytes()).unwrap();
        assert_eq!(found.size, (2000, 2));
        assert!((found.sides.unwrap()[0] - 1.0 / 3000.0).abs() < 1e-8);
    }

    #[test]
    fn tables_of_other_programs_are_told() {
        let wide: Vec<u8> = ("\u{feff}1,5\t2\r\n3\t4\r\n".encode_utf16())
            .flat_map(u16::to_le_bytes)
            .collect();
        // Excel's text, and a name in an old encoding.
        assert_eq!(Format::detect(&wide), Some(Format::Text));
        assert_eq!(decode(&wide).unwrap().values, [1.5, 2.0, 3.0, 4.0]);
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
            assert_eq!((width, height), (3, 3), "{text}");
            let missing: Vec<usize> = (0..9).filter(|i| values[*i].is_nan()).collect();
            assert_eq!(
                (missing, values[0], values[8]),
                (vec![1, 5], 1.0, 9.0),
                "{text}"
            );
        }
        // As pandas writes a table, with names or numbers of its columns.
        // As R does, which quotes them.
        for head in [",a,b", ",0,1", "\"\",\"V1\",\"V2\""] {
            let text = format!("{head}\n\"0\",5,6\n1,7,8\n");
            assert_eq!(read(&text).3, [5.0, 6.0, 7.0, 8.0], "{head}");
            let told = decode(text.as_bytes()).unwrap().assumptions;
            assert_eq!(told[0].code, "matrix");
        }
        assert_eq!(read("1 2;\n3 4;\n").3, [1.0, 2.0, 3.0, 4.0]);
        // By R's `write.table`, with its name for a missing number; prose before a matrix names no columns.
        for (text, numbers) in [
            (
                "\"V1\" \"V2\" \"V3\"\n\"1\" 5 6 NA\n\"2\" 7 8 9\n",
                [5.0, 6.0, 7.0, 8.0],
            ),
            (
                "three named columns\n2 5 6 NA\n1 7 8 9\n",
                [2.0, 5.0, 6.0, 1.0],
            ),
        ] {
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
            "1,5; 2; 3; 4\n5; 6; 7; 8\n",
            "1.5,2,3,4\n5,6,7,8\n",
        ] {
            assert_eq!(
                read(text),
                (4, 2, 1.0, vec![1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]),
                "{text}"
            );
        }
        // Three columns that are no places.
        assert_eq!(read("1 1 5\n1 1 6\n1 1 7\n1 1 8\n").0, 3);
        assert!(decode(b"1 2\n3\n").is_err() && decode(b"a b\n").is_err());
    }
}
