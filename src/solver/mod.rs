//! ADMM for the nuclear norm of the Hessian (paper, Sec. 4.1), with a certified
//! duality gap.

mod cg;
mod lanes;
mod options;
mod problem;
mod report;
mod schedule;
mod state;

use std::ops::ControlFlow;

use web_time::Instant;

pub use options::{Lambda, Normalization, Options, Schedule};
pub use report::{Progress, Report, Seconds, StopReason};

use crate::error::{Error, Result};
use crate::heightfield::Heightfield;
use crate::restore::restore_omitted;
use crate::surface::Surface;
use cg::ConjugateGradients;
use problem::Problem;
use schedule::Plan;
use state::{Certificate, State};

/// Whether a [`Solver`] has more to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// [`Solver::advance`] should be called again.
    Running,
    /// Done; further calls change nothing.
    Stopped(StopReason),
}

/// A solve that runs in steps, so that its caller can look at it, draw, or stop
/// it in between.
///
/// ```
/// use developable::{Heightfield, Lattice, Options, Solver, Status};
/// # fn main() -> developable::Result<()> {
/// let lattice = Lattice::new(30, 30, 1.0)?;
/// let field = Heightfield::from_fn(lattice, |x, y| 0.01 * x * x + 0.1 * (7.0 * y).sin())?;
/// let mut solver = Solver::new(&field, &Options::default())?;
/// while solver.advance(100) == Status::Running {
///     println!("gap {:.3}", solver.progress().gap);
/// }
/// assert!(solver.surface()?.report().gap <= 0.01);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct Solver {
    field: Heightfield,
    problem: Problem,
    plan: Plan,
    state: State,
    cg: ConjugateGradients,
    /// Conjugate-gradient iterations of the z-step under way.
    z_step: usize,
    iteration: usize,
    cg_iterations: usize,
    best: Best,
    status: Status,
    started: Instant,
    seconds: Seconds,
}

/// The best iterate so far and the best bound so far; they need not belong together.
#[derive(Debug, Clone)]
struct Best {
    z: Vec<f64>,
    fidelity: f64,
    nuclear_norm: f64,
    dual_bound: f64,
}

impl Best {
    fn objective(&self) -> f64 {
        self.fidelity + self.nuclear_norm
    }

    fn gap(&self) -> f64 {
        let objective = self.objective();
        if objective > 0.0 {
            (objective - self.dual_bound) / objective
        } else {
            0.0
        }
    }

    fn take(&mut self, z: &[f64], certificate: &Certificate) {
        if certificate.objective() < self.objective() {
            self.z.copy_from_slice(z);
            self.fidelity = certificate.fidelity;
            self.nuclear_norm = certificate.nuclear_norm;
        }
        self.dual_bound = self.dual_bound.max(certificate.dual_bound);
    }
}

impl Solver {
    /// Sets up a solve. Memory: about 90 bytes for each vertex of the valid
    /// vertices' bounding box.
    ///
    /// # Errors
    /// [`Error::Option`] for an option out of range, [`Error::NoInterior`] if
    /// there is nothing to solve, [`Error::Overflow`] if the heights are too
    /// large for their energy to be computed, [`Error::OutOfMemory`].
    pub fn new(field: &Heightfield, options: &Options) -> Result<Self> {
        let started = Instant::now();
        let problem = Problem::new(field, options)?;
        let plan = Plan::new(options);
        let mut state = State::new(&problem, plan.first_rho(&problem))?;
        let mut cg = ConjugateGradients::new(&problem, state.rho)?;
        let certificate = state.certify(&problem);
        if !certificate.objective().is_finite() {
            return Err(Error::Overflow {
                spacing: field.lattice().spacing(),
            });
        }
        state.update(&problem, 0.0, &mut cg);
        let best = Best {
            z: state.z.clone(),
            fidelity: certificate.fidelity,
            nuclear_norm: certificate.nuclear_norm,
            dual_bound: certificate.dual_bound,
        };
        let reason = plan.stop(&problem, 0, &certificate, best.objective(), best.gap());
        Ok(Solver {
            field: field.clone(),
            problem,
            plan,
            state,
            cg,
            z_step: 0,
            iteration: 0,
            cg_iterations: 0,
            best,
            status: reason.map_or(Status::Running, Status::Stopped),
            started,
            seconds: Seconds {
                setup: started.elapsed().as_secs_f64(),
                ..Seconds::default()
            },
        })
    }

    /// Runs about `work` conjugate-gradient iterations, at least one. Results
    /// do not depend on how the work is divided.
    pub fn advance(&mut self, work: usize) -> Status {
        let mut left = work.max(1);
        while left > 0 && self.status == Status::Running {
            let start = Instant::now();
            let done = self.run_z_step(&mut left);
            self.seconds.z_step += start.elapsed().as_secs_f64();
            if done {
                self.finish_iteration();
            }
        }
        self.status
    }

    /// Goes on with the z-step under way; tells whether it is complete.
    fn run_z_step(&mut self, left: &mut usize) -> bool {
        let target = if self.plan.cg_tolerance > 0.0 {
            self.plan.cg_tolerance * self.cg.reference_norm(&self.problem)
        } else {
            0.0
        };
        while self.z_step < self.plan.cg_iterations && self.cg.residual_norm() > target {
            if *left == 0 {
                return false;
            }
            *left -= 1;
            if !self.cg.step(&self.problem, &mut self.state.z) {
                break;
            }
            self.z_step += 1;
            self.cg_iterations += 1;
        }
        // The update below costs about as much; so a solve without work for CG ends as well.
        *left = left.saturating_sub(1);
        true
    }

    /// H-step, dual update and, when one is due, the certificate.
    fn finish_iteration(&mut self) {
        let start = Instant::now();
        self.z_step = 0;
        self.iteration += 1;
        self.state
            .update(&self.problem, self.plan.relaxation, &mut self.cg);
        self.seconds.h_step += start.elapsed().as_secs_f64();
        let due = self.iteration.is_multiple_of(self.plan.check_every);
        if due || self.plan.is_last(self.iteration) {
            let start = Instant::now();
            self.check();
            self.seconds.certificate += start.elapsed().as_secs_f64();
        }
    }

    fn check(&mut self) {
        let certificate = self.state.certify(&self.problem);
        self.best.take(&self.state.z, &certificate);
        if let Some(reason) = self.plan.stop(
            &self.problem,
            self.iteration,
            &certificate,
            self.best.objective(),
            self.best.gap(),
        ) {
            self.status = Status::Stopped(reason);
            return;
        }
        let rho = self.plan.next_rho(self.state.rho, &certificate);
        if rho != self.state.rho {
            self.state.set_rho(&self.problem, rho);
            self.cg.set_rho(&self.problem, rho);
            self.state.update(&self.problem, 0.0, &mut self.cg);
        }
    }

    /// Figures of the last check.
    pub fn progress(&self) -> Progress {
        Progress {
            iteration: self.iteration,
            cg_iterations: self.cg_iterations,
            objective: self.best.objective(),
            dual_bound: self.best.dual_bound,
            gap: self.best.gap(),
            rho: self.state.rho,
            elapsed: self.started.elapsed().as_secs_f64(),
        }
    }

    /// Stops a running solve: its surface is then the best one so far, marked
    /// [`StopReason::Cancelled`].
    pub fn cancel(&mut self) {
        if self.status == Status::Running {
            self.status = Status::Stopped(StopReason::Cancelled);
        }
    }

    /// The best surface so far, in the input's units, omitted vertices
    /// restored. While the solve is running it is reported as cancelled.
    pub fn surface(&self) -> Result<Surface> {
        let mut heights = self.problem.heights(&self.field, &self.best.z);
        restore_omitted(&self.problem.domain, &self.field, &mut heights);
        let domain = &self.problem.domain;
        let report = Report {
            interior: domain.interior_len(),
            boundary: domain.boundary_len(),
            omitted: domain.omitted_len(),
            iterations: self.iteration,
            cg_iterations: self.cg_iterations,
            objective: self.best.objective(),
            fidelity: self.best.fidelity,
            nuclear_norm: self.best.nuclear_norm,
            dual_bound: self.best.dual_bound,
            gap: self.best.gap(),
            lambda: self.problem.lambda,
            rho: self.state.rho,
            scale: self.problem.scale,
            stop_reason: match self.status {
                Status::Running => StopReason::Cancelled,
                Status::Stopped(reason) => reason,
            },
            seconds: Seconds {
                total: self.started.elapsed().as_secs_f64(),
                ..self.seconds
            },
        };
        Ok(Surface {
            heightfield: Heightfield::new(*self.field.lattice(), heights)?,
            report,
        })
    }
}

/// Solves to the end.
///
/// # Errors
/// As [`Solver::new`].
pub fn fit(field: &Heightfield, options: &Options) -> Result<Surface> {
    fit_with(field, options, |_| ControlFlow::Continue(()))
}

/// Solves to the end, unless `on_progress` breaks off: it is called every few
/// conjugate-gradient iterations, and after a break the best surface so far
/// comes back, marked [`StopReason::Cancelled`].
///
/// # Errors
/// As [`Solver::new`].
pub fn fit_with(
    field: &Heightfield,
    options: &Options,
    mut on_progress: impl FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Surface> {
    /// About ten iterations of the default schedule.
    const WORK: usize = 70;
    let mut solver = Solver::new(field, options)?;
    while solver.advance(WORK) == Status::Running {
        if on_progress(&solver.progress()).is_break() {
            solver.cancel();
        }
    }
    solver.surface()
}
