//! Extrapolated heights of omitted vertices, which are not part of the solve (paper, Sec. 4.1 and Fig. 9).

use std::collections::VecDeque;

use super::input::Input;
use crate::lattice::domain::{Domain, Role};
use crate::lattice::stencil::Quadratic;

/// Gives every omitted vertex the value of the best-fit quadratic of an interior vertex near it: the nearest one among
/// those that its neighbours have taken, in a search that spreads from the interior over valid vertices. Where none is
/// within reach, as on an island without interior vertices or far out on a thin strip, the input's own height stays, if
/// there is one. Linear cost.
pub(crate) fn extrapolate_omitted(domain: &Domain, input: &Input, heights: &mut [f64]) {
    if domain.omitted_len() == 0 {
        return;
    }
    let lattice = domain.lattice();
    let roles = domain.roles();
    let stride = domain.stride();
    // In spacings, whose squares neither over- nor underflow.
    let position = |cell: usize| {
        let (row, col) = domain.lattice_vertex(cell);
        lattice.position(row, col).map(|x| x / lattice.spacing())
    };
    let distance = |a: usize, b: usize| {
        let ([ax, ay], [bx, by]) = (position(a), position(b));
        (ax - bx).powi(2) + (ay - by).powi(2)
    };

    /// Marks a vertex that no quadratic has reached.
    const NO_SOURCE: usize = usize::MAX;
    /// Maximum distance from its vertex at which a quadratic is evaluated, in spacings: further out its error exceeds
    /// that of the input's own height.
    const QUADRATIC_REACH_SPACINGS: f64 = 4.0;
    let reach = QUADRATIC_REACH_SPACINGS * QUADRATIC_REACH_SPACINGS;
    let mut source = vec![NO_SOURCE; domain.cells()];
    let mut queue = VecDeque::new();
    for cell in domain.interior().cells() {
        source[cell] = cell;
    }
    // Every boundary vertex touches an interior one, so the search starts there.
    for cell in domain.active().cells() {
        if roles[cell] == Role::Boundary {
            queue.push_back(cell);
        }
    }
    while let Some(cell) = queue.pop_front() {
        for offset in domain.neighbour_offsets(cell / stride) {
            let neighbour = cell.wrapping_add_signed(offset);
            let candidate = source[neighbour];
            if candidate != NO_SOURCE
                && (source[cell] == NO_SOURCE
                    || distance(cell, candidate) < distance(cell, source[cell]))
            {
                source[cell] = candidate;
            }
        }
        for offset in domain.neighbour_offsets(cell / stride) {
            let neighbour = cell.wrapping_add_signed(offset);
            if roles[neighbour] == Role::Omitted && source[neighbour] == NO_SOURCE {
                // Claimed now so that it is queued once; improved when its turn comes.
                source[neighbour] = source[cell];
                queue.push_back(neighbour);
            }
        }
    }

    let own = |index: usize| {
        if input.is_given(index) {
            input.field.heights()[index]
        } else {
            f64::NAN
        }
    };
    for cell in (0..domain.cells()).filter(|cell| roles[*cell] == Role::Omitted) {
        let index = domain.lattice_index(cell);
        heights[index] = match source[cell] {
            NO_SOURCE => own(index),
            from if distance(cell, from) > reach => own(index),
            from => {
                let ring = domain
                    .neighbour_offsets(from / stride)
                    .map(|o| heights[domain.lattice_index(from.wrapping_add_signed(o))]);
                let centre = heights[domain.lattice_index(from)];
                let ([x, y], [x0, y0]) = (position(cell), position(from));
                let z = Quadratic::fit(centre, ring, 1.0).at([x - x0, y - y0]);
                if z.is_finite() { z } else { own(index) }
            }
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::heights::heightfield::Heightfield;
    use crate::lattice::hexagonal::Lattice;

    #[test]
    fn a_quadratic_is_continued_exactly_and_far_islands_keep_their_heights() {
        let lattice = Lattice::new(12, 20, 0.5).unwrap();
        let truth = |x: f64, y: f64| 0.3 * x * x - 0.2 * x * y + 0.1 * y * y + x - 2.0 * y + 3.0;
        let field = Heightfield::from_fn(lattice, truth).unwrap();
        let mut heights = field.heights().to_vec();
        for row in 0..12 {
            for col in 0..20 {
                let body = col < 9;
                let tail = (9..13).contains(&col) && row == 5;
                let island = row < 2 && col > 17;
                if !(body || tail || island) {
                    heights[lattice.index(row, col)] = f64::NAN;
                }
            }
        }
        let field = Heightfield::new(lattice, heights).unwrap();
        let domain = Domain::new(&field).unwrap();
        assert!(domain.omitted_len() >= 8);
        let mut restored: Vec<f64> = (0..lattice.len())
            .map(|i| {
                let role = domain.role(i / 20, i % 20);
                if role.is_active() {
                    field.heights()[i]
                } else {
                    f64::NAN
                }
            })
            .collect();
        extrapolate_omitted(&domain, &field.clone().into(), &mut restored);
        for (i, (a, b)) in restored.iter().zip(field.heights()).enumerate() {
            assert_eq!(a.is_nan(), b.is_nan(), "vertex {i}");
            assert!(
                b.is_nan() || (a - b).abs() < 1e-9,
                "vertex {i}: {a} for {b}"
            );
        }
    }
}
