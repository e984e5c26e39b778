//! The multilevel solve of one linearised problem of a mesh: from clusters of its vertices to the vertices themselves.

use std::sync::Arc;

use super::clusters::Clusters;
use super::edge_load::load_border;
use super::interpolation::interpolation;
use super::level_transfer::{StencilMatrices, add_correction, restrict};
use super::linearisation::Linearisation;
use super::options::MeshOptions;
use super::rho_shares::set_rho_shares;
use super::smooth_regions::SmoothRegions;
use crate::error::{Result, try_filled};
use crate::fit::admm::default_rho::rho_for_spacing;
use crate::fit::admm::iterate::Iterate;
use crate::fit::admm::parameters::AdmmParameters;
use crate::fit::admm::solver::{AdmmSolver, initial_rho};
use crate::fit::energy::moment_load::bearing;
use crate::fit::energy::spectral_penalty::HuberParameters;
use crate::fit::operator::sparse::SparseOperator;
use crate::fit::operator::sparse::gradients::SparseGradients;
use crate::fit::operator::sparse::matrix::SparseMatrix;
use crate::fit::report::{Seconds, StopReason};
use crate::math::index::NO_INDEX;
use crate::math::sym2::Sym2;

/// Minimum number of vertices of a level that is made coarser (`benches/whole.md`).
const MIN_COARSENED_VERTICES: usize = 4000;

/// Minimum ratio of the vertices of a level to those of the next coarser one at which that saves time.
const MIN_COARSENING_RATIO: f64 = 2.0;

/// Minimum number of vertices of a level whose z-steps are V-cycles. On smaller levels they save up to a third of the time, but
/// surfaces can be up to 1.5 times as far off (`benches/whole.md`).
const MIN_V_CYCLE_VERTICES: usize = 100_000;

/// Number of ADMM iterations of a level before dual ascent is tried: the start of a level is farther from its optimum than
/// a gap that ends the solve.
const FIRST_ASCENT_ITERATION: usize = 1;

/// Ratio of ρ in spacings at the start of a level to that at the end of the next coarser one.
const RHO_SPACING_RATIO: f64 = 2.0;

/// Result of the linearisation before: its dual and Hessians, the smooth regions of its surface, and its ρ.
pub(super) struct WarmStart {
    /// Dual and Hessian at each stencil of the mesh.
    pub matrices: StencilMatrices,
    pub sides: SmoothRegions,
    pub rho: f64,
}

/// Solve of one linearised problem, level by level from the coarsest.
#[derive(Debug, Clone)]
pub(super) struct MeshLevels {
    /// Levels that are not solved yet and the one that is being solved, the finest first.
    levels: Vec<MeshLevel>,
    pub solver: AdmmSolver<SparseOperator>,
    /// Whether each vertex of the mesh is on a crease; empty if none is.
    creased: Vec<bool>,
    parameters: AdmmParameters,
    /// Number of stencils on creases of the mesh.
    pub creases: usize,
    /// Numbers of ADMM and of conjugate-gradient iterations on the coarser levels.
    coarser: [usize; 2],
    seconds: Seconds,
}

/// One level of the solve of a linearised problem.
#[derive(Debug, Clone)]
struct MeshLevel {
    linear: Linearisation,
    /// Dual and Hessian at each stencil that the solve of the level starts from, without corrections.
    start: StencilMatrices,
    /// Clusters of the level's vertices, if there is a coarser level.
    clusters: Option<Clusters>,
    /// Interpolations between the unknowns of this level and the coarser ones, the finest first.
    interpolations: Vec<Arc<SparseMatrix<f32>>>,
    loaded: bool,
}

impl MeshLevels {
    /// Sets up the levels of a linearised problem, and starts on the coarsest one. Also returns a reason to stop at once,
    /// if there is one.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(
        linear: Linearisation,
        warm: Option<&WarmStart>,
        options: &MeshOptions,
        parameters: AdmmParameters,
    ) -> Result<(Self, Option<StopReason>)> {
        let sides = warm.map(|warm| &warm.sides);
        let is_creased = |v: u32| sides.is_some_and(|s| s.is_on_crease(v as usize));
        let start = match warm {
            Some(warm) => warm.matrices.clone(),
            None => zero_matrices(&linear)?,
        };
        let finest = linear.spacing;
        let has_v_cycles = linear.vertices.len() >= MIN_V_CYCLE_VERTICES;
        let mut levels = vec![MeshLevel::new(linear, start)];
        while let Some(level) = levels.last_mut()
            && level.linear.vertices.len() >= MIN_COARSENED_VERTICES
        {
            let vertices = &level.linear.vertices;
            let clusters = Clusters::new(vertices)?;
            if (clusters.seeds.len() as f64) * MIN_COARSENING_RATIO > vertices.len() as f64 {
                break;
            }
            let bends = HuberParameters::from_options(&options.common());
            let lambda = level.linear.problem.lambda;
            let Ok(linear) = Linearisation::new(clusters.coarsen(vertices), bends, lambda, sides)
            else {
                break;
            };
            let fine = &level.linear;
            let start = restrict(fine, &level.start, &clusters, &linear, &is_creased)?;
            let to_finer =
                has_v_cycles.then(|| Arc::new(interpolation(&linear, &clusters, fine, sides)));
            level.clusters = Some(clusters);
            for level in &mut levels {
                level.interpolations.extend(to_finer.clone());
            }
            levels.push(MeshLevel::new(linear, start));
        }
        let mut creases = 0;
        if let Some(warm) = warm {
            for level in levels.iter_mut().rev() {
                creases = level.weigh_creases(&warm.sides, options)?;
            }
        }
        let creased = match sides {
            Some(_) => (0..levels[0].linear.vertices.len() as u32)
                .map(is_creased)
                .collect(),
            None => Vec::new(),
        };
        let coarsest = &levels[levels.len() - 1];
        let problem = &coarsest.linear.problem;
        let rho = match warm {
            Some(warm) => rho_for_spacing(warm.rho, finest, problem),
            None => initial_rho(&parameters, problem),
        };
        let on_level = parameters.on_level(levels.len() > 1, 0);
        let z = coarsest.linear.start();
        let (solver, reason) = coarsest.solver(&z, &coarsest.start, rho, on_level)?;
        let mut all = MeshLevels {
            levels,
            solver,
            creased,
            parameters,
            creases,
            coarser: [0; 2],
            seconds: Seconds::default(),
        };
        let reason = match reason {
            Some(reason) => all.finish_level(reason)?,
            None => None,
        };
        Ok((all, reason))
    }

    /// Returns the linearisation about the mesh itself.
    pub(super) fn finest(&self) -> &Linearisation {
        &self.levels[0].linear
    }

    /// Returns the numbers of ADMM and of conjugate-gradient iterations so far, on all levels.
    pub(super) fn iterations(&self) -> [usize; 2] {
        let own = self.solver.report();
        let [iterations, cg_iterations] = self.coarser;
        [
            iterations + own.iterations,
            cg_iterations + own.cg_iterations,
        ]
    }

    /// Returns the time that the solve of all levels took so far.
    pub(super) fn seconds(&self) -> Seconds {
        self.seconds + self.solver.admm.seconds
    }

    /// Continues until `left` conjugate-gradient iterations are used up, or until the finest level is solved; then returns
    /// the reason why it stopped.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn advance(&mut self, left: &mut usize) -> Result<Option<StopReason>> {
        while *left > 0 {
            if let Some(reason) = self.solver.advance(left)?
                && let Some(reason) = self.finish_level(reason)?
            {
                return Ok(Some(reason));
            }
        }
        Ok(None)
    }

    /// Interpolates the unknowns so far to the finest level.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn prolong_to_finest(&mut self) -> Result<()> {
        while self.levels.len() > 1 {
            self.finish_level(StopReason::Cancelled)?;
        }
        Ok(())
    }

    /// Goes on to the next finer level after one has been solved; returns `reason` if that was the finest.
    fn finish_level(&mut self, mut reason: StopReason) -> Result<Option<StopReason>> {
        while self.levels.len() > 1 {
            let Some(coarse) = self.levels.pop() else {
                break;
            };
            self.coarser = self.iterations();
            self.seconds = self.seconds();
            let iterate = &self.solver.admm.iterate;
            let problem = &self.solver.admm.problem;
            let change: StencilMatrices = (coarse.start.iter().enumerate())
                .map(|(stencil, [dual, hessian])| {
                    let (new, bend) = iterate.matrices(problem, stencil);
                    [new - *dual, bend - *hessian]
                })
                .collect();
            let creased = &self.creased;
            let is_creased = |v: u32| creased.get(v as usize).is_some_and(|creased| *creased);
            let fine = &self.levels[self.levels.len() - 1];
            let Some(clusters) = &fine.clusters else {
                break;
            };
            let (mut z, mut matrices) = (fine.linear.start(), fine.start.clone());
            add_correction(
                &coarse.linear,
                (&iterate.z, &change),
                clusters,
                &fine.linear,
                (&mut z, &mut matrices),
                &is_creased,
            )?;
            let rho = RHO_SPACING_RATIO * iterate.rho;
            let rho = rho_for_spacing(rho, coarse.linear.spacing, &fine.linear.problem);
            let on_level = self
                .parameters
                .on_level(self.levels.len() > 1, self.coarser[0]);
            let (solver, next) = fine.solver(&z, &matrices, rho, on_level)?;
            self.solver = solver;
            match next {
                Some(next) => reason = next,
                None => return Ok(None),
            }
        }
        Ok(Some(reason))
    }

    /// Returns the result of the solve as the start of the next linearisation, which has stencils about the same vertices
    /// or fewer of them, and the regions `sides`.
    pub(super) fn warm_start(
        &self,
        next: &Linearisation,
        sides: SmoothRegions,
    ) -> Result<WarmStart> {
        let mut matrices = zero_matrices(next)?;
        let (iterate, problem) = (&self.solver.admm.iterate, &self.solver.admm.problem);
        for (pair, centre) in matrices.iter_mut().zip(&next.centres) {
            let from = self.finest().about[*centre as usize];
            if from != NO_INDEX {
                *pair = iterate.matrices(problem, from as usize).into();
            }
        }
        Ok(WarmStart {
            matrices,
            sides,
            rho: iterate.rho,
        })
    }
}

impl MeshLevel {
    fn new(linear: Linearisation, start: StencilMatrices) -> Self {
        MeshLevel {
            linear,
            start,
            clusters: None,
            interpolations: Vec::new(),
            loaded: false,
        }
    }

    /// Reduces the weights of stencils on creases, and loads creases and border with the moments of the dual. Returns the
    /// number of stencils on creases.
    fn weigh_creases(&mut self, sides: &SmoothRegions, options: &MeshOptions) -> Result<usize> {
        let linear = &mut self.linear;
        let start = linear.start();
        let source = &linear.vertices.source;
        let known: Vec<bool> = (linear.centres.iter())
            .map(|v| sides.is_on_crease(source[*v as usize] as usize))
            .collect();
        let problem = &mut linear.problem;
        let creases = problem.reweight_creases(&start, options.crease_radius)?;
        let count = creases.vertices + problem.free_creases(&known);
        set_rho_shares(problem);
        let moments: Vec<Sym2> = (self.start.iter())
            .map(|[dual, hessian]| match options.is_bend(*dual) {
                true => bearing(*dual, *hessian),
                false => Sym2::default(),
            })
            .collect();
        self.loaded = load_border(linear, &moments, options, &known)?;
        Ok(count)
    }

    /// Starts ADMM on the level, at the unknowns `z` and with dual and Hessian at each stencil. Also returns a reason to
    /// stop at once, if there is one.
    fn solver(
        &self,
        z: &[f64],
        matrices: &StencilMatrices,
        rho: f64,
        parameters: AdmmParameters,
    ) -> Result<(AdmmSolver<SparseOperator>, Option<StopReason>)> {
        let problem = self.linear.problem.clone();
        let mut iterate = Iterate::new(&problem, rho)?;
        iterate.z.copy_from_slice(z);
        for (stencil, pair) in matrices.iter().enumerate() {
            iterate.set_matrices_with_rho_share(&problem, stencil, *pair);
        }
        let interpolations = match self.linear.vertices.len() >= MIN_V_CYCLE_VERTICES {
            true => &self.interpolations[..],
            false => &[],
        };
        let solver = SparseGradients::with_v_cycle(&problem, rho, interpolations)?;
        let first = FIRST_ASCENT_ITERATION;
        let (solver, reason) = AdmmSolver::new(problem, iterate, solver, parameters, first, false)?;
        // A load is a tiny part of the energy: the gap says nothing before the surface has followed it.
        Ok((solver, reason.filter(|_| !self.loaded)))
    }
}

/// A dual and a Hessian of 0 at each stencil of a linearisation.
pub(super) fn zero_matrices(linear: &Linearisation) -> Result<StencilMatrices> {
    try_filled(
        "Hessians and dual",
        linear.centres.len(),
        [Sym2::default(); 2],
    )
}
