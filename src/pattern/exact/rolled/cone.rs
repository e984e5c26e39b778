//! Circular cones and cylinders: the one nearest to points, and how they are laid flat.

use super::surface::Surface;
use crate::math::least_squares::LeastSquares;
use crate::math::planar::Point2;
use crate::math::symmetric_eigen::symmetric_eigen3;
use crate::scene::polyhedron::Place;

/// Number of steps in which a cylinder is found by Gauss and Newton. `benches/patterns.md` has what others give.
const MAX_FIT_STEPS: usize = 12;

/// The direction along which normals, as long as their weights, are alike: across which they differ least from the usual one.
pub(super) fn least_normal(normals: &[Place], usual: Place) -> Place {
    let spread = normals.iter().map(|n| {
        let size = n.norm();
        let off = n / size.max(f64::MIN_POSITIVE) - usual;
        off * off.transpose() * size
    });
    let [.., (_, along)] = symmetric_eigen3(spread.sum());
    along
}

/// A circular cone, or a cylinder: a point of its axis, the direction of the axis and two across, all right-handed, the radius at the
/// point, and how much the radius grows along the axis: 0 for a cylinder.
pub(super) struct Cone {
    centre: Place,
    across: [Place; 2],
    along: Place,
    radius: f64,
    slope: f64,
}

impl Surface for Cone {
    fn radius(&self) -> f64 {
        self.radius
    }

    fn coordinates(&self, place: &Place) -> [f64; 3] {
        let [x, y, high] = self.upright(place);
        [y.atan2(x), high, self.beyond([x, y, high])]
    }

    fn angle(&self, direction: &Place) -> f64 {
        let [x, y] = self.across.map(|axis| axis.dot(direction));
        y.atan2(x)
    }

    fn normal(&self, angle: f64) -> Place {
        (self.outward(angle) - self.along * self.slope) / self.slope.hypot(1.0)
    }

    fn ruling(&self, angle: f64) -> Place {
        (self.along + self.outward(angle) * self.slope) / self.slope.hypot(1.0)
    }

    fn place(&self, [angle, high]: [f64; 2]) -> Place {
        let out = self.outward(angle) * (self.radius + self.slope * high);
        self.centre + out + self.along * high
    }

    fn is_tip(&self, place: &Place, near: f64) -> bool {
        let [_, high, _] = self.coordinates(place);
        self.slope != 0.0 && (self.radius + self.slope * high).abs() <= near
    }

    fn flat(&self, [angle, high]: [f64; 2]) -> Point2 {
        if self.slope == 0.0 {
            return Point2::new(self.radius * angle, high);
        }
        let long = self.slope.hypot(1.0);
        let (tip, turned) = (self.radius / self.slope * long, angle * self.slope / long);
        let (sin, cos) = turned.sin_cos();
        let from = tip + high * long;
        Point2::new(from * sin, high * long - from * (1.0 - cos))
    }

    fn rolled(&self, touch: f64, from: Place) -> [f64; 2] {
        let aside = self.along.cross(&self.outward(touch)).dot(&from);
        if self.slope == 0.0 {
            return [touch + aside / self.radius, self.along.dot(&from)];
        }
        let long = self.slope.hypot(1.0);
        let tip = self.radius / self.slope * long;
        let ahead = tip + self.ruling(touch).dot(&from);
        let turned = (aside / ahead).atan() * long / self.slope;
        let away = aside.hypot(ahead) * tip.signum();
        [touch + turned, (away - tip) / long]
    }

    fn crossing(&self, line: f64, [from, to]: [[f64; 2]; 2]) -> f64 {
        let [p, q] = [from, to].map(|[angle, high]| self.flat([angle - line, high]));
        let at = p + (q - p) * (p.re / (p.re - q.re));
        at.im / self.slope.hypot(1.0)
    }

    fn edges(&self) -> Option<&[f64]> {
        None
    }
}

impl Cone {
    /// Coordinates of a place across and along the axis.
    fn upright(&self, place: &Place) -> [f64; 3] {
        let off = place - self.centre;
        let [first, second] = self.across;
        [first, second, self.along].map(|axis| axis.dot(&off))
    }

    /// How far a place is off the surface, outwards.
    pub(super) fn off(&self, place: &Place) -> f64 {
        self.beyond(self.upright(place))
    }

    fn beyond(&self, [x, y, high]: [f64; 3]) -> f64 {
        let beyond = (x * x + y * y).sqrt() - self.radius - self.slope * high;
        beyond / (1.0 + self.slope * self.slope).sqrt()
    }

    /// Unit vector at an angle, away from the axis.
    fn outward(&self, angle: f64) -> Place {
        self.across[0] * angle.cos() + self.across[1] * angle.sin()
    }

    /// The cone or cylinder nearest to points with weights, whose triangles have these normals, as long as their areas.
    pub(super) fn fit(
        points: &[(Place, f64)],
        normals: &[Place],
        is_conical: bool,
    ) -> Option<Cone> {
        let all: f64 = normals.iter().map(|n| n.norm()).sum();
        let usual = match is_conical {
            true => normals.iter().sum::<Place>() / all,
            false => Place::zeros(),
        };
        let mut along = least_normal(normals, usual);
        let weight: f64 = points.iter().map(|(_, weight)| weight).sum();
        let mean = points.iter().map(|(p, weight)| p * *weight).sum::<Place>() / weight;
        let extent = (points.iter()).fold(0.0, |most: f64, (p, _)| most.max((p - mean).norm()));
        let mut found: Option<Cone> = None;
        for _ in 0..MAX_FIT_STEPS {
            let first = along.cross(&Place::ith(along.iamin(), 1.0)).normalize();
            let across = [first, along.cross(&first)];
            let mut is_near = false;
            let (centre, radius, tilt, slope) = match &found {
                None => {
                    // The circle x² + y² = 2 (a x + b y) + c, of a cone the one in the middle.
                    let mut circle = LeastSquares::<3>::new();
                    for (p, weight) in points {
                        let [x, y] = across.map(|axis| axis.dot(&(p - mean)));
                        circle.add(&[2.0 * x, 2.0 * y, 1.0].into(), [x * x + y * y], *weight);
                    }
                    let [a, b, c]: [f64; 3] = circle.solve()?.into();
                    ([a, b], (c + a * a + b * b).max(0.0).sqrt(), [0.0; 2], 0.0)
                }
                Some(last) => {
                    // The slope of a cylinder stays 0.
                    let held = if is_conical { 0.0 } else { 1.0 };
                    let mut step = LeastSquares::<6>::with_ridge([0.0, 0.0, 0.0, 0.0, 0.0, held]);
                    for (p, weight) in points {
                        let off = p - last.centre;
                        let [x, y] = across.map(|axis| axis.dot(&off));
                        let (far, high) = ((x * x + y * y).sqrt(), along.dot(&(p - mean)));
                        if far == 0.0 {
                            continue;
                        }
                        let [u, v] = [x / far, y / far];
                        let tilt = [u * high + last.slope * x, v * high + last.slope * y];
                        let wide = (1.0 - held) * high;
                        let row = [u, v, 1.0, tilt[0], tilt[1], wide];
                        step.add(
                            &row.into(),
                            [far - last.radius - last.slope * high],
                            *weight,
                        );
                    }
                    let [a, b, r, s, t, k]: [f64; 6] = step.solve()?.into();
                    // The next step is below rounding.
                    let moved =
                        a.abs() + b.abs() + r.abs() + extent * (s.abs() + t.abs() + k.abs());
                    is_near = moved <= f64::EPSILON.sqrt() * extent;
                    let [x, y] = across.map(|axis| axis.dot(&(last.centre - mean)));
                    ([x + a, y + b], last.radius + r, [s, t], last.slope + k)
                }
            };
            let place = mean + across[0] * centre[0] + across[1] * centre[1];
            along = (along + across[0] * tilt[0] + across[1] * tilt[1]).normalize();
            // Angles are counted from the middle of the points.
            let out = mean - place;
            let first = (out - along * along.dot(&out)).normalize();
            found = Some(Cone {
                centre: place,
                across: [first, along.cross(&first)],
                along,
                radius,
                slope,
            });
            if is_near {
                break;
            }
        }
        found.filter(|found| {
            found.radius.is_finite() && found.slope.is_finite() && found.along.norm() > 0.5
        })
    }
}
