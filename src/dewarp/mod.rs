//! Dewarping: photos of bent pages made flat by the [unrolled](mod@super::unroll) surface.
//!
//! The photo can be registered to the surface in three ways ([`Registration`]): photo and heights were both
//! taken straight from above ([`Extent`]), a camera took the photo, or there are texture coordinates.
//! The flat image has
//! the sheet's true proportions, is upright, and is transparent where there is no sheet. The
//! [`WarpMap`] is an output too: it maps each pixel of the flat image to its place in the photo.
//!
//! ```
//! use developable::dewarp::{DewarpOptions, Extent, Photo, WarpMap};
//! use developable::unroll::{UnrollOptions, unroll};
//! use developable::{HeightImage, dewarp};
//! # fn main() -> developable::Result<()> {
//! // A page of 40 by 30 pixels that rises to the right, and a photo of it.
//! let (width, height) = (40, 30);
//! let scan = HeightImage::new(width, height, (0..1200).map(|i| (i % 40) as f64).collect())?;
//! let rgba: Vec<u8> = (0..1200).flat_map(|i| [6 * (i % 40) as u8, 0, 0, 255]).collect();
//! let photo = Photo::new(width, height, &rgba)?;
//!
//! let sheet = unroll(&scan.to_lattice(None)?, &UnrollOptions::default())?;
//! let options = DewarpOptions::default().trim(true);
//! let map = WarpMap::new(&sheet, Extent::from_image(&scan), [width, height], &options)?;
//! // A slope of 45° is √2 times as long as it looks: 39 pixels are 55, less a cell at the margins.
//! assert!((51..57).contains(&map.width()), "{}", map.width());
//! let flat = map.image(&photo)?; // RGBA bytes, row by row
//! assert_eq!(flat.len(), 4 * map.width() * map.height());
//! # Ok(())
//! # }
//! ```

mod bilinear;
mod box_reduction;
mod charts;
mod continuation;
mod crop;
mod deskew;
mod extent;
mod largest_rectangle;
mod local_quadratic;
mod options;
mod photo;
mod pixel_grid;
mod raster;
mod registration;
mod verdict;
mod warp_grid;
mod warp_map;

pub(crate) use bilinear::bilinear;
pub use box_reduction::BoxReduction;
pub use extent::Extent;
pub use options::DewarpOptions;
pub use photo::{Photo, paint};
pub use pixel_grid::PixelGrid;
pub use registration::Registration;
pub use verdict::Verdict;
pub use warp_grid::WarpGrid;
pub use warp_map::WarpMap;
