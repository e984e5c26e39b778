//! How close to the truth `lambda: auto` with the energy `huber` comes, without any parameter, beside
//! the nuclear norm with the λ that is best for each scene, which only who knows the truth can pick.
//!
//! ```sh
//! cargo run --release --example scenes > benches/scenes.md
//! cargo run --release --example scenes -- 100 fan correlated
//! ```
//!
//! The second form is for one size, or several (`100,150`), and for scenes and noises whose names begin
//! so. `-- pictures docs` writes six of them as pictures, and the page that shows them, to the folder
//! `docs`; `-- meshes FOLDER` all of them as meshes, for `benches/pymeshlab/compare.py`.

mod distance;
mod meshes;
mod noise;
mod pictures;
mod shapes;

use std::path::Path;

use developable::{Heightfield, LambdaReason, Lattice, Options, Report, Result, fit};

use distance::Distance;
use noise::Noise;
use shapes::Scene;

const SIZES: [usize; 2] = [80, 200];

const NOISES: [Noise; 25] = [
    Noise::White(0.005),
    Noise::White(0.01),
    Noise::White(0.02),
    Noise::White(0.05),
    Noise::White(0.1),
    Noise::Correlated(0.01),
    Noise::Correlated(0.05),
    Noise::Blurred(0.02, [3.0, 0.0]),
    Noise::Blurred(0.005, [1.0, 1.0]),
    Noise::Blurred(0.01, [1.0, 1.0]),
    Noise::Blurred(0.02, [1.0, 1.0]),
    Noise::Blurred(0.005, [1.6, 1.6]),
    Noise::Blurred(0.01, [1.6, 1.6]),
    Noise::Blurred(0.02, [1.6, 1.6]),
    Noise::Blurred(0.005, [2.5, 2.5]),
    Noise::Blurred(0.01, [2.5, 2.5]),
    Noise::Blurred(0.02, [2.5, 2.5]),
    Noise::Blurred(0.005, [4.0, 4.0]),
    Noise::Blurred(0.01, [4.0, 4.0]),
    Noise::Blurred(0.02, [4.0, 4.0]),
    Noise::Blurred(0.01, [3.0, 0.0]),
    Noise::Blurred(0.01, [4.0, 1.0]),
    Noise::Voxels(0.01),
    Noise::Voxels(0.03),
    Noise::Voxels(0.1),
];

/// Half-decades about `8/σh` among which the best λ is picked, for normals and heights apart.
const DECADES: [f64; 8] = [-2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5];

/// One scene under one noise.
struct Row {
    scene: &'static str,
    size: usize,
    noise: Noise,
    /// The best of the nuclear norm, and ours.
    oracle: Distance,
    own: Distance,
    report: Report,
    /// `8/σh`.
    first: f64,
    /// Seconds of a solve with the nuclear norm at the best λ for normals; of ours with its options
    /// given; and of the search for them.
    seconds: [f64; 3],
}

impl Row {
    fn ratios(&self) -> [f64; 2] {
        [
            self.own.normals / self.oracle.normals,
            self.own.heights / self.oracle.heights,
        ]
    }
}

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1).peekable();
    for (what, write) in [
        ("pictures", pictures::write as fn(&Path) -> _),
        ("meshes", meshes::write),
    ] {
        if args.next_if_eq(what).is_some() {
            return write(args.next().ok_or("name a folder for them")?.as_ref());
        }
    }
    let sizes = args.next().map_or(SIZES.to_vec(), |list| {
        list.split(',').filter_map(|n| n.parse().ok()).collect()
    });
    let name = args.next().unwrap_or_default();
    let only = args.next().unwrap_or_default();
    let mut rows = Vec::new();
    for scene in shapes::all().iter().filter(|s| s.name.starts_with(&name)) {
        for &size in &sizes {
            let chosen = |noise: &Noise| noise.to_string().starts_with(&only);
            for noise in NOISES.into_iter().filter(chosen) {
                rows.push(measure(scene, size, noise)?);
                eprintln!("{} of {size}, {noise}", scene.name);
            }
        }
    }
    write(&rows);
    Ok(())
}

fn measure(scene: &Scene, size: usize, noise: Noise) -> Result<Row> {
    let lattice = Lattice::covering([0.0, 0.0], [1.0, 1.0], 1.0 / size as f64)?;
    let truth = Heightfield::from_fn(lattice, scene.height)?;
    let input = noise.add_to(&truth)?;
    let first = 8.0 * size as f64 / noise.sigma(&truth);
    let solve = |options: Options| -> Result<(Distance, Report)> {
        let surface = fit(&input, &options)?;
        let distance = Distance::between(&truth, surface.heightfield());
        Ok((distance, surface.report().clone()))
    };
    let mut oracle = Distance {
        normals: f64::INFINITY,
        heights: f64::INFINITY,
    };
    let mut nuclear = 0.0;
    for decade in DECADES {
        let (found, report) = solve(Options::paper().lambda(first * 10f64.powf(decade)))?;
        if found.normals < oracle.normals {
            nuclear = report.seconds.total;
        }
        oracle.normals = oracle.normals.min(found.normals);
        oracle.heights = oracle.heights.min(found.heights);
    }
    let huber = Options::default();
    let (own, report) = solve(huber)?;
    let mut given = huber.lambda(report.lambda);
    if let Some(used) = report.huber {
        given = given
            .bend_radius(used.bend_radius)
            .flatness(used.flatness)
            .crease_radius(used.crease_radius);
    }
    let plain = solve(given)?.1.seconds.total;
    let seconds = [nuclear, plain, (report.seconds.total - plain).max(0.0)];
    Ok(Row {
        scene: scene.name,
        size,
        noise,
        oracle,
        own,
        report,
        first,
        seconds,
    })
}

fn write(rows: &[Row]) {
    println!(
        "## Scenes\n\n\
         Written by `cargo run --release --example scenes`. Noisy developable surfaces, and envelopes of \
         some, over the unit square (`examples/scenes/shapes.rs`). `huber` with λ by itself, without any \
         parameter, beside the nuclear norm with the best of six λ, picked by the truth for each scene, \
         and for normals and heights apart. Ratios of errors, below 1 where ours are smaller: \
         geometric means and the largest, over all scenes but the plane; of normals (mean angle) and \
         heights (root mean square). Times: ours with its options given, relative to the nuclear norm's, \
         and the search for them, relative to that.\n"
    );
    println!(
        "| size | noise | normals | largest | above 1 | heights | largest | time | search |\n\
         | ---: | :--- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
    );
    let bent: Vec<&Row> = rows.iter().filter(|row| row.scene != "plane").collect();
    let mut sizes: Vec<usize> = bent.iter().map(|row| row.size).collect();
    sizes.sort_unstable();
    sizes.dedup();
    for size in sizes {
        for noise in NOISES {
            let label = noise.to_string();
            let of = |row: &&&Row| row.size == size && row.noise.to_string() == label;
            let chosen: Vec<&Row> = bent.iter().filter(of).copied().collect();
            if !chosen.is_empty() {
                println!("| {size} | {label} | {} |", summary(&chosen));
            }
        }
    }
    println!("| all | all | {} |\n", summary(&bent));
    println!(
        "| scene | size | noise | nuclear ° | huber ° | ratio | heights | λ σh / 8 | flatness | radius | \
         creases | from |\n\
         | :--- | ---: | :--- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | :--- |"
    );
    for row in rows {
        let [normals, heights] = row.ratios();
        let (report, used) = (&row.report, row.report.huber);
        println!(
            "| {} | {} | {} | {:.3} | {:.3} | {normals:.2} | {heights:.2} | {:.2} | {:.1} | {:.1} | \
             {:.1} % | {} |",
            row.scene,
            row.size,
            row.noise,
            row.oracle.normals,
            row.own.normals,
            report.lambda / row.first,
            used.map_or(f64::NAN, |used| used.flatness),
            used.map_or(f64::NAN, |used| used.bend_radius),
            used.map_or(0.0, |used| 100.0 * used.creases as f64
                / report.interior as f64),
            match report.lambda_choice.map(|choice| choice.reason) {
                Some(LambdaReason::Prediction) => "prediction",
                Some(LambdaReason::Noise) => "noise",
                _ => "else",
            }
        );
    }
}

fn summary(rows: &[&Row]) -> String {
    let mean = |values: &dyn Fn(&Row) -> f64| {
        let logs: f64 = rows.iter().map(|row| values(row).ln()).sum();
        (logs / rows.len() as f64).exp()
    };
    let largest = |k: usize| rows.iter().map(|row| row.ratios()[k]).fold(0.0, f64::max);
    let above = rows.iter().filter(|row| row.ratios()[0] > 1.0).count();
    let search: f64 = rows.iter().map(|row| row.seconds[2] / row.seconds[1]).sum();
    format!(
        "{:.2} | {:.2} | {above} of {} | {:.2} | {:.2} | {:.1} | {:.1}",
        mean(&|row| row.ratios()[0]),
        largest(0),
        rows.len(),
        mean(&|row| row.ratios()[1]),
        largest(1),
        mean(&|row| row.seconds[1] / row.seconds[0]),
        search / rows.len() as f64
    )
}
