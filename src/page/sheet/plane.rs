//! Plane through a page's four corners: its homography, and the camera for which it is a rectangle.

use nalgebra::{SMatrix, SVector, Vector3};

use super::camera::SheetCamera;
use super::grid::{SheetGrid, node_shares};
use crate::math::planar::{cross, difference};
use crate::page::robust_fit;

/// Prior knowledge about the camera and the ratio of a page's sides.
#[derive(Debug, Clone, Copy)]
pub(super) struct CameraPrior {
    /// Standard deviation of the logarithm of the camera's focal length, whose expected value is the nominal one.
    pub scale_deviation: f64,
    /// Standard deviation of the coordinates of the camera's principal point, divided by the nominal focal length.
    pub centre_deviation: f64,
    /// Logarithm of the page's height over its width and its standard deviation, if the format is known.
    pub log_ratio: Option<[f64; 2]>,
}

/// Homography that maps a flat page, in shares of its width and height, to normalised image coordinates (pixels from
/// the nominal principal point, over the nominal focal length).
#[derive(Debug, Clone, Copy)]
pub(super) struct Homography {
    matrix: SMatrix<f64, 3, 3>,
}

/// Standard deviation, due to errors of the corners, of the two conditions that a homography shows a rectangle: right
/// angle, and the ratio of sides.
const RECTANGLE_DEVIATION: f64 = 0.02;

/// Standard deviation of the logarithm of a page's height over its width where the format is unknown, about the
/// geometric mean of common formats.
pub(super) const UNKNOWN_RATIO_DEVIATION: f64 = 0.5;

impl CameraPrior {
    /// Returns mean and standard deviation of the logarithm of the page's height over its width. The ratio as seen in
    /// the photo, `apparent`, tells portrait from landscape.
    pub fn ratio(&self, apparent: f64) -> [f64; 2] {
        // Of most formats the ratio of longer to shorter side is √2.
        let common = std::f64::consts::SQRT_2.ln() * (apparent - 1.0).signum();
        self.log_ratio.unwrap_or([common, UNKNOWN_RATIO_DEVIATION])
    }
}

impl Homography {
    /// Computes the homography that maps the flat page's corners to four points, clockwise from the upper left one;
    /// None if three of them are on a line.
    pub fn new(corners: [[f64; 2]; 4]) -> Option<Self> {
        let [p0, p1, p2, p3] = corners;
        let (d1, d2) = (difference(p2, p1), difference(p2, p3));
        let sum = [0, 1].map(|k| p0[k] - p1[k] + p2[k] - p3[k]);
        let area = cross(d1, d2);
        let (g, h) = (cross(sum, d2) / area, cross(d1, sum) / area);
        let row = |k: usize| [p1[k] - p0[k] + g * p1[k], p3[k] - p0[k] + h * p3[k], p0[k]];
        let ([a, b, c], [d, e, f]) = (row(0), row(1));
        let matrix = SMatrix::<f64, 3, 3>::new(a, b, c, d, e, f, g, h, 1.0);
        matrix
            .iter()
            .all(|v| v.is_finite())
            .then_some(Homography { matrix })
    }

    /// Finds the camera, and the logarithm of the page's height over its width, for which the homography is nearest to
    /// the image of a rectangle, given prior knowledge, from the prior's camera on.
    fn camera(&self, prior: &CameraPrior, apparent: f64) -> (SheetCamera, f64) {
        let [ratio, ratio_deviation] = prior.ratio(apparent);
        let start = SVector::<f64, 4>::new(0.0, 0.0, 0.0, ratio);
        let deviations = SVector::<f64, 4>::new(
            prior.scale_deviation,
            prior.centre_deviation,
            prior.centre_deviation,
            ratio_deviation,
        );
        let residuals = |at: &SVector<f64, 4>| {
            let [across, down] = self.sides(at);
            let (a, b) = (across.norm_squared(), down.norm_squared());
            let off = (at - start).component_div(&deviations);
            let (skew, stretch) = (2.0 * across.dot(&down) / (a + b), (a - b) / (a + b));
            SVector::<f64, 6>::new(
                skew / RECTANGLE_DEVIATION,
                stretch / RECTANGLE_DEVIATION,
                off[0],
                off[1],
                off[2],
                off[3],
            )
        };
        let system = |at: &SVector<f64, 4>| {
            let here = residuals(at);
            let mut jacobian = SMatrix::<f64, 6, 4>::zeros();
            for k in 0..4 {
                let mut moved = *at;
                moved[k] += 1e-6;
                jacobian.set_column(k, &((residuals(&moved) - here) / 1e-6));
            }
            Some((jacobian.transpose() * jacobian, jacobian.transpose() * here))
        };
        let step = |at: &SVector<f64, 4>, (normal, right): &(SMatrix<f64, 4, 4>, _), damping| {
            let damped = normal + SMatrix::from_diagonal(&(normal.diagonal() * damping));
            Some(at - damped.cholesky()?.solve(right))
        };
        let cost = |at: &SVector<f64, 4>| residuals(at).norm_squared();
        let at = robust_fit::fit(start, system, step, cost, 0.0).unwrap_or(start);
        (fitted_camera(&at), at[3])
    }

    /// Vectors in space along the flat page's width and height, per unit of flat length and up to a common factor, for
    /// the unknowns `at`: logarithms of the focal length and the ratio of sides first and last, the principal point
    /// between them.
    fn sides(&self, at: &SVector<f64, 4>) -> [Vector3<f64>; 2] {
        let camera = fitted_camera(at);
        let [across, down] = [Vector3::x(), Vector3::y()].map(|way| self.in_space(&camera, way));
        [across, down / at[3].exp()]
    }

    /// Homogeneous coordinates of the flat page as a vector in space, up to a common factor.
    fn in_space(&self, camera: &SheetCamera, flat: Vector3<f64>) -> Vector3<f64> {
        let [x, y, w] = <[f64; 3]>::from(self.matrix * flat);
        let [cx, cy] = camera.centre.map(|at| at * w);
        let scale = camera.log_scale.exp();
        Vector3::new((x - cx) / scale, (y - cy) / scale, w)
    }

    /// Makes a sheet that is the plane of the homography, with a grid of `cols` columns; None if it is not in front of
    /// the camera. `apparent` is the ratio of height to width in the photo.
    pub fn sheet(&self, cols: usize, prior: &CameraPrior, apparent: f64) -> Option<SheetGrid> {
        let (camera, log_ratio) = self.camera(prior, apparent);
        let point = |[x, y]: [f64; 2]| self.in_space(&camera, Vector3::new(x, y, 1.0));
        let rows = grid_rows(cols, log_ratio.exp());
        let unit = (point([1.0, 0.0]) - point([0.0, 0.0])).norm();
        let nodes: Vec<_> = node_shares([cols, rows])
            .map(|share| point(share) / unit)
            .collect();
        let visible = (nodes.iter()).all(|node| camera.project(*node).is_some());
        visible.then_some(SheetGrid {
            cols,
            rows,
            log_ratio,
            camera,
            nodes,
        })
    }
}

/// The camera of the unknowns of a plane.
fn fitted_camera(at: &SVector<f64, 4>) -> SheetCamera {
    SheetCamera {
        log_scale: at[0],
        centre: [at[1], at[2]],
    }
}

/// Number of rows of a grid of `cols` columns with about square cells on a page of height over width `ratio`.
pub(super) fn grid_rows(cols: usize, ratio: f64) -> usize {
    ((((cols - 1) as f64 * ratio).round() as usize).max(2) + 1).min(4 * cols)
}
