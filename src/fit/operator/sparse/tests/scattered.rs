//! Scattered points against a conic solver.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, SecondOrderConeT, SolverStatus,
};
use nalgebra::{DMatrix, DVector};
use sprs::TriMat;

use super::{
    PenaltyKind, Problem, SparseGradients, StopReason, noise, operator_of, options, solve,
};

/// Scattered points, each but those at the border with a quadratic through the eight around it.
fn scattered(side: usize) -> (sprs::CsMat<f64>, Vec<usize>, Vec<[f64; 2]>) {
    let mut noise = noise(11);
    let h = 1.0 / side as f64;
    let mut places = Vec::new();
    for i in 0..side * side {
        let at = [i % side, i / side];
        places.push(at.map(|k| h * (k as f64 + 0.25 * noise())));
    }
    let inside = 1..side - 1;
    let centres: Vec<usize> = (0..side * side)
        .filter(|i| inside.contains(&(i % side)) && inside.contains(&(i / side)))
        .collect();
    let mut triplets = TriMat::new((3 * centres.len(), places.len()));
    for (stencil, centre) in centres.iter().enumerate() {
        let around = [-1isize, 0, 1]
            .into_iter()
            .flat_map(|r| [-1, 0, 1].map(|c| centre.wrapping_add_signed(r * side as isize + c)));
        let around: Vec<usize> = around.filter(|other| other != centre).collect();
        let design = DMatrix::from_fn(8, 5, |i, k| {
            let [x, y] = [0, 1].map(|k| places[around[i]][k] - places[*centre][k]);
            [0.5 * x * x, x * y, 0.5 * y * y, x, y][k]
        });
        let fit = design.pseudo_inverse(1e-12).unwrap();
        for k in 0..3 {
            for (i, vertex) in around.iter().enumerate() {
                triplets.add_triplet(3 * stencil + k, *vertex, fit[(k, i)]);
            }
            triplets.add_triplet(3 * stencil + k, *centre, -fit.row(k).sum());
        }
    }
    (triplets.to_csr(), centres, places)
}

/// `min λ‖z − z̃‖² + Σ ω ‖H‖_*` as a second-order cone program: `t ≥ ‖H‖_*` where
/// `t ≥ |h_xx + h_yy|` and `t ≥ ‖(h_xx − h_yy, 2h_xy)‖`.
fn conic(matrix: &sprs::CsMat<f64>, target: &[f64], lambda: f64) -> (f64, Vec<f64>) {
    let (n, stencils) = (target.len(), matrix.rows() / 3);
    let quadratic =
        DMatrix::from_diagonal_element(n, n, 2.0 * lambda).resize(n + stencils, n + stencils, 0.0);
    let mut linear = DVector::zeros(n + stencils);
    let mut left = DMatrix::zeros(5 * stencils, n + stencils);
    for (i, z) in target.iter().enumerate() {
        linear[i] = -2.0 * lambda * z;
    }
    for stencil in 0..stencils {
        linear[n + stencil] = 1.0;
        left[(5 * stencil, n + stencil)] = -1.0;
        left[(5 * stencil + 2, n + stencil)] = -1.0;
    }
    for (entry, (row, vertex)) in matrix {
        let first = row / 3 * 5;
        match row % 3 {
            0 => {
                left[(first + 1, vertex)] -= entry;
                left[(first + 3, vertex)] -= entry;
            }
            1 => left[(first + 4, vertex)] -= 2.0 * entry,
            _ => {
                left[(first + 1, vertex)] -= entry;
                left[(first + 3, vertex)] += entry;
            }
        }
    }
    let rows = |m: &DMatrix<f64>| -> Vec<Vec<f64>> {
        m.row_iter()
            .map(|row| row.iter().copied().collect())
            .collect()
    };
    let cones: Vec<_> = (0..stencils)
        .flat_map(|_| [SecondOrderConeT(2), SecondOrderConeT(3)])
        .collect();
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(1e-11)
        .tol_gap_rel(1e-11)
        .tol_feas(1e-11)
        .build()
        .unwrap();
    let mut solver = DefaultSolver::new(
        &CscMatrix::from(&rows(&quadratic)),
        linear.as_slice(),
        &CscMatrix::from(&rows(&left)),
        &vec![0.0; 5 * stencils],
        &cones,
        settings,
    )
    .unwrap();
    solver.solve();
    assert_eq!(solver.solution.status, SolverStatus::Solved);
    let squares: f64 = target.iter().map(|z| z * z).sum();
    let z = solver.solution.x[..n].to_vec();
    (solver.solution.obj_val + lambda * squares, z)
}

#[test]
fn scattered_points_have_the_optimum_of_a_conic_solver() {
    let side = 10;
    let (matrix, centres, places) = scattered(side);
    let mut noise = noise(3);
    let heights = places
        .iter()
        .map(|[x, y]| 0.4 * (x - y + 0.1).abs() + 0.02 * noise());
    let target: Vec<f64> = heights.collect();
    let lambda = 3e3;
    let (optimum, z) = conic(&matrix, &target, lambda);
    let operator = operator_of(&matrix, &centres, places, 1.0 / side as f64);
    // The input is no plane: the affine functions are looked for among all of them.
    let problem = Problem::unweighted(operator, lambda, target, PenaltyKind::Nuclear);
    let (level, reason) = solve(&problem, SparseGradients::new, &options(lambda).gap(1e-7));
    assert_eq!(reason, StopReason::Gap);
    let incumbent = &level.admm.incumbent;
    let slack = 1e-9 * optimum;
    assert!(incumbent.dual_bound <= optimum + slack && optimum <= incumbent.objective() + slack);
    assert!(incumbent.objective() - incumbent.dual_bound <= 1.01e-7 * optimum);
    let distance = z
        .iter()
        .zip(&incumbent.z)
        .map(|(a, b)| (a - b).powi(2))
        .sum::<f64>();
    assert!(
        lambda * distance <= incumbent.objective() - optimum + slack,
        "{distance:e}"
    );
}
