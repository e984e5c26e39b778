//! Directions in which vertices on creases of a mesh move besides that of their normal.
//!
//! The surface has two normals on a crease, and three in a corner. A vertex that moves along one ray alone cannot lie
//! on all these sides; what it misses them by would stay as a dent.

use super::geometry::{Frame, Point};
use super::input::MeshInput;
use super::smooth_regions::SmoothRegions;

/// Directions across the rays in which vertices on creases move, each with an unknown of its own.
#[derive(Debug, Clone, Default)]
pub(super) struct CreaseDirections {
    /// Vertex and unit direction of each unknown.
    pub all: Vec<(u32, Point)>,
    /// Index in `all` of each vertex's first direction.
    first: Vec<u32>,
}

impl CreaseDirections {
    /// Finds the directions of each vertex: the one across the crease where two smooth regions meet, and two directions
    /// where three regions do.
    pub(super) fn new(
        given: &MeshInput,
        sides: &SmoothRegions,
        base: &[Point],
        frames: &[Frame],
    ) -> CreaseDirections {
        let topology = &given.topology;
        let creases = sides.creases(topology);
        let mut directions = CreaseDirections {
            all: Vec::new(),
            first: vec![0],
        };
        for (vertex, frame) in frames.iter().enumerate() {
            let own = match topology.inside[vertex] && !given.held[vertex] {
                true => sides.around(vertex).len(),
                false => 0,
            };
            match (own, creases[vertex]) {
                (2, Some([a, b])) => {
                    let along = base[b as usize] - base[a as usize];
                    let way = frame.normal.cross(&along).try_normalize(0.0);
                    directions.all.extend(way.map(|way| (vertex as u32, way)));
                }
                (3.., _) => {
                    let ring = topology.around(vertex).iter();
                    let longest = ring
                        .map(|other| base[*other as usize] - base[vertex])
                        .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
                    let hint = longest.unwrap_or(frame.tangents[0]);
                    let [a, b] = Frame::from_normal(frame.normal, hint).tangents;
                    directions
                        .all
                        .extend([(vertex as u32, a), (vertex as u32, b)]);
                }
                _ => {}
            }
            directions.first.push(directions.all.len() as u32);
        }
        directions
    }

    /// Returns the directions of some of the vertices, which are given in the order that they then have.
    pub(super) fn at_vertices(&self, vertices: impl Iterator<Item = usize>) -> CreaseDirections {
        let mut some = CreaseDirections {
            all: Vec::new(),
            first: vec![0],
        };
        for (own, vertex) in (0..).zip(vertices) {
            let all = self.at_vertex(vertex);
            some.all.extend(all.map(|(_, along)| (own, along)));
            some.first.push(some.all.len() as u32);
        }
        some
    }

    /// Returns the directions of a vertex, each with its index in `all`.
    pub(super) fn at_vertex(&self, vertex: usize) -> impl Iterator<Item = (u32, Point)> + '_ {
        let own = match self.first.get(vertex..vertex + 2) {
            Some([first, end]) => *first..*end,
            _ => 0..0,
        };
        own.map(|way| (way, self.all[way as usize].1))
    }
}
