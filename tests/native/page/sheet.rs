//! Sheets of any shape: pages of known geometry, rendered with lines of print as a pinhole camera sees them.

use developable::dewarp::{DewarpOptions, Photo};
use developable::page::{
    Edges, FocalLength, Format, PageDoubt, PageModel, PageOptions, PageReport, PageSurface,
    PageVerdict, Ruler, Trace,
};
use oorandom::Rand64;

use crate::native::common::similarity;

/// A page of width 1 in space: an isometric map of its plane.
type Shape = fn(f64, f64) -> [f64; 3];

const HEIGHT: f64 = std::f64::consts::SQRT_2;
const PHOTO: [usize; 2] = [900, 1200];
const FOCAL: f64 = 1100.0;

fn flat(x: f64, y: f64) -> [f64; 3] {
    [x, y, 0.0]
}

/// An arc of a circle over the diagonal direction with slopes `a` and `b`.
fn arc(x: f64, y: f64, [a, b]: [f64; 2], radius: f64) -> [f64; 3] {
    let (along, across) = (a * (x - 0.5) + b * (y - 0.7), a * (y - 0.7) - b * (x - 0.5));
    let turned = radius * (along / radius).sin();
    [
        0.5 + a * turned - b * across,
        0.7 + b * turned + a * across,
        radius * ((along / radius).cos() - 1.0),
    ]
}

fn curled(x: f64, y: f64) -> [f64; 3] {
    arc(x, y, [1.0, 0.0], 0.8)
}

fn curled_askew(x: f64, y: f64) -> [f64; 3] {
    arc(x, y, [0.8, 0.6], 1.0)
}

/// A cone whose apex is above the page's upper edge.
fn cone(x: f64, y: f64) -> [f64; 3] {
    const APEX: [f64; 2] = [0.5, -1.6];
    const SINE: f64 = 0.5;
    let (dx, dy) = (x - APEX[0], y - APEX[1]);
    let (radius, angle) = (dx.hypot(dy), dx.atan2(dy) / SINE);
    let slope = (1.0 - SINE * SINE).sqrt();
    // Turned about the horizontal axis, so that the middle ruling lies in the plane.
    let (out, up) = (radius * SINE * angle.cos(), radius * slope);
    [
        APEX[0] + radius * SINE * angle.sin(),
        APEX[1] + SINE * out + slope * up,
        slope * out - SINE * up,
    ]
}

/// A letter folded in thirds that has been opened.
fn thirds(x: f64, y: f64) -> [f64; 3] {
    let third = HEIGHT / 3.0;
    let (sine, cosine) = 0.35f64.sin_cos();
    match (y / third) as usize {
        0 => [x, third - (third - y) * cosine, (third - y) * -sine],
        1 => [x, y, 0.0],
        _ => [
            x,
            2.0 * third + (y - 2.0 * third) * cosine,
            (y - 2.0 * third) * -sine,
        ],
    }
}

/// Place in the photo, in pixels, of a point of a page that is tilted before the camera.
fn seen(shape: Shape, share: [f64; 2]) -> [f64; 2] {
    let [x, y, z] = shape(share[0], share[1] * HEIGHT);
    let (sine, cosine) = 0.4f64.sin_cos();
    let (x, y) = (x - 0.5, y - 0.7);
    let depth = 2.1 - sine * y - cosine * z;
    let down = cosine * y - sine * z;
    [449.5 + FOCAL * x / depth, 599.5 + FOCAL * down / depth]
}

/// The four edges, traced with a hand's errors in pixels.
fn edges(shape: Shape, error: f64) -> Edges {
    let mut rng = Rand64::new(5);
    let mut edge = |at: fn(f64) -> [f64; 2]| {
        let point = |i: usize| {
            let [x, y] = seen(shape, at(i as f64 / 60.0));
            let mut off = || error * (2.0 * rng.rand_float() - 1.0);
            [x + off(), y + off()]
        };
        let mut point = point;
        Trace::Points((0..=60).map(&mut point).collect())
    };
    Edges::All {
        top: edge(|t| [t, 0.0]),
        bottom: edge(|t| [t, 1.0]),
        left: edge(|t| [0.0, t]),
        right: edge(|t| [1.0, t]),
    }
}

/// Grey of the page at a place: lines of words on white paper.
fn print([x, y]: [f64; 2]) -> f64 {
    let line = (y * 30.0).fract();
    let word = (x * 17.0 + (y * 30.0).floor() * 0.37).fract();
    let inside = (0.1..0.9).contains(&x) && (0.06..0.94).contains(&y);
    if inside && line < 0.3 && word < 0.85 {
        60.0
    } else {
        225.0
    }
}

/// The photo of a page, with or without print.
fn photo(shape: Shape, printed: bool) -> Vec<u8> {
    let mut sums = vec![[0.0; 2]; PHOTO[0] * PHOTO[1]];
    const SHEET_SAMPLES: [usize; 2] = [1300, 1900];
    for i in 0..SHEET_SAMPLES[0] * SHEET_SAMPLES[1] {
        let at = [i % SHEET_SAMPLES[0], i / SHEET_SAMPLES[0]];
        let share = [0, 1].map(|k| (at[k] as f64 + 0.5) / SHEET_SAMPLES[k] as f64);
        let [x, y] = seen(shape, share).map(|v| v.round() as usize);
        let sum = &mut sums[y * PHOTO[0] + x];
        sum[0] += if printed { print(share) } else { 225.0 };
        sum[1] += 1.0;
    }
    (sums.iter())
        .flat_map(|[sum, count]| {
            let grey = if *count > 0.0 {
                (sum / count) as u8
            } else {
                90
            };
            [grey, grey, grey, 255]
        })
        .collect()
}

fn known() -> PageOptions {
    let options = PageOptions::default().focal_length(FocalLength::Pixels(FOCAL));
    options.format(Format::A4)
}

/// Root mean square displacement on the flat page, in % of its width, and the report.
fn fitted(shape: Shape, printed: bool) -> (f64, PageReport) {
    let pixels = photo(shape, printed);
    let photo = Photo::new(PHOTO[0], PHOTO[1], &pixels).unwrap();
    let page = PageSurface::in_photo(&[edges(shape, 0.4)], &[], &photo, &known()).unwrap();
    let map = page.warp_map(&DewarpOptions::default().dots(0.5)).unwrap();
    let width = {
        let [left, right] = [0.0, 1.0].map(|x| seen(shape, [x, 0.5]));
        (left[0] - right[0]).hypot(left[1] - right[1])
    };
    let mut sum = 0.0;
    for (i, place) in map.places().iter().enumerate() {
        let share = [
            ((i % map.width()) as f64 + 0.5) / map.width() as f64,
            ((i / map.width()) as f64 + 0.5) / map.height() as f64,
        ];
        let truth = seen(shape, share);
        sum += (0..2)
            .map(|k| (f64::from(place[k]) - truth[k]).powi(2))
            .sum::<f64>();
    }
    let error = 100.0 * (sum / map.places().len() as f64).sqrt() / width;
    let report = *page.report();
    println!("{error:.3} {report:?}");
    (error, report)
}

#[test]
fn shapes_are_isometric() {
    for shape in [curled as Shape, curled_askew, cone, thirds] {
        for (x, y) in [(0.2, 0.2), (0.5, 0.7), (0.9, 1.3)] {
            let at = shape(x, y);
            let step = |dx: f64, dy: f64| {
                let moved = shape(x + 1e-5 * dx, y + 1e-5 * dy);
                [0, 1, 2].map(|k| (moved[k] - at[k]) / 1e-5)
            };
            let (a, b) = (step(1.0, 0.0), step(0.0, 1.0));
            let dot = |p: [f64; 3], q: [f64; 3]| (0..3).map(|k| p[k] * q[k]).sum::<f64>();
            for (found, expected) in [(dot(a, a), 1.0), (dot(b, b), 1.0), (dot(a, b), 0.0)] {
                assert!((found - expected).abs() < 1e-3, "{found} {expected}");
            }
        }
    }
}

#[test]
fn a_plane_stays_a_plane() {
    for printed in [true, false] {
        let (error, report) = fitted(flat, printed);
        assert!(error < 0.2, "{error}");
        assert_eq!(
            (report.model, report.verdict),
            (PageModel::Plane, PageVerdict::Flat)
        );
    }
}

#[test]
fn known_sheets_are_found() {
    for (shape, most) in [
        (curled as Shape, 0.9),
        (curled_askew, 6.2),
        (cone, 0.5),
        (thirds, 0.5),
    ] {
        let (error, report) = fitted(shape, true);
        assert!(error < most, "{error}");
        assert_ne!(report.model, PageModel::Plane);
        assert!(report.lines > 8, "{report:?}");
    }
}

/// Root mean square displacements after the best similarity, in % of the width shown, of a photo that a page fills and of what its
/// print alone makes of it; and the report.
fn fitted_by_print(shape: Shape) -> ([f64; 2], PageReport) {
    // The middle of the photo, about its principal point.
    const MARGIN: [usize; 2] = [270, 320];
    let size = [0, 1].map(|k| PHOTO[k] - 2 * MARGIN[k]);
    let pixels: Vec<u8> = (photo(shape, true).chunks_exact(4 * PHOTO[0]))
        .skip(MARGIN[1])
        .take(size[1])
        .flat_map(|row| row[4 * MARGIN[0]..4 * (MARGIN[0] + size[0])].to_vec())
        .collect();
    let cropped = Photo::new(size[0], size[1], &pixels).unwrap();
    let options = PageOptions::default().focal_length(FocalLength::Pixels(FOCAL));
    let page = PageSurface::by_print(&cropped, &options).unwrap();
    let [photographed, flattened] = [true, false].map(|is_photographed| {
        let pairs: Vec<_> = (0..400)
            .map(|i| {
                let share = [i % 20, i / 20].map(|k| (k as f64 + 0.5) / 20.0);
                let place = match is_photographed {
                    true => [0, 1].map(|k| share[k] * size[k] as f64 - 0.5),
                    false => page.photo_place(share),
                };
                let whole = match is_photographed {
                    true => place,
                    false => [0, 1].map(|k| share[k] * page.flat_size()[k]),
                };
                let [x, y] = on_page(shape, [0, 1].map(|k| place[k] + MARGIN[k] as f64));
                (whole, [x, HEIGHT * y])
            })
            .collect();
        let shown = pairs.iter().map(|(_, [x, _])| *x);
        let width = shown.clone().fold(f64::MIN, f64::max) - shown.fold(f64::MAX, f64::min);
        100.0 * similarity(&pairs) / width
    });
    println!("{photographed} {flattened} {:?}", page.report());
    ([photographed, flattened], *page.report())
}

/// Place on the page, as shares of its sides, of a pixel of the photo: Newton's method.
fn on_page(shape: Shape, pixel: [f64; 2]) -> [f64; 2] {
    const STEP: f64 = 1e-4;
    let mut at = [0.5, 0.5];
    for _ in 0..20 {
        let here = seen(shape, at);
        let [s, t] = [[STEP, 0.0], [0.0, STEP]].map(|step| {
            let moved = seen(shape, [at[0] + step[0], at[1] + step[1]]);
            [0, 1].map(|k| (moved[k] - here[k]) / STEP)
        });
        let off = [0, 1].map(|k| pixel[k] - here[k]);
        let area = s[0] * t[1] - s[1] * t[0];
        at[0] += (off[0] * t[1] - off[1] * t[0]) / area;
        at[1] += (s[0] * off[1] - s[1] * off[0]) / area;
    }
    at
}

#[test]
fn a_page_that_fills_the_photo_is_flattened_by_its_print() {
    for (shape, most) in [(curled as Shape, 0.5), (cone, 0.8)] {
        let ([photographed, flattened], report) = fitted_by_print(shape);
        let share = flattened / photographed;
        assert!(share < most && report.lines > 8, "{share} {report:?}");
        assert!(flattened < report.error_bound, "{flattened} {report:?}");
        let word = (report.verdict, report.doubt);
        assert_eq!(word, (PageVerdict::Doubtful, Some(PageDoubt::LargeError)));
    }
}

#[test]
fn a_ruler_beside_a_sheet_is_refused_in_plain_numbers() {
    let pixels = photo(thirds, true);
    let photo = Photo::new(PHOTO[0], PHOTO[1], &pixels).unwrap();
    let ruler = Ruler {
        from: [0.0; 2],
        to: [10.0; 2],
        length: 1.0,
    };
    let options = PageOptions::default().focal_length(FocalLength::Pixels(FOCAL));
    let error = PageSurface::in_photo(&[edges(thirds, 0.4)], &[], &photo, &options.ruler(ruler))
        .unwrap_err();
    let text = error.to_string();
    assert!(text.contains("begin and end on the page"), "{text}");
    assert!(text.contains("[0, 0]") && !text.contains("0.0"), "{text}");
}

#[test]
fn a_sheet_without_lines_is_not_trusted() {
    let (_, report) = fitted(curled_askew, false);
    let is_trusted = matches!(report.verdict, PageVerdict::Flat | PageVerdict::Unrolled);
    assert!(!is_trusted && report.lines == 0, "{report:?}");
}

#[test]
fn edges_of_no_sheet_are_not_trusted() {
    let pixels = photo(flat, true);
    let photo = Photo::new(PHOTO[0], PHOTO[1], &pixels).unwrap();
    let Edges::All {
        top, bottom, left, ..
    } = edges(flat, 0.0)
    else {
        unreachable!()
    };
    // The right edge was drawn around a shadow.
    let right = Trace::Points(
        (0..=60)
            .map(|i| {
                let [x, y] = seen(flat, [1.0, i as f64 / 60.0]);
                [x + 120.0 * (0.1 * i as f64).sin().abs(), y]
            })
            .collect(),
    );
    let wrong = Edges::All {
        top,
        bottom,
        left,
        right,
    };
    match PageSurface::in_photo(&[wrong], &[], &photo, &known()) {
        Ok(page) => assert!(
            matches!(
                page.report().verdict,
                PageVerdict::Doubtful | PageVerdict::NotThisKind
            ),
            "{:?}",
            page.report()
        ),
        Err(error) => assert_eq!(error.code(), "EDGES"),
    }
}

/// Edges as a detector finds them: all of a page's horizontal edges bow alike, by some pixels in the middle.
fn bowed_edges(shape: Shape, bow: f64) -> Edges {
    let edge = |at: fn(f64) -> [f64; 2], bow: f64| {
        let point = |i: usize| {
            let share = i as f64 / 60.0;
            let [x, y] = seen(shape, at(share));
            [x, y + 4.0 * bow * share * (1.0 - share)]
        };
        Trace::Points((0..=60).map(point).collect())
    };
    Edges::All {
        top: edge(|t| [t, 0.0], bow),
        bottom: edge(|t| [t, 1.0], bow),
        left: edge(|t| [0.0, t], 0.0),
        right: edge(|t| [1.0, t], 0.0),
    }
}

/// Outlines of flat pages bow by errors of their detection or of the lens; without lines of print nothing contradicts a
/// cylinder there, but a plane is as likely.
#[test]
fn a_small_bow_of_the_outline_alone_bends_no_page() {
    let options = PageOptions::default().format(Format::A4);
    for (shape, bow, model) in [
        (flat as Shape, 1.6, PageModel::Plane),
        (curled, 0.0, PageModel::Cylinder),
    ] {
        let pixels = photo(shape, false);
        let photo = Photo::new(PHOTO[0], PHOTO[1], &pixels).unwrap();
        let edges = bowed_edges(shape, bow);
        let page = PageSurface::in_photo(&[edges], &[], &photo, &options).unwrap();
        let report = page.report();
        assert_eq!((report.model, report.lines), (model, 0), "{report:?}");
    }
}

#[test]
fn the_plainest_model_is_taken() {
    for (shape, model) in [(flat as Shape, PageModel::Plane), (cone, PageModel::Sheet)] {
        let pixels = photo(shape, true);
        let photo = Photo::new(PHOTO[0], PHOTO[1], &pixels).unwrap();
        let page = PageSurface::in_photo(&[edges(shape, 0.4)], &[], &photo, &known()).unwrap();
        assert_eq!(page.report().model, model, "{:?}", page.report());
        let [width, height] = page.flat_size();
        assert!(
            page.is_millimetres() && (width - 210.0).abs() < 1.0,
            "{width}"
        );
        assert!((height - 297.0).abs() < 1.5, "{height}");
        let mesh = page.mesh().unwrap();
        assert_eq!(mesh.uvs().unwrap().len(), mesh.positions().len());

        // Bands of rows, each by its own map, make the image of the whole map.
        let options = DewarpOptions::default().dots(0.5);
        let warp = page.warp().unwrap();
        let flat = warp.pixel_grid(PHOTO, &options).unwrap();
        let map = warp.warp_map(PHOTO, &options).unwrap();
        assert_eq!([map.width(), map.height()], [flat.width, flat.height]);
        assert_eq!(
            (map.resolution(), map.corner()),
            (flat.resolution, flat.corner)
        );
        let mut image = vec![0; 4 * flat.width * flat.height];
        for rows in [0..1, 1..40, 40..flat.height] {
            let bytes = 4 * flat.width * rows.start..4 * flat.width * rows.end;
            warp.image_rows(&flat, &photo, rows, &mut image[bytes])
                .unwrap();
        }
        assert!(image == map.image(&photo).unwrap());
    }
}
