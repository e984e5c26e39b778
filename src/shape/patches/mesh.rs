//! The patches of a mesh as it is: its triangles, parted along the edges where the surface folds.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use nalgebra::Vector3;

use super::chains::chains;
use super::{Crease, Patch, PatchOptions};
use crate::error::{Error, Result, positive, try_filled};
use crate::fit::mesh::topology::Topology;
use crate::math::forest::Forest;
use crate::scene::mesh::Mesh;
use crate::scene::twins::{NONE, ends, twins};

/// The usual threshold between these angles: flat facets of a round shape fold by less, and what is left of
/// noise does, too.
const BEND: [f64; 2] = [0.035, 0.35];

/// What is flat up to rounding says nothing about how much a surface bends usually.
const FLAT: f64 = 1e-6;

/// Label of triangles that belong to no patch.
const NO_PATCH: u32 = super::NO_PATCH;

/// A mesh parted along its creases.
///
/// A crease runs along edges. Where noise or the triangles themselves have cut its corner, so that it is a
/// strip of triangles, these go to the side that they bend away from less.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshPatches {
    labels: Vec<u32>,
    patches: Vec<Patch>,
    creases: Vec<Crease>,
    bend: f64,
}

impl MeshPatches {
    /// Looks for the patches of a mesh; costs `O(n log n)` for `n` triangles. [`PatchOptions::bend`] is the
    /// angle between the triangles on either side of an edge; by default six times its median over edges
    /// that are not flat, from 0.035 to 0.35.
    ///
    /// # Errors
    /// [`Error::Option`] as for heightfields, [`Error::Topology`] if the mesh is no surface,
    /// [`Error::OutOfMemory`].
    pub fn new(mesh: &Mesh, options: &PatchOptions) -> Result<Self> {
        if !(0.0..=1.0).contains(&options.smallest) {
            let must = "must be from 0 to 1";
            return Err(Error::option("smallest", options.smallest, must));
        }
        let fold = positive("fold", options.fold)?;
        let bend = options.bend.map(|b| positive("bend", b)).transpose()?;
        let topology = Topology::new(mesh)?;
        let shape = Facets::new(mesh, &topology)?;
        let bend = bend.unwrap_or_else(|| shape.usual_bend());
        let mut own = shape.regions(0.5 * bend)?;
        shape.give_away(&mut own, options.smallest);
        shape.merge(&mut own, fold)?;
        let patches = shape.sorted(&mut own);
        let mut labels = try_filled("patches", mesh.triangles().len(), NO_PATCH)?;
        for (label, triangle) in own.iter().zip(&topology.from) {
            labels[*triangle as usize] = *label;
        }
        Ok(MeshPatches {
            labels,
            patches,
            creases: shape.creases(&own),
            bend,
        })
    }

    /// The patch of each triangle; [`NO_PATCH`](super::NO_PATCH) for those without an area or that are
    /// there twice.
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// The patches, that with the largest area first. Vertices on creases count for all patches there.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// The creases between them.
    pub fn creases(&self) -> &[Crease] {
        &self.creases
    }

    /// The angle that counted as a crease, in radians from one triangle to the next; half of it does along
    /// an edge whose neighbours reach it.
    pub fn bend(&self) -> f64 {
        self.bend
    }
}

/// Triangles with what lies between them.
struct Facets {
    places: Vec<Vector3<f64>>,
    triangles: Vec<[u32; 3]>,
    twins: Vec<u32>,
    /// Angle along each side, and the side's length.
    angles: Vec<f64>,
    lengths: Vec<f64>,
    areas: Vec<f64>,
}

impl Facets {
    fn new(mesh: &Mesh, topology: &Topology) -> Result<Self> {
        let place = |vertex: &u32| Vector3::from(mesh.positions()[*vertex as usize]);
        let places: Vec<_> = topology.source.iter().map(place).collect();
        let triangles = topology.triangles.clone();
        let twins = twins(&triangles);
        let mut normals = try_filled("patches", triangles.len(), Vector3::zeros())?;
        let mut areas = try_filled("patches", triangles.len(), 0.0)?;
        for (corners, (normal, area)) in triangles.iter().zip(normals.iter_mut().zip(&mut areas)) {
            let [a, b, c] = corners.map(|v| places[v as usize]);
            let cross: Vector3<f64> = (b - a).cross(&(c - a));
            *area = 0.5 * cross.norm();
            *normal = cross;
        }
        let mut angles = try_filled("patches", twins.len(), 0.0)?;
        let mut lengths = try_filled("patches", twins.len(), 0.0)?;
        for side in 0..twins.len() {
            let [a, b] = ends(&triangles, side as u32).map(|v| places[v as usize]);
            lengths[side] = (b - a).norm();
            if twins[side] != NONE {
                let [m, n] = [side, twins[side] as usize].map(|side| normals[side / 3]);
                angles[side] = m.cross(&n).norm().atan2(m.dot(&n));
            }
        }
        Ok(Facets {
            places,
            triangles,
            twins,
            angles,
            lengths,
            areas,
        })
    }

    /// Sides with another one, each pair once.
    fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let all = self.twins.iter().enumerate();
        all.filter(|(side, twin)| **twin != NONE && *side < **twin as usize)
            .map(|(side, twin)| (side, *twin as usize))
    }

    fn usual_bend(&self) -> f64 {
        let pairs = self.pairs().map(|(side, _)| self.angles[side]);
        let mut angles: Vec<f64> = pairs.filter(|angle| *angle > FLAT).collect();
        let middle = angles.len() / 2;
        let median = match angles.is_empty() {
            true => 0.0,
            false => *angles.select_nth_unstable_by(middle, f64::total_cmp).1,
        };
        (6.0 * median).clamp(BEND[0], BEND[1])
    }

    /// Triangles with no sharper edge between them.
    fn regions(&self, bend: f64) -> Result<Vec<u32>> {
        let mut forest = Forest::new("patches", self.triangles.len())?;
        for (side, twin) in self.pairs() {
            if self.angles[side] <= bend {
                forest.join(side as u32 / 3, twin as u32 / 3);
            }
        }
        Ok((0..self.triangles.len() as u32)
            .map(|t| forest.root(t))
            .collect())
    }

    /// The triangles of small regions go to where they bend least, as water runs.
    fn give_away(&self, labels: &mut [u32], share: f64) {
        let mut areas = vec![0.0; labels.len()];
        for (label, area) in labels.iter().zip(&self.areas) {
            areas[*label as usize] += area;
        }
        let largest = areas.iter().copied().fold(0.0, f64::max);
        let least = largest.min(share * self.areas.iter().sum::<f64>());
        let mut open: Vec<bool> = labels.iter().map(|l| areas[*l as usize] < least).collect();
        // By the angle, which orders as its bits do.
        let mut queue = BinaryHeap::new();
        let around = |t: usize| (3 * t..3 * t + 3).filter(|side| self.twins[*side] != NONE);
        let entry = |side: usize| Reverse((self.angles[side].to_bits(), self.twins[side], side));
        for t in (0..labels.len()).filter(|t| !open[*t]) {
            queue.extend(around(t).map(entry));
        }
        while let Some(Reverse((_, twin, side))) = queue.pop() {
            let to = twin as usize / 3;
            if std::mem::take(&mut open[to]) {
                labels[to] = labels[side / 3];
                queue.extend(around(to).map(entry));
            }
        }
    }

    /// Regions that fold by less than an angle on average are one, those that fold least first.
    fn merge(&self, labels: &mut [u32], fold: f64) -> Result<()> {
        let mut forest = Forest::new("patches", labels.len())?;
        let mut between: BTreeMap<(u32, u32), [f64; 2]> = BTreeMap::new();
        for (side, twin) in self.pairs() {
            let [a, b] = [side, twin].map(|side| labels[side / 3]);
            if a != b {
                let sum = between.entry((a.min(b), a.max(b))).or_default();
                *sum = [
                    sum[0] + self.lengths[side] * self.angles[side],
                    sum[1] + self.lengths[side],
                ];
            }
        }
        loop {
            let angles = between
                .iter()
                .map(|(pair, [bent, long])| (bent / long, *pair));
            let least = angles
                .filter(|(angle, _)| *angle < fold)
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, (a, b))) = least else {
                break;
            };
            forest.join(a, b);
            let mut joined: BTreeMap<(u32, u32), [f64; 2]> = BTreeMap::new();
            for ((a, b), [bent, long]) in between {
                let (a, b) = (forest.root(a), forest.root(b));
                if a != b {
                    let sum = joined.entry((a.min(b), a.max(b))).or_default();
                    *sum = [sum[0] + bent, sum[1] + long];
                }
            }
            between = joined;
        }
        for label in labels {
            *label = forest.root(*label);
        }
        Ok(())
    }

    /// Measures the regions and numbers them by their areas.
    fn sorted(&self, labels: &mut [u32]) -> Vec<Patch> {
        let mut found: BTreeMap<u32, (f64, Vec<u32>)> = BTreeMap::new();
        for ((label, area), corners) in labels.iter().zip(&self.areas).zip(&self.triangles) {
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

    fn creases(&self, labels: &[u32]) -> Vec<Crease> {
        let mut between: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
        for (side, twin) in self.pairs() {
            let [a, b] = [side, twin].map(|side| labels[side / 3]);
            if a != b {
                between.entry([a.min(b), a.max(b)]).or_default().push(side);
            }
        }
        let mut creases = Vec::new();
        for (patches, sides) in between {
            let edges: Vec<[u32; 2]> = (sides.iter())
                .map(|side| ends(&self.triangles, *side as u32))
                .collect();
            for chain in chains(&edges, |_| false) {
                let (mut bent, mut length) = (0.0, 0.0);
                for edge in &chain.edges {
                    let side = sides[*edge];
                    bent += self.lengths[side] * self.angles[side];
                    length += self.lengths[side];
                }
                let points = chain.vertices.iter();
                creases.push(Crease {
                    patches,
                    points: points.map(|v| self.places[*v as usize].into()).collect(),
                    length,
                    fold: if length > 0.0 { bent / length } else { 0.0 },
                });
            }
        }
        creases
    }
}
