use super::*;
use crate::fit::linear::z_step_solver::{CgCriteria, ZStepSolver};
use crate::fit::mesh::clusters::Clusters;
use crate::fit::mesh::interpolation::interpolation;
use crate::fit::operator::sparse::matrix::SparseMatrix;

/// Interpolations from two levels of clusters.
fn interpolations(finest: &Linearisation) -> Vec<Arc<SparseMatrix<f32>>> {
    let mut levels = vec![finest.clone()];
    let mut found = Vec::new();
    for _ in 0..2 {
        let fine = &levels[levels.len() - 1];
        let clusters = Clusters::new(&fine.vertices).unwrap();
        let vertices = clusters.coarsen(&fine.vertices);
        let coarse = Linearisation::new(vertices, huber_penalty(), 1e4, None).unwrap();
        found.push(Arc::new(interpolation(&coarse, &clusters, fine, None)));
        levels.push(coarse);
    }
    found
}

/// Number of V-cycles until the solution is within a thousandth of that of conjugate gradients in double precision.
fn iterations(linear: &Linearisation) -> usize {
    let problem = &linear.problem;
    // A screening length of 4 spacings, at which the condition number is about 4,000.
    let rho = 2.0 * problem.lambda * (4.0 * linear.spacing).powi(4);
    let interpolations = interpolations(linear);
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
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    solver.restart(&problem.operator);
    for done in 1..100 {
        assert!(solver.step(&problem.operator));
        let mut found = vec![0.0; exact.len()];
        solver.correct(&problem.operator, &mut found);
        // The V-cycle's matrix is at least that of the z-step, so that it never goes too far.
        let share = dot(&right, &found) / dot(&right, &exact);
        assert!(share > 0.0 && share < 1.0 + 1e-5, "{share}");
        let error: Vec<f64> = found.iter().zip(&exact).map(|(a, b)| a - b).collect();
        if dot(&error, &error) < 1e-6 * dot(&exact, &exact) {
            return done;
        }
    }
    panic!("no solution after 100 iterations");
}

#[test]
fn v_cycles_take_as_few_iterations_on_fine_meshes_as_on_coarse_ones() {
    let [coarse, fine] = [40, 120].map(|cols| iterations(&linearise(&pipe(cols, 0.2, 1.0))));
    assert!(coarse <= 50 && 4 * fine <= 5 * coarse, "{coarse}, {fine}");
}
