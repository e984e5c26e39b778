//! Estimate of the flat page's error: the covariance of the least-squares solution, propagated
//! to places on the page.

use nalgebra::{DMatrix, DVector, Matrix2};

use super::cylinder::{Cylinder, DIFFERENCE_STEP};
use super::prior::Prior;
use super::traces::{Residuals, Traces};

/// Error estimate of a flat page: root mean square displacement after the best similarity, over the width
/// of a page.
#[derive(Debug, Clone, Copy)]
pub(super) struct ErrorEstimate {
    /// Expected displacement of the flat page's points, over the width of a page.
    pub expected: f64,
    /// Displacement, over the width of a page, that is not exceeded in 95 of 100 cases if the page is curled in one
    /// direction.
    pub bound: f64,
    /// Relative standard deviation of the camera's focal length.
    pub focal: f64,
}

/// Number of sample points along each page's curve at which errors of the flat page are estimated.
const PLACES_ACROSS: usize = 11;

/// Number of sample points along each ruling at which errors of the flat page are estimated.
const PLACES_DOWN: usize = 7;

/// Number of additional points with exactly the assumed accuracy that enter the estimate of the traced points'
/// variance.
const PRIOR_POINTS: f64 = 4.0;

/// Estimates the error of the flat page that a cylinder gives. `centre` is the standard deviation of the principal
/// point, in pixels. None if the traces do not determine all parameters.
pub(super) fn estimate_error(
    cylinder: &Cylinder,
    traces: &Traces,
    residuals: &Residuals,
    prior: &Prior,
    centre: f64,
) -> Option<ErrorEstimate> {
    let (matrix, _) = traces.jacobian(cylinder, residuals, prior)?;
    let rows = traces.rows();
    let data = matrix.rows(0, rows);
    let known = matrix.rows(rows, matrix.nrows() - rows);
    let count = traces.count();
    let free = (count - cylinder.parameters() as f64).max(0.0) + PRIOR_POINTS;
    let assumed = prior.accuracy.powi(2);
    // At least the assumed error, because a curve follows smooth errors.
    let squared = ((traces.squares(residuals) + PRIOR_POINTS * assumed) / free).max(assumed);
    // Points that share an error count as one.
    let share = assumed / (squared * traces.points_per_error(residuals));
    let normal = data.tr_mul(&data) * share + known.tr_mul(&known);
    let covariance = normal.cholesky()?.inverse();

    let places = displacement_jacobian(cylinder)?;
    let parameters = cylinder.parameters();
    let mut field = places.columns(0, parameters).into_owned();
    let mut centred = places.columns(parameters, 2).into_owned();
    // An error of the principal point moves the projection, and the solution with it.
    let pull = data.tr_mul(&traces.principal_point_jacobian(cylinder, residuals, prior)?) * share;
    centred -= product(&field, &product(&covariance, &pull));
    let similarities = similarity_basis(cylinder);
    for k in 0..parameters {
        remove_components(&mut field, k, &similarities);
    }
    for k in 0..2 {
        remove_components(&mut centred, k, &similarities);
    }

    let points = field.nrows() as f64 / 2.0;
    let pages = cylinder.pages.len() as f64;
    let width = cylinder.pages.iter().map(|page| page.width).sum::<f64>() / pages;
    let shift = product(&centred, &centred.transpose()) * centre.powi(2);
    let spread = product(&product(&field, &covariance), &field.transpose()) + shift;
    let mean = spread.trace() / points;
    let deviation = (2.0 * spread.norm_squared()).sqrt() / points;
    let unsure = 1.0 + 2.0 * (2.0 / free).sqrt();
    let expected = mean.sqrt() / width;
    let bound = ((mean + 2.0 * deviation) * unsure).sqrt() / width;

    let all = [expected, bound, covariance[(0, 0)].sqrt()];
    let [expected, bound, focal] = all;
    all.iter().all(|v| v.is_finite()).then_some(ErrorEstimate {
        expected,
        bound,
        focal,
    })
}

/// Product of two matrices, computed by dot products of columns.
fn product(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    left.transpose().tr_mul(right)
}

/// Root mean square displacement between the flat pages that two cylinders give for one photo, after the best
/// similarity, over the width of a page. None if a place of one page is not visible on the other.
pub(super) fn displacement_between(one: &Cylinder, other: &Cylinder) -> Option<f64> {
    let (curve, found) = (one.curve(), other.curve());
    let mut way = Vec::new();
    let mut starts = [0.0; 2];
    let mut last = 0;
    for (page, share, down) in page_places(one.pages.len()) {
        if page != last {
            starts[0] += one.pages[last].width;
            starts[1] += other.pages[last].width;
            last = page;
        }
        let pixel = one.project(curve.at(page, share), down * one.length)?;
        let mut at = nalgebra::Vector2::new(share, down);
        for _ in 0..20 {
            let off = |dx: f64, dy: f64| {
                let seen = other.project(found.at(page, at.x + dx), (at.y + dy) * other.length)?;
                Some(nalgebra::Vector2::new(
                    seen[0] - pixel[0],
                    seen[1] - pixel[1],
                ))
            };
            let here = off(0.0, 0.0)?;
            let columns = [
                (off(DIFFERENCE_STEP, 0.0)? - here) / DIFFERENCE_STEP,
                (off(0.0, DIFFERENCE_STEP)? - here) / DIFFERENCE_STEP,
            ];
            at -= Matrix2::from_columns(&columns).try_inverse()? * here;
        }
        way.push(
            starts[1] + at.x * other.pages[page].width - starts[0] - share * one.pages[page].width,
        );
        way.push(at.y * other.length - down * one.length);
    }
    let mut field = DMatrix::from_vec(way.len(), 1, way);
    remove_components(&mut field, 0, &similarity_basis(one));
    let width = one.pages.iter().map(|page| page.width).sum::<f64>() / one.pages.len() as f64;
    let mean = (2.0 * field.norm_squared() / field.len() as f64).sqrt() / width;
    mean.is_finite().then_some(mean)
}

/// Sample points at which errors of the flat page are estimated: number of the page, share of its width, share of its
/// length.
fn page_places(pages: usize) -> impl Iterator<Item = (usize, f64, f64)> {
    (0..pages * PLACES_ACROSS * PLACES_DOWN).map(|i| {
        let (page, i) = (
            i / (PLACES_ACROSS * PLACES_DOWN),
            i % (PLACES_ACROSS * PLACES_DOWN),
        );
        let share = |i: usize, of: usize| (i as f64 + 0.5) / of as f64;
        (
            page,
            share(i % PLACES_ACROSS, PLACES_ACROSS),
            share(i / PLACES_ACROSS, PLACES_DOWN),
        )
    })
}

/// Jacobian of the positions on the flat page that belong to fixed pixels, by the cylinder's parameters and the
/// principal point. Rows are x and y of each sample point. None if a sample point is not in front of the camera.
fn displacement_jacobian(cylinder: &Cylinder) -> Option<DMatrix<f64>> {
    let places: Vec<_> = page_places(cylinder.pages.len()).collect();
    let parameters = cylinder.parameters();
    // Positions in the photo and on the page.
    let look = |of: &Cylinder, moved: [f64; 2]| -> Option<Vec<([f64; 2], [f64; 2])>> {
        let curve = of.curve();
        let mut starts = vec![0.0];
        for page in &of.pages {
            starts.push(starts[starts.len() - 1] + page.width);
        }
        (places.iter())
            .map(|&(page, share, down)| {
                let (share, down) = (share + moved[0], (down + moved[1]) * of.length);
                let seen = of.project(curve.at(page, share), down)?;
                Some((seen, [starts[page] + share * of.pages[page].width, down]))
            })
            .collect()
    };
    type Places = Vec<([f64; 2], [f64; 2])>;
    let differences = |plus: Places, minus: Places| -> Places {
        let half =
            |p: [f64; 2], q: [f64; 2]| [0, 1].map(|k| (p[k] - q[k]) / (2.0 * DIFFERENCE_STEP));
        plus.into_iter()
            .zip(minus)
            .map(|(p, m)| (half(p.0, m.0), half(p.1, m.1)))
            .collect()
    };
    let by = |way: [f64; 2]| -> Option<Places> {
        let back = way.map(|v| -v);
        Some(differences(look(cylinder, way)?, look(cylinder, back)?))
    };
    let (across, along) = (by([DIFFERENCE_STEP, 0.0])?, by([0.0, DIFFERENCE_STEP])?);
    let mut back = Vec::with_capacity(places.len());
    for ((x_s, u_s), (x_t, u_t)) in across.iter().zip(&along) {
        let seen = Matrix2::new(x_s[0], x_t[0], x_s[1], x_t[1]);
        let flat = Matrix2::new(u_s[0], u_t[0], u_s[1], u_t[1]);
        back.push(flat * seen.try_inverse()?);
    }
    let mut out = DMatrix::zeros(2 * places.len(), parameters + 2);
    let mut step = vec![0.0; parameters];
    for k in 0..parameters {
        step[k] = DIFFERENCE_STEP;
        let plus = look(&cylinder.moved(&step), [0.0; 2])?;
        step[k] = -DIFFERENCE_STEP;
        let minus = look(&cylinder.moved(&step), [0.0; 2])?;
        step[k] = 0.0;
        for (i, (seen, flat)) in differences(plus, minus).into_iter().enumerate() {
            let moved = back[i] * nalgebra::Vector2::from(seen);
            out[(2 * i, k)] = flat[0] - moved[0];
            out[(2 * i + 1, k)] = flat[1] - moved[1];
        }
    }
    for (i, back) in back.iter().enumerate() {
        for k in 0..2 {
            for row in 0..2 {
                out[(2 * i + row, parameters + k)] = -back[(row, k)];
            }
        }
    }
    Some(out)
}

/// Orthonormal basis of the displacements of the flat page's sample points by translation, scaling and rotation.
fn similarity_basis(cylinder: &Cylinder) -> Vec<DVector<f64>> {
    let mut starts = vec![0.0];
    for page in &cylinder.pages {
        starts.push(starts[starts.len() - 1] + page.width);
    }
    let places: Vec<[f64; 2]> = page_places(cylinder.pages.len())
        .map(|(page, share, down)| {
            [
                starts[page] + share * cylinder.pages[page].width,
                down * cylinder.length,
            ]
        })
        .collect();
    let motions: [fn([f64; 2]) -> [f64; 2]; 4] =
        [|_| [1.0, 0.0], |_| [0.0, 1.0], |p| p, |[x, y]| [-y, x]];
    let mut found: Vec<DVector<f64>> = Vec::new();
    for motion in motions {
        let mut own = DVector::from_vec(places.iter().flat_map(|p| motion(*p)).collect());
        for other in &found {
            let part = own.dot(other);
            own -= other * part;
        }
        found.push(own.normalize());
    }
    found
}

/// Subtracts from one column of a matrix its components along orthonormal vectors.
fn remove_components(field: &mut DMatrix<f64>, column: usize, motions: &[DVector<f64>]) {
    for motion in motions {
        let part = field.column(column).dot(motion);
        field.column_mut(column).axpy(-part, motion, 1.0);
    }
}
