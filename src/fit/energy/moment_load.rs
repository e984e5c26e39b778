//! Bending moments on the border as a load, such as the surface would exert if it continued beyond it.
//!
//! A free border bears no bending moment, while a bend inside does (`Y`, the dual). So the smallest energy
//! straightens a bent sheet along its border, over a length of about `(2/δλ)^¼`. The moments inside, continued
//! to the border and applied there, undo this: where they are alike everywhere, `CᵀY` is nothing but the load,
//! and a sheet that was measured without noise stays where it is. A load is linear in the heights, so that it
//! only moves the target: each problem stays convex, with a certificate of its own.

use std::ops::{Add, Mul, Range};

use super::problem::Problem;
use crate::error::{Result, try_filled};
use crate::fit::operator::{Matrices, Operator, Sums};
use crate::math::fork;
use crate::math::sym2::Sym2;

/// Distance from the border beyond which bending moments count as undisturbed by it, in lengths `(2/δλ)^¼` over which a
/// free border straightens (`benches/whole.md`).
const BORDER_REACH_LENGTHS: f64 = 2.3;

/// Maximum moment of a load, as a share of the largest moment that a stencil can bear, its penalty weight `ω`: a larger
/// one would fold the sheet along its border without limit (`benches/whole.md`).
const MAX_LOAD_MOMENT: f64 = 0.6;

/// Number of vertices whose moments are smoothed by one thread at a time.
const SMOOTHING_PIECE_VERTICES: usize = 4096;

/// Vertices near the border in rings: the border vertices, their neighbours, and so on.
pub(crate) struct Rings {
    /// The vertices of each ring, from the border inwards: `reach` rings whose moments the border disturbs, and as many
    /// beyond.
    rings: Vec<Vec<u32>>,
    /// Number of the ring that each vertex is in, or `u32::MAX` if it is in none.
    depth: Vec<u32>,
    /// Number of rings from the border to the vertices whose bending moments the border does not disturb.
    reach: u32,
}

impl Rings {
    /// Collects rings from the `outermost` vertices inwards. `vertices` is the number of all vertices, `around` gives
    /// the neighbours of one.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn new<I: Iterator<Item = usize>>(
        outermost: Vec<u32>,
        vertices: usize,
        around: impl Fn(usize) -> I,
        reach: u32,
    ) -> Result<Self> {
        let mut depth = try_filled("border", vertices, u32::MAX)?;
        outermost.iter().for_each(|v| depth[*v as usize] = 0);
        let mut rings = Vec::new();
        let mut front = outermost;
        while !front.is_empty() && (rings.len() as u32) < 2 * reach {
            let mut next = Vec::new();
            for other in front.iter().flat_map(|vertex| around(*vertex as usize)) {
                if depth[other] == u32::MAX {
                    depth[other] = rings.len() as u32 + 1;
                    next.push(other as u32);
                }
            }
            rings.push(std::mem::replace(&mut front, next));
        }
        Ok(Rings {
            rings,
            depth,
            reach,
        })
    }

    /// Returns whether a vertex is in one of the rings.
    pub(crate) fn contain(&self, vertex: usize) -> bool {
        // An operator may have room for more vertices than there are.
        self.depth
            .get(vertex)
            .is_some_and(|depth| *depth != u32::MAX)
    }

    /// Returns whether a vertex is in one of the outermost rings, up to the ring of this number.
    pub(crate) fn are_within(&self, vertex: usize, rings: u32) -> bool {
        self.contain(vertex) && self.depth[vertex] <= rings
    }

    /// Smooths the values beyond `reach` rings until hardly any noise is left, and continues them to the border along
    /// the shortest paths; returns whether any vertex is that far inside.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn continue_outwards<M, I>(
        &self,
        values: &mut [M],
        around: impl Fn(usize) -> I + Sync,
    ) -> Result<bool>
    where
        M: Copy + Default + Add<Output = M> + Mul<f64, Output = M> + Send + Sync,
        I: Iterator<Item = usize>,
    {
        // Mean over the neighbours in a range of rings and `own` copies of the vertex itself.
        let mean = |values: &[M], vertex: usize, rings: Range<u32>, own: f64| {
            let start = (values[vertex] * own, own);
            let others = around(vertex).filter(|other| rings.contains(&self.depth[*other]));
            let (sum, count) = others.fold(start, |(sum, count), other| {
                (sum + values[other], count + 1.0)
            });
            // In a part that is too narrow no path leads inside.
            if count > 0.0 {
                sum * (1.0 / count)
            } else {
                M::default()
            }
        };
        let (reach, edge) = (self.reach as usize, 2 * self.reach);
        let inside: Vec<u32> = self.rings.iter().skip(reach).flatten().copied().collect();
        if inside.is_empty() {
            return Ok(false);
        }
        let mut means = try_filled("moments", inside.len(), M::default())?;
        for _ in 0..reach {
            let old = &*values;
            let vertices = inside.chunks(SMOOTHING_PIECE_VERTICES);
            let pieces = vertices.zip(means.chunks_mut(SMOOTHING_PIECE_VERTICES));
            fork::for_each(&mut pieces.collect::<Vec<_>>(), |_, (vertices, means)| {
                for (vertex, to) in vertices.iter().zip(means.iter_mut()) {
                    *to = mean(old, *vertex as usize, self.reach..edge, 2.0);
                }
            });
            for (vertex, from) in inside.iter().zip(&means) {
                values[*vertex as usize] = *from;
            }
        }
        for (depth, ring) in self.rings.iter().enumerate().take(reach).rev() {
            for vertex in ring {
                let vertex = *vertex as usize;
                values[vertex] = M::default();
                values[vertex] = mean(values, vertex, depth as u32 + 1..edge, 0.0);
            }
        }
        Ok(true)
    }
}

impl<O: Operator> Problem<O> {
    /// Returns the number of rings from the border to the vertices whose bending moments the border does not disturb.
    /// `bend_radius` is `1/δ`.
    pub(crate) fn reach(&self, bend_radius: f64) -> u32 {
        let length = (2.0 * bend_radius / self.lambda).powf(0.25);
        ((BORDER_REACH_LENGTHS * length / self.operator.spacing()).ceil()).clamp(2.0, 1e6) as u32
    }

    /// Loads the vertices that are `near` the border with the bending `moments` of all stencils, each limited to what
    /// its stencil can bear. The load changes the problem's target heights and offset.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn load(&mut self, moments: &[Sym2], near: impl Fn(usize) -> bool) -> Result<()> {
        let operator = &self.operator;
        let mut load = try_filled("load", operator.vertex_cells(), 0.0)?;
        let mut scratch = operator.scratch::<f64>()?;
        operator.sweep(
            &mut scratch,
            &self.target,
            &mut operator.bands().split(&mut load).collect::<Vec<_>>(),
            |_, run, _, mut to| {
                for (i, stencil) in (run.start..run.end).enumerate() {
                    let most = MAX_LOAD_MOMENT * self.weight.at(stencil);
                    let moment = moments[stencil];
                    let share = most / moment.spectral_norm().max(most);
                    to.set(i, moment.scale(share).coordinates());
                }
            },
            |load, run, sums| {
                for (i, load) in load.run_mut(run).iter_mut().enumerate() {
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

/// Returns the part of a stencil's `dual` that bears a bend, in the direction of the larger curvature of its `hessian`.
/// A pure bend leaves no other part.
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

    #[test]
    fn values_inside_go_on_to_the_border() {
        // A row of vertices, of which the first and the last have no stencil.
        let around = |vertex: usize| {
            [vertex.wrapping_sub(1), vertex + 1]
                .into_iter()
                .filter(|v| *v < 21)
        };
        let continued = |reach: u32| {
            let rings = Rings::new(vec![0, 20], 21, around, reach).unwrap();
            let mut values: Vec<f64> = (0..21).map(|v| if v < 10 { 2.0 } else { 5.0 }).collect();
            values[0] = f64::NAN;
            values[1] = 100.0;
            let any = rings.continue_outwards(&mut values, around).unwrap();
            (any, values)
        };
        let (any, values) = continued(3);
        assert!(any);
        assert_eq!(
            [values[0], values[1], values[3], values[20]],
            [2.0, 2.0, 2.0, 5.0]
        );
        // Nothing is as deep as that.
        assert!(!continued(11).0);
    }
}
