//! Rotates sheets to their smallest bounding boxes and lays these beside each other in rows, the tallest first.
//! (Shelves are not the least area, but near it for few sheets, and everybody sees what comes where.)

use crate::math::planar::LeastBox;

/// Width of the empty margin around each sheet in a drawing, of the margin that a printer may leave blank, and by which pages of one
/// sheet overlap, in millimetres. That of a plate is half as wide, and pages are twice as far apart.
pub(super) const MARGIN_MM: f64 = 10.0;

/// Placement of a sheet in a drawing: a rotation followed by a translation, and the size of the resulting bounding box,
/// in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    turn: [f64; 2],
    shift: [f64; 2],
    size: [f64; 2],
}

impl Place {
    /// The placement that moves nothing: no rotation and no translation.
    pub(super) const IDENTITY: Place = Place {
        turn: [1.0, 0.0],
        shift: [0.0; 2],
        size: [0.0; 2],
    };

    pub(super) fn of(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([cos, sin], [dx, dy]) = (self.turn, self.shift);
        [cos * x - sin * y + dx, sin * x + cos * y + dy]
    }

    /// Computes this placement followed by a number of quarter turns about the origin.
    pub(super) fn quarters(&self, count: usize) -> Place {
        let turned = |[x, y]: [f64; 2]| match count % 4 {
            0 => [x, y],
            1 => [-y, x],
            2 => [-x, -y],
            _ => [y, -x],
        };
        let [w, h] = self.size;
        Place {
            turn: turned(self.turn),
            shift: turned(self.shift),
            size: if count.is_multiple_of(2) {
                [w, h]
            } else {
                [h, w]
            },
        }
    }

    pub(super) fn shifted(&self, by: [f64; 2]) -> Place {
        Place {
            shift: [0, 1].map(|k| self.shift[k] + by[k]),
            ..*self
        }
    }

    pub(super) fn degrees(&self) -> f64 {
        self.turn[1].atan2(self.turn[0]).to_degrees()
    }

    /// Finds the rotation that gives points the bounding box of least area, which aligns an edge of their convex hull
    /// with an axis, and the translation that moves the box's lower left corner to the origin.
    pub(super) fn around(lines: &[Vec<[f64; 2]>]) -> Place {
        let LeastBox { turn, low, size } =
            LeastBox::around(lines.iter().flatten().copied().collect());
        Place {
            turn,
            shift: low.map(|v| -v),
            size,
        }
    }
}

/// Lays sheets, given as closed lines in millimetres, beside each other. Returns the cosine and sine of each sheet's
/// rotation, and the translation after it.
#[cfg(feature = "patterns")]
pub(crate) fn beside(sheets: &[Vec<Vec<[f64; 2]>>]) -> Vec<([f64; 2], [f64; 2])> {
    let boxes: Vec<Place> = sheets.iter().map(|lines| Place::around(lines)).collect();
    let (places, _) = pack_rows(&boxes);
    places
        .iter()
        .map(|place| (place.turn, place.shift))
        .collect()
}

/// Lays bounding boxes in rows. Returns the position of each box, and width and height of the whole arrangement.
pub(super) fn pack_rows(boxes: &[Place]) -> (Vec<Place>, [f64; 2]) {
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|a, b| boxes[*b].size[1].total_cmp(&boxes[*a].size[1]));
    let padded = |place: &Place| place.size.map(|side| side + MARGIN_MM);
    let area: f64 = boxes.iter().map(|b| padded(b)[0] * padded(b)[1]).sum();
    let widest = boxes.iter().map(|b| padded(b)[0]).fold(0.0, f64::max);
    let limit = widest.max(1.1 * area.sqrt());
    let mut out = boxes.to_vec();
    // Rows are laid from the top down; y is flipped once the total height is known.
    let (mut x, mut y, mut row, mut width) = (0.0, 0.0, 0.0f64, 0.0f64);
    for i in order {
        let [w, h] = padded(&boxes[i]);
        if x > 0.0 && x + w > limit {
            (x, y, row) = (0.0, y + row, 0.0);
        }
        out[i].shift[0] += x + MARGIN_MM;
        out[i].shift[1] -= y + h;
        row = row.max(h);
        x += w;
        width = width.max(x);
    }
    let height = y + row + MARGIN_MM;
    for place in &mut out {
        place.shift[1] += height;
    }
    (out, [width + MARGIN_MM, height])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_rectangle_is_turned_back() {
        let (sin, cos) = 20f64.to_radians().sin_cos();
        let corners = [[0.0, 0.0], [30.0, 0.0], [30.0, 10.0], [0.0, 10.0]];
        let line = corners.map(|[x, y]| [cos * x - sin * y, sin * x + cos * y]);
        let place = Place::around(&[line.to_vec()]);
        let (long, short) = (
            place.size[0].max(place.size[1]),
            place.size[0].min(place.size[1]),
        );
        assert!(
            (long - 30.0).abs() < 1e-9 && (short - 10.0).abs() < 1e-9,
            "{place:?}"
        );
    }

    #[test]
    fn boxes_keep_their_distance() {
        let sides = [
            [50.0, 20.0],
            [10.0, 80.0],
            [30.0, 30.0],
            [25.0, 5.0],
            [60.0, 60.0],
        ];
        let boxes =
            sides.map(|[w, h]| Place::around(&[vec![[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]]));
        let (places, [width, height]) = pack_rows(&boxes);
        for (i, a) in places.iter().enumerate() {
            let [x, y] = a.shift;
            assert!(x >= MARGIN_MM && y >= MARGIN_MM - 1e-9);
            assert!(
                x + a.size[0] <= width - MARGIN_MM + 1e-9
                    && y + a.size[1] <= height - MARGIN_MM + 1e-9
            );
            for b in &places[..i] {
                let apart = |k: usize| {
                    (a.shift[k] - b.shift[k] - b.size[k]).max(b.shift[k] - a.shift[k] - a.size[k])
                };
                assert!(apart(0).max(apart(1)) >= MARGIN_MM - 1e-9, "{a:?} {b:?}");
            }
        }
    }
}
