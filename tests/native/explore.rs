//! Patterns at several λ and sizes of patches.

use crate::native::common::unit_square;
use developable::Heightfield;
use developable::analysis::Deviation;
use developable::drawing::{Drawing, DrawingOptions};
use developable::explore::Trials;
use developable::patches::{PatchOptions, Patches};
use developable::pattern::{PatternOptions, pattern};
use developable::{Options, Solver, Status};

/// λ at which a surface on the unit square is next to its input, and at which it is next to a plane.
const LARGE: f64 = 1e7;
const TINY: f64 = 1e-4;

/// Four faces that rise and fall in turns around a point: the angles around it come to more than a full turn, so
/// that no single sheet can be folded to them, and two can.
fn saddle() -> Heightfield {
    unit_square(40, |x, y| 0.5 * (x - 0.512).abs() - 0.5 * (y - 0.507).abs())
}

#[test]
fn trials_go_from_the_input_to_the_plainest() {
    let trials = Trials {
        lambdas: vec![TINY, LARGE],
        smallest: vec![0.05, 0.01],
    };
    let trials = trials.in_order();
    assert_eq!(trials.lambdas, [LARGE, TINY]);
    assert_eq!(trials.smallest, [0.01, 0.05]);
    assert_eq!(Trials::for_mesh(10.0).lambdas, [10.0, 3.0, 1.0, 0.3]);
}

#[test]
fn a_saddle_of_planes_takes_two_sheets_and_a_plane_one() {
    let mut solver = Solver::new(saddle(), &Options::paper()).unwrap();
    // Of a plane, what remains are two of the hats |x − ½|/2, each of which is off its mean by 1/(4√12).
    let plane = 2f64.sqrt() / (4.0 * 12f64.sqrt());
    for (lambda, sheets, folds, distances) in [
        (LARGE, 2, 2, 0.0..0.005),
        (TINY, 1, 0, 0.95 * plane..1.05 * plane),
    ] {
        solver.restart(&Options::paper().lambda(lambda)).unwrap();
        while solver.advance(usize::MAX).unwrap() == Status::Running {}
        let surface = solver.surface().unwrap().into_heightfield();
        let distance = Deviation::between(&surface, &saddle()).unwrap().rms;
        assert!(distances.contains(&distance), "{distance}");
        for smallest in [0.01, 0.05] {
            let options = PatchOptions::default().smallest(smallest);
            let patches = Patches::new(&surface, &options).unwrap();
            let found = pattern(&surface, &patches, &PatternOptions::default()).unwrap();
            let drawn = Drawing::new(&found.sheets, &DrawingOptions::default()).unwrap();
            let told = &drawn.summary;
            assert_eq!((told.sheets, told.folds, told.slits), (sheets, folds, 0));
        }
    }
}
