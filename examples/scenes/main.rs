//! How close to the truth solves come, over scenes, sizes and noises.
mod shapes;

use developable::{Energy, Heightfield, Lattice, Options, fit};

pub struct Rng(u64);
impl Rng {
    fn uniform(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((self.0 >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }
    fn gauss(&mut self) -> f64 {
        let r = (-2.0 * self.uniform().ln()).sqrt();
        r * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

fn range(f: &Heightfield) -> f64 {
    let v = || f.heights().iter().filter(|z| !z.is_nan());
    v().fold(f64::MIN, |a, b| a.max(*b)) - v().fold(f64::MAX, |a, b| a.min(*b))
}

#[derive(Clone, Copy, Debug)]
enum Noise {
    White(f64),
    Voxels(f64),
    Smooth(f64),
}

impl Noise {
    fn parse(t: &str) -> Self {
        let (k, v) = t.split_at(1);
        let v: f64 = v.parse().unwrap();
        match k {
            "w" => Noise::White(v / 100.0),
            "v" => Noise::Voxels(v / 100.0),
            "c" => Noise::Smooth(v / 100.0),
            _ => panic!(),
        }
    }
    fn add(self, truth: &Heightfield, seed: u64) -> Heightfield {
        let range = range(truth).max(0.05);
        let lattice = *truth.lattice();
        let mut rng = Rng(seed * 77 + 5);
        for _ in 0..10 {
            rng.uniform();
        }
        let z = match self {
            Noise::White(a) => truth
                .heights()
                .iter()
                .map(|z| z + a * range * rng.gauss())
                .collect(),
            Noise::Voxels(a) => {
                let s = a * range;
                truth
                    .heights()
                    .iter()
                    .map(|z| (z / s + 0.37).round() * s)
                    .collect()
            }
            Noise::Smooth(a) => {
                let mut n: Vec<f64> = (0..lattice.len()).map(|_| rng.gauss()).collect();
                for _ in 0..4 {
                    let old = n.clone();
                    for r in 0..lattice.rows() {
                        for c in 0..lattice.cols() {
                            let (mut s, mut w) = (2.0 * old[lattice.index(r, c)], 2.0);
                            for (r, c) in lattice.neighbours(r, c).into_iter().flatten() {
                                s += old[lattice.index(r, c)];
                                w += 1.0;
                            }
                            n[lattice.index(r, c)] = s / w;
                        }
                    }
                }
                let rms = (n.iter().map(|x| x * x).sum::<f64>() / n.len() as f64).sqrt();
                truth
                    .heights()
                    .iter()
                    .zip(&n)
                    .map(|(z, n)| z + a * range * n / rms)
                    .collect()
            }
        };
        Heightfield::new(lattice, z).unwrap()
    }
    fn sigma(self, truth: &Heightfield) -> f64 {
        let range = range(truth).max(0.05);
        match self {
            Noise::White(a) | Noise::Smooth(a) => a * range,
            Noise::Voxels(a) => a * range / 12f64.sqrt(),
        }
    }
}

/// Mean angle between normals in degrees, and RMS of heights.
fn error(truth: &Heightfield, other: &Heightfield) -> [f64; 2] {
    let l = *truth.lattice();
    let h = l.spacing();
    let normal = |f: &Heightfield, r: usize, c: usize| {
        let n = l.neighbours(r, c);
        let mut z = [0.0; 6];
        for (z, n) in z.iter_mut().zip(n) {
            let (r, c) = n?;
            *z = f.height(r, c);
            if z.is_nan() {
                return None;
            }
        }
        if f.height(r, c).is_nan() {
            return None;
        }
        let mut g = [0.0; 2];
        let [x0, y0] = l.position(r, c);
        for (z, n) in z.iter().zip(n) {
            let (r, c) = n?;
            let [x, y] = l.position(r, c);
            g[0] += (x - x0) * z / (3.0 * h * h);
            g[1] += (y - y0) * z / (3.0 * h * h);
        }
        let s = 1.0 / (1.0 + g[0] * g[0] + g[1] * g[1]).sqrt();
        Some([-g[0] * s, -g[1] * s, s])
    };
    let (mut a, mut n) = (0.0, 0);
    for r in 0..l.rows() {
        for c in 0..l.cols() {
            if let (Some(p), Some(q)) = (normal(truth, r, c), normal(other, r, c)) {
                let cross = [
                    p[1] * q[2] - p[2] * q[1],
                    p[2] * q[0] - p[0] * q[2],
                    p[0] * q[1] - p[1] * q[0],
                ];
                let sin = (cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]).sqrt();
                a += sin.min(1.0).asin().to_degrees();
                n += 1;
            }
        }
    }
    let d: Vec<f64> = truth
        .heights()
        .iter()
        .zip(other.heights())
        .filter(|(a, b)| !a.is_nan() && !b.is_nan())
        .map(|(a, b)| (a - b).powi(2))
        .collect();
    [
        a / n as f64,
        (d.iter().sum::<f64>() / d.len() as f64).sqrt(),
    ]
}

fn grid(args: &[String]) {
    let sizes: Vec<usize> = args[2].split(',').map(|s| s.parse().unwrap()).collect();
    let noises: Vec<Noise> = args[3].split(',').map(Noise::parse).collect();
    let only: Vec<&str> = args[4].split(',').collect();
    // flatness, bend, crease radius, passes
    let params: Vec<[f64; 4]> = args[5]
        .split(',')
        .map(|p| {
            let v: Vec<f64> = p.split('/').map(|x| x.parse().unwrap()).collect();
            [v[0], v[1], v[2], v[3]]
        })
        .collect();
    let ks: Vec<f64> = args.get(6).map_or(vec![-1.0, -0.5, 0.0, 0.5], |a| {
        a.split(',').map(|x| x.parse().unwrap()).collect()
    });
    let mut logs = vec![[0.0f64; 3]; params.len()];
    let mut count = 0.0;
    for scene in shapes::all() {
        if !only.contains(&scene.name) && only != ["all"] {
            continue;
        }
        for &size in &sizes {
            let lattice = Lattice::covering([0.0, 0.0], [1.0, 1.0], 1.0 / size as f64).unwrap();
            let truth = Heightfield::from_fn(lattice, scene.height).unwrap();
            for &noise in &noises {
                let input = noise.add(&truth, 1);
                let l0 = 8.0 * size as f64 / noise.sigma(&truth);
                let curve = |o: Options| -> Vec<[f64; 2]> {
                    ks.iter()
                        .map(|k| {
                            let s = fit(&input, &o.lambda(l0 * 10f64.powf(*k))).unwrap();
                            error(&truth, s.heightfield())
                        })
                        .collect()
                };
                let best =
                    |c: &[[f64; 2]], i: usize| c.iter().map(|e| e[i]).fold(f64::MAX, f64::min);
                let n = curve(Options::default());
                print!(
                    "{:10} {size:3} {:12} nuc {:6.3} {:.1e} |",
                    scene.name,
                    format!("{noise:?}"),
                    best(&n, 0),
                    best(&n, 1)
                );
                count += 1.0;
                for (p, log) in params.iter().zip(&mut logs) {
                    let c = curve(
                        Options::default()
                            .energy(Energy::Huber)
                            .flatness(p[0])
                            .bend_radius(p[1])
                            .crease_radius(p[2])
                            .crease_passes(p[3] as usize),
                    );
                    let (ra, rr) = (best(&c, 0) / best(&n, 0), best(&c, 1) / best(&n, 1));
                    let at0 = ks
                        .iter()
                        .position(|k| *k == 0.0)
                        .map_or(f64::NAN, |i| c[i][0] / best(&n, 0));
                    let arg = (0..ks.len())
                        .min_by(|a, b| c[*a][0].total_cmp(&c[*b][0]))
                        .unwrap();
                    print!(" {ra:5.2} {rr:4.2} ({:+.1}) {at0:4.2} |", ks[arg]);
                    log[0] += ra.ln();
                    log[1] += rr.ln();
                    log[2] += at0.ln();
                }
                println!();
            }
        }
    }
    print!("geometric mean ");
    for (p, log) in params.iter().zip(&logs) {
        print!(
            " {p:?} {:.3} {:.3} at0 {:.3} |",
            (log[0] / count).exp(),
            (log[1] / count).exp(),
            (log[2] / count).exp()
        );
    }
    println!();
}

/// Mean of N rho^2 over lags.
fn whiteness(input: &Heightfield, fit: &Heightfield, reach: f64) -> f64 {
    let l = *input.lattice();
    let r: Vec<f64> = input
        .heights()
        .iter()
        .zip(fit.heights())
        .map(|(a, b)| a - b)
        .collect();
    let at = |row: isize, u: isize| {
        let c = u - (row - (row & 1)) / 2;
        if row >= 0 && c >= 0 && (row as usize) < l.rows() && (c as usize) < l.cols() {
            r[l.index(row as usize, c as usize)]
        } else {
            f64::NAN
        }
    };
    let (mut s, mut n) = (0.0, 0.0);
    for x in r.iter().filter(|x| !x.is_nan()) {
        s += x * x;
        n += 1.0;
    }
    let var = s / n;
    let m = reach.ceil() as isize;
    let (mut total, mut lags) = (0.0, 0.0);
    for dr in 0..=m {
        for du in -2 * m..=2 * m {
            if dr == 0 && du <= 0 {
                continue;
            }
            let (x, y) = (du as f64 - dr as f64 / 2.0, dr as f64 * 0.75f64.sqrt());
            if x.hypot(y) > reach + 1e-9 {
                continue;
            }
            let (mut s, mut k) = (0.0, 0.0);
            for row in 0..l.rows() as isize {
                for c in 0..l.cols() as isize {
                    let u = c + (row - (row & 1)) / 2;
                    let v = at(row, u) * at(row + dr, u + du);
                    if !v.is_nan() {
                        s += v;
                        k += 1.0;
                    }
                }
            }
            let rho = s / k / var;
            total += k * rho * rho;
            lags += 1.0;
        }
    }
    total / lags
}

/// Held-out error: mean squared.
fn held_out(input: &Heightfield, o: &Options) -> f64 {
    let l = *input.lattice();
    let mut z = input.heights().to_vec();
    let mut conf = vec![1.0; l.len()];
    let mut held = vec![];
    let mut rng = Rng(99);
    for r in 0..l.rows() {
        for c in 0..l.cols() {
            let i = l.index(r, c);
            if !z[i].is_nan()
                && rng.uniform() < 0.15
                && l.neighbours(r, c)
                    .into_iter()
                    .all(|n| n.is_some_and(|(r, c)| !input.height(r, c).is_nan()))
            {
                held.push((r, c));
                conf[i] = 0.01;
            }
        }
    }
    let is = conf.clone();
    for &(r, c) in &held {
        let (mut s, mut w) = (0.0, 0.0);
        for (r, c) in l.neighbours(r, c).into_iter().flatten() {
            let i = l.index(r, c);
            if is[i] == 1.0 {
                s += input.heights()[i];
                w += 1.0;
            }
        }
        let i = l.index(r, c);
        if w > 0.0 {
            z[i] = s / w;
        }
    }
    let inp = developable::Input::new(Heightfield::new(l, z).unwrap())
        .with_confidence(conf)
        .unwrap();
    let s = fit(inp, o).unwrap();
    let h = s.heightfield();
    held.iter()
        .map(|&(r, c)| (h.height(r, c) - input.height(r, c)).powi(2))
        .sum::<f64>()
        / held.len() as f64
}

fn select(args: &[String]) {
    let sizes: Vec<usize> = args[2].split(',').map(|s| s.parse().unwrap()).collect();
    let noises: Vec<Noise> = args[3].split(',').map(Noise::parse).collect();
    let only: Vec<&str> = args[4].split(',').collect();
    let params: Vec<[f64; 4]> = args[5]
        .split(',')
        .map(|p| {
            let v: Vec<f64> = p.split('/').map(|x| x.parse().unwrap()).collect();
            [v[0], v[1], v[2], v[3]]
        })
        .collect();
    let ks: Vec<f64> = args.get(6).map_or(vec![-1.0, -0.5, 0.0, 0.5], |a| {
        a.split(',').map(|x| x.parse().unwrap()).collect()
    });
    let names = ["whiteness 2", "whiteness 4", "held out", "best"];
    let mut logs = [[0.0f64; 2]; 4];
    let mut worst = [0.0f64; 4];
    let mut count = 0.0;
    for scene in shapes::all() {
        if !only.contains(&scene.name) && only != ["all"] {
            continue;
        }
        for &size in &sizes {
            let lattice = Lattice::covering([0.0, 0.0], [1.0, 1.0], 1.0 / size as f64).unwrap();
            let truth = Heightfield::from_fn(lattice, scene.height).unwrap();
            for &noise in &noises {
                let input = noise.add(&truth, 1);
                let l0 = 8.0 * size as f64 / noise.sigma(&truth);
                let best = [0, 1].map(|i| {
                    ks.iter()
                        .map(|k| {
                            error(
                                &truth,
                                fit(&input, &Options::default().lambda(l0 * 10f64.powf(*k)))
                                    .unwrap()
                                    .heightfield(),
                            )[i]
                        })
                        .fold(f64::MAX, f64::min)
                });
                let mut all = vec![];
                for p in &params {
                    for k in &ks {
                        let o = Options::default()
                            .energy(Energy::Huber)
                            .flatness(p[0])
                            .bend_radius(p[1])
                            .crease_radius(p[2])
                            .crease_passes(p[3] as usize)
                            .lambda(l0 * 10f64.powf(*k));
                        let s = fit(&input, &o).unwrap();
                        let e = error(&truth, s.heightfield());
                        all.push((
                            *p,
                            *k,
                            e,
                            [
                                whiteness(&input, s.heightfield(), 2.0),
                                whiteness(&input, s.heightfield(), 4.0),
                                held_out(&input, &o),
                                e[0],
                            ],
                        ));
                    }
                }
                print!(
                    "{:10} {size:3} {:12} nuc {:6.3} {:.1e} |",
                    scene.name,
                    format!("{noise:?}"),
                    best[0],
                    best[1]
                );
                count += 1.0;
                for i in 0..4 {
                    let (p, k, e, _) = all.iter().min_by(|a, b| a.3[i].total_cmp(&b.3[i])).unwrap();
                    let ra = [e[0] / best[0], e[1] / best[1]];
                    print!(" {:4.2} {:4.2} {}/{} {k:+.1} |", ra[0], ra[1], p[0], p[1]);
                    logs[i][0] += ra[0].ln();
                    logs[i][1] += ra[1].ln();
                    worst[i] = worst[i].max(ra[0]);
                }
                println!();
            }
        }
    }
    for i in 0..4 {
        print!(
            "{} {:.3} {:.3} worst {:.2} | ",
            names[i],
            (logs[i][0] / count).exp(),
            (logs[i][1] / count).exp(),
            worst[i]
        );
    }
    println!();
}

/// Ours without any parameter against the oracle's nuclear norm.
fn bench(args: &[String]) {
    let sizes: Vec<usize> = args[2].split(',').map(|s| s.parse().unwrap()).collect();
    let noises: Vec<Noise> = args[3].split(',').map(Noise::parse).collect();
    let only: Vec<&str> = args[4].split(',').collect();
    let ks = [-1.5, -1.0, -0.5, 0.0, 0.5, 1.0];
    let (mut logs, mut worst, mut count, mut search) = ([0.0f64; 3], [0.0f64; 2], 0.0, 0.0);
    for scene in shapes::all() {
        if !only.contains(&scene.name) && only != ["all"] {
            continue;
        }
        for &size in &sizes {
            let lattice = Lattice::covering([0.0, 0.0], [1.0, 1.0], 1.0 / size as f64).unwrap();
            let truth = Heightfield::from_fn(lattice, scene.height).unwrap();
            for &noise in &noises {
                let input = noise.add(&truth, 1);
                let l0 = 8.0 * size as f64 / noise.sigma(&truth);
                let c: Vec<_> = ks
                    .iter()
                    .map(|k| {
                        let s =
                            fit(&input, &Options::default().lambda(l0 * 10f64.powf(*k))).unwrap();
                        let e = error(&truth, s.heightfield());
                        (e, s.report().seconds.total)
                    })
                    .collect();
                let best = [0, 1].map(|i| c.iter().map(|c| c.0[i]).fold(f64::MAX, f64::min));
                let s = fit(
                    &input,
                    &Options::default()
                        .lambda(developable::Lambda::Auto)
                        .energy(Energy::Huber),
                )
                .unwrap();
                let (e, r) = (error(&truth, s.heightfield()), s.report());
                let (choice, h) = (r.lambda_choice.unwrap(), r.huber.unwrap());
                let ra = [e[0] / best[0], e[1] / best[1]];
                let nuclear = c.iter().map(|c| c.1).sum::<f64>() / 6.0;
                let fixed = fit(
                    &input,
                    &Options::default()
                        .lambda(r.lambda)
                        .energy(Energy::Huber)
                        .bend_radius(h.bend_radius)
                        .flatness(h.flatness)
                        .crease_radius(h.crease_radius),
                )
                .unwrap()
                .report()
                .seconds
                .total;
                println!(
                    "{:10} {size:3} {:13} nuc {:6.3} {:.1e} | {:6.3} {:.1e} | {:4.2} {:4.2} | lambda {:+.2} {}/{} {}p {:.3} | sigma {:.2} m{} {:?} {} solves | time {:.1} of nuclear, search {:.1} of ours",
                    scene.name,
                    format!("{noise:?}"),
                    best[0],
                    best[1],
                    e[0],
                    e[1],
                    ra[0],
                    ra[1],
                    (r.lambda / l0).log10(),
                    h.flatness,
                    h.bend_radius,
                    h.crease_passes,
                    h.creases as f64 / r.interior as f64,
                    choice.sigma.unwrap_or(f64::NAN) / noise.sigma(&truth),
                    choice.merged,
                    choice.reason,
                    choice.solves,
                    fixed / nuclear,
                    (r.seconds.total - fixed) / fixed
                );
                count += 1.0;
                for i in 0..2 {
                    logs[i] += ra[i].ln();
                    worst[i] = worst[i].max(ra[i]);
                }
                logs[2] += (fixed / nuclear).ln();
                search += r.seconds.total / fixed - 1.0;
            }
        }
    }
    println!(
        "geometric mean {:.3} {:.3} time {:.2} search {:.2} worst {worst:.2?}",
        (logs[0] / count).exp(),
        (logs[1] / count).exp(),
        (logs[2] / count).exp(),
        search / count
    );
}

fn kappa(args: &[String]) {
    let bytes = std::fs::read(&args[2]).unwrap();
    let file =
        developable::files::images::decode_basic(&bytes, developable::files::images::Format::Npy)
            .unwrap();
    let image = file.into_image().unwrap();
    let lattice = Lattice::new(image.height(), image.width(), args[3].parse().unwrap()).unwrap();
    let heights = image
        .values()
        .iter()
        .map(|z| if *z == 0.0 { f64::NAN } else { *z })
        .collect();
    let field = Heightfield::new(lattice, heights).unwrap();
    let energy: Energy = args[4].parse().unwrap();
    let gap: f64 = args[5].parse().unwrap();
    let o = Options::default()
        .energy(energy)
        .gap(gap)
        .lambda(1e6)
        .normalization(developable::Normalization::Off);
    let s = fit(&field, &o).unwrap();
    let c = developable::analysis::Curvatures::new(s.heightfield()).unwrap();
    let sum = developable::analysis::Summary::new(s.heightfield(), &c, 1.0).unwrap();
    let r = s.report();
    println!(
        "kappa2 {:.4} K {:.4} gap {:.4} iterations {:?} {:.2} s",
        sum.median_kappa2,
        sum.median_gaussian,
        r.gap.unwrap(),
        r.levels.iter().map(|l| l.iterations).collect::<Vec<_>>(),
        r.seconds.total
    );
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    if args[1] == "grid" {
        return grid(&args);
    }
    if args[1] == "kappa" {
        return kappa(&args);
    }
    if args[1] == "bench" {
        return bench(&args);
    }
    if args[1] == "select" {
        return select(&args);
    }
    let sizes: Vec<usize> = args[1].split(',').map(|s| s.parse().unwrap()).collect();
    let noises: Vec<Noise> = args[2].split(',').map(Noise::parse).collect();
    let only: Vec<&str> = args
        .get(3)
        .map(|s| s.split(',').collect())
        .unwrap_or_default();
    for scene in shapes::all() {
        if !only.is_empty() && !only.contains(&scene.name) && only != ["all"] {
            continue;
        }
        for &size in &sizes {
            let lattice = Lattice::covering([0.0, 0.0], [1.0, 1.0], 1.0 / size as f64).unwrap();
            let truth = Heightfield::from_fn(lattice, scene.height).unwrap();
            for &noise in &noises {
                let input = noise.add(&truth, 1);
                let sigma = noise.sigma(&truth);
                let l0 = 8.0 * size as f64 / sigma;
                println!(
                    "{} {size} {noise:?} noisy {:.2?} lambda0 {l0:.1e}",
                    scene.name,
                    error(&truth, &input)
                );
                for k in -4..=4 {
                    let lambda = l0 * 10f64.powf(k as f64 / 2.0);
                    let base = Options::default().lambda(lambda);
                    let run = |o: Options| {
                        let s = fit(&input, &o).unwrap();
                        let e = error(&truth, s.heightfield());
                        (e, s.report().clone())
                    };
                    let (n, rn) = run(base);
                    print!(
                        "  {:+.1} nuc {:6.3} {:.2e} {:3}it |",
                        k as f64 / 2.0,
                        n[0],
                        n[1],
                        rn.iterations
                    );
                    for passes in [0, 1, 2] {
                        let (e, r) = run(base.energy(Energy::Huber).crease_passes(passes));
                        print!(
                            " {}: {:6.3} {:.2e} {:3}it {:.3} |",
                            r.huber.unwrap().crease_passes,
                            e[0],
                            e[1],
                            r.iterations,
                            r.huber.unwrap().creases as f64 / r.interior as f64
                        );
                        if !matches!(r.stop_reason, developable::StopReason::Gap) {
                            print!("{:?}", r.stop_reason);
                        }
                    }
                    println!();
                }
            }
        }
    }
}
