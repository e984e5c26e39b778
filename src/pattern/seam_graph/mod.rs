//! What a surface falls into along its creases: patches laid flat, the seams between them, and the
//! lines around each patch.
//!
//! A *node* is a point where the line around a patch may turn: a vertex of the lattice, the point on an edge where
//! two patches meet, or the point in a triangle where three patches meet.

mod border;
mod division;
mod places;

pub(super) use border::HEADING_NODES;
pub(super) use division::divided;

use super::flat_patch::{FlatPatch, MIN_TEAR_GAP_SPACINGS};
use super::labels::Labels;
use crate::error::Result;
use crate::heights::heightfield::Heightfield;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;
use crate::shape::patches::crease::crease_lines;
use crate::unroll::flat_triangle::Point;
use rustc_hash::FxHashMap;

/// Node of the graph of seams: a point on an edge, at a vertex or in a triangle of the lattice. An edge is given by its
/// vertices, the lower number first; a vertex by its number, twice; a triangle by its number and an invalid vertex.
/// Numbers refer to the mesh of the whole surface.
pub(super) type Node = crate::shape::patches::crease::CreaseNode;

/// Maximum distance, in lattice spacings, between two nodes of three patches each that form one junction of four
/// patches.
pub(super) const FOUR_WAY_JUNCTION_RADIUS: f64 = 3.0;

/// Seam gap below which a seam counts as closed, because it is finer than the surface's resolution; in spacings of
/// a lattice or edge lengths of a mesh.
pub(in crate::pattern) const NEGLIGIBLE_GAP_LENGTHS: f64 = 0.25;

/// Minimum number of nodes (points where a crease crosses lattice edges) of each part of a seam that is divided.
/// `benches/patterns.md` has what others give.
const MIN_SEAM_PART_NODES: usize = 4;

/// A crease or a part of it, with its line on the flat patches on both sides.
pub(super) struct Seam {
    pub patches: [u32; 2],
    /// Number of the crease that the seam lies on.
    pub crease: usize,
    /// Whether the seam is a cut inside of a patch, and not a crease.
    pub smooth: bool,
    /// Position of the seam's first node in the list of the crease's nodes.
    from: usize,
    pub nodes: Vec<Node>,
    /// Positions of the seam's nodes in the plane of the flat patch on either side, smoothed along the crease.
    pub sides: [Vec<Point>; 2],
    /// Sum over the crease's nodes of how far one patch falls relative to the other across the crease; its sign is
    /// positive for a ridge, negative for a groove, seen from above.
    pub rise: f64,
    /// Root mean square vertical distance between the surfaces of the two patches along the seam, in the surface's
    /// units.
    pub apart: f64,
}

/// A segment of the closed line around a patch, from one node to the next; the patch is to its left.
type Segment = [Node; 2];

/// Graph of the seams between all patches; its nodes are points along the seams, with their positions in the plane of
/// each patch.
pub(super) struct SeamGraph {
    pub spacing: f64,
    /// Spacing, in the surface's units, of the lattice on which the cuts of the surface were decided, which may be
    /// coarser than this lattice; loops of outlines that are small on that lattice are cut off.
    pub decided: f64,
    pub flat_patches: Vec<Option<FlatPatch>>,
    pub seams: Vec<Seam>,
    /// Numbers of the seams that each crease is divided into.
    parts: Vec<Vec<usize>>,
    /// For each node the number of its seam; `also` holds a second seam for nodes where a crease is divided.
    seam_of: FxHashMap<Node, usize>,
    also: FxHashMap<Node, usize>,
    /// For each patch the segments of the closed line around it, in no order.
    borders: Vec<Vec<Segment>>,
    mesh: Triangulation,
    labels: Vec<u32>,
    /// Barycentric coordinates of each node: the share of the first corner for edges, of all three for
    /// triangles.
    shares: FxHashMap<Node, [f64; 3]>,
    /// Distance in plan from the last node of a seam to the border's line, for seams that end at the border.
    ends: FxHashMap<Node, f64>,
    /// For a node on a seam and a patch beside it: position of the node in the plane of the flat patch.
    on_seams: FxHashMap<(Node, u32), Point>,
}

impl SeamGraph {
    /// Finds the seams of a surface, one for each crease. `decided` is the spacing of the lattice on which the
    /// surface was cut; a larger value cuts off larger loops of the outlines.
    pub(super) fn new(
        surface: &Heightfield,
        labels: &Labels,
        flat_patches: Vec<Option<FlatPatch>>,
        decided: f64,
    ) -> Result<SeamGraph> {
        let mesh = Triangulation::new(surface, &Frame::default())?;
        let mut net = SeamGraph {
            spacing: surface.lattice().spacing(),
            decided,
            borders: vec![Vec::new(); flat_patches.len()],
            flat_patches,
            seams: Vec::new(),
            parts: Vec::new(),
            seam_of: FxHashMap::default(),
            also: FxHashMap::default(),
            labels: (mesh.vertices().iter())
                .map(|v| labels.of[*v as usize])
                .collect(),
            mesh,
            shares: FxHashMap::default(),
            ends: FxHashMap::default(),
            on_seams: FxHashMap::default(),
        };
        for (crease, (patches, nodes)) in
            crease_lines(&net.mesh, &labels.of).into_iter().enumerate()
        {
            let smooth = labels.are_one(patches[0], patches[1]);
            net.add_seam(crease, patches, smooth, nodes);
        }
        net.index();
        net.add_borders();
        net.add_ends();
        Ok(net)
    }

    fn add_seam(&mut self, crease: usize, patches: [u32; 2], smooth: bool, nodes: Vec<Node>) {
        let (mut rise, mut squares, mut count) = (0.0, 0.0, 0.0);
        for node in &nodes {
            if is_triangle(*node) {
                let share = self.meeting(node.0);
                self.shares.entry(*node).or_insert(share);
                continue;
            }
            let (share, steepness) = match smooth {
                true => (0.5, 0.0),
                false => self.crossing(*node),
            };
            self.shares.insert(*node, [1.0 - share, share, 0.0]);
            rise += steepness;
            let [a, b] = patches.map(|patch| self.height(*node, patch));
            squares += (a - b) * (a - b);
            count += 1.0;
        }
        let sides = patches.map(|patch| self.line(patch, &nodes, smooth));
        for (patch, side) in patches.iter().zip(&sides) {
            for (node, place) in nodes.iter().zip(side) {
                self.on_seams.insert((*node, *patch), *place);
            }
        }
        self.parts.push(vec![self.seams.len()]);
        self.seams.push(Seam {
            patches,
            crease,
            smooth,
            from: 0,
            nodes,
            sides,
            rise,
            apart: f64::sqrt(squares / f64::max(count, 1.0)),
        });
    }

    /// Builds the index from nodes to the seams that they are on.
    fn index(&mut self) {
        self.seam_of.clear();
        self.also.clear();
        for (number, seam) in self.seams.iter().enumerate() {
            for node in seam.nodes.iter().filter(|node| !is_triangle(**node)) {
                match self.seam_of.get(node) {
                    Some(first) if *first != number => {
                        self.also.insert(*node, number);
                    }
                    _ => {
                        self.seam_of.insert(*node, number);
                    }
                }
            }
        }
    }

    /// Returns whether a seam is at a step of the surface, so that its two sides are apart in space.
    pub(super) fn is_torn(&self, seam: usize) -> bool {
        self.seams[seam].apart > MIN_TEAR_GAP_SPACINGS * self.spacing
    }

    /// Returns the one or two seams that a node on an edge is on.
    pub(super) fn seams_of(&self, node: Node) -> [Option<usize>; 2] {
        [
            self.seam_of.get(&node).copied(),
            self.also.get(&node).copied(),
        ]
    }

    /// Returns the seams that cross the three edges of a triangle.
    pub(super) fn seams_at(&self, triangle: u32) -> [Option<usize>; 3] {
        let [a, b, c] = self.mesh.triangles()[triangle as usize];
        [(a, b), (b, c), (c, a)].map(|(p, q)| self.seam_of.get(&(p.min(q), p.max(q))).copied())
    }
}

pub(super) fn is_triangle((_, q): Node) -> bool {
    q == u32::MAX
}
