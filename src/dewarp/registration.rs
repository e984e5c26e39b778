//! Where in a photo the points of a surface are.

use super::Extent;
use crate::error::{Error, Result, check_count, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::math::lanes;
use crate::scene::camera::{Camera, Distortion, Intrinsics};
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;

/// What says where in a photo each point of a surface is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there is one for each photo")]
#[non_exhaustive]
pub enum Registration<'a> {
    /// Photo and heights were taken straight from above: a point is where the photo's share of its
    /// extent is.
    Extent(Extent),
    /// A camera took the photo: a point of the *fitted* surface is where the camera sees it, which the
    /// noisy point was not. The frame is that of the surface, in the axes of the camera that saw the
    /// depths (those of [`Samples::frame`](crate::Samples::frame)).
    Camera(Camera, Frame),
    /// Texture coordinates at each vertex of the surface's lattice, as shares from the left and from
    /// the bottom, NaN where there are none, as where a hole was bridged: those of a textured scan, by [`Samples::carry`](crate::Samples::carry).
    Uvs(&'a [[f32; 2]]),
}

impl From<Extent> for Registration<'_> {
    fn from(extent: Extent) -> Self {
        Registration::Extent(extent)
    }
}

impl Registration<'_> {
    /// Texture coordinates of each vertex of a surface in a photo of so many pixels: its place, as
    /// shares from the left and from the bottom, for [`paint`](super::paint) and
    /// [`Triangulation::with_uvs`](crate::Triangulation::with_uvs). Not a number where there is no surface, or nothing in the photo: behind a
    /// camera, beside its photo by more than a hundredth, without texture coordinates. What is
    /// less far beside has the place nearest to it, and so has everything beside an extent.
    ///
    /// # Errors
    /// [`Error::Empty`] for a photo without pixels or an extent without area; those of
    /// [`Camera::for_size`] for a camera of other images than the photo; [`Error::Shape`] if there are not as many
    /// coordinates as vertices; [`Error::OutOfMemory`].
    pub fn uvs(&self, surface: &Heightfield, photo: [usize; 2]) -> Result<Vec<[f32; 2]>> {
        /// Shares of the photo: more than half a pixel of depths.
        const BESIDE: f64 = 0.01;
        let lattice = surface.lattice();
        let (camera, frame) = match self {
            Registration::Extent(extent) => return extent.uvs(lattice),
            Registration::Uvs(uvs) => {
                let what = "texture coordinates of the surface";
                check_count(what, lattice.len(), 2, 2 * uvs.len())?;
                return Ok(uvs.to_vec());
            }
            Registration::Camera(camera, frame) => (camera.for_size(photo)?, frame),
        };
        let mut uvs = try_filled("texture coordinates", lattice.len(), [f32::NAN; 2])?;
        for (i, (uv, z)) in uvs.iter_mut().zip(surface.heights()).enumerate() {
            let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
            let seen = camera.seen_from(frame.unview([x, y, *z]));
            let Some(pixel) = camera.intrinsics.project(seen) else {
                continue;
            };
            let [u, v] = [0, 1].map(|k| (pixel[k] + 0.5) / photo[k] as f64);
            if [u, v]
                .iter()
                .all(|share| (-BESIDE..=1.0 + BESIDE).contains(share))
            {
                *uv = [u, 1.0 - v].map(|share| lanes::single(share.clamp(0.0, 1.0)));
            }
        }
        Ok(uvs)
    }
}

/// The same for a photo of so many pixels.
pub(super) enum Places {
    /// Pixels for each unit across and up, and the upper left corner.
    Plane([f64; 2], [f64; 2]),
    Camera(Camera, Frame),
    /// The same without distortion by the lens: focal lengths and centre.
    Pinhole([f64; 4], Camera, Frame),
    /// At the vertices of the mesh.
    Uvs(Vec<[f32; 2]>, [f64; 2]),
}

impl Places {
    pub(super) fn new(
        registration: Registration,
        photo: [usize; 2],
        mesh: &Triangulation,
    ) -> Result<Self> {
        if photo.contains(&0) {
            return Err(Error::Empty { what: "photo" });
        }
        let size = photo.map(|n| n as f64);
        match registration {
            Registration::Extent(extent) => {
                let sides = extent.sides()?;
                let corner = [extent.min[0], extent.max[1]];
                Ok(Places::Plane([0, 1].map(|k| size[k] / sides[k]), corner))
            }
            Registration::Camera(camera, frame) => {
                let camera = camera.for_size(photo)?;
                let Intrinsics { fx, fy, cx, cy, .. } = camera.intrinsics;
                Ok(
                    match camera.intrinsics.distortion == Distortion::default() {
                        true => Places::Pinhole([fx, fy, cx, cy], camera, frame),
                        false => Places::Camera(camera, frame),
                    },
                )
            }
            Registration::Uvs(uvs) => {
                let uvs = mesh.picked("texture coordinates of the surface", uvs)?;
                Ok(Places::Uvs(uvs, size))
            }
        }
    }

    /// What is interpolated over a triangle, for a vertex of the mesh at a point: it is linear
    /// there, which places in a photo through a camera are not.
    pub(super) fn of_vertex(&self, vertex: usize, point: [f64; 3]) -> [f64; 3] {
        match self {
            Places::Plane(..) => point,
            Places::Camera(camera, frame) | Places::Pinhole(_, camera, frame) => {
                camera.seen_from(frame.unview(point))
            }
            Places::Uvs(uvs, _) => [uvs[vertex][0].into(), uvs[vertex][1].into(), 0.0],
        }
    }

    /// The place in the photo, in pixels, `[0, 0]` the centre of the upper left one. Nothing behind
    /// the camera and where there are no texture coordinates.
    pub(super) fn of(&self, [x, y, z]: [f64; 3]) -> Option<[f32; 2]> {
        let place = match self {
            Places::Plane([across, up], [left, top]) => {
                [(x - left) * across - 0.5, (top - y) * up - 0.5]
            }
            Places::Camera(camera, _) => camera.intrinsics.project([x, y, z])?,
            Places::Pinhole([fx, fy, cx, cy], ..) => {
                if z >= 0.0 || z.is_nan() {
                    return None;
                }
                let near = -1.0 / z;
                [cx + fx * x * near, cy - fy * y * near]
            }
            Places::Uvs(_, [width, height]) => [x * width - 0.5, (1.0 - y) * height - 0.5],
        };
        let place = place.map(lanes::single);
        place.iter().all(|v| v.is_finite()).then_some(place)
    }
}
