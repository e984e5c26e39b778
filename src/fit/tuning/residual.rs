//! Distance of a surface to the heights of its input, by which λ is judged.

use super::curvature_scales::stepped;
use super::noise::{MIN_SAMPLE_CONFIDENCE, largest_trust, sample};
use crate::error::{Result, try_filled};
use crate::fit::input::Input;
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;
use crate::lattice::hexagonal::Lattice;
use crate::math::statistics::{MAD_TO_SIGMA, median};

/// Side, in spacings, of the tiles in which the size of most residuals is measured: far larger than the strips in which a
/// surface loses steps.
const TILE: usize = 16;

/// Distances of a surface to the heights of its input.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Residual {
    /// Root mean square.
    pub rms: f64,
    /// Standard deviation of most heights nearby, from the medians of the absolute values in tiles, since noise may be larger
    /// in one place than in another: the root of the mean of its square.
    pub bulk: f64,
    /// Median magnitude of the autocorrelations in the lattice's three directions, at [`AUTOCORRELATION_LAG`], as that
    /// along scan lines is their noise; 0 where too few vertices are that far apart.
    pub autocorrelation: f64,
}

/// Lag, in spacings, at which the autocorrelation is measured: white noise has none there, even that of square pixels after
/// resampling, whose neighbours are correlated.
const AUTOCORRELATION_LAG: isize = 4;

/// Minimum number of pairs of vertices from which an autocorrelation is measured.
const MIN_AUTOCORRELATION_PAIRS: usize = 400;

/// Computes the distances of a surface to the heights of the domain, in a unit; NaN where no height is measured.
pub(super) fn residuals(
    input: &Input,
    domain: &Domain,
    surface: &Heightfield,
    unit: f64,
) -> Result<Vec<f64>> {
    let least = MIN_SAMPLE_CONFIDENCE * largest_trust(input);
    let mut residuals = try_filled("residuals", input.field.lattice().len(), f64::NAN)?;
    for cell in domain.active().cells() {
        let vertex = domain.lattice_index(cell);
        residuals[vertex] = (sample(input, vertex, least) - surface.heights()[vertex]) / unit;
    }
    Ok(residuals)
}

impl Residual {
    /// Returns the correlation that noise of a correlation length has at [`AUTOCORRELATION_LAG`] spacings.
    pub(crate) fn correlation_at_lag(spacing: f64, length: f64) -> f64 {
        (-(AUTOCORRELATION_LAG as f64 * spacing / (2.0 * length)).powi(2)).exp()
    }

    /// Measures the distances of a surface to the heights of the domain that are measured, in a unit; larger ones than `most`
    /// count as that.
    ///
    /// # Errors
    /// Out of memory.
    pub(crate) fn of(
        input: &Input,
        domain: &Domain,
        surface: &Heightfield,
        [unit, most]: [f64; 2],
    ) -> Result<Self> {
        let lattice = *input.field.lattice();
        let residuals = residuals(input, domain, surface, unit)?;
        let known = residuals.iter().filter(|residual| residual.is_finite());
        let (squares, count) = known.fold((0.0, 0.0), |(squares, count), residual| {
            (squares + residual.abs().min(most).powi(2), count + 1.0)
        });
        let autocorrelation = autocorrelation(&lattice, &residuals);
        Ok(Residual {
            rms: f64::sqrt(squares / f64::max(count, 1.0)),
            bulk: bulk(&lattice, &residuals),
            autocorrelation,
        })
    }
}

/// Computes [`Residual::bulk`] of residuals, which are NaN where there is none.
fn bulk(lattice: &Lattice, residuals: &[f64]) -> f64 {
    let [rows, cols] = [lattice.rows(), lattice.cols()];
    let (mut squares, mut count) = (0.0, 0.0);
    for top in (0..rows).step_by(TILE) {
        for left in (0..cols).step_by(TILE) {
            let in_row = |row| &residuals[row * cols..][left..cols.min(left + TILE)];
            let tile = (top..rows.min(top + TILE)).flat_map(in_row);
            let mut tile: Vec<f64> = tile.map(|r| r.abs()).filter(|r| r.is_finite()).collect();
            if let Some(median) = median(&mut tile) {
                squares += tile.len() as f64 * (MAD_TO_SIGMA * median).powi(2);
                count += tile.len() as f64;
            }
        }
    }
    f64::sqrt(squares / f64::max(count, 1.0))
}

/// Computes [`Residual::autocorrelation`] of residuals, which are NaN where there is none.
fn autocorrelation(lattice: &Lattice, residuals: &[f64]) -> f64 {
    let mut sizes = [(0, 2), (1, 1), (1, -1)].map(|(rows, half_cols)| {
        let (mut products, mut squares, mut pairs) = (0.0, 0.0, 0);
        for (vertex, a) in residuals.iter().enumerate() {
            let (row, col) = (vertex / lattice.cols(), vertex % lattice.cols());
            let offset = (AUTOCORRELATION_LAG * rows, AUTOCORRELATION_LAG * half_cols);
            let (row, col) = stepped(row as isize, col as isize, offset);
            if lattice.contains(row, col) {
                let b = residuals[lattice.index(row as usize, col as usize)];
                if a.is_finite() && b.is_finite() {
                    products += a * b;
                    squares += 0.5 * (a * a + b * b);
                    pairs += 1;
                }
            }
        }
        let is_measured = pairs >= MIN_AUTOCORRELATION_PAIRS && squares > 0.0;
        match is_measured {
            true => f64::abs(products / squares),
            false => 0.0,
        }
    });
    sizes.sort_by(f64::total_cmp);
    sizes[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    /// Distance of a flat surface to heights on a lattice of 40 columns, in units of 0.5.
    fn distance(heights: impl Fn(usize) -> f64) -> f64 {
        let lattice = Lattice::new(40, 40, 1.0).unwrap();
        let field = Heightfield::new(lattice, (0..1600).map(heights).collect()).unwrap();
        let flat = Heightfield::from_fn(lattice, |_, _| 0.0).unwrap();
        let input = Input::new(field);
        let domain = input.domain().unwrap();
        Residual::of(&input, &domain, &flat, [0.5, 2.0])
            .unwrap()
            .rms
    }

    /// Heights of ±0.5 are one unit off. Impulses at one of 80 heights, and a strip of a tenth, count as two units each; vertices at
    /// corners are left out.
    #[test]
    fn outliers_and_strips_count_as_lost_vertices() {
        let sign = |vertex: usize| if vertex.is_multiple_of(2) { 0.5 } else { -0.5 };
        let expected = |share: f64| (1.0 + share * (4.0 - 1.0)).sqrt();
        assert!((distance(sign) - 1.0).abs() < 1e-12);
        let impulses = distance(|v| if v.is_multiple_of(80) { 50.0 } else { sign(v) });
        assert!((impulses - expected(1.0 / 80.0)).abs() < 0.01, "{impulses}");
        let strip = distance(|v| if v % 40 < 4 { 5.0 } else { sign(v) });
        assert!((strip - expected(0.1)).abs() < 0.01, "{strip}");
    }
}
