//! Piecewise smooth curves through ragged points: robust smoothing splines whose bends may be sharp where paper is folded.

use nalgebra::Vector2;

use crate::math::bordered::BorderedSystem;
use crate::page::robust_fit;

/// Number of rounds of iteratively reweighted least squares.
/// Its row: `benches/page.md`, Constants of the outline.
const REWEIGHTING_ROUNDS: usize = 6;

/// Change of the curve's direction from point to point, in radians for points one pixel apart, above which it counts as a
/// fold, which is penalised by its angle and not by its square.
/// Its row: `benches/page.md`, One rule at a time.
const FOLD_ANGLE: f64 = 0.004;

/// Fits a piecewise smooth curve to points about one pixel apart, and returns its points. Bends shorter than about `length`
/// pixels are smoothed, and so are stretches of outliers that are not much longer than that.
pub(super) fn piecewise_smooth(points: &[[f64; 2]], length: f64) -> Vec<[f64; 2]> {
    let mut curve: Vec<Vector2<f64>> = points.iter().map(|p| Vector2::from(*p)).collect();
    if points.len() < 3 {
        return points.to_vec();
    }
    let stiffness = length.powi(4);
    let mut bends = vec![stiffness; points.len() - 2];
    for round in 0..REWEIGHTING_ROUNDS {
        let trust: Vec<f64> = (points.iter().zip(&curve))
            .map(|(p, on)| {
                let off = (Vector2::from(*p) - on).norm();
                // A point more than a pixel off is an outlier and counts less.
                robust_fit::weight(off)
            })
            .collect();
        if round > 0 {
            for (bend, p) in bends.iter_mut().zip(curve.windows(3)) {
                let angle = (p[0] - 2.0 * p[1] + p[2]).norm();
                *bend = stiffness * robust_fit::weight(angle / FOLD_ANGLE);
            }
        }
        curve = smoothed(points, &trust, &bends);
    }
    curve.into_iter().map(Into::into).collect()
}

/// Minimises the sum of weighted squared distances from the points and of weighted squared second differences (Whittaker's
/// smoother), coordinate by coordinate.
fn smoothed(points: &[[f64; 2]], trust: &[f64], bends: &[f64]) -> Vec<Vector2<f64>> {
    let [x, y] = [0, 1].map(|k| {
        let mut system = BorderedSystem::new(points.len(), 2, 0);
        for (i, (point, weight)) in points.iter().zip(trust).enumerate() {
            let root = weight.sqrt();
            system.add(&[(i, root)], &[], -root * point[k]);
        }
        for (i, weight) in bends.iter().enumerate() {
            let root = weight.sqrt();
            system.add(&[(i, root), (i + 1, -2.0 * root), (i + 2, root)], &[], 0.0);
        }
        // Every point has a weight, so that there is a solution.
        system.solve(0.0).map_or(Vec::new(), |(found, _)| found)
    });
    (x.into_iter().zip(y))
        .map(|(x, y)| Vector2::new(x, y))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_of_the_path_is_left_out_and_a_fold_hardly_rounded() {
        // A fold of 0.3 radians at 200, and ground taken along over 25 pixels.
        let truth = |x: f64| {
            if x < 200.0 {
                50.0
            } else {
                50.0 + 0.3 * (x - 200.0)
            }
        };
        let points: Vec<[f64; 2]> = (0..400)
            .map(|i| {
                let x = f64::from(i);
                let ground = if (90..115).contains(&i) { 7.0 } else { 0.0 };
                [x, truth(x) + ground + 0.4 * (1.7 * x).sin()]
            })
            .collect();
        for [x, y] in piecewise_smooth(&points, 25.0) {
            // The ground is seven pixels off, and an edge is rounded beside a fold.
            let most = if x < 150.0 { 1.5 } else { 3.0 };
            assert!((y - truth(x)).abs() < most, "{x} {y} {}", truth(x));
        }
    }

    #[test]
    fn a_circle_stays_round() {
        let points: Vec<[f64; 2]> = (0..500)
            .map(|i| {
                let angle = f64::from(i) / 300.0;
                [300.0 * angle.cos(), 300.0 * angle.sin()]
            })
            .collect();
        let off: Vec<f64> = (piecewise_smooth(&points, 25.0).into_iter())
            .map(|[x, y]| (x.hypot(y) - 300.0).abs())
            .collect();
        // The ends are free, so that they bend less than what lies between.
        assert!(off.iter().all(|off| *off < 3.0), "{off:?}");
        assert!(off[100..400].iter().all(|off| *off < 0.3), "{off:?}");
    }
}
