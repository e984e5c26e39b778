//! The paper's ADMM (Sec. 4.1) as its authors run it: the z-step by a sparse Cholesky
//! factorisation, made anew whenever ρ changes, on one lattice. A reference for
//! `Schedule::Paper`, whose stopping rule it has.

use std::error::Error;
use std::time::Instant;

use developable::{Domain, Heightfield, Sym2};
use faer::Side;
use faer::col::ColMut;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use sprs::CsMat;
use sprs::binop::csmat_binop;

use crate::energy::Energy;
use crate::task::{Outcome, Settings};

const FIRST_RHO: f64 = 1e-6;
const CHECK_EVERY: usize = 10;
const IMBALANCE: f64 = 5000.0;
const ABSOLUTE: f64 = 1e-4;
const RELATIVE: f64 = 1e-3;

/// The clock starts when the matrices are there.
pub fn solve(field: &Heightfield, settings: &Settings) -> Result<Outcome, Box<dyn Error>> {
    let domain = Domain::new(field)?;
    let energy = Energy::new(&domain, field.heights(), settings.lambda);
    let normal = energy.normal_matrix();
    let start = Instant::now();
    let last = iterate(&energy, &normal, settings.max_iterations)?;
    Ok(Outcome {
        vertices: energy.vertices(),
        seconds: start.elapsed().as_secs_f64(),
        objective: energy.objective(&last.z),
        dual_bound: Some(energy.dual_bound(&last.dual)),
        iterations: last.iterations,
        finest: last.iterations,
        stop: last.stop.into(),
    })
}

struct Iterate {
    z: Vec<f64>,
    /// `Y = ρU`.
    dual: Vec<Sym2>,
    iterations: usize,
    /// As the library says it.
    stop: &'static str,
}

fn iterate(
    energy: &Energy,
    normal: &CsMat<f64>,
    max_iterations: usize,
) -> Result<Iterate, Box<dyn Error>> {
    let system = System::new(normal, 2.0 * energy.lambda)?;
    let mut rho = FIRST_RHO;
    let mut factor = system.factor(rho)?;
    let mut h = vec![Sym2::default(); energy.interior()];
    let mut u = h.clone();
    // Four entries of a Hessian, as in the paper.
    let absolute = (4.0 * energy.interior() as f64).sqrt() * ABSOLUTE;
    for iteration in 1.. {
        // z ← argmin λ‖z − z̃‖² + ρ/2 ‖Cz − H + U‖²
        let wanted: Vec<Sym2> = h.iter().zip(&u).map(|(h, u)| *h - *u).collect();
        let mut z = energy.c.adjoint(&wanted);
        for (z, target) in z.iter_mut().zip(&energy.target) {
            *z = 2.0 * energy.lambda * target + rho * *z;
        }
        factor.solve_in_place(ColMut::from_slice_mut(&mut z));

        // H ← soft(Cz + U, 1/ρ), U ← U + Cz − H
        let cz = energy.c.apply(&z);
        let (mut primal, mut change) = (0.0, 0.0);
        for ((h, u), cz) in h.iter_mut().zip(&mut u).zip(&cz) {
            let sum = *cz + *u;
            let new = sum.soft_threshold(1.0 / rho);
            *u = sum - new;
            primal += (*cz - new).dot(*cz - new);
            change += (new - *h).dot(new - *h);
            *h = new;
        }

        let last = iteration == max_iterations;
        if !(last || iteration % CHECK_EVERY == 0) {
            continue;
        }
        let (primal, dual) = (primal.sqrt(), rho * change.sqrt());
        let converged = primal <= absolute + RELATIVE * norm(&cz).max(norm(&h))
            && dual <= absolute + RELATIVE * rho * norm(&u);
        if converged || last {
            return Ok(Iterate {
                z,
                dual: scaled(&u, rho),
                iterations: iteration,
                stop: if converged {
                    "residuals"
                } else {
                    "maxIterations"
                },
            });
        }
        let step = if primal > IMBALANCE * dual {
            2.0
        } else if dual > IMBALANCE * primal {
            0.5
        } else {
            continue;
        };
        rho *= step;
        u = scaled(&u, 1.0 / step);
        factor = system.factor(rho)?;
    }
    unreachable!("the last iteration returns")
}

fn norm(matrices: &[Sym2]) -> f64 {
    matrices.iter().map(|m| m.dot(*m)).sum::<f64>().sqrt()
}

fn scaled(matrices: &[Sym2], factor: f64) -> Vec<Sym2> {
    let scale = |m: &Sym2| {
        let [xx, xy, yy] = m.entries();
        Sym2::new(factor * xx, factor * xy, factor * yy)
    };
    matrices.iter().map(scale).collect()
}

/// `2λI + ρCᵀC`, whose entries lie at the same places for every ρ.
struct System<'a> {
    normal: &'a CsMat<f64>,
    fidelity: f64,
    symbolic: SymbolicLlt<usize>,
}

impl<'a> System<'a> {
    fn new(normal: &'a CsMat<f64>, fidelity: f64) -> Result<Self, Box<dyn Error>> {
        let matrix = combine(normal, fidelity, FIRST_RHO);
        Ok(System {
            normal,
            fidelity,
            symbolic: SymbolicLlt::try_new(matrix.symbolic(), Side::Lower)?,
        })
    }

    fn factor(&self, rho: f64) -> Result<Llt<usize, f64>, Box<dyn Error>> {
        let matrix = combine(self.normal, self.fidelity, rho);
        let symbolic = self.symbolic.clone();
        Ok(Llt::try_new_with_symbolic(
            symbolic,
            matrix.as_ref(),
            Side::Lower,
        )?)
    }
}

fn combine(normal: &CsMat<f64>, fidelity: f64, rho: f64) -> SparseColMat<usize, f64> {
    let n = normal.rows();
    let identity: CsMat<f64> = CsMat::eye(n);
    let sum = csmat_binop(identity.view(), normal.view(), |one: &f64, entry| {
        fidelity * one + rho * entry
    });
    // It is symmetric: its rows are its columns.
    let (pointers, rows, entries) = sum.into_raw_storage();
    SparseColMat::new(
        SymbolicSparseColMat::new_checked(n, n, pointers, None, rows),
        entries,
    )
}
