//! Figures of a fitted sheet: how well it meets outline and lines, how much it is strained and bent.

use super::fit::FittedSheet;
use super::problem::{ResidualRow, RobustWeights, SheetProblem, SheetWeights};

/// Misfits and shape of a sheet, in widths of the page. Outliers count less.
#[derive(Debug, Clone, Copy)]
pub(super) struct SheetFigures {
    /// Root mean square distance of the border from the outline.
    pub outline: f64,
    /// Root mean square distance of the lines from level ones; 0 without lines.
    pub lines: f64,
    /// Root mean square relative change of length.
    pub strain: f64,
    /// Root mean square curvature.
    pub curvature: f64,
}

/// Number of rounds of refining the lines' levels on a given sheet.
const LEVEL_ROUNDS: usize = 3;

impl SheetProblem {
    /// Figures of a sheet; None if it is not in front of the camera.
    pub fn figures(&self, sheet: &FittedSheet) -> Option<SheetFigures> {
        let grid = &sheet.grid;
        let mut unit = self.clone();
        unit.weights = SheetWeights {
            isometry: 1.0,
            bending: 1.0,
            outline: 1.0,
            corners: 0.0,
            lines: 1.0,
        };
        let robust = RobustWeights::default;
        let mut sums = [0.0; 4];
        let mut rows = 0.0;
        unit.visit_outline(grid, &mut robust(), &mut |row| {
            sums[0] += row.value * row.value
        })?;
        unit.visit_lines(grid, &sheet.levels, &mut robust(), &mut |row| {
            sums[1] += row.value * row.value;
        })?;
        unit.visit_isometry(grid, &mut |row| {
            sums[2] += row.value * row.value;
            rows += 1.0;
        });
        unit.visit_bending(grid, &mut robust(), &mut |row| {
            sums[3] += row.value * row.value
        });
        let [across, down] = grid.steps();
        let length: f64 = self.lines.iter().map(|line| line.length).sum();
        Some(SheetFigures {
            outline: (sums[0] / (2.0 + 2.0 * grid.ratio())).sqrt(),
            lines: (sums[1] / length.max(1e-9)).sqrt(),
            strain: (sums[2] / (rows * across * down)).sqrt(),
            curvature: (sums[3] / grid.ratio()).sqrt(),
        })
    }

    /// A sheet with its lines' levels where they are nearest to the lines.
    pub fn with_levels(&self, sheet: &FittedSheet) -> Option<FittedSheet> {
        let mut sheet = sheet.clone();
        sheet.levels = self.lines.iter().map(|line| line.level).collect();
        for _ in 0..LEVEL_ROUNDS {
            let mut sums = vec![[0.0; 2]; sheet.levels.len()];
            let mut sink = |row: &ResidualRow| {
                if let Some((line, derivative)) = row.level {
                    sums[line][0] += derivative * row.value;
                    sums[line][1] += derivative * derivative;
                }
            };
            self.visit_lines(
                &sheet.grid,
                &sheet.levels,
                &mut RobustWeights::default(),
                &mut sink,
            )?;
            for (level, [right, square]) in sheet.levels.iter_mut().zip(sums) {
                *level = (*level - right / square.max(1e-300)).clamp(0.0, 1.0);
            }
        }
        Some(sheet)
    }
}
