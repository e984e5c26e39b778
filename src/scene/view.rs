//! Views of a mesh: the direction it is seen in, and the axes of the resulting image.

use std::str::FromStr;

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::mesh::Mesh;
use crate::error::{Error, Result};

/// Direction in which a mesh is seen, from the viewer to the mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum View {
    /// View along a vector of any length: `[0.0, 0.0, -1.0]` looks down the z axis, so that what has the largest z is
    /// in front. By name, `"-z"`.
    Along([f64; 3]),
    /// View along the normal of the plane that fits the triangles best (their principal axes, weighted by area), from
    /// the side that more of their area faces. For a point cloud the plane fits the points, and the viewer is on the
    /// positive side of the normal's largest coordinate.
    BestFit,
}

/// A right-handed orthonormal frame: the axes of the image in those of the mesh.
///
/// A point `p` of the mesh lies at `(p·right, p·up, p·towards)` in the image: both have the same origin and unit.
/// `up` is as close to `+y` as possible. For a view along the y axis itself `up` is `-z` (looking along `-y`) or `+z`
/// (looking along `+y`): the limit of tilting the view there from `-z`. The frames of the six axes are
///
/// | along | right | up | towards the viewer |
/// |---|---|---|---|
/// | `-z` | `+x` | `+y` | `+z` |
/// | `+z` | `-x` | `+y` | `-z` |
/// | `-x` | `-z` | `+y` | `+x` |
/// | `+x` | `+z` | `+y` | `-x` |
/// | `-y` | `+x` | `-z` | `+y` |
/// | `+y` | `+x` | `+z` | `-y` |
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Direction of the image's x axis, in the mesh's axes.
    pub right: [f64; 3],
    /// Direction of the image's y axis, in the mesh's axes.
    pub up: [f64; 3],
    /// Direction of the heights, towards the viewer, in the mesh's axes.
    pub towards: [f64; 3],
}

impl Default for Frame {
    /// Returns the frame of a view along `-z`: the mesh's own axes.
    fn default() -> Self {
        Frame {
            right: [1.0, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
            towards: [0.0, 0.0, 1.0],
        }
    }
}

impl FromStr for View {
    type Err = Error;

    /// Makes a view from its name: `-x`, `+x`, `-y`, `+y`, `-z`, `+z` or `best-fit`.
    fn from_str(name: &str) -> Result<Self> {
        Ok(match name {
            "-x" => View::Along([-1.0, 0.0, 0.0]),
            "+x" => View::Along([1.0, 0.0, 0.0]),
            "-y" => View::Along([0.0, -1.0, 0.0]),
            "+y" => View::Along([0.0, 1.0, 0.0]),
            "-z" => View::Along([0.0, 0.0, -1.0]),
            "+z" => View::Along([0.0, 0.0, 1.0]),
            "best-fit" => View::BestFit,
            _ => {
                return Err(Error::option(
                    "view",
                    name,
                    "must be `-x`, `+x`, `-y`, `+y`, `-z`, `+z`, `best-fit` or a vector",
                ));
            }
        })
    }
}

impl View {
    /// Computes the frame (axes of the image) of this view of a mesh.
    ///
    /// # Errors
    /// [`Error::Option`] if the vector is zero or not finite,
    /// [`Error::Unsupported`] if there is no best-fit plane because all
    /// triangles are degenerate, or all points the same.
    pub fn frame(&self, mesh: &Mesh) -> Result<Frame> {
        match self {
            View::Along(direction) => Frame::looking_along(*direction),
            View::BestFit if mesh.is_cloud() => {
                Frame::looking_along((-normal_of_points(mesh)?).into())
            }
            View::BestFit => Frame::looking_along((-facing_normal(mesh)?).into()),
        }
    }
}

impl Frame {
    /// Computes the frame (axes of the image) of the view along a vector.
    ///
    /// # Errors
    /// [`Error::Option`] if the vector is zero or not finite.
    pub fn looking_along(direction: [f64; 3]) -> Result<Self> {
        let largest = direction.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        if !(largest > 0.0 && direction.iter().all(|v| v.is_finite())) {
            return Err(Error::option(
                "view",
                direction,
                "must be a finite vector that is not zero",
            ));
        }
        // Scaled first: squares would over- or underflow.
        let towards = (-Vector3::from(direction) / largest).normalize();
        let level = towards.x.hypot(towards.z);
        let hint = if level > 1e-6 {
            Vector3::y()
        } else {
            -Vector3::z() * towards.y.signum()
        };
        let right = hint.cross(&towards).normalize();
        let up = towards.cross(&right);
        // Adding 0 makes +0 of -0.
        let axis = |v: Vector3<f64>| v.add_scalar(0.0).into();
        Ok(Frame {
            right: axis(right),
            up: axis(up),
            towards: axis(towards),
        })
    }

    /// Transforms a point from the mesh's axes to the image's.
    pub fn view(&self, point: [f64; 3]) -> [f64; 3] {
        [self.right, self.up, self.towards]
            .map(|axis| axis[0] * point[0] + axis[1] * point[1] + axis[2] * point[2])
    }

    /// Transforms a point from the image's axes to the mesh's.
    pub fn to_world(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| x * self.right[k] + y * self.up[k] + z * self.towards[k])
    }
}

/// Computes the normal of the plane that fits a mesh's triangles best, on the side that more of their area faces. On
/// equal sides, as of a closed mesh with a symmetry, the normal's largest component is positive.
fn facing_normal(mesh: &Mesh) -> Result<Vector3<f64>> {
    let (centre, size) = bounds(mesh);
    let corners = || {
        mesh.triangles().iter().map(|t| {
            mesh.corners(*t)
                .map(|p| Vector3::from_fn(|k, _| p[k] / size - centre[k] / size))
        })
    };
    // Twice the area, along the normal.
    let across = |[a, b, c]: [Vector3<f64>; 3]| (b - a).cross(&(c - a));
    let mut area = 0.0;
    let mut first = Vector3::zeros();
    let mut second = Matrix3::zeros();
    for triangle in corners() {
        let weight = across(triangle).norm();
        let [a, b, c] = triangle;
        let sum = a + b + c;
        area += weight;
        first += sum * (weight / 3.0);
        // The second moment of a triangle, exactly.
        let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
        second += (squares + sum * sum.transpose()) * (weight / 12.0);
    }
    if !(area > 0.0 && area.is_finite()) {
        return Err(Error::Unsupported {
            format: "mesh",
            reason: "there is no best-fit plane, for no triangle has an area; give a direction to \
                     look in"
                .into(),
        });
    }
    let mean = first / area;
    let eigen = SymmetricEigen::new(second / area - mean * mean.transpose());
    let normal: Vector3<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into();
    let facing: f64 = corners()
        .map(across)
        .map(|n| {
            let towards = n.dot(&normal);
            if towards == 0.0 {
                0.0
            } else {
                n.norm().copysign(towards)
            }
        })
        .sum();
    let sign = if facing.abs() > 1e-9 * area {
        facing
    } else {
        normal[normal.iamax()]
    };
    Ok(normal * 1f64.copysign(sign))
}

/// Computes the normal of the plane that fits the points of a cloud best, with its largest component positive.
fn normal_of_points(mesh: &Mesh) -> Result<Vector3<f64>> {
    let (centre, size) = bounds(mesh);
    let points = || {
        let positions = mesh.positions().iter();
        positions.map(|p| Vector3::from_fn(|k, _| p[k] / size - centre[k] / size))
    };
    let count = mesh.positions().len() as f64;
    let mean = points().sum::<Vector3<f64>>() / count;
    let spread = points()
        .map(|p| (p - mean) * (p - mean).transpose())
        .sum::<Matrix3<f64>>();
    let eigen = SymmetricEigen::new(spread / count);
    if eigen.eigenvalues.max() <= 0.0 {
        return Err(Error::Unsupported {
            format: "point cloud",
            reason: "there is no best-fit plane, for all points are the same; give a direction to \
                     look in"
                .into(),
        });
    }
    let normal: Vector3<f64> = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into();
    Ok(normal * 1f64.copysign(normal[normal.iamax()]))
}

/// Centre of the bounding box of all vertices, and half the box's longest side, which is never 0.
fn bounds(mesh: &Mesh) -> ([f64; 3], f64) {
    let [min, max] = mesh.bounds();
    let centre = std::array::from_fn(|k| min[k] / 2.0 + max[k] / 2.0);
    let size = (0..3).fold(f64::MIN_POSITIVE, |m, k| m.max(max[k] / 2.0 - min[k] / 2.0));
    (centre, size)
}
