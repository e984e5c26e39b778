//! Computes curvatures of a heightfield: the discrete Gaussian curvature, and those of the best-fit Hessian.

use std::f64::consts::TAU;

use crate::error::{Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;
use crate::lattice::hessian::HessianOperator;
use crate::lattice::hexagonal::ROW_SPACING;
use crate::math::sym2::Sym2;

/// Curvatures at the vertices of a heightfield, row by row; NaN where a vertex or one of its
/// six neighbours has no height. Units are the surface's own: `1/length`, and `1/length²` for
/// `gaussian`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Curvatures {
    /// Discrete Gaussian curvature: the angle deficit `2π − Σ angles` over the lumped area, a third
    /// of the area of the six triangles ([paper](crate#references), Sec. 5.4). It is that of the surface in space,
    /// not of the Hessian.
    pub gaussian: Vec<f64>,
    /// `κ₁`: the eigenvalue of larger magnitude of the best-fit Hessian at each vertex.
    pub kappa1: Vec<f64>,
    /// `κ₂`: the eigenvalue of smaller magnitude of the best-fit Hessian at each vertex, which vanishes on developable
    /// surfaces.
    pub kappa2: Vec<f64>,
    /// Nuclear norm of the Hessian at each vertex, `‖H‖_* = |κ₁| + |κ₂|`.
    pub nuclear_norm: Vec<f64>,
}

impl Curvatures {
    /// Computes the curvatures of a heightfield; costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::NoInterior`](crate::Error::NoInterior) if no vertex has all six neighbours,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(surface: &Heightfield) -> Result<Self> {
        let lattice = surface.lattice();
        let blank = || try_filled("curvatures", lattice.len(), f64::NAN);
        let mut fields = Curvatures {
            gaussian: blank()?,
            kappa1: blank()?,
            kappa2: blank()?,
            nuclear_norm: blank()?,
        };
        let domain = Domain::new(surface)?;
        let operator = HessianOperator::new(&domain);
        let hessians = operator.apply(surface.heights());
        for ((row, col), hessian) in operator.vertices().zip(&hessians) {
            let i = lattice.index(row, col);
            let [kappa1, kappa2] = eigenvalues_by_magnitude(*hessian);
            fields.kappa1[i] = kappa1;
            fields.kappa2[i] = kappa2;
            fields.nuclear_norm[i] = hessian.nuclear_norm();
            // Interior vertices have all six neighbours.
            let ring = lattice.neighbours(row, col).map(|n| {
                n.map_or(f64::NAN, |(r, c)| {
                    surface.height(r, c) - surface.height(row, col)
                })
            });
            fields.gaussian[i] = gaussian_curvature(ring, lattice.spacing());
        }
        Ok(fields)
    }
}

/// Computes the eigenvalues of a symmetric 2×2 matrix, the one of larger magnitude first.
pub(super) fn eigenvalues_by_magnitude(hessian: Sym2) -> [f64; 2] {
    let [high, low] = hessian.eigenvalues();
    if high.abs() >= low.abs() {
        [high, low]
    } else {
        [low, high]
    }
}

/// Computes the discrete Gaussian curvature at a vertex: the angle deficit over the lumped area, from the heights of
/// the neighbours W, E, NW, NE, SW, SE above the vertex.
fn gaussian_curvature([w, e, nw, ne, sw, se]: [f64; 6], spacing: f64) -> f64 {
    // In units of the spacing, once around.
    let edges = [
        [1.0, 0.0, e],
        [0.5, ROW_SPACING, ne],
        [-0.5, ROW_SPACING, nw],
        [-1.0, 0.0, w],
        [-0.5, -ROW_SPACING, sw],
        [0.5, -ROW_SPACING, se],
    ]
    .map(|[x, y, z]| [x, y, z / spacing]);
    let (mut angles, mut area) = (0.0, 0.0);
    for (i, [ax, ay, az]) in edges.into_iter().enumerate() {
        let [bx, by, bz] = edges[(i + 1) % 6];
        let cross = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
        let doubled = cross[0].hypot(cross[1]).hypot(cross[2]);
        angles += doubled.atan2(ax * bx + ay * by + az * bz);
        area += 0.5 * doubled;
    }
    (TAU - angles) / (area / 3.0 * spacing * spacing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    fn curvatures(f: impl Fn(f64, f64) -> f64) -> (Lattice, Curvatures) {
        let lattice = Lattice::new(61, 51, 0.02)
            .and_then(|l| l.with_origin([-0.5, 0.5]))
            .unwrap();
        let surface = Heightfield::from_fn(lattice, f).unwrap();
        (lattice, Curvatures::new(&surface).unwrap())
    }

    /// Largest difference of a field from what it should be, away from the origin.
    fn error(
        lattice: &Lattice,
        field: &[f64],
        away: f64,
        expected: impl Fn(f64, f64) -> f64,
    ) -> f64 {
        let mut count = 0;
        let mut worst = 0.0f64;
        for (i, value) in field.iter().enumerate().filter(|(_, v)| !v.is_nan()) {
            let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
            if x.hypot(y) >= away {
                count += 1;
                worst = worst.max((value - expected(x, y)).abs());
            }
        }
        assert!(count > 2000, "{count}");
        worst
    }

    #[test]
    fn a_sphere_has_one_over_the_square_of_its_radius() {
        let (lattice, c) = curvatures(|x, y| (2.25 - x * x - y * y).sqrt());
        let worst = error(&lattice, &c.gaussian, 0.0, |_, _| 1.0 / 2.25);
        assert!(worst < 2e-3, "{worst}");
    }

    #[test]
    fn a_saddle_is_negative_with_opposite_eigenvalues() {
        let (a, b) = (0.5, -0.3);
        let (lattice, c) = curvatures(|x, y| 0.5 * (a * x * x + b * y * y));
        // (h_xx h_yy − h_xy²) / (1 + |∇z|²)².
        let k = |x: f64, y: f64| a * b / (1.0 + (a * x).powi(2) + (b * y).powi(2)).powi(2);
        assert!(error(&lattice, &c.gaussian, 0.0, k) < 1e-3);
        assert!(error(&lattice, &c.kappa1, 0.0, |_, _| a) < 1e-9);
        assert!(error(&lattice, &c.kappa2, 0.0, |_, _| b) < 1e-9);
        assert!(error(&lattice, &c.nuclear_norm, 0.0, |_, _| a - b) < 1e-9);
    }

    #[test]
    fn cylinders_and_cones_have_none_away_from_the_apex() {
        let (sin, cos) = 0.4f64.sin_cos();
        let radius = 1.2f64;
        let across = |x: f64, y: f64| cos * x + sin * y;
        let (lattice, c) = curvatures(|x, y| (radius * radius - across(x, y).powi(2)).sqrt());
        assert!(error(&lattice, &c.gaussian, 0.0, |_, _| 0.0) < 2e-3);
        assert!(error(&lattice, &c.kappa2, 0.0, |_, _| 0.0) < 2e-3);
        let bent =
            |x: f64, y: f64| -radius * radius / (radius * radius - across(x, y).powi(2)).powf(1.5);
        assert!(error(&lattice, &c.kappa1, 0.0, bent) < 5e-3);

        let (lattice, c) = curvatures(|x, y| 1.0 - 0.7 * x.hypot(y));
        assert!(error(&lattice, &c.gaussian, 0.2, |_, _| 0.0) < 0.02);
        assert!(error(&lattice, &c.kappa2, 0.2, |_, _| 0.0) < 0.03);
        assert!(error(&lattice, &c.kappa1, 0.2, |x, y| -0.7 / x.hypot(y)) < 0.06);
        // The apex holds what the cone lacks of 2π: gathered over the whole, by Gauss and Bonnet.
        let apex = TAU * (1.0 - 1.0 / (1.0f64 + 0.49).sqrt());
        let whole: f64 = (c.gaussian.iter().filter(|k| !k.is_nan()))
            .map(|k| k * (1.0f64 + 0.49).sqrt() * 0.02 * 0.02 * ROW_SPACING)
            .sum();
        assert!((whole - apex).abs() < 0.1 * apex, "{whole} {apex}");
    }
}
