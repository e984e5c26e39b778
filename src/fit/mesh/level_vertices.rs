//! The vertices of a linearised problem: those of the mesh, or clusters of them on a coarser level.

use super::adjacency::Adjacency;
use super::clusters::Clusters;
use super::crease_directions::CreaseDirections;
use super::geometry::{Frame, Point, areas};
use super::input::MeshInput;
use super::smooth_regions::SmoothRegions;

/// Vertices of one level of the solve of a linearised problem, with all that the problem depends on.
#[derive(Debug, Clone)]
pub(super) struct LevelVertices {
    pub adjacency: Adjacency,
    /// Vertex of the mesh that each vertex of the level is.
    pub source: Vec<u32>,
    /// Whether each vertex has neighbours all around.
    pub inside: Vec<bool>,
    /// Whether the mesh has no border.
    pub closed: bool,
    /// Area of each vertex.
    pub areas: Vec<f64>,
    /// Positions of the vertices about which the energy is linearised.
    pub base: Vec<Point>,
    /// Frames of the vertices, whose normals are the rays along which vertices move.
    pub frames: Vec<Frame>,
    /// Vector from each vertex's position in the base to the given one.
    pub offset: Vec<Point>,
    /// Confidence of each vertex; empty if each is 1.
    pub confidence: Vec<f64>,
    /// Whether each vertex stays where it is given.
    pub held: Vec<bool>,
    /// Directions across the rays in which vertices on creases move as well.
    pub directions: CreaseDirections,
}

impl LevelVertices {
    /// Takes the vertices of the mesh, for a linearisation about vertices at `base`.
    pub(super) fn from_mesh(
        given: &MeshInput,
        base: Vec<Point>,
        frames: Vec<Frame>,
        sides: Option<&SmoothRegions>,
    ) -> Self {
        let topology = &given.topology;
        LevelVertices {
            adjacency: topology.adjacency.clone(),
            source: (0..topology.len() as u32).collect(),
            inside: topology.inside.clone(),
            closed: topology.closed,
            areas: areas(topology, &base),
            offset: (given.noisy.iter().zip(&base))
                .map(|(noisy, base)| noisy - base)
                .collect(),
            confidence: given.confidence.clone(),
            held: given.held.clone(),
            directions: sides.map_or_else(CreaseDirections::default, |sides| {
                CreaseDirections::new(given, sides, &base, &frames)
            }),
            base,
            frames,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.source.len()
    }

    /// Makes the vertices of the next coarser level: one for each cluster, where its seed is, with the area of the
    /// cluster and its mean offset along the ray. An offset across the ray, which counts on creases alone, is the mean of
    /// the cluster's vertices on creases.
    pub(super) fn coarsen(&self, clusters: &Clusters) -> Self {
        let of_seed = |seed: &u32| *seed as usize;
        let seeds = || clusters.seeds.iter().map(of_seed);
        let count = clusters.seeds.len();
        let mut areas = vec![0.0; count];
        let mut confidence = vec![0.0; if self.confidence.is_empty() { 0 } else { count }];
        let mut sums = vec![[(0.0, 0.0); 2]; count];
        let mut across = vec![Point::zeros(); count];
        for (vertex, cluster) in clusters.of_vertex.iter().enumerate() {
            let cluster = *cluster as usize;
            let area = self.areas[vertex];
            areas[cluster] += area;
            let trust = self.confidence.get(vertex).copied().unwrap_or(1.0);
            if let Some(sum) = confidence.get_mut(cluster) {
                *sum += area * trust;
            }
            let weight = area * trust;
            let rise = self.offset[vertex].dot(&self.frames[vertex].normal);
            let is_free = usize::from(self.directions.at_vertex(vertex).next().is_some());
            let sum = &mut sums[cluster][is_free];
            *sum = (sum.0 + weight * rise, sum.1 + weight);
            if is_free == 1 {
                across[cluster] += weight * self.offset[vertex];
            }
        }
        for (sum, area) in confidence.iter_mut().zip(&areas) {
            *sum /= area;
        }
        let offset = seeds().enumerate().map(|(cluster, seed)| {
            let normal = self.frames[seed].normal;
            let [(smooth, smooth_weight), (creased, creased_weight)] = sums[cluster];
            let is_free = self.directions.at_vertex(seed).next().is_some();
            if is_free && creased_weight > 0.0 {
                return across[cluster] / creased_weight;
            }
            let weight = smooth_weight + creased_weight;
            match weight > 0.0 {
                true => normal * ((smooth + creased) / weight),
                false => self.offset[seed],
            }
        });
        LevelVertices {
            source: seeds().map(|seed| self.source[seed]).collect(),
            inside: seeds().map(|seed| self.inside[seed]).collect(),
            base: seeds().map(|seed| self.base[seed]).collect(),
            frames: seeds().map(|seed| self.frames[seed].clone()).collect(),
            held: seeds().map(|seed| self.held[seed]).collect(),
            directions: self.directions.at_vertices(seeds()),
            adjacency: clusters.adjacency.clone(),
            closed: self.closed,
            offset: offset.collect(),
            areas,
            confidence,
        }
    }
}
