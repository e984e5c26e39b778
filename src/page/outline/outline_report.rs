//! Result of the search for pages in a photo: outlines with corners and edges, a verdict, and the reasons for it.

use crate::error::{Error, Result};
use crate::math::planar::{distance_to_segment, polygon_area, polygon_contains};
use crate::page::edges::{Edges, Trace};

/// Verdict of a search for the outline of a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
#[non_exhaustive]
pub enum OutlineVerdict {
    /// One page was found, with a clear edge all around.
    Found,
    /// One page was found, but something about its outline is uncertain: see the reasons.
    Doubtful,
    /// Several pages side by side were found, listed by decreasing score: choose one.
    Several,
    /// No page was found that can be told from its background.
    NotFound,
}

/// Reason why an outline is doubtful or was not found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
#[non_exhaustive]
pub enum OutlineReason {
    /// A corner is outside of the photo; its position is extrapolated from the edges.
    CornerOutside,
    /// A corner is covered, folded over or torn off; its position is extrapolated from the edges.
    CornerCovered,
    /// Most of an edge is outside of the photo, or on its rim.
    EdgeOutside,
    /// Part of an edge has no contrast: something covers it, or page and background look alike.
    FaintEdge,
    /// The outline's shape is unlike that of a sheet of paper.
    UnlikelyShape,
    /// Nothing in the photo looks like a page on a background.
    NoPage,
}

/// The outline of one page in a photo.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PageOutline {
    /// Upper left, upper right, lower right and lower left corner of the page as it is read, in the photo's pixels;
    /// `[0, 0]` is the centre of the photo's upper left pixel. A corner may be outside of the photo.
    pub corners: [[f64; 2]; 4],
    /// Upper, right, lower and left edge as polylines from corner to corner, clockwise, in the photo's pixels.
    pub edges: [Vec<[f64; 2]>; 4],
    /// Confidence that this is the outline of a page, from 0 to 1.
    pub score: f64,
    /// Reasons for which the outline is uncertain.
    pub reasons: Vec<OutlineReason>,
}

impl PageOutline {
    /// Returns the page's edges in the form that [`PageSurface`](crate::page::PageSurface) takes.
    pub fn to_edges(&self) -> Edges {
        let [top, right, bottom, left] = &self.edges;
        let reversed = |edge: &[[f64; 2]]| Trace::Points(edge.iter().rev().copied().collect());
        Edges::All {
            top: Trace::Points(top.clone()),
            bottom: reversed(bottom),
            left: reversed(left),
            right: Trace::Points(right.clone()),
        }
    }

    /// Distance by which a polygon in the photo reaches beyond the page: the largest distance of one of its corners from the
    /// page, as a share of the square root of the page's area in the photo. 0 for a polygon within the page.
    pub fn overreach(&self, polygon: &[[f64; 2]]) -> f64 {
        let outline: Vec<[f64; 2]> = self.edges.concat();
        let distance = |point: [f64; 2]| {
            (0..outline.len())
                .map(|k| distance_to_segment(point, [outline[k], outline[(k + 1) % outline.len()]]))
                .fold(f64::INFINITY, f64::min)
        };
        let outside = |point: &&[f64; 2]| !polygon_contains(&outline, **point);
        let farthest = (polygon.iter().filter(outside))
            .map(|point| distance(*point))
            .fold(0.0, f64::max);
        farthest / polygon_area(&outline).abs().sqrt()
    }

    /// Returns this outline with its lists of corners and edges rotated by `turns` places, so that another corner is
    /// first.
    pub(super) fn turned(mut self, turns: usize) -> Self {
        self.corners.rotate_left(turns % 4);
        self.edges.rotate_left(turns % 4);
        self
    }
}

/// Result of the search for pages in a photo: a verdict, the reasons for it, and the outlines.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OutlineReport {
    /// Verdict of the search: one page, a doubtful one, several, or none.
    pub verdict: OutlineVerdict,
    /// Reasons for which the verdict is not [`OutlineVerdict::Found`]; empty if it is.
    pub reasons: Vec<OutlineReason>,
    /// Outlines by decreasing score: one if the verdict is `Found` or `Doubtful`, several if it is `Several`; if it is
    /// `NotFound` the best guess, if there is any.
    pub pages: Vec<PageOutline>,
}

impl OutlineReport {
    /// Returns the outline of the page to be made flat, which is the one with the highest score.
    ///
    /// # Errors
    /// [`Error::NoPage`] if no page was found.
    pub fn page(&self) -> Result<&PageOutline> {
        match self.pages.first() {
            Some(page) if self.verdict != OutlineVerdict::NotFound => Ok(page),
            _ => Err(Error::NoPage),
        }
    }
}
