//! Floating-point numbers of single or double precision, for kernels that are written for both.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A floating-point number, `f32` or `f64`, in kernels that run in both precisions; its default is 0.
pub(crate) trait Real:
    Copy
    + Send
    + Sync
    + std::fmt::Debug
    + 'static
    + Default
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The number ½.
    const HALF: Self;
    /// SIMD vector of four numbers, for loops that do not vectorise by themselves.
    type Four: Copy + Add<Output = Self::Four> + Mul<Output = Self::Four>;
    fn sqrt(self) -> Self;
    fn four(lanes: [Self; 4]) -> Self::Four;
    fn lanes(four: Self::Four) -> [Self; 4];
}

impl Real for f64 {
    const HALF: Self = 0.5;
    type Four = wide::f64x4;
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn four(lanes: [Self; 4]) -> Self::Four {
        lanes.into()
    }
    #[inline(always)]
    fn lanes(four: Self::Four) -> [Self; 4] {
        four.to_array()
    }
}

impl Real for f32 {
    const HALF: Self = 0.5;
    type Four = wide::f32x4;
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn four(lanes: [Self; 4]) -> Self::Four {
        lanes.into()
    }
    #[inline(always)]
    fn lanes(four: Self::Four) -> [Self; 4] {
        four.to_array()
    }
}

// `f64::max` treats NaN in a way that costs wasm several instructions; these are one each.
/// Returns the larger of two values; the second one if they cannot be compared.
#[inline(always)]
pub(crate) fn larger<T: PartialOrd>(a: T, b: T) -> T {
    if a > b { a } else { b }
}

/// Returns the smaller of two values; the second one if they cannot be compared.
#[inline(always)]
pub(crate) fn smaller<T: PartialOrd>(a: T, b: T) -> T {
    if a < b { a } else { b }
}
