//! Huber's penalty of residuals in the fit of a page: quadratic for small distances, linear for outliers.

/// Distance of a traced point from the page's model, in standard deviations, above which it is an outlier and penalised
/// linearly. Limits the influence of a wrongly traced point.
const OUTLIER_THRESHOLD: f64 = 3.0;

/// Huber's penalty of a residual, `distance` in standard deviations: quadratic up to the outlier threshold, linear
/// above.
pub(super) fn huber_cost(distance: f64) -> f64 {
    if distance > OUTLIER_THRESHOLD {
        OUTLIER_THRESHOLD * (2.0 * distance - OUTLIER_THRESHOLD)
    } else {
        distance * distance
    }
}

/// Huber's weight of a residual, `distance` in standard deviations, for iteratively reweighted least squares: 1, or
/// less for an outlier.
pub(super) fn huber_weight(distance: f64) -> f64 {
    if distance > OUTLIER_THRESHOLD {
        OUTLIER_THRESHOLD / distance
    } else {
        1.0
    }
}
