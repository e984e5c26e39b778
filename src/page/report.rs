//! Report on a page that was found in a photo: the verdict on its fit and the measures behind that.

use super::cylinder::Cylinder;
use super::error_estimate::ErrorEstimate;
use super::residual_statistics::ResidualStatistics;
use super::traced_line::TracedLine;
use super::traces::{Residuals, Traces};
use super::working_photo::PhotoScale;

/// Verdict on a flat page: whether it can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum PageVerdict {
    /// Both bent edges are straight, and so are lines of text if they are known; only the perspective is removed. The
    /// page was flat, or it is folded along these edges, which they do not show (the other two edges do, if
    /// all four are given).
    Flat,
    /// The page was curled in one direction and is flat now, with lengths as on the page.
    Unrolled,
    /// The flat page may be right, but nothing checks it: too few points were traced, or one of the edges appears
    /// straight however the page is bent.
    Unchecked,
    /// The flat page may be wrong: the expected error is above 1 % of the page's width, or the page hides a part of
    /// itself, or its edges and lines disagree by about the accuracy of the traced points.
    Doubtful,
    /// The edges, or the lines of text, cannot belong to a page that is curled in one direction only: the page is
    /// folded, crumpled or bent both ways, or a line is traced wrongly. Measured depths are needed, or better traces.
    NotThisKind,
}

/// Main reason why a flat page is doubtful ([`PageVerdict::Doubtful`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum PageDoubt {
    /// The expected error is above 1 % of the page's width.
    LargeError,
    /// A part of the page hides another part from the camera.
    HiddenPart,
    /// Edges and lines of text disagree by about the accuracy of the traced points.
    Disagreement,
    /// Fewer than eight lines of text were detected, and a sheet of any shape is not determined by its edges alone.
    FewLines,
    /// The page is crumpled: its model is a sheet that is strained.
    Crumpled,
    /// The page is bent so strongly that its model may be wrong between edges and lines.
    StrongBend,
    /// The outline that was found in the photo is doubtful.
    Outline,
}

/// Model of a page's shape, from the plainest to the most general.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum PageModel {
    /// A plane seen in perspective: a homography maps it to the photo.
    Plane,
    /// A cylinder over any curve: a page that is curled in one direction.
    Cylinder,
    /// An isometric sheet of any shape, bent without strain: a page that is folded, or bent both ways.
    Sheet,
    /// A sheet that is slightly strained: a crumpled page, whose wrinkles are too small to be visible in its outline.
    SoftSheet,
}

/// Verdict on a page that was found in a photo, with the measures of its fit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct PageReport {
    /// Whether the flat page can be trusted.
    pub verdict: PageVerdict,
    /// Main reason for the verdict [`PageVerdict::Doubtful`]; `None` for other verdicts.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub doubt: Option<PageDoubt>,
    /// Model that was fitted to the page's shape: plane, cylinder or sheet.
    pub model: PageModel,
    /// Expected displacement of points on the flat page: the root mean square after the best
    /// similarity, in % of a page's width.
    pub error: f64,
    /// Displacement that is not exceeded in 95 of 100 cases if the page is curled in one direction and the lens does
    /// not distort (phones correct it), in % of a page's width.
    pub pinhole_error_bound: f64,
    /// Focal length of the camera, in pixels of the photo.
    pub focal_length: f64,
    /// Standard deviation of the focal length, in %.
    pub focal_deviation: f64,
    /// Angle between the camera's axis and the normal of the page's chord plane, in degrees.
    pub tilt: f64,
    /// Angle by which the page's tangent turns along its curve (largest minus smallest direction), in degrees; the
    /// larger one of a spread's two pages.
    pub bend: f64,
    /// Root mean square distance between the traced points and the page's model, in pixels: of the edge that fits
    /// worst, or of all lines of text together.
    pub residual: f64,
    /// Part of the residual that is correlated between neighbouring points of an edge, or between neighbouring lines of
    /// text, so that it is not due to inaccurate tracing; in % of a page's width in the photo.
    pub disagreement: f64,
    /// Number of lines of text that the fit of the page used besides the edges, traced and detected ones.
    pub lines: usize,
    /// Number of lines of text that were detected in the photo.
    pub lines_found: usize,
    /// Number of detected lines of text that the fit of the page used: all or none. If they contradict the edges, the
    /// page is fitted to the edges alone, and only the verdict takes the lines into account.
    pub lines_used: usize,
    /// Part of the residual of lines of text that is correlated between neighbouring lines, in % of the page's width in
    /// the photo.
    pub lines_disagreement: f64,
    /// Ratio of the page's height to its width as the edges show it, without use of a given format.
    pub ratio: f64,
}

impl PageReport {
    /// Returns the report on a page whose outline was found with doubt: what follows from the outline is doubtful, too.
    pub fn with_doubtful_outline(self) -> Self {
        match self.verdict {
            PageVerdict::Doubtful | PageVerdict::NotThisKind => self,
            _ => PageReport {
                verdict: PageVerdict::Doubtful,
                doubt: Some(PageDoubt::Outline),
                ..self
            },
        }
    }

    /// Converts what is in pixels of the working photo to pixels of the photo.
    pub(super) fn in_full_photo(self, scale: PhotoScale) -> Self {
        PageReport {
            focal_length: scale.block * self.focal_length,
            residual: scale.block * self.residual,
            ..self
        }
    }
}

/// Maximum expected error of the flat page for a verdict other than `Doubtful`, as a share of the page's width.
const MAX_TRUSTED_ERROR: f64 = 0.01;

/// Minimum standard deviation of traced points that residuals are compared with, as a share of a page's width in the
/// photo: lens distortion, which is not modelled, moves points by about as much.
const MIN_ACCURACY_SHARE: f64 = 0.0007;

/// Maximum root mean square residual of an edge with many points, as a multiple of the traced points' standard
/// deviation.
const MAX_EDGE_RESIDUAL: f64 = 1.3;

/// Addition to [`MAX_EDGE_RESIDUAL`], times the square root of the edge's number of independent points: random scatter
/// of the residual.
const EDGE_RESIDUAL_SCATTER: f64 = 1.3;

/// Maximum root mean square residual of lines of text, as a multiple of the residual that chance exceeds once in a few
/// thousand times.
const MAX_TEXT_RESIDUAL: f64 = 1.3;

/// Maximum correlated residual of neighbouring points of an edge, as a multiple of the traced points' standard
/// deviation; above it the page is not curled in one direction.
const MAX_COMMON_RESIDUAL: f64 = 1.2;

/// Maximum correlated residual of neighbouring points of an edge, as a multiple of the traced points' standard
/// deviation, for a verdict other than `Doubtful`.
const MAX_TRUSTED_COMMON_RESIDUAL: f64 = 0.85;

/// Ratio of the limit for correlated residuals of lines of text to that of edges: the former contain no errors of
/// tracing, which are independent from line to line, so that a smaller one is significant.
const TEXT_COMMON_RESIDUAL_RATIO: f64 = 0.27;

/// Minimum number of independent points of an edge, corners included, for a verdict other than `Unchecked`.
const MIN_CHECKED_POINTS: f64 = 4.0;

/// Maximum distance of a straight edge's points from its chord, in standard deviations of a traced point.
const MAX_STRAIGHT_BOW: f64 = 3.0;

/// Minimum bow (largest distance from the chord) of the more bent edge, as a multiple of that of a straight edge, for
/// which the other edge has to be bent, too.
const MIN_CHECKED_BOW_RATIO: f64 = 4.0;

/// Minimum bow (largest distance from the chord) of the straighter edge, in standard deviations of a traced point, for
/// it to check the more bent one.
const MIN_CHECKING_BOW: f64 = 2.0;

/// Quantile of the standard normal distribution that is exceeded once in a few thousand times.
const CHANCE_QUANTILE: f64 = 3.4;

/// Measures from which the verdict on a curled page is derived.
pub(super) struct VerdictFigures {
    pub estimate: ErrorEstimate,
    /// Residual statistics of each edge.
    pub edges: Vec<ResidualStatistics>,
    /// Residual statistics of each line of text that the caller traced.
    pub text: Vec<ResidualStatistics>,
    /// Covariance of the residuals of neighbouring lines of text, detected ones included, in pixels².
    pub common: f64,
    /// Assumed standard deviation of a traced point, in pixels.
    pub accuracy: f64,
    /// Mean length of the edges' chords in the photo, in pixels.
    pub edge_length: f64,
    /// Bows (largest distances from the chord) of the two edges in the photo, in pixels, the larger one first; if lines
    /// of text run like the edges, the two largest bows of edges and lines.
    pub bow: [f64; 2],
    /// Number of independent points of the edge that has the fewest, corners included.
    pub fewest_points: f64,
    /// Whether a part of the page hides another part from the camera.
    pub hidden: bool,
}

impl VerdictFigures {
    /// Derives the verdict on a page from the measures of its fit, and the reason if it is `Doubtful`.
    pub fn verdict(&self) -> (PageVerdict, Option<PageDoubt>) {
        let accuracy = self.accuracy.max(MIN_ACCURACY_SHARE * self.edge_length);
        let max_residual = MAX_EDGE_RESIDUAL + EDGE_RESIDUAL_SCATTER / self.fewest_points.sqrt();
        let has_common_residual = |limit: f64| {
            let edge = |own: &ResidualStatistics| own.common.sqrt() > limit * accuracy;
            self.edges.iter().any(edge)
                || self.common.sqrt() > TEXT_COMMON_RESIDUAL_RATIO * limit * accuracy
        };
        let far = |own: &ResidualStatistics| {
            own.mean_square.sqrt()
                > MAX_TEXT_RESIDUAL
                    * chance_residual(own.independent / own.points_per_error())
                    * accuracy
        };
        if has_common_residual(MAX_COMMON_RESIDUAL)
            || self
                .edges
                .iter()
                .any(|own| own.mean_square.sqrt() > max_residual * accuracy)
            || self.text.iter().any(far)
            || ResidualStatistics::pooled(&self.text).is_some_and(|all| far(&all))
        {
            return (PageVerdict::NotThisKind, None);
        }
        let doubts = [
            (
                self.estimate.expected > MAX_TRUSTED_ERROR,
                PageDoubt::LargeError,
            ),
            (self.hidden, PageDoubt::HiddenPart),
            (
                has_common_residual(MAX_TRUSTED_COMMON_RESIDUAL),
                PageDoubt::Disagreement,
            ),
        ];
        if let Some((_, doubt)) = doubts.into_iter().find(|(applies, _)| *applies) {
            return (PageVerdict::Doubtful, Some(doubt));
        }
        let straight = MAX_STRAIGHT_BOW * self.accuracy;
        if self.fewest_points < MIN_CHECKED_POINTS
            || (self.bow[0] > MIN_CHECKED_BOW_RATIO * straight
                && self.bow[1] < MIN_CHECKING_BOW * self.accuracy)
        {
            return (PageVerdict::Unchecked, None);
        }
        if self.bow[0] < straight {
            (PageVerdict::Flat, None)
        } else {
            (PageVerdict::Unrolled, None)
        }
    }
}

/// Limit of the root mean square of `count` normally distributed errors of unit variance that chance exceeds once in a
/// few thousand times (Wilson and Hilferty's quantile of chi-squared).
fn chance_residual(count: f64) -> f64 {
    let part = 2.0 / (9.0 * count.max(1.0));
    (1.0 - part + CHANCE_QUANTILE * part.sqrt()).powf(1.5)
}

/// Makes the report on a curled page: the verdict and the measures of its fit.
pub(super) fn report(
    cylinder: &Cylinder,
    pages: &[[TracedLine; 2]],
    traces: &Traces,
    residuals: &Residuals,
    estimate: ErrorEstimate,
    accuracy: f64,
) -> PageReport {
    let [edges, text, found] = traces.statistics(residuals);
    let common = traces.common(residuals);
    // The largest of the edges, or that of all lines of text.
    let lines = ResidualStatistics::pooled(&[&text[..], &found].concat());
    let worst = |of: fn(&ResidualStatistics) -> f64, of_lines: f64| {
        let squares = edges.iter().map(of);
        squares.fold(of_lines, f64::max).sqrt()
    };
    let residual = worst(
        |own| own.mean_square,
        lines.map_or(0.0, |own| own.mean_square),
    );
    let common_residual = worst(|own| own.common, common);
    let lines = || pages.iter().flatten();
    let seen = lines().map(TracedLine::chord).sum::<f64>() / lines().count() as f64;
    let mut bow = traces.bows(cylinder).unwrap_or(vec![f64::INFINITY; 2]);
    bow.sort_by(|p, q| q.total_cmp(p));
    let fewest = lines()
        .map(|line| line.independent)
        .fold(f64::INFINITY, f64::min);
    let lines_found = found.len();
    let findings = VerdictFigures {
        estimate,
        edges,
        text,
        common,
        accuracy,
        edge_length: seen,
        bow: [bow[0], bow[1]],
        fewest_points: fewest,
        hidden: cylinder.has_hidden_part(),
    };
    let (verdict, doubt) = findings.verdict();
    PageReport {
        verdict,
        doubt,
        model: PageModel::Cylinder,
        error: 100.0 * estimate.expected,
        pinhole_error_bound: 100.0 * estimate.bound,
        focal_length: cylinder.focal,
        focal_deviation: 100.0 * estimate.focal,
        tilt: cylinder.axes.column(1).z.abs().min(1.0).acos().to_degrees(),
        bend: cylinder.bend().to_degrees(),
        residual,
        disagreement: 100.0 * common_residual / seen,
        lines: traces.text(),
        lines_found,
        lines_used: lines_found,
        lines_disagreement: 100.0 * common.sqrt() / seen,
        ratio: cylinder.length,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_is_not_surer_than_its_outline() {
        let report = |verdict, doubt| PageReport {
            verdict,
            doubt,
            model: PageModel::Plane,
            error: 0.1,
            pinhole_error_bound: 0.2,
            focal_length: 1000.0,
            focal_deviation: 1.0,
            tilt: 0.0,
            bend: 0.0,
            residual: 0.1,
            disagreement: 0.0,
            lines: 9,
            lines_found: 9,
            lines_used: 9,
            lines_disagreement: 0.0,
            ratio: 1.4,
        };
        for verdict in [
            PageVerdict::Flat,
            PageVerdict::Unrolled,
            PageVerdict::Unchecked,
        ] {
            let found = report(verdict, None).with_doubtful_outline();
            assert_eq!(
                found,
                report(PageVerdict::Doubtful, Some(PageDoubt::Outline))
            );
        }
        for (verdict, doubt) in [
            (PageVerdict::NotThisKind, None),
            (PageVerdict::Doubtful, Some(PageDoubt::Crumpled)),
        ] {
            assert_eq!(
                report(verdict, doubt).with_doubtful_outline(),
                report(verdict, doubt)
            );
        }
    }

    #[test]
    fn a_doubtful_page_has_a_reason_and_others_have_none() {
        let figures = |expected: f64, hidden: bool, common: f64| VerdictFigures {
            estimate: ErrorEstimate {
                expected,
                bound: 2.0 * expected,
                focal: 0.0,
            },
            edges: Vec::new(),
            text: Vec::new(),
            common,
            accuracy: 1.0,
            edge_length: 1000.0,
            bow: [80.0, 70.0],
            fewest_points: 12.0,
            hidden,
        };
        let trusted_common = TEXT_COMMON_RESIDUAL_RATIO * MAX_TRUSTED_COMMON_RESIDUAL;
        let disagreeing = (1.1 * trusted_common).powi(2);
        let doubtful = |doubt| (PageVerdict::Doubtful, Some(doubt));
        for (found, expected) in [
            (figures(0.001, false, 0.0), (PageVerdict::Unrolled, None)),
            (figures(0.02, false, 0.0), doubtful(PageDoubt::LargeError)),
            (figures(0.001, true, 0.0), doubtful(PageDoubt::HiddenPart)),
            (
                figures(0.001, false, disagreeing),
                doubtful(PageDoubt::Disagreement),
            ),
            (
                figures(0.02, true, 4.0 * disagreeing),
                (PageVerdict::NotThisKind, None),
            ),
        ] {
            assert_eq!(found.verdict(), expected);
        }
    }
}
