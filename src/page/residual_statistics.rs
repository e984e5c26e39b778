//! Statistics of the distances of traced points from their line.

/// Correlation of neighbouring points' distances that is not significant, over the inverse square root of their number.
const INSIGNIFICANT_CORRELATION: f64 = 2.5;

/// Maximum correlation of neighbouring points' distances: limits how much fewer independent errors there are.
const MAX_CORRELATION: f64 = 0.9;

/// Statistics of the distances of traced points from their line, in pixels².
#[derive(Debug, Clone, Copy)]
pub(super) struct ResidualStatistics {
    /// Mean square of the distances.
    pub mean_square: f64,
    /// Part of the mean square that independent points next to each other have in common (their covariance), which no
    /// noise of single points explains; 0 if it is not significant.
    pub common: f64,
    /// Number of independent points.
    pub independent: f64,
}

impl ResidualStatistics {
    /// Statistics of the distances of at least two points, in pixels, that count as a number of independent ones.
    pub fn new(distances: &[f64], independent: f64) -> Self {
        let count = distances.len();
        let mean_square = distances.iter().map(|d| d * d).sum::<f64>() / count as f64;
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

    /// Statistics of several lines together.
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

    /// Number of neighbouring points that have one error in common.
    pub fn points_per_error(&self) -> f64 {
        let share = (self.common / self.mean_square.max(1e-12)).min(MAX_CORRELATION);
        (1.0 + share) / (1.0 - share)
    }
}
