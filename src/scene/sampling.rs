//! Sampling of a mesh as seen from a view: the first hit of a ray through each lattice vertex.
//!
//! This is a z-buffer, scanned row by row. A row of the lattice cuts a triangle in an interval whose ends lie
//! on two of its edges. The intersection of an edge with a row is computed from the edge's ends in a fixed
//! order, so that it is the same for both triangles at the edge; and because intervals are closed, no ray slips
//! through between the two.

use super::mesh::Mesh;
use super::splats::splat;
use super::view::{Frame, View};
use crate::error::{Error, Result, positive, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::{Lattice, ROW_SPACING, shift};
use crate::math::lanes;

/// Resolution of the lattice on which a mesh is sampled: a number of vertices, or their distance.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Resolution {
    /// Number of vertices along the longer side of the view, at least 2: the spacing is that side over one
    /// less.
    Across(usize),
    /// Distance between neighbouring vertices of the lattice, in the mesh's units.
    Spacing(f64),
    /// 200 vertices along the longer side; for a point cloud fewer, if there would be less than four points for each
    /// vertex of the box around them.
    Auto,
}

/// Maximum number of lattice vertices along the longer side of the view for [`Resolution::Auto`].
const MAX_AUTO_SIDE_VERTICES: usize = 200;
/// Minimum mean number of a cloud's points for each lattice vertex for [`Resolution::Auto`].
const MIN_POINTS_PER_VERTEX: f64 = 4.0;

/// The first hit of a view ray with a mesh: the triangle or point, and the position in it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Hit {
    /// Index of the triangle that is hit; in a point cloud, of the nearest visible point.
    pub index: usize,
    /// Barycentric coordinates of the hit in the triangle: none negative, their sum 1.
    pub weights: [f32; 3],
}

/// Marks a lattice vertex whose ray hits no triangle.
const NO_TRIANGLE: u32 = u32::MAX;

/// A mesh sampled on a lattice in the frame of a view: heights, and what each ray hits.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    field: Heightfield,
    frame: Frame,
    indices: Vec<u32>,
    weights: Vec<[f32; 3]>,
}

/// Samples a mesh by a ray through every vertex of a lattice that covers it.
///
/// Triangles are hit from either side. Those seen edge-on and degenerate ones are never hit. Of several hits at the
/// same height the first triangle counts. A vertex whose ray hits nothing has no height (NaN).
///
/// In a **point cloud** a vertex sees the points within one spacing of it, except those more than three spacings
/// behind the foremost. Its height is that of the plane fitted to them by least squares, in which near points have
/// larger weights. Where all of them lie to one side it has none. So the spacing should be at least the distance
/// between points, and better several times that.
///
/// Costs `O(vertices + triangles + hits)`: some tens of milliseconds for a million triangles.
///
/// # Errors
/// [`Error::Option`] for a view or resolution out of range, [`Error::TooLarge`]
/// for a lattice of more than [`MAX_CELLS`](crate::MAX_CELLS) vertices,
/// [`Error::Unsupported`] if nothing is seen, or a cloud has too few points, [`Error::OutOfMemory`].
pub fn sample(mesh: &Mesh, view: View, resolution: Resolution) -> Result<Samples> {
    let frame = view.frame(mesh)?;
    let (min, max) = seen(mesh, &frame);
    let [width, height] = [max[0] - min[0], max[1] - min[1]];
    let across = |vertices: usize| width.max(height) / (vertices - 1) as f64;
    let spacing = match resolution {
        Resolution::Spacing(spacing) => positive("spacing", spacing)?,
        Resolution::Across(vertices) if vertices >= 2 => across(vertices),
        Resolution::Auto if mesh.is_cloud() => {
            let points = mesh.positions().len() as f64;
            // Each vertex has an area of ROW_SPACING times the spacing squared.
            let each = (MIN_POINTS_PER_VERTEX / (points * ROW_SPACING)).sqrt();
            across(MAX_AUTO_SIDE_VERTICES).max(each * width.sqrt() * height.sqrt())
        }
        Resolution::Auto => across(MAX_AUTO_SIDE_VERTICES),
        Resolution::Across(vertices) => {
            return Err(Error::option("resolution", vertices, "must be at least 2"));
        }
    };
    if !(spacing > 0.0 && spacing.is_finite()) {
        return Err(nothing_seen());
    }
    let lattice = Lattice::covering(min, max, spacing)?;
    if mesh.is_cloud() {
        let samples = sample_cloud(mesh, frame, lattice)?;
        let seen = samples.indices.iter().filter(|i| **i != NO_TRIANGLE);
        // Not even a vertex with its six neighbours.
        if resolution == Resolution::Auto && seen.count() < 7 {
            let points = mesh.positions().len();
            return Err(Error::Unsupported {
                format: "point cloud",
                reason: format!("{points} points are too few for a surface; give more of them"),
            });
        }
        return Ok(samples);
    }
    let mut buffer = Buffer {
        lattice,
        heights: try_filled("depth buffer", lattice.len(), f64::NAN)?,
        triangles: try_filled("depth buffer", lattice.len(), NO_TRIANGLE)?,
        weights: try_filled("depth buffer", lattice.len(), [0.0; 3])?,
    };
    for (i, triangle) in mesh.triangles().iter().enumerate() {
        let corners = mesh.corners(*triangle).map(|p| buffer.place(frame.view(p)));
        buffer.scan(i as u32, corners);
    }
    if buffer.triangles.iter().all(|t| *t == NO_TRIANGLE) {
        return Err(nothing_seen());
    }
    Ok(Samples {
        field: Heightfield::new(lattice, buffer.heights)?,
        frame,
        indices: buffer.triangles,
        weights: buffer.weights,
    })
}

fn sample_cloud(mesh: &Mesh, frame: Frame, lattice: Lattice) -> Result<Samples> {
    let points = mesh.positions().iter().map(|p| frame.view(*p));
    let (heights, indices) = splat(&lattice, points, NO_TRIANGLE)?;
    if indices.iter().all(|i| *i == NO_TRIANGLE) {
        return Err(nothing_seen());
    }
    Ok(Samples {
        field: Heightfield::new(lattice, heights)?,
        frame,
        weights: try_filled("point cloud", indices.len(), [1.0, 0.0, 0.0])?,
        indices,
    })
}

fn nothing_seen() -> Error {
    Error::Unsupported {
        format: "mesh",
        reason: "nothing of it is seen from there: it is edge-on or falls between the lattice's \
                 vertices; choose another view or a finer resolution"
            .into(),
    }
}

/// Bounding box of all triangles or points in the plane of the view: lower left and upper right corner.
fn seen(mesh: &Mesh, frame: &Frame) -> ([f64; 2], [f64; 2]) {
    let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let mut include = |point| {
        let [x, y, _] = frame.view(point);
        min = [min[0].min(x), min[1].min(y)];
        max = [max[0].max(x), max[1].max(y)];
    };
    if mesh.is_cloud() {
        mesh.positions().iter().for_each(|p| include(*p));
    } else {
        // Vertices that no triangle uses do not count.
        let corners = mesh.triangles().iter().flat_map(|t| mesh.corners(*t));
        corners.for_each(include);
    }
    (min, max)
}

impl Samples {
    /// Sampled heights of the mesh: `x` to the right, `y` up, `z` towards the viewer.
    pub fn heightfield(&self) -> &Heightfield {
        &self.field
    }

    /// Returns the sampled heights, without the frame of the view and the hits.
    pub fn into_heightfield(self) -> Heightfield {
        self.field
    }

    /// Frame of the view: the axes of the image in those of the mesh.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The first hit of the ray through a lattice vertex, which is given by its row-major index; `None` if nothing is
    /// hit.
    pub fn hit(&self, index: usize) -> Option<Hit> {
        let found = self.indices[index];
        (found != NO_TRIANGLE).then(|| Hit {
            index: found as usize,
            weights: self.weights[index],
        })
    }

    /// Transfers values from the mesh's vertices to the lattice's vertices: interpolated linearly in each triangle, the
    /// nearest point's in a cloud, NaN where nothing was hit. For colours, texture coordinates and other attributes of
    /// the mesh that was sampled.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    ///
    /// # Panics
    /// If there are not as many values as the mesh has vertices.
    pub fn carry<const N: usize>(&self, mesh: &Mesh, values: &[[f32; N]]) -> Result<Vec<[f32; N]>> {
        let mut carried = try_filled("sampled values", self.indices.len(), [f32::NAN; N])?;
        for (i, out) in carried.iter_mut().enumerate() {
            let Some(Hit { index, weights }) = self.hit(i) else {
                continue;
            };
            if mesh.is_cloud() {
                *out = values[index];
            } else {
                let corners = mesh.triangles()[index].map(|v| &values[v as usize]);
                *out = std::array::from_fn(|k| (0..3).map(|j| weights[j] * corners[j][k]).sum());
            }
        }
        Ok(carried)
    }

    /// Texture number at each lattice vertex, of the triangle that its ray hits: -1 where it hits none. Without
    /// [`Mesh::textures`] all triangles have number 0.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn textures(&self, mesh: &Mesh) -> Result<Vec<i32>> {
        let mut textures = try_filled("sampled values", self.indices.len(), -1)?;
        for (i, out) in textures.iter_mut().enumerate() {
            if let Some(Hit { index, .. }) = self.hit(i) {
                *out = mesh.textures().map_or(0, |textures| textures[index]);
            }
        }
        Ok(textures)
    }
}

struct Buffer {
    lattice: Lattice,
    heights: Vec<f64>,
    triangles: Vec<u32>,
    weights: Vec<[f32; 3]>,
}

/// A corner of a triangle in lattice coordinates: `along` a row in spacings, `down` in rows.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Corner {
    down: f64,
    along: f64,
    height: f64,
}

/// Intersection of a lattice row with an edge of a triangle: at the share `share` of the way from corner `from` to
/// corner `to`.
#[derive(Clone, Copy)]
struct Crossing {
    along: f64,
    from: usize,
    to: usize,
    share: f64,
}

impl Buffer {
    fn place(&self, [x, y, height]: [f64; 3]) -> Corner {
        let [left, top] = self.lattice.origin();
        Corner {
            down: (top - y) / self.lattice.row_spacing(),
            along: (x - left) / self.lattice.spacing(),
            height,
        }
    }

    fn scan(&mut self, triangle: u32, corners: [Corner; 3]) {
        let [a, b, c] = corners;
        if (b.along - a.along) * (c.down - a.down) == (c.along - a.along) * (b.down - a.down) {
            return; // degenerate, or edge-on
        }
        let first = a.down.min(b.down).min(c.down).ceil().max(0.0);
        let last = a.down.max(b.down).max(c.down).floor();
        let last = last.min((self.lattice.rows() - 1) as f64);
        // Casts saturate, so that the range is empty where `last` is below `first`.
        for row in first as isize..=last as isize {
            if let Some((left, right)) = interval(&corners, row as f64) {
                self.fill(triangle, &corners, row as usize, left, right);
            }
        }
    }

    fn fill(
        &mut self,
        triangle: u32,
        corners: &[Corner; 3],
        row: usize,
        left: Crossing,
        right: Crossing,
    ) {
        let shift = shift(row);
        let first = (left.along + shift).ceil().max(0.0);
        let last = (right.along + shift).floor();
        let last = last.min((self.lattice.cols() - 1) as f64);
        let (start, end) = (left.weights(), right.weights());
        let width = right.along - left.along;
        for col in first as isize..=last as isize {
            let at = col as f64 - shift - left.along;
            let share = if width > 0.0 {
                (at / width).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let weights: [f64; 3] =
                std::array::from_fn(|k| (1.0 - share) * start[k] + share * end[k]);
            let height = (0..3).map(|k| weights[k] * corners[k].height).sum();
            let index = self.lattice.index(row, col as usize);
            let nearest = self.heights[index];
            if nearest.is_nan() || height > nearest {
                self.heights[index] = height;
                self.triangles[index] = triangle;
                self.weights[index] = weights.map(lanes::single);
            }
        }
    }
}

impl Crossing {
    /// Barycentric coordinates of the intersection in the triangle.
    fn weights(&self) -> [f64; 3] {
        let mut weights = [0.0; 3];
        weights[self.from] += 1.0 - self.share;
        weights[self.to] += self.share;
        weights
    }
}

/// Finds where a lattice row enters and leaves a triangle; `None` if it does not meet the triangle.
fn interval(corners: &[Corner; 3], row: f64) -> Option<(Crossing, Crossing)> {
    let mut found: Option<(Crossing, Crossing)> = None;
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        for crossing in crossings(corners, from, to, row).into_iter().flatten() {
            found = Some(match found {
                None => (crossing, crossing),
                Some((left, right)) if crossing.along < left.along => (crossing, right),
                Some((left, right)) if crossing.along > right.along => (left, crossing),
                Some(both) => both,
            });
        }
    }
    found
}

/// Finds the intersections of a triangle's edge with a lattice row: one, both of its ends if it lies on the row, or
/// none. They are equal to the last bit for an edge and its reverse.
fn crossings(corners: &[Corner; 3], from: usize, to: usize, row: f64) -> [Option<Crossing>; 2] {
    let key = |i: usize| (corners[i].down, corners[i].along);
    let (from, to) = if key(to) < key(from) {
        (to, from)
    } else {
        (from, to)
    };
    let (a, b) = (corners[from], corners[to]);
    let at = |share, along| {
        Some(Crossing {
            along,
            from,
            to,
            share,
        })
    };
    if !(a.down <= row && row <= b.down) {
        [None, None]
    } else if a.down == b.down {
        [at(0.0, a.along), at(1.0, b.along)]
    } else if row == b.down {
        [at(1.0, b.along), None]
    } else {
        let share = (row - a.down) / (b.down - a.down);
        [at(share, a.along + share * (b.along - a.along)), None]
    }
}
