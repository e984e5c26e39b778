//! Residual of a surface beside the noise of its input, by which λ is refined once it is known.

use super::curvature_scales::stepped;
use super::noise::{MIN_SAMPLE_CONFIDENCE, Noise, largest_trust, sample};
use crate::error::{Result, try_filled};
use crate::fit::input::Input;
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;
use crate::lattice::hexagonal::Lattice;
use crate::math::statistics::{MAD_TO_SIGMA, median};

/// Residual, in standard deviations of the noise, from which on a height counts as an outlier unless its neighbours have
/// such residuals, too.
const MIN_OUTLIER_RESIDUAL: f64 = 3.0;

/// Residual of a neighbour, in standard deviations of the noise, that counts as alike if it has the same sign.
const MIN_ALIKE_RESIDUAL: f64 = 2.0;

/// Minimum number of neighbours with residuals alike at which a large residual is the surface's error, as beside a step.
const MIN_ALIKE_NEIGHBOURS: usize = 2;

/// Largest root mean square of the residual, in standard deviations of white noise, that the noise explains. A shape that
/// bends more than λ allows adds to it. More than 1, because rings of six neighbours show the noise of square pixels by about
/// three quarters of its size after resampling to the lattice, where neighbours share pixels.
const MAX_WHITE_RESIDUAL: f64 = 2.0;

/// Largest root mean square of the residual, in standard deviations of correlated noise, that the noise explains.
const MAX_CORRELATED_RESIDUAL: f64 = 1.1;

/// Largest root mean square of the residual, in those standard deviations that its median shows, that noise explains.
/// Noise has about 1; a surface that has lost steps of the shape has 2 to 10, whatever σ was found (`benches/scenes.md`).
const MAX_RESIDUAL_TAIL: f64 = 1.5;

/// Lag, in spacings, at which the residual's autocorrelation is measured: white noise has none there, even that of square
/// pixels after resampling, whose neighbours are correlated.
const AUTOCORRELATION_LAG: usize = 4;

/// Largest autocorrelation, of either sign, that the residual of white noise may have. Where λ suits the shape it is at
/// most 0.1 (`benches/scenes.md`).
const MAX_WHITE_AUTOCORRELATION: f64 = 0.15;

/// Largest autocorrelation across its direction, of either sign, that the residual of anisotropic noise may have.
const MAX_ANISOTROPIC_AUTOCORRELATION: f64 = 0.3;

/// Largest residual that rounding leaves, in standard deviations `step/√12` of its errors: half a step, and a tenth more.
const MAX_ROUNDING_RESIDUAL: f64 = 1.9;

/// Largest share of vertices with a residual beyond [`MAX_ROUNDING_RESIDUAL`] where λ suits the shape.
const MAX_SHARE_BEYOND_ROUNDING: f64 = 0.02;

/// Minimum number of pairs of vertices from which an autocorrelation is measured: its standard error is then a third of
/// [`MAX_WHITE_AUTOCORRELATION`].
const MIN_AUTOCORRELATION_PAIRS: usize = 400;

/// Range of the factors by which λ is raised where the residual is larger than that: at least so much that a solve more
/// is worth its cost, at most so much that a warm start is still of use.
const LAMBDA_RAISE_FACTORS: [f64; 2] = [2.9, 10.0];

/// Maximum number of times that λ is raised.
const MAX_LAMBDA_RAISES: usize = 4;

/// Median residual under correlated noise, in standard deviations of it, below which the noise is taken to be as much
/// smaller: a shape beside correlated noise makes it look larger than it is (`benches/scenes.md`).
const MIN_NOISE_MEDIAN: f64 = 0.8;

/// Number of raises below which λ is raised for a median residual that is smaller.
const MAX_SMALLER_NOISE_RAISES: usize = 2;

/// Residual of a surface, in standard deviations of the noise.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Residual {
    /// Root mean square, without outliers.
    pub rms: f64,
    /// Standard deviation of the normal distribution with the same median of absolute values.
    median: f64,
    /// Absolute autocorrelations at [`AUTOCORRELATION_LAG`] in the lattice's three directions, from the smallest to the
    /// largest; 0 where too few vertices are that far apart.
    autocorrelations: [f64; 3],
    /// Share of the vertices whose residual exceeds [`MAX_ROUNDING_RESIDUAL`].
    beyond_rounding: f64,
}

impl Residual {
    /// The residual over the vertices of the domain whose heights are measured; `None` if there are none or the
    /// standard deviation `sigma` of their noise is 0.
    ///
    /// # Errors
    /// Out of memory.
    pub(crate) fn of(
        input: &Input,
        domain: &Domain,
        surface: &Heightfield,
        sigma: f64,
    ) -> Result<Option<Self>> {
        let lattice = *input.field.lattice();
        let least = MIN_SAMPLE_CONFIDENCE * largest_trust(input);
        let mut residuals = try_filled("residuals", lattice.len(), f64::NAN)?;
        for cell in domain.active().cells() {
            let vertex = domain.lattice_index(cell);
            residuals[vertex] = (sample(input, vertex, least) - surface.heights()[vertex]) / sigma;
        }
        let (mut squares, mut count) = (0.0, 0.0);
        for row in 0..lattice.rows() {
            for col in 0..lattice.cols() {
                let residual = residuals[lattice.index(row, col)];
                let is_alike = |(row, col): &(usize, usize)| {
                    residuals[lattice.index(*row, *col)] * residual.signum() > MIN_ALIKE_RESIDUAL
                };
                let alike = || {
                    let neighbours = lattice.neighbours(row, col).into_iter().flatten();
                    neighbours.filter(is_alike).count()
                };
                let is_small = residual.abs() < MIN_OUTLIER_RESIDUAL;
                if residual.is_finite() && (is_small || alike() >= MIN_ALIKE_NEIGHBOURS) {
                    squares += residual * residual;
                    count += 1.0;
                }
            }
        }
        let autocorrelations = autocorrelations(&lattice, &residuals);
        residuals.retain(|residual| residual.is_finite());
        residuals
            .iter_mut()
            .for_each(|residual| *residual = residual.abs());
        let beyond = residuals
            .iter()
            .filter(|r| **r > MAX_ROUNDING_RESIDUAL)
            .count();
        let median = median(&mut residuals);
        Ok(median.filter(|_| count > 0.0).map(|median| Residual {
            rms: (squares / count).sqrt(),
            median: MAD_TO_SIGMA * median,
            autocorrelations,
            beyond_rounding: beyond as f64 / residuals.len() as f64,
        }))
    }

    /// Whether the residual is larger than the noise explains. Of anisotropic noise σ is too uncertain to tell.
    pub(crate) fn exceeds_noise(&self, noise: &Noise) -> bool {
        let limit = match noise.is_correlated() {
            true => MAX_CORRELATED_RESIDUAL,
            false => MAX_WHITE_RESIDUAL,
        };
        self.rms > limit && !noise.is_anisotropic
    }

    /// Whether a few residuals are much larger than most, as beside steps that the surface has lost. Where rounded heights are
    /// level most residuals are 0, so that rounding errors alone are compared with what they can be.
    fn has_lost_steps(&self, noise: &Noise) -> bool {
        match noise.is_quantised {
            true => noise.step.is_some() && self.beyond_rounding > MAX_SHARE_BEYOND_ROUNDING,
            false => self.rms > MAX_RESIDUAL_TAIL * self.median,
        }
    }

    /// Whether residuals far apart are alike, as where the surface has lost bends. Correlated noise is alike, too: isotropic
    /// noise in all directions, anisotropic noise in one.
    fn has_lost_bends(&self, noise: &Noise) -> bool {
        let [_, second, largest] = self.autocorrelations;
        if noise.is_anisotropic {
            second > MAX_ANISOTROPIC_AUTOCORRELATION
        } else if noise.is_quantised {
            !noise.is_correlated() && largest > MAX_WHITE_AUTOCORRELATION && self.rms > 1.0
        } else {
            !noise.is_correlated() && largest > MAX_WHITE_AUTOCORRELATION
        }
    }

    /// The factor by which λ should be larger; `None` where it suits the residual, or was raised often enough.
    pub(crate) fn lambda_factor(&self, noise: &Noise, raises: usize) -> Option<f64> {
        let [least, most] = LAMBDA_RAISE_FACTORS;
        let is_noise_smaller = noise.is_correlated()
            && self.median < MIN_NOISE_MEDIAN
            && raises < MAX_SMALLER_NOISE_RAISES;
        if raises >= MAX_LAMBDA_RAISES {
            None
        } else if self.has_lost_steps(noise) {
            Some(match noise.is_quantised {
                true => most,
                false => (self.rms / self.median).powi(2).clamp(least, most),
            })
        } else if self.has_lost_bends(noise) || self.exceeds_noise(noise) {
            Some(self.rms.clamp(least, most))
        } else if is_noise_smaller {
            Some((1.0 / self.median).min(least))
        } else {
            None
        }
    }
}

/// Computes [`Residual::autocorrelations`] of residuals, which are NaN where there is none.
fn autocorrelations(lattice: &Lattice, residuals: &[f64]) -> [f64; 3] {
    let directions = [(0, 2), (1, 1), (1, -1)];
    let lag = AUTOCORRELATION_LAG as isize;
    let mut correlations = directions.map(|(rows, half_cols)| {
        let (mut products, mut squares, mut pairs) = (0.0, 0.0, 0);
        for row in 0..lattice.rows() as isize {
            for col in 0..lattice.cols() as isize {
                let (other_row, other_col) = stepped(row, col, (lag * rows, lag * half_cols));
                if lattice.contains(other_row, other_col) {
                    let index = |row, col| lattice.index(row as usize, col as usize);
                    let [a, b] =
                        [index(row, col), index(other_row, other_col)].map(|v| residuals[v]);
                    if a.is_finite() && b.is_finite() {
                        products += a * b;
                        squares += 0.5 * (a * a + b * b);
                        pairs += 1;
                    }
                }
            }
        }
        match pairs >= MIN_AUTOCORRELATION_PAIRS && squares > 0.0 {
            true => f64::abs(products / squares),
            false => 0.0,
        }
    });
    correlations.sort_unstable_by(f64::total_cmp);
    correlations
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Residual of a flat surface beside heights on a lattice of 40 columns, whose noise is 0.5.
    fn residual(heights: impl Fn(usize) -> f64) -> Residual {
        let lattice = Lattice::new(40, 40, 1.0).unwrap();
        let field = Heightfield::new(lattice, (0..1600).map(heights).collect()).unwrap();
        let flat = Heightfield::from_fn(lattice, |_, _| 0.0).unwrap();
        let input = Input::new(field);
        let domain = input.domain().unwrap();
        let residual = Residual::of(&input, &domain, &flat, 0.5).unwrap();
        residual.unwrap()
    }

    fn ratio(heights: impl Fn(usize) -> f64) -> f64 {
        residual(heights).rms
    }

    /// Noise of standard deviation 0.5, uniform.
    fn white() -> impl Fn(usize) -> f64 {
        let mut random = oorandom::Rand64::new(3);
        let noise: Vec<f64> = (0..1600).map(|_| random.rand_float() - 0.5).collect();
        move |vertex| 3f64.sqrt() * noise[vertex]
    }

    fn noise() -> Noise {
        Noise {
            sigma: 0.5,
            correlation_length: 0.0,
            merged: 0,
            product: 0.5,
            step: None,
            is_quantised: false,
            is_anisotropic: false,
            ambiguous: false,
        }
    }

    /// White noise is no reason to raise λ; a strip of large residuals is, and bends that add less than the noise are.
    #[test]
    fn lost_steps_and_bends_raise_lambda() {
        let white = white();
        assert_eq!(residual(&white).lambda_factor(&noise(), 0), None);
        let strip = residual(|v| white(v) + if v % 40 < 2 { 5.0 } else { 0.0 });
        let factor = strip.lambda_factor(&noise(), 0).unwrap();
        assert!((3.0..10.0).contains(&factor), "{factor}");
        assert_eq!(strip.lambda_factor(&noise(), MAX_LAMBDA_RAISES), None);
        let bends = residual(|v| white(v) + 0.4 * (0.8 * (v % 40) as f64).sin());
        assert!(bends.rms < MAX_WHITE_RESIDUAL);
        assert_eq!(bends.lambda_factor(&noise(), 0), Some(2.9));
    }

    /// Rounding errors of level ground are 0 for most vertices and half a step for a few.
    #[test]
    fn level_ground_raises_no_lambda() {
        let rounding = Noise {
            step: Some(0.5 * 12f64.sqrt()),
            is_quantised: true,
            correlation_length: 0.0,
            ..noise()
        };
        let half = 0.25 * 12f64.sqrt();
        let level = |share: f64| move |v: usize| if v % 40 < 4 { share * half } else { 0.0 };
        assert_eq!(residual(level(0.9)).lambda_factor(&rounding, 0), None);
        assert_eq!(residual(level(2.5)).lambda_factor(&rounding, 0), Some(10.0));
    }

    /// Heights of ±1 are two standard deviations off; single impulses do not count, a strip of large residuals does.
    #[test]
    fn strips_count_and_impulses_do_not() {
        let sign = |vertex: usize| if vertex.is_multiple_of(2) { 1.0 } else { -1.0 };
        assert!((ratio(sign) - 2.0).abs() < 1e-12);
        let impulses = ratio(|v| if v.is_multiple_of(83) { 50.0 } else { sign(v) });
        assert!((impulses - 2.0).abs() < 1e-12, "{impulses}");
        let strip = ratio(|v| if v % 40 < 4 { 5.0 } else { sign(v) });
        assert!(strip > 3.0, "{strip}");
    }

    #[test]
    fn there_is_no_ratio_without_noise() {
        let field = Heightfield::from_fn(Lattice::new(9, 9, 1.0).unwrap(), |x, _| x).unwrap();
        let input = Input::new(field.clone());
        let domain = input.domain().unwrap();
        assert!(
            Residual::of(&input, &domain, &field, 0.0)
                .unwrap()
                .is_none()
        );
    }
}
