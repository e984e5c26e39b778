use super::*;
use crate::closed_meshes::crossings;
use crate::fit::mesh::self_intersections::separate_self_intersections;

/// Two vertices next to each other on an edge of a cube change places.
#[test]
fn vertices_that_passed_each_other_on_a_crease_go_back() {
    let truth = cube(8);
    let given = given(&truth);
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
    separate_self_intersections(&given, &mut x, &|v| edge(&given.noisy[v]));
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
    separate_self_intersections(&given, &mut x, &|_| false);
    assert_eq!(x, given.noisy);
}
