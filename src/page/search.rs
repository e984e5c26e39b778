//! Search for the cylinder on which a page lies, with the degree of its curve that the traces support.

use super::closed_form;
use super::cylinder::Cylinder;
use super::error_estimate::{ErrorEstimate, displacement_between};
use super::prior::Prior;
use super::traced_line::TracedLine;
use super::traces::{Residuals, Traces};

/// Degrees of the polynomial series for the direction of a page's curve that are tried in turn, each from the solution
/// for the previous one.
const CURVE_DEGREES: [usize; 11] = [0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 14];

/// Smallest and largest typical focal length, as multiples of the photo's longer side. A focal length that cannot be
/// determined is assumed to lie between them.
const TYPICAL_FOCAL_RATIOS: [f64; 2] = [0.35, 4.0];

/// Smallest and largest focal length, as multiples of the photo's longer side, from which a search starts.
const FOCAL_SEARCH_RATIOS: [f64; 2] = [0.2, 15.0];

/// Maximum standard deviation of the logarithm of an undetermined focal length that is used for the range of focal
/// lengths that are tried.
const MAX_FOCAL_UNCERTAINTY: f64 = 10.0;

/// Standard deviation of the logarithm of a focal length that is held fixed in a fit.
const HELD_FOCAL_DEVIATION: f64 = 1e-3;

/// Number of successive degrees of the page's curve that may be worse than the best degree before the search ends.
const MAX_WORSE_DEGREES: usize = 3;

/// Degree of the page's curve at which the search starts once more from the initial guess in closed form, beside the
/// solution for the previous degree.
const CLOSED_FORM_DEGREE: usize = 4;

/// Standard deviation of traced points, in pixels, that is added to the residuals in the information criterion, so that
/// exact traces do not call for ever higher degrees.
const MIN_CRITERION_ERROR: f64 = 0.05;

/// Minimum number of observations in excess of parameters that is assumed in Akaike's information criterion, whose
/// correction for few observations divides by it.
const MIN_CRITERION_SPARE: f64 = 0.2;

/// Minimum number of observations in excess of parameters for which a degree of the page's curve is tried.
const MIN_SPARE_DISTANCES: f64 = 2.0;

/// Whether a focal length, in pixels, is within the range from which a search starts; `longer` is the longer side of
/// the photo in pixels.
pub(super) fn is_searched(focal: f64, longer: f64) -> bool {
    (FOCAL_SEARCH_RATIOS[0] * longer..=FOCAL_SEARCH_RATIOS[1] * longer).contains(&focal)
}

/// Search for the cylinder that fits the traced edges and lines of a page best.
pub(super) struct CylinderSearch<'a> {
    pub pages: &'a [[TracedLine; 2]],
    pub traces: &'a Traces,
    /// Principal point of the camera, in pixels.
    pub centre: [f64; 2],
}

impl CylinderSearch<'_> {
    /// Computes the initial cylinder in closed form for a focal length in pixels.
    fn start(&self, focal: f64) -> Option<Cylinder> {
        let mut start = closed_form::cylinder(self.pages, self.centre, focal)?;
        if self.traces.text() > 0 {
            start.skews = vec![0.0; self.pages.len()];
        }
        Some(start)
    }

    /// Extends the error estimate of a page whose focal length cannot be determined to all typical focal lengths. None
    /// unless the flat page is nearly the same for all of them, as that of a page seen from straight above.
    pub(super) fn estimate_for_any_focal_length(
        &self,
        found: ErrorEstimate,
        cylinder: &Cylinder,
        prior: &Prior,
        longer: f64,
    ) -> Option<ErrorEstimate> {
        /// Maximum displacement, over a page's width, between the flat pages for two focal lengths that count as equal.
        const MAX_FOCAL_DISPLACEMENT: f64 = 0.01;
        let middle = cylinder.focal.clamp(
            TYPICAL_FOCAL_RATIOS[0] * longer,
            TYPICAL_FOCAL_RATIOS[1] * longer,
        );
        let mut bound = found.bound;
        for sign in [-2.0, 2.0] {
            let focal = middle * (sign * found.focal.min(MAX_FOCAL_UNCERTAINTY)).exp();
            let focal = focal.clamp(
                TYPICAL_FOCAL_RATIOS[0] * longer,
                TYPICAL_FOCAL_RATIOS[1] * longer,
            );
            let held = Prior {
                focal: Some([focal.ln(), HELD_FOCAL_DEVIATION]),
                ..*prior
            };
            let start = self.start(focal)?;
            let (other, _) = self
                .traces
                .solve(start.with_degree(cylinder.degree()), &held)?;
            bound = bound.max(displacement_between(cylinder, &other)?);
        }
        (bound < MAX_FOCAL_DISPLACEMENT).then(|| ErrorEstimate {
            expected: found.expected.clamp(bound / 2.0, bound),
            bound,
            ..found
        })
    }

    /// Finds the best cylinder of all degrees that the traces support, by an information criterion, from several
    /// initial focal lengths in pixels. None if no fit succeeds.
    pub(super) fn best(&self, focal: &[f64], prior: &Prior) -> Option<(Cylinder, Residuals)> {
        let count = self.traces.count();
        let starts: Vec<Cylinder> = (focal.iter()).filter_map(|f| self.start(*f)).collect();
        let parameters = |degree: usize| {
            (starts.first()).map_or(0, |c| c.clone().with_degree(degree).parameters()) as f64
        };
        let known = f64::from(prior.focal.is_some()) + f64::from(prior.ratio.is_some());
        // Akaike's criterion, corrected for few points. Lines of text are many points in the page's
        // middle, by which a curve of high degree would oscillate at its ends: with them parameters cost as much
        // as in Schwarz's criterion.
        let price = if self.traces.text() > 0 {
            count.ln().max(2.0)
        } else {
            2.0
        };
        let criterion = |residuals: &Residuals, degree: usize| {
            let p = parameters(degree) - known;
            let squares =
                residuals.cost * prior.accuracy.powi(2) + count * MIN_CRITERION_ERROR.powi(2);
            let spare = (count - p - 1.0).max(MIN_CRITERION_SPARE);
            count * (squares / count).ln() + price * p * (1.0 + (p + 1.0) / spare)
        };
        let supported = |degree: usize| count + known - parameters(degree) >= MIN_SPARE_DISTANCES;
        let lowest =
            |one: Option<(Cylinder, Residuals)>, other: Option<(Cylinder, Residuals)>| match (
                one, other,
            ) {
                (Some(one), Some(other)) if one.1.cost <= other.1.cost => Some(one),
                (one, None) => one,
                (_, other) => other,
            };
        let mut best: Option<(Cylinder, Residuals, f64)> = None;
        let mut before: Option<(Cylinder, Residuals)> = None;
        let mut worse = 0;
        for degree in CURVE_DEGREES {
            if degree > 0 && !supported(degree) {
                break;
            }
            let mut found = before
                .clone()
                .and_then(|(cylinder, _)| self.traces.solve(cylinder.with_degree(degree), prior));
            // From the closed form, with its bend and without.
            if degree == 0 || degree == CLOSED_FORM_DEGREE {
                for start in &starts {
                    let start = start.clone().with_degree(degree);
                    found = lowest(found, self.traces.solve(start, prior));
                }
            }
            let Some((cylinder, residuals)) = found else {
                continue;
            };
            let value = criterion(&residuals, degree);
            before = Some((cylinder.clone(), residuals.clone()));
            if best.as_ref().is_none_or(|(_, _, least)| value < *least) {
                best = Some((cylinder, residuals, value));
                worse = 0;
            } else {
                worse += 1;
                if worse > MAX_WORSE_DEGREES && degree > CLOSED_FORM_DEGREE {
                    break;
                }
            }
        }
        best.map(|(cylinder, residuals, _)| (cylinder, residuals))
    }
}
