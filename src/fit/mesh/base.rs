//! The base of a mesh's first linearisation: the input mesh, smoothed.

use super::geometry::{Frame, Point, across, normals, smooth};
use super::input::MeshInput;
use super::orientation::unfold;

/// Number of smoothing steps of the input mesh that determine where the vertices of the base (the smoothed mesh) are
/// across their normals (`benches/whole.md`).
const BASE_PLACE_STEPS: usize = 3;

/// Number of smoothing steps of the input mesh that determine where the vertices of the base (the smoothed mesh) are
/// along their normals; includes [`BASE_PLACE_STEPS`] (`benches/whole.md`).
const BASE_SURFACE_STEPS: usize = 10;

/// Smooths the input mesh, `repeats` times as much as usual, and returns the positions and frames of its vertices, about which the
/// energy is first linearised. After the first steps vertices move along their normals alone, because the mean of its neighbours
/// leads a vertex of irregular triangles along the surface as well. Vertices stay within their reach, a multiple of the noise.
pub(super) fn first_base(given: &MeshInput, repeats: usize) -> (Vec<Point>, Vec<Frame>) {
    let topology = &given.topology;
    let mut base = given.noisy.clone();
    smooth(topology, &mut base, repeats * BASE_PLACE_STEPS);
    given.keep_within_reach(&mut base);
    let mut rays = normals(topology, &base, None);
    for _ in repeats * BASE_PLACE_STEPS..repeats * BASE_SURFACE_STEPS {
        let places = base.clone();
        smooth(topology, &mut base, 1);
        base = across(&base, &places, &rays);
        rays = normals(topology, &base, Some(&rays));
    }
    given.keep_within_reach(&mut base);
    unfold(given, &mut base, &rays);
    let rays = normals(topology, &base, Some(&rays));
    let frames = rays
        .into_iter()
        .map(|normal| Frame::from_normal(normal, Point::x()))
        .collect();
    (base, frames)
}
