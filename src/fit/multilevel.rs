//! One connected part: from its coarsest lattice to its finest, and through the
//! reweighted passes there.

use std::sync::Arc;

use super::admm::best::Best;
use super::admm::schedule::Plan;
use super::border_load::load_border;
use super::energy::creases::Creases;
use super::heightfields::{Level, Problem, State};
use super::linear::cg::ConjugateGradients;
use super::options::{Bending, Border, Energy, Options};
use super::prolong::prolong;
use super::report::{LevelReport, Seconds, StopReason};
use crate::error::Result;
use crate::lattice::domain::Domain;

/// What a step of setting a level up costs, in conjugate-gradient iterations on it.
pub(crate) const SET_UP: usize = 10;

#[derive(Debug, Clone)]
pub(crate) struct Multilevel {
    /// The level under way; the finest one at the end.
    level: Level,
    /// The problems of the finer levels, the finest first.
    finer: Vec<Problem>,
    /// The start of the next one of them, once the level under way is done, and then the system of
    /// its z-steps.
    carried: Option<(State, Option<ConjugateGradients>)>,
    /// The domains of all lattices, the finest first.
    domains: Vec<Arc<Domain>>,
    /// The levels done, the coarsest first.
    coarser: Vec<LevelReport>,
    plan: Plan,
    /// Reweighted passes done and still to come.
    passes: usize,
    passes_left: usize,
    /// Those at creases: the radius, and what the last one was about.
    crease_radius: Option<f64>,
    /// Of a border that is yet to be loaded: the radius that says how far it straightens.
    loads_within: Option<f64>,
    creases: Creases,
    /// Whether all that is left has begun.
    ends: bool,
    seconds: Seconds,
    reason: Option<StopReason>,
}

/// What is kept of a component that is done: its surface, and where to go on from.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    pub problem: Problem,
    pub state: State,
    pub best: Best,
    /// The penalty at the start.
    pub first_rho: f64,
    pub reason: StopReason,
    pub levels: Vec<LevelReport>,
    pub passes: usize,
    pub creases: Creases,
    pub seconds: Seconds,
}

impl Multilevel {
    /// From its first level, and a reason to stop that at once.
    pub(crate) fn new(
        level: Level,
        reason: Option<StopReason>,
        finer: Vec<Problem>,
        domains: Vec<Arc<Domain>>,
        plan: Plan,
        options: &Options,
    ) -> Result<Self> {
        let (crease_radius, passes_left) = match options.energy_or_default() {
            Energy::Huber => {
                let Bending { crease_radius, .. } = Bending::SMOOTH.within(options);
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
            plan,
            passes: 0,
            passes_left,
            crease_radius,
            loads_within: (options.border_or_default() == Border::Loaded)
                .then(|| Bending::SMOOTH.within(options).bend_radius),
            creases: Creases::default(),
            ends: false,
            seconds: Seconds::default(),
            reason: None,
        };
        if let Some(reason) = reason {
            multilevel.finish_level(reason)?;
        }
        Ok(multilevel)
    }

    /// Runs until `left` conjugate-gradient iterations are used up or it is
    /// done; then tells why.
    pub(crate) fn advance(&mut self, left: &mut usize) -> Result<Option<StopReason>> {
        while *left > 0 && self.reason.is_none() {
            if let Some((state, cg)) = self.carried.take() {
                *left = left.saturating_sub(SET_UP);
                match (cg, self.finer.last()) {
                    (None, Some(fine)) => {
                        let domains = &self.domains[self.finer.len() - 1..];
                        let cg = ConjugateGradients::new(fine, domains, state.rho)?;
                        self.carried = Some((state, Some(cg)));
                    }
                    (Some(cg), _) => self.enter_level(state, cg)?,
                    (None, None) => (),
                }
            } else if let Some(reason) = self.level.advance(left)? {
                self.finish_level(reason)?;
            }
        }
        Ok(self.reason)
    }

    /// Goes on to the finer level, in steps of their own, or to further passes, as long as they have
    /// nothing to do.
    fn finish_level(&mut self, mut reason: StopReason) -> Result<()> {
        if let Some(fine) = self.finer.last() {
            let rho = self.plan.finer_rho(self.level.state.rho, fine);
            let state = prolong(&self.level.problem, &self.level.state, fine, rho)?;
            self.carried = Some((state, None));
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
                    if !creases.is_worth() && !loaded {
                        break;
                    }
                    let next = self.level.begin_pass_at_creases(loaded)?;
                    // A pass for the border alone is none at creases.
                    if creases.is_worth() {
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
        if !self.ends && self.level.begin_reduction(reason)? {
            self.ends = true;
            return Ok(());
        }
        self.reason = Some(reason);
        Ok(())
    }

    /// Loads the border, once.
    fn load_border(&mut self) -> Result<bool> {
        let Level { problem, state, .. } = &mut self.level;
        match self.loads_within.take() {
            Some(radius) => load_border(problem, state, radius),
            None => Ok(false),
        }
    }

    /// Begins with the next finer level.
    fn enter_level(&mut self, state: State, cg: ConjugateGradients) -> Result<()> {
        let Some(fine) = self.finer.pop() else {
            return Ok(());
        };
        self.coarser.push(self.level.report());
        self.seconds = self.seconds + self.level.seconds;
        let done = self.coarser.iter().map(|level| level.iterations).sum();
        let plan = self.plan.on_level(!self.finer.is_empty(), done);
        // Levels take about as many iterations as the one before.
        let next_climb = 2 * self.level.report().iterations / 3;
        let may_be_affine = self.level.best.affine;
        let (level, stop) = Level::new(fine, state, cg, plan, next_climb, may_be_affine)?;
        self.level = level;
        match stop {
            Some(reason) => self.finish_level(reason),
            None => Ok(()),
        }
    }

    /// Why it stopped, if it has.
    pub(crate) fn reason(&self) -> Option<StopReason> {
        self.reason
    }

    /// How many finer levels are still to come.
    pub(crate) fn levels_left(&self) -> usize {
        self.finer.len()
    }

    /// The level under way.
    pub(crate) fn level(&self) -> &Level {
        &self.level
    }

    /// The problem on the finest lattice.
    pub(crate) fn problem(&self) -> &Problem {
        self.finer.first().unwrap_or(&self.level.problem)
    }

    /// The levels that were worked on, the coarsest first.
    pub(crate) fn levels(&self) -> Vec<LevelReport> {
        let mut levels = self.coarser.clone();
        levels.push(self.level.report());
        levels
    }

    /// What is there, whether it is done or not. From a coarse level it is
    /// carried to the finest lattice and certified there.
    pub(crate) fn answer(&self) -> Result<Answer> {
        let carried = self.carry_to_finest()?;
        let (state, best) = carried.unwrap_or((self.level.state.clone(), self.level.best.clone()));
        Ok(Answer {
            problem: self.problem().clone(),
            state,
            best,
            first_rho: self.level.first_rho,
            reason: self.reason.unwrap_or(StopReason::Cancelled),
            levels: self.levels(),
            passes: self.passes,
            creases: self.creases,
            seconds: self.seconds + self.level.seconds,
        })
    }

    /// The same, of one that is done.
    pub(crate) fn into_answer(self, reason: StopReason) -> Answer {
        let levels = self.levels();
        Answer {
            seconds: self.seconds + self.level.seconds,
            first_rho: self.level.first_rho,
            problem: self.level.problem,
            state: self.level.state,
            best: self.level.best,
            reason,
            levels,
            passes: self.passes,
            creases: self.creases,
        }
    }

    /// A coarse level's iterate on the finest lattice, or the input if that is better, or if there
    /// has been no iteration yet.
    fn carry_to_finest(&self) -> Result<Option<(State, Best)>> {
        if let Some(finest) = self.finer.first()
            && self.coarser.is_empty()
            && self.level.report().iterations == 0
        {
            let start = State::new(finest, self.level.state.rho)?;
            return Ok(Some((start, Best::of_input(finest))));
        }
        let mut state: Option<State> = None;
        let mut coarse = &self.level.problem;
        for fine in self.finer.iter().rev() {
            let from = state.as_ref().unwrap_or(&self.level.state);
            let rho = self.plan.finer_rho(from.rho, fine);
            state = Some(prolong(coarse, from, fine, rho)?);
            coarse = fine;
        }
        let Some(mut state) = state else {
            return Ok(None);
        };
        let certificate = state.certify(coarse);
        let mut best = Best::of_input(coarse);
        best.take(&state.z, &certificate);
        Ok(Some((state, best)))
    }
}
