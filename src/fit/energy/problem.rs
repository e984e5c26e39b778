//! The optimisation problem of a solve: the energy of heights under an operator `C`, in normalised coordinates.

use super::spectral_penalty::{AnyPenalty, PenaltyKind, SpectralPenalty};
use crate::error::{Result, try_filled};
use crate::fit::coordinates::Plane;
use crate::fit::operator::Operator;
use crate::fit::options::Energy;
use crate::lattice::per_cell::PerCell;
use crate::math::fork;

/// Nuclear norm of a Hessian, as a share of the mean norm, that counts as small when all stencils are reweighted: the ε
/// of the reweighting (`benches/choices.md`, One constant at a time).
const NEGLIGIBLE_NORM_SHARE: f64 = 0.3;

/// Minimum fidelity weight, in units of `1/(λh⁴)`, at which a vertex is fixed at its height: it would hardly move, and
/// fixing it costs less than a tenth, because the norm of one Hessian is of order 1 to 1/h
/// (`benches/choices.md`, One constant at a time).
const PINNED_FIDELITY: f64 = 1e3;

/// Fidelity weight of a vertex, as a share of the largest, below which it counts as weak
/// (`benches/choices.md`, One constant at a time).
const WEAK_FIDELITY_SHARE: f64 = 5e-3;

/// Largest possible fidelity, as a share of the input's penalty, below which constraints alone are said to hold the
/// surface (`benches/choices.md`, One constant at a time).
const NEGLIGIBLE_FIDELITY_SHARE: f64 = 0.1;

/// Rounding error of a Hessian's norm, in rounding errors of the largest height divided by the squared spacing: a norm
/// is a sum of about as many heights.
pub(crate) const HESSIAN_ROUNDING_UNITS: f64 = 16.0;

/// Number of times that Hessians' norms are averaged with their neighbours' before all stencils are reweighted
/// (`benches/choices.md`, One constant at a time).
const NORM_AVERAGING_STEPS: usize = 30;

/// Optimisation problem of a solve: to minimise the energy `P(z) = λ Σ w (z − z̃)² + Σ ω f(Cz)` (paper, Eq. 15), summed
/// over the operator's vertices and over its stencils, subject to `z = z̃` at constrained vertices.
#[derive(Debug, Clone)]
pub(crate) struct Problem<O> {
    /// Linear operator `C` from heights to Hessians.
    pub operator: O,
    pub lambda: f64,
    /// Input height `z̃` of each vertex; 0 in entries without a vertex.
    pub target: Vec<f64>,
    /// Energy that is subtracted from the objective, because loads on the border have added it by moving the target
    /// heights: a load does no work at the given heights.
    pub offset: f64,
    /// Weight `w` of each vertex's fidelity term.
    pub fidelity: PerCell<f64>,
    /// One over the fidelity weight `w` of each vertex, and 0 at constrained vertices.
    pub inverse_fidelity: PerCell<f64>,
    /// Vertices that keep their given height exactly.
    pub constrained: Vec<u32>,
    /// Vertices with neither constraint nor given height; a tiny fidelity weight makes their heights unique.
    pub free: Vec<u32>,
    /// Whether some vertices have hardly any fidelity weight, or constraints alone hold the surface, so that `CᵀY` must
    /// all but vanish there for a useful dual bound.
    pub has_weak_fidelity: bool,
    pub kind: PenaltyKind,
    /// Weight `ω` of each stencil's penalty.
    pub weight: PerCell<f64>,
    /// Weight `ω` of each stencil's penalty before any reweighting.
    first_weight: PerCell<f64>,
    /// Objective below which nothing but rounding errors is left.
    pub rounding: f64,
}

impl<O: Operator> Problem<O> {
    /// Makes a problem with all weights 1 and without constraints.
    pub(crate) fn unweighted(
        operator: O,
        lambda: f64,
        target: Vec<f64>,
        kind: PenaltyKind,
    ) -> Self {
        let ones = || PerCell::same(operator.longest_run(), 1.0);
        Problem {
            lambda,
            target,
            offset: 0.0,
            fidelity: ones(),
            inverse_fidelity: ones(),
            constrained: Vec::new(),
            free: Vec::new(),
            has_weak_fidelity: false,
            kind,
            weight: ones(),
            first_weight: ones(),
            rounding: 0.0,
            operator,
        }
    }

    /// Sets the fidelity weights and the constraints of all vertices. A vertex of weight 0 is free, and `tie_break` is
    /// the product `λw` that it gets.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(crate) fn set_fidelity(
        &mut self,
        weight: impl Fn(usize) -> f64,
        is_constrained: impl Fn(usize) -> bool,
        tie_break: f64,
    ) -> Result<()> {
        let vertices = self.operator.vertices();
        let mut alike = true;
        for vertex in vertices.cells() {
            alike &= weight(vertex) == 1.0;
            if is_constrained(vertex) {
                self.constrained.push(vertex as u32);
            } else if weight(vertex) == 0.0 {
                self.free.push(vertex as u32);
            }
        }
        let constrained = !self.constrained.is_empty();
        if alike && !constrained {
            return Ok(());
        }
        // Next to given heights, the tie break weighs at most as much as their fidelity.
        let mixed = self.free.len() + self.constrained.len() < vertices.len();
        let most = if mixed { 1.0 } else { f64::INFINITY };
        let tie_break = (tie_break / self.lambda).min(most);
        let values = || try_filled("fidelity", self.operator.vertex_cells(), 0.0);
        let (mut fidelity, mut inverse) = (values()?, values()?);
        for vertex in vertices.cells() {
            let weight = match weight(vertex) {
                0.0 => tie_break,
                weight => weight,
            };
            let constrained = is_constrained(vertex);
            fidelity[vertex] = if constrained { 1.0 } else { weight };
            inverse[vertex] = if constrained { 0.0 } else { 1.0 / weight };
        }
        let largest = vertices.cells().fold(0.0f64, |m, v| m.max(fidelity[v]));
        let weak = |vertex: usize| fidelity[vertex] < WEAK_FIDELITY_SHARE * largest;
        self.has_weak_fidelity = !self.free.is_empty() || vertices.cells().any(weak);
        if self.has_weak_fidelity {
            // The rounding errors of firmly held vertices would exceed all else. Their share of the bound stays.
            let firm = PINNED_FIDELITY / (self.lambda * self.operator.spacing().powi(4));
            let firm = |vertex: &usize| fidelity[*vertex] >= firm && inverse[*vertex] > 0.0;
            let firm = vertices.cells().filter(firm);
            self.constrained.extend(firm.map(|vertex| vertex as u32));
        }
        self.fidelity = PerCell::Each(fidelity);
        self.inverse_fidelity = PerCell::Each(inverse);
        self.has_weak_fidelity |= constrained && self.is_held_by_constraints();
        Ok(())
    }

    /// Returns whether constraints alone hold the surface: the largest possible fidelity is small beside the penalty of
    /// the input.
    fn is_held_by_constraints(&self) -> bool {
        let vertices = self.operator.vertices().cells();
        let squares = vertices.map(|v| self.fidelity.at(v) * self.target[v].powi(2));
        self.lambda * squares.sum::<f64>()
            < NEGLIGIBLE_FIDELITY_SHARE * self.smoothness(&self.target)
    }

    /// Sets the rounding error of an objective of 0 from the largest magnitude of heights.
    pub(crate) fn set_rounding(&mut self, largest: f64) {
        let spacing = self.operator.spacing();
        let norm = HESSIAN_ROUNDING_UNITS * f64::EPSILON * largest / (spacing * spacing);
        let count = self.operator.stencils().len() as f64;
        self.rounding = match self.kind {
            PenaltyKind::SquaredNuclear => {
                // Σ (s + δ)² − s² by Cauchy and Schwarz.
                let squares = self.smoothness(&self.target);
                norm * (2.0 * (count * squares).sqrt() + count * norm)
            }
            PenaltyKind::Huber(bends) => {
                let mut slopes = 0.0;
                self.operator.hessians(&self.target, |_, hessian| {
                    slopes += bends.slope(hessian.nuclear_norm() + norm);
                });
                norm * slopes
            }
            _ => norm * count,
        };
    }

    /// Sets the penalty weights of an energy whose weights follow from the normals of the input heights; to be called
    /// again after free vertices have got heights.
    pub(crate) fn set_input_normal_weights(&mut self, energy: Energy) -> Result<()> {
        if matches!(energy, Energy::SecondFormOfInput | Energy::SecondForm) {
            let target = std::mem::take(&mut self.target);
            self.set_normal_weights(&target)?;
            self.target = target;
            self.first_weight = self.weight.clone();
        }
        Ok(())
    }

    /// Sets the penalty weights `ω = n₃`, the upward component of the unit normal of the surface `z`, which turns its
    /// Hessian into the second fundamental form (paper, Eq. 24).
    pub(crate) fn set_normal_weights(&mut self, z: &[f64]) -> Result<()> {
        let mut factors = match std::mem::replace(&mut self.weight, PerCell::Same(Vec::new())) {
            PerCell::Each(factors) => factors,
            PerCell::Same(_) => try_filled("normals", self.operator.stencil_cells(), 0.0)?,
        };
        self.operator.normals(z, &mut factors);
        self.weight = PerCell::Each(factors);
        Ok(())
    }

    /// Reweights all stencils by `ω ← ω ε/(σ + ε)`, where `σ` is `‖Cz‖_*` averaged over the stencils around and `ε` a
    /// share of its mean: where the surface bends, bending becomes cheap (Candès, Wakin and Boyd, *Enhancing Sparsity
    /// by Reweighted ℓ₁ Minimization*, 2008). Without the average, a stencil that bends a little more than its
    /// surroundings by chance would become a crease.
    pub(crate) fn reweight(&mut self, z: &[f64]) -> Result<()> {
        let mut norms = self.norms(z)?;
        let stencils = self.operator.stencils();
        let sum: f64 = stencils.cells().map(|stencil| norms[stencil]).sum();
        for _ in 0..NORM_AVERAGING_STEPS {
            self.operator.spread(&mut norms);
        }
        let epsilon = NEGLIGIBLE_NORM_SHARE * sum / stencils.len() as f64;
        for stencil in stencils.cells() {
            let factor = if epsilon > 0.0 {
                epsilon / (norms[stencil] + epsilon)
            } else {
                1.0
            };
            norms[stencil] = factor * self.first_weight.at(stencil);
        }
        self.weight = PerCell::Each(norms);
        Ok(())
    }

    /// Computes the nuclear norm `‖Cz‖_*` of the Hessian at each stencil; entries without a stencil are 0.
    pub(crate) fn norms(&self, z: &[f64]) -> Result<Vec<f64>> {
        let mut norms = try_filled("weights", self.operator.stencil_cells(), 0.0)?;
        let mut states: Vec<_> = self.operator.bands().split(&mut norms).collect();
        fork::for_each(&mut states, |band, norms| {
            let first = norms.first();
            let norms = norms.values();
            self.operator.band_hessians(band, z, |stencil, hessian| {
                norms[stencil - first] = hessian.nuclear_norm()
            });
        });
        Ok(norms)
    }

    /// Computes the penalty `Σ ω f(Cz)` of a surface `z`.
    pub(crate) fn smoothness(&self, z: &[f64]) -> f64 {
        let mut sums = vec![0.0; self.operator.bands().len()];
        fork::for_each(&mut sums, |band, sum| {
            self.band_costs(band, z, |_, cost| *sum += cost);
        });
        sums.iter().sum()
    }

    /// Calls `visit` with each stencil and its term of the penalty.
    pub(crate) fn each_cost(&self, z: &[f64], mut visit: impl FnMut(usize, f64)) {
        for band in 0..self.operator.bands().len() {
            self.band_costs(band, z, &mut visit);
        }
    }

    /// Calls `visit` with each stencil of a band and its term of the penalty.
    fn band_costs(&self, band: usize, z: &[f64], mut visit: impl FnMut(usize, f64)) {
        // The penalty's values do not depend on ρ.
        let penalty = AnyPenalty::new(self.kind, f64::NAN);
        self.operator.band_hessians(band, z, |stencil, hessian| {
            let value = penalty.value(hessian, self.weight.at(stencil));
            visit(stencil, self.operator.area(stencil) * value);
        });
    }

    /// Computes the fidelity `λ Σ w (z − z̃)²` of a surface `z`, less the energy offset of loads.
    pub(crate) fn distance(&self, z: &[f64]) -> f64 {
        let vertices = self.operator.vertices().cells();
        let squares = vertices.map(|v| self.fidelity.at(v) * (z[v] - self.target[v]).powi(2));
        self.lambda * squares.sum::<f64>() - self.offset
    }

    /// Returns the affine surface that fits the target heights best by least squares. It is exactly 0 if every height
    /// is given, because the coordinates are relative to it then.
    pub(crate) fn least_squares(&self) -> Result<Vec<f64>> {
        let operator = &self.operator;
        let mut z = try_filled("affine surface", operator.vertex_cells(), 0.0)?;
        if self.free.is_empty() && self.constrained.is_empty() {
            return Ok(z);
        }
        let plane = Plane::fit(operator.vertices().cells().map(|vertex| {
            let [x, y] = operator.place(vertex);
            ([x, y, self.target[vertex]], self.fidelity.at(vertex))
        }));
        for vertex in operator.vertices().cells() {
            z[vertex] = plane.at(operator.place(vertex));
        }
        Ok(z)
    }
}
