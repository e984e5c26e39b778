//! Meshes with exact faces laid flat: lengths, areas and folds by closed forms.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::closed_meshes::cube;
use crate::math::planar::distance_to_segment;
use crate::native::common::Random;
use developable::drawing::{Bending, Drawing, DrawingOptions, Label, LabelKind};
use developable::files::drawings::{PdfOptions, TextureFile, write_dxf, write_pdf, write_svg};
use developable::pattern::{
    MeshKind, NetOptions, Pattern, RecognizedMesh, Sheet, pattern_exact, sheet_metal,
};
use developable::{Exactness, Lambda, Mesh, MeshOptions, StopReason, fit_mesh};

fn seam_length(pattern: &Pattern) -> f64 {
    Drawing::new(&pattern.sheets, &DrawingOptions::default())
        .unwrap()
        .summary
        .seam_length
}

fn flat_area(sheet: &Sheet) -> f64 {
    let corner = |v: u32| sheet.faces.flat[v as usize];
    let areas = sheet.faces.triangles.iter().map(|t| {
        let [a, b, c] = t.map(corner);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    });
    areas.sum()
}

/// The hull of few points, by trying all planes through three of them.
fn hull(points: Vec<[f64; 3]>) -> Mesh {
    let less = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let n = points.len();
    let mut triangles = Vec::new();
    for (i, j, k) in (0..n).flat_map(|i| (0..n).flat_map(move |j| (0..n).map(move |k| (i, j, k)))) {
        if i >= j || i >= k || j == k {
            continue;
        }
        let (u, v) = (less(points[j], points[i]), less(points[k], points[i]));
        let normal = [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ];
        let is_outside = |p: &[f64; 3]| {
            (0..3)
                .map(|d| normal[d] * (p[d] - points[i][d]))
                .sum::<f64>()
                > 1e-9
        };
        if !points.iter().any(is_outside) {
            triangles.push([i as u32, j as u32, k as u32]);
        }
    }
    Mesh::new(points, triangles).unwrap()
}

/// A block of 60 × 40 × 10 with a round hole of radius 8 through it, as CAD writes it: 48 sides, all faces of triangles.
fn block_with_hole() -> Mesh {
    let sides = 48u32;
    let mut points = Vec::new();
    for z in [0.0, 10.0] {
        points.extend([
            [-30.0, -20.0, z],
            [30.0, -20.0, z],
            [30.0, 20.0, z],
            [-30.0, 20.0, z],
        ]);
        points.extend((0..sides).map(|i| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(sides) - PI).sin_cos();
            [8.0 * cos, 8.0 * sin, z]
        }));
    }
    let (high, rim) = (4 + sides, |i: u32| 4 + i % sides);
    let mut triangles = Vec::new();
    let mut face = |[a, b, c]: [u32; 3]| {
        // Below seen from below, above from above.
        triangles.push([a, c, b]);
        triangles.push([a + high, b + high, c + high]);
    };
    for quarter in 0..4 {
        let first = quarter * sides / 4;
        for i in first..first + sides / 4 {
            face([quarter, rim(i + 1), rim(i)]);
        }
        face([quarter, (quarter + 1) % 4, rim(first + sides / 4)]);
    }
    for i in 0..4u32 {
        let (a, b) = (i, (i + 1) % 4);
        triangles.extend([[a, b, b + high], [a, b + high, a + high]]);
    }
    for i in 0..sides {
        let (a, b) = (rim(i), rim(i + 1));
        triangles.extend([[b, a, a + high], [b, a + high, b + high]]);
    }
    Mesh::new(points, triangles).unwrap()
}

#[test]
fn polyhedra_are_one_net_with_the_shortest_cut() {
    let tetrahedron = hull(vec![
        [0.0; 3],
        [60.0, 60.0, 0.0],
        [60.0, 0.0, 60.0],
        [0.0, 60.0, 60.0],
    ]);
    let cube = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 1 { 60.0 } else { 0.0 });
    let octahedron = |i: usize| {
        let end = 30.0 - 60.0 * (i % 2) as f64;
        [0, 1, 2].map(|k| if i / 2 == k { end } else { 0.0 })
    };
    // One cut fewer than faces is left of all edges.
    let edge = 60.0 * 2f64.sqrt();
    let boxed = {
        let mut triangles = Vec::new();
        for [a, b, c, d] in [
            [0u32, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ] {
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        Mesh::new((0..8).map(cube).collect(), triangles).unwrap()
    };
    let all = [
        (tetrahedron, 3.0 * edge, 3, 3f64.sqrt() * edge * edge),
        (boxed, 7.0 * 60.0, 5, 6.0 * 3600.0),
        (
            hull((0..6).map(octahedron).collect()),
            5.0 * edge / 2.0,
            7,
            3f64.sqrt() / 2.0 * edge * edge,
        ),
    ];
    // Each triangle once, and twice, as some programs write it.
    let all = all.into_iter().flat_map(|(mesh, cut, folds, area)| {
        let again = mesh.triangles().iter().map(|[a, b, c]| [*b, *c, *a]);
        let twice = mesh.triangles().iter().copied().chain(again).collect();
        let twice = Mesh::new(mesh.positions().to_vec(), twice).unwrap();
        [(mesh, cut, folds, area), (twice, cut, folds, area)]
    });
    for (mesh, cut, folds, area) in all {
        assert_eq!(Exactness::of(&mesh), Exactness::Faces);
        let pattern = pattern_exact(&mesh, &NetOptions::default()).unwrap();
        let [sheet] = &pattern.sheets[..] else {
            panic!("{} sheets", pattern.sheets.len());
        };
        let length = seam_length(&pattern) / cut;
        assert!((length - 1.0).abs() < 1e-9, "{length}");
        assert_eq!((sheet.folds.len(), sheet.strain), (folds, 0.0));
        for area in [sheet.area / area, flat_area(sheet) / area] {
            assert!((area - 1.0).abs() < 1e-9, "{area}");
        }
    }
}

#[test]
fn of_equally_long_edges_a_sharp_one_is_cut_and_no_smooth_bend() {
    // A half-round bar, turned so that no two of its long edges are equally long in floating point.
    let (steps, radius, length) = (20u32, 20.0, 100.0);
    let places = (0..=steps).flat_map(|k| {
        let (sin, cos) = (PI * f64::from(k) / f64::from(steps)).sin_cos();
        [0.0, length].map(|along| {
            let [x, y] = [radius * cos, radius * sin];
            [0.6 * x - 0.8 * along, 0.8 * x + 0.6 * along, y]
        })
    });
    let mut triangles = Vec::new();
    for k in 0..=steps {
        let [a, b] = [2 * k, 2 * ((k + 1) % (steps + 1))];
        triangles.extend([[a, b + 1, b], [a, a + 1, b + 1]]);
    }
    triangles.extend((1..steps).flat_map(|k| [[0, 2 * k, 2 * k + 2], [1, 2 * k + 3, 2 * k + 1]]));
    let bar = Mesh::new(places.collect(), triangles).unwrap();
    let pattern = pattern_exact(&bar, &NetOptions::default()).unwrap();
    let folds = pattern.sheets.iter().flat_map(|sheet| &sheet.folds);
    let smooth = folds.filter(|fold| fold.seam.angle < 0.5).count();
    assert_eq!(smooth, steps as usize - 1);
}

#[test]
fn walls_that_meet_at_small_angles_are_bends_each_by_itself() {
    // A cylinder that goes over into a cone by 0.38, as a shaft's chamfer or a vase does, between two discs.
    let (sides, rings) = (32u32, [[12.0, 0.0], [12.0, 20.0], [6.0, 35.0]]);
    let mut points = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 35.0]];
    for [radius, height] in rings {
        points.extend((0..sides).map(|k| {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(sides)).sin_cos();
            [radius * cos, radius * sin, height]
        }));
    }
    let at = |ring: u32, k: u32| 2 + ring * sides + k % sides;
    let mut triangles = Vec::new();
    for k in 0..sides {
        triangles.extend([[0, at(0, k + 1), at(0, k)], [1, at(2, k), at(2, k + 1)]]);
        for ring in 0..2 {
            let [a, b, c, d] = [
                at(ring, k),
                at(ring, k + 1),
                at(ring + 1, k + 1),
                at(ring + 1, k),
            ];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let shaft = Mesh::new(points, triangles).unwrap();
    let pattern = pattern_exact(&shaft, &NetOptions::default()).unwrap();
    // Each wall goes all around and is cut along one line, so that it is two patches.
    assert_eq!(pattern.patches.len(), 2 + 2 * 2);
    let folds = pattern.sheets.iter().flat_map(|sheet| &sheet.folds);
    let radii: Vec<f64> = (folds.filter_map(|fold| fold.bend))
        .map(|bend| bend.radius)
        .collect();
    // Half of both widths of the cone, along its side, over half of the angle that it has when it is flat.
    let cone = 0.5 * (12.0 + 6.0) * 15f64.hypot(6.0) / 15.0;
    for radius in [12.0, cone] {
        let own = radii.iter().filter(|r| (*r / radius - 1.0).abs() < 0.01);
        assert!(own.count() > 20, "{radius}: {radii:?}");
    }
}

#[test]
fn a_fit_leaves_meshes_without_noise_as_they_are() {
    // A cone of one row of quadrilaterals has no vertex inside.
    let ring = |k: usize, r: f64, z: f64| {
        let angle = TAU * k as f64 / 40.0;
        [r * angle.cos(), r * angle.sin(), z]
    };
    let places = (0..40).flat_map(|k| [ring(k, 40.0, 0.0), ring(k, 20.0, 50.0)]);
    let quads = (0..40u32).map(|k| [2 * k, 2 * ((k + 1) % 40), 2 * ((k + 1) % 40) + 1, 2 * k + 1]);
    let triangles = quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let cone = Mesh::new(places.collect(), triangles.collect()).unwrap();
    for mesh in [block_with_hole(), cone] {
        let fitted = fit_mesh(&mesh, &MeshOptions::default()).unwrap();
        assert_eq!(fitted.mesh().positions(), mesh.positions());
        let report = fitted.report();
        assert_eq!(
            (report.stop_reason, report.sigma),
            (StopReason::NoNoise, Some(0.0))
        );
    }
    // A saddle over a sheared grid is no mesh that is known as exact, and far from no quadratic; noise of two hundredths is removed.
    let saddle = |noise: f64| {
        let mut random = Random::new(3);
        let n = 40u32;
        let place = |(i, j): (u32, u32)| {
            let (x, y) = (f64::from(i) + 0.3 * f64::from(j), f64::from(j));
            [x, y, 0.01 * x * y + noise * random.normal()]
        };
        let places = (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).map(place);
        let squares = (0..n - 1).flat_map(|j| (0..n - 1).map(move |i| j * n + i));
        let triangles = squares.flat_map(|a| [[a, a + 1, a + n], [a + 1, a + n + 1, a + n]]);
        Mesh::new(places.collect(), triangles.collect()).unwrap()
    };
    for (noise, reason) in [
        (0.0, StopReason::NoNoise),
        (0.005, StopReason::NoNoise),
        (0.02, StopReason::Gap),
    ] {
        let mesh = saddle(noise);
        assert!(noise == 0.0 || !mesh.is_exact());
        let fitted = fit_mesh(&mesh, &MeshOptions::default()).unwrap();
        assert_eq!(fitted.report().stop_reason, reason, "{noise}");
        let is_left = fitted.mesh().positions() == mesh.positions();
        assert_eq!(is_left, reason == StopReason::NoNoise, "{noise}");
    }
    let options = MeshOptions::default().lambda(Lambda::Medium);
    let moved = fit_mesh(&block_with_hole(), &options).unwrap();
    assert_ne!(moved.mesh().positions(), block_with_hole().positions());
}

#[test]
fn a_hole_through_a_block_has_two_circles_and_a_strip() {
    let mesh = block_with_hole();
    assert_eq!(Exactness::of(&mesh), Exactness::Faces);
    let pattern = pattern_exact(&mesh, &NetOptions::default()).unwrap();
    let [block, wall] = &pattern.sheets[..] else {
        panic!("{} sheets", pattern.sheets.len());
    };
    assert_eq!((block.outlines.len(), wall.outlines.len()), (3, 1));
    let square: Vec<f64> = block.folds.iter().map(|fold| fold.seam.angle).collect();
    assert_eq!(square.len(), 5);
    assert!(square.iter().all(|angle| (angle - FRAC_PI_2).abs() < 1e-9));
    // The strip is folded along its 47 edges inside.
    assert_eq!(wall.folds.len(), 47);
    assert!(
        wall.folds
            .iter()
            .all(|fold| (fold.seam.angle - TAU / 48.0).abs() < 1e-9)
    );
    let drawing = Drawing::new(&pattern.sheets, &DrawingOptions::default()).unwrap();
    for hole in &drawing.sheets[0].curves[1..] {
        let (_, radius) = hole.circle().unwrap();
        assert!((radius - 8.0).abs() < 1e-6, "{radius}");
    }
    let file = String::from_utf8(write_dxf(&drawing).unwrap()).unwrap();
    assert_eq!(file.matches("\r\nCIRCLE\r\n").count(), 2);
    // Half as large, its lines are too near to be scored.
    for (scale, count) in [(1.0, 47), (0.5, 23), (0.1, 4)] {
        let options = DrawingOptions::default().scale(scale);
        let folds = &Drawing::new(&pattern.sheets, &options).unwrap().sheets[1].folds;
        let angle: f64 = folds.iter().map(|fold| fold.angle).sum();
        assert_eq!(folds.len(), count, "{scale}");
        assert!((angle - 47.0 * 7.5).abs() < 1e-9, "{scale}: {angle}");
    }
    // Both rims have one letter each, on the block and on the wall.
    let letters = |sheet: &Sheet| {
        let runs = sheet.outlines.iter().flatten();
        let mut all: Vec<usize> = runs.filter_map(|run| Some(run.seam?.crease)).collect();
        all.sort_unstable();
        all.dedup();
        all
    };
    let both = letters(wall)
        .into_iter()
        .filter(|crease| letters(block).contains(crease))
        .count();
    assert!((2..=4).contains(&both), "{both}");
}

#[test]
fn faces_meeting_at_an_edge_of_three_are_cut_there() {
    // Three squares like the pages of a book.
    let mut points = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 10.0]];
    let mut triangles = Vec::new();
    for page in 0..3u32 {
        let (sin, cos) = (f64::from(page) * 2.0).sin_cos();
        points.extend([
            [10.0 * cos, 10.0 * sin, 0.0],
            [10.0 * cos, 10.0 * sin, 10.0],
        ]);
        let [a, b] = [2 + 2 * page, 3 + 2 * page];
        triangles.extend([[0, a, b], [0, b, 1]]);
    }
    let book = Mesh::new(points, triangles).unwrap();
    let pattern = pattern_exact(&book, &NetOptions::default()).unwrap();
    assert_eq!(pattern.sheets.len(), 3);
    let mut areas = pattern.sheets.iter().map(|sheet| sheet.area);
    assert!(areas.all(|area| (area - 100.0).abs() < 1e-9));
}

#[test]
fn solids_that_touch_are_laid_flat_each_by_itself() {
    // Cubes at an edge of two, at a whole face, and eight around a point.
    let around = (0..8).map(|k| [k % 2, k / 2 % 2, k / 4]);
    for cells in [
        vec![[0, 0, 0], [1, 1, 0]],
        vec![[0, 0, 0], [0, 0, 1]],
        around.collect(),
    ] {
        let one = cube(1);
        let [low, high] = one.bounds();
        let (mut points, mut triangles) = (Vec::new(), Vec::new());
        for cell in &cells {
            let first = points.len() as u32;
            let moved =
                |p: &[f64; 3]| [0, 1, 2].map(|k| p[k] + f64::from(cell[k]) * (high[k] - low[k]));
            points.extend(one.positions().iter().map(moved));
            triangles.extend(one.triangles().iter().map(|t| t.map(|v| first + v)));
        }
        // Facing outwards, and inwards as after mirroring.
        let inwards: Vec<_> = triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        for triangles in [triangles, inwards] {
            let both = Mesh::new(points.clone(), triangles).unwrap();
            let pattern = pattern_exact(&both, &NetOptions::default()).unwrap();
            assert_eq!(pattern.sheets.len(), cells.len());
            let whole = 6.0 * (high[0] - low[0]).powi(2);
            let mut areas = pattern.sheets.iter().map(flat_area);
            assert!(areas.all(|area| (area / whole - 1.0).abs() < 1e-9));
        }
    }
}

#[test]
fn triangles_without_a_width_cut_nothing_and_are_no_sheet() {
    // Two, back to back, on an edge of a cube.
    let cube = cube(1);
    let (mut points, mut triangles) = (cube.positions().to_vec(), cube.triangles().to_vec());
    let [a, b, _] = triangles[0];
    let [p, q] = [a, b].map(|v| points[v as usize]);
    let middle = points.len() as u32;
    points.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
    triangles.extend([[a, b, middle], [b, a, middle]]);
    let mesh = Mesh::new(points, triangles).unwrap();
    let pattern = pattern_exact(&mesh, &NetOptions::default()).unwrap();
    assert_eq!(pattern.sheets.len(), 1);
    assert!((flat_area(&pattern.sheets[0]) - 24.0).abs() < 1e-9);
    // Seven edges of length 2 are cut, as of a cube by itself.
    assert!((seam_length(&pattern) - 14.0).abs() < 1e-9);
}

#[test]
fn sheets_fit_the_room_that_there_is() {
    // A cross of squares of 60 needs 180 × 240.
    let mesh = block_with_hole();
    let whole = pattern_exact(&mesh, &NetOptions::default())
        .unwrap()
        .sheets
        .len();
    let room = NetOptions {
        room: Some([65.0, 65.0]),
        ..NetOptions::default()
    };
    let pattern = pattern_exact(&mesh, &room).unwrap();
    assert!(pattern.sheets.len() > whole);
    for sheet in &pattern.sheets {
        let extent = |k: usize| {
            let all = sheet.faces.flat.iter().map(|p| p[k]);
            all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
        };
        // Turned by an eighth a box is larger by √2 at most.
        assert!(extent(0).max(extent(1)) < 65.0 * 2f64.sqrt() + 1e-9);
    }
}

#[test]
fn noise_and_smooth_surfaces_are_not_exact() {
    // A gable roof of 60 × 60 squares; noise of a tenth of a spacing, and none but a smooth bend.
    let exactness = |height: &dyn Fn(f64, f64, usize) -> f64| {
        let n = 60usize;
        let point = |i: usize| {
            let (x, y) = ((i % n) as f64, (i / n) as f64);
            [x, y, height(x, y, i)]
        };
        let squares = (0..n - 1).flat_map(|j| (0..n - 1).map(move |i| (j * n + i) as u32));
        let triangles = squares.flat_map(|a| [[a, a + 1, a + 61], [a, a + 61, a + 60]]);
        Exactness::of(&Mesh::new((0..n * n).map(point).collect(), triangles.collect()).unwrap())
    };
    let noise = |i: usize| ((i as f64 * 12.9898).sin() * 43758.5453).fract() * 0.1;
    let roof = |x: f64| 0.8 * (30.0 - (x - 29.5).abs());
    assert_eq!(exactness(&|x, _, _| roof(x)), Exactness::Faces);
    let noisy = exactness(&|x, _, i| roof(x) + noise(i));
    assert_ne!(noisy, Exactness::Faces);
    let ball = |x: f64, y: f64| (2500.0 - (x - 30.0).powi(2) - (y - 30.0).powi(2)).sqrt();
    assert_ne!(exactness(&|x, y, _| ball(x, y)), Exactness::Faces);
    // Whole heights, as in a scan of few digits, are planes of many triangles and still noise.
    let stairs = exactness(&|_, y, i| (0.2 * y + 10.0 * noise(i)).round());
    assert_eq!(stairs, Exactness::None);
}

/// A solid angle of sheet metal as CAD writes it: flat faces of 40 and 60 beside a bend of 90° with inner radius 3, 2 thick and
/// 50 wide.
fn bent_angle() -> Mesh {
    let (inner, thickness, width, steps) = (3.0, 2.0, 50.0, 12);
    // Both skins from end to end, about the middle of the bend.
    let skin = |radius: f64| {
        let mut line = vec![[-radius, -40.0]];
        line.extend((0..=steps).map(|i| {
            let (sin, cos) = (FRAC_PI_2 * f64::from(i) / f64::from(steps)).sin_cos();
            [-radius * cos, radius * sin]
        }));
        line.push([60.0, radius]);
        line
    };
    let lines = [skin(inner), skin(inner + thickness)];
    let n = lines[0].len() as u32;
    let mut points = Vec::new();
    for y in [0.0, width] {
        points.extend(lines.iter().flatten().map(|[x, z]| [*x, y, *z]));
    }
    let far = 2 * n;
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [u32; 4]| triangles.extend([[a, b, c], [a, c, d]]);
    for i in 0..n - 1 {
        quad([i, i + 1, far + i + 1, far + i]);
        quad([n + i, far + n + i, far + n + i + 1, n + i + 1]);
        quad([i, n + i, n + i + 1, i + 1]);
        quad([far + i, far + i + 1, far + n + i + 1, far + n + i]);
    }
    quad([0, far, far + n, n]);
    quad([n - 1, 2 * n - 1, far + 2 * n - 1, far + n - 1]);
    Mesh::new(points, triangles).unwrap()
}

#[test]
fn a_solid_of_sheet_metal_has_the_blank_that_it_is_bent_from() {
    let solid = bent_angle();
    let metal = sheet_metal(&solid).unwrap().expect("sheet metal");
    assert!((metal.thickness - 2.0).abs() < 1e-9, "{}", metal.thickness);
    let pattern = pattern_exact(&metal.skin, &NetOptions::default()).unwrap();
    let options = DrawingOptions::default().bending(Bending::new(2.0).k_factor(0.44));
    let drawing = Drawing::new(&pattern.sheets, &options).unwrap();
    let [blank] = &drawing.sheets[..] else {
        panic!("{} sheets", drawing.sheets.len());
    };
    // Flat faces, and the neutral line of the bend.
    let long = 40.0 + 60.0 + FRAC_PI_2 * (3.0 + 0.44 * 2.0);
    let [low, high] = blank.bounds;
    let mut sides = [high[0] - low[0], high[1] - low[1]];
    sides.sort_by(f64::total_cmp);
    assert!(
        (sides[0] - 50.0).abs() < 1e-6 && (sides[1] - long).abs() < 1e-6,
        "{sides:?}"
    );
    let [line] = &blank.folds[..] else {
        panic!("{} bend lines", blank.folds.len());
    };
    let bend = line.bend.unwrap();
    assert!(
        (bend.angle - 90.0).abs() < 1e-9 && (line.length - 50.0).abs() < 1e-9,
        "{line:?}"
    );
    // Of the inside, though the blank is made of the outer skin, which is the larger one.
    assert!((bend.radius - 3.0).abs() < 1e-9, "{}", bend.radius);
    let away = |p: &[f64; 2]| {
        let k = usize::from(high[1] - low[1] > high[0] - low[0]);
        (p[k] - low[k]).min(high[k] - p[k])
    };
    let middle = 40.0 + 0.5 * FRAC_PI_2 * (3.0 + 0.44 * 2.0);
    assert!(line.points.iter().all(|p| (away(p) - middle).abs() < 1e-6));
}

/// Folds of a tray meet at its corners, where each is moved by the allowances of the others.
#[test]
fn bend_lines_of_a_tray_end_at_its_outline() {
    let mut random = Random::new(5);
    for _ in 0..20 {
        let sides = [(); 3].map(|()| 60.0 + 30.0 * random.sample());
        let (sin, cos) = (PI * random.sample()).sin_cos();
        let corner = |k: usize| {
            let [x, y, z] = [0, 1, 2].map(|axis| sides[axis] * (k >> axis & 1) as f64);
            let [y, z] = [cos * y - sin * z, sin * y + cos * z];
            [cos * x - sin * y, sin * x + cos * y, z]
        };
        let faces = [
            [0, 2, 3, 1],
            [0, 1, 5, 4],
            [1, 3, 7, 5],
            [3, 2, 6, 7],
            [2, 0, 4, 6],
        ];
        let triangles = faces
            .iter()
            .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
        let tray = Mesh::new((0..8).map(corner).collect(), triangles.collect()).unwrap();
        let pattern = pattern_exact(&tray, &NetOptions::default()).unwrap();
        let options = DrawingOptions::default().bending(Bending::new(2.0));
        for sheet in Drawing::new(&pattern.sheets, &options).unwrap().sheets {
            let away = |p: [f64; 2]| {
                let rings = sheet.cuts.iter();
                let sides = rings.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
                let away = sides.map(|(a, b)| distance_to_segment(p, [*a, *b]));
                away.fold(f64::INFINITY, f64::min)
            };
            for fold in &sheet.folds {
                let [a, b] = [fold.points[0], fold.points[fold.points.len() - 1]];
                let at = |share: f64| [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
                assert!(away(a).max(away(b)) < 1e-6, "{sides:?} {fold:?}");
                let inside = away(at(0.005)).min(away(at(0.995)));
                assert!(inside > 0.1, "{sides:?} {inside} {fold:?}");
            }
        }
    }
}

#[test]
fn a_bend_of_uneven_facets_is_one_bend() {
    // Two faces beside an arc of radius 10 whose chords are as uneven as where a reader has joined some of them.
    let mut turned = 0.0_f64;
    let mut line = vec![[0.0, -30.0]];
    for degrees in [0.0, 4.0, 13.0, 13.0, 13.0, 13.0, 13.0, 13.0, 8.0_f64] {
        turned += degrees.to_radians();
        line.push([10.0 - 10.0 * turned.cos(), 10.0 * turned.sin()]);
    }
    line.push([40.0, 10.0]);
    let n = line.len() as u32;
    let points = [0.0, 50.0]
        .iter()
        .flat_map(|y| line.iter().map(|[x, z]| [*x, *y, *z]));
    let triangles = (0..n - 1).flat_map(|i| [[i, i + 1, n + i + 1], [i, n + i + 1, n + i]]);
    let skin = Mesh::new(points.collect(), triangles.collect()).unwrap();
    let pattern = pattern_exact(&skin, &NetOptions::default()).unwrap();
    let [sheet] = &pattern.sheets[..] else {
        panic!("{} sheets", pattern.sheets.len());
    };
    let angles: Vec<f64> = (sheet.folds.iter())
        .map(|fold| fold.bend.map_or(0.0, |bend| bend.angle.to_degrees()))
        .collect();
    assert_eq!(angles.len(), 9);
    for bend in sheet.folds.iter().filter_map(|fold| fold.bend) {
        assert!((bend.radius - 10.0).abs() < 0.05, "{}", bend.radius);
    }
    assert!(
        angles.iter().all(|angle| (angle - 90.0).abs() < 1e-6),
        "{angles:?}"
    );
}

/// A cube of side 10 whose six faces are squares of a quarter of a texture's width, one and a half textures away from its
/// corner, those of the upper three from a second texture.
fn textured_cube() -> Mesh {
    let (mut places, mut uvs, mut triangles, mut textures) = (vec![], vec![], vec![], vec![]);
    for (face, axis) in [(0u8, 0usize), (1, 1), (2, 2), (3, 0), (4, 1), (5, 2)] {
        let up = face >= 3;
        let first = places.len() as u32;
        for [a, b] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            // Anticlockwise as seen from outside, so that the texture is not mirrored.
            let (s, t) = if up { (a, b) } else { (b, a) };
            let mut place = [0.0; 3];
            place[axis] = if up { 10.0 } else { 0.0 };
            place[(axis + 1) % 3] = 10.0 * s;
            place[(axis + 2) % 3] = 10.0 * t;
            places.push(place);
            uvs.push([1.5 + 0.25 * a as f32, 1.5 + 0.25 * b as f32]);
        }
        triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t: [u32; 3]| t.map(|v| first + v)));
        textures.extend([i32::from(up); 2]);
    }
    let mesh = Mesh::new(places, triangles).unwrap();
    mesh.with_uvs(uvs).unwrap().with_textures(textures).unwrap()
}

#[test]
fn textures_are_printed_on_sheets_in_their_true_place() {
    let mesh = textured_cube();
    let sheets = pattern_exact(&mesh, &NetOptions::default()).unwrap().sheets;
    let options = DrawingOptions::default().printed(true);
    let drawing = Drawing::new(&sheets, &options).unwrap();
    let printed: Vec<_> = drawing
        .sheets
        .iter()
        .flat_map(|sheet| &sheet.printed)
        .collect();
    assert_eq!(printed.len(), 12);
    for triangle in &printed {
        // 40 millimetres for each share of the texture, turned in any way and not mirrored.
        let sides = |p: [[f64; 2]; 3]| {
            let [[a, b], [c, d]] = [1, 2].map(|k| [p[k][0] - p[0][0], p[k][1] - p[0][1]]);
            [a * a + b * b, c * c + d * d, a * d - b * c]
        };
        let (drawn, of_texture) = (sides(triangle.corners), sides(triangle.uvs));
        for k in 0..3 {
            assert!(
                (drawn[k] - 1600.0 * of_texture[k]).abs() < 1e-6,
                "{triangle:?}"
            );
        }
        assert!(of_texture[2] > 0.0);
    }
    let of_second = printed.iter().filter(|triangle| triangle.texture == 1);
    assert_eq!(of_second.count(), 6);

    let files = [
        TextureFile {
            jpeg: b"first",
            size: [8, 8],
        },
        TextureFile {
            jpeg: b"second",
            size: [16, 8],
        },
    ];
    let svg = String::from_utf8(write_svg(&drawing, None, &files).unwrap()).unwrap();
    // Each square is one part, so that no line shows in it.
    assert_eq!(svg.matches("<clipPath").count(), 6, "{svg}");
    assert!(svg.contains("data:image/jpeg;base64,Zmlyc3Q=") && svg.contains("base64,c2Vjb25k"));
    assert_eq!(svg.matches("href=\"#texture-1\"").count(), 3);
    let pdf = write_pdf(&drawing, &PdfOptions::default().textures(&files)).unwrap();
    let shown = |name: &[u8]| {
        pdf.windows(name.len())
            .filter(|bytes| *bytes == name)
            .count()
    };
    assert_eq!(
        [shown(b"/T0 Do"), shown(b"/T1 Do"), shown(b"/DCTDecode")],
        [3, 3, 2]
    );
    assert!(shown(b"second") == 1);

    let plain = Drawing::new(&sheets, &DrawingOptions::default()).unwrap();
    assert!(plain.sheets.iter().all(|sheet| sheet.printed.is_empty()));
    let bare = pattern_exact(&block_with_hole(), &NetOptions::default()).unwrap();
    assert_eq!(
        Drawing::new(&bare.sheets, &options).unwrap_err().code(),
        "UNSUPPORTED"
    );
}

#[test]
fn boxes_and_open_skins_are_no_sheet_metal() {
    assert!(sheet_metal(&block_with_hole()).unwrap().is_none());
    let skin = sheet_metal(&bent_angle()).unwrap().unwrap().skin;
    assert!(sheet_metal(&skin).unwrap().is_none());
}

#[test]
fn a_person_decides_which_edges_are_cut_and_which_are_folds() {
    let mesh = hull(vec![
        [0.0, 0.0, 0.0],
        [40.0, 0.0, 0.0],
        [0.0, 50.0, 0.0],
        [0.0, 0.0, 60.0],
    ]);
    let pairs = |pattern: &Pattern, is_fold: bool| {
        let folds = pattern.sheets.iter().flat_map(|sheet| &sheet.folds);
        let mut folded: Vec<[u32; 2]> = folds.map(|fold| fold.seam.patches).collect();
        folded.sort_unstable();
        let all = pattern.creases.iter().map(|crease| crease.patches);
        all.filter(|pair| folded.contains(pair) == is_fold)
            .collect::<Vec<_>>()
    };
    let before = pattern_exact(&mesh, &NetOptions::default()).unwrap();
    let (cut, join) = (pairs(&before, true)[0], pairs(&before, false)[0]);
    let options = NetOptions {
        cut: vec![cut],
        join: vec![[join[1], join[0]]],
        ..NetOptions::default()
    };
    let after = pattern_exact(&mesh, &options).unwrap();
    assert!(pairs(&after, false).contains(&cut) && pairs(&after, true).contains(&join));
    assert_eq!(after.sheets.len(), 1);
    let none = NetOptions {
        cut: vec![[0, 9]],
        ..NetOptions::default()
    };
    let error = pattern_exact(&mesh, &none).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("patches 1 and 10 have no edge in common"),
        "{error}"
    );
    // All six edges of a tetrahedron cannot be folds.
    let all = (0..4)
        .flat_map(|a| (a + 1..4).map(move |b| [a, b]))
        .collect();
    let folds = NetOptions {
        join: all,
        ..NetOptions::default()
    };
    assert!(pattern_exact(&mesh, &folds).is_err());
}

#[test]
fn no_text_lies_on_a_line_or_on_another_text() {
    let mesh = block_with_hole();
    let sheets = pattern_exact(&mesh, &NetOptions::default()).unwrap().sheets;
    let drawing = Drawing::new(&sheets, &DrawingOptions::default().tabs(4.0)).unwrap();
    for sheet in &drawing.sheets {
        // Points a tenth of a millimetre apart along all lines, and those of a grid over each text.
        let folds = sheet
            .folds
            .iter()
            .chain(&sheet.tabs)
            .map(|line| &line.points);
        let mut lines: Vec<[f64; 2]> = Vec::new();
        for line in folds {
            lines.extend(line.windows(2).flat_map(|p| {
                (0..=1000)
                    .map(|i| [0, 1].map(|k| p[0][k] + (p[1][k] - p[0][k]) * f64::from(i) / 1000.0))
            }));
        }
        let covers = |label: &Label, p: [f64; 2]| {
            let (sin, cos) = label.turn.to_radians().sin_cos();
            let [x, y] = [p[0] - label.place[0], p[1] - label.place[1]];
            let letters = label.text.chars().count() as f64;
            (x * cos + y * sin).abs() < 0.29 * label.size * letters
                && (y * cos - x * sin).abs() < 0.5 * label.size
        };
        let folds = sheet
            .labels
            .iter()
            .filter(|label| label.kind == LabelKind::Fold);
        for label in folds {
            assert!(!lines.iter().any(|p| covers(label, *p)), "{label:?}");
            let others = sheet.labels.iter().filter(|other| *other != label);
            assert!(
                !others.clone().any(|other| covers(label, other.place)),
                "{label:?}"
            );
        }
    }
}

#[test]
fn models_of_few_faces_are_built_face_by_face_however_little_these_fold() {
    let kind = |points: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>| {
        RecognizedMesh::of(&Mesh::new(points, triangles).unwrap())
            .unwrap()
            .kind
    };
    // Squares of a saddle, no four of whose corners lie in a plane, and the same with a tenth of their size of noise.
    let saddle = |n: u32, noise: f64| {
        let mut random = Random::new(5);
        let point = |i: u32| {
            let (x, y) = (f64::from(i % n), f64::from(i / n));
            [
                x,
                y,
                0.02 * (x - 4.5).powi(2) * (y - 4.5) + noise * random.normal(),
            ]
        };
        let squares = (0..n - 1).flat_map(|j| (0..n - 1).map(move |i| j * n + i));
        let triangles = squares.flat_map(|a| [[a, a + 1, a + n + 1], [a, a + n + 1, a + n]]);
        kind((0..n * n).map(point).collect(), triangles.collect())
    };
    assert_eq!(saddle(10, 0.0), MeshKind::Faces);
    assert_eq!(saddle(10, 0.1), MeshKind::Faces);
    assert_eq!(saddle(20, 0.1), MeshKind::Noisy);
    // A plate with a round bump: what lies in its plane to rounding is no scan, unless the bump has noise.
    let bump = |noise: f64| {
        let (n, mut random) = (30u32, Random::new(3));
        let mut point = |i: u32| {
            let [x, y] = [i % n, i / n].map(|k| f64::from(k) - 14.5);
            let near = 1.0 - x.hypot(y) / 13.0;
            let rough = noise * random.normal();
            [
                x,
                y,
                if near > 0.0 {
                    3.0 * near * near * (3.0 - 2.0 * near) + rough
                } else {
                    0.0
                },
            ]
        };
        let points = (0..n * n).map(&mut point).collect();
        let squares = (0..n - 1).flat_map(|j| (0..n - 1).map(move |i| j * n + i));
        let triangles = squares.flat_map(|a| match (7 * a) % 5 < 2 {
            true => [[a, a + 1, a + n + 1], [a, a + n + 1, a + n]],
            false => [[a, a + 1, a + n], [a + 1, a + n + 1, a + n]],
        });
        kind(points, triangles.collect())
    };
    assert_eq!(bump(0.0), MeshKind::Surface);
    assert_eq!(bump(0.1), MeshKind::Noisy);
    // An open pyramid of many sides, whose tip bends by more than all other vertices together.
    let sides = 14u32;
    let mut points = vec![[0.0, 0.0, 60.0]];
    points.extend((0..sides).map(|k| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(sides)).sin_cos();
        [20.0 * cos, 20.0 * sin, 0.0]
    }));
    let triangles = (0..sides).map(|k| [0, 1 + k, 1 + (k + 1) % sides]);
    assert_eq!(kind(points, triangles.collect()), MeshKind::Faces);
}

/// What rounding in a file bends a quad by is no fold that anybody makes.
#[test]
fn folds_that_round_to_no_angle_are_not_drawn() {
    // A gable of two squares that meet at a right angle; one corner of the left one is lifted from its plane.
    let folded = |lift: f64| {
        let side = 0.5_f64.sqrt();
        let corners = vec![
            [-side, 0.0, -side + lift],
            [0.0, 0.0, 0.0],
            [side, 0.0, -side],
            [-side, 1.0, -side],
            [0.0, 1.0, 0.0],
            [side, 1.0, -side],
        ];
        let triangles = vec![[0, 1, 3], [1, 4, 3], [1, 2, 5], [1, 5, 4]];
        let mesh = Mesh::new(corners, triangles).unwrap();
        let pattern = pattern_exact(&mesh, &NetOptions::default()).unwrap();
        let drawing = Drawing::new(&pattern.sheets, &DrawingOptions::default()).unwrap();
        let angles = drawing.sheets.iter().flat_map(|sheet| &sheet.folds);
        let angles: Vec<f64> = angles.map(|fold| fold.angle.round()).collect();
        (pattern.sheets[0].folds.len(), angles)
    };
    assert_eq!(folded(0.0), (1, vec![90.0]));
    assert_eq!(folded(0.005), (2, vec![90.0]));
    let (count, mut angles) = folded(0.02);
    angles.sort_by(f64::total_cmp);
    assert_eq!((count, angles), (2, vec![1.0, 90.0]));
}
