//! Residual of a surface beside the noise of its input, by which λ is refined once it is known.

use super::noise::{MIN_SAMPLE_CONFIDENCE, largest_trust, sample};
use crate::error::{Result, try_filled};
use crate::fit::input::Input;
use crate::fit::report::LambdaChoice;
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;
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
        residuals.retain(|residual| residual.is_finite());
        residuals
            .iter_mut()
            .for_each(|residual| *residual = residual.abs());
        let median = median(&mut residuals);
        Ok(median.filter(|_| count > 0.0).map(|median| Residual {
            rms: (squares / count).sqrt(),
            median: MAD_TO_SIGMA * median,
        }))
    }

    /// Whether the residual is larger than the noise explains.
    pub(crate) fn exceeds_noise(&self, choice: &LambdaChoice) -> bool {
        match choice.correlation_length > 0.0 {
            true => self.rms > MAX_CORRELATED_RESIDUAL,
            false => self.rms > MAX_WHITE_RESIDUAL,
        }
    }

    /// The factor by which λ should be larger; `None` where it suits the residual.
    pub(crate) fn lambda_factor(&self, choice: &LambdaChoice) -> Option<f64> {
        let [least, most] = LAMBDA_RAISE_FACTORS;
        let is_correlated = choice.correlation_length > 0.0;
        if self.exceeds_noise(choice) && choice.raises < MAX_LAMBDA_RAISES {
            Some(self.rms.clamp(least, most))
        } else if is_correlated
            && self.median < MIN_NOISE_MEDIAN
            && choice.raises < MAX_SMALLER_NOISE_RAISES
        {
            Some((1.0 / self.median).min(least))
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    fn ratio(heights: impl Fn(usize) -> f64) -> f64 {
        let lattice = Lattice::new(40, 40, 1.0).unwrap();
        let field = Heightfield::new(lattice, (0..1600).map(heights).collect()).unwrap();
        let flat = Heightfield::from_fn(lattice, |_, _| 0.0).unwrap();
        let input = Input::new(field);
        let domain = input.domain().unwrap();
        Residual::of(&input, &domain, &flat, 0.5)
            .unwrap()
            .unwrap()
            .rms
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
