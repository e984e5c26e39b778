//! Load of bending moments on the border of a heightfield, continued from the vertices inside (see
//! [`energy::moment_load`](crate::fit::energy::moment_load)).

use super::energy::moment_load::{Rings, bearing};
use super::heightfields::{Iterate, Problem};
use crate::error::{Result, try_filled};
use crate::lattice::domain::Role;
use crate::math::fork;
use crate::math::sym2::Sym2;

/// Loads the border with the bending moments of the vertices inside, and returns whether there are any. `bend_radius`
/// is that of the Huber penalty, in normalised coordinates.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn load_border(
    problem: &mut Problem,
    iterate: &Iterate,
    bend_radius: f64,
) -> Result<bool> {
    // Where next to nothing holds a vertex, a load would move it without end.
    if problem.has_weak_fidelity {
        return Ok(false);
    }
    let domain = problem.operator.domain.clone();
    let roles = domain.roles();
    let around = |cell: usize| {
        let offsets = domain.neighbour_offsets(cell / domain.stride());
        let neighbours = offsets.map(|offset| cell.wrapping_add_signed(offset));
        let active = |cell: &usize| roles.get(*cell).is_some_and(|role| role.is_active());
        neighbours.into_iter().filter(active)
    };
    let outermost = domain.active().cells();
    let outermost = outermost.filter(|cell| roles[*cell] == Role::Boundary);
    let outermost = outermost.map(|cell| cell as u32).collect();
    let rings = Rings::new(
        outermost,
        domain.cells(),
        around,
        problem.reach(bend_radius),
    )?;
    let mut moments = try_filled("moments", domain.cells(), Sym2::default())?;
    let bands = domain.bands();
    let mut states: Vec<_> = bands.split(&mut moments).collect();
    let from = &*problem;
    fork::for_each(&mut states, |band, moments| {
        for run in bands.runs(domain.interior(), band) {
            for (cell, moment) in (run.start..).zip(moments.run_mut(*run)) {
                let (dual, hessian) = iterate.matrices(from, cell);
                *moment = bearing(dual, hessian);
            }
        }
    });
    if !rings.continue_outwards(&mut moments, around)? {
        return Ok(false);
    }
    problem.load(&moments, |vertex| rings.are_within(vertex, 1))?;
    Ok(true)
}
