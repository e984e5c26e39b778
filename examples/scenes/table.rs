//! Table of how close to the truth the default comes, beside the λ that is best by the truth.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{fs, thread};

use developable::{Bridging, HeightImage, Heightfield, Input, Options, Report, Result, fit};

use super::distance::mean_angle;
use super::random_shapes::{self, Height, shape};
use super::sensors;

/// Half-decades of λ from 10³ to 10⁸ among which the best is picked.
const ORACLE_STEPS: i32 = 10;

/// File with the oracles' angles, so that a table is made again quickly.
const CACHE: &str = "target/scenes-oracles.txt";

/// What one shape under one fault has come to.
struct Row {
    name: &'static str,
    fault: &'static str,
    seed: u64,
    /// Angle of the default, of the best nuclear norm, and of the best λ of the own energy, in degrees.
    angles: [f64; 3],
    /// Root mean square distance to the truth, as a share of the height range.
    off: f64,
    /// Processor time of the default over that of the fit with its λ and parameters given.
    cost: f64,
    report: Report,
}

/// Writes the table for some sizes, for faults and shapes whose names begin so.
pub fn write(
    size: usize,
    seeds: std::ops::Range<u64>,
    fault: &str,
    name: &str,
    verbose: bool,
) -> Result<()> {
    let known: BTreeMap<String, [f64; 2]> = read_cache();
    let mut jobs = Vec::new();
    for seed in seeds.clone() {
        for (i, shape) in random_shapes::NAMES.into_iter().enumerate() {
            let faults = if i < random_shapes::DEVELOPABLE {
                &sensors::NAMES[..]
            } else {
                &[]
            };
            let faults = faults.iter().copied().chain(["none"]);
            for fault in faults
                .filter(|f| f.starts_with(fault))
                .filter(|_| shape.starts_with(name))
            {
                jobs.push((shape, fault, seed));
            }
        }
    }
    let (next, rows, cache) = (
        AtomicUsize::new(0),
        Mutex::new(Vec::new()),
        Mutex::new(known),
    );
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some((name, fault, seed)) = jobs.get(next.fetch_add(1, Ordering::Relaxed))
                {
                    match measure(size, name, fault, *seed, &cache) {
                        Ok(row) => rows.lock().unwrap().push(row),
                        Err(error) => eprintln!("{name} {fault} {seed}: {error}"),
                    }
                }
            });
        }
    });
    save_cache(&cache.into_inner().unwrap());
    let mut rows = rows.into_inner().unwrap();
    rows.sort_by_key(|row| (row.fault, row.name, row.seed));
    print(size, &rows, verbose);
    Ok(())
}

fn save_cache(known: &BTreeMap<String, [f64; 2]>) {
    let line = |(key, [a, b]): (&String, &[f64; 2])| format!("{key}\t{a}\t{b}");
    fs::write(CACHE, known.iter().map(line).collect::<Vec<_>>().join("\n")).ok();
}

fn read_cache() -> BTreeMap<String, [f64; 2]> {
    let text = fs::read_to_string(CACHE).unwrap_or_default();
    let line = |line: &str| {
        let mut parts = line.split('\t');
        let key = parts.next()?.to_owned();
        Some((
            key,
            [parts.next()?.parse().ok()?, parts.next()?.parse().ok()?],
        ))
    };
    text.lines().filter_map(line).collect()
}

fn measure(
    size: usize,
    name: &'static str,
    fault: &'static str,
    seed: u64,
    cache: &Mutex<BTreeMap<String, [f64; 2]>>,
) -> Result<Row> {
    let height = shape(name, seed);
    let pixel = 1.0 / size as f64;
    let centre = |i: usize| {
        [
            (i % size) as f64 + 0.5,
            size as f64 - (i / size) as f64 - 0.5,
        ]
        .map(|c| c * pixel)
    };
    let pixels = (0..size * size).map(centre).map(|[x, y]| height(x, y));
    let pixels: Vec<f64> = pixels.collect();
    let values = match fault {
        "none" => pixels.clone(),
        _ => sensors::spoil(fault, &pixels, seed * 31 + name.len() as u64),
    };
    let image = HeightImage::new(size, size, values)?.with_pixel_size(pixel)?;
    let on_lattice =
        |image: &HeightImage| Input::from_bridged(&image.bridged(Bridging::default())?, None);
    let [raw, input] = [on_lattice(&image)?, on_lattice(&image.repaired()?)?];
    let truth = Heightfield::from_fn(*input.field().lattice(), &height)?;
    let smooth = away_from_jumps(&truth, &height);
    let angle = |surface: &Heightfield| mean_angle(&truth, surface, &smooth);
    let fit = |input: &Input, options: Options| fit(input.clone(), &options.threads(1));
    let solve = |options: Options| fit(&input, options);
    let key = format!("{size} {name} {fault} {seed}");
    let cached = cache.lock().unwrap().get(&key).copied();
    let oracles = match cached {
        Some(oracles) => oracles,
        None if fault == "none" => [f64::NAN; 2],
        None => {
            let mut best = [f64::INFINITY; 2];
            for step in 0..=ORACLE_STEPS {
                let lambda = 10f64.powf(3.0 + 0.5 * f64::from(step));
                // The own energy, which depends less on λ, at whole decades.
                let energies = [
                    Some(Options::paper()),
                    (step % 2 == 0).then(Options::default),
                ];
                for (best, options) in best.iter_mut().zip(energies) {
                    let Some(options) = options else { continue };
                    let surface = fit(&raw, options.lambda(lambda))?;
                    *best = best.min(angle(surface.heightfield()));
                }
            }
            let mut known = cache.lock().unwrap();
            known.insert(key, best);
            // Now and then, in case that the program is stopped.
            if known.len().is_multiple_of(16) {
                save_cache(&known);
            }
            best
        }
    };
    let start = processor_seconds();
    let surface = solve(Options::default())?;
    let own = processor_seconds() - start;
    let report = surface.report().clone();
    let mut given = Options::default().lambda(report.lambda);
    if let Some(used) = report.huber {
        given = given
            .bend_radius(used.bend_radius)
            .flatness(used.flatness)
            .crease_radius(used.crease_radius)
            .crease_passes(used.crease_passes);
    }
    let start = processor_seconds();
    solve(given)?;
    let plain = processor_seconds() - start;
    let [low, high] = pixels
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| {
            [low.min(*z), high.max(*z)]
        });
    let pairs = truth.heights().iter().zip(surface.heightfield().heights());
    let squares = pairs
        .map(|(a, b)| (a - b).powi(2))
        .filter(|square| !square.is_nan());
    let squares: Vec<f64> = squares.collect();
    Ok(Row {
        name,
        fault,
        seed,
        angles: [angle(surface.heightfield()), oracles[0], oracles[1]],
        off: (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() / (high - low),
        cost: own / plain,
        report,
    })
}

/// Seconds of processor time of this thread, where the system tells.
fn processor_seconds() -> f64 {
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let first = text
        .split(' ')
        .next()
        .and_then(|text| text.parse::<f64>().ok());
    first.unwrap_or(f64::NAN) / 1e9
}

/// Returns for each vertex whether the shape is continuous within two spacings.
fn away_from_jumps(truth: &Heightfield, height: &Height) -> Vec<bool> {
    let lattice = truth.lattice();
    let spacing = lattice.spacing();
    let range = truth
        .heights()
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| {
            [low.min(*z), high.max(*z)]
        });
    let least = 0.005 * (range[1] - range[0]);
    let jumps = |[x, y]: [f64; 2], [dx, dy]: [f64; 2]| {
        let (mut a, mut b) = ([x, y], [x + dx, y + dy]);
        let z = |[x, y]: [f64; 2]| height(x, y);
        if (z(a) - z(b)).abs() < least {
            return false;
        }
        for _ in 0..8 {
            let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            match (z(a) - z(middle)).abs() > (z(middle) - z(b)).abs() {
                true => b = middle,
                false => a = middle,
            }
        }
        (z(a) - z(b)).abs() > least
    };
    let vertex = |row: usize, col: usize| {
        let at = lattice.position(row, col);
        let mut steps = (0..8).map(|k| (f64::from(k) * std::f64::consts::TAU / 8.0).sin_cos());
        !steps.any(|(sin, cos)| jumps(at, [2.0 * spacing * cos, 2.0 * spacing * sin]))
    };
    (0..lattice.len())
        .map(|i| vertex(i / lattice.cols(), i % lattice.cols()))
        .collect()
}

fn print(size: usize, rows: &[Row], verbose: bool) {
    let mut text = String::new();
    if verbose {
        for row in rows {
            let choice = row.report.lambda_choice.expect("the default chooses λ");
            let [own, nuclear, best] = row.angles;
            let _ = writeln!(
                text,
                "{:22} {:14} {} | {:6.2} {:6.2} | {own:6.2}° off {:.2} % cost {:.1} solves {} | {:?} σ {:.3e} ℓ {:.2} λ {:.1e} rr {:.2} {}{} flat {:.1} crease {:.1}",
                row.fault,
                row.name,
                row.seed,
                own / nuclear,
                own / best,
                100.0 * row.off,
                row.cost,
                choice.solves,
                choice.reason,
                choice.sigma.unwrap_or(0.0),
                choice.correlation_length * size as f64,
                row.report.lambda,
                choice.residual_ratio.unwrap_or(f64::NAN),
                if choice.ambiguous { "ambiguous " } else { "" },
                choice.raises,
                row.report.huber.map_or(0.0, |h| h.flatness),
                row.report.huber.map_or(0.0, |h| h.crease_radius),
            );
        }
    }
    let _ = writeln!(
        text,
        "| {size} pixels | chosen on: to the best nuclear λ, worst | to the best λ of the own energy | kept: nuclear, worst | own | cost, 9 of 10 below, most |\n\
         | :--- | ---: | ---: | ---: | ---: | ---: |"
    );
    let mut faults: Vec<&str> = sensors::NAMES.to_vec();
    faults.push("all");
    for fault in faults {
        let of = |seed: u64| {
            let chosen = move |row: &&Row| {
                row.seed == seed && row.fault != "none" && (fault == "all" || row.fault == fault)
            };
            rows.iter().filter(chosen).collect::<Vec<_>>()
        };
        let both = [of(0), of(1)];
        if both.iter().any(Vec::is_empty) {
            continue;
        }
        let cells = both.iter().map(|rows| {
            let ratios = |k: usize| {
                rows.iter()
                    .map(move |row| row.angles[0].max(0.01) / row.angles[k].max(0.01))
            };
            let mean = |k: usize| (ratios(k).map(f64::ln).sum::<f64>() / rows.len() as f64).exp();
            format!(
                "{:.2}, {:.1} | {:.2}",
                mean(1),
                ratios(1).fold(0.0, f64::max),
                mean(2)
            )
        });
        let cells: Vec<String> = cells.collect();
        let mut costs: Vec<f64> = both.iter().flatten().map(|row| row.cost).collect();
        costs.sort_by(f64::total_cmp);
        let cost = |share: f64| costs[((costs.len() - 1) as f64 * share) as usize];
        let _ = writeln!(
            text,
            "| {fault} | {} | {} | {:.1}, {:.1}, {:.1} |",
            cells[0],
            cells[1],
            cost(0.5),
            cost(0.9),
            cost(1.0)
        );
    }
    let _ = writeln!(
        text,
        "\n| without noise | angle, distance to the input in % of its range: seed 0 | seed 1 | cost |\n| :--- | ---: | ---: | ---: |"
    );
    for name in random_shapes::NAMES {
        let of = |seed: u64| {
            rows.iter()
                .find(|row| row.name == name && row.fault == "none" && row.seed == seed)
        };
        if let (Some(a), Some(b)) = (of(0), of(1)) {
            let cell = |row: &Row| format!("{:.2}°, {:.2}", row.angles[0], 100.0 * row.off);
            let _ = writeln!(
                text,
                "| {name} | {} | {} | {:.1} |",
                cell(a),
                cell(b),
                a.cost.max(b.cost)
            );
        }
    }
    println!("{text}");
}
