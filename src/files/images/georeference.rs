//! Georeferences of GeoTIFF files: where the pixels of an image lie on a map.

use super::square_pixels::resampled;
use crate::error::Result;
use crate::heights::heightfield::HeightImage;

/// Number of the key `GTRasterTypeGeoKey` of the GeoTIFF format, which tells what of a pixel has the coordinates.
const RASTER_TYPE_KEY: u16 = 1025;

/// Value of the key `GTRasterTypeGeoKey` of the GeoTIFF format for the middles of pixels.
const RASTER_TYPE_POINT: u16 = 2;

/// Where the pixels of an image lie on a map. It is read from a GeoTIFF and written to one unchanged, but for the rows
/// that were reversed.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Georeference {
    /// Affine transformation `[a, b, c, d, e, f]` from the column `i` and the row `j` of a pixel's upper left corner (of its
    /// middle, if the keys say so) to map coordinates: `x = a·i + b·j + c`, `y = d·i + e·j + f`, in the unit of the coordinate system.
    pub transformation: [f64; 6],
    /// Numbers of the tag `GeoKeyDirectory`, which names the coordinate system; empty if there is none.
    pub keys: Vec<u16>,
    /// Numbers of the tag `GeoDoubleParams`, to which keys refer.
    pub doubles: Vec<f64>,
    /// Text of the tag `GeoAsciiParams`, to which keys refer.
    pub text: String,
    /// Columns and rows of the file's own pixels, which the transformation is about, if the image was made of square ones; files of
    /// its surface are written on them.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Option::is_none")
    )]
    pub size: Option<[usize; 2]>,
}

impl Georeference {
    /// Whether a coordinate system is named: without one nothing is known of the unit.
    pub(super) fn has_system(&self) -> bool {
        !self.keys.is_empty()
    }

    /// Value of a GeoTIFF key that is stored in the directory itself.
    pub(super) fn key(&self, wanted: u16) -> Option<u16> {
        // Four numbers each: key, where its value is (0: here), how many there are, the value.
        (self.keys.chunks_exact(4).skip(1))
            .find(|entry| entry[0] == wanted && entry[1] == 0)
            .map(|entry| entry[3])
    }

    /// Whether the transformation is about the middles of pixels, not their upper left corners.
    pub(super) fn is_point(&self) -> bool {
        self.key(RASTER_TYPE_KEY) == Some(RASTER_TYPE_POINT)
    }

    /// Makes pixels wider and higher by these factors, and leaves the first one where it is.
    pub(super) fn scale_pixels(&mut self, [across, down]: [f64; 2]) {
        let [a, b, _, d, e, _] = &mut self.transformation;
        (*a, *d) = (*a * across, *d * across);
        (*b, *e) = (*b * down, *e * down);
    }
}

/// Interpolates an image on square pixels at the [own pixels](Georeference::size) of the file that its map comes from; `None` where
/// these are the same.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn on_own_pixels(
    map: Option<&Georeference>,
    image: &HeightImage,
) -> Result<Option<HeightImage>> {
    let size = (image.width(), image.height());
    let own = map
        .and_then(|map| map.size)
        .map(|[width, height]| (width, height));
    let Some(own) = own.filter(|own| *own != size) else {
        return Ok(None);
    };
    let values = resampled(image.values(), size, own)?;
    Ok(Some(HeightImage::new(own.0, own.1, values)?))
}
