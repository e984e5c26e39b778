//! The vertices of a linearised problem: those of the mesh, or clusters of them on a coarser level.

use super::adjacency::Adjacency;
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
}
