//! Photos of synthetic pages made flat, against where things are on the page.

use crate::native::common::{noisy, unit_square};
use developable::dewarp::{DewarpOptions, Extent, Photo, Registration, Verdict, WarpMap};
use developable::unroll::{UnrollOptions, unroll};
use developable::{Heightfield, Options, fit};

const RADIUS: f64 = 0.7;

/// An upright page, curled about a vertical axis: symmetric, so that the sheet is where the page is.
fn curled() -> Heightfield {
    unit_square(200, |x, _| (RADIUS * RADIUS - (x - 0.5).powi(2)).sqrt())
}

/// Where a point that is seen at `x` lies on the page.
fn on_page(x: f64) -> f64 {
    0.5 + RADIUS * ((x - 0.5) / RADIUS).asin()
}

const UNIT: Extent = Extent {
    min: [0.0; 2],
    max: [1.0; 2],
};

fn map_of(surface: &Heightfield, options: &DewarpOptions) -> WarpMap {
    let sheet = unroll(surface, &UnrollOptions::default()).unwrap();
    WarpMap::new(&sheet, UNIT, [1000, 1000], options).unwrap()
}

/// Largest distance between where a pixel of the flat image is and where what it shows lies on the
/// page, but for a shift.
fn error(map: &WarpMap) -> f64 {
    let mut differences = Vec::new();
    for row in 0..map.height() {
        for col in 0..map.width() {
            let [px, py] = map.places()[row * map.width() + col].map(f64::from);
            if !px.is_nan() {
                // Pixels of the photo to the plane, and from there to the page.
                let (x, y) = ((px + 0.5) / 1000.0, 1.0 - (py + 0.5) / 1000.0);
                let [left, top] = map.corner();
                let u = left + (col as f64 + 0.5) / map.resolution();
                let v = top - (row as f64 + 0.5) / map.resolution();
                differences.push([u - on_page(x), v - y]);
            }
        }
    }
    let n = differences.len() as f64;
    let mean = [0, 1].map(|k| differences.iter().map(|d| d[k]).sum::<f64>() / n);
    let far = |d: &[f64; 2]| (d[0] - mean[0]).hypot(d[1] - mean[1]);
    differences.iter().map(far).fold(0.0, f64::max)
}

#[test]
fn a_curled_page_is_flat_again_to_a_fifth_of_a_percent() {
    let map = map_of(&curled(), &DewarpOptions::default());
    assert_eq!(map.resolution(), 1000.0);
    // As wide as the arc, or a cell more at each side.
    let arc = on_page(1.0) - on_page(0.0);
    let cells = (map.width() as f64 / 1000.0 - arc) * 200.0;
    assert!((0.0..3.0).contains(&cells), "{cells}");
    let exact = error(&map);
    println!("exact {exact:.1e}");
    assert!(exact < 2e-4, "{exact}");

    let range = RADIUS - (RADIUS * RADIUS - 0.25f64).sqrt();
    let input = noisy(&curled(), 0.01 * range * 3f64.sqrt(), 3);
    let surface = fit(&input, &Options::paper()).unwrap();
    let solved = error(&map_of(surface.heightfield(), &DewarpOptions::default()));
    println!("solved {solved:.1e}");
    assert!(solved < 0.002, "{solved}");
}

#[test]
fn every_pixel_within_the_outline_has_a_place_and_trimming_leaves_only_these() {
    let map = map_of(&curled(), &DewarpOptions::default().dots(400.0));
    let there =
        |map: &WarpMap, row: usize, col: usize| !map.places()[row * map.width() + col][0].is_nan();
    for row in 4..map.height() - 4 {
        assert!(
            (4..map.width() - 4).all(|col| there(&map, row, col)),
            "row {row}"
        );
    }
    let trimmed = map_of(&curled(), &DewarpOptions::default().dots(400.0).trim(true));
    assert!((0..trimmed.height()).all(|r| (0..trimmed.width()).all(|c| there(&trimmed, r, c))));
    assert!(trimmed.width() > map.width() - 8 && trimmed.height() > map.height() - 8);
    // The same places at the same points of the sheet.
    let [dx, dy] = [0, 1].map(|k| (trimmed.corner()[k] - map.corner()[k]).abs() * 400.0);
    let (dx, dy) = (dx.round() as usize, dy.round() as usize);
    let whole = map.places()[(dy + 5) * map.width() + dx + 7];
    assert_eq!(trimmed.places()[5 * trimmed.width() + 7], whole);
}

#[test]
fn lines_on_the_page_are_straight_and_evenly_spaced_in_the_flat_image() {
    // Dark upright lines every tenth of the page, as the camera sees them.
    let size = 1000;
    let rgba: Vec<u8> = (0..size * size)
        .flat_map(|i| {
            let u = on_page((i % size) as f64 / size as f64 + 0.0005);
            let distance = (u * 10.0 - (u * 10.0).round()).abs() / 10.0;
            let grey = (255.0 * (distance / 0.01).min(1.0)) as u8;
            [grey, grey, grey, 255]
        })
        .collect();
    let photo = Photo::new(size, size, &rgba).unwrap();
    let map = map_of(&curled(), &DewarpOptions::default());
    let flat = map.image(&photo).unwrap();
    // The centre of each line by the mean of its darkness.
    for row in [20, map.height() / 2, map.height() - 20] {
        for line in 1..10 {
            let expected = (f64::from(line) / 10.0 - map.corner()[0]) * 1000.0 - 0.5;
            let around = expected as usize - 12..expected as usize + 13;
            let dark = |col: usize| f64::from(255 - flat[4 * (row * map.width() + col)]);
            let weight: f64 = around.clone().map(dark).sum();
            let centre = around.map(|col| dark(col) * col as f64).sum::<f64>() / weight;
            assert!(
                (centre - expected).abs() < 0.5,
                "row {row}, line {line}: {centre} {expected}"
            );
        }
    }
    // Upright: the alpha tells where there is sheet.
    assert_eq!(flat[4 * (map.width() / 2) + 3], 255);
}

/// A curled page with a ball-shaped dimple in its middle, where the area inside its rim must stretch.
fn dimple(x: f64, y: f64) -> f64 {
    let inside = (1.0 - ((x - 0.5).powi(2) + (y - 0.5).powi(2)) / 0.03).max(0.0);
    (0.49 - (x - 0.5).powi(2)).sqrt() + 0.03 * inside.powi(2)
}

#[test]
fn a_word_tells_whether_to_trust_it() {
    let verdict = |f: fn(f64, f64) -> f64| {
        let sheet = unroll(&unit_square(60, f), &UnrollOptions::default()).unwrap();
        Verdict::from_report(sheet.report())
    };
    assert_eq!(verdict(|x, y| 0.01 * x - 0.02 * y), Verdict::Flat);
    assert_eq!(
        verdict(|x, _| (0.49 - (x - 0.5).powi(2)).sqrt()),
        Verdict::Unrolled
    );
    assert_eq!(verdict(|x, _| x), Verdict::Unrolled); // seen at a slant
    assert_eq!(
        verdict(|x, y| (0.6 - (x - 0.5).powi(2) - (y - 0.5).powi(2)).sqrt()),
        Verdict::Stretched
    );
    // A page that is stretched by more than paper allows in a part only.
    let in_part = unroll(&unit_square(60, dimple), &UnrollOptions::default()).unwrap();
    let strain = in_part.report().distortion;
    assert!(strain.rms < 0.01 && strain.maximum > 0.01, "{strain:?}");
    assert_eq!(Verdict::from_report(in_part.report()), Verdict::Stretched);
    // A border that crosses itself, but covers nothing to speak of.
    let sheet = unroll(&curled(), &UnrollOptions::default()).unwrap();
    let map = map_of(&curled(), &DewarpOptions::default());
    let mut report = *sheet.report();
    report.crossings = 1;
    assert_eq!(Verdict::from_report(&report), Verdict::Stretched);
    assert_eq!(map.verdict(&report), Verdict::Unrolled);
}

#[test]
fn only_what_lies_on_another_part_of_the_sheet_counts_as_overlap() {
    let sheet = unroll(&curled(), &UnrollOptions::default()).unwrap();
    let mut crossing = *sheet.report();
    crossing.crossings = 1;
    // A few pixels, whose number is not that of the area in pixels.
    let coarse = map_of(&curled(), &DewarpOptions::default().dots(31.0));
    assert_eq!(coarse.verdict(&crossing), Verdict::Unrolled);
    // A fifth of the page has no place in the photo, as behind a camera.
    let surface = curled();
    let lattice = surface.lattice();
    let seen = |i: usize| {
        let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
        if x < 0.8 {
            [x as f32, y as f32]
        } else {
            [f32::NAN; 2]
        }
    };
    let uvs: Vec<[f32; 2]> = (0..lattice.len()).map(seen).collect();
    let photo = Registration::Uvs(&uvs);
    let options = DewarpOptions::default().dots(400.0).trim(false);
    let map = WarpMap::new(&sheet, photo, [400, 400], &options).unwrap();
    let unseen = map
        .places()
        .iter()
        .filter(|place| place[0].is_nan())
        .count();
    let share = unseen as f64 / map.places().len() as f64;
    // More than the overlap that a flat page may have, which they would be counted as.
    assert!(share > 0.005, "{share}");
    assert_eq!(map.verdict(&crossing), Verdict::Unrolled);
}

#[test]
fn nonsense_is_refused() {
    let sheet = unroll(&curled(), &UnrollOptions::default()).unwrap();
    let code = |extent, photo, options| {
        WarpMap::new(&sheet, extent, photo, &options)
            .unwrap_err()
            .code()
    };
    let options = DewarpOptions::default();
    let empty = Extent {
        min: [1.0; 2],
        max: [1.0; 2],
    };
    assert_eq!(code(empty, [10, 10], options), "EMPTY");
    assert_eq!(code(UNIT, [10, 0], options), "EMPTY");
    assert_eq!(code(UNIT, [10, 10], options.dots(-1.0)), "OPTION");
    assert_eq!(code(UNIT, [10, 10], options.dots(1e9)), "TOO_LARGE");
}
