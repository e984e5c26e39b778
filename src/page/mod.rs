//! Flat pages from one photo of a bent page and the traces of its edges.
//!
//! A page is a sheet of paper in space that a camera sees: a grid of points that keeps lengths, bends little, and meets the
//! edges and the lines of print of the photo. A page that is flat, curled in one direction, folded, crumpled or bent both ways
//! differs by its stiffness only: the plainest model that explains the photo is taken. (Nail Gumerov, Ali Zandifar, Ramani
//! Duraiswami, Larry Davis, *Structure of Applicable Surfaces from Single Views*, ECCV 2004, show that an outline nearly
//! determines a smooth sheet.)
//!
//! ```
//! use developable::dewarp::DewarpOptions;
//! use developable::page::{Edges, FocalLength, PageOptions, PageSurface, PageVerdict, Trace};
//! # fn main() -> developable::Result<()> {
//! // Seen from straight above, a page that rises in its middle: both edges bow outwards.
//! let bow = |y: f64, rise: f64| {
//!     let point = |i: usize| {
//!         let x = i as f64 / 8.0;
//!         [400.0 + 2400.0 * x, y + 4.0 * rise * x * (1.0 - x)]
//!     };
//!     Trace::Points((0..9).map(point).collect())
//! };
//! let edges = Edges::TopBottom {
//!     top: bow(500.0, -60.0),
//!     bottom: bow(1900.0, 60.0),
//! };
//! let options = PageOptions::default().focal_length(FocalLength::Pixels(2700.0));
//! let page = PageSurface::new(&[edges], &[], [3200, 2400], &options)?;
//! // Without a line of text nothing checks the bend.
//! assert_eq!(page.report().verdict, PageVerdict::Unchecked);
//! // The curve is longer than its chord, so the page is lower than it looks: 1400 by 2400.
//! let [width, height] = page.flat_size();
//! assert!(width == 1.0 && height < 0.58);
//! let map = page.warp_map(&DewarpOptions::default())?; // and `map.image(&photo)`
//! assert!(map.width() > 2400);
//! # Ok(())
//! # }
//! ```
//!
//! [`find_outline`] finds the edges in the photo, with a verdict: [`PageOutline::to_edges`] gives them in the form that
//! [`PageSurface::in_photo`] takes. [`trace_edges`] finds them between corners that are given. Lenses are assumed to have
//! no distortion.

mod best_path;
pub mod cleaning;
mod corners;
mod edges;
mod known_sizes;
mod options;
mod outline;
mod page_warp;
mod read_traces;
mod report;
mod robust_fit;
mod sheet;
mod surface;
mod text;
mod traced_line;
mod working_photo;

pub use crate::dewarp::PixelGrid;
pub use edges::{Edges, Trace};
pub use options::{FocalLength, Format, PageOptions, Ruler};
pub use outline::{
    OutlineReason, OutlineReport, OutlineVerdict, PageOutline, find_outline, trace_edges,
};
pub use page_warp::PageWarp;
pub use report::{PageDoubt, PageModel, PageReport, PageVerdict};
pub use surface::PageSurface;
