//! λ and the penalty that follow from the noise of the heights, without a solve.

use super::noise::{MIN_NOISE_SHARE, Noise, height_range, height_spread};
use super::refinement::Aim;
use crate::error::Result;
use crate::fit::input::Input;
use crate::fit::options::{Energy, HuberOptions, LAMBDA_RANGE, Lambda, Options};
use crate::fit::report::{LambdaChoice, LambdaReason};

/// Product `λ σ h √A` under noise of standard deviation σ, of which `A` vertices share a value, where h is the spacing, in normalised
/// coordinates. The best λ is about there (`benches/scenes.md`, One constant at a time).
const LAMBDA_NOISE: f64 = 8.0;

/// λ of an input that is free of noise.
const WITHOUT_NOISE: Lambda = Lambda::Big;

/// Maximum standard deviation of smooth noise of heights that no camera has measured, as a share of their
/// [spread](InputStatistics::spread). What looks like larger noise may be the shape of a terrain, which is alike at every scale
/// (`benches/scenes.md`, Terrain).
const MAX_SMOOTH_NOISE_SHARE: f64 = 0.042;

/// Root mean square distance that a surface may have from heights without noise, as a share of their range
/// (`benches/scenes.md`, One constant at a time).
const DEFAULT_TOLERANCE: f64 = 0.002;

/// Noise and scale of an input, known before its solve.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InputStatistics {
    pub scale: f64,
    pub noise: Option<Noise>,
    /// Difference between the highest and the lowest height.
    pub range: f64,
    /// Range of evenly distributed heights with the same standard deviation, which a few summits do not change.
    pub spread: f64,
    /// Whether a camera has measured the heights.
    pub is_measured: bool,
}

impl InputStatistics {
    pub(crate) fn of(input: &Input, options: &Options) -> Result<Self> {
        let is_auto = options.lambda_or_default() == Lambda::Auto;
        let wanted = is_auto || options.energy_or_default() == Energy::Huber;
        Ok(InputStatistics {
            range: height_range(input),
            spread: height_spread(input),
            is_measured: input.is_measured,
            scale: options.normalization.factor(&input.field),
            noise: if wanted {
                // Beside a λ that is given, noise only makes the penalty flatter: a shape is not lost to it.
                Noise::from_input(input, input.is_measured || !is_auto)?
            } else {
                None
            },
        })
    }
}

/// Initial options with the initial λ, the reason for it, and what coarse solves aim at: a λ from the size of the noise,
/// [`WITHOUT_NOISE`] for an input without noise, or [`Lambda::Medium`] where the noise cannot be measured.
pub(crate) fn initial_options(
    options: &Options,
    InputStatistics {
        noise,
        scale,
        range,
        spread,
        is_measured,
    }: InputStatistics,
) -> (Options, LambdaChoice, Option<Aim>) {
    let mut choice = LambdaChoice {
        sigma: noise.map(|noise| noise.sigma),
        step: noise.and_then(|noise| noise.step),
        correlation_length: noise.map_or(0.0, |noise| noise.correlation_length),
        ..LambdaChoice::default()
    };
    let mut aim = noise.map(Aim::Noise);
    let lambda = noise.map(|noise| LAMBDA_NOISE / (noise.product * scale * scale));
    let is_noise = noise.is_some_and(|noise| noise.white_equivalent > MIN_NOISE_SHARE * range);
    let lambda = match lambda {
        None => Lambda::Medium,
        Some(lambda) if is_noise && lambda <= *LAMBDA_RANGE.end() => {
            choice.reason = LambdaReason::Noise;
            Lambda::Value(lambda.max(*LAMBDA_RANGE.start()))
        }
        Some(_) => {
            choice.reason = LambdaReason::NoNoise;
            WITHOUT_NOISE
        }
    };
    let is_shape = noise.is_some_and(|noise| {
        noise.is_correlated() && !is_measured && noise.sigma > MAX_SMOOTH_NOISE_SHARE * spread
    });
    choice.ambiguous = is_shape;
    let tolerance = match options.tolerance {
        Some(tolerance) => {
            choice.reason = LambdaReason::Tolerance;
            Some(tolerance.distance(range))
        }
        None if choice.reason == LambdaReason::NoNoise || is_shape => {
            Some(DEFAULT_TOLERANCE * range)
        }
        None => None,
    };
    if let Some(distance) = tolerance {
        choice.tolerance = tolerance.filter(|distance| *distance > 0.0);
        let is_exact = options.tolerance.is_some();
        aim = choice
            .tolerance
            .map(|_| Aim::Distance { distance, is_exact });
    }
    (options.lambda(lambda), choice, aim)
}

/// Options with the default Huber parameters filled in where none are given, kept from following noise: flatness grows in
/// proportion to the ratio of λ to the λ that suits the noise, up to the nuclear norm, which has no crease passes.
pub(crate) fn with_huber_defaults(options: &Options, noise: Option<Noise>, scale: f64) -> Options {
    let noise_to_signal = noise.map_or(0.0, |noise| {
        options.lambda_or_default().value() * noise.product * scale * scale / LAMBDA_NOISE
    });
    let flatness = HuberOptions::SMOOTH.flatness * noise_to_signal.max(1.0);
    let quiet = HuberOptions {
        flatness: flatness.min(1.0),
        ..HuberOptions::SMOOTH
    };
    let mut out = quiet.within(options).of(options);
    if flatness >= 1.0 {
        out.crease_passes.get_or_insert(0);
    }
    out
}
