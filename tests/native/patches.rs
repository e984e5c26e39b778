//! Patches and creases of shapes that are known.

use crate::native::common::unit_square;
use developable::patches::{PatchOptions, Patches};
use developable::{Example, ExampleOptions, Heightfield, Options, fit};

/// The roof of the paper's Fig. 22 over the unit square, and which of its five patches is where.
fn roof(x: f64, y: f64) -> ([f64; 3], usize) {
    let (x, y) = (x - 0.5, y - 0.5);
    let arc = |offset: f64, radius: f64| {
        (radius * radius - offset * offset).sqrt() - (radius * radius - 0.25f64).sqrt()
    };
    let heights = [arc(y, 0.7), arc(x, 0.65), 0.45 - 1.3 * x.hypot(y)];
    let highest = (0..3)
        .max_by(|a, b| heights[*a].total_cmp(&heights[*b]))
        .unwrap();
    let patch = match highest {
        0 => usize::from(x > 0.0),
        1 => 2 + usize::from(y > 0.0),
        _ => 4,
    };
    (heights, patch)
}

/// Vertices with another true patch within two cells count for nothing; all others of a true
/// patch must have one label, and no other patch's.
fn check(surface: &Heightfield) {
    let found = Patches::new(surface, &PatchOptions::default()).unwrap();
    let lattice = surface.lattice();
    let truth = |i: usize| {
        let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
        roof(x, y).1
    };
    let mut votes = vec![[0; 5]; found.patches().len()];
    for i in 0..lattice.len() {
        let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
        let reach = 2.0 * lattice.spacing();
        let near = (0..12).any(|k| {
            let (sin, cos) = (std::f64::consts::FRAC_PI_6 * f64::from(k)).sin_cos();
            roof(x + reach * cos, y + reach * sin).1 != truth(i)
        });
        if near || surface.heights()[i].is_nan() {
            continue;
        }
        votes[found.labels()[i] as usize][truth(i)] += 1;
    }
    assert_eq!(found.patches().len(), 5, "{:?}", found.patches());
    // Each patch holds vertices of one true patch, and of another one than the others.
    let held = |votes: &[usize; 5]| (0..5).filter(|k| votes[*k] > 0).collect::<Vec<_>>();
    let mut held: Vec<_> = votes.iter().map(held).collect();
    held.sort();
    assert_eq!(held, [[0], [1], [2], [3], [4]], "{votes:?}");
    // Four creases between the vaults, four around the tower.
    assert_eq!(
        found.creases().len(),
        8,
        "{:?}",
        found
            .creases()
            .iter()
            .map(|c| (c.patches, c.length))
            .collect::<Vec<_>>()
    );
}

#[test]
fn the_roof_has_its_five_patches() {
    check(&unit_square(200, |x, y| {
        let heights = roof(x, y).0;
        heights[0].max(heights[1]).max(heights[2])
    }));
}

#[test]
fn and_has_them_still_once_it_was_solved_from_noise() {
    let options = ExampleOptions {
        size: 200,
        noise: 0.01,
        seed: 1,
    };
    let input = Example::Roof.generate(&options).unwrap().input;
    let lattice = input.to_lattice(None).unwrap();
    let surface = fit(&lattice, &Options::paper()).unwrap();
    check(surface.heightfield());
}

#[test]
fn a_fold_has_its_length_and_angle() {
    // Slopes of 0.3 and −0.5 on either side of a slanting line through the middle.
    let (sin, cos) = 20f64.to_radians().sin_cos();
    let fold = unit_square(150, |x, y| {
        let across = cos * (x - 0.5) + sin * (y - 0.5);
        if across < 0.0 {
            0.3 * across
        } else {
            -0.5 * across
        }
    });
    let found = Patches::new(&fold, &PatchOptions::default()).unwrap();
    assert_eq!((found.patches().len(), found.creases().len()), (2, 1));
    let crease = &found.creases()[0];
    let angle = 0.3f64.atan() + 0.5f64.atan();
    assert!(
        (crease.fold - angle).abs() < 0.02,
        "{} {angle}",
        crease.fold
    );
    assert!(
        (crease.length * cos - 1.0).abs() < 0.03,
        "{}",
        crease.length
    );
    for [x, y, _] in &crease.points {
        let across = cos * (x - 0.5) + sin * (y - 0.5);
        assert!(across.abs() < 2.0 / 150.0, "{x} {y}");
    }
    let area: f64 = found.patches().iter().map(|p| p.area).sum();
    let exact = 0.5 * (1.09f64.sqrt() + 1.25f64.sqrt());
    assert!((area / exact - 1.0).abs() < 0.02, "{area} {exact}");
}

#[test]
fn what_is_smooth_is_one_patch() {
    for f in [
        (|_, _| 0.0) as fn(f64, f64) -> f64,
        |x, y| (0.6 - (0.8 * x + 0.6 * y - 0.7).powi(2)).sqrt(),
        |x, y| 0.1 * (7.0 * x).sin() * y,
    ] {
        let found = Patches::new(&unit_square(100, f), &PatchOptions::default()).unwrap();
        assert_eq!(found.patches().len(), 1);
        assert!(found.creases().is_empty());
    }
}

#[test]
fn nonsense_is_refused() {
    let code = |options| {
        Patches::new(&unit_square(9, |_, _| 0.0), &options)
            .unwrap_err()
            .code()
    };
    assert_eq!(code(PatchOptions::default().bend(0.0)), "OPTION");
    assert_eq!(code(PatchOptions::default().smallest(1.5)), "OPTION");
}
