//! Coarse to fine: an iterate of the lattice of twice the spacing is a good start.
//!
//! The dual is bounded by 1 whatever the resolution, so `Y` and `H` carry over as they are. `z` is
//! interpolated linearly, which keeps creases; `Y` more smoothly, by the rules of Loop's subdivision
//! surfaces, for every kink of it is a residual.

use super::admm::state::State;
use super::energy::problem::Problem;
use crate::error::Result;
use crate::lattice::coarsening::parents;
use crate::lattice::domain::Role;
use crate::lattice::hexagonal::{NEIGHBOURS, Towards};
use crate::math::sym2::Sym2;

/// An iterate on the fine lattice from one on the coarse lattice. Where a fine
/// vertex has no coarse vertex to take from, as on islands and between holes
/// that are too small for the coarse lattice, it starts from the input.
pub(crate) fn prolong(coarse: &Problem, from: &State, fine: &Problem, rho: f64) -> Result<State> {
    let mut state = State::new(fine, rho)?;
    // At the same ρ, `V` is linear in `Y` and `H`.
    let v = from.v_at(coarse, rho)?;
    let active = |vertex| coarse.domain.cell_of(vertex, Role::is_active);
    let interior = |vertex| coarse.domain.cell_of(vertex, |role| role == Role::Interior);
    for i in fine.domain.active().cells() {
        let (row, col) = fine.domain.lattice_vertex(i);
        let [a, b] = parents(row, col);
        if let (Some(a), Some(b)) = (active(a), active(b)) {
            state.z[i] = 0.5 * (from.z[a] + from.z[b]);
        }
        if fine.domain.roles()[i] == Role::Interior {
            let (mut sum, mut total) = (Sym2::default(), 0.0);
            for (vertex, weight) in loop_weights(a, b) {
                if let Some(cell) = interior(vertex) {
                    sum = sum + v.get(cell).scale(weight);
                    total += weight;
                }
            }
            if total > 0.0 {
                state.v.set(i, sum.scale(1.0 / total));
            }
        }
    }
    for cell in &fine.constrained {
        state.z[*cell as usize] = fine.target[*cell as usize];
    }
    Ok(state)
}

/// Coarse vertices that a fine one between `a` and `b` takes from, and their weights (Loop 1987):
/// of a coarse vertex itself and its neighbours, or of an edge's ends and the vertices opposite.
fn loop_weights(
    a: (isize, isize),
    b: (isize, isize),
) -> impl Iterator<Item = ((isize, isize), f64)> {
    let around = |(row, col)| NEIGHBOURS.map(|t: Towards| t.step(row, col));
    let end = if a == b { 5.0 } else { 3.0 };
    let shared = around(b);
    let far = around(a).into_iter().filter(move |v| shared.contains(v));
    [(a, end), (b, end)]
        .into_iter()
        .chain(far.map(|vertex| (vertex, 1.0)))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::fit::coarsen::coarsen;
    use crate::fit::coordinates::Coordinates;
    use crate::{Domain, Heightfield, Input, Lattice, Options};

    #[test]
    fn a_constant_dual_and_a_plane_carry_over_unchanged() {
        let lattice = Lattice::new(17, 18, 0.1).unwrap();
        // Bent, so that the best-fit plane that is taken away is not everything.
        let field = Heightfield::from_fn(lattice, |x, y| x * x + 0.3 * y).unwrap();
        let field = Input::new(field);
        let fine_domain = Domain::new(&field.field).unwrap();
        let coarse_field = coarsen(&field, &fine_domain).unwrap();
        let coarse_domain = coarse_field.domain().unwrap();
        let domains = [fine_domain, coarse_domain].map(Arc::new);
        let coordinates = Coordinates::new(&field, &domains[0], 1.0);
        let options = Options::default().lambda(1e3);
        let [fine, coarse] = [(&field, &domains[0]), (&coarse_field, &domains[1])]
            .map(|(f, d)| Problem::new(f, d.clone(), &coordinates, &options).unwrap());
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
                let (y, h) = carried.matrices(&fine, cell);
                assert!((y - dual).dot(y - dual) < 1e-24, "{row} {col}: {y:?}");
                assert!((h - hessian).dot(h - hessian) < 1e-24, "{row} {col}: {h:?}");
                assert!((carried.z[cell] - plane(&fine.domain, cell)).abs() < 1e-12);
                checked += 1;
            }
        }
        assert_eq!(checked, 121);
    }
}
