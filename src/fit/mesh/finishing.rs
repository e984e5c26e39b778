//! The steps that follow a solve: borders and creases become smooth, and folds and self-intersections removed.

use super::fairing::{curves, fair_curves};
use super::geometry::{Frame, Point};
use super::input::MeshInput;
use super::orientation::turn_back;
use super::self_intersections::{all_entangled, separate_self_intersections};
use super::smooth_regions::SmoothRegions;
use super::tight_bends::restore_bends;

/// Maximum movement of a vertex to the smoothed curve of its border or crease, in standard deviations of the
/// noise (`benches/whole.md`).
const MAX_FAIRING_NOISE_RATIO: f64 = 1.5;

/// Maximum number of times that self-intersections are removed and triangles turned back: either may bring back a few of
/// the other.
const MAX_UNTANGLING_ROUNDS: usize = 3;

/// Moves vertices on creases and borders to smooth curves, and takes the surface `before` crease passes where a crease
/// proves to be a tight bend.
pub(super) fn fair_creases(
    given: &MeshInput,
    sides: &SmoothRegions,
    x: &mut [Point],
    before: Option<&[Point]>,
    frames: &[Frame],
    sigma: Option<f64>,
) {
    if let Some(sigma) = sigma {
        let curves = curves(&given.topology, sides);
        fair_curves(x, &curves, MAX_FAIRING_NOISE_RATIO * sigma, &given.held);
        given.keep_within_reach(x);
    }
    if let Some(before) = before {
        restore_bends(given, sides, x, before, frames);
    }
}

/// Removes self-intersections and triangles that are turned over from a finished surface, and returns the triangles
/// for which that is not possible with all vertices within their reach.
pub(super) fn untangle(
    given: &MeshInput,
    x: &mut [Point],
    creased: &dyn Fn(usize) -> bool,
) -> Vec<u32> {
    for _ in 0..MAX_UNTANGLING_ROUNDS {
        separate_self_intersections(given, x, creased);
        if !turn_back(given, x) {
            break;
        }
    }
    all_entangled(given, x)
}
