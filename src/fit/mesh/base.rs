//! The base of a mesh's first linearisation: the input mesh, smoothed.

use super::geometry::{Frame, Point, across, normals, smooth, unfold};
use super::input::MeshInput;

/// Number of smoothing steps of the input mesh that determine where the vertices of the base (the smoothed mesh) are
/// across their normals.
const BASE_PLACE_STEPS: usize = 3;

/// Number of smoothing steps of the input mesh that determine where the vertices of the base (the smoothed mesh) are
/// along their normals; includes [`BASE_PLACE_STEPS`].
const BASE_SURFACE_STEPS: usize = 10;

/// Smooths the input mesh, and returns the positions and frames of its vertices, about which the energy is first
/// linearised. Across the rays, vertices are where fewer smoothing steps leave them.
pub(super) fn first_base(given: &MeshInput) -> (Vec<Point>, Vec<Frame>) {
    let topology = &given.topology;
    let mut places = given.noisy.clone();
    smooth(topology, &mut places, BASE_PLACE_STEPS);
    let mut smoothed = places.clone();
    smooth(
        topology,
        &mut smoothed,
        BASE_SURFACE_STEPS - BASE_PLACE_STEPS,
    );
    let rays = normals(topology, &smoothed, None);
    let mut base = across(&smoothed, &places, &rays);
    unfold(topology, &mut base, &rays, &given.held);
    let rays = normals(topology, &base, Some(&rays));
    let frames = rays
        .into_iter()
        .map(|normal| Frame::from_normal(normal, Point::x()))
        .collect();
    (base, frames)
}
