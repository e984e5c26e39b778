//! Heights of patches beyond their borders, and the nodes of creases: where the continuations of patches meet.

use nalgebra::Vector2;
use rustc_hash::FxHashMap;
use std::cell::RefCell;

use super::border::BorderLines;
use crate::heights::heightfield::Heightfield;
use crate::math::index::NO_INDEX;
use crate::math::least_squares::LeastSquares;
use crate::scene::triangulation::Triangulation;
use crate::shape::patches::NO_PATCH;
use crate::shape::patches::crease::CreaseNode;
use crate::shape::patches::extrapolate::extrapolated_height;

/// A surface on its lattice, with the patches of its vertices and the line along its border.
pub(super) struct Nodes<'a> {
    surface: &'a Heightfield,
    pub lattice: &'a Triangulation,
    labels: &'a [u32],
    border: &'a BorderLines,
    /// Extrapolated height of a patch at a vertex of another one.
    continued: RefCell<FxHashMap<(u32, u32), f64>>,
}

impl<'a> Nodes<'a> {
    pub(super) fn new(
        surface: &'a Heightfield,
        lattice: &'a Triangulation,
        labels: &'a [u32],
        border: &'a BorderLines,
    ) -> Self {
        Nodes {
            surface,
            lattice,
            labels,
            border,
            continued: RefCell::default(),
        }
    }

    /// Number of the patch of a vertex of the lattice's mesh.
    pub(super) fn label(&self, vertex: u32) -> u32 {
        self.labels[self.lattice.vertices()[vertex as usize] as usize]
    }

    /// Position of a node of a crease seen from above, and the height of each given patch there.
    pub(super) fn node<const N: usize>(
        &self,
        node: CreaseNode,
        patches: [u32; N],
    ) -> ([f64; 2], [f64; N]) {
        let (p, q) = node;
        let corners = match q {
            NO_INDEX => {
                let corners = self.lattice.triangles()[p as usize];
                let shares = self.meeting(corners);
                [0, 1, 2].map(|k| (corners[k], shares[k]))
            }
            _ => {
                let share = self.crossing(node);
                [(p, 1.0 - share), (q, share), (p, 0.0)]
            }
        };
        let plans = corners.map(|(v, share)| (self.plan(v), share));
        let plan = [0, 1].map(|k| plans.iter().map(|(at, share)| share * at[k]).sum());
        let height = |patch: u32| {
            let used = corners.iter().filter(|(_, share)| *share != 0.0);
            used.map(|(v, share)| share * self.height(*v, patch)).sum()
        };
        (plan, patches.map(height))
    }

    /// Position of a vertex of the lattice seen from above, on the border's line if it is at the border.
    pub(super) fn plan(&self, vertex: u32) -> [f64; 2] {
        let positions = self.lattice.positions();
        match self.border.shares(vertex) {
            None => [0, 1].map(|k| positions[vertex as usize][k]),
            Some(shares) => [0, 1].map(|k| {
                shares
                    .iter()
                    .map(|(v, share)| share * positions[*v as usize][k])
                    .sum()
            }),
        }
    }

    /// Height of a patch, continued where necessary, at the position of a vertex of the lattice; NaN if too few vertices of the patch are
    /// near.
    pub(super) fn height(&self, vertex: u32, patch: u32) -> f64 {
        let own = || self.continued(vertex, patch);
        let Some(shares) = self.border.shares(vertex) else {
            return own();
        };
        let height: f64 = shares
            .iter()
            .map(|(v, share)| share * self.continued(*v, patch))
            .sum();
        if height.is_nan() { own() } else { height }
    }

    /// Finds the point near a given one where the continuations of several patches differ least.
    pub(super) fn common_point(&self, near: [f64; 2], patches: &[u32], reach: f64) -> [f64; 2] {
        let height = |at: [f64; 2], patch: u32| self.height_at(at, patch);
        let [x, y] = near;
        let step = self.surface.lattice().spacing();
        let planes = patches.iter().map(|patch| {
            let along =
                |p: [f64; 2], q: [f64; 2]| (height(q, *patch) - height(p, *patch)) / (2.0 * step);
            [
                height(near, *patch),
                along([x - step, y], [x + step, y]),
                along([x, y - step], [x, y + step]),
            ]
        });
        let planes: Vec<[f64; 3]> = planes
            .filter(|plane| plane.iter().all(|x| x.is_finite()))
            .collect();
        let mean =
            [0, 1, 2].map(|k| planes.iter().map(|p| p[k]).sum::<f64>() / planes.len() as f64);
        let mut fit = LeastSquares::<2>::new();
        for plane in planes {
            let [z, gx, gy] = [0, 1, 2].map(|k| plane[k] - mean[k]);
            fit.add(&Vector2::new(gx, gy), [-z], 1.0);
        }
        let found = fit.solve().map(|d| [d[0], d[1]]);
        match found.filter(|d| d[0].hypot(d[1]) <= reach) {
            Some([dx, dy]) => [x + dx, y + dy],
            None => near,
        }
    }

    /// Height of a patch, continued where necessary, at a point seen from above; NaN outside of the surface.
    pub(super) fn height_at(&self, at: [f64; 2], patch: u32) -> f64 {
        let lattice = self.surface.lattice();
        let located = lattice.locate(at);
        let corners = located.vertices.into_iter().zip(located.weights);
        let heights = corners.map(|((row, col), weight)| {
            let index = lattice
                .contains(row, col)
                .then(|| lattice.index(row as usize, col as usize) as u32);
            let vertex = index.and_then(|index| self.lattice.vertices().binary_search(&index).ok());
            vertex.map_or(f64::NAN, |vertex| {
                weight * self.continued(vertex as u32, patch)
            })
        });
        heights.sum()
    }

    /// Number of the patch at a point seen from above; [`NO_PATCH`] outside of the surface.
    pub(super) fn label_at(&self, at: [f64; 2]) -> u32 {
        let lattice = self.surface.lattice();
        let located = lattice.locate(at);
        let labels = located
            .vertices
            .map(|(row, col)| match lattice.contains(row, col) {
                true => self.labels[lattice.index(row as usize, col as usize)],
                false => NO_PATCH,
            });
        if labels.contains(&NO_PATCH) {
            return NO_PATCH;
        }
        let nearest = (0..3).max_by(|a, b| located.weights[*a].total_cmp(&located.weights[*b]));
        nearest.map_or(NO_PATCH, |k| labels[k])
    }

    /// Height of the surface at a point seen from above, of its nearest vertices where some are missing.
    pub(super) fn surface_height(&self, at: [f64; 2]) -> f64 {
        let lattice = self.surface.lattice();
        let located = lattice.locate(at);
        let (mut sum, mut total) = (0.0, 0.0);
        for ((row, col), weight) in located.vertices.into_iter().zip(located.weights) {
            let z = match lattice.contains(row, col) {
                true => self.surface.height(row as usize, col as usize),
                false => f64::NAN,
            };
            if !z.is_nan() {
                // What is nearest counts even if it has no share.
                let share = weight.max(f64::EPSILON);
                sum += share * z;
                total += share;
            }
        }
        sum / total
    }

    fn continued(&self, vertex: u32, patch: u32) -> f64 {
        if self.label(vertex) == patch {
            return self.lattice.positions()[vertex as usize][2];
        }
        let index = self.lattice.vertices()[vertex as usize] as usize;
        let mut all = self.continued.borrow_mut();
        let height = || extrapolated_height(self.surface, self.labels, patch, index);
        *all.entry((vertex, patch)).or_insert_with(height)
    }

    /// Computes where the continuations of the patches at the ends of an edge meet, as a share of the way along it.
    fn crossing(&self, (p, q): CreaseNode) -> f64 {
        let [a, b] = [p, q].map(|v| self.label(v));
        let here = self.height(p, a) - self.height(p, b);
        let there = self.height(q, a) - self.height(q, b);
        let share = here / (here - there);
        // Across a step they hardly meet.
        match (-1.0..=2.0).contains(&share) {
            true => share.clamp(0.0, 1.0),
            false => 0.5,
        }
    }

    /// Computes the barycentric coordinates of the point in a triangle where the continuations of its three patches meet;
    /// those of the centroid if they do not meet inside.
    fn meeting(&self, corners: [u32; 3]) -> [f64; 3] {
        let heights = corners.map(|own| corners.map(|corner| self.height(corner, self.label(own))));
        let difference = |a: usize, b: usize| [0, 1, 2].map(|k| heights[a][k] - heights[b][k]);
        let ([a, b, c], [d, e, f]) = (difference(0, 1), difference(1, 2));
        let shares = [b * f - c * e, c * d - a * f, a * e - b * d];
        let shares = shares.map(|share| share / shares.iter().sum::<f64>());
        match shares.iter().all(|share| *share >= 0.0) {
            true => shares,
            false => [1.0 / 3.0; 3],
        }
    }
}
