//! Patterns drawn in millimetres, and written to files. (What other programs measure in these is in
//! `tests/js/patterns.test.mjs`.)

use std::collections::BTreeMap;

use crate::closed_meshes::cube;
use crate::native::common::{noisy, unit_square};
use developable::drawing::{Bending, Drawing, DrawingOptions, DrawnSheet, LabelKind, Piece, Stock};
use developable::files::assembly::write_assembly_svg;
use developable::files::drawings::{PdfOptions, write_dxf, write_pdf, write_svg};
use developable::patches::{PatchOptions, Patches};
use developable::pattern::{NetOptions, PatternOptions, Sheet, pattern, pattern_exact};
use developable::{Heightfield, Options, fit};

fn sheets(surface: &Heightfield) -> Vec<Sheet> {
    let patches = Patches::new(surface, &PatchOptions::default()).unwrap();
    let found = pattern(surface, &patches, &PatternOptions::default());
    found.unwrap().sheets
}

/// Vaults that meet in curves: three sheets.
fn vaults() -> Vec<Sheet> {
    let arc = |v: f64| (0.49 - (v - 0.5).powi(2)).sqrt();
    sheets(&unit_square(80, move |x, y| (arc(x) - 0.05).max(arc(y))))
}

/// Four faces, cut along one of its edges.
fn pyramid() -> Vec<Sheet> {
    sheets(&unit_square(80, |x, y| {
        -0.8 * (x - 0.503).abs().max((y - 0.502).abs())
    }))
}

fn drawn(sheets: &[Sheet], options: DrawingOptions) -> Drawing {
    Drawing::new(sheets, &options).unwrap()
}

/// Whether a place is within closed lines: a ray from it crosses them an odd number of times.
fn inside([x, y]: [f64; 2], cuts: &[Vec<[f64; 2]>]) -> bool {
    let crossed = cuts.iter().flat_map(|cut| {
        (0..cut.len()).filter(move |i| {
            let ([ax, ay], [bx, by]) = (cut[*i], cut[(i + 1) % cut.len()]);
            (ay > y) != (by > y) && x < ax + (bx - ax) * (y - ay) / (by - ay)
        })
    });
    crossed.count() % 2 == 1
}

/// Area that closed lines enclose: holes are clockwise.
fn area(cuts: &[Vec<[f64; 2]>]) -> f64 {
    let ring = |cut: &Vec<[f64; 2]>| -> f64 {
        let pairs = (0..cut.len()).map(|i| (cut[i], cut[(i + 1) % cut.len()]));
        pairs
            .map(|([ax, ay], [bx, by])| 0.5 * (ax * by - ay * bx))
            .sum()
    };
    cuts.iter().map(ring).sum()
}

fn area_of(sheet: &DrawnSheet) -> f64 {
    area(&sheet.cuts)
}

#[test]
fn sheets_keep_their_size_and_lie_apart() {
    for sheets in [vaults(), pyramid()] {
        let drawing = drawn(&sheets, DrawingOptions::default().scale(150.0));
        for (i, sheet) in drawing.sheets.iter().enumerate() {
            let [min, max] = sheet.bounds;
            for k in 0..2 {
                let side = [drawing.width, drawing.height][k];
                assert!(
                    min[k] >= 9.99 && max[k] <= side - 9.99,
                    "{:?}",
                    sheet.bounds
                );
            }
            for other in &drawing.sheets[..i] {
                let [low, high] = other.bounds;
                let apart = |k: usize| (min[k] - high[k]).max(low[k] - max[k]);
                assert!(apart(0).max(apart(1)) >= 9.99);
            }
            // Lines that are not cut lie within, patches' numbers as well.
            for label in sheet.labels.iter().filter(|l| l.kind != LabelKind::Sheet) {
                assert!(inside(label.place, &sheet.cuts), "{label:?}");
            }
        }
        // The outline loses less than half a cell around the lattice's whole triangles.
        let found: f64 = drawing.sheets.iter().map(|sheet| area(&sheet.cuts)).sum();
        assert!(
            (found / drawing.summary.area - 1.0).abs() < 0.02,
            "{found} {:?}",
            drawing.summary
        );
    }
}

#[test]
fn lines_of_a_noisy_surface_are_straight_or_smooth() {
    // A barrel vault through a lower one, measured with noise, and cut at its border by a circle: the lattice's
    // border is a staircase.
    let arc = |v: f64| (0.49 - (v - 0.5).powi(2)).sqrt();
    let vault = noisy(
        &unit_square(80, move |x, y| (arc(x) - 0.05).max(arc(y))),
        2e-4,
        7,
    );
    let lattice = *vault.lattice();
    let heights = (0..lattice.rows() * lattice.cols()).map(|i| {
        let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
        let out = (x - 0.5).hypot(y - 0.5) > 0.45;
        if out { f64::NAN } else { vault.heights()[i] }
    });
    let round = Heightfield::new(lattice, heights.collect()).unwrap();
    let scan = fit(&round, &Options::paper()).unwrap();
    let found = sheets(scan.heightfield());
    let scale = 200.0;
    let cell = scale / 80.0;
    let drawing = drawn(&found, DrawingOptions::default().scale(scale));
    let pieces = |drawing: &Drawing| -> usize {
        let curves = drawing.sheets.iter().flat_map(|sheet| &sheet.curves);
        curves.map(|curve| curve.pieces().count()).sum()
    };
    let runs = |sheet: &Sheet| -> Vec<Vec<[f64; 2]>> {
        let runs = sheet.outlines.iter().flatten();
        runs.map(|run| run.points.clone()).collect()
    };
    let given = found.iter().flat_map(runs).map(|line| line.len() - 1);
    let given: usize = given.sum();
    assert!(3 * pieces(&drawing) < given, "{} {given}", pieces(&drawing));
    let bends = drawing
        .sheets
        .iter()
        .flat_map(|s| s.curves.iter().flat_map(|c| c.pieces()));
    assert!(bends.filter(|p| matches!(p, Piece::Bezier(_))).count() > 3);
    for (before, after) in found.iter().zip(&drawing.sheets) {
        assert!((scale * scale * before.area / area_of(after) - 1.0).abs() < 0.01);
        let lines = runs(before);
        let given = lines.iter().flat_map(|line| {
            let lengths = line
                .windows(2)
                .map(|p| (p[0][0] - p[1][0]).hypot(p[0][1] - p[1][1]));
            lengths.collect::<Vec<f64>>()
        });
        let given = scale * given.sum::<f64>();
        let around: f64 = after.cuts.iter().map(|cut| perimeter(cut)).sum();
        assert!((around / given - 1.0).abs() < 2e-3, "{around} {given}");
        let [low, high] = after.bounds;
        assert!((high[0] - low[0]).max(high[1] - low[1]) < scale * 1.3 + cell);
    }
    // Both sides of each seam keep their length.
    assert!(drawing.summary.mismatch < 0.005, "{:?}", drawing.summary);
}

#[test]
fn the_border_of_a_tilted_rectangle_is_four_straight_lines() {
    let (slope_x, slope_y) = (0.3, 0.2);
    let plane = unit_square(60, |x, y| slope_x * x + slope_y * y);
    for noise in [0.0, 2e-3] {
        let scan = fit(noisy(&plane, noise, 5), &Options::default()).unwrap();
        let drawing = drawn(
            &sheets(scan.heightfield()),
            DrawingOptions::default().scale(200.0),
        );
        let [sheet] = &drawing.sheets[..] else {
            panic!("{} sheets", drawing.sheets.len());
        };
        let pieces: Vec<Piece> = sheet.curves.iter().flat_map(|c| c.pieces()).collect();
        assert_eq!(pieces.len(), 4, "{pieces:?}");
        let mut lengths: Vec<f64> = (pieces.iter())
            .map(|piece| match piece {
                Piece::Line([p, q]) => (p[0] - q[0]).hypot(p[1] - q[1]),
                Piece::Bezier(_) => f64::NAN,
            })
            .collect();
        lengths.sort_by(f64::total_cmp);
        // A unit square's sides rise by the slopes; the lattice may leave out a cell at each end.
        for (length, slope) in lengths.iter().zip([slope_y, slope_y, slope_x, slope_x]) {
            let side = 200.0 * f64::hypot(1.0, slope);
            assert!((length / side - 1.0).abs() < 2.5 / 60.0, "{lengths:?}");
        }
    }
}

fn perimeter(cut: &[[f64; 2]]) -> f64 {
    let next = cut.iter().cycle().skip(1);
    cut.iter()
        .zip(next)
        .map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1]))
        .sum()
}

#[test]
fn tabs_are_added_outside_and_touch_nothing() {
    let plain = drawn(&pyramid(), DrawingOptions::default().scale(150.0));
    let tabbed = drawn(&pyramid(), DrawingOptions::default().scale(150.0).tabs(8.0));
    assert!(tabbed.summary.tabs >= 1);
    let [before, after] = [&plain, &tabbed].map(|d| area(&d.sheets[0].cuts));
    // A trapezoid over each base, cut at 45° where that is long enough.
    let expected: f64 = (tabbed.sheets[0].tabs.iter())
        .map(|tab| 8.0 * (tab.length - f64::min(8.0, 0.3 * tab.length)))
        .sum();
    assert!(
        (after - before - expected).abs() < 0.025 * expected,
        "{} {expected}",
        after - before
    );
    let cut = &tabbed.sheets[0].cuts[0];
    let piece = |i: usize| [cut[i], cut[(i + 1) % cut.len()]];
    let side = |[p, q]: [[f64; 2]; 2], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) > 0.0
    };
    for i in 0..cut.len() {
        for k in i + 2..cut.len() {
            if i == 0 && k == cut.len() - 1 {
                continue;
            }
            let ([a, b], [c, d]) = (piece(i), piece(k));
            let cross = side([a, b], c) != side([a, b], d) && side([c, d], a) != side([c, d], b);
            assert!(!cross, "{a:?} {b:?} cross {c:?} {d:?}");
        }
    }
}

#[test]
fn a_step_has_no_tabs() {
    // A pyramid on a block on a plane: the block's walls are steps.
    let roof = sheets(&unit_square(80, |x, y| {
        let inside = (x - 0.503).abs().max((y - 0.502).abs()) < 0.3;
        f64::from(inside) * (0.8 - 0.8 * (x - 0.503).abs().max((y - 0.502).abs()))
    }));
    let tabbed = drawn(&roof, DrawingOptions::default().scale(150.0).tabs(8.0));
    // Only along the cut edge of the pyramid: the steps are more than four times as long.
    let edge = 150.0 * (2.0f64 * 0.3 * 0.3 + 0.24 * 0.24).sqrt();
    let tabs = tabbed.sheets.iter().flat_map(|sheet| &sheet.tabs);
    let long: f64 = tabs.map(|tab| tab.length).sum();
    assert!(long > 0.5 * edge && long < 1.1 * edge, "{long} {edge}");
}

#[test]
fn a_curved_edge_has_a_comb_of_short_tabs() {
    let options = DrawingOptions::default().scale(200.0);
    let (plain, tabbed) = (
        drawn(&vaults(), options),
        drawn(&vaults(), options.tabs(6.0)),
    );
    let tabs: Vec<_> = tabbed.sheets.iter().flat_map(|sheet| &sheet.tabs).collect();
    // Along all of one side of each seam, and none of them turns by much.
    let long: f64 = tabs.iter().map(|tab| tab.length).sum();
    assert!(
        long > 0.9 * plain.summary.seam_length,
        "{long} {:?}",
        plain.summary
    );
    assert!(tabs.len() > 2 * plain.summary.seams, "{}", tabs.len());
    for tab in tabs {
        let points = &tab.points;
        let heading = |i: usize| {
            let [p, q] = [points[i], points[i + 1]];
            (q[1] - p[1]).atan2(q[0] - p[0])
        };
        let turn = heading(points.len() - 2) - heading(0);
        assert!(turn.sin().abs() < 0.5, "{points:?}");
    }
    // The other side has none.
    let without = plain.sheets.iter().zip(&tabbed.sheets);
    assert!(
        without
            .filter(|(a, b)| area_of(b) > 1.001 * area_of(a))
            .count()
            < plain.sheets.len()
    );
}

#[test]
fn both_sides_of_each_cut_have_the_same_letter() {
    let drawing = drawn(&vaults(), DrawingOptions::default().scale(150.0));
    let labels = drawing.sheets.iter().flat_map(|sheet| &sheet.labels);
    let mut letters: Vec<&str> = labels
        .filter(|label| label.kind == LabelKind::Seam)
        .map(|label| &label.text[..])
        .collect();
    letters.sort_unstable();
    assert_eq!(letters.len(), 2 * drawing.summary.seams);
    assert!(
        letters.chunks(2).all(|pair| pair[0] == pair[1]),
        "{letters:?}"
    );
    assert_eq!(letters[0], "a");
}

#[test]
fn cuts_without_room_for_their_letters_are_counted() {
    let net = pattern_exact(&cube(1), &NetOptions::default()).unwrap();
    // One sheet that is slit.
    let cone = sheets(&unit_square(60, |x, y| -0.5 * (x - 0.502).hypot(y - 0.503)));
    for sheets in [&net.sheets, &cone] {
        let mut without = 0;
        for scale in [100.0, 5.0, 2.0, 1.0, 0.3] {
            let drawing = drawn(sheets, DrawingOptions::default().scale(scale));
            let labels = (drawing.sheets.iter())
                .flat_map(|sheet| sheet.labels.iter().map(move |l| (sheet, l)));
            let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
            for (sheet, label) in labels.filter(|(_, label)| label.kind == LabelKind::Seam) {
                *counts.entry(&label.text).or_default() += 1;
                let (sin, cos) = label.turn.to_radians().sin_cos();
                let wide = 0.29 * label.size * label.text.len() as f64;
                for (x, y) in [(wide, 0.5), (wide, -0.5), (-wide, 0.5), (-wide, -0.5)] {
                    let [px, py] = label.place;
                    let y = y * label.size;
                    let corner = [px + x * cos - y * sin, py + x * sin + y * cos];
                    assert!(inside(corner, &sheet.cuts), "scale {scale}: {label:?}");
                }
            }
            assert!(counts.values().all(|count| *count == 2), "{counts:?}");
            without = drawing.summary.seams + drawing.summary.slits - counts.len();
            assert_eq!(drawing.summary.unlettered, without, "scale {scale}");
            assert!(without == 0 || scale < 100.0);
        }
        assert!(without > 0);
    }
}

#[test]
fn pages_overlap_and_cover_what_is_too_large_for_one() {
    let drawing = drawn(&vaults(), DrawingOptions::default().scale(300.0));
    for (stock, size) in [(Stock::A4, [210.0, 297.0]), (Stock::Letter, [215.9, 279.4])] {
        let laid = drawing.clone().onto(stock).unwrap();
        let pages = laid.pages.as_ref().unwrap();
        let count = pages.pages.len();
        match stock {
            Stock::A4 => assert_eq!(count, drawing.summary.a4),
            _ => assert_eq!(count, drawing.summary.letter),
        }
        let mut sides = pages.paper;
        sides.sort_by(f64::total_cmp);
        assert_eq!(sides, size);
        let on = |point: &[f64; 2], corner: [f64; 2]| {
            [0, 1]
                .iter()
                .all(|k| (corner[*k]..=corner[*k] + pages.part[*k]).contains(&point[*k]))
        };
        for sheet in &laid.sheets {
            let showing = |p: &&[f64; 2]| !pages.pages.iter().any(|page| on(p, page.corner));
            let lost = sheet.cuts.iter().flatten().find(showing);
            assert_eq!(lost, None, "{}", sheet.name);
            // A sheet that fits on a page is on one.
            let [low, high] = sheet.bounds;
            let fits =
                |turn: [usize; 2]| (0..2).all(|k| high[k] - low[k] < pages.part[turn[k]] - 7.0);
            let whole = pages
                .pages
                .iter()
                .any(|p| on(&low, p.corner) && on(&high, p.corner));
            assert!(
                whole || !(fits([0, 1]) || fits([1, 0])),
                "{:?}",
                sheet.bounds
            );
        }
        // Each page that is put together with others has crosses at all four corners, and so has something of
        // all its neighbours.
        let together = pages
            .pages
            .iter()
            .filter(|page| page.name.starts_with(char::is_alphabetic));
        let mut some = 0;
        for page in together {
            let crosses = pages.marks.iter().filter(|mark| on(mark, page.corner));
            assert_eq!(crosses.count(), 4);
            some += 1;
        }
        assert!(some >= 2);
    }
}

#[test]
fn sheets_lie_whole_on_as_few_pages_as_they_fit_on() {
    // Four times the vaults' sheets: twelve of them.
    let one = vaults();
    let sheets: Vec<Sheet> = (0..4).flat_map(|_| one.clone()).collect();
    let drawing = drawn(&sheets, DrawingOptions::default().scale(120.0));
    let area = drawing.summary.area;
    for stock in [Stock::A4, Stock::Plate([400.0, 300.0]), Stock::Roll(300.0)] {
        let laid = drawing.clone().onto(stock).unwrap();
        let pages = laid.pages.as_ref().unwrap();
        let mut owners = vec![0; pages.pages.len()];
        for sheet in &laid.sheets {
            let within = |corner: [f64; 2]| {
                let points = sheet.cuts.iter().flatten();
                points.into_iter().all(|p| {
                    (0..2).all(|k| {
                        let along = p[k] - corner[k];
                        (-1e-6..=pages.part[k] + 1e-6).contains(&along)
                    })
                })
            };
            let page = pages.pages.iter().position(|page| within(page.corner));
            owners[page.expect("a page for each sheet")] += 1;
        }
        assert!(owners.iter().all(|count| *count > 0), "{owners:?}");
        // Never on each other: no corner of one is within another, nor near it.
        for (i, one) in laid.sheets.iter().enumerate() {
            for other in &laid.sheets[..i] {
                let near = one.cuts.iter().flatten().step_by(3).find(|p| {
                    inside(**p, &other.cuts)
                        || (other.cuts.iter().flatten())
                            .any(|q| (p[0] - q[0]).hypot(p[1] - q[1]) < 2.5)
                });
                assert_eq!(near, None, "{} {}", one.name, other.name);
            }
        }
        // Few enough pages: an even larger part of a roll, or of two plates, would be empty.
        let whole = owners.len() as f64 * pages.part[0] * pages.part[1];
        assert!(
            area > 0.2 * whole,
            "{stock:?}: {} pages, {}",
            owners.len(),
            area / whole
        );
        let turned = drawing.sheets.iter().zip(&laid.sheets);
        for (before, after) in turned {
            assert!((area_of(before) / area_of(after) - 1.0).abs() < 1e-6);
        }
    }
    let code = |stock| drawing.clone().onto(stock).unwrap_err().to_string();
    assert!(code(Stock::Plate([100.0, 60.0])).contains("Sheet"));
    assert!(code(Stock::Roll(-3.0)).contains("stock"));
    assert!(code(Stock::Plate([8.0, f64::NAN])).contains("stock"));
}

#[test]
fn files_are_the_same_each_time() {
    let drawing = drawn(&vaults(), DrawingOptions::default().scale(100.0).tabs(5.0));
    for write in [
        |d: &Drawing| write_svg(d, None, &[]),
        write_dxf,
        |d: &Drawing| write_pdf(d, &PdfOptions::default().stock(Some(Stock::A4))),
    ] {
        let file = write(&drawing).unwrap();
        assert!(file.len() > 1000);
        assert_eq!(file, write(&drawing).unwrap());
    }
}

#[test]
fn nonsense_is_refused() {
    let sheets = pyramid();
    let code = |sheets: &[Sheet], options| Drawing::new(sheets, &options).unwrap_err().code();
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(
            code(&sheets, DrawingOptions::default().scale(value)),
            "OPTION"
        );
        assert_eq!(
            code(&sheets, DrawingOptions::default().tabs(value)),
            "OPTION"
        );
    }
    assert_eq!(
        code(&sheets, DrawingOptions::default().scale(1e6)),
        "OPTION"
    );
    assert_eq!(code(&[], DrawingOptions::default()), "EMPTY");
    let large = drawn(&sheets, DrawingOptions::default().scale(20_000.0));
    assert_eq!(
        write_pdf(&large, &PdfOptions::default())
            .unwrap_err()
            .code(),
        "UNSUPPORTED"
    );
    assert_eq!(
        write_pdf(&large, &PdfOptions::default().stock(Some(Stock::A4)))
            .unwrap_err()
            .code(),
        "UNSUPPORTED"
    );
    let mut broken = drawn(&sheets, DrawingOptions::default());
    broken.sheets[0].cuts[0][0][1] = f64::NAN;
    assert_eq!(
        write_svg(&broken, None, &[]).unwrap_err().code(),
        "UNSUPPORTED"
    );
    assert_eq!(write_dxf(&broken).unwrap_err().code(), "UNSUPPORTED");
    // So deep that no edge is long enough for one.
    let tabs = drawn(&sheets, DrawingOptions::default().tabs(1e3));
    assert_eq!(tabs.summary.tabs, 0);
}

/// Brackets and a channel of metal: by the formulas of the trade.
#[test]
fn bends_take_the_length_of_their_neutral_line() {
    let [thickness, radius, k] = [2.0, 3.0, 0.4];
    let metal = Bending::new(thickness).radius(radius).k_factor(k);
    let bends = std::f64::consts::FRAC_PI_2;
    let allowance = bends * (radius + k * thickness);
    let plain = DrawingOptions::default().scale(100.0);
    // From the left edge to each fold and on to the right one.
    let across = |sheets: &[Sheet], options: DrawingOptions| {
        let drawing = drawn(sheets, options);
        let sheet = &drawing.sheets[0];
        let from = |x: f64| (x - sheet.bounds[0][0]).min(sheet.bounds[1][0] - x);
        let mut folds: Vec<f64> = (sheet.folds.iter())
            .map(|fold| {
                from(fold.points.iter().map(|p| p[0]).sum::<f64>() / fold.points.len() as f64)
            })
            .collect();
        folds.sort_by(f64::total_cmp);
        assert!(
            sheet
                .folds
                .iter()
                .all(|fold| (fold.angle - 90.0).abs() < 0.5)
        );
        (
            sheet.bounds[1][0] - sheet.bounds[0][0],
            folds,
            area_of(sheet),
            drawing.summary.area,
        )
    };
    let ridge = |x: f64, _: f64| -(x - 0.403).abs();
    let groove = |x: f64, _: f64| (x - 0.403).abs();
    // Two right angles: a ridge and a groove.
    let step = |x: f64, _: f64| {
        if x < 0.303 {
            x
        } else if x < 0.703 {
            0.606 - x
        } else {
            x - 0.8
        }
    };
    let outside = 2.0 * (radius + thickness);
    let inside = 2.0 * radius;
    for (name, height, longer) in [
        (
            "ridge",
            &ridge as &dyn Fn(f64, f64) -> f64,
            allowance - outside,
        ),
        ("groove", &groove, allowance - inside),
        ("step", &step, 2.0 * allowance - outside - inside),
    ] {
        let sheets = sheets(&unit_square(100, height));
        assert_eq!(sheets.len(), 1, "{name}");
        let (wide, folds, area, told) = across(&sheets, plain);
        let (bent, moved, less, all) = across(&sheets, plain.bending(metal));
        assert!(
            (bent - wide - longer).abs() < 0.06,
            "{name}: {} {longer}",
            bent - wide
        );
        assert_eq!(folds.len(), moved.len());
        let high = area / wide;
        assert!(
            (less - area - longer * high).abs() < 0.01 * area,
            "{name}: {less} {area}"
        );
        assert!(
            (all - told - longer * high).abs() < 0.01 * told,
            "{name}: {all} {told}"
        );
        // A flange has half of what its bend takes or saves.
        if folds.len() == 1 {
            assert!(
                (moved[0] - folds[0] - 0.5 * longer).abs() < 0.06,
                "{name}: {moved:?} {folds:?}"
            );
        }
    }
    // What has no such bends.
    let refused = |sheets: &[Sheet], bending: Bending| {
        Drawing::new(sheets, &plain.bending(bending))
            .unwrap_err()
            .to_string()
    };
    assert!(
        refused(&pyramid(), metal).contains("meets another one"),
        "{}",
        refused(&pyramid(), metal)
    );
    // A cylinder whose upper part is mirrored in the plane y = 0.5 + 2 (z - z₀) folds along a curve.
    let round = |x: f64| (0.49 - (x - 0.5).powi(2)).sqrt();
    let curved = sheets(&unit_square(100, |x, y| {
        let crease = 0.5 + 2.0 * (round(x) - round(0.25));
        round(x) + (4.0 / 3.0) * (y - crease).max(0.0)
    }));
    assert_eq!((curved.len(), curved[0].folds.len()), (1, 1));
    let error = Drawing::new(&curved, &plain.bending(metal)).unwrap_err();
    assert_eq!(error.code(), "CURVED_FOLD", "{error}");
    assert!(
        error.to_string().starts_with("fold 1 of sheet 1 is curved"),
        "{error}"
    );
    let narrow = sheets(&unit_square(100, |x, _| -(x - 0.053).abs()));
    assert!(refused(&narrow, metal.radius(30.0)).contains("nearer to an edge"));
    for (bending, name) in [
        (metal.k_factor(2.0), "kFactor"),
        (metal.radius(-1.0), "innerRadius"),
        (Bending::new(0.0), "thickness"),
        (Bending::new(f64::NAN), "thickness"),
    ] {
        assert!(refused(&narrow, bending).contains(name), "{bending:?}");
    }
}

#[test]
fn the_picture_of_an_assembly_has_its_lines_where_the_creases_are() {
    let sheets = pyramid();
    let svg = String::from_utf8(write_assembly_svg(&sheets).unwrap()).unwrap();
    let all = || sheets.iter().flat_map(|sheet| &sheet.faces.built);
    let low = all().map(|p| p[0]).fold(f64::INFINITY, f64::min);
    let high = all().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
    let wide = all().map(|p| p[0]).fold(f64::NEG_INFINITY, f64::max) - low;
    let tall = high - all().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let scale = 1000.0 / wide.max(tall);
    let mut quarters = [0; 4];
    let lists = svg
        .split(['"', 'Z'])
        .filter(|text| text.starts_with('M') || text.contains(".") && text.contains(','));
    for list in lists {
        let numbers: Vec<f64> = (list.split(|c: char| !c.is_ascii_digit() && c != '.'))
            .filter_map(|number| number.parse().ok())
            .collect();
        let points: Vec<[f64; 2]> = numbers.as_chunks().0.to_vec();
        let steps = points.windows(2).flat_map(|ends| {
            let along = |k: usize, t: f64| (1.0 - t) * ends[0][k] + t * ends[1][k];
            (0..=100).map(move |i| [0, 1].map(|k| along(k, 0.01 * f64::from(i))))
        });
        for pixel in steps {
            let x = low + pixel[0] / scale - 0.503;
            let y = high - pixel[1] / scale - 0.502;
            // Away from the apex, which is round, and from the border all that is drawn are creases.
            if (0.03..0.45).contains(&x.abs().max(y.abs())) {
                let off = (x.abs() - y.abs()).abs() / 2f64.sqrt();
                assert!(off < 0.8 / 80.0, "{x} {y}");
                quarters[usize::from(x > 0.0) + 2 * usize::from(y > 0.0)] += 1;
            }
        }
    }
    assert!(quarters.iter().all(|points| *points > 50), "{quarters:?}");
}

#[test]
fn no_text_lies_beyond_its_sheet_however_small_that_is() {
    let net = pattern_exact(&cube(1), &NetOptions::default()).unwrap();
    for scale in [30.0, 3.0, 1.0, 0.3] {
        for sheets in [&net.sheets, &pyramid()] {
            let drawing = drawn(sheets, DrawingOptions::default().scale(scale).tabs(2.0));
            for sheet in &drawing.sheets {
                let ends: Vec<_> = sheet
                    .leaders
                    .iter()
                    .map(|line| *line.controls().last().unwrap())
                    .collect();
                let is_beside = |place: [f64; 2]| {
                    (ends.iter()).any(|end| (end[0] - place[0]).hypot(end[1] - place[1]) < 4.5)
                };
                for label in sheet
                    .labels
                    .iter()
                    .filter(|label| label.kind != LabelKind::Sheet)
                {
                    assert!(
                        inside(label.place, &sheet.cuts) || is_beside(label.place),
                        "{scale} {label:?}"
                    );
                }
            }
        }
    }
}
