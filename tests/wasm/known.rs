//! What may be known besides heights has the same closed forms everywhere.

macro_rules! known_tests {
    ($test:meta) => {
        mod known {
            use developable::{
                Heightfield, Input, Lattice, Normalization, Occlusions, Options, Solver, Status,
                fit,
            };

            fn plane(x: f64, y: f64) -> f64 {
                3.0 + 0.4 * x - 0.7 * y
            }

            fn lattice() -> Lattice {
                Lattice::new(14, 16, 0.5).unwrap()
            }

            #[$test]
            fn three_points_give_their_plane() {
                let truth = Heightfield::from_fn(lattice(), plane).unwrap();
                let points = [17, 30, 200];
                let constraints = (truth.heights().iter().enumerate())
                    .map(|(i, z)| if points.contains(&i) { *z } else { f64::NAN })
                    .collect();
                let constraints = Heightfield::new(lattice(), constraints).unwrap();
                let input = Input::design(constraints, None).unwrap();
                let surface = fit(input, &Options::paper()).unwrap();
                assert_eq!(surface.report().constrained, 3);
                for (a, b) in surface.heightfield().heights().iter().zip(truth.heights()) {
                    assert!((a - b).abs() < 1e-6, "{a} {b}");
                }
            }

            #[$test]
            fn two_points_do_not() {
                let mut points = vec![f64::NAN; lattice().len()];
                points[20] = 1.0;
                points[40] = 2.0;
                let points = Heightfield::new(lattice(), points).unwrap();
                let input = Input::design(points, None).unwrap();
                let error = fit(input, &Options::paper()).unwrap_err();
                assert_eq!(error.code(), "UNDERDETERMINED");
            }

            #[$test]
            fn a_torn_step_stays() {
                let step = |x, y| plane(x, y) + if x > 3.6 { 5.0 } else { 0.0 };
                let field = Heightfield::from_fn(lattice(), step).unwrap();
                let torn = Occlusions::detect(&field, 5.0, Normalization::Off).unwrap();
                assert!(torn.len() > 14);
                let input = Input::new(field.clone()).with_occlusions(torn).unwrap();
                let surface = fit(input, &Options::paper()).unwrap();
                assert!(surface.report().objective < 1e-9);
                for (a, b) in surface.heightfield().heights().iter().zip(field.heights()) {
                    assert!((a - b).abs() < 1e-6, "{a} {b}");
                }
            }

            #[$test]
            fn a_restart_is_certified_anew() {
                let wave = |x: f64, y: f64| plane(x, y) + 0.3 * (9.0 * x).sin() * (7.0 * y).cos();
                let field = Heightfield::from_fn(lattice(), wave).unwrap();
                let mut solver = Solver::new(&field, &Options::paper()).unwrap();
                while solver.advance(50).unwrap() == Status::Running {}
                let options = Options::paper().lambda(2e6).gap(1e-3);
                solver.restart(&options).unwrap();
                while solver.advance(50).unwrap() == Status::Running {}
                let warm = solver.surface().unwrap();
                let cold = fit(&field, &options).unwrap();
                let (a, b) = (warm.report(), cold.report());
                assert!(a.is_certified(1e-3) && a.lambda == 2e6);
                assert!((a.objective - b.objective).abs() <= 2e-3 * b.objective);
                assert!(a.dual_bound <= b.objective && b.dual_bound <= a.objective);
            }
        }
    };
}
pub(crate) use known_tests;
