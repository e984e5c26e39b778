//! Points inside of a mesh where cuts or folds end, and the angles of the mesh and of its sheets around them.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use super::body::Body;
use super::seams::Seams;
use crate::pattern::Junction;
use crate::unroll::flat_triangle::Point;

/// Maximum radius around a point within which angles are measured, in edge lengths of the mesh.
/// `benches/patterns.md` has what others give.
const MAX_ANGLE_RADIUS_LENGTHS: f64 = 20.0;

/// Maximum radius around a point within which angles are measured, as a share of the shortest seam that ends there.
/// `benches/patterns.md` has what others give.
const ANGLE_RADIUS_SHARE: f64 = 0.8;

/// Minimum radius around a point at which angles are measured, in edge lengths of the mesh; nearer to the point the sampling smooths
/// the surface. `benches/patterns.md` has what others give.
const MIN_ANGLE_RADIUS_LENGTHS: f64 = 6.0;

/// The seams that end at a vertex.
struct SeamEnds {
    shortest: f64,
    /// Number of edges of the seam with the most edges.
    most: usize,
    /// Lowest number of a seam that is cut.
    cut: Option<usize>,
}

/// Measures the points where cuts or folds end, by the numbers of their vertices; those near the border are left out, and those at
/// which a seam ends that is too short. `is_whole` tells which seams are joined, and `flat` has the positions of the corners of
/// triangles on their sheets.
pub(super) fn junctions(
    body: &Body,
    seams: &Seams,
    is_whole: &[bool],
    flat: &[[Point; 3]],
) -> BTreeMap<u32, Junction> {
    let mut all: BTreeMap<u32, SeamEnds> = BTreeMap::new();
    for (number, (seam, is_whole)) in seams.all.iter().zip(is_whole).enumerate() {
        let [first, last] = [0, seam.vertices.len() - 1].map(|k| seam.vertices[k]);
        if first == last || *is_whole && seam.smooth {
            continue;
        }
        for end in [first, last] {
            let found = all.entry(end).or_insert(SeamEnds {
                shortest: f64::INFINITY,
                most: 0,
                cut: None,
            });
            found.shortest = found.shortest.min(seam.length);
            found.most = found.most.max(seam.sides.len());
            found.cut = found.cut.or((!is_whole).then_some(number));
        }
    }
    let around = AngleDefects::new(body, flat);
    let junction = |(vertex, ends): (u32, SeamEnds)| {
        let longest = MAX_ANGLE_RADIUS_LENGTHS * body.spacing;
        let reach = longest.min(ANGLE_RADIUS_SHARE * ends.shortest);
        if ends.most > 1 && reach < MIN_ANGLE_RADIUS_LENGTHS * body.spacing {
            return None;
        }
        let [surface, flat] = around.angles(vertex, reach)?;
        let place = body.places[vertex as usize].into();
        let junction = Junction {
            place,
            crease: ends.cut,
            surface,
            flat,
        };
        Some((vertex, junction))
    };
    all.into_iter().filter_map(junction).collect()
}

/// Angle defects of all vertices of a mesh, in space and on its sheets, and their neighbours.
struct AngleDefects<'a> {
    body: &'a Body,
    /// Angle defects of each vertex, in space and on the sheets: a full turn less the angles around it; NaN at the border.
    defects: Vec<[f64; 2]>,
    /// Numbers of the neighbours of all vertices, vertex by vertex; `starts` holds the position of each vertex's first
    /// neighbour in this list.
    neighbours: Vec<u32>,
    starts: Vec<usize>,
}

impl AngleDefects<'_> {
    fn new<'a>(body: &'a Body, flat: &[[Point; 3]]) -> AngleDefects<'a> {
        let count = body.places.len();
        let in_space = body.angle_defects().into_iter();
        let mut defects: Vec<[f64; 2]> = in_space.map(|defect| [defect, TAU]).collect();
        // An interior edge occurs in both directions.
        let mut edges = Vec::with_capacity(3 * body.triangles.len());
        for (corners, places) in body.triangles.iter().zip(flat) {
            for k in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|i| places[(k + i) % 3]);
                defects[corners[k] as usize][1] -= ((b - a).conj() * (c - a)).arg();
                edges.push((corners[k], corners[(k + 1) % 3]));
            }
        }
        edges.sort_unstable();
        let mut starts = vec![0; count + 1];
        for (a, b) in &edges {
            starts[*a as usize + 1] += 1;
            if edges.binary_search(&(*b, *a)).is_err() {
                defects[*a as usize] = [f64::NAN; 2];
                defects[*b as usize] = [f64::NAN; 2];
            }
        }
        for k in 0..count {
            starts[k + 1] += starts[k];
        }
        AngleDefects {
            body,
            defects,
            neighbours: edges.into_iter().map(|(_, b)| b).collect(),
            starts,
        }
    }

    /// Computes the angles around a vertex, in radians, of the surface and of its flat pieces: 2π less the sum of the angle defects
    /// within a circle, averaged over radii from half of `reach` to `reach`. They are exact where flat faces meet. `None` if the
    /// border is within `reach`.
    fn angles(&self, vertex: u32, reach: f64) -> Option<[f64; 2]> {
        let middle = self.body.places[vertex as usize];
        let mut seen = BTreeSet::from([vertex]);
        let mut open = vec![vertex];
        let mut angles = [TAU; 2];
        while let Some(one) = open.pop() {
            let far = (self.body.places[one as usize] - middle).norm() / reach;
            if far > 1.0 {
                continue;
            }
            let defects = self.defects[one as usize];
            if defects[0].is_nan() {
                return None;
            }
            let share = (2.0 * (1.0 - far)).min(1.0);
            angles = [0, 1].map(|k| angles[k] - share * defects[k]);
            let own = self.starts[one as usize]..self.starts[one as usize + 1];
            for next in &self.neighbours[own] {
                if seen.insert(*next) {
                    open.push(*next);
                }
            }
        }
        Some(angles)
    }
}
