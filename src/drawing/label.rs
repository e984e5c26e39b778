//! Texts on the sheets of a drawing: their contents, sizes and positions.

use super::curve::Curve;
use super::line::{FLATTENING_TOLERANCE_MM, Line, place_at};
use super::tabs::Tab;
use crate::math::planar::{Point2, cross, distance, polyline_length};
use crate::pattern::Direction;

/// Font size of a text beside a sheet, and maximum font size of a text along a line, in millimetres.
const NOTE_SIZE_MM: f64 = 3.0;

/// Maximum font size of a text in a drawing, in millimetres.
const MAX_TEXT_SIZE_MM: f64 = 12.0;

/// Minimum font size of a text in a drawing, in millimetres.
const MIN_TEXT_SIZE_MM: f64 = 1.5;

/// A text on a sheet of a drawing or beside it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "DrawingLabel")
)]
#[non_exhaustive]
pub struct Label {
    /// Subject of the text: a patch, a cut crease, a fold or a sheet.
    pub kind: LabelKind,
    /// The text's characters.
    pub text: String,
    /// Position of the middle of the text in the drawing, in millimetres.
    pub place: [f64; 2],
    /// Font size of the text, in millimetres.
    pub size: f64,
    /// Angle of the text, in degrees counter-clockwise.
    pub turn: f64,
}

/// Subject of a text in a drawing: what the text numbers or names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "DrawingLabelKind", rename_all = "lowercase")
)]
#[non_exhaustive]
pub enum LabelKind {
    /// The number of a patch, on it or beside its sheet.
    Patch,
    /// The letter of a cut crease, along the cut or on a tab.
    Seam,
    /// Direction (mountain or valley) and angle of a fold, along it.
    Fold,
    /// The name of a sheet, above the sheet.
    Sheet,
}

impl Label {
    pub(super) fn patch(patch: u32, place: [f64; 2], room: f64) -> Self {
        Label {
            kind: LabelKind::Patch,
            text: (patch + 1).to_string(),
            place,
            size: (0.8 * room).clamp(MIN_TEXT_SIZE_MM, MAX_TEXT_SIZE_MM),
            turn: 0.0,
        }
    }

    /// Returns whether a patch is too small for its number; `room` is the distance from the label's place to the
    /// patch's border, in millimetres.
    pub(super) fn is_cramped(room: f64) -> bool {
        0.8 * room < MIN_TEXT_SIZE_MM
    }

    /// Moves this label to a place beside its sheet, where a leader line connects it to its patch.
    pub(super) fn outside(self, place: [f64; 2]) -> Self {
        Label {
            place,
            size: NOTE_SIZE_MM,
            ..self
        }
    }

    /// Returns whether this label stands beside its sheet, which it does if a leader line ends at it.
    pub(super) fn is_beside(&self, leaders: &[Curve]) -> bool {
        self.kind == LabelKind::Patch
            && (leaders.iter().flat_map(|line| line.controls().last()))
                .any(|end| distance(*end, self.place) < 1.5 * NOTE_SIZE_MM)
    }

    /// Computes the four corners of an approximate bounding box of the label's text, in millimetres.
    pub(super) fn corners(&self) -> Vec<[f64; 2]> {
        let half = [
            0.3 * self.size * self.text.chars().count() as f64,
            0.6 * self.size,
        ];
        let at = |x: f64, y: f64| [self.place[0] + x * half[0], self.place[1] + y * half[1]];
        vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)]
    }

    /// Corners of the text's bounding box, turned with the text.
    fn turned_corners(&self) -> Vec<Point2> {
        let (sin, cos) = self.turn.to_radians().sin_cos();
        let middle = Point2::new(self.place[0], self.place[1]);
        let turned =
            |[x, y]: [f64; 2]| middle + Point2::new(cos, sin) * (Point2::new(x, y) - middle);
        self.corners().into_iter().map(turned).collect()
    }

    /// Returns whether two texts lie on each other.
    fn touches(&self, other: &Label) -> bool {
        let (one, two) = (self.turned_corners(), other.turned_corners());
        let is_apart = |p: &[Point2], q: &[Point2]| {
            (0..4).any(|k| {
                let (from, along) = (p[k], p[(k + 1) % 4] - p[k]);
                q.iter().all(|v| cross(along, v - from) <= 0.0)
            })
        };
        !is_apart(&one, &two) && !is_apart(&two, &one)
    }

    /// Makes texts smaller that lie on others, and leaves out those for which that is not enough: angles of folds first,
    /// then numbers. Letters of seams stay.
    pub(super) fn without_collisions(mut labels: Vec<Label>) -> Vec<Label> {
        let rank = |label: &Label| match label.kind {
            LabelKind::Seam => 0,
            LabelKind::Fold => 2,
            _ => 1,
        };
        labels.sort_by_key(rank);
        let mut out: Vec<Label> = Vec::new();
        for label in labels {
            let is_free = |label: &Label| !out.iter().any(|other| label.touches(other));
            let smallest = Label {
                size: label.size.min(MIN_TEXT_SIZE_MM),
                ..label.clone()
            };
            let smaller = Label {
                size: 0.5 * (label.size + smallest.size),
                ..label.clone()
            };
            let must_stay = label.kind == LabelKind::Seam;
            let mut tried = [label, smaller, smallest.clone()].into_iter();
            let kept = tried.find(is_free);
            out.extend(kept.or_else(|| must_stay.then_some(smallest)));
        }
        out
    }

    /// Creates the label with the letter of a cut crease, to the left of the middle of the crease's line.
    pub(super) fn seam(letter: &str, points: &[[f64; 2]]) -> Self {
        Label::beside(LabelKind::Seam, letter.into(), points, 1.0)
    }

    pub(super) fn fold(line: &Line) -> Self {
        let way = match line.direction {
            Direction::Mountain => 'M',
            Direction::Valley => 'V',
        };
        let text = format!("{way} {:.0}°", line.angle);
        Label::beside(LabelKind::Fold, text, &line.points, 0.8)
    }

    pub(super) fn tab(letter: &str, tab: &Tab) -> Self {
        let label = Label::beside(
            LabelKind::Seam,
            letter.into(),
            &tab.base.points(FLATTENING_TOLERANCE_MM),
            0.0,
        );
        let size = label.size.min(0.7 * tab.depth);
        Label {
            place: tab.middle,
            size,
            ..label
        }
    }

    pub(super) fn sheet(name: &str, [min, max]: [[f64; 2]; 2]) -> Self {
        Label {
            kind: LabelKind::Sheet,
            text: name.into(),
            place: [0.5 * (min[0] + max[0]), max[1] + NOTE_SIZE_MM],
            size: NOTE_SIZE_MM,
            turn: 0.0,
        }
    }

    /// Creates a small text that belongs to no sheet, such as the name of a printed page.
    #[cfg(feature = "patterns")]
    pub(crate) fn note(text: &str, place: [f64; 2]) -> Self {
        Label {
            kind: LabelKind::Sheet,
            text: text.into(),
            place,
            size: NOTE_SIZE_MM,
            turn: 0.0,
        }
    }

    /// Creates a text along a line, to the left of the line's middle, at a distance that is a multiple of the text's
    /// font size.
    fn beside(kind: LabelKind, text: String, points: &[[f64; 2]], away: f64) -> Self {
        let long = polyline_length(points);
        let size = (0.2 * long).clamp(MIN_TEXT_SIZE_MM, NOTE_SIZE_MM);
        let (place, along) = place_at(points, 0.5 * long);
        let [x, y] = along;
        let mut label = Label {
            kind,
            text,
            place: [place[0] - away * size * y, place[1] + away * size * x],
            size,
            turn: 0.0,
        };
        label.turn_by(y.atan2(x).to_degrees());
        label
    }

    /// Estimates the width of a sheet's name, and its height with the empty space around it, in millimetres.
    pub(super) fn extent(&self) -> [f64; 2] {
        let letters = self.text.chars().count() as f64;
        [0.6 * self.size * letters, 2.0 * self.size]
    }

    pub(super) fn is_sheet(&self) -> bool {
        self.kind == LabelKind::Sheet
    }

    /// Rotates the label when its sheet is rotated, by 180° more if the text would be upside down.
    pub(super) fn turn_by(&mut self, degrees: f64) {
        let turned = (self.turn + degrees).rem_euclid(180.0);
        // Text runs to the right or upwards.
        self.turn = if turned > 90.5 {
            turned - 180.0
        } else {
            turned
        };
    }
}
