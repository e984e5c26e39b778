//! A curled page in space: a cylinder over a planar curve, seen by a pinhole camera.

use nalgebra::{Matrix3, Rotation3, Vector3};

/// Number of pieces into which each page's curve is divided for integrating its direction.
pub(super) const CURVE_PIECES: usize = 96;

/// Number of secant steps by which the intersection of a line of sight with a piece of the page's curve is found; a
/// piece is nearly straight, so that this many are exact to rounding.
const SECANT_STEPS: usize = 3;

/// Half the step of central differences, by the parameters of a page's cylinder and by positions on the page, which are
/// of order 1. About the cube root of the rounding error, where truncation and rounding are equally small.
pub(super) const DIFFERENCE_STEP: f64 = 1e-5;

/// A page, or the two of a spread, as a cylinder seen by a pinhole camera. Lengths are in widths of the first page.
#[derive(Debug, Clone)]
pub(super) struct Cylinder {
    /// Focal length of the camera, in pixels.
    pub focal: f64,
    /// Principal point of the camera, in pixels of the photo.
    pub centre: [f64; 2],
    /// Rotation from the cylinder's axes to the camera's. Its columns are the two axes of the curve's plane and the
    /// direction of the rulings, from the first edge to the second.
    pub axes: Matrix3<f64>,
    /// Position of the first edge's start in the camera's axes: x to the right, y down, z ahead.
    pub origin: Vector3<f64>,
    /// Length of the rulings, in widths of the first page.
    pub length: f64,
    /// Each page's curve across the rulings: the cylinder's cross-section.
    pub pages: Vec<CurveSeries>,
    /// Angle by which the print is rotated on each page, in radians; empty if there are no lines of text.
    pub skews: Vec<f64>,
}

/// The curve of one page, by its direction as a Legendre series over the arc length.
#[derive(Debug, Clone)]
pub(super) struct CurveSeries {
    /// Arc length of the page's curve, that is the width of the flat page.
    pub width: f64,
    /// Coefficients, in radians, of the Legendre polynomials over the arc length whose sum is the curve's direction in
    /// its plane. The first coefficient of the first page is 0: its mean direction is in [`Cylinder::axes`].
    pub turns: Vec<f64>,
}

/// Curve of all pages, sampled at nodes of equal arc length in the curve's plane.
#[derive(Debug, Clone)]
pub(super) struct SampledCurve {
    /// Position and unit tangent of the curve at each node of each page.
    nodes: Vec<Vec<([f64; 2], [f64; 2])>>,
    widths: Vec<f64>,
}

impl Cylinder {
    /// Number of unknowns of the cylinder's least-squares problem, without the principal point.
    pub fn parameters(&self) -> usize {
        8 + self
            .pages
            .iter()
            .map(|page| page.turns.len() + 1)
            .sum::<usize>()
            - 2
            + self.skews.len()
    }

    /// Degree of the Legendre series that describes the direction of a page's curve.
    pub fn degree(&self) -> usize {
        self.pages[0].turns.len() - 1
    }

    /// Returns this cylinder with another degree of the curve's Legendre series; added coefficients are 0.
    pub fn with_degree(mut self, degree: usize) -> Self {
        for page in &mut self.pages {
            page.turns.resize(degree + 1, 0.0);
        }
        self
    }

    /// Returns this cylinder with its parameters changed by `step`. The parameters' order is: logarithm of the focal
    /// length, rotation about the page's middle (3), translation (3), logarithm of the length, and for each page the
    /// logarithm of its width and its Legendre coefficients, but for the first page's width and mean direction; the
    /// rotations of the print come last.
    pub fn moved(&self, step: &[f64]) -> Self {
        let mut moved = self.clone();
        moved.focal *= step[0].exp();
        let turn = Rotation3::new(Vector3::new(step[1], step[2], step[3])).into_inner();
        let middle = self.middle();
        moved.axes = turn * self.axes;
        moved.origin =
            middle + turn * (self.origin - middle) + Vector3::new(step[4], step[5], step[6]);
        moved.length *= step[7].exp();
        let mut rest = step[8..].iter();
        let mut next = || rest.next().copied().unwrap_or(0.0);
        for (number, page) in moved.pages.iter_mut().enumerate() {
            if number > 0 {
                page.width *= next().exp();
                page.turns[0] += next();
            }
            for coefficient in &mut page.turns[1..] {
                *coefficient += next();
            }
        }
        for skew in &mut moved.skews {
            *skew += next();
        }
        moved
    }

    /// Point in space about which steps of the fit rotate the cylinder: the middle of a flat page with the same start,
    /// width and length.
    fn middle(&self) -> Vector3<f64> {
        let width: f64 = self.pages.iter().map(|page| page.width).sum();
        self.origin + self.axes * Vector3::new(width / 2.0, 0.0, self.length / 2.0)
    }

    /// Integrates the direction of the pages' curve to positions, by Simpson's rule.
    pub fn curve(&self) -> SampledCurve {
        let mut place = [0.0; 2];
        let mut nodes = Vec::with_capacity(self.pages.len());
        for page in &self.pages {
            let step = page.width / CURVE_PIECES as f64;
            let direction = |at: f64| {
                let (sin, cos) = legendre_sum(&page.turns, at).sin_cos();
                [cos, sin]
            };
            let mut here = direction(0.0);
            let mut own = Vec::with_capacity(CURVE_PIECES + 1);
            own.push((place, here));
            for i in 0..CURVE_PIECES {
                let between = direction((i as f64 + 0.5) / CURVE_PIECES as f64);
                let next = direction((i + 1) as f64 / CURVE_PIECES as f64);
                for k in 0..2 {
                    place[k] += step / 6.0 * (here[k] + 4.0 * between[k] + next[k]);
                }
                here = next;
                own.push((place, here));
            }
            nodes.push(own);
        }
        SampledCurve {
            nodes,
            widths: self.pages.iter().map(|page| page.width).collect(),
        }
    }

    /// Returns the point in space, in the camera's axes, on the ruling through point `(x, y)` of the curve, at a
    /// distance `down` along the ruling.
    pub fn point(&self, [x, y]: [f64; 2], down: f64) -> Vector3<f64> {
        self.origin + self.axes * Vector3::new(x, y, down)
    }

    /// Projects the point on the ruling through point `on` of the curve, at a distance `down` along the ruling, to
    /// pixels of the photo. None unless the point is in front of the camera.
    pub fn project(&self, on: [f64; 2], down: f64) -> Option<[f64; 2]> {
        let point = self.point(on, down);
        (point.z > 1e-9).then(|| {
            [
                self.centre[0] + self.focal * point.x / point.z,
                self.centre[1] + self.focal * point.y / point.z,
            ]
        })
    }
}

impl Cylinder {
    /// Back-projects a pixel to a page: returns the distances from the page's left edge along its curve and from its upper
    /// edge down its ruling, in the cylinder's unit of length. Beyond the page's sides the curve is extended straight.
    pub fn back_project(
        &self,
        curve: &SampledCurve,
        page: usize,
        [x, y]: [f64; 2],
    ) -> Option<[f64; 2]> {
        let focal = self.focal;
        let sight = Vector3::new(
            (x - self.centre[0]) / focal,
            (y - self.centre[1]) / focal,
            1.0,
        );
        // The camera and the sight in the cylinder's own axes.
        let (camera, sight) = (self.axes.tr_mul(&-self.origin), self.axes.tr_mul(&sight));
        let beside = |[u, v]: [f64; 2]| sight.x * (v - camera.y) - sight.y * (u - camera.x);
        let at = |node: usize| beside(curve.node(page, node));
        let [first, last] = [at(0), at(CURVE_PIECES)];
        let (along, on) = if (first > 0.0) != (last > 0.0) {
            let (mut low, mut high) = (0, CURVE_PIECES);
            while high - low > 1 {
                let middle = (low + high) / 2;
                if (at(middle) > 0.0) == (first > 0.0) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let share = |piece: f64| (low as f64 + piece) / CURVE_PIECES as f64;
            let (mut from, mut to) = ((0.0, at(low)), (1.0, at(high)));
            let mut piece = 0.5;
            for _ in 0..SECANT_STEPS {
                if from.1 == to.1 {
                    break;
                }
                piece = (from.0 - from.1 * (to.0 - from.0) / (to.1 - from.1)).clamp(0.0, 1.0);
                (from, to) = (to, (piece, beside(curve.at(page, share(piece)))));
            }
            let share = share(piece);
            (share * self.pages[page].width, curve.at(page, share))
        } else {
            let (end, here) = match first.abs() < last.abs() {
                true => (0, first),
                false => (CURVE_PIECES, last),
            };
            let (_, way) = curve.nodes[page][end];
            let change = sight.x * way[1] - sight.y * way[0];
            let width = self.pages[page].width;
            let along = end as f64 / CURVE_PIECES as f64 * width - here / change;
            (along, curve.at_extended(page, along / width))
        };
        let off = [on[0] - camera.x, on[1] - camera.y];
        let reach = (off[0] * sight.x + off[1] * sight.y) / (sight.x.powi(2) + sight.y.powi(2));
        let found = [along, camera.z + reach * sight.z];
        found.iter().all(|v| v.is_finite()).then_some(found)
    }

    /// Angle by which the curve's tangent turns over a page (largest minus smallest direction), in radians; the maximum
    /// over all pages.
    pub fn bend(&self) -> f64 {
        let page = |page: &CurveSeries| {
            let turns = (0..=CURVE_PIECES)
                .map(|i| legendre_sum(&page.turns, i as f64 / CURVE_PIECES as f64));
            let (low, high) = turns
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), turn| {
                    (low.min(turn), high.max(turn))
                });
            high - low
        };
        self.pages.iter().map(page).fold(0.0, f64::max)
    }

    /// Whether the camera sees a part of the page from behind, so that this part hides another one.
    pub fn has_hidden_part(&self) -> bool {
        let curve = self.curve();
        let mut seen = [false; 2];
        for nodes in &curve.nodes {
            for (place, direction) in nodes {
                let normal = self.axes * Vector3::new(-direction[1], direction[0], 0.0);
                // The same all along a ruling, for it lies in the tangent plane.
                let facing = normal.dot(&self.point(*place, 0.0));
                seen[usize::from(facing > 0.0)] = true;
            }
        }
        seen == [true; 2]
    }
}

impl SampledCurve {
    /// Position of a point of one page's curve, in the curve's plane, at a share of the page's width from 0 to 1, by
    /// cubic Hermite interpolation.
    pub fn at(&self, page: usize, share: f64) -> [f64; 2] {
        let scaled = share.clamp(0.0, 1.0) * CURVE_PIECES as f64;
        let piece = (scaled as usize).min(CURVE_PIECES - 1);
        let x = scaled - piece as f64;
        let [(p, d), (q, e)] = [self.nodes[page][piece], self.nodes[page][piece + 1]];
        let step = self.widths[page] / CURVE_PIECES as f64;
        let (x2, x3) = (x * x, x * x * x);
        [0, 1].map(|k| {
            p[k] * (1.0 - 3.0 * x2 + 2.0 * x3)
                + q[k] * (3.0 * x2 - 2.0 * x3)
                + step * (d[k] * (x - 2.0 * x2 + x3) + e[k] * (x3 - x2))
        })
    }

    /// Position of a point of one page's curve, in the curve's plane, at a share of the page's width; below 0 and above
    /// 1 the curve is extended straight.
    pub fn at_extended(&self, page: usize, share: f64) -> [f64; 2] {
        let end = if share < 0.0 { 0 } else { CURVE_PIECES };
        let beyond = if share < 0.0 {
            share
        } else {
            (share - 1.0).max(0.0)
        };
        let way = self.nodes[page][end].1;
        let on = self.at(page, share);
        [0, 1].map(|k| on[k] + beyond * self.widths[page] * way[k])
    }

    /// Position of a node of one page's curve, in the curve's plane.
    pub fn node(&self, page: usize, node: usize) -> [f64; 2] {
        self.nodes[page][node].0
    }
}

/// Evaluates a series of Legendre polynomials, scaled to the interval from 0 to 1, at a place `at` in it (Clenshaw's
/// recurrence).
fn legendre_sum(coefficients: &[f64], at: f64) -> f64 {
    let x = 2.0 * at - 1.0;
    let (mut b1, mut b2) = (0.0, 0.0);
    for (k, c) in coefficients.iter().enumerate().rev() {
        let k = k as f64;
        let b = c + (2.0 * k + 1.0) / (k + 1.0) * x * b1 - (k + 1.0) / (k + 2.0) * b2;
        (b2, b1) = (b1, b);
    }
    b1
}

/// Evaluates the Legendre polynomials of degrees 0 to `degree`, scaled to the interval from 0 to 1, at a place `at` in
/// it.
pub(super) fn legendre_values(degree: usize, at: f64) -> Vec<f64> {
    let x = 2.0 * at - 1.0;
    let mut values = vec![1.0];
    for k in 0..degree {
        let before = if k > 0 { values[k - 1] } else { 0.0 };
        let k_ = k as f64;
        values.push(((2.0 * k_ + 1.0) * x * values[k] - k_ * before) / (k_ + 1.0));
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_is_that_of_legendre_polynomials() {
        for at in [0.0, 0.2, 0.5, 0.9, 1.0] {
            let x: f64 = 2.0 * at - 1.0;
            let known = [1.0, x, 1.5 * x * x - 0.5, 2.5 * x.powi(3) - 1.5 * x];
            for (found, known) in legendre_values(3, at).into_iter().zip(known) {
                assert!((found - known).abs() < 1e-14);
            }
            let sum = 0.3 * known[0] - 2.0 * known[1] + 0.7 * known[2] + 0.1 * known[3];
            assert!((legendre_sum(&[0.3, -2.0, 0.7, 0.1], at) - sum).abs() < 1e-14);
        }
    }

    #[test]
    fn a_place_is_where_it_is_seen() {
        let page = |turns: &[f64]| CurveSeries {
            width: 1.0,
            turns: turns.to_vec(),
        };
        let cylinder = Cylinder {
            focal: 2000.0,
            centre: [900.0, 700.0],
            axes: Rotation3::from_euler_angles(0.3, -0.2, 0.1).into_inner()
                * Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0),
            origin: Vector3::new(-0.5, -0.6, 2.0),
            length: 1.4,
            pages: vec![page(&[0.0, 0.4, -0.3]), page(&[0.2, -0.3])],
            skews: Vec::new(),
        };
        let curve = cylinder.curve();
        for (number, share, down) in [(0, 0.0, 0.2), (0, 0.37, 1.4), (1, 0.71, 0.6), (1, 1.0, 0.0)]
        {
            let seen = cylinder.project(curve.at(number, share), down).unwrap();
            let [along, found] = cylinder.back_project(&curve, number, seen).unwrap();
            assert!((along - share).abs() < 1e-7 && (found - down).abs() < 1e-7);
        }
        // Beyond its end the curve is a straight line.
        let (from, way) = curve.nodes[1][CURVE_PIECES];
        let beyond = [0, 1].map(|k| from[k] + 0.1 * way[k]);
        let seen = cylinder.project(beyond, 0.5).unwrap();
        let [along, down] = cylinder.back_project(&curve, 1, seen).unwrap();
        assert!(
            (along - 1.1).abs() < 1e-9 && (down - 0.5).abs() < 1e-9,
            "{along} {down}"
        );
    }

    #[test]
    fn a_constant_turn_is_an_arc() {
        let page = CurveSeries {
            width: 2.0,
            turns: vec![0.0, 0.6],
        };
        let arc = Cylinder {
            focal: 1.0,
            centre: [0.0; 2],
            axes: Matrix3::identity(),
            origin: Vector3::zeros(),
            length: 1.0,
            pages: vec![page],
            skews: Vec::new(),
        };
        // From −0.6 to 0.6 rad over a length of 2: a radius of 1/0.6.
        let (curve, radius) = (arc.curve(), 1.0 / 0.6f64);
        for share in [0.0f64, 0.123, 0.5, 0.77, 1.0] {
            let angle = -0.6 + 1.2 * share;
            let known = [
                radius * (angle.sin() + 0.6f64.sin()),
                radius * (0.6f64.cos() - angle.cos()),
            ];
            let found = curve.at(0, share);
            assert!(
                (0..2).all(|k| (found[k] - known[k]).abs() < 1e-8),
                "{found:?} {known:?}"
            );
        }
    }
}
