//! What is told about a page besides its shape.

use super::estimate::Estimate;
use super::misfit::Misfit;

/// Whether a flat page is to be trusted, in a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum PageVerdict {
    /// Both edges are straight, and so are lines of text where they are known; only the perspective is
    /// taken out. The page was flat, or it is folded along them, which they do not show (its other two
    /// edges do: [`Edges::All`](super::Edges::All)).
    Flat,
    /// The page was curled one way and is flat now, with lengths as on the page.
    Unrolled,
    /// It may be: too few points were traced, or one of the edges looks straight however the page
    /// is bent, so that nothing checks the other one.
    Unchecked,
    /// The page is likely to be wrong by more than 1 % of its width, or hides a part of itself, or its
    /// edges and lines disagree by about as much as they were meant to be traced to.
    Doubtful,
    /// The edges, or the lines of text, are not those of a page that is curled one way only: it is
    /// folded, crumpled, bent both ways, or one is traced wrongly. Depth is needed, or better traces.
    NotThisKind,
}

/// How a page was found.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct PageReport {
    /// The verdict, in a word.
    pub verdict: PageVerdict,
    /// Expected displacement of what is on the flat page, as a root mean square after the best
    /// similarity, in % of a page's width.
    pub error: f64,
    /// The same, but not exceeded in 95 of 100 cases, if the page is curled one way.
    pub error_bound: f64,
    /// Focal length, in pixels of the photo.
    pub focal_length: f64,
    /// Its standard deviation, in %.
    pub focal_deviation: f64,
    /// Angle between the camera's axis and the normal of the page's chord, in degrees.
    pub tilt: f64,
    /// By how much the page's direction changes from one end of its curve to the other at most, in
    /// degrees.
    pub bend: f64,
    /// Root mean square of the distances between the traced points and the edge found, in pixels; of
    /// the edge that fits worst, or of all lines of text together.
    pub residual: f64,
    /// The part of it that goes on from point to point along an edge, or from one line of text to the
    /// next, which is no scatter of a hand: by how much they disagree, in % of a page's width as it is
    /// seen.
    pub disagreement: f64,
    /// Lines of text that it was found by besides the edges, given and found.
    pub lines: usize,
    /// Lines of text that were found in the photo by themselves.
    pub lines_found: usize,
    /// Those of them that it was found by, all or none: if they contradict the edges, the page is that of the edges,
    /// and only the verdict is theirs.
    pub lines_used: usize,
    /// By how much lines of text disagree with the page, in % of its width as it is seen: what neighbouring ones
    /// have in common of it.
    pub lines_disagreement: f64,
    /// Height over width of a page as it is seen, without use of a format that was given.
    pub ratio: f64,
}

/// What a verdict is made of.
pub(super) struct Findings {
    pub estimate: Estimate,
    /// How the residuals are spread along each of the edges.
    pub edges: Vec<Misfit>,
    /// Likewise along lines of text that were given.
    pub text: Vec<Misfit>,
    /// What lines of text, found ones too, have in common, as a mean square in pixels².
    pub common: f64,
    /// Standard deviation that was assumed.
    pub accuracy: f64,
    /// Length of a page's edge as it is seen, in pixels.
    pub seen: f64,
    /// How far from straight the two edges are seen, in pixels, the straighter one last; if there are
    /// lines of text that run like them, the two least straight of all.
    pub bow: [f64; 2],
    /// Independent points of the edge with fewest, corners included.
    pub fewest: f64,
    /// Whether a part of the page lies behind another.
    pub hidden: bool,
}

impl Findings {
    pub fn verdict(&self) -> PageVerdict {
        /// Share of the page's width.
        const DOUBTFUL: f64 = 0.01;
        /// What lines have in common is free of errors of tracing them, so that less of it tells.
        const LINES: f64 = 0.27;
        // No lens is true to less than this share of the width.
        let least = self.accuracy.max(0.0007 * self.seen);
        // What that many points come to by chance, and a little more.
        let scatter = 1.3 + 1.3 / self.fewest.sqrt();
        let over = |limit: f64| {
            let smooth = |own: &Misfit| own.smooth.sqrt() > limit * least;
            self.edges.iter().any(smooth) || self.common.sqrt() > LINES * limit * least
        };
        let far =
            |own: &Misfit| own.all.sqrt() > 1.3 * chance(own.count / own.correlation()) * least;
        if over(1.2)
            || self
                .edges
                .iter()
                .any(|own| own.all.sqrt() > scatter * least)
            || self.text.iter().any(far)
            || Misfit::together(&self.text).is_some_and(|all| far(&all))
        {
            return PageVerdict::NotThisKind;
        }
        if self.estimate.expected > DOUBTFUL || self.hidden || over(0.85) {
            return PageVerdict::Doubtful;
        }
        let straight = 3.0 * self.accuracy;
        if self.fewest < 4.0 || (self.bow[0] > 4.0 * straight && self.bow[1] < 2.0 * self.accuracy)
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

/// What so many points' root mean square exceeds once in a few thousand times, over its expectation
/// (Wilson and Hilferty's quantile of chi-squared).
fn chance(count: f64) -> f64 {
    let part = 2.0 / (9.0 * count.max(1.0));
    (1.0 - part + 3.4 * part.sqrt()).powf(1.5)
}
