//! Photos of bent pages made flat: resampled along the [unrolled](mod@super::unroll) surface.
//!
//! A [`Registration`] says where in the photo the surface's points are: photo and heights were both
//! taken straight from above ([`Extent`]), a camera took the photo, or there are texture coordinates.
//! The flat image has
//! the sheet's true proportions, stays upright, and is transparent where there is no sheet. The
//! [`WarpMap`] is an output too: it carries coordinates from the flat image back to the photo.
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
//! let map = WarpMap::new(&sheet, Extent::of(&scan), [width, height], &options)?;
//! // A slope of 45° is √2 times as long as it looks: 39 pixels are 55, less a cell at the margins.
//! assert!((51..57).contains(&map.width()), "{}", map.width());
//! let flat = map.image(&photo)?; // RGBA bytes, row by row
//! assert_eq!(flat.len(), 4 * map.width() * map.height());
//! # Ok(())
//! # }
//! ```

mod crop;
mod extend;
mod grid;
mod local;
mod map;
mod photo;
mod raster;
mod registration;
mod trim;
mod turn;

use super::unroll::UnrollReport;
use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::{HeightImage, Heightfield};
use crate::lattice::hexagonal::Lattice;
use crate::math::lanes;
pub use grid::WarpGrid;
pub use map::WarpMap;
pub use photo::Photo;
pub use registration::Registration;

/// What of a flat image is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct DewarpOptions {
    /// Pixels of the flat image per unit of length. `None`: as many as the photo has.
    pub dots: Option<f64>,
    /// Cut off the margins: keep the largest upright rectangle that is all sheet. Default false.
    pub trim: bool,
}

impl DewarpOptions {
    /// These options with another resolution, in pixels per unit of length.
    pub fn dots(self, dots: f64) -> Self {
        DewarpOptions {
            dots: Some(dots),
            ..self
        }
    }

    /// These options with margins cut off, or not.
    pub fn trim(self, trim: bool) -> Self {
        DewarpOptions { trim, ..self }
    }
}

/// The part of the plane that a photo shows, in the surface's units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Lower left corner.
    pub min: [f64; 2],
    /// Upper right corner.
    pub max: [f64; 2],
}

impl Extent {
    /// That of the pixels of a height image: the photo shows the same, with as many pixels as it
    /// likes.
    pub fn of(image: &HeightImage) -> Self {
        let [width, height] = [image.width(), image.height()].map(|n| n as f64);
        Extent {
            min: [0.0, 0.0],
            max: [width * image.pixel_size(), height * image.pixel_size()],
        }
    }

    /// That of a lattice, from its vertices' least to its largest coordinates.
    pub fn of_lattice(field: &Heightfield) -> Self {
        let lattice = field.lattice();
        let [left, top] = lattice.origin();
        let shift = if lattice.rows() > 1 { 0.5 } else { 0.0 };
        Extent {
            min: [
                left - shift * lattice.spacing(),
                top - (lattice.rows() - 1) as f64 * lattice.row_spacing(),
            ],
            max: [left + (lattice.cols() - 1) as f64 * lattice.spacing(), top],
        }
    }

    /// Texture coordinates of each vertex of a lattice: its place in the photo, as shares from the
    /// left and from the bottom. What lies beside the photo has the place nearest to it.
    ///
    /// # Errors
    /// [`Error::Empty`] for an extent without area, [`Error::OutOfMemory`].
    pub fn uvs(&self, lattice: &Lattice) -> Result<Vec<[f32; 2]>> {
        let [width, height] = self.sides()?;
        let mut uvs = try_filled("texture coordinates", lattice.len(), [0.0; 2])?;
        for (i, uv) in uvs.iter_mut().enumerate() {
            let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
            let place = [(x - self.min[0]) / width, (y - self.min[1]) / height];
            *uv = place.map(|share| lanes::single(share.clamp(0.0, 1.0)));
        }
        Ok(uvs)
    }

    /// Width and height, of which there has to be some.
    pub(crate) fn sides(&self) -> Result<[f64; 2]> {
        let sides = [0, 1].map(|k| self.max[k] - self.min[k]);
        if sides.iter().all(|side| side.is_finite() && *side > 0.0) {
            Ok(sides)
        } else {
            Err(Error::Empty { what: "photo" })
        }
    }
}

/// Colours for vertices with texture coordinates, from the photo that these are about. Where it is
/// transparent they stay as they are, and so do vertices that are not `wanted`.
///
/// # Panics
/// If there are not as many colours as texture coordinates.
pub fn paint(
    colors: &mut [[f32; 3]],
    uvs: &[[f32; 2]],
    photo: &Photo<'_>,
    wanted: impl Fn(usize) -> bool,
) {
    assert_eq!(colors.len(), uvs.len());
    for (i, (color, uv)) in colors.iter_mut().zip(uvs).enumerate() {
        if let Some(found) = photo.color(*uv).filter(|_| wanted(i)) {
            *color = found;
        }
    }
}

/// Whether a flat image is to be trusted, in a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum Verdict {
    /// The page was flat to begin with, and faced the camera: the photo can be used as it is.
    Flat,
    /// The page was bent and is flat now, with lengths as on the page.
    Unrolled,
    /// The surface cannot be laid flat without stretching it, or its sheet lies on itself: some
    /// lengths are wrong.
    Stretched,
}

impl Verdict {
    /// From how a surface was unrolled: flat if the view from above is true to 0.2 % already;
    /// stretched from strains of 1 % on, or where the layout overlaps or is flipped.
    pub fn of(report: &UnrollReport) -> Self {
        /// Root mean squares of the strains.
        const FLAT: f64 = 0.002;
        const STRETCHED: f64 = 0.01;
        let sheet = report.distortion;
        if sheet.rms > STRETCHED || sheet.flipped > 0 || report.crossings > 0 {
            Verdict::Stretched
        } else if report.plan.rms < FLAT {
            Verdict::Flat
        } else {
            Verdict::Unrolled
        }
    }
}
