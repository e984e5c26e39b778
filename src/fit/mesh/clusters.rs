//! Clusters of a level's vertices, which are the vertices of the next coarser level.
//!
//! A cluster is a vertex, its seed, with those of its neighbours that have no nearer seed: three to four vertices, so that
//! the spacing nearly doubles. Clusters are neighbours if an edge leads from one to the other.

use super::adjacency::Adjacency;
use super::geometry::Point;
use super::level_vertices::LevelVertices;
use crate::error::{Result, try_filled};
use crate::math::index::NO_INDEX;

/// Clusters of a level's vertices.
#[derive(Debug, Clone)]
pub(super) struct Clusters {
    /// Vertex in the middle of each cluster.
    pub seeds: Vec<u32>,
    /// Cluster of each vertex.
    pub of_vertex: Vec<u32>,
    /// Neighbours of each cluster.
    pub adjacency: Adjacency,
}

impl Clusters {
    /// Groups a level's vertices around a maximal set of seeds of which no two are neighbours. Seeds are found on the
    /// border first, then on creases, so that coarser levels have both. Costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(vertices: &LevelVertices) -> Result<Self> {
        let count = vertices.len();
        let mut of_vertex = try_filled("vertices", count, NO_INDEX)?;
        let mut is_covered = try_filled("vertices", count, false)?;
        let mut seeds = Vec::new();
        let class = |vertex: usize| match vertices.directions.at_vertex(vertex).next() {
            _ if !vertices.inside[vertex] => 0,
            Some(_) => 1,
            None => 2,
        };
        for wanted in 0..3 {
            for vertex in 0..count {
                if class(vertex) == wanted && !is_covered[vertex] {
                    is_covered[vertex] = true;
                    of_vertex[vertex] = seeds.len() as u32;
                    seeds.push(vertex as u32);
                    for other in vertices.adjacency.around(vertex) {
                        is_covered[*other as usize] = true;
                    }
                }
            }
        }
        join_nearest(vertices, &seeds, &mut of_vertex);
        let adjacency = adjacency(vertices, &of_vertex, seeds.len())?;
        Ok(Clusters {
            seeds,
            of_vertex,
            adjacency,
        })
    }

    /// Makes the vertices of the next coarser level: one for each cluster, where its seed is, with the area of the
    /// cluster and its mean offset along the ray. An offset across the ray, which counts on creases alone, is the mean of
    /// the cluster's vertices on creases.
    pub(super) fn coarsen(&self, fine: &LevelVertices) -> LevelVertices {
        let of_seed = |seed: &u32| *seed as usize;
        let seeds = || self.seeds.iter().map(of_seed);
        let count = self.seeds.len();
        let mut areas = vec![0.0; count];
        let mut confidence = vec![0.0; if fine.confidence.is_empty() { 0 } else { count }];
        let mut sums = vec![[(0.0, 0.0); 2]; count];
        let mut across = vec![Point::zeros(); count];
        for (vertex, cluster) in self.of_vertex.iter().enumerate() {
            let cluster = *cluster as usize;
            let area = fine.areas[vertex];
            areas[cluster] += area;
            let trust = fine.confidence.get(vertex).copied().unwrap_or(1.0);
            if let Some(sum) = confidence.get_mut(cluster) {
                *sum += area * trust;
            }
            let weight = area * trust;
            let rise = fine.offset[vertex].dot(&fine.frames[vertex].normal);
            let is_free = usize::from(fine.directions.at_vertex(vertex).next().is_some());
            let sum = &mut sums[cluster][is_free];
            *sum = (sum.0 + weight * rise, sum.1 + weight);
            if is_free == 1 {
                across[cluster] += weight * fine.offset[vertex];
            }
        }
        for (sum, area) in confidence.iter_mut().zip(&areas) {
            *sum /= area;
        }
        let offset = seeds().enumerate().map(|(cluster, seed)| {
            let normal = fine.frames[seed].normal;
            let [(smooth, smooth_weight), (creased, creased_weight)] = sums[cluster];
            let is_free = fine.directions.at_vertex(seed).next().is_some();
            if is_free && creased_weight > 0.0 {
                return across[cluster] / creased_weight;
            }
            let weight = smooth_weight + creased_weight;
            match weight > 0.0 {
                true => normal * ((smooth + creased) / weight),
                false => fine.offset[seed],
            }
        });
        LevelVertices {
            source: seeds().map(|seed| fine.source[seed]).collect(),
            inside: seeds().map(|seed| fine.inside[seed]).collect(),
            base: seeds().map(|seed| fine.base[seed]).collect(),
            frames: seeds().map(|seed| fine.frames[seed].clone()).collect(),
            held: seeds().map(|seed| fine.held[seed]).collect(),
            directions: fine.directions.at_vertices(seeds()),
            adjacency: self.adjacency.clone(),
            closed: fine.closed,
            offset: offset.collect(),
            areas,
            confidence,
        }
    }
}

/// Adds each vertex that is no seed to the cluster of the nearest seed among its neighbours.
fn join_nearest(vertices: &LevelVertices, seeds: &[u32], of_vertex: &mut [u32]) {
    let base = &vertices.base;
    let joined: Vec<(usize, u32)> = (0..vertices.len())
        .filter(|vertex| of_vertex[*vertex] == NO_INDEX)
        .filter_map(|vertex| {
            let own = vertices.adjacency.around(vertex).iter();
            let clusters = own.map(|other| of_vertex[*other as usize]);
            let distance = |cluster: u32| {
                let seed = seeds[cluster as usize] as usize;
                (base[seed] - base[vertex]).norm_squared()
            };
            clusters
                .filter(|cluster| *cluster != NO_INDEX)
                .min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
                .map(|cluster| (vertex, cluster))
        })
        .collect();
    for (vertex, cluster) in joined {
        of_vertex[vertex] = cluster;
    }
}

/// Finds the neighbours of each cluster.
fn adjacency(vertices: &LevelVertices, of_vertex: &[u32], clusters: usize) -> Result<Adjacency> {
    let mut edges = Vec::new();
    for (vertex, own) in of_vertex.iter().enumerate() {
        for other in vertices.adjacency.around(vertex) {
            let other = of_vertex[*other as usize];
            if *own < other {
                edges.push([*own, other]);
            }
        }
    }
    edges.sort_unstable();
    edges.dedup();
    Adjacency::from_edges(clusters, edges.iter().copied())
}
