use super::*;
use crate::fit::linear::z_step_solver::{CgCriteria, ZStepSolver};
use crate::fit::mesh::clusters::Clusters;
use crate::fit::mesh::interpolation::interpolation;
use crate::fit::mesh::smooth_regions::SmoothRegions;
use crate::fit::operator::sparse::matrix::SparseMatrix;

/// Screening length of the z-step's matrix, in spacings: at 4, its condition number is about 4,000.
const SCREENING_LENGTH_CELLS: f64 = 4.0;

/// Interpolations from two levels of clusters.
fn interpolations(
    finest: &Linearisation,
    sides: Option<&SmoothRegions>,
) -> Vec<Arc<SparseMatrix<f32>>> {
    let mut levels = vec![finest.clone()];
    let mut found = Vec::new();
    for _ in 0..2 {
        let fine = &levels[levels.len() - 1];
        let clusters = Clusters::new(&fine.vertices).unwrap();
        let vertices = clusters.coarsen(&fine.vertices);
        let coarse = Linearisation::new(vertices, HUBER_PENALTY, |_| 1e4, sides).unwrap();
        found.push(Arc::new(interpolation(&coarse, &clusters, fine, sides)));
        levels.push(coarse);
    }
    found
}

/// Number of conjugate-gradient iterations with V-cycles until the solution is within a thousandth of that of
/// conjugate gradients in double precision without V-cycles.
fn iterations(linear: &Linearisation, sides: Option<&SmoothRegions>) -> usize {
    let problem = &linear.problem;
    let rho = 2.0 * problem.lambda * (SCREENING_LENGTH_CELLS * linear.spacing).powi(4);
    let interpolations = interpolations(linear, sides);
    let mut solver = SparseGradients::with_v_cycle(problem, rho, &interpolations).unwrap();
    let mut random = random(5);
    let mut right: Vec<f64> = problem.target.iter().map(|_| random() - 0.5).collect();
    right[linear.vertices.len()] = 0.0;
    let scale = solver.residual_scale();
    for (to, from) in solver.residual().iter_mut().zip(&right) {
        *to = (scale * from) as f32;
    }
    let mut exact = vec![0.0; right.len()];
    let criteria = CgCriteria {
        tolerance: 1e-8,
        max_iterations: 1000,
    };
    let mut jacobi = SparseGradients::new(problem, rho).unwrap();
    let residual = &mut right.clone();
    jacobi
        .solve_precisely(problem, residual, &mut exact, criteria)
        .unwrap();
    let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    solver.restart(&problem.operator);
    for done in 1..100 {
        assert!(solver.step(&problem.operator));
        let mut error = exact.iter().map(|x| -x).collect::<Vec<f64>>();
        solver.correct(&problem.operator, &mut error);
        if norm(&error) < 1e-3 * norm(&exact) {
            return done;
        }
    }
    panic!("no solution after 100 iterations");
}

#[test]
fn v_cycles_take_as_few_iterations_on_fine_meshes_as_on_coarse_ones() {
    for cols in [40, 120] {
        let taken = iterations(&linearise(&pipe(cols, 0.2, 1.0)), None);
        assert!(taken <= 8, "{taken} at {cols}");
    }
}

#[test]
fn v_cycles_solve_across_the_creases_of_a_cube() {
    let cube = cube(24);
    let x: Vec<Point> = points(&cube).iter().map(|x| 0.25 * x).collect();
    let cube = with_positions(&cube, &x);
    let given = given(&cube);
    let sides = SmoothRegions::new(&given.topology, &x).unwrap();
    let up = normals(&given.topology, &x, None);
    let frames = up.into_iter().map(|n| Frame::from_normal(n, Point::x()));
    let vertices = LevelVertices::from_mesh(&given, x, frames.collect(), Some(&sides));
    let linear = Linearisation::new(vertices, HUBER_PENALTY, |_| 1e4, Some(&sides)).unwrap();
    let taken = iterations(&linear, Some(&sides));
    assert!(taken <= 12, "{taken}");
}

/// Interpolated from values that are linear in the plane, heights of a plane are these values.
#[test]
fn interpolation_on_a_plane_reproduces_linear_functions() {
    let plane = indexed(&grid(30, 30, |u, v| {
        [
            u + 0.01 * (40.0 * v).sin(),
            v + 0.01 * (30.0 * u).sin(),
            0.0,
        ]
    }));
    let fine = linearise(&plane);
    let clusters = Clusters::new(&fine.vertices).unwrap();
    let vertices = clusters.coarsen(&fine.vertices);
    let coarse = Linearisation::new(vertices, HUBER_PENALTY, |_| 1e4, None).unwrap();
    let matrix = interpolation(&coarse, &clusters, &fine, None);
    let height = |x: &Point| 0.3 + 0.7 * x.x - 0.4 * x.y;
    for (vertex, x) in fine.vertices.base.iter().enumerate() {
        let terms = matrix.row(vertex).iter().map(|(cluster, factor)| {
            let cluster = *cluster as usize;
            f64::from(*factor) * height(&coarse.vertices.base[cluster]) / coarse.scales[cluster]
        });
        let found = fine.scales[vertex] * terms.sum::<f64>();
        assert!(
            (found - height(x)).abs() < 2e-3,
            "{found} for {}",
            height(x)
        );
    }
}
