//! Traced edges and lines of text, in one order.

/// An edge from its first corner to its last, in the order of the cylinder.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// What the user calls it.
    pub name: &'static str,
    /// Its points, corners included.
    pub points: Vec<[f64; 2]>,
    /// How many independent points that are.
    pub independent: f64,
}

/// What was traced of a page.
#[derive(Debug, Clone)]
pub(super) struct Traced {
    /// The cylinder's first and second edge, both from the curve's start to its end, so that the
    /// corners lie clockwise in the photo.
    pub pair: [Line; 2],
    /// The two other edges, at the curve's start and at its end.
    pub sides: Option<[Line; 2]>,
    /// Lines of text.
    pub text: Vec<Line>,
    /// Lines of text that were found in the photo.
    pub found: Vec<Line>,
}

impl Line {
    pub fn ends(&self) -> [[f64; 2]; 2] {
        [self.points[0], self.points[self.points.len() - 1]]
    }

    pub fn chord(&self) -> f64 {
        let [from, to] = self.ends();
        distance(from, to)
    }
}

pub(super) fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}
