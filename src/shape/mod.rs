//! Properties of a surface: curvatures, creases and patches, rulings.

pub mod analysis;
pub mod patches;
pub mod rulings;
