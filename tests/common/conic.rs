//! An independent optimum: the energy as a second-order cone program, solved by
//! Clarabel. Nothing here calls the library's own stencils or domains.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT,
    SolverStatus, SupportedConeT,
};
use developable::Heightfield;
use nalgebra::{SMatrix, SVector};

pub struct Optimum {
    pub objective: f64,
    /// Heights in the order of the lattice; NaN outside `I ∪ ∂I`.
    pub heights: Vec<f64>,
}

/// Rows `h_xx, h_xy, h_yy` of the best-fit Hessian at a vertex as combinations
/// of the vertex and its six neighbours, from their positions alone.
fn stencil(positions: [[f64; 2]; 7]) -> SMatrix<f64, 3, 7> {
    let [x0, y0] = positions[0];
    let mut design = SMatrix::<f64, 7, 6>::zeros();
    for (i, [x, y]) in positions.into_iter().enumerate() {
        let (x, y) = (x - x0, y - y0);
        let row = [0.5 * x * x, x * y, 0.5 * y * y, x, y, 1.0];
        design.set_row(i, &SVector::<f64, 6>::from(row).transpose());
    }
    // Scaled to a unit stencil first, so that the normal equations are well conditioned.
    let h = (positions[1][0] - x0).hypot(positions[1][1] - y0);
    let scale = SVector::<f64, 6>::from([h * h, h * h, h * h, h, h, 1.0]);
    for (mut column, s) in design.column_iter_mut().zip(scale.iter()) {
        column /= *s;
    }
    let fit = (design.transpose() * design).try_inverse().unwrap() * design.transpose();
    fit.fixed_rows::<3>(0) / (h * h)
}

/// Minimises `λ Σ (z − z̃)² + Σ ‖H‖_*` with `‖H‖_* = max(|h_xx + h_yy|, ‖(h_xx − h_yy, 2h_xy)‖)`,
/// in the field's own coordinates.
pub fn optimum(field: &Heightfield, lambda: f64) -> Optimum {
    let lattice = field.lattice();
    let valid = |(r, c): (usize, usize)| !field.height(r, c).is_nan();
    let interior: Vec<[(usize, usize); 7]> = (0..lattice.rows())
        .flat_map(|r| (0..lattice.cols()).map(move |c| (r, c)))
        .filter(|v| valid(*v))
        .filter_map(|v| {
            let ring = lattice.neighbours(v.0, v.1);
            let mut all = [v; 7];
            for (slot, n) in all[1..].iter_mut().zip(ring) {
                *slot = n.filter(|n| valid(*n))?;
            }
            Some(all)
        })
        .collect();

    // Unknowns: the heights touched by a stencil, then one bound s for each stencil.
    let mut column = vec![usize::MAX; lattice.len()];
    let mut active = Vec::new();
    for (r, c) in interior.iter().flatten() {
        let i = lattice.index(*r, *c);
        if column[i] == usize::MAX {
            column[i] = active.len();
            active.push(i);
        }
    }
    let (n, m) = (active.len(), interior.len());
    let target: Vec<f64> = active.iter().map(|i| field.heights()[*i]).collect();

    // Ax + cone variable = b: the trace rows first, then one cone of three for each stencil.
    let (mut rows, mut cols, mut values) = (Vec::new(), Vec::new(), Vec::new());
    let mut entry = |row: usize, col: usize, value: f64| {
        rows.push(row);
        cols.push(col);
        values.push(value);
    };
    for (k, ring) in interior.iter().enumerate() {
        let b = stencil(ring.map(|(r, c)| lattice.position(r, c)));
        let s = n + k;
        entry(2 * k, s, -1.0);
        entry(2 * k + 1, s, -1.0);
        entry(2 * m + 3 * k, s, -1.0);
        for (j, (r, c)) in ring.iter().enumerate() {
            let z = column[lattice.index(*r, *c)];
            let (xx, xy, yy) = (b[(0, j)], b[(1, j)], b[(2, j)]);
            entry(2 * k, z, xx + yy);
            entry(2 * k + 1, z, -(xx + yy));
            entry(2 * m + 3 * k + 1, z, -(xx - yy));
            entry(2 * m + 3 * k + 2, z, -2.0 * xy);
        }
    }
    let a = CscMatrix::new_from_triplets(5 * m, n + m, rows, cols, values);
    let p = CscMatrix::new_from_triplets(
        n + m,
        n + m,
        (0..n).collect(),
        (0..n).collect(),
        vec![2.0 * lambda; n],
    );
    let q: Vec<f64> = target
        .iter()
        .map(|t| -2.0 * lambda * t)
        .chain(std::iter::repeat_n(1.0, m))
        .collect();
    let mut cones: Vec<SupportedConeT<f64>> = vec![NonnegativeConeT(2 * m)];
    cones.extend((0..m).map(|_| SecondOrderConeT(3)));
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(1e-12)
        .tol_gap_rel(1e-10)
        .tol_feas(1e-11)
        .build()
        .unwrap();
    let mut solver = DefaultSolver::new(&p, &q, &a, &vec![0.0; 5 * m], &cones, settings).unwrap();
    solver.solve();
    assert!(
        matches!(
            solver.solution.status,
            SolverStatus::Solved | SolverStatus::AlmostSolved
        ),
        "{:?}",
        solver.solution.status
    );

    let x = &solver.solution.x;
    // The objective is evaluated at the heights themselves, not read off the solver.
    let fidelity: f64 = x.iter().zip(&target).map(|(z, t)| (z - t).powi(2)).sum();
    let nuclear: f64 = interior
        .iter()
        .map(|ring| {
            let b = stencil(ring.map(|(r, c)| lattice.position(r, c)));
            let z = SVector::<f64, 7>::from(ring.map(|(r, c)| x[column[lattice.index(r, c)]]));
            let h = b * z;
            (h[0] + h[2]).abs().max((h[0] - h[2]).hypot(2.0 * h[1]))
        })
        .sum();
    let mut heights = vec![f64::NAN; lattice.len()];
    for (i, z) in active.iter().zip(x) {
        heights[*i] = *z;
    }
    Optimum {
        objective: lambda * fidelity + nuclear,
        heights,
    }
}
