//! Polygons in the plane.

use crate::error::{Error, Result};

/// Whether these can be the corners of a part of a photo, the option `crop`.
pub(crate) fn check_corners(polygon: &[[f64; 2]]) -> Result<()> {
    if polygon.len() >= 3 && polygon.as_flattened().iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    let requirement = "must be three or more corners, each with a finite x and y";
    Err(Error::option("crop", format!("{polygon:?}"), requirement))
}

/// Whether a point is within a polygon, by the even-odd rule.
pub(crate) fn contains(polygon: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let mut inside = false;
    let Some(mut last) = polygon.last() else {
        return false;
    };
    for corner in polygon {
        let ([px, py], [qx, qy]) = (*corner, *last);
        if (py > y) != (qy > y) && x < (qx - px) * (y - py) / (qy - py) + px {
            inside = !inside;
        }
        last = corner;
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
