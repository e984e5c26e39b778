//! Texts on the sheets of a drawing: their contents, sizes and positions.

use super::curve::Curve;
use super::line::{FLATTENING_TOLERANCE_MM, Line, Wall, place_at};
use super::tabs::Tab;
use crate::math::planar::{Point2, bounds, cross, distance, is_within, polyline_length};
use crate::pattern::{Direction, Seam};

/// Font size of a text beside a sheet, in millimetres. Texts on a sheet have half of it at least, along a line it at most, and
/// four times it elsewhere; marks, leader lines and the gaps between nested sheets are as long.
pub(super) const TEXT_SIZE_MM: f64 = 3.0;

/// Places of a text along a line, in the order in which they are tried, as shares of the line.
const LABEL_PLACES: [f64; 3] = [0.5, 0.3, 0.7];

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
    /// Numbers of the patches on either side of a cut crease, from 0, the lower one first; only its letters have them.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Option::is_none")
    )]
    pub patches: Option<[u32; 2]>,
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
            size: (0.8 * room).clamp(0.5 * TEXT_SIZE_MM, 4.0 * TEXT_SIZE_MM),
            turn: 0.0,
            patches: None,
        }
    }

    /// Returns whether a patch is too small for its number; `room` is the distance from the label's place to the
    /// patch's border, in millimetres.
    pub(super) fn is_cramped(room: f64) -> bool {
        0.8 * room < 0.5 * TEXT_SIZE_MM
    }

    /// Moves this label to a place beside its sheet, where a leader line connects it to its patch.
    pub(super) fn outside(self, place: [f64; 2]) -> Self {
        Label {
            place,
            size: TEXT_SIZE_MM,
            ..self
        }
    }

    /// Returns whether this label stands beside its sheet, which it does if a leader line ends at it.
    pub(super) fn is_beside(&self, leaders: &[Curve]) -> bool {
        self.kind == LabelKind::Patch
            && (leaders.iter().flat_map(|line| line.controls().last()))
                .any(|end| distance(*end, self.place) < 1.5 * TEXT_SIZE_MM)
    }

    fn half_extent(&self) -> [f64; 2] {
        let letters = self.text.chars().count() as f64;
        [0.3 * self.size * letters, 0.6 * self.size]
    }

    /// Computes the four corners of an approximate bounding box of the label's text, in millimetres.
    pub(super) fn corners(&self) -> Vec<[f64; 2]> {
        let half = self.half_extent();
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
        let [[a, b], [c, d]] = [self, other].map(|label| label.half_extent());
        if distance(self.place, other.place) > a.hypot(b) + c.hypot(d) {
            return false;
        }
        let (one, two) = (self.turned_corners(), other.turned_corners());
        let is_apart = |p: &[Point2], q: &[Point2]| {
            (0..4).any(|k| {
                let (from, along) = (p[k], p[(k + 1) % 4] - p[k]);
                q.iter().all(|v| cross(along, v - from) <= 0.0)
            })
        };
        !is_apart(&one, &two) && !is_apart(&two, &one)
    }

    /// Returns whether a straight line crosses the text's bounding box (clipped to the slabs of the box, in its axes).
    fn is_crossed_by(&self, line: &Wall) -> bool {
        let half = self.half_extent();
        let (sin, cos) = self.turn.to_radians().sin_cos();
        let middle = Point2::new(self.place[0], self.place[1]);
        let [a, b] = line.map(|[x, y]| (Point2::new(x, y) - middle) * Point2::new(cos, -sin));
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for (start, end, half) in [(a.re, b.re, half[0]), (a.im, b.im, half[1])] {
            let step = end - start;
            if step == 0.0 {
                if start.abs() >= half {
                    return false;
                }
                continue;
            }
            let [p, q] = [(-half - start) / step, (half - start) / step];
            (from, to) = (from.max(p.min(q)), to.min(p.max(q)));
        }
        from < to
    }

    /// Chooses for each text the first of its candidates that lies within the outlines, on none of them or of the folds, and on no other
    /// text, letters of seams first and angles of folds last; a text without such a candidate is left out. Those `beside` the sheet, at
    /// leader lines, are kept. The letter of a seam may lie on folds, if need be.
    pub(super) fn without_collisions(
        beside: Vec<Label>,
        mut texts: Vec<Vec<Label>>,
        outlines: &[Wall],
        folds: &[Wall],
    ) -> Vec<Label> {
        let rank = |candidates: &Vec<Label>| match candidates.first().map(|label| label.kind) {
            Some(LabelKind::Seam) => 0,
            Some(LabelKind::Fold) => 2,
            _ => 1,
        };
        texts.sort_by_key(rank);
        let mut out = beside;
        for candidates in texts {
            let corners: Vec<[f64; 2]> = (candidates.iter().flat_map(Label::turned_corners))
                .map(|p| [p.re, p.im])
                .collect();
            let [low, high] = bounds(corners.iter());
            let is_near = |line: &&Wall| {
                (0..2).all(|k| {
                    line[0][k].min(line[1][k]) <= high[k] && line[0][k].max(line[1][k]) >= low[k]
                })
            };
            let [edges, folds] =
                [outlines, folds].map(|lines| lines.iter().filter(is_near).collect::<Vec<_>>());
            // What costs most is asked last.
            let is_apart = |label: &Label| {
                !edges.iter().any(|line| label.is_crossed_by(line))
                    && !out.iter().any(|other| label.touches(other))
                    && is_within(label.place, outlines.iter().copied())
            };
            let is_free = |label: &&Label| {
                !folds.iter().any(|line| label.is_crossed_by(line)) && is_apart(label)
            };
            let is_on_folds = |label: &&Label| label.kind == LabelKind::Seam && is_apart(label);
            let kept = candidates.iter().find(is_free);
            out.extend(
                kept.or_else(|| candidates.iter().rev().find(is_on_folds))
                    .cloned(),
            );
        }
        out
    }

    /// Creates candidates of this label in three sizes, down to the smallest.
    pub(super) fn in_sizes(self) -> Vec<Label> {
        let least = self.size.min(0.5 * TEXT_SIZE_MM);
        let sizes = [self.size, 0.5 * (self.size + least), least];
        let sized = |size: f64| Label {
            size,
            ..self.clone()
        };
        sizes.map(sized).to_vec()
    }

    /// Creates candidates of the label with the letter of a cut crease, along the crease's line.
    pub(super) fn seam(letter: &str, seam: &Seam, points: &[[f64; 2]]) -> Vec<Label> {
        let mut texts = Label::beside(LabelKind::Seam, letter, points, 1.0);
        texts
            .iter_mut()
            .for_each(|text| text.patches = Some(seam.patches));
        texts
    }

    /// Creates candidates of the label with the direction and angle of a fold, of a smooth bend with its radius at the fold in
    /// its middle.
    pub(super) fn fold(line: &Line) -> Vec<Label> {
        let way = match line.direction {
            Direction::Mountain => 'M',
            Direction::Valley => 'V',
        };
        let text = match line.bend {
            None => format!("{way} {:.0}°", line.angle),
            Some(bend) if bend.is_middle => {
                format!(
                    "{way} {:.0}° R{}",
                    bend.angle,
                    (10.0 * bend.radius).round() / 10.0
                )
            }
            Some(_) => return Vec::new(),
        };
        // To the left of the line first, then to its right.
        [0.8, -0.8]
            .iter()
            .flat_map(|away| Label::beside(LabelKind::Fold, &text, &line.points, *away))
            .collect()
    }

    pub(super) fn tab(letter: &str, tab: &Tab) -> Vec<Label> {
        let base = tab.base.points(FLATTENING_TOLERANCE_MM);
        let along = Label::beside(LabelKind::Seam, letter, &base, 0.0);
        let tabbed = |label: Label| Label {
            place: tab.middle,
            size: label.size.min(0.7 * tab.depth),
            patches: Some(tab.seam.patches),
            ..label
        };
        let first = along.into_iter().next().map(tabbed);
        first.map(Label::in_sizes).unwrap_or_default()
    }

    pub(super) fn sheet(name: &str, [min, max]: [[f64; 2]; 2]) -> Self {
        Label::note(name, [0.5 * (min[0] + max[0]), max[1] + TEXT_SIZE_MM])
    }

    /// Creates a small text that belongs to no sheet, such as the name of a printed page.
    pub(crate) fn note(text: &str, place: [f64; 2]) -> Self {
        Label {
            kind: LabelKind::Sheet,
            text: text.into(),
            place,
            size: TEXT_SIZE_MM,
            turn: 0.0,
            patches: None,
        }
    }

    /// Creates candidates of a text along a line, the best first: largest in the middle of the line, to its left, at a distance
    /// that is a multiple of the text's font size.
    fn beside(kind: LabelKind, text: &str, points: &[[f64; 2]], away: f64) -> Vec<Label> {
        let long = polyline_length(points);
        let size = (0.2 * long).clamp(0.5 * TEXT_SIZE_MM, TEXT_SIZE_MM);
        let at = |label: Label| {
            LABEL_PLACES.map(|along| {
                let (place, [x, y]) = place_at(points, along * long);
                let away = away * label.size;
                let mut label = Label {
                    place: [place[0] - away * y, place[1] + away * x],
                    ..label.clone()
                };
                label.turn_by(y.atan2(x).to_degrees());
                label
            })
        };
        let label = Label {
            kind,
            text: text.into(),
            place: [0.0; 2],
            size,
            turn: 0.0,
            patches: None,
        };
        label.in_sizes().into_iter().flat_map(at).collect()
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
