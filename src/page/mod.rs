//! Flat pages from one photo and the traces of their bent edges.
//!
//! A page that is curled one way (a book's page, a letter that was rolled up) is a cylinder over
//! some curve: its rulings are straight, parallel, and normal to the two edges that are bent. Then
//! one photo in which these edges are traced, with the page's corners at their ends, tells the whole
//! surface: the corners are those of a plane rectangle, which gives the rulings' direction, and each
//! traced point is where its ray meets the plane of its edge. (Huaigu Cao, Xiaoqing Ding, Changsong
//! Liu, *A Cylindrical Surface Model to Rectify the Bound Document Image*, ICCV 2003, have the same
//! model; they derive the bend from lines of text.) From this closed form the least-squares
//! cylinder is found by which both edges, the corners and what else is known are met best; what is
//! left says how good it is.
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
//! assert!(page.report().error_bound < 0.3); // % of the page's width
//! // The curve is longer than its chord, so the page is lower than it looks: 1400 by 2400.
//! let [width, height] = page.flat_size();
//! assert!(width == 1.0 && height < 0.58);
//! let map = page.warp_map(&DewarpOptions::default())?; // and `map.image(&photo)`
//! assert!(map.width() > 2400);
//! # Ok(())
//! # }
//! ```
//!
//! What two edges cannot tell: an edge whose plane passes near the camera looks straight however the
//! page is bent, and then nothing checks the other edge ([`PageVerdict::Unchecked`]). A page with a
//! slight fold that both edges explain nearly as well by a curve is told from one by its known
//! format, by lines of text ([`CurledPage::in_photo`] finds them, [`CurledPage::with_lines`] is given them) or by its
//! straight edges ([`Edges::All`]).
//! Lenses are taken to be free of distortion.

mod corners;
mod cross;
mod cylinder;
mod estimate;
mod find;
mod known;
mod misfit;
mod output;
mod photo;
mod prior;
mod report;
mod solve;
mod start;
mod text;
mod trace;

pub use find::CurledPage;
pub use report::{PageReport, PageVerdict};

/// An edge as it was traced in a photo, from one corner of the page to the next, in the photo's
/// pixels: `[0, 0]` is the centre of the upper left one.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Trace {
    /// Points on the edge, as many as there are, at any distances; the first and the last one are
    /// corners. Between them the edge is smooth, not straight.
    Points(Vec<[f64; 2]>),
    /// Cubic Bézier curves that follow each other: 4, 7, 10 … control points.
    Beziers(Vec<[f64; 2]>),
}

/// The edges of a page: the two that are bent, or all. Each is listed from left to right, or from top to bottom; if all
/// are the other way round that is seen and mended.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Edges {
    /// Of a page whose rulings run from top to bottom, as a book's.
    TopBottom {
        /// The upper edge as one reads.
        top: Trace,
        /// The lower one.
        bottom: Trace,
    },
    /// Of a page whose rulings run from left to right.
    LeftRight {
        /// The left edge as one reads.
        left: Trace,
        /// The right one.
        right: Trace,
    },
    /// All four, of which two are bent and the other two straight: which ones is seen. The straight
    /// ones check the page: a letter that is folded along two of its edges shows it by the others.
    All {
        /// The upper edge as one reads.
        top: Trace,
        /// The lower one.
        bottom: Trace,
        /// The left one.
        left: Trace,
        /// The right one.
        right: Trace,
    },
}

/// What is known of the camera's focal length.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum FocalLength {
    /// Nothing: it is found from the perspective, if that is strong enough.
    #[default]
    Unknown,
    /// In pixels of the photo.
    Pixels(f64),
    /// As the angle, in degrees, that the photo's longer side covers.
    FieldOfView(f64),
    /// In millimetres, as for a film of 36 by 24 mm with the same diagonal angle: Exif's
    /// `FocalLengthIn35mmFilm`. Such numbers are taken to be right to 2 %.
    Film35(f64),
}

/// What is known of a page's size.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Format {
    /// Nothing: the page's width is the unit of length.
    #[default]
    Unknown,
    /// 210 by 297 mm, upright or across, whichever is nearer to what is seen.
    A4,
    /// 8.5 by 11 inches, likewise.
    Letter,
    /// Width and height of a page, in millimetres.
    Millimetres([f64; 2]),
    /// Height over width; the page's width is the unit of length.
    Ratio(f64),
}

/// A known distance on the flat page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ruler {
    /// Where it begins in the photo, in pixels.
    pub from: [f64; 2],
    /// Where it ends.
    pub to: [f64; 2],
    /// Its length, in millimetres.
    pub length: f64,
}

/// What is known besides the edges.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct PageOptions {
    /// The camera's focal length. Default: unknown.
    pub focal_length: FocalLength,
    /// The page's format; of a spread that of each of its pages. Default: unknown.
    pub format: Format,
    /// A known length on the page, where its format is not known in millimetres.
    pub ruler: Option<Ruler>,
    /// The principal point, in pixels; of a photo that was cropped, the middle of the whole one.
    /// Default: the photo's middle, right to 0.4 % of the diagonal.
    pub centre: Option<[f64; 2]>,
    /// How near to the edge traced points are meant to lie, as a standard deviation in pixels; the
    /// points' own scatter corrects it. Default: 1/2500 of the photo's diagonal, 2 pixels of a
    /// 12-megapixel photo.
    pub accuracy: Option<f64>,
}

impl PageOptions {
    /// These options with another focal length.
    pub fn focal_length(self, focal_length: FocalLength) -> Self {
        PageOptions {
            focal_length,
            ..self
        }
    }

    /// These options with another format.
    pub fn format(self, format: Format) -> Self {
        PageOptions { format, ..self }
    }

    /// These options with a ruler.
    pub fn ruler(self, ruler: Ruler) -> Self {
        PageOptions {
            ruler: Some(ruler),
            ..self
        }
    }

    /// These options with another principal point.
    pub fn centre(self, centre: [f64; 2]) -> Self {
        PageOptions {
            centre: Some(centre),
            ..self
        }
    }

    /// These options with another accuracy.
    pub fn accuracy(self, accuracy: f64) -> Self {
        PageOptions {
            accuracy: Some(accuracy),
            ..self
        }
    }
}
