//! The fit of a noisy mesh goes nowhere through itself.

use developable::{Mesh, MeshOptions, fit_mesh};
use nalgebra::Vector3;

use crate::closed_meshes::{crossings, cube, normal, points, random, with_positions};

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

/// Next to sharp edges rays come together, and coarse noise makes vertices pass each other on these. Where triangles can
/// only be separated by moving vertices farther than the noise may have moved them, the report says which they are.
#[test]
fn what_crosses_along_sharp_edges_in_coarse_noise_is_separated_or_reported() {
    let mut reported = 0;
    for (cols, share, seeds) in [(12, 0.4, [5, 7, 11]), (24, 0.3, [7, 10, 11])] {
        let truth = leaning(cols, 3.0);
        assert_eq!(crossings(&truth), 0);
        for seed in seeds {
            let given = shaken(&truth, share * 2.0 / cols as f64, seed);
            assert!(crossings(&given) > 0);
            let surface = fit_mesh(&given, &MeshOptions::default()).unwrap();
            let report = surface.report();
            let found = (crossings(surface.mesh()), report.flipped[1]);
            if report.entangled.is_empty() {
                assert_eq!(found, (0, 0), "{cols} columns, seed {seed}");
                continue;
            }
            reported += 1;
            let places = points(surface.mesh());
            for entangled in &report.entangled {
                let corners = surface.mesh().triangles()[entangled.triangle];
                let middle: Point = corners.iter().map(|i| places[*i as usize]).sum();
                let off = middle / 3.0 - Point::from(entangled.position);
                assert!(off.norm() < 1e-9, "{off}");
            }
        }
    }
    assert!(reported <= 3, "{reported} of 6");
}
