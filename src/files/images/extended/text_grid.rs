//! Reads grids of heights that are text: grids of ESRI and Surfer, points on a grid (XYZ) and plain matrices.

use crate::error::{Result, checked_cells, try_filled};
use crate::files::Assumption;
use crate::files::failure::damaged;
use crate::files::image_format::Format;
use crate::files::images::decoded::StoredImage;
use crate::files::number_type::NumberType;
use crate::files::text::decoded;

/// Maximum distance of a point from its place on the grid, as a share of the grid's spacing.
const MAX_OFF_GRID_SHARE: f64 = 0.02;

/// Smallest value that means no data in a grid of Surfer.
const SURFER_BLANK: f64 = 1.701_41e38;

/// A grid of heights with the sides of its cells.
struct Grid {
    values: Vec<f64>,
    size: (usize, usize),
    sides: Option<[f64; 2]>,
    assumptions: Vec<Assumption>,
}

pub(super) fn decode(bytes: &[u8]) -> Result<StoredImage> {
    let text = decoded(bytes);
    let text = text.as_ref();
    let (grid, no_data) = if let Some(grid) = text.strip_prefix("DSAA") {
        (surfer_grid(grid)?, Some(SURFER_BLANK))
    } else if let Some(found) = esri_grid(text)? {
        found
    } else {
        (table(text)?, None)
    };
    let mut values = grid.values;
    for value in values.iter_mut().filter(|value| Some(**value) == no_data) {
        *value = f64::NAN;
    }
    Ok(StoredImage {
        names_no_data: no_data.is_some(),
        sides: grid.sides,
        assumptions: grid.assumptions,
        ..StoredImage::new(Format::Text, grid.size, values, NumberType::F64)
    })
}

/// Reads an ESRI ASCII grid and its value of no data; `None` if the text does not begin like one.
fn esri_grid(text: &str) -> Result<Option<(Grid, Option<f64>)>> {
    let mut head = std::collections::HashMap::new();
    let mut rest = text;
    while let Some((line, after)) = rest.split_once('\n') {
        let mut words = line.split_whitespace();
        let (Some(name), Some(value), None) = (words.next(), words.next(), words.next()) else {
            break;
        };
        if !name.starts_with(|letter: char| letter.is_ascii_alphabetic()) {
            break;
        }
        head.insert(name.to_lowercase(), value);
        rest = after;
    }
    let number = |name: &str| -> Result<Option<f64>> {
        let Some(value) = head.get(name) else {
            return Ok(None);
        };
        match value.replace(',', ".").parse() {
            Ok(value) => Ok(Some(value)),
            Err(_) => Err(damaged(
                Format::Text,
                format!("its {name} is `{value}`, no number"),
            )),
        }
    };
    let (Some(cols), Some(rows)) = (number("ncols")?, number("nrows")?) else {
        return Ok(None);
    };
    let size = (cols as usize, rows as usize);
    let cell = number("cellsize")?;
    let [dx, dy] = [number("dx")?.or(cell), number("dy")?.or(cell)];
    let sides = dx.zip(dy).map(|(dx, dy)| [dx, dy]);
    if !(sides.iter().flatten()).all(|side| side.is_finite() && *side > 0.0) {
        return Err(damaged(Format::Text, "its cells have no size"));
    }
    let count = checked_cells("ASCII grid", size.1, size.0)?;
    let values = numbers(rest, true)?;
    if values.len() != count || count == 0 {
        let reason = format!("it has {} values, but {rows} rows of {cols}", values.len());
        return Err(damaged(Format::Text, reason));
    }
    Ok(Some((
        Grid {
            values,
            size,
            sides,
            assumptions: Vec::new(),
        },
        number("nodata_value")?,
    )))
}

/// Reads what follows the first word of a grid of Surfer: numbers of columns and rows, ranges of x, y and z, and the rows
/// from the lowest y upwards.
fn surfer_grid(text: &str) -> Result<Grid> {
    let mut values = numbers(text, false)?;
    let cut_short = || damaged(Format::Text, "its header is cut short");
    let head = *values.first_chunk::<8>().ok_or_else(cut_short)?;
    let [cols, rows, x0, x1, y0, y1, _, _] = head;
    if cols.fract() != 0.0 || rows.fract() != 0.0 {
        return Err(damaged(
            Format::Text,
            "its rows and columns are no whole numbers",
        ));
    }
    let size = (cols as usize, rows as usize);
    let count = checked_cells("Surfer grid", size.1, size.0)?;
    values.drain(..head.len());
    if values.len() != count || size.0 < 2 || size.1 < 2 {
        let reason = format!("it has {} values, but {rows} rows of {cols}", values.len());
        return Err(damaged(Format::Text, reason));
    }
    let sides = [(x1 - x0) / (cols - 1.0), (y1 - y0) / (rows - 1.0)];
    if !sides.iter().all(|side| side.is_finite() && *side > 0.0) {
        return Err(damaged(Format::Text, "its cells have no size"));
    }
    Ok(Grid {
        values: (values.chunks_exact(size.0).rev().flatten())
            .map(|value| {
                if *value < SURFER_BLANK {
                    *value
                } else {
                    f64::NAN
                }
            })
            .collect(),
        size,
        sides: Some(sides),
        assumptions: Vec::new(),
    })
}

/// Reads lines of equally many numbers: points on a grid if the first three are their places, else a matrix. Lines before the
/// first number are names of columns or comments.
fn table(text: &str) -> Result<Grid> {
    // A comma is a decimal one wherever something else divides the numbers.
    let is_divided = text.lines().any(|line| {
        // Names of columns and comments are no rows; a number may have an exponent.
        let is_row = !line.contains(|letter: char| {
            letter == '#' || letter.is_alphabetic() && !"eEnNaA".contains(letter)
        });
        let is_blank_divided = line.trim().contains(' ') && !line.contains(", ");
        is_row && (line.contains([';', '\t']) || is_blank_divided)
    });
    // A table that numbers its rows and columns has nothing in its corner.
    let mut starts = text.lines().map(|line| line.starts_with(DIVIDERS));
    let is_numbered = starts.next() == Some(true) && starts.next() == Some(false);
    let mut values: Vec<f64> = Vec::new();
    let (mut cols, mut rows) = (0, 0);
    for (k, line) in text.lines().enumerate().skip(usize::from(is_numbered)) {
        let line = line.trim_end_matches([' ', '\r']);
        let mut row = match cells(line, is_divided) {
            Ok(row) if rows > 0 || !row.iter().all(|value| value.is_nan()) => row,
            Err(_) if rows > 0 => {
                let reason = format!("line {} is no row of numbers", k + 1);
                return Err(damaged(Format::Text, reason));
            }
            _ => continue,
        };
        row.drain(..usize::from(is_numbered).min(row.len()));
        if row.is_empty() {
            continue;
        }
        if row.len() + 1 == cols && line.ends_with(DIVIDERS) {
            row.push(f64::NAN);
        }
        if rows > 0 && row.len() != cols {
            let reason = format!(
                "line {} has {} numbers, where the lines before have {cols}",
                k + 1,
                row.len()
            );
            return Err(damaged(Format::Text, reason));
        }
        cols = row.len();
        rows += 1;
        values.extend(row);
    }
    checked_cells("matrix", rows, cols)?;
    if rows == 0 {
        return Err(damaged(Format::Text, "it has no numbers"));
    }
    let may_be_points = (3..=7).contains(&cols) && rows > cols;
    if let Some(points) = may_be_points
        .then(|| points_on_grid(&values, cols))
        .transpose()?
        .flatten()
    {
        return Ok(points);
    }
    let points = format!(
        "lines of {cols} numbers are rows of a matrix: they are no points on a grid (scattered points are read as PLY)"
    );
    let numbered = "the first row and the first column number the others".to_owned();
    let assumptions = [(may_be_points, points), (is_numbered, numbered)];
    let told = assumptions.into_iter().filter(|(is_told, _)| *is_told);
    Ok(Grid {
        values,
        size: (cols, rows),
        sides: None,
        assumptions: told
            .map(|(_, words)| Assumption::new("matrix", words, None))
            .collect(),
    })
}

/// What divides the cells of a table, any of which may be empty.
const DIVIDERS: [char; 3] = [';', '\t', ','];

/// Numbers of a row of a table, NaN for those that are missing; what divides them may also end it.
fn cells(line: &str, decimal_commas: bool) -> Result<Vec<f64>> {
    let divides = |letter: &char| line.contains(*letter) && !(*letter == ',' && decimal_commas);
    let Some(divider) = DIVIDERS.into_iter().find(divides) else {
        return numbers(line, decimal_commas);
    };
    let line = line.strip_suffix(divider).unwrap_or(line);
    let cell = |cell: &str| match numbers(cell, decimal_commas)?[..] {
        [] => Ok(f64::NAN),
        [number] => Ok(number),
        _ => Err(damaged(Format::Text, format!("`{cell}` is no number"))),
    };
    let row: Result<_> = line.split(divider).map(cell).collect();
    row.or_else(|_| numbers(line, decimal_commas))
}

/// Numbers of a text, between blanks and semicolons and, unless commas are decimal, commas.
fn numbers(text: &str, decimal_commas: bool) -> Result<Vec<f64>> {
    let divides =
        |letter: char| letter.is_whitespace() || letter == ';' || letter == ',' && !decimal_commas;
    text.split(divides)
        .filter(|word| !word.is_empty())
        .map(|word| {
            let plain = if decimal_commas {
                word.replace(',', ".")
            } else {
                word.to_owned()
            };
            plain
                .parse()
                .map_err(|_| damaged(Format::Text, format!("`{word}` is no number")))
        })
        .collect()
}

/// Arranges points, whose rows of `cols` numbers begin with `x, y, z`, as a grid with y upwards, NaN where there is none; `None`
/// if they do not lie on a grid.
fn points_on_grid(values: &[f64], cols: usize) -> Result<Option<Grid>> {
    let points: Vec<[f64; 3]> = (values.chunks_exact(cols))
        .map(|row| [row[0], row[1], row[2]])
        .collect();
    let axis = |k: usize| {
        let mut places: Vec<f64> = points.iter().map(|point| point[k]).collect();
        places.sort_by(f64::total_cmp);
        let (first, last) = (places[0], places[places.len() - 1]);
        let tolerance = 1e-9 * (last - first);
        let step = (places.windows(2))
            .map(|pair| pair[1] - pair[0])
            .filter(|step| *step > tolerance)
            .fold(f64::INFINITY, f64::min);
        let count = ((last - first) / step).round() + 1.0;
        (step.is_finite() && first.is_finite() && last.is_finite() && count <= 1e6).then_some((
            first,
            step,
            count as usize,
        ))
    };
    let (Some((left, dx, width)), Some((bottom, dy, height))) = (axis(0), axis(1)) else {
        return Ok(None);
    };
    // Scattered points would fill a small part of a fine grid.
    if width < 2 || height < 2 || width.saturating_mul(height) / 16 > points.len() {
        return Ok(None);
    }
    let mut grid = try_filled(
        "grid of points",
        checked_cells("grid of points", height, width)?,
        f64::NAN,
    )?;
    for [x, y, z] in points {
        let [col, row] = [(x - left) / dx, (y - bottom) / dy];
        if (col - col.round()).abs().max((row - row.round()).abs()) > MAX_OFF_GRID_SHARE {
            return Ok(None);
        }
        let place = &mut grid[(height - 1 - row.round() as usize) * width + col.round() as usize];
        // Two heights at one place are no grid: a matrix of three columns, perhaps.
        if !place.is_nan() {
            return Ok(None);
        }
        *place = z;
    }
    Ok(Some(Grid {
        values: grid,
        size: (width, height),
        sides: Some([dx, dy]),
        assumptions: Vec::new(),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::images::DecodeOptions;

    fn read(text: &str) -> (usize, usize, f64, Vec<f64>) {
        let file = decode(text.as_bytes())
            .and_then(|file| file.finish(&DecodeOptions::default()))
            .unwrap();
        (file.width, file.height, file.pixel_size, file.values)
    }

    #[test]
    fn an_esri_grid_without_a_size_of_cells_has_one_that_is_assumed() {
        let file = decode(b"ncols 3\nnrows 2\n100 900 500\n300 200 700\n").unwrap();
        assert_eq!(file.sides, None);
        let file = file.finish(&DecodeOptions::default()).unwrap();
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
        let error = decode(b"ncols 3\nnrows 2\n1 2 3\n4 5\n")
            .unwrap_err()
            .to_string();
        assert!(error.contains("5 values, but 2 rows of 3"), "{error}");
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
        for head in [",a,b", ",0,1"] {
            let text = format!("{head}\n0,5,6\n1,7,8\n");
            assert_eq!(read(&text).3, [5.0, 6.0, 7.0, 8.0], "{head}");
            let told = decode(text.as_bytes()).unwrap().assumptions;
            assert_eq!(told[0].code, "matrix");
        }
        assert_eq!(read("1 2;\n3 4;\n").3, [1.0, 2.0, 3.0, 4.0]);
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
