//! Interpolation of a plane of values across gaps.

use crate::page::outline::box_mean;

/// Radii, in cells, of the means by which gaps are filled, from the largest to the smallest.
const FILL_RADII: [usize; 4] = [400, 96, 24, 6];

/// Weight of the estimate by the next larger radius, relative to a window of known values.
const COARSE_WEIGHT: f32 = 0.02;

/// Replaces values that are not known by weighted means of known values around them, over windows of several sizes;
/// leaves the plane as it is where nothing is known.
pub(super) fn fill_gaps(plane: &mut [f32], known: &[bool], width: usize, height: usize) {
    let count = known.iter().filter(|known| **known).count();
    if count == 0 || count == plane.len() {
        return;
    }
    let sum: f64 = (plane.iter().zip(known))
        .filter(|(_, known)| **known)
        .map(|(value, _)| f64::from(*value))
        .sum();
    let mut estimate = vec![(sum / count as f64) as f32; plane.len()];
    for radius in FILL_RADII {
        let mut weights: Vec<f32> = known.iter().map(|known| f32::from(*known)).collect();
        let mut values: Vec<f32> = (plane.iter().zip(&weights)).map(|(v, w)| v * w).collect();
        box_mean(&mut weights, width, height, radius);
        box_mean(&mut values, width, height, radius);
        for ((estimate, value), weight) in estimate.iter_mut().zip(&values).zip(&weights) {
            *estimate = (value + COARSE_WEIGHT * *estimate) / (weight + COARSE_WEIGHT);
        }
    }
    for ((value, known), estimate) in plane.iter_mut().zip(known).zip(estimate) {
        if !known {
            *value = estimate;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_take_the_values_around_them_and_known_values_stay() {
        let (width, height) = (60, 40);
        let ramp = |i: usize| 0.01 * (i % width) as f32;
        let known: Vec<bool> = (0..width * height)
            .map(|i| !(20..30).contains(&(i % width)) || !(10..20).contains(&(i / width)))
            .collect();
        let mut plane: Vec<f32> = (0..width * height)
            .map(|i| if known[i] { ramp(i) } else { 9.0 })
            .collect();
        fill_gaps(&mut plane, &known, width, height);
        for i in 0..plane.len() {
            let off = (plane[i] - ramp(i)).abs();
            assert!(if known[i] { off == 0.0 } else { off < 0.06 }, "{i}: {off}");
        }
    }
}
