//! Coarsening of a solve's input to the lattice of twice the spacing. λ stays the same, because both terms of the
//! energy are plain sums over vertices.

use nalgebra::{Matrix3, Vector3};

use super::input::Input;
use crate::error::{Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::heights::occlusions::Occlusions;
use crate::lattice::coarsening::{coarse_lattice, fine_vertex};
use crate::lattice::domain::{Domain, Role};
use crate::lattice::hexagonal::{NEIGHBOUR_DIRECTIONS, ROW_SPACING};
use crate::math::fork;

/// Offsets (x, y) from a lattice vertex to its neighbours W, E, NW, NE, SW and SE, in spacings.
const NEIGHBOUR_OFFSETS: [[f64; 2]; 6] = [
    [-1.0, 0.0],
    [1.0, 0.0],
    [-0.5, ROW_SPACING],
    [0.5, ROW_SPACING],
    [-0.5, -ROW_SPACING],
    [0.5, -ROW_SPACING],
];

/// Half of the number of fine vertices that a coarse vertex stands for: the one at its position, and half of each of
/// that one's six neighbours.
const HALF_COARSE_WEIGHT: f64 = 2.0;

/// Coarsens an input to the lattice of twice the spacing. `domain` has the roles of the fine vertices.
///
/// Whether a coarse vertex is valid depends on seven fine vertices: the one at its position and its neighbours. So a
/// hole of one vertex, or a row of them, does not become a hole of four or vanish, depending on where the coarse
/// lattice lies. A coarse vertex is valid where its fine vertex is, or at least half of what it stands for. It has a
/// stencil if at least half of the fine vertices have one, and if no occlusion tears the surface at these vertices or
/// at those of a neighbour.
///
/// Its height is the mean, weighted by confidence, over pairs of opposite neighbours, which keeps planes and halves the
/// noise. It is constrained if its fine vertex is, or else to the mean of its constrained neighbours.
pub(crate) fn coarsen(input: &Input, domain: &Domain) -> Result<Input> {
    let fine = input.field.lattice();
    let lattice = coarse_lattice(fine)?;
    let heights = input.field.heights();
    let vertex = |(row, col): (isize, isize)| {
        let inside = fine.contains(row, col);
        let index = inside.then(|| fine.index(row as usize, col as usize));
        index.filter(|v| !heights[*v].is_nan())
    };
    let has_stencil = |vertex| {
        domain
            .cell_of(vertex, |role| role == Role::Interior)
            .is_some()
    };
    let mut merged = try_filled("coarse vertices", lattice.len(), Merged::default())?;
    let mut torn = try_filled("coarse occlusions", lattice.len(), 0u8)?;
    let rows = merged.chunks_mut(lattice.cols());
    let mut rows: Vec<_> = rows.zip(torn.chunks_mut(lattice.cols())).collect();
    fork::for_each(&mut rows, |row, (merged, torn)| {
        for (col, (merged, torn)) in merged.iter_mut().zip(torn.iter_mut()).enumerate() {
            let centre = fine_vertex(row, col);
            let around = NEIGHBOUR_DIRECTIONS.map(|t| t.step(centre.0, centre.1));
            let (own, ring) = (vertex(centre), around.map(vertex));
            let share = |own: bool, ring: usize| f64::from(u8::from(own)) + 0.5 * ring as f64;
            let valid = share(own.is_some(), ring.into_iter().flatten().count());
            let stencils = around.into_iter().filter(|v| has_stencil(*v)).count();
            let mut given = own.into_iter().chain(ring.into_iter().flatten());
            let is_torn = share(has_stencil(centre), stencils) < HALF_COARSE_WEIGHT
                || given.any(|v| input.is_occluded(v));
            *torn = u8::from(is_torn);
            if own.is_some() || valid >= HALF_COARSE_WEIGHT {
                *merged = input.merged(own, ring);
            }
        }
    });
    let heights = merged.iter().map(|merged| merged.height).collect();
    let mut coarse = Input::new(Heightfield::new(lattice, heights)?);
    if !input.confidence.is_empty() {
        coarse.confidence = merged.iter().map(|merged| merged.confidence).collect();
    }
    if !input.constrained.is_empty() {
        coarse.constrained = merged.iter().map(|merged| merged.constrained).collect();
    }
    coarse.with_occlusions(Occlusions::from_vertices(&lattice, &torn)?)
}

/// Height, confidence and constraint of a coarse vertex, merged from fine vertices.
#[derive(Debug, Clone, Copy)]
struct Merged {
    height: f64,
    confidence: f64,
    constrained: bool,
}

impl Default for Merged {
    fn default() -> Self {
        Merged {
            height: f64::NAN,
            confidence: 0.0,
            constrained: false,
        }
    }
}

impl Input {
    /// Merges a fine vertex and those of its neighbours that are valid: at least the vertex itself or two opposite
    /// neighbours.
    fn merged(&self, own: Option<usize>, ring: [Option<usize>; 6]) -> Merged {
        let heights = self.field.heights();
        // Weights 2 and 1: those of linear interpolation, transposed.
        let mut terms = [None; 7];
        terms[0] = own.map(|v| ([0.0; 2], 2.0, v));
        for (a, b) in [(0, 1), (2, 5), (3, 4)] {
            if let Some((v, w)) = ring[a].zip(ring[b]) {
                terms[1 + a] = Some((NEIGHBOUR_OFFSETS[a], 1.0, v));
                terms[1 + b] = Some((NEIGHBOUR_OFFSETS[b], 1.0, w));
            }
        }
        let given = || terms.iter().flatten();
        let count: f64 = given().map(|(_, share, _)| share).sum();
        let plain: f64 = given().map(|(_, share, v)| share * heights[*v]).sum();
        let (height, weight) = match self.confidence.is_empty() {
            true => (plain / count, count),
            false => self
                .plane(given())
                .unwrap_or((own.map_or(plain / count, |v| heights[v]), 0.0)),
        };
        let held = |v: &usize| self.is_constrained(*v);
        let constraint = match own.filter(held) {
            Some(own) => Some(heights[own]),
            None => {
                let held = || ring.into_iter().flatten().filter(held);
                let sum: f64 = held().map(|v| heights[v]).sum();
                (held().count() > 0).then(|| sum / held().count() as f64)
            }
        };
        Merged {
            height: constraint.unwrap_or(height),
            confidence: weight / count,
            constrained: constraint.is_some(),
        }
    }

    /// Fits a plane to the heights of vertices at given offsets, weighted by their shares and confidence; returns its
    /// height at the origin and the weight of that height, or `None` if all weights vanish.
    fn plane<'a>(
        &self,
        terms: impl Iterator<Item = &'a ([f64; 2], f64, usize)> + Clone,
    ) -> Option<(f64, f64)> {
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        let first = self.field.heights()[terms.clone().next()?.2];
        for ([x, y], share, vertex) in terms {
            let weight = share * self.weight(*vertex);
            let row = Vector3::new(1.0, *x, *y);
            normal += weight * row * row.transpose();
            right += weight * row * (self.field.heights()[*vertex] - first);
        }
        // Where nothing says how it slopes, hardly at all.
        let slope = 1e-9 * normal[(0, 0)];
        normal += Matrix3::from_diagonal(&Vector3::new(0.0, slope, slope));
        let inverse = normal.cholesky()?.inverse();
        let height = first + inverse.column(0).dot(&right);
        Some((height, 1.0 / inverse[(0, 0)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    #[test]
    fn coarsening_keeps_planes_and_holes() {
        let lattice = Lattice::new(15, 16, 0.1)
            .unwrap()
            .with_origin([3.0, 1.0])
            .unwrap();
        let hole = |x: f64, y: f64| (x - 3.8f64).hypot(y - 0.5) < 0.25;
        let plane = |x: f64, y: f64| {
            if hole(x, y) {
                f64::NAN
            } else {
                2.0 * x - y + 1.0
            }
        };
        let field = Heightfield::from_fn(lattice, plane).unwrap();
        let domain = Domain::new(&field).unwrap();
        let coarse = coarsen(&field.into(), &domain).unwrap().field;
        let mut counts = [0, 0];
        for row in 0..coarse.lattice().rows() {
            for col in 0..coarse.lattice().cols() {
                let [x, y] = coarse.lattice().position(row, col);
                let z = coarse.height(row, col);
                let outside = !(3.0 - 1e-9..=4.5 + 1e-9).contains(&x);
                assert_eq!(z.is_nan(), hole(x, y) || outside, "{x} {y}");
                counts[usize::from(z.is_nan())] += 1;
                assert!(z.is_nan() || (z - (2.0 * x - y + 1.0)).abs() < 1e-12);
            }
        }
        assert!(counts[0] > 40 && counts[1] > 3);
    }
}
