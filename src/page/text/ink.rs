//! Ink image of a page: the page's darkness relative to its paper, flattened by the surface that was found from the
//! edges.

use super::grey_photo::GreyPhoto;
use crate::dewarp::Photo;

/// A flat page with its projection to the photo; places on the page are shares of its width and height.
pub(in crate::page) struct PageView<'a> {
    place: Box<dyn Fn([f64; 2]) -> [f64; 2] + 'a>,
}

/// Ink image: darkness of each pixel of the flat page relative to the paper around it, from 0 to 1.
pub(super) struct InkImage {
    pub width: usize,
    pub height: usize,
    pub data: Vec<f32>,
}

/// Maximum width of the ink image, in pixels: the x-height of body text on A4 is 8 pixels then.
const MAX_INK_WIDTH: f64 = 1000.0;

/// Minimum width and height of a page in the photo, in pixels, for text to be searched.
const MIN_PAGE_PIXELS: f64 = 100.0;

/// Number of blocks across the page in each of which the paper's brightness is measured.
const PAPER_BLOCKS_ACROSS: usize = 40;

/// Quantile of the brightness of a block's pixels that is taken for the paper's brightness.
const PAPER_QUANTILE: f64 = 0.85;

/// Side, in pixels of the ink image, of the square cells whose corners are projected to the photo; in between, the places
/// are interpolated, with an error of some hundredths of a pixel.
const PIXELS_PER_CELL: usize = 8;

impl<'a> PageView<'a> {
    /// Makes the view of a page whose places are projected to the photo's pixels by the function `place`.
    pub fn new(place: impl Fn([f64; 2]) -> [f64; 2] + 'a) -> Self {
        PageView {
            place: Box::new(place),
        }
    }

    /// Reduces a photo for the page's ink image; None if too little of the page is in the photo for lines of text.
    pub fn reduce(&self, photo: &Photo<'_>) -> Option<GreyPhoto> {
        let [seen, down] = self.size();
        let is_large = seen >= MIN_PAGE_PIXELS && down >= MIN_PAGE_PIXELS;
        (is_large && seen < 1e6 && down < 1e6).then(|| {
            let block = (seen / MAX_INK_WIDTH).round().max(1.0) as usize;
            GreyPhoto::new(photo, block)
        })
    }

    /// Width and height of the page in the photo, in pixels, along the lines through its middle.
    fn size(&self) -> [f64; 2] {
        /// Number of segments by which the page's width and height in the photo are measured.
        const PAGE_SIZE_SEGMENTS: usize = 16;
        let length = |along: fn(f64) -> [f64; 2]| -> f64 {
            let seen: Vec<_> = (0..=PAGE_SIZE_SEGMENTS)
                .map(|i| (self.place)(along(i as f64 / PAGE_SIZE_SEGMENTS as f64)))
                .collect();
            (seen.windows(2))
                .map(|w| (w[0][0] - w[1][0]).hypot(w[0][1] - w[1][1]))
                .sum()
        };
        [length(|t| [t, 0.5]), length(|t| [0.5, t])]
    }
}

impl InkImage {
    /// Computes the ink image of a page.
    pub fn new(view: &PageView<'_>, photo: &GreyPhoto) -> Self {
        let [seen, down] = view.size();
        let scale = (MAX_INK_WIDTH / seen).min(1.0);
        let [width, height] =
            [seen * scale, (down * scale).min(4.0 * MAX_INK_WIDTH)].map(|n| n as usize);
        let [cols, rows] = [width, height].map(|n| n.div_ceil(PIXELS_PER_CELL) + 1);
        let nodes: Vec<_> = (0..cols * rows)
            .map(|i| {
                let node = [i % cols, i / cols].map(|n| (n * PIXELS_PER_CELL) as f64);
                (view.place)([node[0] / width as f64, node[1] / height as f64])
            })
            .collect();
        let mut data = vec![f32::NAN; width * height];
        let mut line = vec![[0.0; 2]; cols];
        for row in 0..height {
            let (above, t) = cell_place(row);
            for (col, place) in line.iter_mut().enumerate() {
                let [p, q] = [above, above + 1].map(|row| nodes[row * cols + col]);
                *place = between(p, q, t);
            }
            for col in 0..width {
                let (before, s) = cell_place(col);
                let place = between(line[before], line[before + 1], s);
                data[row * width + col] = photo.at(place);
            }
        }
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

/// Cell of the grid of projected nodes in which the centre of an ink image's pixel lies, along one axis, and the share of
/// the cell before it.
fn cell_place(pixel: usize) -> (usize, f64) {
    let rest = (pixel % PIXELS_PER_CELL) as f64 + 0.5;
    (pixel / PIXELS_PER_CELL, rest / PIXELS_PER_CELL as f64)
}

/// Point at a share of the way between two points.
fn between(p: [f64; 2], q: [f64; 2], share: f64) -> [f64; 2] {
    [0, 1].map(|k| p[k] + share * (q[k] - p[k]))
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
