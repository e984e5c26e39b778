//! By which angle a surface bends from one vertex to the next.

use crate::error::{Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;
use crate::lattice::hexagonal::{Lattice, NEIGHBOURS, OPPOSITE};
use crate::lattice::stencil::Quadratic;

/// Angle and slope at each vertex of the lattice; NaN where a neighbour is missing.
pub(super) struct Bend {
    pub angle: Vec<f64>,
    pub gradient: Vec<[f64; 2]>,
}

/// How many vertices from a crease, which is some vertices wide, the normals are taken.
pub(super) const ASIDE: usize = 4;

/// A crease bends by as many times the median, and by as much at least.
const TIMES: f64 = 6.0;
const LEAST: f64 = 0.035;

impl Bend {
    pub(super) fn new(surface: &Heightfield) -> Result<Self> {
        let lattice = surface.lattice();
        let h = lattice.spacing();
        let mut bend = Bend {
            angle: try_filled("bending", lattice.len(), f64::NAN)?,
            gradient: try_filled("bending", lattice.len(), [f64::NAN; 2])?,
        };
        let domain = Domain::new(surface)?;
        for cell in domain.interior().cells() {
            let (row, col) = domain.lattice_vertex(cell);
            // All six are there, the interior being defined by that.
            let ring = lattice
                .neighbours(row, col)
                .map(|n| n.map_or(f64::NAN, |(r, c)| surface.height(r, c)));
            let fit = Quadratic::fit(surface.height(row, col), ring, h);
            let [gx, gy] = fit.gradient;
            let i = lattice.index(row, col);
            bend.gradient[i] = fit.gradient;
            bend.angle[i] = fit.hessian.nuclear_norm() * h / (1.0 + gx * gx + gy * gy);
        }
        Ok(bend)
    }

    /// Where a crease is told from a curve, if nobody says.
    pub(super) fn usual_threshold(&self) -> f64 {
        let mut angles: Vec<f64> = self.angle.iter().copied().filter(|a| !a.is_nan()).collect();
        let middle = angles.len() / 2;
        let median = match angles.is_empty() {
            true => 0.0,
            false => *angles.select_nth_unstable_by(middle, f64::total_cmp).1,
        };
        (TIMES * median).max(LEAST)
    }

    /// Angle between the normals some vertices away from an edge, on either side, as far as the
    /// patches reach.
    pub(super) fn fold(&self, lattice: &Lattice, labels: &[u32], ends: [usize; 2]) -> Option<f64> {
        let cols = lattice.cols();
        let step = |i: usize, towards: usize| {
            let (r, c) = NEIGHBOURS[towards].step((i / cols) as isize, (i % cols) as isize);
            let inside = lattice.contains(r, c);
            inside.then(|| lattice.index(r as usize, c as usize))
        };
        let towards = (0..6).find(|towards| step(ends[0], *towards) == Some(ends[1]))?;
        let normal = |from: usize, away: usize| {
            let mut place = from;
            for _ in 0..ASIDE {
                match step(place, away) {
                    Some(next) if labels[next] == labels[from] && !self.angle[next].is_nan() => {
                        place = next;
                    }
                    _ => break,
                }
            }
            let [x, y] = self.gradient[place];
            (!x.is_nan()).then(|| {
                let length = (1.0 + x * x + y * y).sqrt();
                [-x / length, -y / length, 1.0 / length]
            })
        };
        let (a, b) = (
            normal(ends[0], OPPOSITE[towards])?,
            normal(ends[1], towards)?,
        );
        let dot: f64 = (0..3).map(|k| a[k] * b[k]).sum();
        Some(dot.clamp(-1.0, 1.0).acos())
    }
}
