//! What is made of meshes as they are: patches, curvatures and patterns, by closed forms.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2, TAU};

use developable::Mesh;
use developable::analysis::MeshCurvatures;
use developable::drawing::{Drawing, DrawingOptions, Totals};
use developable::files::assembly::write_assembly_svg;
use developable::patches::{MeshPatches, PatchOptions};
use developable::pattern::{Pattern, PatternOptions, Sheet, pattern_mesh};
use developable::rulings::{Ruling, Rulings, TraceOptions};

/// The triangles of a map from the unit square, corners at one place being one vertex, and those without an
/// area left out.
fn surface(maps: &[&dyn Fn(f64, f64) -> [f64; 3]], cols: usize, rows: usize) -> Mesh {
    let (mut places, mut triangles, mut found) = (Vec::new(), Vec::new(), HashMap::new());
    for map in maps {
        let mut vertex = |i: usize, j: usize| {
            let place = map(i as f64 / cols as f64, j as f64 / rows as f64);
            let key = place.map(|x| (x * 1e8).round() as i64);
            *found.entry(key).or_insert_with(|| {
                places.push(place);
                places.len() as u32 - 1
            })
        };
        for i in 0..cols {
            for j in 0..rows {
                let [a, b] = [vertex(i, j), vertex(i + 1, j)];
                let [c, d] = [vertex(i + 1, j + 1), vertex(i, j + 1)];
                let both = match (i + j) % 2 {
                    0 => [[a, b, c], [a, c, d]],
                    _ => [[a, b, d], [b, c, d]],
                };
                let whole = |t: &&[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
                triangles.extend(both.iter().filter(whole));
            }
        }
    }
    Mesh::new(places, triangles).unwrap()
}

/// A box of given sides, each divided into squares.
fn cuboid([a, b, c]: [f64; 3], count: usize) -> Mesh {
    surface(
        &[
            &|u, v| [a * u, b * (1.0 - v), 0.0],
            &|u, v| [a * u, b * v, c],
            &|u, v| [a * u, 0.0, c * v],
            &|u, v| [a * (1.0 - u), b, c * v],
            &|u, v| [0.0, b * (1.0 - u), c * v],
            &|u, v| [a, b * u, c * v],
        ],
        count,
        count,
    )
}

/// A tube of radius 1 from z = 0 to a slanting cut.
fn slanting(angle: f64) -> f64 {
    2.0 + 0.5 * angle.cos()
}

fn tube(around: usize) -> Mesh {
    surface(
        &[&|u, v| {
            let angle = TAU * u;
            [angle.cos(), angle.sin(), v * slanting(angle)]
        }],
        around,
        around / 4,
    )
}

fn pattern_of(mesh: &Mesh) -> (MeshPatches, Pattern) {
    let patches = MeshPatches::new(mesh, &PatchOptions::default()).unwrap();
    let pattern = pattern_mesh(mesh, &patches, &PatternOptions::default()).unwrap();
    (patches, pattern)
}

/// Area within the outlines of a sheet, holes running clockwise.
fn enclosed(sheet: &Sheet) -> f64 {
    let runs = sheet.outlines.iter().flatten();
    let pieces = runs.flat_map(|run| run.points.windows(2));
    0.5 * pieces
        .map(|p| p[0][0] * p[1][1] - p[0][1] * p[1][0])
        .sum::<f64>()
}

fn area_of(mesh: &Mesh) -> f64 {
    mesh.triangles().iter().map(|t| area(mesh, t)).sum()
}

fn area(mesh: &Mesh, triangle: &[u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|v| nalgebra::Vector3::from(mesh.positions()[v as usize]));
    0.5 * (b - a).cross(&(c - a)).norm()
}

#[test]
fn a_box_has_six_faces_and_one_net() {
    for count in [1, 4] {
        let sides = [3.0, 2.0, 1.0];
        let (patches, pattern) = pattern_of(&cuboid(sides, count));
        let areas: Vec<f64> = patches.patches().iter().map(|patch| patch.area).collect();
        for (area, expected) in areas.iter().zip([6.0, 6.0, 3.0, 3.0, 2.0, 2.0]) {
            assert!((area - expected).abs() < 1e-12, "{areas:?}");
        }
        assert_eq!((areas.len(), patches.creases().len()), (6, 12));
        assert!(
            patches
                .creases()
                .iter()
                .all(|crease| (crease.fold - FRAC_PI_2).abs() < 1e-12)
        );
        let [sheet] = &pattern.sheets[..] else {
            panic!("{} sheets", pattern.sheets.len());
        };
        // Five folds hold six faces together, and all bend outwards.
        assert_eq!(sheet.folds.len(), 5);
        assert!(sheet.folds.iter().all(|fold| {
            fold.seam.direction == developable::pattern::Direction::Mountain && !fold.seam.slit
        }));
        assert!(sheet.strain < 1e-12 && sheet.seam_gap < 1e-12);
        assert!((enclosed(sheet) - 22.0).abs() < 1e-9, "{}", enclosed(sheet));
        // Each of the other seven edges is there twice.
        let cuts: Vec<_> = sheet
            .outlines
            .iter()
            .flatten()
            .map(|run| run.seam)
            .collect();
        assert_eq!(cuts.len(), 14);
    }
}

/// Its lid, that is: all else faces away or is seen from its edge.
#[test]
fn the_picture_of_an_assembly_has_of_a_box_what_is_seen_from_above() {
    let (_, pattern) = pattern_of(&cuboid([3.0, 2.0, 1.0], 4));
    let svg = String::from_utf8(write_assembly_svg(&pattern.sheets).unwrap()).unwrap();
    assert_eq!(svg.matches("class=\"patch\"").count(), 1);
    let start = svg.find("d=\"M").unwrap() + 4;
    let line = &svg[start..start + svg[start..].find('Z').unwrap()];
    let corners: Vec<[f64; 2]> = (line.split('L'))
        .map(|corner| {
            let mut numbers = corner.split_whitespace().map(|v| v.parse().unwrap());
            [(); 2].map(|()| numbers.next().unwrap())
        })
        .collect();
    let turned: f64 = (0..corners.len())
        .map(|i| {
            let ([ax, ay], [bx, by]) = (corners[i], corners[(i + 1) % corners.len()]);
            0.5 * (ax * by - bx * ay)
        })
        .sum();
    // As large as it is, with its longer side 1000 units long.
    let lid = 1000.0 * 2000.0 / 3.0;
    assert!((turned.abs() / lid - 1.0).abs() < 1e-3, "{turned}");
}

#[test]
fn a_tube_with_a_slanting_cut_unrolls_to_a_sine() {
    let around = 96;
    let mesh = tube(around);
    let (patches, pattern) = pattern_of(&mesh);
    assert_eq!(patches.patches().len(), 1);
    let [sheet] = &pattern.sheets[..] else {
        panic!("{} sheets", pattern.sheets.len());
    };
    assert!(sheet.strain < 1e-6, "{}", sheet.strain);
    assert!((enclosed(sheet) - area_of(&mesh)).abs() < 1e-6);
    assert!((area_of(&mesh) - 4.0 * PI).abs() < 0.01);
    assert!(sheet.folds.is_empty());
    let cut: Vec<_> = sheet
        .outlines
        .iter()
        .flatten()
        .filter(|run| run.seam.is_some())
        .collect();
    assert!(cut.len() == 2 && cut.iter().all(|run| run.seam.unwrap().slit));
    // Above the foot, which is straight, the other end is as high as the tube there.
    let faces = &sheet.faces;
    let on_foot = (0..faces.flat.len()).filter(|i| faces.built[*i][2].abs() < 1e-9);
    let foot: Vec<[f64; 2]> = on_foot.map(|i| faces.flat[i]).collect();
    let far = |p: &[f64; 2], q: &[f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let (first, last) = foot
        .iter()
        .flat_map(|p| foot.iter().map(move |q| (p, q)))
        .max_by(|a, b| far(a.0, a.1).total_cmp(&far(b.0, b.1)))
        .unwrap();
    let long = 2.0 * around as f64 * (PI / around as f64).sin();
    assert!(
        (far(first, last) - long).abs() < 1e-5,
        "{}",
        far(first, last)
    );
    let along = [0, 1].map(|k| (last[k] - first[k]) / long);
    let above = |p: &[f64; 2]| (along[0] * (p[1] - first[1]) - along[1] * (p[0] - first[0])).abs();
    assert!(foot.iter().all(|p| above(p) < 1e-5));
    for (built, flat) in faces.built.iter().zip(&faces.flat) {
        assert!((above(flat) - built[2]).abs() < 1e-5);
    }
}

/// A cone as high as its radius is long, a pyramid of 64 sides, in so many rings.
fn cone(rings: usize) -> Mesh {
    surface(
        &[&|u, v| {
            let angle = TAU * u;
            [v * angle.cos(), v * angle.sin(), 1.0 - v]
        }],
        64,
        rings,
    )
}

#[test]
fn a_cone_gets_one_slit_and_its_angle() {
    let cone = cone(16);
    let (_, pattern) = pattern_of(&cone);
    let [sheet] = &pattern.sheets[..] else {
        panic!("{} sheets", pattern.sheets.len());
    };
    assert!((area_of(&cone) - PI * SQRT_2).abs() < 0.01);
    assert!((enclosed(sheet) - area_of(&cone)).abs() < 1e-3);
    let cut = sheet
        .outlines
        .iter()
        .flatten()
        .filter(|run| run.seam.is_some());
    let long: f64 = cut
        .flat_map(|run| run.points.windows(2))
        .map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]))
        .sum();
    assert!(
        (long - 2.0 * SQRT_2).abs() < 0.05,
        "both sides of the slit: {long}"
    );
}

fn drawn(mesh: &Mesh) -> Totals {
    let (_, pattern) = pattern_of(mesh);
    let options = DrawingOptions::default().scale(100.0);
    Drawing::new(&pattern.sheets, &options).unwrap().summary
}

/// The faces of a polyhedron, each a triangle divided into squares of its parameters.
fn solid(corners: &[[f64; 3]], faces: &[[usize; 3]], count: usize) -> Mesh {
    let face = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [a, b, c].map(|i| corners[i]);
        move |u: f64, v: f64| {
            [0, 1, 2].map(|k| (1.0 - u) * a[k] + u * ((1.0 - v) * b[k] + v * c[k]))
        }
    };
    let faces: Vec<_> = faces.iter().map(|f| face(*f)).collect();
    let maps: Vec<&dyn Fn(f64, f64) -> [f64; 3]> = faces.iter().map(|f| f as _).collect();
    surface(&maps, count, count)
}

/// The surface of those unit cubes of a grid for which `is_filled` is true.
fn cubes(size: [i32; 3], is_filled: impl Fn([i32; 3]) -> bool) -> Mesh {
    let is_filled =
        |cell: [i32; 3]| (0..3).all(|k| (0..size[k]).contains(&cell[k])) && is_filled(cell);
    let (mut places, mut triangles, mut found) = (Vec::new(), Vec::new(), HashMap::new());
    let [x, y, z] = size;
    let cells = (0..x * y * z).map(|i| [i % x, i / x % y, i / (x * y)]);
    for cell in cells.filter(|cell| is_filled(*cell)) {
        for (axis, side) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
            let mut beyond = cell;
            beyond[axis] += 2 * side - 1;
            if is_filled(beyond) {
                continue;
            }
            let mut quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[u, v]| {
                let mut corner = cell;
                corner[axis] += side;
                corner[(axis + 1) % 3] += u;
                corner[(axis + 2) % 3] += v;
                *found.entry(corner).or_insert_with(|| {
                    places.push(corner.map(f64::from));
                    places.len() as u32 - 1
                })
            });
            if side == 0 {
                quad.reverse();
            }
            let [a, b, c, d] = quad;
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::new(places, triangles).unwrap()
}

/// Around a corner of a bracket the faces have 270 degrees, though cuts that do not end there are nearer than other
/// corners.
#[test]
fn angles_beside_other_cuts_close_up() {
    let bracket = cubes([24, 18, 24], |[x, y, z]| {
        x < 6 || z < 6 || (6..12).contains(&y) && x < 16 && z < 16
    });
    let (_, pattern) = pattern_of(&bracket);
    let drawing = Drawing::new(&pattern.sheets, &DrawingOptions::default()).unwrap();
    let worst = drawing.summary.worst_angle;
    println!("{worst:?} of {} points", drawing.summary.points);
    assert!(worst.is_none_or(|worst| (worst.flat - worst.surface).abs() < 1.0));
}

#[test]
fn angles_at_the_corners_of_solids_close_up() {
    for count in [1, 12] {
        let cube = drawn(&cuboid([1.0; 3], count));
        // A tetrahedron's corner is three of a regular triangle, an octahedron's four.
        let corners = [
            [1.0, 1.0, 1.0],
            [1.0, -1.0, -1.0],
            [-1.0, 1.0, -1.0],
            [-1.0, -1.0, 1.0],
        ];
        let faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
        let tetrahedron = drawn(&solid(&corners, &faces, count));
        let (x, y, z) = (
            [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]],
            [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]],
            [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]],
        );
        let corners = [x[0], x[1], y[0], y[1], z[0], z[1]];
        let faces = [
            [4, 0, 2],
            [4, 2, 1],
            [4, 1, 3],
            [4, 3, 0],
            [5, 2, 0],
            [5, 1, 2],
            [5, 3, 1],
            [5, 0, 3],
        ];
        let octahedron = drawn(&solid(&corners, &faces, count));
        for (summary, points, angle) in [
            (cube, 8, 270.0),
            (tetrahedron, 4, 180.0),
            (octahedron, 6, 240.0),
        ] {
            assert_eq!(summary.sheets, 1);
            assert_eq!(summary.points, points, "{angle} {count}");
            let worst = summary.worst_angle.unwrap();
            assert!((worst.surface - angle).abs() < 1e-6, "{worst:?}");
            assert!((worst.flat - angle).abs() < 0.1, "{worst:?}");
            assert!(worst.crease.is_some());
        }
    }
}

#[test]
fn the_angle_of_a_cone_closes_up() {
    let cone = cone(24);
    let summary = drawn(&cone);
    let worst = summary.worst_angle.unwrap();
    assert_eq!((summary.sheets, summary.points), (1, 1));
    // Of the inscribed pyramid of 64 sides.
    let side = (PI / 64.0).sin() * SQRT_2;
    let angle = (64.0 * 2.0 * (0.5 * side).asin()).to_degrees();
    assert!((worst.surface - angle).abs() < 1e-6, "{worst:?} {angle}");
    assert!((worst.flat - angle).abs() < 1.0, "{worst:?} {angle}");
}

/// Two circles of radius 1 in planes at right angles, each through the other's centre, and their common
/// tangent planes (Dirnböck and Stachel 1997).
fn oloid(cols: usize, rows: usize) -> Mesh {
    let ruling = |t: f64, up: f64, v: f64| {
        let c = t.cos();
        let a = [t.sin(), -0.5 - c, 0.0];
        let b = [
            0.0,
            0.5 - c / (1.0 + c),
            up * (1.0 + 2.0 * c).max(0.0).sqrt() / (1.0 + c),
        ];
        [0, 1, 2].map(|k| a[k] + v * (b[k] - a[k]))
    };
    let most = TAU / 3.0;
    surface(
        &[
            &|u, v| ruling(most * (FRAC_PI_2 * (2.0 * u - 1.0)).sin(), 1.0, v),
            &|u, v| ruling(most * (FRAC_PI_2 * (1.0 - 2.0 * u)).sin(), -1.0, v),
        ],
        cols,
        rows,
    )
}

#[test]
fn an_oloid_is_one_sheet_as_large_as_a_sphere() {
    let mesh = oloid(80, 20);
    assert!(
        (area_of(&mesh) - 2.0 * TAU).abs() < 0.02,
        "{}",
        area_of(&mesh)
    );
    let (_, pattern) = pattern_of(&mesh);
    assert_eq!(pattern.sheets.len(), 1);
    assert!(pattern.sheets[0].strain < 0.01);
    assert!((enclosed(&pattern.sheets[0]) - 2.0 * TAU).abs() < 0.02);
}

#[test]
fn curvatures_are_those_of_tubes_and_balls() {
    let mesh = tube(96);
    let found = MeshCurvatures::new(&mesh).unwrap();
    let inside = || (0..mesh.positions().len()).filter(|i| !found.gaussian[*i].is_nan());
    assert_eq!(inside().count(), 96 * 23);
    for i in inside() {
        assert!((found.kappa1[i] - 1.0).abs() < 0.01, "{}", found.kappa1[i]);
        assert!(found.kappa2[i].abs() < 0.01 && found.gaussian[i].abs() < 1e-9);
        // The rulings run along the axis.
        assert!(found.rulings[i][2].abs() > 0.999);
    }
    let summary = found.summary(&mesh, 1.0).unwrap();
    assert_eq!((summary.vertices, summary.gaussian_above), (96 * 23, 0.0));
    let ball = surface(
        &[&|u, v| {
            let (angle, high) = (TAU * u, PI * v);
            [
                high.sin() * angle.cos(),
                high.sin() * angle.sin(),
                -high.cos(),
            ]
            .map(|x| 3.0 * x)
        }],
        60,
        30,
    );
    let found = MeshCurvatures::new(&ball).unwrap();
    let summary = found.summary(&ball, 1.0).unwrap();
    // In a ball of the diameter 1 its radius is a half.
    assert!((summary.size - 6.0).abs() < 1e-9);
    // Gauss and Bonnet: the curvature of all of it is 4π.
    let mut areas = vec![0.0; ball.positions().len()];
    for t in ball.triangles() {
        t.iter()
            .for_each(|v| areas[*v as usize] += area(&ball, t) / 3.0);
    }
    let whole: f64 = found
        .gaussian
        .iter()
        .zip(&areas)
        .map(|(k, area)| k * area)
        .sum();
    assert!((whole - 2.0 * TAU).abs() < 1e-9, "{whole}");
    assert!(
        (summary.median_kappa2 - 2.0).abs() < 0.05,
        "{}",
        summary.median_kappa2
    );
    assert_eq!(summary.gaussian_above, 1.0);
}

/// A cone about a slanting axis, or a tube about it, of irregular triangles: its radius goes from 1 to `end`.
fn frustum(end: f64) -> (Mesh, [[f64; 3]; 3]) {
    let (cols, rows) = (90, 30);
    let (sin, cos) = 0.6f64.sin_cos();
    // Along, and two across.
    let axes = [[0.0, sin, cos], [0.0, cos, -sin], [1.0, 0.0, 0.0]];
    let off = |i: f64, j: f64, seed: f64| {
        let far = 43758.5453 * (12.9898 * i + 78.233 * j + seed).sin();
        0.6 * (far - far.floor() - 0.5)
    };
    let mesh = surface(
        &[&|u, v| {
            let (i, j) = (
                (u * cols as f64).round() % cols as f64,
                (v * rows as f64).round(),
            );
            let rim = j == 0.0 || j == rows as f64;
            let v = if rim {
                v
            } else {
                v + off(i, j, 1.0) / rows as f64
            };
            let angle = TAU * (u + off(i, j, 2.0) / cols as f64);
            let radius = 1.0 + (end - 1.0) * v;
            let at = [2.0 * v, radius * angle.cos(), radius * angle.sin()];
            [0, 1, 2].map(|k| (0..3).map(|n| at[n] * axes[n][k]).sum())
        }],
        cols,
        rows,
    );
    (mesh, axes)
}

fn traced(mesh: &Mesh, separation: f64) -> (Rulings, Vec<Ruling>) {
    let rulings = Rulings::new(mesh).unwrap();
    let options = TraceOptions::default().separation(separation);
    let lines = rulings.trace(&options).unwrap();
    (rulings, lines)
}

fn apart(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

#[test]
fn the_rulings_of_a_tube_are_parallel_to_its_axis() {
    let (mesh, [axis, ..]) = frustum(1.0);
    let (rulings, lines) = traced(&mesh, 0.3);
    let inside = rulings.directions().iter().filter(|d| !d[0].is_nan());
    let off = |d: &[f64; 3]| dot(*d, axis).abs().min(1.0).acos().to_degrees();
    let all: Vec<f64> = inside.map(off).collect();
    let worst = all.iter().copied().fold(0.0, f64::max);
    println!(
        "{} vertices, off by {worst}°, {} lines",
        all.len(),
        lines.len()
    );
    assert_eq!(all.len(), 90 * 29);
    assert!(worst < 2.0);
    // As many as there is room for around it, and at least half as many.
    assert!((10..=42).contains(&lines.len()), "{}", lines.len());
    let whole = lines.iter().filter(|line| line.length > 1.7).count();
    assert!(2 * whole > lines.len(), "{whole} of {}", lines.len());
    for line in &lines {
        let ends = apart(line.points[line.points.len() - 1], line.points[0]);
        assert!(
            off(&ends.map(|x| x / line.length)) < 2.0 && line.deviation < 0.02,
            "{line:?}"
        );
        for point in &line.points {
            let along = dot(*point, axis);
            let radius = (dot(*point, *point) - along * along).sqrt();
            assert!((radius - 1.0).abs() < 0.005, "{radius}");
        }
    }
}

#[test]
fn the_rulings_of_a_cone_run_through_its_apex() {
    let (mesh, [axis, ..]) = frustum(0.25);
    let apex = axis.map(|x| x * 2.0 / 0.75);
    let (rulings, lines) = traced(&mesh, 0.3);
    let mut worst = 0.0f64;
    for (place, direction) in mesh.positions().iter().zip(rulings.directions()) {
        if !direction[0].is_nan() {
            let to = apart(apex, *place);
            let cos = dot(to, *direction).abs() / dot(to, to).sqrt();
            worst = worst.max(cos.min(1.0).acos().to_degrees());
        }
    }
    println!("off by {worst}°, {} lines", lines.len());
    assert!(worst < 2.0);
    assert!(lines.len() > 8);
    for line in &lines {
        let [first, last] = [line.points[0], line.points[line.points.len() - 1]];
        let (along, to) = (apart(last, first), apart(apex, first));
        let ahead = dot(along, to) / line.length;
        let past = (dot(to, to) - ahead * ahead).max(0.0).sqrt();
        assert!(past < 0.035 * dot(to, to).sqrt(), "{past} {line:?}");
    }
}

#[test]
fn what_does_not_bend_one_way_has_no_rulings() {
    let ball = surface(
        &[&|u, v| {
            let (angle, high) = (TAU * u, PI * v);
            [
                high.sin() * angle.cos(),
                high.sin() * angle.sin(),
                -high.cos(),
            ]
        }],
        60,
        30,
    );
    let separation = 0.2;
    assert!(traced(&ball, separation).1.is_empty());
    let plate = surface(&[&|u, v| [u, v, 0.3 * u - 0.1 * v]], 20, 20);
    assert!(traced(&plate, separation).1.is_empty());
    let rulings = Rulings::new(&ball).unwrap();
    let options = TraceOptions::default();
    assert!(rulings.trace(&options.separation(0.0)).is_err());
    assert!(rulings.trace(&options.confidence(1.5)).is_err());
    assert!(rulings.trace(&options.crease(f64::NAN)).is_err());
    let cloud = Mesh::cloud(ball.positions().to_vec()).unwrap();
    assert_eq!(Rulings::new(&cloud).unwrap_err().code(), "UNSUPPORTED");
}

#[test]
fn what_was_found_of_a_noisy_bottle_lies_flat_within_the_limit() {
    // A pipe that goes on to a cone, at 27°.
    let mut random = oorandom::Rand64::new(7);
    let mut noise = move || 0.01 * (0..12).map(|_| random.rand_float() - 0.5).sum::<f64>();
    let exact = surface(
        &[&|u, v| {
            let (angle, z) = (TAU * u, 3.0 * v);
            let r = if z < 2.0 { 1.0 } else { 2.0 - 0.5 * z };
            [r * angle.cos(), r * angle.sin(), z]
        }],
        120,
        60,
    );
    let noisy = exact.positions().iter().map(|[x, y, z]| {
        let more = 1.0 + noise();
        [x * more, y * more, *z]
    });
    let noisy = Mesh::new(noisy.collect(), exact.triangles().to_vec()).unwrap();
    let found = developable::fit_mesh(&noisy, &developable::MeshOptions::default()).unwrap();
    let (patches, pattern) = pattern_of(found.mesh());
    let areas = [4.0 * PI, 1.5 * PI * 1.25f64.sqrt()];
    assert_eq!(patches.patches().len(), 2);
    for (patch, area) in patches.patches().iter().zip(areas) {
        assert!(
            (patch.area / area - 1.0).abs() < 0.02,
            "{} for {area}",
            patch.area
        );
    }
    for sheet in &pattern.sheets {
        assert!(sheet.strain <= 0.01, "{}", sheet.strain);
    }
    assert!(pattern.sheets.len() <= 4, "{}", pattern.sheets.len());
    let whole: f64 = pattern.sheets.iter().map(enclosed).sum();
    assert!((whole / (areas[0] + areas[1]) - 1.0).abs() < 0.02);
}

#[test]
fn a_crease_that_fits_along_a_part_of_its_length_is_a_fold_there() {
    // A plate, and a wall upright on its edge, which is straight for a length of 2 and then an arc of radius 1. The wall's
    // edge unrolls to a straight line.
    let edge = |s: f64| match s <= 2.0 {
        true => [0.0, s],
        false => [(s - 2.0).cos() - 1.0, 2.0 + (s - 2.0).sin()],
    };
    let plate = |u: f64, v: f64| {
        let [x, y] = edge(3.2 * v);
        [x - 1.2 * (1.0 - u), y, 0.0]
    };
    let wall = |u: f64, v: f64| {
        let [x, y] = edge(3.2 * v);
        [x, y, u]
    };
    let mesh = surface(&[&plate, &wall], 13, 49);
    let (patches, pattern) = pattern_of(&mesh);
    assert_eq!(patches.patches().len(), 2);
    let [sheet] = &pattern.sheets[..] else {
        panic!("{} sheets", pattern.sheets.len());
    };
    let long = |points: &[[f64; 2]]| -> f64 {
        let pairs = points.windows(2);
        pairs
            .map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]))
            .sum()
    };
    let [fold] = &sheet.folds[..] else {
        panic!("{} folds", sheet.folds.len());
    };
    let cuts = sheet
        .outlines
        .iter()
        .flatten()
        .filter(|run| run.seam.is_some());
    let cuts: Vec<f64> = cuts.map(|run| long(&run.points)).collect();
    // Where the arc begins the two sides part slowly, by the square of the length; over a fold of 2.5 they are a quarter of an edge
    // apart in root mean square.
    let folded = long(&fold.points);
    assert!((1.9..2.5).contains(&folded), "{folded}");
    assert_eq!(cuts.len(), 2, "{cuts:?}");
    // All of the strain is beside the fold's end, and the sides differ by it.
    for cut in cuts {
        assert!((folded + cut - 3.2).abs() < 0.03, "{folded} {cut}");
    }
}
