//! Robust least squares: the Levenberg–Marquardt method, and the pseudo-Huber penalty of outliers, by which a
//! page and its edges are fitted.

/// Initial damping of the Levenberg–Marquardt method, relative to the normal matrix's diagonal.
const INITIAL_DAMPING: f64 = 1e-3;

/// Minimum damping of the Levenberg–Marquardt method, relative to the normal matrix's diagonal.
/// Its row: `benches/page.md`, Models.
const MIN_DAMPING: f64 = 1e-12;

/// Factor that multiplies the Levenberg–Marquardt damping after a step that lowers the cost.
const DAMPING_DECREASE: f64 = 0.1;

/// Factor that multiplies the Levenberg–Marquardt damping after a step that does not lower the cost.
/// Its row: `benches/page.md`, Models.
const DAMPING_INCREASE: f64 = 5.0;

/// Maximum number of Levenberg–Marquardt steps in one fit.
/// Chosen by `benches/page.md`, Beside other ways.
const MAX_FIT_STEPS: usize = 15;

/// A robust least-squares problem: its model, and the normal equations at one.
pub(super) trait RobustProblem {
    /// A model with its residuals: a point of the search.
    type Model: Clone;
    /// The normal equations at a model, with residuals reweighted by their penalty.
    type System;

    /// The normal equations at a model; None if the model is not in front of the camera.
    fn system(&self, model: &Self::Model) -> Option<Self::System>;

    /// The model after the step that solves the normal equations with their diagonal enlarged by the factor `1 + damping`;
    /// None if they are singular, or the model is not in front of the camera.
    fn stepped(
        &self,
        model: &Self::Model,
        system: &Self::System,
        damping: f64,
    ) -> Option<Self::Model>;

    /// The sum of the penalties of a model's residuals, which the search lowers.
    fn cost(&self, model: &Self::Model) -> f64;
}

/// Finds the model with the lowest cost by the Levenberg–Marquardt method from an initial guess, until a step lowers the cost
/// by no more than the tolerance at that cost. None if the initial model is not in front of the camera.
pub(super) fn fit<P: RobustProblem>(
    problem: &P,
    start: P::Model,
    tolerance: impl Fn(f64) -> f64,
) -> Option<P::Model> {
    let mut best = start;
    let mut damping = INITIAL_DAMPING;
    for step in 0..MAX_FIT_STEPS {
        let system = match problem.system(&best) {
            Some(system) => system,
            None if step == 0 => return None,
            None => break,
        };
        let cost = problem.cost(&best);
        let better = loop {
            // Shorter steps change the cost by its rounding errors alone.
            if damping * f64::EPSILON.sqrt() > 1.0 {
                return Some(best);
            }
            match problem.stepped(&best, &system, damping) {
                Some(moved) if problem.cost(&moved) < cost => break moved,
                _ => damping *= DAMPING_INCREASE,
            }
        };
        damping = (damping * DAMPING_DECREASE).max(MIN_DAMPING);
        best = better;
        if cost - problem.cost(&best) <= tolerance(cost) {
            break;
        }
    }
    Some(best)
}

/// Weight of a squared residual, given over its outlier threshold, in iteratively reweighted least squares: half the
/// derivative by its square of its pseudo-Huber penalty, which is its square for small residuals and twice its size for large
/// ones; from 0 to 1.
pub(super) fn weight(relative: f64) -> f64 {
    1.0 / root(relative)
}

fn root(relative: f64) -> f64 {
    (1.0 + relative * relative).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight line through points, of which one is far off.
    struct Line(Vec<[f64; 2]>);

    impl RobustProblem for Line {
        type Model = [f64; 2];
        type System = ([[f64; 2]; 2], [f64; 2]);

        fn system(&self, line: &[f64; 2]) -> Option<Self::System> {
            let (mut normal, mut right) = ([[0.0; 2]; 2], [0.0; 2]);
            for [x, y] in &self.0 {
                let off = y - line[0] - line[1] * x;
                let row = [1.0, *x];
                for i in 0..2 {
                    (0..2).for_each(|k| normal[i][k] += weight(off) * row[i] * row[k]);
                    right[i] += weight(off) * row[i] * off;
                }
            }
            Some((normal, right))
        }

        fn stepped(
            &self,
            line: &[f64; 2],
            system: &Self::System,
            damping: f64,
        ) -> Option<[f64; 2]> {
            let ([[a, b], [_, d]], [p, q]) = *system;
            let (a, d) = (a * (1.0 + damping), d * (1.0 + damping));
            let area = a * d - b * b;
            Some([
                line[0] + (d * p - b * q) / area,
                line[1] + (a * q - b * p) / area,
            ])
        }

        fn cost(&self, line: &[f64; 2]) -> f64 {
            let off = |[x, y]: &[f64; 2]| penalty(y - line[0] - line[1] * x);
            self.0.iter().map(off).sum()
        }
    }

    /// Pseudo-Huber penalty of a residual over its outlier threshold.
    fn penalty(relative: f64) -> f64 {
        2.0 * (root(relative) - 1.0)
    }

    #[test]
    fn an_outlier_hardly_moves_a_line() {
        let on = |i: usize| [i as f64, 3.0 + 0.5 * i as f64];
        let mut points: Vec<_> = (0..21).map(on).collect();
        points[4][1] += 1000.0;
        let line = fit(&Line(points), [0.0; 2], |cost| 1e-12 * cost).unwrap();
        assert!(
            (line[0] - 3.0).abs() < 0.2 && (line[1] - 0.5).abs() < 0.02,
            "{line:?}"
        );
    }

    #[test]
    fn the_weight_is_the_slope_of_the_penalty() {
        for relative in [0.0, 0.3, 1.0, 40.0] {
            let step = 1e-6;
            let slope = (penalty(relative + step) - penalty(relative - step)) / (2.0 * step);
            assert!((slope - 2.0 * relative * weight(relative)).abs() < 1e-6);
        }
    }
}
