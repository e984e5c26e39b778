//! The base of the first linearisation.

use super::geometry::{Frame, Point, across, normals, smooth, unfold};
use super::input::MeshInput;

/// Number of smoothing steps for the places of vertices across the viewing rays, with which the first base
/// begins.
const BASE_PLACE_STEPS: usize = 3;

/// Number of smoothing steps for the first base surface, those for the places across the rays included.
const BASE_SURFACE_STEPS: usize = 10;

/// The noisy mesh smoothed, its vertices across the rays where less smoothing has them.
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
        .map(|normal| Frame::about(normal, Point::x()))
        .collect();
    (base, frames)
}
