//! Cameras: projection of points in space to pixels, and back-projection of pixels with a depth.

use crate::error::{Error, Result, positive};

/// Ratios of the longer to the shorter side of photos as cameras and phones take them.
const CAMERA_SIDE_RATIOS: [f64; 7] = [1.0, 4.0 / 3.0, 1.5, 16.0 / 9.0, 2.0, 19.5 / 9.0, 20.0 / 9.0];

/// Maximum relative deviation of a photo's side ratio from a camera's: reduced photos have their sides rounded to pixels.
const CAMERA_SIDE_RATIO_TOLERANCE: f64 = 0.003;

/// Whether a photo of `size` (width, height) has the proportions in which cameras take photos; otherwise it was cropped, and
/// neither its focal length nor its principal point can be derived from its size.
pub(crate) fn has_camera_proportions(size: [usize; 2]) -> bool {
    let [width, height] = size.map(|n| n as f64);
    let ratio = width.max(height) / width.min(height);
    (CAMERA_SIDE_RATIOS.iter()).any(|own| (ratio / own - 1.0).abs() < CAMERA_SIDE_RATIO_TOLERANCE)
}

/// What the values of a depth image measure: the distance along the camera's axis or along the line of sight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum Depth {
    /// Distance in the direction of the camera's axis, as most depth cameras and depth buffers give it.
    #[default]
    Planar,
    /// Distance from the camera's centre, in the direction of the pixel's own line of sight.
    Ray,
}

/// Lens distortion, with the coefficients of OpenCV and most calibration programs: radial `k1, k2, k3` and tangential
/// `p1, p2` (D. C. Brown, Close-range camera calibration, 1971).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[allow(missing_docs)]
pub struct Distortion {
    pub k1: f64,
    pub k2: f64,
    pub p1: f64,
    pub p2: f64,
    pub k3: f64,
}

impl Distortion {
    /// Applies the distortion: returns the position in the image of a point that an ideal lens would show at `[x, y]`,
    /// both in focal lengths from the axis. `None` beyond the radius at which the polynomial turns back.
    fn distorted(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let r = x * x + y * y;
        let growth = 1.0 + r * (3.0 * self.k1 + r * (5.0 * self.k2 + r * 7.0 * self.k3));
        let [dx, dy] = self.tangential(x, y);
        let radial = self.radial(r);
        (growth > 0.0).then_some([x * radial + dx, y * radial + dy])
    }

    /// Removes the distortion, as the inverse of [`Self::distorted`], by fixed-point iteration; `None` where that does
    /// not converge.
    fn undistorted(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        if *self == Distortion::default() {
            return Some([x, y]);
        }
        let mut ideal = [x, y];
        for _ in 0..50 {
            let [dx, dy] = self.tangential(ideal[0], ideal[1]);
            let radial = self.radial(ideal[0] * ideal[0] + ideal[1] * ideal[1]);
            ideal = [(x - dx) / radial, (y - dy) / radial];
        }
        let [u, v] = self.distorted(ideal)?;
        ((u - x).hypot(v - y) < 1e-9).then_some(ideal)
    }

    fn radial(&self, r: f64) -> f64 {
        1.0 + r * (self.k1 + r * (self.k2 + r * self.k3))
    }

    fn tangential(&self, x: f64, y: f64) -> [f64; 2] {
        let (xy, r) = (2.0 * x * y, x * x + y * y);
        [
            self.p1 * xy + self.p2 * (r + 2.0 * x * x),
            self.p1 * (r + 2.0 * y * y) + self.p2 * xy,
        ]
    }
}

/// Intrinsics of a pinhole camera: focal lengths, principal point and lens distortion, in pixels.
///
/// The centre of the top left pixel is at `(0, 0)`, columns count to the right and rows down, as in OpenCV and the
/// files of most cameras: a point `x` to the right of the axis, `y` below it and `z` ahead is seen at `(fx·x/z + cx,
/// fy·y/z + cy)`, apart from lens distortion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intrinsics {
    /// Horizontal focal length, in widths of a pixel.
    pub fx: f64,
    /// Vertical focal length, in heights of a pixel.
    pub fy: f64,
    /// Horizontal coordinate of the principal point (where the camera's axis meets the image), in pixels.
    pub cx: f64,
    /// Vertical coordinate of the principal point (where the camera's axis meets the image), in pixels from the top.
    pub cy: f64,
    /// Width and height, in pixels, of the images that the intrinsics are for; an image of another size is assumed to
    /// show the same view, finer or coarser. `None`: any image.
    pub size: Option<[usize; 2]>,
    /// Distortion by the camera's lens.
    pub distortion: Distortion,
    /// Factor that converts a depth image's values to lengths: 0.001 makes metres of millimetres.
    pub depth_scale: f64,
    /// Kind of distance that the values of a depth image are: along the camera's axis or along the line of sight.
    pub depth: Depth,
    /// Number of pixels of a depth image that are discarded on both sides of a jump in depth, where sensors give depths
    /// between the two surfaces that belong to neither (flying pixels). Default 2.
    pub margin: usize,
}

impl Intrinsics {
    /// Makes intrinsics from focal lengths and principal point in pixels, without lens distortion. Depth images hold
    /// distances along the camera's axis, in the unit of the result.
    pub fn new(fx: f64, fy: f64, cx: f64, cy: f64) -> Self {
        Intrinsics {
            fx,
            fy,
            cx,
            cy,
            size: None,
            distortion: Distortion::default(),
            depth_scale: 1.0,
            depth: Depth::Planar,
            margin: 2,
        }
    }

    /// Makes the intrinsics of a camera that looks at the middle of its images, of size (width, height), with a field
    /// of view in degrees across their longer side.
    ///
    /// # Errors
    /// [`Error::Option`] for an angle that is not between 0 and 180 degrees, [`Error::Empty`].
    pub fn with_field_of_view(degrees: f64, size: [usize; 2]) -> Result<Self> {
        let [width, height] = size.map(|n| n as f64);
        let focal = focal_length_of(degrees, width.max(height))?;
        if size.contains(&0) {
            return Err(Error::Empty { what: "photo" });
        }
        let mut camera = Intrinsics::new(focal, focal, (width - 1.0) / 2.0, (height - 1.0) / 2.0);
        camera.size = Some(size);
        Ok(camera)
    }

    /// Scales the intrinsics to images of another size (width, height) that show the same view: `cx' + ½ = (cx + ½)·s`.
    ///
    /// # Errors
    /// [`Error::Option`] for a number that is out of range or a centre outside the image,
    /// [`Error::Unsupported`] where the two sizes have not the same proportions, to 2 %, for such an
    /// image does not show the same.
    pub fn for_size(&self, size: [usize; 2]) -> Result<Self> {
        self.check()?;
        let own = self.size.unwrap_or(size);
        if own.contains(&0) || size.contains(&0) {
            return Err(Error::Empty { what: "image" });
        }
        let [sx, sy] = [0, 1].map(|k| size[k] as f64 / own[k] as f64);
        if (sx / sy - 1.0).abs() > 0.02 {
            return Err(Error::Unsupported {
                format: "photo",
                reason: other_proportions(own, size),
            });
        }
        for (name, centre, side) in [("cx", self.cx, own[0]), ("cy", self.cy, own[1])] {
            if !(-0.5..=side as f64 - 0.5).contains(&centre) {
                return Err(Error::option(
                    name,
                    centre,
                    "must lie inside the image; are the numbers for images of another size? Then give \
                     that size with them",
                ));
            }
        }
        Ok(Intrinsics {
            fx: self.fx * sx,
            fy: self.fy * sy,
            cx: (self.cx + 0.5) * sx - 0.5,
            cy: (self.cy + 0.5) * sy - 0.5,
            size: Some(size),
            ..*self
        })
    }

    /// Projects a point in space to the image, as column and row in pixels; `None` if it is not ahead of the camera.
    /// The axes are x to the right, y up and z towards the viewer, the origin the camera's centre.
    pub fn project(&self, [x, y, z]: [f64; 3]) -> Option<[f64; 2]> {
        if z >= 0.0 || z.is_nan() {
            return None;
        }
        let [u, v] = self.distortion.distorted([x / -z, y / z])?;
        Some([self.fx * u + self.cx, self.fy * v + self.cy])
    }

    /// Back-projects a pixel with a depth to a point in space, in the axes of [`Intrinsics::project`]; `None` where the
    /// lens cannot have shown it. `value` is the depth as the image stores it.
    pub(super) fn point(&self, col: f64, row: f64, value: f64) -> Option<[f64; 3]> {
        let seen = [(col - self.cx) / self.fx, (row - self.cy) / self.fy];
        let [x, y] = self.distortion.undistorted(seen)?;
        let depth = value * self.depth_scale;
        let ahead = match self.depth {
            Depth::Planar => depth,
            Depth::Ray => depth / x.hypot(y).hypot(1.0),
        };
        Some([x * ahead, -y * ahead, -ahead])
    }

    fn check(&self) -> Result<()> {
        positive("fx", self.fx)?;
        positive("fy", self.fy)?;
        positive("depth_scale", self.depth_scale)?;
        let Distortion { k1, k2, p1, p2, k3 } = self.distortion;
        let names = ["cx", "cy", "k1", "k2", "p1", "p2", "k3"];
        for (name, value) in names.iter().zip([self.cx, self.cy, k1, k2, p1, p2, k3]) {
            if !value.is_finite() {
                return Err(Error::option(name, value, "must be a finite number"));
            }
        }
        Ok(())
    }
}

/// Computes the focal length, in pixels, from a field of view in degrees across a number of pixels.
pub(crate) fn focal_length_of(degrees: f64, pixels: f64) -> Result<f64> {
    if !(degrees > 0.0 && degrees < 180.0) {
        let requirement = "must be above 0 and below 180 degrees";
        return Err(Error::option("field_of_view", degrees, requirement));
    }
    Ok(0.5 * pixels / (degrees.to_radians() / 2.0).tan())
}

fn other_proportions(own: [usize; 2], size: [usize; 2]) -> String {
    let turned = own[0] as f64 * size[0] as f64 / (own[1] as f64 * size[1] as f64);
    let what = if (turned - 1.0).abs() < 0.02 {
        "it lies on its side: turn it as the camera's images are"
    } else {
        "it shows another part of the scene: give a photo that was not cropped, or the camera of this one"
    };
    format!(
        "it has {} × {} pixels where the camera's images have {} × {}: {what}",
        size[0], size[1], own[0], own[1]
    )
}

/// Pose of one camera relative to another: a point at `p` for the other camera is at `R p + t` for this one, in the
/// axes of calibrations: x to the right, y down, z ahead.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Rotation matrix `R`, row by row.
    pub rotation: [[f64; 3]; 3],
    /// Translation vector `t`, in the unit of the depths.
    pub translation: [f64; 3],
}

impl Default for Pose {
    /// Returns the identity: no rotation and no translation.
    fn default() -> Self {
        Pose {
            rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            translation: [0.0; 3],
        }
    }
}

/// A camera that takes photos, with its pose relative to the camera that measures depths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Intrinsics of the camera. They are scaled to a photo of another size.
    pub intrinsics: Intrinsics,
    /// Pose of the camera relative to the camera that measures depths.
    pub pose: Pose,
}

impl Camera {
    /// Makes a camera with the pose of the one that measures depths, such as a phone's.
    pub fn new(intrinsics: Intrinsics) -> Self {
        Camera {
            intrinsics,
            pose: Pose::default(),
        }
    }

    /// Returns the camera with another pose relative to the camera that measures depths.
    pub fn at(self, pose: Pose) -> Self {
        Camera { pose, ..self }
    }

    /// Returns the camera for photos of another size that show the same view, and checks its pose.
    ///
    /// # Errors
    /// Those of [`Intrinsics::for_size`]; [`Error::Option`] if the pose's matrix is no rotation.
    pub fn for_size(&self, size: [usize; 2]) -> Result<Self> {
        let [a, b, c] = self.pose.rotation;
        let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
        let unit = [a, b, c]
            .iter()
            .all(|row| (dot(*row, *row) - 1.0).abs() < 1e-3);
        let square = [(a, b), (b, c), (c, a)]
            .iter()
            .all(|(p, q)| dot(*p, *q).abs() < 1e-3);
        let cross = [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ];
        if !(unit && square && dot(cross, c) > 0.0) {
            let requirement = "must be a rotation matrix: orthonormal, without a reflection";
            return Err(Error::option("rotation", self.pose.rotation, requirement));
        }
        if !self.pose.translation.iter().all(|t| t.is_finite()) {
            return Err(Error::option(
                "translation",
                self.pose.translation,
                "must be finite",
            ));
        }
        Ok(Camera {
            intrinsics: self.intrinsics.for_size(size)?,
            pose: self.pose,
        })
    }

    /// Projects a point in the axes of the camera that measures depths to this camera's photo, as column and row in
    /// pixels. `None` if it is not ahead of this camera.
    pub fn project(&self, point: [f64; 3]) -> Option<[f64; 2]> {
        self.intrinsics.project(self.seen_from(point))
    }

    /// Transforms a point from the axes of the camera that measures depths to this camera's axes.
    pub(crate) fn seen_from(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let Pose {
            rotation,
            translation,
        } = self.pose;
        let moved: [f64; 3] = std::array::from_fn(|k| {
            rotation[k][0] * x - rotation[k][1] * y - rotation[k][2] * z + translation[k]
        });
        [moved[0], -moved[1], -moved[2]]
    }
}
