//! Reweighting passes at creases: the penalty's weight is reduced where the surface bends too sharply to be smooth.
//!
//! With the weight `ω = T/s̄` beyond a curvature `T`, passes one after the other lower a penalty that grows
//! like a logarithm there (Candès, Wakin and Boyd, *Enhancing Sparsity by Reweighted ℓ₁ Minimization*, 2008),
//! so that creases keep their angle. Each pass is a convex problem of its own.

use super::problem::Problem;
use crate::error::Result;
use crate::fit::operator::Operator;
use crate::lattice::per_cell::PerCell;

/// Minimum penalty weight of a stencil on a crease, relative to a smooth stencil's: keeps the problem well conditioned
/// (`benches/choices.md`, One constant at a time).
const MIN_CREASE_WEIGHT: f64 = 0.05;

/// Penalty weight of a stencil on a crease between regions that are known to be smooth, relative to a smooth stencil's
/// (`benches/whole.md`).
const KNOWN_CREASE_WEIGHT: f64 = 0.01;

/// Stencils on creases in one reweighting pass.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Creases {
    /// Number of stencils with a penalty weight below 1.
    pub vertices: usize,
    /// Whether the penalty weight of any stencil has changed, so that another solve differs from the last one.
    pub changed: bool,
}

impl<O: Operator> Problem<O> {
    /// Sets the penalty weights `ω = min(1, T/s̄)`, where `s̄` is `‖Cz‖_*` averaged once with the neighbours. `radius` is
    /// `1/T`, in normalised coordinates: a bend of a smaller radius counts as a crease.
    pub(crate) fn reweight_creases(&mut self, z: &[f64], radius: f64) -> Result<Creases> {
        let mut weights = self.norms(z)?;
        self.operator.spread(&mut weights);
        let mut creases = Creases::default();
        for stencil in self.operator.stencils().cells() {
            let sharpness = radius * weights[stencil];
            let weight = if sharpness > 1.0 {
                (1.0 / sharpness).max(MIN_CREASE_WEIGHT)
            } else {
                1.0
            };
            creases.vertices += usize::from(weight < 1.0);
            creases.changed |= weight != self.weight.at(stencil);
            weights[stencil] = weight;
        }
        if creases.changed {
            self.weight = PerCell::Each(weights);
        }
        Ok(creases)
    }

    /// Takes nearly all of the penalty weight from stencils on creases that are `known`, and returns how many of these
    /// had weight 1 before. A weight by curvature leaves much of it where the mesh is coarse, because a crease is not
    /// much sharper than a bend there; that would round the crease and push the surface beside it outwards.
    pub(crate) fn free_creases(&mut self, known: &[bool]) -> usize {
        let mut found = 0;
        let weights = known.iter().enumerate().map(|(stencil, known)| {
            let weight = self.weight.at(stencil);
            found += usize::from(*known && weight == 1.0);
            match known {
                true => weight.min(KNOWN_CREASE_WEIGHT),
                false => weight,
            }
        });
        self.weight = PerCell::Each(weights.collect());
        found
    }
}
