//! The result of a search for pages: outlines with corners and edges, a verdict, and the reasons for it.

use crate::error::{Error, Result};
use crate::math::planar::{distance_to_segment, polygon_area, polygon_contains};
use crate::page::edges::{Edges, Trace};

/// Verdict of a search for the outline of a page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "camelCase"))]
#[non_exhaustive]
pub enum OutlineVerdict {
    /// One page, with a clear edge all around.
    Found,
    /// One page, of which something is not clear: see the reasons.
    Doubtful,
    /// Several pages side by side, the best first: choose one.
    Several,
    /// No page that can be told from its ground.
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
    /// Most of an edge is outside of the photo, or on its rim.
    EdgeOutside,
    /// Part of an edge has no contrast: something covers it, or page and ground look alike.
    FaintEdge,
    /// The shape is unlike that of a sheet of paper.
    UnlikelyShape,
    /// Nothing in the photo looks like a page on a ground.
    NoPage,
}

/// The outline of one page in a photo.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PageOutline {
    /// Upper left, upper right, lower right and lower left corner of the page as it is read, in the photo's pixels:
    /// `[0, 0]` is the centre of the upper left one. A corner may be outside of the photo.
    pub corners: [[f64; 2]; 4],
    /// Upper, right, lower and left edge as polylines from corner to corner, clockwise, in the photo's pixels.
    pub edges: [Vec<[f64; 2]>; 4],
    /// How sure the outline is, from 0 to 1.
    pub score: f64,
    /// What is not clear about it.
    pub reasons: Vec<OutlineReason>,
}

impl PageOutline {
    /// The edges in the form that [`CurledPage`](crate::page::CurledPage) takes.
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

    /// The same outline with another corner first: `turns` quarter turns of the page clockwise.
    pub(super) fn turned(mut self, turns: usize) -> Self {
        self.corners.rotate_left(turns % 4);
        self.edges.rotate_left(turns % 4);
        self
    }
}

/// Pages that were found in a photo.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OutlineReport {
    /// Whether one page was found.
    pub verdict: OutlineVerdict,
    /// Why the verdict is not [`OutlineVerdict::Found`]; empty if it is.
    pub reasons: Vec<OutlineReason>,
    /// Outlines, the best first: one of them if the verdict is `Found` or `Doubtful`, more if it is `Several`; of
    /// `NotFound` the best guess, if there is any.
    pub pages: Vec<PageOutline>,
}

impl OutlineReport {
    /// The page to be made flat: the best outline.
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
