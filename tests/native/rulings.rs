//! Rulings of surfaces whose rulings are known.

use crate::native::common::{noisy, unit_square};
use developable::rulings::{Rulings, TraceOptions};
use developable::{Frame, Heightfield, Lambda, Options, Triangulation, fit};

fn tube(x: f64, y: f64) -> f64 {
    let (sin, cos) = 25f64.to_radians().sin_cos();
    (0.81 - (cos * (x - 0.5) + sin * (y - 0.5)).powi(2)).sqrt()
}

/// Along the cylinder's axis.
fn tube_ruling(_: f64, _: f64) -> [f64; 2] {
    let (sin, cos) = 25f64.to_radians().sin_cos();
    [-sin, cos]
}

fn cone(x: f64, y: f64) -> f64 {
    -0.8 * (x - 0.5).hypot(y + 0.2)
}

/// Away from the apex.
fn cone_ruling(x: f64, y: f64) -> [f64; 2] {
    let r = (x - 0.5).hypot(y + 0.2);
    [(x - 0.5) / r, (y + 0.2) / r]
}

fn rulings(surface: &Heightfield) -> Rulings {
    let mesh = Triangulation::new(surface, &Frame::default()).unwrap();
    Rulings::new(mesh.mesh()).unwrap()
}

/// Directions seen from above, and their confidence.
fn directions(surface: &Heightfield) -> (Vec<[f64; 2]>, Vec<f64>) {
    let mesh = Triangulation::new(surface, &Frame::default()).unwrap();
    rulings(surface).on_lattice(&mesh).unwrap()
}

/// Largest angle to the true rulings, in degrees, at least `away` from the border.
fn error(surface: &Heightfield, ruling: fn(f64, f64) -> [f64; 2], away: f64) -> f64 {
    let (directions, confidence) = directions(surface);
    let lattice = surface.lattice();
    let mut worst = 0.0f64;
    for i in 0..lattice.len() {
        let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
        let inside = |v: f64| (away..=1.0 - away).contains(&v);
        if inside(x) && inside(y) {
            let ([a, b], [c, d]) = (directions[i], ruling(x, y));
            worst = worst.max((a * d - b * c).abs().asin().to_degrees());
            assert!(confidence[i] > 0.5, "{x} {y}");
        }
    }
    worst
}

#[test]
fn right_to_one_degree_on_a_cylinder_and_a_cone() {
    for (name, height, ruling) in [
        (
            "cylinder",
            tube as fn(f64, f64) -> f64,
            tube_ruling as fn(f64, f64) -> [f64; 2],
        ),
        ("cone", cone, cone_ruling),
    ] {
        let worst = error(&unit_square(100, height), ruling, 0.05);
        println!("{name}: {worst:.2}°");
        assert!(worst < 1.0, "{name}: {worst}");
    }
}

#[test]
fn traced_lines_are_straight_and_evenly_spaced() {
    for (height, ruling) in [
        (
            tube as fn(f64, f64) -> f64,
            tube_ruling as fn(f64, f64) -> [f64; 2],
        ),
        (cone, cone_ruling),
    ] {
        let lines = rulings(&unit_square(100, height))
            .trace(&TraceOptions::default().separation(0.08))
            .unwrap();
        assert!(lines.len() >= 8, "{}", lines.len());
        for line in &lines {
            assert!(line.deviation < 0.005, "{}", line.deviation);
            let (p, q) = (line.points[0], line.points[line.points.len() - 1]);
            let [u, v] = ruling(0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]));
            let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
            assert!(((dx * v - dy * u) / dx.hypot(dy)).abs() < 0.02);
        }
        // No two come closer than half the separation, but for a step.
        for (i, a) in lines.iter().enumerate() {
            for b in &lines[..i] {
                for p in &a.points {
                    for q in &b.points {
                        let apart = (p[0] - q[0]).hypot(p[1] - q[1]).hypot(p[2] - q[2]);
                        assert!(apart > 0.035);
                    }
                }
            }
        }
    }
}

#[test]
fn lines_end_at_creases_and_planes_have_none() {
    let ridge = unit_square(100, |x, y| {
        let arch = |v: f64| (0.49 - (v - 0.5).powi(2)).sqrt();
        arch(x).max(arch(y))
    });
    let lines = rulings(&ridge).trace(&TraceOptions::default()).unwrap();
    assert!(!lines.is_empty());
    for line in &lines {
        // The vaults meet on the diagonals.
        let side = |p: &[f64; 3]| ((p[0] - p[1]).abs() > 0.03).then_some(p[0] > p[1]);
        let mut sides = line.points.iter().filter_map(side);
        let first = sides.next();
        assert!(sides.all(|s| Some(s) == first));
    }
    let plane = rulings(&unit_square(40, |x, y| x + 2.0 * y));
    assert!(plane.trace(&TraceOptions::default()).unwrap().is_empty());
    for confidence in [-0.1, 1.1, f64::NAN] {
        let error = plane.trace(&TraceOptions::default().confidence(confidence));
        assert_eq!(error.unwrap_err().code(), "OPTION");
    }
}

#[test]
fn most_are_right_once_noise_was_solved_away() {
    let truth = unit_square(150, tube);
    let surface = fit(
        noisy(&truth, 0.003, 4),
        &Options::paper().lambda(Lambda::Small),
    )
    .unwrap();
    let field = surface.heightfield();
    let (directions, confidence) = directions(field);
    let lattice = field.lattice();
    let mut angles = Vec::new();
    for i in (0..lattice.len()).filter(|i| confidence[*i] > 0.5) {
        let ([a, b], [c, d]) = (directions[i], tube_ruling(0.0, 0.0));
        angles.push((a * d - b * c).abs().asin().to_degrees());
    }
    angles.sort_by(f64::total_cmp);
    println!(
        "{} sure, median {:.2}°",
        angles.len(),
        angles[angles.len() / 2]
    );
    assert!(angles.len() > lattice.len() / 4);
    assert!(
        angles[angles.len() / 2] < 5.0,
        "{}",
        angles[angles.len() / 2]
    );
}
