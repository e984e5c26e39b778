//! Interpolation of a plane of values across gaps.

use crate::page::outline::{MAX_REDUCED_SIDE, box_mean};

/// Weight of the estimate by the next larger radius, relative to a window of known values.
const COARSE_WEIGHT: f32 = 0.02;

/// Replaces values of planes that are not known by weighted means of known values around them, over windows of several
/// sizes; leaves the planes as they are where nothing is known.
pub(super) fn fill_gaps(planes: &mut [Vec<f32>], known: &[bool], width: usize, height: usize) {
    let count = known.iter().filter(|known| **known).count();
    if count == 0 || count == known.len() {
        return;
    }
    let mean = |plane: &Vec<f32>| {
        let values = plane.iter().zip(known).filter(|(_, known)| **known);
        (values.map(|(value, _)| f64::from(*value)).sum::<f64>() / count as f64) as f32
    };
    let mut estimates: Vec<Vec<f32>> = planes.iter().map(|p| vec![mean(p); p.len()]).collect();
    // From half a page on, each a fourth of the one before.
    for radius in [2, 8, 32, 128].map(|part| MAX_REDUCED_SIDE / part) {
        let mut weights: Vec<f32> = known.iter().map(|known| f32::from(*known)).collect();
        box_mean(&mut weights, width, height, radius);
        for (plane, estimate) in planes.iter().zip(&mut estimates) {
            let mut values: Vec<f32> = (plane.iter().zip(known))
                .map(|(value, known)| if *known { *value } else { 0.0 })
                .collect();
            box_mean(&mut values, width, height, radius);
            for ((estimate, value), weight) in estimate.iter_mut().zip(&values).zip(&weights) {
                *estimate = (value + COARSE_WEIGHT * *estimate) / (weight + COARSE_WEIGHT);
            }
        }
    }
    for (plane, estimate) in planes.iter_mut().zip(estimates) {
        for ((value, known), estimate) in plane.iter_mut().zip(known).zip(estimate) {
            if !known {
                *value = estimate;
            }
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
        let plane: Vec<f32> = (0..width * height)
            .map(|i| if known[i] { ramp(i) } else { 9.0 })
            .collect();
        let negated: Vec<f32> = plane.iter().map(|value| -value).collect();
        let mut planes = [plane, negated];
        fill_gaps(&mut planes, &known, width, height);
        let [plane, negated] = planes;
        assert!(
            plane
                .iter()
                .zip(&negated)
                .all(|(one, other)| *one == -other)
        );
        for i in 0..plane.len() {
            let off = (plane[i] - ramp(i)).abs();
            assert!(if known[i] { off == 0.0 } else { off < 0.06 }, "{i}: {off}");
        }
    }
}
