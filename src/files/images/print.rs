//! Writes photos to files that state their size on paper: PNG and JPEG.

use std::io::Write as _;

use ::png::{
    BitDepth, ColorType, DeflateCompression, Encoder, Filter as Prediction, PixelDimensions, Unit,
};
use jpeg_encoder::{
    Encoder as JpegEncoder, EncodingError as JpegError, ImageBuffer, JpegColorType, PixelDensity,
    PixelDensityUnit, rgb_to_ycbcr,
};

use crate::dewarp::Photo;
use crate::error::{Error, Result, positive, try_filled};
use crate::files::buffer::Buffer;
use crate::files::failure::unsupported;

/// Options of writing a photo to a file: resolution and quality.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PhotoOptions {
    /// Number of pixels per millimetre of the surface in the photo. `None` (the default): not known, so that
    /// PNG and JPEG files do not state it, and no PDF can be made.
    pub dots_per_millimetre: Option<f64>,
    /// Quality of JPEG compression, in a JPEG file or within a PDF: from 1 to 100; default 90. Colour has the full
    /// resolution from 90 on, and half of it below.
    pub quality: u8,
}

impl Default for PhotoOptions {
    fn default() -> Self {
        PhotoOptions {
            dots_per_millimetre: None,
            quality: 90,
        }
    }
}

impl PhotoOptions {
    /// Sets the resolution, in pixels per millimetre of the surface in the photo, and returns the options.
    pub fn dots_per_millimetre(self, dots: f64) -> Self {
        PhotoOptions {
            dots_per_millimetre: Some(dots),
            ..self
        }
    }

    /// Sets the quality of JPEG compression, from 1 to 100, and returns the options.
    pub fn quality(self, quality: u8) -> Self {
        PhotoOptions { quality, ..self }
    }

    /// Checks the range of the resolution and returns it, in pixels per millimetre.
    pub(super) fn dots(&self) -> Result<Option<f64>> {
        let checked = |dots| positive("dots_per_millimetre", dots);
        self.dots_per_millimetre.map(checked).transpose()
    }
}

/// Compression level of black and white PNG files, which compress quickly.
const BILEVEL_COMPRESSION: u8 = 6;

/// A photo that is read row by row, so that writing it needs no copy of it.
pub trait PhotoRows {
    /// Returns width and height of the photo in pixels.
    fn size(&self) -> [usize; 2];

    /// Copies the RGBA bytes of one row, counted from the top, into `rgba`, whose length is four bytes per pixel of the
    /// row.
    fn read(&self, row: usize, rgba: &mut [u8]);
}

impl PhotoRows for Photo<'_> {
    fn size(&self) -> [usize; 2] {
        [self.width(), self.height()]
    }

    fn read(&self, row: usize, rgba: &mut [u8]) {
        rgba.copy_from_slice(&self.rgba()[4 * row * self.width()..][..4 * self.width()]);
    }
}

/// Whether a photo has black and white pixels only, all of them opaque.
pub(super) fn is_bilevel(photo: &impl PhotoRows) -> Result<bool> {
    all_pixels(photo, |pixel| {
        matches!(pixel, [0, 0, 0, 255] | [255, 255, 255, 255])
    })
}

/// Whether all pixels of a photo are of a kind.
fn all_pixels(photo: &impl PhotoRows, is_one: impl Fn(&[u8; 4]) -> bool) -> Result<bool> {
    let [width, height] = photo.size();
    let mut line = try_filled("PNG file", 4 * width, 0)?;
    Ok((0..height).all(|row| {
        photo.read(row, &mut line);
        line.as_chunks().0.iter().all(&is_one)
    }))
}

/// Writes a photo as a PNG file: with one bit for each pixel if all are black or white, otherwise with 8 bits for each
/// colour, and with alpha if a pixel is transparent. The file states the resolution, if it is known, to whole pixels per
/// metre.
///
/// # Errors
/// [`Error::Option`] for a resolution that is not positive and finite, [`Error::OutOfMemory`].
pub fn write_photo(photo: &impl PhotoRows, options: &PhotoOptions) -> Result<Vec<u8>> {
    let [width, height] = photo.size();
    let dots = options.dots()?;
    let mut line = try_filled("PNG file", 4 * width, 0)?;
    let bilevel = is_bilevel(photo)?;
    let opaque = bilevel || all_pixels(photo, |pixel| pixel[3] == u8::MAX)?;
    let mut file = Buffer::default();
    let mut encoder = Encoder::new(&mut file, width as u32, height as u32);
    if bilevel {
        encoder.set_color(ColorType::Grayscale);
        encoder.set_depth(BitDepth::One);
        encoder.set_deflate_compression(DeflateCompression::Level(BILEVEL_COMPRESSION));
        encoder.set_filter(Prediction::NoFilter);
    } else {
        let colour = [ColorType::Rgba, ColorType::Rgb][usize::from(opaque)];
        encoder.set_color(colour);
        encoder.set_depth(BitDepth::Eight);
        // Higher compression would hardly shrink a photo, because of its noise, at ten times the cost.
        encoder.set_deflate_compression(DeflateCompression::Level(2));
        encoder.set_filter(Prediction::Adaptive);
    }
    let per_metre = dots.map_or(0.0, |dots| (1000.0 * dots).round());
    if (1.0..=f64::from(i32::MAX)).contains(&per_metre) {
        encoder.set_pixel_dims(Some(PixelDimensions {
            xppu: per_metre as u32,
            yppu: per_metre as u32,
            unit: Unit::Meter,
        }));
    }
    let written = || -> std::io::Result<()> {
        let mut writer = encoder.write_header()?;
        let mut stream = writer.stream_writer()?;
        for row in 0..height {
            photo.read(row, &mut line);
            if bilevel {
                for (col, pixels) in (0..width).step_by(8).enumerate() {
                    let bits = (pixels..width.min(pixels + 8))
                        .map(|x| (line[4 * x] >> 7) << (7 - (x - pixels)))
                        .sum();
                    line[col] = bits;
                }
                stream.write_all(&line[..width.div_ceil(8)])?;
            } else if opaque {
                for col in 0..width {
                    line.copy_within(4 * col..4 * col + 3, 3 * col);
                }
                stream.write_all(&line[..3 * width])?;
            } else {
                stream.write_all(&line)?;
            }
        }
        stream.finish()?;
        Ok(writer.finish()?)
    }();
    file.finish("PNG file", written)
}

/// Writes a photo as a JPEG file, white where the photo is transparent. The file states the resolution, if it is known,
/// in whole pixels per inch or per centimetre, whichever is nearer.
///
/// # Errors
/// [`Error::Option`] for a resolution that is not positive and finite or a quality that is not from 1
/// to 100, [`Error::Unsupported`] for a side of more than 65535 pixels, [`Error::OutOfMemory`].
pub fn write_photo_jpeg(photo: &impl PhotoRows, options: &PhotoOptions) -> Result<Vec<u8>> {
    let quality = options.quality;
    if !(1..=100).contains(&quality) {
        let requirement = "must be a whole number from 1 to 100";
        return Err(Error::option("quality", quality, requirement));
    }
    let size = photo.size();
    let [Ok(width), Ok(height)] = size.map(u16::try_from) else {
        let [width, height] = size;
        let reason = format!(
            "{width} × {height} pixels are more than the 65535 along a side that it can have; choose a lower resolution, or PNG"
        );
        return Err(unsupported("JPEG", reason));
    };
    let density = options.dots()?.and_then(density);
    let mut file = Buffer::default();
    let mut encoder = JpegEncoder::new(&mut file, quality);
    if let Some(density) = density {
        encoder.set_density(density);
    }
    let white = JpegRows {
        photo: OnWhite(photo),
        width,
        height,
    };
    let written = encoder.encode_image(white).map_err(|error| match error {
        JpegError::IoError(error) => error,
        other => std::io::Error::other(other.to_string()),
    });
    file.finish("JPEG file", written)
}

/// Converts a resolution, in pixels per millimetre, to the pixel density that the header of a JPEG file (JFIF) states;
/// `None` if JFIF cannot state it.
fn density(dots_per_millimetre: f64) -> Option<PixelDensity> {
    let stated = |millimetres: f64, unit| {
        let dots = dots_per_millimetre * millimetres;
        let whole = dots.round().clamp(1.0, f64::from(u16::MAX));
        (((whole / dots).ln()).abs(), whole as u16, unit)
    };
    let inches = stated(25.4, PixelDensityUnit::Inches);
    let centimetres = stated(10.0, PixelDensityUnit::Centimeters);
    let (error, dots, unit) = if inches.0 <= centimetres.0 {
        inches
    } else {
        centimetres
    };
    (error < 0.3).then_some(PixelDensity {
        density: (dots, dots),
        unit,
    })
}

/// A photo on white where it is transparent.
pub(super) struct OnWhite<'a, P>(pub &'a P);

impl<P: PhotoRows> PhotoRows for OnWhite<'_, P> {
    fn size(&self) -> [usize; 2] {
        self.0.size()
    }

    fn read(&self, row: usize, rgba: &mut [u8]) {
        self.0.read(row, rgba);
        for [colour @ .., alpha] in rgba.as_chunks_mut::<4>().0 {
            let [own, white] = [*alpha, u8::MAX - *alpha].map(u32::from);
            *colour =
                colour.map(|value| ((u32::from(value) * own + 255 * white + 127) / 255) as u8);
            *alpha = u8::MAX;
        }
    }
}

/// An opaque photo that is written as a JPEG file.
struct JpegRows<'a, P> {
    photo: OnWhite<'a, P>,
    width: u16,
    height: u16,
}

impl<P: PhotoRows> ImageBuffer for JpegRows<'_, P> {
    fn get_jpeg_color_type(&self) -> JpegColorType {
        JpegColorType::Ycbcr
    }

    fn width(&self) -> u16 {
        self.width
    }

    fn height(&self) -> u16 {
        self.height
    }

    fn fill_buffers(&self, row: u16, [y, cb, cr, _]: &mut [Vec<u8>; 4]) {
        let mut line = vec![0; 4 * usize::from(self.width)];
        self.photo.read(row.into(), &mut line);
        for [red, green, blue, _] in line.as_chunks().0 {
            let colour = rgb_to_ycbcr(*red, *green, *blue);
            y.push(colour.0);
            cb.push(colour.1);
            cr.push(colour.2);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resolution_is_stated_in_the_nearer_unit() {
        let stated = |dots: f64| density(dots).map(|found| (found.density.0, found.unit));
        assert_eq!(stated(300.0 / 25.4), Some((300, PixelDensityUnit::Inches)));
        assert_eq!(stated(8.0), Some((80, PixelDensityUnit::Centimeters)));
        // One pixel for a metre, and a million for a millimetre.
        assert_eq!(stated(1e-3), None);
        assert_eq!(stated(1e6), None);
    }
}
