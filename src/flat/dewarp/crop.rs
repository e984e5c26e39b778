//! The part of a photo that is wanted.

use super::WarpMap;
use crate::error::{Error, Result};

impl WarpMap {
    /// The map of what lies within a polygon in the photo, given by its corners in pixels, `[0, 0]`
    /// the centre of the upper left one. The flat image ends there, with straight edges, and is no
    /// larger than it has to be. Costs `O(pixels · corners)`.
    ///
    /// # Errors
    /// [`Error::Option`] for fewer than three corners or one that is not finite,
    /// [`Error::Unsupported`] if nothing of the sheet lies within it.
    pub fn crop(mut self, polygon: &[[f64; 2]]) -> Result<Self> {
        if polygon.len() < 3 || !polygon.as_flattened().iter().all(|v| v.is_finite()) {
            let requirement = "must be three or more corners, each with a finite x and y";
            return Err(Error::option("crop", format!("{polygon:?}"), requirement));
        }
        let (mut first, mut last) = ([usize::MAX; 2], [0; 2]);
        let width = self.width();
        for (i, place) in self.places_mut().iter_mut().enumerate() {
            if place[0].is_nan() {
                continue;
            }
            if contains(polygon, place.map(f64::from)) {
                for (k, at) in [i / width, i % width].into_iter().enumerate() {
                    first[k] = first[k].min(at);
                    last[k] = last[k].max(at + 1);
                }
            } else {
                *place = [f32::NAN; 2];
            }
        }
        if first[0] >= last[0] {
            return Err(Error::Unsupported {
                format: "flat image",
                reason:
                    "nothing of the sheet lies within the part of the photo that is wanted: its \
                         corners are in pixels of the photo, from its upper left"
                        .into(),
            });
        }
        self.keep(first[0]..last[0], first[1]..last[1])?;
        Ok(self)
    }
}

/// By the even-odd rule.
fn contains(polygon: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let mut inside = false;
    let mut last = polygon[polygon.len() - 1];
    for &[px, py] in polygon {
        let [qx, qy] = last;
        if (py > y) != (qy > y) && x < (qx - px) * (y - py) / (qy - py) + px {
            inside = !inside;
        }
        last = [px, py];
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::contains;

    #[test]
    fn a_bent_polygon_contains_what_it_should() {
        // An L.
        let polygon = [
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 2.0],
            [2.0, 2.0],
            [2.0, 5.0],
            [0.0, 5.0],
        ];
        for (point, inside) in [
            ([1.0, 1.0], true),
            ([3.0, 1.0], true),
            ([1.0, 4.0], true),
            ([3.0, 3.0], false),
            ([-1.0, 1.0], false),
            ([5.0, 1.0], false),
        ] {
            assert_eq!(contains(&polygon, point), inside, "{point:?}");
        }
    }
}
