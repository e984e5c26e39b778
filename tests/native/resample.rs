//! Image to lattice and back: linear ramps are exact, invalid pixels never count.

use developable::{HeightImage, Heightfield, Lattice};
use proptest::prelude::*;

fn image(
    width: usize,
    height: usize,
    pixel: f64,
    f: impl Fn(usize, [f64; 2]) -> f64,
) -> HeightImage {
    let blank = HeightImage::new(width, height, vec![0.0; width * height])
        .unwrap()
        .with_pixel_size(pixel)
        .unwrap();
    let values = (0..width * height)
        .map(|i| f(i, blank.position(i / width, i % width)))
        .collect();
    HeightImage::new(width, height, values)
        .unwrap()
        .with_pixel_size(pixel)
        .unwrap()
}

fn is_valid(values: &[f64]) -> Vec<bool> {
    values.iter().map(|v| v.is_finite()).collect()
}

/// Position and height of each vertex that has one.
fn vertices(field: &Heightfield) -> impl Iterator<Item = ([f64; 2], f64)> {
    let lattice = field.lattice();
    (0..lattice.len()).filter_map(|i| {
        let (row, col) = (i / lattice.cols(), i % lattice.cols());
        let z = field.height(row, col);
        z.is_finite().then(|| (lattice.position(row, col), z))
    })
}

prop_compose! {
    /// An image's size and a mask, from empty to full.
    fn masked()(width in 1usize..24, height in 1usize..24, share in 0.0f64..=1.0)(
        mask in prop::collection::vec(prop::bool::weighted(share), width * height),
        width in Just(width), height in Just(height),
    ) -> (usize, usize, Vec<bool>) {
        (width, height, mask)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_ramp_comes_through_both_ways_exactly(
        (width, height, mask) in masked(),
        pixel in 0.05f64..20.0,
        relative_spacing in prop_oneof![Just(1.0), 0.2f64..6.0],
        slope in (-3.0f64..3.0, -3.0f64..3.0),
        offset in -50.0f64..50.0,
    ) {
        let ramp = |[x, y]: [f64; 2]| slope.0 * x + slope.1 * y + offset;
        let input = image(width, height, pixel, |i, p| if mask[i] { ramp(p) } else { f64::NAN });
        let field = input.to_lattice(Some(pixel * relative_spacing)).unwrap();
        let tolerance = 1e-11 * (50.0 + 6.0 * pixel * 24.0);
        for (p, z) in vertices(&field) {
            prop_assert!((z - ramp(p)).abs() < tolerance, "{:?}: {} {}", p, z, ramp(p));
        }
        let back = field.to_image(&input).unwrap();
        prop_assert_eq!(back.pixel_size(), input.pixel_size());
        prop_assert_eq!(is_valid(back.values()), is_valid(input.values()));
        for (a, b) in back.values().iter().zip(input.values()) {
            prop_assert!(a.is_nan() || (a - b).abs() < tolerance, "{} {}", a, b);
        }
    }

    #[test]
    fn sampled_heights_stay_between_the_images(
        (width, height, mask) in masked(),
        heights in prop::collection::vec(-1.0f64..1.0, 24 * 24),
        spacing in 0.2f64..3.0,
    ) {
        let input = image(width, height, 1.0, |i, _| if mask[i] { heights[i] } else { f64::NAN });
        let valid = input.values().iter().copied().filter(|v| v.is_finite());
        let (low, high) = valid.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
            (l.min(v), h.max(v))
        });
        for (_, z) in vertices(&input.to_lattice(Some(spacing)).unwrap()) {
            prop_assert!(low - 1e-12 <= z && z <= high + 1e-12);
        }
    }

    #[test]
    fn every_vertex_within_the_pixel_centres_has_a_height(
        width in 1usize..24, height in 1usize..24, pixel in 0.05f64..20.0,
        relative_spacing in prop_oneof![Just(1.0), Just(0.5), 0.2f64..6.0],
    ) {
        let input = image(width, height, pixel, |_, _| 1.0);
        let field = input.to_lattice(Some(pixel * relative_spacing)).unwrap();
        let lattice = field.lattice();
        let ([left, bottom], [right, top]) =
            (input.position(height - 1, 0), input.position(0, width - 1));
        for row in 0..lattice.rows() {
            for col in 0..lattice.cols() {
                let [x, y] = lattice.position(row, col);
                let hair = 1e-7 * pixel;
                let inside = x > left - 1e-12 * pixel && x < right + 1e-12 * pixel
                    && y > bottom - 1e-12 * pixel && y < top + 1e-12 * pixel;
                let outside = x < left - hair || x > right + hair || y < bottom - hair || y > top + hair;
                let valid = field.height(row, col).is_finite();
                prop_assert!(valid || !inside, "{row} {col} should have a height");
                prop_assert!(!valid || !outside, "{row} {col} should have none");
            }
        }
    }

    #[test]
    fn a_solid_shape_takes_all_its_heights_from_the_lattice(
        (width, height) in (9usize..40, 9usize..40),
        relative_spacing in prop_oneof![Just(1.0), 0.3f64..2.0],
        disk in any::<bool>(),
    ) {
        let radius = width.min(height) as f64 / 2.0;
        let inside = |[x, y]: [f64; 2]| {
            !disk || (x - width as f64 / 2.0).hypot(y - height as f64 / 2.0) < radius
        };
        let input = image(width, height, 1.0, |_, p| if inside(p) { p[0] } else { f64::NAN });
        let field = input.to_lattice(Some(relative_spacing)).unwrap();
        let lowered = field.heights().iter().map(|z| z - 5.0).collect();
        let back = Heightfield::new(*field.lattice(), lowered).unwrap().to_image(&input).unwrap();
        for (a, b) in back.values().iter().zip(input.values()) {
            prop_assert!(a.is_nan() && b.is_nan() || (a + 5.0 - b).abs() < 1e-9, "{} {}", a, b);
        }
    }

    #[test]
    fn any_lattice_gives_every_pixel_a_height(
        (width, height, mask) in masked(),
        origin in (-30.0f64..30.0, -30.0f64..30.0),
        spacing in prop_oneof![0.01f64..5.0, Just(1e-200), Just(1e200)],
        keep in prop::collection::vec(any::<bool>(), 7 * 9),
    ) {
        let input = image(width, height, 1.0, |i, _| if mask[i] { 0.25 } else { f64::NAN });
        let lattice = Lattice::new(7, 9, spacing).unwrap().with_origin(origin.into()).unwrap();
        let heights = keep.iter().map(|k| if *k { 1.5 } else { f64::NAN }).collect();
        let back = Heightfield::new(lattice, heights).unwrap().to_image(&input).unwrap();
        prop_assert_eq!(is_valid(back.values()), is_valid(input.values()));
    }
}

#[test]
fn the_default_lattice_has_the_pixel_size_and_starts_at_the_first_pixel() {
    let input = image(7, 5, 0.5, |_, [x, y]| x * y);
    let field = input.to_lattice(None).unwrap();
    assert_eq!(field.lattice().spacing(), 0.5);
    assert_eq!(field.lattice().origin(), input.position(0, 0));
    assert_eq!(field.height(0, 3), input.values()[3]);
    assert_eq!(input.to_lattice(Some(0.0)).unwrap_err().code(), "OPTION");
    assert_eq!(
        input.to_lattice(Some(1e-9)).unwrap_err().code(),
        "TOO_LARGE"
    );
}

#[test]
fn plateaus_either_side_of_a_gap_stay_apart() {
    let input = image(21, 17, 1.0, |i, _| match i % 21 {
        0..=9 => 0.0,
        10 => f64::NAN,
        _ => 100.0,
    });
    for spacing in [0.3, 0.7, 1.0] {
        let field = input.to_lattice(Some(spacing)).unwrap();
        assert!(vertices(&field).all(|(_, z)| z == 0.0 || (z - 100.0).abs() < 1e-12));
        let back = field.to_image(&input).unwrap();
        for (a, b) in back.values().iter().zip(input.values()) {
            assert!(
                a.is_nan() && b.is_nan() || (a - b).abs() < 1e-9,
                "{spacing}: {a} {b}"
            );
        }
    }
}

#[test]
fn a_pixel_in_a_triangle_of_three_takes_their_plane() {
    // Only the lower right pixel is missing: the upper left half of the cell is known.
    let input = HeightImage::new(2, 2, vec![1.0, 2.0, 4.0, f64::NAN]).unwrap();
    let field = input.to_lattice(Some(0.25)).unwrap();
    let plane = |[x, y]: [f64; 2]| 1.0 + (x - 0.5) + 3.0 * (1.5 - y);
    let heights: Vec<_> = vertices(&field).collect();
    assert!(heights.len() > 10);
    for (p, z) in heights {
        assert!((z - plane(p)).abs() < 1e-12);
        assert!((p[0] - 0.5) + (1.5 - p[1]) < 1.0 + 1e-6);
    }
}

#[test]
fn pixels_out_of_reach_keep_their_own_height() {
    // A wide field, and far from it a lone pixel that no lattice vertex meets.
    let input = image(30, 30, 1.0, |i, _| match (i / 30, i % 30) {
        (_, 0..12) => 3.0,
        (17, 23) => 8.0,
        _ => f64::NAN,
    });
    let field = input.to_lattice(Some(1.3)).unwrap();
    let lowered = Heightfield::new(
        *field.lattice(),
        field.heights().iter().map(|z| z - 1.0).collect(),
    );
    let back = lowered.unwrap().to_image(&input).unwrap();
    assert_eq!(back.values()[17 * 30 + 23], 8.0);
    for row in 0..30 {
        for col in 0..12 {
            assert!(
                (back.values()[row * 30 + col] - 2.0).abs() < 1e-12,
                "{row} {col}"
            );
        }
    }
}
