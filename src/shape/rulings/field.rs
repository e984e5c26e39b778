//! Computes the direction of the ruling at each vertex of a mesh.

use nalgebra::{Matrix3, Vector3};

use super::direction::{SMOOTHING_PASSES, direction_confidence, minor_axis};
use super::options::DEFAULT_CREASE_BEND;
use crate::error::{Result, check_count, try_filled};
use crate::fit::mesh::geometry::{Frame, normals};
use crate::fit::mesh::linearisation::fit_quadratic;
use crate::fit::mesh::topology::Topology;
use crate::math::sym2::Sym2;
use crate::scene::half_edges::twin_half_edges;
use crate::scene::mesh::Mesh;
use crate::scene::triangulation::Triangulation;

/// The direction of the ruling at every vertex of a mesh of any shape.
#[derive(Debug, Clone)]
pub struct Rulings {
    /// Positions of the vertices, with vertices at the same position merged to one. All other fields but `directions`
    /// and `confidence` are by these merged vertices.
    pub(super) places: Vec<Vector3<f64>>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) twins: Vec<u32>,
    /// Sum of the squares of the second fundamental form over the neighbourhood of each vertex.
    pub(super) squares: Vec<Matrix3<f64>>,
    /// Confidence of the ruling's direction at each vertex, from 0 to 1; NaN where there is no second fundamental form.
    pub(super) trust: Vec<f64>,
    /// Bend angle of the mesh at each vertex, in radians over one edge; NaN where there is no second fundamental form.
    pub(super) bends: Vec<f64>,
    /// Mean length of the mesh's edges, in the mesh's units.
    pub(super) spacing: f64,
    directions: Vec<[f64; 3]>,
    confidence: Vec<f64>,
}

impl Rulings {
    /// Computes the ruling direction at each vertex of a mesh; costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::Topology`](crate::Error::Topology) if the mesh is no surface,
    /// [`Error::Unsupported`](crate::Error::Unsupported) for a cloud of points,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(mesh: &Mesh) -> Result<Self> {
        let topology = Topology::new(mesh)?;
        let place = |vertex: &u32| Vector3::from(mesh.positions()[*vertex as usize]);
        let places: Vec<_> = topology.source.iter().map(place).collect();
        let up = normals(&topology, &places, None);
        let count = places.len();
        let mut squares = try_filled("rulings", count, Matrix3::zeros())?;
        let mut bends = try_filled("rulings", count, f64::NAN)?;
        let mut frames: Vec<Frame> = (up.iter())
            .map(|normal| Frame::from_normal(*normal, Vector3::x()))
            .collect();
        for vertex in topology.vertices_inside() {
            let Some((fit, _, frame)) = fit_quadratic(&topology, &places, &frames[vertex], vertex)
            else {
                continue;
            };
            let bend = fit.hessian();
            let [xx, xy, yy] = bend.entries();
            let [t1, t2] = &frame.tangents;
            let cross = t1 * t2.transpose();
            let form = t1 * t1.transpose() * xx
                + (cross + cross.transpose()) * xy
                + t2 * t2.transpose() * yy;
            squares[vertex] = form * form;
            bends[vertex] = bend.nuclear_norm() * topology.mean_edge_length(&places, vertex);
            frames[vertex] = frame;
        }
        for _ in 0..SMOOTHING_PASSES {
            let last = squares.clone();
            for vertex in 0..count {
                if bends[vertex].is_nan() {
                    continue;
                }
                let (mut sum, mut weight) = (last[vertex] * 2.0, 2.0);
                // What lies on a crease is averaged with no neighbour that bends less.
                let most = bends[vertex].max(DEFAULT_CREASE_BEND);
                for other in topology.around(vertex).iter().map(|v| *v as usize) {
                    if bends[other] <= most {
                        sum += last[other];
                        weight += 1.0;
                    }
                }
                squares[vertex] = sum / weight;
            }
        }
        let blank = try_filled("rulings", mesh.positions().len(), [f64::NAN; 3])?;
        let unknown = try_filled("rulings", mesh.positions().len(), f64::NAN)?;
        let mut rulings = Rulings {
            twins: twin_half_edges(&topology.triangles),
            trust: try_filled("rulings", count, f64::NAN)?,
            spacing: mean_edge_length(&topology, &places),
            squares,
            bends,
            directions: blank,
            confidence: unknown,
            places,
            triangles: topology.triangles.clone(),
        };
        let mut along = try_filled("rulings", count, [f64::NAN; 3])?;
        for vertex in 0..count {
            if rulings.bends[vertex].is_nan() {
                continue;
            }
            let square = restrict_to_plane(&rulings.squares[vertex], &frames[vertex].tangents);
            let spacing = topology.mean_edge_length(&rulings.places, vertex);
            rulings.trust[vertex] = direction_confidence(square.eigenvalues(), spacing);
            along[vertex] = minor_axis_in_space(square, &frames[vertex].tangents).into();
        }
        for (i, vertex) in topology.joined.iter().enumerate() {
            rulings.directions[i] = along[*vertex as usize];
            rulings.confidence[i] = rulings.trust[*vertex as usize];
        }
        Ok(rulings)
    }

    /// Returns unit vectors along the rulings, for each vertex of the mesh, up to their sign; NaN at vertices on the
    /// border.
    pub fn directions(&self) -> &[[f64; 3]] {
        &self.directions
    }

    /// Returns the confidence of each ruling direction, from 0 to 1: low where the surface is nearly a plane, and where
    /// it bends in both directions; NaN where there is no direction.
    pub fn confidence(&self) -> &[f64] {
        &self.confidence
    }

    /// Directions of the rulings of a heightfield as seen from above, and their confidence, at the vertices of its lattice
    /// row by row: unit vectors with `x ≥ 0`. NaN where a vertex is not surrounded by triangles. `mesh` is the
    /// triangulation from which the rulings were computed.
    ///
    /// # Errors
    /// [`Error::Shape`](crate::Error::Shape) for the triangulation of another mesh,
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn on_lattice(&self, mesh: &Triangulation) -> Result<(Vec<[f64; 2]>, Vec<f64>)> {
        check_count("rulings", mesh.vertices().len(), 1, self.confidence.len())?;
        let mut directions = try_filled("rulings", mesh.lattice().len(), [f64::NAN; 2])?;
        let mut confidence = try_filled("rulings", mesh.lattice().len(), f64::NAN)?;
        for ((vertex, [x, y, _]), trust) in
            (mesh.vertices().iter().zip(&self.directions)).zip(&self.confidence)
        {
            let length = x.hypot(*y).copysign(*x);
            directions[*vertex as usize] = [x / length, y / length];
            confidence[*vertex as usize] = *trust;
        }
        Ok((directions, confidence))
    }
}

/// Restricts a symmetric tensor in space to the plane of two orthonormal vectors; returns a 2×2 matrix.
pub(super) fn restrict_to_plane(square: &Matrix3<f64>, [t1, t2]: &[Vector3<f64>; 2]) -> Sym2 {
    let [a, b] = [square * t1, square * t2];
    Sym2::new(t1.dot(&a), t1.dot(&b), t2.dot(&b))
}

/// Computes the eigenvector, in space, of the smaller eigenvalue of a tensor in the plane of two orthonormal vectors.
pub(super) fn minor_axis_in_space(square: Sym2, [t1, t2]: &[Vector3<f64>; 2]) -> Vector3<f64> {
    let [x, y] = minor_axis(square);
    t1 * x + t2 * y
}

/// Computes the mean length of all edges of a mesh.
fn mean_edge_length(topology: &Topology, places: &[Vector3<f64>]) -> f64 {
    let all = (0..places.len()).map(|vertex| topology.mean_edge_length(places, vertex));
    all.sum::<f64>() / places.len().max(1) as f64
}
