//! What a surface is like: its curvatures, its creases and patches, its rulings.

pub mod analysis;
pub mod patches;
pub mod rulings;
