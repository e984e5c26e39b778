//! Transfer of iterates between the levels of a mesh's multilevel solve.
//!
//! The coarser level passes on the correction that it has found: displacements along the rays, and the
//! changes of dual and Hessian as matrices in space, because neighbours have different frames. The dual is bounded by 1 on
//! every level, so that nothing is rescaled.

use nalgebra::Matrix3;

use super::adjacency::Adjacency;
use super::clusters::Clusters;
use super::edge_load::{in_plane, in_space};
use super::geometry::{Point, SMOOTHING_STEP_SHARE};
use super::linearisation::Linearisation;
use crate::error::{Result, try_filled};
use crate::math::index::NO_INDEX;
use crate::math::sym2::Sym2;

/// Number of smoothing steps of a correction that is constant on each cluster, after which hardly anything of the jumps
/// between clusters is left.
const CORRECTION_SMOOTHING_STEPS: usize = 3;

/// Minimum share of the vertices around with a value at which their smoothed value is used.
const MIN_VALUE_WEIGHT: f64 = 0.05;

/// Number of coordinates of two symmetric matrices in space.
const PAIR_COORDINATES: usize = 12;

/// Dual and Hessian at each stencil.
pub(super) type StencilMatrices = Vec<[Sym2; 2]>;

/// Restricts dual and Hessian at the stencils of a level to the next coarser one: the mean over each cluster, of vertices
/// on creases for a seed on a crease and of all others for any other seed.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn restrict(
    fine: &Linearisation,
    matrices: &StencilMatrices,
    clusters: &Clusters,
    coarse: &Linearisation,
    is_creased: &dyn Fn(u32) -> bool,
) -> Result<StencilMatrices> {
    let count = clusters.seeds.len();
    let mut sums = try_filled("clusters", count, ([Matrix3::zeros(); 2], 0.0))?;
    for (vertex, pair) in fine.centres.iter().zip(matrices) {
        let own = *vertex as usize;
        let cluster = clusters.of_vertex[own] as usize;
        let seed = clusters.seeds[cluster] as usize;
        let source = &fine.vertices.source;
        if is_creased(source[own]) == is_creased(source[seed]) {
            let (sum, weight) = &mut sums[cluster];
            for (sum, matrix) in sum.iter_mut().zip(pair) {
                *sum += in_space(&fine.vertices.frames[own], *matrix);
            }
            *weight += 1.0;
        }
    }
    let all = coarse.centres.iter().map(|cluster| {
        let cluster = *cluster as usize;
        let (sum, weight) = &sums[cluster];
        let frame = &coarse.vertices.frames[cluster];
        sum.map(|sum| in_plane(frame, &sum).scale(1.0 / f64::max(*weight, 1.0)))
    });
    Ok(all.collect())
}

/// Adds to the unknowns `z` and to the matrices of a level what the next coarser one has found: its unknowns, which began
/// at the base, and the change of its matrices. Matrices on creases stay, because Hessians there depend on the spacing.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn add_correction(
    coarse: &Linearisation,
    found: (&[f64], &StencilMatrices),
    clusters: &Clusters,
    fine: &Linearisation,
    (z, matrices): (&mut [f64], &mut StencilMatrices),
    is_creased: &dyn Fn(u32) -> bool,
) -> Result<()> {
    add_displacements(coarse, found.0, clusters, fine, z)?;
    let (vertices, adjacency) = (&fine.vertices, &fine.vertices.adjacency);
    let creased: Vec<bool> = vertices.source.iter().map(|v| is_creased(*v)).collect();
    let mut values = try_filled("correction", vertices.len(), [0.0; PAIR_COORDINATES + 1])?;
    for (vertex, cluster) in clusters.of_vertex.iter().enumerate() {
        let stencil = coarse.about[*cluster as usize];
        let seed = clusters.seeds[*cluster as usize] as usize;
        if stencil != NO_INDEX && !creased[vertex] && !creased[seed] {
            let frame = &coarse.vertices.frames[*cluster as usize];
            let pair = found.1[stencil as usize].map(|matrix| in_space(frame, matrix));
            values[vertex] = coordinates(pair);
        }
    }
    smooth(adjacency, &mut values, |vertex| !creased[vertex])?;
    for (vertex, pair) in fine.centres.iter().zip(matrices) {
        let value = &values[*vertex as usize];
        let weight = value[PAIR_COORDINATES];
        if weight > MIN_VALUE_WEIGHT && !creased[*vertex as usize] {
            let frame = &vertices.frames[*vertex as usize];
            for (to, more) in pair.iter_mut().zip(matrices_in_space(value)) {
                *to = *to + in_plane(frame, &more).scale(1.0 / weight);
            }
        }
    }
    Ok(())
}

/// Adds the displacements that a coarser level has found to the unknowns of a level.
fn add_displacements(
    coarse: &Linearisation,
    found: &[f64],
    clusters: &Clusters,
    fine: &Linearisation,
    z: &mut [f64],
) -> Result<()> {
    let (own, above) = (&fine.vertices, &coarse.vertices);
    let mut rises = try_filled("correction", own.len(), [0.0])?;
    for (rise, cluster) in rises.iter_mut().zip(&clusters.of_vertex) {
        let cluster = *cluster as usize;
        *rise = [found[cluster] * coarse.scales[cluster]];
    }
    smooth(&own.adjacency, &mut rises, |_| true)?;
    for (vertex, [rise]) in rises.iter().enumerate() {
        if !own.held[vertex] {
            z[vertex] += rise / fine.scales[vertex];
        }
    }
    let mut across = try_filled("correction", above.len(), Point::zeros())?;
    for (value, (cluster, along)) in found[above.len() + 1..].iter().zip(&above.directions.all) {
        let cluster = *cluster as usize;
        across[cluster] += along * (value * coarse.scales[cluster]);
    }
    for (value, (vertex, along)) in z[own.len() + 1..].iter_mut().zip(&own.directions.all) {
        let vertex = *vertex as usize;
        let cluster = clusters.of_vertex[vertex] as usize;
        *value += along.dot(&across[cluster]) / fine.scales[vertex];
    }
    Ok(())
}

/// Smooths values at vertices, of those alone that `takes_part` holds for.
fn smooth<const N: usize>(
    adjacency: &Adjacency,
    values: &mut Vec<[f64; N]>,
    takes_part: impl Fn(usize) -> bool,
) -> Result<()> {
    let mut old = try_filled("correction", values.len(), [0.0; N])?;
    for _ in 0..CORRECTION_SMOOTHING_STEPS {
        std::mem::swap(&mut old, values);
        for (vertex, value) in values.iter_mut().enumerate() {
            *value = old[vertex];
            if !takes_part(vertex) {
                continue;
            }
            let (mut sum, mut count) = ([0.0; N], 0.0);
            for other in adjacency.around(vertex) {
                if takes_part(*other as usize) {
                    let other = &old[*other as usize];
                    (0..N).for_each(|k| sum[k] += other[k]);
                    count += 1.0;
                }
            }
            if count > 0.0 {
                let step = |own: f64, sum: f64| SMOOTHING_STEP_SHARE * (sum / count - own);
                (0..N).for_each(|k| value[k] += step(value[k], sum[k]));
            }
        }
    }
    Ok(())
}

/// Returns the coordinates of two symmetric matrices in space, and a weight of 1.
fn coordinates(pair: [Matrix3<f64>; 2]) -> [f64; PAIR_COORDINATES + 1] {
    let mut to = [1.0; PAIR_COORDINATES + 1];
    for (half, m) in to.chunks_exact_mut(PAIR_COORDINATES / 2).zip(pair) {
        half.copy_from_slice(&[m.m11, m.m12, m.m13, m.m22, m.m23, m.m33]);
    }
    to
}

/// Returns the two symmetric matrices in space of given coordinates.
fn matrices_in_space(from: &[f64; PAIR_COORDINATES + 1]) -> [Matrix3<f64>; 2] {
    [0, PAIR_COORDINATES / 2].map(|first| {
        let [a, b, c, d, e, f] = std::array::from_fn(|k| from[first + k]);
        Matrix3::new(a, b, c, b, d, e, c, e, f)
    })
}
