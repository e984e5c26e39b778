//! Tests of the residuals of folds in the fit of a sheet: free bending and the prior of a fold's position.

use nalgebra::Vector3;

use super::camera::SheetCamera;
use super::fit::FittedSheet;
use super::grid::{SheetGrid, node_shares};
use super::plane::CameraPrior;
use super::polyline::Polyline;
use super::problem::{LevelLine, ResidualRow, SheetProblem};
use super::search::FIRM_PAPER_WEIGHTS;

const PAGE_RATIO: f64 = 1.4;

/// Numbers of columns and rows of the grid: row 6 is in the middle.
const GRID_SIZE: [usize; 2] = [9, 13];

/// A sheet at a distance of three widths, bent by `shape`, which maps a place on the flat page (from its middle, in widths
/// of the page) to space.
fn sheet(shape: impl Fn([f64; 2]) -> Vector3<f64>) -> SheetGrid {
    let [cols, rows] = GRID_SIZE;
    let nodes = node_shares(GRID_SIZE)
        .map(|[x, y]| shape([x - 0.5, PAGE_RATIO * (y - 0.5)]) + Vector3::new(0.0, 0.0, 3.0))
        .collect();
    SheetGrid {
        cols,
        rows,
        log_ratio: PAGE_RATIO.ln(),
        camera: SheetCamera {
            log_scale: 0.0,
            centre: [0.0; 2],
        },
        nodes,
    }
}

fn plane([x, y]: [f64; 2]) -> Vector3<f64> {
    Vector3::new(x, y, 0.0)
}

/// The page folded across at `crease` (from its middle), with the lower panel tilted by 0.5 radians.
fn folded([x, y]: [f64; 2], crease: f64) -> Vector3<f64> {
    let down = (y - crease).max(0.0);
    let upper = y.min(crease);
    Vector3::new(x, upper + down * 0.5_f64.cos(), down * 0.5_f64.sin())
}

fn seen(grid: &SheetGrid, share: [f64; 2]) -> [f64; 2] {
    grid.seen(&grid.place(share)).unwrap()
}

/// The line across a sheet at the share `at` of its height as the photo shows it, expected at the share `level`.
fn line(grid: &SheetGrid, at: f64, level: f64, level_deviation: Option<f64>) -> LevelLine {
    LevelLine {
        points: (0..20)
            .map(|i| seen(grid, [(i as f64 + 0.5) / 20.0, at]))
            .collect(),
        level,
        level_deviation,
        length: 1.0,
    }
}

/// The problem of finding a sheet whose outline the photo shows, with the given lines of print and folds.
fn problem(grid: &SheetGrid, lines: Vec<LevelLine>, folds: Vec<LevelLine>) -> SheetProblem {
    let edge = |at: fn(f64) -> [f64; 2]| {
        Polyline::new((0..=40).map(|i| seen(grid, at(i as f64 / 40.0))).collect())
    };
    SheetProblem {
        edges: [
            edge(|t| [t, 0.0]),
            edge(|t| [t, 1.0]),
            edge(|t| [0.0, t]),
            edge(|t| [1.0, t]),
        ],
        lines,
        traced: 0,
        folds,
        prior: CameraPrior {
            scale_deviation: 0.01,
            centre_deviation: 0.01,
            log_ratio: None,
        },
        ratio: [PAGE_RATIO.ln(), 0.002],
        depth: 3.0,
        weights: FIRM_PAPER_WEIGHTS,
    }
}

/// Sum of squares of the bending residuals of a sheet with folds at some shares of its height.
fn bending(grid: &SheetGrid, folds: &[f64]) -> f64 {
    let folds = folds.iter().map(|level| line(grid, *level, *level, None));
    let problem = problem(grid, Vec::new(), folds.collect());
    let mut sum = 0.0;
    problem.visit_bending(grid, &mut |row| {
        sum += row.value * row.value;
    });
    sum
}

#[test]
fn bending_across_a_fold_is_free_and_other_bending_is_not() {
    let middle = sheet(|at| folded(at, 0.0));
    assert!(bending(&middle, &[]) > 0.1);
    assert!(bending(&middle, &[0.5]) < 1e-20);
    // The fold frees the row that is less than one row away from it, on either side, and no other row.
    assert!(bending(&middle, &[6.9 / 12.0]) < 1e-20);
    assert!(bending(&middle, &[5.1 / 12.0]) < 1e-20);
    assert_eq!(bending(&middle, &[7.1 / 12.0]), bending(&middle, &[]));
    // A crease between two rows bends at both of them.
    let between = sheet(|at| folded(at, 0.4 * PAGE_RATIO / 12.0));
    assert!(bending(&between, &[6.4 / 12.0]) < 1e-20);
    assert!(bending(&between, &[7.2 / 12.0]) > 0.01);
    // A curl across the page is not free.
    let curled = sheet(|[x, y]| Vector3::new(x.sin(), y, x.cos()));
    assert!(bending(&curled, &[]) > 0.1);
    assert_eq!(bending(&curled, &[0.5]), bending(&curled, &[]));
}

#[test]
fn residuals_of_folds_depend_on_their_own_levels() {
    let grid = sheet(plane);
    let print = line(&grid, 0.3, 0.31, None);
    let fold = line(&grid, 0.47, 0.5, Some(0.01));
    let problem = problem(&grid, vec![print], vec![fold]);
    assert_eq!(problem.expected_levels(), [0.31, 0.5]);
    let rows = |levels: [f64; 2]| {
        let mut rows: Vec<ResidualRow> = Vec::new();
        let lines = problem.lines.iter().chain(&problem.folds);
        problem
            .visit_lines(&grid, lines.zip(&levels), &mut |row| {
                rows.push(row.clone());
            })
            .unwrap();
        rows
    };
    let levels = [0.31, 0.48];
    let found = rows(levels);
    let prior: Vec<_> = (found.iter())
        .filter(|row| row.nodes[0].1.norm() == 0.0)
        .collect();
    assert_eq!(prior.len(), 1);
    assert!((prior[0].value - (0.48 - 0.5) / 0.01).abs() < 1e-9);
    assert_eq!(prior[0].level, Some((1, 100.0)));
    for number in 0..2 {
        let mut moved = levels;
        moved[number] += 1e-7;
        let mut count = 0;
        for (one, other) in found.iter().zip(rows(moved)) {
            let slope = (other.value / other.trust - one.value / one.trust) / 1e-7;
            let (own, derivative) = one.level.unwrap();
            let derivative = derivative / one.trust;
            count += usize::from(own == number);
            let expected = if own == number { derivative } else { 0.0 };
            assert!(
                (slope - expected).abs() < 1e-4 * expected.abs() + 1e-6,
                "{slope} {expected}"
            );
        }
        assert_eq!(count, 20 + number);
    }
}

#[test]
fn a_fold_that_halves_the_page_is_moved_to_the_middle_as_far_as_its_deviation_says() {
    // The photo shows the fold at 0.47 of the height where the outline says so.
    let grid = sheet(|at| folded(at, -0.03 * PAGE_RATIO));
    let level = |deviation: Option<f64>| {
        let fold = line(&grid, 0.47, 0.5, deviation);
        let problem = problem(&grid, Vec::new(), vec![fold]);
        let start = FittedSheet {
            levels: problem.expected_levels(),
            ..FittedSheet::new(grid.clone())
        };
        let start = problem.with_cost(start).unwrap();
        problem.solve_to(start, 1e-6).unwrap().levels[0]
    };
    let [free, loose, tight] = [None, Some(1.0), Some(1e-4)].map(level);
    assert!((free - 0.47).abs() < 0.005, "{free}");
    assert!((loose - free).abs() < 0.001, "{loose} {free}");
    assert!((tight - 0.5).abs() < 0.002, "{tight}");
}
