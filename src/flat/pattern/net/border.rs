//! The lines around patches.

use super::{Net, Node, Segment, is_triangle};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::NEIGHBOURS;
use crate::scene::triangulation::Triangulation;
use crate::shape::patches::NO_PATCH;

impl Net {
    /// The seam that a piece of a patch's line is of, by its ends; `None` on the border.
    pub(super) fn seam_along(&self, from: Node, to: Node) -> Option<usize> {
        let on_vertex = |(p, q): Node| p == q;
        if on_vertex(from) || on_vertex(to) {
            return None;
        }
        match (is_triangle(from), is_triangle(to)) {
            (true, true) => None,
            (true, false) => self.seam_of.get(&to).copied(),
            (false, true) => self.seam_of.get(&from).copied(),
            (false, false) => self.seam_between(from, to),
        }
    }

    /// The line around a patch, piece by piece, with the seams that these are of.
    pub(in crate::flat::pattern) fn border(
        &self,
        patch: u32,
    ) -> impl Iterator<Item = (Segment, Option<usize>)> {
        let pieces = self.borders[patch as usize].iter();
        pieces.map(|[from, to]| ([*from, *to], self.seam_along(*from, *to)))
    }

    /// The seam that a piece between two nodes in a triangle is of.
    pub(super) fn seam_between(&self, one: Node, other: Node) -> Option<usize> {
        let (one, other) = (self.seams_of(one), self.seams_of(other));
        let both = one
            .into_iter()
            .flatten()
            .find(|seam| other.contains(&Some(*seam)));
        both.or(one[0])
    }

    pub(super) fn add_borders(&mut self, surface: &Heightfield) {
        for (number, corners) in self.mesh.triangles().iter().copied().enumerate() {
            let labels = corners.map(|v| self.labels[v as usize]);
            let junction = (number as u32, u32::MAX);
            let [a, b, c] = labels;
            let apart = a != b && b != c && c != a;
            for (k, patch) in labels.into_iter().enumerate() {
                if patch == NO_PATCH || labels[..k].contains(&patch) {
                    continue;
                }
                let mut border = Vec::new();
                let (mut exit, mut entry) = (None, None);
                for (i, from) in corners.into_iter().enumerate() {
                    let to = corners[(i + 1) % 3];
                    let [ours, theirs] = [i, (i + 1) % 3].map(|k| labels[k] == patch);
                    let edge = (from.min(to), from.max(to));
                    let ends: Segment = match (ours, theirs) {
                        (true, true) => [(from, from), (to, to)],
                        (true, false) => [(from, from), *exit.insert(edge)],
                        (false, true) => [*entry.insert(edge), (to, to)],
                        (false, false) => continue,
                    };
                    if is_open(surface, &self.mesh, from, to) {
                        border.push(ends);
                    }
                }
                if let (Some(exit), Some(entry)) = (exit, entry) {
                    match apart {
                        true => border.extend([[exit, junction], [junction, entry]]),
                        false => border.push([exit, entry]),
                    }
                }
                self.borders[patch as usize].extend(border);
            }
        }
    }
}

/// Whether there is no triangle to the right of an edge of one to the left.
fn is_open(surface: &Heightfield, mesh: &Triangulation, from: u32, to: u32) -> bool {
    let lattice = surface.lattice();
    let [from, to] = [from, to].map(|v| {
        let index = mesh.vertices()[v as usize] as usize;
        (index / lattice.cols(), index % lattice.cols())
    });
    let place = (from.0 as isize, from.1 as isize);
    let target = (to.0 as isize, to.1 as isize);
    // The next direction clockwise of W, E, NW, NE, SW, SE.
    const CLOCKWISE: [usize; 6] = [2, 5, 3, 1, 0, 4];
    let towards = (0..6).find(|k| NEIGHBOURS[*k].step(place.0, place.1) == target);
    let Some(towards) = towards else { return true };
    let (row, col) = NEIGHBOURS[CLOCKWISE[towards]].step(place.0, place.1);
    !lattice.contains(row, col) || surface.height(row as usize, col as usize).is_nan()
}
