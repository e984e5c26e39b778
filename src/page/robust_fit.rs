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

/// Finds the model with the lowest cost by the Levenberg–Marquardt method from an initial guess, until a step lowers the cost
/// by no more than the share `tolerance`. `system` are the normal equations at a model, with residuals reweighted by their penalty;
/// `step` makes the model that solves them with their diagonal enlarged by the factor `1 + damping`, if there is one; `cost` is the
/// sum of the penalties. None if there are no equations at the initial model.
pub(super) fn fit<M, S>(
    start: M,
    system: impl Fn(&M) -> Option<S>,
    step: impl Fn(&M, &S, f64) -> Option<M>,
    cost: impl Fn(&M) -> f64,
    tolerance: f64,
) -> Option<M> {
    let mut best = start;
    let mut equations = system(&best)?;
    let mut damping = INITIAL_DAMPING;
    for _ in 0..MAX_FIT_STEPS {
        let before = cost(&best);
        let better = loop {
            // Shorter steps change the cost by its rounding errors alone.
            if damping * f64::EPSILON.sqrt() > 1.0 {
                return Some(best);
            }
            match step(&best, &equations, damping) {
                Some(moved) if cost(&moved) < before => break moved,
                _ => damping *= DAMPING_INCREASE,
            }
        };
        damping = (damping * DAMPING_DECREASE).max(MIN_DAMPING);
        best = better;
        if before - cost(&best) <= tolerance * before {
            break;
        }
        equations = match system(&best) {
            Some(next) => next,
            None => break,
        };
    }
    Some(best)
}

/// Weight of a squared residual, given over its outlier threshold, in iteratively reweighted least squares: half the
/// derivative by its square of its pseudo-Huber penalty, which is its square for small residuals and twice its size for large
/// ones; from 0 to 1.
pub(super) fn weight(relative: f64) -> f64 {
    1.0 / (1.0 + relative * relative).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::least_squares::LeastSquares;
    use nalgebra::SVector;

    /// Pseudo-Huber penalty of a residual over its outlier threshold.
    fn penalty(relative: f64) -> f64 {
        2.0 * (1.0 / weight(relative) - 1.0)
    }

    #[test]
    fn an_outlier_hardly_moves_a_line() {
        let on = |i: usize| [i as f64, 3.0 + 0.5 * i as f64];
        let mut points: Vec<_> = (0..21).map(on).collect();
        points[4][1] += 1000.0;
        let off = |line: &[f64; 2], [x, y]: &[f64; 2]| y - line[0] - line[1] * x;
        let system = |line: &[f64; 2]| {
            let mut fit = LeastSquares::<2>::new();
            for point in &points {
                let off = off(line, point);
                fit.add(&SVector::from([1.0, point[0]]), [off], weight(off));
            }
            Some(fit)
        };
        let step = |line: &[f64; 2], system: &LeastSquares<2>, damping: f64| {
            let mut damped = system.clone();
            damped.add_ridge(&[0, 1].map(|k| damping * system.matrix[(k, k)]));
            let step = damped.solve()?;
            Some([line[0] + step[0], line[1] + step[1]])
        };
        let cost = |line: &[f64; 2]| points.iter().map(|p| penalty(off(line, p))).sum();
        let line = fit([0.0; 2], system, step, cost, 1e-12).unwrap();
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
