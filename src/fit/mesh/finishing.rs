//! The steps that follow a solve: creases are sharpened, and folds and self-intersections removed.

use super::border_extrapolation::extrapolate_border;
use super::crease_vertices::move_crease_vertices;
use super::fairing::{curves, fair_curves};
use super::geometry::{Frame, Point};
use super::input::MeshInput;
use super::orientation::turn_back;
use super::self_intersections::{all_entangled, separate_self_intersections};
use super::smooth_regions::SmoothRegions;
use super::tight_bends::restore_bends;
use super::vertex_fans::VertexFans;

/// Maximum movement of a vertex to the smoothed curve of its border or crease, in standard deviations of the
/// noise.
const MAX_FAIRING_NOISE_RATIO: f64 = 1.5;

/// Maximum number of times that self-intersections are removed and triangles turned back: either may bring back a few of
/// the other.
const MAX_UNTANGLING_ROUNDS: usize = 3;

/// Maximum number of times that what is still entangled is moved halfway back to where it was given.
const MAX_RETREAT_STEPS: usize = 6;

/// Moves vertices on creases and borders to where the continuations of their sides meet and to smooth curves, and takes
/// the surface `before` crease passes where a crease proves to be a tight bend.
pub(super) fn sharpen_creases(
    given: &MeshInput,
    sides: &SmoothRegions,
    x: &mut [Point],
    before: Option<&[Point]>,
    frames: &[Frame],
    sigma: Option<f64>,
) {
    extrapolate_border(given, x, frames, Some(sides));
    move_crease_vertices(given, sides, x, frames);
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
    vertex_fans: &VertexFans,
    x: &mut [Point],
    creased: &dyn Fn(usize) -> bool,
) -> Vec<u32> {
    for _ in 0..MAX_UNTANGLING_ROUNDS {
        separate_self_intersections(given, vertex_fans, x, creased);
        if !turn_back(given, x) {
            break;
        }
    }
    let mut left = all_entangled(given, vertex_fans, x);
    for _ in 0..MAX_RETREAT_STEPS {
        if left.is_empty() {
            break;
        }
        let mut retreated = x.to_vec();
        let corners = left
            .iter()
            .flat_map(|t| given.topology.triangles[*t as usize]);
        for vertex in given.topology.within_rings(corners.collect(), 1) {
            let vertex = vertex as usize;
            retreated[vertex] = 0.5 * (x[vertex] + given.noisy[vertex]);
        }
        let still = all_entangled(given, vertex_fans, &retreated);
        if still.len() >= left.len() {
            break;
        }
        x.copy_from_slice(&retreated);
        left = still;
    }
    left
}
