//! Prolongation: the first iterate on a multigrid level from the last one of the next coarser level.
//!
//! The dual is bounded by 1 at every resolution, so `Y` and `H` are carried over unscaled. `z` is interpolated
//! linearly, which keeps creases; `Y` by the smoother weights of Loop's subdivision surfaces, because every kink of
//! `Y` would be a residual.

use super::heightfields::{Iterate, Problem};
use crate::error::Result;
use crate::lattice::coarsening::parents;
use crate::lattice::domain::{Domain, Role};
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
    fork::for_each(&mut states, |band, (z, matrices)| {
        for row in bands.rows(band, domain.rows()) {
            let sources = [0, 1].map(|col| {
                Sources::new(&coarse.operator.domain, parents(top + row - 1, left + col))
            });
            for run in domain.active().row(row) {
                let z = z.run_mut(*run);
                let mut matrices = matrices.run(*run);
                for (k, i) in (run.start..run.end).enumerate() {
                    let col = i - row * domain.stride() - 1;
                    let sources = &sources[col % 2];
                    let cell =
                        |offset: isize| sources.cell(col / 2, offset, &coarse.operator.domain);
                    let (a, b) = (cell(0), cell(sources.other));
                    if let (Some(a), Some(b)) = (a, b)
                        && roles[a].is_active()
                        && roles[b].is_active()
                    {
                        z[k] = 0.5 * (from.z[a] + from.z[b]);
                    }
                    if domain.roles()[i] == Role::Interior {
                        let (mut sum, mut total) = (Sym2::default(), 0.0);
                        for (offset, weight) in &sources.weights {
                            if let Some(cell) = cell(*offset)
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

/// Coarse cells from which every other fine vertex of a row is interpolated, as offsets that are the same for all of
/// them.
struct Sources {
    /// Coarse cell of the first parent of the first vertex of the row, counted as if the coarse box were wide enough.
    /// (Parents of a fine vertex are the two coarse vertices that it lies between.)
    first: isize,
    /// Column of the coarse cell [`Self::first`] in the padded coarse box.
    col: isize,
    /// Offset from the first parent to the second one, in coarse cells.
    other: isize,
    /// Offsets from the first parent to all coarse cells that `V = Y + ρH` is interpolated from, with their weights.
    weights: Vec<(isize, f64)>,
}

impl Sources {
    fn new(coarse: &Domain, [a, b]: [(isize, isize); 2]) -> Self {
        let stride = coarse.stride() as isize;
        let offset = |(row, col): (isize, isize)| (row - a.0) * stride + col - a.1;
        let (row, col) = (
            a.0 - coarse.corner().0 as isize + 1,
            a.1 - coarse.corner().1 as isize + 1,
        );
        Sources {
            first: row * stride + col,
            col,
            other: offset(b),
            weights: loop_weights(a, b)
                .map(|(v, weight)| (offset(v), weight))
                .collect(),
        }
    }

    /// Returns the coarse cell at an offset from the first parent of the row's `k`-th vertex, if it is in the coarse
    /// box. Offsets lead no further than to a neighbour, so that those out of the box end in its padding.
    fn cell(&self, k: usize, offset: isize, coarse: &Domain) -> Option<usize> {
        let inside = (0..coarse.stride() as isize).contains(&(self.col + k as isize));
        let cell = usize::try_from(self.first + k as isize + offset).ok()?;
        (inside && cell < coarse.cells()).then_some(cell)
    }
}

/// Returns coarse vertices and weights of Loop's subdivision (1987) for the fine vertex between `a` and `b`: a coarse
/// vertex itself and its neighbours if both are the same, else the ends of an edge and the vertices opposite.
fn loop_weights(
    a: (isize, isize),
    b: (isize, isize),
) -> impl Iterator<Item = ((isize, isize), f64)> {
    let around = |(row, col)| NEIGHBOUR_DIRECTIONS.map(|t: Towards| t.step(row, col));
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
    use crate::{Heightfield, Input, Lattice, Options};

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
