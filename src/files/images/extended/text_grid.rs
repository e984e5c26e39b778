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
