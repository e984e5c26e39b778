//! Triangles laid flat together, cut open along some of their edges.

use std::collections::VecDeque;

use rustc_hash::FxHashSet;

use super::body::Body;
use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::math::planar::orientation;
use crate::math::union_find::UnionFind;
use crate::scene::half_edges::{half_edge_ends, next_half_edge, outlines, twin_half_edges};
use crate::unroll::arap_mesh::{ArapMesh, StoppingCriteria};
use crate::unroll::flat_triangle::{FlatTriangle, Point};
use crate::unroll::overlap::crossings;

/// A part of a mesh, laid flat: its triangles, and the positions of its vertices in the plane.
#[derive(Debug, Clone)]
pub(super) struct FlatPart {
    /// Numbers of the laid triangles in the whole mesh.
    pub members: Vec<u32>,
    /// Vertices of the triangles; `twins` holds the opposite of each half-edge, or [`NO_INDEX`] where it is cut or
    /// at the border.
    pub triangles: Vec<[u32; 3]>,
    pub twins: Vec<u32>,
    /// Number of the mesh's vertex that each vertex of the flat part comes from.
    pub source: Vec<u32>,
    pub places: Vec<Point>,
    pub area: f64,
    /// Strain of the flat part: root mean square over its area.
    pub strain: f64,
    /// Number of the triangle with the largest strain for its size.
    pub worst: usize,
}

/// Stopping criteria of the solver that lays a sheet flat whose cut is tried to be closed.
const TRIAL_RELAXATION: StoppingCriteria = StoppingCriteria {
    tolerance: 1e-8,
    relative_tolerance: 0.01,
    target_energy: 0.0,
    hopeless_energy: f64::INFINITY,
    max_steps: 6,
};

/// Number of solver iterations that are made before the solver may give up a layout.
/// `benches/patterns.md` has what others give.
const UNCONDITIONAL_STEPS: usize = 40;

/// Initial flat positions of triangles, from which the solver reduces their strain.
pub(super) enum Lying<'a> {
    /// Triangles are unfolded into the plane one after the other, over common edges.
    TurnedOver,
    /// A function that gives the flat position of each corner of the whole mesh's triangles.
    At(&'a dyn Fn(u32) -> Point),
}

impl FlatPart {
    /// Places triangles in the plane, by unfolding them or at given positions. `twins` holds the opposite of each
    /// half-edge, or [`NO_INDEX`] where the triangles are cut apart.
    pub(super) fn new(
        body: &Body,
        members: Vec<u32>,
        twins: Vec<u32>,
        start: Lying,
    ) -> Result<FlatPart> {
        let own: Vec<[u32; 3]> = members
            .iter()
            .map(|t| body.triangles[*t as usize])
            .collect();
        // Merge the corners of triangles into one vertex unless a cut lies between them.
        let mut sets = UnionFind::new("pattern", 3 * own.len())?;
        for (side, twin) in twins
            .iter()
            .enumerate()
            .filter(|(_, twin)| **twin != NO_INDEX)
        {
            let side = side as u32;
            sets.union(side, next_half_edge(*twin));
            sets.union(next_half_edge(side), *twin);
        }
        let mut numbers = vec![NO_INDEX; 3 * own.len()];
        let mut source = Vec::new();
        let mut triangles = vec![[0; 3]; own.len()];
        for corner in 0..3 * own.len() {
            let root = sets.find(corner as u32) as usize;
            if numbers[root] == NO_INDEX {
                numbers[root] = source.len() as u32;
                source.push(own[corner / 3][corner % 3]);
            }
            triangles[corner / 3][corner % 3] = numbers[root];
        }
        let pieces: Vec<FlatTriangle> = own.iter().map(|t| piece(body, *t)).collect();
        let mut laid = FlatPart {
            area: pieces.iter().map(FlatTriangle::area).sum(),
            places: vec![Point::default(); source.len()],
            members,
            triangles,
            twins,
            source,
            strain: 0.0,
            worst: 0,
        };
        match start {
            Lying::TurnedOver => laid.turn_over(body, &pieces),
            Lying::At(place) => {
                for (t, corners) in laid.members.iter().zip(&laid.triangles) {
                    for (k, corner) in (0..).zip(corners) {
                        laid.places[*corner as usize] = place(3 * t + k);
                    }
                }
            }
        }
        laid.measure(&pieces);
        Ok(laid)
    }

    /// Moves the vertices from their current flat positions to those of the least strain.
    pub(super) fn relaxed(self, body: &Body, until: StoppingCriteria) -> Result<FlatPart> {
        self.with_sides(body, |_| None, 0.0, until)
    }

    /// Moves the vertices near to the positions of least strain: later steps hardly lower the strain of a sheet.
    pub(super) fn closed(self, body: &Body) -> Result<FlatPart> {
        self.relaxed(body, TRIAL_RELAXATION)
    }

    /// Moves the vertices to the positions of least strain at which edges along the border have given lengths, by the half-edges of the
    /// whole mesh; the weight is that of the squared difference of a length in the energy.
    pub(super) fn with_sides(
        mut self,
        body: &Body,
        length: impl Fn(u32) -> Option<f64>,
        weight: f64,
        until: StoppingCriteria,
    ) -> Result<FlatPart> {
        let own = self.members.iter().map(|t| body.triangles[*t as usize]);
        let pieces: Vec<FlatTriangle> = own.map(|t| piece(body, t)).collect();
        let triangles = pieces.iter().copied().zip(self.triangles.iter().copied());
        let edges = self.border().filter_map(|side| {
            let [from, to] = half_edge_ends(&self.triangles, side);
            let length = length(3 * self.members[side as usize / 3] + side % 3)?;
            Some((FlatTriangle::edge(length, weight), [from, to, to]))
        });
        let all = triangles.chain(edges).filter(|(piece, _)| piece.exists());
        let mut problem = ArapMesh::new(&self.places, all.collect())?;
        // Slow progress in the first steps is no reason to stop: an error at one end takes several steps to reach
        // the other.
        let start = StoppingCriteria {
            max_steps: until.max_steps.min(UNCONDITIONAL_STEPS),
            hopeless_energy: f64::INFINITY,
            ..until
        };
        let steps = problem.minimise(&mut self.places, start)?.steps;
        if steps == UNCONDITIONAL_STEPS && until.max_steps > UNCONDITIONAL_STEPS {
            problem.minimise(&mut self.places, until)?;
        }
        self.measure(&pieces);
        Ok(self)
    }

    /// Length on the sheet of each half-edge of its triangles, by the half-edges of the whole mesh.
    pub(super) fn side_lengths(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        self.members
            .iter()
            .zip(&self.triangles)
            .flat_map(|(t, corners)| {
                let place = |k: usize| self.places[corners[k % 3] as usize];
                [0, 1, 2].map(|k| (3 * t + k as u32, (place(k + 1) - place(k)).norm()))
            })
    }

    /// Unfolds one triangle after the other into the plane, next to those that are laid already.
    fn turn_over(&mut self, body: &Body, pieces: &[FlatTriangle]) {
        let mut lies = vec![false; self.places.len()];
        let mut seen = vec![false; pieces.len()];
        let mut queue = VecDeque::new();
        for start in 0..pieces.len() {
            if seen[start] || !pieces[start].exists() {
                continue;
            }
            seen[start] = true;
            let [_, b, c] = self.triangles[start].map(|v| v as usize);
            let apex = pieces[start].third_corner();
            let long = (2.0 * pieces[start].area() / apex.im).sqrt();
            (self.places[b], self.places[c]) = (Point::new(long, 0.0), apex * long);
            for v in self.triangles[start] {
                lies[v as usize] = true;
            }
            queue.push_back(start);
            while let Some(t) = queue.pop_front() {
                for side in 3 * t..3 * t + 3 {
                    let twin = self.twins[side];
                    if twin == NO_INDEX {
                        continue;
                    }
                    let other = twin as usize / 3;
                    if std::mem::replace(&mut seen[other], true) {
                        continue;
                    }
                    queue.push_back(other);
                    let [from, to] = half_edge_ends(&self.triangles, twin).map(|v| v as usize);
                    let apex = self.triangles[other][(twin as usize + 2) % 3] as usize;
                    if std::mem::replace(&mut lies[apex], true) {
                        continue;
                    }
                    let along = self.places[to] - self.places[from];
                    // Scale the edge to its length on the mesh, or errors would grow from one triangle to the next.
                    let [p, q] = [from, to].map(|v| body.places[self.source[v] as usize]);
                    let scale = (q - p).norm() / along.norm().max(f64::MIN_POSITIVE);
                    self.places[apex] = self.places[from]
                        + along * (scale * third(&pieces[other], twin as usize % 3));
                }
            }
        }
    }

    /// Integral of the squared strain over the flat part.
    pub(super) fn energy(&self) -> f64 {
        self.area * self.strain.powi(2)
    }

    /// Root mean square strain of some triangles.
    pub(super) fn strain_of(&self, body: &Body, wanted: &[u32]) -> f64 {
        let wanted: FxHashSet<u32> = wanted.iter().copied().collect();
        let (mut squares, mut area) = (0.0, 0.0);
        for (t, corners) in self.members.iter().zip(&self.triangles) {
            if !wanted.contains(t) {
                continue;
            }
            let piece = piece(body, body.triangles[*t as usize]);
            if piece.exists() {
                let [long, short] = piece.singular_values(corners.map(|v| self.places[v as usize]));
                squares += piece.area() * ((long - 1.0).powi(2) + (short - 1.0).powi(2));
                area += piece.area();
            }
        }
        if area > 0.0 {
            (0.5 * squares / area).sqrt()
        } else {
            0.0
        }
    }

    fn measure(&mut self, pieces: &[FlatTriangle]) {
        let (mut squares, mut worst) = (0.0, 0.0);
        for (t, piece) in pieces.iter().enumerate().filter(|(_, p)| p.exists()) {
            let [long, short] =
                piece.singular_values(self.triangles[t].map(|v| self.places[v as usize]));
            let own = piece.area() * ((long - 1.0).powi(2) + (short - 1.0).powi(2));
            squares += own;
            if own > worst {
                (worst, self.worst) = (own, t);
            }
        }
        self.strain = match self.area > 0.0 {
            true => (0.5 * squares / self.area).sqrt(),
            false => 0.0,
        };
    }

    /// Lists the half-edges along the border of the flat part.
    pub(super) fn border(&self) -> impl Iterator<Item = u32> + '_ {
        let all = (0..self.twins.len() as u32).zip(&self.twins);
        all.filter(|(_, twin)| **twin == NO_INDEX)
            .map(|(side, _)| side)
    }

    /// Returns whether the flat part's border crosses itself, or triangles overlap.
    pub(super) fn overlaps(&self) -> bool {
        let border: Vec<[u32; 2]> = self
            .border()
            .map(|s| half_edge_ends(&self.triangles, s))
            .collect();
        crossings(&self.places, &border).next().is_some() || self.covers_itself(&border)
    }

    /// The closed lines around the flat part.
    pub(super) fn lines(&self) -> Vec<Vec<Point>> {
        let is_cut = |side: u32| self.twins[side as usize] == NO_INDEX;
        let start = |side: &u32| self.triangles[*side as usize / 3][*side as usize % 3];
        let lines = outlines(&self.twins, self.border(), is_cut);
        let mut lines: Vec<Vec<Point>> = (lines.iter())
            .map(|line| {
                line.iter()
                    .map(|side| self.places[start(side) as usize])
                    .collect()
            })
            .collect();
        lines.retain(|line| line.len() > 2);
        lines
    }

    /// Lays triangles flat: unfolds them into the plane one after the other, then moves their vertices to the least
    /// strain.
    pub(super) fn whole(
        body: &Body,
        members: Vec<u32>,
        until: StoppingCriteria,
    ) -> Result<FlatPart> {
        let own: Vec<[u32; 3]> = (members.iter())
            .map(|t| body.triangles[*t as usize])
            .collect();
        FlatPart::new(body, members, twin_half_edges(&own), Lying::TurnedOver)?.relaxed(body, until)
    }

    /// Returns whether the centroid of a triangle lies on another triangle, by the border's winding number around the
    /// centroid.
    fn covers_itself(&self, border: &[[u32; 2]]) -> bool {
        let step = self.triangles.len().div_ceil(MAX_OVERLAP_PROBES);
        // Of a sliver on a straight border rounding says where it lies.
        let least = MIN_PROBED_AREA_SHARE * self.area / self.triangles.len() as f64;
        let is_wide = |corners: &&[u32; 3]| {
            let [a, b, c] = corners.map(|v| self.places[v as usize]);
            0.5 * orientation(a, b, c).abs() > least
        };
        let wide = self.triangles.iter().filter(is_wide);
        wide.step_by(step).any(|corners| {
            let middle = corners
                .iter()
                .map(|v| self.places[*v as usize])
                .sum::<Point>()
                / 3.0;
            let turns: i32 = (border.iter())
                .map(|ends| {
                    let [a, b] = ends.map(|v| self.places[v as usize] - middle);
                    let is_left = (a.conj() * b).im > 0.0;
                    match (a.im <= 0.0, b.im <= 0.0) {
                        (true, false) => i32::from(is_left),
                        (false, true) => -i32::from(!is_left),
                        _ => 0,
                    }
                })
                .sum();
            turns > 1
        })
    }
}

/// Minimum area of a triangle whose centroid is tested for lying on another triangle, as a share of the mean area.
/// `benches/patterns.md` has what others give.
const MIN_PROBED_AREA_SHARE: f64 = 0.01;

fn piece(body: &Body, corners: [u32; 3]) -> FlatTriangle {
    FlatTriangle::from_points(corners.map(|v| body.places[v as usize].into()))
}

/// Maximum number of a flat part's triangles whose centroids are tested for lying on another triangle.
/// `benches/patterns.md` has what others give.
const MAX_OVERLAP_PROBES: usize = 60;

/// Computes the position of a triangle's third corner, as a complex number, where the edge opposite of it goes from 0
/// to 1.
fn third(piece: &FlatTriangle, side: usize) -> Point {
    if !piece.exists() {
        return Point::new(0.5, 0.0);
    }
    let apex = piece.third_corner();
    let one = Point::new(1.0, 0.0);
    match side {
        0 => apex,
        // From the second corner to the third one.
        1 => -one / (apex - one),
        _ => (one - apex) / -apex,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::pattern::cutting::body::Place;

    #[test]
    fn what_cannot_lie_flat_is_turned_over_no_farther_than_it_reaches() {
        // A sphere of radius 1, without its poles.
        let (around, high) = (48u32, 24u32);
        let places = (1..high).flat_map(|j| (0..around).map(move |i| (i, j)));
        let places = places.map(|(i, j)| {
            let (angle, down) = (
                TAU * f64::from(i) / f64::from(around),
                PI * f64::from(j) / f64::from(high),
            );
            Place::new(
                down.sin() * angle.cos(),
                down.sin() * angle.sin(),
                down.cos(),
            )
        });
        let cells = (0..high - 2).flat_map(|j| (0..around).map(move |i| (i, j)));
        let triangles: Vec<[u32; 3]> = cells
            .flat_map(|(i, j)| {
                let vertex = |i: u32, j: u32| j * around + i % around;
                let [a, b] = [vertex(i, j), vertex(i, j + 1)];
                let [c, d] = [vertex(i + 1, j + 1), vertex(i + 1, j)];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let count = triangles.len();
        let body = Body::new(places.collect(), triangles.clone(), vec![0; count]).unwrap();
        let all = (0..count as u32).collect();
        let laid =
            FlatPart::new(&body, all, twin_half_edges(&triangles), Lying::TurnedOver).unwrap();
        let reach = laid
            .places
            .iter()
            .map(|place| place.norm())
            .fold(0.0, f64::max);
        assert!(reach > 1.0 && reach < TAU, "{reach}");
    }
}
