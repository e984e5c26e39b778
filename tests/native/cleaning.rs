//! Flat pages cleaned for reading: under hard shadows, coloured lamps and vignetting, with print and coloured stamps.

use developable::page::cleaning::{CleaningOptions, Light, clean};
use oorandom::Rand64;

/// Width and height of the rendered page: A4 with four pixels for each millimetre.
const SIZE: [usize; 2] = [840, 1188];

/// Colours of paper, ink, stamp and logo.
const PAPER: [f64; 3] = [238.0, 238.0, 236.0];
const INK: [f64; 3] = [25.0, 25.0, 30.0];
const STAMP: [f64; 3] = [196.0, 40.0, 52.0];
const LOGO: [f64; 3] = [40.0, 90.0, 190.0];

/// What each pixel of the rendered page shows.
#[derive(Clone, Copy, PartialEq)]
enum Shown {
    Paper,
    Ink,
    Stamp,
    Logo,
}

/// A page of lines of strokes as wide as those of letters, with a headline, a round stamp and a rectangular logo.
fn page(seed: u128) -> Vec<Shown> {
    let [width, height] = SIZE;
    let mut random = Rand64::new(seed);
    let mut shown = vec![Shown::Paper; width * height];
    let fill = |shown: &mut [Shown], [x, y, w, h]: [usize; 4], what: Shown| {
        for row in y..(y + h).min(height) {
            shown[row * width..][x.min(width)..(x + w).min(width)].fill(what);
        }
    };
    // A headline with strokes of 3 mm.
    for letter in 0..9 {
        let x = 90 + 34 * letter;
        fill(&mut shown, [x, 70, 12, 40], Shown::Ink);
        fill(&mut shown, [x, 70 + 10 * (letter % 3), 26, 10], Shown::Ink);
    }
    for line in 0..34 {
        let (y, mut x) = (330 + 24 * line, 90);
        let end = 500 + random.rand_range(0..250) as usize;
        while x < end {
            match random.rand_range(0..6) {
                0 => x += 8,
                1 => fill(&mut shown, [x, y + 5, 7, 2], Shown::Ink),
                2 => fill(&mut shown, [x + 2, y, 2, 12], Shown::Ink),
                _ => {
                    fill(&mut shown, [x, y, 2, 12], Shown::Ink);
                    fill(
                        &mut shown,
                        [x, y + random.rand_range(0..10) as usize, 7, 2],
                        Shown::Ink,
                    );
                }
            }
            x += 9;
        }
    }
    fill(&mut shown, [560, 60, 180, 90], Shown::Logo);
    for (i, shown) in shown.iter_mut().enumerate() {
        let [x, y] = [(i % width) as f64 - 620.0, (i / width) as f64 - 240.0];
        if x.hypot(y) < 60.0 {
            *shown = Shown::Stamp;
        }
    }
    shown
}

/// The light at a place, in shares of the page, for red, green and blue.
type Lamp = fn([f64; 2]) -> [f64; 3];

/// The share of a lamp's light that passes an edge across the page, with a penumbra of 2 mm: all of it on one side.
fn beyond([x, y]: [f64; 2], slope: f64, offset: f64) -> f64 {
    let distance = SIZE[0] as f64 * (x + slope * y - offset) / 1.0f64.hypot(slope);
    1.0 / (1.0 + (-distance / 2.0).exp())
}

/// The factor on a pixel's value for a share of the light, by the gamma of images.
fn value(light: f64) -> f64 {
    light.powf(1.0 / 2.2)
}

const LAMPS: [(&str, Lamp); 5] = [
    ("hard shadow", |at| {
        [value(0.2 + 0.8 * beyond(at, 0.5, 0.7)); 3]
    }),
    ("shadows of two lamps, bluer than these", |at| {
        let lamps = [beyond(at, 0.4, 0.8), beyond(at, -1.5, -0.6)];
        [0.12, 0.14, 0.18].map(|sky| value(sky + 0.45 * lamps[0] + 0.4 * lamps[1]))
    }),
    ("warm lamp from one side", |[x, y]| {
        [1.0, 0.7, 0.35].map(|colour| value(colour * (1.0 - 0.7 * x - 0.2 * y)))
    }),
    ("vignetting", |[x, y]| {
        [value(1.0 - 1.6 * ((x - 0.5).powi(2) + (y - 0.5).powi(2))); 3]
    }),
    ("warm lamp, vignetting and a shadow", |at| {
        let edge = 1.0 - ((at[0] - 0.5).powi(2) + (at[1] - 0.5).powi(2));
        let lamp = edge * (0.25 + 0.75 * beyond(at, 1.2, 1.0));
        [1.0, 0.8, 0.55].map(|colour| value(colour * lamp))
    }),
];

/// The page under a lamp, with noise of two steps and the edges of print blurred by the lens.
fn photograph(shown: &[Shown], lamp: Lamp, seed: u128) -> Vec<u8> {
    let colour = |i: usize| match shown[i] {
        Shown::Paper => PAPER,
        Shown::Ink => INK,
        Shown::Stamp => STAMP,
        Shown::Logo => LOGO,
    };
    photograph_colours(colour, lamp, seed)
}

/// A page whose pixels have the given colours under a lamp, with the same noise and blur.
fn photograph_colours(colour: impl Fn(usize) -> [f64; 3], lamp: Lamp, seed: u128) -> Vec<u8> {
    let [width, height] = SIZE;
    let mut random = Rand64::new(seed);
    let mut rgba = Vec::with_capacity(4 * width * height);
    for i in 0..width * height {
        let (x, y) = (i % width, i / width);
        let at = [x, y].map(|v| v as f64);
        let light = lamp([at[0] / width as f64, at[1] / height as f64]);
        let around = [
            i,
            y * width + x.saturating_sub(1),
            y * width + (x + 1).min(width - 1),
            y.saturating_sub(1) * width + x,
            (y + 1).min(height - 1) * width + x,
        ];
        for (k, light) in light.iter().enumerate() {
            let clean = around.map(|j| colour(j)[k]);
            let blurred = 0.6 * clean[0] + 0.1 * clean[1..].iter().sum::<f64>();
            let noise: f64 = (0..4).map(|_| random.rand_float() - 0.5).sum::<f64>() * 3.5;
            rgba.push((light * blurred + noise).round().clamp(0.0, 255.0) as u8);
        }
        rgba.push(255);
    }
    rgba
}

/// Pixels of which all within `radius` show the same.
fn inner(shown: &[Shown], what: Shown, radius: usize) -> Vec<usize> {
    let [width, height] = SIZE;
    (0..shown.len())
        .filter(|i| {
            let (x, y) = (i % width, i / width);
            shown[*i] == what
                && (y.saturating_sub(radius)..(y + radius + 1).min(height)).all(|row| {
                    let (from, to) = (x.saturating_sub(radius), (x + radius + 1).min(width));
                    shown[row * width..][from..to]
                        .iter()
                        .all(|other| *other == what)
                })
        })
        .collect()
}

/// Mean and standard deviation of the luminance of some pixels.
fn luminance(rgba: &[u8], pixels: &[usize]) -> [f64; 2] {
    let values: Vec<f64> = pixels
        .iter()
        .map(|i| {
            let [r, g, b] = [0, 1, 2].map(|k| f64::from(rgba[4 * i + k]));
            0.299 * r + 0.587 * g + 0.114 * b
        })
        .collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let square = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64;
    [mean, square.sqrt()]
}

/// Hue, in degrees, and saturation, from 0 to 1, of the mean colour of some pixels.
fn hue(rgba: &[u8], pixels: &[usize]) -> [f64; 2] {
    let mean = |k: usize| {
        pixels
            .iter()
            .map(|i| f64::from(rgba[4 * i + k]))
            .sum::<f64>()
            / pixels.len() as f64
    };
    hue_of([0, 1, 2].map(mean))
}

fn hue_of([r, g, b]: [f64; 3]) -> [f64; 2] {
    let (most, least) = (r.max(g).max(b), r.min(g).min(b));
    let angle = (3.0f64.sqrt() * (g - b))
        .atan2(2.0 * r - g - b)
        .to_degrees();
    [angle, (most - least) / most]
}

#[test]
fn paper_becomes_white_and_colours_stay_under_every_lamp() {
    for (number, (name, lamp)) in LAMPS.into_iter().enumerate() {
        let shown = page(number as u128 + 1);
        let photo = photograph(&shown, lamp, 7);
        let mut found = photo.clone();
        let light = clean(SIZE[0], SIZE[1], &mut found, &CleaningOptions::default()).unwrap();
        assert_eq!(light, Light::Even, "{name}");
        let paper = inner(&shown, Shown::Paper, 3);
        let [before, after] = [&photo, &found].map(|rgba| luminance(rgba, &paper));
        assert!(before[1] > 12.0, "{name}: {before:?}");
        assert!(after[0] > 252.0 && after[1] < 3.0, "{name}: {after:?}");
        for (what, colour) in [(Shown::Stamp, STAMP), (Shown::Logo, LOGO)] {
            let clean = [0, 1, 2].map(|k| 255.0 * colour[k] / PAPER[k]);
            let (found, expected) = (hue(&found, &inner(&shown, what, 2)), hue_of(clean));
            let turned = (found[0] - expected[0] + 540.0).rem_euclid(360.0) - 180.0;
            assert!(turned.abs() < 8.0, "{name}: {found:?} {expected:?}");
            assert!(
                (found[1] - expected[1]).abs() < 0.12,
                "{name}: {found:?} {expected:?}"
            );
        }
        let ink = inner(&shown, Shown::Ink, 1);
        assert!(luminance(&found, &ink)[0] < 60.0, "{name}");
    }
}

/// Colour of the head of a table.
const BAR: [f64; 3] = [130.0, 55.0, 85.0];

#[test]
fn a_tilted_head_of_a_table_of_eleven_millimetres_keeps_its_colour() {
    let [width, height] = SIZE;
    // A bar of 45 pixels that falls by one in fifty, with pale letters and edges that the lens blurs over four pixels.
    let share = |x: usize, y: usize| {
        let from = y as f64 - 400.0 - 0.02 * x as f64;
        let inside = (from / 4.0).min((45.0 - from) / 4.0).clamp(0.0, 1.0);
        let is_letter = (16.0..28.0).contains(&from) && x / 60 % 3 == 1 && x % 9 < 3;
        if (90..750).contains(&x) && !is_letter {
            inside
        } else {
            0.0
        }
    };
    let mut random = Rand64::new(6);
    let mut found = Vec::new();
    let mut bar = Vec::new();
    for i in 0..width * height {
        let (x, y) = (i % width, i / width);
        let share = share(x, y);
        if share == 1.0 {
            bar.push(i);
        }
        for k in 0..3 {
            let noise = 6.0 * (random.rand_float() - 0.5);
            let colour = PAPER[k] + share * (BAR[k] - PAPER[k]);
            found.push((0.8 * colour + noise) as u8);
        }
        found.push(255);
    }
    let light = clean(width, height, &mut found, &CleaningOptions::default()).unwrap();
    assert_eq!(light, Light::Even);
    let [mean, deviation] = luminance(&found, &bar);
    let expected = 0.299 * BAR[0] + 0.587 * BAR[1] + 0.114 * BAR[2];
    let expected = 255.0 / PAPER[1] * expected;
    assert!((mean - expected).abs() < 10.0, "{mean} {expected}");
    assert!(deviation < 5.0, "{deviation}");
}

#[test]
fn black_and_white_recalls_print_under_every_lamp() {
    for (number, (name, lamp)) in LAMPS.into_iter().enumerate() {
        let shown = page(number as u128 + 11);
        let mut found = photograph(&shown, lamp, 8);
        let options = CleaningOptions::default().ink(true);
        clean(SIZE[0], SIZE[1], &mut found, &options).unwrap();
        for pixel in found.as_chunks::<4>().0 {
            assert!(matches!(pixel, [0, 0, 0, 255] | [255, 255, 255, 255]));
        }
        let share_black = |pixels: &[usize]| {
            pixels.iter().filter(|i| found[4 * **i] == 0).count() as f64 / pixels.len() as f64
        };
        let ink: Vec<usize> = (0..shown.len())
            .filter(|i| shown[*i] == Shown::Ink)
            .collect();
        let (recall, wrong) = (
            share_black(&ink),
            share_black(&inner(&shown, Shown::Paper, 2)),
        );
        assert!(recall > 0.98 && wrong < 1e-3, "{name}: {recall} {wrong}");
    }
}

#[test]
fn a_picture_keeps_its_light_and_so_does_whoever_asks_for_it() {
    let [width, height] = SIZE;
    let mut random = Rand64::new(5);
    // Waves and grain, as of grass: hardly two neighbours are alike.
    let picture: Vec<u8> = (0..width * height)
        .flat_map(|i| {
            let (x, y) = ((i % width) as f64, (i / width) as f64);
            let wave = (0.31 * x).sin() * (0.23 * y).cos() + 0.4 * (0.011 * x + 0.02 * y).sin();
            let value = 120.0 + 70.0 * wave + 40.0 * (random.rand_float() - 0.5);
            [0.7, 1.0, 0.5, 0.0].map(|share| {
                if share > 0.0 {
                    (share * value) as u8
                } else {
                    255
                }
            })
        })
        .collect();
    let mut found = picture.clone();
    let light = clean(width, height, &mut found, &CleaningOptions::default()).unwrap();
    assert!(light == Light::Keep && found == picture);

    let photo = photograph(&page(3), LAMPS[0].1, 9);
    let mut kept = photo.clone();
    let options = CleaningOptions::default().light(Light::Keep);
    assert_eq!(
        clean(width, height, &mut kept, &options).unwrap(),
        Light::Keep
    );
    assert!(kept == photo);
}

#[test]
fn a_dark_page_with_light_print_stays_dark_and_its_print_becomes_ink() {
    let [width, height] = SIZE;
    let shown = page(6);
    // The colours of paper and ink are exchanged; stamp and logo are plain.
    let negative: Vec<Shown> = (shown.iter())
        .map(|what| match what {
            Shown::Ink => Shown::Paper,
            _ => Shown::Ink,
        })
        .collect();
    for (name, lamp) in LAMPS {
        let photo = photograph(&negative, lamp, 9);
        let mut found = photo.clone();
        let light = clean(width, height, &mut found, &CleaningOptions::default()).unwrap();
        assert!(light == Light::Keep && found == photo, "{name}");
        let options = CleaningOptions::default().ink(true);
        clean(width, height, &mut found, &options).unwrap();
        let share_of_ink = |pixels: &[usize]| {
            let ink = pixels.iter().filter(|i| found[4 * **i] == 0).count();
            ink as f64 / pixels.len() as f64
        };
        let print = inner(&negative, Shown::Paper, 1);
        let ground = inner(&negative, Shown::Ink, 3);
        let shares = [share_of_ink(&print), share_of_ink(&ground)];
        assert!(shares[0] > 0.9 && shares[1] < 0.02, "{name}: {shares:?}");
    }
}

#[test]
fn panels_and_tinted_cells_keep_their_shade_under_every_lamp() {
    let [width, height] = SIZE;
    // A panel of 90 by 60 mm, two cells of a table of 25 mm in pale grey and in yellow, and a head of 11 mm.
    let areas: [([usize; 4], [f64; 3]); 4] = [
        ([120, 150, 360, 240], [52.0, 96.0, 150.0]),
        ([266, 960, 98, 110], [204.0, 204.0, 203.0]),
        ([430, 560, 320, 100], [232.0, 226.0, 168.0]),
        ([90, 800, 660, 44], BAR),
    ];
    let print = page(12);
    let area = |i: usize, rim: usize| {
        let (x, y) = (i % width, i / width);
        areas.iter().position(|([left, top, w, h], _)| {
            (left + rim..left + w - rim).contains(&x) && (top + rim..top + h - rim).contains(&y)
        })
    };
    for (name, lamp) in LAMPS {
        let colour = |i: usize| match area(i, 0) {
            Some(number) => areas[number].1,
            None if print[i] == Shown::Ink && i % width > 500 => INK,
            None => PAPER,
        };
        let mut found = photograph_colours(colour, lamp, 10);
        let options = CleaningOptions::default();
        assert_eq!(
            clean(width, height, &mut found, &options).unwrap(),
            Light::Even
        );
        for (number, (_, colour)) in areas.iter().enumerate() {
            let pixels: Vec<usize> = (0..width * height)
                .filter(|i| area(*i, 4) == Some(number))
                .collect();
            let mean = |k: usize| {
                let values = pixels.iter().map(|i| f64::from(found[4 * i + k]));
                values.sum::<f64>() / pixels.len() as f64
            };
            for k in 0..3 {
                let expected = (255.0 / 0.94 * colour[k] / PAPER[k]).min(255.0);
                let off = mean(k) - expected;
                assert!(
                    off.abs() < 24.0,
                    "{name}, area {number}: {off:.1} from {expected:.0}"
                );
            }
        }
    }
}

#[test]
fn a_fringe_of_the_table_becomes_white_and_a_panel_at_the_rim_stays() {
    let [width, height] = SIZE;
    let is_panel = |i: usize| i / width < 120 && (200..600).contains(&(i % width));
    let is_fringe = |i: usize| i % width >= width - 4 || i / width >= height - 3;
    let colour = |i: usize| match (is_panel(i), is_fringe(i)) {
        (true, _) => LOGO,
        (_, true) => [60.0, 45.0, 35.0],
        _ => PAPER,
    };
    for (name, lamp) in LAMPS {
        let mut found = photograph_colours(colour, lamp, 12);
        clean(width, height, &mut found, &CleaningOptions::default()).unwrap();
        let mean = |is: &dyn Fn(usize) -> bool| {
            let pixels: Vec<usize> = (0..width * height).filter(|i| is(*i)).collect();
            luminance(&found, &pixels)[0]
        };
        let rim = |i: usize| i % width >= width - 2 || i / width >= height - 2;
        let panel = |i: usize| i / width < 4 && (210..590).contains(&(i % width));
        let [fringe, panel] = [mean(&rim), mean(&panel)];
        assert!(
            fringe > 180.0 && panel < 150.0,
            "{name}: {fringe:.0} {panel:.0}"
        );
    }
}

#[test]
fn a_page_with_one_bar_is_not_dark() {
    let [width, height] = SIZE;
    let is_bar = |i: usize| (400..444).contains(&(i / width)) && (90..750).contains(&(i % width));
    let colour = |i: usize| if is_bar(i) { BAR } else { PAPER };
    for (name, lamp) in LAMPS {
        let mut found = photograph_colours(colour, lamp, 11);
        let light = clean(width, height, &mut found, &CleaningOptions::default()).unwrap();
        assert_eq!(light, Light::Even, "{name}");
    }
}

#[test]
fn transparent_pixels_stay_as_they_are() {
    let mut photo = photograph(&page(4), LAMPS[3].1, 9);
    for pixel in photo.as_chunks_mut::<4>().0.iter_mut().take(200 * SIZE[0]) {
        *pixel = [0; 4];
    }
    for ink in [false, true] {
        let mut found = photo.clone();
        let options = CleaningOptions::default().ink(ink);
        clean(SIZE[0], SIZE[1], &mut found, &options).unwrap();
        let alpha = |rgba: &[u8]| -> Vec<u8> { rgba.iter().skip(3).step_by(4).copied().collect() };
        assert!(alpha(&found) == alpha(&photo));
    }
}

#[test]
fn tiny_and_wrong_pages_do_no_harm() {
    for size in [[1, 1], [2, 1], [1, 900], [3, 3]] {
        for options in [
            CleaningOptions::default(),
            CleaningOptions::default().ink(true),
        ] {
            let mut rgba = vec![200; 4 * size[0] * size[1]];
            clean(size[0], size[1], &mut rgba, &options).unwrap();
        }
    }
    assert_eq!(
        clean(2, 2, &mut [0; 15], &CleaningOptions::default())
            .unwrap_err()
            .code(),
        "SHAPE"
    );
}
