//! Multigrid transfer and coarse stencils at the border of a lattice, exact for planes.
//!
//! Prolongation has to keep planes as they are at the border, too. A correction that tilts an edge would
//! otherwise get a kink, whose energy is many times that of the correction itself: the V-cycle would overshoot
//! there, 4 to 10 times on straight edges, and a step of conjugate gradients would be too short everywhere
//! else.

use nalgebra::{Matrix3, Vector3};

use crate::error::{Result, try_filled};
use crate::lattice::coarsening::parents;
use crate::lattice::domain::{Domain, Role};
use crate::lattice::hexagonal::{NEIGHBOUR_DIRECTIONS, OPPOSITE_DIRECTION};
use crate::lattice::per_cell::PerCell;

/// Weight of each neighbour in the averages of multigrid prolongation; the vertex itself has the rest of the weight, at
/// least ¼ (`benches/choices.md`, One constant at a time).
const NEIGHBOUR_WEIGHT: f32 = 0.125;

/// Averages of multigrid prolongation at boundary vertices: each vertex is averaged with those pairs of opposite
/// neighbours that are both active.
#[derive(Debug, Clone)]
pub(super) struct Averages {
    of: Vec<Average>,
}

/// Averaging of one boundary vertex in multigrid prolongation; sets of neighbours are bits in the order of
/// [`NEIGHBOUR_DIRECTIONS`].
#[derive(Debug, Clone, Copy)]
struct Average {
    cell: u32,
    /// Directions of the neighbours that the vertex is averaged with, one bit for each of the six.
    pairs: u8,
    /// Directions of the interior neighbours, whose own averages include this vertex, one bit for each of the six.
    interior: u8,
}

/// Directions of neighbours are bits in the order of [`NEIGHBOUR_DIRECTIONS`].
impl Averages {
    pub(super) fn new(domain: &Domain) -> Self {
        let boundary = |cell: &usize| domain.roles()[*cell] == Role::Boundary;
        let average = |cell: usize| {
            let around = domain
                .neighbour_offsets(cell / domain.stride())
                .map(|o| domain.roles()[cell.wrapping_add_signed(o)]);
            let bits = |wanted: &dyn Fn(usize) -> bool| {
                (0..6).fold(0, |bits, k| bits | u8::from(wanted(k)) << k)
            };
            Average {
                cell: cell as u32,
                pairs: bits(&|k| {
                    around[k].is_active() && around[OPPOSITE_DIRECTION[k]].is_active()
                }),
                interior: bits(&|k| around[k] == Role::Interior),
            }
        };
        Averages {
            of: domain
                .active()
                .cells()
                .filter(boundary)
                .map(average)
                .collect(),
        }
    }

    pub(super) fn cells(&self) -> impl Iterator<Item = usize> + '_ {
        self.of.iter().map(|average| average.cell as usize)
    }

    /// Completes `to = A from` at boundary vertices, where `to` has only the vertices' own values so far.
    pub(super) fn complete(&self, domain: &Domain, from: &[f32], to: &mut [f32]) {
        for average in &self.of {
            let cell = average.cell as usize;
            for (k, n) in neighbours(domain, cell) {
                if average.pairs & 1 << k != 0 {
                    to[cell] += NEIGHBOUR_WEIGHT * (from[n] - from[cell]);
                }
            }
        }
    }

    /// Completes `to = Aᵀ from`, where `to` has been computed so far as if the averaging `A` were symmetric.
    pub(super) fn complete_transposed(&self, domain: &Domain, from: &[f32], to: &mut [f32]) {
        for average in &self.of {
            let cell = average.cell as usize;
            for (k, n) in neighbours(domain, cell) {
                let pair = average.pairs & 1 << k != 0;
                let interior = average.interior & 1 << k != 0;
                if pair {
                    to[cell] -= NEIGHBOUR_WEIGHT * from[cell];
                }
                match (interior, pair) {
                    (true, true) => to[cell] += NEIGHBOUR_WEIGHT * from[n],
                    (true, false) => {
                        to[cell] += NEIGHBOUR_WEIGHT * from[n];
                        to[n] -= NEIGHBOUR_WEIGHT * from[cell];
                    }
                    (false, true) => to[n] += NEIGHBOUR_WEIGHT * from[cell],
                    (false, false) => (),
                }
            }
        }
    }
}

fn neighbours(domain: &Domain, cell: usize) -> impl Iterator<Item = (usize, usize)> {
    let offsets = domain.neighbour_offsets(cell / domain.stride());
    offsets
        .into_iter()
        .map(move |o| cell.wrapping_add_signed(o))
        .enumerate()
}

/// Linear interpolation `L` of multigrid at fine vertices that do not lie between two coarse vertices, from the
/// best-fit plane through the coarse vertices nearby.
#[derive(Debug, Clone)]
pub(super) struct Extension {
    terms: Vec<Term>,
    /// Fine vertices that lie between two coarse vertices of which only one is in the domain, each with that one.
    single: Vec<(u32, u32)>,
}

#[derive(Debug, Clone, Copy)]
struct Term {
    fine: u32,
    coarse: u32,
    weight: f32,
}

impl Extension {
    pub(super) fn new(fine: &Domain, coarse: &Domain) -> Self {
        let active = |vertex| {
            let cell = coarse.cell(vertex)?;
            coarse.roles()[cell].is_active().then_some(cell)
        };
        let (mut terms, mut single) = (Vec::new(), Vec::new());
        for cell in fine.active().cells() {
            let (row, col) = fine.lattice_vertex(cell);
            let parents = parents(row, col);
            match parents.map(active) {
                [Some(_), Some(_)] => continue,
                [Some(a), None] | [None, Some(a)] => single.push((cell as u32, a as u32)),
                [None, None] => (),
            }
            let near = nearby(parents).into_iter().filter_map(active);
            let near: Vec<_> = near
                .map(|other| (other, offset(fine, cell, coarse, other)))
                .collect();
            for ((coarse, _), weight) in near.iter().zip(affine_weights(&near)) {
                terms.push(Term {
                    fine: cell as u32,
                    coarse: *coarse as u32,
                    weight: weight as f32,
                });
            }
        }
        Extension { terms, single }
    }

    /// Writes the interpolated values `L from` at fine vertices that do not lie between two coarse ones.
    pub(super) fn extend(&self, from: &[f32], to: &mut [f32]) {
        for (fine, _) in &self.single {
            to[*fine as usize] = 0.0;
        }
        for term in &self.terms {
            to[term.fine as usize] += term.weight * from[term.coarse as usize];
        }
    }

    /// Completes `to = scale · Lᵀ from` for fine vertices that do not lie between two coarse ones: `to` has only half
    /// of `from` at each parent so far.
    pub(super) fn extend_transposed(&self, from: &[f32], to: &mut [f32], scale: f32) {
        for (fine, parent) in &self.single {
            to[*parent as usize] -= 0.5 * scale * from[*fine as usize];
        }
        for term in &self.terms {
            to[term.coarse as usize] += scale * term.weight * from[term.fine as usize];
        }
    }
}

/// Collects the coarse vertices up to two edges away from the parents of a fine vertex, each once.
fn nearby(parents: [(isize, isize); 2]) -> Vec<(isize, isize)> {
    let mut found = vec![parents[0]];
    if parents[1] != parents[0] {
        found.push(parents[1]);
    }
    let mut first = 0;
    for _ in 0..2 {
        let last = found.len();
        for i in first..last {
            let (row, col) = found[i];
            for next in NEIGHBOUR_DIRECTIONS.map(|towards| towards.step(row, col)) {
                if !found.contains(&next) {
                    found.push(next);
                }
            }
        }
        first = last;
    }
    found
}

/// Returns the weights with which values at given offsets sum up to the value of their best-fit plane at offset 0; near
/// values weigh most.
fn affine_weights(near: &[(usize, [f64; 2])]) -> Vec<f64> {
    /// Weight of the squared slope relative to the squared residuals, which chooses the plane of least slope
    /// where the values do not determine one.
    const SLOPE_WEIGHT: f64 = 1e-6;
    let influence = |[x, y]: [f64; 2]| (x * x + y * y).powi(-2);
    let mut normal = Matrix3::from_diagonal(&Vector3::new(0.0, SLOPE_WEIGHT, SLOPE_WEIGHT));
    for (_, offset) in near {
        let row = Vector3::new(1.0, offset[0], offset[1]);
        normal += influence(*offset) * row * row.transpose();
    }
    let Some(inverse) = normal.try_inverse() else {
        return Vec::new();
    };
    let plane = inverse.column(0);
    let weight = |offset: [f64; 2]| {
        influence(offset) * (plane[0] + plane[1] * offset[0] + plane[2] * offset[1])
    };
    near.iter().map(|(_, offset)| weight(*offset)).collect()
}

/// Counts the stencils of the finest lattice that each stencil of the next coarser lattice stands for, as a share of
/// the number away from the border. Near a border it is more, because the coarse stencils end further inside: bending
/// would be too cheap there otherwise, and the correction up to three times too large.
pub(super) fn coarser_counts(
    counts: &PerCell<f32>,
    fine: &Domain,
    coarse: &Domain,
) -> Result<PerCell<f32>> {
    let mut sums = try_filled("multigrid", coarse.cells(), 0.0)?;
    let interior = |vertex| {
        let cell = coarse.cell(vertex)?;
        (coarse.roles()[cell] == Role::Interior).then_some(cell)
    };
    for cell in fine.interior().cells() {
        let (row, col) = fine.lattice_vertex(cell);
        let share = 0.25 * counts.at(cell);
        let parents = parents(row, col);
        match parents.map(interior) {
            [Some(a), Some(b)] => {
                sums[a] += 0.5 * share;
                sums[b] += 0.5 * share;
            }
            [Some(only), None] | [None, Some(only)] => sums[only] += share,
            [None, None] => {
                let nearest = nearby(parents).into_iter().filter_map(interior);
                let distance = |c: &usize| squared_distance(fine, cell, coarse, *c);
                let nearest = nearest.min_by(|a, b| distance(a).total_cmp(&distance(b)));
                if let Some(nearest) = nearest {
                    sums[nearest] += share;
                }
            }
        }
    }
    Ok(PerCell::Each(sums))
}

fn squared_distance(fine: &Domain, cell: usize, coarse: &Domain, other: usize) -> f64 {
    let [x, y] = offset(fine, cell, coarse, other);
    x * x + y * y
}

/// Returns the offset from a fine vertex to a coarse one, in coarse spacings.
fn offset(fine: &Domain, cell: usize, coarse: &Domain, other: usize) -> [f64; 2] {
    let place = |domain: &Domain, cell: usize| {
        let (row, col) = domain.lattice_vertex(cell);
        domain.lattice().position(row, col)
    };
    let ([x, y], [u, v]) = (place(fine, cell), place(coarse, other));
    let unit = coarse.lattice().spacing();
    [(u - x) / unit, (v - y) / unit]
}
