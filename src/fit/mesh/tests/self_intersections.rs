use nalgebra::Matrix3;

use super::*;
use crate::fit::mesh::self_intersections::separate_self_intersections;
use crate::fit::mesh::vertex_fans::VertexFans;

/// A cube leant over, so that four of its edges are sharp.
fn leaning(cols: usize, by: f64) -> Mesh {
    let cube = cube(cols);
    let leant = points(&cube).into_iter();
    let leant: Vec<Point> = leant.map(|x| x + Point::x() * (by * x.y)).collect();
    with_positions(&cube, &leant)
}

/// Moved in all directions.
fn shaken(mesh: &Mesh, sigma: f64, seed: u64) -> Mesh {
    let mut random = random(seed);
    let moved = points(mesh).into_iter();
    let moved: Vec<Point> = moved
        .map(|x| x + sigma * Point::from_fn(|_, _| normal(&mut random)))
        .collect();
    with_positions(mesh, &moved)
}

/// Pairs of triangles without a common corner, one of which has a side that goes through the other.
fn crossings(mesh: &Mesh) -> usize {
    let x = points(mesh);
    let triangles = mesh.triangles();
    let boxes: Vec<[Point; 2]> = (triangles.iter())
        .map(|t| {
            let [a, b, c] = t.map(|i| x[i as usize]);
            [a.inf(&b).inf(&c), a.sup(&b).sup(&c)]
        })
        .collect();
    let pierced = |side: [u32; 2], t: &[u32; 3]| {
        let [p, q] = side.map(|i| x[i as usize]);
        let [a, b, c] = t.map(|i| x[i as usize]);
        let system = Matrix3::from_columns(&[b - a, c - a, p - q]);
        let sizes: f64 = system.column_iter().map(|column| column.norm()).product();
        let Some(inverse) = system.try_inverse() else {
            return false;
        };
        let [u, v, way] = (inverse * (p - a)).into();
        // In one plane they only touch.
        system.determinant().abs() > 1e-9 * sizes
            && u >= 0.0
            && v >= 0.0
            && u + v <= 1.0
            && (0.0..=1.0).contains(&way)
    };
    let through = |s: &[u32; 3], t: &[u32; 3]| (0..3).any(|k| pierced([s[k], s[(k + 1) % 3]], t));
    let mut found = 0;
    for (i, s) in triangles.iter().enumerate() {
        for (j, t) in triangles.iter().enumerate().skip(i + 1) {
            let apart =
                (0..3).any(|k| boxes[i][1][k] < boxes[j][0][k] || boxes[j][1][k] < boxes[i][0][k]);
            if !apart && !s.iter().any(|i| t.contains(i)) && (through(s, t) || through(t, s)) {
                found += 1;
            }
        }
    }
    found
}

/// Next to sharp edges rays come together, and coarse noise makes vertices pass each other on these.
#[test]
fn nothing_crosses_along_sharp_edges_in_coarse_noise() {
    for (cols, share, seeds) in [(12, 0.4, [5, 7, 11]), (24, 0.3, [7, 10, 11])] {
        let truth = leaning(cols, 3.0);
        assert_eq!(crossings(&truth), 0);
        for seed in seeds {
            let given = shaken(&truth, share * 2.0 / cols as f64, seed);
            assert!(crossings(&given) > 0);
            let surface = fit_mesh(&given, &MeshOptions::default()).unwrap();
            let found = (crossings(surface.mesh()), surface.report().flipped[1]);
            assert_eq!(found, (0, 0), "{cols} columns, seed {seed}");
        }
    }
}

/// Two vertices next to each other on an edge of a cube change places.
#[test]
fn vertices_that_passed_each_other_on_a_crease_go_back() {
    let truth = cube(8);
    let given = given(&truth);
    let topology = &given.topology;
    let vertex_fans = VertexFans::new(topology);
    let edge = |x: &Point| x.x == 1.0 && x.y == 1.0;
    let at = |z: f64| {
        let all = given.noisy.iter();
        all.clone()
            .position(|x| edge(x) && (x.z - z).abs() < 1e-9)
            .unwrap()
    };
    let mut x = given.noisy.clone();
    let (one, other) = (at(0.0), at(0.25));
    x[one].z += 0.35;
    x[other].z -= 0.2;
    assert!(crossings(&with_positions(&truth, &x)) > 0);
    let held = vec![false; topology.len()];
    separate_self_intersections(topology, &vertex_fans, &mut x, &held, &|v| {
        edge(&given.noisy[v])
    });
    assert_eq!(crossings(&with_positions(&truth, &x)), 0);
    assert!(x[at(-0.25)].z < x[one].z && x[one].z < x[other].z && x[other].z < x[at(0.5)].z);
    // What is not near stays, and what is on the edge slides along it.
    for (x, before) in x.iter().zip(&given.noisy) {
        assert!((x - before).norm() < 1e-12 || (x - before).norm() < 0.3 && before.norm() < 2.0);
        assert!(!edge(before) || edge(x));
    }
}

#[test]
fn bodies_put_through_each_other_stay() {
    let (one, offset) = (cube(6), Point::new(1.03, 0.91, 0.87));
    let mut positions = one.positions().to_vec();
    positions.extend(points(&one).iter().map(|x| <[f64; 3]>::from(x + offset)));
    let count = one.positions().len() as u32;
    let mut triangles = one.triangles().to_vec();
    triangles.extend(one.triangles().iter().map(|t| t.map(|i| i + count)));
    let both = Mesh::new(positions, triangles).unwrap();
    assert!(crossings(&both) > 0);
    let given = given(&both);
    let mut x = given.noisy.clone();
    let vertex_fans = VertexFans::new(&given.topology);
    separate_self_intersections(&given.topology, &vertex_fans, &mut x, &given.held, &|_| {
        false
    });
    assert_eq!(x, given.noisy);
}
