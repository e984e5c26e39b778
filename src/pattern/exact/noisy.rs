//! Polyhedra with noise, as scans of buildings and boxes are: their planes, and the exact faces that these make.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use super::FoundFaces;
use super::planes::{MAX_DEVIATION_SIGMAS, NoisyPlanes};
use super::straight::{Straight, straight_parts};
use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::math::planar::{Point2, polygon_area};
use crate::math::polygon::triangulate;
use crate::math::union_find::UnionFind;
use crate::scene::half_edges::{half_edge_ends, outlines, twin_half_edges};
use crate::scene::mesh::Mesh;
use crate::scene::polyhedron::{KnownFaces, Place, Polyhedron};

/// Length, in standard deviations of the noise, up to which the ends of an edge are one corner. `benches/patterns.md` has what
/// others give.
const MIN_EDGE_SIGMAS: f64 = 10.0;

/// Maximum difference of the area of each face from that of the mesh on its plane, as a share, and of all from all.
/// `benches/patterns.md` has what others give.
const MAX_AREA_DIFFERENCE: f64 = 0.05;

/// Maximum share of the area that bridges of the border have: more are faces of their own, such as the risers of steps.
/// `benches/patterns.md` has what others give.
const MAX_BRIDGE_SHARE: f64 = 0.01;

/// Minimum number of edges of a border whose ends do not count for its straight parts. `benches/patterns.md` has what others give.
const MIN_BORDER_EDGES: usize = 4;

/// Recognises a polyhedron with noise, and finds its faces: planes that explain all vertices as nearly as neighbouring vertices
/// explain each other. `None` for a mesh without noise, or with other shapes. Faces meet where their planes do. More than three
/// planes have no common point in general: there the faces are flat but for a part of the noise.
///
/// Costs `O(vertices · log(vertices))`, and for faces with `n` corners `O(n²)`.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn noisy_faces(mesh: &Mesh) -> Result<Option<FoundFaces>> {
    let Ok(mut solid) = Polyhedron::new(mesh) else {
        return Ok(None);
    };
    // Coordinates of maps lose digits in squares.
    let middle = solid.places.iter().sum::<Place>() / solid.places.len() as f64;
    solid.places.iter_mut().for_each(|place| *place -= middle);
    let Some(found) = NoisyPlanes::find(&solid) else {
        return Ok(None);
    };
    let Some(mut divided) = Divided::new(&solid, &found)? else {
        return Ok(None);
    };
    let Some(faces) = divided.faces()? else {
        return Ok(None);
    };
    let places = divided.places.iter().map(|place| place + middle);
    Ok(Some(FoundFaces {
        count: found.planes.len(),
        noise: found.noise,
        solid: Polyhedron::from_faces(places.collect(), faces, found.noise),
    }))
}

/// A mesh whose triangles are divided where the plane changes, so that each has one.
struct Divided<'a> {
    found: &'a NoisyPlanes,
    places: Vec<Place>,
    triangles: Vec<[u32; 3]>,
    labels: Vec<u32>,
    twins: Vec<u32>,
}

impl<'a> Divided<'a> {
    fn new(solid: &Polyhedron, found: &'a NoisyPlanes) -> Result<Option<Divided<'a>>> {
        let mut places = solid.places.clone();
        let mut between: FxHashMap<[u32; 2], u32> = FxHashMap::default();
        let (mut triangles, mut labels) = (Vec::new(), Vec::new());
        let Some(kept) = without_bridges(solid, found) else {
            return Ok(None);
        };
        for corners in kept {
            let own = corners.map(|v| found.labels[v as usize]);
            // Begins with the corner that differs from both others, if there is one.
            let first = (0..3)
                .find(|k| own[(k + 1) % 3] == own[(k + 2) % 3])
                .unwrap_or(0);
            let [a, b, c] = [0, 1, 2].map(|k| corners[(first + k) % 3]);
            let [i, j, k] = [0, 1, 2].map(|k| own[(first + k) % 3]);
            let mut add = |t: [u32; 3], label: u32| {
                triangles.push(t);
                labels.push(label);
            };
            if i == j && j == k {
                add([a, b, c], i);
                continue;
            }
            let mut middle = |v: u32, w: u32| {
                *between.entry([v.min(w), v.max(w)]).or_insert_with(|| {
                    let number = places.len() as u32;
                    let ends = [v, w].map(|v| (places[v as usize], found.labels[v as usize]));
                    places.push(crossing(ends, found));
                    number
                })
            };
            let (p, q) = (middle(a, b), middle(c, a));
            if j == k {
                add([a, p, q], i);
                add([p, b, c], j);
                add([p, c, q], j);
                continue;
            }
            let r = middle(b, c);
            let centre = places.len() as u32;
            places.push([a, b, c].iter().map(|v| places[*v as usize]).sum::<Place>() / 3.0);
            for (label, corner, before, after) in [(i, a, q, p), (j, b, p, r), (k, c, r, q)] {
                add([before, corner, after], label);
                add([before, after, centre], label);
            }
        }
        let twins = twin_half_edges(&triangles);
        let goes_back = |(side, twin): (u32, &u32)| {
            *twin == NO_INDEX
                || half_edge_ends(&triangles, side)[0] == half_edge_ends(&triangles, *twin)[1]
        };
        let is_surface = (0u32..).zip(&twins).all(goes_back);
        Ok(is_surface.then_some(Divided {
            found,
            places,
            triangles,
            labels,
            twins,
        }))
    }

    fn label(&self, side: u32) -> u32 {
        self.labels[side as usize / 3]
    }

    /// The plane on the other side of a half-edge; [`NO_INDEX`] on the border.
    fn beyond(&self, side: u32) -> u32 {
        match self.twins[side as usize] {
            NO_INDEX => NO_INDEX,
            twin => self.label(twin),
        }
    }

    fn start(&self, side: u32) -> u32 {
        half_edge_ends(&self.triangles, side)[0]
    }

    fn end(&self, side: u32) -> u32 {
        half_edge_ends(&self.triangles, side)[1]
    }

    /// Triangles of the faces, whose corners are moved to where planes meet; `None` if the faces are no polygons.
    fn faces(&mut self) -> Result<Option<KnownFaces>> {
        // The closed lines around the regions.
        let is_cut = |side: u32| self.beyond(side) != self.label(side);
        let mut loops = outlines(&self.twins, 0..self.twins.len() as u32, is_cut);
        // Corners are where what is beyond changes; a line begins with one.
        for line in &mut loops {
            let n = line.len();
            let is_corner = |i: usize| self.beyond(line[i]) != self.beyond(line[(i + n - 1) % n]);
            match (0..n).find(|i| is_corner(*i)) {
                Some(corner) => line.rotate_left(corner),
                // Two planes do not meet along a closed line.
                None if self.beyond(line[0]) != NO_INDEX => return Ok(None),
                None => {
                    // A point farthest from all others' mean is a corner, if there is any.
                    let place = |side: &u32| self.places[self.start(*side) as usize];
                    let mean = line.iter().map(place).sum::<Place>() / n as f64;
                    let away = |i: &usize| (place(&line[*i]) - mean).norm();
                    let corner = (0..n).max_by(|a, b| away(a).total_cmp(&away(b)));
                    line.rotate_left(corner.unwrap_or(0));
                }
            }
        }
        // Planes at each vertex of a line.
        let mut planes: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
        for side in loops.iter().flatten() {
            for v in half_edge_ends(&self.triangles, *side) {
                planes.entry(v).or_default().insert(self.label(*side));
            }
        }
        let edges: Vec<[u32; 2]> = (loops.iter())
            .flat_map(|line| {
                let edges = line.chunk_by(|a, b| self.beyond(*a) == self.beyond(*b));
                edges.filter(|edge| self.beyond(edge[0]) != NO_INDEX)
            })
            .map(|edge| [self.start(edge[0]), self.end(edge[edge.len() - 1])])
            .collect();
        let given = self.places.clone();
        for (v, own) in &planes {
            self.places[*v as usize] = self.found.corner(given[*v as usize], own);
        }
        let mut joined = UnionFind::new("corners", self.places.len())?;
        for [a, b] in edges {
            let long = (self.places[a as usize] - self.places[b as usize]).norm();
            if long <= MIN_EDGE_SIGMAS * self.found.noise {
                joined.union(a, b);
            }
        }
        let mut groups: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for v in planes.keys() {
            groups.entry(joined.find(*v)).or_default().push(*v);
        }
        for (root, members) in groups.iter().filter(|(_, members)| members.len() > 1) {
            let own: BTreeSet<u32> = members.iter().flat_map(|v| &planes[v]).copied().collect();
            let mean = members
                .iter()
                .map(|v| self.places[*v as usize])
                .sum::<Place>()
                / members.len() as f64;
            self.places[*root as usize] = self.found.corner(mean, &own);
            planes.insert(*root, own);
        }
        // Where a straight border meets a crease or another one, as all their points tell.
        let mut meetings: BTreeMap<u32, Vec<Place>> = BTreeMap::new();
        let mut lines: Vec<Vec<Vec<u32>>> = vec![Vec::new(); self.found.planes.len()];
        for line in &loops {
            let mut polygon = Vec::new();
            for edge in line.chunk_by(|a, b| self.beyond(*a) == self.beyond(*b)) {
                let mut vertices: Vec<u32> = edge
                    .iter()
                    .map(|side| joined.find(self.start(*side)))
                    .collect();
                if self.beyond(edge[0]) != NO_INDEX {
                    polygon.push(vertices[0]);
                    continue;
                }
                vertices.push(joined.find(self.end(edge[edge.len() - 1])));
                polygon.extend(self.border(&vertices, &planes, &mut meetings));
            }
            polygon.dedup();
            while polygon.len() > 1 && polygon[0] == polygon[polygon.len() - 1] {
                polygon.pop();
            }
            if polygon.len() > 2 {
                lines[self.label(line[0]) as usize].push(polygon);
            }
        }
        for (v, found) in meetings.iter().filter(|(_, found)| !found.is_empty()) {
            let mean = found.iter().sum::<Place>() / found.len() as f64;
            self.places[*v as usize] = self.found.corner(mean, &planes[v]);
        }
        Ok(self.fill(&lines, &given))
    }

    /// Vertices at which a border turns, from the first to the one before the last, and where its straight parts meet each other or
    /// the creases at its ends.
    fn border(
        &self,
        vertices: &[u32],
        planes: &BTreeMap<u32, BTreeSet<u32>>,
        meetings: &mut BTreeMap<u32, Vec<Place>>,
    ) -> Vec<u32> {
        let points: Vec<Place> = vertices.iter().map(|v| self.places[*v as usize]).collect();
        let last = points.len() - 1;
        let is_closed = vertices[0] == vertices[last];
        // The ends lie where an edge of the mesh crosses a crease, and that cuts the corner off.
        let first = usize::from(!is_closed && last >= MIN_BORDER_EDGES);
        let inner = &points[first..=last - first];
        let parts = straight_parts(inner, MAX_DEVIATION_SIGMAS * self.found.noise);
        let longest = points
            .windows(2)
            .map(|p| (p[1] - p[0]).norm())
            .fold(0.0, f64::max);
        let mut meet = |k: usize, one: &Straight, other: &Straight| {
            // Lines that run nearly the same way meet far away.
            let found = Some(one.meet(other)).filter(|p| (p - points[k]).norm() <= longest);
            meetings.entry(vertices[k]).or_default().extend(found);
        };
        for pair in parts.windows(2) {
            meet(first + pair[1].ends[0], &pair[0], &pair[1]);
        }
        for (end, part) in [(0, &parts[0]), (last, &parts[parts.len() - 1])] {
            let normals = planes[&vertices[end]]
                .iter()
                .map(|k| self.found.planes[*k as usize].normal);
            if is_closed {
                meet(0, &parts[parts.len() - 1], &parts[0]);
            } else if let [m, n] = normals.collect::<Vec<_>>()[..] {
                meet(end, part, &Straight::new([0; 2], points[end], m.cross(&n)));
            }
        }
        let turns = parts
            .iter()
            .skip(1)
            .map(|part| vertices[first + part.ends[0]]);
        [vertices[0]].into_iter().chain(turns).collect()
    }

    /// Triangles of polygons with holes, given by the lines around each plane's region; `None` if they do not cover what the
    /// mesh does.
    fn fill(&self, lines: &[Vec<Vec<u32>>], given: &[Place]) -> Option<KnownFaces> {
        let mut areas = vec![0.0; lines.len()];
        for (corners, label) in self.triangles.iter().zip(&self.labels) {
            let [a, b, c] = corners.map(|v| given[v as usize]);
            areas[*label as usize] += 0.5
                * (b - a)
                    .cross(&(c - a))
                    .dot(&self.found.planes[*label as usize].normal);
        }
        let mut faces = KnownFaces::default();
        let (mut all, mut difference) = (0.0, 0.0);
        for (((face, lines), plane), area) in
            (0u32..).zip(lines).zip(&self.found.planes).zip(&areas)
        {
            let [x, y] = plane.axes();
            let flat = |v: &u32| {
                let off = self.places[*v as usize] - plane.origin;
                // Seen from the side that the mesh faces.
                Point2::new(x.dot(&off), y.dot(&off) * area.signum())
            };
            let flat: Vec<Vec<Point2>> = (lines.iter())
                .map(|line| line.iter().map(flat).collect())
                .collect();
            let own: f64 = flat.iter().map(|line| polygon_area(line)).sum();
            // The border of a face is known but for the noise.
            let perimeter: f64 = (flat.iter())
                .flat_map(|line| (0..line.len()).map(|k| (line[k], line[(k + 1) % line.len()])))
                .map(|(a, b)| (b - a).norm())
                .sum();
            let off = (own - area.abs()).abs();
            if off
                > MAX_AREA_DIFFERENCE * area.abs()
                    + MAX_DEVIATION_SIGMAS * self.found.noise * perimeter
            {
                return None;
            }
            difference += off;
            all += area.abs();
            let (numbers, points) = (lines.concat(), flat.concat());
            for t in triangulate(flat)? {
                faces.push(t.map(|k| numbers[k]), face, t.map(|k| points[k]));
            }
            faces.normals.push(plane.normal * area.signum());
        }
        (difference <= MAX_AREA_DIFFERENCE * all).then_some(faces)
    }
}

/// Triangles without those of several planes along the border whose planes do not meet there: they only bridge vertices that are the
/// border, as the hull of scattered points does. `None` if they are more than that.
fn without_bridges(solid: &Polyhedron, found: &NoisyPlanes) -> Option<Vec<[u32; 3]>> {
    let mut is_left = vec![true; solid.triangles.len()];
    let mut open: Vec<usize> = (0..is_left.len()).collect();
    while let Some(t) = open.pop() {
        let own = solid.triangles[t].map(|v| found.labels[v as usize]);
        let meets = || {
            let corners = solid.corners(t);
            let middle = corners.iter().sum::<Place>() / 3.0;
            let corner = found.corner(middle, &own.into_iter().collect());
            let size = corners
                .iter()
                .map(|p| (p - middle).norm())
                .fold(0.0, f64::max);
            let limit = MAX_DEVIATION_SIGMAS * found.noise;
            (corner - middle).norm() <= size + limit
                && own
                    .iter()
                    .all(|k| found.planes[*k as usize].distance(&corner).abs() <= limit)
        };
        let is_bridge = |k: usize| {
            let twin = solid.twins[3 * t + k];
            let is_border = twin == NO_INDEX || !is_left[twin as usize / 3];
            is_border && !meets()
        };
        if is_left[t] && (own[0] != own[1] || own[1] != own[2]) && (0..3).any(is_bridge) {
            is_left[t] = false;
            let around = solid.twins[3 * t..3 * t + 3].iter();
            open.extend(
                around
                    .filter(|twin| **twin != NO_INDEX)
                    .map(|twin| *twin as usize / 3),
            );
        }
    }
    let area = |t: usize| {
        let [a, b, c] = solid.corners(t);
        (b - a).cross(&(c - a)).norm()
    };
    let all = 0..is_left.len();
    let bridges: f64 = all.clone().filter(|t| !is_left[*t]).map(area).sum();
    if bridges > MAX_BRIDGE_SHARE * all.map(area).sum::<f64>() {
        return None;
    }
    let left = solid.triangles.iter().zip(is_left);
    let left = left.filter(|(_, is_left)| *is_left).map(|(t, _)| *t);
    Some(left.collect())
}

/// The point of an edge between vertices of two planes that is nearest to both.
fn crossing([(from, a), (to, b)]: [(Place, u32); 2], found: &NoisyPlanes) -> Place {
    let (mut products, mut squares) = (0.0, 0.0);
    for plane in [a, b].map(|label| &found.planes[label as usize]) {
        let slope = plane.normal.dot(&(to - from));
        products -= slope * plane.distance(&from);
        squares += slope * slope;
    }
    let share = if squares > 0.0 {
        products / squares
    } else {
        0.5
    };
    from.lerp(&to, share.clamp(0.0, 1.0))
}
