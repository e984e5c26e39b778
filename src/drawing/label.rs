//! What is written on sheets, and where.

use super::curve::Curve;
use super::line::{FLATTENING_TOLERANCE_MM, Line, place_at};
use super::tabs::Tab;
use crate::math::planar::{distance, polyline_length};
use crate::pattern::Direction;

/// Size of texts beside sheets and maximum size of those along lines, in millimetres.
const NOTE_SIZE_MM: f64 = 3.0;

/// Maximum size of texts, in millimetres.
const MAX_TEXT_SIZE_MM: f64 = 12.0;

/// Minimum size of texts, in millimetres.
const MIN_TEXT_SIZE_MM: f64 = 1.5;

/// A text on a sheet.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Label {
    /// What it is about.
    pub kind: LabelKind,
    /// The text.
    pub text: String,
    /// Its middle.
    pub place: [f64; 2],
    /// Size of the font, in millimetres.
    pub size: f64,
    /// Degrees by which it is turned, counter-clockwise.
    pub turn: f64,
}

/// What a text is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
#[non_exhaustive]
pub enum LabelKind {
    /// The number of a patch.
    Patch,
    /// The letter of a cut crease, at its edge or on a tab.
    Seam,
    /// Direction and angle of a fold.
    Fold,
    /// The name of a sheet, above it.
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

    /// Whether there is no room for the number of a patch on it.
    pub(super) fn is_cramped(room: f64) -> bool {
        0.8 * room < MIN_TEXT_SIZE_MM
    }

    /// The number of a patch beside its sheet.
    pub(super) fn outside(self, place: [f64; 2]) -> Self {
        Label {
            place,
            size: NOTE_SIZE_MM,
            ..self
        }
    }

    /// Whether a leader from its sheet ends at it.
    pub(super) fn is_beside(&self, leaders: &[Curve]) -> bool {
        self.kind == LabelKind::Patch
            && (leaders.iter().flat_map(|line| line.controls().last()))
                .any(|end| distance(*end, self.place) < 1.5 * NOTE_SIZE_MM)
    }

    /// The box that it takes, about.
    pub(super) fn corners(&self) -> Vec<[f64; 2]> {
        let half = [
            0.3 * self.size * self.text.chars().count() as f64,
            0.6 * self.size,
        ];
        let at = |x: f64, y: f64| [self.place[0] + x * half[0], self.place[1] + y * half[1]];
        vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)]
    }

    /// Beside the middle of a run, on its left.
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

    /// A small text of no sheet, such as a page's name.
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

    /// So many of its sizes to the left of the middle of a line, along it.
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

    /// About how wide a name above a sheet is, and how high with the room around it.
    pub(super) fn extent(&self) -> [f64; 2] {
        let letters = self.text.chars().count() as f64;
        [0.6 * self.size * letters, 2.0 * self.size]
    }

    pub(super) fn is_sheet(&self) -> bool {
        self.kind == LabelKind::Sheet
    }

    /// Turns it with its sheet, and by half a turn more where it would be upside down.
    pub(super) fn turn_by(&mut self, degrees: f64) {
        let turned = (self.turn + degrees).rem_euclid(180.0);
        // To the right or up.
        self.turn = if turned > 90.5 {
            turned - 180.0
        } else {
            turned
        };
    }
}
