//! Fairing: moves a mesh's vertices on borders and creases to smooth curves.

use nalgebra::Vector3;

use super::geometry::Point;
use super::smooth_regions::SmoothRegions;
use super::topology::Topology;
use crate::math::least_squares::LeastSquares;

/// Number of vertices on either side of a vertex, along its border or crease, that the fairing quadratic is fitted to
/// (`benches/whole.md`).
const FAIRING_HALF_WINDOW: usize = 4;

/// Finds the borders and creases of a surface as curves: for each vertex the vertices before and after it on its curve,
/// and `None` where a curve ends and at vertices of no curve.
pub(super) fn curves(topology: &Topology, sides: &SmoothRegions) -> Vec<Option<[u32; 2]>> {
    let mut curves = sides.creases(topology);
    for (vertex, beside) in curves.iter_mut().enumerate() {
        let rim: Vec<usize> = topology.along_rim(vertex).collect();
        if let ([a, b], None) = (&rim[..], &beside) {
            *beside = Some([*a as u32, *b as u32]);
        }
    }
    curves
}

/// Moves each vertex of the `curves` to the quadratic fitted to the vertices along its curve. A vertex that this would
/// move by more than `most` is a corner: the curve ends there, and the vertex stays. Vertices that are `held` stay,
/// too.
pub(super) fn fair_curves(x: &mut [Point], curves: &[Option<[u32; 2]>], most: f64, held: &[bool]) {
    let old = x.to_vec();
    let near = |step: &Point| step.norm() <= most;
    let none = vec![false; x.len()];
    let ends: Vec<bool> = (0..x.len())
        .map(|vertex| !fairing_step(&old, curves, &none, vertex).is_some_and(|step| near(&step)))
        .collect();
    for vertex in 0..x.len() {
        if !ends[vertex]
            && !held[vertex]
            && let Some(step) = fairing_step(&old, curves, &ends, vertex).filter(near)
        {
            x[vertex] += step;
        }
    }
}

/// Returns the step from a vertex to the quadratic fitted to its neighbours along its curve, no further than to the
/// `ends`; `None` where fairing does not apply.
fn fairing_step(
    x: &[Point],
    curves: &[Option<[u32; 2]>],
    ends: &[bool],
    vertex: usize,
) -> Option<Point> {
    let beside = curves[vertex]?;
    let scale: f64 = (beside.iter())
        .map(|other| (x[*other as usize] - x[vertex]).norm())
        .sum();
    // The vertex itself, at the curve parameter 0.
    let mut quadratic = LeastSquares::<3, 3>::with_ridge([1.0, 0.0, 0.0]);
    for (first, sign) in beside.into_iter().zip([-1.0, 1.0]) {
        let (mut before, mut here, mut along) = (vertex, first as usize, 0.0);
        for _ in 0..FAIRING_HALF_WINDOW {
            along += sign * (x[here] - x[before]).norm() / scale;
            let powers = Vector3::new(1.0, along, along * along);
            quadratic.add(&powers, (x[here] - x[vertex]).into(), 1.0);
            let Some([a, b]) = curves[here].filter(|_| !ends[here]) else {
                break;
            };
            let next = if a as usize == before { b } else { a };
            (before, here) = (here, next as usize);
            if here == vertex {
                break;
            }
        }
    }
    let inverse = quadratic.factor()?.inverse();
    let step = (inverse.row(0) * quadratic.right).transpose();
    step.iter().all(|v| v.is_finite()).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_noisy_polygon_keeps_its_sides_and_its_corner() {
        // An arc of radius 1 and a straight line at a right angle to its end.
        let arc = (0..40).map(|i| {
            let angle = 0.03 * f64::from(i);
            Point::new(angle.cos(), angle.sin(), 0.0)
        });
        let end = Point::new((1.2f64).cos(), (1.2f64).sin(), 0.0);
        let line = (0..40).map(|i| end + 0.03 * f64::from(i) * end);
        let truth: Vec<Point> = arc.chain(line).collect();
        let curves: Vec<Option<[u32; 2]>> = (0..80)
            .map(|i: u32| (i > 0 && i < 79).then(|| [i - 1, i + 1]))
            .collect();
        let mut random = oorandom::Rand64::new(7);
        let mut shake = || 0.01 * (random.rand_float() - 0.5);
        let given: Vec<Point> = (truth.iter())
            .map(|x| x + Point::new(shake(), shake(), shake()))
            .collect();
        let mut x = given.clone();
        fair_curves(&mut x, &curves, 0.012, &[false; 80]);
        let off = |x: &[Point]| {
            let squares = x.iter().zip(&truth).map(|(a, b)| (a - b).norm_squared());
            squares.sum::<f64>().sqrt()
        };
        assert!(off(&x) < 0.75 * off(&given), "{} {}", off(&x), off(&given));
        assert!((x[40] - truth[40]).norm() < 0.012);
    }
}
