//! What is to be measured and what was; the types of `tools/bench/task.mjs`.

use std::error::Error;

use serde::{Deserialize, Serialize};

use crate::memory;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Task {
    pub method: Method,
    pub input: Input,
    pub options: Settings,
    /// Solve with these first, which is not measured, and go on from there.
    pub from: Option<Settings>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Method {
    /// This library.
    Library,
    /// The paper's ADMM with a sparse factorisation in the z-step.
    Cholesky,
    /// A general conic solver.
    Conic,
}

/// An NPY file, on the hexagonal lattice or on square pixels.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Input {
    pub file: String,
    pub lattice: Lattice,
    pub spacing: f64,
    /// A value that means no data, besides NaN.
    pub no_data: Option<f64>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Lattice {
    Hex,
    Square,
}

/// The package's `SolverOptions`, all of them given.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Settings {
    pub lambda: f64,
    pub schedule: Schedule,
    pub gap: f64,
    pub max_iterations: usize,
    pub normalize: bool,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "camelCase")]
pub enum Schedule {
    Default,
    Paper,
}

/// What a method says of its solve.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Outcome {
    pub vertices: usize,
    pub seconds: f64,
    pub objective: f64,
    /// Certified lower bound of the optimum, from who gives one.
    pub dual_bound: Option<f64>,
    pub iterations: usize,
    /// Iterations on the input's own lattice.
    pub finest: usize,
    pub stop: String,
}

#[derive(Serialize)]
pub struct Measurement {
    #[serde(flatten)]
    outcome: Outcome,
    /// Most heap in use beyond the input.
    bytes: usize,
}

/// Solves that are measured at least, unless they take long.
const RUNS: usize = 3;
/// Seconds that all of them together take at least, and after which there are no more.
const SHORT: f64 = 1.0;
const LONG: f64 = 6.0;

/// The fastest of several solves.
pub fn best(
    solve: impl Fn() -> Result<Outcome, Box<dyn Error>>,
) -> Result<Measurement, Box<dyn Error>> {
    let measure = || {
        let before = memory::restart();
        let outcome = solve()?;
        let bytes = memory::peak() - before;
        Ok::<_, Box<dyn Error>>(Measurement { outcome, bytes })
    };
    let mut best = measure()?;
    let (mut runs, mut spent) = (1, best.outcome.seconds);
    while spent < LONG && (runs < RUNS || spent < SHORT) {
        let next = measure()?;
        (runs, spent) = (runs + 1, spent + next.outcome.seconds);
        if next.outcome.seconds < best.outcome.seconds {
            best = next;
        }
    }
    Ok(best)
}
