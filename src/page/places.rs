//! Places of a flat page in a photo, and the other way round.

use crate::math::lanes;

/// Maximum number of steps of Newton's method for finding the place on the page that a pixel shows.
const MAX_NEWTON_STEPS: usize = 30;

/// Converts a place in a photo, in pixels, to texture coordinates; `photo` is the photo's width and height.
pub(super) fn texture_coordinates([x, y]: [f64; 2], photo: [usize; 2]) -> [f32; 2] {
    let [width, height] = photo.map(|n| n as f64);
    [(x + 0.5) / width, 1.0 - (y + 0.5) / height].map(lanes::single)
}

/// Finds the place on a flat page, in shares of its width and height, that the photo shows at a pixel: by Newton's
/// method from the nearest of a grid of initial places. None if the pixel is not on the page.
pub(super) fn back_project(
    photo_place: impl Fn([f64; 2]) -> Option<[f64; 2]>,
    pixel: [f64; 2],
) -> Option<[f64; 2]> {
    /// Number of initial places along each side of the page, from the nearest of which Newton's method starts.
    const INITIAL_PLACES_PER_SIDE: usize = 24;
    let off = |at: [f64; 2]| {
        let seen = photo_place(at)?;
        Some([seen[0] - pixel[0], seen[1] - pixel[1]])
    };
    let mut best = (f64::INFINITY, [0.5; 2]);
    for i in 0..INITIAL_PLACES_PER_SIDE * INITIAL_PLACES_PER_SIDE {
        let at = [i % INITIAL_PLACES_PER_SIDE, i / INITIAL_PLACES_PER_SIDE]
            .map(|k| (k as f64 + 0.5) / INITIAL_PLACES_PER_SIDE as f64);
        let distance = off(at).map_or(f64::INFINITY, |o| o[0].hypot(o[1]));
        if distance < best.0 {
            best = (distance, at);
        }
    }
    let mut at = best.1;
    for _ in 0..MAX_NEWTON_STEPS {
        /// Step of the forward differences in Newton's method, as a share of a page's side.
        const NEWTON_DIFFERENCE_STEP: f64 = 1e-6;
        let here = off(at)?;
        let [right, below] = [
            off([at[0] + NEWTON_DIFFERENCE_STEP, at[1]])?,
            off([at[0], at[1] + NEWTON_DIFFERENCE_STEP])?,
        ];
        let [a, c] = [0, 1].map(|k| (right[k] - here[k]) / NEWTON_DIFFERENCE_STEP);
        let [b, d] = [0, 1].map(|k| (below[k] - here[k]) / NEWTON_DIFFERENCE_STEP);
        let area = a * d - b * c;
        at = [
            (at[0] - (d * here[0] - b * here[1]) / area).clamp(0.0, 1.0),
            (at[1] - (a * here[1] - c * here[0]) / area).clamp(0.0, 1.0),
        ];
    }
    let left = off(at)?;
    // To one pixel: outside of the page the nearest place on it is farther away.
    (left[0].hypot(left[1]) < 1.0).then_some(at)
}
