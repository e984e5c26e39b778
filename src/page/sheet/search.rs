//! The sheet of an outline and the lines in its photo: from a coarse grid to a fine one, then with lines.

use super::fit::FittedSheet;
use super::level_lines::find_level_lines;
use super::place_table::PlaceTable;
use super::plane::{CameraPrior, Homography, grid_rows};
use super::polyline::Polyline;
use super::problem::{SheetProblem, SheetWeights};
use super::view::PhotoView;
use crate::dewarp::Photo;

pub(super) fn knob(name: &str, default: f64) -> f64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default)
}

/// Fits a sheet.
pub(super) fn search(
    edges: &[Polyline; 4],
    prior: CameraPrior,
    view: &PhotoView,
    photo: &Photo<'_>,
    soft: bool,
) -> Option<(FittedSheet, SheetProblem)> {
    let [top, bottom] = [0, 1].map(|k| edges[k].points());
    let corners = [top[0], top[top.len() - 1], bottom[bottom.len() - 1], bottom[0]];
    let side = |i: usize, j: usize| {
        (corners[i][0] - corners[j][0]).hypot(corners[i][1] - corners[j][1])
    };
    let apparent = (side(0, 3) + side(1, 2)) / (side(0, 1) + side(2, 3));
    let ratio = prior.ratio(apparent);
    let homography = Homography::new(corners)?;
    let sizes = [9, 13, knob("FINE", 25.0) as usize];
    let grid = homography.sheet(sizes[0], &prior, apparent)?;
    let depth = grid.nodes.iter().map(|p| p.z).sum::<f64>() / grid.nodes.len() as f64;
    let weights = SheetWeights {
        isometry: if soft { knob("ISOS", 40.0) } else { knob("ISO", 300.0) },
        bending: if soft { knob("BENDS", 3.5) } else { knob("BEND", 1.5) },
        outline: knob("OUT", 350.0),
        corners: knob("COR", 300.0),
        lines: knob("TEXT", 400.0),
    };
    let mut problem = SheetProblem {
        edges: edges.clone(),
        lines: Vec::new(),
        prior,
        ratio,
        depth,
        weights: SheetWeights {
            isometry: 0.25 * weights.isometry,
            bending: 4.0 * weights.bending,
            ..weights
        },
    };
    let start = FittedSheet {
        grid,
        levels: Vec::new(),
        cost: 0.0,
    };
    let steps = knob("STEPS", 15.0) as usize;
    let tolerance = knob("TOL", 0.01);
    let debug = |name: &str, sheet: &FittedSheet| {
        if knob("DEBUG", 0.0) > 0.0 {
            eprintln!("{name} cost {:.3} camera {:?} ratio {:.3} lines {}", sheet.cost, sheet.grid.camera, sheet.grid.ratio(), sheet.levels.len());
        }
    };
    let mut sheet = problem.solve(start, steps, tolerance)?;
    debug("coarse", &sheet);
    problem.weights = weights;
    for size in sizes {
        let rows = grid_rows(size, sheet.grid.ratio());
        sheet.grid = sheet.grid.resampled([size, rows]);
        sheet = problem.solve(sheet, steps, tolerance)?;
        debug("level", &sheet);
    }
    for _ in 0..knob("ROUNDS", 2.0) as usize {
        let table = PlaceTable::new(&sheet.grid, view).ok()?;
        problem.lines = find_level_lines(&table, view, photo, sheet.grid.ratio());
        sheet.levels = problem.lines.iter().map(|line| line.level).collect();
        if sheet.levels.is_empty() {
            break;
        }
        sheet = problem.solve(sheet, steps, tolerance)?;
        debug("lines", &sheet);
    }
    Some((sheet, problem))
}
