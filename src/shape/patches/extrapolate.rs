//! Continues patches beyond their borders.

use nalgebra::Vector6;

use super::bend_angles::NORMAL_DISTANCE_VERTICES;
use super::patch::NO_PATCH;
use crate::error::{Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::{ROW_SPACING, shift};
use crate::math::least_squares::LeastSquares;

/// Radii around a vertex, in lattice spacings, within which the vertices of a patch determine the patch's continuation there: the largest
/// within which they lie on a quadratic. `benches/patterns.md` has what others give.
const CONTINUATION_RADII: [usize; 3] = [10, 6, 3];

/// Distance of a patch's vertices from a quadratic, root mean square and in lattice spacings, up to which they lie on it.
/// `benches/patterns.md` has what others give.
const MAX_QUADRATIC_RESIDUAL: f64 = 0.1;

/// Continuations of the patches of a surface, as their vertices away from creases have it.
pub(crate) struct Continuations<'a> {
    surface: &'a Heightfield,
    labels: &'a [u32],
    /// Whether a vertex is so far from other patches that no crease has made the surface round there.
    core: Vec<bool>,
}

/// A patch's continuation: a quadratic around a vertex, in lattice spacings.
struct Continuation {
    coefficients: Vector6<f64>,
    /// Distance of the vertices that determine it from it, root mean square.
    residual: f64,
}

impl Continuation {
    fn at(&self, [x, y]: [f64; 2]) -> f64 {
        self.coefficients.dot(&terms([x, y]))
    }
}

fn terms([x, y]: [f64; 2]) -> Vector6<f64> {
    Vector6::new(1.0, x, y, x * x, x * y, y * y)
}

impl<'a> Continuations<'a> {
    pub(crate) fn new(surface: &'a Heightfield, labels: &'a [u32]) -> Result<Self> {
        let lattice = surface.lattice();
        let mut core = try_filled("patches", labels.len(), true)?;
        let is_beside_another = |i: &usize| {
            let mut around = lattice.around(*i);
            around.any(|k| labels[k] != labels[*i] && labels[k] != NO_PATCH)
        };
        let mut near: Vec<usize> = (0..labels.len()).filter(is_beside_another).collect();
        for _ in 0..NORMAL_DISTANCE_VERTICES / 2 {
            near.iter().for_each(|i| core[*i] = false);
            let around = near.iter().flat_map(|i| lattice.around(*i));
            near = around.filter(|i| core[*i]).collect();
        }
        Ok(Continuations {
            surface,
            labels,
            core,
        })
    }

    /// Height of a patch's continuation at a vertex; NaN if none of the patch's other vertices is near.
    pub(crate) fn height(&self, patch: u32, vertex: usize) -> f64 {
        self.around(patch, vertex)
            .map_or(f64::NAN, |there| there.at([0.0; 2]))
    }

    /// The continuation of a patch around a vertex.
    fn around(&self, patch: u32, vertex: usize) -> Option<Continuation> {
        let most = MAX_QUADRATIC_RESIDUAL * self.surface.lattice().spacing();
        let mut found = None;
        for radius in CONTINUATION_RADII {
            found = self.within(radius, patch, vertex);
            if found.as_ref().is_some_and(|there| there.residual <= most) {
                break;
            }
        }
        found
    }

    /// The least-squares quadratic of a patch's other vertices within a radius, without those near creases if enough are left. Where
    /// they do not determine a quadratic, it is as plane and as level as they allow.
    fn within(&self, radius: usize, patch: u32, vertex: usize) -> Option<Continuation> {
        let lattice = self.surface.lattice();
        let (row, col) = (vertex / lattice.cols(), vertex % lattice.cols());
        let mut samples: Vec<([f64; 2], f64, bool)> = Vec::new();
        for r in row.saturating_sub(radius)..=(row + radius).min(lattice.rows() - 1) {
            for c in col.saturating_sub(radius + 1)..=(col + radius + 1).min(lattice.cols() - 1) {
                let i = lattice.index(r, c);
                let x = c as f64 - shift(r) - (col as f64 - shift(row));
                let y = (row as f64 - r as f64) * ROW_SPACING;
                if i != vertex && self.labels[i] == patch && x.hypot(y) < radius as f64 + 0.1 {
                    samples.push(([x, y], self.surface.heights()[i], self.core[i]));
                }
            }
        }
        // Twice as many as a quadratic has coefficients.
        if samples.iter().filter(|(.., core)| *core).count() >= 12 {
            samples.retain(|(.., core)| *core);
        }
        if samples.is_empty() {
            return None;
        }
        let count = samples.len() as f64;
        let mean = samples.iter().map(|(_, z, _)| z).sum::<f64>() / count;
        // A ridge so small that it decides only what the samples leave open.
        let mut quadratic = LeastSquares::<6>::with_ridge([1e-12, 1e-9, 1e-9, 1e-5, 1e-5, 1e-5]);
        for (at, z, _) in &samples {
            quadratic.add(&terms(*at), [z - mean], 1.0);
        }
        let fit = quadratic
            .solve()
            .filter(|c| c.iter().all(|c| c.is_finite()));
        let mut there = Continuation {
            coefficients: fit.unwrap_or_default(),
            residual: 0.0,
        };
        there.coefficients[0] += mean;
        let squares = samples.iter().map(|(at, z, _)| (there.at(*at) - z).powi(2));
        there.residual = (squares.sum::<f64>() / count).sqrt();
        Some(there)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    #[test]
    fn a_patch_goes_on_as_the_quadratic_that_it_is() {
        let truth = |x: f64, y: f64| 1.0 + 0.3 * x - 0.2 * y + 0.04 * x * x - 0.03 * x * y;
        let lattice = Lattice::new(12, 12, 0.5).unwrap();
        let field =
            Heightfield::from_fn(lattice, |x, y| if x < 2.6 { truth(x, y) } else { 9.0 }).unwrap();
        let label = |i: usize| u32::from(lattice.position(i / 12, i % 12)[0] >= 2.6);
        let labels: Vec<u32> = (0..lattice.len()).map(label).collect();
        for row in 2..10 {
            let col = (0..12).find(|c| labels[row * 12 + c] == 1).unwrap();
            let [x, y] = lattice.position(row, col);
            let z = Continuations::new(&field, &labels)
                .unwrap()
                .height(0, row * 12 + col);
            assert!((z - truth(x, y)).abs() < 1e-4, "{z} {}", truth(x, y));
        }
    }

    #[test]
    fn what_is_too_narrow_for_a_quadratic_goes_on_straight() {
        // Two rows of vertices of a plane.
        let lattice = Lattice::new(3, 12, 1.0).unwrap();
        let field = Heightfield::from_fn(lattice, |x, y| 2.0 * x - y).unwrap();
        let labels: Vec<u32> = (0..36).map(|i| u32::from(i >= 24)).collect();
        let z = Continuations::new(&field, &labels)
            .unwrap()
            .height(0, 24 + 6);
        assert!((z - field.height(2, 6)).abs() < 1e-3, "{z}");
        // One row says nothing about its sides.
        let labels: Vec<u32> = (0..36).map(|i| u32::from(i >= 12)).collect();
        assert!(
            (Continuations::new(&field, &labels)
                .unwrap()
                .height(0, 12 + 6)
                - field.height(1, 6))
            .abs()
                < 1.0
        );
    }
}
