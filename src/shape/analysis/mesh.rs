//! Computes curvatures at the vertices of a mesh.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::curvature::eigenvalues_by_magnitude;
use super::summary::{CurvatureMagnitudes, Summary};
use crate::error::{Result, positive, try_filled};
use crate::fit::mesh::geometry::{Frame, normals};
use crate::fit::mesh::linearisation::fit_quadratic;
use crate::fit::mesh::topology::Topology;
use crate::math::sym2::Sym2;
use crate::scene::mesh::Mesh;

/// Curvatures at the vertices of a mesh; NaN on the border. Units are the mesh's own:
/// `1/length`, and `1/length²` for `gaussian`. `κ₁` and `κ₂` are positive on a ball whose triangles face outwards.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshCurvatures {
    /// Discrete Gaussian curvature: the angle deficit `2π − Σ angles` over the lumped area, a third of the area of the
    /// triangles around a vertex.
    pub gaussian: Vec<f64>,
    /// `κ₁`: the eigenvalue of larger magnitude of the second fundamental form of the least-squares
    /// quadratic at a vertex.
    pub kappa1: Vec<f64>,
    /// `κ₂`: the eigenvalue of smaller magnitude of the second fundamental form at a vertex, which vanishes on
    /// developable surfaces.
    pub kappa2: Vec<f64>,
    /// Nuclear norm of the second fundamental form at a vertex, `‖II‖_* = |κ₁| + |κ₂|`.
    pub nuclear_norm: Vec<f64>,
    /// Principal direction of `κ₂`, a unit vector up to its sign: the direction of the ruling on a developable surface.
    pub rulings: Vec<[f64; 3]>,
    /// Area that belongs to each vertex, in the mesh's units squared: a third of the area of the triangles around it; 0
    /// on the border.
    areas: Vec<f64>,
}

impl MeshCurvatures {
    /// Computes the curvatures of a mesh; costs `O(vertices)`. Vertices at the same position have equal curvatures.
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
        let (turns, areas) = angles_and_areas(&topology, &places);
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
                // An earlier vertex had this position.
                let first = topology.source[vertex] as usize;
                fields.copy(first, i);
                continue;
            }
            fields.gaussian[i] = (TAU - turns[vertex]) / areas[vertex];
            fields.areas[i] = areas[vertex];
            let ray = Frame::from_normal(up[vertex], Vector3::x());
            let Some((fit, _, frame)) = fit_quadratic(&topology, &places, &ray, vertex) else {
                continue;
            };
            // Heights over the tangent plane fall where the surface bends away.
            let bend = fit.hessian().scale(-1.0);
            let ([k1, k2], along) = (eigenvalues_by_magnitude(bend), minor_eigenvector(bend));
            fields.kappa1[i] = k1;
            fields.kappa2[i] = k2;
            fields.nuclear_norm[i] = k1.abs() + k2.abs();
            let [t1, t2] = &frame.tangents;
            fields.rulings[i] = (t1 * along[0] + t2 * along[1]).into();
        }
        Ok(fields)
    }

    /// Copies the curvatures of one vertex to another vertex at the same position.
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

    /// Computes statistics of the curvatures, in coordinates in which the bounding sphere of the mesh has the diameter
    /// 1, as for λ of meshes; [`Summary::size`] is that diameter. Nuclear norms are summed by area, in units of the
    /// mean lumped area of a vertex.
    ///
    /// # Errors
    /// [`Error::Option`](crate::Error::Option) unless the threshold is positive and finite,
    /// [`Error::Topology`](crate::Error::Topology) for a mesh without a size.
    pub fn summary(&self, mesh: &Mesh, threshold: f64) -> Result<Summary> {
        let threshold = positive("threshold", threshold)?;
        let scale = crate::fit::mesh::bounding_sphere_scale(mesh)?;
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
        Ok(Summary::from_magnitudes(CurvatureMagnitudes {
            gaussian: magnitudes(&self.gaussian, scale * scale),
            kappa2: magnitudes(&self.kappa2, scale),
            nuclear_norm: shares.filter(|share| !share.is_nan()).sum(),
            size: 1.0 / scale,
            threshold,
        }))
    }
}

/// Computes the unit eigenvector of the eigenvalue of smaller magnitude of a symmetric 2×2 matrix.
fn minor_eigenvector(bend: Sym2) -> [f64; 2] {
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

/// Computes the sum of the angles at each vertex, in radians, and the vertex's area: a third of the area of the
/// triangles around it.
fn angles_and_areas(topology: &Topology, places: &[Vector3<f64>]) -> (Vec<f64>, Vec<f64>) {
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
