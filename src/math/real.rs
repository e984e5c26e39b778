//! Double precision, or single where that will do.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// What the row kernels need of a number; its default is 0.
pub(crate) trait Real:
    Copy
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
    const HALF: Self;
    fn sqrt(self) -> Self;
}

impl Real for f64 {
    const HALF: Self = 0.5;
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

impl Real for f32 {
    const HALF: Self = 0.5;
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

// `f64::max` treats NaN in a way that costs wasm several instructions; these are one each.
#[inline(always)]
pub(crate) fn larger<T: PartialOrd>(a: T, b: T) -> T {
    if a > b { a } else { b }
}

#[inline(always)]
pub(crate) fn smaller<T: PartialOrd>(a: T, b: T) -> T {
    if a < b { a } else { b }
}
