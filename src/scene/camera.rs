//! Depth cameras: from depths at the pixels of an image to a mesh in space.

use nalgebra::Vector3;

use super::mesh::Mesh;
use crate::error::{Error, Result, positive, try_filled};
use crate::heights::heightfield::HeightImage;
use crate::math::lanes;

/// What a depth is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Depth {
    /// The distance along the camera's axis, as depth cameras and depth buffers
    /// mostly give it.
    #[default]
    Planar,
    /// The distance from the camera's centre, along the pixel's own ray.
    Ray,
}

/// A pinhole camera without distortion, in pixels.
///
/// The centre of the top left pixel is at `(0, 0)`, columns count to the right
/// and rows down, as in OpenCV and the files of most cameras: a point `x` to the
/// right of the axis, `y` below it and `z` ahead is seen at
/// `(fx·x/z + cx, fy·y/z + cy)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intrinsics {
    /// Focal length in columns.
    pub fx: f64,
    /// Focal length in rows.
    pub fy: f64,
    /// Column of the axis.
    pub cx: f64,
    /// Row of the axis.
    pub cy: f64,
    /// Length of one step of the image's values: 0.001 makes metres of millimetres.
    pub depth_scale: f64,
    /// What the image's values are.
    pub depth: Depth,
}

/// How much farther one pixel's point may be than its neighbour's, in the distance between the two
/// across the line of sight.
const STEEPEST: f64 = 10.0;

impl Intrinsics {
    /// A camera whose image holds planar depths in the unit of the result.
    pub fn new(fx: f64, fy: f64, cx: f64, cy: f64) -> Self {
        Intrinsics {
            fx,
            fy,
            cx,
            cy,
            depth_scale: 1.0,
            depth: Depth::Planar,
        }
    }

    /// What the camera has seen, as a mesh: each pixel is a vertex, by the same
    /// index, and neighbouring ones are joined by triangles.
    ///
    /// The axes are those of the camera as [`Frame`](crate::Frame)s have them:
    /// x to the right, y up, z towards the viewer, the origin at the camera's
    /// centre. So looking along `-z` is looking along the camera's axis.
    ///
    /// A depth that is NaN, 0 or below is none: its vertex lies at the origin,
    /// and no triangle uses it. Two pixels are not joined where one point lies
    /// behind the other by more than ten times their distance across the line of
    /// sight, for that is a jump: a surface that steep (seen at less than 5.7°)
    /// is lost. Of the two ways to cut a square of pixels the one with the
    /// shorter diagonal is taken, unless it leaves fewer triangles.
    ///
    /// The pixels have texture coordinates for a picture with the same outline.
    /// The image's own pixel size does not matter. Costs `O(pixels)`.
    ///
    /// # Errors
    /// [`Error::Option`] for a number of the camera that is out of range,
    /// [`Error::NotFinite`] if a point is too far away for a number,
    /// [`Error::Unsupported`] if no three neighbours can be joined,
    /// [`Error::OutOfMemory`].
    pub fn back_project(&self, depths: &HeightImage) -> Result<Mesh> {
        self.check()?;
        let (width, height) = (depths.width(), depths.height());
        let mut positions = try_filled("mesh", width * height, [0.0; 3])?;
        let mut uvs = try_filled("mesh", width * height, [0f32; 2])?;
        for (i, value) in depths.values().iter().enumerate() {
            let (col, row) = ((i % width) as f64, (i / width) as f64);
            let share = |at: f64, of: usize| (at + 0.5) / of as f64;
            uvs[i] = [share(col, width), 1.0 - share(row, height)].map(lanes::single);
            if *value > 0.0 {
                positions[i] = self.point(col, row, *value);
            }
        }
        let grid = Grid {
            width,
            values: depths.values(),
            points: &positions,
        };
        let mut triangles = Vec::new();
        for row in 1..height {
            for col in 1..width {
                let found = grid.square(row * width + col);
                triangles.try_reserve(2).map_err(|_| Error::OutOfMemory {
                    what: "mesh",
                    bytes: triangles.len() * size_of::<[u32; 3]>(),
                })?;
                triangles.extend(found.into_iter().flatten());
            }
        }
        if triangles.is_empty() {
            return Err(Error::Unsupported {
                format: "depth image",
                reason:
                    "no three neighbouring pixels have depths without a jump between them; are \
                         the focal lengths in pixels, and is the depth scale right?"
                        .into(),
            });
        }
        Mesh::new(positions, triangles)?.with_uvs(uvs)
    }

    fn check(&self) -> Result<()> {
        positive("fx", self.fx)?;
        positive("fy", self.fy)?;
        positive("depth_scale", self.depth_scale)?;
        for (name, value) in [("cx", self.cx), ("cy", self.cy)] {
            if !value.is_finite() {
                return Err(Error::option(name, value, "must be a finite number"));
            }
        }
        Ok(())
    }

    fn point(&self, col: f64, row: f64, value: f64) -> [f64; 3] {
        let (x, y) = ((col - self.cx) / self.fx, (row - self.cy) / self.fy);
        let depth = value * self.depth_scale;
        let ahead = match self.depth {
            Depth::Planar => depth,
            Depth::Ray => depth / x.hypot(y).hypot(1.0),
        };
        [x * ahead, -y * ahead, -ahead]
    }
}

/// The points of an image's pixels.
struct Grid<'a> {
    width: usize,
    values: &'a [f64],
    points: &'a [[f64; 3]],
}

impl Grid<'_> {
    /// The triangles of the square whose lower right corner is a pixel, counter-clockwise as the
    /// camera sees them.
    fn square(&self, last: usize) -> [Option<[u32; 3]>; 2] {
        let [a, b] = [last - self.width - 1, last - self.width];
        let [c, d] = [last - 1, last];
        let falling = [[a, c, d], [a, d, b]].map(|t| self.triangle(t));
        let rising = [[a, c, b], [b, c, d]].map(|t| self.triangle(t));
        let count = |cut: &[Option<_>; 2]| cut.iter().flatten().count();
        match count(&falling).cmp(&count(&rising)) {
            std::cmp::Ordering::Less => rising,
            std::cmp::Ordering::Greater => falling,
            _ if self.distance(a, d) <= self.distance(b, c) => falling,
            _ => rising,
        }
    }

    fn triangle(&self, corners: [usize; 3]) -> Option<[u32; 3]> {
        let [a, b, c] = corners;
        let whole = corners.iter().all(|i| self.values[*i] > 0.0)
            && [(a, b), (b, c), (c, a)]
                .iter()
                .all(|(from, to)| self.joined(*from, *to));
        whole.then(|| corners.map(|i| i as u32))
    }

    /// Whether there is no jump between two pixels.
    fn joined(&self, from: usize, to: usize) -> bool {
        let [from, to] = [from, to].map(|i| Vector3::from(self.points[i]));
        // In proportion to the distance from the camera, so that nothing over- or underflows.
        let size = from.amax().max(to.amax());
        let (from, to) = (from / size, to / size);
        let sight = (from + to).normalize();
        let way = to - from;
        let along = way.dot(&sight);
        along.abs() <= STEEPEST * (way - sight * along).norm()
    }

    fn distance(&self, from: usize, to: usize) -> f64 {
        (Vector3::from(self.points[from]) - Vector3::from(self.points[to])).norm()
    }
}
