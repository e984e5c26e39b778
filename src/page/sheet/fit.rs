//! Levenberg–Marquardt method for fitting a sheet in space to a photo of a page.

use nalgebra::Vector3;

use super::bordered::BorderedSystem;
use super::grid::SheetGrid;
use super::problem::{ResidualRow, RobustWeights, SheetProblem};

/// Initial damping of the Levenberg–Marquardt method, relative to the normal matrix's diagonal.
const INITIAL_DAMPING: f64 = 1e-3;

/// Minimum damping of the Levenberg–Marquardt method, relative to the normal matrix's diagonal.
const MIN_DAMPING: f64 = 1e-9;

/// Damping of the Levenberg–Marquardt method at which the search for a step that lowers the cost ends.
const MAX_DAMPING: f64 = 1e8;

/// Factor that multiplies the Levenberg–Marquardt damping after a step that lowers the cost.
const DAMPING_DECREASE: f64 = 0.1;

/// Factor that multiplies the Levenberg–Marquardt damping after a step that does not lower the cost.
const DAMPING_INCREASE: f64 = 5.0;

/// Number of unknowns besides the sheet's nodes and lines: focal length, two coordinates of the principal point, ratio
/// of the page's sides.
const CAMERA_UNKNOWNS: usize = 4;

/// A sheet in space that was fitted to a photo of a page, with the position on the page (share of its height or width)
/// of each line of print and, after these, of each fold.
#[derive(Debug, Clone)]
pub(super) struct FittedSheet {
    pub grid: SheetGrid,
    pub levels: Vec<f64>,
    /// Sum of squares of the fit's weighted residuals.
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
    /// Finds the sheet that fits the photo best in the least-squares sense, from an initial guess: by at most `steps`
    /// steps, until one lowers the cost by less than the share `tolerance`. None if the initial sheet is not in front
    /// of the camera.
    pub fn solve(&self, start: FittedSheet, steps: usize, tolerance: f64) -> Option<FittedSheet> {
        let mut best = start;
        let mut damping = INITIAL_DAMPING;
        for _ in 0..steps {
            let mut robust = RobustWeights::default();
            let (system, cost) = self.system(&best, &mut robust)?;
            best.cost = cost;
            let mut better = None;
            while damping < MAX_DAMPING {
                let moved = (system.solve(damping)).map(|step| moved(&best, &step.0, &step.1));
                if let Some(mut moved) = moved {
                    moved.cost = self.cost(&moved, &mut robust).unwrap_or(f64::INFINITY);
                    if moved.cost < cost {
                        better = Some(moved);
                        damping = (damping * DAMPING_DECREASE).max(MIN_DAMPING);
                        break;
                    }
                }
                damping *= DAMPING_INCREASE;
            }
            let Some(moved) = better else { break };
            let gain = cost - moved.cost;
            best = moved;
            if gain < tolerance * cost {
                break;
            }
        }
        Some(best)
    }

    /// Sum of squares of a sheet's weighted residuals, with the robust weights held as they are. None if the sheet is
    /// not in front of the camera.
    fn cost(&self, sheet: &FittedSheet, robust: &mut RobustWeights) -> Option<f64> {
        robust.hold();
        let mut cost = 0.0;
        self.visit(&sheet.grid, &sheet.levels, robust, &mut |row| {
            cost += row.value * row.value;
        })?;
        cost.is_finite().then_some(cost)
    }

    /// Builds the normal equations of the least-squares problem at a sheet; returns them with the sheet's cost. None if
    /// the sheet is not in front of the camera.
    fn system(
        &self,
        sheet: &FittedSheet,
        robust: &mut RobustWeights,
    ) -> Option<(BorderedSystem, f64)> {
        let grid = &sheet.grid;
        let half_width = 3 * 2 * grid.cols + 2;
        let border = CAMERA_UNKNOWNS + sheet.levels.len();
        let mut system = BorderedSystem::new(3 * grid.nodes.len(), half_width, border);
        let mut cost = 0.0;
        let (mut banded, mut bordered) = (Vec::new(), Vec::new());
        self.visit(grid, &sheet.levels, robust, &mut |row| {
            cost += row.value * row.value;
            unknowns(row, &mut banded, &mut bordered);
            system.add(&banded, &bordered, row.value);
        })?;
        Some((system, cost))
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
