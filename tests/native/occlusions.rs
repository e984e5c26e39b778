//! Surfaces that are torn.

use crate::native::common::conic::Instance;
use crate::native::common::{max_difference, noisy, unit_square};
use developable::{
    Error, Heightfield, Input, Normalization, Occlusions, Options, StopReason, Surface, fit,
};

/// Distance from a line across the unit square.
fn across(x: f64, y: f64) -> f64 {
    0.8 * (x - 0.5) + 0.6 * (y - 0.45)
}

fn side(x: f64, y: f64, right: bool) -> f64 {
    if right {
        0.4 - 0.3 * x + 0.2 * y
    } else {
        0.1 * x - 0.2 * y
    }
}

/// Two planes with a jump in between.
fn step(cols: usize) -> Heightfield {
    unit_square(cols, |x, y| side(x, y, across(x, y) > 0.0))
}

/// One value for each vertex.
fn each<T>(field: &Heightfield, f: impl Fn(usize, usize, [f64; 2]) -> T) -> Vec<T> {
    let lattice = field.lattice();
    (0..lattice.len())
        .map(|i| (i / lattice.cols(), i % lattice.cols()))
        .map(|(row, col)| f(row, col, lattice.position(row, col)))
        .collect()
}

fn solve(field: &Heightfield, occlusions: Occlusions) -> Surface {
    let input = Input::new(field.clone())
        .with_occlusions(occlusions)
        .unwrap();
    fit(input, &Options::paper()).unwrap()
}

fn check(field: &Heightfield, occlusions: Occlusions) {
    let surface = solve(field, occlusions);
    let report = surface.report();
    let h = field.lattice().spacing();
    let errors = each(field, |row, col, [x, y]| {
        let z = surface.heightfield().height(row, col);
        let [own, other] =
            [across(x, y) > 0.0, across(x, y) <= 0.0].map(|right| (z - side(x, y, right)).abs());
        // At the step itself what is restored may go on from either side.
        if across(x, y).abs() < 0.9 * h {
            own.min(other)
        } else {
            own
        }
    });
    let worst = errors.into_iter().fold(0.0, f64::max);
    assert!(worst < 1e-11, "{worst:e}: {report:?}");
    assert_eq!(report.stop_reason, StopReason::Rounding);
    assert_eq!(report.gap, None);
    assert!(report.components == 2 && report.occluded > 30, "{report:?}");
}

#[test]
fn a_detected_step_leaves_two_planes() {
    let field = step(60);
    let found = Occlusions::detect(&field, 100.0, Normalization::UnitSquare).unwrap();
    check(&field, found);
    // Without it the planes are drawn towards one another.
    let whole = fit(&field, &Options::paper()).unwrap();
    assert!(max_difference(&field, whole.heightfield()) > 0.01);
}

#[test]
fn given_vertices_and_given_edges_do_the_same() {
    let field = step(60);
    let lattice = *field.lattice();
    let h = lattice.spacing();
    let near = each(&field, |_, _, [x, y]| u8::from(across(x, y).abs() <= h));
    check(&field, Occlusions::from_vertices(&lattice, &near).unwrap());
    let edges = each(&field, |row, col, [x, y]| {
        let mut bits = 0;
        for (k, n) in lattice.neighbours(row, col).into_iter().enumerate() {
            let torn = n.is_some_and(|(r, c)| {
                let [u, v] = lattice.position(r, c);
                (across(u, v) > 0.0) && (across(x, y) <= 0.0)
            });
            bits |= u8::from(torn) << k;
        }
        bits
    });
    check(&field, Occlusions::from_edges(&lattice, &edges).unwrap());
}

#[test]
fn restored_vertices_go_on_as_their_own_side_does() {
    let truth = step(60);
    let lattice = *truth.lattice();
    let h = lattice.spacing();
    // A band of nonsense, wide enough that no stencil touches its middle.
    let garbled = each(&truth, |row, col, [x, y]| {
        let nonsense = across(x, y).abs() < 1.5 * h;
        if nonsense {
            -5.0
        } else {
            truth.height(row, col)
        }
    });
    let band = each(&truth, |_, _, [x, y]| {
        u8::from(across(x, y).abs() < 2.6 * h)
    });
    let surface = solve(
        &Heightfield::new(lattice, garbled).unwrap(),
        Occlusions::from_vertices(&lattice, &band).unwrap(),
    );
    assert!(surface.report().omitted > 100, "{:?}", surface.report());
    let ends = |row: usize| row < 4 || row + 4 > lattice.rows();
    let errors = each(&truth, |row, col, [x, y]| {
        let z = surface.heightfield().height(row, col);
        match ends(row) || across(x, y).abs() < 0.3 * h {
            true => 0.0,
            false => (z - truth.height(row, col)).abs(),
        }
    });
    let worst = errors.into_iter().fold(0.0, f64::max);
    assert!(worst < 1e-11, "{worst:e}");
}

#[test]
fn torn_vertices_have_no_hessian() {
    let field = noisy(&step(15), 0.02, 1);
    for lambda in [1e4, 1e6] {
        let mut instance = Instance::new(&field, lambda);
        instance.torn = each(&field, |row, col, [x, y]| {
            across(x, y).abs() < 0.05 || (row, col) == (4, 4)
        });
        let report = instance.check();
        assert!(report.occluded > 15, "{report:?}");
        assert!(report.nuclear_norm < Instance::new(&field, lambda).check().nuclear_norm);
    }
}

#[test]
fn where_everything_is_torn_nothing_is_left() {
    let field = step(20);
    let all = vec![1; field.lattice().len()];
    let input = Input::new(field.clone())
        .with_occlusions(Occlusions::from_vertices(field.lattice(), &all).unwrap())
        .unwrap();
    let error = fit(input, &Options::paper()).unwrap_err();
    assert!(matches!(error, Error::NoInterior { .. }), "{error}");
    let other = Occlusions::from_vertices(step(10).lattice(), &vec![0; step(10).lattice().len()]);
    let error = Input::new(field).with_occlusions(other.unwrap());
    assert_eq!(error.unwrap_err().code(), "SHAPE");
}
