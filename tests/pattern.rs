//! Surfaces cut into sheets that lie flat.
#![cfg(not(target_arch = "wasm32"))]

mod common;

use common::unit_square;
use developable::Heightfield;
use developable::patches::{PatchOptions, Patches};
use developable::pattern::{PatternOptions, Sheet, pattern};

fn sheets(surface: &Heightfield) -> (Patches, Vec<Sheet>) {
    let patches = Patches::new(surface, &PatchOptions::default()).unwrap();
    let sheets = pattern(surface, &patches, &PatternOptions::default()).unwrap();
    (patches, sheets)
}

#[test]
fn a_zigzag_stays_in_one_piece() {
    // Four strips, three folds.
    let (patches, sheets) = sheets(&unit_square(100, |x, _| {
        let t = 4.0 * (x - 0.003);
        0.1 * (t - 2.0 * (0.5 * t).round()).abs()
    }));
    assert_eq!(patches.patches().len(), 4);
    assert_eq!(sheets.len(), 1);
    assert_eq!(sheets[0].patches, [0, 1, 2, 3]);
    assert_eq!(sheets[0].folds.len(), 3);
    // As wide as its strips together.
    let places = sheets[0].flat.places();
    let extent = |k: usize| {
        let values = || places.iter().map(|p| p[k]);
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    };
    let slope = (1.0f64 + 0.16).sqrt();
    assert!((extent(0) / slope - 1.0).abs() < 0.015, "{}", extent(0));
}

#[test]
fn a_pyramid_is_cut_along_one_of_its_edges() {
    // Four faces around an apex that lacks a part of a full turn.
    let (patches, sheets) = sheets(&unit_square(100, |x, y| {
        -0.8 * (x - 0.503).abs().max((y - 0.502).abs())
    }));
    assert_eq!(patches.patches().len(), 4);
    assert_eq!(sheets.len(), 1);
    assert_eq!(sheets[0].folds.len(), 3);
    assert!(sheets[0].flat.report().distortion.rms < 0.01);
}

#[test]
fn vaults_that_meet_in_a_curve_come_apart() {
    // A barrel vault through a lower one: the creases are curved, and no flat sheet has both sides.
    let arc = |v: f64| (0.49 - (v - 0.5).powi(2)).sqrt();
    let (patches, sheets) = sheets(&unit_square(100, move |x, y| (arc(x) - 0.05).max(arc(y))));
    assert_eq!(patches.patches().len(), 3);
    assert_eq!(
        sheets.len(),
        3,
        "{:?}",
        sheets.iter().map(|s| &s.patches).collect::<Vec<_>>()
    );
    for sheet in &sheets {
        assert!(sheet.folds.is_empty());
        assert!(sheet.flat.report().distortion.rms < 0.001);
    }
}
