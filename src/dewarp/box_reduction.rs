//! Reduction of a photo by the means of square blocks of pixels.

/// Maximum length of a block's side, in pixels, for which sums fit into 32 bits.
const MAX_BLOCK_SIDE: usize = 128;

/// Reduction of a photo by the means of square blocks of pixels, row by row.
///
/// Colours are mixed by their alpha. Pixels beyond the last whole block at the right and at the bottom are left out, so that
/// two reductions, one after the other, are one, up to the rounding of bytes.
#[derive(Debug, Clone)]
pub struct BoxReduction {
    /// Width and height of a block.
    block: [usize; 2],
    /// Number of columns of the photo.
    width: usize,
    /// Width and height of the reduced photo.
    size: [usize; 2],
    /// Sums over the part of each block that has been read: of red, green and blue, each times alpha, and of alpha.
    sums: Vec<[u32; 4]>,
    /// Number of rows that the sums hold.
    rows: usize,
}

impl BoxReduction {
    /// Prepares the reduction of a photo of `photo` (width and height) pixels by blocks with sides of `side` pixels, from 1 to
    /// 128, or as many as the photo's side has.
    pub fn new(photo: [usize; 2], side: usize) -> Self {
        let side = side.clamp(1, MAX_BLOCK_SIDE);
        let block = photo.map(|length| length.clamp(1, side));
        let size = [0, 1].map(|k| photo[k] / block[k]);
        BoxReduction {
            block,
            width: photo[0],
            size,
            sums: vec![[0; 4]; size[0]],
            rows: 0,
        }
    }

    /// Width and height of the reduced photo, in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Reads the photo's next row, RGBA bytes, and appends a row to the reduced photo `out` if it completes one.
    pub fn push_row(&mut self, row: &[u8], out: &mut Vec<u8>) {
        let count = (self.block[0] * self.block[1]) as u32;
        self.add_row(row, |[r, g, b, a]| {
            let mean = |value: u32| ((value + a / 2) / a.max(1)) as u8;
            out.extend([mean(r), mean(g), mean(b), ((a + count / 2) / count) as u8]);
        });
    }

    /// Reads the photo's next row, RGBA bytes; calls `take` with the sums of each block of a row that it completes: of red, green
    /// and blue, each times alpha, and of alpha.
    fn add_row(&mut self, row: &[u8], take: impl FnMut([u32; 4])) {
        let pixels = row.as_chunks::<4>().0;
        for (sum, pixels) in self.sums.iter_mut().zip(pixels.chunks_exact(self.block[0])) {
            for [r, g, b, a] in pixels {
                let a = u32::from(*a);
                for (sum, value) in sum.iter_mut().zip([r, g, b]) {
                    *sum += a * u32::from(*value);
                }
                sum[3] += a;
            }
        }
        self.rows += 1;
        if self.rows == self.block[1] {
            self.rows = 0;
            self.sums.iter_mut().map(std::mem::take).for_each(take);
        }
    }

    /// Reduces a whole photo, RGBA bytes row by row.
    pub fn reduce(mut self, rgba: &[u8]) -> Vec<u8> {
        let mut out = Vec::with_capacity(4 * self.size[0] * self.size[1]);
        for row in rgba.chunks_exact(4 * self.width.max(1)) {
            self.push_row(row, &mut out);
        }
        out
    }

    /// Calls `take` with the mean colour of each block of a photo, RGBA bytes row by row, from 0 to 255; not numbers where it is
    /// transparent.
    pub(crate) fn for_each_mean(mut self, rgba: &[u8], mut take: impl FnMut([f64; 3])) {
        for row in rgba.chunks_exact(4 * self.width.max(1)) {
            self.add_row(row, |[r, g, b, a]| {
                take([r, g, b].map(|sum| f64::from(sum) / f64::from(a)));
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_reductions_are_one() {
        let (width, height) = (23, 18);
        let rgba: Vec<u8> = (0..4 * width * height)
            .map(|i| {
                if i % 4 == 3 {
                    255
                } else {
                    (i * 97 % 251) as u8
                }
            })
            .collect();
        let once = BoxReduction::new([width, height], 4);
        let half = BoxReduction::new([width, height], 2);
        let again = BoxReduction::new(half.size(), 2);
        assert_eq!((once.size(), again.size()), ([5, 4], [5, 4]));
        let (once, twice) = (once.reduce(&rgba), again.reduce(&half.reduce(&rgba)));
        assert_eq!(once.len(), 80);
        assert!(once.iter().zip(&twice).all(|(a, b)| a.abs_diff(*b) <= 1));
    }

    #[test]
    fn transparent_pixels_have_no_colour_and_thin_photos_keep_a_pixel() {
        let photo = [[90, 10, 0, 255], [200, 200, 200, 0]].concat();
        let thin = BoxReduction::new([2, 1], 2);
        assert_eq!(thin.size(), [1, 1]);
        assert_eq!(thin.reduce(&photo), [90, 10, 0, 128]);
    }
}
