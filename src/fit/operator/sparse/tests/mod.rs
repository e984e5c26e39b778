//! ADMM under an operator that is no lattice's: the same lattice as a matrix.

mod scattered;

use std::sync::Arc;

use super::gradients::SparseGradients;
use super::matrix::SparseMatrix;
use super::{Rows, SparseOperator, SparseOperatorParts};
use crate::error::Result;
use crate::fit::admm::iterate::Iterate;
use crate::fit::admm::parameters::AdmmParameters;
use crate::fit::admm::solver::{AdmmSolver, initial_rho};
use crate::fit::coordinates::Coordinates;
use crate::fit::energy::problem;
use crate::fit::energy::spectral_penalty::PenaltyKind;
use crate::fit::heightfields;
use crate::fit::linear::cg::ConjugateGradients;
use crate::fit::linear::z_step_solver::SolvableOperator;
use crate::fit::operator::{Hessians, Matrices, Operator, Sums};
use crate::fit::report::StopReason;
use crate::lattice::domain::Domain;
use crate::{Energy, Heightfield, HessianOperator, Input, Lattice, Options};

type Problem = problem::Problem<SparseOperator>;

fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut random = oorandom::Rand64::new(seed.into());
    move || 2.0 * random.rand_float() - 1.0
}

/// A noisy crease over a disk with a hole, `cols` vertices across.
fn disk(cols: usize) -> Heightfield {
    let lattice = Lattice::new(cols, cols, 1.0 / cols as f64).unwrap();
    let mut noise = noise(5);
    let heights = (0..lattice.len()).map(|i| {
        let [x, y] = lattice.position(i / cols, i % cols);
        let r = (x - 0.5).hypot(y + 0.43);
        let height = 0.3 * (x + 0.4 * y - 0.3).abs() + 0.1 * (6.0 * y).sin() + 0.02 * noise();
        if r < 0.46 && (x - 0.6).hypot(y + 0.4) > 0.12 {
            height
        } else {
            f64::NAN
        }
    });
    Heightfield::new(lattice, heights.collect()).unwrap()
}

/// Of a matrix with three rows `h_xx, h_xy, h_yy` for each stencil, as
/// [`HessianOperator::triplets`] has them, and a column for each vertex. `centres` are the vertices in
/// the middle of the stencils, whose neighbours are the others that they take heights of.
fn operator_of(
    matrix: &sprs::CsMat<f64>,
    centres: &[usize],
    places: Vec<[f64; 2]>,
    spacing: f64,
) -> SparseOperator {
    let mut about = vec![None; places.len()];
    for (stencil, centre) in centres.iter().enumerate() {
        about[*centre] = Some(stencil as u32);
    }
    let (mut rows, mut beside) = (Rows::new(), SparseMatrix::new(centres.len()));
    for (stencil, centre) in centres.iter().enumerate() {
        let mut entries = std::collections::BTreeMap::<usize, [f64; 3]>::new();
        for k in 0..3 {
            for (vertex, entry) in matrix.outer_view(3 * stencil + k).unwrap().iter() {
                entries.entry(vertex).or_default()[k] = *entry;
            }
        }
        let others = entries.keys().filter(|vertex| *vertex != centre);
        beside.push(others.filter_map(|vertex| Some((about[*vertex]?, ()))));
        rows.push(entries.into_iter().map(|(vertex, [xx, xy, yy])| {
            (vertex as u32, crate::Sym2::new(xx, xy, yy).coordinates())
        }));
    }
    let extent = |k: usize| {
        let along = rows.vertices().map(|vertex| places[vertex as usize][k]);
        let [least, most] = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| {
            [a.min(x), b.max(x)]
        });
        most - least
    };
    let size = extent(0).max(extent(1));
    SparseOperator::new(SparseOperatorParts {
        rows,
        areas: Vec::new(),
        beside,
        constant: None,
        places,
        spacing,
        size,
    })
    .unwrap()
}

/// One instance under both operators.
struct Both {
    domain: Arc<Domain>,
    lattice: heightfields::Problem,
    sparse: Problem,
}

impl Both {
    fn new(input: &Input, options: &Options) -> Self {
        let domain = Arc::new(input.domain().unwrap());
        let coordinates = Coordinates::new(input, &domain, 1.0);
        let lattice =
            heightfields::Problem::new(input, domain.clone(), &coordinates, options).unwrap();
        let all = *domain.lattice();
        let vertices = || (0..all.len()).map(|i| (i / all.cols(), i % all.cols()));
        let hessian = HessianOperator::new(&domain);
        let centres: Vec<usize> = hessian.vertices().map(|(r, c)| all.index(r, c)).collect();
        let operator = operator_of(
            &hessian.to_sparse(),
            &centres,
            vertices().map(|(r, c)| all.position(r, c)).collect(),
            all.spacing(),
        );
        let mut target = vec![0.0; all.len()];
        for cell in domain.active().cells() {
            target[domain.lattice_index(cell)] = lattice.target[cell];
        }
        let lambda = options.lambda_or_default().value();
        let sparse =
            Problem::unweighted(operator, lambda, target, PenaltyKind::from_options(options));
        Both {
            domain,
            lattice,
            sparse,
        }
    }

    /// Heights of the lattice's cells in the order of the matrix's columns.
    fn of_cells(&self, z: &[f64]) -> Vec<f64> {
        let mut heights = vec![0.0; self.domain.lattice().len()];
        for cell in self.domain.active().cells() {
            heights[self.domain.lattice_index(cell)] = z[cell];
        }
        heights
    }
}

/// ADMM from the input to the end, on one level.
fn solve<O: SolvableOperator>(
    problem: &problem::Problem<O>,
    solver: impl Fn(&problem::Problem<O>, f64) -> Result<O::Solver>,
    options: &Options,
) -> (AdmmSolver<O>, StopReason) {
    let parameters = AdmmParameters::new(options);
    let iterate = Iterate::new(problem, initial_rho(&parameters, problem)).unwrap();
    let solver = solver(problem, iterate.rho).unwrap();
    let (mut level, mut reason) =
        AdmmSolver::new(problem.clone(), iterate, solver, parameters, 0, true).unwrap();
    while reason.is_none() {
        reason = level.advance(&mut 1000).unwrap();
    }
    (level, reason.unwrap())
}

fn multigrid(problem: &heightfields::Problem, rho: f64) -> Result<ConjugateGradients> {
    ConjugateGradients::new(problem, std::slice::from_ref(&problem.operator.domain), rho)
}

/// Both answers are certified, each bound is one for the other as well, and the surfaces are as close
/// as strong convexity says: `λ min w ‖z − z*‖² ≤ P − D`.
fn assert_alike(
    both: &Both,
    lattice: &AdmmSolver<impl SolvableOperator>,
    sparse: &AdmmSolver<SparseOperator>,
) {
    let (a, b) = (&lattice.admm.incumbent, &sparse.admm.incumbent);
    let bound = a.dual_bound.max(b.dual_bound);
    let gaps = [a, b].map(|incumbent| incumbent.objective() - bound);
    let rounding = 1e-12 * bound;
    assert!(
        gaps.iter().all(|gap| *gap >= -rounding),
        "{gaps:?} of {bound}"
    );
    let problem = &both.sparse;
    let vertices = || problem.operator.vertices().cells();
    let least = vertices().fold(f64::MAX, |m, v| m.min(problem.fidelity.at(v)));
    let radius = |gap: f64| ((gap + rounding) / (problem.lambda * least)).sqrt();
    let z = both.of_cells(&a.z);
    let distance = vertices()
        .map(|v| (z[v] - b.z[v]).powi(2))
        .sum::<f64>()
        .sqrt();
    let allowed = radius(gaps[0]) + radius(gaps[1]);
    assert!(distance <= allowed, "{distance} beyond {allowed}");
}

fn options(lambda: f64) -> Options {
    Options::paper()
        .lambda(lambda)
        .gap(1e-5)
        .max_iterations(20_000)
}

/// A penalty of each stencil's own changes the way, not the answer: the nuclear norm's duals do not depend on it.
#[test]
fn the_answer_does_not_depend_on_the_penalties() {
    let options = options(1e4);
    let mut both = Both::new(&Input::new(disk(16)), &options);
    let (lattice, _) = solve(&both.lattice, multigrid, &options);
    let (usual, _) = solve(&both.sparse, SparseGradients::new, &options);
    let mut noise = noise(8);
    let rho_shares: Vec<f64> = (0..both.sparse.operator.stencil_cells())
        .map(|_| 10f64.powf(noise()))
        .collect();
    both.sparse
        .operator
        .set_rho_shares(|stencil| rho_shares[stencil]);
    let (own, reason) = solve(&both.sparse, SparseGradients::new, &options);
    assert_eq!(reason, StopReason::Gap);
    assert_alike(&both, &lattice, &own);
    assert_ne!(own.admm.incumbent.z, usual.admm.incumbent.z);
    // Dual and Hessian are what the iterate is made of.
    for (stencil, rho_share) in rho_shares.iter().enumerate() {
        let (dual, hessian) = own.admm.iterate.matrices(&both.sparse, stencil);
        let v = dual + hessian.scale(own.admm.iterate.rho * rho_share);
        let [found, expected] = [v, own.admm.iterate.v.get(stencil)].map(|m| m.coordinates());
        for (a, b) in found.into_iter().zip(expected) {
            assert!((a - b).abs() <= 1e-12 * (1.0 + b.abs()), "{a} and {b}");
        }
    }
}

#[test]
fn a_lattice_as_a_matrix_has_its_sweeps() {
    let both = Both::new(&Input::new(disk(20)), &options(1e4));
    let (lattice, sparse) = (&both.lattice.operator, &both.sparse.operator);
    let mut noise = noise(7);
    let mut z = vec![0.0; lattice.vertex_cells()];
    for cell in lattice.vertices().cells() {
        z[cell] = noise();
    }
    let y: Vec<[f64; 3]> = (0..sparse.stencil_cells())
        .map(|_| [noise(), noise(), noise()])
        .collect();
    // From the lattice's cells to the numbers of its stencils.
    let numbers: Vec<usize> = lattice.stencils().cells().collect();
    let number = |cell: usize| numbers.binary_search(&cell).unwrap();
    let columns = both.of_cells(&z);
    let scale = lattice.spacing.powi(-2);
    let close = |a: f64, b: f64, size: f64| assert!((a - b).abs() < size, "{a} for {b}");

    fn run<O: SolvableOperator>(
        operator: &O,
        z: &[f64],
        y: impl Fn(usize) -> [f64; 3] + Sync,
    ) -> [Vec<f64>; 4] {
        let hessians = || vec![0.0; 3 * operator.stencil_cells()];
        let heights = || vec![0.0; operator.vertex_cells()];
        let mut found = (hessians(), heights());
        operator.sweep(
            &mut operator.scratch().unwrap(),
            z,
            std::slice::from_mut(&mut found),
            |(found, _), run, hessians, mut matrices| {
                for (i, stencil) in (run.start..run.end).enumerate() {
                    found[3 * stencil..][..3].copy_from_slice(&hessians.at(i));
                    matrices.set(i, y(stencil));
                }
            },
            |(_, found), run, sums| {
                for (i, vertex) in (run.start..run.end).enumerate() {
                    found[vertex] = sums.at(i);
                }
            },
        );
        let mut back = hessians();
        let mut single = vec![0.0f32; operator.vertex_cells()];
        operator.sweep_back(
            &mut operator.scratch().unwrap(),
            &mut single,
            std::slice::from_mut(&mut back),
            |_, run, mut matrices| {
                for (i, stencil) in (run.start..run.end).enumerate() {
                    matrices.set(i, y(stencil).map(|y| y as f32));
                }
            },
            |_, run, sums, heights| {
                assert_eq!(heights.len(), run.end - run.start);
                for (i, height) in heights.iter_mut().enumerate() {
                    *height = sums.at(i);
                }
            },
            |back, run, hessians| {
                for (i, stencil) in (run.start..run.end).enumerate() {
                    back[3 * stencil..][..3].copy_from_slice(&hessians.at(i).map(f64::from));
                }
            },
        );
        [
            found.0,
            found.1,
            single.iter().map(|z| (*z).into()).collect(),
            back,
        ]
    }
    let [h1, a1, s1, b1] = run(lattice, &z, |cell| y[number(cell)]);
    let [h2, a2, s2, b2] = run(sparse, &columns, |stencil| y[stencil]);
    for (stencil, cell) in numbers.iter().enumerate() {
        for k in 0..3 {
            close(h2[3 * stencil + k], h1[3 * cell + k], 1e-13 * scale);
            close(b2[3 * stencil + k], b1[3 * cell + k], 1e-4);
        }
    }
    for ((a, b), size) in [(a1, a2), (s1, s2)].into_iter().zip([1e-13 * scale, 1e-5]) {
        let a = both.of_cells(&a);
        for vertex in sparse.vertices().cells() {
            close(b[vertex], a[vertex], size);
        }
    }
    assert_eq!(sparse.vertices().len(), lattice.vertices().len());
    let (mut a, mut b) = (z.clone(), Vec::new());
    b.extend(numbers.iter().map(|cell| z[*cell]));
    lattice.spread(&mut a);
    sparse.spread(&mut b);
    for (stencil, cell) in numbers.iter().enumerate() {
        close(b[stencil], a[*cell], 1e-14);
    }
    // That of a part of the lattice is a little smaller.
    let ratio = sparse.norm() / lattice.norm();
    assert!((0.95..=1.1).contains(&ratio), "{ratio}");
}

#[test]
fn a_lattice_as_a_matrix_has_its_answer_under_every_energy() {
    let input = Input::new(disk(16));
    for energy in [
        Energy::Nuclear,
        Energy::Huber,
        Energy::Frobenius,
        Energy::SquaredNuclear,
    ] {
        let options = options(1e4).energy(energy);
        let both = Both::new(&input, &options);
        let (lattice, a) = solve(&both.lattice, multigrid, &options);
        let (sparse, b) = solve(&both.sparse, SparseGradients::new, &options);
        assert_eq!([a, b], [StopReason::Gap; 2], "{energy:?}");
        assert_alike(&both, &lattice, &sparse);
    }
}
