//! Whether the surface goes on from one side of a hole to the other, and at which height.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::raster::Raster;
use crate::error::{Result, try_filled};

/// By how many standard deviations the slope across a hole may differ from those beside it.
const UNEXPLAINED: f64 = 4.0;

/// Slopes that differ by less are the same whatever the noise: keeps rounding from being a jump.
const SAME: f64 = 0.05;

/// Nor is a difference up to this share of the spread: where the surface creases within the hole, and
/// not in its middle, there is one.
const BEND: f64 = 0.7;

/// Where no neighbours are left that slopes could be taken between, heights may be as far from the
/// plane as is typical, times this,
const STRAY: f64 = 3.0;

/// and as far as a right-angled fold brings them, in distances from the hole.
const FOLD: f64 = 0.35;

/// Fewest heights that a plane is fitted to.
const FEWEST: usize = 6;

/// For so many differences the typical noise counts as much as a hole's own.
const TYPICAL: f64 = 6.0;

/// A hole's cell with the plane through what is around.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    pub cell: usize,
    pub height: f64,
    pub confidence: f64,
    /// By how much the slope across differs from those beside, in height per step.
    difference: f64,
    /// The same squared, in variances of one height.
    evidence: f64,
    /// How much slopes beside differ among each other: the sum of the squares, and their number.
    spread: f64,
    terms: f64,
    /// Whether slopes beside are known in all directions.
    sees: bool,
    /// How far heights are from the plane (root mean square), and how far away they are taken from.
    stray: f64,
    reach: f64,
}

pub(super) struct Crossings<'a> {
    raster: &'a Raster,
    heights: &'a [f64],
    confidence: &'a dyn Fn(usize) -> f64,
    /// Distance between neighbours, in units of height.
    spacing: f64,
    /// Around a cell in an even and in an odd row.
    sites: [Sites; 2],
}

/// Cells by their distance from a hole's: those `k` steps away are `sites[rings[k - 1]..rings[k]]`.
struct Sites {
    sites: Vec<Site>,
    rings: Vec<usize>,
}

struct Site {
    offset: isize,
    place: [f64; 2],
    /// Of twelve sectors, which one it lies in.
    sector: u32,
    /// Half of its neighbours, so that each pair comes once.
    next: Vec<usize>,
}

const SECTORS: u32 = 12;

/// For each site, to be used again.
#[derive(Default)]
struct Scratch {
    /// Heights above the plane.
    residuals: Vec<f64>,
    shares: Vec<Vector2<f64>>,
}

impl<'a> Crossings<'a> {
    pub(super) fn new(
        raster: &'a Raster,
        heights: &'a [f64],
        confidence: &'a dyn Fn(usize) -> f64,
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

    /// Those of the cells where the surface goes on, and that are not next to one where it does not.
    pub(super) fn sound(&self, cells: &[usize]) -> Result<Vec<Crossing>> {
        let mut scratch = Scratch::default();
        let found: Vec<Option<Crossing>> = cells
            .iter()
            .map(|cell| self.at(*cell, &mut scratch))
            .collect();
        let typical = median(
            found
                .iter()
                .flatten()
                .filter(|c| c.terms >= TYPICAL)
                .map(|c| c.spread / c.terms),
        );
        let blind = || found.iter().flatten().filter(|c| !c.sees);
        let typical_stray = median(blind().map(|c| c.stray));
        let same = SAME * self.spacing;
        let mut torn = try_filled("bridged holes", self.raster.cells(), false)?;
        for (cell, crossing) in cells.iter().zip(&found) {
            let sound = crossing.is_some_and(|crossing| {
                let spread = (crossing.spread + TYPICAL * typical) / (crossing.terms + TYPICAL);
                if !crossing.sees {
                    let fold = FOLD * crossing.reach * self.spacing;
                    return crossing.stray <= STRAY * typical_stray + fold;
                }
                // A difference of two heights has twice the variance of one.
                let explained = crossing.evidence <= UNEXPLAINED.powi(2) * 0.5 * spread;
                crossing.height.is_finite()
                    && (explained || crossing.difference <= same + BEND * spread.sqrt())
            });
            torn[*cell] = !sound;
        }
        let sound =
            |c: &Crossing| !torn[c.cell] && !self.raster.neighbours(c.cell).any(|n| torn[n]);
        Ok(found.into_iter().flatten().filter(sound).collect())
    }

    /// What is around a cell: as far as there is something on all sides of it, and a step further.
    fn at(&self, cell: usize, scratch: &mut Scratch) -> Option<Crossing> {
        let sites = &self.sites[usize::from(self.raster.is_odd(cell))];
        let there = |site: &Site| {
            let at = cell.wrapping_add_signed(site.offset);
            let given = !self.heights[at].is_nan() && (self.confidence)(at) > 0.0;
            given.then_some(at)
        };
        let (mut sectors, mut count) = (0u32, 0);
        let mut far = None;
        for (k, ring) in sites.rings.windows(2).enumerate() {
            for site in sites.sites[ring[0]..ring[1]]
                .iter()
                .filter(|site| there(site).is_some())
            {
                sectors |= 1 << site.sector;
                count += 1;
            }
            if far.is_none() && surround(sectors) {
                far = Some(k + 3);
            }
            if far.is_some_and(|far| k + 1 >= far) && count >= FEWEST {
                return self.fit(cell, &sites.sites[..ring[1]], &there, scratch);
            }
        }
        None
    }

    fn fit(
        &self,
        cell: usize,
        sites: &[Site],
        there: &dyn Fn(&Site) -> Option<usize>,
        Scratch { residuals, shares }: &mut Scratch,
    ) -> Option<Crossing> {
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        let (mut n, mut confidence) = (0.0, 0.0);
        residuals.clear();
        let mut first = None;
        for site in sites {
            let Some(at) = there(site) else {
                residuals.push(f64::NAN);
                continue;
            };
            // Above the first one: nothing is lost far from 0.
            let z = self.heights[at] - *first.get_or_insert(self.heights[at]);
            let row = Vector3::new(1.0, site.place[0], site.place[1]);
            normal += row * row.transpose();
            right += row * z;
            residuals.push(z);
            n += 1.0;
            confidence += (self.confidence)(at);
        }
        let plane = normal.cholesky()?.solve(&right);
        for (residual, site) in residuals.iter_mut().zip(sites) {
            *residual -= plane[0] + plane[1] * site.place[0] + plane[2] * site.place[1];
        }
        // Slopes between neighbours, less the plane's, and what each height contributes to them.
        let (mut normal, mut right) = (Matrix2::identity() * 1e-6, Vector2::zeros());
        let (mut squares, mut terms) = (0.0, 0.0);
        shares.clear();
        shares.resize(sites.len(), Vector2::zeros());
        for (i, site) in sites.iter().enumerate() {
            for k in site.next.iter().filter(|k| **k < sites.len()) {
                let rise = residuals[*k] - residuals[i];
                if !rise.is_nan() {
                    let step = [0, 1].map(|axis| sites[*k].place[axis] - site.place[axis]);
                    let step = Vector2::from(step);
                    normal += step * step.transpose();
                    right += step * rise;
                    shares[*k] += step;
                    shares[i] -= step;
                    squares += rise * rise;
                    terms += 1.0;
                }
            }
        }
        let variance = shares
            .iter()
            .fold(Matrix2::identity() * 1e-6, |sum, share| {
                sum + share * share.transpose()
            });
        let strays = residuals.iter().filter(|r| !r.is_nan()).map(|r| r * r);
        let stray = (strays.sum::<f64>() / n).sqrt();
        let farthest = sites.last().map_or([0.0; 2], |site| site.place);
        // A pair along each of two directions has an eigenvalue of at least a half.
        let sees = normal.symmetric_eigenvalues().min() > 0.25;
        let difference = normal.cholesky()?.solve(&right);
        Some(Crossing {
            cell,
            height: plane[0] + first?,
            confidence: confidence / n,
            difference: difference.norm(),
            evidence: right.dot(&variance.cholesky()?.solve(&right)),
            spread: (squares - right.dot(&difference)).max(0.0),
            terms,
            sees,
            stray,
            reach: farthest[0].hypot(farthest[1]),
        })
    }
}

impl Sites {
    fn new(raster: &Raster, odd: bool, most: usize) -> Self {
        let steps = [raster.steps(false), raster.steps(true)];
        let parity = |[row, _]: [isize; 2]| usize::from(odd) ^ row.rem_euclid(2) as usize;
        let mut places: Vec<[isize; 2]> = vec![[0, 0]];
        let mut rings = vec![1];
        let mut from = 0;
        for _ in 0..most {
            for i in from..places.len() {
                let at = places[i];
                for [r, c] in &steps[parity(at)] {
                    let to = [at[0] + r, at[1] + c];
                    if !places.contains(&to) {
                        places.push(to);
                    }
                }
            }
            from = rings[rings.len() - 1];
            rings.push(places.len());
        }
        let stride = raster.stride as isize;
        let sites = places.iter().map(|at| {
            let place = raster.place(odd, *at);
            let angle = place[1].atan2(place[0]) / std::f64::consts::TAU;
            let half = steps[parity(*at)].len() / 2;
            let next = steps[parity(*at)][..half].iter();
            let next = next.filter_map(|[r, c]| {
                let to = [at[0] + r, at[1] + c];
                places.iter().position(|place| *place == to)
            });
            Site {
                offset: at[0] * stride + at[1],
                place,
                sector: (angle.rem_euclid(1.0) * f64::from(SECTORS)) as u32 % SECTORS,
                next: next.collect(),
            }
        });
        Sites {
            sites: sites.collect(),
            rings,
        }
    }
}

/// Whether no half of the sectors in a row is without any.
fn surround(sectors: u32) -> bool {
    let all = sectors | sectors << SECTORS;
    let half = (1 << (SECTORS / 2)) - 1;
    (0..SECTORS).all(|first| all >> first & half != 0)
}

/// 0 of nothing.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    let middle = values.len() / 2;
    match values.is_empty() {
        true => 0.0,
        false => *values.select_nth_unstable_by(middle, f64::total_cmp).1,
    }
}
