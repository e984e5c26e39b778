//! Ink image of a page: the page's darkness relative to its paper, flattened by the surface that was found from the
//! edges.

use super::grey_photo::MAX_PAGE_WIDTH;
use crate::dewarp::bilinear;
use crate::page::outline::square_extreme;

/// Ink image: darkness of each pixel of the flat page relative to the paper around it, from 0 to 1.
pub(super) struct InkImage {
    pub width: usize,
    pub height: usize,
    pub data: Vec<f32>,
}

/// Number of blocks across the page in each of which the paper's brightness is measured.
const PAPER_BLOCKS_ACROSS: usize = 40;

/// Quantile of the brightness of a block's pixels that is taken for the paper's brightness.
const PAPER_QUANTILE: f64 = 0.85;

impl InkImage {
    /// Computes the ink image of a page that is seen with `size` (width and height, in pixels); `brightness` gives the photo's
    /// at shares of the page's width and height.
    pub fn new([seen, down]: [f64; 2], brightness: impl Fn([f64; 2]) -> f32) -> Self {
        let scale = (MAX_PAGE_WIDTH / seen).min(1.0);
        let [width, height] =
            [seen * scale, (down * scale).min(4.0 * MAX_PAGE_WIDTH)].map(|n| n.max(1.0) as usize);
        let share = |at: usize, count: usize| (at as f64 + 0.5) / count as f64;
        let mut data: Vec<f32> = (0..width * height)
            .map(|i| brightness([share(i % width, width), share(i / width, height)]))
            .collect();
        let paper = PaperBrightness::new(&data, [width, height]);
        for (i, value) in data.iter_mut().enumerate() {
            let white = paper.at([i % width, i / width]);
            *value = if white > 1.0 && value.is_finite() {
                (1.0 - *value / white).clamp(0.0, 1.0)
            } else {
                0.0
            };
        }
        InkImage {
            width,
            height,
            data,
        }
    }
}

/// Brightness of the paper, measured in square blocks of the flat page, by which shadows are corrected.
struct PaperBrightness {
    side: usize,
    /// Numbers of columns and rows of blocks.
    size: [usize; 2],
    levels: Vec<f32>,
}

impl PaperBrightness {
    fn new(data: &[f32], [width, height]: [usize; 2]) -> Self {
        let side = width.div_ceil(PAPER_BLOCKS_ACROSS).max(8);
        let size @ [cols, rows] = [width, height].map(|n| n.div_ceil(side));
        let mut levels = Vec::with_capacity(cols * rows);
        for block in 0..cols * rows {
            let [x, y] = [block % cols * side, block / cols * side];
            let mut bright: Vec<f32> = (y..(y + side).min(height))
                .flat_map(|row| &data[row * width..][x..(x + side).min(width)])
                .copied()
                .filter(|value| value.is_finite())
                .collect();
            let darker = (PAPER_QUANTILE * bright.len() as f64) as usize;
            let paper = darker.min(bright.len().saturating_sub(1));
            levels.push(match bright.is_empty() {
                true => f32::NAN,
                false => *bright.select_nth_unstable_by(paper, f32::total_cmp).1,
            });
        }
        // Blocks without pixels, at the margins, have the brightness of those near them.
        let near = square_extreme(&levels, cols, 2, f32::max);
        for (level, near) in levels.iter_mut().zip(near) {
            *level = if level.is_nan() { near } else { *level };
        }
        PaperBrightness { side, size, levels }
    }

    /// Interpolates the paper's brightness at a pixel, bilinearly between the centres of blocks.
    fn at(&self, pixel: [usize; 2]) -> f32 {
        let at = [0, 1].map(|k| {
            let at = (pixel[k] as f64 + 0.5) / self.side as f64 - 0.5;
            at.clamp(0.0, (self.size[k] - 1) as f64)
        });
        bilinear(at, self.size, |i| [f64::from(self.levels[i])])
            .map_or(f32::NAN, |[level]| level as f32)
    }
}
