use super::*;
use crate::heights::heightfield::HeightImage;
use crate::lattice::hexagonal::Lattice;

fn surface(f: impl Fn(f64, f64) -> f64) -> Heightfield {
    Heightfield::from_fn(Lattice::new(47, 41, 0.5).unwrap(), f).unwrap()
}

fn pixel(picture: &Picture, row: usize, col: usize) -> [u8; 4] {
    let from = 4 * (row * picture.width() + col);
    std::array::from_fn(|k| picture.rgba()[from + k])
}

fn pixels(picture: &Picture) -> impl Iterator<Item = [u8; 4]> + '_ {
    let columns = 0..picture.width();
    (0..picture.height())
        .flat_map(move |row| columns.clone().map(move |col| pixel(picture, row, col)))
}

fn code(surface: &Heightfield, options: PictureOptions) -> &'static str {
    Picture::new(surface, &options).unwrap_err().code()
}

#[test]
fn a_tilted_plane_has_the_one_colour_that_follows_from_the_light() {
    let plane = surface(|x, y| 0.75 * x - 0.2 * y + 3.0);
    for (light, cosine) in [
        // Along the normal, straight above, and from where the plane is in its own shade.
        ([-0.75, 0.2, 1.0], 1.0),
        ([0.0, 0.0, 7.0], 1.0 / (1.0f64 + 0.5625 + 0.04).sqrt()),
        ([2.0, 0.0, 0.1], 0.0),
    ] {
        let options = PictureOptions::default().style(Style::Shaded { light });
        let picture = Picture::new(&plane, &options).unwrap();
        assert_eq!((picture.width(), picture.height()), (41, 41));
        let tone = 0.15 + 0.85 * cosine;
        let green = (255.0 * tone).round() as u8;
        let first = pixel(&picture, 0, 0);
        assert_eq!((first[1], first[3]), (green, 255), "{light:?}");
        assert!(first[0] <= green && green <= first[2]);
        assert!(pixels(&picture).all(|other| other == first));
    }
}

#[test]
fn what_faces_the_light_is_brighter() {
    let mound = surface(|x, y| -0.02 * ((x - 10.0).powi(2) + (y + 10.0).powi(2)));
    let picture = Picture::new(&mound, &PictureOptions::default()).unwrap();
    // The light is above to the left, and so is what is bright.
    let [bright, dark] = [pixel(&picture, 8, 8), pixel(&picture, 32, 32)];
    assert!(bright[1] > dark[1] + 50, "{bright:?} {dark:?}");
}

#[test]
fn a_folded_card_has_two_colours_and_a_dark_crease() {
    let card = surface(|x, _| 0.6 * (x - 8.1).abs());
    let options = PictureOptions::default().style(Style::patches());
    let picture = Picture::new(&card, &options).unwrap();
    // Of the larger patch, to the right, and of the smaller one.
    let [right, left] = [[86, 148, 206, 255], [240, 160, 75, 255]];
    let light = |pixel: [u8; 4]| u32::from(pixel[0]) + u32::from(pixel[1]) + u32::from(pixel[2]);
    for (i, found) in pixels(&picture).enumerate() {
        let x = 0.5 * (i % 41) as f64;
        if x < 7.0 {
            assert_eq!(found, left, "{x}");
        } else if x > 9.2 {
            assert_eq!(found, right, "{x}");
        } else {
            assert!(found == left || found == right || 2 * light(found) < light(left));
        }
    }
    for row in 0..picture.height() {
        let dark = (0..41).filter(|col| light(pixel(&picture, row, *col)) < 200);
        assert!((1..=3).contains(&dark.count()), "row {row}");
    }
}

#[test]
fn a_cap_has_the_colour_of_one_over_its_radius_squared() {
    let radius = 30.0f64;
    let cap = surface(|x, y| (radius.powi(2) - (x - 10.0).powi(2) - (y + 10.0).powi(2)).sqrt());
    let gaussian = 1.0 / radius.powi(2);
    let drawn = |kind, limit| {
        let style = Style::Curvature { kind, limit };
        let picture = Picture::new(&cap, &PictureOptions::default().style(style)).unwrap();
        assert!(pixels(&picture).all(|pixel| pixel[3] == 255));
        assert_eq!(
            pixel(&picture, 0, 0),
            [150, 155, 160, 255],
            "no curvature at the border"
        );
        [pixel(&picture, 20, 20), pixel(&picture, 12, 26)]
    };
    let near = |found: [[u8; 4]; 2], expected: [f64; 3]| {
        for pixel in found {
            for (a, b) in pixel.iter().zip(expected) {
                assert!((f64::from(*a) - b).abs() <= 2.0, "{pixel:?} {expected:?}");
            }
        }
    };
    // Half-way to red, where RdBu is the mean of its eighth and ninth colour; beyond its end.
    near(
        drawn(Curvature::Gaussian, Some(2.0 * gaussian)),
        [229.0, 130.5, 103.5],
    );
    near(
        drawn(Curvature::Gaussian, Some(0.5 * gaussian)),
        [103.0, 0.0, 31.0],
    );
    // The surface is 20.25 wide, as is the sphere at the scale's ends, with 4 / 20.25² instead of
    // 1/r²; from white to the next of the five colours up to red it is a fifth of the way.
    let place = 5.0 + 5.0 * (20.25f64 / (2.0 * radius)).powi(2);
    let share = place - 5.0;
    near(
        drawn(Curvature::Gaussian, None),
        [
            247.0 + 6.0 * share,
            247.0 - 28.0 * share,
            247.0 - 48.0 * share,
        ],
    );
    // A dome bends downwards, by 1/r both ways at its top.
    let top = drawn(Curvature::Kappa2, Some(2.0 / radius))[0];
    near([top, top], [106.5, 172.0, 208.5]);
}

#[test]
fn holes_are_transparent_and_the_rest_is_opaque_up_to_its_border() {
    let [width, height] = [40usize, 31usize];
    let hole = |x: f64, y: f64| (x - 20.0).hypot(y - 15.5) < 6.0;
    let values = (0..width * height).map(|i| {
        let [x, y] = [(i % width) as f64 + 0.5, 30.5 - (i / width) as f64];
        if hole(x, y) { f64::NAN } else { 0.1 * x }
    });
    let image = HeightImage::new(width, height, values.collect()).unwrap();
    for (spacing, scale) in [(None, 1), (None, 3), (Some(2.0), 1), (Some(0.7), 1)] {
        let surface = image.to_lattice(spacing).unwrap();
        let options = PictureOptions::default()
            .extent(Extent::from_image(&image))
            .width(scale * width);
        for style in [Style::shaded(), Style::curvature(), Style::patches()] {
            let picture = Picture::new(&surface, &options.style(style)).unwrap();
            assert_eq!(
                (picture.width(), picture.height()),
                (scale * width, scale * height)
            );
            for (i, pixel) in pixels(&picture).enumerate() {
                let x = ((i % picture.width()) as f64 + 0.5) / scale as f64;
                let y = 31.0 - ((i / picture.width()) as f64 + 0.5) / scale as f64;
                let from_hole = (x - 20.0).hypot(y - 15.5) - 6.0;
                // Within a spacing of the hole it depends on the lattice.
                let near = spacing.unwrap_or(1.0) + 0.5;
                if from_hole < -1.0 {
                    assert_eq!(pixel, [0; 4], "{x} {y}");
                } else if from_hole > near {
                    assert_eq!(pixel[3], 255, "{x} {y} {spacing:?} {scale}");
                }
            }
        }
    }
}

#[test]
fn an_island_ends_where_its_vertices_do() {
    let [width, height] = [30usize, 30usize];
    let values = (0..width * height).map(|i| {
        let [x, y] = [(i % width) as f64 - 14.5, (i / width) as f64 - 14.5];
        if x.hypot(y) < 9.0 { x } else { f64::NAN }
    });
    let image = HeightImage::new(width, height, values.collect()).unwrap();
    let surface = image.to_lattice(None).unwrap();
    let options = PictureOptions::default().extent(Extent::from_image(&image));
    for scale in [1, 4] {
        let picture = Picture::new(&surface, &options.width(scale * width)).unwrap();
        for (i, pixel) in pixels(&picture).enumerate() {
            let place = |n: usize| (n as f64 + 0.5) / scale as f64 - 15.0;
            let from = place(i % picture.width()).hypot(place(i / picture.width()));
            if from < 8.0 {
                assert_eq!(pixel[3], 255, "{i}");
            } else if from > 9.8 {
                assert_eq!(pixel, [0; 4], "{i}");
            }
        }
    }
}

#[test]
fn nothing_is_drawn_where_there_is_nothing() {
    let nothing = surface(|_, _| f64::NAN);
    let picture = Picture::new(&nothing, &PictureOptions::default()).unwrap();
    assert!(picture.rgba().iter().all(|byte| *byte == 0));
    assert_eq!(
        code(
            &nothing,
            PictureOptions::default().style(Style::curvature())
        ),
        "NO_INTERIOR"
    );
    // Beside the surface.
    let far = Extent {
        min: [90.0, 90.0],
        max: [95.0, 95.0],
    };
    let options = PictureOptions::default().extent(far);
    let picture = Picture::new(&surface(|x, _| x), &options).unwrap();
    assert!(picture.rgba().iter().all(|byte| *byte == 0));
    // One vertex lies level, and one row has a pixel of height.
    let one = Heightfield::new(Lattice::new(1, 1, 2.0).unwrap(), vec![5.0]).unwrap();
    let picture = Picture::new(&one, &PictureOptions::default()).unwrap();
    assert_eq!(
        (picture.width(), picture.height(), picture.rgba()[3]),
        (1, 1, 255)
    );
}

#[test]
fn nonsense_is_refused() {
    let level = surface(|_, _| 0.0);
    let options = PictureOptions::default();
    assert_eq!(code(&level, options.width(0)), "OPTION");
    assert_eq!(code(&level, options.width(usize::MAX)), "TOO_LARGE");
    assert_eq!(code(&level, options.width(5000)), "TOO_LARGE");
    for light in [
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, f64::NAN, 1.0],
        [0.0, 0.0, f64::INFINITY],
    ] {
        assert_eq!(
            code(&level, options.style(Style::Shaded { light })),
            "OPTION"
        );
    }
    let kind = Curvature::Kappa2;
    for limit in [Some(0.0), Some(f64::NAN)] {
        assert_eq!(
            code(&level, options.style(Style::Curvature { kind, limit })),
            "OPTION"
        );
    }
    let wanted = PatchOptions::default().fold(-1.0);
    assert_eq!(
        code(&level, options.style(Style::Patches(wanted))),
        "OPTION"
    );
    let extent = Extent {
        min: [0.0, 0.0],
        max: [3.0, 0.0],
    };
    assert_eq!(code(&level, options.extent(extent)), "EMPTY");
}
