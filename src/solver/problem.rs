//! The energy in normalised coordinates, and the way back to the user's.

use nalgebra::{Matrix3, Vector3};

use super::options::{Normalization, Options};
use crate::domain::Domain;
use crate::error::{Result, try_filled};
use crate::heightfield::Heightfield;
use crate::stencil::HessianMap;

/// `P(z) = λ Σ (z − z̃)² + Σ ‖H(z)‖_*` over a domain (paper, Eq. 15), with the
/// input's best-fit plane taken away: the energy does not see affine functions,
/// and without them nothing is lost to rounding.
#[derive(Debug, Clone)]
pub(crate) struct Problem {
    pub domain: Domain,
    pub lambda: f64,
    /// `z̃` on the padded box, zero outside `I ∪ ∂I`.
    pub target: Vec<f64>,
    pub map: HessianMap,
    /// Lattice spacing in normalised coordinates.
    pub spacing: f64,
    /// Factor from the user's units.
    pub scale: f64,
    /// Objectives up to this are rounding errors of zero.
    pub rounding: f64,
    plane: Plane,
}

impl Problem {
    pub(crate) fn new(field: &Heightfield, options: &Options) -> Result<Self> {
        options.validate()?;
        let domain = Domain::new(field)?;
        let scale = match options.normalization {
            Normalization::Off => 1.0,
            Normalization::UnitSquare => 1.0 / longer_side(field),
        };
        let plane = Plane::fit(field, &domain);
        let mut target = try_filled("input heights", domain.cells(), 0.0)?;
        let mut largest = 0.0f64;
        for cell in domain.active().cells() {
            let height = field.heights()[domain.lattice_index(cell)];
            target[cell] = scale * (height - plane.at(domain.lattice_vertex(cell), field));
            largest = largest.max((scale * height).abs());
        }
        let spacing = scale * domain.lattice().spacing();
        // Each Hessian is a handful of heights over h², each with its own rounding error.
        let rounding =
            16.0 * f64::EPSILON * largest / (spacing * spacing) * domain.interior_len() as f64;
        Ok(Problem {
            lambda: options.lambda.value(),
            target,
            map: HessianMap::new(spacing),
            spacing,
            scale,
            rounding,
            plane,
            domain,
        })
    }

    /// Heights in the user's units from `z` on the padded box; omitted vertices stay NaN.
    pub(crate) fn heights(&self, field: &Heightfield, z: &[f64]) -> Vec<f64> {
        let mut heights = vec![f64::NAN; field.lattice().len()];
        for cell in self.domain.active().cells() {
            let vertex = self.domain.lattice_vertex(cell);
            heights[self.domain.lattice_index(cell)] =
                z[cell] / self.scale + self.plane.at(vertex, field);
        }
        heights
    }
}

/// Longer side of the bounding box of the valid vertices.
fn longer_side(field: &Heightfield) -> f64 {
    let lattice = field.lattice();
    let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for row in 0..lattice.rows() {
        for col in (0..lattice.cols()).filter(|col| !field.height(row, *col).is_nan()) {
            for (k, x) in lattice.position(row, col).into_iter().enumerate() {
                min[k] = min[k].min(x);
                max[k] = max[k].max(x);
            }
        }
    }
    (max[0] - min[0]).max(max[1] - min[1])
}

/// `a + b·(x − x̄, y − ȳ)` in the user's units.
#[derive(Debug, Clone, Copy)]
struct Plane {
    centre: [f64; 2],
    constant: f64,
    slope: [f64; 2],
}

impl Plane {
    /// Least squares over `I ∪ ∂I`.
    fn fit(field: &Heightfield, domain: &Domain) -> Plane {
        let n = domain.active().len() as f64;
        let vertices = || domain.active().cells().map(|c| domain.lattice_vertex(c));
        let position = |(row, col)| field.lattice().position(row, col);
        let height = |(row, col)| field.height(row, col);
        let centre = [0, 1].map(|k| vertices().map(|v| position(v)[k]).sum::<f64>() / n);
        let mean = vertices().map(height).sum::<f64>() / n;

        let mut normal = Matrix3::zeros();
        let mut right = Vector3::zeros();
        for v in vertices() {
            let [x, y] = position(v);
            let row = Vector3::new(1.0, x - centre[0], y - centre[1]);
            normal += row * row.transpose();
            right += row * (height(v) - mean);
        }
        // Seven vertices of a stencil always span the plane; the fallback is for overflow only.
        let solution = normal.cholesky().map(|c| c.solve(&right));
        let [constant, sx, sy] = solution.map_or([0.0; 3], |s| [s[0], s[1], s[2]]);
        Plane {
            centre,
            constant: mean + constant,
            slope: [sx, sy],
        }
    }

    fn at(&self, (row, col): (usize, usize), field: &Heightfield) -> f64 {
        let [x, y] = field.lattice().position(row, col);
        self.constant + self.slope[0] * (x - self.centre[0]) + self.slope[1] * (y - self.centre[1])
    }
}
