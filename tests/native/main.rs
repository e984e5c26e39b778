//! The library as its users see it: by what is public.

pub(crate) mod common;

#[path = "../fixtures/case.rs"]
mod case;
#[path = "../fixtures/check.rs"]
mod check;

#[cfg(feature = "patterns")]
mod cad;
mod camera;
mod cleaning;
mod clouds;
mod confidence;
mod cylinder;
mod defaults;
mod design;
mod dewarp;
#[cfg(feature = "patterns")]
mod drawing;
mod dropouts;
mod energies;
#[cfg(feature = "patterns")]
mod exact;
mod examples;
mod explore;
mod fixtures;
#[cfg(feature = "formats")]
mod formats;
mod honesty;
mod huber;
#[cfg(feature = "images")]
mod images;
mod invariance;
mod irregular;
mod mesh_crossings;
#[cfg(feature = "meshes")]
mod mesh_files;
#[cfg(feature = "meshes")]
mod meshes;
mod noise;
mod occlusions;
mod optimum;
mod page;
mod parts;
mod patches;
mod pattern;
mod polyhedra;
mod rank;
mod recovery;
mod registration;
mod resample;
mod reweighting;
mod rulings;
mod sampling;
mod steps;
#[cfg(all(feature = "formats", feature = "meshes"))]
mod surfaces;
#[cfg(feature = "images")]
mod text_grids;
#[cfg(all(feature = "formats", feature = "meshes"))]
mod textures;
#[cfg(feature = "threads")]
mod threads;
#[cfg(feature = "images")]
mod tiffs;
mod unroll;
mod warm;
mod whole;
