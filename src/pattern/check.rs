//! Checks that a sheet is valid: laid flat without strain, and within an outline that does not cross itself.

use super::flat_patch::Strain;
use super::layout::seam_gap;
use super::motion::Motion;
use super::outline::Layout;
use super::seam_graph::{SeamGraph, is_triangle};
use crate::error::Result;
use crate::unroll::arap_mesh::{ArapMesh, BarycentricPoint, StoppingCriteria};
use crate::unroll::flat_triangle::Point;
use crate::unroll::overlap::crossings;

/// Maximum seam gap, in lattice spacings, at which the two sides of a fold count as coincident, so that the sheet
/// is not laid flat again. `benches/patterns.md` has what others give.
const MAX_JOINED_GAP_SPACINGS: f64 = 0.05;

/// Number of nodes at an end of a seam that are not joined to the seam's other side where three patches meet: if more
/// than three meet, the position of the meeting point is inexact. `benches/patterns.md` has what others give.
const UNTIED_END_NODES: usize = 1;

/// Returns whether the two sides of every fold of a sheet coincide already, so that the sheet need not be laid flat
/// again.
pub(super) fn are_close(net: &SeamGraph, layout: &Layout, folded: &[usize]) -> bool {
    let mut folded = folded.iter();
    folded.all(|seam| seam_gap(net, layout, *seam) <= MAX_JOINED_GAP_SPACINGS * net.spacing)
}

/// The patches of a sheet as one triangle mesh, in which points on the two sides of each fold are constrained to
/// coincide.
pub(super) struct SheetMesh {
    patches: Vec<u32>,
    /// Number of the first vertex of each patch among the vertices of the joined mesh.
    starts: Vec<u32>,
    joint: ArapMesh,
    places: Vec<Point>,
}

impl SheetMesh {
    pub(super) fn new(
        net: &SeamGraph,
        layout: &Layout,
        patches: &[u32],
        folded: &[usize],
    ) -> Result<SheetMesh> {
        let mut pieces = Vec::new();
        let mut places: Vec<Point> = Vec::new();
        let mut starts = Vec::new();
        for patch in patches {
            let first = places.len() as u32;
            starts.push(first);
            let Some(flat_patch) = net.flat_patches[*patch as usize].as_ref() else {
                continue;
            };
            let motion = layout.motions[*patch as usize];
            places.extend(flat_patch.places().iter().map(|place| motion.apply(*place)));
            let own = flat_patch.all_pieces().filter(|(piece, _)| piece.exists());
            pieces.extend(own.map(|(piece, corners)| (piece, corners.map(|v| first + v))));
        }
        let ties = ties(net, patches, &starts, folded);
        Ok(SheetMesh {
            patches: patches.to_vec(),
            starts,
            joint: ArapMesh::new(&places, pieces, ties)?,
            places,
        })
    }

    /// Moves the sheet's vertices to positions of less strain, starting from the current positions of its patches,
    /// and resets the patches' rigid motions. Returns the cost: number of iterations times number of vertices.
    pub(super) fn relax(
        &mut self,
        net: &mut SeamGraph,
        layout: &mut Layout,
        until: StoppingCriteria,
    ) -> Result<usize> {
        let steps = self.joint.minimise_in_plane(&mut self.places, until)?.steps;
        for (k, patch) in self.patches.iter().enumerate() {
            let end = self
                .starts
                .get(k + 1)
                .map_or(self.places.len(), |end| *end as usize);
            net.set_places(*patch, self.places[self.starts[k] as usize..end].to_vec());
            layout.motions[*patch as usize] = Motion::IDENTITY;
        }
        Ok(steps * self.places.len())
    }
}

/// Lists the pairs of points on the two sides of folds that have to coincide, each point as a weighted mean of
/// vertices; `starts` holds the number of each patch's first vertex.
pub(super) fn ties(
    net: &SeamGraph,
    patches: &[u32],
    starts: &[u32],
    folded: &[usize],
) -> Vec<[BarycentricPoint; 2]> {
    let mut ties = Vec::new();
    for seam in folded {
        let seam = &net.seams[*seam];
        let last = seam.nodes.len() - 1;
        let from = if is_triangle(seam.nodes[0]) {
            UNTIED_END_NODES
        } else {
            0
        };
        let to = match is_triangle(seam.nodes[last]) {
            true => last.saturating_sub(UNTIED_END_NODES),
            false => last,
        };
        for node in seam.nodes.iter().take(to + 1).skip(from) {
            let mean = |side: usize| {
                let patch = seam.patches[side];
                let first = starts[patches.binary_search(&patch).ok()?];
                Some(net.mean(*node, patch)?.map(|(v, w)| (first + v, w)))
            };
            if let (Some(one), Some(other)) = (mean(0), mean(1)) {
                ties.push([one, other]);
            }
        }
    }
    ties
}

/// Computes the root mean square strain of the triangles beside a seam, on both of the seam's sides.
pub(super) fn strain_along(net: &SeamGraph, seam: usize) -> f64 {
    let seam = &net.seams[seam];
    let sides = seam.patches.iter().filter_map(|patch| {
        let flat_patch = net.flat_patches[*patch as usize].as_ref()?;
        let mut beside = vec![false; flat_patch.places().len()];
        let means = seam.nodes.iter().filter_map(|node| net.mean(*node, *patch));
        for (vertex, weight) in means.flatten() {
            beside[vertex as usize] |= weight != 0.0;
        }
        Some(flat_patch.strain_of(|vertex| beside[vertex as usize]))
    });
    sides.fold(Strain::default(), Strain::with).rms()
}

/// Computes the strain of a whole sheet, and the strain of each of its patches.
pub(super) fn strains(net: &SeamGraph, patches: &[u32]) -> (Strain, Vec<(u32, Strain)>) {
    let flat_patch = |patch: &u32| net.flat_patches[*patch as usize].as_ref();
    let of = |patch: &u32| Some((*patch, flat_patch(patch)?.strain()));
    let all: Vec<(u32, Strain)> = patches.iter().filter_map(of).collect();
    let sum = all
        .iter()
        .fold(Strain::default(), |sum, (_, strain)| sum.with(*strain));
    (sum, all)
}

/// Finds the first point where closed polylines cross each other or themselves.
pub(super) fn crossing(lines: &[Vec<Point>]) -> Option<Point> {
    let (mut places, mut edges) = (Vec::new(), Vec::new());
    for line in lines {
        let (first, count) = (places.len() as u32, line.len() as u32);
        places.extend(line);
        edges.extend((0..count).map(|k| [first + k, first + (k + 1) % count]));
    }
    let found = crossings(&places, &edges).into_iter().next()?;
    Some(places[edges[found[0]][0] as usize])
}
