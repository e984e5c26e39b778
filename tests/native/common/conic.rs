//! An independent optimum: the energy as a second-order cone program, solved by
//! Clarabel. Nothing here calls the library's own stencils, domains or energies.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT,
    SolverStatus, SupportedConeT,
};
use developable::{
    Bridging, Energy, Heightfield, Input, Lattice, Normalization, Occlusions, Options, Report,
    StopReason, Surface, fit,
};
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

/// All that a solve depends on, in the field's own coordinates.
#[derive(Debug, Clone)]
pub struct Instance {
    /// Those of constraints among them.
    pub field: Heightfield,
    pub lambda: f64,
    pub energy: Energy,
    pub confidence: Vec<f64>,
    pub constrained: Vec<bool>,
    pub torn: Vec<bool>,
    pub tie_break: f64,
    /// For [`Energy::Huber`]: flatness, bend, and at each stencil where the slope ends, if that is
    /// not 1.
    pub huber: [f64; 2],
    pub slopes: Option<Vec<f64>>,
    pub gap: f64,
}

pub struct Optimum {
    pub objective: f64,
    /// Heights in the order of the lattice; NaN outside `I ∪ ∂I`.
    pub heights: Vec<f64>,
}

/// A vertex of `I` with its six neighbours, and the rows `h_xx, h_xy, h_yy, g_x,
/// g_y` of its best-fit quadratic.
struct Stencil {
    vertices: [usize; 7],
    rows: SMatrix<f64, 5, 7>,
}

impl Stencil {
    fn of(lattice: &Lattice, vertices: [(usize, usize); 7]) -> Self {
        Stencil {
            vertices: vertices.map(|(r, c)| lattice.index(r, c)),
            rows: rows_of(vertices.map(|(r, c)| lattice.position(r, c))),
        }
    }

    fn fit(&self, z: &[f64]) -> SVector<f64, 5> {
        self.rows * SVector::from(self.vertices.map(|v| z[v]))
    }

    fn hessian(&self, z: &[f64]) -> [f64; 3] {
        let fit = self.fit(z);
        [fit[0], fit[1], fit[2]]
    }
}

/// Derivatives of the best-fit quadratic as combinations of the heights of a
/// vertex and its six neighbours, from their positions alone.
fn rows_of(positions: [[f64; 2]; 7]) -> SMatrix<f64, 5, 7> {
    let [x0, y0] = positions[0];
    // Scaled to a unit stencil first, so that the normal equations are well conditioned.
    let h = (positions[1][0] - x0).hypot(positions[1][1] - y0);
    let mut design = SMatrix::<f64, 7, 6>::zeros();
    for (i, [x, y]) in positions.into_iter().enumerate() {
        let (x, y) = ((x - x0) / h, (y - y0) / h);
        let row = [0.5 * x * x, x * y, 0.5 * y * y, x, y, 1.0];
        design.set_row(i, &SVector::<f64, 6>::from(row).transpose());
    }
    let fit = (design.transpose() * design).try_inverse().unwrap() * design.transpose();
    let mut rows = fit.fixed_rows::<5>(0).into_owned();
    for (i, mut row) in rows.row_iter_mut().enumerate() {
        row /= if i < 3 { h * h } else { h };
    }
    rows
}

impl Instance {
    pub fn new(field: &Heightfield, lambda: f64) -> Self {
        let n = field.lattice().len();
        Instance {
            field: field.clone(),
            lambda,
            energy: Energy::Nuclear,
            confidence: vec![1.0; n],
            constrained: vec![false; n],
            torn: vec![false; n],
            tie_break: 0.01,
            huber: [0.3, 0.1],
            slopes: None,
            gap: 1e-8,
        }
    }

    /// Constraints and nothing else, where `held` says so.
    pub fn design(field: &Heightfield, lambda: f64, held: impl Fn(usize, usize) -> bool) -> Self {
        let cols = field.lattice().cols();
        let mut instance = Instance::new(field, lambda);
        instance.confidence.fill(0.0);
        for (i, constrained) in instance.constrained.iter_mut().enumerate() {
            *constrained = held(i / cols, i % cols);
        }
        instance
    }

    pub fn energy(mut self, energy: Energy) -> Self {
        self.energy = energy;
        self
    }

    /// The library's view of the same.
    pub fn input(&self) -> Input {
        let lattice = self.field.lattice();
        let heights = self.field.heights().iter().zip(&self.constrained);
        let constraints = heights.map(|(z, held)| if *held { *z } else { f64::NAN });
        let torn: Vec<u8> = self.torn.iter().map(|torn| u8::from(*torn)).collect();
        Input::new(self.field.clone())
            .with_bridging(Bridging::Off)
            .and_then(|input| input.with_confidence(self.confidence.clone()))
            .and_then(|input| input.with_constraints(constraints.collect()))
            .and_then(|input| input.with_occlusions(Occlusions::from_vertices(lattice, &torn)?))
            .unwrap()
    }

    pub fn options(&self) -> Options {
        let mut options = Options::default()
            .lambda(self.lambda)
            .energy(self.energy)
            .gap(self.gap)
            .max_iterations(200_000)
            .normalization(Normalization::Off);
        if self.energy == Energy::Huber {
            let [flatness, bend_radius] = self.huber;
            options = options.flatness(flatness).bend_radius(bend_radius);
            options = options.crease_passes(0);
        }
        let is_free = |i: usize| self.confidence[i] == 0.0 && !self.constrained[i];
        if (0..self.confidence.len()).any(is_free) {
            options = options.tie_break(self.tie_break);
        }
        options
    }

    fn stencils(&self) -> Vec<Stencil> {
        let lattice = self.field.lattice();
        let valid = |(r, c): (usize, usize)| !self.field.height(r, c).is_nan();
        let stencil = |i: usize| {
            let v = (i / lattice.cols(), i % lattice.cols());
            let mut all = [v; 7];
            for (slot, n) in all[1..].iter_mut().zip(lattice.neighbours(v.0, v.1)) {
                *slot = n.filter(|n| valid(*n))?;
            }
            (valid(v) && !self.torn[i]).then(|| Stencil::of(lattice, all))
        };
        (0..lattice.len()).filter_map(stencil).collect()
    }

    /// Weight of the squared distance from [`Instance::target`]; infinite where constrained.
    fn weight(&self, i: usize) -> f64 {
        match (self.constrained[i], self.confidence[i]) {
            (true, _) => f64::INFINITY,
            (_, 0.0) => self.tie_break,
            (_, confidence) => self.lambda * confidence,
        }
    }

    /// The heights, and the thin plate through them where they mean nothing: the
    /// minimiser of `Σ λw(z − z̃)² + h/2 Σ ‖H‖_F²`.
    pub fn target(&self) -> Vec<f64> {
        self.plate().expect("a plate that is held in place")
    }

    /// The same; `None` if what is given does not hold the plate, which on a strip one stencil
    /// wide may bend without bending any stencil.
    pub fn plate(&self) -> Option<Vec<f64>> {
        let given = |i: usize| self.constrained[i] || self.confidence[i] > 0.0;
        let mut target = self.field.heights().to_vec();
        let stencils = self.stencils();
        let unknown: Vec<usize> = active(&stencils, target.len())
            .into_iter()
            .filter(|i| !self.constrained[*i])
            .collect();
        if unknown.iter().all(|i| given(*i)) {
            return Some(target);
        }
        let mut place = vec![usize::MAX; target.len()];
        for (k, i) in unknown.iter().enumerate() {
            place[*i] = k;
        }
        let mut matrix = DMatrix::<f64>::zeros(unknown.len(), unknown.len());
        let mut right = DVector::<f64>::zeros(unknown.len());
        let half = 0.5 * self.field.lattice().spacing();
        for stencil in &stencils {
            for (row, factor) in [(0, half), (1, 2.0 * half), (2, half)] {
                let b = stencil.rows.row(row);
                for (j, v) in stencil.vertices.into_iter().enumerate() {
                    for (k, u) in stencil.vertices.into_iter().enumerate() {
                        let value = factor * b[j] * b[k];
                        match (place[v], place[u]) {
                            (usize::MAX, _) => {}
                            (p, usize::MAX) => right[p] -= value * target[u],
                            (p, q) => matrix[(p, q)] += value,
                        }
                    }
                }
            }
        }
        for (k, i) in unknown.iter().enumerate() {
            if given(*i) {
                matrix[(k, k)] += self.weight(*i);
                right[k] += self.weight(*i) * target[*i];
            }
        }
        let plate = matrix.cholesky()?.solve(&right);
        for (k, i) in unknown.iter().enumerate().filter(|(_, i)| !given(**i)) {
            target[*i] = plate[k];
        }
        Some(target)
    }

    /// `1/√(1 + |∇z|²)` at each stencil.
    pub fn normals(&self, z: &[f64]) -> Vec<f64> {
        let normal = |stencil: &Stencil| {
            let fit = stencil.fit(z);
            1.0 / (1.0 + fit[3] * fit[3] + fit[4] * fit[4]).sqrt()
        };
        self.stencils().iter().map(normal).collect()
    }

    /// Factors of the norms.
    fn factors(&self) -> Vec<f64> {
        match self.energy {
            Energy::SecondFormOfInput => self.normals(&self.target()),
            _ => self
                .slopes
                .clone()
                .unwrap_or_else(|| vec![1.0; self.stencils().len()]),
        }
    }

    /// `‖H‖_*` at each stencil, and its mean over the stencil (weight 2) and those around it.
    pub fn norms(&self, z: &[f64]) -> Vec<[f64; 2]> {
        let stencils = self.stencils();
        let nuclear = |stencil: &Stencil| {
            let [xx, xy, yy] = stencil.hessian(z);
            (xx + yy).abs().max((xx - yy).hypot(2.0 * xy))
        };
        let own: Vec<f64> = stencils.iter().map(nuclear).collect();
        let mut at = vec![None; z.len()];
        for (stencil, norm) in stencils.iter().zip(&own) {
            at[stencil.vertices[0]] = Some(*norm);
        }
        let spread = |(stencil, norm): (&Stencil, &f64)| {
            let ring = stencil.vertices[1..].iter().filter_map(|v| at[*v]);
            let (sum, count) = ring.fold((2.0 * norm, 2.0), |(s, n), x| (s + x, n + 1.0));
            [*norm, sum / count]
        };
        stencils.iter().zip(&own).map(spread).collect()
    }

    /// `φ` with a slope that ends at `slope`, by its definition.
    fn huber(&self, norm: f64, slope: f64) -> f64 {
        let [flatness, bend] = self.huber;
        let first = flatness.min(slope);
        let knee = (slope - first) / bend;
        let bent = norm.min(knee);
        first * bent + 0.5 * bend * bent * bent + slope * (norm - bent)
    }

    /// The energy of a surface: the part that is fidelity or tie break, and the other.
    pub fn terms(&self, z: &[f64]) -> [f64; 2] {
        self.terms_with(z, &self.factors())
    }

    pub fn terms_with(&self, z: &[f64], factors: &[f64]) -> [f64; 2] {
        let (stencils, target) = (self.stencils(), self.target());
        let free = active(&stencils, z.len())
            .into_iter()
            .filter(|i| !self.constrained[*i]);
        let fidelity = free.map(|i| self.weight(i) * (z[i] - target[i]).powi(2));
        let norm = |[xx, xy, yy]: [f64; 3], factor: f64| {
            let nuclear = (xx + yy).abs().max((xx - yy).hypot(2.0 * xy));
            match self.energy {
                Energy::Frobenius => factor * (xx * xx + 2.0 * xy * xy + yy * yy).sqrt(),
                Energy::SquaredNuclear => factor * nuclear * nuclear,
                Energy::Huber => self.huber(nuclear, factor),
                _ => factor * nuclear,
            }
        };
        let norms = stencils.iter().zip(factors);
        [
            fidelity.sum(),
            norms.map(|(s, factor)| norm(s.hessian(z), *factor)).sum(),
        ]
    }

    pub fn optimum(&self) -> Optimum {
        self.optimum_with(&self.factors())
    }

    /// Minimises `Σ λw(z − z̃)² + Σ factor · f(H)` over the offsets `z − z̃` where there is
    /// no constraint and a bound `s` of `‖H‖` for each stencil: `‖H‖_* = max(|h_xx + h_yy|,
    /// ‖(h_xx − h_yy, 2h_xy)‖)`. For [`Energy::Huber`] that bound is `u + v`, of which `u` costs
    /// `αu + u²/2δ` and `v ≥ 0` the slope that `φ` ends with.
    pub fn optimum_with(&self, factors: &[f64]) -> Optimum {
        let (stencils, target) = (self.stencils(), self.target());
        let mut unknown = active(&stencils, target.len());
        unknown.retain(|i| !self.constrained[*i]);
        let mut column = vec![None; target.len()];
        for (k, i) in unknown.iter().enumerate() {
            column[*i] = Some(k);
        }
        let (n, m) = (unknown.len(), stencils.len());

        // Ax + cone variable = b, row by row.
        let mut form = Rows::default();
        let row = |stencil: &Stencil, [xx, xy, yy]: [f64; 3]| {
            let b = &stencil.rows;
            let entry = |j: usize| xx * b[(0, j)] + xy * b[(1, j)] + yy * b[(2, j)];
            let value: f64 = (0..7).map(|j| entry(j) * target[stencil.vertices[j]]).sum();
            let entries = (0..7).filter_map(|j| Some((column[stencil.vertices[j]]?, entry(j))));
            (entries.collect::<Vec<_>>(), -value)
        };
        let huber = self.energy == Energy::Huber;
        let bound = |k: usize| {
            let second = huber.then_some((n + m + k, -1.0));
            [(n + k, -1.0)].into_iter().chain(second)
        };
        let mut cones = Vec::new();
        if huber {
            for k in 0..m {
                form.push(vec![(n + m + k, -1.0)], 0.0);
            }
            cones.push(NonnegativeConeT(m));
        }
        if self.energy != Energy::Frobenius {
            for (k, stencil) in stencils.iter().enumerate() {
                for sign in [1.0, -1.0] {
                    let (mut trace, value) = row(stencil, [sign, 0.0, sign]);
                    trace.extend(bound(k));
                    form.push(trace, value);
                }
            }
            cones.push(NonnegativeConeT(2 * m));
        }
        for (k, stencil) in stencils.iter().enumerate() {
            let inside: &[[f64; 3]] = match self.energy {
                Energy::Frobenius => &[[1.0, 0.0, 0.0], [0.0, 2f64.sqrt(), 0.0], [0.0, 0.0, 1.0]],
                _ => &[[1.0, 0.0, -1.0], [0.0, 2.0, 0.0]],
            };
            form.push(bound(k).collect(), 0.0);
            for entries in inside {
                let (entries, value) = row(stencil, *entries);
                form.push(entries, value);
            }
            cones.push(SecondOrderConeT(1 + inside.len()));
        }

        let weights = unknown.iter().map(|i| 2.0 * self.weight(*i));
        let squared = self.energy == Energy::SquaredNuclear;
        let [linear, quadratic] = [!squared, squared].map(|on| f64::from(u8::from(on)));
        let mut diagonal: Vec<f64> = weights.collect();
        let mut costs = vec![0.0; n];
        if huber {
            let [flatness, bend] = self.huber;
            diagonal.extend(factors.iter().map(|_| bend).chain(vec![0.0; m]));
            costs.extend(factors.iter().map(|slope| flatness.min(*slope)));
            costs.extend(factors);
        } else {
            diagonal.extend(factors.iter().map(|factor| 2.0 * quadratic * factor));
            costs.extend(factors.iter().map(|factor| linear * factor));
        }
        let x = form.solve(diagonal, costs, &cones);
        let mut heights = vec![f64::NAN; target.len()];
        for i in stencils.iter().flat_map(|stencil| stencil.vertices) {
            heights[i] = target[i] + column[i].map_or(0.0, |k| x[k]);
        }
        Optimum {
            // Evaluated at the heights themselves, not read off the solver.
            objective: self.terms_with(&heights, factors).iter().sum(),
            heights,
        }
    }

    pub fn solve(&self) -> Surface {
        fit(self.input(), &self.options()).unwrap()
    }

    /// Solves and compares objective, bound and heights with the optimum.
    pub fn check(&self) -> Report {
        let surface = self.solve();
        let exact = self.optimum();
        self.compare(&surface, &exact)
    }

    pub fn compare(&self, surface: &Surface, exact: &Optimum) -> Report {
        let (heights, report) = (surface.heightfield().heights(), surface.report());
        assert_eq!(report.stop_reason, StopReason::Gap, "{report:?}");
        for i in (0..heights.len()).filter(|i| self.constrained[*i]) {
            let given = self.field.heights()[i];
            assert_eq!(heights[i].to_bits(), given.to_bits(), "vertex {i}");
        }
        // What is reported is the energy of what is returned.
        let [fidelity, norms] = self.terms(heights);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-7 * report.objective;
        assert!(
            close(fidelity, report.fidelity) && close(norms, report.nuclear_norm),
            "{fidelity} and {norms}: {report:?}"
        );

        let error = (report.objective - exact.objective) / exact.objective;
        assert!(
            error < 1.1 * self.gap,
            "objective off by {error:e}: {report:?}"
        );
        // The conic solver is exact to about 1e-9 itself.
        let slack = 1e-8 * exact.objective;
        assert!(
            report.dual_bound <= exact.objective + slack,
            "bound above {}: {report:?}",
            exact.objective
        );
        assert!(error >= -1e-8, "{error:e} below the optimum: {report:?}");

        // Strong convexity bounds the distance to the optimum by the gap.
        let distance: f64 = (0..heights.len())
            .filter(|i| !exact.heights[*i].is_nan() && !self.constrained[*i])
            .map(|i| self.weight(i) * (heights[i] - exact.heights[i]).powi(2))
            .sum();
        let bound = report.objective - report.dual_bound + 2.0 * slack;
        assert!(distance <= bound, "{distance:e} against {bound:e}");
        report.clone()
    }
}

/// What is touched by a stencil, in order.
fn active(stencils: &[Stencil], len: usize) -> Vec<usize> {
    let mut touched = vec![false; len];
    for v in stencils.iter().flat_map(|stencil| stencil.vertices) {
        touched[v] = true;
    }
    (0..len).filter(|i| touched[*i]).collect()
}

/// A sparse matrix and the right-hand sides of its rows.
#[derive(Default)]
struct Rows {
    row: Vec<usize>,
    col: Vec<usize>,
    value: Vec<f64>,
    b: Vec<f64>,
}

impl Rows {
    fn push(&mut self, entries: Vec<(usize, f64)>, b: f64) {
        for (col, value) in entries {
            self.row.push(self.b.len());
            self.col.push(col);
            self.value.push(value);
        }
        self.b.push(b);
    }

    /// Minimises `½ xᵀ diag(quadratic) x + linear·x`.
    fn solve(
        self,
        quadratic: Vec<f64>,
        linear: Vec<f64>,
        cones: &[SupportedConeT<f64>],
    ) -> Vec<f64> {
        let (m, n) = (self.b.len(), linear.len());
        let a = CscMatrix::new_from_triplets(m, n, self.row, self.col, self.value);
        let all = || (0..n).collect();
        let p = CscMatrix::new_from_triplets(n, n, all(), all(), quadratic);
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .tol_gap_abs(1e-12)
            .tol_gap_rel(1e-10)
            .tol_feas(1e-11)
            .build()
            .unwrap();
        let mut solver = DefaultSolver::new(&p, &linear, &a, &self.b, cones, settings).unwrap();
        solver.solve();
        let status = solver.solution.status;
        assert!(
            matches!(status, SolverStatus::Solved | SolverStatus::AlmostSolved),
            "{status:?}"
        );
        solver.solution.x
    }
}
