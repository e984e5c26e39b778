//! The base of the first linearisation: the input mesh, smoothed.

use super::geometry::{Frame, Point, across, normals, smooth, unfold};
use super::input::MeshInput;

/// Number of smoothing steps that determine the positions of base vertices across the rays.
const BASE_PLACE_STEPS: usize = 3;

/// Number of smoothing steps that determine the positions of base vertices along the rays; includes
/// [`BASE_PLACE_STEPS`].
const BASE_SURFACE_STEPS: usize = 10;

/// The smoothed mesh and its frames. Across the rays, vertices are where fewer smoothing steps leave them.
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
