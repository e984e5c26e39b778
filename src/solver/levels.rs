//! Coarse to fine: the sublattice of twice the spacing is the same kind of
//! lattice, and its solution a good start.
//!
//! Coarse vertex `(r, c)` is fine vertex `(2r, 2c − (r odd))`, and every other
//! fine vertex is the midpoint of a coarse edge. Since both terms of the energy
//! are plain sums over vertices, λ stays; the dual is bounded by 1 whatever the
//! resolution, so `Y` and `H` carry over by linear interpolation as `z` does.

use super::problem::Problem;
use super::state::State;
use super::transfer::parents;
use crate::domain::{Domain, Role};
use crate::error::Result;
use crate::heightfield::Heightfield;
use crate::lattice::{Lattice, Towards};

/// The field on the lattice of twice the spacing. A coarse vertex is valid where
/// its fine vertex is; its height is the mean over the opposite neighbours that
/// are both there, which leaves planes alone and halves the noise.
pub(crate) fn coarsen(field: &Heightfield) -> Result<Heightfield> {
    let fine = field.lattice();
    let lattice = Lattice::new(
        fine.rows().div_ceil(2),
        fine.cols() / 2 + 1,
        2.0 * fine.spacing(),
    )?
    .with_origin(fine.origin())?;
    let height = |(row, col): (isize, isize)| {
        if fine.contains(row, col) {
            field.height(row as usize, col as usize)
        } else {
            f64::NAN
        }
    };
    const OPPOSITE: [(Towards, Towards); 3] = [
        (Towards::West, Towards::East),
        (Towards::NorthWest, Towards::SouthEast),
        (Towards::NorthEast, Towards::SouthWest),
    ];
    let mut heights = Vec::with_capacity(lattice.len());
    for row in 0..lattice.rows() {
        for col in 0..lattice.cols() {
            let (r, c) = (2 * row as isize, 2 * col as isize - (row % 2) as isize);
            let centre = height((r, c));
            // Weights 2 and 1: those of linear interpolation, transposed.
            let (mut sum, mut weight) = (2.0 * centre, 2.0);
            for (a, b) in OPPOSITE {
                let pair = height(a.step(r, c)) + height(b.step(r, c));
                if !pair.is_nan() {
                    sum += pair;
                    weight += 2.0;
                }
            }
            heights.push(sum / weight);
        }
    }
    Heightfield::new(lattice, heights)
}

/// An iterate on the fine lattice from one on the coarse lattice. Where a fine
/// vertex has no coarse vertex to take from, as on islands and between holes
/// that are too small for the coarse lattice, it starts from the input.
pub(crate) fn prolong(coarse: &Problem, from: &State, fine: &Problem, rho: f64) -> Result<State> {
    let mut state = State::new(fine, rho)?;
    let active = |vertex| cell(&coarse.domain, vertex, Role::is_active);
    let interior = |vertex| cell(&coarse.domain, vertex, |role| role == Role::Interior);
    for i in fine.domain.active().cells() {
        let (row, col) = fine.domain.lattice_vertex(i);
        let [a, b] = parents(row, col);
        if let (Some(a), Some(b)) = (active(a), active(b)) {
            state.z[i] = 0.5 * (from.z[a] + from.z[b]);
        }
        if fine.domain.roles()[i] == Role::Interior {
            let found = [interior(a), interior(b)];
            let n = found.iter().flatten().count();
            if n > 0 {
                let weight = 1.0 / n as f64;
                let halves = found.into_iter().flatten().map(|cell| from.matrices(cell));
                let (dual, hessian) = halves.fold(Default::default(), |(y, h), (dy, dh)| {
                    (y + dy.scale(weight), h + dh.scale(weight))
                });
                state.set_matrices(i, dual, hessian);
            }
        }
    }
    Ok(state)
}

/// The padded box's cell of a lattice vertex, if its role is wanted.
fn cell(domain: &Domain, vertex: (isize, isize), wanted: impl Fn(Role) -> bool) -> Option<usize> {
    let cell = domain.cell(vertex)?;
    wanted(domain.roles()[cell]).then_some(cell)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::solver::frame::Frame;
    use crate::{Normalization, Sym2};

    #[test]
    fn a_constant_dual_and_a_plane_carry_over_unchanged() {
        let lattice = Lattice::new(17, 18, 0.1).unwrap();
        // Bent, so that the best-fit plane that is taken away is not everything.
        let field = Heightfield::from_fn(lattice, |x, y| x * x + 0.3 * y).unwrap();
        let coarse_field = coarsen(&field).unwrap();
        let domains = [&field, &coarse_field].map(|f| Arc::new(Domain::new(f).unwrap()));
        let frame = Frame::new(&field, &domains[0], Normalization::Off);
        let [fine, coarse] = [(&field, &domains[0]), (&coarse_field, &domains[1])]
            .map(|(f, d)| Problem::new(f, d.clone(), &frame, 1e3).unwrap());
        let mut state = State::new(&coarse, 0.4).unwrap();
        let (dual, hessian) = (Sym2::new(1.0, 0.0, 0.3), Sym2::new(2.0, 0.0, 0.0));
        let plane = |domain: &Domain, cell: usize| {
            let (row, col) = domain.lattice_vertex(cell);
            let [x, y] = domain.lattice().position(row, col);
            5.0 * x - 3.0 * y + 1.0
        };
        for cell in coarse.domain.active().cells() {
            state.z[cell] = plane(&coarse.domain, cell);
        }
        for cell in coarse.domain.interior().cells() {
            state.set_matrices(cell, dual, hessian);
        }
        let carried = prolong(&coarse, &state, &fine, 0.2).unwrap();
        let mut checked = 0;
        for cell in fine.domain.interior().cells() {
            let (row, col) = fine.domain.lattice_vertex(cell);
            if (3..14).contains(&row) && (3..14).contains(&col) {
                let (y, h) = carried.matrices(cell);
                assert!((y - dual).dot(y - dual) < 1e-24, "{row} {col}: {y:?}");
                assert!((h - hessian).dot(h - hessian) < 1e-24, "{row} {col}: {h:?}");
                assert!((carried.z[cell] - plane(&fine.domain, cell)).abs() < 1e-12);
                checked += 1;
            }
        }
        assert_eq!(checked, 121);
    }

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
        let coarse = coarsen(&Heightfield::from_fn(lattice, plane).unwrap()).unwrap();
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
