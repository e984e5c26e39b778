//! The energy on one lattice, in normalised coordinates.

use std::sync::Arc;

use super::law::{Any, Kind, Law};
use crate::error::{Error, Result, try_filled};
use crate::fit::coordinates::{Coordinates, Plane};
use crate::fit::input::Input;
use crate::fit::options::{Energy, Options};
use crate::lattice::domain::{Domain, Role};
use crate::lattice::per_cell::PerCell;
use crate::lattice::runs::Run;
use crate::lattice::stencil::{HessianMap, Ring};
use crate::math::sym2::Sym2;

/// Norms up to this share of their mean count as none when an energy is reweighted.
const REWEIGHTING: f64 = 0.3;

/// Heights and Hessians are at most so large, and the spacing; and at least one over it.
const LARGEST: f64 = 1e130;
const FARTHEST: f64 = 1e50;

/// A weight of this over `λh⁴` lets a vertex move by next to nothing: keeping it where it is costs
/// less than a tenth, the norm of one Hessian being of order 1 to 1/h.
const FIRM: f64 = 1e3;

/// Weights up to this share of the largest are next to none.
const WEAK: f64 = 5e-3;

/// Fidelity up to this share of what the input's bends cost is next to none.
const NOTHING: f64 = 0.1;

/// How often norms are averaged with their neighbours' before that.
const SPREADING: usize = 30;

/// `P(z) = λ Σ w (z − z̃)² + Σ ω f(H(z))` over a domain (paper, Eq. 15), subject
/// to `z = z̃` at constrained vertices.
#[derive(Debug, Clone)]
pub(crate) struct Problem {
    pub domain: Arc<Domain>,
    pub lambda: f64,
    /// `z̃` on the padded box, zero outside `I ∪ ∂I`.
    pub target: Vec<f64>,
    /// `w`, and one over it; the latter is 0 at constrained cells.
    pub fidelity: PerCell<f64>,
    pub inverse_fidelity: PerCell<f64>,
    /// Cells whose height stays as it is given.
    pub constrained: Vec<u32>,
    /// Cells with neither constraint nor fidelity, where `λw` is the tie break.
    pub free: Vec<u32>,
    /// Whether there are cells with next to no fidelity, where `CᵀY` must all but vanish.
    pub loose: bool,
    pub kind: Kind,
    /// `ω`, and what it was before any reweighting.
    pub weight: PerCell<f64>,
    first_weight: PerCell<f64>,
    pub map: HessianMap,
    /// Lattice spacing in normalised coordinates.
    pub spacing: f64,
    /// Objectives up to this are rounding errors of zero.
    pub rounding: f64,
    /// From the user's heights and back.
    pub coordinates: Coordinates,
}

impl Problem {
    pub(crate) fn new(
        input: &Input,
        domain: Arc<Domain>,
        coordinates: &Coordinates,
        options: &Options,
    ) -> Result<Self> {
        let lambda = options.lambda.value();
        let mut target = try_filled("input heights", domain.cells(), 0.0)?;
        let (mut constrained, mut free) = (Vec::new(), Vec::new());
        let mut largest = 0.0f64;
        let mut alike = true;
        for cell in domain.active().cells() {
            let vertex = domain.lattice_index(cell);
            let height = input.field().heights()[vertex];
            target[cell] = coordinates.inward(position(&domain, cell), height);
            largest = largest.max((coordinates.scale * height).abs());
            alike &= input.weight(vertex) == 1.0;
            if input.is_constrained(vertex) {
                constrained.push(cell as u32);
            } else if input.weight(vertex) == 0.0 {
                free.push(cell as u32);
            }
        }
        let spacing = coordinates.scale * domain.lattice().spacing();
        check_range(&domain, input.field().heights(), &target, largest, spacing)?;
        // Each Hessian is a handful of heights over h², each with its own rounding error.
        let norm = 16.0 * f64::EPSILON * largest / (spacing * spacing);
        let count = domain.interior_len() as f64;
        let mut problem = Problem {
            lambda,
            target,
            fidelity: PerCell::same(&domain, 1.0),
            inverse_fidelity: PerCell::same(&domain, 1.0),
            constrained,
            loose: false,
            free,
            kind: Kind::of(options),
            weight: PerCell::same(&domain, 1.0),
            first_weight: PerCell::same(&domain, 1.0),
            map: HessianMap::new(spacing),
            spacing,
            rounding: norm * count,
            coordinates: *coordinates,
            domain,
        };
        if !alike || !problem.constrained.is_empty() {
            // Beside given heights a tie break weighs no more than these.
            let constrained = !problem.constrained.is_empty();
            let mixed =
                problem.free.len() + problem.constrained.len() < problem.domain.active().len();
            let most = if mixed { 1.0 } else { f64::INFINITY };
            problem.set_fidelity(input, (options.tie_break / lambda).min(most))?;
            problem.loose |= constrained && problem.yields();
        }
        problem.take_first_normals(options.energy)?;
        if problem.kind == Kind::SquaredNuclear {
            // Σ (s + δ)² − s² by Cauchy and Schwarz.
            let squares = problem.smoothness(&problem.target);
            problem.rounding = norm * (2.0 * (count * squares).sqrt() + count * norm);
        }
        if let Kind::Huber(bends) = problem.kind {
            let mut slopes = 0.0;
            problem.each_hessian(&problem.target, |_, hessian| {
                slopes += bends.slope(hessian.nuclear_norm() + norm);
            });
            problem.rounding = norm * slopes;
        }
        Ok(problem)
    }

    fn set_fidelity(&mut self, input: &Input, tie_break: f64) -> Result<()> {
        let domain = &self.domain;
        let values = || try_filled("fidelity", domain.cells(), 0.0);
        let (mut fidelity, mut inverse) = (values()?, values()?);
        for cell in domain.active().cells() {
            let vertex = domain.lattice_index(cell);
            let weight = match input.weight(vertex) {
                0.0 => tie_break,
                weight => weight,
            };
            let constrained = input.is_constrained(vertex);
            fidelity[cell] = if constrained { 1.0 } else { weight };
            inverse[cell] = if constrained { 0.0 } else { 1.0 / weight };
        }
        let largest = domain
            .active()
            .cells()
            .fold(0.0f64, |m, c| m.max(fidelity[c]));
        let weak = |cell: usize| fidelity[cell] < WEAK * largest;
        self.loose = !self.free.is_empty() || domain.active().cells().any(weak);
        if self.loose {
            // Beside them, what is held firmly would drown everything else in its rounding errors.
            // Its share of the bound stays.
            let firm = FIRM / (self.lambda * self.spacing.powi(4));
            let firm = |cell: &usize| fidelity[*cell] >= firm && inverse[*cell] > 0.0;
            let cells = domain.active().cells().filter(firm);
            self.constrained.extend(cells.map(|cell| cell as u32));
        }
        self.fidelity = PerCell::Each(fidelity);
        self.inverse_fidelity = PerCell::Each(inverse);
        Ok(())
    }

    /// Whether constraints alone hold the surface: what fidelity costs at its worst is next to
    /// nothing beside the bends of the input.
    fn yields(&self) -> bool {
        let cells = self.domain.active().cells();
        let squares = cells.map(|cell| self.fidelity.at(cell) * self.target[cell].powi(2));
        self.lambda * squares.sum::<f64>() < NOTHING * self.smoothness(&self.target)
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
        let domain = &self.domain;
        let mut factors = match std::mem::replace(&mut self.weight, PerCell::Same(Vec::new())) {
            PerCell::Each(factors) => factors,
            PerCell::Same(_) => try_filled("normals", domain.cells(), 0.0)?,
        };
        for row in 1..=domain.rows() {
            for run in domain.interior().row(row) {
                let ring = Ring::new(z, domain, row, *run);
                for (i, factor) in factors[run.start..run.end].iter_mut().enumerate() {
                    let [gx, gy] = ring.gradient(i, self.spacing);
                    let [sx, sy] = self.coordinates.slope();
                    let (gx, gy) = (gx + sx, gy + sy);
                    *factor = 1.0 / (1.0 + gx * gx + gy * gy).sqrt();
                }
            }
        }
        self.weight = PerCell::Each(factors);
        Ok(())
    }

    /// `ω ← ω ε/(σ + ε)`, where `σ` is `‖H(z)‖_*` as a mean over some cells around
    /// and `ε` a share of its mean over all: where the surface bends, bending
    /// becomes cheap (Candès, Wakin and Boyd, Enhancing Sparsity by Reweighted
    /// ℓ₁ Minimization, 2008). Without the local mean, what bends a little more
    /// than its surroundings by chance would become a crease.
    pub(crate) fn reweight(&mut self, z: &[f64]) -> Result<()> {
        let domain = &self.domain;
        let mut norms = self.norms(z)?;
        let sum: f64 = domain.interior().cells().map(|cell| norms[cell]).sum();
        for _ in 0..SPREADING {
            spread(domain, &mut norms);
        }
        let epsilon = REWEIGHTING * sum / domain.interior_len() as f64;
        for cell in domain.interior().cells() {
            let factor = if epsilon > 0.0 {
                epsilon / (norms[cell] + epsilon)
            } else {
                1.0
            };
            norms[cell] = factor * self.first_weight.at(cell);
        }
        self.weight = PerCell::Each(norms);
        Ok(())
    }

    /// `‖H(z)‖_*` at interior cells, 0 elsewhere.
    pub(crate) fn norms(&self, z: &[f64]) -> Result<Vec<f64>> {
        let mut norms = try_filled("weights", self.domain.cells(), 0.0)?;
        self.each_hessian(z, |cell, hessian| norms[cell] = hessian.nuclear_norm());
        Ok(norms)
    }

    /// Calls `visit` with each interior cell and `H(z)` there.
    fn each_hessian(&self, z: &[f64], mut visit: impl FnMut(usize, Sym2)) {
        for row in 1..=self.domain.rows() {
            for run in self.domain.interior().row(row) {
                let ring = Ring::new(z, &self.domain, row, *run);
                for cell in run.start..run.end {
                    visit(cell, self.map.hessian(ring.differences(cell - run.start)));
                }
            }
        }
    }

    /// `Σ ω f(H(z))`.
    pub(crate) fn smoothness(&self, z: &[f64]) -> f64 {
        let law = self.law();
        let mut sum = 0.0;
        self.each_hessian(z, |cell, hessian| {
            sum += law.value(hessian, self.weight.at(cell));
        });
        sum
    }

    /// `λ Σ w (z − z̃)²`.
    pub(crate) fn distance(&self, z: &[f64]) -> f64 {
        let cells = self.domain.active().cells();
        let squares =
            cells.map(|cell| self.fidelity.at(cell) * (z[cell] - self.target[cell]).powi(2));
        self.lambda * squares.sum::<f64>()
    }

    /// The affine function next to `z̃`. Exactly 0 if every height is given, for then the
    /// coordinates are about it.
    pub(crate) fn least_squares(&self) -> Result<Vec<f64>> {
        let mut z = try_filled("affine surface", self.domain.cells(), 0.0)?;
        if self.free.is_empty() && self.constrained.is_empty() {
            return Ok(z);
        }
        let plane = Plane::fit(self.domain.active().cells().map(|cell| {
            let [x, y] = position(&self.domain, cell).map(|x| self.coordinates.scale * x);
            ([x, y, self.target[cell]], self.fidelity.at(cell))
        }));
        for cell in self.domain.active().cells() {
            let place = position(&self.domain, cell).map(|x| self.coordinates.scale * x);
            z[cell] = plane.at(place);
        }
        Ok(z)
    }

    /// The longer side of the domain's box.
    pub(crate) fn size(&self) -> f64 {
        self.spacing * self.domain.rows().max(self.domain.stride()) as f64
    }

    /// For values, which do not depend on ρ.
    fn law(&self) -> Any {
        Any::new(self.kind, f64::NAN)
    }

    /// The same for the input, by the parts that cells belong to.
    pub(crate) fn smoothness_by(&self, parts: usize, part: impl Fn(usize) -> usize) -> Vec<f64> {
        let mut sums = vec![0.0; parts];
        for cell in self.domain.interior().cells() {
            let row = cell / self.domain.stride();
            let run = Run {
                start: cell,
                end: cell + 1,
            };
            let ring = Ring::new(&self.target, &self.domain, row, run);
            let hessian = self.map.hessian(ring.differences(0));
            let weight = self.weight.at(cell);
            sums[part(cell)] += self.law().value(hessian, weight);
        }
        sums
    }

    /// Calls `write` with each vertex of `I ∪ ∂I` and its height in the user's units.
    pub(crate) fn write_heights(&self, z: &[f64], mut write: impl FnMut((usize, usize), f64)) {
        for cell in self.domain.active().cells() {
            let height = self
                .coordinates
                .outward(position(&self.domain, cell), z[cell]);
            write(self.domain.lattice_vertex(cell), height);
        }
    }
}

/// Whether the squares of heights and Hessians, summed and times any λ, can be told from 0 and from
/// infinity. Heights that differ from a plane by rounding errors only are fine.
///
/// # Errors
/// [`Error::Overflow`] or [`Error::Underflow`].
fn check_range(
    domain: &Domain,
    heights: &[f64],
    target: &[f64],
    largest: f64,
    h: f64,
) -> Result<()> {
    let spacing = domain.lattice().spacing();
    let cells = || domain.active().cells();
    let finite = cells().all(|cell| target[cell].is_finite());
    let bend = cells().fold(0.0f64, |m, cell| m.max(target[cell].abs()));
    let hessian = |height: f64| height / (h * h);
    let affine = bend <= 16.0 * f64::EPSILON * largest && largest >= 1.0 / LARGEST;
    let zero = bend == 0.0 && cells().all(|cell| heights[domain.lattice_index(cell)] == 0.0);
    // As what a NaN is not.
    let small_enough = h >= 1.0 / FARTHEST && largest.max(hessian(largest)) <= LARGEST;
    if !(finite && small_enough) {
        return Err(Error::Overflow { spacing });
    }
    let large_enough = affine || zero || bend.min(hessian(bend)) >= 1.0 / LARGEST;
    if h > FARTHEST || !large_enough {
        return Err(Error::Underflow { spacing });
    }
    Ok(())
}

/// The mean over each interior cell (weight 2) and its interior neighbours (weight 1).
pub(super) fn spread(domain: &Domain, values: &mut [f64]) {
    let old = values.to_vec();
    for cell in domain.interior().cells() {
        let around = domain
            .neighbour_offsets(cell / domain.stride())
            .map(|o| cell.wrapping_add_signed(o))
            .into_iter()
            .filter(|n| domain.roles()[*n] == Role::Interior);
        let (sum, weight) = around.fold((2.0 * old[cell], 2.0), |(sum, weight), n| {
            (sum + old[n], weight + 1.0)
        });
        values[cell] = sum / weight;
    }
}

pub(crate) fn position(domain: &Domain, cell: usize) -> [f64; 2] {
    let (row, col) = domain.lattice_vertex(cell);
    domain.lattice().position(row, col)
}
