//! Photos as RGBA bytes, and their resampling.

use crate::error::{Error, Result, checked_pixels};

/// A photo: RGBA bytes, row by row, top row first.
#[derive(Debug, Clone, Copy)]
pub struct Photo<'a> {
    width: usize,
    height: usize,
    rgba: &'a [u8],
}

/// Maximum number of samples of the photo along each side of a pixel of the flat image. Limits the cost where the photo
/// is much finer.
const MAX_SAMPLES_PER_PIXEL_SIDE: f32 = 8.0;

impl<'a> Photo<'a> {
    /// Makes a photo from its bytes, four for each pixel (red, green, blue, alpha), row by row.
    ///
    /// # Errors
    /// [`Error::Empty`] without pixels, [`Error::Shape`] if there are not `4 · width · height`
    /// bytes, [`Error::TooLarge`].
    pub fn new(width: usize, height: usize, rgba: &'a [u8]) -> Result<Self> {
        if width == 0 || height == 0 {
            return Err(Error::Empty { what: "photo" });
        }
        if !rgba.len().is_multiple_of(4) || rgba.len() / 4 != width.saturating_mul(height) {
            return Err(Error::Shape {
                what: "photo",
                rows: height,
                cols: width,
                expected: width.saturating_mul(height).saturating_mul(4),
                found: rgba.len(),
            });
        }
        checked_pixels("photo", height, width)?;
        Ok(Photo {
            width,
            height,
            rgba,
        })
    }

    /// Number of columns of the photo.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows of the photo.
    pub fn height(&self) -> usize {
        self.height
    }

    /// RGBA bytes of the photo, row by row from the top.
    pub fn rgba(&self) -> &'a [u8] {
        self.rgba
    }

    /// Interpolates the colour, from 0 to 1, at texture coordinates, which are shares of the width from the left and of
    /// the height from the bottom. The photo repeats beyond 0 and 1; colours between pixels are bilinear. None where
    /// the photo is transparent or a coordinate is not finite.
    pub fn color(&self, uv: [f32; 2]) -> Option<[f32; 3]> {
        let within = |v: f32| {
            if (0.0..=1.0).contains(&v) {
                v
            } else {
                v - v.floor()
            }
        };
        let [u, v] = uv.map(within);
        let place = [u * self.width as f32, (1.0 - v) * self.height as f32];
        let [r, g, b, a] = self.bilinear(place.map(|at| at - 0.5));
        (a > 0.0).then(|| [r, g, b].map(|value| value / a / 255.0))
    }

    /// Averages the colour, as RGBA bytes, of the parallelogram around a place in the photo whose sides are the vectors
    /// `across` and `down`, all in pixels; `[0, 0]` is the centre of the upper left pixel. Transparent outside of the
    /// photo.
    #[inline]
    pub(super) fn sample(&self, [x, y]: [f32; 2], [across, down]: [[f32; 2]; 2]) -> [u8; 4] {
        let samples = |[dx, dy]: [f32; 2]| {
            let square = dx * dx + dy * dy;
            (square.sqrt() + 0.5)
                .floor()
                .clamp(1.0, MAX_SAMPLES_PER_PIXEL_SIDE)
        };
        let [m, n] = [samples(across), samples(down)];
        if m * n == 1.0 {
            return to_bytes(self.bilinear([x, y]), 1.0);
        }
        let mut sum = [0.0f32; 4];
        for j in 0..n as usize {
            let v = (j as f32 + 0.5) / n - 0.5;
            for i in 0..m as usize {
                let u = (i as f32 + 0.5) / m - 0.5;
                let place = [0, 1].map(|k| [x, y][k] + u * across[k] + v * down[k]);
                let colour = self.bilinear(place);
                for (sum, value) in sum.iter_mut().zip(colour) {
                    *sum += value;
                }
            }
        }
        to_bytes(sum, m * n)
    }

    /// Interpolates the colour at a place in the photo bilinearly, premultiplied by alpha, which is from 0 to 255. Up
    /// to half a pixel beyond the outermost pixel centres the photo has the colour at its border.
    #[inline]
    fn bilinear(&self, [x, y]: [f32; 2]) -> [f32; 4] {
        let [right, bottom] = [self.width, self.height].map(|n| n as f32 - 0.5);
        if !((-0.5..=right).contains(&x) && (-0.5..=bottom).contains(&y)) {
            return [0.0; 4];
        }
        let (left, top) = (x.floor(), y.floor());
        let (fx, fy) = (x - left, y - top);
        let columns = [
            left.max(0.0) as usize,
            ((left + 1.0) as usize).min(self.width - 1),
        ];
        let rows = [
            top.max(0.0) as usize,
            ((top + 1.0) as usize).min(self.height - 1),
        ];
        let pixels = self.rgba.as_chunks::<4>().0;
        let mut sum = [0.0; 4];
        for (row, down) in rows.into_iter().zip([1.0 - fy, fy]) {
            let line = &pixels[row * self.width..][..self.width];
            for (column, across) in columns.into_iter().zip([1.0 - fx, fx]) {
                let mut colour = line[column].map(f32::from);
                let alpha = across * down * colour[3];
                colour[3] = 1.0;
                for k in 0..4 {
                    sum[k] += alpha * colour[k];
                }
            }
        }
        sum
    }
}

/// Converts a sum of premultiplied colours over some number of samples to the RGBA bytes of their mean.
#[inline]
fn to_bytes([r, g, b, a]: [f32; 4], samples: f32) -> [u8; 4] {
    if a <= 0.0 {
        return [0; 4];
    }
    // Casts saturate.
    let byte = |value: f32| (value + 0.5) as u8;
    [byte(r / a), byte(g / a), byte(b / a), byte(a / samples)]
}

/// Colours vertices by their texture coordinates in a photo. Vertices keep their colours where the photo is
/// transparent, and where `wanted` is false.
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

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: [[f32; 2]; 2] = [[1.0, 0.0], [0.0, 1.0]];

    #[test]
    fn a_ramp_stays_one_between_pixels_and_ends_at_the_border() {
        let rgba: Vec<u8> = (0..40).flat_map(|i| [20 * (i % 10), 10, 5, 255]).collect();
        let photo = Photo::new(10, 4, &rgba).unwrap();
        assert_eq!(photo.sample([3.5, 1.2], ONE), [70, 10, 5, 255]);
        assert_eq!(photo.sample([-0.4, 0.0], ONE), [0, 10, 5, 255]);
        assert_eq!(photo.sample([-0.6, 0.0], ONE), [0; 4]);
        assert_eq!(photo.sample([9.4, 3.4], ONE), [180, 10, 5, 255]);
        assert_eq!(photo.sample([9.6, 3.0], ONE), [0; 4]);
    }

    #[test]
    fn texture_coordinates_count_from_the_lower_left_corner() {
        // Red to the right, green downwards; the lower right pixel is transparent.
        let rgba = [
            [0, 0, 51, 255],
            [255, 0, 51, 255],
            [0, 255, 51, 255],
            [9; 4],
        ];
        let mut rgba = rgba.as_flattened().to_vec();
        rgba[15] = 0;
        let photo = Photo::new(2, 2, &rgba).unwrap();
        let close = |uv, expected: [f32; 3]| {
            let found = photo.color(uv).unwrap();
            assert!(
                found
                    .iter()
                    .zip(expected)
                    .all(|(a, b)| (a - b).abs() < 1e-6),
                "{found:?}"
            );
        };
        close([0.25, 0.75], [0.0, 0.0, 0.2]);
        close([0.75, 0.75], [1.0, 0.0, 0.2]);
        close([0.25, 0.25], [0.0, 1.0, 0.2]);
        close([0.5, 0.75], [0.5, 0.0, 0.2]);
        // The border itself, and once around.
        close([0.0, 1.0], [0.0, 0.0, 0.2]);
        close([1.0, 1.0], [1.0, 0.0, 0.2]);
        close([-0.25, 5.75], [1.0, 0.0, 0.2]);
        assert_eq!(photo.color([0.75, 0.25]), None);
        assert_eq!(photo.color([f32::NAN, 0.25]), None);
        assert_eq!(photo.color([f32::INFINITY, 0.25]), None);
    }

    #[test]
    fn many_pixels_in_one_are_averaged_and_transparent_ones_have_no_colour() {
        let rgba: Vec<u8> = (0..64)
            .flat_map(|i| {
                if (i % 8 + i / 8) % 2 == 0 {
                    [200, 0, 0, 255]
                } else {
                    [0, 9, 9, 0]
                }
            })
            .collect();
        let photo = Photo::new(8, 8, &rgba).unwrap();
        let four = [[4.0, 0.0], [0.0, 4.0]];
        let [r, g, b, a] = photo.sample([3.5, 3.5], four);
        assert_eq!([r, g, b], [200, 0, 0]);
        assert!(a.abs_diff(128) <= 1, "{a}");
    }

    #[test]
    fn wrong_sizes_are_refused() {
        assert_eq!(Photo::new(2, 2, &[0; 15]).unwrap_err().code(), "SHAPE");
        assert_eq!(Photo::new(2, 0, &[]).unwrap_err().code(), "EMPTY");
        assert_eq!(
            Photo::new(usize::MAX, 2, &[0; 8]).unwrap_err().code(),
            "SHAPE"
        );
    }
}
