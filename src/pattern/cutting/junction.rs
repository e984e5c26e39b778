//! Points inside of a mesh where cuts or folds end, and the angle of the mesh around them.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use super::body::Body;
use super::join::Joined;
use super::seams::{Seam, Seams};
use crate::pattern::Junction;

/// Maximum radius around a point within which the surface's angle is measured, in edge lengths of the mesh.
/// `benches/patterns.md` has what others give.
const MAX_ANGLE_RADIUS_LENGTHS: f64 = 20.0;

/// Maximum radius around a point within which the surface's angle is measured, as a share of the shortest seam that
/// ends there and of the distance to the nearest cut that does not. `benches/patterns.md` has what others give.
const ANGLE_RADIUS_SHARE: f64 = 0.8;

/// Minimum radius around a point at which the surface's angle is measured, in edge lengths of the mesh; nearer to the point the sampling smooths the surface.
/// `benches/patterns.md` has what others give.
const MIN_ANGLE_RADIUS_LENGTHS: f64 = 6.0;

/// Radius around a point within which the surface's angle is measured, from the length of the shortest seam that ends there
/// and the distance to the nearest cut that does not: what the surface bends beside another cut is taken up by that cut.
fn angle_reach(spacing: f64, shortest: f64, other: f64) -> f64 {
    (MAX_ANGLE_RADIUS_LENGTHS * spacing).min(ANGLE_RADIUS_SHARE * shortest.min(other))
}

/// The points of a mesh where cuts or folds end or meet, with the number of the vertex there as the key.
pub(super) struct Junctions {
    of: BTreeMap<u32, Junction>,
}

/// Data of a vertex where seams end, gathered before its angle is measured.
#[derive(Clone)]
struct PointSeams {
    /// Number of cuts that end at the vertex. `edges` is the number of the vertex's edges that are cut.
    cuts: usize,
    edges: usize,
    shortest: f64,
    /// Number of edges of the seam with the most edges that ends at the vertex.
    most: usize,
}

impl Junctions {
    /// Returns the point where cuts or folds meet at a vertex; `None` if the border is near, or if a seam that ends there
    /// is too short or another cut too near to measure an angle.
    pub(super) fn at(&self, vertex: u32) -> Option<Junction> {
        self.of.get(&vertex).copied()
    }

    pub(super) fn new(body: &Body, seams: &Seams, sheets: &[Joined]) -> Junctions {
        let mut whole = vec![false; seams.all.len()];
        for seam in sheets.iter().flat_map(|sheet| &sheet.whole) {
            whole[*seam] = true;
        }
        let mut all: BTreeMap<u32, PointSeams> = BTreeMap::new();
        for (seam, _) in lines(seams, &whole) {
            for end in ends(&seam.vertices) {
                let blank = PointSeams {
                    cuts: 0,
                    edges: 0,
                    shortest: f64::INFINITY,
                    most: 0,
                };
                all.entry(end).or_insert(blank);
            }
        }
        for (seam, cut) in lines(seams, &whole) {
            for end in ends(&seam.vertices) {
                if let Some(found) = all.get_mut(&end) {
                    found.cuts += usize::from(cut);
                    found.shortest = found.shortest.min(seam.length);
                    found.most = found.most.max(seam.sides.len());
                }
            }
            for vertex in seam.vertices.windows(2).flatten().filter(|_| cut) {
                if let Some(found) = all.get_mut(vertex) {
                    found.edges += 1;
                }
            }
        }
        // The vertices of all cuts, each with the ends of its cut.
        let cut_vertices: Vec<(u32, Vec<u32>)> = lines(seams, &whole)
            .filter(|(_, cut)| *cut)
            .flat_map(|(seam, _)| seam.vertices.iter().map(|v| (*v, ends(&seam.vertices))))
            .collect();
        let around = AngleDefects::new(body);
        let junction = |(vertex, found): (u32, PointSeams)| {
            let others = cut_vertices
                .iter()
                .filter(|(_, ends)| !ends.contains(&vertex));
            let place = body.places[vertex as usize];
            let other = others
                .map(|(other, _)| (body.places[*other as usize] - place).norm())
                .fold(f64::INFINITY, f64::min);
            let reach = angle_reach(body.spacing, found.shortest, other);
            let short = found.most > 1 && reach < MIN_ANGLE_RADIUS_LENGTHS * body.spacing;
            // A cut that passes through the vertex without an end divides the surface around it, so no angle is
            // measured.
            if short || found.edges != found.cuts {
                return None;
            }
            let junction = Junction {
                number: vertex as usize,
                place: body.places[vertex as usize].into(),
                angle: around.angle(vertex, reach)?,
                reach,
                cuts: found.cuts,
            };
            Some((vertex, junction))
        };
        Junctions {
            of: all.into_iter().filter_map(junction).collect(),
        }
    }
}

/// Iterates over the seams that are cut or folded: yields each seam with a flag that is true if it is cut.
fn lines<'a>(seams: &'a Seams, whole: &'a [bool]) -> impl Iterator<Item = (&'a Seam, bool)> {
    let all = seams.all.iter().zip(whole);
    all.filter(|(seam, whole)| !(**whole && seam.smooth))
        .map(|(seam, whole)| (seam, !whole))
}

/// Lists the vertices where a seam's line ends; none for a closed line.
fn ends(vertices: &[u32]) -> Vec<u32> {
    let (first, last) = (vertices[0], vertices[vertices.len() - 1]);
    match first == last {
        true => Vec::new(),
        false => vec![first, last],
    }
}

/// Angle defects and neighbours of all vertices of a mesh, for measuring angles around points.
struct AngleDefects<'a> {
    body: &'a Body,
    /// Angle defect of each vertex: a full turn less the angles around it; NaN at the border.
    missing: Vec<f64>,
    /// Numbers of the neighbours of all vertices, vertex by vertex; `starts` holds the position of each vertex's first
    /// neighbour in this list.
    neighbours: Vec<u32>,
    starts: Vec<usize>,
}

impl AngleDefects<'_> {
    fn new(body: &Body) -> AngleDefects<'_> {
        let count = body.places.len();
        let mut missing = body.angle_defects();
        // An interior edge occurs in both directions.
        let mut edges = Vec::with_capacity(3 * body.triangles.len());
        for corners in &body.triangles {
            edges.extend((0..3).map(|k| (corners[k], corners[(k + 1) % 3])));
        }
        edges.sort_unstable();
        let mut starts = vec![0; count + 1];
        for (a, b) in &edges {
            starts[*a as usize + 1] += 1;
            if edges.binary_search(&(*b, *a)).is_err() {
                missing[*a as usize] = f64::NAN;
                missing[*b as usize] = f64::NAN;
            }
        }
        for k in 0..count {
            starts[k + 1] += starts[k];
        }
        AngleDefects {
            body,
            missing,
            neighbours: edges.into_iter().map(|(_, b)| b).collect(),
            starts,
        }
    }

    /// Computes the angle of the surface around a vertex, in radians: 2π less the sum of the angle defects within a
    /// circle, averaged over radii from half of `reach` to `reach`. It is exact where flat faces meet. `None` if the
    /// border is within `reach`.
    fn angle(&self, vertex: u32, reach: f64) -> Option<f64> {
        let middle = self.body.places[vertex as usize];
        let mut seen = BTreeSet::from([vertex]);
        let mut open = vec![vertex];
        let mut angle = TAU;
        while let Some(one) = open.pop() {
            let far = (self.body.places[one as usize] - middle).norm() / reach;
            if far > 1.0 {
                continue;
            }
            let missing = self.missing[one as usize];
            if missing.is_nan() {
                return None;
            }
            angle -= missing * (2.0 * (1.0 - far)).min(1.0);
            let own = self.starts[one as usize]..self.starts[one as usize + 1];
            for next in &self.neighbours[own] {
                if seen.insert(*next) {
                    open.push(*next);
                }
            }
        }
        Some(angle)
    }
}
