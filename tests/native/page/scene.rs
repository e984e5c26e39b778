//! Synthetic pages under a pinhole camera, with their own geometry: a curve by small straight
//! steps, turned and projected.

use developable::page::{Edges, Trace};
use oorandom::Rand64;

/// The directions of a page's curve over the share of its width.
pub type Turns = fn(f64) -> f64;

pub fn flat(_: f64) -> f64 {
    0.0
}

/// A letter that was rolled up: 80° of a circle.
pub fn arc(s: f64) -> f64 {
    0.7 - 1.4 * s
}

pub fn s_curve(s: f64) -> f64 {
    0.5 * (std::f64::consts::TAU * s).sin() + 0.1
}

/// The right page of an open book: steep at the gutter, on the left.
pub fn book(s: f64) -> f64 {
    1.1 * (-s / 0.12).exp() - 0.25 * (1.0 - (-s / 0.5).exp())
}

pub fn mirrored_book(s: f64) -> f64 {
    -book(1.0 - s)
}

pub const STEPS: usize = 2000;

/// A page, or two beside each other, in millimetres, and a camera.
#[derive(Clone)]
pub struct Scene {
    /// Points of each page's curve: x to the right, z towards the viewer.
    curves: Vec<Vec<[f64; 2]>>,
    pub sides: [f64; 2],
    pub distance: f64,
    /// Rotations about the horizontal and the vertical axis, and that of the camera, in degrees.
    pub pitch: f64,
    pub yaw: f64,
    pub roll: f64,
    pub focal: f64,
    pub photo: [usize; 2],
    pub centre: [f64; 2],
    /// Bends the page along its rulings, too: what a cylinder never is.
    pub fold: f64,
    /// The same for a fold that runs from left to right, in the middle.
    pub valley: f64,
    /// Heights of bumps, in millimetres.
    pub crumple: f64,
}

impl Scene {
    /// A4 pages under a phone: 12 megapixels, 26 mm.
    pub fn new(pages: &[Turns]) -> Self {
        let sides = [210.0, 297.0];
        let mut at = [0.0; 2];
        let mut curves = Vec::new();
        for turn in pages {
            let mut curve = vec![at];
            for i in 0..STEPS {
                let angle = turn((i as f64 + 0.5) / STEPS as f64);
                let step = sides[0] / STEPS as f64;
                at = [at[0] + step * angle.cos(), at[1] + step * angle.sin()];
                curve.push(at);
            }
            curves.push(curve);
        }
        // The chord level and centred.
        let (sin, cos) = at[1].atan2(at[0]).sin_cos();
        let chord = at[0].hypot(at[1]);
        for point in curves.iter_mut().flatten() {
            let [x, z] = *point;
            *point = [cos * x + sin * z - chord / 2.0, cos * z - sin * x];
        }
        Scene {
            curves,
            sides,
            distance: 430.0,
            pitch: 0.0,
            yaw: 0.0,
            roll: 0.0,
            focal: 3028.0,
            photo: [3024, 4032],
            centre: [1511.5, 2015.5],
            fold: 0.0,
            valley: 0.0,
            crumple: 0.0,
        }
    }

    pub fn tilted(mut self, distance: f64, pitch: f64, yaw: f64, roll: f64) -> Self {
        (self.distance, self.pitch, self.yaw, self.roll) = (distance, pitch, yaw, roll);
        self
    }

    pub fn pages(&self) -> usize {
        self.curves.len()
    }

    /// Where a place on a page is seen, from its upper left corner as shares of its sides.
    pub fn seen(&self, page: usize, s: f64, t: f64) -> [f64; 2] {
        let curve = &self.curves[page];
        let scaled = s.clamp(-0.5, 1.5) * STEPS as f64;
        let i = (scaled.max(0.0) as usize).min(STEPS - 1);
        let u = scaled - i as f64;
        let [p, q] = [curve[i], curve[i + 1]];
        let [x, mut z] = [0, 1].map(|k| p[k] + u * (q[k] - p[k]));
        let level = (1.0 + self.valley * self.valley).sqrt();
        let y = (t - 0.5) * self.sides[1] / level;
        // A fold across a corner, and bumps.
        let beyond = (x / self.sides[0] + y / self.sides[1] - 0.25).max(0.0);
        z += self.fold * beyond * self.sides[0];
        z += self.valley * y.abs();
        let bumps =
            (13.0 * s + 5.0 * t).sin() + (7.0 * s - 11.0 * t + 1.0).sin() + (19.0 * t * s).cos();
        z += self.crumple * bumps;
        let mut point = [x, y, -z];
        let turn = |point: &mut [f64; 3], j: usize, k: usize, degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            (point[j], point[k]) = (
                cos * point[j] - sin * point[k],
                sin * point[j] + cos * point[k],
            );
        };
        turn(&mut point, 1, 2, self.pitch);
        turn(&mut point, 0, 2, self.yaw);
        turn(&mut point, 0, 1, self.roll);
        let depth = point[2] + self.distance;
        [
            self.centre[0] + self.focal * point[0] / depth,
            self.centre[1] + self.focal * point[1] / depth,
        ]
    }

    /// Where on a page a pixel lies, in millimetres from the upper left corner of all: Newton's
    /// method from a place nearby.
    pub fn on_page(&self, page: usize, near: [f64; 2], pixel: [f64; 2]) -> [f64; 2] {
        let mut at = near;
        for _ in 0..20 {
            let here = self.seen(page, at[0], at[1]);
            let h = 1e-3;
            let [l, r] = [-h, h].map(|h| self.seen(page, at[0] + h, at[1]));
            let [a, b] = [-h, h].map(|h| self.seen(page, at[0], at[1] + h));
            let s = [0, 1].map(|k| (r[k] - l[k]) / (2.0 * h));
            let t = [0, 1].map(|k| (b[k] - a[k]) / (2.0 * h));
            let off = [0, 1].map(|k| pixel[k] - here[k]);
            let area = s[0] * t[1] - s[1] * t[0];
            at[0] += (off[0] * t[1] - off[1] * t[0]) / area;
            at[1] += (s[0] * off[1] - s[1] * off[0]) / area;
        }
        [(page as f64 + at[0]) * self.sides[0], at[1] * self.sides[1]]
    }

    /// Points along an edge at shares of its length.
    pub fn edge(&self, page: usize, t: f64, shares: &[f64]) -> Vec<[f64; 2]> {
        shares.iter().map(|s| self.seen(page, *s, t)).collect()
    }
}

/// How an edge is traced.
#[derive(Clone, Copy)]
pub struct Hand {
    /// Points, and how far each is off, in pixels, as a standard deviation.
    pub points: usize,
    pub error: f64,
    /// The same for errors that go on along a sixth of the edge.
    pub wander: f64,
}

pub fn normal(rng: &mut Rand64) -> f64 {
    let (a, b) = (1.0 - rng.rand_float(), rng.rand_float());
    (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
}

/// Traces of every page's edges: unequal distances, an error in each.
pub fn trace(scene: &Scene, hand: Hand, rng: &mut Rand64) -> Vec<Edges> {
    let mut line = |page: usize, t: f64| {
        let mut shares: Vec<f64> = (0..hand.points - 2).map(|_| rng.rand_float()).collect();
        shares.extend([0.0, 1.0]);
        shares.sort_by(f64::total_cmp);
        let mut points = scene.edge(page, t, &shares);
        let waves: Vec<[f64; 3]> = (0..12)
            .map(|i| [f64::from(i), normal(rng), normal(rng)])
            .collect();
        for (point, s) in points.iter_mut().zip(&shares) {
            for k in 0..2 {
                let wander: f64 = (waves.iter())
                    .map(|[i, a, b]| {
                        a * (i * s * 3.0 + b).cos() * [1.0, -1.0][(k * (*i as usize)) % 2]
                    })
                    .sum();
                point[k] += hand.error * normal(rng) + hand.wander * wander / 6f64.sqrt();
            }
        }
        Trace::Points(points)
    };
    (0..scene.pages())
        .map(|page| Edges::TopBottom {
            top: line(page, 0.0),
            bottom: line(page, 1.0),
        })
        .collect()
}
