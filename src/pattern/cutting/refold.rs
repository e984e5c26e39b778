//! Folds flat sheets back into space and measures their distance from the surface.
//!
//! A sheet of paper bends but does not stretch. A sheet is folded back by an as-rigid-as-possible deformation: its
//! flat triangles move in space from their positions on the surface to those of least
//! strain. The distance that they end up from the surface shows how much the strain of the flat sheet matters.

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::body::Body;
use super::lay::FlatPart;
use crate::error::Result;
use crate::pattern::sheets::Refolding;
use crate::unroll::arap_mesh::{ArapMesh, StoppingCriteria};
use crate::unroll::flat_triangle::{FlatTriangle, Point};

/// Stopping criteria of the solver that folds a sheet back into space.
const REFOLDING_RELAXATION: StoppingCriteria = StoppingCriteria {
    tolerance: 1e-12,
    relative_tolerance: 0.0,
    target_energy: 0.0,
    hopeless_energy: f64::INFINITY,
    max_steps: 80,
};

/// Folds a flat sheet back into space, and measures its distance from the surface.
pub(super) fn refold_sheet(body: &Body, laid: &FlatPart) -> Result<Refolding> {
    let pieces = laid.triangles.iter().map(|corners| {
        let points = corners.map(|v| laid.places[v as usize]);
        let piece = FlatTriangle::from_points(points.map(|p| [p.re, p.im, 0.0]));
        (piece, *corners)
    });
    let pieces = pieces.filter(|(piece, _)| piece.exists()).collect();
    let built = laid.source.iter().map(|v| body.places[*v as usize]);
    let built: Vec<Vector3<f64>> = built.collect();
    let plan: Vec<Point> = built.iter().map(|p| Point::new(p.x, p.y)).collect();
    let mut places = built.clone();
    let mut sheet = ArapMesh::new(&plan, pieces)?;
    sheet.minimise(&mut places, REFOLDING_RELAXATION)?;
    let strain = sheet.strain_in_space(&places);
    register(&mut places, &built);
    let away = || places.iter().zip(&built).map(|(p, q)| (p - q).norm());
    let squares: f64 = away().map(|distance| distance * distance).sum();
    Ok(Refolding {
        rms: (squares / built.len().max(1) as f64).sqrt(),
        maximum: away().fold(0.0, f64::max),
        strain,
    })
}

/// Registers a point set to another by the rigid motion with the least sum of squared distances.
fn register(places: &mut [Vector3<f64>], others: &[Vector3<f64>]) {
    let count = places.len().max(1) as f64;
    let here = places.iter().sum::<Vector3<f64>>() / count;
    let there = others.iter().sum::<Vector3<f64>>() / count;
    let pairs = places.iter().zip(others);
    let spread: Matrix3<f64> = pairs
        .map(|(p, q)| (q - there) * (p - here).transpose())
        .sum();
    let turn = Rotation3::from_matrix(&spread);
    for place in places {
        *place = turn * (*place - here) + there;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_turned_and_shifted_is_brought_back() {
        let built: Vec<Vector3<f64>> = (0..40)
            .map(|i| Vector3::new(f64::from(i % 8), f64::from(i / 8), f64::from(i * i % 7)))
            .collect();
        let turn = Rotation3::from_euler_angles(0.3, -0.5, 0.7);
        let mut places: Vec<Vector3<f64>> = (built.iter())
            .map(|p| turn * p + Vector3::new(3.0, -2.0, 5.0))
            .collect();
        register(&mut places, &built);
        for (p, q) in places.iter().zip(&built) {
            assert!((p - q).norm() < 1e-9, "{p} {q}");
        }
    }
}
