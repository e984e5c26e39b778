//! How distances from a line are spread along it.

/// In pixels².
#[derive(Debug, Clone, Copy)]
pub(super) struct Misfit {
    /// Their mean square.
    pub all: f64,
    /// What of it does not change from one independent point to the next, which no noise of single
    /// points explains.
    pub smooth: f64,
    /// How many independent points there are.
    pub count: f64,
}

impl Misfit {
    /// Of the distances of at least two points, that are worth so many independent ones.
    pub fn new(distances: &[f64], independent: f64) -> Self {
        let count = distances.len();
        let all = distances.iter().map(|d| d * d).sum::<f64>() / count as f64;
        // Of white noise, one independent point has no correlation with the next.
        let lag = (count as f64 / independent.max(1.0)).round() as usize;
        let lag = lag.clamp(1, count - 1);
        let both: f64 = (distances.iter().zip(&distances[lag..]))
            .map(|(d, e)| d * e)
            .sum();
        let smooth = (both / (count - lag) as f64).clamp(0.0, all);
        // A correlation that as many points of white noise have, too, is none.
        let chance = 2.5 / (count as f64 / lag as f64).sqrt();
        Misfit {
            all,
            smooth: if smooth > chance * all { smooth } else { 0.0 },
            count: independent,
        }
    }

    /// That of all lines.
    pub fn together(list: &[Misfit]) -> Option<Misfit> {
        let count: f64 = list.iter().map(|own| own.count).sum();
        let mean = |of: fn(&Misfit) -> f64| {
            list.iter().map(|own| own.count * of(own)).sum::<f64>() / count
        };
        (count > 0.0).then(|| Misfit {
            all: mean(|own| own.all),
            smooth: mean(|own| own.smooth),
            count,
        })
    }

    /// How many neighbouring points have one error in common.
    pub fn correlation(&self) -> f64 {
        let share = (self.smooth / self.all.max(1e-12)).min(0.9);
        (1.0 + share) / (1.0 - share)
    }
}
