use super::*;
use crate::fit::mesh::levels::{MeshLevels, WarmStart, zero_matrices};
use crate::fit::mesh::smooth_regions::SmoothRegions;
use crate::fit::operator::sparse::SparseOperator;
use crate::fit::report::StopReason;

fn options() -> MeshOptions {
    MeshOptions::default().gap(2e-3)
}

fn parameters() -> AdmmParameters {
    AdmmParameters::new(&options().common()).for_mesh()
}

/// About the mesh without noise, of a mesh with noise.
fn linearise_noisy(mesh: &Mesh, sigma: f64, sides: Option<&SmoothRegions>) -> Linearisation {
    let (base, mut given) = (points(mesh), given(mesh));
    given.noisy = points(&noisy(mesh, sigma));
    let up = normals(&given.topology, &base, None);
    let frames = up
        .into_iter()
        .map(|n| Frame::from_normal(n, Point::x()))
        .collect();
    let vertices = LevelVertices::from_mesh(&given, base, frames, sides);
    Linearisation::new(vertices, huber_penalty(), 1e4, sides).unwrap()
}

/// The solve of a level from nothing, without coarser levels.
fn cold(linear: &Linearisation) -> AdmmSolver<SparseOperator> {
    let (problem, parameters) = (linear.problem.clone(), parameters());
    let mut iterate = Iterate::new(&problem, initial_rho(&parameters, &problem)).unwrap();
    iterate.z.copy_from_slice(&linear.start());
    let jacobi = SparseGradients::new(&problem, iterate.rho).unwrap();
    let (mut solver, mut reason) =
        AdmmSolver::new(problem, iterate, jacobi, parameters, 0, false).unwrap();
    while reason.is_none() {
        reason = solver.advance(&mut 100).unwrap();
    }
    assert_eq!(reason, Some(StopReason::Gap));
    solver
}

/// Solves with coarser levels and without, compares what both certify, and returns their iterations on the mesh itself.
fn compare(linear: Linearisation, warm: Option<&WarmStart>) -> [usize; 2] {
    let options = options();
    let (mut levels, mut reason) = MeshLevels::new(linear, warm, &options, parameters()).unwrap();
    while reason.is_none() {
        reason = levels.advance(&mut 100).unwrap();
    }
    assert_eq!(reason, Some(StopReason::Gap));
    let (linear, own) = (levels.finest(), &levels.solver);
    assert!(levels.iterations()[0] > own.report().iterations);
    let cold = cold(linear);
    let (a, b) = (&own.admm.incumbent, &cold.admm.incumbent);
    let bound = a.dual_bound.max(b.dual_bound);
    for objective in [a.objective(), b.objective()] {
        assert!((bound..(1.0 + 2.0 * options.gap) * bound).contains(&objective));
    }
    // Each is as near to the optimum as its gap says, because the fidelity is strongly convex.
    let radius = |objective: f64| ((objective - bound) / linear.problem.lambda).sqrt();
    let squares = a.z.iter().zip(&b.z).map(|(a, b)| (a - b) * (a - b));
    let apart = squares.sum::<f64>().sqrt();
    assert!(apart <= radius(a.objective()) + radius(b.objective()));
    [own, &cold].map(|solver| solver.report().iterations)
}

#[test]
fn coarser_levels_lead_to_the_same_optimum_in_fewer_iterations() {
    let [own, cold] = compare(linearise_noisy(&pipe(80, 0.2, 1.0), 0.004, None), None);
    assert!(5 * own <= 4 * cold, "{own} {cold}");
}

#[test]
fn coarser_levels_lead_to_the_same_optimum_at_creases() {
    let cube = cube(32);
    let x: Vec<Point> = points(&cube).iter().map(|x| 0.25 * x).collect();
    let cube = with_positions(&cube, &x);
    let topology = Topology::new(&cube).unwrap();
    let sides = SmoothRegions::new(&topology, &x).unwrap();
    let linear = linearise_noisy(&cube, 0.002, Some(&sides));
    let warm = WarmStart {
        matrices: zero_matrices(&linear).unwrap(),
        rho: linear.spacing,
        sides,
    };
    compare(linear, Some(&warm));
}
