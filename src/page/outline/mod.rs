//! Detection of pages in a photo: their corners and edges, with a verdict.
//!
//! The photo is reduced to 800 pixels and its print suppressed by a grey closing. Thresholds of lightness and colour,
//! and histograms of page and ground, give masks; each of their regions has four corners, the largest quadrilateral of
//! its convex hull. The regions most like a page get exact edges, each the path of most contrast in a band along the
//! border (Viterbi), and corners where these edges meet, or would where a corner is covered. Where no region has a clear outline,
//! regions are taken of the photo as it is, in which paper is wider than the pattern of the ground; and where these have none either,
//! the page is searched around its print: in a frame that is turned like the lines of print each edge is a path that stands
//! out from the texture around it (Viterbi again), smooth or not, whichever is seen better. What that gives is never more than doubtful.

mod candidates;
mod colour_model;
mod corner_edges;
mod corners;
mod covered;
mod edge_path;
mod morphology;
mod orientation;
mod outline_report;
mod planes;
mod print;
mod print_frame;
mod quadrilateral;
mod region;
mod search;
mod smooth_curve;
mod tracing;
mod views;

pub use corner_edges::trace_edges;
pub(super) use edge_path::MIN_EDGE_CONTRAST;
pub(super) use morphology::{box_mean, closed, closed_plane, square_extreme, vertical_extreme};
pub use outline_report::{OutlineReason, OutlineReport, OutlineVerdict, PageOutline};
pub(super) use planes::{LOG_OFFSET, MAX_REDUCED_SIDE, Planes};
pub(super) use region::flood;
pub use search::find_outline;
