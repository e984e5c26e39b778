//! A page in space: a cylinder over a curve, seen by a pinhole camera.

use nalgebra::{Matrix3, Rotation3, Vector3};

/// Pieces that each page's curve is integrated over.
pub(super) const PIECES: usize = 96;

/// Half the step of central differences by a cylinder's parameters and by places on the page, which are of order 1.
/// About the cube root of the rounding error, where truncation and rounding are equally small.
pub(super) const DIFFERENCE_STEP: f64 = 1e-5;

/// One page, or several that share rulings, side by side. Lengths are in widths of the first one.
#[derive(Debug, Clone)]
pub(super) struct Cylinder {
    /// Focal length, in pixels.
    pub focal: f64,
    /// Principal point, in pixels.
    pub centre: [f64; 2],
    /// Columns: the curve's two axes, and the rulings' direction from the first edge to the second.
    pub axes: Matrix3<f64>,
    /// Where the first edge starts, from the camera: x to the right, y down, z ahead.
    pub origin: Vector3<f64>,
    /// Length of the rulings.
    pub length: f64,
    /// Each page.
    pub pages: Vec<Strip>,
    /// By how much the print is turned on each page, in radians, where lines of text tell; else none.
    pub skews: Vec<f64>,
}

/// One page's part of the curve.
#[derive(Debug, Clone)]
pub(super) struct Strip {
    /// Its arc length.
    pub width: f64,
    /// Its direction in the curve's plane, in radians, as coefficients of the Legendre polynomials
    /// over the page's arc length. The first page's mean is 0: it is in the axes.
    pub turns: Vec<f64>,
}

/// The curve itself, in its plane.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    /// For each page its nodes: place and direction.
    nodes: Vec<Vec<([f64; 2], [f64; 2])>>,
    widths: Vec<f64>,
}

impl Cylinder {
    /// How many numbers describe it, but for the principal point.
    pub fn parameters(&self) -> usize {
        8 + self
            .pages
            .iter()
            .map(|page| page.turns.len() + 1)
            .sum::<usize>()
            - 2
            + self.skews.len()
    }

    /// Degree of the polynomials.
    pub fn degree(&self) -> usize {
        self.pages[0].turns.len() - 1
    }

    /// The same with a longer or shorter series.
    pub fn with_degree(mut self, degree: usize) -> Self {
        for page in &mut self.pages {
            page.turns.resize(degree + 1, 0.0);
        }
        self
    }

    /// Each parameter changed a little, in the order: logarithm of the focal length, rotation
    /// about the page's middle (3), place (3), logarithm of the length, and for each page the
    /// logarithm of its width and its coefficients, but for the first page's width and mean; the
    /// skews come last.
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

    fn middle(&self) -> Vector3<f64> {
        let width: f64 = self.pages.iter().map(|page| page.width).sum();
        self.origin + self.axes * Vector3::new(width / 2.0, 0.0, self.length / 2.0)
    }

    /// Integrates the curve, by Simpson's rule.
    pub fn curve(&self) -> Curve {
        let mut place = [0.0; 2];
        let mut nodes = Vec::with_capacity(self.pages.len());
        for page in &self.pages {
            let step = page.width / PIECES as f64;
            let direction = |at: f64| {
                let (sin, cos) = series(&page.turns, at).sin_cos();
                [cos, sin]
            };
            let mut here = direction(0.0);
            let mut own = Vec::with_capacity(PIECES + 1);
            own.push((place, here));
            for i in 0..PIECES {
                let between = direction((i as f64 + 0.5) / PIECES as f64);
                let next = direction((i + 1) as f64 / PIECES as f64);
                for k in 0..2 {
                    place[k] += step / 6.0 * (here[k] + 4.0 * between[k] + next[k]);
                }
                here = next;
                own.push((place, here));
            }
            nodes.push(own);
        }
        Curve {
            nodes,
            widths: self.pages.iter().map(|page| page.width).collect(),
        }
    }

    /// The point in space over a point of the curve, `down` along its ruling.
    pub fn point(&self, [x, y]: [f64; 2], down: f64) -> Vector3<f64> {
        self.origin + self.axes * Vector3::new(x, y, down)
    }

    /// Where that is seen, in pixels; nowhere if it is not in front of the camera.
    pub fn seen(&self, on: [f64; 2], down: f64) -> Option<[f64; 2]> {
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
    /// Where on a page a pixel lies: along its curve, and down its ruling. Beyond the page's sides the
    /// curve goes on straight.
    pub fn place(&self, curve: &Curve, page: usize, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
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
        let [first, last] = [at(0), at(PIECES)];
        let (along, on) = if (first > 0.0) != (last > 0.0) {
            let (mut low, mut high) = (0, PIECES);
            while high - low > 1 {
                let middle = (low + high) / 2;
                if (at(middle) > 0.0) == (first > 0.0) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let share = |piece: f64| (low as f64 + piece) / PIECES as f64;
            let (mut from, mut to) = ((0.0, at(low)), (1.0, at(high)));
            // Three steps of the secant are exact to rounding, for a piece is nearly straight.
            let mut piece = 0.5;
            for _ in 0..3 {
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
                false => (PIECES, last),
            };
            let (_, way) = curve.nodes[page][end];
            let change = sight.x * way[1] - sight.y * way[0];
            let width = self.pages[page].width;
            let along = end as f64 / PIECES as f64 * width - here / change;
            (along, curve.straight(page, along / width))
        };
        let off = [on[0] - camera.x, on[1] - camera.y];
        let reach = (off[0] * sight.x + off[1] * sight.y) / (sight.x.powi(2) + sight.y.powi(2));
        let found = [along, camera.z + reach * sight.z];
        found.iter().all(|v| v.is_finite()).then_some(found)
    }

    /// By how much the direction changes at most along the curve of a page, in radians.
    pub fn bend(&self) -> f64 {
        let page = |page: &Strip| {
            let turns = (0..=PIECES).map(|i| series(&page.turns, i as f64 / PIECES as f64));
            let (low, high) = turns
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), turn| {
                    (low.min(turn), high.max(turn))
                });
            high - low
        };
        self.pages.iter().map(page).fold(0.0, f64::max)
    }

    /// Whether a part of it is seen from the other side than the rest.
    pub fn hides_itself(&self) -> bool {
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

impl Curve {
    /// The place at a share of one page's width.
    pub fn at(&self, page: usize, share: f64) -> [f64; 2] {
        let scaled = share.clamp(0.0, 1.0) * PIECES as f64;
        let piece = (scaled as usize).min(PIECES - 1);
        let x = scaled - piece as f64;
        let [(p, d), (q, e)] = [self.nodes[page][piece], self.nodes[page][piece + 1]];
        let step = self.widths[page] / PIECES as f64;
        // Cubic Hermite: the directions are known.
        let (x2, x3) = (x * x, x * x * x);
        [0, 1].map(|k| {
            p[k] * (1.0 - 3.0 * x2 + 2.0 * x3)
                + q[k] * (3.0 * x2 - 2.0 * x3)
                + step * (d[k] * (x - 2.0 * x2 + x3) + e[k] * (x3 - x2))
        })
    }

    /// The same, and beyond the page's sides straight on.
    pub fn straight(&self, page: usize, share: f64) -> [f64; 2] {
        let end = if share < 0.0 { 0 } else { PIECES };
        let beyond = if share < 0.0 {
            share
        } else {
            (share - 1.0).max(0.0)
        };
        let way = self.nodes[page][end].1;
        let on = self.at(page, share);
        [0, 1].map(|k| on[k] + beyond * self.widths[page] * way[k])
    }

    /// The place at a node.
    pub fn node(&self, page: usize, node: usize) -> [f64; 2] {
        self.nodes[page][node].0
    }
}

/// Sum of Legendre polynomials over the unit interval (Clenshaw).
fn series(coefficients: &[f64], at: f64) -> f64 {
    let x = 2.0 * at - 1.0;
    let (mut b1, mut b2) = (0.0, 0.0);
    for (k, c) in coefficients.iter().enumerate().rev() {
        let k = k as f64;
        let b = c + (2.0 * k + 1.0) / (k + 1.0) * x * b1 - (k + 1.0) / (k + 2.0) * b2;
        (b2, b1) = (b1, b);
    }
    b1
}

/// The Legendre polynomials up to a degree, at a place of the unit interval.
pub(super) fn legendre(degree: usize, at: f64) -> Vec<f64> {
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
            for (found, known) in legendre(3, at).into_iter().zip(known) {
                assert!((found - known).abs() < 1e-14);
            }
            let sum = 0.3 * known[0] - 2.0 * known[1] + 0.7 * known[2] + 0.1 * known[3];
            assert!((series(&[0.3, -2.0, 0.7, 0.1], at) - sum).abs() < 1e-14);
        }
    }

    #[test]
    fn a_place_is_where_it_is_seen() {
        let page = |turns: &[f64]| Strip {
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
            let seen = cylinder.seen(curve.at(number, share), down).unwrap();
            let [along, found] = cylinder.place(&curve, number, seen).unwrap();
            assert!((along - share).abs() < 1e-7 && (found - down).abs() < 1e-7);
        }
        // Beyond its end the curve is a straight line.
        let (from, way) = curve.nodes[1][PIECES];
        let beyond = [0, 1].map(|k| from[k] + 0.1 * way[k]);
        let seen = cylinder.seen(beyond, 0.5).unwrap();
        let [along, down] = cylinder.place(&curve, 1, seen).unwrap();
        assert!(
            (along - 1.1).abs() < 1e-9 && (down - 0.5).abs() < 1e-9,
            "{along} {down}"
        );
    }

    #[test]
    fn a_constant_turn_is_an_arc() {
        let page = Strip {
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
