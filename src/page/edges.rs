//! The edges of a page as they were traced.

/// An edge as it was traced in a photo, from one corner of the page to the next, in the photo's
/// pixels: `[0, 0]` is the centre of the upper left one.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Trace {
    /// Points on the edge, as many as there are, at any distances; the first and the last one are
    /// corners. Between them the edge is smooth, not straight.
    Points(Vec<[f64; 2]>),
    /// Cubic Bézier curves that follow each other: 4, 7, 10 … control points.
    Beziers(Vec<[f64; 2]>),
}

/// The edges of a page: the two that are bent, or all. Each is listed from left to right, or from top to bottom; if all
/// are the other way round that is seen and mended.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Edges {
    /// Of a page whose rulings run from top to bottom, as a book's.
    TopBottom {
        /// The upper edge as one reads.
        top: Trace,
        /// The lower one.
        bottom: Trace,
    },
    /// Of a page whose rulings run from left to right.
    LeftRight {
        /// The left edge as one reads.
        left: Trace,
        /// The right one.
        right: Trace,
    },
    /// All four, of which two are bent and the other two straight: which ones is seen. The straight
    /// ones check the page: a letter that is folded along two of its edges shows it by the others.
    All {
        /// The upper edge as one reads.
        top: Trace,
        /// The lower one.
        bottom: Trace,
        /// The left one.
        left: Trace,
        /// The right one.
        right: Trace,
    },
}
