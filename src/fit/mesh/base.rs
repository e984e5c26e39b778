//! The base of the first linearisation.

use super::geometry::{Frame, Point, across, normals, smooth, unfold};
use super::linear::Given;

/// Smoothing steps for the first base: of the places across the rays, and of the surface.
const PLACES: usize = 3;
const SURFACE: usize = 10;

/// The noisy mesh smoothed, its vertices across the rays where less smoothing has them.
pub(super) fn first_base(given: &Given) -> (Vec<Point>, Vec<Frame>) {
    let topology = &given.topology;
    let mut places = given.noisy.clone();
    smooth(topology, &mut places, PLACES);
    let mut smoothed = places.clone();
    smooth(topology, &mut smoothed, SURFACE - PLACES);
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
