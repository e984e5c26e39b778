//! Standard deviation and correlation length of noise, from the curvatures that it has at several scales.
//!
//! The covariance of the noise is taken to be Gaussian, as that of white noise after a Gaussian blur:
//! `σ² exp(−d²/4ℓ²)` at the distance `d`, where `ℓ` is the blur's standard deviation. The curvature that such noise has
//! in discs of some radius follows from the coefficients of the least-squares fit, so that `σ` and `ℓ` can be fitted to
//! what was measured.

use super::curvature_scales::{CurvatureScale, Disc};

/// Minimum ratio of the medians of the smaller and the larger principal curvature, in discs of one size, at which they
/// count as curvatures of noise. Isotropic noise has 0.30 to 0.34 at every scale; a developable shape beside the noise
/// lowers the ratio.
const MIN_NOISE_RATIO: f64 = 0.22;

/// Minimum ratio of the medians of the smaller and the larger principal curvature, in discs of one size, at which they
/// count as curvatures of isotropic noise without a visible shape beside it.
const MIN_ISOTROPIC_RATIO: f64 = 0.28;

/// Minimum ratio of the medians of the smaller and the larger principal curvature, in discs of one size, of noise that
/// is rougher in one direction, such as that of scan lines. It counts as noise only where its Hessians are incoherent.
const MIN_ANISOTROPIC_RATIO: f64 = 0.1;

/// Largest coherence of neighbouring Hessians of noise. Bends of a shape that is not developable have a coherence near 1.
const MAX_COHERENCE: f64 = 0.7;

/// Largest coherence of neighbouring Hessians at which they are incoherent.
const MAX_NOISE_COHERENCE: f64 = 0.15;

/// Minimum coherence (mean cosine) of neighbouring discs' Hessians that shows a shape beside noise.
const MIN_SHAPE_COHERENCE: f64 = 0.05;

/// Minimum ratio, or its inverse, of the second derivatives across rows and along them of incoherent Hessians at which the
/// noise is anisotropic.
const MIN_ANISOTROPY: f64 = 3.0;

/// Largest coherence of neighbouring Hessians of anisotropic noise, whose ratio of principal curvatures tells little.
const MAX_ANISOTROPIC_COHERENCE: f64 = 0.3;

/// Maximum radius, in spacings, of the smallest discs that show noise. What shows in larger discs only is a shape.
const MAX_FIRST_RADIUS: f64 = 4.0;

/// Minimum number of discs of a scale, of those without a common vertex, whose median curvatures are used.
const MIN_INDEPENDENT_DISCS: f64 = 5.5;

/// Number of scales, up to the largest one that is used, to which a covariance of noise is fitted.
const FITTED_SCALES: usize = 3;

/// Maximum ratio of the noise's standard deviation over large areas to the part of it that the largest disc shows.
/// Above it the fitted covariance is too uncertain to be used.
const MAX_HIDDEN_RATIO: f64 = 6.0;

/// Maximum ratio of the noise measured in larger discs to what the fitted covariance predicts there. Creases in the
/// discs raise it, smooth noise behind rough noise raises it more.
const MAX_PREDICTION_RATIO: f64 = 2.2;

/// Maximum ratio of a covariance's noise over large areas to the least one among the candidates. Of those below it the
/// one fitted to the smallest discs is taken, as these determine the correlation length best.
const MAX_LEAST_NOISE_RATIO: f64 = 1.25;

/// Number of positive correlation lengths that are tried when a covariance is fitted.
const LENGTH_TRIALS: u32 = 40;

/// Minimum positive correlation length that is tried, in radii of the largest disc that is used. 0 is tried, too.
const MIN_LENGTH_RADII: f64 = 0.02;

/// Maximum correlation length that is tried, in radii of the largest disc that is used.
const MAX_LENGTH_RADII: f64 = 1.2;

/// Variance of the positions in a lattice cell along one axis, in squares of the spacing: means over cells blur noise
/// by as much.
const CELL_VARIANCE: f64 = 0.08;

/// Noise with a Gaussian covariance: its standard deviation and correlation length.
#[derive(Debug, Clone, Copy)]
pub(super) struct CorrelatedNoise {
    /// Standard deviation of the noise, in the heights' unit.
    pub sigma: f64,
    /// Correlation length, in spacings: the standard deviation of the Gaussian blur that makes such noise of white
    /// noise.
    pub length: f64,
    /// Number of vertices that share one independent value of the noise: the sum of its correlations over the lattice.
    pub shared_vertices: f64,
    /// Whether the noise is much rougher in one direction than in the other, so that no covariance that depends on the
    /// distance alone describes it.
    pub is_anisotropic: bool,
    /// Whether no fitted covariance explains the curvatures at all scales, so that most of the noise may be shape.
    pub ambiguous: bool,
}

impl CorrelatedNoise {
    /// Estimates the noise of heights from their curvatures at scales from small discs to large ones; `None` if a shape
    /// hides it.
    ///
    /// A shape beside the noise adds to the curvatures. So of the covariances that explain all larger scales, the one
    /// of the least noise counts, or one of smaller discs with hardly more.
    pub(super) fn from_scales(scales: &[CurvatureScale], discs: &[Disc]) -> Option<Self> {
        let is_anisotropic = scales.first().is_some_and(is_anisotropic);
        let is_noise = |scale: &CurvatureScale| is_noise(scale, discs, is_anisotropic);
        let first = scales.iter().position(is_noise)?;
        if scales[first].radius() > MAX_FIRST_RADIUS {
            return None;
        }
        let noisy = scales[first..].iter().take_while(|scale| is_noise(scale));
        let scales = &scales[first..first + noisy.count()];
        let (explaining, others): (Vec<_>, Vec<_>) = (1..scales.len())
            .map(|last| {
                let fitted = (last + 1).saturating_sub(FITTED_SCALES)..=last;
                let covariance = Covariance::fit(&scales[fitted], discs);
                (covariance.explains(&scales[last..], discs), covariance)
            })
            .partition(|(explains, _)| *explains);
        let ambiguous = explaining.is_empty();
        let candidates = if ambiguous { others } else { explaining };
        let roots = candidates
            .iter()
            .map(|(_, covariance)| covariance.spectral_root());
        let most = MAX_LEAST_NOISE_RATIO * roots.fold(f64::INFINITY, f64::min);
        let (_, found) = candidates
            .into_iter()
            .find(|(_, covariance)| covariance.spectral_root() <= most)?;
        Some(CorrelatedNoise {
            sigma: found.sigma,
            length: found.length,
            shared_vertices: found.shared_vertices,
            is_anisotropic,
            ambiguous,
        })
    }

    /// Standard deviation of white noise that has the same spectral density as this noise over large areas.
    pub(super) fn white_equivalent(&self) -> f64 {
        self.sigma * self.shared_vertices.sqrt()
    }
}

/// Returns whether the curvatures of the smallest scale are those of anisotropic noise.
fn is_anisotropic(scale: &CurvatureScale) -> bool {
    let ratio = scale.anisotropy.max(1.0 / scale.anisotropy);
    ratio > MIN_ANISOTROPY && scale.coherence < MAX_NOISE_COHERENCE
}

/// Returns whether the curvatures of a scale are mostly noise.
fn is_noise(scale: &CurvatureScale, discs: &[Disc], is_anisotropic: bool) -> bool {
    let bends_both_ways = scale.ratio > MIN_NOISE_RATIO && scale.coherence < MAX_COHERENCE;
    let max_coherence = match is_anisotropic {
        true => MAX_ANISOTROPIC_COHERENCE,
        false => MAX_NOISE_COHERENCE,
    };
    let incoherent = scale.coherence < max_coherence && scale.ratio > MIN_ANISOTROPIC_RATIO;
    scale.independent_discs(discs) >= MIN_INDEPENDENT_DISCS && (bends_both_ways || incoherent)
}

/// Returns whether the curvatures of a scale are isotropic noise alone, with no shape beside it.
fn is_plain_noise(scale: &CurvatureScale) -> bool {
    scale.ratio > MIN_ISOTROPIC_RATIO && scale.coherence < MAX_NOISE_COHERENCE
}

/// Gaussian covariance of noise, fitted to the curvatures of some scales.
struct Covariance {
    sigma: f64,
    length: f64,
    shared_vertices: f64,
    /// Ratio of the noise's standard deviation over large areas to the part of it that the largest disc shows.
    hidden_ratio: f64,
}

impl Covariance {
    /// Fits a covariance of noise to scales: least squares of the logarithms of their white equivalents, over a grid of
    /// correlation lengths.
    fn fit(scales: &[CurvatureScale], discs: &[Disc]) -> Self {
        let largest = scales.last().map_or(0.0, CurvatureScale::radius);
        let [shortest, longest] = [MIN_LENGTH_RADII, MAX_LENGTH_RADII].map(|radii| radii * largest);
        let step = (longest / shortest).powf(1.0 / f64::from(LENGTH_TRIALS - 1));
        let lengths = (0..LENGTH_TRIALS).map(|trial| shortest * step.powi(trial as i32));
        let mut best = (f64::INFINITY, 0.0, 0.0);
        for length in [0.0].into_iter().chain(lengths) {
            let logs: Vec<f64> = (scales.iter())
                .map(|scale| (scale.white_equivalent / response(scale, discs, length)).ln())
                .collect();
            let mean = logs.iter().sum::<f64>() / logs.len() as f64;
            let misfit = logs.iter().map(|log| (log - mean).powi(2)).sum::<f64>();
            if misfit < best.0 {
                best = (misfit, length, mean.exp());
            }
        }
        let (_, length, sigma) = best;
        let shared_vertices = shared_vertices(length);
        let shown = scales
            .last()
            .map_or(1.0, |scale| response(scale, discs, length));
        Covariance {
            sigma,
            length,
            shared_vertices,
            hidden_ratio: shared_vertices.sqrt() / shown,
        }
    }

    /// Returns whether the covariance explains the first of `scales`, the largest it was fitted to, and predicts all
    /// larger ones that show noise alone.
    fn explains(&self, scales: &[CurvatureScale], discs: &[Disc]) -> bool {
        let Some((last, larger)) = scales.split_first() else {
            return false;
        };
        let is_whole = last.ratio >= MIN_ISOTROPIC_RATIO || last.coherence > MIN_SHAPE_COHERENCE;
        let is_predicted = |scale: &CurvatureScale| {
            scale.white_equivalent <= MAX_PREDICTION_RATIO * self.predict(scale, discs)
        };
        is_whole
            && self.hidden_ratio <= MAX_HIDDEN_RATIO
            && larger
                .iter()
                .filter(|scale| is_plain_noise(scale))
                .all(is_predicted)
    }

    /// Returns the standard deviation of white noise that has the same spectral density as this noise over large areas.
    fn spectral_root(&self) -> f64 {
        self.sigma * self.shared_vertices.sqrt()
    }

    /// Predicts the standard deviation of white noise that has the same curvatures at a scale as this noise.
    fn predict(&self, scale: &CurvatureScale, discs: &[Disc]) -> f64 {
        self.sigma * response(scale, discs, self.length)
    }
}

/// Returns the standard deviation of white noise that has, at a scale, the same curvatures as noise of standard
/// deviation 1 with this correlation length in spacings.
fn response(scale: &CurvatureScale, discs: &[Disc], length: f64) -> f64 {
    if length == 0.0 {
        return 1.0;
    }
    let spacing = f64::from(1u32 << scale.lattice);
    let own = (length / spacing).powi(2);
    // Means over cells are blurred by the cell, and have less variance by that.
    let blurred = own + CELL_VARIANCE * (1.0 - 1.0 / (spacing * spacing));
    let pairs = discs[scale.disc].autocorrelation.iter();
    let sum: f64 = pairs
        .map(|(distance, product)| product * (-distance / (4.0 * blurred)).exp())
        .sum();
    spacing * (own / blurred * sum).sqrt()
}

/// Returns the sum of the correlations of the noise at one vertex with that at all vertices, for a correlation length
/// in spacings.
fn shared_vertices(length: f64) -> f64 {
    if length == 0.0 {
        return 1.0;
    }
    let reach = (8.0 * length).ceil() as i64 + 1;
    let correlation = |row: i64, half: i64| {
        let squares = 0.25 * (half * half) as f64 + 0.75 * (row * row) as f64;
        (-squares / (4.0 * length * length)).exp()
    };
    (-reach..=reach)
        .flat_map(|row| (-2 * reach..=2 * reach).map(move |half| (row, half)))
        .filter(|(row, half)| (row + half) % 2 == 0)
        .map(|(row, half)| correlation(row, half))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::tuning::curvature_scales::DISC_RADII;

    /// Far more than a spacing, the sum is the integral over the plane: `4πℓ²` over the area of a cell.
    #[test]
    fn vertices_share_values_over_the_correlated_area() {
        let area = 0.75f64.sqrt();
        for length in [1.0, 3.0] {
            let integral = 4.0 * std::f64::consts::PI * length * length / area;
            assert!((shared_vertices(length) / integral - 1.0).abs() < 1e-6);
        }
        assert!((shared_vertices(1e-3) - 1.0).abs() < 1e-12);
    }

    /// Discs that are much larger than the correlation length see white noise of the same spectrum; the response grows
    /// with the disc until then.
    #[test]
    fn large_discs_see_the_whole_noise() {
        let discs: Vec<Disc> = DISC_RADII.iter().filter_map(|r| Disc::new(*r)).collect();
        let scale = |lattice, disc| CurvatureScale {
            lattice,
            disc,
            count: 1000,
            ratio: 0.32,
            white_equivalent: 0.0,
            coherence: 0.0,
            anisotropy: 1.0,
        };
        for length in [1.0, 2.5] {
            let whole = shared_vertices(length).sqrt();
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
