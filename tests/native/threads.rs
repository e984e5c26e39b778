//! Solves on several threads: the same surface to the last bit, and what the report says of the threads.

use crate::native::common::{cut, noisy, unit_square};
use developable::{
    Energy, Heightfield, Input, Options, Report, Schedule, Surface, ThreadLimit, fit,
};

/// Two sheets that meet in a crease, one of them bent, with a hole.
fn sheets(cols: usize) -> Heightfield {
    let field = unit_square(cols, |x, y| {
        0.2 * (x + 0.3 * y - 0.5).abs() + if y > 0.5 { 0.1 * (4.0 * x).sin() } else { 0.0 }
    });
    cut(&noisy(&field, 0.004, 7), |x, y| {
        (x - 0.3).hypot(y - 0.4) > 0.1
    })
}

/// A report without the times and the threads.
fn figures(report: &Report) -> String {
    let mut report = report.clone();
    report.seconds = Default::default();
    (report.threads, report.thread_limit) = (1, ThreadLimit::Options);
    format!("{report:?}")
}

fn assert_same(one: &Surface, other: &Surface, what: &str) {
    let bits = |surface: &Surface| -> Vec<u64> {
        let heights = surface.heightfield().heights();
        heights.iter().map(|z| z.to_bits()).collect()
    };
    assert!(bits(one) == bits(other), "{what}");
    assert_eq!(figures(one.report()), figures(other.report()), "{what}");
}

#[test]
fn one_to_sixteen_threads_give_the_same_bits() {
    let field = sheets(420);
    let options = Options::default().lambda(1e6).max_iterations(12);
    let one = fit(&field, &options.threads(1)).unwrap();
    assert!(one.report().interior > 16 * 4096);
    for threads in [2, 3, 5, 8, 11, 16] {
        let surface = fit(&field, &options.threads(threads)).unwrap();
        assert_eq!(surface.report().threads, threads);
        assert_eq!(surface.report().thread_limit, ThreadLimit::Options);
        assert_same(&one, &surface, &format!("{threads} threads"));
    }
}

#[test]
fn every_energy_and_schedule_gives_the_same_bits() {
    let field = sheets(200);
    let weights = |vertex: usize| [1.0, 0.25, 0.0][vertex % 3];
    let confidence = (0..field.lattice().len()).map(weights).collect();
    let weighted = Input::new(field.clone())
        .with_confidence(confidence)
        .unwrap();
    let plain = Input::new(field.clone());
    let few = Options::default().max_iterations(30);
    let cases = [
        (&plain, few),
        (&plain, few.lambda(1e6).gap(1e-4)),
        (&weighted, few.lambda(1e6)),
        (&weighted, few.lambda(1e6).energy(Energy::Nuclear)),
        (&plain, few.lambda(1e5).energy(Energy::SecondForm)),
        (&plain, few.lambda(1e6).energy(Energy::SquaredNuclear)),
        (&plain, few.lambda(1e6).energy(Energy::Frobenius)),
        (
            &plain,
            few.lambda(1e6).energy(Energy::Nuclear).reweighting(1),
        ),
        (&plain, few.or_paper().schedule(Schedule::Paper)),
    ];
    for (input, options) in cases {
        let one = fit(input.clone(), &options.threads(1)).unwrap();
        for threads in [2, 3] {
            let surface = fit(input.clone(), &options.threads(threads)).unwrap();
            assert_eq!(surface.report().threads, threads);
            assert_same(&one, &surface, &format!("{options:?}"));
        }
    }
}

#[test]
fn the_report_says_why_there_are_not_more_threads() {
    let threads = |cols: usize, options: Options| {
        let options = options.lambda(1e6).max_iterations(1);
        let surface = fit(sheets(cols), &options).unwrap();
        (surface.report().threads, surface.report().thread_limit)
    };
    let auto = Options::default();
    let cores = std::thread::available_parallelism().unwrap().get();
    assert_eq!(threads(40, auto), (1, ThreadLimit::Vertices));
    assert_eq!(threads(40, auto.threads(3)), (1, ThreadLimit::Vertices));
    assert_eq!(threads(200, auto.threads(1)), (1, ThreadLimit::Options));
    let (most, limit) = threads(200, auto.threads(256));
    assert!(
        (2..=11).contains(&most) && limit == ThreadLimit::Vertices,
        "{most}"
    );
    let expected = if cores <= most {
        (cores, ThreadLimit::Cores)
    } else {
        (most, ThreadLimit::Vertices)
    };
    assert_eq!(threads(200, auto), expected);
}

#[test]
fn a_number_of_threads_out_of_range_is_an_error() {
    for threads in [0, 257] {
        let error = Options::default().threads(threads).validate().unwrap_err();
        assert_eq!(error.code(), "OPTION");
    }
}
