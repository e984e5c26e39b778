use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{Rotation3, Vector3};

use super::geometry::{Frame, Point, normals};
use super::input::MeshInput;
use super::level_vertices::LevelVertices;
use super::linearisation::Linearisation;
use super::quadratic::{Neighbour, Quadratic};
use super::topology::Topology;
use super::{MeshOptions, fit_mesh};
use crate::fit::admm::iterate::Iterate;
use crate::fit::admm::parameters::AdmmParameters;
use crate::fit::admm::solver::{AdmmSolver, initial_rho};
use crate::fit::coordinates::Coordinates;
use crate::fit::energy::spectral_penalty::HuberParameters;
use crate::fit::heightfields;
use crate::fit::linear::cg::ConjugateGradients;
use crate::fit::linear::z_step_solver::SolvableOperator;
use crate::fit::operator::Operator;
use crate::fit::operator::lattice::position;
use crate::fit::operator::sparse::gradients::SparseGradients;
use crate::math::sym2::Sym2;
use crate::scene::view::Frame as Frame3;
use crate::{Error, Heightfield, Input, Lattice, Mesh, Options, Triangulation};

mod creases;
mod levels;
mod orientation;
mod self_intersections;
mod v_cycle;

use crate::closed_meshes::{cube, grid, indexed, normal, points, random, with_positions};

/// A pipe around the x axis, with uneven triangles.
fn pipe(cols: usize, radius: f64, length: f64) -> Mesh {
    let rows = (cols as f64 * length / (std::f64::consts::TAU * radius)).ceil() as usize;
    indexed(&grid(cols, rows, |u, v| {
        let angle = std::f64::consts::TAU * (u + 0.3 / cols as f64 * (40.0 * v).sin());
        let x = length * v;
        [x, radius * angle.cos(), radius * angle.sin()]
    }))
}

/// Moved along its normals.
fn noisy(mesh: &Mesh, sigma: f64) -> Mesh {
    let topology = Topology::new(mesh).unwrap();
    let mut x = points(mesh);
    let up = normals(&topology, &x, None);
    let mut random = random(9);
    for (x, up) in x.iter_mut().zip(up) {
        *x += sigma * normal(&mut random) * up;
    }
    with_positions(mesh, &x)
}

fn huber_penalty() -> HuberParameters {
    HuberParameters::from_options(&MeshOptions::default().common())
}

fn given(mesh: &Mesh) -> MeshInput {
    let topology = Topology::new(mesh).unwrap();
    MeshInput {
        noisy: points(mesh),
        confidence: Vec::new(),
        held: vec![false; topology.len()],
        reach: vec![f64::INFINITY; topology.len()],
        topology,
    }
}

/// About the mesh itself.
fn linearise(mesh: &Mesh) -> Linearisation {
    let given = given(mesh);
    let up = normals(&given.topology, &given.noisy, None);
    let frames = up
        .into_iter()
        .map(|n| Frame::from_normal(n, Point::x()))
        .collect();
    let vertices = LevelVertices::from_mesh(&given, given.noisy.clone(), frames, None);
    Linearisation::new(vertices, huber_penalty(), 1e4, None).unwrap()
}

#[test]
fn a_plane_of_hexagons_has_the_papers_stencil() {
    let (cols, h) = (12, 0.25);
    let lattice = Lattice::new(10, cols, h).unwrap();
    let flat = Heightfield::from_fn(lattice, |_, _| 0.0).unwrap();
    let flat = Triangulation::new(&flat, &Frame3::default()).unwrap();
    let mesh = Mesh::new(flat.positions().to_vec(), flat.triangles().to_vec()).unwrap();
    let linear = linearise(&mesh);
    assert!((linear.spacing / h - 1.0).abs() < 1e-12);
    let mut random = random(1);
    let heights: Vec<f64> = linear.vertices.base.iter().map(|_| random()).collect();
    let mut z: Vec<f64> = heights
        .iter()
        .zip(&linear.scales)
        .map(|(s, w)| s / w)
        .collect();
    z.push(1.0);
    let index: HashMap<[i64; 2], usize> = linear
        .vertices
        .base
        .iter()
        .enumerate()
        .map(|(i, x)| {
            (
                [
                    (4.0 * x.x / h).round() as i64,
                    (4.0 * x.y / h).round() as i64,
                ],
                i,
            )
        })
        .collect();
    let mut count = 0;
    linear.problem.operator.hessians(&z, |stencil, hessian| {
        let centre = linear.centres[stencil] as usize;
        let x = linear.vertices.base[centre];
        let at = |dx: f64, dy: f64| {
            let place = [x.x + dx * h, x.y + dy * h * 3f64.sqrt()];
            heights[index[&place.map(|p| (4.0 * p / h).round() as i64)]]
        };
        let (w, e, c) = (at(-1.0, 0.0), at(1.0, 0.0), heights[centre]);
        let [nw, ne] = [at(-0.5, 0.5), at(0.5, 0.5)];
        let [sw, se] = [at(-0.5, -0.5), at(0.5, -0.5)];
        let expected = [
            (w - 2.0 * c + e) / (h * h),
            (ne - nw + sw - se) / (3f64.sqrt() * h * h),
            (2.0 * (nw + ne + sw + se) - (w + e) - 6.0 * c) / (3.0 * h * h),
        ];
        for (found, expected) in hessian.entries().into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{found} for {expected}");
        }
        count += 1;
    });
    assert!(count > 50);
}

#[test]
fn a_lattice_as_a_mesh_has_the_lattices_answer() {
    let cols = 20;
    let lattice = Lattice::new(cols, cols, 1.0 / cols as f64).unwrap();
    let mut noise = random(5);
    let field = Heightfield::from_fn(lattice, |x, y| {
        0.3 * (x + 0.4 * y - 0.1).abs() + 0.1 * (6.0 * y).sin()
    })
    .unwrap();
    let heights: Vec<f64> = field.heights().iter().map(|z| z + 0.02 * noise()).collect();
    let field = Heightfield::new(lattice, heights).unwrap();
    let input = Input::new(field.clone());
    let options = Options::default().lambda(1e4).gap(1e-5);
    let domain = Arc::new(input.domain().unwrap());
    let coordinates = Coordinates::new(&input, &domain, 1.0);
    let problem =
        heightfields::Problem::new(&input, domain.clone(), &coordinates, &options).unwrap();
    fn solve<O: SolvableOperator>(
        problem: crate::fit::energy::problem::Problem<O>,
        options: &Options,
        solver: impl Fn(&crate::fit::energy::problem::Problem<O>, f64) -> O::Solver,
        start: Option<Vec<f64>>,
    ) -> AdmmSolver<O> {
        let parameters = AdmmParameters::new(options);
        let mut iterate = Iterate::new(&problem, initial_rho(&parameters, &problem)).unwrap();
        if let Some(start) = start {
            iterate.z = start;
        }
        let solver = solver(&problem, iterate.rho);
        let (mut level, mut reason) =
            AdmmSolver::new(problem, iterate, solver, parameters, 0, false).unwrap();
        while reason.is_none() {
            reason = level.advance(&mut 1000).unwrap();
        }
        level
    }
    let multigrid = |problem: &heightfields::Problem, rho| {
        ConjugateGradients::new(problem, std::slice::from_ref(&domain), rho).unwrap()
    };
    let a = solve(problem, &options, multigrid, None);

    // The same as a flat mesh whose vertices move upwards, from and to where the heights have them. Each
    // vertex counts alike.
    let flat = Triangulation::new(&field, &Frame3::default()).unwrap();
    let places: Vec<Point> = flat.positions().iter().map(|x| Point::from(*x)).collect();
    let base: Vec<Point> = places.iter().map(|x| Point::new(x.x, x.y, 0.0)).collect();
    let mesh = Mesh::new(
        base.iter().map(|x| (*x).into()).collect(),
        flat.triangles().to_vec(),
    )
    .unwrap();
    let topology = Topology::new(&mesh).unwrap();
    let areas = super::geometry::areas(&topology, &base);
    let whole = areas.iter().copied().fold(0.0, f64::max);
    let given = MeshInput {
        topology,
        noisy: places.clone(),
        confidence: areas.iter().map(|area| whole / area).collect(),
        held: vec![false; base.len()],
        reach: vec![f64::INFINITY; base.len()],
    };
    let frames = base
        .iter()
        .map(|_| Frame::from_normal(Point::z(), Point::x()))
        .collect();
    let bends = HuberParameters::from_options(&options);
    let vertices = LevelVertices::from_mesh(&given, base, frames, None);
    let linear = Linearisation::new(vertices, bends, 1e4, None).unwrap();
    let jacobi =
        |problem: &super::linearisation::Problem, rho| SparseGradients::new(problem, rho).unwrap();
    let b = solve(
        linear.problem.clone(),
        &options,
        jacobi,
        Some(linear.start()),
    );

    let bound = a.admm.incumbent.dual_bound.max(b.admm.incumbent.dual_bound);
    for gap in [
        a.admm.incumbent.objective() - bound,
        b.admm.incumbent.objective() - bound,
    ] {
        assert!(
            (-1e-12 * bound..2e-5 * bound).contains(&gap),
            "{gap:e} of {bound}"
        );
    }
    let found = linear.moved(&b.admm.incumbent.z);
    let radius = (2.0 * 1e-5 * bound / 1e4).sqrt();
    let mut square = 0.0f64;
    for cell in domain.active().cells() {
        let place = position(&domain, cell);
        let height = coordinates.outward(place, a.admm.incumbent.z[cell]);
        let vertex = (places.iter()).position(|x| (x.x - place[0]).hypot(x.y - place[1]) < 1e-9);
        square += (found[vertex.unwrap()].z - height).powi(2);
    }
    assert!(square.sqrt() < 2.0 * radius, "{square:e}");
}

#[test]
fn curvature_is_that_of_spheres_and_pipes() {
    let radius = 0.7;
    let ball = indexed(&grid(60, 14, |u, v| {
        let (phi, y) = (std::f64::consts::TAU * u, 1.2 * (v - 0.5));
        let r = (1.0 - y * y).sqrt();
        [r * phi.cos() * radius, r * phi.sin() * radius, y * radius]
    }));
    for (mesh, other) in [(ball, 1.0 / radius), (pipe(60, radius, 2.0), 0.0)] {
        let linear = linearise(&mesh);
        let mut count = 0;
        linear
            .problem
            .operator
            .hessians(&linear.start(), |_, hessian| {
                let [mut large, mut small] = hessian.eigenvalues();
                if small.abs() > large.abs() {
                    (large, small) = (small, large);
                }
                // The coordinates have their diagonal as it is here.
                assert!((large.abs() * radius - 1.0).abs() < 0.03, "{large}");
                assert!(
                    (small.abs() - other).abs() * radius < 0.03,
                    "{small} for {other}"
                );
                count += 1;
            });
        assert!(count > 500);
    }
}

#[test]
fn the_change_of_a_fit_is_its_derivative() {
    let mut random = random(2);
    for valence in [5, 6, 7, 9] {
        let frame = Frame::from_normal(Point::new(0.1, 0.2, 1.0).normalize(), Point::x());
        let offsets: Vec<Point> = (0..valence)
            .map(|k| {
                let angle = std::f64::consts::TAU * (k as f64 + 0.2 * random()) / valence as f64;
                let r = 1.0 + 0.2 * random();
                0.3 * Point::new(r * angle.cos(), r * angle.sin(), 0.4 * random())
            })
            .collect();
        let fit = |offsets: &[Point]| {
            let neighbours: Vec<_> = (offsets.iter())
                .map(|offset| Neighbour {
                    offset: *offset,
                    weight: 1.0,
                })
                .collect();
            Quadratic::fit(&frame, neighbours.into_iter()).unwrap()
        };
        let own = fit(&offsets);
        let check = |found: Sym2, moved: &dyn Fn(f64) -> Vec<Point>| {
            let t = 1e-5;
            let change = fit(&moved(t)).hessian() - fit(&moved(-t)).hessian();
            let expected = change.scale(0.5 / t).entries();
            for (found, expected) in found.entries().into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-4 * (1.0 + expected.abs()));
            }
        };
        for k in 0..valence {
            let v = Vector3::new(random(), random(), random());
            check(own.change(&frame, k, v), &|t| {
                let mut offsets = offsets.clone();
                offsets[k] += t * v;
                offsets
            });
        }
        let v = Vector3::new(random(), random(), random());
        check(own.change_at_centre(&frame, v), &|t| {
            offsets.iter().map(|offset| offset - t * v).collect()
        });
    }
}

/// Root mean square and largest distance from a cube's surface.
fn off_cube(mesh: &Mesh) -> f64 {
    let squares = points(mesh).into_iter().map(|x| (x.amax() - 1.0).powi(2));
    (squares.sum::<f64>() / mesh.positions().len() as f64).sqrt()
}

#[test]
fn a_noisy_cube_becomes_one() {
    let truth = cube(24);
    let sigma = 0.005 * 12f64.sqrt();
    let surface = fit_mesh(&noisy(&truth, sigma), &MeshOptions::default()).unwrap();
    let report = surface.report();
    assert!(
        (report.sigma.unwrap() / sigma - 1.0).abs() < 0.15,
        "{:?}",
        report.sigma
    );
    assert!(
        off_cube(surface.mesh()) < 0.4 * sigma,
        "{}",
        off_cube(surface.mesh()) / sigma
    );
    assert!(report.gap().unwrap() <= 0.01 && report.flipped[1] == 0);
    assert_eq!(
        (report.border, report.components, report.pinched),
        (0, 1, 0)
    );
    assert!(
        report
            .passes
            .iter()
            .all(|pass| pass.dual_bound <= pass.objective)
    );
    let [_, after] = report.volume.unwrap();
    assert!((after / 8.0 - 1.0).abs() < 0.02, "{after}");
    assert_eq!(surface.mesh().triangles(), truth.triangles());
}

/// A crease that keeps costs is rounded, and what is beside it goes out for that.
#[test]
fn faces_of_a_coarse_cube_stay_where_they_are() {
    let truth = cube(14);
    let sigma = 0.03;
    let given = noisy(&truth, sigma);
    let surface = fit_mesh(&given, &MeshOptions::default()).unwrap();
    let (mut out, mut faces) = (0.0, 0.0);
    let pairs = points(&given).into_iter().zip(points(surface.mesh()));
    for (t, (given, found)) in points(&truth).into_iter().zip(pairs) {
        let mut along = t.abs();
        along.as_mut_slice().sort_by(f64::total_cmp);
        if along.y < 0.7 {
            let up = t.map(|c| if c.abs() == 1.0 { c } else { 0.0 });
            out += (found - given).dot(&up);
            faces += 1.0;
        }
    }
    assert!(
        (out / faces).abs() < 0.05 * sigma,
        "{}",
        out / faces / sigma
    );
}

#[test]
fn a_pipe_with_borders_becomes_one() {
    let truth = pipe(60, 0.5, 2.0);
    let sigma = 0.01;
    let surface = fit_mesh(&noisy(&truth, sigma), &MeshOptions::default()).unwrap();
    let off = |x: &Point| (x.y.hypot(x.z) - 0.5).powi(2);
    let rms = |squares: Vec<f64>| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
    let x = points(surface.mesh());
    let all = rms(x.iter().map(off).collect());
    let border = x.iter().zip(points(&truth));
    let border = rms(border
        .filter(|(_, t)| t.x < 1e-9 || t.x > 2.0 - 1e-9)
        .map(|(x, _)| off(x))
        .collect());
    assert!(all < 0.35 * sigma, "{}", all / sigma);
    assert!(border < 0.7 * sigma, "{}", border / sigma);
    assert!(surface.report().volume.is_none() && surface.report().border == 120);
}

#[test]
fn motions_and_scale_change_nothing_else() {
    let mesh = noisy(&cube(10), 0.02);
    let turn = Rotation3::from_euler_angles(0.3, 1.1, -0.7);
    let (factor, shift) = (37.0, Point::new(500.0, -30.0, 12.0));
    let moved: Vec<Point> = points(&mesh)
        .iter()
        .map(|x| factor * (turn * x) + shift)
        .collect();
    let options = MeshOptions::default();
    let a = fit_mesh(&mesh, &options).unwrap();
    let scaled: Vec<Point> = points(&mesh).iter().map(|x| factor * x + shift).collect();
    let b = fit_mesh(&with_positions(&mesh, &scaled), &options).unwrap();
    for (a, b) in points(a.mesh()).iter().zip(points(b.mesh())) {
        assert!((factor * a + shift - b).norm() < 1e-4 * factor, "{a} {b}");
    }
    let c = fit_mesh(&with_positions(&mesh, &moved), &options).unwrap();
    let squares = points(a.mesh()).into_iter().zip(points(c.mesh()));
    let squares = squares.map(|(a, c)| (factor * (turn * a) + shift - c).norm_squared());
    let rms = (squares.sum::<f64>() / mesh.positions().len() as f64).sqrt() / factor;
    assert!(rms < 1e-3, "{rms}");
    assert!((a.report().sigma.unwrap() * factor / c.report().sigma.unwrap() - 1.0).abs() < 1e-3);
}

#[test]
fn what_can_be_mended_is_mended() {
    let truth = noisy(&cube(8), 0.01);
    // Each triangle with corners of its own, one of them there twice, one turned over, one of two corners,
    // and a vertex of no triangle.
    let mut positions: Vec<[f64; 3]> = vec![[9.0, 9.0, 9.0]];
    let mut triangles = Vec::new();
    for (i, triangle) in truth.triangles().iter().enumerate() {
        let first = positions.len() as u32;
        positions.extend(triangle.map(|i| truth.positions()[i as usize]));
        let mut own = [first, first + 1, first + 2];
        if i == 5 {
            own.swap(0, 1);
        }
        triangles.push(own);
    }
    triangles.push(triangles[7]);
    triangles.push([1, 2, 1]);
    let soup = Mesh::new(positions, triangles).unwrap();
    let a = fit_mesh(&soup, &MeshOptions::default()).unwrap();
    let b = fit_mesh(&truth, &MeshOptions::default()).unwrap();
    let repairs = a.report().repairs;
    assert_eq!(
        [
            repairs.repeated,
            repairs.degenerate,
            repairs.turned,
            repairs.unused
        ],
        [1, 1, 1, 1]
    );
    assert_eq!(
        repairs.joined,
        soup.positions().len() - 1 - truth.positions().len()
    );
    assert_eq!(a.report().vertices, truth.positions().len() + 1);
    assert_eq!(a.mesh().positions()[0], [9.0, 9.0, 9.0]);
    for (i, triangle) in truth.triangles().iter().enumerate() {
        for (k, corner) in triangle.iter().enumerate() {
            let found = Point::from(a.mesh().positions()[1 + 3 * i + k]);
            let expected = Point::from(b.mesh().positions()[*corner as usize]);
            assert!((found - expected).norm() < 1e-3);
        }
    }
}

fn refused(positions: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> String {
    let mesh = Mesh::new(positions, triangles).unwrap();
    let error = fit_mesh(&mesh, &MeshOptions::default().lambda(1e6)).unwrap_err();
    assert_eq!(error.code(), "TOPOLOGY");
    error.to_string()
}

#[test]
fn what_is_no_surface_is_refused_with_its_place() {
    // A strip that is turned half round.
    let mut places = Vec::new();
    for i in 0..12 {
        let angle = std::f64::consts::TAU * i as f64 / 12.0;
        for side in [-0.3, 0.3] {
            let r = 1.0 + side * (angle / 2.0).cos();
            places.push([r * angle.cos(), r * angle.sin(), side * (angle / 2.0).sin()]);
        }
    }
    let mut strip = Vec::new();
    for i in 0..12u32 {
        let [a, b, c, d] = match i {
            11 => [22, 23, 1, 0],
            _ => [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3],
        };
        strip.extend([[a, b, c], [b, d, c]]);
    }
    assert!(refused(places, strip).contains("Möbius"));
    let alone = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert!(refused(alone.clone(), vec![[0, 1, 2]]).contains("inside"));
    refused(vec![[2.0; 3]; 3], vec![[0, 1, 2]]);
    let cloud = fit_mesh(&Mesh::cloud(alone).unwrap(), &MeshOptions::default());
    assert!(matches!(cloud, Err(Error::Unsupported { .. })));
}

/// Three walls that meet along one edge, as those of a plan of a house: they stay together there, and noise goes.
#[test]
fn walls_that_meet_along_an_edge_are_borders_of_each_other() {
    let side = 16;
    let directions = [[1.0, 0.0], [-0.5, 0.8], [-0.5, -0.8]];
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    let mut random = random(3);
    for [x, y] in directions {
        let first = positions.len() as u32;
        let step = |i: usize| i as f64 / (side - 1) as f64;
        for (out, up) in (0..side).flat_map(|out| (0..side).map(move |up| (step(out), step(up)))) {
            // Across the wall, but not where the walls meet.
            let noise = if out > 0.0 {
                0.01 * normal(&mut random)
            } else {
                0.0
            };
            positions.push([x * out - y * noise, y * out + x * noise, up]);
        }
        let corner = |out: usize, up: usize| first + (out * side + up) as u32;
        for (out, up) in (0..side - 1).flat_map(|out| (0..side - 1).map(move |up| (out, up))) {
            let [a, b] = [corner(out, up), corner(out, up + 1)];
            let [c, d] = [corner(out + 1, up), corner(out + 1, up + 1)];
            triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    let walls = Mesh::new(positions, triangles).unwrap();
    let off = |mesh: &Mesh| {
        let squares = (mesh.positions().iter().enumerate()).map(|(i, [x, y, _])| {
            let [u, v] = directions[i / (side * side)];
            ((u * y - v * x) / f64::hypot(u, v)).powi(2)
        });
        (squares.sum::<f64>() / mesh.positions().len() as f64).sqrt()
    };
    let surface = fit_mesh(&walls, &MeshOptions::default()).unwrap();
    let report = surface.report();
    assert_eq!(report.repairs.branched, side - 1);
    let after = off(surface.mesh());
    assert!(after < 0.6 * off(&walls), "{after} {}", off(&walls));
    for up in 0..side {
        let [a, b, c] = [0, 1, 2].map(|k| surface.mesh().positions()[k * side * side + up]);
        assert_eq!([a, a], [b, c]);
    }
}

#[test]
fn slivers_and_flat_triangles_leave_everything_finite() {
    let mut x = points(&cube(8));
    let mesh = cube(8);
    let mut random = random(4);
    for x in &mut x {
        // Next to each other, and on lines.
        if random() > 0.5 {
            *x = x.map(|c| (c * 3.0).round() / 3.0 + 1e-9 * random());
        }
    }
    let surface = fit_mesh(&with_positions(&mesh, &x), &MeshOptions::default()).unwrap();
    assert!(
        surface
            .mesh()
            .positions()
            .as_flattened()
            .iter()
            .all(|x| x.is_finite())
    );
    assert!(surface.report().area.iter().all(|area| area.is_finite()));
}

#[test]
fn bent_strip_keeps_its_ends() {
    let cols = 60;
    let strip = indexed(&grid(cols, 24, |u, v| {
        let angle = 1.5 * (u - 0.5);
        [angle.sin(), 0.6 * v, angle.cos()]
    }));
    let options = MeshOptions::default().lambda(3e4).crease_radius(1e-3);
    let off = |options: &MeshOptions| {
        let found = fit_mesh(&strip, options).unwrap();
        let ends = found.mesh().positions().iter().zip(strip.positions());
        let ends =
            ends.filter(|(_, x)| x[0].abs() > 0.999 * 0.75f64.sin() && (x[1] - 0.3).abs() < 0.2);
        let errors: Vec<f64> = ends.map(|(x, _)| (x[0].hypot(x[2]) - 1.0).abs()).collect();
        errors.iter().sum::<f64>() / errors.len() as f64
    };
    let [without, with] = [off(&options.crease_passes(0)), off(&options)];
    assert!(without > 1e-3, "{without}");
    assert!(with < 0.5 * without, "{with} for {without}");
}

/// A square with a triangle on its border that is folded over onto it.
#[test]
fn a_folded_triangle_on_the_border_is_turned_back() {
    let mut soup = grid(10, 10, |u, v| [10.0 * u, 10.0 * v, 0.0]);
    soup.push([[4.0, 0.0, 0.0], [4.4, 0.6, 0.0], [5.0, 0.0, 0.0]]);
    let options = MeshOptions::default().lambda(1e6);
    let fitted = fit_mesh(&indexed(&soup), &options).unwrap();
    assert_eq!(fitted.report().flipped, [1, 0]);
}

/// Along one ray a vertex on a crease cannot be on both of its sides, and dents them.
#[test]
fn faces_are_flat_beside_their_edges() {
    let truth = cube(16);
    let surface = fit_mesh(&noisy(&truth, 0.02), &MeshOptions::default()).unwrap();
    let (flat, x) = (points(&truth), points(surface.mesh()));
    let (mut sum, mut count) = (0.0, 0.0);
    for triangle in truth.triangles() {
        let area = |x: &[Point]| {
            let [a, b, c] = triangle.map(|i| x[i as usize]);
            (b - a).cross(&(c - a)).normalize()
        };
        let near = |i: &u32| flat[*i as usize].iter().filter(|c| c.abs() > 0.99).count() > 1;
        if triangle.iter().any(near) {
            sum += area(&x).dot(&area(&flat)).min(1.0).acos();
            count += 1.0;
        }
    }
    let mean: f64 = sum / count;
    assert!(mean < 0.026, "{mean}");
}

/// A crease bears no moment, so that a bent side straightens towards it as towards a border.
#[test]
fn a_bent_side_stays_bent_up_to_its_crease() {
    // Half a pipe, closed by a plate, without lids.
    let soup: Vec<_> = [
        grid(48, 40, |u, v| {
            let angle = std::f64::consts::PI * u;
            [angle.cos(), 3.0 * v, angle.sin()]
        }),
        grid(30, 40, |u, v| [2.0 * u - 1.0, 3.0 * v, 0.0]),
    ]
    .concat();
    let truth = indexed(&soup);
    let options = MeshOptions::default().lambda(3e4);
    let found = fit_mesh(&truth, &options).unwrap();
    let x = points(found.mesh()).into_iter().zip(points(&truth));
    let near = x.filter(|(_, t)| t.z > 1e-9 && t.z < 0.3 && (t.y - 1.5).abs() < 1.0);
    let off: Vec<f64> = near.map(|(x, _)| (x.x.hypot(x.z) - 1.0).abs()).collect();
    let mean = off.iter().sum::<f64>() / off.len() as f64;
    assert!(mean < 1e-3, "{mean}");
}

/// Noise of several spacings along the view, as of a scanner near by: triangles of such a mesh stand steep and face any way.
#[test]
fn noise_of_several_spacings_is_measured_and_removed() {
    let height = |x: f64| 0.1 * (4.0 * x).sin();
    let sheet = indexed(&grid(80, 80, |u, v| [u, v, height(u)]));
    let (mut x, mut random, sigma) = (points(&sheet), random(4), 4.0 / 80.0);
    x.iter_mut()
        .for_each(|place| place.z += sigma * normal(&mut random));
    let fit = fit_mesh(&with_positions(&sheet, &x), &MeshOptions::default()).unwrap();
    let report = fit.report();
    let found = report.sigma.unwrap() / sigma;
    assert!((0.85..1.1).contains(&found), "{found}");
    assert_eq!((report.flipped[1], report.entangled.len()), (0, 0));
    let places = points(fit.mesh());
    let squares = places
        .iter()
        .map(|place| (place.z - height(place.x)).powi(2));
    let off = (squares.sum::<f64>() / places.len() as f64).sqrt();
    assert!(off < 0.12 * sigma, "{off}");
    let area = report.area[1] / whole_area(&sheet);
    assert!((area - 1.0).abs() < 0.02, "{area}");
}

/// Sum of the areas of a mesh's triangles.
fn whole_area(mesh: &Mesh) -> f64 {
    let places = points(mesh);
    let areas = mesh
        .triangles()
        .iter()
        .map(|triangle| super::geometry::twice_area(&places, triangle).norm());
    0.5 * areas.sum::<f64>()
}

/// Root mean square distance of vertices from a pipe's radius.
fn off_pipe(mesh: &Mesh, radius: f64) -> f64 {
    let squares = points(mesh)
        .into_iter()
        .map(|p| (p.y.hypot(p.z) - radius).powi(2));
    (squares.sum::<f64>() / mesh.positions().len() as f64).sqrt()
}

/// A fit that is stopped in its first pass is nearer to the truth than the input, and at once or on a coarse level not far from it.
#[test]
fn a_stopped_fit_keeps_what_it_has_found() {
    let input = noisy(&pipe(60, 0.5, 2.0), 0.01);
    let before = off_pipe(&input, 0.5);
    for until in [0, 1, 8] {
        let known = crate::MeshKnown::default();
        let options = MeshOptions::default();
        let mut solver = crate::MeshSolver::new(input.clone(), known, &options).unwrap();
        while solver.progress().iteration < until {
            solver.advance(1).unwrap();
        }
        solver.cancel().unwrap();
        let surface = solver.surface().unwrap();
        let report = surface.report();
        assert_eq!(
            (report.passes.len(), report.stop_reason),
            (1, crate::StopReason::Cancelled)
        );
        let after = off_pipe(surface.mesh(), 0.5);
        let most = if until < 8 { 1.5 } else { 0.8 };
        assert!(after < most * before, "{until}: {before} {after}");
    }
}
