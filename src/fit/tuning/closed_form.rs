//! λ and the penalty that follow from the noise of the heights, without a solve.

use super::noise::Noise;
use crate::error::Result;
use crate::fit::input::Input;
use crate::fit::options::{Energy, HuberOptions, Lambda, Options};
use crate::fit::report::{LambdaChoice, LambdaReason};

/// Product `λ σ h` under white noise, in normalised coordinates: σ is the noise's standard deviation, h the spacing. The
/// best λ is about there.
const WHITE_LAMBDA_NOISE: f64 = 8.0;

/// Product `λ σ h √A` under correlated noise, of which `A` vertices share a value, in
/// normalised coordinates. It is larger than under white noise, since a shape beside such noise makes the noise look
/// larger than it is (`benches/scenes.md`).
const CORRELATED_LAMBDA_NOISE: f64 = 14.0;

/// Maximum λ that follows from noise. An input whose noise is so small that it asks for a larger one counts as free
/// of noise and gets [`WITHOUT_NOISE`].
const MAX_NOISE_LAMBDA: f64 = 1e9;

/// λ of an input that is free of noise.
const WITHOUT_NOISE: Lambda = Lambda::Big;

/// Ratio of `λ σ h` to [`WHITE_LAMBDA_NOISE`] above which there are no crease passes, since these would make creases
/// of noise.
const LOUD_NOISE_RATIO: f64 = 2.0;

/// Noise and scale of an input, known before its solve.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Known {
    pub scale: f64,
    pub noise: Option<Noise>,
}

impl Known {
    pub(crate) fn of(input: &Input, options: &Options) -> Result<Self> {
        let wanted = options.lambda_or_default() == Lambda::Auto
            || options.energy_or_default() == Energy::Huber;
        Ok(Known {
            scale: options.normalization.factor(&input.field),
            noise: if wanted {
                Noise::from_input(input)?
            } else {
                None
            },
        })
    }
}

/// Initial options, with the initial λ and the reason for it: a λ from the size of the noise, [`WITHOUT_NOISE`] for
/// an input without noise, or [`Lambda::Medium`] where the noise cannot be measured.
pub(crate) fn initial_options(
    options: &Options,
    noise: Option<Noise>,
    scale: f64,
) -> (Options, LambdaChoice) {
    let mut choice = LambdaChoice {
        reason: LambdaReason::Unknown,
        sigma: noise.map(|noise| noise.sigma),
        step: noise.and_then(|noise| noise.step),
        correlation_length: noise.map_or(0.0, |noise| noise.correlation_length),
        ambiguous: noise.is_some_and(|noise| noise.ambiguous),
        merged: noise.map_or(0, |noise| noise.merged),
        residual_ratio: None,
        residual_exceeds_noise: false,
        raises: 0,
        solves: 0,
        iterations: 0,
    };
    let lambda = match noise.map(|noise| {
        let product = match noise.is_correlated() {
            true => CORRELATED_LAMBDA_NOISE,
            false => WHITE_LAMBDA_NOISE,
        };
        product / (noise.product * scale * scale)
    }) {
        None => Lambda::Medium,
        Some(lambda) if lambda <= MAX_NOISE_LAMBDA => {
            choice.reason = LambdaReason::Noise;
            Lambda::Value(lambda.max(1.0 / MAX_NOISE_LAMBDA))
        }
        Some(_) => {
            choice.reason = LambdaReason::NoNoise;
            WITHOUT_NOISE
        }
    };
    (options.lambda(lambda), choice)
}

/// Options with the default Huber parameters filled in where none are given, kept from following noise where λ is
/// large for it.
pub(crate) fn with_huber_defaults(options: &Options, noise: Option<Noise>, scale: f64) -> Options {
    let loudness = noise.map_or(0.0, |noise| {
        options.lambda_or_default().value() * noise.product * scale * scale / WHITE_LAMBDA_NOISE
    });
    at_loudness(options, HuberOptions::SMOOTH, loudness)
}

/// Penalty of [`Energy::Huber`] for a surface of unknown kind. Under correlated noise it is the nuclear norm, as any other
/// penalty would follow the noise.
pub(super) fn default_penalty(noise: Option<Noise>) -> HuberOptions {
    match noise.is_some_and(|noise| noise.merged > 0) {
        true => HuberOptions::NUCLEAR,
        false => HuberOptions::ANY,
    }
}

/// Options where no penalty is searched: those of [`initial_options`] with [`default_penalty`], and without crease passes
/// under correlated noise.
pub(crate) fn without_search(first: &Options, noise: Option<Noise>) -> Options {
    let penalty = default_penalty(noise);
    let loudness = if penalty == HuberOptions::NUCLEAR {
        f64::INFINITY
    } else {
        1.0
    };
    at_loudness(first, penalty, loudness)
}

/// Options with the parameters of `huber` where none are given, restrained so that the surface does not follow
/// noise. `loudness` is the ratio of λ to the λ that suits the noise: flatness grows in proportion to it, up to 1
/// (the nuclear norm), and above [`LOUD_NOISE_RATIO`] there are no crease passes.
fn at_loudness(options: &Options, huber: HuberOptions, loudness: f64) -> Options {
    let quiet = HuberOptions {
        flatness: (HuberOptions::SMOOTH.flatness * loudness).clamp(huber.flatness, 1.0),
        ..huber
    };
    let mut out = quiet.within(options).of(options);
    if loudness > LOUD_NOISE_RATIO {
        out.crease_passes.get_or_insert(0);
    }
    out
}
