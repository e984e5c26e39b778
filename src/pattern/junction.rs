//! Points inside of the surface where cuts or folds end, and the angle of the surface around them.

use super::labels::Labels;
use super::outline::Layout;
use super::seam_graph::{FOUR_WAY_JUNCTION_RADIUS, Node, SeamGraph, is_triangle};
use crate::error::Result;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::Lattice;
use crate::math::planar::polyline_length;
use crate::math::union_find::UnionFind;
use crate::unroll::flat_triangle::Point;
use rustc_hash::FxHashMap;

/// Maximum radius around a point within which the surface's angle is measured, in spacings of a lattice or edge lengths
/// of a mesh.
const MAX_ANGLE_RADIUS_LENGTHS: f64 = 20.0;

/// Maximum radius around a point within which the surface's angle is measured, as a share of the shortest seam that
/// ends there and of the distance to the nearest cut that does not.
const ANGLE_RADIUS_SHARE: f64 = 0.8;

/// Minimum radius around a point at which the surface's angle is measured, in spacings of a lattice or edge lengths of
/// a mesh; nearer to the point the sampling smooths the surface.
pub(super) const MIN_ANGLE_RADIUS_LENGTHS: f64 = 6.0;

/// Number of evenly spaced directions in which the ring around a point is sampled to measure the angle there.
const RING_DIRECTIONS: usize = 720;

/// Number of straight segments by which the length of the path from a point to its ring is measured.
const RADIAL_STEPS: usize = 12;

/// Radius around a point within which the surface's angle is measured, from the length of the shortest seam that ends there
/// and the distance to the nearest cut that does not: what the surface bends beside another cut is taken up by that cut.
pub(super) fn angle_reach(spacing: f64, shortest: f64, other: f64) -> f64 {
    (MAX_ANGLE_RADIUS_LENGTHS * spacing).min(ANGLE_RADIUS_SHARE * shortest.min(other))
}

/// A point inside of the surface where cuts or folds end.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Junction {
    /// Number of the point, which is the same on all sheets.
    pub number: usize,
    /// Position of the point on the surface, in the surface's units.
    pub place: [f64; 3],
    /// Sum of the angles of the surface around the point, in radians: 2π where the surface could be laid flat in
    /// one piece, less at the tip of a cone, more at a saddle.
    pub angle: f64,
    /// Outer radius of the ring in which the angle was measured, as distance along the surface in its units; the inner
    /// radius is half of it.
    pub reach: f64,
    /// Number of cuts that end at the point, counted twice if both ends do.
    pub cuts: usize,
}

/// The points of a heightfield where cuts or folds end or meet, each with its node in the graph of seams as the
/// key.
pub(super) struct Junctions {
    all: Vec<Option<Junction>>,
    of: FxHashMap<Node, usize>,
}

impl Junctions {
    /// Returns the point at a node of the seam graph; `None` at the border, at steps, and where a seam that ends there
    /// is too short to measure an angle.
    pub(super) fn at(&self, node: Node) -> Option<Junction> {
        self.of.get(&node).and_then(|number| self.all[*number])
    }

    pub(super) fn new(
        surface: &Heightfield,
        labels: &Labels,
        net: &SeamGraph,
        layout: &Layout,
    ) -> Result<Junctions> {
        let ends = |seam: usize| {
            let nodes = &net.seams[seam].nodes;
            [nodes[0], nodes[nodes.len() - 1]]
        };
        let inner = |node: Node| is_triangle(node) || net.seams_of(node)[1].is_some();
        let open = |seam: &usize| ends(*seam)[0] != ends(*seam)[1];
        let seams: Vec<usize> = (0..net.seams.len()).filter(open).collect();
        let (mut nodes, mut of) = (Vec::new(), FxHashMap::default());
        for node in seams.iter().flat_map(|seam| ends(*seam)) {
            if inner(node) && !of.contains_key(&node) {
                of.insert(node, nodes.len());
                nodes.push(node);
            }
        }
        // A junction of four patches consists of two nodes with three patches each; merge them.
        let long = |seam: usize| polyline_length(&net.seams[seam].sides[0]);
        let mut sets = UnionFind::new("pattern", nodes.len())?;
        for seam in seams
            .iter()
            .filter(|s| long(**s) <= FOUR_WAY_JUNCTION_RADIUS * net.spacing)
        {
            if let [Some(a), Some(b)] = ends(*seam).map(|node| of.get(&node)) {
                sets.union(*a as u32, *b as u32);
            }
        }
        of.values_mut()
            .for_each(|number| *number = sets.find(*number as u32) as usize);
        let mut found = vec![PointSeams::default(); nodes.len()];
        for seam in seams {
            let at = ends(seam).map(|node| of.get(&node).copied());
            for number in at.into_iter().flatten() {
                let found = &mut found[number];
                found.torn |= net.is_torn(seam);
                // Skip seams that only connect nodes of one junction.
                if at[0] != at[1] {
                    found.cuts += usize::from(!layout.folded[seam]);
                    found.shortest = found.shortest.min(long(seam));
                }
            }
        }
        for node in &nodes {
            let found = &mut found[of[node]];
            let place = net.built(*node);
            found.sum = [0, 1, 2].map(|k| found.sum[k] + place[k]);
            found.count += 1.0;
        }
        let around = AngleSurface {
            surface,
            labels,
            net,
        };
        // Positions of the nodes of all cuts, each with the numbers of the points where its cut ends.
        let cuts: Vec<([f64; 3], [Option<usize>; 2])> = (0..net.seams.len())
            .filter(|seam| !layout.folded[*seam])
            .flat_map(|seam| {
                let ends = ends(seam).map(|node| of.get(&node).copied());
                let nodes = net.seams[seam].nodes.iter();
                nodes.map(move |node| (net.built(*node), ends))
            })
            .collect();
        let all = found.iter().enumerate().map(|(number, found)| {
            let place = found.sum.map(|sum| sum / found.count);
            let others = cuts
                .iter()
                .filter(|(_, ends)| !ends.contains(&Some(number)));
            let other = others
                .map(|(node, _)| squared(*node, place))
                .fold(f64::INFINITY, f64::min);
            let reach = angle_reach(net.spacing, found.shortest, other.sqrt());
            if found.torn || found.count == 0.0 || reach < MIN_ANGLE_RADIUS_LENGTHS * net.spacing {
                return None;
            }
            Some(Junction {
                number,
                place,
                angle: around.angle(place, reach)?,
                reach,
                cuts: found.cuts,
            })
        });
        Ok(Junctions {
            all: all.collect(),
            of,
        })
    }

    /// Lists the points where cuts or folds meet at the corners of a sheet, with their positions on the sheet.
    pub(super) fn corners(
        &self,
        net: &SeamGraph,
        layout: &Layout,
        patches: &[u32],
    ) -> Vec<(Point, Junction)> {
        let corners = layout.outlines(net, patches).into_iter().flatten();
        corners
            .filter_map(|corner| Some((corner.place, self.at(corner.node)?)))
            .collect()
    }
}

/// Data of a point where seams end, gathered before its angle is measured.
#[derive(Clone)]
struct PointSeams {
    cuts: usize,
    torn: bool,
    shortest: f64,
    /// Sum of the positions of the graph's nodes that belong to the point. `count` is the number of these nodes.
    sum: [f64; 3],
    count: f64,
}

impl Default for PointSeams {
    fn default() -> Self {
        PointSeams {
            cuts: 0,
            torn: false,
            shortest: f64::INFINITY,
            sum: [0.0; 3],
            count: 0.0,
        }
    }
}

/// The surface around a point where seams end, with its patches and the creases between them.
struct AngleSurface<'a> {
    surface: &'a Heightfield,
    labels: &'a Labels,
    net: &'a SeamGraph,
}

/// A path along the surface that is straight as seen from above: its length and its end.
struct RadialPath {
    long: f64,
    place: [f64; 3],
    /// Length of the path's first half, and the position where that half ends.
    half: (f64, [f64; 3]),
}

fn squared(p: [f64; 3], q: [f64; 3]) -> f64 {
    (0..3).map(|k| (p[k] - q[k]).powi(2)).sum()
}

impl AngleSurface<'_> {
    /// Computes the angle of the surface around a point, in radians, measured between two rings around it, of `reach`
    /// and half of it: from the lengths along both rings and between them. It is exact for cones, and so where flat
    /// faces meet, and hardly depends on heights near the point, where the lattice smooths the surface. `None` if a
    /// ring leaves the surface.
    fn angle(&self, place: [f64; 3], reach: f64) -> Option<f64> {
        let first = self.ring(place, 0.5 * reach)?;
        let mean = first.iter().map(|path| path.long).sum::<f64>() / RING_DIRECTIONS as f64;
        // Radius in plan at which the distance along the surface is `reach`.
        let radius = 0.5 * reach * reach / mean;
        let ring = self.ring(place, radius)?;
        let next = ring.iter().cycle().skip(1);
        let angles = ring.iter().zip(next).map(|(one, other)| {
            let (a, b) = (one.long - one.half.0, other.long - other.half.0);
            let along = squared(one.place, other.place).sqrt();
            let square = (along - squared(one.half.1, other.half.1).sqrt()).powi(2);
            // Angle of a triangle from its sides by the half-angle sine; for small angles the law of cosines would
            // lose half of the digits.
            let sine = ((square - (a - b).powi(2)) / (4.0 * a * b)).max(0.0).sqrt();
            2.0 * sine.min(1.0).asin()
        });
        Some(angles.sum())
    }

    /// Computes paths along the surface, straight as seen from above, from a centre to points of a ring with a given
    /// radius in plan, in evenly spaced directions. `None` if one leaves the surface.
    fn ring(&self, place: [f64; 3], radius: f64) -> Option<Vec<RadialPath>> {
        let path = |k: usize| {
            let turn = k as f64 / RING_DIRECTIONS as f64;
            let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
            let mut path = RadialPath {
                long: 0.0,
                place,
                half: (0.0, place),
            };
            for step in 1..=RADIAL_STEPS {
                let away = radius * step as f64 / RADIAL_STEPS as f64;
                let [x, y] = [place[0] + away * cos, place[1] + away * sin];
                let z = self.height([x, y])?;
                path.long += squared([x, y, z], path.place).sqrt();
                path.place = [x, y, z];
                if 2 * step == RADIAL_STEPS {
                    path.half = (path.long, path.place);
                }
            }
            Some(path)
        };
        (0..RING_DIRECTIONS).map(path).collect()
    }

    /// Computes the height of the surface at a point. In a triangle in which two patches meet, both are extrapolated to their
    /// crease.
    fn height(&self, place: [f64; 2]) -> Option<f64> {
        let lattice: &Lattice = self.surface.lattice();
        let found = lattice.locate(place);
        let mut corners = [([0; 2], 0); 3];
        for (corner, (row, col)) in corners.iter_mut().zip(found.vertices) {
            if !lattice.contains(row, col) {
                return None;
            }
            let (row, col) = (row as usize, col as usize);
            *corner = ([row, col], self.labels.of[lattice.index(row, col)]);
        }
        let flat_patch = |patch: u32| self.net.flat_patches.get(patch as usize)?.as_ref();
        let of = |vertex: [usize; 2], patch: u32| Some(flat_patch(patch)?.height(vertex));
        let sum = |heights: [Option<f64>; 3]| {
            let terms = heights.into_iter().zip(found.weights);
            terms.map(|(z, w)| Some(z? * w)).sum::<Option<f64>>()
        };
        let own = corners.map(|(vertex, patch)| of(vertex, patch));
        let first = corners[0].1;
        let other = corners
            .iter()
            .map(|(_, patch)| *patch)
            .find(|p| *p != first);
        let height = match other {
            None => sum(own)?,
            Some(other) if corners.iter().all(|(_, p)| [first, other].contains(p)) => {
                let sides = [first, other].map(|patch| corners.map(|(v, _)| of(v, patch)));
                let [one, two] = [sum(sides[0])?, sum(sides[1])?];
                // At a ridge both patches, extrapolated, lie above the other patch's vertices.
                let beyond = |k: usize| Some(sides[0][k]? + sides[1][k]? - 2.0 * own[k]?);
                let ridge = (0..3).map(beyond).sum::<Option<f64>>()? > 0.0;
                if ridge { one.min(two) } else { one.max(two) }
            }
            Some(_) => sum(own)?,
        };
        height.is_finite().then_some(height)
    }
}
