//! Registration of a photo to a surface: where the photo shows each of the surface's points.

use super::extent::Extent;
use crate::error::{Error, Result, check_count, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::math::lanes;
use crate::scene::camera::{Camera, Distortion, Intrinsics};
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;

/// Registration of a photo to a surface: tells where the photo shows each point of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there is one for each photo")]
#[non_exhaustive]
pub enum Registration<'a> {
    /// Photo and heights were both taken from straight above: a point's place in the photo is given by its position in
    /// this rectangle.
    Extent(Extent),
    /// A camera took the photo, and shows each point of the *fitted* surface by perspective projection. The frame maps
    /// the surface to the axes of the camera that measured the depths (as [`Samples::frame`](crate::Samples::frame)).
    Camera(Camera, Frame),
    /// Texture coordinates at each vertex of the surface's lattice, as shares from the left and from
    /// the bottom; NaN where there are none, as in a bridged hole. A textured scan has them by
    /// [`Samples::carry`](crate::Samples::carry).
    Uvs(&'a [[f32; 2]]),
}

impl From<Extent> for Registration<'_> {
    fn from(extent: Extent) -> Self {
        Registration::Extent(extent)
    }
}

impl Registration<'_> {
    /// Texture coordinates of each vertex of a surface in a photo of `photo` (width and height) pixels: its place, as
    /// shares from the left and from the bottom, for [`paint`](super::paint) and
    /// [`Triangulation::with_uvs`](crate::Triangulation::with_uvs). NaN where there is no surface, behind a
    /// camera, outside of its photo by more than a hundredth, and without texture coordinates. Points
    /// nearer to the photo, and all points outside of an extent, have the nearest place in it.
    ///
    /// # Errors
    /// [`Error::Empty`] for a photo without pixels or an extent without area; those of
    /// [`Camera::for_size`] for a camera of other images than the photo; [`Error::Shape`] if there are not as many
    /// coordinates as vertices; [`Error::OutOfMemory`].
    pub fn uvs(&self, surface: &Heightfield, photo: [usize; 2]) -> Result<Vec<[f32; 2]>> {
        /// Maximum distance outside of the photo, as a share of its side, at which a point still gets texture
        /// coordinates, those of the photo's border: more than half a pixel of a depth image.
        const MAX_OUTSIDE_SHARE: f64 = 0.01;
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
            let seen = camera.seen_from(frame.to_world([x, y, *z]));
            let Some(pixel) = camera.intrinsics.project(seen) else {
                continue;
            };
            let [u, v] = [0, 1].map(|k| (pixel[k] + 0.5) / photo[k] as f64);
            if [u, v]
                .iter()
                .all(|share| (-MAX_OUTSIDE_SHARE..=1.0 + MAX_OUTSIDE_SHARE).contains(share))
            {
                *uv = [u, 1.0 - v].map(|share| lanes::single(share.clamp(0.0, 1.0)));
            }
        }
        Ok(uvs)
    }
}

/// Projection of a surface to a photo of known size: maps attributes, which are linear on each triangle of the surface,
/// to pixels of the photo.
pub(super) enum PhotoProjection {
    /// Photo from straight above: its pixels per unit of length to the right and upwards, and the position of its upper
    /// left corner.
    Plane([f64; 2], [f64; 2]),
    /// Photo by a camera with lens distortion, and the frame that maps the surface to the camera's axes.
    Camera(Camera, Frame),
    /// Photo by a camera without lens distortion: focal lengths and principal point `[fx, fy, cx, cy]` in pixels, the
    /// camera itself, and the frame that maps the surface to its axes.
    Pinhole([f64; 4], Camera, Frame),
    /// Photo with texture coordinates: those of each vertex of the mesh, and the photo's width and height in pixels.
    Uvs(Vec<[f32; 2]>, [f64; 2]),
}

impl PhotoProjection {
    /// Makes the projection for a registration and a photo of `photo` (width and height) pixels. `mesh` is the
    /// triangulated surface.
    ///
    /// # Errors
    /// Those of [`Registration::uvs`].
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
                Ok(PhotoProjection::Plane(
                    [0, 1].map(|k| size[k] / sides[k]),
                    corner,
                ))
            }
            Registration::Camera(camera, frame) => {
                let camera = camera.for_size(photo)?;
                let Intrinsics { fx, fy, cx, cy, .. } = camera.intrinsics;
                Ok(
                    match camera.intrinsics.distortion == Distortion::default() {
                        true => PhotoProjection::Pinhole([fx, fy, cx, cy], camera, frame),
                        false => PhotoProjection::Camera(camera, frame),
                    },
                )
            }
            Registration::Uvs(uvs) => {
                let uvs = mesh.picked("texture coordinates of the surface", uvs)?;
                Ok(PhotoProjection::Uvs(uvs, size))
            }
        }
    }

    /// Returns the attributes of a vertex of the mesh at position `point`, which are interpolated linearly on triangles
    /// (places in a camera's photo are not linear).
    pub(super) fn attributes(&self, vertex: usize, point: [f64; 3]) -> [f64; 3] {
        match self {
            PhotoProjection::Plane(..) => point,
            PhotoProjection::Camera(camera, frame) | PhotoProjection::Pinhole(_, camera, frame) => {
                camera.seen_from(frame.to_world(point))
            }
            PhotoProjection::Uvs(uvs, _) => [uvs[vertex][0].into(), uvs[vertex][1].into(), 0.0],
        }
    }

    /// Projects interpolated attributes to the photo, in pixels; `[0, 0]` is the centre of the upper left pixel. None
    /// behind the camera and without texture coordinates.
    pub(super) fn project(&self, [x, y, z]: [f64; 3]) -> Option<[f32; 2]> {
        let place = match self {
            PhotoProjection::Plane([across, up], [left, top]) => {
                [(x - left) * across - 0.5, (top - y) * up - 0.5]
            }
            PhotoProjection::Camera(camera, _) => camera.intrinsics.project([x, y, z])?,
            PhotoProjection::Pinhole([fx, fy, cx, cy], ..) => {
                if z >= 0.0 || z.is_nan() {
                    return None;
                }
                let near = -1.0 / z;
                [cx + fx * x * near, cy - fy * y * near]
            }
            PhotoProjection::Uvs(_, [width, height]) => [x * width - 0.5, (1.0 - y) * height - 0.5],
        };
        let place = place.map(lanes::single);
        place.iter().all(|v| v.is_finite()).then_some(place)
    }
}
