//! Lines of text that are found in photos, of pages that are printed with blocks for letters.

use developable::dewarp::Photo;
use developable::page::{Edges, FocalLength, PageOptions, PageSurface, PageVerdict, Trace};
use oorandom::Rand64;

use super::measure::displacement;
use super::scene::{Hand, Scene, arc, book, flat, mirrored_book, normal, s_curve, trace};
use super::{VIEWS, points, view};

/// 2 pixels of a 12-megapixel photo.
const HAND: Hand = Hand {
    points: 40,
    error: 0.75,
    wander: 0.0,
};

/// A photo in grey.
struct Picture {
    size: [usize; 2],
    grey: Vec<f64>,
}

impl Picture {
    /// Paper in uneven light.
    fn new(size: [usize; 2], rng: &mut Rand64) -> Self {
        let grey = (0..size[0] * size[1])
            .map(|i| {
                let [x, y] = [i % size[0], i / size[0]];
                let light = 1.0 - 0.4 * x as f64 / size[0] as f64 - 0.2 * y as f64 / size[1] as f64;
                220.0 * light + 3.0 * normal(rng)
            })
            .collect();
        Picture { size, grey }
    }

    /// Darkens what lies between four points, by shares of pixels.
    fn ink(&mut self, quad: [[f64; 2]; 4]) {
        const FINE: usize = 3;
        let range = |k: usize| {
            let values = quad.map(|p| p[k]);
            let low = values.into_iter().fold(f64::INFINITY, f64::min);
            let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
            (low.round().max(0.0) as usize)..=(high.round().max(0.0) as usize).min(self.size[k] - 1)
        };
        for (y, x) in range(1).flat_map(|y| range(0).map(move |x| (y, x))) {
            let inside = (0..FINE * FINE)
                .filter(|i| {
                    let p = [(x, i % FINE), (y, i / FINE)]
                        .map(|(at, part)| at as f64 + (part as f64 + 0.5) / FINE as f64 - 0.5);
                    let side = |i: usize| {
                        let (a, b) = (quad[i], quad[(i + 1) % 4]);
                        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0.0
                    };
                    (1..4).all(|i| side(i) == side(0))
                })
                .count();
            let share = inside as f64 / (FINE * FINE) as f64;
            self.grey[y * self.size[0] + x] *= 1.0 - 0.8 * share;
        }
    }

    fn rgba(&self) -> Vec<u8> {
        let pixel = |v: &f64| [v.round() as u8, v.round() as u8, v.round() as u8, 255];
        self.grey.iter().flat_map(pixel).collect()
    }
}

/// A scene at 1.7 megapixels.
fn small(turn: super::Turns, place: [f64; 4]) -> Scene {
    reduced(view(turn, place))
}

fn reduced(mut scene: Scene) -> Scene {
    const SCALE: f64 = 0.375;
    scene.photo = scene.photo.map(|n| (n as f64 * SCALE) as usize);
    scene.focal *= SCALE;
    scene.centre = scene.photo.map(|n| (n as f64 - 1.0) / 2.0);
    scene
}

fn known(scene: &Scene) -> PageOptions {
    PageOptions::default().focal_length(FocalLength::Pixels(scene.focal))
}

/// Levels of the lines, as shares of the page.
fn levels() -> impl Iterator<Item = f64> {
    (0..34).map(|i| 0.08 + 0.025 * f64::from(i))
}

/// Words of letters of unequal widths, some of which are taller, or reach below their line; `wander` is how far
/// each of them stands off it, in millimetres, and `slope` how differently lines rise.
fn print(
    scene: &Scene,
    page: usize,
    [wander, slope]: [f64; 2],
    picture: &mut Picture,
    rng: &mut Rand64,
) {
    let [wide, high] = scene.sides;
    for level in levels() {
        let rise = slope * normal(rng);
        let end = if rng.rand_float() < 0.2 { 110.0 } else { 188.0 };
        let (mut x, mut off) = (22.0, 0.0);
        while x < end {
            let width = 1.0 + 1.3 * rng.rand_float();
            off = 0.7 * off + wander * normal(rng);
            let foot = level * high + off + rise * (x - 105.0);
            let kind = rng.rand_float();
            let top = foot - if kind < 0.3 { 3.1 } else { 2.1 };
            let below = foot + if kind > 0.9 { 0.9 } else { 0.0 };
            let corner = |x: f64, y: f64| scene.seen(page, x / wide, y / high);
            picture.ink([
                corner(x, top),
                corner(x + width, top),
                corner(x + width, below),
                corner(x, below),
            ]);
            x += width + if rng.rand_float() < 0.2 { 2.4 } else { 0.5 };
        }
    }
}

/// Their photo, and the pages by their edges and with lines that were found.
fn both(scene: &Scene, hand: [f64; 2], seed: u128) -> [PageSurface; 2] {
    let mut rng = Rand64::new(seed);
    let edges = trace(scene, HAND, &mut rng);
    let mut picture = Picture::new(scene.photo, &mut rng);
    for page in 0..scene.pages() {
        print(scene, page, hand, &mut picture, &mut rng);
    }
    pages(scene, &edges, &picture)
}

fn pages(scene: &Scene, edges: &[Edges], picture: &Picture) -> [PageSurface; 2] {
    let bytes = picture.rgba();
    let photo = Photo::new(scene.photo[0], scene.photo[1], &bytes).unwrap();
    [
        PageSurface::new(edges, &[], scene.photo, &known(scene)).unwrap(),
        PageSurface::in_photo(edges, &[], &photo, &known(scene)).unwrap(),
    ]
}

const PRINT: [f64; 2] = [0.0; 2];

fn places(line: &Trace) -> &[[f64; 2]] {
    match line {
        Trace::Points(points) => points,
        other => panic!("{other:?}"),
    }
}

#[test]
fn lines_lie_where_letters_stand_and_make_curled_pages_more_exact() {
    let mut sums = [0.0; 2];
    for (seed, turn) in (0..6).zip([arc, s_curve, book].into_iter().cycle()) {
        let scene = small(turn, VIEWS[seed % 3]);
        let pages = both(&scene, PRINT, seed as u128);
        let report = pages[1].report();
        assert_eq!(report.verdict, PageVerdict::Unrolled, "{seed} {report:?}");
        assert!(
            report.lines >= 25 && report.lines_found == report.lines,
            "{report:?}"
        );
        assert_eq!(report.lines, pages[1].text()[0].len());
        // How far from level they are, in millimetres, of letters that are 2.1 high.
        let mut off = Vec::new();
        for line in pages[1].text()[0].iter().map(places) {
            let mut rows: Vec<f64> = (line.iter())
                .map(|p| scene.on_page(0, [0.5, 0.5], *p)[1])
                .collect();
            rows.sort_by(f64::total_cmp);
            let level = rows[rows.len() / 2];
            // As a whole it may lie a little above or below the letters' feet.
            let near = |own: f64| (own * scene.sides[1] - level).abs() < 0.6;
            assert!(levels().any(near), "{seed} {level}");
            off.extend(rows.iter().map(|row| (row - level).abs()));
        }
        off.sort_by(f64::total_cmp);
        assert!(
            off[off.len() * 19 / 20] < 0.3,
            "{seed} {}",
            off[off.len() * 19 / 20]
        );
        for (sum, page) in sums.iter_mut().zip(&pages) {
            *sum += displacement(page, &scene).powi(2);
        }
    }
    assert!(sums[1] < sums[0], "{sums:?}");
}

#[test]
fn slight_folds_show_in_lines_that_are_found() {
    for seed in 0..4 {
        let mut scene = small([flat, arc][seed % 2], VIEWS[seed / 2]);
        // By 14 degrees, across a corner.
        scene.fold = 0.25;
        let [_, page] = both(&scene, PRINT, seed as u128);
        let report = page.report();
        assert_eq!(
            report.verdict,
            PageVerdict::NotThisKind,
            "{seed}: {report:?}"
        );
        assert!(report.lines_found >= 20 && report.lines_disagreement > 0.09);
    }
}

#[test]
fn blank_pages_have_no_lines_and_are_not_checked() {
    let scene = small(s_curve, VIEWS[1]);
    let mut rng = Rand64::new(3);
    let edges = trace(&scene, HAND, &mut rng);
    let blank = Picture::new(scene.photo, &mut rng);
    let [bare, page] = pages(&scene, &edges, &blank);
    assert!(page.text().iter().all(Vec::is_empty));
    assert_eq!(page.report(), bare.report());
    assert_eq!(page.report().verdict, PageVerdict::Unchecked);
}

#[test]
fn lines_are_found_on_pages_that_are_read_from_their_side_and_on_both_pages_of_a_spread() {
    let scene = reduced(view(arc, [430.0, 15.0, 0.0, 90.0]));
    let mut rng = Rand64::new(4);
    let mut picture = Picture::new(scene.photo, &mut rng);
    // Lines along the rulings.
    for i in 0..30 {
        let s = 0.08 + 0.028 * f64::from(i);
        let mut t = 0.1;
        while t < 0.9 {
            let long = 0.004 + 0.005 * rng.rand_float();
            let corner = |ds: f64, dt: f64| scene.seen(0, s + ds, t + dt);
            picture.ink([
                corner(0.0, 0.0),
                corner(0.01, 0.0),
                corner(0.01, long),
                corner(0.0, long),
            ]);
            t += long + 0.002 + 0.006 * f64::from(u8::from(rng.rand_float() < 0.2));
        }
    }
    let [top, bottom] = points(&trace(&scene, HAND, &mut rng)[0]);
    let edges = [Edges::LeftRight {
        left: Trace::Points(bottom),
        right: Trace::Points(top),
    }];
    let [_, page] = pages(&scene, &edges, &picture);
    assert_eq!(page.report().verdict, PageVerdict::Unrolled);
    assert!(page.report().lines >= 20, "{:?}", page.report());

    let scene = reduced(Scene::new(&[mirrored_book, book]).tilted(600.0, 20.0, 5.0, 90.0));
    let mut edges = trace(&scene, HAND, &mut rng);
    let mut picture = Picture::new(scene.photo, &mut rng);
    for page in 0..2 {
        print(&scene, page, PRINT, &mut picture, &mut rng);
    }
    // The right page may be given first.
    edges.reverse();
    let [_, page] = pages(&scene, &edges, &picture);
    assert_eq!(page.report().verdict, PageVerdict::Unrolled);
    assert!(
        page.text().iter().all(|lines| lines.len() >= 15),
        "{:?}",
        page.report()
    );
    assert!(displacement(&page, &scene) < 0.3);
}
