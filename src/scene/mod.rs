//! Meshes, point clouds, depth images and cameras, and the views in which these become heightfields.

pub(crate) mod camera;
pub(crate) mod decimation;
mod depth;
pub(crate) mod exactness;
pub(crate) mod facets;
mod footprint;
pub(crate) mod half_edges;
mod hidden;
pub(crate) mod mesh;
mod parts;
pub(crate) mod polyhedron;
pub(crate) mod quarter;
pub(crate) mod region;
pub(crate) mod region_graph;
pub(crate) mod sampling;
mod splats;
pub(crate) mod triangulation;
pub(crate) mod view;
