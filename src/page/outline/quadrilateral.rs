//! Quadrilaterals of regions in a mask: four corners on a region's border, and a score of how much it is like a page.

use super::region::Region;
use crate::math::planar::{
    convex_hull, cross, difference, distance, orientation, polygon_area, polyline_length,
};

/// The border of a region in a mask, divided by four corners, clockwise.
pub(super) struct Quadrilateral {
    /// The four arcs of the region's border from each corner to the next, in pixels of the mask.
    pub arcs: [Vec<[f64; 2]>; 4],
    /// Score of how much the region is like a page, from 0 to 1.
    pub likeness: f64,
}

/// Finds the four vertices of a convex polygon whose quadrilateral has the largest area; returns their indices. None if
/// the polygon has fewer than four vertices.
fn largest_quadrilateral(polygon: &[[f64; 2]]) -> Option<[usize; 4]> {
    let n = polygon.len();
    let mut best = (0.0, None);
    for i in 0..n {
        for k in i + 2..n {
            let farthest = |from: usize, to: usize| {
                (from + 1..to)
                    .map(|j| {
                        let area = orientation(polygon[i], polygon[j % n], polygon[k]).abs();
                        (area, j % n)
                    })
                    .max_by(|a, b| a.0.total_cmp(&b.0))
            };
            let (Some((one, j)), Some((other, l))) = (farthest(i, k), farthest(k, i + n)) else {
                continue;
            };
            if one + other > best.0 {
                best = (one + other, Some([i, j, k, l]));
            }
        }
    }
    best.1
}

/// Score of how much four corners are like those of a sheet of paper seen by a camera, from 0 to 1: right angles, and
/// opposite sides of equal length, give 1.
pub(super) fn rectangularity(corners: &[[f64; 2]; 4]) -> f64 {
    let side = |k: usize| difference(corners[k % 4], corners[(k + 1) % 4]);
    let lengths = [0, 1, 2, 3].map(|k| side(k)[0].hypot(side(k)[1]));
    let sines = [0, 1, 2, 3]
        .map(|k| cross(side(k), side(k + 1)).abs() / (lengths[k] * lengths[(k + 1) % 4]).max(1e-9));
    let ratio = |a: f64, b: f64| (a.min(b) / a.max(b).max(1e-9)).sqrt();
    let sides = ratio(lengths[0], lengths[2]) * ratio(lengths[1], lengths[3]);
    sines.iter().product::<f64>().sqrt() * sides
}

impl Quadrilateral {
    /// Finds the quadrilateral of a region in a mask `width` pixels wide. `None` if the region is too small to have
    /// corners.
    pub fn new(region: &Region, width: usize) -> Option<Self> {
        let border = region.border(width);
        let hull = convex_hull(border.clone());
        let hull_area = polygon_area(&hull).abs();
        let corners = largest_quadrilateral(&hull)?.map(|k| hull[k]);
        let mut places =
            corners.map(|corner| border.iter().position(|at| *at == corner).unwrap_or(0));
        places.sort_unstable();
        let n = border.len();
        let arcs = [0, 1, 2, 3].map(|k| {
            let (from, to) = (places[k], places[(k + 1) % 4]);
            let to = if to > from { to } else { to + n };
            (from..=to).map(|i| border[i % n]).collect::<Vec<_>>()
        });
        let corners = places.map(|i| border[i]);
        let area = polygon_area(&corners).abs();
        // Its square, so that a disc, which fills 2/π, is no page.
        let fill = (area / hull_area.max(1.0)).min(1.0);
        let solidity = (region.area as f64 / hull_area.max(1.0)).min(1.0);
        // Every fourth pixel, so that the stairs of the pixels do not count.
        let straightness = arcs
            .iter()
            .map(|arc| {
                let coarse: Vec<_> = arc.iter().step_by(4).copied().collect();
                let chord = distance(coarse[0], coarse[coarse.len() - 1]);
                (chord / polyline_length(&coarse).max(1.0)).min(1.0)
            })
            .product::<f64>();
        Some(Quadrilateral {
            arcs,
            likeness: rectangularity(&corners) * solidity * fill.powi(2) * straightness,
        })
    }

    /// The four corners, in pixels of the mask.
    pub fn corners(&self) -> [[f64; 2]; 4] {
        self.arcs.each_ref().map(|arc| arc[0])
    }
}
