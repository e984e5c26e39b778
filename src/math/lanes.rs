//! Sums of slices, and conversions between precisions, that vectorise: additions run in a fixed number of lanes, so
//! that the result depends neither on the machine nor on its vector width.
//!
//! They take slices, not closures: a closure that is called in a loop and again for its tail is not inlined,
//! and costs ten times the sum.

/// Number of partial sums that are kept side by side when 64-bit values are added.
const F64_LANES: usize = 8;

/// Number of partial sums that are kept side by side when 32-bit values are added.
const F32_LANES: usize = 16;

/// Returns the sum `Σ a` of a slice.
pub(crate) fn sum(a: &[f64]) -> f64 {
    let mut lanes = [0.0; F64_LANES];
    let chunks = a.chunks_exact(F64_LANES);
    let tail = chunks.remainder();
    for chunk in chunks {
        for (lane, x) in lanes.iter_mut().zip(chunk) {
            *lane += x;
        }
    }
    for (lane, x) in lanes.iter_mut().zip(tail) {
        *lane += x;
    }
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

/// Returns the inner product `Σ a b` of two slices: products and partial sums in single precision, their total in
/// double.
pub(crate) fn dot(a: &[f32], b: &[f32]) -> f64 {
    let mut lanes = [0.0f32; F32_LANES];
    let (a, b) = (a.chunks_exact(F32_LANES), b.chunks_exact(F32_LANES));
    let tail = a.remainder().iter().zip(b.remainder());
    for (a, b) in a.zip(b) {
        for (lane, (x, y)) in lanes.iter_mut().zip(a.iter().zip(b)) {
            *lane += x * y;
        }
    }
    for (lane, (x, y)) in lanes.iter_mut().zip(tail) {
        *lane += x * y;
    }
    lanes.iter().map(|lane| f64::from(*lane)).sum()
}

/// Returns the weighted sum of squares `Σ a² m` of a slice `a` with weights `m`: partial sums in single precision,
/// their total in double.
pub(crate) fn weighted_square(a: &[f32], m: &[f32]) -> f64 {
    let mut lanes = [0.0f32; F32_LANES];
    let (a, m) = (a.chunks_exact(F32_LANES), m.chunks_exact(F32_LANES));
    let tail = a.remainder().iter().zip(m.remainder());
    for (a, m) in a.zip(m) {
        for (lane, (x, w)) in lanes.iter_mut().zip(a.iter().zip(m)) {
            *lane += x * x * w;
        }
    }
    for (lane, (x, w)) in lanes.iter_mut().zip(tail) {
        *lane += x * x * w;
    }
    lanes.iter().map(|lane| f64::from(*lane)).sum()
}

/// Converts a slice of `f64` to `f32`. This function and [`widen`] are loops of their own: V8's optimising compiler
/// (Node 20) miscompiles some vectorised conversions within larger loops. No other loop over cells may convert, except
/// by [`single`] and [`double`].
#[inline(never)]
pub(crate) fn narrow(from: &[f64], to: &mut [f32]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from as f32;
    }
}

/// Converts a slice of `f32` to `f64`.
#[inline(never)]
pub(crate) fn widen(from: &[f32], to: &mut [f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = f64::from(*from);
    }
}

/// Converts one `f64` to `f32`, where speed does not matter: never inlined, so that the loop around the call is not
/// vectorised.
#[inline(never)]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}

/// Converts one `f32` to `f64`, where speed does not matter: never inlined, so that the loop around the call is not
/// vectorised.
#[inline(never)]
pub(crate) fn double(value: f32) -> f64 {
    f64::from(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_term_once() {
        for n in [0usize, 1, 7, 8, 9, 16, 29, 33] {
            let double: Vec<f64> = (0..n).map(|i| i as f64).collect();
            let single: Vec<f32> = (0..n).map(|i| i as f32).collect();
            let twos = vec![2.0f32; n];
            let first = n * n.saturating_sub(1) / 2;
            let second: usize = (0..n).map(|i| i * i).sum();
            assert_eq!(sum(&double), first as f64);
            assert_eq!(dot(&single, &twos), 2.0 * first as f64);
            assert_eq!(weighted_square(&single, &twos), 2.0 * second as f64);
        }
    }

    #[test]
    fn precision_changes_for_every_value() {
        for n in [0usize, 1, 3, 4, 9, 31] {
            let single: Vec<f32> = (0..n).map(|i| 0.1 * i as f32).collect();
            let mut double = vec![f64::NAN; n];
            widen(&single, &mut double);
            assert!(double.iter().zip(&single).all(|(d, s)| *d == f64::from(*s)));
            // Less than half of the last place away.
            let nearby: Vec<f64> = double.iter().map(|d| d * (1.0 + 1e-9)).collect();
            let mut back = vec![f32::NAN; n];
            narrow(&nearby, &mut back);
            assert_eq!(back, single);
        }
    }
}
