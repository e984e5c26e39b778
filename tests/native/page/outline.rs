//! Outlines of pages in rendered photos, whose corners are known.

use developable::dewarp::{Photo, Verdict};
use developable::page::{
    Edges, Format, OutlineReason, OutlineReport, OutlineVerdict, PageOptions, PageOutline,
    PageSurface, Trace, find_outline, trace_edges,
};
use oorandom::Rand64;

use super::scene::normal;

type Colour = [f64; 3];
type Corners = [[f64; 2]; 4];

const SIZE: [usize; 2] = [1200, 1000];

/// A page seen at a slant.
const PAGE: Corners = [
    [310.0, 120.0],
    [880.0, 160.0],
    [960.0, 880.0],
    [230.0, 820.0],
];

const DARK: Colour = [60.0, 62.0, 66.0];
const PAPER: Colour = [232.0, 230.0, 226.0];

/// The projective map that takes the plane of the photo to the unit square of a page (Heckbert's, inverted).
struct ToPage([[f64; 3]; 3]);

impl ToPage {
    fn new([a, b, c, d]: Corners) -> Self {
        let sum = [0, 1].map(|k| a[k] - b[k] + c[k] - d[k]);
        let (u, v) = ([b[0] - c[0], b[1] - c[1]], [d[0] - c[0], d[1] - c[1]]);
        let area = u[0] * v[1] - u[1] * v[0];
        let g = (sum[0] * v[1] - sum[1] * v[0]) / area;
        let h = (u[0] * sum[1] - u[1] * sum[0]) / area;
        let row = |k: usize| [b[k] - a[k] + g * b[k], d[k] - a[k] + h * d[k], a[k]];
        let m = [row(0), row(1), [g, h, 1.0]];
        // The adjugate, which is the inverse up to its scale.
        let minor = |i: usize, j: usize| {
            let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1]
        };
        ToPage([0, 1, 2].map(|i| [0, 1, 2].map(|j| minor(j, i))))
    }

    fn apply(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [u, v, w] = self.0.map(|row| row[0] * x + row[1] * y + row[2]);
        [u / w, v / w]
    }
}

/// A letter: lines of words, of which the upper ones are more.
fn letter([u, v]: [f64; 2]) -> Colour {
    let (line, word) = ((v * 45.0) as usize, (u * 30.0) as usize);
    let is_text = (0.1..0.9).contains(&u)
        && (0.08..0.7).contains(&v)
        && (v * 45.0).fract() < 0.45
        && (line * 7 + word * 13) % 6 != 0
        && !(line.is_multiple_of(6) || (line % 5 == 4 && u > 0.5));
    if is_text { [50.0; 3] } else { PAPER }
}

/// A poster with broad bars of colour up to its border.
fn poster(place: [f64; 2]) -> Colour {
    let [u, v] = place;
    if (0.1..0.125).contains(&v) || (0.6..0.62).contains(&v) || (0.3..0.32).contains(&u) {
        [40.0, 60.0, 140.0]
    } else {
        letter(place)
    }
}

fn wood([x, y]: [f64; 2]) -> Colour {
    let grain = 1.0 + 0.08 * (0.11 * y + 2.0 * (0.004 * x).sin()).sin();
    let gap = if (y / 150.0).fract() < 0.02 { 0.5 } else { 1.0 };
    [150.0, 96.0, 48.0].map(|value| value * grain * gap)
}

fn tiles([x, y]: [f64; 2]) -> Colour {
    let odd = ((x / 130.0) as usize + (y / 130.0) as usize) % 2 == 1;
    if odd {
        [96.0, 70.0, 64.0]
    } else {
        [66.0, 78.0, 92.0]
    }
}

/// A cloth of checks, its white ones as bright as paper.
fn cloth([x, y]: [f64; 2]) -> Colour {
    let [u, v] = [0.95 * x + 0.3 * y, 0.95 * y - 0.3 * x].map(|at| (at / 30.0).floor() as i64);
    if (u + v).rem_euclid(2) == 0 {
        PAPER
    } else {
        [170.0, 40.0, 40.0]
    }
}

/// A photo: what is at each place, in light of a brightness, with noise of two levels of grey.
fn photo(colour: impl Fn([f64; 2]) -> Colour, light: impl Fn([f64; 2]) -> f64) -> Vec<u8> {
    let mut rng = Rand64::new(5);
    let [width, height] = SIZE;
    (0..width * height)
        .flat_map(|i| {
            let (x, y) = ((i % width) as f64, (i / width) as f64);
            let mut sum = [0.0; 3];
            for [dx, dy] in [[-0.25, -0.25], [0.25, -0.25], [-0.25, 0.25], [0.25, 0.25]] {
                let place = [x + dx, y + dy];
                let shade = light(place);
                let own = colour(place);
                (0..3).for_each(|k| sum[k] += 0.25 * own[k] * shade);
            }
            let [r, g, b] =
                sum.map(|value| (value + 2.0 * normal(&mut rng)).clamp(0.0, 255.0) as u8);
            [r, g, b, 255]
        })
        .collect()
}

/// Pages with a print, on a ground.
fn pages<'a>(
    all: &[Corners],
    print: impl Fn([f64; 2]) -> Colour + 'a,
    ground: impl Fn([f64; 2]) -> Colour + 'a,
) -> impl Fn([f64; 2]) -> Colour + 'a {
    let maps: Vec<ToPage> = all.iter().map(|corners| ToPage::new(*corners)).collect();
    move |place| {
        let on = maps
            .iter()
            .map(|map| map.apply(place))
            .find(|[u, v]| (0.0..1.0).contains(u) && (0.0..1.0).contains(v));
        on.map_or_else(|| ground(place), &print)
    }
}

fn even(_: [f64; 2]) -> f64 {
    1.0
}

/// A hard shadow across page and table, and a second one at a corner.
fn shadows([x, y]: [f64; 2]) -> f64 {
    let first = x + 0.6 * y < 780.0;
    let second = (x - 900.0).hypot(y - 800.0) < 170.0;
    if first || second { 0.45 } else { 1.0 }
}

fn found(rgba: &[u8]) -> OutlineReport {
    find_outline(&Photo::new(SIZE[0], SIZE[1], rgba).unwrap())
}

/// The largest distance of a corner from its true place, in pixels.
fn corner_error(outline: &PageOutline, truth: &Corners) -> f64 {
    (outline.corners.iter().zip(truth))
        .map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1]))
        .fold(0.0, f64::max)
}

/// The root mean square distance of the edges' points from the straight edges between the true corners, in pixels.
fn edge_error(outline: &PageOutline, truth: &Corners) -> f64 {
    let squares: Vec<f64> = (0..4)
        .flat_map(|k| {
            let (a, b) = (truth[k], truth[(k + 1) % 4]);
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            outline.edges[k].iter().map(move |p| {
                (((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / length).powi(2)
            })
        })
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn check(name: &str, rgba: &[u8], truth: &Corners) {
    let report = found(rgba);
    assert_eq!(
        report.verdict,
        OutlineVerdict::Found,
        "{name}: {:?}",
        report.reasons
    );
    assert!(report.reasons.is_empty());
    let (corner, edge) = (
        corner_error(&report.pages[0], truth),
        edge_error(&report.pages[0], truth),
    );
    // A reduced photo has pixels of two by two.
    assert!(
        corner < 2.0 && edge < 0.5,
        "{name}: corners {corner:.2}, edges {edge:.2}"
    );
}

#[test]
fn a_page_is_found_on_any_ground_and_under_hard_shadows() {
    let grey = |level: f64| move |_: [f64; 2]| [level; 3];
    check(
        "dark",
        &photo(pages(&[PAGE], letter, grey(60.0)), even),
        &PAGE,
    );
    check(
        "light",
        &photo(pages(&[PAGE], letter, grey(165.0)), even),
        &PAGE,
    );
    check("wood", &photo(pages(&[PAGE], letter, wood), even), &PAGE);
    check("tiles", &photo(pages(&[PAGE], letter, tiles), even), &PAGE);
    check(
        "shadow on wood",
        &photo(pages(&[PAGE], letter, wood), shadows),
        &PAGE,
    );
    check(
        "shadow on tiles",
        &photo(pages(&[PAGE], letter, tiles), shadows),
        &PAGE,
    );
    check(
        "print to the border",
        &photo(pages(&[PAGE], poster, grey(120.0)), even),
        &PAGE,
    );
}

#[test]
fn a_page_on_a_chequered_cloth_is_found() {
    let report = found(&photo(pages(&[PAGE], letter, cloth), even));
    assert_eq!(report.verdict, OutlineVerdict::Found);
    // A white check may lie at a corner.
    let error = corner_error(&report.pages[0], &PAGE);
    assert!(error < 25.0, "{error}");
}

/// Corners moved towards the middle of the page, or away from it, by a factor.
fn scaled(corners: &Corners, factor: f64) -> Corners {
    let middle = [0, 1].map(|k| corners.iter().map(|corner| corner[k]).sum::<f64>() / 4.0);
    corners.map(|corner| [0, 1].map(|k| middle[k] + factor * (corner[k] - middle[k])))
}

#[test]
fn a_crop_that_reaches_beyond_the_page_is_told_by_how_much() {
    let report = found(&photo(pages(&[PAGE], letter, wood), even));
    let page = &report.pages[0];
    // Within the page, and on its corners to a pixel or two of some 670.
    assert_eq!(page.overreach(&scaled(&PAGE, 0.9)), 0.0);
    assert!(page.overreach(&PAGE) < 0.005, "{}", page.overreach(&PAGE));
    // One corner straight to the left of a side that is nearly upright: its distance is known.
    let (a, d) = (PAGE[0], PAGE[3]);
    let side = (d[0] - a[0]).hypot(d[1] - a[1]);
    let middle = [0, 1].map(|k| 0.5 * (a[k] + d[k]));
    let outwards = [(a[1] - d[1]) / side, (d[0] - a[0]) / side];
    let beside = [0, 1].map(|k| middle[k] + 40.0 * outwards[k]);
    let area = (0..4)
        .map(|k| PAGE[k][0] * PAGE[(k + 1) % 4][1] - PAGE[(k + 1) % 4][0] * PAGE[k][1])
        .sum::<f64>()
        / 2.0;
    let (overreach, truth) = (page.overreach(&[beside]), 40.0 / area.sqrt());
    assert!(
        (overreach / truth - 1.0).abs() < 0.05,
        "{overreach} {truth}"
    );
    assert_eq!(
        Verdict::Unrolled.with_overreach(overreach),
        Verdict::Doubtful
    );
    assert_eq!(
        Verdict::Stretched.with_overreach(overreach),
        Verdict::Stretched
    );
    assert_eq!(
        Verdict::Unrolled.with_overreach(page.overreach(&PAGE)),
        Verdict::Unrolled
    );
}

#[test]
fn a_finger_at_an_edge_moves_no_corner() {
    let page = pages(&[PAGE], letter, |_| DARK);
    let finger = move |[x, y]: [f64; 2]| {
        let (u, v) = ((x - 930.0) / 110.0, (y - 500.0) / 28.0);
        if u * u + v * v < 1.0 {
            [205.0, 150.0, 120.0]
        } else {
            page([x, y])
        }
    };
    let report = found(&photo(finger, even));
    assert!(matches!(
        report.verdict,
        OutlineVerdict::Found | OutlineVerdict::Doubtful
    ));
    let error = corner_error(&report.pages[0], &PAGE);
    assert!(error < 4.0, "{error}");
}

/// Cups that lie over a corner, of the paper's colour and darker than the ground, and a corner that is folded over.
#[test]
fn a_covered_corner_is_said_and_lies_where_its_edges_would_meet() {
    let page = pages(&[PAGE], letter, wood);
    let cup = |colour: Colour, centre: [f64; 2]| {
        let page = &page;
        move |[x, y]: [f64; 2]| match (x - centre[0]).hypot(y - centre[1]) {
            away if away > 70.0 => page([x, y]),
            away if away > 60.0 => colour,
            _ => colour.map(|value| 0.85 * value),
        }
    };
    let folded = |[x, y]: [f64; 2]| {
        // The fold runs from 110 pixels before the upper right corner to as far below it.
        let beyond = (x - 770.0) - (y - 152.0);
        let is_over = beyond < 0.0 && x > 765.0 && y < 270.0 && beyond > -110.0;
        match beyond {
            beyond if beyond > 0.0 => wood([x, y]),
            _ if is_over => [190.0; 3],
            _ => page([x, y]),
        }
    };
    for (name, rgba) in [
        ("white cup", photo(cup([240.0; 3], [950.0, 870.0]), even)),
        (
            "dark cup",
            photo(cup([40.0, 30.0, 28.0], [318.0, 140.0]), even),
        ),
        ("folded over", photo(folded, even)),
    ] {
        let report = found(&rgba);
        assert_eq!(report.verdict, OutlineVerdict::Doubtful, "{name}");
        assert_eq!(report.reasons, [OutlineReason::CornerCovered], "{name}");
        let (corner, edge) = (
            corner_error(&report.pages[0], &PAGE),
            edge_error(&report.pages[0], &PAGE),
        );
        assert!(corner < 5.0 && edge < 1.0, "{name}: {corner:.2}, {edge:.2}");
    }
}

#[test]
fn a_corner_outside_of_the_photo_is_said_and_extrapolated() {
    let cut = [
        [150.0, 40.0],
        [880.0, 160.0],
        [800.0, 900.0],
        [-60.0, 640.0],
    ];
    let report = found(&photo(pages(&[cut], letter, wood), even));
    assert_eq!(report.verdict, OutlineVerdict::Doubtful);
    assert_eq!(report.reasons, [OutlineReason::CornerOutside]);
    let error = corner_error(&report.pages[0], &cut);
    assert!(error < 8.0, "{error}");
}

#[test]
fn two_pages_are_both_found() {
    let left = [[80.0, 200.0], [540.0, 180.0], [560.0, 820.0], [60.0, 800.0]];
    let right = left.map(|[x, y]| [x + 570.0, 1.05 * y - 30.0]);
    let report = found(&photo(pages(&[left, right], letter, wood), even));
    assert_eq!(report.verdict, OutlineVerdict::Several);
    assert_eq!(report.pages.len(), 2);
    for truth in [left, right] {
        assert!(
            report
                .pages
                .iter()
                .any(|page| corner_error(page, &truth) < 2.0)
        );
    }
}

#[test]
fn a_table_without_a_page_has_none() {
    type Ground = fn([f64; 2]) -> Colour;
    let grounds: [(&str, Ground); 5] = [
        ("wood", wood),
        ("tiles", tiles),
        ("grey", |_| DARK),
        ("cloth", cloth),
        ("larger checks", |[x, y]| cloth([0.5 * x, 0.5 * y])),
    ];
    for (name, ground) in grounds {
        for light in [even, shadows] {
            let report = found(&photo(ground, light));
            assert_eq!(report.verdict, OutlineVerdict::NotFound, "{name}");
            assert!(report.reasons.contains(&OutlineReason::NoPage));
            assert!(report.page().is_err());
        }
    }
}

/// Uneven light, with a thin shadow below and to the right of the page and a thin bright line at its other edges.
fn thin_shadow([x, y]: [f64; 2]) -> f64 {
    let [u, v] = ToPage::new(PAGE).apply([x, y]);
    let beside = |a: f64, b: f64, range: std::ops::Range<f64>| {
        range.contains(&a) && (-0.006..1.008).contains(&b)
    };
    let shadow = beside(u, v, 1.0..1.008) || beside(v, u, 1.0..1.008);
    let lit = beside(u, v, -0.006..0.0) || beside(v, u, -0.006..0.0);
    let uneven = 0.9 - 0.2 * x / SIZE[0] as f64;
    uneven
        * if shadow {
            0.75
        } else if lit {
            0.9
        } else {
            1.0
        }
}

#[test]
fn white_on_white_is_found_by_its_print_in_coloured_light() {
    // A lamp without red, whose channel is noise, a bar that is the longest straight edge, and sides that bulge.
    let bulge = |y: f64| 45.0 * (0.006 * y).sin();
    let print = |[u, v]: [f64; 2]| {
        let is_bar = (0.05..0.95).contains(&u) && (0.3..0.325).contains(&v);
        if is_bar { [30.0; 3] } else { letter([u, v]) }
    };
    let page = pages(&[PAGE], print, |_| PAPER);
    let lamp = |[x, y]: [f64; 2]| {
        let [r, g, b] = page([x + bulge(y), y]);
        [0.01 * r, 0.8 * g, 0.9 * b]
    };
    let report = found(&photo(lamp, |[x, y]| thin_shadow([x + bulge(y), y])));
    assert_eq!(report.verdict, OutlineVerdict::Doubtful);
    assert!(corner_error(&report.pages[0], &PAGE.map(|[x, y]| [x - bulge(y), y])) < 15.0);
}

#[test]
fn white_on_white_is_doubtful_or_not_found_but_never_taken_wrongly() {
    let report = found(&photo(pages(&[PAGE], letter, |_| PAPER), thin_shadow));
    assert_eq!(report.verdict, OutlineVerdict::Doubtful);
    assert!(report.reasons.contains(&OutlineReason::FaintEdge));
    let error = corner_error(&report.pages[0], &PAGE);
    // The shadow is taken for the edge: 1 % of the photo's diagonal.
    assert!(error < 15.0, "{error}");
    // Without any shadow there is nothing to be seen.
    let report = found(&photo(pages(&[PAGE], letter, |_| PAPER), even));
    assert_eq!(report.verdict, OutlineVerdict::NotFound);
}

#[test]
fn a_page_that_lies_sideways_is_turned_by_its_print() {
    // The page's upper left corner is at the photo's lower left, and the other way round.
    for turn in [1, 3] {
        let mut turned = PAGE;
        turned.rotate_left(turn);
        check(
            "sideways",
            &photo(pages(&[turned], letter, wood), even),
            &turned,
        );
    }
}

/// A page that is printed evenly, a little more in its lower half: short letters, of which every third goes on above the others.
fn prose([u, v]: [f64; 2]) -> Colour {
    let (letter, line, row) = ((u * 50.0) as usize, (v * 24.0) as usize, (v * 24.0).fract());
    let is_long = (letter + line * line).is_multiple_of(3);
    let height = if is_long { 0.65 } else { 0.35 };
    let is_text = (0.1..0.9).contains(&u)
        && (0.1..0.94).contains(&v)
        && (letter * 5 + line * 3) % 7 != 0
        && (0.8 - height..0.8).contains(&row);
    if is_text { [50.0; 3] } else { PAPER }
}

#[test]
fn a_page_that_lies_sideways_has_the_long_letters_up() {
    for turn in [1, 3] {
        let mut turned = PAGE;
        turned.rotate_left(turn);
        let page = photo(pages(&[turned], prose, wood), even);
        check("prose", &page, &turned);
    }
}

#[test]
fn a_page_is_not_turned_by_a_picture() {
    // Lines of words above a picture of upright bars.
    let cover = |[u, v]: [f64; 2]| match (0.1..0.9).contains(&u) && (0.45..0.95).contains(&v) {
        true if (u * 20.0).fract() < 0.5 => [50.0; 3],
        false if v < 0.4 => letter([u, v]),
        _ => PAPER,
    };
    check("cover", &photo(pages(&[PAGE], cover, wood), even), &PAGE);
}

#[test]
fn a_wide_page_is_not_turned_by_its_print() {
    // A card that is four times as wide as high, with three lines of words.
    let card = [
        [120.0, 380.0],
        [1080.0, 390.0],
        [1085.0, 630.0],
        [115.0, 620.0],
    ];
    let words = |[u, v]: [f64; 2]| {
        let word = (u * 40.0) as usize;
        let is_text = (0.08..0.92).contains(&u)
            && (0.2..0.8).contains(&v)
            && ((v - 0.2) * 5.0).fract() < 0.5
            && !(word + (v * 5.0) as usize).is_multiple_of(4);
        if is_text { [50.0; 3] } else { PAPER }
    };
    check("card", &photo(pages(&[card], words, wood), even), &card);
}

/// Corners in the photo of a sheet of A4 on a table that a camera looks at from 30° above it: seen from its lower edge, and seen
/// from its left one.
fn foreshortened() -> [Corners; 2] {
    [[210.0, 297.0], [297.0, 210.0]].map(|[width, height]| {
        let (sin, cos) = 60.0_f64.to_radians().sin_cos();
        let seen = |x: f64, y: f64| {
            let depth = 380.0 - sin * y;
            [600.0 + 1080.0 * x / depth, 500.0 + 1080.0 * cos * y / depth]
        };
        let (x, y) = (0.5 * width, 0.5 * height);
        [seen(-x, -y), seen(x, -y), seen(x, y), seen(-x, y)]
    })
}

#[test]
fn perspective_neither_turns_a_page_nor_stretches_it() {
    let [upright, mut sideways] = foreshortened();
    sideways.rotate_left(1);
    for corners in [upright, sideways] {
        let rgba = photo(pages(&[corners], letter, wood), even);
        let report = found(&rgba);
        let error = corner_error(&report.pages[0], &corners);
        assert!(error < 4.0, "{error} {corners:?}");
        let edges = [report.pages[0].to_edges()];
        let photo = Photo::new(SIZE[0], SIZE[1], &rgba).unwrap();
        let options = PageOptions::default().format(Format::A4);
        let [width, height] = PageSurface::in_photo(&edges, &[], &photo, &options)
            .unwrap()
            .flat_size();
        assert!((width - 210.0).abs() < 1.0 && (height - 297.0).abs() < 1.0);
    }
}

/// A page that is folded in thirds, so that its outline is far from a rectangle.
#[test]
fn a_clear_outline_is_not_refused_for_its_shape() {
    let shift = |v: f64| 170.0 * ((3.0 * v).rem_euclid(2.0) - 1.0).abs();
    let inside = |[x, y]: [f64; 2]| {
        let v = (y - 120.0) / 760.0;
        let u = (x - 250.0 - shift(v)) / 540.0;
        ((0.0..1.0).contains(&u) && (0.0..1.0).contains(&v)).then_some([u, v])
    };
    let colour = |place: [f64; 2]| inside(place).map_or_else(|| wood(place), letter);
    let report = found(&photo(colour, even));
    assert_eq!(report.verdict, OutlineVerdict::Doubtful);
    let truth = [
        [420.0, 120.0],
        [960.0, 120.0],
        [790.0, 880.0],
        [250.0, 880.0],
    ];
    let error = corner_error(&report.pages[0], &truth);
    assert!(error < 4.0, "{error}");
}

#[test]
fn photos_of_any_size_and_content_are_answered() {
    let mut rng = Rand64::new(9);
    for (width, height) in [
        (1, 1),
        (1, 50),
        (2, 3),
        (17, 9),
        (40, 40),
        (801, 2),
        (3, 900),
        (200, 150),
    ] {
        for content in 0..3 {
            let rgba: Vec<u8> = (0..4 * width * height)
                .map(|i| match content {
                    0 => 0,
                    1 => 255,
                    _ => (rng.rand_u64() >> 56) as u8 ^ (i % 3) as u8,
                })
                .collect();
            let report = find_outline(&Photo::new(width, height, &rgba).unwrap());
            assert_eq!(
                report.verdict,
                OutlineVerdict::NotFound,
                "{width} × {height}"
            );
        }
    }
}

/// A page that is bent, on tiles: its upper and lower edge rise by `BOW` pixels in the middle.
fn bowed([x, y]: [f64; 2]) -> Colour {
    let u = (x - 300.0) / 600.0;
    let v = (y - 280.0 + bow(u)) / 600.0;
    if (0.0..1.0).contains(&u) && (0.0..1.0).contains(&v) {
        letter([u, v])
    } else {
        tiles([x, y])
    }
}

fn bow(u: f64) -> f64 {
    130.0 * (std::f64::consts::PI * u).sin()
}

fn given_corners([a, b, c, d]: Corners) -> Edges {
    let edge = |from: [f64; 2], to: [f64; 2]| Trace::Points(vec![from, to]);
    Edges::All {
        top: edge(a, b),
        bottom: edge(d, c),
        left: edge(a, d),
        right: edge(b, c),
    }
}

#[test]
fn edges_between_given_corners_follow_the_paper() {
    let rgba = photo(bowed, shadows);
    let photo = Photo::new(SIZE[0], SIZE[1], &rgba).unwrap();
    let corners = [
        [300.0, 280.0],
        [900.0, 280.0],
        [900.0, 880.0],
        [300.0, 880.0],
    ];
    // Corners are set by hand, and some pixels off.
    let mut rng = Rand64::new(43);
    let by_hand = corners.map(|corner| corner.map(|at: f64| at + 3.0 * normal(&mut rng)));
    let traced = trace_edges(&photo, &[given_corners(by_hand)]);
    let [top, bottom, left, right] = traced[0].traces()[..] else {
        panic!("four edges");
    };
    let off = |trace: &Trace, error: &dyn Fn([f64; 2]) -> f64| {
        let Trace::Points(points) = trace else {
            panic!("points");
        };
        assert!(points.len() > 50, "{} points", points.len());
        // Beside the corners the edges run to where these were set.
        let inner = points.iter().filter(|p| {
            by_hand
                .iter()
                .all(|c| (p[0] - c[0]).hypot(p[1] - c[1]) > 30.0)
        });
        inner.map(|p| error(*p).abs()).fold(0.0, f64::max)
    };
    let level = |y: f64| move |p: [f64; 2]| p[1] - y + bow((p[0] - 300.0) / 600.0);
    let upright = |x: f64| move |p: [f64; 2]| p[0] - x;
    let errors = [
        off(top, &level(280.0)),
        off(bottom, &level(880.0)),
        off(left, &upright(300.0)),
        off(right, &upright(900.0)),
    ];
    // The corners are put right, too.
    if let Trace::Points(points) = left {
        for (point, truth) in [
            (points[0], corners[0]),
            (points[points.len() - 1], corners[3]),
        ] {
            let off = (point[0] - truth[0]).hypot(point[1] - truth[1]);
            assert!(off < 2.0, "{point:?} for {truth:?}");
        }
    }
    // The chord is 130 pixels off.
    assert!(errors.iter().all(|off| *off < 3.5), "{errors:?}");
}

#[test]
fn edges_that_cannot_be_seen_stay_straight_and_given_ones_as_they_are() {
    let blank = photo(|_| PAPER, even);
    let photo = Photo::new(SIZE[0], SIZE[1], &blank).unwrap();
    let unseen = given_corners(PAGE);
    assert_eq!(trace_edges(&photo, std::slice::from_ref(&unseen)), [unseen]);
    let rgba = self::photo(bowed, even);
    let photo = Photo::new(SIZE[0], SIZE[1], &rgba).unwrap();
    let by_three = |y: f64| Trace::Points(vec![[300.0, y], [600.0, y - 40.0], [900.0, y]]);
    let given = Edges::TopBottom {
        top: by_three(280.0),
        bottom: by_three(880.0),
    };
    assert_eq!(trace_edges(&photo, std::slice::from_ref(&given)), [given]);
}
