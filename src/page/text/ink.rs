//! Ink image of a page: the page's darkness relative to its paper, flattened by the surface that was found from the
//! edges.

/// Ink image: darkness of each pixel of the flat page relative to the paper around it, from 0 to 1.
pub(super) struct InkImage {
    pub width: usize,
    pub height: usize,
    pub data: Vec<f32>,
}

/// Maximum width of the ink image, in pixels: the x-height of body text on A4 is 8 pixels then.
const MAX_INK_WIDTH: f64 = 1000.0;

/// Number of blocks across the page in each of which the paper's brightness is measured.
const PAPER_BLOCKS_ACROSS: usize = 40;

/// Quantile of the brightness of a block's pixels that is taken for the paper's brightness.
const PAPER_QUANTILE: f64 = 0.85;

/// Side, in pixels of a photo, of the squares that are averaged for the ink image of a page that is seen `width` pixels wide.
pub(in crate::page) fn ink_block(width: f64) -> usize {
    (width / MAX_INK_WIDTH).round().max(1.0) as usize
}

impl InkImage {
    /// Computes the ink image of a page that is seen with `size` (width and height, in pixels); `brightness` gives the photo's
    /// at shares of the page's width and height.
    pub fn new([seen, down]: [f64; 2], brightness: impl Fn([f64; 2]) -> f32) -> Self {
        let scale = (MAX_INK_WIDTH / seen).min(1.0);
        let [width, height] =
            [seen * scale, (down * scale).min(4.0 * MAX_INK_WIDTH)].map(|n| n.max(1.0) as usize);
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
    cols: usize,
    rows: usize,
    levels: Vec<f32>,
}

impl PaperBrightness {
    fn new(data: &[f32], [width, height]: [usize; 2]) -> Self {
        let side = width.div_ceil(PAPER_BLOCKS_ACROSS).max(8);
        let [cols, rows] = [width, height].map(|n| n.div_ceil(side));
        let mut levels = Vec::with_capacity(cols * rows);
        for block in 0..cols * rows {
            let [x, y] = [block % cols * side, block / cols * side];
            let mut counts = [0u32; 256];
            for row in y..(y + side).min(height) {
                for value in &data[row * width + x..row * width + (x + side).min(width)] {
                    if value.is_finite() {
                        counts[*value as usize] += 1;
                    }
                }
            }
            let all: u32 = counts.iter().sum();
            let mut rest = f64::from(all) * (1.0 - PAPER_QUANTILE);
            let level = (0..256).rev().find(|level| {
                rest -= f64::from(counts[*level]);
                rest < 0.0
            });
            levels.push(match level {
                Some(level) => level as f32 + 0.5,
                None => f32::NAN,
            });
        }
        // Blocks without pixels, at the margins, have the brightness of those beside them.
        for _ in 0..2 {
            let before = levels.clone();
            for block in 0..cols * rows {
                if before[block].is_nan() {
                    let [x, y] = [block % cols, block / cols];
                    let near =
                        |x: usize, y: usize| before[y.min(rows - 1) * cols + x.min(cols - 1)];
                    levels[block] = [
                        near(x + 1, y),
                        near(x, y + 1),
                        near(x.saturating_sub(1), y),
                        near(x, y.saturating_sub(1)),
                    ]
                    .into_iter()
                    .fold(f32::NAN, f32::max);
                }
            }
        }
        PaperBrightness {
            side,
            cols,
            rows,
            levels,
        }
    }

    /// Interpolates the paper's brightness at a pixel, bilinearly between the centres of blocks.
    fn at(&self, pixel: [usize; 2]) -> f32 {
        let sides = [self.cols, self.rows];
        let [(x, s), (y, t)] = [0, 1].map(|k| {
            let at = ((pixel[k] as f32 + 0.5) / self.side as f32 - 0.5)
                .clamp(0.0, (sides[k] - 1) as f32);
            let low = (at as usize).min(sides[k].saturating_sub(2));
            (low, at - low as f32)
        });
        let level = |x: usize, y: usize| {
            self.levels[y.min(self.rows - 1) * self.cols + x.min(self.cols - 1)]
        };
        (1.0 - t) * ((1.0 - s) * level(x, y) + s * level(x + 1, y))
            + t * ((1.0 - s) * level(x, y + 1) + s * level(x + 1, y + 1))
    }
}
