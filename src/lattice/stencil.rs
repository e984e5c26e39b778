//! The best-fit quadratic through a vertex and its six neighbours, and the
//! row kernels that evaluate its Hessian and the adjoint.
//!
//! Along the three lattice directions the heights have second differences
//!
//! ```text
//! d₁ = W − 2C + E,   d₂ = NW − 2C + SE,   d₃ = NE − 2C + SW
//! ```
//!
//! and the least-squares Hessian (paper, Eq. 12, 13 and 27; the printed Eq. 27
//! gives the coefficients of x² and y², half of the diagonal) is
//!
//! ```text
//! mean = (d₁ + d₂ + d₃) / 3h²,   diff = (2d₁ − d₂ − d₃) / 3h²,   off = (d₃ − d₂) / √3h²
//! ```
//!
//! in the coordinates of [`Sym2`]. So `C` is three second differences and a
//! 3×3 map, and `Cᵀ` is the transposed map and three second differences again.

use std::ops::Range;

use super::domain::Domain;
use super::runs::Run;
use crate::math::fork::{self, HAS_POOLS};
use crate::math::real::Real;
use crate::math::sym2::Sym2;

/// A quadratic height function `c + g·x + ½ xᵀHx` of the offset `x` from a vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadratic {
    /// Height `c` at the vertex.
    pub constant: f64,
    /// Gradient `g` at the vertex.
    pub gradient: [f64; 2],
    /// Hessian `H`, the matrix of second derivatives.
    pub hessian: Sym2,
}

impl Quadratic {
    /// Fits a quadratic by least squares to the heights of a vertex and its neighbours W, E, NW, NE, SW, SE at distance
    /// `spacing`. The quadratic has the vertex's own height there.
    pub fn fit(centre: f64, neighbours: [f64; 6], spacing: f64) -> Self {
        let [w, e, nw, ne, sw, se] = neighbours;
        let d = [
            w - 2.0 * centre + e,
            nw - 2.0 * centre + se,
            ne - 2.0 * centre + sw,
        ];
        Quadratic {
            constant: centre,
            gradient: [
                (ne - nw + 2.0 * (e - w) + se - sw) / (6.0 * spacing),
                3f64.sqrt() * (nw + ne - sw - se) / (6.0 * spacing),
            ],
            hessian: HessianMap::new(spacing).hessian(d),
        }
    }

    /// Returns the quadratic's height at the offset `(x, y)` from the vertex.
    pub fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let [xx, xy, yy] = self.hessian.entries();
        self.constant
            + self.gradient[0] * x
            + self.gradient[1] * y
            + 0.5 * (xx * x * x + 2.0 * xy * x * y + yy * y * y)
    }
}

/// The 3×3 linear map from the second differences of heights in the three lattice directions to the Hessian at a
/// vertex, and its adjoint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HessianMap<T = f64> {
    third: T,
    root_third: T,
}

impl<T: Real> HessianMap<T> {
    /// Returns the Hessian of three second differences by its coordinates `[mean, diff, off]`, as [`Sym2`] has them.
    #[inline(always)]
    pub(crate) fn coordinates(&self, [d1, d2, d3]: [T; 3]) -> [T; 3] {
        let side = d2 + d3;
        [
            self.third * (d1 + side),
            self.third * (d1 + d1 - side),
            self.root_third * (d3 - d2),
        ]
    }

    /// Applies the adjoint of the map, with respect to the Frobenius inner product, to a matrix with the coordinates
    /// `[mean, diff, off]` of [`Sym2`]; returns one value for each lattice direction.
    #[inline(always)]
    pub(crate) fn adjoint_of(&self, [mean, diff, off]: [T; 3]) -> [T; 3] {
        let twice = self.third + self.third;
        let (mean, diff) = (twice * mean, twice * diff);
        let off = (self.root_third + self.root_third) * off;
        [mean + (diff + diff), mean - diff - off, mean - diff + off]
    }
}

impl HessianMap<f32> {
    /// Makes the map for a lattice of spacing 1.
    pub(crate) fn unit() -> Self {
        HessianMap {
            third: 1.0 / 3.0,
            root_third: 1.0 / 3f32.sqrt(),
        }
    }
}

impl HessianMap {
    pub(crate) fn new(spacing: f64) -> Self {
        let inverse = 1.0 / (spacing * spacing);
        HessianMap {
            third: inverse / 3.0,
            root_third: inverse / 3f64.sqrt(),
        }
    }

    /// Returns the Hessian of three second differences of heights, one for each lattice direction.
    #[inline(always)]
    pub(crate) fn hessian(&self, differences: [f64; 3]) -> Sym2 {
        let [mean, diff, off] = self.coordinates(differences);
        Sym2 { mean, diff, off }
    }

    /// Applies the adjoint of the map, with respect to the Frobenius inner product, to a matrix; returns one value for
    /// each lattice direction.
    #[inline(always)]
    pub(crate) fn adjoint(&self, y: Sym2) -> [f64; 3] {
        self.adjoint_of([y.mean, y.diff, y.off])
    }

    /// Applies the map to three second differences, and its adjoint to the Hessian: `adjoint(hessian(d))`.
    #[inline(always)]
    pub(crate) fn normal(&self, [d1, d2, d3]: [f64; 3]) -> [f64; 3] {
        let unit = 2.0 * self.third * self.third; // 2/9 h⁻⁴
        let sum = unit * (d1 + d2 + d3);
        let six = 6.0 * unit;
        [six * d1 - sum, six * d2 - sum, six * d3 - sum]
    }
}

/// The heights of the cells of a run and of their six neighbours, as slices of the run's length.
pub(crate) struct Ring<'a, T> {
    w: &'a [T],
    c: &'a [T],
    e: &'a [T],
    nw: &'a [T],
    ne: &'a [T],
    sw: &'a [T],
    se: &'a [T],
}

impl<'a, T: Real> Ring<'a, T> {
    /// Takes the heights of a run's cells and of their neighbours from `field`, an array over the domain; `row` is the
    /// run's row in the padded box.
    #[inline(always)]
    pub(crate) fn new(field: &'a [T], domain: &Domain, row: usize, run: Run) -> Self {
        let n = run.end - run.start;
        let [w, e, nw, ne, sw, se] = domain
            .neighbour_offsets(row)
            .map(|o| &field[run.start.wrapping_add_signed(o)..][..n]);
        let c = &field[run.start..][..n];
        Ring {
            w,
            c,
            e,
            nw,
            ne,
            sw,
            se,
        }
    }

    /// Returns the second differences of heights at cell `i` of the run, in the three lattice directions.
    #[inline(always)]
    pub(crate) fn differences(&self, i: usize) -> [T; 3] {
        let twice = self.c[i] + self.c[i];
        [
            self.w[i] - twice + self.e[i],
            self.nw[i] - twice + self.se[i],
            self.ne[i] - twice + self.sw[i],
        ]
    }
}

impl Ring<'_, f64> {
    /// Returns the gradient of the best-fit quadratic at cell `i` of the run.
    #[inline(always)]
    pub(crate) fn gradient(&self, i: usize, spacing: f64) -> [f64; 2] {
        let (right, left) = (self.ne[i] + self.se[i], self.nw[i] + self.sw[i]);
        let (up, down) = (self.nw[i] + self.ne[i], self.sw[i] + self.se[i]);
        [
            (right - left + 2.0 * (self.e[i] - self.w[i])) / (6.0 * spacing),
            3f64.sqrt() * (up - down) / (6.0 * spacing),
        ]
    }
}

impl<T: Real> Ring<'_, T> {
    /// Returns the height of cell `i` of the run.
    #[inline(always)]
    pub(crate) fn centre(&self, i: usize) -> T {
        self.c[i]
    }

    /// Returns the sum of the heights of the six neighbours of cell `i` of the run.
    #[inline(always)]
    pub(crate) fn sum(&self, i: usize) -> T {
        self.w[i] + self.e[i] + self.nw[i] + self.ne[i] + self.sw[i] + self.se[i]
    }
}

/// The weights of one row's vertices that multiply second differences in the adjoint `Cᵀ`, one array for each of the
/// three lattice directions.
pub(crate) type Weights<T> = [Vec<T>; 3];

/// Returns the weights of a run's cells in each lattice direction, as slices of the run's length.
#[inline(always)]
pub(crate) fn weights_of<'a, T>(
    weights: &'a mut Weights<T>,
    domain: &Domain,
    row: usize,
    run: Run,
) -> [&'a mut [T]; 3] {
    let (col, n) = (run.start - row * domain.stride(), run.end - run.start);
    weights.each_mut().map(|weight| &mut weight[col..][..n])
}

/// Three consecutive rows of weights of second differences for each band of a domain, which move down the band, so that
/// the adjoint `Cᵀ` never stores weights for all vertices.
#[derive(Debug, Clone)]
pub(crate) struct Rolling<T> {
    bands: Vec<BandRows<T>>,
}

/// Rows of weights in one band.
#[derive(Debug, Clone)]
struct BandRows<T> {
    rows: [Weights<T>; 3],
    /// First two rows of the band, for the vertices beside the band above.
    first: [Weights<T>; 2],
}

impl<T: Real> BandRows<T> {
    /// Sweeps down a band of rows as [`Rolling::sweep`] does, without `gather` of the outermost rows that have a band above or
    /// below; `ends` says whether the band is the first one and the last one.
    #[inline(always)]
    fn sweep<S>(
        &mut self,
        domain: &Domain,
        band: Range<usize>,
        [is_first, is_last]: [bool; 2],
        state: &mut S,
        fill: impl Fn(&mut S, usize, &mut Weights<T>),
        gather: impl Fn(&mut S, usize, &Gather<'_, T>),
    ) {
        let BandRows { rows, first } = self;
        for weights in rows.iter_mut().flatten() {
            weights.fill(T::default());
        }
        let Range { start, end } = band;
        let gathered_from = start + usize::from(!is_first);
        for row in start..end + usize::from(is_last) {
            rows.rotate_left(1);
            for weights in &mut rows[2] {
                weights.fill(T::default());
            }
            if row < end {
                fill(state, row, &mut rows[2]);
            }
            if !is_first && row < start + 2 {
                for (to, from) in first[row - start].iter_mut().zip(&rows[2]) {
                    to.copy_from_slice(from);
                }
            }
            if row > gathered_from {
                let sums = Gather::new(domain, row - 1, rows.each_ref());
                gather(state, row - 1, &sums);
            }
        }
    }
}

impl<T: Real> Rolling<T> {
    pub(crate) fn new(domain: &Domain) -> Self {
        let row = || vec![T::default(); domain.stride()];
        let weights = || [row(), row(), row()];
        let rows = || BandRows {
            rows: [weights(), weights(), weights()],
            first: [weights(), weights()],
        };
        Rolling {
            bands: (0..domain.bands().len()).map(|_| rows()).collect(),
        }
    }

    /// Sweeps down all rows of the domain on the calling thread, as [`sweep`](Self::sweep) does on a domain of one band.
    /// `gather` may change what `fill` reads of a row: no later row reads it.
    #[inline(always)]
    pub(crate) fn sweep_serially<S>(
        &mut self,
        domain: &Domain,
        state: &mut S,
        fill: impl Fn(&mut S, usize, &mut Weights<T>),
        gather: impl Fn(&mut S, usize, &Gather<'_, T>),
    ) {
        let rows = 1..domain.rows() + 1;
        self.bands[0].sweep(domain, rows, [true, true], state, fill, gather);
    }

    /// Sweeps down each band of the domain once to apply the adjoint `Cᵀ`, with one of the `states` for each band:
    /// `fill(state, row, weights)` writes the weights of the interior cells of a row (cleared before),
    /// `gather(state, row, sums)` then reads the adjoint's values in a row whose own weights and those of both
    /// neighbouring rows are complete.
    ///
    /// In a band, `fill` is called for each row before `gather` of the row above it; `gather` of the band's outermost
    /// rows follows after all bands are swept, in the order of the rows.
    #[inline(always)]
    pub(crate) fn sweep<S: Send>(
        &mut self,
        domain: &Domain,
        states: &mut [S],
        fill: impl Fn(&mut S, usize, &mut Weights<T>) + Sync,
        gather: impl Fn(&mut S, usize, &Gather<'_, T>) + Sync,
    ) {
        let last = self.bands.len() - 1;
        let rows_of = |band| domain.bands().rows(band, domain.rows());
        let mut bands: Vec<_> = self.bands.iter_mut().zip(&mut *states).collect();
        fork::for_each(&mut bands, |band, (weights, state)| {
            let ends = [band == 0, band == last];
            weights.sweep(domain, rows_of(band), ends, *state, &fill, &gather);
        });
        if !HAS_POOLS || last == 0 {
            return;
        }
        let bands = &self.bands;
        fork::for_each(states, |band, state| {
            let BandRows { rows, first } = &bands[band];
            let top = band.checked_sub(1).map(|above| {
                let rows = [&bands[above].rows[2], &first[0], &first[1]];
                (rows_of(band).start, rows)
            });
            let bottom = bands.get(band + 1).map(|below| {
                let rows = [&rows[1], &rows[2], &below.first[0]];
                (rows_of(band).end - 1, rows)
            });
            for (row, rows) in [top, bottom].into_iter().flatten() {
                gather(state, row, &Gather::new(domain, row, rows));
            }
        });
    }
}

/// Values of the adjoint `Cᵀ` in one row, to be read as second differences of three complete rows of weights.
pub(crate) struct Gather<'a, T> {
    rows: [&'a Weights<T>; 3],
    row: usize,
    domain: &'a Domain,
}

/// The nine weights whose sum is the adjoint's value in a cell, for each cell of a run: slices of the run's length.
pub(crate) struct Gathered<'a, T> {
    w: &'a [T],
    e: &'a [T],
    nw: &'a [T],
    se: &'a [T],
    ne: &'a [T],
    sw: &'a [T],
    c1: &'a [T],
    c2: &'a [T],
    c3: &'a [T],
}

impl<'a, T: Real> Gather<'a, T> {
    /// Takes the weights of a row, of the one before it and of the one after it.
    #[inline(always)]
    fn new(domain: &'a Domain, row: usize, rows: [&'a Weights<T>; 3]) -> Self {
        Gather { rows, row, domain }
    }

    /// Takes the weights that the adjoint's values in the cells of a run are computed from.
    #[inline(always)]
    pub(crate) fn run(&self, run: Run) -> Gathered<'_, T> {
        let n = run.end - run.start;
        let stride = self.domain.stride();
        let col = run.start - self.row * stride;
        // 1 on the lattice's even rows, as in `Lattice`; row 1 of the box is one.
        let o = self.row % 2;
        let [up, mid, down] = self.rows;
        Gathered {
            w: &mid[0][col - 1..][..n],
            e: &mid[0][col + 1..][..n],
            nw: &up[1][col + o - 1..][..n],
            se: &down[1][col + o..][..n],
            ne: &up[2][col + o..][..n],
            sw: &down[2][col + o - 1..][..n],
            c1: &mid[0][col..][..n],
            c2: &mid[1][col..][..n],
            c3: &mid[2][col..][..n],
        }
    }
}

impl<T: Real> Gathered<'_, T> {
    /// Returns the adjoint's value in cell `i` of the run.
    #[inline(always)]
    pub(crate) fn at(&self, i: usize) -> T {
        let centre = self.c1[i] + self.c2[i] + self.c3[i];
        (self.w[i] + self.e[i] + self.nw[i] + self.se[i] + self.ne[i] + self.sw[i])
            - (centre + centre)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))] // proptest is native
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn exact_on_every_quadratic(
            [xx, xy, yy] in [-5.0..5.0f64, -5.0..5.0f64, -5.0..5.0f64],
            [gx, gy, c] in [-5.0..5.0f64, -5.0..5.0f64, -5.0..5.0f64],
            h in 0.01..10.0f64,
            odd in 0usize..2,
        ) {
            let truth = Quadratic { constant: c, gradient: [gx, gy], hessian: Sym2::new(xx, xy, yy) };
            let lattice = Lattice::new(5, 5, h).unwrap();
            let (row, col) = (2 + odd, 2);
            let [x0, y0] = lattice.position(row, col);
            let ring = lattice.neighbours(row, col).map(|n| {
                let (r, c) = n.unwrap();
                let [x, y] = lattice.position(r, c);
                truth.at([x - x0, y - y0])
            });
            let fit = Quadratic::fit(c, ring, h);
            let size = c.abs() + h * (gx.abs() + gy.abs()) + h * h * 20.0;
            for (a, b) in fit.hessian.entries().into_iter().zip([xx, xy, yy]) {
                prop_assert!((a - b).abs() < 1e-14 * size / (h * h) + 1e-13);
            }
            for (a, b) in fit.gradient.into_iter().zip([gx, gy]) {
                prop_assert!((a - b).abs() < 1e-14 * size / h + 1e-13);
            }
            prop_assert_eq!(fit.constant, c);
        }

        #[test]
        fn the_map_and_its_adjoint_fit(
            d in prop::array::uniform3(-1.0..1.0f64), y in prop::array::uniform3(-1.0..1.0f64),
        ) {
            let map = HessianMap::new(0.7);
            let y = Sym2::new(y[0], y[1], y[2]);
            let left = map.hessian(d).dot(y);
            let right: f64 = map.adjoint(y).iter().zip(d).map(|(a, b)| a * b).sum();
            prop_assert!((left - right).abs() < 1e-13);
            let composed = map.adjoint(map.hessian(d));
            for (a, b) in composed.into_iter().zip(map.normal(d)) {
                prop_assert!((a - b).abs() < 1e-13);
            }
        }
    }
}
