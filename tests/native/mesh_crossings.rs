//! The fit of a noisy mesh goes nowhere through itself.

use developable::{Mesh, MeshOptions, fit_mesh};
use nalgebra::Vector3;

use crate::common::closed_meshes::{crossings, cube, normal, points, random, with_positions};

type Point = Vector3<f64>;

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
