//! Files as bytes in memory: height images and photos, meshes, drawings, and pictures of an assembly.

#[cfg(feature = "patterns")]
pub mod assembly;
mod assumption;
#[cfg(any(feature = "formats", feature = "meshes", feature = "patterns"))]
mod buffer;
#[cfg(feature = "patterns")]
pub mod drawings;
#[cfg(any(feature = "formats", feature = "meshes", feature = "patterns"))]
mod failure;
#[cfg(any(feature = "meshes", feature = "patterns"))]
mod glb;
#[cfg(any(feature = "formats", feature = "meshes"))]
mod image_format;
#[cfg(feature = "formats")]
pub mod images;
#[cfg(any(feature = "formats", feature = "meshes"))]
mod kind;
#[cfg(any(feature = "formats", feature = "meshes"))]
mod mesh_format;
#[cfg(feature = "meshes")]
pub mod meshes;
#[cfg(any(feature = "formats", feature = "meshes"))]
mod number_type;
#[cfg(any(feature = "formats", feature = "patterns"))]
mod points;
#[cfg(any(feature = "formats", feature = "meshes"))]
mod signature;
#[cfg(any(feature = "formats", feature = "meshes"))]
mod table;
#[cfg(any(feature = "formats", feature = "meshes"))]
mod text;
mod unit;
#[cfg(feature = "formats")]
pub mod wavefront;

pub use assumption::Assumption;
pub use unit::Unit;
