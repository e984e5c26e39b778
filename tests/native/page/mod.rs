//! Flat pages from traced edges, against synthetic pages under a camera.

mod found;
mod lines;
mod measure;
mod outline;
mod scene;
mod sheet;

use developable::dewarp::{DewarpOptions, Photo};
use developable::page::{
    Edges, FocalLength, Format, PageOptions, PageSurface, PageVerdict, Ruler, Trace,
};
use developable::{Error, Resolution, View, sample};
use measure::displacement;
use oorandom::Rand64;
use scene::{Hand, Scene, Turns, arc, book, flat, mirrored_book, s_curve, trace};

/// 2 pixels of a 12-megapixel photo.
const HAND: Hand = Hand {
    points: 40,
    error: 2.0,
    wander: 0.0,
};

const EXACT: Hand = Hand {
    points: 30,
    error: 0.0,
    wander: 0.0,
};

/// Distance, pitch, yaw and roll.
const VIEWS: [[f64; 4]; 5] = [
    [430.0, 0.0, 0.0, 0.0],
    [430.0, 15.0, 0.0, 5.0],
    [430.0, 30.0, -8.0, 0.0],
    [600.0, 0.0, -15.0, 180.0],
    [600.0, -25.0, -10.0, 90.0],
];

fn view(turn: Turns, [distance, pitch, yaw, roll]: [f64; 4]) -> Scene {
    Scene::new(&[turn]).tilted(distance, pitch, yaw, roll)
}

fn known(scene: &Scene) -> PageOptions {
    PageOptions::default().focal_length(FocalLength::Pixels(scene.focal))
}

fn found(
    scene: &Scene,
    hand: Hand,
    seed: u128,
    options: &PageOptions,
) -> Result<PageSurface, Error> {
    PageSurface::new(
        &trace(scene, hand, &mut Rand64::new(seed)),
        &[],
        scene.photo,
        options,
    )
}

fn points(edges: &Edges) -> [Vec<[f64; 2]>; 2] {
    match edges {
        Edges::TopBottom {
            top: Trace::Points(top),
            bottom: Trace::Points(bottom),
        } => [top.clone(), bottom.clone()],
        other => panic!("{other:?}"),
    }
}

fn top_bottom([top, bottom]: [Vec<[f64; 2]>; 2]) -> Edges {
    Edges::TopBottom {
        top: Trace::Points(top),
        bottom: Trace::Points(bottom),
    }
}

#[test]
fn curled_pages_are_flat_to_six_thousandths_of_their_width_and_the_estimate_says_so() {
    let (mut within, mut count) = (0, 0);
    for turn in [arc, s_curve, book] {
        for (number, place) in VIEWS.into_iter().enumerate() {
            let scene = view(turn, place);
            let page = found(&scene, HAND, 11 + number as u128, &known(&scene)).unwrap();
            let (error, report) = (displacement(&page, &scene), page.report());
            assert!(error < 0.6, "{place:?}: {error} {report:?}");
            assert_eq!(
                report.verdict,
                PageVerdict::Unchecked,
                "{place:?} {report:?}"
            );
            assert!(!page.is_millimetres());
            count += 1;
            within += usize::from(error <= report.error_bound);
        }
    }
    assert!(within + 1 >= count, "{within} of {count}");
}

#[test]
fn an_unknown_focal_length_is_that_of_a_phone_and_changes_little() {
    for turn in [flat as Turns, arc, book, mirrored_book] {
        for place in [[430.0, 15.0, 0.0, 0.0], [430.0, 0.0, 0.0, 0.0]] {
            let scene = view(turn, place);
            let page = found(&scene, HAND, 3, &PageOptions::default()).unwrap();
            let off = displacement(&page, &scene);
            assert!(off < 1.0, "{off} {:?}", page.report());
        }
    }
    let above = view(flat, [430.0, 0.0, 0.0, 0.0]);
    let page = found(&above, EXACT, 3, &PageOptions::default()).unwrap();
    assert!(displacement(&page, &above) < 0.05);
    assert_eq!(page.report().verdict, PageVerdict::Flat);
}

#[test]
fn focal_lengths_may_be_told_in_several_ways() {
    let scene = view(arc, VIEWS[1]);
    let [short, long] = [3024.0f64, 4032.0];
    let told = [
        FocalLength::FieldOfView(2.0 * (long / 2.0 / 3028.0).atan().to_degrees()),
        FocalLength::Film35(3028.0 * (36f64.hypot(24.0)) / short.hypot(long)),
    ];
    for focal in told {
        let page = found(
            &scene,
            EXACT,
            1,
            &PageOptions::default().focal_length(focal),
        )
        .unwrap();
        assert!((page.report().focal_length / 3028.0 - 1.0).abs() < 0.03);
    }
}

#[test]
fn both_pages_of_a_spread_share_the_gutter() {
    for place in [[600.0, 0.0, 0.0, 90.0], [600.0, 20.0, 5.0, 90.0]] {
        let [distance, pitch, yaw, roll] = place;
        let scene = Scene::new(&[mirrored_book, book]).tilted(distance, pitch, yaw, roll);
        let page = found(&scene, HAND, 5, &known(&scene).format(Format::A4)).unwrap();
        assert_eq!(page.pages(), 2);
        assert!(displacement(&page, &scene) < 0.3, "{:?}", page.report());
        assert_eq!(page.report().verdict, PageVerdict::Unchecked);
        let [width, height] = page.flat_size();
        assert!(
            (width - 420.0).abs() < 2.0 && (height - 297.0).abs() < 1.5,
            "{width} {height}"
        );
        // The gutter, from above, is where the pages meet.
        let [gutter, there] = [page.photo_place([0.5, 0.3]), scene.seen(1, 0.0, 0.3)];
        assert!((gutter[0] - there[0]).hypot(gutter[1] - there[1]) < 8.0);

        // The right page first: the same.
        let mut edges = trace(&scene, HAND, &mut Rand64::new(5));
        edges.reverse();
        let again =
            PageSurface::new(&edges, &[], scene.photo, &known(&scene).format(Format::A4)).unwrap();
        assert_eq!(again.flat_size(), page.flat_size());
    }
}

#[test]
fn wide_angles_and_cropped_photos() {
    let mut wide = view(book, [260.0, 10.0, -10.0, 0.0]);
    wide.focal = 1700.0;
    let page = found(&wide, HAND, 2, &known(&wide)).unwrap();
    assert!(displacement(&page, &wide) < 0.3);

    // A part of a larger photo, whose middle is beside it.
    let mut cropped = view(arc, VIEWS[1]);
    cropped.centre = [700.0, 2600.0];
    let page = found(&cropped, HAND, 2, &known(&cropped).centre(cropped.centre)).unwrap();
    assert!(displacement(&page, &cropped) < 0.3);
}

#[test]
fn the_order_of_points_and_the_direction_of_edges_do_not_matter() {
    let scene = view(s_curve, VIEWS[2]);
    let edges = trace(&scene, HAND, &mut Rand64::new(9));
    let page = PageSurface::new(&edges, &[], scene.photo, &known(&scene)).unwrap();
    let [top, bottom] = points(&edges[0]);
    let turned = |line: &Vec<[f64; 2]>| line.iter().rev().copied().collect::<Vec<_>>();
    let mut mixed = bottom.clone();
    mixed[1..39].sort_by(|p, q| (p[0] * 7.3 % 1.0).total_cmp(&(q[0] * 7.3 % 1.0)));
    for own in [
        [turned(&top), bottom.clone()],
        [top.clone(), turned(&bottom)],
        [turned(&top), turned(&bottom)],
        [top.clone(), mixed],
    ] {
        let again = PageSurface::new(&[top_bottom(own)], &[], scene.photo, &known(&scene)).unwrap();
        let (one, other) = (page.photo_place([0.3, 0.4]), again.photo_place([0.3, 0.4]));
        let ([x, y], [u, v]) = (one, other);
        assert!((x - u).hypot(y - v) < 1.0, "{x} {y} {u} {v}");
    }
}

#[test]
fn a_page_curled_the_other_way_is_the_same_turned() {
    let scene = view(arc, [430.0, 15.0, 0.0, 90.0]);
    let edges = trace(&scene, HAND, &mut Rand64::new(4));
    let [top, bottom] = points(&edges[0]);
    // Turned clockwise: what was the top edge is at the right, and runs down.
    let turned = Edges::LeftRight {
        left: Trace::Points(bottom),
        right: Trace::Points(top),
    };
    let options = known(&scene).format(Format::A4);
    let (page, across) = (
        PageSurface::new(&edges, &[], scene.photo, &options).unwrap(),
        PageSurface::new(&[turned], &[], scene.photo, &options).unwrap(),
    );
    let ([w, h], [v, u]) = (page.flat_size(), across.flat_size());
    assert!((w - u).abs() < 0.5 && (h - v).abs() < 0.5);
    assert!((w - 210.0).abs() < 1.0 && (h - 297.0).abs() < 1.0);
    for [s, t] in [[0.1, 0.2], [0.7, 0.9]] {
        let (one, other) = (page.photo_place([s, t]), across.photo_place([1.0 - t, s]));
        let off = (one[0] - other[0]).hypot(one[1] - other[1]);
        assert!(off < 6.0, "{off}");
    }
    assert!((page.report().ratio * across.report().ratio - 1.0).abs() < 2e-3);
}

#[test]
fn folded_and_crumpled_pages_are_not_trusted_by_two_edges() {
    for place in [VIEWS[0], VIEWS[1], VIEWS[2]] {
        let mut folded = view(flat, place);
        folded.fold = 1.0;
        let mut crumpled = view(arc, place);
        crumpled.crumple = 6.0;
        for scene in [folded, crumpled] {
            let page = found(&scene, HAND, 6, &known(&scene)).unwrap();
            let report = page.report();
            let is_trusted = matches!(report.verdict, PageVerdict::Flat | PageVerdict::Unrolled);
            assert!(!is_trusted, "{report:?}");
        }
    }
}

/// Perspective alone: the homography of the four corners, by solving for it.
#[test]
fn straight_edges_give_the_plain_homography() {
    let scene = view(flat, [500.0, 25.0, -12.0, 10.0]);
    let corners = |t: f64| scene.edge(0, t, &[0.0, 1.0]);
    let edges = [top_bottom([corners(0.0), corners(1.0)])];
    let page = PageSurface::new(&edges, &[], scene.photo, &known(&scene)).unwrap();
    // Nothing was traced between the corners, so nothing says that it is flat.
    assert_eq!(page.report().verdict, PageVerdict::Unchecked);
    assert!(displacement(&page, &scene) < 0.01);
    let [a, b, c, d] =
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[s, t]| scene.seen(0, s, t));
    // Heckbert's closed form for the unit square.
    let (dx, dy) = ([b[0] - c[0], d[0] - c[0]], [b[1] - c[1], d[1] - c[1]]);
    let sum = [0, 1].map(|k| a[k] - b[k] + c[k] - d[k]);
    let area = dx[0] * dy[1] - dx[1] * dy[0];
    let g = (sum[0] * dy[1] - dx[1] * sum[1]) / area;
    let h = (dx[0] * sum[1] - sum[0] * dy[0]) / area;
    for [s, t] in [[0.25, 0.5], [0.8, 0.1], [0.5, 0.95]] {
        let known = [0, 1].map(|k| {
            let (p, q) = (b[k] - a[k] + g * b[k], d[k] - a[k] + h * d[k]);
            (p * s + q * t + a[k]) / (g * s + h * t + 1.0)
        });
        let found = page.photo_place([s, t]);
        assert!(
            (found[0] - known[0]).hypot(found[1] - known[1]) < 0.5,
            "{found:?} {known:?}"
        );
    }
}

#[test]
fn formats_and_rulers_give_millimetres() {
    let scene = view(arc, VIEWS[1]);
    let page = found(&scene, HAND, 8, &known(&scene).format(Format::A4)).unwrap();
    let [width, height] = page.flat_size();
    assert!(page.is_millimetres());
    assert!(
        (width - 210.0).abs() < 0.7 && (height - 297.0).abs() < 1.0,
        "{width} {height}"
    );
    assert!(displacement(&page, &scene) < 0.2);

    // 150 mm down the page, and across it.
    for [from, to] in [
        [[0.2, 0.1], [0.2, 0.1 + 150.0 / 297.0]],
        [[0.1, 0.5], [0.1 + 150.0 / 210.0, 0.5]],
    ] {
        let [from, to] = [from, to].map(|[s, t]| scene.seen(0, s, t));
        let ruler = Ruler {
            from,
            to,
            length: 150.0,
        };
        let page = found(&scene, HAND, 8, &known(&scene).ruler(ruler)).unwrap();
        let [width, height] = page.flat_size();
        assert!(page.is_millimetres());
        assert!(
            (width - 210.0).abs() < 1.0 && (height - 297.0).abs() < 1.5,
            "{width} {height}"
        );
    }
    let beside = Ruler {
        from: [0.0; 2],
        to: [10.0; 2],
        length: 1.0,
    };
    assert_eq!(
        found(&scene, HAND, 8, &known(&scene).ruler(beside))
            .unwrap_err()
            .code(),
        "OPTION"
    );

    // What it is not.
    let square = known(&scene).format(Format::Millimetres([200.0, 200.0]));
    let report = *found(&scene, HAND, 8, &square).unwrap().report();
    let word = report.verdict;
    assert!(
        matches!(word, PageVerdict::Doubtful | PageVerdict::NotThisKind),
        "{report:?}"
    );
}

#[test]
fn the_warp_map_is_exact_and_the_flat_image_has_what_the_page_has() {
    let scene = view(arc, VIEWS[1]);
    let page = found(&scene, EXACT, 1, &known(&scene).format(Format::A4)).unwrap();
    let map = page.warp_map(&DewarpOptions::default().dots(2.0)).unwrap();
    assert_eq!([map.width(), map.height()], [420, 594]);
    for (col, row) in [(0, 0), (100, 300), (419, 593)] {
        let [x, y] = map.places()[row * 420 + col].map(f64::from);
        let [u, v] = scene.seen(0, (col as f64 + 0.5) / 420.0, (row as f64 + 0.5) / 594.0);
        assert!((x - u).hypot(y - v) < 3.0, "{x} {y} {u} {v}");
    }
    // A photo that is red in the page's upper left quarter.
    let fine = 8;
    let [width, height] = scene.photo.map(|n| n / fine);
    let mut rgba = vec![255u8; 4 * width * height];
    let mut small = scene.clone();
    (small.focal, small.photo) = (scene.focal / fine as f64, [width, height]);
    small.centre = scene.centre.map(|c| (c + 0.5) / fine as f64 - 0.5);
    for (i, pixel) in rgba.chunks_exact_mut(4).enumerate() {
        let at = [(i % width) as f64, (i / width) as f64];
        let [x, y] = small.on_page(0, [0.5, 0.5], at);
        if (0.0..105.0).contains(&x) && (0.0..148.5).contains(&y) {
            pixel.copy_from_slice(&[255, 0, 0, 255]);
        }
    }
    let page = found(&small, EXACT, 1, &known(&small).format(Format::A4)).unwrap();
    // By default as many pixels as the photo has of it.
    let whole = page.warp_map(&DewarpOptions::default()).unwrap();
    let per_millimetre = small.focal / small.distance;
    let shares = whole.resolution() / per_millimetre;
    assert!((shares - 1.0).abs() < 0.15, "{shares}");
    let map = page.warp_map(&DewarpOptions::default().dots(1.0)).unwrap();
    let image = map
        .image(&Photo::new(width, height, &rgba).unwrap())
        .unwrap();
    for row in 0..map.height() {
        for col in 0..map.width() {
            let green = image[4 * (row * map.width() + col) + 1];
            if (3..102).contains(&col) && (3..145).contains(&row) {
                assert_eq!(green, 0, "{col} {row}");
            } else if col > 107 || row > 151 {
                assert_eq!(green, 255, "{col} {row}");
            }
        }
    }
}

#[test]
fn the_surface_is_a_mesh_that_is_isometric_to_the_page() {
    let scene = view(arc, VIEWS[1]);
    let page = found(&scene, EXACT, 1, &known(&scene).format(Format::A4)).unwrap();
    let mesh = page.mesh().unwrap();
    let area: f64 = (mesh.triangles().iter())
        .map(|t| {
            let [a, b, c] = t.map(|i| mesh.positions()[i as usize]);
            let ([p, q], mut sum) = ([b, c].map(|v| [0, 1, 2].map(|k| v[k] - a[k])), 0.0);
            for k in 0..3 {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                sum += (p[i] * q[j] - p[j] * q[i]).powi(2);
            }
            sum.sqrt() / 2.0
        })
        .sum();
    assert!((area / (210.0 * 297.0) - 1.0).abs() < 5e-3, "{area}");
    // In front of the camera, where texture coordinates say it is in the photo.
    for (p, uv) in mesh.positions().iter().zip(mesh.uvs().unwrap()) {
        assert!(p[2] < -300.0 && p[2] > -600.0);
        let x = scene.centre[0] - scene.focal * p[0] / p[2];
        let y = scene.centre[1] + scene.focal * p[1] / p[2];
        assert!((x + 0.5 - 3024.0 * f64::from(uv[0])).abs() < 40.0);
        assert!((y + 0.5 - 4032.0 * (1.0 - f64::from(uv[1]))).abs() < 40.0);
    }
    let seen = sample(&mesh, View::BestFit, Resolution::Across(60)).unwrap();
    let heights = seen.heightfield().heights();
    let there = heights.iter().filter(|z| !z.is_nan()).count();
    assert!(10 * there > 7 * heights.len());
}

#[test]
fn bezier_curves_are_edges_too() {
    let scene = view(arc, VIEWS[1]);
    let line = |t: f64| {
        // Through the curve's points, with its tangents, in three pieces.
        let mut control = vec![scene.seen(0, 0.0, t)];
        for i in 0..3 {
            let [from, to] = [i, i + 1].map(|i| f64::from(i) / 3.0);
            let slope = |s: f64| {
                let [p, q] = [(s - 1e-2).max(0.0), (s + 1e-2).min(1.0)];
                let (a, b) = (scene.seen(0, p, t), scene.seen(0, q, t));
                [0, 1].map(|k| (b[k] - a[k]) / (q - p) / 9.0)
            };
            let (a, b) = (scene.seen(0, from, t), scene.seen(0, to, t));
            let (u, v) = (slope(from), slope(to));
            control.extend([[a[0] + u[0], a[1] + u[1]], [b[0] - v[0], b[1] - v[1]], b]);
        }
        Trace::Beziers(control)
    };
    let edges = Edges::TopBottom {
        top: line(0.0),
        bottom: line(1.0),
    };
    let page = PageSurface::new(&[edges], &[], scene.photo, &known(&scene)).unwrap();
    assert!(displacement(&page, &scene) < 0.3, "{:?}", page.report());

    let short = Edges::TopBottom {
        top: Trace::Beziers(vec![[0.0; 2]; 5]),
        bottom: line(1.0),
    };
    assert_eq!(
        PageSurface::new(&[short], &[], scene.photo, &known(&scene))
            .unwrap_err()
            .code(),
        "EDGES"
    );
}

#[test]
fn what_is_no_page_is_refused() {
    let photo = [3000, 2000];
    let options = PageOptions::default().focal_length(FocalLength::Pixels(2500.0));
    let line = |points: &[[f64; 2]]| points.to_vec();
    let (top, bottom) = (
        line(&[[500.0, 400.0], [1500.0, 300.0], [2500.0, 400.0]]),
        line(&[[500.0, 1600.0], [1500.0, 1700.0], [2500.0, 1600.0]]),
    );
    let code = |top: &[[f64; 2]], bottom: &[[f64; 2]]| {
        let edges = [top_bottom([top.to_vec(), bottom.to_vec()])];
        PageSurface::new(&edges, &[], photo, &options).map_or_else(|error| error.code(), |_| "none")
    };
    assert_eq!(code(&top, &bottom), "none");
    assert_eq!(code(&bottom, &top), "EDGES"); // exchanged
    assert_eq!(code(&[], &bottom), "EDGES");
    assert_eq!(code(&[[1.0, 2.0]], &bottom), "EDGES");
    assert_eq!(code(&[[500.0, 400.0]; 9], &bottom), "EDGES");
    assert_eq!(code(&top, &top), "EDGES");
    assert_eq!(
        code(&[[f64::NAN, 0.0], [2500.0, 400.0]], &bottom),
        "NOT_FINITE"
    );
    assert_eq!(
        code(&[[500.0, f64::INFINITY], [2500.0, 400.0]], &bottom),
        "NOT_FINITE"
    );
    // Beside the photo, as of a photo of another size.
    assert_eq!(code(&[[500.0, 400.0], [3600.0, 400.0]], &bottom), "EDGES");
    // Crossing, and with a corner within the other three.
    let through = line(&[[500.0, 400.0], [1500.0, 1900.0], [2500.0, 400.0]]);
    assert_eq!(code(&through, &bottom), "EDGES");
    assert_eq!(code(&[[500.0, 400.0], [700.0, 1500.0]], &bottom), "EDGES");

    let edges = [top_bottom([top.clone(), bottom.clone()])];
    let with = |options: PageOptions| {
        PageSurface::new(&edges, &[], photo, &options).map_or_else(|e| e.code(), |_| "none")
    };
    for focal in [0.0, -1.0, f64::NAN, f64::INFINITY, 1.0, 1e9] {
        assert_eq!(
            with(PageOptions::default().focal_length(FocalLength::Pixels(focal))),
            "OPTION"
        );
        assert_eq!(
            with(PageOptions::default().focal_length(FocalLength::Film35(-focal))),
            "OPTION"
        );
    }
    for angle in [0.0, 180.0, f64::NAN] {
        assert_eq!(
            with(PageOptions::default().focal_length(FocalLength::FieldOfView(angle))),
            "OPTION"
        );
    }
    assert_eq!(with(options.centre([f64::NAN, 0.0])), "OPTION");
    assert_eq!(
        with(options.format(Format::Millimetres([0.0, 1.0]))),
        "OPTION"
    );
    assert_eq!(with(options.format(Format::Ratio(1e5))), "OPTION");
    assert_eq!(
        PageSurface::new(&edges, &[], [0, 5], &options)
            .unwrap_err()
            .code(),
        "EMPTY"
    );
    assert_eq!(
        PageSurface::new(&[], &[], photo, &options)
            .unwrap_err()
            .code(),
        "OPTION"
    );
    // Two pages that do not touch.
    let apart = [
        top_bottom([top.clone(), bottom.clone()]),
        top_bottom([top, bottom]),
    ];
    assert_eq!(
        PageSurface::new(&apart, &[], photo, &options)
            .unwrap_err()
            .code(),
        "EDGES"
    );
}

/// Whatever it is given, it ends with a page or an error.
#[test]
fn no_edges_make_it_panic() {
    let mut rng = Rand64::new(77);
    for _ in 0..15 {
        let mut line = |low: f64, high: f64| {
            let count = 2 + (rng.rand_float() * 6.0) as usize;
            let steps = |k: usize| k as f64 / (count - 1) as f64;
            (0..count)
                .map(|k| {
                    [
                        100.0 + 800.0 * steps(k),
                        low + (high - low) * rng.rand_float(),
                    ]
                })
                .collect::<Vec<_>>()
        };
        let edges = [top_bottom([line(0.0, 600.0), line(400.0, 1000.0)])];
        for focal in [FocalLength::Unknown, FocalLength::Pixels(900.0)] {
            let options = PageOptions::default().focal_length(focal);
            if let Ok(page) = PageSurface::new(&edges, &[], [1000, 1000], &options) {
                let report = page.report();
                assert!(report.error.is_finite() && report.error_bound >= report.error);
                assert!(
                    page.flat_size()
                        .iter()
                        .all(|side| side.is_finite() && *side > 0.0)
                );
                assert!(page.mesh().is_ok());
            }
        }
    }
}
