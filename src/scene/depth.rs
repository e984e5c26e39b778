//! Back-projection of depth images to meshes in space.

use nalgebra::Vector3;

use super::camera::Intrinsics;
use super::mesh::Mesh;
use crate::error::{Error, Result, check_count, try_filled};
use crate::heights::heightfield::HeightImage;
use crate::math::lanes;

/// Maximum difference in depth between the points of neighbouring pixels, per distance across the line of sight; above
/// it the pixels are not joined.
const MAX_DEPTH_SLOPE: f64 = 10.0;

impl Intrinsics {
    /// Back-projects a depth image to a mesh in space: each pixel becomes the vertex of the same index, and
    /// neighbouring pixels are joined by triangles.
    ///
    /// The axes are those of the camera as [`Frame`](crate::Frame)s have them:
    /// x to the right, y up, z towards the viewer, the origin at the camera's
    /// centre. So looking along `-z` is looking along the camera's axis.
    ///
    /// A depth that is NaN, 0 or negative counts as missing: its vertex lies at the origin, and no triangle uses it.
    /// Two pixels are not joined across a jump, where one point lies behind the other by more than ten times their
    /// distance across the line of sight; a surface that steep (seen at less than 5.7°) is lost. Pixels beside a jump
    /// are discarded, as many as [`margin`](Intrinsics::margin) says; the jump may extend over up to three pixels. Of
    /// the two ways to cut a square of pixels the one with the shorter diagonal is taken, unless it leaves fewer
    /// triangles.
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
        self.project_back(depths, None)
    }

    /// Back-projects only the pixels of a depth image whose flag in `keep` is not 0, as [`Intrinsics::within`] gives
    /// them. The other depths still show where jumps are. If depths are masked before instead, the background of a page
    /// is lost, and depths that mix page and background stay and bend the page's border.
    ///
    /// # Errors
    /// Those of [`Intrinsics::back_project`]; [`Error::Shape`] if there is not a flag for each pixel.
    pub fn back_project_within(&self, depths: &HeightImage, keep: &[u8]) -> Result<Mesh> {
        let (width, height) = (depths.width(), depths.height());
        check_count("mask", height, width, keep.len())?;
        self.project_back(depths, Some(keep))
    }

    fn project_back(&self, depths: &HeightImage, keep: Option<&[u8]>) -> Result<Mesh> {
        let (width, height) = (depths.width(), depths.height());
        let camera = self.for_size([width, height])?;
        let mut positions = try_filled("mesh", width * height, [0.0; 3])?;
        let mut uvs = try_filled("mesh", width * height, [0f32; 2])?;
        let mut there = try_filled("mesh", width * height, false)?;
        for (i, value) in depths.values().iter().enumerate() {
            let (col, row) = ((i % width) as f64, (i / width) as f64);
            let share = |at: f64, of: usize| (at + 0.5) / of as f64;
            uvs[i] = [share(col, width), 1.0 - share(row, height)].map(lanes::single);
            if *value > 0.0
                && let Some(point) = camera.point(col, row, *value)
            {
                positions[i] = point;
                there[i] = true;
            }
        }
        for (there, outline) in there.iter_mut().zip(camera.outlines(&positions, width)?) {
            *there &= !outline;
        }
        for (there, keep) in there.iter_mut().zip(keep.into_iter().flatten()) {
            *there &= *keep != 0;
        }
        let grid = Grid {
            width,
            there: &there,
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

    /// Marks the pixels of a depth image that are within the margin of a jump in depth. `points` are the back-projected
    /// pixels; those without a depth are at the origin.
    fn outlines(&self, points: &[[f64; 3]], width: usize) -> Result<Vec<bool>> {
        let mut outlines = try_filled("mesh", points.len(), false)?;
        if self.margin > 0 {
            let height = points.len() / width;
            for row in 0..height {
                let line = Line {
                    points,
                    start: row * width,
                    step: 1,
                    length: width,
                };
                line.mark(self.fx, self.margin, &mut outlines);
            }
            for col in 0..width {
                let line = Line {
                    points,
                    start: col,
                    step: width,
                    length: height,
                };
                line.mark(self.fy, self.margin, &mut outlines);
            }
        }
        Ok(outlines)
    }
}

/// A row or a column of a depth image's pixels, along which jumps in depth are detected.
struct Line<'a> {
    points: &'a [[f64; 3]],
    start: usize,
    step: usize,
    length: usize,
}

/// Maximum number of pixels over which a jump in depth may extend.
const MAX_JUMP_PIXELS: usize = 3;

impl Line<'_> {
    /// Distance of pixel `i`'s point ahead of the camera; `None` where there is no depth.
    fn ahead(&self, i: usize) -> Option<f64> {
        let depth = -self.points.get(self.start + i * self.step)?[2];
        (i < self.length && depth > 0.0).then_some(depth)
    }

    fn mark(&self, focal: f64, margin: usize, outlines: &mut [bool]) {
        for from in 0..self.length {
            for wide in 1..=MAX_JUMP_PIXELS {
                if self.jumps(from, wide, focal) {
                    // Pixels within the jump count, too.
                    let beyond = if wide == 1 { margin } else { margin - 1 };
                    let first = (from + 1).saturating_sub(beyond);
                    for i in first..(from + wide + beyond).min(self.length) {
                        outlines[self.start + i * self.step] = true;
                    }
                }
            }
        }
    }

    /// Whether the depth jumps from pixel `from` to the one `wide` pixels further on. Over several pixels it must rise
    /// from the first to the last, and much more than the depths before and after them; otherwise it is a steep
    /// surface.
    fn jumps(&self, from: usize, wide: usize, focal: f64) -> bool {
        let (Some(a), Some(b)) = (self.ahead(from), self.ahead(from + wide)) else {
            return false;
        };
        let rise = (b - a).abs();
        if rise <= MAX_DEPTH_SLOPE * a.min(b) / focal {
            return false;
        }
        let part = rise / wide as f64 / 4.0;
        let steps = |i: usize, level: f64| self.ahead(i).is_some_and(|z| (z - level).abs() > part);
        let within = steps(from + 1, a) && steps(from + wide - 1, b);
        let before = from.checked_sub(1).is_some_and(|i| steps(i, a));
        wide == 1 || within && !before && !steps(from + wide + 1, b)
    }
}

/// Pixels of a depth image as points in space, row by row, from which triangles are made.
struct Grid<'a> {
    width: usize,
    there: &'a [bool],
    points: &'a [[f64; 3]],
}

impl Grid<'_> {
    /// Makes the up to two triangles of the square of pixels whose lower right corner is pixel `last`,
    /// counter-clockwise as the camera sees them.
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
        let whole = corners.iter().all(|i| self.there[*i])
            && [(a, b), (b, c), (c, a)]
                .iter()
                .all(|(from, to)| self.joined(*from, *to));
        whole.then(|| corners.map(|i| i as u32))
    }

    /// Whether two neighbouring pixels are joined: there is no jump in depth between them.
    fn joined(&self, from: usize, to: usize) -> bool {
        let [from, to] = [from, to].map(|i| Vector3::from(self.points[i]));
        // In proportion to the distance from the camera, so that nothing over- or underflows.
        let size = from.amax().max(to.amax());
        let (from, to) = (from / size, to / size);
        let sight = (from + to).normalize();
        let way = to - from;
        let along = way.dot(&sight);
        along.abs() <= MAX_DEPTH_SLOPE * (way - sight * along).norm()
    }

    fn distance(&self, from: usize, to: usize) -> f64 {
        (Vector3::from(self.points[from]) - Vector3::from(self.points[to])).norm()
    }
}
