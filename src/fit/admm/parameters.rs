//! Parameters of ADMM on one level of the multigrid hierarchy.

use super::certificate::Certificate;
use crate::fit::options::{DEFAULT_GAP, Energy, Options, Schedule};

/// Parameters of ADMM on one multigrid level: the schedule that it follows, and when it stops.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AdmmParameters {
    pub(super) schedule: Schedule,
    /// Relative duality gap at which ADMM stops.
    pub(super) gap: f64,
    pub(super) max_iterations: usize,
    /// Maximum number of ADMM iterations on the finest level.
    max_finest_iterations: usize,
    /// Whether this level's lattice is not the finest one.
    pub(super) is_coarse: bool,
    /// Whether the problem is that of a mesh, not of a lattice.
    pub(super) is_mesh: bool,
    /// Whether the penalty weights are computed anew from the current surface's normals ([`Energy::SecondForm`]).
    pub(super) follows_normals: bool,
}

/// Default of the maximum number of ADMM iterations on all levels.
const DEFAULT_MAX_ITERATIONS: usize = 20_000;

/// Maximum number of ADMM iterations on the finest level where neither it nor a smaller gap than the default is asked for
/// (`benches/choices.md`, Jumps).
const MAX_FINEST_ITERATIONS: usize = 400;

/// Minimum number of interior vertices of a coarse multigrid level: a smaller lattice saves nothing
/// (`benches/choices.md`, Schedule by ablation).
const MIN_COARSE_VERTICES: usize = 500;

/// Relative duality gap at which ADMM stops on coarse levels, unless a larger one is asked for: their lattice differs
/// from the fine one by more than that (`benches/choices.md`, Schedule by ablation).
const MIN_COARSE_GAP: f64 = 0.01;

/// Relative duality gap at which ADMM stops on coarse levels of a mesh, unless a larger one is asked for: their clusters
/// of vertices differ from the mesh by more than those of a lattice (`benches/whole.md`).
const MIN_COARSE_MESH_GAP: f64 = 0.05;

/// Maximum number of ADMM iterations on a coarse level (`benches/choices.md`): more would save the finer level less
/// than they cost.
const MAX_COARSE_ITERATIONS: usize = 200;

/// Ratio of a warm start's duality gap to the square root of the requested gap above which a solve from coarse levels
/// is a better start (`benches/choices.md`).
const WARM_START_MAX_GAP_FACTOR: f64 = 3.0;

impl AdmmParameters {
    /// Takes the parameters of the finest level from the solve's options.
    pub(crate) fn new(options: &Options) -> Self {
        AdmmParameters {
            schedule: options.schedule,
            gap: options.gap_or_default(),
            max_iterations: options.max_iterations.unwrap_or(DEFAULT_MAX_ITERATIONS),
            max_finest_iterations: match (options.max_iterations, options.schedule) {
                (None, Schedule::Default) if options.gap_or_default() >= DEFAULT_GAP => {
                    MAX_FINEST_ITERATIONS
                }
                _ => usize::MAX,
            },
            is_coarse: false,
            is_mesh: false,
            follows_normals: options.energy_or_default() == Energy::SecondForm,
        }
    }

    /// Returns these parameters for the problem of a mesh.
    pub(crate) fn for_mesh(self) -> Self {
        AdmmParameters {
            is_mesh: true,
            ..self
        }
    }

    /// Returns the parameters of a coarse level or of the finest one, after `iterations_done` iterations on other
    /// levels.
    pub(crate) fn on_level(&self, is_coarse: bool, iterations_done: usize) -> Self {
        let left = self.max_iterations.saturating_sub(iterations_done);
        let (gap, max_iterations) = match is_coarse {
            true => (
                self.gap.max(match self.is_mesh {
                    true => MIN_COARSE_MESH_GAP,
                    false => MIN_COARSE_GAP,
                }),
                left.min(MAX_COARSE_ITERATIONS),
            ),
            false => (self.gap, left.min(self.max_finest_iterations)),
        };
        AdmmParameters {
            gap,
            max_iterations,
            is_coarse,
            ..*self
        }
    }

    /// Returns whether a lattice with `interior` interior vertices is worth a multigrid level of its own.
    pub(crate) fn wants_level(&self, interior: usize) -> bool {
        self.schedule == Schedule::Default && interior >= MIN_COARSE_VERTICES
    }

    /// Returns whether a warm start, given by its certificate, is so far from the optimum that a solve from coarse
    /// levels is a better start.
    pub(crate) fn is_far(&self, start: &Certificate) -> bool {
        let objective = start.objective();
        let gap = (objective - start.dual_bound) / objective;
        gap.is_nan() || gap > WARM_START_MAX_GAP_FACTOR * self.gap.sqrt()
    }

    /// Returns whether this ADMM iteration is the last one allowed.
    pub(super) fn is_last(&self, iteration: usize) -> bool {
        iteration >= self.max_iterations
    }
}
