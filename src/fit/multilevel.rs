//! The multilevel solve of one connected component: from its coarsest lattice to its finest, and through the
//! reweighting passes there.

use std::sync::Arc;

use super::admm::default_rho::refined_rho;
use super::admm::incumbent::Incumbent;
use super::admm::parameters::AdmmParameters;
use super::admm::steps::Admm;
use super::border_load::load_border;
use super::energy::creases::Creases;
use super::heightfields::{AdmmSolver, Iterate, Problem};
use super::linear::cg::ConjugateGradients;
use super::options::{Border, Energy, HuberOptions, Options};
use super::prolong::prolong;
use super::report::{LevelReport, Seconds, StopReason};
use crate::error::Result;
use crate::lattice::domain::Domain;

/// Cost of one step of the set-up of a multigrid level, in conjugate-gradient iterations on that level.
pub(crate) const SET_UP_CG_ITERATIONS: usize = 10;

/// Solve of one connected component, level by level from the coarsest, which can be interrupted.
#[derive(Debug, Clone)]
pub(crate) struct Multilevel {
    /// ADMM on the current level.
    pub level: AdmmSolver,
    /// Problems on the finer levels, the finest first.
    finer: Vec<Problem>,
    /// First iterate of the next finer level, from the end of the current level until the next one begins.
    carried: Option<Iterate>,
    /// Domains of all lattices, the finest first.
    domains: Vec<Arc<Domain>>,
    /// Reports of the finished coarser levels, the coarsest first.
    coarser: Vec<LevelReport>,
    parameters: AdmmParameters,
    /// Number of reweighting passes so far.
    passes: usize,
    /// Maximum number of reweighting passes still to come.
    passes_left: usize,
    /// Crease radius, if the passes are crease passes; `None` if they reweight all stencils.
    crease_radius: Option<f64>,
    /// Bend radius by which the border is to be loaded with moments; `None` if it is not to be loaded, or is already.
    loads_within: Option<f64>,
    /// Counts of the stencils on creases in the last pass.
    creases: Creases,
    /// Whether rank reduction, the last step of the solve, has begun.
    ends: bool,
    /// Whether there is rank reduction.
    reduces_rank: bool,
    seconds: Seconds,
    /// Reason why the solve stopped; `None` while it runs.
    pub reason: Option<StopReason>,
}

/// Result of a component's solve: its surface, and the iterate for a warm start of another solve.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    pub problem: Problem,
    pub iterate: Iterate,
    pub incumbent: Incumbent,
    /// Value of ρ at the start of the finest level.
    pub initial_rho: f64,
    pub reason: StopReason,
    pub levels: Vec<LevelReport>,
    pub passes: usize,
    pub creases: Creases,
    pub seconds: Seconds,
}

impl Multilevel {
    /// Starts the solve with ADMM on its first `level`, which may have stopped at once for a `reason`. `finer` are the
    /// problems on the finer levels.
    pub(crate) fn new(
        level: AdmmSolver,
        reason: Option<StopReason>,
        finer: Vec<Problem>,
        domains: Vec<Arc<Domain>>,
        parameters: AdmmParameters,
        options: &Options,
    ) -> Result<Self> {
        let (crease_radius, passes_left) = match options.energy_or_default() {
            Energy::Huber => {
                let HuberOptions { crease_radius, .. } = HuberOptions::SMOOTH.within(options);
                (Some(crease_radius), options.crease_passes_or_default())
            }
            _ => (None, options.reweighting),
        };
        let mut multilevel = Multilevel {
            level,
            finer,
            carried: None,
            domains,
            coarser: Vec::new(),
            parameters,
            passes: 0,
            passes_left,
            crease_radius,
            loads_within: (options.border_or_default() == Border::Loaded && !options.is_trial)
                .then(|| HuberOptions::SMOOTH.within(options).bend_radius),
            creases: Creases::default(),
            ends: false,
            reduces_rank: !options.is_trial,
            seconds: Seconds::default(),
            reason: None,
        };
        if let Some(reason) = reason {
            multilevel.finish_level(reason)?;
        }
        Ok(multilevel)
    }

    /// Continues until `left` conjugate-gradient iterations are used up, or until the solve is finished; then returns
    /// the reason why it stopped.
    pub(crate) fn advance(&mut self, left: &mut usize) -> Result<Option<StopReason>> {
        while *left > 0 && self.reason.is_none() {
            if let Some(iterate) = self.carried.take() {
                *left = left.saturating_sub(SET_UP_CG_ITERATIONS);
                self.enter_level(iterate)?;
            } else if let Some(reason) = self.level.advance(left)? {
                self.finish_level(reason)?;
            }
        }
        Ok(self.reason)
    }

    /// Continues after ADMM has stopped on a level, with `reason` as its stop reason: sets up the next finer level, or on the
    /// finest level begins the next reweighting or crease pass, if there is one.
    fn finish_level(&mut self, mut reason: StopReason) -> Result<()> {
        if let Some(fine) = self.finer.last() {
            let rho = refined_rho(self.level.admm.iterate.rho, fine);
            let iterate = prolong(
                &self.level.admm.problem,
                &self.level.admm.iterate,
                fine,
                rho,
            )?;
            self.carried = Some(iterate);
            return Ok(());
        }
        while !self.ends
            && self.passes_left > 0
            && matches!(reason, StopReason::Gap | StopReason::Residuals)
        {
            self.passes_left -= 1;
            let next = match self.crease_radius {
                None => {
                    self.passes += 1;
                    self.level.reweight()?
                }
                Some(radius) => {
                    let creases = self.level.reweight_creases(radius)?;
                    let loaded = self.load_border()?;
                    if !creases.changed && !loaded {
                        break;
                    }
                    let next = self.level.begin_pass_at_creases(loaded)?;
                    // A pass for the border's load alone is not counted as a crease pass.
                    if creases.changed {
                        self.creases = creases;
                        self.passes += 1;
                    }
                    next
                }
            };
            match next {
                Some(next) => reason = next,
                None => return Ok(()),
            }
        }
        if self.reduces_rank && !self.ends && self.level.begin_rank_reduction(reason)? {
            self.ends = true;
            return Ok(());
        }
        self.reason = Some(reason);
        Ok(())
    }

    /// Loads the border with bending moments, if it is to be loaded and is not yet; returns whether there are any.
    fn load_border(&mut self) -> Result<bool> {
        let Admm {
            problem, iterate, ..
        } = &mut self.level.admm;
        match self.loads_within.take() {
            Some(radius) => load_border(problem, iterate, radius),
            None => Ok(false),
        }
    }

    /// Starts ADMM on the next finer level.
    fn enter_level(&mut self, iterate: Iterate) -> Result<()> {
        let Some(last) = self.finer.len().checked_sub(1) else {
            return Ok(());
        };
        let cg = ConjugateGradients::new(&self.finer[last], &self.domains[last..], iterate.rho)?;
        let fine = self.finer.remove(last);
        self.coarser.push(self.level.report());
        self.seconds = self.seconds + self.level.admm.seconds;
        let done = self.coarser.iter().map(|level| level.iterations).sum();
        let parameters = self.parameters.on_level(!self.finer.is_empty(), done);
        // A level takes about as many iterations as the one before.
        let next_climb = 2 * self.level.report().iterations / 3;
        let may_be_affine = self.level.admm.incumbent.is_affine;
        let (level, stop) =
            AdmmSolver::new(fine, iterate, cg, parameters, next_climb, may_be_affine)?;
        self.level = level;
        match stop {
            Some(reason) => self.finish_level(reason),
            None => Ok(()),
        }
    }

    /// Number of finer levels still to come.
    pub(crate) fn levels_left(&self) -> usize {
        self.finer.len()
    }

    /// Returns the problem on the finest lattice.
    pub(crate) fn problem(&self) -> &Problem {
        self.finer.first().unwrap_or(&self.level.admm.problem)
    }

    /// Returns the reports of all levels so far, the coarsest first.
    pub(crate) fn levels(&self) -> Vec<LevelReport> {
        let mut levels = self.coarser.clone();
        levels.push(self.level.report());
        levels
    }

    /// Returns the result so far, whether the solve is finished or not. On a coarse level it is prolonged to the finest
    /// lattice and certified there.
    pub(crate) fn answer(&self) -> Result<Answer> {
        let carried = self.carry_to_finest()?;
        let (iterate, incumbent) = carried.unwrap_or((
            self.level.admm.iterate.clone(),
            self.level.admm.incumbent.clone(),
        ));
        Ok(Answer {
            problem: self.problem().clone(),
            iterate,
            incumbent,
            initial_rho: self.level.admm.initial_rho,
            reason: self.reason.unwrap_or(StopReason::Cancelled),
            levels: self.levels(),
            passes: self.passes,
            creases: self.creases,
            seconds: self.seconds + self.level.admm.seconds,
        })
    }

    /// Returns the result of a finished solve, which stopped for a reason.
    pub(crate) fn into_answer(self, reason: StopReason) -> Answer {
        let levels = self.levels();
        Answer {
            seconds: self.seconds + self.level.admm.seconds,
            initial_rho: self.level.admm.initial_rho,
            problem: self.level.admm.problem,
            iterate: self.level.admm.iterate,
            incumbent: self.level.admm.incumbent,
            reason,
            levels,
            passes: self.passes,
            creases: self.creases,
        }
    }

    /// Prolongs the iterate of a coarse level to the finest lattice, with the input as the incumbent where its
    /// objective is smaller or where there was no iteration yet; `None` on the finest level.
    fn carry_to_finest(&self) -> Result<Option<(Iterate, Incumbent)>> {
        if let Some(finest) = self.finer.first()
            && self.coarser.is_empty()
            && self.level.report().iterations == 0
        {
            let start = Iterate::new(finest, self.level.admm.iterate.rho)?;
            return Ok(Some((start, Incumbent::from_input(finest))));
        }
        let mut iterate: Option<Iterate> = None;
        let mut coarse = &self.level.admm.problem;
        for fine in self.finer.iter().rev() {
            let from = iterate.as_ref().unwrap_or(&self.level.admm.iterate);
            let rho = refined_rho(from.rho, fine);
            iterate = Some(prolong(coarse, from, fine, rho)?);
            coarse = fine;
        }
        let Some(mut iterate) = iterate else {
            return Ok(None);
        };
        let certificate = iterate.certify(coarse);
        let mut incumbent = Incumbent::from_input(coarse);
        incumbent.update(&iterate.z, &certificate);
        Ok(Some((iterate, incumbent)))
    }
}
