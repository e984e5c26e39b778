//! Patterns drawn in millimetres, and written to files. (What other programs measure in these is in
//! `tests/js/patterns.test.mjs`.)

use crate::common::unit_square;
use developable::Heightfield;
use developable::drawing::{Drawing, DrawingOptions, LabelKind, Pages, Paper};
use developable::files::drawings::{write_dxf, write_pdf, write_svg};
use developable::patches::{PatchOptions, Patches};
use developable::pattern::{PatternOptions, Sheet, pattern};

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
fn tabs_are_added_outside_and_touch_nothing() {
    let plain = drawn(&pyramid(), DrawingOptions::default().scale(150.0));
    let tabbed = drawn(&pyramid(), DrawingOptions::default().scale(150.0).tabs(8.0));
    assert!(tabbed.summary.tabs >= 1);
    let [before, after] = [&plain, &tabbed].map(|d| area(&d.sheets[0].cuts));
    // A trapezoid of 45° over each base.
    let expected: f64 = (tabbed.sheets[0].tabs.iter())
        .map(|tab| 8.0 * (tab.length - 8.0))
        .sum();
    assert!(
        (after - before - expected).abs() < 0.02 * expected,
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
fn pages_overlap_and_cover_the_sheets() {
    let drawing = drawn(&vaults(), DrawingOptions::default().scale(300.0));
    for paper in [Paper::A4, Paper::Letter] {
        let pages = Pages::new(&drawing, paper).unwrap();
        assert_eq!(pages.pages.len(), Pages::count(&drawing, paper));
        let mut sides = pages.paper;
        sides.sort_by(f64::total_cmp);
        assert_eq!(sides, paper.size());
        for point in drawing
            .sheets
            .iter()
            .flat_map(|sheet| sheet.cuts.iter().flatten())
        {
            let on = |corner: [f64; 2]| {
                [0, 1]
                    .iter()
                    .all(|k| (corner[*k]..=corner[*k] + pages.part[*k]).contains(&point[*k]))
            };
            assert!(pages.pages.iter().any(|page| on(page.corner)), "{point:?}");
        }
        // Each page has crosses at all four corners, and so has something of all its neighbours.
        for page in &pages.pages {
            let on = |mark: &&[f64; 2]| {
                [0, 1].iter().all(|k| {
                    let along = mark[*k] - page.corner[*k];
                    (0.0..=pages.part[*k]).contains(&along)
                })
            };
            assert_eq!(pages.marks.iter().filter(on).count(), 4);
        }
    }
    assert_eq!(drawing.summary.a4, Pages::count(&drawing, Paper::A4));
}

#[test]
fn files_are_the_same_each_time() {
    let drawing = drawn(&vaults(), DrawingOptions::default().scale(100.0).tabs(5.0));
    for write in [write_svg, write_dxf, |d: &Drawing| {
        write_pdf(d, Some(Paper::A4))
    }] {
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
    assert_eq!(write_pdf(&large, None).unwrap_err().code(), "UNSUPPORTED");
    assert_eq!(
        write_pdf(&large, Some(Paper::A4)).unwrap_err().code(),
        "UNSUPPORTED"
    );
    let mut broken = drawn(&sheets, DrawingOptions::default());
    broken.sheets[0].cuts[0][0][1] = f64::NAN;
    assert_eq!(write_svg(&broken).unwrap_err().code(), "UNSUPPORTED");
    assert_eq!(write_dxf(&broken).unwrap_err().code(), "UNSUPPORTED");
    // So deep that no edge is long enough for one.
    let tabs = drawn(&sheets, DrawingOptions::default().tabs(1e3));
    assert_eq!(tabs.summary.tabs, 0);
}
