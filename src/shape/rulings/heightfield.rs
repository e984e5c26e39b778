//! Computes the direction of the ruling at each vertex of a heightfield.

use super::direction::{SMOOTHING_PASSES, direction_confidence, minor_axis};
use crate::error::{Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;
use crate::lattice::hessian::HessianOperator;
use crate::lattice::stencil::Quadratic;
use crate::math::sym2::Sym2;

/// The direction of the ruling at every vertex of a heightfield.
#[derive(Debug, Clone, PartialEq)]
pub struct Rulings {
    pub(super) surface: Heightfield,
    /// Sum of the squared Hessians `H²` over the neighbourhood of each vertex.
    pub(super) squares: Vec<Sym2>,
    pub(super) directions: Vec<[f64; 2]>,
    pub(super) confidence: Vec<f64>,
    /// Bend angle of the surface at each vertex, in radians over one spacing; NaN where there is no Hessian.
    pub(super) bends: Vec<f64>,
}

impl Rulings {
    /// Computes the ruling direction at each vertex of a heightfield; costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::NoInterior`](crate::Error::NoInterior) if no vertex has all six neighbours,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(surface: &Heightfield) -> Result<Self> {
        let lattice = *surface.lattice();
        let domain = Domain::new(surface)?;
        let operator = HessianOperator::new(&domain);
        let mut squares = try_filled("rulings", lattice.len(), Sym2::default())?;
        let mut bends = try_filled("rulings", lattice.len(), f64::NAN)?;
        for ((row, col), h) in (operator.vertices()).zip(operator.apply(surface.heights())) {
            let i = lattice.index(row, col);
            // In these coordinates a square has no cross terms.
            squares[i] = Sym2 {
                mean: h.mean * h.mean + h.diff * h.diff + h.off * h.off,
                diff: 2.0 * h.mean * h.diff,
                off: 2.0 * h.mean * h.off,
            };
            let [gx, gy] = slope(surface, row, col);
            bends[i] = h.nuclear_norm() * lattice.spacing() / (1.0 + gx * gx + gy * gy);
        }
        for _ in 0..SMOOTHING_PASSES {
            let last = squares.clone();
            for (row, col) in operator.vertices() {
                let i = lattice.index(row, col);
                let (mut sum, mut weight) = (last[i].scale(2.0), 2.0);
                for (r, c) in lattice.neighbours(row, col).into_iter().flatten() {
                    let k = lattice.index(r, c);
                    if !bends[k].is_nan() {
                        sum = sum + last[k];
                        weight += 1.0;
                    }
                }
                squares[i] = sum.scale(1.0 / weight);
            }
        }
        let mut directions = try_filled("rulings", lattice.len(), [f64::NAN; 2])?;
        let mut confidence = try_filled("rulings", lattice.len(), f64::NAN)?;
        for (row, col) in operator.vertices() {
            let i = lattice.index(row, col);
            directions[i] = minor_axis(squares[i]);
            confidence[i] = direction_confidence(squares[i].eigenvalues(), lattice.spacing());
        }
        Ok(Rulings {
            surface: surface.clone(),
            squares,
            directions,
            confidence,
            bends,
        })
    }

    /// Returns unit vectors along the rulings as seen from above, row by row, with `x ≥ 0`; NaN where a vertex or a
    /// neighbour of it has no height.
    pub fn directions(&self) -> &[[f64; 2]] {
        &self.directions
    }

    /// Returns the confidence of each ruling direction, from 0 to 1: low where the surface is nearly a plane, and where
    /// it bends in both directions; NaN where there is no direction.
    pub fn confidence(&self) -> &[f64] {
        &self.confidence
    }

    /// Computes the unit vector in space along the ruling at a vertex; `None` where there is no direction.
    pub fn lifted(&self, row: usize, col: usize) -> Option<[f64; 3]> {
        let [x, y] = self.directions[self.surface.lattice().index(row, col)];
        if x.is_nan() {
            return None;
        }
        let [gx, gy] = slope(&self.surface, row, col);
        let z = gx * x + gy * y;
        let length = (1.0 + z * z).sqrt();
        Some([x / length, y / length, z / length])
    }
}

/// Computes the gradient of the best-fit quadratic at a vertex that has all six neighbours, as slopes in x and y.
fn slope(surface: &Heightfield, row: usize, col: usize) -> [f64; 2] {
    let lattice = surface.lattice();
    let ring = lattice
        .neighbours(row, col)
        .map(|n| n.map_or(f64::NAN, |(r, c)| surface.height(r, c)));
    Quadratic::fit(surface.height(row, col), ring, lattice.spacing()).gradient
}
