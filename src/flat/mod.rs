//! The surface laid flat: unrolled, with its photo, or cut along its creases into sheets.

pub mod assembly;
pub mod dewarp;
pub mod drawing;
pub mod explore;
pub mod page;
pub mod pattern;
pub mod unroll;
