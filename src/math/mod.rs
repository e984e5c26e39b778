//! Numerics that know nothing of lattices and surfaces: symmetric 2×2 and 3×3 matrices, least squares, planar
//! geometry, medians, disjoint sets, and sums in single and double precision.

pub(crate) mod bordered;
pub(crate) mod fork;
pub(crate) mod index;
pub(crate) mod lanes;
pub(crate) mod least_squares;
pub(crate) mod motion;
pub(crate) mod planar;
pub(crate) mod polygon;
pub(crate) mod real;
pub(crate) mod simplify;
pub(crate) mod statistics;
pub(crate) mod sym2;
pub(crate) mod symmetric_eigen;
pub(crate) mod union_find;
