//! Exact heights of the examples. `x` runs to the right and `y` up from the centre of the image, whose longer side is
//! 1; NaN is outside of the shape.

use super::example::Example;

/// An example surface: the size of its image, and a function for its heights.
pub(super) struct Shape {
    /// Width and height of the image.
    pub extent: [f64; 2],
    pub height: fn(f64, f64) -> f64,
}

impl Shape {
    pub fn of(example: Example) -> Shape {
        match example {
            Example::Cylinder => Shape {
                extent: [1.0, 1.0],
                height: cylinder,
            },
            Example::Cone => Shape {
                extent: [1.0, 1.0],
                height: cone,
            },
            Example::Roof => Shape {
                extent: [1.0, 1.0],
                height: roof,
            },
            Example::Oloid => Shape {
                extent: [1.0, 2.1 / OLOID_IMAGE_WIDTH],
                height: oloid,
            },
            Example::Page => Shape {
                extent: [1.04 * A4_WIDTH / EXAMPLE_PAGE_IMAGE_HEIGHT_RATIO, 1.0],
                height: page,
            },
            Example::House => Shape {
                extent: [1.0, HOUSE_DEPTH],
                height: house,
            },
        }
    }
}

/// Height at `offset` of an upright circular arc with a given radius over the chord from `-half` to `half`.
fn arc(offset: f64, radius: f64, half: f64) -> f64 {
    (radius * radius - offset * offset).sqrt() - (radius * radius - half * half).sqrt()
}

/// Sine and cosine of 25°, the angle between the cylinder's rulings and the image's rows.
const RULING_DIRECTION: [f64; 2] = [0.422_618_261_740_699_4, 0.906_307_787_036_65];

fn cylinder(x: f64, y: f64) -> f64 {
    // Half the square's width across the axis.
    let half = 0.5 * (RULING_DIRECTION[0] + RULING_DIRECTION[1]);
    arc(
        RULING_DIRECTION[1] * y - RULING_DIRECTION[0] * x,
        0.85,
        half,
    )
}

fn cone(x: f64, y: f64) -> f64 {
    /// Radius of the cone's base, in widths of the image.
    const CONE_BASE_RADIUS: f64 = 0.48;
    /// Slope of the cone: height over distance from the base's circle.
    const CONE_SLOPE: f64 = 0.8;
    let r = x.hypot(y);
    if r <= CONE_BASE_RADIUS {
        CONE_SLOPE * (CONE_BASE_RADIUS - r)
    } else {
        f64::NAN
    }
}

fn roof(x: f64, y: f64) -> f64 {
    let (along_x, along_y) = (arc(y, 0.7, 0.5), arc(x, 0.65, 0.5));
    let tower = 0.45 - 1.3 * x.hypot(y);
    along_x.max(along_y).max(tower)
}

/// Depth of the house in plan, where its width is 1.
const HOUSE_DEPTH: f64 = 0.75;

fn house(x: f64, y: f64) -> f64 {
    /// Slope of the house's roof planes: rise over horizontal distance from the eaves.
    const ROOF_PITCH: f64 = 0.8;
    /// Radius of the house's barrel vaults, where its width is 1.
    const VAULT_RADIUS: f64 = 0.36;
    /// Half the width of the house's barrel vaults at the eaves, where its width is 1.
    const VAULT_HALF_WIDTH: f64 = 0.3;
    let roof = ROOF_PITCH * (0.5 * HOUSE_DEPTH - y.abs()).min(0.5 - x.abs());
    let vault = if x.abs() < VAULT_HALF_WIDTH {
        arc(x, VAULT_RADIUS, VAULT_HALF_WIDTH)
    } else {
        0.0
    };
    roof.max(vault)
}

/// Width of the oloid's image in units of the radius of its circles: the oloid's length 3 plus a margin.
const OLOID_IMAGE_WIDTH: f64 = 3.1;

fn oloid(x: f64, y: f64) -> f64 {
    unit_oloid(y * OLOID_IMAGE_WIDTH, x * OLOID_IMAGE_WIDTH) / OLOID_IMAGE_WIDTH
}

/// Height of the upper half of the oloid of the circles `x² + (y + ½)² = 1, z = 0` and `(y − ½)² + z² = 1, x = 0`; NaN
/// outside of it.
///
/// With `u = tan(t/2)`, `0 ≤ u ≤ √3`, the ruling of parameter `t` leads from
/// `(sin t, −½ − cos t, 0)` on the first circle to `(0, u²/2, √((3 − u²)(1 + u²))/2)`
/// on the second; the mirror image covers `x < 0`. The one above `(x, y)` is the root of
/// `x u⁴ − 2u³ + 4y u + 3x`.
fn unit_oloid(x: f64, y: f64) -> f64 {
    let x = x.abs();
    if x > 1.0 {
        return f64::NAN;
    }
    // The rulings over this x have a share x(1 + u²)/(2u) of the first circle's point below 1.
    let root = (1.0 - x * x).sqrt();
    let (mut low, mut high) = (x / (1.0 + root), 3f64.sqrt().min((1.0 + root) / x));
    let excess = |u: f64| ((x * u - 2.0) * u * u + 4.0 * y) * u + 3.0 * x;
    if x == 0.0 {
        // The ruling u = 0 runs along x = 0 up to y = 0, the second circle from there on.
        return match y {
            -1.5..=0.0 => 3f64.sqrt() / 2.0 * (1.0 + y / 1.5),
            0.0..=1.5 => (1.0 - (y - 0.5) * (y - 0.5)).sqrt(),
            _ => f64::NAN,
        };
    }
    // Rulings of larger u lie further up, so the excess goes from positive to negative.
    if excess(low) < 0.0 || excess(high) > 0.0 {
        return f64::NAN;
    }
    // Newton's method, by bisection where that would leave the bracket.
    let mut u = 0.5 * (low + high);
    for _ in 0..60 {
        let value = excess(u);
        if value > 0.0 {
            low = u;
        } else {
            high = u;
        }
        let newton = u - value / ((4.0 * x * u - 6.0) * u * u + 4.0 * y);
        let next = if (low..=high).contains(&newton) {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - u).abs() <= f64::EPSILON * u {
            break;
        }
        u = next;
    }
    let share = x * (1.0 + u * u) / (2.0 * u);
    (1.0 - share) * 0.5 * ((3.0 - u * u).max(0.0) * (1.0 + u * u)).sqrt()
}

/// Width of an A4 sheet of height 1.
const A4_WIDTH: f64 = 210.0 / 297.0;

/// Height of the height image of the example "page", as a multiple of the paper's height: the rest is the margin around it.
const EXAMPLE_PAGE_IMAGE_HEIGHT_RATIO: f64 = 1.04;

fn page(x: f64, y: f64) -> f64 {
    unit_page(
        x * EXAMPLE_PAGE_IMAGE_HEIGHT_RATIO + 0.5 * A4_WIDTH,
        y * EXAMPLE_PAGE_IMAGE_HEIGHT_RATIO + 0.5,
    ) / EXAMPLE_PAGE_IMAGE_HEIGHT_RATIO
}

/// Height of a sheet `[0, A4_WIDTH] × [0, 1]` that is flat up to a slanting line and rolled onto a cylinder beyond it,
/// at a point in plan; NaN outside of the sheet.
fn unit_page(x: f64, y: f64) -> f64 {
    /// Cosine and sine of 15°, the angle between the image's rows and the direction across the roll's rulings.
    const ROLL_DIRECTION: [f64; 2] = [0.965_925_826_289_068_3, 0.258_819_045_102_520_74];
    /// Distance of the line at which the roll begins from the sheet's corner, in heights of the sheet.
    const ROLL_START_DISTANCE: f64 = 0.45;
    /// Radius of the roll, in heights of the sheet.
    const ROLL_RADIUS: f64 = 0.42;

    let across = ROLL_DIRECTION[0] * x + ROLL_DIRECTION[1] * y;
    let along = ROLL_DIRECTION[0] * y - ROLL_DIRECTION[1] * x;
    let sine = ((across - ROLL_START_DISTANCE) / ROLL_RADIUS).max(0.0);
    if sine >= 1.0 {
        return f64::NAN;
    }
    // Distance across the rulings on the sheet itself: arc length instead of plan length.
    let unrolled = if sine > 0.0 {
        ROLL_START_DISTANCE + ROLL_RADIUS * sine.asin()
    } else {
        across
    };
    let a = ROLL_DIRECTION[0] * unrolled - ROLL_DIRECTION[1] * along;
    let b = ROLL_DIRECTION[1] * unrolled + ROLL_DIRECTION[0] * along;
    if (0.0..=A4_WIDTH).contains(&a) && (0.0..=1.0).contains(&b) {
        ROLL_RADIUS * (1.0 - (1.0 - sine * sine).sqrt())
    } else {
        f64::NAN
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points over the box, away from grid symmetries.
    fn points(extent: [f64; 2], n: usize) -> impl Iterator<Item = [f64; 2]> {
        (0..n * n).map(move |i| {
            let at = |k: usize| (k as f64 + 0.517) / n as f64 - 0.5;
            [extent[0] * at(i % n), extent[1] * at(i / n)]
        })
    }

    /// Second derivatives `xx, xy, yy` by differences of width `h`.
    fn hessian(f: fn(f64, f64) -> f64, [x, y]: [f64; 2], h: f64) -> [f64; 3] {
        let xx = f(x + h, y) - 2.0 * f(x, y) + f(x - h, y);
        let yy = f(x, y + h) - 2.0 * f(x, y) + f(x, y - h);
        let xy = f(x + h, y + h) - f(x + h, y - h) - f(x - h, y + h) + f(x - h, y - h);
        [xx, xy / 4.0, yy].map(|d| d / (h * h))
    }

    #[test]
    fn every_example_is_developable_but_for_creases() {
        for example in Example::ALL {
            let Shape { extent, height } = Shape::of(example);
            let (mut smooth, mut all) = (0, 0);
            for p in points(extent, 60) {
                let ([a, b, c], coarse) = (hessian(height, p, 1e-4), hessian(height, p, 3e-4));
                if !coarse.iter().all(|d| d.is_finite()) {
                    continue;
                }
                all += 1;
                // Where the surface is smooth the width of the differences does not matter.
                let size = a.abs().max(b.abs()).max(c.abs());
                let change = (a - coarse[0]).abs().max((b - coarse[1]).abs());
                if change.max((c - coarse[2]).abs()) > 0.01 * size + 1e-4 {
                    continue;
                }
                smooth += 1;
                let determinant = a * c - b * b;
                let flat = 1e-3 * size * size + 1e-6;
                assert!(
                    determinant.abs() < flat,
                    "{example:?} at {p:?}: {a} {b} {c}"
                );
            }
            assert!(
                all > 1500 && smooth * 100 >= 95 * all,
                "{example:?}: {smooth} of {all}"
            );
        }
    }

    /// Area of a surface and volume below it, from a fine grid of cells.
    fn area_and_volume(f: impl Fn(f64, f64) -> f64, extent: [f64; 2], n: usize) -> (f64, f64) {
        let cell = extent[0] * extent[1] / (n * n) as f64;
        let (mut area, mut volume) = (0.0, 0.0);
        for [x, y] in points(extent, n) {
            let (z, h) = (f(x, y), 1e-6);
            if z.is_nan() {
                continue;
            }
            volume += z * cell;
            // One-sided at the edge.
            let slope = |forward: f64, back: f64| match (forward.is_nan(), back.is_nan()) {
                (false, false) => (forward - back) / (2.0 * h),
                (false, true) => (forward - z) / h,
                (true, false) => (z - back) / h,
                (true, true) => 0.0,
            };
            let dx = slope(f(x + h, y), f(x - h, y));
            let dy = slope(f(x, y + h), f(x, y - h));
            area += (1.0 + dx * dx + dy * dy).sqrt() * cell;
        }
        (area, volume)
    }

    #[test]
    fn the_oloid_has_its_known_area_and_volume() {
        let (area, volume) = area_and_volume(unit_oloid, [2.1, 3.1], 600);
        // Half of 4π and of Dirnböck and Stachel's 3.0524184684.
        assert!((area / std::f64::consts::TAU - 1.0).abs() < 5e-3, "{area}");
        assert!((volume / 1.526_209_234_2 - 1.0).abs() < 5e-4, "{volume}");
    }

    #[test]
    fn the_oloid_is_the_hull_of_its_circles() {
        let mut touched = 0;
        for i in 1..200 {
            for k in 1..200 {
                let (s, t) = (i as f64 * 0.0314, k as f64 * 0.0157);
                let (a, b) = ([s.sin(), -0.5 - s.cos()], [0.5 - t.cos(), t.sin()]);
                for share in [0.1, 0.35, 0.5, 0.8] {
                    let x = (1.0 - share) * a[0];
                    let y = (1.0 - share) * a[1] + share * b[0];
                    let z = unit_oloid(x, y);
                    let below = z - share * b[1];
                    assert!(
                        below > -1e-9,
                        "a chord above the surface at {x} {y}: {below}"
                    );
                    touched += usize::from(below < 1e-4);
                }
            }
        }
        assert!(touched > 100, "the surface consists of chords: {touched}");
    }

    #[test]
    fn the_oloid_is_continuous_at_its_symmetry_plane_and_ends_at_its_outline() {
        for y in [-1.4, -0.7, -0.01, 0.01, 0.3, 1.0, 1.49] {
            let (on, beside) = (unit_oloid(0.0, y), unit_oloid(1e-9, y));
            assert!((on - beside).abs() < 1e-7, "{y}: {on} {beside}");
            assert_eq!(unit_oloid(0.2, y).to_bits(), unit_oloid(-0.2, y).to_bits());
        }
        assert!(unit_oloid(0.0, -1.51).is_nan() && unit_oloid(0.0, 1.51).is_nan());
        assert!(unit_oloid(1.01, -0.5).is_nan() && unit_oloid(0.999, -0.5) < 0.05);
    }

    #[test]
    fn the_page_keeps_the_area_of_its_sheet() {
        let on_image = |x, y| unit_page(x + 0.5 * A4_WIDTH, y + 0.5);
        let (area, _) = area_and_volume(on_image, [1.04 * A4_WIDTH, 1.04], 700);
        assert!((area / A4_WIDTH - 1.0).abs() < 2e-3, "{area}");
        // Nothing of it lies beyond the image.
        let (larger, _) = area_and_volume(on_image, [1.2 * A4_WIDTH, 1.2], 700);
        assert!((larger / area - 1.0).abs() < 2e-3, "{larger} {area}");
    }

    #[test]
    fn the_roof_has_a_cone_and_two_vaults() {
        let z = roof;
        assert_eq!(z(0.0, 0.0), 0.45);
        assert!(z(0.0, 0.1) - z(0.0, 0.05) < -0.06, "the cone's slope");
        assert!(
            (z(0.45, 0.1) - z(0.35, 0.1)).abs() < 1e-12,
            "a vault along x"
        );
        assert!(
            (z(-0.1, 0.45) - z(-0.1, 0.35)).abs() < 1e-12,
            "a vault along y"
        );
        assert!(z(0.5, 0.5).abs() < 1e-12);
    }

    #[test]
    fn the_house_has_four_planes_and_two_vaults() {
        let z = house;
        let slope = |a: [f64; 2], b: [f64; 2]| {
            (z(b[0], b[1]) - z(a[0], a[1])) / (b[0] - a[0]).hypot(b[1] - a[1])
        };
        // The planes to the sides, and what is left of those in front and behind.
        assert!((slope([0.49, 0.0], [0.4, 0.0]) - 0.8).abs() < 1e-12);
        assert!((slope([-0.49, 0.1], [-0.4, 0.1]) - 0.8).abs() < 1e-12);
        assert!((slope([0.0, 0.15], [0.0, 0.05]) - 0.8).abs() < 1e-12);
        assert!((slope([0.1, -0.15], [0.1, -0.05]) - 0.8).abs() < 1e-12);
        // Ridge and eaves.
        assert!((z(0.1, 0.0) - 0.3).abs() < 1e-12 && (z(-0.125, 0.0) - 0.3).abs() < 1e-12);
        assert!(z(0.4, 0.375).abs() < 1e-12 && z(0.5, 0.2).abs() < 1e-12);
        // The vaults are circles of radius 0.36 across, straight along, and alike.
        let vault = |x: f64| z(x, 0.37);
        assert_eq!(vault(0.1), z(0.1, -0.37));
        assert!((vault(0.1) - z(0.1, 0.3)).abs() < 1e-12);
        let sagitta = vault(0.0) - vault(0.2);
        assert!((sagitta - (0.36 - (0.36f64.powi(2) - 0.04).sqrt())).abs() < 1e-12);
    }
}
