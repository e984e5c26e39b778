//! The energy of heights under any operator, in normalised coordinates.

use super::spectral_penalty::{AnyPenalty, PenaltyKind, SpectralPenalty};
use crate::error::{Result, try_filled};
use crate::fit::coordinates::Plane;
use crate::fit::operator::Operator;
use crate::fit::options::Energy;
use crate::lattice::per_cell::PerCell;

/// Norm, as a share of the mean, up to which a Hessian counts as none when an energy is reweighted.
const NEGLIGIBLE_NORM_SHARE: f64 = 0.3;

/// Weight over `λh⁴` from which on a vertex moves by next to nothing: keeping it where it is costs less than
/// a tenth, the norm of one Hessian being of order 1 to 1/h.
const FIRM_WEIGHT: f64 = 1e3;

/// Weight, as a share of the largest, up to which it counts as none.
const NEGLIGIBLE_WEIGHT_SHARE: f64 = 5e-3;

/// Fidelity, as a share of the cost of the input's bends, up to which it counts as none.
const NEGLIGIBLE_FIDELITY_SHARE: f64 = 0.1;

/// Number of times that norms are averaged with their neighbours' before a reweighting.
const NORM_AVERAGING_STEPS: usize = 30;

/// `P(z) = λ Σ w (z − z̃)² + Σ ω f(Cz)` (paper, Eq. 15), the one sum over the operator's vertices, the
/// other over its stencils, subject to `z = z̃` at constrained vertices.
#[derive(Debug, Clone)]
pub(crate) struct Problem<O> {
    /// `C`.
    pub operator: O,
    pub lambda: f64,
    /// `z̃`, zero where no vertex is.
    pub target: Vec<f64>,
    /// What loads of the border have added to the fidelity by moving the target, and is taken off again: a
    /// load does no work at the heights as they were given.
    pub offset: f64,
    /// `w`, and one over it; the latter is 0 at constrained vertices.
    pub fidelity: PerCell<f64>,
    pub inverse_fidelity: PerCell<f64>,
    /// Vertices whose height stays as it is given.
    pub constrained: Vec<u32>,
    /// Vertices with neither constraint nor fidelity, where `λw` is the tie break.
    pub free: Vec<u32>,
    /// Whether there are vertices with next to no fidelity, where `CᵀY` must all but vanish.
    pub loose: bool,
    pub kind: PenaltyKind,
    /// `ω`, and what it was before any reweighting.
    pub weight: PerCell<f64>,
    first_weight: PerCell<f64>,
    /// Objectives up to this are rounding errors of zero.
    pub rounding: f64,
}

impl<O: Operator> Problem<O> {
    /// With all weights 1.
    pub(crate) fn under(operator: O, lambda: f64, target: Vec<f64>, kind: PenaltyKind) -> Self {
        let ones = || PerCell::same(operator.longest_run(), 1.0);
        Problem {
            lambda,
            target,
            offset: 0.0,
            fidelity: ones(),
            inverse_fidelity: ones(),
            constrained: Vec::new(),
            free: Vec::new(),
            loose: false,
            kind,
            weight: ones(),
            first_weight: ones(),
            rounding: 0.0,
            operator,
        }
    }

    /// Weights of the fidelity, of which 0 leaves a vertex free, and which vertices are constrained.
    /// The `tie_break` is `λw` at free vertices.
    ///
    /// # Errors
    /// Out of memory.
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
        // Beside given heights a tie break weighs no more than these.
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
        let weak = |vertex: usize| fidelity[vertex] < NEGLIGIBLE_WEIGHT_SHARE * largest;
        self.loose = !self.free.is_empty() || vertices.cells().any(weak);
        if self.loose {
            // Beside them, what is held firmly would drown everything else in its rounding errors.
            // Its share of the bound stays.
            let firm = FIRM_WEIGHT / (self.lambda * self.operator.spacing().powi(4));
            let firm = |vertex: &usize| fidelity[*vertex] >= firm && inverse[*vertex] > 0.0;
            let firm = vertices.cells().filter(firm);
            self.constrained.extend(firm.map(|vertex| vertex as u32));
        }
        self.fidelity = PerCell::Each(fidelity);
        self.inverse_fidelity = PerCell::Each(inverse);
        self.loose |= constrained && self.yields();
        Ok(())
    }

    /// Whether constraints alone hold the surface: what fidelity costs at its worst is next to
    /// nothing beside the bends of the input.
    fn yields(&self) -> bool {
        let vertices = self.operator.vertices().cells();
        let squares = vertices.map(|v| self.fidelity.at(v) * self.target[v].powi(2));
        self.lambda * squares.sum::<f64>()
            < NEGLIGIBLE_FIDELITY_SHARE * self.smoothness(&self.target)
    }

    /// What rounding errors may change in an objective of 0, those of a Hessian's norm being `norm`.
    pub(crate) fn set_rounding(&mut self, norm: f64) {
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

    /// The weights of an energy that has those of its input. Once more where that has
    /// been given heights for free vertices.
    pub(crate) fn take_first_normals(&mut self, energy: Energy) -> Result<()> {
        if matches!(energy, Energy::SecondFormOfInput | Energy::SecondForm) {
            let target = std::mem::take(&mut self.target);
            self.take_normals(&target)?;
            self.target = target;
            self.first_weight = self.weight.clone();
        }
        Ok(())
    }

    /// `ω = n₃`, the upward part of the unit normal of the surface `z`: what
    /// turns its Hessian into the second fundamental form (paper, Eq. 24).
    pub(crate) fn take_normals(&mut self, z: &[f64]) -> Result<()> {
        let mut factors = match std::mem::replace(&mut self.weight, PerCell::Same(Vec::new())) {
            PerCell::Each(factors) => factors,
            PerCell::Same(_) => try_filled("normals", self.operator.stencil_cells(), 0.0)?,
        };
        self.operator.normals(z, &mut factors);
        self.weight = PerCell::Each(factors);
        Ok(())
    }

    /// `ω ← ω ε/(σ + ε)`, where `σ` is `‖Cz‖_*` as a mean over some stencils around
    /// and `ε` a share of its mean over all: where the surface bends, bending
    /// becomes cheap (Candès, Wakin and Boyd, Enhancing Sparsity by Reweighted
    /// ℓ₁ Minimization, 2008). Without the local mean, what bends a little more
    /// than its surroundings by chance would become a crease.
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

    /// `‖Cz‖_*` at the stencils, 0 elsewhere.
    pub(crate) fn norms(&self, z: &[f64]) -> Result<Vec<f64>> {
        let mut norms = try_filled("weights", self.operator.stencil_cells(), 0.0)?;
        self.operator.hessians(z, |stencil, hessian| {
            norms[stencil] = hessian.nuclear_norm()
        });
        Ok(norms)
    }

    /// `Σ ω f(Cz)`.
    pub(crate) fn smoothness(&self, z: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.each_cost(z, |_, cost| sum += cost);
        sum
    }

    /// Calls `visit` with each stencil and its term of that.
    pub(crate) fn each_cost(&self, z: &[f64], mut visit: impl FnMut(usize, f64)) {
        // For values, which do not depend on ρ.
        let penalty = AnyPenalty::new(self.kind, f64::NAN);
        self.operator.hessians(z, |stencil, hessian| {
            let value = penalty.value(hessian, self.weight.at(stencil));
            visit(stencil, self.operator.area(stencil) * value);
        });
    }

    /// `λ Σ w (z − z̃)²`, less the offset.
    pub(crate) fn distance(&self, z: &[f64]) -> f64 {
        let vertices = self.operator.vertices().cells();
        let squares = vertices.map(|v| self.fidelity.at(v) * (z[v] - self.target[v]).powi(2));
        self.lambda * squares.sum::<f64>() - self.offset
    }

    /// The affine function next to `z̃`. Exactly 0 if every height is given, for then the
    /// coordinates are about it.
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
