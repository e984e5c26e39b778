//! The same optimum by a general interior-point solver: the energy as a second-order cone program,
//! with `‖H‖_* = max(|h_xx + h_yy|, ‖(h_xx − h_yy, 2h_xy)‖)`.
//!
//! The unknowns are the corrections `z − z̃`, so that the program's objective is the energy and
//! its relative gap means what the library's does.

use std::error::Error;
use std::time::Instant;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT,
    SupportedConeT,
};
use developable::{Domain, Heightfield};

use crate::energy::Energy;
use crate::task::{Outcome, Settings};

/// The clock starts when the matrices are there.
pub fn solve(field: &Heightfield, settings: &Settings) -> Result<Outcome, Box<dyn Error>> {
    let domain = Domain::new(field)?;
    let energy = Energy::new(&domain, field.heights(), settings.lambda);
    let program = Program::new(&energy);
    let tolerances = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_rel(settings.gap)
        .tol_gap_abs(f64::MIN_POSITIVE)
        .tol_feas(settings.gap)
        .max_threads(1)
        .build()?;
    let start = Instant::now();
    let Program { p, q, a, b, cones } = &program;
    let mut solver = DefaultSolver::new(p, q, a, b, cones, tolerances)?;
    solver.solve();
    let seconds = start.elapsed().as_secs_f64();
    // The energy of the heights themselves, as far as they are from what the solver thinks.
    let pairs = solver.solution.x.iter().zip(&energy.target);
    let z: Vec<f64> = pairs.map(|(x, target)| target + x).collect();
    let iterations = solver.solution.iterations as usize;
    Ok(Outcome {
        vertices: energy.vertices(),
        seconds,
        objective: energy.objective(&z),
        dual_bound: None,
        iterations,
        finest: iterations,
        stop: format!("{:?}", solver.solution.status),
    })
}

/// Minimise `½xᵀPx + qᵀx` where `b − Ax` lies in the cones.
struct Program {
    p: CscMatrix<f64>,
    q: Vec<f64>,
    a: CscMatrix<f64>,
    b: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
}

impl Program {
    /// Unknowns: the corrections, then a bound `s` of each nuclear norm. Conditions: two for each
    /// trace, then a cone of three for each stencil.
    fn new(energy: &Energy) -> Program {
        let (n, m) = (energy.len(), energy.interior());
        let [mut rows, mut cols] = [Vec::new(), Vec::new()];
        let mut values = Vec::new();
        let mut b = vec![0.0; 5 * m];
        let mut add = |row: usize, col: usize, value: f64| {
            rows.push(row);
            cols.push(col);
            values.push(value);
        };
        // The rows of stencil `k`, each with the combination of `h_xx, h_xy, h_yy` that is bounded.
        let conditions = |k: usize| {
            let (low, high, cone) = (2 * k, 2 * k + 1, 2 * m + 3 * k);
            [
                (low, [-1.0, 0.0, -1.0]),
                (high, [1.0, 0.0, 1.0]),
                (cone + 1, [1.0, 0.0, -1.0]),
                (cone + 2, [0.0, 2.0, 0.0]),
            ]
        };
        for (row, entries) in energy.operator().outer_iterator().enumerate() {
            for (condition, factors) in conditions(row / 3) {
                let factor = factors[row % 3];
                for (col, value) in entries.iter().filter(|_| factor != 0.0) {
                    add(condition, col, -factor * value);
                }
            }
        }
        for (k, hessian) in energy.c.apply(&energy.target).iter().enumerate() {
            for (condition, factors) in conditions(k) {
                let terms = factors.iter().zip(hessian.entries());
                b[condition] = terms.map(|(factor, entry)| factor * entry).sum();
            }
            for bounded in [2 * k, 2 * k + 1, 2 * m + 3 * k] {
                add(bounded, n + k, -1.0);
            }
        }
        let diagonal: Vec<usize> = (0..n).collect();
        let weights = vec![2.0 * energy.lambda; n];
        Program {
            p: CscMatrix::new_from_triplets(n + m, n + m, diagonal.clone(), diagonal, weights),
            q: [vec![0.0; n], vec![1.0; m]].concat(),
            a: CscMatrix::new_from_triplets(5 * m, n + m, rows, cols, values),
            b,
            cones: std::iter::once(NonnegativeConeT(2 * m))
                .chain(std::iter::repeat_n(SecondOrderConeT(3), m))
                .collect(),
        }
    }
}
