//! How far a surface is from the truth.

use developable::{Heightfield, Quadratic};

/// Mean angle between normals, in degrees, and root mean square of the difference in height.
#[derive(Debug, Clone, Copy)]
pub struct Distance {
    pub normals: f64,
    pub heights: f64,
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
        let pairs = truth.heights().iter().zip(surface.heights());
        let valid = pairs.filter(|(a, b)| !a.is_nan() && !b.is_nan());
        let squares: Vec<f64> = valid.map(|(a, b)| (a - b).powi(2)).collect();
        Distance {
            normals: angles / count,
            heights: (squares.iter().sum::<f64>() / squares.len() as f64).sqrt(),
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
