//! The maximum distance of each vertex from where it was given.
//!
//! Extrapolation and smoothing over slivers know no bounds. The noise does: it has moved no vertex far.

use super::geometry::{faces_away, normals};
use super::input::MeshInput;
use super::linearisation::MIN_CONFIDENCE;

/// Maximum distance of a vertex from where it was given, in standard deviations of the noise; noise in space exceeds it
/// at one vertex in 65,000 (`benches/whole.md`).
const MAX_MOVE_NOISE_RATIO: f64 = 5.0;

/// Reach of every vertex for noise of the standard deviation `sigma`. A vertex of one triangle that is folded over onto
/// its neighbours may be turned back, as far as its edges are long.
pub(super) fn reach(given: &MeshInput, sigma: Option<f64>, spacing: f64) -> Vec<f64> {
    let usual = match sigma {
        Some(sigma) => MAX_MOVE_NOISE_RATIO * sigma,
        None => spacing,
    };
    let (topology, x) = (&given.topology, &given.noisy);
    let confidence = |vertex: usize| given.confidence.get(vertex).copied().unwrap_or(1.0);
    let mut reach: Vec<f64> = (0..x.len())
        .map(|vertex| usual / confidence(vertex).clamp(MIN_CONFIDENCE, 1.0).sqrt())
        .collect();
    let up = normals(topology, x, None);
    for triangle in &topology.triangles {
        let corners = triangle.map(|i| i as usize);
        for tip in corners {
            if topology.around(tip).len() == 2 && faces_away(x, &up, triangle) {
                let edges = corners.iter().map(|other| (x[*other] - x[tip]).norm());
                reach[tip] = edges.fold(reach[tip], f64::max);
            }
        }
    }
    reach
}
