//! Robust fit of a sheet in space to a photo of a page.

use nalgebra::Vector3;

use super::grid::SheetGrid;
use super::problem::{ResidualRow, SheetProblem};
use crate::math::bordered::BorderedSystem;
use crate::page::robust_fit;

/// Number of unknowns besides the sheet's nodes and lines: focal length, two coordinates of the principal point, ratio
/// of the page's sides.
const CAMERA_UNKNOWNS: usize = 4;

/// Relative change of the cost by one step below which the fit of a sheet has converged.
/// Its row: `benches/page.md`, Constants of the outline.
const COST_TOLERANCE: f64 = 0.01;

/// A sheet in space that was fitted to a photo of a page, with the position on the page (share of its height or width)
/// of each line of print and, after these, of each fold.
#[derive(Debug, Clone)]
pub(super) struct FittedSheet {
    pub grid: SheetGrid,
    pub levels: Vec<f64>,
    /// Sum of the robust penalties of the fit's weighted residuals.
    pub cost: f64,
}

impl FittedSheet {
    /// Makes a sheet of a grid in space, without lines of print.
    pub fn new(grid: SheetGrid) -> Self {
        FittedSheet {
            grid,
            levels: Vec::new(),
            cost: 0.0,
        }
    }
}

impl SheetProblem {
    /// Finds the sheet that fits the photo best, from an initial guess. None if that is not in front of the camera.
    pub fn solve(&self, start: FittedSheet) -> Option<FittedSheet> {
        self.solve_to(start, COST_TOLERANCE)
    }

    /// Finds that sheet until a step lowers the cost by no more than the share `tolerance`.
    pub(super) fn solve_to(&self, start: FittedSheet, tolerance: f64) -> Option<FittedSheet> {
        robust_fit::fit(
            self.with_cost(start)?,
            |sheet| self.system(sheet),
            |sheet, system: &BorderedSystem, damping| {
                let (banded, bordered) = system.solve(damping)?;
                self.with_cost(moved(sheet, &banded, &bordered))
            },
            |sheet| sheet.cost,
            tolerance,
        )
    }

    /// Returns a sheet with its cost: the sum of the robust penalties of its weighted residuals. None if the sheet is not in
    /// front of the camera.
    pub fn with_cost(&self, sheet: FittedSheet) -> Option<FittedSheet> {
        let mut cost = 0.0;
        self.visit(&sheet.grid, &sheet.levels, &mut |row| cost += row.penalty())?;
        cost.is_finite().then_some(FittedSheet { cost, ..sheet })
    }

    /// The normal equations of a sheet's robust least-squares problem; None if the sheet is not in front of the camera.
    fn system(&self, sheet: &FittedSheet) -> Option<BorderedSystem> {
        let grid = &sheet.grid;
        let half_width = 3 * 2 * grid.cols + 2;
        let border = CAMERA_UNKNOWNS + sheet.levels.len();
        let mut system = BorderedSystem::new(3 * grid.nodes.len(), half_width, border);
        let (mut banded, mut bordered) = (Vec::new(), Vec::new());
        self.visit(grid, &sheet.levels, &mut |row| {
            unknowns(row, &mut banded, &mut bordered);
            system.add(&banded, &bordered, row.value);
        })?;
        Some(system)
    }
}

/// Lists the non-zero derivatives of a residual as pairs of an unknown's number and the derivative by it: by nodes into
/// `banded`, by camera, ratio and levels into `bordered`.
fn unknowns(row: &ResidualRow, banded: &mut Vec<(usize, f64)>, bordered: &mut Vec<(usize, f64)>) {
    banded.clear();
    bordered.clear();
    for (node, gradient) in &row.nodes {
        for k in 0..3 {
            if gradient[k] != 0.0 {
                banded.push((3 * node + k, gradient[k]));
            }
        }
    }
    for (k, derivative) in row.globals.iter().enumerate() {
        if *derivative != 0.0 {
            bordered.push((k, *derivative));
        }
    }
    if let Some((line, derivative)) = row.level {
        bordered.push((CAMERA_UNKNOWNS + line, derivative));
    }
}

/// Returns a sheet changed by a step of its unknowns: `banded` moves the nodes, `bordered` changes camera, ratio of
/// sides and levels of lines.
fn moved(sheet: &FittedSheet, banded: &[f64], bordered: &[f64]) -> FittedSheet {
    let mut moved = sheet.clone();
    for (node, step) in moved.grid.nodes.iter_mut().zip(banded.as_chunks::<3>().0) {
        *node += Vector3::from(*step);
    }
    let camera = &mut moved.grid.camera;
    camera.log_scale += bordered[0];
    camera.centre[0] += bordered[1];
    camera.centre[1] += bordered[2];
    moved.grid.log_ratio += bordered[3];
    for (level, step) in moved.levels.iter_mut().zip(&bordered[CAMERA_UNKNOWNS..]) {
        *level = (*level + step).clamp(0.0, 1.0);
    }
    moved
}
