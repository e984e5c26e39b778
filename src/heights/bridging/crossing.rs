//! Test whether the surface continues from one side of a hole in the data to the other, and the height of a cell
//! (vertex or pixel) in the hole.

use nalgebra::{Matrix2, Vector2};

use super::raster::Raster;
use super::sites::{Site, Sites, surround};
use crate::error::{Result, try_filled};
use crate::math::least_squares::LeastSquares;
use crate::math::statistics::median;
use crate::math::sym2::Sym2;

/// Maximum difference between the slope across a hole and the slopes beside it that noise explains, in standard
/// deviations.
const MAX_SLOPE_JUMP_DEVIATIONS: f64 = 4.0;

/// Difference between slopes, as rise over run, below which they count as equal whatever the noise, so that rounding
/// errors are no jump.
const NEGLIGIBLE_SLOPE_DIFFERENCE: f64 = 0.05;

/// Maximum difference between the slope across a hole and those beside it that a crease within the hole explains, as a
/// multiple of the slopes' standard deviation.
const MAX_CREASE_SLOPE_SHARE: f64 = 0.7;

/// Maximum distance of heights from the plane around a hole, relative to the typical distance, where slopes beside the
/// hole are unknown.
const MAX_PLANE_DISTANCE_RATIO: f64 = 3.0;

/// Height by which a right-angled fold deviates from the plane around a hole, per distance from the hole.
const FOLD_HEIGHT_PER_DISTANCE: f64 = 0.35;

/// Minimum number of heights around a hole's cell to which a plane is fitted.
const MIN_PLANE_SAMPLES: usize = 6;

/// Weight of the noise that is typical of all holes in the estimate of the noise around one hole, as an equivalent
/// number of slopes.
const TYPICAL_NOISE_WEIGHT: f64 = 6.0;

/// A cell (vertex or pixel) in a hole, with the plane fitted to the heights around it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    pub cell: usize,
    pub height: f64,
    /// Mean confidence of the heights around the cell.
    pub confidence: f64,
    /// Number of steps from the cell within which there are heights on all sides.
    pub distance: f64,
    /// Difference between the slope across the hole and the slopes beside it, in height units per step.
    difference: f64,
    /// Significance of `difference`: its square in units of the variance of one height.
    evidence: f64,
    /// Sum of squared deviations, from their mean, of the slopes between neighbouring heights beside the hole; `terms`
    /// is their number.
    spread: f64,
    terms: f64,
    /// Whether slopes beside the hole are known in all directions.
    sees: bool,
    /// Root mean square distance of the heights from the plane; `reach` is the distance from the cell up to which they
    /// are taken, in steps.
    stray: f64,
    reach: f64,
}

pub(super) struct Crossings<'a> {
    raster: &'a Raster,
    /// Heights of the cells; NaN where there is none or its confidence is 0.
    heights: &'a [f64],
    /// Confidence of each cell; empty if all are 1.
    confidence: &'a [f64],
    /// Distance between neighbouring cells, in units of height.
    spacing: f64,
    /// Sites (relative positions of further cells) around a cell in an even row, and around one in an odd row.
    sites: [Sites; 2],
}

/// Buffers for the heights around a cell, used again for each cell.
#[derive(Default)]
struct Scratch {
    /// Indices of those sites around the cell that have a height.
    found: Vec<usize>,
    /// Height of each site, and later its distance from the plane; NaN where there is none.
    residuals: Vec<f64>,
    /// Contribution of each site's height to the slopes beside the hole.
    shares: Vec<Vector2<f64>>,
}

/// Ridge of the normal equations of a plane's slopes, so that a matrix that is singular up to rounding stays positive
/// definite.
const PLANE_MATRIX_SHIFT: f64 = 1e-6;

impl<'a> Crossings<'a> {
    pub(super) fn new(
        raster: &'a Raster,
        heights: &'a [f64],
        confidence: &'a [f64],
        width: usize,
        spacing: f64,
    ) -> Self {
        Crossings {
            raster,
            heights,
            confidence,
            spacing,
            sites: [false, true].map(|odd| Sites::new(raster, odd, width + 2)),
        }
    }

    /// Returns those of the given cells (vertices or pixels in holes) where the surface continues across the hole,
    /// without the neighbours of cells where it does not.
    pub(super) fn sound(&self, cells: &[usize]) -> Result<Vec<Crossing>> {
        let mut scratch = Scratch::default();
        let at = |cell: &usize| self.at(*cell, &mut scratch);
        let found: Vec<Option<Crossing>> = cells.iter().map(at).collect();
        let known = || found.iter().flatten();
        let spreads = known().filter(|c| c.terms >= TYPICAL_NOISE_WEIGHT);
        let mut spreads: Vec<f64> = spreads.map(|c| c.spread / c.terms).collect();
        let strays = known().filter(|c| !c.sees);
        let mut strays: Vec<f64> = strays.map(|c| c.stray).collect();
        let typical = Typical {
            spread: median(&mut spreads).unwrap_or(0.0),
            stray: median(&mut strays).unwrap_or(0.0),
        };
        let mut torn = try_filled("bridged holes", self.raster.cells(), false)?;
        for (cell, crossing) in cells.iter().zip(&found) {
            torn[*cell] = !crossing.is_some_and(|c| c.is_sound(&typical, self.spacing));
        }
        let sound =
            |c: &Crossing| !torn[c.cell] && !self.raster.neighbours(c.cell).any(|n| torn[n]);
        Ok(found.into_iter().flatten().filter(sound).collect())
    }

    /// Fits a plane to the heights around a cell: out to where there are heights on all sides of it, and two steps
    /// further. None if there are too few.
    fn at(&self, cell: usize, scratch: &mut Scratch) -> Option<Crossing> {
        let sites = &self.sites[usize::from(self.raster.is_odd(cell))];
        scratch.found.clear();
        scratch.residuals.clear();
        scratch.residuals.push(f64::NAN);
        let (mut sectors, mut around) = (0, None);
        for (k, ring) in sites.rings.windows(2).enumerate() {
            for (i, site) in sites.sites[..ring[1]].iter().enumerate().skip(ring[0]) {
                let z = self.heights[cell.wrapping_add_signed(site.offset)];
                scratch.residuals.push(z);
                if !z.is_nan() {
                    scratch.found.push(i);
                    sectors |= 1 << site.sector;
                }
            }
            if around.is_none() && surround(sectors) {
                around = Some(k + 1);
            }
            match around {
                Some(distance) if k > distance && scratch.found.len() >= MIN_PLANE_SAMPLES => {
                    return self.fit(cell, &sites.sites[..ring[1]], distance, scratch);
                }
                _ => (),
            }
        }
        None
    }

    fn fit(
        &self,
        cell: usize,
        sites: &[Site],
        distance: usize,
        Scratch {
            found,
            residuals,
            shares,
        }: &mut Scratch,
    ) -> Option<Crossing> {
        let mut plane = LeastSquares::<3>::new();
        let mut confidence = 0.0;
        // Heights are relative to one of them, so that no digits are lost far from 0.
        let first = residuals[*found.first()?];
        for i in &*found {
            let row = sites[*i].place.push(1.0);
            plane.add(&row, [residuals[*i] - first], 1.0);
            let at = cell.wrapping_add_signed(sites[*i].offset);
            confidence += self.confidence.get(at).copied().unwrap_or(1.0);
        }
        let plane = plane.solve()?;
        let mut strays = 0.0;
        for i in &*found {
            let residual = residuals[*i] - first - plane.dot(&sites[*i].place.push(1.0));
            residuals[*i] = residual;
            strays += residual * residual;
        }
        // Slopes between neighbours, less the plane's.
        let mut gradient = LeastSquares::<2>::with_ridge([PLANE_MATRIX_SHIFT; 2]);
        let (mut squares, mut terms) = (0.0, 0.0);
        shares.clear();
        shares.resize(sites.len(), Vector2::zeros());
        for i in &*found {
            for k in sites[*i].next.iter().filter(|k| **k < sites.len()) {
                let rise = residuals[*k] - residuals[*i];
                if !rise.is_nan() {
                    let step = sites[*k].place - sites[*i].place;
                    gradient.add(&step, [rise], 1.0);
                    shares[*k] += step;
                    shares[*i] -= step;
                    squares += rise * rise;
                    terms += 1.0;
                }
            }
        }
        let variance = found
            .iter()
            .fold(Matrix2::identity() * PLANE_MATRIX_SHIFT, |sum, i| {
                sum + shares[*i] * shares[*i].transpose()
            });
        let (normal, right) = (&gradient.matrix, &gradient.right);
        let [_, least] = Sym2::new(normal.m11, normal.m12, normal.m22).eigenvalues();
        let difference = gradient.solve()?;
        let n = found.len() as f64;
        Some(Crossing {
            cell,
            height: plane[2] + first,
            confidence: confidence / n,
            distance: distance as f64,
            difference: difference.norm(),
            evidence: right.dot(&variance.cholesky()?.solve(right)),
            spread: (squares - right.dot(&difference)).max(0.0),
            terms,
            // Pairs along two directions give an eigenvalue of at least a half.
            sees: least > 0.25,
            stray: (strays / n).sqrt(),
            reach: sites.last()?.place.norm(),
        })
    }
}

/// Typical noise of the heights around holes: medians over all holes.
struct Typical {
    /// Median over all holes of the variance of the slopes between neighbouring heights beside a hole.
    spread: f64,
    /// Median distance of heights from the plane around a hole, over holes beside which slopes are unknown.
    stray: f64,
}

impl Crossing {
    fn is_sound(&self, typical: &Typical, spacing: f64) -> bool {
        let fold = FOLD_HEIGHT_PER_DISTANCE * self.reach * spacing;
        let spread = (self.spread + TYPICAL_NOISE_WEIGHT * typical.spread)
            / (self.terms + TYPICAL_NOISE_WEIGHT);
        // A difference of two heights has twice the variance of one.
        let noise = self.evidence <= MAX_SLOPE_JUMP_DEVIATIONS.powi(2) * 0.5 * spread;
        let bend = self.difference
            <= NEGLIGIBLE_SLOPE_DIFFERENCE * spacing + MAX_CREASE_SLOPE_SHARE * spread.sqrt();
        self.height.is_finite()
            && match self.sees {
                true => noise || bend,
                false => self.stray <= MAX_PLANE_DISTANCE_RATIO * typical.stray + fold,
            }
    }
}
