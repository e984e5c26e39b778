//! Computes the angle by which a heightfield bends from one vertex to the next.

use crate::error::{Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;
use crate::lattice::hexagonal::{Lattice, NEIGHBOUR_DIRECTIONS, OPPOSITE_DIRECTION};
use crate::lattice::stencil::Quadratic;

/// Bend angle and slope of a heightfield at each vertex of the lattice; NaN where a neighbour is missing.
pub(super) struct BendAngles {
    /// Angle, in radians, by which the surface bends over one spacing: the nuclear norm of the Hessian along the
    /// surface, times the spacing.
    pub angle: Vec<f64>,
    /// Gradient of the quadratic that fits the heights around each vertex best, as slopes in x and y.
    pub gradient: Vec<[f64; 2]>,
}

/// Distance from a crease, in vertices, at which the normals on either side are taken: a crease of a fitted surface is
/// some vertices wide. `benches/patterns.md` has what others give.
pub(crate) const NORMAL_DISTANCE_VERTICES: usize = 4;

/// Ratio of the default bend angle of a crease to the median over the surface: limits how much of a surface that bends
/// everywhere is taken for crease. `benches/patterns.md` has what others give.
const CREASE_BEND_PER_MEDIAN: f64 = 6.0;

/// Minimum default bend angle of a crease, in radians (two degrees): limits what noise on a flat surface is taken for
/// crease. `benches/patterns.md` has what others give.
const MIN_CREASE_BEND: f64 = 0.035;

impl BendAngles {
    /// Computes the bend angles of a heightfield; costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::NoInterior`](crate::Error::NoInterior), [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn new(surface: &Heightfield) -> Result<Self> {
        let lattice = surface.lattice();
        let h = lattice.spacing();
        let mut bend = BendAngles {
            angle: try_filled("bending", lattice.len(), f64::NAN)?,
            gradient: try_filled("bending", lattice.len(), [f64::NAN; 2])?,
        };
        let domain = Domain::new(surface)?;
        for cell in domain.interior().cells() {
            let (row, col) = domain.lattice_vertex(cell);
            // Interior vertices have all six neighbours.
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

    /// Computes the default bend angle above which a vertex counts as part of a crease, in radians from one vertex to
    /// the next.
    pub(super) fn default_crease_bend(&self) -> f64 {
        let mut angles: Vec<f64> = self.angle.iter().copied().filter(|a| !a.is_nan()).collect();
        let middle = angles.len() / 2;
        let median = match angles.is_empty() {
            true => 0.0,
            false => *angles.select_nth_unstable_by(middle, f64::total_cmp).1,
        };
        (CREASE_BEND_PER_MEDIAN * median).max(MIN_CREASE_BEND)
    }

    /// Computes the fold angle, in radians, of a crease at an edge of the lattice between two patches: the angle
    /// between the normals some vertices away from the edge on either side, or as far as the patches reach. `None` if
    /// there is no normal.
    pub(super) fn fold_angle(
        &self,
        lattice: &Lattice,
        labels: &[u32],
        ends: [usize; 2],
    ) -> Option<f64> {
        let [a, b] = self.beside(lattice, labels, ends)?.map(|i| self.normal(i));
        let dot: f64 = (0..3).map(|k| a[k] * b[k]).sum();
        Some(dot.clamp(-1.0, 1.0).acos())
    }

    /// Computes by how far the surfaces on both sides of an edge differ, as an angle in radians: the fold angle or, at a step, the
    /// larger angle between the line that joins both sides and their tangent planes.
    pub(super) fn difference(
        &self,
        surface: &Heightfield,
        labels: &[u32],
        ends: [usize; 2],
    ) -> Option<f64> {
        let lattice = surface.lattice();
        let places = self.beside(lattice, labels, ends)?;
        let [p, q] = places.map(|i| {
            let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
            [x, y, surface.heights()[i]]
        });
        let line = [0, 1, 2].map(|k| q[k] - p[k]);
        let length = line.iter().map(|x| x * x).sum::<f64>().sqrt();
        let angles = places.map(|i| {
            let normal = self.normal(i);
            let away: f64 = (0..3).map(|k| normal[k] * line[k]).sum();
            (away.abs() / length).min(1.0).asin()
        });
        let fold = self.fold_angle(lattice, labels, ends)?;
        Some(angles.into_iter().fold(fold, f64::max))
    }

    /// Vertices some steps away from an edge on either side, or as far as the patches reach; `None` if one has no normal.
    fn beside(&self, lattice: &Lattice, labels: &[u32], ends: [usize; 2]) -> Option<[usize; 2]> {
        let cols = lattice.cols();
        let step = |i: usize, towards: usize| {
            let (r, c) =
                NEIGHBOUR_DIRECTIONS[towards].step((i / cols) as isize, (i % cols) as isize);
            let inside = lattice.contains(r, c);
            inside.then(|| lattice.index(r as usize, c as usize))
        };
        let towards = (0..6).find(|towards| step(ends[0], *towards) == Some(ends[1]))?;
        let walk = |from: usize, away: usize| {
            let mut place = from;
            for _ in 0..NORMAL_DISTANCE_VERTICES {
                match step(place, away) {
                    Some(next) if labels[next] == labels[from] && !self.angle[next].is_nan() => {
                        place = next;
                    }
                    _ => break,
                }
            }
            (!self.gradient[place][0].is_nan()).then_some(place)
        };
        Some([
            walk(ends[0], OPPOSITE_DIRECTION[towards])?,
            walk(ends[1], towards)?,
        ])
    }

    fn normal(&self, vertex: usize) -> [f64; 3] {
        let [x, y] = self.gradient[vertex];
        let length = (1.0 + x * x + y * y).sqrt();
        [-x / length, -y / length, 1.0 / length]
    }
}
