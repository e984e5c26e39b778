//! Flat pages from one photo of a curled page and the traces of its bent edges.
//!
//! A page that is curled one way (a book's page, a letter that was rolled up) is a cylinder over some curve: its
//! rulings are straight, parallel, and normal to the two edges that are bent. So one photo in which these edges are
//! traced, with the page's corners at their ends, determines the surface: the corners are those of a plane rectangle,
//! which gives the rulings' direction, and each traced point is the intersection of its line of sight with the plane of
//! its edge. (Huaigu Cao, Xiaoqing Ding, Changsong Liu, *A Cylindrical Surface Model to Rectify the Bound Document
//! Image*, ICCV 2003, have the same model; they derive the bend from lines of text.) The closed form is the initial
//! guess of the least-squares cylinder of both edges, the corners and prior knowledge; its residuals give the verdict.
//!
//! ```
//! use developable::dewarp::DewarpOptions;
//! use developable::page::{CurledPage, Edges, FocalLength, PageOptions, PageVerdict, Trace};
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
//! let page = CurledPage::new(&[edges], [3200, 2400], &options)?;
//! assert_eq!(page.report().verdict, PageVerdict::Unrolled);
//! assert!(page.report().pinhole_error_bound < 0.3); // % of the page's width
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
//! [`CurledPage::in_photo`] takes.
//!
//! Limits of two edges: an edge whose plane passes near the camera appears straight however the
//! page is bent, so that nothing checks the other edge ([`PageVerdict::Unchecked`]). A page with a
//! slight fold, which both edges fit nearly as well as a curve, is recognised by its known
//! format, by lines of text ([`CurledPage::in_photo`] finds them, [`CurledPage::with_lines`] is given them) or by its
//! straight edges ([`Edges::All`]).
//! Lenses are assumed to have no distortion.
//!
//! A page that is folded, crumpled or bent both ways is no cylinder. [`SheetPage`] finds it by its four edges and the
//! lines of print between them as an isometric sheet that bends little; [`PageSurface`] takes the plainest model that
//! explains them.

pub mod cleaning;
mod closed_form;
mod corners;
mod cross_sections;
mod curled_page;
mod cylinder;
mod edges;
mod error_estimate;
mod in_photo;
mod known_sizes;
mod options;
mod outline;
mod output;
mod page_warp;
mod pixel_grid;
mod prior;
mod read_traces;
mod report;
mod residual_statistics;
mod robust_fit;
mod search;
mod sheet;
mod surface;
mod text;
mod traced_line;
mod traces;
mod working_photo;

pub use curled_page::CurledPage;
pub use edges::{Edges, Trace};
pub use options::{FocalLength, Format, PageOptions, Ruler};
pub use outline::{OutlineReason, OutlineReport, OutlineVerdict, PageOutline, find_outline};
pub use page_warp::PageWarp;
pub use pixel_grid::PixelGrid;
pub use report::{PageDoubt, PageModel, PageReport, PageVerdict};
pub use sheet::SheetPage;
pub use surface::PageSurface;
