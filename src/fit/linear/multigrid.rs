//! Multigrid V-cycle, the preconditioner of the z-step on lattices.
//!
//! The same energy on the lattices of spacing 2h, 4h, … gives the coarse matrices (a coarse vertex stands for
//! four fine ones, hence the factor ¼ in the restriction; at a border a coarse stencil may stand for more).
//! Chebyshev's polynomial of Jacobi's preconditioner smooths, and the cycle ends where the fidelity term makes
//! the system well conditioned, two to five lattices down. The cycle is symmetric and positive definite, so
//! that conjugate gradients may use it.

use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::border::coarser_counts;
use super::grid::{Grid, LARGEST_EIGENVALUE, part};
use super::transfer::Transfer;
use crate::error::{Result, try_filled};
use crate::fit::heightfields::Problem;
use crate::lattice::domain::Domain;
use crate::lattice::per_cell::PerCell;
use crate::math::{fork, lanes};

/// Number of smoothing steps of a V-cycle on each lattice before and after the coarse correction
/// (`benches/choices.md`, One constant at a time).
const SMOOTHING_STEPS: usize = 2;

/// Ratio of the largest to the smallest eigenvalue whose error the smoother reduces; the coarse lattice reduces the
/// errors of smaller eigenvalues (`benches/choices.md`, One constant at a time).
const SMOOTHED_EIGENVALUE_RATIO: f32 = 5.0;

/// Maximum condition number of a lattice's matrix at which a V-cycle needs no coarser lattice
/// (`benches/choices.md`, One constant at a time).
const MAX_BOTTOM_CONDITION: f32 = 8.0;

/// Maximum number of smoothing steps on the coarsest lattice of a V-cycle
/// (`benches/choices.md`, One constant at a time).
const MAX_BOTTOM_STEPS: f32 = 40.0;

/// Maximum number of unknowns of a coarsest lattice that is solved by a Cholesky factorisation where Chebyshev's
/// iteration would need more than [`MAX_BOTTOM_STEPS`] steps (`benches/choices.md`, One constant at a time).
const MAX_DIRECT_UNKNOWNS: usize = 300;

/// Amount added to the diagonal of a matrix before its Cholesky factorisation, relative to the diagonal, so that a
/// matrix that is singular up to rounding stays positive definite.
const DIAGONAL_SHIFT: f32 = 1e-5;

/// Stiffness of the springs that hold coarse vertices in place of constrained ones ([`Shares`]), relative to the finest
/// matrix's diagonal: the value with the fewest iterations on drawn curves; 1 and 0.001 took half as many again
/// (`benches/choices.md`, One constant at a time).
const SPRING_STIFFNESS: f64 = 0.03;

/// Multigrid hierarchy: lattices, each of twice the spacing of the one before, and the transfers between them.
#[derive(Debug, Clone)]
pub(crate) struct Multigrid {
    /// Lattices of the hierarchy, the finest first.
    levels: Vec<MultigridLevel>,
    /// Transfer from each lattice to the next coarser one.
    transfers: Vec<Transfer>,
    /// Number of lattices that a V-cycle visits.
    depth: usize,
    lambda: f64,
}

/// One lattice of the multigrid hierarchy with its matrix and work vectors.
#[derive(Debug, Clone)]
struct MultigridLevel {
    grid: Grid,
    /// Fidelity weights and constraints of the lattice's vertices; `None` if all vertices have weight 1 and none is
    /// constrained.
    shares: Option<Shares>,
    /// Cholesky factor of the matrix on the coarsest lattice of a cycle, where Chebyshev's iteration would take too
    /// long.
    direct: Option<Cholesky<f32, Dyn>>,
    /// Right-hand side of the lattice's linear system; the fields `x`, `step` and `residual` are its solution, the
    /// smoother's last step, and its residual.
    b: Vec<f32>,
    x: Vec<f32>,
    /// Solution after the smoothing step in progress; empty on one thread, which changes the solution in place.
    next: Vec<f32>,
    step: Vec<f32>,
    residual: Vec<f32>,
}

/// Fidelity weights and constraints of a lattice's vertices, as means over the finest vertices that each stands for.
/// Constrained vertices are no unknowns of the finest system; on coarser lattices springs replace them.
#[derive(Debug, Clone)]
struct Shares {
    fidelity: Vec<f32>,
    constrained: Vec<f32>,
}

impl Multigrid {
    /// Makes the hierarchy for a problem on the first of `domains`, each of which has twice the spacing of the one
    /// before.
    pub(crate) fn new(problem: &Problem, domains: &[Arc<Domain>], rho: f64) -> Result<Self> {
        let transfers = || {
            let pairs = domains.windows(2);
            let mut transfers: Vec<_> = pairs.map(|pair| (pair, None)).collect();
            fork::for_each(&mut transfers, |_, (pair, to)| {
                *to = Some(Transfer::new(&pair[0], &pair[1]));
            });
            transfers.into_iter().filter_map(|(_, transfer)| transfer)
        };
        let (transfers, counts) = fork::join(
            || transfers().collect::<Vec<Transfer>>(),
            || stencil_counts(domains),
        );
        let mut levels: Vec<MultigridLevel> = Vec::with_capacity(domains.len());
        let mut spacing = problem.operator.spacing;
        let varied = matches!(problem.fidelity, PerCell::Each(_));
        for (i, (domain, stencils)) in domains.iter().zip(counts?).enumerate() {
            let zeros = || try_filled("multigrid", domain.cells(), 0.0);
            let constrained = if i == 0 {
                problem.constrained.clone()
            } else {
                Vec::new()
            };
            let mut level = MultigridLevel {
                grid: Grid::new(domain.clone(), spacing, constrained, varied)?,
                shares: None,
                direct: None,
                b: zeros()?,
                x: zeros()?,
                next: Vec::new(),
                step: zeros()?,
                residual: zeros()?,
            };
            level.grid.stencils = stencils;
            level.shares = match levels.last_mut() {
                None => Shares::from_problem(problem)?,
                Some(finer) => finer.coarser_shares(&transfers[i - 1], &mut level)?,
            };
            levels.push(level);
            spacing *= 2.0;
        }
        let mut multigrid = Multigrid {
            levels,
            transfers,
            depth: 1,
            lambda: problem.lambda,
        };
        multigrid.set(rho);
        Ok(multigrid)
    }

    /// Changes ρ in the matrices of all lattices.
    pub(crate) fn set(&mut self, rho: f64) {
        let typical = 2.0 * self.lambda;
        let spring = SPRING_STIFFNESS * self.levels[0].grid.stiffness(rho);
        for level in &mut self.levels {
            match &level.shares {
                None => level.grid.set(rho, typical, |_| typical),
                Some(Shares {
                    fidelity,
                    constrained,
                }) => {
                    let each = |cell: usize| {
                        typical * lanes::double(fidelity[cell])
                            + spring * lanes::double(constrained[cell])
                    };
                    level.grid.set(rho, typical, each);
                }
            }
        }
        let good = |level: &MultigridLevel| level.grid.condition() <= MAX_BOTTOM_CONDITION;
        let last = self.levels.len() - 1;
        self.depth = self.levels.iter().position(good).unwrap_or(last) + 1;
        self.levels[self.depth - 1].prepare();
    }

    /// Matrix of the z-step on the finest lattice.
    pub(crate) fn matrix(&self) -> &Grid {
        &self.levels[0].grid
    }

    /// Matrix of the z-step on the finest lattice, for passes that use its buffers.
    pub(crate) fn matrix_mut(&mut self) -> &mut Grid {
        &mut self.levels[0].grid
    }

    /// Returns an approximation of `A⁻¹ b` by one V-cycle; `b` is the same afterwards.
    pub(crate) fn precondition(&mut self, b: &mut Vec<f32>) -> &[f32] {
        std::mem::swap(b, &mut self.levels[0].b);
        cycle(&mut self.levels[..self.depth], &self.transfers);
        std::mem::swap(b, &mut self.levels[0].b);
        &self.levels[0].x
    }
}

/// Counts the finest stencils that each stencil of each lattice stands for, as shares of the number away from the border.
fn stencil_counts(domains: &[Arc<Domain>]) -> Result<Vec<PerCell<f32>>> {
    let mut counts: Vec<PerCell<f32>> = Vec::with_capacity(domains.len());
    for (i, domain) in domains.iter().enumerate() {
        counts.push(match counts.last() {
            None => PerCell::same(domain.stride(), 1.0),
            Some(finer) => coarser_counts(finer, &domains[i - 1], domain)?,
        });
    }
    Ok(counts)
}

/// Runs a V-cycle: solves `A x = b` approximately on the first lattice with the help of the coarser ones.
fn cycle(levels: &mut [MultigridLevel], transfers: &[Transfer]) {
    let Some((fine, below)) = levels.split_first_mut() else {
        return;
    };
    let (Some(coarse), Some((transfer, further))) = (below.first_mut(), transfers.split_first())
    else {
        return fine.solve();
    };
    let low = LARGEST_EIGENVALUE / SMOOTHED_EIGENVALUE_RATIO;
    fine.start(low);
    fine.smooth(SMOOTHING_STEPS - 1, low, true);
    fine.grid.residual(&fine.x, &fine.b, &mut fine.residual);
    fine.grid.pin(&mut fine.residual);
    let scale = 0.25 * fine.grid.diagonal / coarse.grid.diagonal;
    transfer.restrict(
        (&fine.grid.domain, &fine.residual, &mut fine.step),
        (&coarse.grid.domain, &mut coarse.b),
        scale as f32,
    );
    cycle(below, further);
    let coarse = &below[0];
    transfer.prolong(
        (&coarse.grid.domain, &coarse.x),
        (&fine.grid.domain, &mut fine.x, &mut fine.residual),
    );
    fine.grid.pin(&mut fine.x);
    fine.smooth(SMOOTHING_STEPS, low, false);
}

impl Shares {
    fn from_problem(problem: &Problem) -> Result<Option<Self>> {
        let PerCell::Each(weights) = &problem.fidelity else {
            return Ok(None);
        };
        let domain = &problem.operator.domain;
        let zeros = || try_filled("multigrid", domain.cells(), 0.0);
        let (mut fidelity, mut constrained) = (zeros()?, zeros()?);
        for cell in domain.active().cells() {
            fidelity[cell] = lanes::single(weights[cell]);
        }
        for cell in &problem.constrained {
            fidelity[*cell as usize] = 0.0;
            constrained[*cell as usize] = 1.0;
        }
        Ok(Some(Shares {
            fidelity,
            constrained,
        }))
    }
}

impl MultigridLevel {
    /// Computes the mean fidelity weights and constraints of the next coarser lattice's vertices; leaves the work
    /// vectors clean.
    fn coarser_shares(
        &mut self,
        transfer: &Transfer,
        coarse: &mut MultigridLevel,
    ) -> Result<Option<Shares>> {
        let Some(shares) = &self.shares else {
            return Ok(None);
        };
        let mean = |fine: &[f32], work: &mut [f32]| {
            let mut means = try_filled("multigrid", coarse.grid.domain.cells(), 0.0)?;
            transfer.restrict(
                (&self.grid.domain, fine, work),
                (&coarse.grid.domain, &mut means),
                0.25,
            );
            // A plane through vertices beside gives some of them negative weights.
            means
                .iter_mut()
                .for_each(|mean: &mut f32| *mean = mean.max(0.0));
            Ok(means)
        };
        Ok(Some(Shares {
            fidelity: mean(&shares.fidelity, &mut self.step)?,
            constrained: mean(&shares.constrained, &mut self.step)?,
        }))
    }

    /// Factors the matrix of the coarsest lattice of a cycle if iterating would take too long there.
    fn prepare(&mut self) {
        let steps = 1.5 * self.grid.condition().sqrt();
        let unknowns = self.grid.domain.active().len();
        let slow = steps > MAX_BOTTOM_STEPS
            && unknowns <= MAX_DIRECT_UNKNOWNS
            && self.grid.constrained().is_empty();
        self.direct = None;
        if slow {
            let columns = self.grid.dense();
            let mut matrix = DMatrix::from_fn(unknowns, unknowns, |i, j| columns[j][i]);
            for i in 0..unknowns {
                matrix[(i, i)] *= 1.0 + DIAGONAL_SHIFT;
            }
            self.direct = matrix.cholesky();
        }
    }

    /// Solves the system on the coarsest lattice of a cycle: by the Cholesky factor, or by Chebyshev's iteration for
    /// the whole spectrum.
    fn solve(&mut self) {
        if let Some(direct) = &self.direct {
            let cells = || self.grid.domain.active().cells();
            let mut solution =
                DVector::from_iterator(self.grid.domain.active().len(), cells().map(|c| self.b[c]));
            direct.solve_mut(&mut solution);
            for (cell, value) in cells().zip(solution.iter()) {
                self.x[cell] = *value;
            }
            return;
        }
        let condition = self.grid.condition();
        let steps = (1.5 * condition.sqrt()).ceil().clamp(2.0, MAX_BOTTOM_STEPS);
        let low = LARGEST_EIGENVALUE / condition;
        self.start(low);
        self.smooth(steps as usize - 1, low, true);
    }

    /// Takes the first step of Chebyshev's iteration from `x = 0`, which needs no product with the matrix. `low` is the
    /// smallest eigenvalue whose error it reduces.
    fn start(&mut self, low: f32) {
        let weight = 2.0 / (LARGEST_EIGENVALUE + low);
        let (domain, b) = (&self.grid.domain, &self.b);
        let (bands, inverse) = (domain.bands(), &self.grid.inverse_diagonal);
        let states = bands.split(&mut self.x).zip(bands.split(&mut self.step));
        fork::for_each(&mut states.collect::<Vec<_>>(), |band, (x, step)| {
            for run in bands.runs(domain.active(), band) {
                let (x, step) = (x.run_mut(*run), step.run_mut(*run));
                let (b, m) = (part(b, *run), part(inverse, *run));
                for i in 0..x.len() {
                    let first = weight * (m[i] * b[i]);
                    step[i] = first;
                    x[i] = first;
                }
            }
        });
    }

    /// Takes steps of Chebyshev's iteration that reduce the errors of eigenvalues from `low` to the largest; `started`
    /// says that the first step was taken.
    fn smooth(&mut self, steps: usize, low: f32, started: bool) {
        let middle = 0.5 * (LARGEST_EIGENVALUE + low);
        let half = 0.5 * (LARGEST_EIGENVALUE - low);
        let sigma = middle / half;
        let mut ratio = 1.0 / sigma;
        for k in 0..steps {
            let (momentum, weight) = if k == 0 && !started {
                (0.0, 1.0 / middle)
            } else {
                let last = ratio;
                ratio = 1.0 / (2.0 * sigma - last);
                (ratio * last, 2.0 * ratio / half)
            };
            let x = (&mut self.x, &mut self.next);
            self.grid
                .smooth(x, &self.b, &mut self.step, momentum, weight);
        }
    }
}
