//! Traced edges of a page and lines of text: points or Bézier curves in a photo's pixels.

/// A traced edge of a page, from one corner to the next, or a traced line of text, in the photo's
/// pixels: `[0, 0]` is the centre of the upper left one.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Trace {
    /// Points on the edge, any number at any distances; the first and the last one are
    /// corners. The edge is smooth between points, not straight, and not seen between two that are more than eight times as
    /// far apart as others.
    Points(Vec<[f64; 2]>),
    /// Cubic Bézier curves that follow each other: 4, 7, 10 … control points.
    Beziers(Vec<[f64; 2]>),
}

impl Trace {
    /// Whether nothing but the two ends of the edge is given.
    pub fn has_ends_alone(&self) -> bool {
        matches!(self, Trace::Points(points) if points.len() == 2)
    }
}

/// The traced edges of a page: the two that are bent, or all four. Each runs from left to right, or from top to bottom;
/// if all run the other way, they are reversed.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Edges {
    /// The upper and the lower edge, of a page whose rulings run from top to bottom, as in a book.
    TopBottom {
        /// The upper edge, as the page is read.
        top: Trace,
        /// The lower edge of the page.
        bottom: Trace,
    },
    /// The left and the right edge, of a page whose rulings run from left to right.
    LeftRight {
        /// The left edge, as the page is read.
        left: Trace,
        /// The right edge of the page.
        right: Trace,
    },
    /// All four edges, each of which may be bent.
    All {
        /// The upper edge, as the page is read.
        top: Trace,
        /// The lower edge of the page.
        bottom: Trace,
        /// The left edge.
        left: Trace,
        /// The right edge of the page.
        right: Trace,
    },
}

impl Edges {
    /// The traces: the upper, lower, left and right one, as far as they are given.
    pub fn traces(&self) -> Vec<&Trace> {
        let [top, right, bottom, left] = self.sides();
        [top, bottom, left, right].into_iter().flatten().collect()
    }

    /// The traces of the sides, clockwise from the upper one, as far as they are given; the lower and the left one run the
    /// other way.
    pub(super) fn sides(&self) -> [Option<&Trace>; 4] {
        match self {
            Edges::TopBottom { top, bottom } => [Some(top), None, Some(bottom), None],
            Edges::LeftRight { left, right } => [None, Some(right), None, Some(left)],
            Edges::All {
                top,
                bottom,
                left,
                right,
            } => [top, right, bottom, left].map(Some),
        }
    }

    /// The traces of [`Edges::sides`], to be changed.
    pub(super) fn sides_mut(&mut self) -> [Option<&mut Trace>; 4] {
        match self {
            Edges::TopBottom { top, bottom } => [Some(top), None, Some(bottom), None],
            Edges::LeftRight { left, right } => [None, Some(right), None, Some(left)],
            Edges::All {
                top,
                bottom,
                left,
                right,
            } => [top, right, bottom, left].map(Some),
        }
    }
}
