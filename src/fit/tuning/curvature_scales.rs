//! Curvatures of heights along the rulings at several scales, by which noise is told from shape.
//!
//! A quadratic is fitted by least squares to all heights in a disc. A developable surface is straight along its rulings, which
//! the discs beside it show, while noise bends in every direction at every scale, whatever its correlation.

use super::merge::merge;
use super::trust::{least_trust, sample};
use crate::error::{Result, try_filled};
use crate::fit::input::Input;
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::ROW_SPACING;
use crate::math::fork;
use crate::math::least_squares::LeastSquares;
use crate::math::statistics::{MAD_TO_SIGMA, median};
use crate::math::sym2::Sym2;
use nalgebra::SVector;

/// Radii of the discs in which curvatures are measured, in spacings of the lattice whose heights they hold.
pub(super) const DISC_RADII: [usize; 2] = [2, 3];

/// Maximum number of lattices on which curvatures are measured, each of twice the spacing of the one before.
const MAX_LATTICES: usize = 5;

/// Maximum number of rows, and of columns, whose vertices are centres of discs in which curvatures are measured. More
/// of them cost time and make the medians hardly more exact.
const MAX_CENTRE_ROWS: usize = 80;

/// Disc in which curvatures are measured: the offsets of its vertices from its centre, and the coefficients that give
/// the Hessian of the quadratic fitted to their heights.
#[derive(Debug, Clone)]
pub(super) struct Disc {
    radius: usize,
    /// Offset of each vertex from the disc's centre, in rows and half columns.
    offsets: Vec<(isize, isize)>,
    /// Coefficients of each vertex's height in the entries `xx`, `xy` and `yy` of the Hessian, for a spacing of 1.
    hessian: Vec<[f64; 3]>,
    /// Autocorrelation of the Hessian's coefficients: for each squared distance between vertices of the disc, at a
    /// spacing of 1, the Frobenius product of two vertices' coefficients, summed over all pairs at that distance, as a
    /// share of the sum at distance 0. For noise whose correlation depends on the distance alone, the sum of these
    /// shares times the correlations is the Hessian's variance relative to white noise.
    pub autocorrelation: Vec<(f64, f64)>,
    /// Standard deviation of the Hessian's entry `xx` for white noise of standard deviation 1, at a spacing of 1.
    pub deviation: f64,
}

impl Disc {
    pub(super) fn new(radius: usize) -> Option<Self> {
        let offsets = offsets_within(radius);
        let row_of = |offset: &(isize, isize)| {
            let [x, y] = position(*offset);
            SVector::<f64, 6>::from([1.0, x, y, 0.5 * x * x, x * y, 0.5 * y * y])
        };
        let mut equations = LeastSquares::<6>::new();
        for offset in &offsets {
            equations.add(&row_of(offset), [0.0], 1.0);
        }
        let factor = equations.factor()?;
        let hessian: Vec<[f64; 3]> = offsets
            .iter()
            .map(|offset| factor.solve(&row_of(offset)))
            .map(|coefficients| [coefficients[3], coefficients[4], coefficients[5]])
            .collect();
        let squares: f64 = hessian.iter().map(|[xx, ..]| xx * xx).sum();
        Some(Disc {
            radius,
            autocorrelation: autocorrelation(&offsets, &hessian),
            offsets,
            hessian,
            deviation: squares.sqrt(),
        })
    }
}

/// Hessians of the quadratics that are fitted to heights in discs of one size, each computed when it is first asked for.
struct Hessians<'a> {
    heights: &'a Heightfield,
    disc: &'a Disc,
    /// Steps from a disc's centre to its vertices, in indices of heights, for a centre in an even and in an odd row.
    steps: [Vec<isize>; 2],
    known: Vec<Option<Option<Sym2>>>,
}

impl<'a> Hessians<'a> {
    fn new(heights: &'a Heightfield, disc: &'a Disc) -> Result<Self> {
        let lattice = heights.lattice();
        let steps = [0, 1].map(|row| {
            let to = disc.offsets.iter().map(|offset| stepped(row, 0, *offset));
            to.map(|(to, col)| (to - row) * lattice.cols() as isize + col)
                .collect()
        });
        let known = try_filled("curvatures", lattice.len(), None)?;
        Ok(Hessians {
            heights,
            disc,
            steps,
            known,
        })
    }

    /// Returns the Hessian in the disc about a vertex, for a spacing of 1; `None` where a height of the disc is missing.
    fn at(&mut self, row: isize, col: isize) -> Option<Sym2> {
        let lattice = self.heights.lattice();
        let reach = self.disc.radius as isize;
        let is_inside = |at: isize, size: usize| (reach..size as isize - reach).contains(&at);
        if !is_inside(row, lattice.rows()) || !is_inside(col, lattice.cols()) {
            return None;
        }
        let centre = lattice.index(row as usize, col as usize);
        *self.known[centre].get_or_insert_with(|| {
            let mut entries = [0.0; 3];
            let steps = &self.steps[row as usize % 2];
            for (step, coefficients) in steps.iter().zip(&self.disc.hessian) {
                let height = self.heights.heights()[centre.wrapping_add_signed(*step)];
                for (entry, coefficient) in entries.iter_mut().zip(coefficients) {
                    *entry += coefficient * height;
                }
            }
            let [xx, xy, yy] = entries;
            xx.is_finite().then(|| Sym2::new(xx, xy, yy))
        })
    }
}

/// Computes [`Disc::autocorrelation`]: the products of the Hessian's coefficients of two vertices, summed by the
/// squared distance between the vertices.
fn autocorrelation(offsets: &[(isize, isize)], hessian: &[[f64; 3]]) -> Vec<(f64, f64)> {
    let mut sums: Vec<(f64, f64)> = Vec::new();
    for (p, a) in offsets.iter().zip(hessian) {
        for (q, b) in offsets.iter().zip(hessian) {
            let distance = 0.25 * (3 * (p.0 - q.0).pow(2) + (p.1 - q.1).pow(2)) as f64;
            let product = a[0] * b[0] + 2.0 * a[1] * b[1] + a[2] * b[2];
            match sums.iter_mut().find(|(other, _)| *other == distance) {
                Some((_, sum)) => *sum += product,
                None => sums.push((distance, product)),
            }
        }
    }
    // The first pair is a vertex with itself.
    let own = sums[0].1;
    sums.iter_mut().for_each(|(_, sum)| *sum /= own);
    sums
}

/// Returns the position of an offset, in rows and half columns, for a spacing of 1.
pub(super) fn position((row, half): (isize, isize)) -> [f64; 2] {
    [0.5 * half as f64, -ROW_SPACING * row as f64]
}

/// Curvatures of an input's heights in discs of one size, along the rulings and across them, as medians over all discs.
#[derive(Debug, Clone, Copy)]
pub(super) struct CurvatureScale {
    /// Number of times the spacing of the input's lattice was doubled.
    pub lattice: usize,
    /// Index of the disc's radius in [`DISC_RADII`].
    pub disc: usize,
    /// Number of discs that were measured.
    pub count: usize,
    /// Standard deviation of white noise on the input's lattice for which the curvature along the rulings has the same median.
    pub white_equivalent: f64,
    /// Standard deviation of white noise for which the curvature across the rulings has the same median.
    pub white_equivalent_across: f64,
    /// Mean product of the signs of a disc's curvature along the rulings and of that of the discs beside it. It is about 0
    /// for noise and 1 for a shape that bends in all directions.
    pub coherence: f64,
    /// Ratio of the median second derivative across rows to the one along rows: 1 for isotropic noise.
    pub anisotropy: f64,
    /// Mean cosine between the Hessians (as vectors of their entries) of discs side by side, along the direction in which it
    /// is least. It is about 0 for noise and 1 for a bend.
    pub likeness: f64,
}

impl CurvatureScale {
    /// Number of discs without a common vertex that would tell as much.
    pub(super) fn independent_discs(&self, discs: &[Disc]) -> f64 {
        self.count as f64 / discs[self.disc].offsets.len() as f64
    }

    /// Radius of the discs, in spacings of the input's lattice.
    pub(super) fn radius(&self) -> f64 {
        (DISC_RADII[self.disc] << self.lattice) as f64
    }
}

/// Measures the curvatures of an input's heights along the rulings and across them, from small discs to large ones. Cost: linear in
/// the number of vertices.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn curvature_scales(input: &Input, discs: &[Disc]) -> Result<Vec<CurvatureScale>> {
    let lattice = *input.field.lattice();
    let mut heights = try_filled("heights whose noise is measured", lattice.len(), f64::NAN)?;
    // What is bridged is nearly as smooth as the rest; what is trusted less says nothing about the noise.
    let least = least_trust(input);
    for vertex in (0..lattice.len()).filter(|vertex| !input.is_occluded(*vertex)) {
        heights[vertex] = sample(input, vertex, least);
    }
    let mut means = Input::new(Heightfield::new(lattice, heights)?);
    let mut scales = Vec::new();
    for lattice in 0..MAX_LATTICES {
        let mut measured: Vec<_> = (0..discs.len()).map(|disc| (disc, None)).collect();
        fork::for_each(&mut measured, |_, (disc, to)| {
            *to = Some(measure(&means.field, lattice, *disc, &discs[*disc]));
        });
        for (_, scale) in measured {
            scales.extend(scale.transpose()?.flatten());
        }
        if means.field.lattice().rows() < 8 || means.field.lattice().cols() < 8 {
            break;
        }
        // White noise stays white.
        means = merge(&means)?;
    }
    Ok(scales)
}

/// Measures the curvatures of heights on the `lattice`-th lattice in discs of one size; `None` if none of them is measured.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
fn measure(
    heights: &Heightfield,
    lattice: usize,
    index: usize,
    disc: &Disc,
) -> Result<Option<CurvatureScale>> {
    let mut hessians = Hessians::new(heights, disc)?;
    let step = |size: usize| size.div_ceil(MAX_CENTRE_ROWS).max(1);
    let [rows, cols] = [heights.lattice().rows(), heights.lattice().cols()];
    let beside = 2 * disc.radius as isize + 1;
    let directions = [(0, 2 * beside), (beside, beside), (beside, -beside)];
    let mut curvatures: [Vec<f64>; 2] = Default::default();
    let mut derivatives: [Vec<f64>; 2] = Default::default();
    let (mut signs, mut cosines) = (0.0, [(0.0, 0.0); 3]);
    for row in (0..rows as isize).step_by(step(rows)) {
        for col in (0..cols as isize).step_by(step(cols)) {
            let Some(hessian) = hessians.at(row, col) else {
                continue;
            };
            let mut ring = Vec::with_capacity(6);
            for ((rows, half), cosine) in directions.into_iter().zip(&mut cosines) {
                for offset in [(rows, half), (-rows, -half)] {
                    let (row, col) = stepped(row, col, offset);
                    if let Some(other) = hessians.at(row, col) {
                        let norms = (hessian.dot(hessian) * other.dot(other)).sqrt();
                        if norms > 0.0 {
                            cosine.0 += hessian.dot(other) / norms;
                            cosine.1 += 1.0;
                        }
                        ring.push(other);
                    }
                }
            }
            if ring.is_empty() {
                continue;
            }
            let ruling = ruling(&ring);
            let own = curvature(hessian, ruling);
            let beside: f64 = ring.iter().map(|hessian| curvature(*hessian, ruling)).sum();
            signs += own.signum() * beside.signum();
            curvatures[0].push(own.abs());
            curvatures[1].push((2.0 * hessian.mean - own).abs());
            let [along, _, across] = hessian.entries();
            derivatives[0].push(along.abs());
            derivatives[1].push(across.abs());
        }
    }
    let [along, across] = &mut curvatures;
    let [along_rows, across_rows] = &mut derivatives;
    let count = along.len();
    let unit = MAD_TO_SIGMA / disc.deviation * f64::from(1u32 << lattice);
    let medians = [along, across, across_rows, along_rows].map(|values| median(values));
    let [
        Some(along),
        Some(across),
        Some(across_rows),
        Some(along_rows),
    ] = medians
    else {
        return Ok(None);
    };
    Ok(Some(CurvatureScale {
        lattice,
        disc: index,
        count,
        white_equivalent: unit * along,
        white_equivalent_across: unit * across,
        coherence: signs / count as f64,
        anisotropy: across_rows / along_rows,
        likeness: (cosines.iter().filter(|(_, count)| *count > 0.0))
            .map(|(sum, count)| sum / count)
            .fold(1.0, f64::min),
    }))
}

/// Returns the direction in which Hessians bend least, as the cosine and the sine of its angle: the eigenvector of the sum of
/// their squares with the smaller eigenvalue.
fn ruling(hessians: &[Sym2]) -> [f64; 2] {
    let (diff, off) = hessians.iter().fold((0.0, 0.0), |(diff, off), h| {
        (diff + h.mean * h.diff, off + h.mean * h.off)
    });
    let (sin, cos) = (0.5 * f64::atan2(-off, -diff)).sin_cos();
    [cos, sin]
}

/// Returns the second derivative of a Hessian in a direction.
fn curvature(hessian: Sym2, [cos, sin]: [f64; 2]) -> f64 {
    let [xx, xy, yy] = hessian.entries();
    cos * cos * xx + 2.0 * cos * sin * xy + sin * sin * yy
}

/// Returns the offsets, in rows and half columns, of all vertices within a radius, for a spacing of 1.
pub(super) fn offsets_within(radius: usize) -> Vec<(isize, isize)> {
    let reach = radius as isize;
    (-reach..=reach)
        .flat_map(|row| (-2 * reach..=2 * reach).map(move |half| (row, half)))
        .filter(|(row, half)| (row + half) % 2 == 0)
        .filter(|offset| {
            let [x, y] = position(*offset);
            x.hypot(y) <= radius as f64 + 1e-9
        })
        .collect()
}

/// Returns row and column of the vertex at an offset, in rows and half columns, from the vertex at `row` and `col`.
pub(super) fn stepped(row: isize, col: isize, (rows, half): (isize, isize)) -> (isize, isize) {
    let odd = |row: isize| row.rem_euclid(2);
    let target = row + rows;
    (target, col + (half + odd(target) - odd(row)).div_euclid(2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    /// A quadratic is fitted exactly, whatever row its centre is in.
    #[test]
    fn quadratics_have_their_own_hessian_everywhere() {
        let lattice = Lattice::new(20, 21, 1.0).unwrap();
        let field = Heightfield::from_fn(lattice, |x, y| {
            1.0 + x - y + 0.5 * (0.3 * x * x - 0.2 * y * y) + 0.1 * x * y
        });
        let field = field.unwrap();
        for radius in DISC_RADII {
            let disc = Disc::new(radius).unwrap();
            let mut hessians = Hessians::new(&field, &disc).unwrap();
            for (row, col) in [(9, 9), (10, 9), (8, 12)] {
                let [xx, xy, yy] = hessians.at(row, col).unwrap().entries();
                for (found, known) in [(xx, 0.3), (xy, 0.1), (yy, -0.2)] {
                    assert!((found - known).abs() < 1e-11, "{found} {known}");
                }
            }
            assert!(hessians.at(1, 9).is_none());
        }
    }
}
