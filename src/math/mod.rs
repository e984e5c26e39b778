//! Small numerics that know nothing of lattices: symmetric 2×2 matrices in closed form, two
//! precisions, sums in lanes, polygons, disjoint sets, a hash for numbers.

pub(crate) mod axes;
pub(crate) mod forest;
pub(crate) mod hash;
pub(crate) mod lanes;
pub(crate) mod polygon;
pub(crate) mod real;
pub(crate) mod sym2;
