//! The result of decoding an image: the stored pixel values, and how they become heights.

use super::decode_options::DecodeOptions;
use super::depths::{self, DepthEvidence};
use super::georeference::Georeference;
use super::no_data;
use super::scale::{SUGGESTED_RELIEF_SHARE, are_measured, assumed_levels, assumed_pixel_size};
use super::square_pixels::{NEGLIGIBLE_SIDE_DIFFERENCE, square_pixels};
use crate::error::{Result, positive};
use crate::files::assumption::rounded;
use crate::files::image_format::Format;
use crate::files::number_type::NumberType;
use crate::files::{Assumption, Unit};
use crate::heights::heightfield::HeightImage;

/// A decoded image file: its stored values, and the scale that converts these to heights.
///
/// `height = values · height_scale`, in the unit of `pixel_size`.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Decoded {
    /// Format of the image file.
    pub format: Format,
    /// Number of pixel columns of the image.
    pub width: usize,
    /// Number of pixel rows of the image.
    pub height: usize,
    /// The pixel values as stored in the file (grey levels, numbers), row by row, top row first; NaN where there is no
    /// data. A PNG's recorded offset is contained, as `offset / height_scale`. Integers beyond 2⁵³ are rounded.
    pub values: Vec<f64>,
    /// Side length of a pixel in `unit`, or in an unknown unit: as recorded by [`write_image`](super::write_image) and the
    /// like, or by a TIFF's resolution or GeoTIFF scale; else 1, unless that makes a slab or a needle of the heights, which is
    /// one of the assumptions.
    pub pixel_size: f64,
    /// The unit of `pixel_size`: millimetres if a TIFF has a resolution, metres if it lies on a map.
    pub unit: Option<Unit>,
    /// Factor from the stored values to heights: `height = values · height_scale`. For NPY, NPZ and numbers that are no levels it is
    /// 1, or the scale that a PFM states; for PNG as recorded by [`write_image`](super::write_image); for a GeoTIFF as its tags say, else
    /// metres. For the levels of other pictures, of 8 or 16 bits, it is a suggestion, which is one of the assumptions: the one that makes their
    /// full range (from black to white) a quarter of the image's longer side.
    pub height_scale: f64,
    /// Type of number that the file stores for each pixel: `"u8"`, `"u16"`, `"f32"`, `"f64"`, …
    pub data_type: &'static str,
    /// Whether the values are depths of a camera.
    pub depths: DepthEvidence,
    /// Unit that the values have if they are depths of a camera: millimetres for integers and large floats, else metres.
    pub depth_unit: Unit,
    /// Where the pixels lie on a map, if the file says it.
    pub georeference: Option<Georeference>,
    /// What the reader assumed because the file does not say it.
    pub assumptions: Vec<Assumption>,
}

impl Decoded {
    /// Converts the stored values to heights by `height_scale`, and returns them as a height image.
    ///
    /// # Errors
    /// As [`HeightImage::new`], so [`Error::NotFinite`](crate::Error::NotFinite) if a value is infinite.
    pub fn into_image(self) -> Result<HeightImage> {
        HeightImage::new(self.width, self.height, self.values)?
            .with_pixel_size(self.pixel_size)?
            .scaled(self.height_scale)
    }
}

/// Contents of an image file as its reader found them, before anything is assumed.
#[derive(Debug)]
pub(super) struct StoredImage {
    /// Columns and rows.
    pub(super) size: (usize, usize),
    /// The pixel values, row by row, top row first; NaN where the file says that there is no data.
    pub(super) values: Vec<f64>,
    pub(super) number_type: NumberType,
    /// Value of no data, if the file names one.
    pub(super) no_data: Option<f64>,
    /// Width and height of a pixel in `unit`, if the file says them.
    pub(super) sides: Option<[f64; 2]>,
    /// Height of a pixel divided by its width, where the file says only that.
    pub(super) aspect: f64,
    pub(super) unit: Option<Unit>,
    /// Scale of `height = scale · value + offset`, if the file says it.
    pub(super) height_scale: Option<f64>,
    /// Offset of `height = scale · value + offset`.
    pub(super) offset: f64,
    pub(super) georeference: Option<Georeference>,
    pub(super) assumptions: Vec<Assumption>,
}

impl StoredImage {
    /// Creates an image of numbers of which the file says neither unit nor size.
    pub(super) fn new(size: (usize, usize), values: Vec<f64>, number_type: NumberType) -> Self {
        StoredImage {
            size,
            values,
            number_type,
            no_data: None,
            sides: None,
            aspect: 1.0,
            unit: None,
            height_scale: None,
            offset: 0.0,
            georeference: None,
            assumptions: Vec::new(),
        }
    }

    /// Decides what the file does not say, in the order in which one depends on the other: which values are no data, square
    /// pixels, the height of levels and the size of pixels. Each is one of the assumptions. Costs `O(pixels)`.
    ///
    /// # Errors
    /// [`Error::Option`] for a size of pixels that is not positive and finite, [`Error::OutOfMemory`].
    pub(super) fn finish(mut self, format: Format, options: &DecodeOptions) -> Result<Decoded> {
        let mut assumptions = self.assumptions;
        // What is no data was measured, too.
        let are_measured = are_measured(&self.values);
        for missing in self.no_data.into_iter().chain(options.no_data) {
            no_data::remove(&mut self.values, missing, self.number_type);
        }
        if options.assume_no_data {
            assumptions.extend(no_data::assume_no_data(
                &mut self.values,
                self.no_data.is_some(),
            ));
        }
        // COLMAP writes nothing but depths, whose unit no file says: taken for metres. On a map, there are heights.
        let are_depths = format == Format::Colmap;
        let depth_unit = match are_depths {
            true => Unit::Metre,
            false => depths::unit(&self.values, self.number_type),
        };
        let is_on_map = (self.georeference.as_ref()).is_some_and(Georeference::has_system);
        let depths = match is_on_map {
            true => DepthEvidence::None,
            false if are_depths => DepthEvidence::Certain,
            false => depths::evidence(
                &self.values,
                self.size.0,
                self.number_type,
                depth_unit,
                &options.name,
            ),
        };
        if depths == DepthEvidence::Certain && options.assume_no_data {
            assumptions.extend(depths::without_missing(&mut self.values, depth_unit));
        }
        if let Some(side) = options
            .pixel_size
            .map(|side| positive("pixel_size", side))
            .transpose()?
        {
            if let Some([x, y]) = self
                .sides
                .filter(|sides| differ([sides[0], side]) || differ([sides[1], side]))
            {
                let words = format!(
                    "pixels are {side} wide, which was given, and not {x} × {y}, which the file says"
                );
                assumptions.push(Assumption::new("givenPixelSize", words, None));
            }
            assumptions.retain(|one| one.option != Some("pixelSize"));
            self.sides = Some([side; 2]);
            self.unit = self.unit.filter(|_| is_on_map);
        }
        // Of pixels of unknown size, the longer side is 1.
        let of_unknown_size = [1.0, self.aspect].map(|side| side / self.aspect.max(1.0));
        let [x, y] = self.sides.unwrap_or(of_unknown_size);
        let square = square_pixels(self.values, self.size, [x, y])?;
        if differ([x, y]) {
            let how = match square.size == self.size {
                true => "taken for",
                false => "resampled to",
            };
            let [x, y, side] = [x, y, square.side].map(|side| rounded(side, 6));
            let words = format!("pixels of {x} × {y} are {how} squares of {side}");
            assumptions.push(Assumption::new("squarePixels", words, "pixelSize"));
            if let Some(map) = &mut self.georeference {
                map.size = Some([self.size.0, self.size.1]);
            }
        }
        let ((width, height), mut pixel_size) = (square.size, square.side);
        let mut values = square.values;
        let side = width.max(height) as f64;
        let height_scale = match (self.height_scale, self.number_type.white_level()) {
            (Some(scale), _) => scale,
            (None, None) => 1.0,
            (None, Some(white)) => {
                assumptions.push(assumed_levels());
                pixel_size * SUGGESTED_RELIEF_SHARE * side / white
            }
        };
        let are_heights = self.height_scale.is_some() || self.number_type.white_level().is_none();
        if self.sides.is_none() && are_heights && are_measured {
            let found = assumed_pixel_size(&values, height_scale, side);
            if let Some((size, assumption)) = found {
                pixel_size = size;
                assumptions.push(assumption);
            }
        }
        if self.offset != 0.0 {
            let offset = self.offset / height_scale;
            values.iter_mut().for_each(|z| *z += offset);
        }
        Ok(Decoded {
            format,
            width,
            height,
            values,
            pixel_size,
            unit: self.unit,
            height_scale,
            data_type: self.number_type.name(),
            depths,
            depth_unit,
            georeference: self.georeference,
            assumptions,
        })
    }
}

/// Whether two sides of pixels differ by more than nobody needs to be told.
pub(super) fn differ([x, y]: [f64; 2]) -> bool {
    (x - y).abs() > NEGLIGIBLE_SIDE_DIFFERENCE * x.max(y)
}

/// The sides of pixels of which a writer of this library recorded the size; it records 1 where it knows none.
pub(super) fn recorded_sides(size: f64) -> Option<[f64; 2]> {
    (size != 1.0).then_some([size; 2])
}
