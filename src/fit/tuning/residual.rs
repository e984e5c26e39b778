//! Distance of a surface to the heights of its input, by which λ is judged.

use super::trust::{least_trust, sample};
use crate::error::{Result, try_filled};
use crate::fit::input::Input;
use crate::heights::heightfield::Heightfield;
use crate::lattice::domain::Domain;

/// Computes the distances of a surface to the heights of the domain, in a unit; NaN where no height is measured.
pub(super) fn residuals(
    input: &Input,
    domain: &Domain,
    surface: &Heightfield,
    unit: f64,
) -> Result<Vec<f64>> {
    let least = least_trust(input);
    let mut residuals = try_filled("residuals", input.field.lattice().len(), f64::NAN)?;
    for cell in domain.active().cells() {
        let vertex = domain.lattice_index(cell);
        residuals[vertex] = (sample(input, vertex, least) - surface.heights()[vertex]) / unit;
    }
    Ok(residuals)
}

/// Computes the root mean square distance of a surface to the heights of the domain that are measured, in a unit; larger ones than
/// `most` count as that.
///
/// # Errors
/// Out of memory.
pub(crate) fn root_mean_square(
    input: &Input,
    domain: &Domain,
    surface: &Heightfield,
    [unit, most]: [f64; 2],
) -> Result<f64> {
    let residuals = residuals(input, domain, surface, unit)?;
    let known = residuals.iter().filter(|residual| residual.is_finite());
    let (squares, count) = known.fold((0.0, 0.0), |(squares, count), residual| {
        (squares + residual.abs().min(most).powi(2), count + 1.0)
    });
    Ok(f64::sqrt(squares / f64::max(count, 1.0)))
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
        root_mean_square(&input, &domain, &flat, [0.5, 2.0]).unwrap()
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
