//! Moments that the surface would exert on its border if it went on beyond it, as a load.
//!
//! A free border bears no bending moment, while what bends inside does (`Y`, the dual). So the least energy
//! straightens a bent sheet along its border, over a length of about `(2/δλ)^¼`. The moments inside,
//! continued to the border and put on it, undo this: where they are the same all over, `CᵀY` is nothing but
//! the load, and a sheet that was measured without noise stays where it is. A load is linear in the heights
//! and so moves the target and nothing else: each problem stays convex, with a certificate of its own.

use super::problem::Problem;
use crate::error::{Result, try_filled};
use crate::fit::operator::{Matrices, Operator, Sums};
use crate::math::sym2::Sym2;

/// Of the length over which a border straightens: there the moments are those inside.
const REACH: f64 = 2.3;

impl<O: Operator> Problem<O> {
    /// From the border to where moments are those inside, in stencils.
    pub(crate) fn reach(&self, bend_radius: f64) -> u32 {
        let length = (2.0 * bend_radius / self.lambda).powf(0.25);
        // Spacings are at least as many as there are vertices from one end to the other.
        ((REACH * length / self.operator.spacing()).ceil()).clamp(2.0, 1e6) as u32
    }

    /// Loads the vertices that are `near` the border with `moments`, of all stencils.
    ///
    /// # Errors
    /// Out of memory.
    pub(crate) fn load(&mut self, moments: &[Sym2], near: impl Fn(usize) -> bool) -> Result<()> {
        let operator = &self.operator;
        let mut load = try_filled("load", operator.vertex_cells(), 0.0)?;
        let mut scratch = operator.scratch::<f64>()?;
        operator.sweep(
            &mut scratch,
            &self.target,
            &mut load,
            |_, run, _, mut to| {
                for (i, moment) in moments[run.start..run.end].iter().enumerate() {
                    to.set(i, moment.coordinates());
                }
            },
            |load, run, sums| {
                for (i, load) in load[run.start..run.end].iter_mut().enumerate() {
                    *load = sums.at(i);
                }
            },
        );
        for vertex in operator.vertices().cells() {
            if near(vertex) {
                let inverse = self.inverse_fidelity.at(vertex);
                let shift = inverse * load[vertex] / (2.0 * self.lambda);
                self.target[vertex] += shift;
                self.offset += 0.5 * load[vertex] * shift;
            }
        }
        Ok(())
    }
}

/// What bears the bend `hessian` of a `dual`: its part in the direction of the larger curvature. The other
/// part is nothing that a bend would leave.
pub(crate) fn bearing(dual: Sym2, hessian: Sym2) -> Sym2 {
    let [mean, diff, off] = hessian.coordinates();
    let radius = hessian.radius();
    if radius <= 0.0 {
        return Sym2::default();
    }
    let side = 0.5f64.copysign(mean) / radius;
    let along = Sym2::from_coordinates([0.5, side * diff, side * off]);
    along.scale(dual.dot(along))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_bears_a_bend_is_along_it() {
        let (cos, sin) = (0.6, 0.8);
        let along = Sym2::new(cos * cos, cos * sin, sin * sin);
        let across = Sym2::new(sin * sin, -cos * sin, cos * cos);
        for side in [1.0, -1.0] {
            let dual = along.scale(0.5 * side) + across.scale(0.3);
            let found = bearing(dual, along.scale(2.0 * side) + across.scale(0.01));
            let off = found - along.scale(0.5 * side);
            assert!(off.dot(off) < 1e-24, "{found:?}");
        }
        assert_eq!(bearing(along, Sym2::default()), Sym2::default());
    }
}
