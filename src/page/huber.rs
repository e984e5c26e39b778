//! Huber's penalty of distances: quadratic for small ones, linear for outliers.

/// Distance, in standard deviations of a traced point, above which it counts by its size and not by its square.
/// Limits what a point that was traced wrongly moves the page by.
const OUTLIER_THRESHOLD: f64 = 3.0;

/// Huber's penalty of a distance in standard deviations.
pub(super) fn huber_cost(distance: f64) -> f64 {
    if distance > OUTLIER_THRESHOLD {
        OUTLIER_THRESHOLD * (2.0 * distance - OUTLIER_THRESHOLD)
    } else {
        distance * distance
    }
}

/// The weight that makes a squared distance count as by Huber's penalty, for iteratively reweighted least squares.
pub(super) fn huber_weight(distance: f64) -> f64 {
    if distance > OUTLIER_THRESHOLD {
        OUTLIER_THRESHOLD / distance
    } else {
        1.0
    }
}
