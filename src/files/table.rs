//! Tables of numbers in text: lines of equally many numbers, which are matrices or points.

use super::failure::damaged;
use super::text::{decoded, number};
use crate::error::{Result, checked_cells, try_filled};

/// Maximum distance of a point from its place on the grid, as a share of the grid's spacing.
const MAX_OFF_GRID_SHARE: f64 = 0.02;

/// Minimum number of lines of a cloud of points, in numbers of a line: fewer are a small matrix.
pub(super) const MIN_CLOUD_LINES_PER_COLUMN: usize = 10;

/// Maximum number of numbers of a point in the formats of scanners: a place, a colour with its opacity, and a normal.
pub(super) const MAX_POINT_NUMBERS: usize = 10;

/// Lines of equally many numbers; NaN where a cell is empty.
#[cfg_attr(not(feature = "images"), allow(dead_code))]
pub(super) struct Table {
    /// The numbers, line by line.
    pub(super) values: Vec<f64>,
    pub(super) cols: usize,
    pub(super) rows: usize,
    /// Whether a first line and a first column numbered the others. They are left out.
    pub(super) is_numbered: bool,
}

/// Heights of points on a grid from the highest y downwards, NaN where there is none.
#[cfg_attr(not(feature = "images"), allow(dead_code))]
pub(super) struct PointGrid {
    pub(super) values: Vec<f64>,
    /// Columns and rows.
    pub(super) size: (usize, usize),
    /// Distances of columns and of rows.
    pub(super) sides: [f64; 2],
    /// Smallest x and y.
    pub(super) corner: [f64; 2],
}

impl Table {
    /// Reads a table. Lines before the first number are names of columns or comments.
    pub(super) fn read(text: &str) -> Result<Table> {
        // Some programs quote their cells, or divide them by two letters.
        let text = &text.replace('"', "").replace(",\t", ",");
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
        let mut starts = text.lines().map(|line| line.starts_with(CELL_DIVIDERS));
        let mut is_numbered = starts.next() == Some(true) && starts.next() == Some(false);
        let mut names = 0;
        let mut values: Vec<f64> = Vec::new();
        let (mut cols, mut rows) = (0, 0);
        for (k, line) in text.lines().enumerate().skip(usize::from(is_numbered)) {
            let line = line.trim_end_matches([' ', '\r']);
            let mut row = match cells(line, is_divided) {
                _ if line.starts_with('#') && rows > 0 => continue,
                Ok(row) if rows > 0 || !row.iter().all(|value| value.is_nan()) => row,
                Err(_) if rows > 0 => {
                    return Err(damaged(format!("line {} is no row of numbers", k + 1)));
                }
                _ => {
                    let words = line.split(|letter: char| {
                        letter.is_whitespace() || CELL_DIVIDERS.contains(&letter)
                    });
                    names = words.filter(|word| !word.is_empty()).count();
                    continue;
                }
            };
            // Scanners begin with a line that counts the points.
            if cols == 1 && rows == 1 && row.len() > 1 {
                (rows, values) = (0, Vec::new());
            }
            row.drain(..usize::from(is_numbered).min(row.len()));
            if row.is_empty() {
                continue;
            }
            if row.len() + 1 == cols && line.ends_with(CELL_DIVIDERS) {
                row.push(f64::NAN);
            }
            if rows > 0 && row.len() != cols {
                let reason = format!(
                    "line {} has {} numbers, where the lines before have {cols}",
                    k + 1,
                    row.len()
                );
                return Err(damaged(reason));
            }
            cols = row.len();
            rows += 1;
            values.extend(row);
        }
        checked_cells("matrix", rows, cols)?;
        if rows == 0 {
            return Err(damaged("it has no numbers"));
        }
        // R names all columns but the first, which numbers the rows.
        let numbers = values.iter().step_by(cols);
        if names + 1 == cols
            && (1..)
                .zip(numbers)
                .all(|(k, number)| *number == f64::from(k))
        {
            is_numbered = true;
            let rows = values.chunks_exact(cols);
            values = rows.flat_map(|row| &row[1..]).copied().collect();
            cols -= 1;
        }
        Ok(Table {
            values,
            cols,
            rows,
            is_numbered,
        })
    }

    /// Whether lines may be points: x, y, z and perhaps more.
    pub(super) fn may_be_points(&self) -> bool {
        (3..=MAX_POINT_NUMBERS).contains(&self.cols) && self.rows > self.cols
    }

    /// Whether a file is a cloud of points, which lie on no grid. Costs `O(bytes)`.
    pub(super) fn is_cloud(bytes: &[u8]) -> bool {
        Table::read(&decoded(bytes)).is_ok_and(|table| {
            table.may_be_points()
                && table.rows >= MIN_CLOUD_LINES_PER_COLUMN * table.cols
                && matches!(table.points_on_grid(), Ok(None))
        })
    }

    /// Arranges points, whose lines begin with x, y, z, as a grid; `None` if they do not lie on one.
    pub(super) fn points_on_grid(&self) -> Result<Option<PointGrid>> {
        if !self.may_be_points() {
            return Ok(None);
        }
        let points: Vec<[f64; 3]> = (self.values.chunks_exact(self.cols))
            .map(|row| [row[0], row[1], row[2]])
            .collect();
        let axis =
            |k: usize| {
                let mut places: Vec<f64> = points.iter().map(|point| point[k]).collect();
                places.sort_by(f64::total_cmp);
                let (first, last) = (places[0], places[places.len() - 1]);
                let tolerance = 1e-9 * (last - first);
                let steps = places.windows(2).map(|pair| pair[1] - pair[0]);
                let steps: Vec<f64> = steps.filter(|step| *step > tolerance).collect();
                let least = steps.iter().copied().fold(f64::INFINITY, f64::min);
                // Rounded coordinates have steps that differ, of which the mean is right; longer ones lead over gaps.
                let (count, sum) = (steps.iter().filter(|step| **step < 1.5 * least))
                    .fold((0.0, 0.0), |(count, sum), step| (count + 1.0, sum + step));
                let step = sum / count;
                let count = ((last - first) / step).round() + 1.0;
                (step.is_finite() && first.is_finite() && last.is_finite() && count <= 1e6)
                    .then_some((first, step, count as usize))
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
            let place =
                &mut grid[(height - 1 - row.round() as usize) * width + col.round() as usize];
            // Two heights at one place are no grid: a matrix of three columns, perhaps.
            if !place.is_nan() {
                return Ok(None);
            }
            *place = z;
        }
        Ok(Some(PointGrid {
            values: grid,
            size: (width, height),
            sides: [dx, dy],
            corner: [left, bottom],
        }))
    }
}

/// Letters that divide the cells of a table, any of which may be empty.
const CELL_DIVIDERS: [char; 3] = [';', '\t', ','];

/// Numbers of a row of a table, NaN for those that are missing; what divides them may also end it.
fn cells(line: &str, decimal_commas: bool) -> Result<Vec<f64>> {
    let divides = |letter: &char| line.contains(*letter) && !(*letter == ',' && decimal_commas);
    let Some(divider) = CELL_DIVIDERS.into_iter().find(divides) else {
        return numbers(line, decimal_commas);
    };
    let line = line.strip_suffix(divider).unwrap_or(line);
    let cell = |cell: &str| match numbers(cell, decimal_commas)?[..] {
        [] => Ok(f64::NAN),
        [number] => Ok(number),
        _ => Err(damaged(format!("`{cell}` is no number"))),
    };
    let row: Result<_> = line.split(divider).map(cell).collect();
    row.or_else(|_| numbers(line, decimal_commas))
}

/// Numbers of a text, between blanks and semicolons and, unless commas are decimal, commas.
pub(super) fn numbers(text: &str, decimal_commas: bool) -> Result<Vec<f64>> {
    let divides =
        |letter: char| letter.is_whitespace() || letter == ';' || letter == ',' && !decimal_commas;
    let point = if decimal_commas { ',' } else { '.' };
    let parsed = |word: &str| {
        let number = number(&word.replace(point, "."));
        number.ok_or_else(|| damaged(format!("`{word}` is no number")))
    };
    let words = text.split(divides).filter(|word| !word.is_empty());
    words.map(parsed).collect()
}
