//! Polyhedra with noise, as scans of roofs and boxes are, smooth surfaces with noise, which are none, and bends of cylinders in
//! triangles of any kind.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use developable::pattern::{FoundFaces, MeshKind, NetOptions, RecognizedMesh};
use developable::{Exactness, Mesh};
use nalgebra::{Rotation3, Vector3};

use crate::closed_meshes::cube;
use crate::native::common::Random;
use crate::native::common::irregular::Tessellation;

fn faces_of(mesh: &Mesh, kind: MeshKind) -> Option<FoundFaces> {
    let found = RecognizedMesh::of(mesh).unwrap();
    found.faces.filter(|_| found.kind == kind)
}

fn noisy_faces(mesh: &Mesh) -> Option<FoundFaces> {
    faces_of(mesh, MeshKind::NoisyFaces)
}

/// A roof over 12 × 8: its name, the number of its faces, and its height at a place.
type Roof = (&'static str, usize, fn(f64, f64) -> f64);

const ROOFS: [Roof; 5] = [
    ("gable", 2, |_, y| 0.8 * y.min(8.0 - y)),
    ("hip", 4, |x, y| 0.7 * y.min(8.0 - y).min(x).min(12.0 - x)),
    // Four planes meet at the top.
    ("pyramid", 4, |x, y| {
        (0.8 * y.min(8.0 - y)).min(0.8 / 1.5 * x.min(12.0 - x))
    }),
    // A lower gable across a higher one, with four valleys.
    ("cross", 6, |x, y| {
        (0.8 * y.min(8.0 - y)).max(0.8 * (x - 3.0).min(9.0 - x))
    }),
    ("gambrel", 4, |_, y| {
        (1.5 * y.min(8.0 - y)).min(1.5 + 0.4 * y.min(8.0 - y))
    }),
];

const BENT: [Roof; 6] = [
    ("barrel", 0, |_, y| (64.0 - (y - 4.0).powi(2)).sqrt()),
    ("vault", 0, |_, y| (25.0 - (y - 4.0).powi(2)).sqrt()),
    ("dome", 0, |x, y| {
        (144.0 - (x - 6.0).powi(2) - (y - 4.0).powi(2)).sqrt()
    }),
    ("saddle", 0, |x, y| 0.05 * (x - 6.0) * (y - 4.0)),
    ("waves", 0, |x, y| {
        0.5 * (x + 0.3 * y).sin() + 0.3 * (0.7 * y - 0.2 * x).cos()
    }),
    // A gable whose halves are bent.
    ("arch", 0, |_, y| 1.2 * y.min(8.0 - y).powf(0.7)),
];

/// A scan of a roof: heights have normally distributed noise, and places a third of that.
fn scan(roof: Roof, triangles: Tessellation, side: usize, noise: f64, seed: u64) -> Mesh {
    let (places, triangles) = triangles.build(side, seed);
    let mut random = Random::spread(seed + 1000);
    let points = places.iter().map(|[u, v]| {
        let (x, y) = (12.0 * u, 8.0 * v);
        let [a, b, c] = [0, 1, 2].map(|_| noise * random.normal());
        [x + 0.3 * a, y + 0.3 * b, roof.2(x, y) + c]
    });
    Mesh::new(points.collect(), triangles).unwrap()
}

#[test]
fn roofs_with_noise_have_their_faces() {
    for roof in ROOFS {
        let mesh = scan(roof, Tessellation::Regular, 60, 0.01, 7);
        let found = noisy_faces(&mesh).expect(roof.0);
        assert_eq!(found.count, roof.1, "{}", roof.0);
        assert!(
            (0.005..0.01).contains(&found.noise),
            "{} {}",
            roof.0,
            found.noise
        );
        let pattern = found.pattern(&NetOptions::default()).unwrap();
        assert_eq!(pattern.patches.len(), roof.1);
        let (cells, step) = (240, 1.0 / 240.0);
        let slope = |x: f64, y: f64| {
            let d = 1e-6;
            let (p, q) = (
                roof.2(x + d, y) - roof.2(x - d, y),
                roof.2(x, y + d) - roof.2(x, y - d),
            );
            (1.0 + (p * p + q * q) / (4.0 * d * d)).sqrt()
        };
        let places = (0..cells * cells).map(|k| [k % cells, k / cells]);
        let places = places.map(|cell| cell.map(|k| (k as f64 + 0.5) * step));
        let area: f64 = places
            .map(|[u, v]| 96.0 * step * step * slope(12.0 * u, 8.0 * v))
            .sum();
        let flat: f64 = pattern.sheets.iter().map(|sheet| sheet.area).sum();
        assert!(
            (flat / area - 1.0).abs() < 0.004,
            "{} {flat} {area}",
            roof.0
        );
        assert!(pattern.sheets.iter().all(|sheet| sheet.strain == 0.0));
    }
}

#[test]
fn a_gable_with_noise_is_one_sheet_with_one_straight_fold_wherever_it_stands() {
    let mesh = scan(ROOFS[0], Tessellation::Regular, 60, 0.01, 15);
    let far: Vec<[f64; 3]> = (mesh.positions().iter())
        .map(|[x, y, z]| [x + 432_123.456, y + 5_412_345.678, z + 251.2])
        .collect();
    let far = Mesh::new(far, mesh.triangles().to_vec()).unwrap();
    let sheets = [&mesh, &far].map(|mesh| {
        let found = noisy_faces(mesh).unwrap();
        let sheets = found.pattern(&NetOptions::default()).unwrap().sheets;
        let [sheet] = &sheets[..] else {
            panic!("{} sheets", sheets.len());
        };
        let [fold] = &sheet.folds[..] else {
            panic!("{} folds", sheet.folds.len());
        };
        assert_eq!(fold.points.len(), 2);
        let angle = fold.seam.angle.to_degrees();
        assert!(
            (angle - 2.0 * 0.8f64.atan().to_degrees()).abs() < 0.1,
            "{angle}"
        );
        let [a, b] = [fold.points[0], fold.points[1]];
        let long = (a[0] - b[0]).hypot(a[1] - b[1]);
        assert!((long - 12.0).abs() < 0.02, "{long}");
        (sheet.area, long)
    });
    assert!((sheets[0].0 - sheets[1].0).abs() < 1e-6 && (sheets[0].1 - sheets[1].1).abs() < 1e-6);
}

#[test]
fn a_closed_box_with_noise_has_six_faces_though_no_vertex_lies_on_its_edges() {
    let turn = Rotation3::from_euler_angles(0.4, 0.5, 0.6);
    let half = Vector3::new(60.0, 40.0, 25.0);
    let ball = cube(24);
    let mut random = Random::spread(5);
    let points = ball.positions().iter().map(|p| {
        let along = turn * Vector3::from(*p);
        // The ray from the middle to the box.
        let far = (0..3)
            .map(|k| half[k] / along[k].abs())
            .fold(f64::INFINITY, f64::min);
        (along * far + Vector3::from([0, 1, 2].map(|_| 0.2 * random.normal()))).into()
    });
    let mesh = Mesh::new(points.collect(), ball.triangles().to_vec()).unwrap();
    let found = noisy_faces(&mesh).expect("a box");
    assert_eq!(found.count, 6);
    let pattern = found.pattern(&NetOptions::default()).unwrap();
    let [sheet] = &pattern.sheets[..] else {
        panic!("{} sheets", pattern.sheets.len());
    };
    let area = 8.0 * (60.0 * 40.0 + 60.0 * 25.0 + 40.0 * 25.0);
    assert!(
        (sheet.area / area - 1.0).abs() < 0.003,
        "{} {area}",
        sheet.area
    );
    assert_eq!(sheet.folds.len(), 5);
    for fold in &sheet.folds {
        assert!((fold.seam.angle.to_degrees() - 90.0).abs() < 0.3);
    }
}

#[test]
fn walls_that_are_partly_round_and_steps_have_no_faces() {
    let mixed: [Roof; 3] = [
        // A quarter is round, and so is a twelfth.
        ("bay", 0, |x, _| (36.0 - (x - 9.0).max(0.0).powi(2)).sqrt()),
        ("edge", 0, |x, _| (4.0 - (x - 11.0).max(0.0).powi(2)).sqrt()),
        // Treads of which one row of triangles each is the riser.
        ("stairs", 0, |x, _| (x / 2.95).floor()),
    ];
    for roof in mixed {
        let found = noisy_faces(&scan(roof, Tessellation::Regular, 60, 0.003, 3));
        assert!(found.is_none(), "{}", roof.0);
    }
}

#[test]
fn smooth_surfaces_with_noise_have_no_faces() {
    for roof in BENT {
        for (seed, triangles) in (0..).zip(Tessellation::ALL) {
            for (side, noise) in [(20, 0.003), (40, 0.01), (40, 0.03)] {
                let found = noisy_faces(&scan(roof, triangles, side, noise, seed));
                let faces = found.map(|found| (found.count, found.noise));
                assert!(
                    faces.is_none(),
                    "{} {triangles:?} {side} {noise} {faces:?}",
                    roof.0
                );
            }
        }
    }
}

/// A sheet of 100 × 60 less half a triangle around, in irregular triangles without those within a circle about its middle, bent by 90°
/// with radius 10 at places along it; with its area, length and width when flat.
fn bent_sheet(bends: &[f64], hole: f64, seed: u64) -> (Mesh, f64, [f64; 2]) {
    let (places, triangles) = Tessellation::RaggedRim.build(40, seed);
    let flat: Vec<[f64; 2]> = places.iter().map(|[u, v]| [100.0 * u, 60.0 * v]).collect();
    let middle = |t: &[u32; 3], k: usize| t.iter().map(|v| flat[*v as usize][k]).sum::<f64>() / 3.0;
    let is_kept = |t: &[u32; 3]| (middle(t, 0) - 50.0).hypot(middle(t, 1) - 30.0) > hole;
    let triangles: Vec<[u32; 3]> = triangles.into_iter().filter(is_kept).collect();
    let area = triangles.iter().map(|t| {
        let [a, b, c] = t.map(|v| flat[v as usize]);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    });
    let area = area.sum();
    let points = flat.iter().map(|[along, across]| {
        let (mut x, mut z, mut turn, mut from) = (0.0, 0.0, 0.0f64, 0.0);
        for bend in bends {
            let start = (bend - 10.0 * FRAC_PI_4).min(*along);
            x += (start - from) * turn.cos();
            z += (start - from) * turn.sin();
            let by = ((along - start) / 10.0).min(FRAC_PI_2);
            x += 10.0 * ((turn + by).sin() - turn.sin());
            z += 10.0 * (turn.cos() - (turn + by).cos());
            (turn, from) = (turn + by, start + 10.0 * by);
        }
        [
            x + (along - from) * turn.cos(),
            *across,
            z + (along - from) * turn.sin(),
        ]
    });
    let extent = [0, 1].map(|k| {
        let all = flat.iter().map(|p| p[k]);
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    });
    (
        Mesh::new(points.collect(), triangles).unwrap(),
        area,
        extent,
    )
}

#[test]
fn bends_in_any_triangles_have_parallel_lines_and_the_blank_that_they_were_bent_from() {
    for (bends, hole) in [(&[50.0][..], 0.0), (&[50.0], 6.0), (&[25.0, 75.0], 0.0)] {
        let (mesh, area, [long, wide]) = bent_sheet(bends, hole, 4);
        assert_eq!(
            Exactness::of(&mesh),
            Exactness::Vertices,
            "{bends:?} {hole}"
        );
        let found = faces_of(&mesh, MeshKind::Bends).expect("a bent sheet");
        let sheets = found.pattern(&NetOptions::default()).unwrap().sheets;
        let [sheet] = &sheets[..] else {
            panic!("{} sheets", sheets.len());
        };
        assert!(
            (sheet.area - area).abs() < 1e-6 * area,
            "{} {area}",
            sheet.area
        );
        assert_eq!(sheet.outlines.len(), if hole > 0.0 { 2 } else { 1 });
        let along = |points: &[[f64; 2]]| {
            let [a, b] = [points[0], points[points.len() - 1]];
            let long = (b[0] - a[0]).hypot(b[1] - a[1]);
            [(b[0] - a[0]) / long, (b[1] - a[1]) / long]
        };
        let first = along(&sheet.folds[0].points);
        for fold in &sheet.folds {
            let [x, y] = along(&fold.points);
            assert!((x * first[1] - y * first[0]).abs() < 1e-5);
            // A hole inside of a bend leaves lines of their own beside it.
            if hole == 0.0 {
                let bend = fold.bend.expect("a line of a bend");
                assert!(
                    (bend.angle.to_degrees() - 90.0).abs() < 0.01,
                    "{}",
                    bend.angle.to_degrees()
                );
                assert!((bend.radius - 10.0).abs() < 0.1, "{}", bend.radius);
            }
        }
        // The sheet's extent along and across the lines.
        let extent = |[x, y]: [f64; 2]| {
            let all = sheet.faces.flat.iter().map(|p| p[0] * x + p[1] * y);
            all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
        };
        let [x, y] = first;
        assert!((extent([x, y]) - wide).abs() < 1e-3 && (extent([y, -x]) - long).abs() < 1e-3);
    }
}

#[test]
fn what_is_bent_otherwise_has_no_rolled_faces() {
    for roof in &BENT[2..] {
        let mesh = scan(*roof, Tessellation::Regular, 30, 0.0, 3);
        assert!(faces_of(&mesh, MeshKind::Bends).is_none(), "{}", roof.0);
    }
}
