//! Curvatures of a mesh as it is.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::curvature::by_magnitude;
use super::summary::{Measured, Summary};
use crate::error::{Result, positive, try_filled};
use crate::fit::mesh::geometry::{Frame, normals};
use crate::fit::mesh::linear::fit_at;
use crate::fit::mesh::topology::Topology;
use crate::math::sym2::Sym2;
use crate::scene::mesh::Mesh;

/// Fields at the vertices of a mesh, NaN where triangles do not go all around one. Units are the mesh's own:
/// `1/length`, and `1/length²` for `gaussian`. Curvatures are above 0 where the surface bends away from the
/// side that its triangles face, as a ball does.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshCurvatures {
    /// Discrete Gaussian curvature: the angle deficit `2π − Σ angles` over a third of the area of the
    /// triangles around.
    pub gaussian: Vec<f64>,
    /// `κ₁`: the eigenvalue of larger magnitude of the second fundamental form, by the quadratic that fits the
    /// vertices around best.
    pub kappa1: Vec<f64>,
    /// `κ₂`: the eigenvalue of smaller magnitude, which the energy wants to vanish.
    pub kappa2: Vec<f64>,
    /// `‖II‖_* = |κ₁| + |κ₂|`: the energy's density.
    pub nuclear_norm: Vec<f64>,
    /// The direction in which it bends by `κ₂`, a unit vector up to its sign: that of the ruling, where there
    /// is one.
    pub rulings: Vec<[f64; 3]>,
    areas: Vec<f64>,
}

impl MeshCurvatures {
    /// The curvatures of a mesh; costs `O(vertices)`. Vertices at one place have the same ones.
    ///
    /// # Errors
    /// [`Error::Topology`](crate::Error::Topology) if it is no surface,
    /// [`Error::Unsupported`](crate::Error::Unsupported) for a cloud of points,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(mesh: &Mesh) -> Result<Self> {
        let topology = Topology::new(mesh)?;
        let place = |vertex: &u32| Vector3::from(mesh.positions()[*vertex as usize]);
        let places: Vec<_> = topology.source.iter().map(place).collect();
        let up = normals(&topology, &places, None);
        let (turns, areas) = turns_and_areas(&topology, &places);
        let count = mesh.positions().len();
        let blank = || try_filled("curvatures", count, f64::NAN);
        let mut fields = MeshCurvatures {
            gaussian: blank()?,
            kappa1: blank()?,
            kappa2: blank()?,
            nuclear_norm: blank()?,
            rulings: try_filled("curvatures", count, [f64::NAN; 3])?,
            areas: try_filled("curvatures", count, 0.0)?,
        };
        for (i, joined) in topology.joined.iter().enumerate() {
            let vertex = *joined as usize;
            if !topology.inside[vertex] {
                continue;
            }
            if topology.source[vertex] as usize != i {
                // Its place was here before.
                let first = topology.source[vertex] as usize;
                fields.copy(first, i);
                continue;
            }
            fields.gaussian[i] = (TAU - turns[vertex]) / areas[vertex];
            fields.areas[i] = areas[vertex];
            let ray = Frame::about(up[vertex], Vector3::x());
            let Some((fit, _, frame)) = fit_at(&topology, &places, &ray, vertex) else {
                continue;
            };
            // Heights over the tangent plane fall where the surface bends away.
            let bend = fit.hessian().scale(-1.0);
            let ([k1, k2], along) = (by_magnitude(bend), weaker(bend));
            fields.kappa1[i] = k1;
            fields.kappa2[i] = k2;
            fields.nuclear_norm[i] = k1.abs() + k2.abs();
            let [t1, t2] = &frame.tangents;
            fields.rulings[i] = (t1 * along[0] + t2 * along[1]).into();
        }
        Ok(fields)
    }

    fn copy(&mut self, from: usize, to: usize) {
        let fields = [
            &mut self.gaussian,
            &mut self.kappa1,
            &mut self.kappa2,
            &mut self.nuclear_norm,
        ];
        for field in fields {
            field[to] = field[from];
        }
        self.rulings[to] = self.rulings[from];
    }

    /// The figures, in coordinates in which the ball about the mesh has the diameter 1, as λ is stated in for
    /// meshes: [`Summary::size`] is that diameter. The sum of the nuclear norms is by area, in vertices of the
    /// mean area.
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) unless the threshold is positive and finite,
    /// [`Error::Topology`](crate::Error::Topology) for a mesh without a size.
    pub fn summary(&self, mesh: &Mesh, threshold: f64) -> Result<Summary> {
        let threshold = positive("threshold", threshold)?;
        let scale = crate::fit::mesh::scale_of(mesh)?;
        let there: Vec<usize> = (0..self.areas.len())
            .filter(|i| self.areas[*i] > 0.0)
            .collect();
        let mean = there.iter().map(|i| self.areas[*i]).sum::<f64>() / there.len().max(1) as f64;
        let magnitudes = |field: &[f64], factor: f64| -> Vec<f64> {
            let values = there.iter().map(|i| field[*i].abs() / factor);
            values.filter(|value| !value.is_nan()).collect()
        };
        let shares = there
            .iter()
            .map(|i| self.nuclear_norm[*i] / scale * self.areas[*i] / mean);
        Ok(Summary::of(Measured {
            gaussian: magnitudes(&self.gaussian, scale * scale),
            kappa2: magnitudes(&self.kappa2, scale),
            nuclear_norm: shares.filter(|share| !share.is_nan()).sum(),
            size: 1.0 / scale,
            threshold,
        }))
    }
}

/// The eigenvector of the eigenvalue of smaller magnitude.
fn weaker(bend: Sym2) -> [f64; 2] {
    let [xx, xy, yy] = bend.entries();
    // The direction of the higher eigenvalue is half the angle of (xx − yy, 2xy).
    let high = 0.5 * (2.0 * xy).atan2(xx - yy);
    let [upper, lower] = bend.eigenvalues();
    let (sin, cos) = high.sin_cos();
    match upper.abs() >= lower.abs() {
        true => [-sin, cos],
        false => [cos, sin],
    }
}

/// The angles around each vertex, and a third of the area.
fn turns_and_areas(topology: &Topology, places: &[Vector3<f64>]) -> (Vec<f64>, Vec<f64>) {
    let (mut turns, mut areas) = (vec![0.0; places.len()], vec![0.0; places.len()]);
    for corners in &topology.triangles {
        let [a, b, c] = corners.map(|v| places[v as usize]);
        let area = (b - a).cross(&(c - a)).norm() / 6.0;
        for (corner, [at, p, q]) in corners.iter().zip([[a, b, c], [b, c, a], [c, a, b]]) {
            turns[*corner as usize] += (p - at).angle(&(q - at));
            areas[*corner as usize] += area;
        }
    }
    (turns, areas)
}
