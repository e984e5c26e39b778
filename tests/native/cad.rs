//! Parts as programs of CAD triangulate them, laid flat: lengths, areas and bends by closed forms.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use developable::drawing::{Bending, Drawing, DrawingOptions};
use developable::pattern::{
    FlatOptions, MeshKind, NetOptions, Pattern, RecognizedMesh, Shape, lay_flat, pattern_exact,
    sheet_metal,
};
use developable::{Exactness, Mesh};

/// The pattern of a mesh whose kind is recognised, and whether bends of it were divided.
fn pattern_of(mesh: &Mesh) -> (Pattern, bool) {
    let kind = RecognizedMesh::of(mesh).unwrap().kind;
    assert!(
        [MeshKind::Faces, MeshKind::Bends].contains(&kind),
        "a part has exact faces"
    );
    let pattern = lay_flat(Shape::Mesh(mesh), &FlatOptions::default()).unwrap();
    (pattern, kind == MeshKind::Bends)
}

fn length_of(line: &[[f64; 2]]) -> f64 {
    let side = |pair: &[[f64; 2]]| f64::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
    line.windows(2).map(side).sum()
}

/// The bends of all sheets: number of folds, angle and radius of each.
fn bends_of(pattern: &Pattern) -> Vec<(usize, f64, f64)> {
    let mut found: Vec<(usize, f64, f64)> = Vec::new();
    for sheet in &pattern.sheets {
        let mut numbers: Vec<u32> = Vec::new();
        for bend in sheet.folds.iter().filter_map(|fold| fold.bend) {
            if !numbers.contains(&bend.number) {
                numbers.push(bend.number);
                let own = |other: &&developable::pattern::Fold| {
                    other.bend.is_some_and(|b| b.number == bend.number)
                };
                found.push((
                    sheet.folds.iter().filter(own).count(),
                    bend.angle,
                    bend.radius,
                ));
            }
        }
    }
    found
}

/// A part turned about an axis: rows of vertices on circles, each with its height, radius and number, joined by triangles in the order
/// of their angles, and closed by discs. A row of radius 0 is a tip.
fn turned(rows: &[(f64, f64, u32)]) -> Mesh {
    let mut points = Vec::new();
    let mut rings: Vec<(u32, u32)> = Vec::new();
    for &(height, radius, count) in rows {
        let count = if radius == 0.0 { 1 } else { count };
        rings.push((points.len() as u32, count));
        // Each row begins at another angle.
        let start = 0.1 * rings.len() as f64;
        points.extend((0..count).map(|k| {
            let angle = start + TAU * f64::from(k) / f64::from(count);
            [radius * angle.cos(), radius * angle.sin(), height]
        }));
    }
    let mut triangles = Vec::new();
    for (k, pair) in rings.windows(2).enumerate() {
        let [(a, m), (b, n)] = [pair[0], pair[1]];
        let [low, high] = [0.1 * (k + 1) as f64, 0.1 * (k + 2) as f64];
        let (mut i, mut j) = (0, 0);
        while i < m || j < n {
            let next = |start: f64, k: u32, of: u32| start + TAU * f64::from(k + 1) / f64::from(of);
            let is_lower = j == n || (i < m && next(low, i, m) < next(high, j, n));
            let (p, q) = (a + i % m, b + j % n);
            if is_lower && m > 1 {
                triangles.push([p, a + (i + 1) % m, q]);
            } else if !is_lower && n > 1 {
                triangles.push([p, b + (j + 1) % n, q]);
            }
            (i, j) = if is_lower { (i + 1, j) } else { (i, j + 1) };
        }
    }
    let mut disc = |(first, count): (u32, u32), is_top: bool| {
        triangles.extend((1..count.max(2) - 1).map(|k| match is_top {
            true => [first, first + k, first + k + 1],
            false => [first, first + k + 1, first + k],
        }));
    };
    disc(rings[0], false);
    disc(rings[rings.len() - 1], true);
    Mesh::new(points, triangles).unwrap()
}

fn disc_area(radius: f64, sides: u32) -> f64 {
    let half = PI / f64::from(sides);
    0.5 * radius * radius * f64::from(sides) * (2.0 * half).sin()
}

/// The sectors of cones with rows of vertices that do not stand above each other, as kernels of CAD put them inside of curved faces.
#[test]
fn cones_in_any_triangles_are_sectors_with_their_discs() {
    let rows = |low: f64, high: f64, sides: u32| {
        let row = |k: u32| {
            let share = f64::from(k) / 4.0;
            let count = if k == 0 || k == 4 { 63 } else { sides };
            (40.0 * share, low + (high - low) * share, count)
        };
        (0..=4).map(row).collect::<Vec<_>>()
    };
    for (low, high, sides) in [
        (25.0, 0.0, 32),
        (30.0, 12.0, 32),
        (12.0, 30.0, 20),
        (20.0, 20.0, 32),
    ] {
        let mesh = turned(&rows(low, high, sides));
        let (pattern, is_divided) = pattern_of(&mesh);
        assert!(is_divided, "{low} {high}");
        assert_eq!(pattern.sheets.len(), 1, "{low} {high}");
        let side = (low - high).hypot(40.0);
        let discs = [low, high].map(|radius| disc_area(radius, 63));
        let area = PI * (low + high) * side + discs[0] + discs[1];
        let found: f64 = pattern.sheets.iter().map(|sheet| sheet.area).sum();
        // The rim of a sector is a polygon, that of a cylinder is straight.
        let tolerance = if low == high { 1e-6 } else { 1e-3 };
        assert!(
            (found - area).abs() < tolerance * area,
            "{low} {high}: {found} {area}"
        );
        let [(_, angle, _)] = bends_of(&pattern)[..] else {
            panic!("{low} {high}: {:?}", bends_of(&pattern));
        };
        // All around.
        let around = TAU * 40.0 / side;
        assert!((angle / around - 1.0).abs() < 2e-3, "{angle} {around}");
    }
}

/// The corners of a disc that ends a flat cone are on the cone as well.
#[test]
fn discs_of_flat_cones_are_no_parts_of_them() {
    let mesh = turned(&[(0.0, 30.0, 63), (1.2, 10.0, 63)]);
    let (pattern, _) = pattern_of(&mesh);
    let discs = [30.0, 10.0].map(|radius| disc_area(radius, 63));
    let area = PI * (30.0 + 10.0) * f64::hypot(20.0, 1.2) + discs[0] + discs[1];
    let found: f64 = pattern.sheets.iter().map(|sheet| sheet.area).sum();
    assert!((found / area - 1.0).abs() < 2e-3, "{found} {area}");
}

#[test]
fn balls_are_no_cones() {
    let row = |k: u32| {
        let angle = PI * (f64::from(k) / 12.0 - 0.5);
        let radius = if k == 0 || k == 12 {
            0.0
        } else {
            20.0 * angle.cos()
        };
        (20.0 * angle.sin(), radius, 24 + 5 * (k % 3))
    };
    let mesh = turned(&(0..=12).map(row).collect::<Vec<_>>());
    assert_ne!(RecognizedMesh::of(&mesh).unwrap().kind, MeshKind::Bends);
}

/// The solid of a strip of metal with these flat lengths between bends of a right angle, alternating to either side, in `steps` facets
/// each, with coordinates in single precision.
fn strip(flats: &[f64], inner: f64, thickness: f64, width: f64, steps: u32) -> Mesh {
    let (mut at, mut turn) = ([0.0, 0.0], 0.0f64);
    let mut skins: [Vec<[f64; 2]>; 2] = Default::default();
    let mut put = |[x, z]: [f64; 2], turn: f64| {
        for (skin, away) in [0.0, thickness].into_iter().enumerate() {
            skins[skin].push([x - away * turn.sin(), z + away * turn.cos()]);
        }
    };
    put(at, turn);
    for (k, flat) in flats.iter().enumerate() {
        at = [at[0] + flat * turn.cos(), at[1] + flat * turn.sin()];
        put(at, turn);
        if k + 1 == flats.len() {
            break;
        }
        // Around a centre above the strip or below it.
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let radius = if sign > 0.0 { inner + thickness } else { inner };
        let centre = [
            at[0] - sign * radius * turn.sin(),
            at[1] + sign * radius * turn.cos(),
        ];
        for _ in 0..steps {
            turn += sign * FRAC_PI_2 / f64::from(steps);
            at = [
                centre[0] + sign * radius * turn.sin(),
                centre[1] - sign * radius * turn.cos(),
            ];
            put(at, turn);
        }
    }
    let n = skins[0].len() as u32;
    let mut points = Vec::new();
    for y in [0.0, width] {
        points.extend(
            skins
                .iter()
                .flatten()
                .map(|[x, z]| [*x, y, *z].map(|v| f64::from(v as f32))),
        );
    }
    let far = 2 * n;
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [u32; 4]| triangles.extend([[a, b, c], [a, c, d]]);
    for i in 0..n - 1 {
        quad([i, far + i, far + i + 1, i + 1]);
        quad([n + i, n + i + 1, far + n + i + 1, far + n + i]);
        quad([i, i + 1, n + i + 1, n + i]);
        quad([far + i, far + n + i, far + n + i + 1, far + i + 1]);
    }
    quad([0, n, far + n, far]);
    quad([n - 1, far + n - 1, far + 2 * n - 1, 2 * n - 1]);
    Mesh::new(points, triangles).unwrap()
}

/// Facets of a bend are hundreds of times as long as wide, and what is rounding at one end is far off at the other.
#[test]
fn bends_in_slender_facets_are_whole() {
    for steps in [4, 16, 64] {
        let solid = strip(&[20.0, 15.0, 30.0, 15.0, 20.0], 2.0, 1.5, 80.0, steps);
        let metal = sheet_metal(&solid).unwrap().expect("sheet metal");
        assert!((metal.thickness - 1.5).abs() < 1e-5);
        let pattern = pattern_exact(&metal.skin, &NetOptions::default()).unwrap();
        let bends = bends_of(&pattern);
        assert_eq!(bends.len(), 4, "{steps}: {bends:?}");
        for (folds, angle, radius) in bends {
            assert_eq!(folds, steps as usize + 1);
            assert!((angle - FRAC_PI_2).abs() < 1e-4, "{angle}");
            assert!(
                [2.0, 3.5].iter().any(|r| (radius - r).abs() < 0.01 * r),
                "{radius}"
            );
        }
        let options = DrawingOptions::default().bending(Bending::new(1.5).k_factor(0.5));
        let drawing = Drawing::new(&pattern.sheets, &options).unwrap();
        let [blank] = &drawing.sheets[..] else {
            panic!("{} sheets", drawing.sheets.len());
        };
        // The blank stands upright: four bend lines across it, each on one height or one side.
        assert_eq!(blank.folds.len(), 4);
        for line in &blank.folds {
            let [from, to] = [line.points[0], line.points[line.points.len() - 1]];
            let off = [0, 1].map(|k: usize| f64::abs(to[k] - from[k]));
            assert!(off[0].min(off[1]) < 1e-4, "{from:?} {to:?}");
        }
        let [low, high] = blank.bounds;
        let long = 100.0 + 4.0 * FRAC_PI_2 * 2.75;
        let found = f64::max(high[0] - low[0], high[1] - low[1]);
        // Chords of few facets are shorter than their arc by less than a hundredth.
        assert!((found - long).abs() < 0.01, "{steps}: {found} {long}");
    }
}

#[test]
fn a_tube_is_one_bend_all_around() {
    // Rows of vertices above each other are strips already; others are divided at the vertices of both rims.
    let side = |points: &[[f64; 3]]| {
        let k = |v: usize| (v % 40) as u32;
        let quads = (0..40).map(|i| [k(i), k(i + 1), 40 + k(i + 1), 40 + k(i)]);
        let triangles = quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        Mesh::new(points.to_vec(), triangles.collect()).unwrap()
    };
    let circle = |k: u32, start: f64, high: f64| {
        let angle = start + TAU * f64::from(k) / 40.0;
        [20.0 * angle.cos(), 20.0 * angle.sin(), high]
    };
    for (start, lines) in [(0.0, 40), (0.06, 80)] {
        let points: Vec<[f64; 3]> = (0..40)
            .map(|k| circle(k, 0.0, 0.0))
            .chain((0..40).map(|k| circle(k, start, 50.0)))
            .collect();
        let (pattern, is_divided) = pattern_of(&side(&points));
        assert_eq!(is_divided, start > 0.0);
        let bends = bends_of(&pattern);
        let [(folds, angle, radius)] = bends[..] else {
            panic!("{bends:?}");
        };
        assert_eq!(folds, lines - 1);
        assert!(
            (angle - TAU).abs() < 1e-9 && (radius - 20.0).abs() < 0.5,
            "{angle} {radius}"
        );
    }
}

/// Two meshes in one, the second one beside the first.
fn beside(one: &Mesh, other: &Mesh) -> Mesh {
    let count = one.positions().len() as u32;
    let moved = other
        .positions()
        .iter()
        .map(|[x, y, z]| [*x, y + 500.0, *z]);
    let triangles = other.triangles().iter().map(|t| t.map(|v| v + count));
    Mesh::new(
        one.positions().iter().copied().chain(moved).collect(),
        one.triangles().iter().copied().chain(triangles).collect(),
    )
    .unwrap()
}

#[test]
fn bodies_of_one_thickness_are_sheet_metal_together() {
    let bent = |thickness: f64| strip(&[20.0, 15.0], 2.0, thickness, 80.0, 8);
    let area = |mesh: &Mesh| {
        let solid = pattern_exact(mesh, &NetOptions::default()).unwrap();
        solid.sheets.iter().map(|sheet| sheet.area).sum::<f64>()
    };
    let one = sheet_metal(&bent(1.5)).unwrap().expect("sheet metal");
    let two = sheet_metal(&beside(&bent(1.5), &bent(1.5))).unwrap();
    let two = two.expect("sheet metal");
    assert!((area(&two.skin) / area(&one.skin) - 2.0).abs() < 1e-6);
    assert!((two.thickness - 1.5).abs() < 1e-5);
    assert!(
        sheet_metal(&beside(&bent(1.5), &bent(1.0)))
            .unwrap()
            .is_none()
    );
}

/// A blank is cut straight through.
#[test]
fn a_plate_with_chamfers_is_no_sheet_metal() {
    // Levels with their heights and how far they are inset.
    let plate = |levels: &[(f64, f64)]| {
        let mut points = Vec::new();
        for (z, inset) in levels {
            let [x, y] = [240.0, 215.0].map(|side| side - inset);
            points.extend(
                [[*inset, *inset], [x, *inset], [x, y], [*inset, y]].map(|[x, y]| [x, y, *z]),
            );
        }
        let top = 4 * (levels.len() as u32 - 1);
        let mut triangles = vec![
            [0, 2, 1],
            [0, 3, 2],
            [top, top + 1, top + 2],
            [top, top + 2, top + 3],
        ];
        for (level, k) in (0..top / 4).flat_map(|level| (0..4).map(move |k| (level, k))) {
            let [a, b] = [4 * level + k, 4 * level + (k + 1) % 4];
            triangles.extend([[a, b, b + 4], [a, b + 4, a + 4]]);
        }
        Mesh::new(points, triangles).unwrap()
    };
    let is_metal = |levels: &[(f64, f64)]| sheet_metal(&plate(levels)).unwrap().is_some();
    assert!(is_metal(&[(0.0, 0.0), (4.0, 0.0)]));
    assert!(!is_metal(&[
        (0.0, 0.75),
        (0.75, 0.0),
        (3.25, 0.0),
        (4.0, 0.75)
    ]));
}

/// Of an open cone in any triangles no face is flat.
#[test]
fn an_open_cone_is_a_sector() {
    let rows = [
        (0.0, 30.0, 63),
        (10.0, 25.0, 48),
        (20.0, 20.0, 48),
        (30.0, 15.0, 48),
        (40.0, 10.0, 63),
    ];
    let closed = turned(&rows);
    let wall = closed.triangles().iter().filter(|t| {
        let [a, b, c] = t.map(|v| closed.positions()[v as usize][2]);
        a != b || b != c
    });
    let mesh = Mesh::new(closed.positions().to_vec(), wall.copied().collect()).unwrap();
    let (pattern, is_divided) = pattern_of(&mesh);
    assert!(is_divided);
    assert_eq!(pattern.sheets.len(), 1);
    let area = PI * (30.0 + 10.0) * 40.0 * f64::hypot(1.0, 0.5);
    assert!((pattern.sheets[0].area / area - 1.0).abs() < 2e-3);
}

/// Bars between holes that are as wide as the plate is thick have parallel sides at its thickness, too.
#[test]
fn a_plate_with_bars_as_wide_as_it_is_thick_is_sheet_metal() {
    let [xs, ys] = [
        [0.0, 10.0, 28.0, 30.0, 48.0, 60.0],
        [0.0, 8.0, 30.0, 32.0, 54.0, 60.0],
    ];
    let is_hole = |i: usize, j: usize| i % 2 == 1 && j % 2 == 1;
    let at = |i: usize, j: usize, top: usize| (2 * (6 * i + j) + top) as u32;
    let mut points = Vec::new();
    for x in xs {
        points.extend(ys.iter().flat_map(|y| [[x, *y, 0.0], [x, *y, 2.0]]));
    }
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [u32; 4]| triangles.extend([[a, b, c], [a, c, d]]);
    for i in 0..5 {
        for j in 0..5 {
            if is_hole(i, j) {
                continue;
            }
            let ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            quad(ring.map(|(i, j)| at(i, j, 1)));
            quad([3, 2, 1, 0].map(|k: usize| at(ring[k].0, ring[k].1, 0)));
            let beside = [
                (i, j.wrapping_sub(1)),
                (i + 1, j),
                (i, j + 1),
                (i.wrapping_sub(1), j),
            ];
            for (k, (i, j)) in beside.into_iter().enumerate() {
                if i > 4 || j > 4 || is_hole(i, j) {
                    let [a, b] = [ring[k], ring[(k + 1) % 4]];
                    quad([
                        at(a.0, a.1, 0),
                        at(b.0, b.1, 0),
                        at(b.0, b.1, 1),
                        at(a.0, a.1, 1),
                    ]);
                }
            }
        }
    }
    let metal = sheet_metal(&Mesh::new(points, triangles).unwrap())
        .unwrap()
        .unwrap();
    assert!((metal.thickness - 2.0).abs() < 1e-9);
    let (pattern, _) = pattern_of(&metal.skin);
    let area: f64 = pattern.sheets.iter().map(|sheet| sheet.area).sum();
    assert!((area - (60.0 * 60.0 - 4.0 * 18.0 * 22.0)).abs() < 1e-6);
}

/// The rims of a funnel are level, and its walls are not upright.
#[test]
fn a_funnel_with_level_rims_is_sheet_metal() {
    let wide = 2.0 * f64::hypot(1.0, 0.5);
    let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    let mut points = Vec::new();
    for (half, z) in [
        (50.0, 0.0),
        (20.0, 60.0),
        (50.0 - wide, 0.0),
        (20.0 - wide, 60.0),
    ] {
        points.extend(corners.map(|[x, y]| [half * x, half * y, z]));
    }
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [u32; 4]| triangles.extend([[a, b, c], [a, c, d]]);
    for k in 0..4 {
        let next = (k + 1) % 4;
        for [low, high] in [[0, 4], [4, 12], [12, 8], [8, 0]] {
            quad([low + k, low + next, high + next, high + k]);
        }
    }
    let metal = sheet_metal(&Mesh::new(points, triangles).unwrap())
        .unwrap()
        .unwrap();
    assert!((metal.thickness - 2.0).abs() < 1e-9);
    assert_eq!(metal.skin.triangles().len(), 8);
}

/// A wall swept along a curve that turns both ways, with a row of vertices between its rims that are on rulings of their own.
#[test]
fn a_wall_of_any_profile_is_folded_along_its_rulings() {
    const COLUMNS: u32 = 40;
    let at = |k: f64, high: f64| [2.0 * k, 10.0 * (k / 6.0).sin(), high];
    let mut points = Vec::new();
    points.extend((0..=COLUMNS).map(|k| at(f64::from(k), 0.0)));
    points.extend((0..=COLUMNS).map(|k| at(f64::from(k), 30.0)));
    points.extend((0..COLUMNS).map(|k| at(f64::from(k) + 0.4, 11.0)));
    let [top, middle] = [COLUMNS + 1, 2 * COLUMNS + 2];
    let mut triangles = vec![
        [0, middle, top],
        [COLUMNS, top + COLUMNS, middle + COLUMNS - 1],
    ];
    for k in 0..COLUMNS {
        triangles.push([k, k + 1, middle + k]);
        triangles.push([top + k + 1, top + k, middle + k]);
        if k + 1 < COLUMNS {
            triangles.push([k + 1, middle + k + 1, middle + k]);
            triangles.push([top + k + 1, middle + k, middle + k + 1]);
        }
    }
    let length: f64 = (0..COLUMNS as usize)
        .map(|k| {
            f64::hypot(
                points[k + 1][0] - points[k][0],
                points[k + 1][1] - points[k][1],
            )
        })
        .sum();
    let (pattern, is_divided) = pattern_of(&Mesh::new(points, triangles).unwrap());
    assert!(is_divided);
    let [sheet] = &pattern.sheets[..] else {
        panic!("{} sheets", pattern.sheets.len());
    };
    assert!((sheet.area / (30.0 * length) - 1.0).abs() < 1e-9);
    assert_eq!(sheet.folds.len(), COLUMNS as usize - 1);
    for fold in &sheet.folds {
        assert!((fold.seam.angle < 0.4) && (length_of(&fold.points) - 30.0).abs() < 1e-9);
    }
}

/// A hole divides the lines of a bend, and its edges move with the sheet.
#[test]
fn a_bend_with_a_hole_has_its_allowance() {
    // Flat for 40, a quarter of a circle in twelve strips, and flat for 40; the hole takes the middle third of six strips.
    let step = FRAC_PI_2 / 12.0;
    let mut profile = vec![[-40.0, 0.0]];
    profile.extend((0..=12).map(|k| {
        let (sin, cos) = (step * f64::from(k)).sin_cos();
        [10.0 * sin, 10.0 * (1.0 - cos)]
    }));
    profile.push([10.0, 50.0]);
    let mut points = Vec::new();
    for [x, z] in &profile {
        points.extend([0.0, 20.0, 40.0, 60.0].map(|y| [*x, y, *z]));
    }
    let cells = (0..14u32).flat_map(|row| (0..3u32).map(move |column| (row, column)));
    let cells = cells.filter(|(row, column)| *column != 1 || !(4..10).contains(row));
    let triangles: Vec<[u32; 3]> = cells
        .flat_map(|(row, column)| {
            let [a, b] = [4 * row + column, 4 * row + column + 1];
            [[a, a + 4, b + 4], [a, b + 4, b]]
        })
        .collect();
    for (triangles, neutral) in [
        (triangles.clone(), 11.0),
        (
            triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect(),
            9.0,
        ),
    ] {
        let mesh = Mesh::new(points.clone(), triangles).unwrap();
        let (pattern, _) = pattern_of(&mesh);
        let options = DrawingOptions::default().bending(Bending::new(2.0).k_factor(0.5));
        let drawing = Drawing::new(&pattern.sheets, &options).unwrap();
        let [blank] = &drawing.sheets[..] else {
            panic!("{} sheets", drawing.sheets.len());
        };
        let mut boxes: Vec<[f64; 2]> = (blank.cuts.iter())
            .map(|cut| {
                let [x, y] = [0, 1].map(|k: usize| {
                    let all = || cut.iter().map(move |p| p[k]);
                    all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
                });
                [x.max(y), x.min(y)]
            })
            .collect();
        boxes.sort_by(|a, b| b[0].total_cmp(&a[0]));
        let expected = [
            [80.0 + FRAC_PI_2 * neutral, 60.0],
            [20.0, 6.0 * step * neutral],
        ];
        assert_eq!(boxes.len(), 2);
        for (found, expected) in boxes.iter().zip(expected) {
            for (a, b) in found.iter().zip(expected) {
                // Chords are shorter than arcs.
                assert!((a - b).abs() < 2e-4 * b, "{boxes:?} {expected:?}");
            }
        }
        // The line in the middle, on both sides of the hole.
        let angles: Vec<f64> = blank.folds.iter().map(|fold| fold.angle).collect();
        assert!(
            angles.len() == 2 && angles.iter().all(|angle| (angle - 90.0).abs() < 1e-4),
            "{angles:?}"
        );
    }
}

/// A rib stands on one skin only.
#[test]
fn an_angle_with_a_rib_is_no_sheet_metal() {
    let profile = [
        [0.0, 0.0],
        [60.0, 0.0],
        [60.0, 4.0],
        [4.0, 4.0],
        [4.0, 50.0],
        [0.0, 50.0],
    ];
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for y in [-20.0, 20.0] {
        points.extend(profile.map(|[x, z]| [x, y, z]));
    }
    for y in [-2.0, 2.0] {
        points.extend([[4.0, y, 4.0], [40.0, y, 4.0], [4.0, y, 40.0]]);
    }
    let mut polygon = |corners: &[u32]| {
        triangles.extend((1..corners.len() - 1).map(|k| [corners[0], corners[k], corners[k + 1]]));
    };
    polygon(&[0, 1, 2, 3]);
    polygon(&[0, 3, 4, 5]);
    polygon(&[9, 8, 7, 6]);
    polygon(&[11, 10, 9, 6]);
    for (k, next) in [(0, 1), (1, 2), (4, 5), (5, 0)] {
        polygon(&[next, k, k + 6, next + 6]);
    }
    // The inner faces around the rib's foot.
    polygon(&[2, 8, 16, 13]);
    polygon(&[2, 13, 12, 3]);
    polygon(&[8, 9, 15, 16]);
    polygon(&[3, 12, 14, 4]);
    polygon(&[4, 14, 17, 10]);
    polygon(&[10, 17, 15, 9]);
    polygon(&[12, 13, 14]);
    polygon(&[15, 17, 16]);
    polygon(&[13, 16, 17, 14]);
    let mesh = Mesh::new(points, triangles).unwrap();
    assert_eq!(Exactness::of(&mesh), Exactness::Faces);
    assert!(sheet_metal(&mesh).unwrap().is_none());
}
