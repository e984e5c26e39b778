//! Meshes for tests of the fit of meshes: their shapes, noise, and the triangles that go through each other.

use std::collections::HashMap;

use developable::Mesh;
use nalgebra::{Matrix3, Vector3};

type Point = Vector3<f64>;

pub fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut random = oorandom::Rand64::new(seed.into());
    move || 2.0 * random.rand_float() - 1.0
}

/// About normal, of variance 1.
pub fn normal(random: &mut impl FnMut() -> f64) -> f64 {
    (0..12).map(|_| random()).sum::<f64>() / 2.0
}

/// The triangles of a map from the unit square, with random diagonals; corners at the same place are one
/// vertex.
pub fn grid(cols: usize, rows: usize, map: impl Fn(f64, f64) -> [f64; 3]) -> Vec<[[f64; 3]; 3]> {
    let mut random = random(3);
    let at = |i: usize, j: usize| map(i as f64 / cols as f64, j as f64 / rows as f64);
    let mut triangles = Vec::new();
    for i in 0..cols {
        for j in 0..rows {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend(match random() > 0.0 {
                true => [[a, b, c], [a, c, d]],
                false => [[a, b, d], [b, c, d]],
            });
        }
    }
    triangles
}

pub fn indexed(soup: &[[[f64; 3]; 3]]) -> Mesh {
    let (mut places, mut found) = (Vec::new(), HashMap::new());
    let triangles = soup.iter().map(|triangle| {
        triangle.map(|x| {
            let key = x.map(|x| (x * 1e9).round() as i64);
            *found.entry(key).or_insert_with(|| {
                places.push(x);
                places.len() as u32 - 1
            })
        })
    });
    let triangles = triangles.collect();
    Mesh::new(places, triangles).unwrap()
}

/// The surface of the cube of side 2 about the origin, outwards.
pub fn cube(cols: usize) -> Mesh {
    let mut soup = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            soup.extend(grid(cols, cols, |u, v| {
                let mut x = [0.0; 3];
                x[axis] = side;
                x[(axis + 1) % 3] = side * (2.0 * u - 1.0);
                x[(axis + 2) % 3] = 2.0 * v - 1.0;
                x
            }));
        }
    }
    indexed(&soup)
}

pub fn points(mesh: &Mesh) -> Vec<Point> {
    mesh.positions().iter().map(|x| Point::from(*x)).collect()
}

pub fn with_positions(mesh: &Mesh, x: &[Point]) -> Mesh {
    let positions = x.iter().map(|x| (*x).into()).collect();
    Mesh::new(positions, mesh.triangles().to_vec()).unwrap()
}

/// Pairs of triangles without a common corner, one of which has a side that goes through the other.
pub fn crossings(mesh: &Mesh) -> usize {
    let x = points(mesh);
    let triangles = mesh.triangles();
    let boxes: Vec<[Point; 2]> = (triangles.iter())
        .map(|t| {
            let [a, b, c] = t.map(|i| x[i as usize]);
            [a.inf(&b).inf(&c), a.sup(&b).sup(&c)]
        })
        .collect();
    let pierced = |side: [u32; 2], t: &[u32; 3]| {
        let [p, q] = side.map(|i| x[i as usize]);
        let [a, b, c] = t.map(|i| x[i as usize]);
        let system = Matrix3::from_columns(&[b - a, c - a, p - q]);
        let sizes: f64 = system.column_iter().map(|column| column.norm()).product();
        let Some(inverse) = system.try_inverse() else {
            return false;
        };
        let [u, v, way] = (inverse * (p - a)).into();
        // In one plane they only touch.
        system.determinant().abs() > 1e-9 * sizes
            && u >= 0.0
            && v >= 0.0
            && u + v <= 1.0
            && (0.0..=1.0).contains(&way)
    };
    let through = |s: &[u32; 3], t: &[u32; 3]| (0..3).any(|k| pierced([s[k], s[(k + 1) % 3]], t));
    let mut found = 0;
    for (i, s) in triangles.iter().enumerate() {
        for (j, t) in triangles.iter().enumerate().skip(i + 1) {
            let apart =
                (0..3).any(|k| boxes[i][1][k] < boxes[j][0][k] || boxes[j][1][k] < boxes[i][0][k]);
            if !apart && !s.iter().any(|i| t.contains(i)) && (through(s, t) || through(t, s)) {
                found += 1;
            }
        }
    }
    found
}
