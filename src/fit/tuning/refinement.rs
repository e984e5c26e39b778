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

impl Aim {
    /// Unit of the distances on a lattice whose spacing is `spacings` times the input's, the size of the noise there or the distance
    /// that is aimed at, and the largest distance that counts, in this unit.
    fn unit(self, spacings: f64) -> [f64; 2] {
        match self {
            Aim::Noise(noise) => {
                let unit = (noise.white_equivalent / spacings).min(noise.vertex_sigma);
                [unit, MAX_RESIDUAL]
            }
            Aim::Distance { distance, .. } => [distance, f64::INFINITY],
        }
    }

    /// Least distance that will do, the one that is aimed at, and the largest one that will do, in [`Aim::unit`].
    fn range(self) -> [f64; 3] {
        let between = 0.5 * (1.0 + MIN_TOLERANCE_SHARE);
        match self {
            Aim::Noise(_) => [0.0, 1.0, MAX_NOISE_DISTANCE],
            Aim::Distance { is_exact: true, .. } => [MIN_TOLERANCE_SHARE, between, 1.0],
            Aim::Distance { .. } => [0.0, between, 1.0],
        }
    }
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
    solves: usize,
    /// λ and distance of the solve that is farthest from the heights of those near enough, and of the nearest one beyond them.
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
            within: None,
            beyond: None,
        }
    }

    /// Unit of the distances, and the largest distance that counts, in this unit.
    pub(crate) fn unit(&self) -> [f64; 2] {
        self.aim.unit(self.spacings)
    }

    /// Takes the root mean square distance of a solve to the heights, in [`Refinement::unit`], and returns λ of the next one.
    pub(crate) fn next(&mut self, lambda: f64, distance: f64) -> Next {
        self.solves += 1;
        let distance = distance.max(1e-6);
        let [least, wanted, most] = self.aim.range();
        let is_within = distance <= most;
        let side = match is_within {
            true => &mut self.within,
            false => &mut self.beyond,
        };
        *side = Some((lambda, distance));
        let largest = *LAMBDA_RANGE.end();
        if is_within && distance >= least || !is_within && lambda >= largest {
            return Next::Keep(lambda);
        }
        // It falls with the square root of λ.
        let nearer = lambda * (distance / wanted).powi(2).clamp(1e-3, 1e3);
        if self.solves + 1 >= MAX_SOLVES {
            let kept = self.within.map_or(2.0 * nearer, |(lambda, _)| lambda);
            // At full size a λ that is kept is that of the solve.
            return match self.spacings > 1.0 {
                true => Next::Keep(kept.min(largest)),
                false if kept == lambda || self.solves >= MAX_SOLVES => Next::Keep(lambda),
                false => Next::Solve(kept.min(largest)),
            };
        }
        let next = match (self.within, self.beyond) {
            (Some((large, near)), Some((small, far))) => {
                let share = (far / wanted).ln() / (far / near).ln();
                small * (large / small).powf(share.clamp(0.1, 0.9))
            }
            _ => nearer,
        };
        Next::Solve(next.min(largest))
    }
}
