//! Report and verdict of a page.

use super::cylinder::Cylinder;
use super::error_estimate::ErrorEstimate;
use super::residual_statistics::ResidualStatistics;
use super::traced_line::TracedLine;
use super::traces::{Residuals, Traces};

/// Verdict on a flat page: whether it can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum PageVerdict {
    /// Both edges are straight, and so are lines of text if they are known; only the perspective is
    /// removed. The page was flat, or it is folded along these edges, which they do not show (the other two
    /// edges do: [`Edges::All`](super::Edges::All)).
    Flat,
    /// The page was curled one way and is flat now, with lengths as on the page.
    Unrolled,
    /// The page may be right: too few points were traced, or one of the edges appears straight however the page
    /// is bent, so that nothing checks the other one.
    Unchecked,
    /// The expected error is above 1 % of the page's width, or the page hides a part of itself, or its
    /// edges and lines disagree by about the accuracy of the traced points.
    Doubtful,
    /// The edges, or the lines of text, cannot belong to a page that is curled one way only: the page is
    /// folded, crumpled or bent both ways, or a line is traced wrongly. Measured depths are needed, or better traces.
    NotThisKind,
}

/// Model of a page's shape, from plain to free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum PageModel {
    /// A plane, seen in perspective: a homography.
    Plane,
    /// A cylinder over any curve: a page that is curled one way.
    Cylinder,
    /// An isometric sheet of any shape: a page that is folded, or bent both ways.
    Sheet,
    /// A sheet that is strained a little: a crumpled page, whose wrinkles are too small to be seen in its outline.
    SoftSheet,
}

/// Verdict and figures of a page that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct PageReport {
    /// Whether the page can be trusted.
    pub verdict: PageVerdict,
    /// Model of the page's shape.
    pub model: PageModel,
    /// Expected displacement of points on the flat page: the root mean square after the best
    /// similarity, in % of a page's width.
    pub error: f64,
    /// Displacement that is not exceeded in 95 of 100 cases if the page is curled one way and the lens does not distort (phones
    /// correct it), in % of a page's width.
    pub error_bound: f64,
    /// Focal length, in pixels of the photo.
    pub focal_length: f64,
    /// Standard deviation of the focal length, in %.
    pub focal_deviation: f64,
    /// Angle between the camera's axis and the normal of the page's chord, in degrees.
    pub tilt: f64,
    /// Range of the page's direction along its curve, in degrees: of the page that bends most.
    pub bend: f64,
    /// Root mean square distance between the traced points and the edge that was found, in pixels: of
    /// the edge that fits worst, or of all lines of text together.
    pub residual: f64,
    /// Part of the residual that neighbouring points of an edge, or neighbouring lines of text, have in common, so that it is
    /// not due to inaccurate tracing, in % of a page's width in the photo.
    pub disagreement: f64,
    /// Number of lines of text that the page was found by besides the edges, given and found ones.
    pub lines: usize,
    /// Number of lines of text that were found in the photo.
    pub lines_found: usize,
    /// Number of lines found in the photo that the page was found by: all or none. If they contradict the edges, the page is
    /// that of the edges, and only the verdict takes them into account.
    pub lines_used: usize,
    /// Part of the distances of lines of text from the page that neighbouring lines have in common, in % of the page's width in
    /// the photo.
    pub lines_disagreement: f64,
    /// Height over width of a page as the edges show it, without use of a format that was given.
    pub ratio: f64,
}

/// Maximum expected error of a page that is not doubtful, as a share of the page's width.
const MAX_TRUSTED_ERROR: f64 = 0.01;

/// Minimum accuracy of traced points that residuals are compared with, as a share of a page's width in the photo: lens
/// distortion, which is not modelled, moves points by about as much.
const MIN_ACCURACY_SHARE: f64 = 0.0007;

/// Maximum residual of an edge with many points, over the accuracy of traced points.
const MAX_EDGE_RESIDUAL: f64 = 1.3;

/// Addition to the maximum residual of an edge, times the square root of its number of independent points: scatter of the
/// residual by chance.
const EDGE_RESIDUAL_SCATTER: f64 = 1.3;

/// Maximum residual of lines of text, over that which is exceeded by chance once in a few thousand times.
const MAX_TEXT_RESIDUAL: f64 = 1.3;

/// Maximum common residual of neighbouring points of an edge, over the accuracy, of a page that is curled one way.
const MAX_COMMON_RESIDUAL: f64 = 1.2;

/// Maximum common residual of neighbouring points of an edge, over the accuracy, of a page that is not doubtful.
const MAX_TRUSTED_COMMON_RESIDUAL: f64 = 0.85;

/// Ratio of the limits of the common residual of lines of text and of edges: the former is free of errors of tracing, which
/// are independent from line to line, so that less of it is significant.
const TEXT_COMMON_RESIDUAL_RATIO: f64 = 0.27;

/// Minimum number of independent points of an edge, corners included, of a page that counts as checked.
const MIN_CHECKED_POINTS: f64 = 4.0;

/// Maximum distance of an edge's points from its chord, in standard deviations of a traced point, of a straight edge.
const MAX_STRAIGHT_BOW: f64 = 3.0;

/// Minimum distance of the more bent edge's points from its chord, over that of a straight edge, for which the other edge has
/// to be bent, too.
const MIN_CHECKED_BOW_RATIO: f64 = 4.0;

/// Minimum distance of the other edge's points from its chord, in standard deviations of a traced point, for which it checks
/// the more bent one.
const MIN_CHECKING_BOW: f64 = 2.0;

/// Quantile of the normal distribution that is exceeded once in a few thousand times.
const CHANCE_QUANTILE: f64 = 3.4;

/// Figures that a verdict is made of.
pub(super) struct VerdictFigures {
    pub estimate: ErrorEstimate,
    /// Statistics of the residuals along each edge.
    pub edges: Vec<ResidualStatistics>,
    /// Statistics of the residuals along each line of text that was given.
    pub text: Vec<ResidualStatistics>,
    /// Covariance of the residuals of neighbouring lines of text, found ones included, in pixels².
    pub common: f64,
    /// Standard deviation of a traced point that was assumed, in pixels.
    pub accuracy: f64,
    /// Mean length of the edges' chords in the photo, in pixels.
    pub edge_length: f64,
    /// Largest distances of the two edges from their chords in the photo, in pixels, the straighter edge last; if
    /// lines of text run like the edges, the two largest of all.
    pub bow: [f64; 2],
    /// Number of independent points of the edge with the fewest, corners included.
    pub fewest_points: f64,
    /// Whether a part of the page is hidden by another.
    pub hidden: bool,
}

impl VerdictFigures {
    /// The verdict on a page.
    pub fn verdict(&self) -> PageVerdict {
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
            return PageVerdict::NotThisKind;
        }
        if self.estimate.expected > MAX_TRUSTED_ERROR
            || self.hidden
            || has_common_residual(MAX_TRUSTED_COMMON_RESIDUAL)
        {
            return PageVerdict::Doubtful;
        }
        let straight = MAX_STRAIGHT_BOW * self.accuracy;
        if self.fewest_points < MIN_CHECKED_POINTS
            || (self.bow[0] > MIN_CHECKED_BOW_RATIO * straight
                && self.bow[1] < MIN_CHECKING_BOW * self.accuracy)
        {
            return PageVerdict::Unchecked;
        }
        if self.bow[0] < straight {
            PageVerdict::Flat
        } else {
            PageVerdict::Unrolled
        }
    }
}

/// Root mean square of `count` normally distributed errors, over its expectation, that is exceeded by chance once
/// in a few thousand times (Wilson and Hilferty's quantile of chi-squared).
fn chance_residual(count: f64) -> f64 {
    let part = 2.0 / (9.0 * count.max(1.0));
    (1.0 - part + CHANCE_QUANTILE * part.sqrt()).powf(1.5)
}

/// The report of a page that was found: its verdict, and the figures that this is made of.
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
    PageReport {
        verdict: findings.verdict(),
        model: PageModel::Cylinder,
        error: 100.0 * estimate.expected,
        error_bound: 100.0 * estimate.bound,
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
