//! The outline of a page in a photo: its corners and its edges, found without any mark by the user.

mod candidates;
mod colour_model;
mod corners;
mod edge_path;
mod morphology;
mod orientation;
mod outline;
mod planes;
mod quadrilateral;
mod region;
mod search;
mod straight_lines;
mod tracing;

pub use outline::{OutlineReason, OutlineReport, OutlineVerdict, PageOutline};
pub use search::find_outline;
