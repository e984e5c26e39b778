//! A traced ruling: its points, its length, and how straight it is.

/// A traced ruling: a nearly straight line in a surface.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Ruling {
    /// Points along the ruling on the surface: one for each edge that it crosses.
    pub points: Vec<[f64; 3]>,
    /// Distance between the two ends of the ruling, in the surface's units.
    pub length: f64,
    /// Deviation of the ruling from a straight line: the largest distance of a point from the line through the
    /// ends, divided by the ruling's length.
    pub deviation: f64,
}

impl Ruling {
    /// Creates a ruling from the points along it; `None` if its ends coincide.
    pub(super) fn new(points: Vec<[f64; 3]>) -> Option<Self> {
        let (first, last) = (*points.first()?, *points.last()?);
        let difference = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        let norm = |v: [f64; 3]| v[0].hypot(v[1]).hypot(v[2]);
        let axis = difference(last, first);
        let length = norm(axis);
        if length == 0.0 {
            return None;
        }
        let off = |p: &[f64; 3]| {
            let v = difference(*p, first);
            let share = (0..3).map(|k| v[k] * axis[k]).sum::<f64>() / (length * length);
            norm([0, 1, 2].map(|k| v[k] - share * axis[k]))
        };
        let deviation = points.iter().map(off).fold(0.0, f64::max) / length;
        Some(Ruling {
            points,
            length,
            deviation,
        })
    }
}
