//! Meshes as scanners, Delaunay triangulators and decimators leave them: slivers along an open rim, triangles of any aspect
//! ratio, vertices of any valence, over surfaces whose shape is known.

use developable::Mesh;
use nalgebra::Vector3;

use super::Random;

pub type Point = Vector3<f64>;

/// A triangulation of the unit square, or of a part of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tessellation {
    /// Delaunay triangles of random points, with the slivers along their convex hull.
    Scattered,
    /// A jittered grid whose outermost points are off a straight line by a ten-thousandth of the side: the hull has slivers of
    /// aspect ratios to 1000.
    RaggedRim,
    /// Points ten times as dense along one side as along the other, triangulated as they are: aspect ratios of 10 and more.
    Stretched,
    /// A grid of which two points of three were removed, more of them in one half.
    Decimated,
    /// Hubs with 20 neighbours, and triangles split at their centroids: valences 3 to 20.
    Hubs,
    /// Points a hundred times as dense around one corner as far from it.
    Graded,
    /// Rows of points close together between rows that are far apart: aspect ratios to 1,000.
    Needles,
    /// A grid with random diagonals, for comparison.
    Regular,
}

impl Tessellation {
    pub const ALL: [Self; 8] = [
        Self::Scattered,
        Self::RaggedRim,
        Self::Stretched,
        Self::Decimated,
        Self::Hubs,
        Self::Graded,
        Self::Needles,
        Self::Regular,
    ];

    /// Places and triangles, counterclockwise; about `side²` places.
    pub fn build(self, side: usize, seed: u64) -> (Vec<[f64; 2]>, Vec<[u32; 3]>) {
        let mut random = Random::spread(seed);
        let step = 1.0 / side as f64;
        let jittered = |share: f64, random: &mut Random| -> Vec<[f64; 2]> {
            let cells = (0..side * side).map(|i| [i % side, i / side]);
            cells
                .map(|cell| {
                    cell.map(|k| (k as f64 + 0.5 + share * (random.uniform() - 0.5)) * step)
                })
                .collect()
        };
        match self {
            Self::Scattered => {
                let places = (0..side * side).map(|_| [random.uniform(), random.uniform()]);
                let places = places.collect();
                delaunay(places)
            }
            Self::RaggedRim => {
                let mut places = jittered(0.7, &mut random);
                for (i, place) in places.iter_mut().enumerate() {
                    for (k, cell) in [i % side, i / side].into_iter().enumerate() {
                        if cell == 0 || cell == side - 1 {
                            let line = (cell as f64 + 0.5) * step;
                            place[k] = line + 1e-4 * (random.uniform() - 0.5);
                        }
                    }
                }
                delaunay(places)
            }
            Self::Stretched => {
                let (cols, rows) = (side * 3, side / 3);
                let places = (0..cols * rows).map(|i| [i % cols, i / cols]);
                let mut places: Vec<[f64; 2]> = places
                    .map(|cell| cell.map(|k| k as f64 + 0.5 + 0.4 * (random.uniform() - 0.5)))
                    .collect();
                let (_, triangles) = delaunay(places.clone());
                for place in &mut places {
                    *place = [place[0] / cols as f64, place[1] / rows as f64];
                }
                (places, triangles)
            }
            Self::Decimated => {
                let mut places = jittered(0.02, &mut random);
                places.retain(|place| random.uniform() < if place[0] < 0.5 { 0.2 } else { 0.5 });
                delaunay(places)
            }
            Self::Hubs => {
                let count = (side as f64 / 8.0).ceil() as usize;
                let mut places = Vec::new();
                for i in 0..count * count {
                    let centre = [i % count, i / count].map(|k| (k as f64 + 0.5) / count as f64);
                    places.push(centre);
                    for k in 0..20 {
                        let turn = std::f64::consts::TAU * f64::from(k) / 20.0;
                        let radius = (0.3 + 0.002 * random.uniform()) / count as f64;
                        places.push([
                            centre[0] + radius * turn.cos(),
                            centre[1] + radius * turn.sin(),
                        ]);
                    }
                }
                let hubs = places.clone();
                let free = jittered(0.7, &mut random).into_iter().filter(|place| {
                    (hubs.iter()).all(|hub| {
                        (hub[0] - place[0]).hypot(hub[1] - place[1]) > 0.31 / count as f64
                    })
                });
                places.extend(free.collect::<Vec<_>>());
                let (mut places, mut triangles) = delaunay(places);
                for t in 0..triangles.len() {
                    if random.uniform() > 0.1 {
                        continue;
                    }
                    let [a, b, c] = triangles[t];
                    let corners = [a, b, c].map(|i| places[i as usize]);
                    let middle = [0, 1].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0);
                    let new = places.len() as u32;
                    places.push(middle);
                    triangles[t] = [a, b, new];
                    triangles.extend([[b, c, new], [c, a, new]]);
                }
                (places, triangles)
            }
            Self::Graded => {
                let places = (0..side * side).map(|_| [0, 1].map(|_| random.uniform().powi(3)));
                let places = places.collect();
                delaunay(places)
            }
            Self::Needles => {
                let (cols, rows) = (side, side);
                let places = (0..cols * rows).map(|i| {
                    let [u, v] = [i % cols, i / cols].map(|k| k as f64);
                    let pair = (v / 2.0).floor() + 1e-3 * (v % 2.0);
                    let jitter = 0.4 * (random.uniform() - 0.5);
                    [
                        (u + 0.5 + jitter) / cols as f64,
                        (pair + 0.5) / (0.5 * rows as f64).ceil(),
                    ]
                });
                let (places, stretched): (Vec<_>, Vec<_>) = places
                    .enumerate()
                    .map(|(i, place)| (place, [place[0], (i / cols) as f64 / rows as f64]))
                    .unzip();
                let (_, triangles) = delaunay(stretched);
                (places, triangles)
            }
            Self::Regular => {
                let places = (0..side * side).map(|i| [i % side, i / side]);
                let places = places.map(|cell| cell.map(|k| k as f64 / (side - 1) as f64));
                let mut triangles = Vec::new();
                for i in 0..(side - 1) * side {
                    if i % side == side - 1 {
                        continue;
                    }
                    let (a, n) = (i as u32, side as u32);
                    let [b, c, d] = [a + 1, a + n + 1, a + n];
                    triangles.extend(match random.uniform() < 0.5 {
                        true => [[a, b, c], [a, c, d]],
                        false => [[a, b, d], [b, c, d]],
                    });
                }
                (places.collect(), triangles)
            }
        }
    }
}

/// A surface over the unit square, without stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sheet {
    /// An arc of a cylinder of radius 0.5.
    Curled,
    /// Two planes along a slanting line, the angle between their normals 60 degrees.
    Folded,
    /// Two planes at 45 degrees along a slanting line, so that the sheet nearly touches itself.
    Wedge,
    /// Two planes joined by a quarter of a cylinder of this radius, around the middle of the square.
    Bracket { radius: f64 },
}

impl Sheet {
    pub fn at(self, [u, v]: [f64; 2]) -> Point {
        match self {
            Sheet::Curled => {
                let angle = (u - 0.5) / 0.5;
                Point::new(0.5 * angle.sin(), v, 0.5 * angle.cos())
            }
            Sheet::Folded | Sheet::Wedge => {
                // Across the fold, and along it.
                let (sin, cos) = 0.3f64.sin_cos();
                let [s, t] = [
                    cos * (u - 0.5) + sin * (v - 0.5),
                    cos * (v - 0.5) - sin * (u - 0.5),
                ];
                let slope = match self {
                    Sheet::Wedge => 3.0 * std::f64::consts::FRAC_PI_8,
                    _ => std::f64::consts::FRAC_PI_6,
                };
                let (rise, run) = slope.sin_cos();
                Point::new(s * run, t, -s.abs() * rise)
            }
            Sheet::Bracket { radius } => {
                let half = 0.25 * std::f64::consts::PI * radius;
                let s = u - 0.5;
                let angle =
                    (s / radius).clamp(-std::f64::consts::FRAC_PI_4, std::f64::consts::FRAC_PI_4);
                let rest = if s.abs() > half {
                    s - s.signum() * half
                } else {
                    0.0
                };
                let bent = Point::new(radius * angle.sin(), v, radius * angle.cos());
                bent + rest * Point::new(angle.cos(), 0.0, -angle.sin())
            }
        }
    }

    /// The unit normal, by differences.
    pub fn normal(self, [u, v]: [f64; 2]) -> Point {
        let step = 1e-6;
        let along = self.at([u + step, v]) - self.at([u - step, v]);
        let across = self.at([u, v + step]) - self.at([u, v - step]);
        along.cross(&across).normalize()
    }
}

/// A mesh with noise, and what is known of it.
pub struct NoisyMesh {
    pub truth: Mesh,
    pub mesh: Mesh,
    pub normals: Vec<Point>,
    /// Largest distance between two corners of the box around it.
    pub diameter: f64,
}

impl NoisyMesh {
    /// Noise of `sigma` diameters, along the normals or in all directions.
    pub fn new(
        sheet: Sheet,
        triangulation: Tessellation,
        side: usize,
        sigma: f64,
        all_directions: bool,
        seed: u64,
    ) -> Self {
        let (places, triangles) = triangulation.build(side, seed);
        let truth: Vec<Point> = places.iter().map(|place| sheet.at(*place)).collect();
        let normals: Vec<Point> = places.iter().map(|place| sheet.normal(*place)).collect();
        let [low, high] = [f64::min, f64::max].map(|pick| {
            truth
                .iter()
                .skip(1)
                .fold(truth[0], |a, b| a.zip_map(b, pick))
        });
        let diameter = (high - low).norm();
        let mut random = Random::spread(seed + 1000);
        let noisy = truth.iter().zip(&normals).map(|(x, normal)| {
            let off = match all_directions {
                true => Point::from_fn(|_, _| random.normal()),
                false => normal * random.normal(),
            };
            x + diameter * sigma * off
        });
        let mesh = |x: Vec<Point>| {
            Mesh::new(x.into_iter().map(Into::into).collect(), triangles.clone()).unwrap()
        };
        NoisyMesh {
            mesh: mesh(noisy.collect()),
            truth: mesh(truth),
            normals,
            diameter,
        }
    }

    /// Root mean square distance of vertices from the true surface, along its normals, in diameters.
    pub fn distance(&self, mesh: &Mesh) -> f64 {
        let off = positions(mesh)
            .zip(positions(&self.truth))
            .zip(&self.normals)
            .map(|((x, y), n)| (x - y).dot(n));
        (off.map(|d| d * d).sum::<f64>() / self.normals.len() as f64).sqrt() / self.diameter
    }

    /// Mean angle between true and found normals of triangles, weighted by the true area, in degrees.
    pub fn angle(&self, mesh: &Mesh) -> f64 {
        let (mut sum, mut area) = (0.0, 0.0);
        for (a, b) in sides(mesh).zip(sides(&self.truth)) {
            let cosine = a.dot(&b) / (a.norm() * b.norm()).max(f64::MIN_POSITIVE);
            sum += b.norm() * cosine.clamp(-1.0, 1.0).acos().to_degrees();
            area += b.norm();
        }
        sum / area
    }

    /// Triangles that face away from the true ones.
    pub fn turned(&self, mesh: &Mesh) -> usize {
        sides(mesh)
            .zip(sides(&self.truth))
            .filter(|(a, b)| a.dot(b) < 0.0)
            .count()
    }

    /// Largest distance of a vertex from where it was given.
    pub fn moved(&self, mesh: &Mesh) -> f64 {
        positions(mesh)
            .zip(positions(&self.mesh))
            .map(|(a, b)| (a - b).norm())
            .fold(0.0, f64::max)
    }
}

fn positions(mesh: &Mesh) -> impl Iterator<Item = Point> + '_ {
    mesh.positions().iter().map(|x| Point::from(*x))
}

fn sides(mesh: &Mesh) -> impl Iterator<Item = Point> + '_ {
    mesh.triangles().iter().map(|t| {
        let [a, b, c] = t.map(|i| Point::from(mesh.positions()[i as usize]));
        (b - a).cross(&(c - a))
    })
}

/// The Delaunay triangles of points in the plane, counterclockwise, by insertion one by one (Bowyer, Watson); `O(n²)`.
fn delaunay(places: Vec<[f64; 2]>) -> (Vec<[f64; 2]>, Vec<[u32; 3]>) {
    let count = places.len() as u32;
    let mut all = places;
    all.extend([[-1e4, -1e4], [1e4, -1e4], [0.0, 1e4]].map(|[x, y]: [f64; 2]| [x * 1.3, y]));
    let mut triangles = vec![[count, count + 1, count + 2]];
    for new in 0..count {
        let [x, y] = all[new as usize];
        let within = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| {
                let [p, q] = all[i as usize];
                let [p, q] = [p - x, q - y];
                [p, q, p * p + q * q]
            });
            a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
                > 0.0
        };
        let mut open: Vec<[u32; 2]> = Vec::new();
        triangles.retain(|t| {
            let gone = within(t);
            if gone {
                for k in 0..3 {
                    let (a, b) = (t[k], t[(k + 1) % 3]);
                    match open.iter().position(|edge| *edge == [b, a]) {
                        Some(twin) => {
                            open.swap_remove(twin);
                        }
                        None => open.push([a, b]),
                    }
                }
            }
            !gone
        });
        triangles.extend(open.into_iter().map(|[a, b]| [a, b, new]));
    }
    triangles.retain(|t| t.iter().all(|i| *i < count));
    all.truncate(count as usize);
    (all, triangles)
}
