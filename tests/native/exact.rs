//! Meshes with exact faces laid flat: lengths, areas and folds by closed forms.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use developable::Mesh;
use developable::drawing::{Drawing, DrawingOptions};
use developable::files::drawings::write_dxf;
use developable::pattern::{MeshPattern, Sheet, has_exact_faces, pattern_exact};

fn seam_length(pattern: &MeshPattern) -> f64 {
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
        [0, 1, 2].map(|k| {
            if i / 2 == k {
                30.0 - 60.0 * (i % 2) as f64
            } else {
                0.0
            }
        })
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
        (
            tetrahedron,
            3.0 * edge,
            3,
            4.0 * 3f64.sqrt() / 4.0 * edge * edge,
        ),
        (boxed, 7.0 * 60.0, 5, 6.0 * 3600.0),
        (
            hull((0..6).map(octahedron).collect()),
            5.0 * edge / 2.0,
            7,
            8.0 * 3f64.sqrt() / 4.0 * edge * edge / 4.0,
        ),
    ];
    for (mesh, cut, folds, area) in all {
        assert!(has_exact_faces(&mesh));
        let pattern = pattern_exact(&mesh, None).unwrap();
        let [sheet] = &pattern.sheets[..] else {
            panic!("{} sheets", pattern.sheets.len());
        };
        assert!(
            (seam_length(&pattern) / cut - 1.0).abs() < 1e-9,
            "{}",
            seam_length(&pattern)
        );
        assert_eq!((sheet.folds.len(), sheet.strain), (folds, 0.0));
        for area in [sheet.area / area, flat_area(sheet) / area] {
            assert!((area - 1.0).abs() < 1e-9, "{area}");
        }
    }
}

#[test]
fn a_hole_through_a_block_has_two_circles_and_a_strip() {
    let mesh = block_with_hole();
    assert!(has_exact_faces(&mesh));
    let pattern = pattern_exact(&mesh, None).unwrap();
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
    let pattern = pattern_exact(&Mesh::new(points, triangles).unwrap(), None).unwrap();
    assert_eq!(pattern.sheets.len(), 3);
    assert!(
        pattern
            .sheets
            .iter()
            .all(|sheet| (sheet.area - 100.0).abs() < 1e-9)
    );
}

#[test]
fn sheets_fit_the_room_that_there_is() {
    // A cross of squares of 60 needs 180 × 240.
    let mesh = block_with_hole();
    let whole = pattern_exact(&mesh, None).unwrap().sheets.len();
    let pattern = pattern_exact(&mesh, Some([65.0, 65.0])).unwrap();
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
    let surface = |height: &dyn Fn(f64, f64, usize) -> f64| {
        let n = 60usize;
        let point = |i: usize| {
            let (x, y) = ((i % n) as f64, (i / n) as f64);
            [x, y, height(x, y, i)]
        };
        let squares = (0..n - 1).flat_map(|j| (0..n - 1).map(move |i| (j * n + i) as u32));
        let triangles = squares.flat_map(|a| [[a, a + 1, a + 61], [a, a + 61, a + 60]]);
        Mesh::new((0..n * n).map(point).collect(), triangles.collect()).unwrap()
    };
    let noise = |i: usize| ((i as f64 * 12.9898).sin() * 43758.5453).fract() * 0.1;
    let roof = |x: f64| 0.8 * (30.0 - (x - 29.5).abs());
    assert!(has_exact_faces(&surface(&|x, _, _| roof(x))));
    assert!(!has_exact_faces(&surface(&|x, _, i| roof(x) + noise(i))));
    assert!(!has_exact_faces(&surface(&|x, y, _| (2500.0
        - (x - 30.0).powi(2)
        - (y - 30.0).powi(2))
    .sqrt())));
}
