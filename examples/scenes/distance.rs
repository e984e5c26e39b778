//! How far a surface is from the truth.

use developable::{Heightfield, Quadratic};

/// Mean angle between normals, in degrees.
#[derive(Debug, Clone, Copy)]
pub struct Distance {
    pub normals: f64,
}

impl Distance {
    pub fn between(truth: &Heightfield, surface: &Heightfield) -> Self {
        let lattice = truth.lattice();
        let (mut angles, mut count) = (0.0, 0.0);
        for row in 0..lattice.rows() {
            for col in 0..lattice.cols() {
                let pair = [truth, surface].map(|field| slope(field, row, col));
                if let [Some(a), Some(b)] = pair {
                    angles += angle(a, b).to_degrees();
                    count += 1.0;
                }
            }
        }
        Distance {
            normals: angles / count,
        }
    }
}

/// Of the best-fit quadratic, where all neighbours are there.
fn slope(field: &Heightfield, row: usize, col: usize) -> Option<[f64; 2]> {
    let mut ring = [0.0; 6];
    let neighbours = field.lattice().neighbours(row, col);
    for (height, neighbour) in ring.iter_mut().zip(neighbours) {
        let (row, col) = neighbour?;
        *height = field.height(row, col);
    }
    let spacing = field.lattice().spacing();
    let gradient = Quadratic::fit(field.height(row, col), ring, spacing).gradient;
    gradient.iter().all(|x| x.is_finite()).then_some(gradient)
}

fn angle([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    let cross = [ay - by, bx - ax, ax * by - ay * bx];
    let size = cross.iter().map(|x| x * x).sum::<f64>().sqrt();
    size.atan2(ax * bx + ay * by + 1.0)
}

/// Mean angle between the normals of two surfaces, in degrees, over the vertices that `counts`.
pub fn mean_angle(truth: &Heightfield, surface: &Heightfield, counts: &[bool]) -> f64 {
    let lattice = truth.lattice();
    let (mut angles, mut count) = (0.0, 0.0);
    for vertex in (0..lattice.len()).filter(|vertex| counts[*vertex]) {
        let (row, col) = (vertex / lattice.cols(), vertex % lattice.cols());
        if let [Some(a), Some(b)] = [truth, surface].map(|field| slope(field, row, col)) {
            angles += angle(a, b).to_degrees();
            count += 1.0;
        }
    }
    angles / count
}
