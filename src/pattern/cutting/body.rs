//! A mesh in parts that can be cut in two by planes.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

use crate::error::{Error, Result};
use crate::math::index::NO_INDEX;
use crate::math::symmetric_eigen::symmetric_eigen3;
use crate::math::union_find::UnionFind;
use crate::scene::half_edges::{half_edge_ends, twin_half_edges};
use rustc_hash::FxHashMap;

pub(super) type Place = Vector3<f64>;

/// Distance from a cutting plane, in mean edge lengths of the mesh, below which a vertex lies on the plane.
/// `benches/patterns.md` has what others give.
const PLANE_TOLERANCE_LENGTHS: f64 = 0.1;

/// A mesh whose triangles are grouped into parts: patches or pieces of them, each of which is to be laid flat on its
/// own.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub places: Vec<Place>,
    pub triangles: Vec<[u32; 3]>,
    /// Number of the patch that each triangle belongs to, while `parts` holds the number of each triangle's part.
    pub patches: Vec<u32>,
    pub parts: Vec<u32>,
    pub count: u32,
    /// Mean length of the mesh's edges, in the mesh's units.
    pub spacing: f64,
}

/// A plane in space along which a part of a mesh is cut: a point on it and its normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    pub through: Place,
    pub normal: Place,
}

impl Body {
    /// Creates a mesh in which each connected component of a patch is a part.
    pub(super) fn new(
        places: Vec<Place>,
        triangles: Vec<[u32; 3]>,
        patches: Vec<u32>,
    ) -> Result<Body> {
        let lengths = triangles.iter().flat_map(|t| {
            [(0, 1), (1, 2), (2, 0)]
                .map(|(i, k)| (places[t[i] as usize] - places[t[k] as usize]).norm())
        });
        let spacing = lengths.sum::<f64>() / (3 * triangles.len()) as f64;
        if !spacing.is_normal() {
            return Err(Error::mesh_size(spacing));
        }
        let mut body = Body {
            parts: vec![0; triangles.len()],
            places,
            triangles,
            patches,
            count: 0,
            spacing,
        };
        let all: Vec<u32> = (0..body.triangles.len() as u32).collect();
        let labels = body.patches.clone();
        body.part(&all, &labels)?;
        Ok(body)
    }

    pub(super) fn members(&self, part: u32) -> Vec<u32> {
        let all = self.parts.iter().zip(0..);
        all.filter(|(own, _)| **own == part)
            .map(|(_, t)| t)
            .collect()
    }

    /// Copies one part of the mesh to a mesh of its own, in which the part has the number 0.
    pub(super) fn alone(&self, members: &[u32]) -> Body {
        let mut numbers: FxHashMap<u32, u32> = FxHashMap::default();
        let mut places = Vec::new();
        let mut number = |v: u32| {
            *numbers.entry(v).or_insert_with(|| {
                places.push(self.places[v as usize]);
                places.len() as u32 - 1
            })
        };
        let triangles: Vec<[u32; 3]> = (members.iter())
            .map(|t| self.triangles[*t as usize].map(&mut number))
            .collect();
        Body {
            places,
            triangles,
            patches: members.iter().map(|t| self.patches[*t as usize]).collect(),
            parts: vec![0; members.len()],
            count: 1,
            spacing: self.spacing,
        }
    }

    /// Divides triangles of a part into connected components of equal labels. The first component keeps the part's
    /// number. Returns the part numbers of all components.
    fn part(&mut self, members: &[u32], labels: &[u32]) -> Result<Vec<u32>> {
        let own: Vec<[u32; 3]> = (members.iter())
            .map(|t| self.triangles[*t as usize])
            .collect();
        let label = |side: usize| labels[members[side / 3] as usize];
        let mut sets = UnionFind::new("pattern", own.len())?;
        for (side, twin) in twin_half_edges(&own).into_iter().enumerate() {
            if twin != NO_INDEX && label(side) == label(twin as usize) {
                sets.union(side as u32 / 3, twin / 3);
            }
        }
        let mut numbers: BTreeMap<u32, u32> = BTreeMap::new();
        let before = self.parts[members[0] as usize];
        for (own, t) in (0..).zip(members) {
            let root = sets.find(own);
            let number = match numbers.get(&root) {
                Some(number) => *number,
                None if numbers.is_empty() && self.count > 0 => before,
                None => {
                    self.count += 1;
                    self.count - 1
                }
            };
            numbers.insert(root, number);
            self.parts[*t as usize] = number;
        }
        Ok(numbers.into_values().collect())
    }

    /// Creates candidate planes for cutting a part in two: for each principal axis of the part two planes normal to it,
    /// one through the part's centroid and one through a given point.
    pub(super) fn planes(&self, members: &[u32], place: Place) -> Vec<Plane> {
        let corners = |t: &u32| self.triangles[*t as usize].map(|v| self.places[v as usize]);
        let (mut sum, mut weight) = (Place::zeros(), 0.0);
        for t in members {
            let [a, b, c] = corners(t);
            let area = (b - a).cross(&(c - a)).norm();
            sum += (a + b + c) * (area / 3.0);
            weight += area;
        }
        let middle = sum / weight;
        let mut spread = Matrix3::zeros();
        for t in members {
            let [a, b, c] = corners(t);
            let area = (b - a).cross(&(c - a)).norm();
            let off = (a + b + c) / 3.0 - middle;
            spread += off * off.transpose() * area;
        }
        let axes = symmetric_eigen3(spread);
        let through = [middle, place].into_iter();
        through
            .flat_map(|through| axes.map(|(_, normal)| Plane { through, normal }))
            .collect()
    }

    /// Cuts a part of the mesh along a plane. Returns the part numbers of the pieces; a single number if the plane does
    /// not meet the part.
    pub(super) fn cut(&mut self, part: u32, plane: &Plane) -> Result<Vec<u32>> {
        let members = self.members(part);
        let mut heights: FxHashMap<u32, f64> = FxHashMap::default();
        for t in &members {
            for v in self.triangles[*t as usize] {
                let height = plane.normal.dot(&(self.places[v as usize] - plane.through));
                let on = height.abs() < PLANE_TOLERANCE_LENGTHS * self.spacing;
                heights.insert(v, if on { 0.0 } else { height });
            }
        }
        // New vertices on the edges that cross.
        let mut middles: FxHashMap<(u32, u32), u32> = FxHashMap::default();
        for t in &members {
            let corners = self.triangles[*t as usize];
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let (a, b) = (a.min(b), a.max(b));
                let (from, to) = (heights[&a], heights[&b]);
                if from * to < 0.0 && !middles.contains_key(&(a, b)) {
                    let share = from / (from - to);
                    let place = self.places[a as usize].lerp(&self.places[b as usize], share);
                    let number = self.places.len() as u32;
                    middles.insert((a, b), number);
                    heights.insert(number, 0.0);
                    self.places.push(place);
                }
            }
        }
        for t in 0..self.triangles.len() {
            self.divide(t, &middles);
        }
        let members = self.members(part);
        let mut labels = vec![0; self.triangles.len()];
        for t in &members {
            let sum: f64 = self.triangles[*t as usize].iter().map(|v| heights[v]).sum();
            labels[*t as usize] = u32::from(sum > 0.0);
        }
        self.part(&members, &labels)
    }

    /// Length of the border of some triangles.
    pub(super) fn perimeter(&self, members: &[u32]) -> f64 {
        let own: Vec<[u32; 3]> = members
            .iter()
            .map(|t| self.triangles[*t as usize])
            .collect();
        let twins = twin_half_edges(&own);
        let border = (0u32..).zip(&twins).filter(|(_, twin)| **twin == NO_INDEX);
        let lengths = border.map(|(side, _)| {
            let [a, b] = half_edge_ends(&own, side).map(|v| self.places[v as usize]);
            (b - a).norm()
        });
        lengths.sum()
    }

    /// Middle of a triangle.
    pub(super) fn middle(&self, triangle: u32) -> Place {
        let corners = self.triangles[triangle as usize];
        corners
            .map(|v| self.places[v as usize])
            .iter()
            .sum::<Place>()
            / 3.0
    }

    /// Divides a triangle into smaller ones at the new vertices on its edges.
    fn divide(&mut self, t: usize, middles: &FxHashMap<(u32, u32), u32>) {
        let corners = self.triangles[t];
        let mut ring: Vec<u32> = Vec::with_capacity(6);
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            ring.push(a);
            ring.extend(middles.get(&(a.min(b), a.max(b))));
        }
        // Corners that are cut off by new vertices on both sides, or halves.
        while ring.len() > 3 {
            let n = ring.len();
            let is_new = |k: usize| !corners.contains(&ring[k % n]);
            let ear = (0..n)
                .find(|k| !is_new(*k) && is_new(k + 1) && is_new(k + n - 1))
                .or_else(|| (0..n).find(|k| !is_new(*k) && is_new(k + 1)))
                .unwrap_or(0);
            let triangle = [ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]];
            self.triangles.push(triangle);
            self.patches.push(self.patches[t]);
            self.parts.push(self.parts[t]);
            ring.remove(ear);
        }
        self.triangles[t] = [ring[0], ring[1], ring[2]];
    }
}

/// Maximum angle defect of a vertex, in radians, at which the surface around it counts as developable.
/// `benches/patterns.md` has what others give.
const MAX_ANGLE_DEFECT: f64 = 0.3;

impl Body {
    /// Returns for each vertex whether its angle defect is above [`MAX_ANGLE_DEFECT`] in magnitude, as at a tip or a saddle. Seams end there, because two sides that meet there
    /// do not both fit.
    pub(super) fn pointed(&self) -> Vec<bool> {
        let defects = self.angle_defects().into_iter();
        defects.map(|d| d.abs() > MAX_ANGLE_DEFECT).collect()
    }

    /// Angle defect of each vertex: a full turn less the angles of the triangles around it, in radians.
    pub(super) fn angle_defects(&self) -> Vec<f64> {
        let mut defects = vec![TAU; self.places.len()];
        for corners in &self.triangles {
            for k in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|i| self.places[corners[(k + i) % 3] as usize]);
                defects[corners[k] as usize] -= (b - a).angle(&(c - a));
            }
        }
        defects
    }

    /// Area of each part.
    pub(super) fn areas(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.count as usize];
        for (part, corners) in self.parts.iter().zip(&self.triangles) {
            let [a, b, c] = corners.map(|v| self.places[v as usize]);
            areas[*part as usize] += 0.5 * (b - a).cross(&(c - a)).norm();
        }
        areas
    }

    /// Number of vertices without a triangle.
    pub(super) fn unused_vertices(&self) -> usize {
        let mut is_used = vec![false; self.places.len()];
        (self.triangles.as_flattened().iter()).for_each(|v| is_used[*v as usize] = true);
        is_used.iter().filter(|used| !**used).count()
    }

    /// Removes the triangles of some parts. Returns the new number of each triangle.
    pub(super) fn remove(&mut self, parts: &[u32]) -> Vec<u32> {
        let is_kept: Vec<bool> = self.parts.iter().map(|p| !parts.contains(p)).collect();
        let mut next = 0;
        let moved = is_kept.iter().map(|kept| {
            next += u32::from(*kept);
            next.saturating_sub(1)
        });
        let moved = moved.collect();
        let mut kept = is_kept.iter();
        self.triangles.retain(|_| kept.next() == Some(&true));
        let mut kept = is_kept.iter();
        self.patches.retain(|_| kept.next() == Some(&true));
        let mut kept = is_kept.iter();
        self.parts.retain(|_| kept.next() == Some(&true));
        moved
    }

    /// Renumbers the parts of the mesh by their areas, the largest first. Returns the new number of each part.
    pub(super) fn sort(&mut self) -> Vec<u32> {
        let areas = self.areas();
        let mut order: Vec<usize> = (0..areas.len()).collect();
        order.sort_by(|a, b| areas[*b].total_cmp(&areas[*a]));
        let mut numbers = vec![0; areas.len()];
        for (number, part) in (0..).zip(order) {
            numbers[part] = number;
        }
        self.parts
            .iter_mut()
            .for_each(|part| *part = numbers[*part as usize]);
        numbers
    }
}
