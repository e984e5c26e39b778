//! Averaging of four vertices to one: the lattice of twice the spacing with half of the noise, which stays as
//! independent from vertex to vertex as it was. The measurement of noise and cross-validation use it; a solve itself
//! coarsens by `coarsen`.

use crate::error::{Result, try_filled};
use crate::fit::input::Input;
use crate::heights::heightfield::Heightfield;
use crate::heights::occlusions::Occlusions;
use crate::lattice::coarsening::coarse_lattice;
use crate::lattice::hexagonal::Lattice;

/// Averages an input to the lattice of twice the spacing: each coarse height is the mean of the four fine ones of a
/// rhombus, NaN where one of them is missing. Constraints become ordinary heights. An occlusion tears the surface at a
/// coarse vertex where it does at one of the four fine ones.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(crate) fn merge(input: &Input) -> Result<Input> {
    let fine = input.field.lattice();
    let lattice = coarse_lattice(fine)?;
    let mut heights = try_filled("merged heights", lattice.len(), f64::NAN)?;
    let mut confidence = try_filled("merged confidence", lattice.len(), 1.0)?;
    let mut torn = try_filled("merged occlusions", lattice.len(), 0u8)?;
    for row in 0..lattice.rows() {
        for col in 0..lattice.cols() {
            let Some(four) = rhombus(fine, row, col) else {
                continue;
            };
            let vertex = lattice.index(row, col);
            heights[vertex] = 0.25 * four.map(|v| input.field.heights()[v]).iter().sum::<f64>();
            // Confidence is taken as the inverse of a variance: that of the mean is a quarter of the mean variance.
            let variance = |v: usize| 1.0 / input.trust(v);
            confidence[vertex] = 4.0 / four.map(variance).iter().sum::<f64>();
            torn[vertex] = u8::from(four.iter().any(|v| input.is_occluded(*v)));
        }
    }
    let occlusions = Occlusions::from_vertices(&lattice, &torn)?;
    let mut merged = Input::new(Heightfield::new(lattice, heights)?)
        .already_bridged(0)
        .with_occlusions(occlusions)?;
    if !input.confidence.is_empty() {
        merged = merged.with_confidence(confidence)?;
    }
    Ok(merged)
}

/// Returns the indices of the four fine vertices that are averaged to one coarse vertex; `None` if one is outside of
/// the fine lattice.
pub(super) fn rhombus(fine: &Lattice, row: usize, col: usize) -> Option<[usize; 4]> {
    let left = (2 * col).checked_sub(row % 2)?;
    let (bottom, right) = (2 * row + 1, left + 1);
    let inside = bottom < fine.rows() && right < fine.cols();
    inside.then(|| {
        [
            fine.index(2 * row, left),
            fine.index(2 * row, right),
            fine.index(bottom, left),
            fine.index(bottom, right),
        ]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vertices of a plane lie on it after merging, all in the same place about the new ones.
    #[test]
    fn planes_stay_planes() {
        let lattice = Lattice::new(21, 24, 0.5).unwrap();
        let field = Heightfield::from_fn(lattice, |x, y| 2.0 * x - 3.0 * y + 1.0).unwrap();
        let merged = merge(&Input::new(field)).unwrap();
        let coarse = merged.field.lattice();
        let mut offset = None;
        let mut count = 0;
        for row in 0..coarse.rows() {
            for col in 0..coarse.cols() {
                let [x, y] = coarse.position(row, col);
                let difference = merged.field.height(row, col) - (2.0 * x - 3.0 * y + 1.0);
                if difference.is_nan() {
                    continue;
                }
                count += 1;
                assert!((difference - *offset.get_or_insert(difference)).abs() < 1e-12);
            }
        }
        assert_eq!(count, 10 * 12 - 5);
    }
}
