//! Lines of text and straight edges as what checks the bent ones.

use developable::page::{Edges, PageSurface, PageVerdict, Trace};
use oorandom::Rand64;

use super::measure::displacement;
use super::scene::{Scene, arc, book, flat, mirrored_book, normal, s_curve, trace};
use super::{HAND, VIEWS, known, points, view};

/// Lines of text with margins, of unequal lengths, on the print turned by `skew` degrees.
fn text(scene: &Scene, page: usize, count: usize, skew: f64, rng: &mut Rand64) -> Vec<Trace> {
    let level = |i: usize| 0.1 + 0.8 * i as f64 / (count - 1) as f64;
    (0..count)
        .map(|i| {
            let end = 0.88 - 0.3 * rng.rand_float() * f64::from(u8::from(i % 4 == 3));
            let line = (0..20).map(|k| {
                let s = 0.1 + (end - 0.1) * f64::from(k) / 19.0;
                let down = skew.to_radians().tan() * (s - 0.5) * scene.sides[0] / scene.sides[1];
                let seen = scene.seen(page, s, level(i) + down);
                seen.map(|v| v + HAND.error * normal(rng))
            });
            Trace::Points(line.collect())
        })
        .collect()
}

/// The same, but errors go on over some points.
fn smooth_text(scene: &Scene, page: usize, count: usize, rng: &mut Rand64) -> Vec<Trace> {
    const POINTS: usize = 20;
    let line = |i: usize, rng: &mut Rand64| {
        let t = 0.1 + 0.8 * i as f64 / (count - 1) as f64;
        let [dx, dy] = [0, 1].map(|_| {
            let white: Vec<f64> = (0..POINTS + 12).map(|_| normal(rng)).collect();
            let weights: Vec<f64> = (-6..=6).map(|k| (-f64::from(k * k) / 8.0).exp()).collect();
            let norm = weights.iter().map(|w| w * w).sum::<f64>().sqrt();
            (0..POINTS)
                .map(|k| (0..13).map(|j| weights[j] * white[k + j]).sum::<f64>() / norm)
                .collect::<Vec<_>>()
        });
        let points = (0..POINTS).map(|k| {
            let [x, y] = scene.seen(page, 0.1 + 0.78 * k as f64 / (POINTS - 1) as f64, t);
            [x + HAND.error * dx[k], y + HAND.error * dy[k]]
        });
        Trace::Points(points.collect())
    };
    (0..count).map(|i| line(i, rng)).collect()
}

#[test]
fn errors_of_tracing_that_go_on_along_a_line_are_no_fold() {
    for (seed, turn) in (0..12).zip([arc, s_curve, book].into_iter().cycle()) {
        let scene = view(turn, VIEWS[1 + seed % 4]);
        let mut rng = Rand64::new(seed as u128);
        let edges = trace(&scene, HAND, &mut rng);
        let lines = [smooth_text(&scene, 0, 24, &mut rng)];
        let page = PageSurface::new(&edges, &lines, scene.photo, &known(&scene)).unwrap();
        let report = page.report();
        // (One is seen at so flat an angle at its gutter that it may hide a part of itself.)
        assert_ne!(
            report.verdict,
            PageVerdict::NotThisKind,
            "{seed}: {report:?}"
        );
        let off = displacement(&page, &scene);
        assert!(off < 0.5, "{off}");
    }
}

fn with(scene: &Scene, seed: u128, lines: usize, skew: f64) -> PageSurface {
    let mut rng = Rand64::new(seed);
    let edges = trace(scene, HAND, &mut rng);
    let lines: Vec<_> = (0..scene.pages())
        .map(|page| text(scene, page, lines, skew, &mut rng))
        .collect();
    PageSurface::new(&edges, &lines, scene.photo, &known(scene)).unwrap()
}

#[test]
fn curled_pages_are_as_accurate_with_lines_of_text_and_the_estimate_says_so() {
    let (mut sums, mut within) = ([[0.0; 2]; 3], 0);
    for (sums, turn) in sums.iter_mut().zip([arc, s_curve, book]) {
        for (number, place) in VIEWS.into_iter().enumerate() {
            let scene = view(turn, place);
            for (sum, lines) in sums.iter_mut().zip([0, 24]) {
                let page = with(&scene, 11 + number as u128, lines, 0.3);
                let (error, report) = (displacement(&page, &scene), page.report());
                let word = [PageVerdict::Unchecked, PageVerdict::Unrolled][usize::from(lines > 0)];
                assert_eq!(report.verdict, word, "{place:?} {report:?}");
                assert!(error < 0.6, "{error} {report:?}");
                assert_eq!(report.lines, lines);
                within += usize::from(error < report.error_bound);
                *sum += error * error;
            }
        }
    }
    assert!(within >= 28, "{within} of 30");
    let shares = sums.map(|[without, with]: [f64; 2]| (with / without).sqrt());
    assert!(shares.into_iter().all(|share| share < 1.3), "{shares:?}");
}

#[test]
fn lines_of_text_check_a_spread_that_nothing_else_checks() {
    // An upper edge whose plane passes near the camera.
    let scene = Scene::new(&[mirrored_book, book]).tilted(600.0, 14.0, 0.0, 90.0);
    let mut rng = Rand64::new(5);
    let edges = trace(&scene, HAND, &mut rng);
    let alone = PageSurface::new(&edges, &[], scene.photo, &known(&scene)).unwrap();
    assert_eq!(alone.report().verdict, PageVerdict::Unchecked);
    let page = with(&scene, 5, 20, -0.2);
    assert_eq!(page.report().verdict, PageVerdict::Unrolled);
    assert!(displacement(&page, &scene) < 0.3);
}

#[test]
fn slight_folds_show_in_lines_of_text() {
    for seed in 0..8 {
        let mut scene = view([flat, arc][seed % 2], VIEWS[seed / 2]);
        // By 14 degrees, across a corner.
        scene.fold = 0.25;
        let page = with(&scene, seed as u128, 24, 0.0);
        assert_eq!(
            page.report().verdict,
            PageVerdict::NotThisKind,
            "{seed}: {:?}",
            page.report()
        );
    }
}

/// All four edges, of which those beside the text are traced from their middle, too.
fn all(scene: &Scene, rng: &mut Rand64) -> Edges {
    let side = |s: f64, rng: &mut Rand64| {
        let points = (0..HAND.points).map(|i| {
            let t = i as f64 / (HAND.points - 1) as f64;
            scene
                .seen(0, s, t)
                .map(|v| v + HAND.error * normal(rng) * f64::from(u8::from(t % 1.0 > 0.0)))
        });
        Trace::Points(points.collect())
    };
    match trace(scene, HAND, rng).remove(0) {
        Edges::TopBottom { top, bottom } => Edges::All {
            top,
            bottom,
            left: side(0.0, rng),
            right: side(1.0, rng),
        },
        other => other,
    }
}

#[test]
fn a_letter_folded_along_two_of_its_edges_shows_it_by_the_others() {
    for place in VIEWS {
        let mut scene = view(flat, place);
        let edges = [all(&scene, &mut Rand64::new(3))];
        let page = PageSurface::new(&edges, &[], scene.photo, &known(&scene)).unwrap();
        assert_eq!(page.report().verdict, PageVerdict::Flat, "{place:?}");
        // In the middle, by 20 degrees: what is right of it rises.
        scene.valley = 0.36;
        let edges = [all(&scene, &mut Rand64::new(3))];
        let page = PageSurface::new(&edges, &[], scene.photo, &known(&scene)).unwrap();
        // Now the edges beside the text are seen to be bent.
        let report = page.report();
        assert_eq!(
            report.verdict,
            PageVerdict::Unchecked,
            "{place:?}: {report:?}"
        );
    }
}

#[test]
fn a_page_of_which_all_edges_are_traced_is_curled_the_way_that_is_seen() {
    let scene = view(s_curve, VIEWS[2]);
    let page = PageSurface::new(
        &[all(&scene, &mut Rand64::new(1))],
        &[],
        scene.photo,
        &known(&scene),
    )
    .unwrap();
    assert_eq!(page.report().verdict, PageVerdict::Unchecked);
    assert!(displacement(&page, &scene) < page.report().error_bound);

    // Turned clockwise: what was the top edge is at the right.
    let Edges::All {
        top,
        bottom,
        left,
        right,
    } = all(&scene, &mut Rand64::new(1))
    else {
        panic!("all edges")
    };
    let turned = Edges::All {
        right: top,
        left: bottom,
        top: left,
        bottom: right,
    };
    let other = PageSurface::new(&[turned], &[], scene.photo, &known(&scene)).unwrap();
    let ([w, h], [v, u]) = (page.flat_size(), other.flat_size());
    assert!((w / h - u / v).abs() < 0.05, "{w} {h} {u} {v}");
}

#[test]
fn lines_along_the_rulings_are_straight() {
    // Read from its side: the lines run along the rulings.
    let scene = view(arc, [430.0, 15.0, 0.0, 90.0]);
    let mut rng = Rand64::new(4);
    let [top, bottom] = points(&trace(&scene, HAND, &mut rng)[0]);
    let edges = [Edges::LeftRight {
        left: Trace::Points(bottom),
        right: Trace::Points(top),
    }];
    let lines = |bent: f64, rng: &mut Rand64| -> Vec<Trace> {
        (0..20)
            .map(|i| {
                let s = 0.05 + 0.9 * f64::from(i) / 19.0;
                let line = (0..15).map(|k| {
                    let t = 0.9 - 0.8 * f64::from(k) / 14.0;
                    let [x, y] = scene.seen(0, s + bent * t * (1.0 - t), t);
                    [x + HAND.error * normal(rng), y + HAND.error * normal(rng)]
                });
                Trace::Points(line.collect())
            })
            .collect()
    };
    let word = |bent: f64, rng: &mut Rand64| {
        let lines = [lines(bent, rng)];
        let page = PageSurface::new(&edges, &lines, scene.photo, &known(&scene)).unwrap();
        page.report().verdict
    };
    assert_eq!(word(0.0, &mut rng), PageVerdict::Unrolled);
    assert_eq!(word(0.2, &mut rng), PageVerdict::NotThisKind);
}

#[test]
fn lines_that_are_none_are_refused() {
    let scene = view(arc, VIEWS[1]);
    let edges = trace(&scene, HAND, &mut Rand64::new(1));
    let code = |lines: &[Vec<Trace>]| {
        PageSurface::new(&edges, lines, scene.photo, &known(&scene))
            .map_or_else(|error| error.code(), |_| "none")
    };
    let (a, b) = (scene.seen(0, 0.1, 0.4), scene.seen(0, 0.9, 0.4));
    let line = |points: &[[f64; 2]]| Trace::Points(points.to_vec());
    assert_eq!(code(&[vec![line(&[a, b])]]), "none");
    assert_eq!(code(&[vec![]]), "none");
    assert_eq!(code(&[vec![line(&[a])]]), "EDGES");
    assert_eq!(code(&[vec![line(&[a, [f64::NAN, 1.0]])]]), "NOT_FINITE");
    // On the table.
    assert_eq!(code(&[vec![line(&[a, [30.0, 30.0]])]]), "EDGES");
    assert_eq!(code(&[vec![line(&[a, b])], vec![line(&[a, b])]]), "OPTION");
    assert_eq!(code(&[vec![line(&[a, b]); 501]]), "TOO_LARGE");
    // An edge that does not reach its corner.
    let Edges::All {
        top, bottom, right, ..
    } = all(&scene, &mut Rand64::new(1))
    else {
        panic!("all edges")
    };
    let open = Edges::All {
        top,
        bottom,
        left: line(&[scene.seen(0, 0.0, 0.0), scene.seen(0, 0.0, 0.7)]),
        right,
    };
    let error = PageSurface::new(&[open], &[], scene.photo, &known(&scene)).unwrap_err();
    assert!(error.to_string().contains("left edge ends"), "{error}");
}
