//! Writes `tests/fixtures/*.json`: small inputs with the results of this very
//! code, which the wasm build has to reproduce.
//!
//! `cargo run --release --example fixtures`, after a change that is meant to
//! change results.

#[path = "../tests/fixtures/case.rs"]
mod case;

use std::path::Path;

use case::{Case, Fixture, Input, Settings};
use serde_json::json;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    for (name, case) in cases() {
        let expected = case.run()?;
        let text = serde_json::to_string(&Fixture { case, expected })?;
        std::fs::write(folder.join(format!("{name}.json")), text + "\n")?;
        println!("tests/fixtures/{name}.json");
    }
    Ok(())
}

fn cases() -> Vec<(&'static str, Case)> {
    vec![
        ("cylinder_image", cylinder_image()),
        ("holed_page", holed_page()),
        ("dead_pixels", dead_pixels()),
        ("roof_small", roof(24, json!("small"))),
        ("roof_medium", roof(24, json!("medium"))),
        ("roof_big", roof(24, json!("big"))),
        ("roof_on_levels", roof(56, json!("medium"))),
        ("tiny_lattice", tiny_lattice()),
        ("paper_schedule", paper_schedule()),
        ("strips_and_weights", strips_and_weights()),
    ]
}

/// A quarter of a cylinder under noise.
fn cylinder_image() -> Case {
    let mut noise = Noise(1);
    let input = image(28, 20, 0.5, |x, y| {
        let across = x - 0.4 * y - 5.0;
        Some((100.0 - across * across).max(0.0).sqrt() + 0.1 * noise.next())
    });
    Case {
        input,
        options: settings(),
    }
}

/// A curled page with a hole and a torn corner, on a lattice coarser than its pixels.
fn holed_page() -> Case {
    let mut noise = Noise(2);
    let input = image(30, 24, 1.0, |x, y| {
        let hole = (x - 11.0).powi(2) + (y - 14.0).powi(2) < 9.0;
        let corner = x + y > 46.0;
        let height = 0.004 * x * x + 1.5 * (-0.15 * (x + 0.3 * y)).exp() + 0.05 * noise.next();
        (!hole && !corner).then_some(height)
    });
    let options = Settings {
        lambda: json!(3e5),
        spacing: Some(1.25),
        ..settings()
    };
    Case { input, options }
}

/// A quarter of whose pixels is missing, and a column.
fn dead_pixels() -> Case {
    let mut noise = Noise(5);
    let input = image(26, 22, 0.5, |x, y| {
        let dead = noise.next() < -0.5 || (x - 7.25).abs() < 0.1;
        let across = x + 0.3 * y - 8.0;
        (!dead).then(|| 0.06 * across * across + 0.05 * noise.next())
    });
    Case {
        input,
        options: settings(),
    }
}

/// Two planes and a cone, lower envelope, straight on the lattice and with an
/// island. Finer lattices are solved from coarse to fine.
fn roof(size: usize, lambda: serde_json::Value) -> Case {
    let mut noise = Noise(3);
    let input = lattice(size + 2, size, 0.48 / size as f64, |x, y| {
        let height = (0.3 * x)
            .min(0.25 - 0.5 * x)
            .min(0.2 - 0.4 * (x * x + y * y).sqrt() + 0.1);
        let moat = (0.28..0.33).contains(&x) && y < -0.1;
        (!moat).then_some(height + 0.001 * noise.next())
    });
    let options = Settings {
        lambda,
        gap: Some(1e-3),
        // The moat is two cells wide.
        bridge: Some(false),
        ..settings()
    };
    Case { input, options }
}

/// One interior vertex, and one that no stencil touches.
fn tiny_lattice() -> Case {
    let heights = [0.0, 1.0, 0.5, -0.5, 2.0, 1.0, 0.25, -1.0, 0.75];
    let mut values = heights.into_iter();
    let input = lattice(3, 3, 1.0, |_, _| values.next());
    let options = Settings {
        lambda: json!(2.0),
        gap: Some(1e-6),
        normalize: false,
        ..settings()
    };
    Case { input, options }
}

fn paper_schedule() -> Case {
    let mut noise = Noise(4);
    let input = lattice(16, 18, 1.0, |x, y| {
        Some(0.02 * (x + y) * (x + y) + 0.2 * noise.next())
    });
    let options = Settings {
        schedule: "paper".into(),
        gap: None,
        max_iterations: 300,
        ..settings()
    };
    Case { input, options }
}

/// Runs of every length from 1 to some dozens, weights of many sizes and vertices without any: all
/// that is converted between single and double precision, often enough to be optimised.
fn strips_and_weights() -> Case {
    let mut noise = Noise(5);
    let (rows, cols) = (36, 40);
    let mut input = lattice(rows, cols, 0.02, |x, y| {
        let (col, row) = ((x / 0.02 + 0.6) as usize, (-y / 0.0173) as usize);
        let slit = row % 9 < 6 && (col * col / 7) % 11 == row % 4;
        let height = 0.2 * (5.0 * x).sin() * (4.0 * y).cos() + 0.01 * noise.next();
        (!slit).then_some(height)
    });
    if let Input::Lattice { confidence, .. } = &mut input {
        let weight = |i: usize| [1.0, 0.5, 1e-4, 30.0, 0.0, 2.0, 1e3][(5 * i / 3) % 7];
        *confidence = Some((0..rows * cols).map(weight).collect());
    }
    let options = Settings {
        gap: Some(1e-4),
        max_iterations: 120,
        bridge: Some(false),
        ..settings()
    };
    Case { input, options }
}

fn settings() -> Settings {
    Settings {
        paper: true,
        lambda: json!("medium"),
        schedule: "default".into(),
        gap: Some(0.01),
        max_iterations: 20_000,
        normalize: true,
        spacing: None,
        bridge: None,
    }
}

fn image(
    width: usize,
    height: usize,
    pixel_size: f64,
    mut f: impl FnMut(f64, f64) -> Option<f64>,
) -> Input {
    let data = (0..width * height)
        .map(|i| {
            let (col, row) = (i % width, i / width);
            let x = (col as f64 + 0.5) * pixel_size;
            let y = ((height - row) as f64 - 0.5) * pixel_size;
            f(x, y).map(rounded)
        })
        .collect();
    Input::Image {
        width,
        height,
        pixel_size,
        data,
    }
}

fn lattice(
    rows: usize,
    cols: usize,
    spacing: f64,
    mut f: impl FnMut(f64, f64) -> Option<f64>,
) -> Input {
    let heights = (0..rows * cols)
        .map(|i| {
            let (row, col) = (i / cols, i % cols);
            let x = (col as f64 - 0.5 * (row % 2) as f64) * spacing;
            let y = -(row as f64) * spacing * 0.75_f64.sqrt();
            f(x, y).map(rounded)
        })
        .collect();
    Input::Lattice {
        rows,
        cols,
        spacing,
        heights,
        confidence: None,
    }
}

/// Few digits: every reader of the JSON file gets the same bits, and it stays small.
fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// Noise between −1 and 1, by a linear congruential generator.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
