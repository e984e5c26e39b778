//! Divides the triangles of a mesh into patches along the edges where the surface folds.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::chains::chains;
use super::crease::Crease;
use super::options::PatchOptions;
use super::patch::{NO_PATCH, Patch};
use crate::error::{Error, Result, positive, try_filled};
use crate::fit::mesh::topology::Topology;
use crate::scene::facets::Facets;
use crate::scene::half_edges::half_edge_ends;
use crate::scene::mesh::Mesh;

/// The patches of a mesh (its triangles divided into regions) and the creases between the patches.
///
/// A crease runs along edges. Where a crease is blunt, by noise or by its triangles, so that it is a
/// strip of triangles, each of these belongs to the side from which it bends less.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshPatches {
    labels: Vec<u32>,
    patches: Vec<Patch>,
    creases: Vec<Crease>,
    bend: f64,
}

impl MeshPatches {
    /// Divides a mesh into patches at its creases; costs `O(n log n)` for `n` triangles. [`PatchOptions::bend`] is the
    /// angle between the triangles on either side of an edge; by default six times its median over edges that are not
    /// flat, from 0.035 to 0.35.
    ///
    /// # Errors
    /// [`Error::Option`] as for heightfields, [`Error::Topology`] if the mesh is no surface,
    /// [`Error::Unsupported`] for a cloud of points, [`Error::OutOfMemory`].
    pub fn new(mesh: &Mesh, options: &PatchOptions) -> Result<Self> {
        if !(0.0..=1.0).contains(&options.smallest) {
            let must = "must be from 0 to 1";
            return Err(Error::option("smallest", options.smallest, must));
        }
        let fold = positive("fold", options.fold)?;
        let bend = options.bend.map(|b| positive("bend", b)).transpose()?;
        let topology = Topology::new(mesh)?;
        let place = |vertex: &u32| Vector3::from(mesh.positions()[*vertex as usize]);
        let places = topology.source.iter().map(place).collect();
        let shape = Facets::new(places, topology.triangles)?;
        let area: f64 = shape.areas.iter().sum();
        if !area.is_normal() {
            return Err(Error::mesh_size(area));
        }
        let bend = bend.unwrap_or_else(|| shape.usual_bend());
        let mut own = shape.parted(bend, options.smallest, fold)?;
        let patches = number_by_area(&shape, &mut own);
        let mut labels = try_filled("patches", mesh.triangles().len(), NO_PATCH)?;
        for (label, triangle) in own.iter().zip(&topology.from) {
            labels[*triangle as usize] = *label;
        }
        Ok(MeshPatches {
            labels,
            patches,
            creases: creases(&shape, &own),
            bend,
        })
    }

    /// Returns the number of the patch of each triangle; [`NO_PATCH`](super::NO_PATCH) for duplicates and triangles
    /// without an area.
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// Returns the patches by area, the largest first. A vertex on a crease counts for all patches there.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// Returns the creases between the patches.
    pub fn creases(&self) -> &[Crease] {
        &self.creases
    }

    /// Returns the angle between neighbouring triangles, in radians, above which an edge counts as part of a crease;
    /// for edges next to such an edge, half of it is enough.
    pub fn bend(&self) -> f64 {
        self.bend
    }
}

/// Measures the patches of a mesh and numbers them by area, the largest first.
fn number_by_area(facets: &Facets, labels: &mut [u32]) -> Vec<Patch> {
    let mut found: BTreeMap<u32, (f64, Vec<u32>)> = BTreeMap::new();
    for ((label, area), corners) in labels.iter().zip(&facets.areas).zip(&facets.triangles) {
        let (sum, vertices) = found.entry(*label).or_default();
        *sum += area;
        vertices.extend(corners);
    }
    let mut order: Vec<(u32, Patch)> = found
        .into_iter()
        .map(|(label, (area, mut vertices))| {
            vertices.sort_unstable();
            vertices.dedup();
            let vertices = vertices.len();
            (label, Patch { vertices, area })
        })
        .collect();
    order.sort_by(|a, b| b.1.area.total_cmp(&a.1.area));
    let numbers: BTreeMap<u32, u32> = (order.iter().zip(0..))
        .map(|((old, _), new)| (*old, new))
        .collect();
    for label in labels {
        *label = numbers[label];
    }
    order.into_iter().map(|(_, patch)| patch).collect()
}

/// Finds the creases of a mesh that is divided into patches: lines of edges between triangles of different patches.
fn creases(facets: &Facets, labels: &[u32]) -> Vec<Crease> {
    let mut between: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (side, twin) in facets.pairs() {
        let [a, b] = [side, twin].map(|side| labels[side / 3]);
        if a != b {
            between.entry([a.min(b), a.max(b)]).or_default().push(side);
        }
    }
    let mut creases = Vec::new();
    for (patches, sides) in between {
        let edges: Vec<[u32; 2]> = (sides.iter())
            .map(|side| half_edge_ends(&facets.triangles, *side as u32))
            .collect();
        for chain in chains(&edges, |_| false) {
            let (mut bent, mut length) = (0.0, 0.0);
            for edge in &chain.edges {
                let side = sides[*edge];
                bent += facets.lengths[side] * facets.angles[side];
                length += facets.lengths[side];
            }
            let points = chain.vertices.iter();
            creases.push(Crease {
                patches,
                points: points.map(|v| facets.places[*v as usize].into()).collect(),
                length,
                fold: if length > 0.0 { bent / length } else { 0.0 },
            });
        }
    }
    creases
}
