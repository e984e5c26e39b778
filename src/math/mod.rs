//! Small numerics that know nothing of lattices: symmetric 2×2 matrices in closed form, two
//! precisions, sums in lanes, polygons, disjoint sets.

pub(crate) mod forest;
pub(crate) mod lanes;
pub(crate) mod polygon;
pub(crate) mod real;
pub(crate) mod sym2;
