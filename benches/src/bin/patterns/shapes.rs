//! Meshes of irregular triangles over shapes whose creases and angles are known, with noise, fitted whole.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use developable::{Mesh, MeshOptions, fit_mesh};

use crate::Outcome;

/// A shape as a mesh, made with random triangles.
pub struct Shape {
    pub name: &'static str,
    pub make: fn(&mut Random) -> Outcome<Mesh>,
}

pub const SHAPES: [Shape; 9] = [
    Shape {
        name: "lampshade",
        make: |random| {
            tube(random, |angle, up| {
                let radius = 0.5 - 0.2 * up;
                [radius * angle.cos(), radius * angle.sin(), 0.6 * up]
            })
        },
    },
    Shape {
        name: "lampshade from a square to a circle",
        make: |random| tube(random, square_to_circle),
    },
    Shape {
        name: "six-sided lampshade",
        make: |random| {
            tube(random, |angle, up| {
                let side = (6.0 * angle / TAU).floor();
                let [from, to] = [side, side + 1.0].map(|k| TAU * k / 6.0);
                let share = 6.0 * angle / TAU - side;
                let radius = 0.5 - 0.2 * up;
                let at = |of: fn(f64) -> f64| radius * ((1.0 - share) * of(from) + share * of(to));
                [at(f64::cos), at(f64::sin), 0.6 * up]
            })
        },
    },
    Shape {
        name: "pleated lampshade",
        make: |random| {
            tube(random, |angle, up| {
                let radius = 0.5 - 0.2 * up + 0.04 * (1.0 - up) * (8.0 * angle).cos();
                [radius * angle.cos(), radius * angle.sin(), 0.6 * up]
            })
        },
    },
    Shape {
        name: "twisted lampshade",
        make: |random| {
            tube(random, |angle, up| {
                let (foot, head) = (angle - 0.5, angle + 0.5);
                let at = |of: fn(f64) -> f64| 0.5 * (1.0 - up) * of(foot) + 0.35 * up * of(head);
                [at(f64::cos), at(f64::sin), 0.6 * up]
            })
        },
    },
    Shape {
        name: "slit lampshade",
        make: |random| {
            sheet(random, |u, v| {
                let (angle, radius) = (0.9 * TAU * u, 0.5 - 0.2 * v);
                [radius * angle.cos(), radius * angle.sin(), 0.6 * v]
            })
        },
    },
    Shape {
        name: "bracket",
        make: |random| solid(random, [12, 8, 12], |[x, _, z]| x < 3 || z < 3),
    },
    Shape {
        name: "bracket with a rib",
        make: |random| {
            solid(random, [12, 9, 12], |[x, y, z]| {
                x < 3 || z < 3 || (3..6).contains(&y) && x < 8 && z < 8
            })
        },
    },
    Shape {
        name: "bent bracket",
        make: |random| {
            sheet(random, |u, v| {
                // Two plates at a right angle, with a bend of radius 0.04.
                let (radius, flat) = (0.04, 0.5 - 0.02 * TAU / 4.0);
                let [x, z] = match u - 0.5 {
                    t if t.abs() < 0.5 - flat => {
                        let turn = TAU / 8.0 + t / radius;
                        [radius * (1.0 - turn.sin()), radius * (1.0 - turn.cos())]
                    }
                    t if t < 0.0 => [radius + flat - u, 0.0],
                    t => [0.0, radius + t - (0.5 - flat)],
                };
                [x, v, z]
            })
        },
    },
];

/// Shares of a shape's diameter that the noise of its vertices has as standard deviation.
pub const NOISE: [f64; 3] = [0.0, 0.001, 0.003];

/// Makes a shape with noise and fits it with the default options.
pub fn fitted(shape: &Shape, noise: f64, seed: u64) -> Outcome<Mesh> {
    let mut random = Random(seed);
    let mesh = (shape.make)(&mut random)?;
    let bound = |k: usize, best: fn(f64, f64) -> f64| {
        mesh.positions()
            .iter()
            .map(|p| p[k])
            .reduce(best)
            .unwrap_or(0.0)
    };
    let extent = [0, 1, 2].map(|k| bound(k, f64::max) - bound(k, f64::min));
    let diameter = extent.iter().map(|side| side * side).sum::<f64>().sqrt();
    let places = mesh
        .positions()
        .iter()
        .map(|place| place.map(|x| x + noise * diameter * random.normal()));
    let noisy = Mesh::new(places.collect(), mesh.triangles().to_vec())?;
    Ok(fit_mesh(&noisy, &MeshOptions::default())?.into_parts().0)
}

/// Number of quadrilaterals around a tube or along the longer side of a sheet, and from one end to the other.
const TUBE_CELLS: [usize; 2] = [72, 22];

/// Maximum shift of a vertex, in cells.
const JITTER: f64 = 0.35;

/// An open tube with a line of vertices at each sixth of a turn; `place` takes an angle and the share of the way from one
/// end to the other.
fn tube(random: &mut Random, place: impl Fn(f64, f64) -> [f64; 3]) -> Outcome<Mesh> {
    let [around, up] = TUBE_CELLS;
    let mut places = Vec::new();
    for row in 0..=up {
        for col in 0..around {
            let mut shift = |is_free| {
                if is_free {
                    JITTER * random.signed()
                } else {
                    0.0
                }
            };
            let x = col as f64 + shift(col % (around / 6) != 0);
            let y = row as f64 + shift(row > 0 && row < up);
            let angle = (TAU * x / around as f64).rem_euclid(TAU);
            places.push(place(angle, y / up as f64));
        }
    }
    let at = |col: usize, row: usize| (row * around + col % around) as u32;
    let cells = (0..up).flat_map(|row| (0..around).map(move |col| (col, row)));
    let quads = cells.map(|(c, r)| [at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1)]);
    let triangles = quads.flat_map(|quad| halves(random, quad)).collect();
    Ok(Mesh::new(places, triangles)?)
}

/// An open sheet; `place` takes two shares of the ways from side to side.
fn sheet(random: &mut Random, place: impl Fn(f64, f64) -> [f64; 3]) -> Outcome<Mesh> {
    let [long, wide] = TUBE_CELLS;
    let mut places = Vec::new();
    for (row, col) in (0..=wide).flat_map(|row| (0..=long).map(move |col| (row, col))) {
        let mut share = |k: usize, count: usize| {
            let free = if k > 0 && k < count {
                JITTER * random.signed()
            } else {
                0.0
            };
            (k as f64 + free) / count as f64
        };
        let (u, v) = (share(col, long), share(row, wide));
        places.push(place(u, v));
    }
    let at = |col: usize, row: usize| (row * (long + 1) + col) as u32;
    let cells = (0..wide).flat_map(|row| (0..long).map(move |col| (col, row)));
    let quads = cells.map(|(c, r)| [at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1)]);
    let triangles = quads.flat_map(|quad| halves(random, quad)).collect();
    Ok(Mesh::new(places, triangles)?)
}

/// A surface of four triangles and four cones between them, from a square to a circle.
fn square_to_circle(angle: f64, up: f64) -> [f64; 3] {
    const SQUARE: f64 = 0.45;
    const CIRCLE: f64 = 0.25;
    // The rulings go from a corner to an eighth of the circle on either side of it, and along the triangles between.
    let quarter = (4.0 * angle / TAU).floor();
    let share = 4.0 * angle / TAU - quarter;
    let turn = |k: f64| (TAU * k / 4.0).sin_cos();
    let corner = |k: f64| {
        let (sin, cos) = turn(k + 0.5);
        [SQUARE * 2f64.sqrt() * cos, SQUARE * 2f64.sqrt() * sin]
    };
    // From the middle of one side of the square over its corner to the middle of the next side.
    let (foot, on_circle) = match share {
        s if s < 0.25 => {
            let ([ax, ay], [bx, by]) = (corner(quarter - 1.0), corner(quarter));
            let t = 0.5 + 2.0 * s;
            ([ax + t * (bx - ax), ay + t * (by - ay)], quarter)
        }
        s if s < 0.75 => (corner(quarter), quarter + 2.0 * (s - 0.25)),
        s => {
            let ([ax, ay], [bx, by]) = (corner(quarter), corner(quarter + 1.0));
            let t = 2.0 * (s - 0.75);
            ([ax + t * (bx - ax), ay + t * (by - ay)], quarter + 1.0)
        }
    };
    let (sin, cos) = turn(on_circle);
    let head = [CIRCLE * cos, CIRCLE * sin];
    let [x, y] = [0, 1].map(|k| (1.0 - up) * foot[k] + up * head[k]);
    [x, y, 0.6 * up]
}

/// The surface of those unit cubes of a grid for which `is_inside` is true; a vertex is shifted along the faces it is on.
fn solid(
    random: &mut Random,
    size: [i32; 3],
    is_inside: impl Fn([i32; 3]) -> bool,
) -> Outcome<Mesh> {
    let filled =
        |cell: [i32; 3]| (0..3).all(|k| (0..size[k]).contains(&cell[k])) && is_inside(cell);
    let mut numbers: BTreeMap<[i32; 3], u32> = BTreeMap::new();
    let mut corners: Vec<[i32; 3]> = Vec::new();
    let mut fixed: Vec<BTreeSet<usize>> = Vec::new();
    let mut quads = Vec::new();
    let cells = (0..size[0])
        .flat_map(|x| (0..size[1]).flat_map(move |y| (0..size[2]).map(move |z| [x, y, z])));
    for cell in cells.filter(|cell| filled(*cell)) {
        for (axis, side) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
            let mut beyond = cell;
            beyond[axis] += 2 * side - 1;
            if filled(beyond) {
                continue;
            }
            let steps = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[u, v]| {
                let mut corner = cell;
                corner[axis] += side;
                corner[(axis + 1) % 3] += u;
                corner[(axis + 2) % 3] += v;
                corner
            });
            let mut quad = steps.map(|corner| {
                let number = *numbers.entry(corner).or_insert_with(|| {
                    corners.push(corner);
                    fixed.push(BTreeSet::new());
                    corners.len() as u32 - 1
                });
                fixed[number as usize].insert(axis);
                number
            });
            if side == 0 {
                quad.reverse();
            }
            quads.push(quad);
        }
    }
    let places = corners.iter().zip(&fixed).map(|(corner, fixed)| {
        [0, 1, 2].map(|k| {
            let shift = JITTER * random.signed();
            f64::from(corner[k]) + if fixed.contains(&k) { 0.0 } else { shift }
        })
    });
    let places = places.collect();
    let triangles = quads
        .into_iter()
        .flat_map(|quad| halves(random, quad))
        .collect();
    Ok(Mesh::new(places, triangles)?)
}

/// A quadrilateral cut along one of its diagonals.
fn halves(random: &mut Random, [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    match random.uniform() < 0.5 {
        true => [[a, b, c], [a, c, d]],
        false => [[a, b, d], [b, c, d]],
    }
}

/// Reproducible random numbers, by a 64-bit linear congruential generator.
pub struct Random(u64);

impl Random {
    /// From 0 to 1, exclusive.
    fn uniform(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// From −1 to 1.
    fn signed(&mut self) -> f64 {
        2.0 * self.uniform() - 1.0
    }

    /// Normally distributed, of variance 1.
    fn normal(&mut self) -> f64 {
        (-2.0 * (1.0 - self.uniform()).ln()).sqrt() * (TAU * self.uniform()).cos()
    }
}

/// A mesh as bytes: number of vertices, positions, and corners of the triangles, all as 64-bit floats.
pub fn to_bytes(mesh: &Mesh) -> Vec<u8> {
    let count = [mesh.positions().len() as f64];
    let corners = mesh.triangles().as_flattened().iter();
    let corners = corners.map(|corner| f64::from(*corner));
    let numbers = count
        .into_iter()
        .chain(mesh.positions().as_flattened().iter().copied());
    numbers.chain(corners).flat_map(f64::to_le_bytes).collect()
}

/// A mesh from the bytes of [`to_bytes`].
pub fn from_bytes(bytes: &[u8]) -> Outcome<Mesh> {
    let number = |chunk: &[u8]| chunk.try_into().map(f64::from_le_bytes);
    let numbers = bytes
        .chunks(8)
        .map(number)
        .collect::<Result<Vec<f64>, _>>()?;
    let (count, rest) = numbers
        .split_first()
        .ok_or("a fitted mesh without a head")?;
    let (places, corners) = rest
        .split_at_checked(3 * *count as usize)
        .ok_or("a fitted mesh that is cut short")?;
    let places = places.chunks_exact(3).map(|p| [p[0], p[1], p[2]]);
    let triangles = corners
        .chunks_exact(3)
        .map(|t| [t[0], t[1], t[2]].map(|v| v as u32));
    Ok(Mesh::new(places.collect(), triangles.collect())?)
}
