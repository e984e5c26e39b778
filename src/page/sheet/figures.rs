//! Measures of a fitted sheet: distances from outline and lines in the photo.

use super::fit::FittedSheet;
use super::problem::{ResidualRow, SheetProblem, SheetWeights};

/// Misfit of a fitted sheet. Lengths are in widths of the page; outliers count less.
#[derive(Debug, Clone, Copy)]
pub(super) struct SheetFigures {
    /// Root mean square distance between the sheet's projected border and the page's outline in the photo, in widths of
    /// the page.
    pub outline: f64,
    /// Root mean square distance between lines of print in the photo and the lines on the sheet that they belong to, in
    /// widths of the page; 0 without lines.
    pub lines: f64,
}

impl SheetProblem {
    /// Computes the misfits of a sheet; None if it is not in front of the camera.
    pub fn figures(&self, sheet: &FittedSheet) -> Option<SheetFigures> {
        let grid = &sheet.grid;
        let mut unit = self.clone();
        unit.weights = SheetWeights {
            outline: 1.0,
            corners: 0.0,
            lines: 1.0,
            ..self.weights
        };
        let mut sums = [0.0; 2];
        unit.visit_outline(grid, &mut |row| sums[0] += row.value * row.value)?;
        let lines = self.lines.iter().zip(&sheet.levels);
        unit.visit_lines(grid, lines, &mut |row| {
            sums[1] += row.value * row.value;
        })?;
        let length: f64 = self.lines.iter().map(|line| line.length).sum();
        Some(SheetFigures {
            outline: (sums[0] / (2.0 + 2.0 * grid.ratio())).sqrt(),
            lines: (sums[1] / length.max(1e-9)).sqrt(),
        })
    }

    /// Returns the sheet with each line of print at the level (share of the page's height or width) to which one
    /// Gauss-Newton step moves it from its expected one, and with folds at their expected levels. None if the sheet is not in
    /// front of the camera.
    pub fn with_levels(&self, sheet: &FittedSheet) -> Option<FittedSheet> {
        let mut sheet = sheet.clone();
        sheet.levels = self.expected_levels();
        let mut sums = vec![[0.0; 2]; sheet.levels.len()];
        let mut sink = |row: &ResidualRow| {
            if let Some((line, derivative)) = row.level {
                sums[line][0] += derivative * row.value;
                sums[line][1] += derivative * derivative;
            }
        };
        self.visit_lines(&sheet.grid, self.lines.iter().zip(&sheet.levels), &mut sink)?;
        for (level, [right, square]) in sheet.levels.iter_mut().zip(sums) {
            *level = (*level - right / square.max(1e-300)).clamp(0.0, 1.0);
        }
        Some(sheet)
    }
}
