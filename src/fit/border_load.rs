//! Which moments load the border of a heightfield.

use super::energy::load::bearing;
use super::heightfields::{Problem, State};
use crate::error::{Result, try_filled};
use crate::lattice::domain::Role;
use crate::math::sym2::Sym2;

/// Loads the border with the moments inside, from there to the border continued along the shortest ways.
/// Says whether there are any.
///
/// # Errors
/// Out of memory.
pub(super) fn load_border(
    problem: &mut Problem,
    state: &mut State,
    bend_radius: f64,
) -> Result<bool> {
    // Where next to nothing holds a vertex, a load would move it without end.
    if problem.loose {
        return Ok(false);
    }
    let domain = problem.operator.domain.clone();
    let roles = domain.roles();
    let around = |cell: usize| {
        domain
            .neighbour_offsets(cell / domain.stride())
            .map(|offset| cell.wrapping_add_signed(offset))
    };
    let inside = |cell: usize| roles[cell] == Role::Interior;
    let reach = problem.reach(bend_radius);
    let mut depth = try_filled("border", domain.cells(), u32::MAX)?;
    let mut rings: Vec<Vec<u32>> = Vec::new();
    let rim = domain.interior().cells();
    let mut front: Vec<u32> = rim
        .filter(|cell| !around(*cell).into_iter().all(inside))
        .map(|cell| cell as u32)
        .collect();
    front.iter().for_each(|cell| depth[*cell as usize] = 0);
    while !front.is_empty() && (rings.len() as u32) < reach {
        let ring = rings.len() as u32 + 1;
        let mut next = Vec::new();
        for cell in &front {
            for other in around(*cell as usize) {
                if inside(other) && depth[other] == u32::MAX {
                    depth[other] = ring;
                    next.push(other as u32);
                }
            }
        }
        rings.push(std::mem::replace(&mut front, next));
    }
    let mut moments = try_filled("moments", domain.cells(), Sym2::default())?;
    let mut bends = moments.clone();
    let mut known = try_filled("moments", domain.cells(), false)?;
    let mut any = false;
    for cell in domain.interior().cells() {
        if depth[cell] >= reach {
            let (dual, hessian) = state.matrices(problem, cell);
            (moments[cell], bends[cell]) = (bearing(dual, hessian), hessian);
            known[cell] = true;
            any |= moments[cell] != Sym2::default();
        }
    }
    for ring in rings.iter().rev() {
        for cell in ring {
            let cell = *cell as usize;
            let (mut sum, mut bend, mut count) = (Sym2::default(), Sym2::default(), 0.0);
            for other in around(cell) {
                if inside(other) && depth[other] > depth[cell] && known[other] {
                    sum = sum + moments[other];
                    bend = bend + bends[other];
                    count += 1.0;
                }
            }
            if count > 0.0 {
                moments[cell] = sum.scale(1.0 / count);
                bends[cell] = bend.scale(1.0 / count);
                state.set_matrices(cell, moments[cell], bends[cell]);
                known[cell] = true;
            }
        }
    }
    if any {
        problem.load(&moments, |vertex| {
            !inside(vertex) || !around(vertex).into_iter().all(inside)
        })?;
    }
    Ok(any)
}
