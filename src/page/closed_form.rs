//! Initial guess of the cylinder on which a curled page lies, in closed form from its corners and edges in the photo.

use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen, Vector3};

use super::cylinder::{CurveSeries, Cylinder, legendre_values};
use super::traced_line::TracedLine;

/// Maximum degree of the polynomial that is fitted to a page's cross-section for the initial guess of the page's curve.
const MAX_INITIAL_DEGREE: usize = 5;

/// Minimum distance between the camera and the plane in which a bent edge lies, as a share of that distance for the
/// opposite edge; an edge with a nearer plane appears straight and is not used for the curve.
const MIN_EDGE_PLANE_DISTANCE: f64 = 0.2;

/// Maximum depth scale of a traced point: the multiple of the line of sight with `z = 1` at which it lies on the page,
/// where the page's first corner is at 1. Points further away are left out.
const MAX_POINT_SCALE: f64 = 100.0;

/// Maximum ratio of a page's length along the rulings to its width, and of its width to its length; other initial
/// guesses are discarded.
const MAX_LENGTH_RATIO: f64 = 1e3;

/// Computes the focal length, in pixels, from the page's four corners in the photo: the one for which the rulings are
/// perpendicular to the chord of the bent edges, so that the vanishing points of both directions satisfy `x₁x₂ + y₁y₂ +
/// f² w₁w₂ = 0`. None if no focal length satisfies that.
pub(super) fn focal_length(pages: &[[TracedLine; 2]], centre: [f64; 2]) -> Option<f64> {
    let [a, b, c, d] = corners(pages).map(|p| ray(p, centre, 1.0));
    let r = a.cross(&d).cross(&b.cross(&c));
    let q = a.cross(&b).cross(&d.cross(&c));
    let squared = -(r.x * q.x + r.y * q.y) / (r.z * q.z);
    (squared.is_finite() && squared > 0.0).then(|| squared.sqrt())
}

/// Returns the four outer corners of a page, or of a spread's two pages together, in the photo's pixels, clockwise from
/// the start of the first edge.
pub(super) fn corners(pages: &[[TracedLine; 2]]) -> [[f64; 2]; 4] {
    let last = &pages[pages.len() - 1];
    [
        pages[0][0].ends()[0],
        last[0].ends()[1],
        last[1].ends()[1],
        pages[0][1].ends()[0],
    ]
}

/// Direction of the line of sight through pixel `p` in the camera's axes, scaled to `z = 1`. `centre` is the principal
/// point.
fn ray(p: [f64; 2], centre: [f64; 2], focal: f64) -> Vector3<f64> {
    Vector3::new((p[0] - centre[0]) / focal, (p[1] - centre[1]) / focal, 1.0)
}

/// Computes the initial guess of the page's cylinder in closed form from the traced edges, for a focal length in
/// pixels. None if the corners are not those of a rectangle.
pub(super) fn cylinder(
    pages: &[[TracedLine; 2]],
    centre: [f64; 2],
    focal: f64,
) -> Option<Cylinder> {
    let ray = |p: &[f64; 2]| ray(*p, centre, focal);
    // Rulings are parallel: their direction is in all planes through the camera and one of them.
    let mut planes = Matrix3::zeros();
    for [first, second] in pages {
        for end in 0..2 {
            let plane = ray(&first.ends()[end])
                .cross(&ray(&second.ends()[end]))
                .normalize();
            planes += plane * plane.transpose();
        }
    }
    let eigen = SymmetricEigen::new(planes);
    let least = eigen.eigenvalues.imin();
    let mut ruling: Vector3<f64> = eigen.eigenvectors.column(least).into();
    let [origin, foot] = [0, 1].map(|e| ray(&pages[0][e].ends()[0]));
    let across = foot.cross(&ruling);
    let mut length = -foot.cross(&origin).dot(&across) / across.norm_squared();
    if length < 0.0 {
        (ruling, length) = (-ruling, -length);
    }
    let end = origin + ruling * length;
    // An edge whose plane passes near the camera appears straight whatever its shape.
    let reaches = [origin, end].map(|corner| ruling.dot(&corner));
    let telling =
        |reach: f64| reach.abs() > MIN_EDGE_PLANE_DISTANCE * reaches[0].abs().max(reaches[1].abs());
    // Points of each page in the plane through the origin and normal to the rulings.
    let mut points: Vec<Vec<(Vector3<f64>, f64)>> = Vec::new();
    for pair in pages {
        let mut own = Vec::new();
        for (line, reach) in pair
            .iter()
            .zip(reaches)
            .filter(|(_, reach)| telling(*reach))
        {
            for p in &line.points {
                let sight = ray(p);
                let scale = reach / ruling.dot(&sight);
                if scale.is_finite() && scale > 0.0 && scale < MAX_POINT_SCALE {
                    let point = sight * scale;
                    let level = point - ruling * ruling.dot(&(point - origin));
                    own.push((level, reach * reach));
                }
            }
        }
        if own.len() < 2 {
            return None;
        }
        points.push(own);
    }
    // The chord, from corners alone.
    let last = &pages[pages.len() - 1];
    let mut far = Vector3::zeros();
    let mut weights = 0.0;
    for (line, reach) in last
        .iter()
        .zip(reaches)
        .filter(|(_, reach)| telling(*reach))
    {
        let sight = ray(&line.ends()[1]);
        let point = sight * (reach / ruling.dot(&sight));
        if point.iter().all(|v| v.is_finite()) && point.z > 0.0 {
            far += (point - ruling * ruling.dot(&(point - origin))) * (reach * reach);
            weights += reach * reach;
        }
    }
    let along = (far / weights - origin).normalize();
    let normal = ruling.cross(&along);
    let mut pages = Vec::new();
    for own in points {
        let flat: Vec<_> = (own.iter())
            .map(|(p, weight)| ((p - origin).dot(&along), (p - origin).dot(&normal), *weight))
            .collect();
        pages.push(fit_curve(&flat)?);
    }
    let mut found = Cylinder {
        focal,
        centre,
        axes: Matrix3::from_columns(&[along, normal, ruling]),
        origin,
        length,
        pages,
        skews: Vec::new(),
    };
    // The first page's mean direction goes into the axes, its width is the unit.
    let (mean, unit) = (found.pages[0].turns[0], found.pages[0].width);
    let (sin, cos) = mean.sin_cos();
    let turned = [along * cos + normal * sin, normal * cos - along * sin];
    found.axes = Matrix3::from_columns(&[turned[0], turned[1], ruling]);
    for page in &mut found.pages {
        page.turns[0] -= mean;
        page.width /= unit;
    }
    found.origin /= unit;
    found.length /= unit;
    let numbers = found
        .pages
        .iter()
        .flat_map(|page| page.turns.iter().chain([&page.width]));
    let finite = numbers
        .chain(&found.origin)
        .chain(&found.axes)
        .all(|v| v.is_finite());
    (finite && found.length > 1.0 / MAX_LENGTH_RATIO && found.length < MAX_LENGTH_RATIO)
        .then_some(found)
}

/// Fits one page's curve to points `(along the chord, across it, weight)`: first a polynomial over the chord, which is
/// then converted to a Legendre series of the curve's direction over its arc length. None if there are too few points.
fn fit_curve(points: &[(f64, f64, f64)]) -> Option<CurveSeries> {
    let low = points.iter().map(|p| p.0).fold(f64::INFINITY, f64::min);
    let high = points.iter().map(|p| p.0).fold(f64::NEG_INFINITY, f64::max);
    let span = high - low;
    if !(span.is_finite() && span > 0.0) {
        return None;
    }
    let degree = MAX_INITIAL_DEGREE.min(points.len() / 3).max(1);
    let mut normal = DMatrix::<f64>::identity(degree + 1, degree + 1) * 1e-9;
    let mut right = DVector::<f64>::zeros(degree + 1);
    for (u, v, weight) in points {
        let row = DVector::from_vec(legendre_values(degree, (u - low) / span));
        normal.ger(*weight, &row, &row, 1.0);
        right += row * (*v * *weight);
    }
    let fitted = normal.cholesky()?.solve(&right);
    let height = |at: f64| -> f64 {
        legendre_values(degree, at)
            .iter()
            .zip(&fitted)
            .map(|(p, c)| p * c)
            .sum()
    };
    /// Number of straight pieces over which the arc length of the fitted polynomial is summed.
    const ARC_LENGTH_STEPS: usize = 200;
    let mut pieces = Vec::with_capacity(ARC_LENGTH_STEPS);
    let mut width = 0.0;
    for i in 0..ARC_LENGTH_STEPS {
        let [from, to] = [i, i + 1].map(|i| i as f64 / ARC_LENGTH_STEPS as f64);
        let rise = height(to) - height(from);
        let run = span / ARC_LENGTH_STEPS as f64;
        pieces.push((
            width + 0.5 * run.hypot(rise),
            run.hypot(rise),
            rise.atan2(run),
        ));
        width += run.hypot(rise);
    }
    let mut turns = vec![0.0; degree + 1];
    for (middle, length, angle) in pieces {
        for (k, (turn, p)) in turns
            .iter_mut()
            .zip(legendre_values(degree, middle / width))
            .enumerate()
        {
            *turn += (2 * k + 1) as f64 * angle * p * length / width;
        }
    }
    Some(CurveSeries { width, turns })
}
