//! Bent pages of which every point's place is known: an A-sized page of width 1, seen from above.

/// Height of a page over its width.
pub const HEIGHT: f64 = std::f64::consts::SQRT_2;

/// A point of the page, from its lower left corner, or one of the plan it is seen in.
pub type Point = [f64; 2];

/// An isometry of the page to a heightfield.
pub trait Page {
    /// Where a point of the page is seen.
    fn seen(&self, on_page: Point) -> Point;
    /// What point of the page's plane is seen there.
    fn on_page(&self, seen: Point) -> Point;
    /// How high it is there.
    fn height(&self, seen: Point) -> f64;
}

/// The pages that are measured, by name.
pub fn all() -> Vec<(&'static str, Box<dyn Page>)> {
    let curl = |p: f64| 0.75 * (3.2 * p + 0.4).sin();
    let fold = |p: f64| match p / HEIGHT {
        ..0.34 => 0.42,
        ..0.67 => -0.36,
        _ => 0.3,
    };
    vec![
        ("curled", Box::new(Profile::new(8f64.to_radians(), curl))),
        ("folded", Box::new(Profile::new(86f64.to_radians(), fold))),
        ("crumpled", Box::new(Crumpled::new(0.55))),
    ]
}

/// Bent in one direction only: the slope is a function of the length along it.
struct Profile {
    /// Cosine and sine of that direction.
    turn: [f64; 2],
    /// Horizontal length and height at every `STEP` of the length, from `START` on.
    places: Vec<[f64; 2]>,
}

const START: f64 = -0.5;
const STEP: f64 = 1e-4;

impl Profile {
    /// `slope` is the angle to the horizontal.
    fn new(direction: f64, slope: impl Fn(f64) -> f64) -> Self {
        let mut at = [START, 0.0];
        let places = (0..30_000)
            .map(|i| {
                let here = at;
                let (sin, cos) = slope(START + (f64::from(i) + 0.5) * STEP).sin_cos();
                at = [at[0] + STEP * cos, at[1] + STEP * sin];
                here
            })
            .collect();
        Profile {
            turn: [direction.cos(), direction.sin()],
            places,
        }
    }

    fn turned(&self, [x, y]: Point) -> Point {
        let [cos, sin] = self.turn;
        [cos * x + sin * y, cos * y - sin * x]
    }

    fn back(&self, [p, q]: Point) -> Point {
        let [cos, sin] = self.turn;
        [cos * p - sin * q, sin * p + cos * q]
    }

    /// Length and height at a horizontal length.
    fn at(&self, horizontal: f64) -> [f64; 2] {
        let after = self.places.partition_point(|place| place[0] <= horizontal);
        let i = after.clamp(1, self.places.len() - 1) - 1;
        let ([x0, z0], [x1, z1]) = (self.places[i], self.places[i + 1]);
        let t = (horizontal - x0) / (x1 - x0);
        [START + (i as f64 + t) * STEP, z0 + t * (z1 - z0)]
    }
}

impl Page for Profile {
    fn seen(&self, on_page: Point) -> Point {
        let [p, q] = self.turned(on_page);
        let step = (p - START) / STEP;
        let i = (step as usize).min(self.places.len() - 2);
        let (x0, x1) = (self.places[i][0], self.places[i + 1][0]);
        self.back([x0 + (step - i as f64) * (x1 - x0), q])
    }

    fn on_page(&self, seen: Point) -> Point {
        let [x, q] = self.turned(seen);
        self.back([self.at(x)[0], q])
    }

    fn height(&self, seen: Point) -> f64 {
        self.at(self.turned(seen)[0])[1]
    }
}

/// Crumpled into facets, without stretch: Miura's fold of parallelograms, partly folded
/// (M. Schenk, S. D. Guest, *Geometry of Miura-folded metamaterials*, PNAS 110(9), 2013, Eqs. 1–4).
struct Crumpled {
    /// Of a facet when flat: across, along, and how far its sides are offset.
    flat: [f64; 3],
    /// The same as seen from above, when folded.
    folded: [f64; 3],
    /// Height of the ridges.
    ridge: f64,
}

impl Crumpled {
    /// `fold` is the angle of the facets to the plane, 0 when flat.
    fn new(fold: f64) -> Self {
        let (a, b, corner) = (0.31f64, 0.37f64, 1.25f64);
        let spread = (1.0 + (fold.cos() * corner.tan()).powi(2)).sqrt();
        Crumpled {
            flat: [b * corner.sin(), a, b * corner.cos()],
            folded: [
                b * fold.cos() * corner.tan() / spread,
                a * (1.0 - (fold.sin() * corner.sin()).powi(2)).sqrt(),
                b / spread,
            ],
            ridge: a * fold.sin() * corner.sin(),
        }
    }

    /// From one state to another; and how many facets along.
    fn carried(from: [f64; 3], to: [f64; 3], [x, y]: Point) -> (Point, f64) {
        let across = x / from[0];
        let along = (y - from[2] * zigzag(across)) / from[1];
        (
            [across * to[0], along * to[1] + to[2] * zigzag(across)],
            along,
        )
    }
}

impl Page for Crumpled {
    fn seen(&self, on_page: Point) -> Point {
        Crumpled::carried(self.flat, self.folded, on_page).0
    }

    fn on_page(&self, seen: Point) -> Point {
        Crumpled::carried(self.folded, self.flat, seen).0
    }

    fn height(&self, seen: Point) -> f64 {
        self.ridge * zigzag(Crumpled::carried(self.folded, self.flat, seen).1)
    }
}

/// Distance to the nearest even number.
fn zigzag(t: f64) -> f64 {
    (t - 2.0 * (0.5 * t).round()).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Short lengths on the page are those on the surface, away from folds, and places go back and forth.
    #[test]
    fn pages_are_isometric() {
        for (name, page) in all() {
            let mut far = 0;
            for i in 0..400 {
                let on_page = [
                    f64::from(i % 20) / 20.3 + 0.017,
                    f64::from(i / 20) * HEIGHT / 20.7 + 0.013,
                ];
                let seen = page.seen(on_page);
                let again = page.on_page(seen);
                assert!(
                    (again[0] - on_page[0]).hypot(again[1] - on_page[1]) < 1e-9,
                    "{name}"
                );
                for direction in [0.3f64, 1.1, 2.5] {
                    let step = 1e-5;
                    let next = [
                        on_page[0] + step * direction.cos(),
                        on_page[1] + step * direction.sin(),
                    ];
                    let [x, y] = page.seen(next);
                    let rise = page.height([x, y]) - page.height(seen);
                    let length =
                        ((x - seen[0]).powi(2) + (y - seen[1]).powi(2) + rise * rise).sqrt();
                    far += usize::from((length / step - 1.0).abs() > 1e-6);
                }
            }
            assert!(far <= 2, "{name}: {far}");
        }
    }
}
