//! Extent of a photo taken from straight above: the rectangle of the plane that it shows.

use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::{HeightImage, Heightfield};
use crate::lattice::hexagonal::Lattice;
use crate::math::lanes;

/// The rectangle of the plane that a photo from straight above shows, in the surface's units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Lower left corner of the rectangle, in the surface's units.
    pub min: [f64; 2],
    /// Upper right corner of the rectangle, in the surface's units.
    pub max: [f64; 2],
}

impl Extent {
    /// Returns the extent of a height image, for a photo that shows the same area. The photo may have another number of
    /// pixels.
    pub fn from_image(image: &HeightImage) -> Self {
        let [width, height] = [image.width(), image.height()].map(|n| n as f64);
        Extent {
            min: [0.0, 0.0],
            max: [width * image.pixel_size(), height * image.pixel_size()],
        }
    }

    /// Returns the extent of a heightfield's vertices, for a photo that shows the same area.
    pub fn from_heightfield(field: &Heightfield) -> Self {
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

    /// Computes texture coordinates of each vertex of a lattice: its place in the photo, in shares of the width from
    /// the left and of the height from the bottom. Vertices outside of the extent get the nearest place in it.
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

    /// Width and height of the extent, in the surface's units.
    ///
    /// # Errors
    /// [`Error::Empty`] without an area.
    pub(crate) fn sides(&self) -> Result<[f64; 2]> {
        let sides = [0, 1].map(|k| self.max[k] - self.min[k]);
        if sides.iter().all(|side| side.is_finite() && *side > 0.0) {
            Ok(sides)
        } else {
            Err(Error::Empty { what: "photo" })
        }
    }
}
