//! Fold lines of a drawn sheet, and the segments of polylines and positions along them.

use super::curve::Curve;
use super::options::DrawingOptions;
use crate::math::planar::{distance, polyline_length};
use crate::pattern::{Direction, Fold, Seam};

/// Maximum distance between a curve of a drawing and the polyline that approximates it, in millimetres.
pub(super) const FLATTENING_TOLERANCE_MM: f64 = 0.02;

/// A line segment that tabs and texts must not touch.
pub(super) type Wall = [[f64; 2]; 2];

/// The segments of a polyline.
pub(super) fn walls_of(line: &[[f64; 2]]) -> Vec<Wall> {
    line.windows(2).map(|p| [p[0], p[1]]).collect()
}

/// A fold line of a drawn sheet: a line along which the sheet is folded.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "FoldLine")
)]
#[non_exhaustive]
pub struct Line {
    /// Number of the crease that the fold line follows, from 0, its index in
    /// [`Pattern::creases`](crate::pattern::Pattern::creases); of lines of a bend that are less than a millimetre apart, one is drawn.
    pub crease: usize,
    /// Numbers of the patches on either side of the fold line, from 0, the lower one first.
    #[cfg_attr(feature = "serde", serde(default))]
    pub patches: [u32; 2],
    /// Whether the fold is a mountain or a valley fold, seen from above.
    pub direction: Direction,
    /// Fold angle in degrees: 0 where the sheet stays flat. Folds of at most half a degree are not drawn; a line of a bend also has the angle
    /// of those beside it that are not.
    pub angle: f64,
    /// The smooth bend that the fold line is a part of.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Option::is_none")
    )]
    pub bend: Option<LineBend>,
    /// Length of the fold line, in millimetres.
    pub length: f64,
    /// The fold line as a polyline in millimetres, within a fiftieth of a millimetre of [`Line::curve`].
    pub points: Vec<[f64; 2]>,
    /// The fold line as a smooth curve in millimetres.
    pub curve: Curve,
}

/// A smooth bend: a piece of a cylinder or cone, which is drawn as several fold lines beside each other, or as the one in
/// its middle where metal is bent.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "FoldBend", rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct LineBend {
    /// Angle of the whole bend, in degrees.
    pub angle: f64,
    /// Radius in millimetres: of the surface in the bend, or of its inside where metal is bent.
    pub radius: f64,
    /// Whether the fold line is the one in the middle of the bend.
    pub is_middle: bool,
}

impl Line {
    /// Creates the line of a fold.
    pub(super) fn of_fold(fold: &Fold, curve: Curve, options: &DrawingOptions) -> Self {
        let radius = |on_surface: f64| match &options.bending {
            Some(bending) => bending.inner_radius(fold.seam.direction, on_surface),
            None => on_surface,
        };
        Line {
            bend: fold.bend.map(|bend| LineBend {
                angle: bend.angle.to_degrees(),
                radius: radius(options.scale * bend.radius),
                is_middle: bend.is_middle,
            }),
            ..Line::new(fold.seam, curve)
        }
    }

    pub(super) fn new(seam: Seam, curve: Curve) -> Self {
        let line = Line {
            bend: None,
            crease: seam.crease,
            patches: seam.patches,
            direction: seam.direction,
            angle: seam.angle.to_degrees(),
            length: 0.0,
            points: Vec::new(),
            curve: Curve::of(Vec::new()),
        };
        line.along(curve)
    }

    /// Replaces the curve of this fold line, and computes its polyline and length anew.
    pub(super) fn along(self, curve: Curve) -> Self {
        let points = curve.points(FLATTENING_TOLERANCE_MM);
        Line {
            length: polyline_length(&points),
            points,
            curve,
            ..self
        }
    }
}

/// Computes the point of a polyline at a given length from its beginning, and the direction of the polyline there.
pub(super) fn place_at(points: &[[f64; 2]], along: f64) -> ([f64; 2], [f64; 2]) {
    let (mut rest, mut place, mut heading) = (along, points[0], [1.0, 0.0]);
    for piece in points.windows(2) {
        let step = distance(piece[0], piece[1]);
        if step > 0.0 {
            heading = [0, 1].map(|k| (piece[1][k] - piece[0][k]) / step);
            place = [0, 1].map(|k| piece[0][k] + heading[k] * rest.min(step));
        }
        if rest <= step {
            break;
        }
        rest -= step;
    }
    (place, heading)
}
