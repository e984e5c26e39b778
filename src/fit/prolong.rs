//! Prolongation: the first iterate on a multigrid level from the last one of the next coarser level.
//!
//! The dual is bounded by 1 at every resolution, so `Y` and `H` are carried over unscaled. `z` is interpolated
//! linearly, which keeps creases; `Y` by the smoother weights of Loop's subdivision surfaces, because every kink of
//! `Y` would be a residual.

use super::heightfields::{Iterate, Problem};
use crate::error::Result;
use crate::lattice::coarsening::parents;
use crate::lattice::domain::Role;
use crate::lattice::hexagonal::{NEIGHBOUR_DIRECTIONS, Towards};
use crate::math::fork;
use crate::math::sym2::Sym2;

/// Makes an iterate on the fine lattice by interpolation of one on the coarse lattice. A fine vertex without coarse
/// vertices to interpolate, as on islands and between holes too small for the coarse lattice, starts from the input.
pub(crate) fn prolong(
    coarse: &Problem,
    from: &Iterate,
    fine: &Problem,
    rho: f64,
) -> Result<Iterate> {
    let mut iterate = Iterate::new(fine, rho)?;
    // At the same ρ, `V` is linear in `Y` and `H`.
    let v = from.v_with_rho(coarse, rho)?;
    let roles = coarse.operator.domain.roles();
    let domain = &fine.operator.domain;
    let (top, left) = domain.corner();
    let bands = domain.bands();
    let matrices = iterate.v.split(bands);
    let mut states: Vec<_> = bands.split(&mut iterate.z).zip(matrices).collect();
    let below = &*coarse.operator.domain;
    fork::for_each(&mut states, |band, (z, matrices)| {
        for row in bands.rows(band, domain.rows()) {
            // Every other vertex of a row has the same sources, relative to its first parent.
            let sources = [0, 1].map(|col| loop_weights(parents(top + row - 1, left + col)));
            for run in domain.active().row(row) {
                let z = z.run_mut(*run);
                let mut matrices = matrices.run(*run);
                for (k, i) in (run.start..run.end).enumerate() {
                    let col = i - row * domain.stride() - 1;
                    let [a, b] = parents(top + row - 1, left + col);
                    if let [Some(a), Some(b)] = [a, b].map(|vertex| below.cell(vertex))
                        && roles[a].is_active()
                        && roles[b].is_active()
                    {
                        z[k] = 0.5 * (from.z[a] + from.z[b]);
                    }
                    if domain.roles()[i] == Role::Interior {
                        let (mut sum, mut total) = (Sym2::default(), 0.0);
                        for ([down, right], weight) in &sources[col % 2] {
                            if let Some(cell) = below.cell((a.0 + down, a.1 + right))
                                && roles[cell] == Role::Interior
                            {
                                sum = sum + v.get(cell).scale(*weight);
                                total += weight;
                            }
                        }
                        if total > 0.0 {
                            matrices.set(k, sum.scale(1.0 / total));
                        }
                    }
                }
            }
        }
    });
    for cell in &fine.constrained {
        iterate.z[*cell as usize] = fine.target[*cell as usize];
    }
    Ok(iterate)
}

/// Returns the coarse vertices and weights of Loop's subdivision (1987) for the fine vertex between `a` and `b`, as offsets from `a`
/// in rows and columns: a coarse vertex itself and its neighbours if both are the same, else the ends of an edge and the vertices
/// opposite.
fn loop_weights([a, b]: [(isize, isize); 2]) -> Vec<([isize; 2], f64)> {
    let around = |(row, col)| NEIGHBOUR_DIRECTIONS.map(|t: Towards| t.step(row, col));
    let end = if a == b { 5.0 } else { 3.0 };
    let shared = around(b);
    let far = around(a).into_iter().filter(|v| shared.contains(v));
    let all = [(a, end), (b, end)].into_iter();
    all.chain(far.map(|vertex| (vertex, 1.0)))
        .map(|((row, col), weight)| ([row - a.0, col - a.1], weight))
        .collect()
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
        let options = Options::paper().lambda(1e3);
        let [fine, coarse] = [(&field, &domains[0]), (&coarse_field, &domains[1])]
            .map(|(f, d)| Problem::new(f, d.clone(), &coordinates, &options).unwrap());
        let mut iterate = Iterate::new(&coarse, 0.4).unwrap();
        let (dual, hessian) = (Sym2::new(1.0, 0.0, 0.3), Sym2::new(2.0, 0.0, 0.0));
        let plane = |domain: &Domain, cell: usize| {
            let (row, col) = domain.lattice_vertex(cell);
            let [x, y] = domain.lattice().position(row, col);
            5.0 * x - 3.0 * y + 1.0
        };
        for cell in coarse.operator.domain.active().cells() {
            iterate.z[cell] = plane(&coarse.operator.domain, cell);
        }
        for cell in coarse.operator.domain.interior().cells() {
            iterate.set_matrices(cell, dual, hessian);
        }
        let carried = prolong(&coarse, &iterate, &fine, 0.2).unwrap();
        let mut checked = 0;
        for cell in fine.operator.domain.interior().cells() {
            let (row, col) = fine.operator.domain.lattice_vertex(cell);
            if (3..14).contains(&row) && (3..14).contains(&col) {
                let (y, h) = carried.matrices(&fine, cell);
                assert!((y - dual).dot(y - dual) < 1e-24, "{row} {col}: {y:?}");
                assert!((h - hessian).dot(h - hessian) < 1e-24, "{row} {col}: {h:?}");
                assert!((carried.z[cell] - plane(&fine.operator.domain, cell)).abs() < 1e-12);
                checked += 1;
            }
        }
        assert_eq!(checked, 121);
    }
}
