//! Patterns at several λ and sizes of patches.

use crate::common::unit_square;
use developable::Heightfield;
use developable::explore::{ExploreOptions, Plan, explore, finest};

/// λ at which a surface on the unit square is next to its input, and at which it is next to a plane.
const LARGE: f64 = 1e7;
const TINY: f64 = 1e-4;

/// Four faces that rise and fall in turns around a point: the angles around it come to more than a full turn, so
/// that no single sheet can be folded to them, and two can.
fn saddle() -> Heightfield {
    unit_square(40, |x, y| 0.5 * (x - 0.512).abs() - 0.5 * (y - 0.507).abs())
}

fn options() -> ExploreOptions {
    ExploreOptions {
        lambdas: vec![TINY, LARGE],
        smallest: vec![0.05, 0.01],
        ..ExploreOptions::default()
    }
}

fn order(plan: &Plan) -> (f64, f64) {
    (plan.lambda, plan.smallest)
}

#[test]
fn a_saddle_of_planes_takes_two_sheets_and_a_plane_one() {
    let plans = explore(saddle(), &options()).unwrap();
    let plans: Vec<Plan> = plans.collect::<Result<_, _>>().unwrap();
    let orders: Vec<_> = plans.iter().map(order).collect();
    let expected = [(LARGE, 0.01), (LARGE, 0.05), (TINY, 0.01), (TINY, 0.05)];
    assert_eq!(orders, expected);
    for plan in &plans[..2] {
        let found = plan.outcome.as_ref().unwrap();
        assert_eq!(plan.sheets(), Some(2));
        let told = &found.drawing.summary;
        assert_eq!((told.sheets, told.folds, told.slits), (2, 2, 0));
        assert!(plan.distance < 0.005, "{}", plan.distance);
    }
    // Of a plane, what remains are two of the hats |x − ½|/2, each of which is off its mean by 1/(4√12).
    let plane = 2f64.sqrt() / (4.0 * 12f64.sqrt());
    for plan in &plans[2..] {
        let told = &plan.outcome.as_ref().unwrap().drawing.summary;
        assert_eq!((plan.sheets(), told.folds, told.slits), (Some(1), 0, 0));
        assert!(told.strain < 1e-4);
        assert!(
            (plan.distance / plane - 1.0).abs() < 0.05,
            "{}",
            plan.distance
        );
    }
    assert!(plans.iter().all(|plan| plan.seconds > 0.0));
}

#[test]
fn the_finest_plan_is_the_first_with_few_enough_sheets() {
    let wanted = |sheets| {
        let plan = finest(explore(saddle(), &options()).unwrap(), sheets).unwrap();
        plan.as_ref().map(order)
    };
    assert_eq!(wanted(1), Some((TINY, 0.01)));
    assert_eq!(wanted(2), Some((LARGE, 0.01)));
    assert_eq!(wanted(0), None);
}

#[test]
fn it_says_what_is_wrong() {
    let code = |options: &ExploreOptions| {
        let mut plans = explore(saddle(), options)?;
        plans.try_for_each(|plan| plan.map(drop))
    };
    let with = |change: fn(&mut ExploreOptions)| {
        let mut options = options();
        change(&mut options);
        code(&options).unwrap_err().to_string()
    };
    assert!(with(|o| o.lambdas.clear()).contains("lambdas"));
    assert!(with(|o| o.smallest.clear()).contains("smallest"));
    assert!(with(|o| o.smallest[0] = 2.0).contains("smallest"));
    assert!(with(|o| o.lambdas[0] = -1.0).contains("lambda"));
    assert!(with(|o| o.drawing.scale = 0.0).contains("scale"));
}
