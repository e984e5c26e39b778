//! Interpolation of displacements from clusters of a level's vertices to the vertices.
//!
//! The displacement of a vertex is a weighted mean of those of the clusters around it, with weights that reproduce
//! functions that are linear over its tangent plane (moving least squares). Weights fall with the distance and with the
//! angle between the normals.

use nalgebra::{Matrix3, Vector3};

use super::clusters::Clusters;
use super::geometry::Point;
use super::linearisation::Linearisation;
use super::smooth_regions::SmoothRegions;
use crate::fit::operator::sparse::matrix::SparseMatrix;
use crate::math::index::NO_INDEX;

/// Squared distance from which on clusters have no weight, in squared distances of the farthest cluster around. A
/// ratio of 1.05 gives coarse matrices 50 % more entries and saves no iterations (`benches/whole.md`, V-cycles).
const SQUARED_REACH_RATIO: f64 = 0.8;

/// Share of the second moments that is added to them, so that slopes vanish where the clusters around a vertex do not
/// determine them.
const SLOPE_DAMPING: f64 = 1e-3;

/// Makes the matrix that interpolates the unknowns of a level from those of the next coarser one. Constrained unknowns
/// have no entries.
pub(super) fn interpolation(
    coarse: &Linearisation,
    clusters: &Clusters,
    fine: &Linearisation,
    sides: Option<&SmoothRegions>,
) -> SparseMatrix<f32> {
    let (own, above) = (&fine.vertices, &coarse.vertices);
    let across = above.len() as u32 + 1;
    let around: Vec<Vec<(u32, f64)>> = (0..own.len())
        .map(|vertex| match own.held[vertex] {
            true => Vec::new(),
            false => cluster_weights(coarse, clusters, fine, sides, vertex),
        })
        .collect();
    let row = |vertex: usize, along: &Point| {
        let mut row = Vec::with_capacity(2 * around[vertex].len());
        for (cluster, weight) in &around[vertex] {
            let at = *cluster as usize;
            let factor = weight * coarse.scales[at] / fine.scales[vertex];
            let mut add = |unknown, other: &Point| {
                row.push((unknown, (factor * along.dot(other)) as f32));
            };
            add(*cluster, &above.frames[at].normal);
            for (way, other) in above.directions.at_vertex(at) {
                add(across + way, &other);
            }
        }
        row
    };
    let mut matrix = SparseMatrix::new(coarse.problem.target.len());
    for (vertex, frame) in own.frames.iter().enumerate() {
        matrix.push(row(vertex, &frame.normal));
    }
    // The constant, which is held.
    matrix.push([]);
    for (vertex, along) in &own.directions.all {
        matrix.push(row(*vertex as usize, along));
    }
    matrix
}

/// Returns the clusters around a vertex, of its own smooth region, with the weights of their displacements.
fn cluster_weights(
    coarse: &Linearisation,
    clusters: &Clusters,
    fine: &Linearisation,
    sides: Option<&SmoothRegions>,
    vertex: usize,
) -> Vec<(u32, f64)> {
    let (own, above) = (&fine.vertices, &coarse.vertices);
    let frame = &own.frames[vertex];
    let cluster = clusters.of_vertex[vertex];
    if cluster == NO_INDEX {
        return Vec::new();
    }
    let is_beside = |other: u32| {
        let Some(sides) = sides else { return true };
        let region = sides.region[own.source[vertex] as usize];
        region == NO_INDEX || sides.touches(above.source[other as usize] as usize, region)
    };
    let ring = clusters.adjacency.around(cluster as usize).iter().copied();
    let mut around: Vec<(u32, [f64; 2], f64)> = std::iter::once(cluster)
        .chain(ring)
        .filter(|other| is_beside(*other))
        .map(|other| {
            let offset = above.base[other as usize] - own.base[vertex];
            let place = frame.tangents.map(|tangent| tangent.dot(&offset));
            let cosine = frame.normal.dot(&above.frames[other as usize].normal);
            (other, place, cosine.max(0.0))
        })
        .collect();
    let square = |[x, y]: [f64; 2]| x * x + y * y;
    let farthest = around
        .iter()
        .fold(0.0, |most, (_, at, _)| square(*at).max(most));
    let reach = SQUARED_REACH_RATIO * farthest;
    around.retain(|(_, at, _)| square(*at) < reach);
    let weight = |at: [f64; 2], cosine: f64| {
        let left = 1.0 - square(at) / reach;
        left * left * cosine * cosine
    };
    let mut moments = Matrix3::zeros();
    for (_, at, cosine) in &around {
        let terms = Vector3::new(1.0, at[0], at[1]);
        moments += weight(*at, *cosine) * terms * terms.transpose();
    }
    let damping = SLOPE_DAMPING * moments[(0, 0)] * reach;
    moments[(1, 1)] += damping;
    moments[(2, 2)] += damping;
    let Some(factors) = moments.cholesky().map(|c| c.solve(&Vector3::x())) else {
        return vec![(cluster, 1.0)];
    };
    around
        .iter()
        .map(|(other, at, cosine)| {
            let value = factors.dot(&Vector3::new(1.0, at[0], at[1]));
            (*other, weight(*at, *cosine) * value)
        })
        .filter(|(_, weight)| weight.is_finite())
        .collect()
}
