//! Statistics of the residuals of a traced line: mean square, and correlation of neighbouring points.

/// Correlation of neighbouring residuals up to which it is insignificant, times the square root of their number.
const INSIGNIFICANT_CORRELATION: f64 = 2.5;

/// Maximum correlation of neighbouring residuals that is assumed; limits by how much they reduce the number of
/// independent errors.
const MAX_CORRELATION: f64 = 0.9;

/// Statistics of the residuals of one traced line, which are distances of its points from the model.
#[derive(Debug, Clone, Copy)]
pub(super) struct ResidualStatistics {
    /// Mean square of the residuals, in pixels².
    pub mean_square: f64,
    /// Covariance of the residuals of neighbouring independent points, in pixels², which no noise of single points
    /// explains; 0 if it is not significant.
    pub common: f64,
    /// Number of independent points of the line.
    pub independent: f64,
}

impl ResidualStatistics {
    /// Computes the statistics of residuals, `distances` in pixels, that count as `independent` independent ones. Fewer
    /// than two have no covariance, and none have the mean square 0.
    pub fn new(distances: &[f64], independent: f64) -> Self {
        let count = distances.len();
        let mean_square = distances.iter().map(|d| d * d).sum::<f64>() / count.max(1) as f64;
        if count < 2 {
            return ResidualStatistics {
                mean_square,
                common: 0.0,
                independent,
            };
        }
        // The lag of one independent point, at which white noise has no correlation.
        let lag = (count as f64 / independent.max(1.0)).round() as usize;
        let lag = lag.clamp(1, count - 1);
        let both: f64 = (distances.iter().zip(&distances[lag..]))
            .map(|(d, e)| d * e)
            .sum();
        let common = (both / (count - lag) as f64).clamp(0.0, mean_square);
        let chance = INSIGNIFICANT_CORRELATION / (count as f64 / lag as f64).sqrt();
        ResidualStatistics {
            mean_square,
            common: if common > chance * mean_square {
                common
            } else {
                0.0
            },
            independent,
        }
    }

    /// Pools the statistics of several lines, weighted by their numbers of independent points. None for no lines.
    pub fn pooled(list: &[ResidualStatistics]) -> Option<ResidualStatistics> {
        let count: f64 = list.iter().map(|own| own.independent).sum();
        let mean = |of: fn(&ResidualStatistics) -> f64| {
            list.iter()
                .map(|own| own.independent * of(own))
                .sum::<f64>()
                / count
        };
        (count > 0.0).then(|| ResidualStatistics {
            mean_square: mean(|own| own.mean_square),
            common: mean(|own| own.common),
            independent: count,
        })
    }

    /// Number of neighbouring points that share one independent error, from their correlation.
    pub fn points_per_error(&self) -> f64 {
        let share = (self.common / self.mean_square.max(1e-12)).min(MAX_CORRELATION);
        (1.0 + share) / (1.0 - share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_residual_has_a_mean_square_and_no_covariance() {
        let one = ResidualStatistics::new(&[2.0], 1.0);
        assert_eq!((one.mean_square, one.common), (4.0, 0.0));
        let none = ResidualStatistics::new(&[], 0.0);
        assert_eq!((none.mean_square, none.common), (0.0, 0.0));
    }
}
