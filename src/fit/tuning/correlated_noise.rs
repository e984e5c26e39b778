//! Standard deviation and correlation length of noise, from the curvatures that it has at several scales.
//!
//! The covariance of the noise is taken to be Gaussian, as that of white noise after a Gaussian blur:
//! `σ² exp(−d²/4ℓ²)` at the distance `d`, where `ℓ` is the blur's standard deviation. The curvature that such noise has
//! in discs of some radius follows from the coefficients of the least-squares fit, so that `σ` and `ℓ` can be fitted to
//! what was measured.

use super::curvature_scales::{CurvatureScale, Disc};

/// Largest coherence of neighbouring discs' curvatures along the rulings of noise. Bends of a shape that is not developable have a
/// coherence near 1 (`benches/scenes.md`, One constant at a time).
const MAX_COHERENCE: f64 = 0.8;

/// Largest root mean square of the logarithms of the ratios of measured noise to that of a fitted covariance that explains it
/// (`benches/scenes.md`).
const MAX_MISFIT: f64 = 0.065;

/// Minimum number of scales that a covariance explains which does not explain the smallest discs of a camera's heights: it has two
/// parameters, and two more scales are to confirm it (`benches/verdicts.md`, Smooth noise).
const MIN_LATE_SCALES: usize = 4;

/// Maximum ratio of the curvatures across the rulings to those along them where a covariance does not explain the smallest discs:
/// noise bends both ways, and terraces across their steps (`benches/verdicts.md`, Smooth noise).
const MAX_ACROSS_RATIO: f64 = 2.0;

/// Minimum ratio, or its inverse, of the second derivatives across rows and along them in the smallest discs at which noise is
/// anisotropic, as that of scan lines is.
const MIN_ANISOTROPY: f64 = 3.0;

/// Largest mean cosine between Hessians of discs side by side of noise, where no bend of a shape is seen
/// (`benches/scenes.md`, One constant at a time).
const MAX_NOISE_LIKENESS: f64 = 0.15;

/// Number of positive correlation lengths that are tried when a covariance is fitted.
const LENGTH_TRIALS: u32 = 40;

/// Minimum positive correlation length that is tried, in radii of the largest disc that is used. 0 is tried, too
/// (`benches/scenes.md`, One constant at a time).
const MIN_LENGTH_RADII: f64 = 0.02;

/// Maximum correlation length that is tried, in radii of the largest disc that is used
/// (`benches/scenes.md`, One constant at a time).
const MAX_LENGTH_RADII: f64 = 1.2;

/// Noise with a Gaussian covariance: its standard deviation and correlation length.
#[derive(Debug, Clone, Copy)]
pub(super) struct CorrelatedNoise {
    /// Standard deviation of the noise, in the heights' unit.
    pub sigma: f64,
    /// Correlation length, in spacings: the standard deviation of the Gaussian blur that makes such noise of white
    /// noise.
    pub length: f64,
    /// Standard deviation of white noise that has the same spectral density over large areas, as far as the largest discs show
    /// it.
    pub white_equivalent: f64,
    /// Whether the noise is much rougher in one direction than in the other.
    pub is_anisotropic: bool,
}

impl CorrelatedNoise {
    /// Estimates the noise of heights from their curvatures at scales from small discs to large ones; `None` if a shape
    /// hides it. A shape beside the noise adds to the curvatures of large discs, so that the covariance counts that explains the
    /// largest discs with all smaller ones.
    ///
    /// Where what is rough is noise, as in heights that a camera has measured, the covariance need not explain the smallest discs, which show the rounding to whole
    /// millimetres as well, and noise may be as smooth as the longest length that is tried, or smoother. Elsewhere that is a shape:
    /// a terrain bends more at every smaller scale, too (`benches/scenes.md`, Terrain).
    ///
    /// Noise of scan lines bends across them at every scale, as a shape does, but not alike in discs side by side: there it is
    /// measured in the direction in which it bends most.
    pub(super) fn from_scales(
        scales: &[CurvatureScale],
        discs: &[Disc],
        is_rough_noise: bool,
    ) -> Option<Self> {
        let mut scales = scales.to_vec();
        let is_anisotropic = scales.first().is_some_and(is_anisotropic);
        if is_anisotropic {
            (scales.iter_mut())
                .for_each(|scale| scale.white_equivalent = scale.white_equivalent_across);
        }
        let is_noise = |scale: &&CurvatureScale| {
            // As many discs without a common vertex as a disc has coefficients.
            scale.independent_discs(discs) >= 6.0
                && scale.coherence < MAX_COHERENCE
                && scale.white_equivalent > 0.0
        };
        let noisy = scales.iter().take_while(is_noise).count();
        let bends_both_ways = |scale: &CurvatureScale| {
            scale.white_equivalent_across <= MAX_ACROSS_RATIO * scale.white_equivalent
        };
        let found = (2..=noisy).rev().find_map(|count| {
            let late = count.saturating_sub(MIN_LATE_SCALES);
            let starts = if is_rough_noise { late + 1 } else { 1 };
            let trials = Trials::new(&scales[..count], discs);
            (0..starts)
                .filter(|first| *first == 0 || scales[*first..count].iter().all(bends_both_ways))
                .map(|first| trials.fit(first))
                .filter(|covariance| is_rough_noise || !covariance.is_smoothest)
                .find(|covariance| covariance.misfit < MAX_MISFIT)
        })?;
        Some(CorrelatedNoise {
            sigma: found.sigma,
            length: found.length,
            white_equivalent: found.sigma * found.shared_root,
            is_anisotropic,
        })
    }
}

/// Returns whether the curvatures of the smallest discs are those of anisotropic noise, which has no rulings.
fn is_anisotropic(scale: &CurvatureScale) -> bool {
    let ratio = scale.anisotropy.max(1.0 / scale.anisotropy);
    ratio > MIN_ANISOTROPY && scale.likeness < MAX_NOISE_LIKENESS
}

/// Gaussian covariance of noise, fitted to the curvatures of some scales.
struct Covariance {
    sigma: f64,
    length: f64,
    /// Whether no length that is tried is longer.
    is_smoothest: bool,
    /// Square root of the number of vertices that share one independent value of the noise, as far as the largest discs show it.
    shared_root: f64,
    /// Root mean square of the logarithms of the ratios of the measured noise to this one's.
    misfit: f64,
}

/// White noise that scales show for each correlation length that is tried, if the noise has that length.
struct Trials<'a> {
    scales: &'a [CurvatureScale],
    discs: &'a [Disc],
    /// Correlation lengths in spacings, and the largest of them that is told from longer ones.
    lengths: Vec<f64>,
    longest: f64,
    /// For each length and each scale, the logarithm of the standard deviation of the noise.
    logs: Vec<Vec<f64>>,
}

impl<'a> Trials<'a> {
    /// Makes the trials over a grid of correlation lengths, up to those that the largest discs show.
    fn new(scales: &'a [CurvatureScale], discs: &'a [Disc]) -> Self {
        let largest = scales.last().map_or(0.0, CurvatureScale::radius);
        let [shortest, longest] = [MIN_LENGTH_RADII, MAX_LENGTH_RADII].map(|radii| radii * largest);
        let step = (longest / shortest).powf(1.0 / f64::from(LENGTH_TRIALS - 1));
        let lengths = (0..LENGTH_TRIALS).map(|trial| shortest * step.powi(trial as i32));
        let lengths: Vec<f64> = [0.0].into_iter().chain(lengths).collect();
        let log = |scale: &CurvatureScale, length: f64| {
            (scale.white_equivalent / response(scale, discs, length)).ln()
        };
        Trials {
            logs: (lengths.iter())
                .map(|length| scales.iter().map(|scale| log(scale, *length)).collect())
                .collect(),
            scales,
            discs,
            lengths,
            longest: longest / step.sqrt(),
        }
    }

    /// Fits a covariance to the scales from the `first` on: least squares of the logarithms.
    fn fit(&self, first: usize) -> Covariance {
        let mut best = (f64::INFINITY, 0, 0.0);
        for (trial, logs) in self.logs.iter().enumerate() {
            let logs = &logs[first..];
            let mean = logs.iter().sum::<f64>() / logs.len() as f64;
            let squares = logs.iter().map(|log| (log - mean).powi(2)).sum::<f64>();
            let misfit = (squares / logs.len() as f64).sqrt();
            if misfit < best.0 {
                best = (misfit, trial, mean.exp());
            }
        }
        let (misfit, trial, sigma) = best;
        let length = self.lengths[trial];
        // No more of the noise is taken for granted than the largest discs show.
        let shared_root =
            (self.scales.last()).map_or(1.0, |scale| response(scale, self.discs, length));
        Covariance {
            sigma,
            length,
            is_smoothest: length > self.longest,
            shared_root,
            misfit,
        }
    }
}

/// Returns the standard deviation of white noise that has, at a scale, the same curvatures as noise of standard
/// deviation 1 with this correlation length in spacings.
fn response(scale: &CurvatureScale, discs: &[Disc], length: f64) -> f64 {
    if length == 0.0 {
        return 1.0;
    }
    let spacing = f64::from(1u32 << scale.lattice);
    let [blur, share] = blurred_by_means(length, spacing);
    let pairs = discs[scale.disc].autocorrelation.iter();
    let sum: f64 = pairs
        .map(|(distance, product)| product * (-distance / (4.0 * blur * blur)).exp())
        .sum();
    spacing * share * sum.sqrt()
}

/// Returns the correlation length of noise on a lattice that was coarsened by means over four vertices, in its spacings, and the share
/// of the standard deviation that is left there. `length` is that of the noise and `spacing` the lattice's, both in spacings of
/// the lattice before.
pub(super) fn blurred_by_means(length: f64, spacing: f64) -> [f64; 2] {
    let own = (length / spacing).powi(2);
    // Means over four vertices of a rhombus are blurred by these: their variance along an axis is a quarter of the squared spacing,
    // and that of all coarsenings `(4ᵏ − 1)/12`.
    let blurred = own + (1.0 - 1.0 / (spacing * spacing)) / 12.0;
    [blurred.sqrt(), (own / blurred).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::tuning::curvature_scales::DISC_RADII;

    fn discs() -> Vec<Disc> {
        DISC_RADII.iter().filter_map(|r| Disc::new(*r)).collect()
    }

    fn scale(lattice: usize, disc: usize) -> CurvatureScale {
        CurvatureScale {
            lattice,
            disc,
            count: 1000,
            white_equivalent: 0.0,
            white_equivalent_across: 0.0,
            coherence: 0.0,
            anisotropy: 1.0,
            likeness: 0.0,
        }
    }

    #[test]
    fn what_is_smoother_than_any_length_may_be_a_shape() {
        let discs = discs();
        let found = |length, is_rough_noise| {
            let scales = [0, 1].map(|disc| CurvatureScale {
                white_equivalent: response(&scale(0, disc), &discs, length),
                ..scale(0, disc)
            });
            CorrelatedNoise::from_scales(&scales, &discs, is_rough_noise).is_some()
        };
        assert!(found(1.5, true) && found(1.5, false));
        assert!(found(6.0, true) && !found(6.0, false));
    }

    /// Discs that are much larger than the correlation length see white noise of the same spectrum, whose variance is the integral
    /// of the correlations over the plane, `4πℓ²`, over the area of a cell; the response grows with the disc until then.
    #[test]
    fn large_discs_see_the_whole_noise() {
        let discs = discs();
        for length in [1.0, 2.5] {
            let area = 0.75f64.sqrt();
            let whole = (4.0 * std::f64::consts::PI * length * length / area).sqrt();
            let seen = response(&scale(4, 1), &discs, length) / whole;
            assert!((seen - 1.0).abs() < 0.12, "{length} {seen}");
            let mut last = 0.0;
            for lattice in 0..4 {
                let response = response(&scale(lattice, 1), &discs, length);
                assert!(
                    response > last && response < 1.1 * whole,
                    "{length} {lattice} {response} {whole}"
                );
                last = response;
            }
        }
        assert_eq!(response(&scale(2, 0), &discs, 0.0), 1.0);
    }
}
