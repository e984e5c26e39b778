//! Triangles that lie in the plane, sheet by sheet, and what is drawn of them: outlines, folds, and places to write on.

use nalgebra::Vector3;
use rustc_hash::FxHashMap;

use super::faces::Faces;
use super::label_spot::label_spot;
use super::sheets::{Fold, Run, Seam, Sheet};
use crate::math::index::NO_INDEX;
use crate::math::planar::{Point2, polygon_area};
use crate::math::simplify::simplify_polyline;
use crate::scene::half_edges::{half_edge_ends, next_on_outline, outlines};
use crate::scene::mesh::TexturedTriangle;
use crate::shape::patches::chains::chains;

/// A mesh whose triangles were moved into the plane, cut open along some of its edges.
pub(super) struct FlatMesh<'a> {
    /// Positions of the vertices in space.
    pub places: &'a [Vector3<f64>],
    pub triangles: &'a [[u32; 3]],
    /// Opposite of each half-edge, or [`NO_INDEX`] at the border.
    pub twins: &'a [u32],
    /// Part of its texture that each triangle shows; empty without textures.
    pub textured: &'a [Option<TexturedTriangle>],
    /// Whether each half-edge lies on its opposite.
    pub closed: Vec<bool>,
    /// Positions of each triangle's corners on its sheet.
    pub flat: Vec<[Point2; 3]>,
    /// Number of the patch of each triangle.
    pub patches: Vec<u32>,
    pub seams: Vec<Seam>,
    /// Number of each half-edge's seam; [`NO_INDEX`] inside of a patch and at the border.
    pub seam_of: Vec<u32>,
    /// Distance on a sheet within which points of one vertex are the same; 0 where faces are not exact.
    pub rounding: f64,
    /// Distance on a sheet within which a line is straight.
    pub straightness: f64,
}

impl FlatMesh<'_> {
    /// Draws a sheet of given triangles; its area, strain and gaps are 0. Closed lines around less than `least` are left out,
    /// unless they are the largest.
    pub(super) fn sheet(&self, members: &[u32], least: impl Fn(&[u32]) -> f64) -> Sheet {
        let sides: Vec<u32> = members.iter().flat_map(|t| 3 * t..3 * t + 3).collect();
        let faces = self.faces(members);
        let mut patches: Vec<u32> = (members.iter())
            .map(|t| self.patches[*t as usize])
            .collect();
        patches.sort_unstable();
        patches.dedup();
        let flat: Vec<Point2> = (faces.flat.iter())
            .map(|[x, y]| Point2::new(*x, *y))
            .collect();
        let spot = |patch: &u32| {
            let own = members.iter().zip(&faces.triangles);
            let own = own.filter(|(t, _)| self.patches[**t as usize] == *patch);
            let own: Vec<[u32; 3]> = own.map(|(_, corners)| *corners).collect();
            label_spot(*patch, &own, &flat)
        };
        Sheet {
            outlines: self.outlines(&sides, least),
            folds: self.folds(&sides),
            spots: patches.iter().map(spot).collect(),
            faces,
            patches,
            spacing: 0.0,
            area: 0.0,
            strain: 0.0,
            seam_gap: 0.0,
            junctions: Vec::new(),
            refolding: None,
            exact: false,
        }
    }

    /// Counts the vertices of each patch; one on a crease counts for all patches there.
    pub(super) fn vertices_of_patches(&self, count: usize) -> Vec<usize> {
        let mut vertices: Vec<(u32, u32)> = (self.triangles.iter().zip(&self.patches))
            .flat_map(|(t, patch)| t.map(|v| (*patch, v)))
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut counts = vec![0; count];
        vertices
            .iter()
            .for_each(|(patch, _)| counts[*patch as usize] += 1);
        counts
    }

    /// Positions of a half-edge's ends on its sheet.
    fn ends(&self, side: u32) -> [Point2; 2] {
        let (corners, k) = (&self.flat[side as usize / 3], side as usize % 3);
        [corners[k], corners[(k + 1) % 3]]
    }

    fn patch(&self, side: u32) -> u32 {
        self.patches[side as usize / 3]
    }

    /// The next half-edge along the outline of a sheet, after one of its border.
    pub(super) fn next_on_outline(&self, side: u32) -> u32 {
        next_on_outline(self.twins, side, |side| !self.closed[side as usize])
    }

    /// The closed lines around a sheet, the longest first, each divided where the seam or the patch changes.
    fn outlines(&self, sides: &[u32], least: impl Fn(&[u32]) -> f64) -> Vec<Vec<Run>> {
        let is_cut = |side: u32| !self.closed[side as usize];
        let mut lines = outlines(self.twins, sides.iter().copied(), is_cut);
        let start = |side: &u32| self.ends(*side)[0];
        drop_empty_lines(
            &mut lines,
            |line| least(line),
            |line| line.iter().map(start).collect(),
        );
        let long = |side: &u32| {
            let [a, b] = self.ends(*side);
            (b - a).norm()
        };
        let mut outlines: Vec<(f64, Vec<Run>)> = (lines.iter())
            .map(|line| (line.iter().map(long).sum(), self.runs(line)))
            .collect();
        outlines.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        outlines.into_iter().map(|(_, runs)| runs).collect()
    }

    fn runs(&self, line: &[u32]) -> Vec<Run> {
        let n = line.len();
        // A border past a fold is one run, so that it is smoothed as one line; of exact faces each side is a run.
        let key = |i: usize| {
            let side = line[i % n];
            let seam = self.seam_of[side as usize];
            let is_divided = seam != NO_INDEX || self.rounding > 0.0;
            (seam, is_divided.then(|| self.patch(side)))
        };
        let start = (0..n).find(|i| key(*i) != key(i + n - 1)).unwrap_or(0);
        let mut order: Vec<usize> = (start..start + n).collect();
        if start == 0 && key(0) == key(n - 1) {
            // One run all around begins at a corner, if it has any.
            let place = |i: usize| self.ends(line[i % n])[0];
            let turn = |i: usize| {
                let [a, b, c] = [place(i + n - 1), place(i), place(i + 1)];
                ((c - b) * (b - a).conj()).arg().abs()
            };
            let corner = (0..n).max_by(|a, b| turn(*a).total_cmp(&turn(*b)).then(b.cmp(a)));
            order.rotate_left(corner.unwrap_or(0));
        }
        let runs = order.chunk_by(|a, b| key(*a) == key(*b));
        runs.map(|run| {
            let sides: Vec<u32> = run.iter().map(|i| line[i % n]).collect();
            let [first, last] = [sides[0], sides[sides.len() - 1]];
            let seam = self.seam_of[first as usize];
            let seam = (seam != NO_INDEX).then(|| self.seams[seam as usize]);
            let mut points: Vec<Point2> = sides.iter().map(|side| self.ends(*side)[0]).collect();
            points.push(self.ends(last)[1]);
            if run.len() == n {
                points[n] = points[0];
            }
            Run {
                seam,
                patch: seam.map(|_| self.patch(first)),
                points: self.straight(&points),
            }
        })
        .collect()
    }

    fn folds(&self, sides: &[u32]) -> Vec<Fold> {
        let mut of: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for side in sides {
            let (seam, twin) = (self.seam_of[*side as usize], self.twins[*side as usize]);
            let is_fold = seam != NO_INDEX && !self.seams[seam as usize].slit;
            if is_fold && *side < twin && self.closed[*side as usize] {
                of.entry(seam).or_default().push(*side);
            }
        }
        let mut folds: Vec<Fold> = Vec::new();
        for (seam, sides) in of {
            let edges: Vec<[u32; 2]> = (sides.iter())
                .map(|side| half_edge_ends(self.triangles, *side))
                .collect();
            let place: FxHashMap<u32, Point2> = (sides.iter().zip(&edges))
                .flat_map(|(side, [a, b])| {
                    let [p, q] = self.ends(*side);
                    [(*a, p), (*b, q)]
                })
                .collect();
            for line in chains(&edges, |_| false) {
                let points: Vec<Point2> = line.vertices.iter().map(|v| place[v]).collect();
                folds.push(Fold {
                    seam: self.seams[seam as usize],
                    bend: None,
                    points: self.straight(&points),
                });
            }
        }
        folds.sort_by(|a, b| {
            let [[x, _], [u, _]] = [a, b].map(|fold| fold.points[0]);
            (a.seam.crease.cmp(&b.seam.crease)).then(x.total_cmp(&u))
        });
        folds
    }

    /// A line without the points at which it goes straight on.
    fn straight(&self, points: &[Point2]) -> Vec<[f64; 2]> {
        let line = simplify_polyline(points, self.straightness).into_iter();
        line.map(|p| [p.re, p.im]).collect()
    }

    /// Triangles of a sheet; corners that lie on each other are one vertex.
    fn faces(&self, members: &[u32]) -> Faces {
        let mut faces = Faces::default();
        let mut found: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        if !self.textured.is_empty() {
            let textured = members.iter().map(|t| self.textured[*t as usize]);
            faces.textured = textured.collect();
        }
        for t in members {
            let (placed, corners) = (&self.flat[*t as usize], self.triangles[*t as usize]);
            faces.triangles.push([0, 1, 2].map(|k| {
                let at = placed[k];
                let all = found.entry(corners[k]).or_default();
                let same = all.iter().copied().find(|v| {
                    let [x, y]: [f64; 2] = faces.flat[*v as usize];
                    (Point2::new(x, y) - at).norm() <= self.rounding
                });
                same.unwrap_or_else(|| {
                    let number = faces.flat.len() as u32;
                    faces.flat.push([at.re, at.im]);
                    faces.built.push(self.places[corners[k] as usize].into());
                    all.push(number);
                    number
                })
            }));
        }
        faces
    }
}

/// Removes the closed lines around less than a least area, except the one around the largest; `least` may differ from
/// line to line.
fn drop_empty_lines<T>(
    lines: &mut Vec<T>,
    least: impl Fn(&T) -> f64,
    ring: impl Fn(&T) -> Vec<Point2>,
) {
    let areas: Vec<f64> = lines
        .iter()
        .map(|line| polygon_area(&ring(line)).abs())
        .collect();
    let largest = areas.iter().copied().fold(0.0, f64::max);
    let mut areas = areas.into_iter();
    lines.retain(|line| {
        let area = areas.next();
        area.is_some_and(|area| area >= least(line).min(largest))
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_there_and_back_is_no_outline_and_a_small_sheet_has_one() {
        let at = Point2::new;
        let square = |size: f64| [at(0.0, 0.0), at(size, 0.0), at(size, size), at(0.0, size)];
        let there_and_back = [at(1.0, 1.0), at(2.0, 1.5), at(3.0, 2.0), at(2.0, 1.5)];
        let mut lines = vec![square(8.0), square(-2.0), there_and_back];
        drop_empty_lines(&mut lines, |_| 1.0, |line| line.to_vec());
        assert_eq!(lines, [square(8.0), square(-2.0)]);
        let mut lines = vec![square(0.5)];
        drop_empty_lines(&mut lines, |_| 1.0, |line| line.to_vec());
        assert_eq!(lines, [square(0.5)]);
    }
}
