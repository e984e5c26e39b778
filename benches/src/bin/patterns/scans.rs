//! Rough scans: real ones, seen from several sides, and terrain and a face made in code.

use std::path::Path;

use developable::files::images;
use developable::files::meshes::read_mesh;
use developable::{Frame, Heightfield, Lattice, Mesh, Resolution, Triangulation, View, sample};

use crate::Outcome;

/// A scan, made from the files in a folder.
pub struct Scan {
    pub name: &'static str,
    pub make: fn(&Path) -> Outcome<Heightfield>,
}

pub const SCANS: [Scan; 7] = [
    Scan {
        name: "range",
        make: range,
    },
    Scan {
        name: "range from the left",
        make: |folder| range_from(folder, [0.7, 0.2, -1.0]),
    },
    Scan {
        name: "range from below",
        make: |folder| range_from(folder, [-0.2, 0.9, -1.0]),
    },
    Scan {
        name: "bunny from ahead",
        make: |folder| bunny_from(folder, [0.0, 0.0, -1.0]),
    },
    Scan {
        name: "bunny from the side",
        make: |folder| bunny_from(folder, [-1.0, -0.3, -0.4]),
    },
    Scan {
        name: "terrain",
        make: |_| terrain(),
    },
    Scan {
        name: "face",
        make: |_| face(),
    },
];

/// Vertices along the longer side of a scan.
const RESOLUTION: usize = 580;

/// The range scan of the paper, on its own lattice.
fn range(folder: &Path) -> Outcome<Heightfield> {
    let file = images::decode(&std::fs::read(folder.join("range.npy"))?, None)?;
    let lattice = Lattice::new(file.height, file.width, 0.002)?;
    let heights = file
        .values
        .iter()
        .map(|z| if *z == 0.0 { f64::NAN } else { *z });
    Ok(Heightfield::new(lattice, heights.collect())?)
}

fn range_from(folder: &Path, along: [f64; 3]) -> Outcome<Heightfield> {
    let mesh = Triangulation::new(&range(folder)?, &Frame::default())?;
    let mesh = Mesh::new(mesh.positions().to_vec(), mesh.triangles().to_vec())?;
    seen(&mesh, along)
}

fn bunny_from(folder: &Path, along: [f64; 3]) -> Outcome<Heightfield> {
    seen(
        &read_mesh(&std::fs::read(folder.join("bunny.obj"))?, None)?,
        along,
    )
}

fn seen(mesh: &Mesh, along: [f64; 3]) -> Outcome<Heightfield> {
    Ok(sample(mesh, View::Along(along), Resolution::Across(RESOLUTION))?.into_heightfield())
}

/// Hills with noise of every wavelength, cut by sharp winding valleys.
fn terrain() -> Outcome<Heightfield> {
    made(|x, y| {
        let (mut height, mut size, mut waves) = (0.0, 0.16, 2.0);
        for octave in 0..7 {
            height += size * value_noise(waves * x, waves * y, octave);
            (size, waves) = (0.5 * size, 2.0 * waves);
        }
        for (k, along) in [0.2, 0.5, 0.8].into_iter().enumerate() {
            let course = along + 0.08 * (7.0 * y + 2.0 * k as f64).sin();
            height = height.min(0.5 * (x - course).abs() + 0.02);
        }
        height
    })
}

/// A head with eye sockets, nose, lips and chin, all ellipsoids, under the noise of a scan.
fn face() -> Outcome<Heightfield> {
    // Middle, half axes, and whether it is carved out.
    const SHAPES: [([f64; 3], [f64; 3], bool); 9] = [
        ([0.5, 0.5, 0.0], [0.36, 0.48, 0.3], false),
        ([0.5, 0.47, 0.27], [0.045, 0.12, 0.1], false),
        ([0.5, 0.40, 0.30], [0.07, 0.045, 0.06], false),
        ([0.36, 0.58, 0.27], [0.075, 0.05, 0.06], true),
        ([0.64, 0.58, 0.27], [0.075, 0.05, 0.06], true),
        ([0.36, 0.575, 0.21], [0.05, 0.04, 0.045], false),
        ([0.64, 0.575, 0.21], [0.05, 0.04, 0.045], false),
        ([0.5, 0.29, 0.24], [0.1, 0.035, 0.05], false),
        ([0.5, 0.15, 0.13], [0.09, 0.07, 0.1], false),
    ];
    made(|x, y| {
        let mut height = f64::NAN;
        for ([cx, cy, cz], [a, b, c], carved) in SHAPES {
            let inside = 1.0 - ((x - cx) / a).powi(2) - ((y - cy) / b).powi(2);
            if inside > 0.0 {
                let rise = c * inside.sqrt();
                height = match carved {
                    true => height.min(cz - rise + 0.045),
                    false => height.max(cz + rise),
                };
            }
        }
        height + 0.002 * value_noise(400.0 * x, 400.0 * y, 0)
    })
}

fn made(height: impl Fn(f64, f64) -> f64) -> Outcome<Heightfield> {
    let spacing = 1.0 / (RESOLUTION - 1) as f64;
    let lattice = Lattice::covering([0.0; 2], [1.0; 2], spacing)?;
    Ok(Heightfield::from_fn(lattice, height)?)
}

/// Smooth noise from −1 to 1 with one knot at each pair of whole numbers.
fn value_noise(x: f64, y: f64, seed: i64) -> f64 {
    let knot = |i: f64, j: f64| {
        // A step of a linear congruential generator (Knuth's MMIX) for each number.
        let mut state = 1u64;
        for number in [i as i64, j as i64, seed] {
            state = (state ^ number as u64).wrapping_mul(6364136223846793005);
            state = state.wrapping_add(1442695040888963407);
            state ^= state >> 29;
        }
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let (i, j) = (x.floor(), y.floor());
    let [u, v] = [x - i, y - j].map(|t| t * t * (3.0 - 2.0 * t));
    let rows = [j, j + 1.0].map(|j| (1.0 - u) * knot(i, j) + u * knot(i + 1.0, j));
    (1.0 - v) * rows[0] + v * rows[1]
}

/// A heightfield as bytes: rows, columns, spacing, origin and heights.
pub fn to_bytes(field: &Heightfield) -> Vec<u8> {
    let lattice = field.lattice();
    let [x, y] = lattice.position(0, 0);
    let head = [
        lattice.rows() as f64,
        lattice.cols() as f64,
        lattice.spacing(),
        x,
        y,
    ];
    let numbers = head.iter().chain(field.heights());
    numbers.flat_map(|number| number.to_le_bytes()).collect()
}

/// A heightfield from the bytes of [`to_bytes`].
pub fn from_bytes(bytes: &[u8]) -> Outcome<Heightfield> {
    let number = |chunk: &[u8]| chunk.try_into().map(f64::from_le_bytes);
    let numbers = bytes
        .chunks(8)
        .map(number)
        .collect::<Result<Vec<f64>, _>>()?;
    let (head, heights) = numbers
        .split_at_checked(5)
        .ok_or("a fitted surface without a head")?;
    let lattice = Lattice::new(head[0] as usize, head[1] as usize, head[2])?;
    Ok(Heightfield::new(
        lattice.with_origin([head[3], head[4]])?,
        heights.to_vec(),
    )?)
}
