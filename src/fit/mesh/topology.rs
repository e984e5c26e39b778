//! Topology of a mesh: the neighbours of each vertex, or an error where the mesh is no surface.

use std::collections::HashMap;

use nalgebra::Vector3;

use crate::error::{Error, Result, rounded, try_filled};
use crate::math::index::NO_INDEX;
use crate::scene::mesh::Mesh;

use super::adjacency::Adjacency;
use super::morton_order;
use super::report::Repairs;
use crate::scene::half_edges::{half_edge_ends, next_half_edge, twin_half_edges};

/// Connectivity of a mesh as a surface: vertices at one position are joined, and all triangles face one side.
#[derive(Debug, Clone)]
pub(crate) struct Topology {
    /// For each vertex of the mesh, the vertex of the topology that it belongs to.
    pub joined: Vec<u32>,
    /// For each vertex of the topology, a vertex of the mesh that has its position.
    pub source: Vec<u32>,
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle of the topology, the triangle of the mesh that it was.
    pub from: Vec<u32>,
    pub adjacency: Adjacency,
    /// Neighbours of each vertex along the border.
    rim: Adjacency,
    /// Triangles around each vertex, in ascending order.
    pub(super) fans: Adjacency,
    /// Whether each vertex is interior: its triangles form one closed fan around it.
    pub inside: Vec<bool>,
    /// Number of pinched vertices, where two fans of triangles meet in a point.
    pub pinched: usize,
    pub components: usize,
    pub closed: bool,
    pub repairs: Repairs,
}

impl Topology {
    /// Finds the topology of a mesh, with vertices and triangles in the mesh's order.
    ///
    /// # Errors
    /// [`Error::Topology`] where triangles cannot all face one side; [`Error::Unsupported`] for a cloud of points.
    pub(crate) fn new(mesh: &Mesh) -> Result<Self> {
        let vertices = join_vertices(mesh)?;
        let mut repairs = Repairs::default();
        let mut from = proper_triangles(mesh, &vertices.0, &mut repairs);
        from.sort_unstable();
        Self::from_triangles(mesh, vertices, from, repairs)
    }

    /// Finds the topology of a mesh, with vertices and triangles ordered along a space-filling curve, so that
    /// neighbours on a large mesh are in the cache together.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn in_spatial_order(mesh: &Mesh) -> Result<Self> {
        let (mut joined, mut source) = join_vertices(mesh)?;
        let order = morton_order::order(source.iter().map(|i| mesh.positions()[*i as usize]));
        let mut place = try_filled("vertices", source.len(), 0)?;
        for (new, old) in (0..).zip(&order) {
            place[*old as usize] = new;
        }
        source = order.iter().map(|old| source[*old as usize]).collect();
        for vertex in &mut joined {
            *vertex = place[*vertex as usize];
        }
        let mut repairs = Repairs::default();
        let from = proper_triangles(mesh, &joined, &mut repairs);
        Self::from_triangles(mesh, (joined, source), from, repairs)
    }

    fn from_triangles(
        mesh: &Mesh,
        (joined, source): (Vec<u32>, Vec<u32>),
        from: Vec<u32>,
        mut repairs: Repairs,
    ) -> Result<Self> {
        let triangles: Vec<[u32; 3]> = (from.iter())
            .map(|t| mesh.triangles()[*t as usize].map(|i| joined[i as usize]))
            .collect();
        let mut used = try_filled("vertices", source.len(), false)?;
        for vertex in triangles.as_flattened() {
            used[*vertex as usize] = true;
        }
        let named = mesh.triangles().as_flattened();
        let mut named_at_all = try_filled("vertices", mesh.positions().len(), false)?;
        for vertex in named {
            named_at_all[*vertex as usize] = true;
        }
        let spoken_for = named_at_all.iter().filter(|used| **used).count();
        repairs.unused = named_at_all.len() - spoken_for;
        let once = used.iter().filter(|used| **used).count();
        repairs.joined = spoken_for.saturating_sub(once);
        let mut topology = Topology {
            joined,
            adjacency: Adjacency::default(),
            rim: Adjacency::default(),
            fans: Adjacency::default(),
            inside: try_filled("vertices", source.len(), false)?,
            source,
            triangles,
            from,
            pinched: 0,
            components: 0,
            closed: true,
            repairs,
        };
        topology.connect(mesh)?;
        Ok(topology)
    }

    pub(crate) fn len(&self) -> usize {
        self.source.len()
    }

    /// Iterates over the interior vertices, which have triangles all around.
    pub(crate) fn vertices_inside(&self) -> impl Iterator<Item = usize> + Clone + '_ {
        (0..self.len()).filter(|vertex| self.inside[*vertex])
    }

    /// Returns the neighbours of a vertex.
    pub(crate) fn around(&self, vertex: usize) -> &[u32] {
        self.adjacency.around(vertex)
    }

    /// Returns the indices of the triangles around a vertex, in ascending order.
    pub(super) fn triangles_around(&self, vertex: usize) -> &[u32] {
        self.fans.around(vertex)
    }

    /// Returns the given vertices and those within `rings` rings around them, each once, in ascending order.
    pub(crate) fn within_rings(&self, mut vertices: Vec<u32>, rings: usize) -> Vec<u32> {
        for _ in 0..rings {
            for given in 0..vertices.len() {
                vertices.extend_from_slice(self.around(vertices[given] as usize));
            }
            vertices.sort_unstable();
            vertices.dedup();
        }
        vertices
    }

    /// Computes the mean length of the edges at a vertex, for vertices at the given positions.
    pub(crate) fn mean_edge_length(&self, positions: &[Vector3<f64>], vertex: usize) -> f64 {
        let ring = self.around(vertex);
        let lengths = ring
            .iter()
            .map(|other| (positions[*other as usize] - positions[vertex]).norm());
        lengths.sum::<f64>() / ring.len().max(1) as f64
    }

    /// Iterates over the neighbours of a vertex along the border.
    pub(crate) fn along_rim(&self, vertex: usize) -> impl Iterator<Item = usize> + '_ {
        self.rim.around(vertex).iter().map(|other| *other as usize)
    }

    /// Finds the second ring of a vertex, as [`Adjacency::second_ring`] does.
    pub(crate) fn second_ring(&self, vertex: usize, to: &mut Vec<u32>) {
        self.adjacency.second_ring(vertex, to);
    }

    /// Finds the neighbours of each vertex, with the edges on the border, after the checks that make the mesh a
    /// surface.
    fn connect(&mut self, mesh: &Mesh) -> Result<()> {
        // The ends of each side of a triangle, the lower one first.
        let mut sides = Vec::new();
        for [a, b, c] in &self.triangles {
            for [a, b] in [[a, b], [b, c], [c, a]] {
                sides.push([*a.min(b), *a.max(b)]);
            }
        }
        sides.sort_unstable();
        let edges: Vec<&[[u32; 2]]> = sides.chunk_by(|a, b| a == b).collect();
        self.repairs.branched = edges.iter().filter(|edge| edge.len() > 2).count();
        self.orient(mesh)?;
        let ends = |edge: &&[[u32; 2]]| edge[0];
        self.adjacency = Adjacency::from_edges(self.len(), edges.iter().map(ends))?;
        // Where three triangles or more meet, none continues another: the edge is a border of each.
        let rim = || edges.iter().filter(|edge| edge.len() != 2);
        self.rim = Adjacency::from_edges(self.len(), rim().map(ends))?;
        self.closed = rim().next().is_none();
        let corners = (0..).zip(&self.triangles);
        let corners = corners.flat_map(|(triangle, own)| own.map(|corner| (corner, triangle)));
        self.fans = Adjacency::from_pairs(self.len(), corners)?;
        self.find_inside();
        Ok(())
    }

    /// Turns triangles over until neighbours face one side, and counts the connected components.
    fn orient(&mut self, mesh: &Mesh) -> Result<()> {
        let twins = twin_half_edges(&self.triangles);
        let count = self.triangles.len();
        let mut turned: Vec<Option<bool>> = vec![None; count];
        let mut stack = Vec::new();
        for start in 0..count {
            if turned[start].is_some() {
                continue;
            }
            self.components += 1;
            turned[start] = Some(false);
            let mut members = vec![start as u32];
            stack.push(start);
            while let Some(triangle) = stack.pop() {
                let own = turned[triangle].unwrap_or(false);
                let sides = 3 * triangle as u32..3 * triangle as u32 + 3;
                for side in sides.filter(|side| twins[*side as usize] != NO_INDEX) {
                    let twin = twins[side as usize];
                    let [from, to] = [side, twin].map(|s| half_edge_ends(&self.triangles, s)[0]);
                    let wanted = own != (from == to);
                    let other = twin as usize / 3;
                    match turned[other] {
                        None => {
                            turned[other] = Some(wanted);
                            members.push(other as u32);
                            stack.push(other);
                        }
                        Some(turn) if turn != wanted => {
                            let [a, ..] = self.triangles[triangle];
                            return Err(Error::Topology {
                                reason: format!(
                                    "it has one side only, as a Möbius strip has: around {} its \
                                     triangles cannot all face the same way",
                                    place(mesh, self.source[a as usize])
                                ),
                                advice: "cut it once across",
                            });
                        }
                        Some(_) => (),
                    }
                }
            }
            // The whole component faces as most of its triangles did.
            let over = members
                .iter()
                .filter(|t| turned[**t as usize] == Some(true))
                .count();
            let most = 2 * over > members.len();
            for triangle in members {
                if turned[triangle as usize] != Some(most) {
                    self.triangles[triangle as usize].swap(1, 2);
                    self.repairs.turned += 1;
                }
            }
        }
        Ok(())
    }

    /// Finds the interior vertices, at which the triangles form one closed fan, and counts the pinched ones.
    fn find_inside(&mut self) {
        let twins = twin_half_edges(&self.triangles);
        let mut count = vec![0u32; self.len()];
        let mut leaving = vec![NO_INDEX; self.len()];
        for (side, corner) in (0..).zip(self.triangles.as_flattened()) {
            count[*corner as usize] += 1;
            leaving[*corner as usize] = side;
        }
        for vertex in 0..self.len() {
            let start = leaving[vertex];
            if start == NO_INDEX {
                continue;
            }
            let (mut side, mut steps) = (start, 0);
            loop {
                side = twins[next_half_edge(next_half_edge(side)) as usize];
                steps += 1;
                if side == start || side == NO_INDEX {
                    break;
                }
            }
            self.inside[vertex] = side == start && steps == count[vertex];
            let rims = self.along_rim(vertex).count();
            self.pinched += usize::from(rims > 2 || (!self.inside[vertex] && rims == 0));
        }
    }
}

/// Writes index and position of a vertex of the mesh, for an error message.
fn place(mesh: &Mesh, vertex: u32) -> String {
    let [x, y, z] = mesh.positions()[vertex as usize].map(rounded);
    format!("vertex {vertex} ({x}, {y}, {z})")
}

/// Returns the indices of the mesh's triangles with three different corners, without repeated ones; counts the others
/// as repairs.
fn proper_triangles(mesh: &Mesh, joined: &[u32], repairs: &mut Repairs) -> Vec<u32> {
    let keys = mesh.triangles().iter().map(|triangle| {
        let mut key = triangle.map(|i| joined[i as usize]);
        key.sort_unstable();
        key
    });
    let mut sorted: Vec<([u32; 3], u32)> = keys.zip(0..).collect();
    let all = sorted.len();
    sorted.retain(|([a, b, c], _)| a != b && b != c);
    repairs.degenerate = all - sorted.len();
    sorted.sort_unstable();
    let some = sorted.len();
    sorted.dedup_by_key(|(key, _)| *key);
    repairs.repeated = some - sorted.len();
    sorted.into_iter().map(|(_, number)| number).collect()
}

/// Joins vertices at exactly one position, as files without indices and seams between textures have them. Returns the
/// joined vertex of each vertex, and for each joined vertex one of its vertices.
fn join_vertices(mesh: &Mesh) -> Result<(Vec<u32>, Vec<u32>)> {
    if mesh.is_cloud() {
        return Err(Error::Unsupported {
            format: "point cloud",
            reason: "its points have no triangles; fit what is seen of it along a view".into(),
        });
    }
    let positions = mesh.positions();
    let mut joined = try_filled("vertices", positions.len(), 0)?;
    let mut source = Vec::new();
    let mut found = HashMap::with_capacity(positions.len());
    for (vertex, position) in positions.iter().enumerate() {
        // Makes 0 of -0.
        let key = position.map(|x| (x + 0.0).to_bits());
        joined[vertex] = *found.entry(key).or_insert_with(|| {
            source.push(vertex as u32);
            source.len() as u32 - 1
        });
    }
    Ok((joined, source))
}
