//! Refinement of λ by what the surface of a solve leaves of the heights.

use super::noise::Noise;
use crate::fit::options::LAMBDA_RANGE;

/// Largest distance of a surface to the heights, in standard deviations of their noise, that noise explains. Above it a part
/// of the shape is lost (`benches/scenes.md`, Fewer rules).
pub(crate) const MAX_NOISE_DISTANCE: f64 = 1.3;

/// Largest residual, in units of the noise, that counts as such: an outlier, or the side of a step, says no more than that its vertex
/// is lost (`benches/scenes.md`, Residuals).
pub(crate) const MAX_RESIDUAL: f64 = 2.0;

/// Maximum number of solves by which λ is refined on the coarse lattice, and at full size (`benches/scenes.md`,
/// Rules of λ that do not pay).
const MAX_SOLVES: usize = 5;

/// Least distance to the heights, as a share of the tolerance that was asked for, at which no simpler surface is looked for
/// (`benches/scenes.md`, One constant at a time).
const MIN_TOLERANCE_SHARE: f64 = 0.86;

/// What the distance of the surface to the heights should be.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Aim {
    /// The size of the noise.
    Noise(Noise),
    /// A distance in the heights' unit: nearly this one, or at most this one.
    Distance { distance: f64, is_exact: bool },
}

/// λ of the next solve, or the λ to keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Next {
    Solve(f64),
    Keep(f64),
}

/// Refinement of λ on one lattice in progress.
#[derive(Debug, Clone)]
pub(crate) struct Refinement {
    aim: Aim,
    /// Spacing of the lattice, in those of the input's.
    spacings: f64,
    /// Number of solves so far.
    pub solves: usize,
    /// λ and residual of the best solve.
    best: Option<(f64, f64)>,
    /// λ and distance of the solve that is farthest from the heights within the tolerance, and of the nearest one beyond it.
    within: Option<(f64, f64)>,
    beyond: Option<(f64, f64)>,
}

impl Refinement {
    /// Begins a refinement on a lattice whose spacing is `spacings` times the input's.
    pub(crate) fn new(aim: Aim, spacings: f64) -> Self {
        Refinement {
            aim,
            spacings,
            solves: 0,
            best: None,
            within: None,
            beyond: None,
        }
    }

    /// Unit of the distances, the size of the noise on the lattice or the distance that is aimed at, and the largest distance that
    /// counts, in this unit.
    pub(crate) fn unit(&self) -> [f64; 2] {
        match self.aim {
            Aim::Noise(noise) => {
                let unit = (noise.white_equivalent / self.spacings).min(noise.vertex_sigma);
                [unit, MAX_RESIDUAL]
            }
            Aim::Distance { distance, .. } => [distance, f64::INFINITY],
        }
    }

    /// Takes the root mean square residual of a solve, in [`Refinement::unit`], and returns λ of the next one.
    pub(crate) fn next(&mut self, lambda: f64, residual: f64) -> Next {
        self.solves += 1;
        let next = match self.aim {
            Aim::Noise(_) => self.next_for_noise(lambda, residual),
            Aim::Distance { is_exact, .. } => self.next_for_distance(is_exact, lambda, residual),
        };
        let largest = *LAMBDA_RANGE.end();
        match next {
            Next::Solve(wanted) if wanted > largest && lambda >= largest => Next::Keep(lambda),
            Next::Solve(wanted) => Next::Solve(wanted.min(largest)),
            kept => kept,
        }
    }

    /// Raises λ where a part of the shape is lost, as long as the residual falls.
    fn next_for_noise(&mut self, lambda: f64, residual: f64) -> Next {
        if let Some((best, least)) = self.best
            && residual >= least
        {
            return Next::Keep(best);
        }
        self.best = Some((lambda, residual));
        match residual > MAX_NOISE_DISTANCE && self.solves < MAX_SOLVES {
            true => Next::Solve(nearer(lambda, residual)),
            false => Next::Keep(lambda),
        }
    }

    /// Looks for the λ at which the distance is nearly the one aimed at; unless it is exact, a smaller one does as well.
    fn next_for_distance(&mut self, is_exact: bool, lambda: f64, distance: f64) -> Next {
        let distance = distance.max(1e-6);
        let is_within = distance <= 1.0;
        let side = if is_within {
            &mut self.within
        } else {
            &mut self.beyond
        };
        *side = Some((lambda, distance));
        if is_within && (!is_exact || distance >= MIN_TOLERANCE_SHARE) {
            return Next::Keep(lambda);
        }
        if self.solves + 1 >= MAX_SOLVES {
            let (kept, _) = self.within.unwrap_or((2.0 * nearer(lambda, distance), 1.0));
            // At full size a λ that is kept is that of the solve.
            return match self.spacings > 1.0 {
                true => Next::Keep(kept),
                false if kept == lambda || self.solves >= MAX_SOLVES => Next::Keep(lambda),
                false => Next::Solve(kept),
            };
        }
        let wanted = 0.5 * (1.0 + MIN_TOLERANCE_SHARE);
        Next::Solve(match (self.within, self.beyond) {
            (Some((large, near)), Some((small, far))) => {
                let share = (far / wanted).ln() / (far / near).ln();
                small * (large / small).powf(share.clamp(0.1, 0.9))
            }
            _ => nearer(lambda, distance / wanted),
        })
    }
}

/// Returns the λ at which the distance to the heights, now `distance` times the one aimed at, is about that: it falls with the
/// square root of λ.
fn nearer(lambda: f64, distance: f64) -> f64 {
    lambda * distance.powi(2).clamp(1e-3, 1e3)
}
