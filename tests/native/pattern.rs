//! Surfaces cut into sheets that lie flat.

use crate::native::common::unit_square;
use developable::drawing::{Drawing, DrawingOptions};
use developable::patches::{PatchOptions, Patches};
use developable::pattern::{
    Direction, FlatOptions, MAX_FEW_FACES, NetOptions, Pattern, PatternOptions, Run, Shape, Sheet,
    lay_flat, pattern,
};
use developable::{Example, ExampleOptions, Heightfield, Lattice, Options, fit};

fn pattern_of(surface: &Heightfield) -> Pattern {
    let patches = Patches::new(surface, &PatchOptions::default()).unwrap();
    pattern(surface, &patches, &PatternOptions::default()).unwrap()
}

fn sheets(surface: &Heightfield) -> Vec<Sheet> {
    pattern_of(surface).sheets
}

/// Width and height of what the outlines enclose.
fn extent(sheet: &Sheet) -> [f64; 2] {
    let points = || (sheet.outlines.iter().flatten()).flat_map(|run| &run.points);
    [0, 1].map(|k| {
        let values = || points().map(|p| p[k]);
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    })
}

fn length(points: &[[f64; 2]]) -> f64 {
    let pieces = points.windows(2);
    pieces
        .map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]))
        .sum()
}

/// Both sides of each crease that is cut, by its number.
fn cuts(sheets: &[Sheet], crease: usize) -> Vec<&Run> {
    let runs = sheets.iter().flat_map(|s| s.outlines.iter().flatten());
    runs.filter(|run| run.seam.is_some_and(|seam| seam.crease == crease))
        .collect()
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} {expected} ±{tolerance}"
    );
}

#[test]
fn a_folded_card_is_as_large_as_the_flat_one() {
    // Folded across, along, and at a slant, at any place between the vertices.
    for (turn, offset) in [
        (0.0, 0.0),
        (0.0, 0.0037),
        (90.0, 0.0021),
        (30.0, 0.004),
        (77.0, 0.001),
    ] {
        for slope in [0.5, -1.3f64] {
            let (sin, cos) = f64::to_radians(turn).sin_cos();
            let card = unit_square(100, |x, y| {
                let across = cos * (x - 0.5 - offset) + sin * (y - 0.5);
                -slope * across.abs()
            });
            let sheets = sheets(&card);
            assert_eq!(sheets.len(), 1);
            let sheet = &sheets[0];
            assert_eq!((sheet.patches.len(), sheet.folds.len()), (2, 1));
            assert!(
                sheet.strain < 1e-5 && sheet.seam_gap < 1e-4,
                "{} {}",
                sheet.strain,
                sheet.seam_gap
            );
            let fold = &sheet.folds[0];
            let direction = if slope > 0.0 {
                Direction::Mountain
            } else {
                Direction::Valley
            };
            assert_eq!(fold.seam.direction, direction);
            near(fold.seam.angle, 2.0 * slope.abs().atan(), 0.01);
            assert_eq!(fold.points.len(), 2, "{turn} {offset}: {:?}", fold.points);
            let lattice = card.lattice();
            let width = (lattice.cols() - 1) as f64 * lattice.spacing();
            let height = (lattice.rows() - 1) as f64 * lattice.row_spacing();
            let steep = (1.0 + slope * slope).sqrt();
            let [w, h] = extent(sheet);
            if turn == 0.0 {
                near(w, width * steep, 0.002 * w);
                near(h, height, 0.002);
                near(length(&fold.points), height, 0.002);
                assert_eq!(
                    sheet.outlines[0]
                        .iter()
                        .map(|r| r.points.len())
                        .sum::<usize>(),
                    5,
                    "{sheet:?}"
                );
            } else if turn == 90.0 {
                near(w, width, 0.002);
                near(h, height * steep, 0.002 * h);
                near(length(&fold.points), width, 0.002);
            }
        }
    }
}

#[test]
fn a_zigzag_stays_in_one_piece() {
    // Four strips, three folds.
    let Pattern {
        patches, sheets, ..
    } = pattern_of(&unit_square(100, |x, _| {
        let t = 4.0 * (x - 0.003);
        0.1 * (t - 2.0 * (0.5 * t).round()).abs()
    }));
    assert_eq!(patches.len(), 4);
    assert_eq!(sheets.len(), 1);
    assert_eq!(sheets[0].patches, [0, 1, 2, 3]);
    let directions: Vec<Direction> = sheets[0].folds.iter().map(|f| f.seam.direction).collect();
    assert_eq!(
        directions
            .iter()
            .filter(|d| **d == Direction::Valley)
            .count(),
        1
    );
    assert_eq!(directions.len(), 3);
    // As wide as its strips together, over the 102 columns that cover the square.
    let slope = (1.0f64 + 0.16).sqrt();
    near(extent(&sheets[0])[0], 1.01 * slope, 0.002 * slope);
}

#[test]
fn a_pyramid_is_cut_along_one_of_its_edges() {
    // Four faces around an apex that lacks a part of a full turn.
    let Pattern {
        patches,
        sheets,
        creases,
        ..
    } = pattern_of(&unit_square(100, |x, y| {
        -0.8 * (x - 0.503).abs().max((y - 0.502).abs())
    }));
    assert_eq!(patches.len(), 4);
    assert_eq!(sheets.len(), 1);
    assert_eq!(sheets[0].folds.len(), 3);
    assert!(sheets[0].strain < 2e-3, "{}", sheets[0].strain);
    let cut = (0..4)
        .find(|c| sheets[0].folds.iter().all(|f| f.seam.crease != *c))
        .unwrap();
    let sides = cuts(&sheets, cut);
    assert_eq!(sides.len(), 2);
    for side in &sides {
        near(length(&side.points), creases[cut].length, 0.01);
        // Straight, but for the last two cells: four patches meet there, and nodes are of three.
        let apex = [side.points[0], *side.points.last().unwrap()];
        let away = |p: &[f64; 2]| {
            apex.map(|q| length(&[*p, q]))
                .into_iter()
                .fold(1.0, f64::min)
        };
        let [p, q] = apex;
        let off = |r: &[f64; 2]| {
            let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            area.abs() / length(&[p, q])
        };
        assert!(
            (side.points.iter()).all(|r| away(r) < 0.025 || off(r) < 5e-4),
            "{:?}",
            side.points
        );
    }
    near(length(&sides[0].points), length(&sides[1].points), 0.002);
}

#[test]
fn vaults_that_meet_in_a_curve_come_apart() {
    // A barrel vault through a lower one: the creases are curved, and no flat sheet has both sides.
    let arc = |v: f64| (0.49 - (v - 0.5).powi(2)).sqrt();
    let Pattern {
        patches,
        sheets,
        creases,
        ..
    } = pattern_of(&unit_square(100, move |x, y| (arc(x) - 0.05).max(arc(y))));
    assert_eq!(patches.len(), 3);
    assert_eq!(
        sheets.len(),
        3,
        "{:?}",
        sheets.iter().map(|s| &s.patches).collect::<Vec<_>>()
    );
    for sheet in &sheets {
        assert!(sheet.folds.is_empty());
        assert!(sheet.strain < 0.001);
    }
    for (number, crease) in creases.iter().enumerate() {
        let sides = cuts(&sheets, number);
        assert_eq!(sides.len(), 2);
        let [a, b] = [0, 1].map(|k| length(&sides[k].points));
        near(a / b, 1.0, 0.002);
        near(a / crease.length, 1.0, 0.01);
    }
}

#[test]
fn a_vertex_with_a_full_turn_around_it_is_folded_flat() {
    // The vertex of a Miura fold: its four angles are α, π − α, π − α and α.
    let fold = unit_square(120, |x, y| {
        0.5 * (x - 0.452 + 0.4 * (y - 0.481).abs()).abs()
    });
    let Pattern {
        patches, sheets, ..
    } = pattern_of(&fold);
    assert_eq!(patches.len(), 4);
    assert_eq!(sheets.len(), 1);
    let sheet = &sheets[0];
    // As Maekawa's theorem has it, two more of the one kind than of the other.
    let valleys = sheet
        .folds
        .iter()
        .filter(|f| f.seam.direction == Direction::Valley);
    assert_eq!((sheet.folds.len(), valleys.count()), (4, 3));
    let shape: Vec<usize> = sheet.outlines.iter().map(Vec::len).collect();
    assert_eq!(shape, [1], "one line around it all");
    assert!(
        sheet.seam_gap < 0.001 && sheet.strain < 0.001,
        "{} {}",
        sheet.seam_gap,
        sheet.strain
    );
    // All four meet at the same slope.
    let steep = (1.0f64 + 0.25 * 1.16).sqrt();
    near(sheet.area, steep, 0.02);
    let drawing = Drawing::new(&sheets, &DrawingOptions::default()).unwrap();
    let worst = drawing.summary.worst_angle.unwrap();
    assert_eq!(drawing.summary.points, 1);
    near(worst.flat, 360.0, 1e-9);
    near(worst.surface, 360.0, 0.5);
}

#[test]
fn holes_and_tears_are_cut() {
    // A flat sheet with a hole, and a step that no fold bridges.
    let holed = crate::native::common::cut(&unit_square(80, |_, _| 0.0), |x, y| {
        (x - 0.5).hypot(y - 0.5) > 0.2
    });
    let found = sheets(&holed);
    assert_eq!((found.len(), found[0].outlines.len()), (1, 2));
    let around = |k: usize| -> f64 { found[0].outlines[k].iter().map(|r| length(&r.points)).sum() };
    near(around(0), 4.0, 0.05);
    near(around(1), std::f64::consts::TAU * 0.2, 0.08);
    let step = unit_square(80, |x, _| if x > 0.503 { 0.3 } else { 0.0 });
    let Pattern {
        patches,
        sheets: found,
        ..
    } = pattern_of(&step);
    if patches.len() > 1 {
        assert!(found.iter().all(|sheet| sheet.folds.is_empty()));
    }
}

#[test]
fn nonsense_is_refused() {
    let field = unit_square(20, |x, _| 0.5 * (x - 0.5).abs());
    let patches = Patches::new(&field, &PatchOptions::default()).unwrap();
    for gap in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = PatternOptions::default().max_seam_gap(gap);
        let error = pattern(&field, &patches, &options).unwrap_err();
        assert!(error.code() == "OPTION" && error.to_string().contains("maxSeamGap"));
        let options = PatternOptions::default().max_strain(gap);
        let error = pattern(&field, &patches, &options).unwrap_err();
        assert!(error.code() == "OPTION" && error.to_string().contains("maxStrain"));
    }
    let other = unit_square(30, |x, _| x);
    let error = pattern(&other, &patches, &PatternOptions::default()).unwrap_err();
    assert_eq!(error.code(), "SHAPE");
}

/// Four planes fold from one sheet; vaults meet them along curves, and are cut.
#[test]
fn a_house_is_three_sheets_and_three_folds_once_it_was_solved_from_noise() {
    let options = ExampleOptions {
        noise: 0.01,
        ..ExampleOptions::default()
    };
    let input = Example::House.generate(&options).unwrap().input;
    let field = input.to_lattice(None).unwrap();
    let solved = fit(&field, &Options::paper()).unwrap();
    let sheets = sheets(solved.heightfield());
    let patches: Vec<usize> = sheets.iter().map(|sheet| sheet.patches.len()).collect();
    let folds: Vec<usize> = sheets.iter().map(|sheet| sheet.folds.len()).collect();
    assert_eq!(patches, [4, 1, 1]);
    assert_eq!(folds, [3, 0, 0], "folds without a ring");
    // Planes of slope 0.8 that meet at a right angle in plan.
    let hip = (1.0f64 / 1.64).acos().to_degrees();
    for fold in &sheets[0].folds {
        assert_eq!(fold.seam.direction, Direction::Mountain);
        near(fold.seam.angle.to_degrees(), hip, 3.0);
        // From the ridge's end to the corner, 0.375 in x, in y and 0.3 up.
        near(
            length(&fold.points),
            (2.0f64 * 0.375 * 0.375 + 0.09).sqrt(),
            0.03,
        );
    }
    for sheet in &sheets {
        assert!(sheet.strain < 0.003, "{}", sheet.strain);
    }
    // The vaults are alike, and rectangles with one side cut to a curve: as long along the arc.
    let arc = 2.0 * 0.36 * (0.3f64 / 0.36).asin();
    for vault in &sheets[1..] {
        let [width, height] = extent(vault);
        near(width.max(height), arc, 0.06);
    }
    near(sheets[1].area, sheets[2].area, 0.01);
}

/// Patches belong to one surface; on another of the same shape their creases lead nowhere.
#[test]
fn patches_of_another_surface_are_refused() {
    let lattice = Lattice::new(40, 40, 0.025).unwrap();
    let roof = |x: f64, _: f64| -0.5 * (x - 0.52).abs();
    let whole = Heightfield::from_fn(lattice, roof).unwrap();
    let island = Heightfield::from_fn(lattice, |x, y| {
        if (x - 0.5).hypot(y + 0.4) < 0.3 {
            roof(x, y)
        } else {
            f64::NAN
        }
    });
    let island = island.unwrap();
    let larger = Heightfield::new(
        Lattice::new(40, 40, 0.05).unwrap(),
        whole.heights().to_vec(),
    );
    let options = PatternOptions::default();
    for (of, on) in [
        (&whole, &island),
        (&island, &whole),
        (&whole, &larger.unwrap()),
    ] {
        let patches = Patches::new(of, &PatchOptions::default()).unwrap();
        let error = pattern(on, &patches, &options).unwrap_err();
        assert_eq!(error.code(), "MISMATCH", "{error}");
        assert!(pattern(of, &patches, &options).is_ok());
    }
}

/// All closed lines of a sheet, the last point joined to the first.
fn lines(sheet: &Sheet) -> Vec<Vec<[f64; 2]>> {
    let outlines = sheet.outlines.iter();
    let line = outlines.map(|runs| {
        let points = runs
            .iter()
            .flat_map(|run| &run.points[..run.points.len() - 1]);
        points.copied().collect()
    });
    line.collect()
}

/// Whether closed lines cross each other or themselves, each piece compared with each other one.
fn crosses(lines: &[Vec<[f64; 2]>]) -> bool {
    let piece = |line: &Vec<[f64; 2]>, k: usize| (line[k], line[(k + 1) % line.len()]);
    let pieces: Vec<([f64; 2], [f64; 2])> = (lines.iter())
        .flat_map(|line| (0..line.len()).map(move |k| piece(line, k)))
        .collect();
    let side = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    let apart =
        |(a, b), (c, d)| side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
    (0..pieces.len()).any(|i| (0..i).any(|k| apart(pieces[i], pieces[k])))
}

/// Area that closed lines enclose, holes being clockwise.
fn enclosed(lines: &[Vec<[f64; 2]>]) -> f64 {
    let area = |line: &Vec<[f64; 2]>| -> f64 {
        let n = line.len();
        let term = |k: usize| line[k][0] * line[(k + 1) % n][1] - line[(k + 1) % n][0] * line[k][1];
        0.5 * (0..n).map(term).sum::<f64>()
    };
    lines.iter().map(area).sum()
}

/// What every pattern is to be: all of the surface, on sheets that are simple and hardly strained.
fn check(name: &str, surface: &Heightfield, limit: f64) -> Vec<Sheet> {
    let patches = Patches::new(surface, &PatchOptions::default()).unwrap();
    let options = PatternOptions::default().max_strain(limit);
    let found = pattern(surface, &patches, &options).unwrap();
    let total: f64 = patches.patches().iter().map(|patch| patch.area).sum();
    let mut sum = 0.0;
    for sheet in &found.sheets {
        assert!(sheet.strain <= limit, "{name}: {}", sheet.strain);
        assert!(!crosses(&lines(sheet)), "{name}: an outline crosses itself");
        let area = enclosed(&lines(sheet));
        // Half a cell around it is not the same, for the line is smooth.
        near(
            area / sheet.area,
            1.0,
            0.03 + 0.1 * f64::from(sheet.area < 0.02 * total),
        );
        sum += area;
    }
    near(sum / total, 1.0, 0.03);
    let mut all: Vec<u32> = found
        .sheets
        .iter()
        .flat_map(|s| s.patches.clone())
        .collect();
    all.sort_unstable();
    let count = found.patches.len() as u32;
    assert_eq!(
        all,
        (0..count).collect::<Vec<_>>(),
        "{name}: each part once"
    );
    found.sheets
}

#[test]
fn a_cone_is_slit_and_becomes_a_sector() {
    // Of slope 1, cut off at radius 0.45.
    let cone = crate::native::common::cut(
        &unit_square(100, |x, y| -(x - 0.503).hypot(y - 0.502)),
        |x, y| (x - 0.503).hypot(y - 0.502) < 0.45,
    );
    let sheets = check("cone", &cone, 0.01);
    assert_eq!(sheets.len(), 1);
    let slits: Vec<&Run> = sheets[0].outlines[0]
        .iter()
        .filter(|r| r.seam.is_some())
        .collect();
    assert_eq!(slits.len(), 2, "one slit has two sides");
    let slant = 0.45 * 2f64.sqrt();
    for slit in &slits {
        assert!(slit.seam.unwrap().slit);
        near(length(&slit.points), slant, 0.03 * slant);
    }
    // A sector of 2π/√2, but for half a cell along the arc.
    near(
        enclosed(&lines(&sheets[0])),
        std::f64::consts::PI * 0.445 * 0.445 * 2f64.sqrt(),
        0.01,
    );
}

#[test]
fn domes_saddles_and_waves_are_cut_until_they_lie_flat() {
    let dome = unit_square(60, |x, y| -0.5 * ((x - 0.5).powi(2) + (y - 0.5).powi(2)));
    let saddle = unit_square(60, |x, y| 0.6 * ((x - 0.5).powi(2) - (y - 0.5).powi(2)));
    let waves = unit_square(60, |x, y| 0.05 * (9.0 * x).sin() * (8.0 * y).cos());
    for (name, surface) in [("dome", dome), ("saddle", saddle), ("waves", waves)] {
        for limit in [0.01, 0.003] {
            let sheets = check(name, &surface, limit);
            assert!(
                sheets.iter().all(|sheet| sheet.folds.is_empty()),
                "no crease is there"
            );
            assert!(sheets.len() < 30, "{name}: {} sheets", sheets.len());
        }
    }
}

#[test]
fn what_no_cut_makes_flat_is_refused_with_its_place() {
    // Rough from vertex to vertex.
    let mut noise = crate::native::common::Random::new(5);
    let rough = unit_square(16, |_, _| 0.0);
    let heights = rough
        .heights()
        .iter()
        .map(|_| 0.2 * noise.sample())
        .collect();
    let rough = Heightfield::new(*rough.lattice(), heights).unwrap();
    let patches = Patches::new(&rough, &PatchOptions::default()).unwrap();
    let error = pattern(&rough, &patches, &PatternOptions::default()).unwrap_err();
    assert_eq!(error.code(), "NOT_FLAT", "{error}");
    assert!(error.to_string().contains("limit of 1 %"), "{error}");
    // Flat faces can be: they stand for it, unless that is not wanted.
    let surface = Shape::Heights(&rough);
    let found = lay_flat(surface, &FlatOptions::default()).unwrap();
    let faces = found.simplified.expect("flat faces").faces;
    assert!((1..=MAX_FEW_FACES).contains(&faces), "{faces}");
    assert!(found.sheets.iter().all(|sheet| sheet.exact));
    let none = FlatOptions {
        faces: Some(0),
        ..FlatOptions::default()
    };
    assert_eq!(lay_flat(surface, &none).unwrap_err(), error);
    let few = FlatOptions {
        faces: Some(20),
        ..FlatOptions::default()
    };
    let fewer = lay_flat(surface, &few).unwrap().simplified.unwrap();
    assert!(fewer.faces <= 20, "{fewer:?}");
    assert!(fewer.distance > 0.0 && fewer.distance < 0.2, "{fewer:?}");
    // A person decides about edges of flat faces alone.
    let decided = FlatOptions {
        net: NetOptions {
            cut: vec![[0, 1]],
            ..NetOptions::default()
        },
        ..FlatOptions::default()
    };
    let error = lay_flat(surface, &decided).unwrap_err();
    assert_eq!(error.code(), "OPTION", "{error}");
}

/// What is cut, as pairs of the lengths on both sides, by the crease.
fn sides(sheets: &[Sheet]) -> std::collections::BTreeMap<usize, (bool, [f64; 2])> {
    let mut sides = std::collections::BTreeMap::new();
    for run in sheets.iter().flat_map(|s| s.outlines.iter().flatten()) {
        if let (Some(seam), Some(patch)) = (run.seam, run.patch) {
            let entry = sides.entry(seam.crease).or_insert((seam.slit, [0.0; 2]));
            entry.1[usize::from(patch == seam.patches[1])] += length(&run.points);
        }
    }
    sides
}

/// A sphere's cap has an excess of angle everywhere; the border of this one is nearly upright and in
/// rags.
#[test]
fn a_steep_ragged_border_gives_way_and_that_is_told() {
    let mut noise = crate::native::common::Random::new(3);
    let ball = unit_square(70, |x, y| {
        let r = (x - 0.5).hypot(y - 0.5);
        (0.25 - r * r).max(0.0).sqrt()
    });
    let heights: Vec<f64> = (0..ball.lattice().len())
        .map(|i| {
            let lattice = ball.lattice();
            let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
            let r = (x - 0.5).hypot(y - 0.5);
            let ragged = r > 0.45 && noise.sample() > 0.8;
            match r > 0.485 || ragged {
                true => f64::NAN,
                false => ball.heights()[i],
            }
        })
        .collect();
    let ball = Heightfield::new(*ball.lattice(), heights).unwrap();
    let patches = Patches::new(&ball, &PatchOptions::default()).unwrap();
    let found = pattern(&ball, &patches, &PatternOptions::default()).unwrap();
    let valid = ball.heights().iter().filter(|z| !z.is_nan()).count();
    let whole: f64 = patches.patches().iter().map(|patch| patch.area).sum();
    let laid: f64 = found.sheets.iter().map(|sheet| sheet.area).sum();
    near((laid + found.missing.area) / whole, 1.0, 0.03);
    assert!(50 * found.missing.vertices <= valid, "{:?}", found.missing);
    assert_eq!(found.missing.vertices > 0, found.missing.area > 0.0);
    for sheet in &found.sheets {
        assert!(sheet.strain <= 0.01, "{}", sheet.strain);
        assert!(!crosses(&lines(sheet)));
    }
}

/// A pattern of a surface that bends along x only, whose border is drawn down at a vertex that is not on the
/// lattice of twice the spacing, where it is cut. The developed sheet is as long as the curve, `arc`, and as wide.
fn torn(height: impl Fn(f64) -> f64, arc: impl Fn(f64) -> f64) -> Pattern {
    let spacing = 1.0 / 159.0;
    let lattice = Lattice::new(160, 160, spacing).unwrap();
    let [left, bottom] = lattice.position(0, 81);
    let surface = Heightfield::from_fn(lattice, |x, y| {
        let away = (x - left).hypot(y - bottom) / spacing;
        height(x) - 12.0 * spacing * (1.0 - away).max(0.0)
    })
    .unwrap();
    let patches = Patches::new(&surface, &PatchOptions::default()).unwrap();
    let options = PatternOptions::default().max_strain(0.003);
    let found = pattern(&surface, &patches, &options).unwrap();
    let [sheet] = &found.sheets[..] else {
        panic!("{} sheets", found.sheets.len());
    };
    assert_eq!((sheet.outlines.len(), found.missing.steps), (1, 0));
    assert!(
        (1..=16).contains(&found.missing.vertices),
        "{:?}",
        found.missing
    );
    assert!(sheet.strain < 1e-4, "{}", sheet.strain);
    let [low, high] = [[0, 0], [0, 159]].map(|[row, col]| lattice.position(row, col)[0]);
    let exact = (arc(high) - arc(low)) * 159.0 * 0.75f64.sqrt() * spacing;
    near(enclosed(&lines(sheet)) / exact, 1.0, 0.002);
    found
}

#[test]
fn a_torn_point_of_a_border_is_left_out_rather_than_cut() {
    let radius = 1.5f64.sqrt();
    let cylinder = |x: f64| (1.5 - (x - 0.5).powi(2)).sqrt();
    let found = torn(cylinder, |x| radius * ((x - 0.5) / radius).asin());
    assert_eq!(found.sheets[0].patches, [0]);
}

/// Of a folded card.
#[test]
fn a_torn_point_does_not_open_a_fold() {
    let found = torn(|x| -0.5 * (x - 0.38).abs(), |x| x * 1.25f64.sqrt());
    let sheet = &found.sheets[0];
    assert_eq!((&sheet.patches[..], sheet.folds.len()), (&[0, 1][..], 1));
    assert!(sheet.outlines[0].iter().all(|run| run.seam.is_none()));
}

#[test]
fn walls_of_steps_are_told() {
    // A block on a plane: its walls are on no sheet.
    let block = unit_square(80, |x, y| {
        f64::from((x - 0.5).abs().max((y - 0.5).abs()) < 0.2) * 0.3
    });
    let patches = Patches::new(&block, &PatchOptions::default()).unwrap();
    let found = pattern(&block, &patches, &PatternOptions::default()).unwrap();
    assert!(found.missing.steps > 0, "{:?}", found.missing);
    near(found.missing.step_area, 1.6 * 0.3, 0.1);
}

#[test]
fn sheets_fold_back_to_the_surface() {
    let cylinder = unit_square(60, |x, _| (0.5 - (x - 0.5f64).powi(2)).sqrt());
    let card = unit_square(60, |x, _| -0.7 * (x - 0.503).abs());
    let cone = crate::native::common::cut(
        &unit_square(60, |x, y| -0.8 * (x - 0.503).hypot(y - 0.502)),
        |x, y| (x - 0.503).hypot(y - 0.502) < 0.45,
    );
    // Not developable: sheets are strained, and cannot be bent to it exactly.
    let dome = unit_square(60, |x, y| -0.5 * ((x - 0.5).powi(2) + (y - 0.5).powi(2)));
    for (name, surface, most) in [
        ("cylinder", &cylinder, 2e-4),
        ("card", &card, 2e-4),
        ("cone", &cone, 0.005),
        ("dome", &dome, 0.02),
    ] {
        let patches = Patches::new(surface, &PatchOptions::default()).unwrap();
        let options = PatternOptions::default();
        let found = pattern(surface, &patches, &options.refold(true)).unwrap();
        for sheet in &found.sheets {
            let refolding = sheet.refolding.unwrap();
            assert!(refolding.rms <= most, "{name}: {refolding:?}");
            assert!(refolding.rms <= refolding.maximum, "{name}: {refolding:?}");
            assert!(refolding.strain < 2e-3, "{name}: {refolding:?}");
        }
        let strained = found.sheets.iter().any(|sheet| sheet.strain > 0.002);
        let away = found
            .sheets
            .iter()
            .any(|s| s.refolding.unwrap().maximum > 1e-4);
        assert!(!strained || away, "{name}: strain, and nothing of it shows");
        let plain = pattern(surface, &patches, &options).unwrap();
        assert!(plain.sheets.iter().all(|sheet| sheet.refolding.is_none()));
    }
}

/// Surfaces that have to be cut, although they are smooth: sheets are strained to the limit, and sides of slits
/// differ by several percent before they are drawn.
#[test]
fn both_sides_of_a_cut_are_drawn_equally_long() {
    let waves = unit_square(100, |x, y| 0.08 * (7.0 * x).sin() * (6.0 * y).cos());
    let bumps = unit_square(100, |x, y| 0.02 * (21.0 * x).sin() * (19.0 * y).cos());
    let cone = crate::native::common::cut(
        &unit_square(120, |x, y| -(x - 0.503).hypot(y - 0.502)),
        |x, y| (x - 0.503).hypot(y - 0.502) < 0.45,
    );
    for (name, surface, slits) in [("waves", waves, 4), ("bumps", bumps, 20), ("cone", cone, 1)] {
        let sheets = sheets(&surface);
        let drawing = Drawing::new(&sheets, &DrawingOptions::default().scale(1e3)).unwrap();
        println!("{name}: {:?}", drawing.summary);
        assert!(drawing.summary.slits >= slits, "{name}");
        assert!(drawing.summary.mismatch <= 0.01, "{name}");
        // Not by lines that go astray: outlines are as long as before, and simple.
        let long: f64 = sides(&sheets).values().map(|(_, [a, b])| a + b).sum();
        let drawn = 2e-3 * (drawing.summary.seam_length + drawing.summary.slit_length);
        near(drawn / long, 1.0, 0.02);
        for sheet in &drawing.sheets {
            assert!(!crosses(&sheet.cuts), "{name}");
        }
    }
}

/// Where a surface has many vertices it is cut on fewer of them.
#[test]
fn a_fine_surface_is_cut_like_a_coarse_one() {
    let cuts = |cols: usize| {
        let dome = unit_square(cols, |x, y| -0.5 * ((x - 0.5).powi(2) + (y - 0.5).powi(2)));
        let sheets = check("dome", &dome, 0.01);
        let long: f64 = sides(&sheets)
            .values()
            .map(|(_, [a, b])| 0.5 * (a + b))
            .sum();
        (sheets.len(), long)
    };
    let (few, many) = (cuts(80), cuts(160));
    assert_eq!(few.0, many.0);
    near(few.1 / many.1, 1.0, 0.3);
}

/// Sheets of a roof from noise: several of several patches, with junctions and ends on the border. Without
/// evening its joints differ by more than one percent.
#[test]
fn joints_of_a_noisy_roof_are_drawn_equally_long() {
    let options = ExampleOptions {
        size: 80,
        noise: 0.01,
        ..ExampleOptions::default()
    };
    let input = Example::Roof.generate(&options).unwrap().input;
    let field = input.to_lattice(None).unwrap();
    let solved = fit(&field, &Options::paper()).unwrap();
    let sheets = sheets(solved.heightfield());
    let area: f64 = sheets.iter().map(|sheet| sheet.area).sum();
    let joints = sides(&sheets);
    let long = (joints.values()).filter(|(_, [a, b])| a.min(*b) > 0.1 * area.sqrt());
    assert!(long.count() >= 4, "{joints:?}");
    let drawing = Drawing::new(&sheets, &DrawingOptions::default()).unwrap();
    assert!(drawing.summary.mismatch <= 0.005, "{:?}", drawing.summary);
    let worst = drawing.summary.worst_joint.unwrap();
    let [a, b] = worst.lengths;
    near(drawing.summary.mismatch, (a - b).abs() / a.max(b), 1e-12);
    assert!(joints.contains_key(&worst.crease));
}

/// The outlines of sheets as they are cut, in the surface's units.
fn drawn(sheets: &[Sheet]) -> Vec<Vec<[f64; 2]>> {
    let drawing = Drawing::new(sheets, &DrawingOptions::default().scale(1e3)).unwrap();
    let cut = |points: &Vec<[f64; 2]>| points.iter().map(|p| p.map(|x| 1e-3 * x)).collect();
    (drawing.sheets.iter())
        .map(|sheet| cut(&sheet.cuts[0]))
        .collect()
}

/// Distances of a closed line from another one that it is laid upon, the largest one.
fn off(outline: &[[f64; 2]], exact: &[[f64; 2]]) -> f64 {
    let next = outline.iter().cycle().skip(1);
    let mut here: Vec<[f64; 2]> = (outline.iter().zip(next))
        .flat_map(|(from, to)| {
            let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / 0.01).ceil();
            (0..steps as usize).map(move |k| {
                let t = k as f64 / steps;
                [0, 1].map(|i| from[i] + t * (to[i] - from[i]))
            })
        })
        .collect();
    let mean = |points: &[[f64; 2]]| {
        [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64)
    };
    let mut most = f64::INFINITY;
    // Nearest points, and the motion that brings them nearest, in turn.
    for _ in 0..150 {
        let squared = |p: &[f64; 2], q: &[f64; 2]| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
        let nearest = |p: &[f64; 2]| {
            let by = exact
                .iter()
                .min_by(|a, b| squared(a, p).total_cmp(&squared(b, p)));
            *by.unwrap()
        };
        let there: Vec<[f64; 2]> = here.iter().map(nearest).collect();
        let farthest = (here.iter().zip(&there)).fold(0.0, |most, (p, q)| squared(p, q).max(most));
        most = farthest.sqrt();
        let (from, to) = (mean(&here), mean(&there));
        let (mut cos, mut sin) = (0.0, 0.0);
        for (p, q) in here.iter().zip(&there) {
            let [x, y] = [p[0] - from[0], p[1] - from[1]];
            let [u, v] = [q[0] - to[0], q[1] - to[1]];
            cos += x * u + y * v;
            sin += x * v - y * u;
        }
        let size = cos.hypot(sin);
        for p in &mut here {
            let [x, y] = [p[0] - from[0], p[1] - from[1]];
            *p = [
                (cos * x - sin * y) / size + to[0],
                (sin * x + cos * y) / size + to[1],
            ];
        }
    }
    most
}

/// A cylinder, and a frustum whose four cuts are all slanting: planes that are not perpendicular to its axis.
#[test]
fn known_developments_have_their_outlines_once_they_were_solved_from_noise() {
    type Shape = (&'static str, fn(f64, f64) -> f64, fn(f64, f64) -> [f64; 2]);
    let shapes: [Shape; 2] = [
        (
            "cylinder",
            |x, _| (0.49 - (x - 0.5).powi(2)).sqrt(),
            |x, y| [0.7 * ((x - 0.5) / 0.7).asin(), y],
        ),
        (
            "frustum",
            |x, y| -0.8 * (x - 0.5).hypot(y + 0.4),
            |x, y| {
                let steep = 1.64f64.sqrt();
                let far = (x - 0.5).hypot(y + 0.4) * steep;
                // Upright, as sheets are.
                let (sin, cos) = ((x - 0.5).atan2(y + 0.4) / steep).sin_cos();
                [far * sin, far * cos]
            },
        ),
    ];
    for (name, height, flat) in shapes {
        let truth = unit_square(100, height);
        let heights = || truth.heights().iter().copied();
        let range = heights().fold(f64::MIN, f64::max) - heights().fold(f64::MAX, f64::min);
        let input = crate::native::common::noisy(&truth, 0.01 * range * 3f64.sqrt(), 5);
        let options = Options::default();
        let solved = fit(&input, &options).unwrap();
        let sheets = sheets(solved.heightfield());
        assert_eq!(sheets.len(), 1, "{name}");
        let [[left, bottom], [right, top]] = covered(truth.lattice());
        let corners = [[left, bottom], [right, bottom], [right, top], [left, top]];
        let exact: Vec<[f64; 2]> = (0..4)
            .flat_map(|k| {
                let (p, q) = (corners[k], corners[(k + 1) % 4]);
                (0..500).map(move |i| {
                    let t = f64::from(i) / 500.0;
                    flat(p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]))
                })
            })
            .collect();
        let error = off(&drawn(&sheets)[0], &exact) / size(&exact);
        println!("{name}: {:.3} %", 100.0 * error);
        assert!(error < 0.004, "{name}: {error}");
    }
}

/// The longer side of the box around a line.
fn size(line: &[[f64; 2]]) -> f64 {
    let extent = |k: usize| {
        let values = || line.iter().map(|p| p[k]);
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    };
    extent(0).max(extent(1))
}

/// Two surfaces with a curved crease: a cylinder whose upper part is mirrored in a slanting plane, which stays one
/// sheet, and a cylinder above which a cone rises, which becomes two.
#[test]
fn curved_creases_have_their_developments() {
    let arc = |x: f64| 0.7 * ((x - 0.5) / 0.7).asin();
    let round = |x: f64| (0.49 - (x - 0.5).powi(2)).sqrt();
    let line = |ends: [[f64; 2]; 2]| {
        (0..500).map(move |i| {
            let t = f64::from(i) / 500.0;
            [0, 1].map(|k| ends[0][k] + t * (ends[1][k] - ends[0][k]))
        })
    };
    // Mirrored in y = 0.5 + 2 (z - z₀), rulings rise by 4/3.
    let crease = |x: f64| 0.5 + 2.0 * (round(x) - round(0.25));
    let folded = unit_square(100, |x, y| {
        round(x) + (4.0 / 3.0) * (y - crease(x)).max(0.0)
    });
    let [[left, bottom], [right, top]] = covered(folded.lattice());
    let corners = [[left, bottom], [right, bottom], [right, top], [left, top]];
    let exact: Vec<[f64; 2]> = (0..4)
        .flat_map(|k| line([corners[k], corners[(k + 1) % 4]]))
        .map(|[x, y]| [arc(x), y + (2.0 / 3.0) * (y - crease(x)).max(0.0)])
        .collect();
    let found = sheets(&folded);
    assert_eq!((found.len(), found[0].folds.len()), (1, 1));
    let error = off(&drawn(&found)[0], &exact) / size(&exact);
    println!("curved fold: {:.3} %", 100.0 * error);
    // A spacing where the crease ends at the border; a third of that elsewhere.
    assert!(error < 0.007, "{error}");

    // The cone's point is below the square; where both are equally high, y is known for each x.
    let cone = |x: f64, y: f64| 1.32 - 0.8 * (x - 0.5).hypot(y + 0.4);
    let crease = |x: f64| (((1.32 - round(x)) / 0.8).powi(2) - (x - 0.5).powi(2)).sqrt() - 0.4;
    let both = unit_square(100, |x, y| round(x).max(cone(x, y)));
    let unrolled = |[x, y]: [f64; 2]| {
        let steep = 1.64f64.sqrt();
        let (sin, cos) = ((x - 0.5).atan2(y + 0.4) / steep).sin_cos();
        let far = (x - 0.5).hypot(y + 0.4) * steep;
        [far * sin, far * cos]
    };
    let curve: Vec<[f64; 2]> = line([[left, 0.0], [right, 0.0]])
        .map(|[x, _]| [x, crease(x)])
        .collect();
    let around = |y: f64| {
        let ends = [left, right].map(|x| [x, crease(x)]);
        let sides = line([ends[0], [left, y]]).chain(line([[left, y], [right, y]]));
        let sides = sides.chain(line([[right, y], ends[1]]));
        sides.chain(curve.iter().copied()).collect::<Vec<_>>()
    };
    let below: Vec<[f64; 2]> = around(bottom).into_iter().map(unrolled).collect();
    let above: Vec<[f64; 2]> = (around(top).into_iter())
        .map(|[x, y]| [arc(x), y])
        .collect();
    let found = sheets(&both);
    assert_eq!(found.len(), 2);
    let mut errors: Vec<[f64; 2]> = (drawn(&found).iter())
        .map(|outline| [&below, &above].map(|exact| off(outline, exact) / size(exact)))
        .collect();
    errors.sort_by(|a, b| a[0].total_cmp(&b[0]));
    println!("cone and cylinder: {errors:?}");
    assert!(errors[0][0] < 0.003 && errors[1][1] < 0.003, "{errors:?}");
}

/// The lower left and the upper right corner of what a lattice's whole triangles cover. Every second row is shifted by
/// half a spacing: its border is halfway.
fn covered(lattice: &Lattice) -> [[f64; 2]; 2] {
    let [left, top] = lattice.position(0, 0);
    let [right, bottom] = lattice.position(lattice.rows() - 1, lattice.cols() - 1);
    let shift = f64::from(u8::from(lattice.rows().is_multiple_of(2))) * 0.5;
    let quarter = 0.25 * lattice.spacing();
    [
        [left - quarter, bottom],
        [right + shift * lattice.spacing() - quarter, top],
    ]
}

/// A height over a plane that is linear between rays from a point: by how far each rises along its direction.
fn fan(rays: &[(f64, f64)], [x, y]: [f64; 2]) -> f64 {
    let at = y.atan2(x).rem_euclid(std::f64::consts::TAU);
    let k = rays.partition_point(|(turn, _)| *turn <= at);
    let (a, b) = (
        rays[(k + rays.len() - 1) % rays.len()],
        rays[k % rays.len()],
    );
    // Shares of both directions.
    let cross = (b.0 - a.0).sin();
    let far = x.hypot(y);
    far * (a.1 * (b.0 - at).sin() + b.1 * (at - a.0).sin()) / cross
}

/// The sum of the angles between such rays.
fn around(rays: &[(f64, f64)]) -> f64 {
    let ray = |(turn, rise): (f64, f64)| {
        let long = rise.hypot(1.0);
        [turn.cos() / long, turn.sin() / long, rise / long]
    };
    let next = rays.iter().cycle().skip(1);
    let angles = rays.iter().zip(next).map(|(a, b)| {
        let (a, b) = (ray(*a), ray(*b));
        (0..3).map(|k| a[k] * b[k]).sum::<f64>().acos()
    });
    angles.sum::<f64>().to_degrees()
}

/// Angles of pieces around a point, against sums that are known.
#[test]
fn angles_at_points_close_up() {
    let third = std::f64::consts::TAU / 3.0;
    // The corner of a cube on its tip; the edges of a cube rise by 1/√2 there.
    let cube: Vec<(f64, f64)> = (0..3)
        .map(|k| (0.3 + third * f64::from(k), -(0.5f64.sqrt())))
        .collect();
    near(around(&cube), 270.0, 1e-9);
    let quarter = std::f64::consts::FRAC_PI_2;
    // A pyramid's edges.
    let pyramid: Vec<(f64, f64)> = (0..4)
        .map(|k| (quarter * (f64::from(k) + 0.5), -0.8 * 0.5f64.sqrt()))
        .collect();
    near(
        around(&pyramid),
        8.0 * (1.0 / 1.64f64.sqrt()).atan().to_degrees(),
        1e-9,
    );
    // More than a full turn.
    let saddle = vec![(0.05, -0.2), (1.9, 0.5), (3.4, -0.9), (4.9, 0.5)];
    assert!(around(&saddle) > 370.0);
    for (name, rays) in [("cube", cube), ("pyramid", pyramid), ("saddle", saddle)] {
        let surface = unit_square(120, |x, y| fan(&rays, [x - 0.503, y - 0.498]));
        let sheets = sheets(&surface);
        let drawing = Drawing::new(&sheets, &DrawingOptions::default()).unwrap();
        let worst = drawing.summary.worst_angle.unwrap();
        println!("{name}: {worst:?}");
        assert_eq!(drawing.summary.points, 1, "{name}");
        near(worst.surface, around(&rays), 1.0);
        near(worst.flat, around(&rays), 1.0);
        near(worst.place[0], 0.503, 0.02);
        near(worst.place[1], 0.498, 0.02);
        assert_eq!(worst.crease.is_none(), name == "folded", "{name}");
    }
    // A cone is slit as far as its point.
    let cone = crate::native::common::cut(
        &unit_square(120, |x, y| -(x - 0.503).hypot(y - 0.502)),
        |x, y| (x - 0.503).hypot(y - 0.502) < 0.45,
    );
    let sheets = sheets(&cone);
    let drawing = Drawing::new(&sheets, &DrawingOptions::default()).unwrap();
    let worst = drawing.summary.worst_angle.unwrap();
    println!("cone: {worst:?}");
    near(worst.surface, 360.0 / 2f64.sqrt(), 2.0);
    near(worst.flat, 360.0 / 2f64.sqrt(), 3.0);
}

/// A cut through a patch that was decided on every fourth vertex turns no more than a line that one would draw.
#[test]
fn cuts_that_were_decided_on_a_coarse_lattice_are_not_serrated() {
    let options = ExampleOptions {
        size: 300,
        noise: 0.0,
        ..ExampleOptions::default()
    };
    let roof = Example::Roof.generate(&options).unwrap().input;
    let roof = roof.to_lattice(None).unwrap();
    let patches = Patches::new(&roof, &PatchOptions::default()).unwrap();
    let found = pattern(&roof, &patches, &PatternOptions::default()).unwrap();
    let cuts = (found.sheets.iter().flat_map(|sheet| &sheet.outlines))
        .flatten()
        .filter(|run| run.seam.is_some_and(|seam| seam.slit));
    let mut sides = 0;
    for cut in cuts {
        let steps: Vec<[f64; 2]> = (cut.points.windows(2))
            .map(|ends| [0, 1].map(|k| ends[1][k] - ends[0][k]))
            .collect();
        let turns = steps.windows(2).map(|pair| {
            let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
            (ax * by - ay * bx).atan2(ax * bx + ay * by).abs()
        });
        let turned: f64 = turns.sum();
        assert!(turned < 2.0, "{turned} radians");
        sides += 1;
    }
    assert!(sides >= 2);
}
