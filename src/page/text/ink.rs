//! The ink on a page, roughly flattened by the page that its edges show.

use crate::dewarp::Photo;
use crate::math::lanes;
use crate::page::cylinder::Curve;
use crate::page::find::CurledPage;

/// One page in a photo, or one of the two of a spread, by shares of its own sides.
pub(super) struct Leaf<'a> {
    page: &'a CurledPage,
    curve: Curve,
    number: usize,
}

/// How dark each pixel of the flat page is against the paper around it, from 0 to 1.
pub(super) struct Ink {
    pub width: usize,
    pub height: usize,
    pub data: Vec<f32>,
}

/// Most pixels across: of body text on A4 an x is 8 high then.
const ACROSS: f64 = 1000.0;

/// Pixels from which on there is something to be seen.
const LEAST: f64 = 100.0;

/// Blocks across the page whose paper is looked for, and the share of a block that is darker than it.
const BLOCKS: usize = 40;
const PAPER: f64 = 0.85;

/// Beside the page's edges nothing is looked at, for they are traced with errors: a share of the page.
const MARGIN: f64 = 0.015;

/// Most samples along each side of a pixel.
const SAMPLES: f64 = 4.0;

impl<'a> Leaf<'a> {
    pub fn new(page: &'a CurledPage, number: usize) -> Self {
        Leaf {
            page,
            curve: page.cylinder.curve(),
            number,
        }
    }

    /// Where a place on the page is seen in the photo.
    pub fn seen(&self, share: [f64; 2]) -> Option<[f64; 2]> {
        let cylinder = &self.page.cylinder;
        let (along, down) = self.page.turned(share);
        cylinder.seen(self.curve.at(self.number, along), down * cylinder.length)
    }

    /// Its width and height in the photo, in pixels, across its middle.
    fn size(&self) -> Option<[f64; 2]> {
        const STEPS: usize = 16;
        let length = |along: fn(f64) -> [f64; 2]| -> Option<f64> {
            let seen: Option<Vec<_>> = (0..=STEPS)
                .map(|i| self.seen(along(i as f64 / STEPS as f64)))
                .collect();
            Some(
                (seen?.windows(2))
                    .map(|w| (w[0][0] - w[1][0]).hypot(w[0][1] - w[1][1]))
                    .sum(),
            )
        };
        Some([length(|t| [t, 0.5])?, length(|t| [0.5, t])?])
    }
}

impl Ink {
    /// None where too little of the page is seen.
    pub fn new(leaf: &Leaf<'_>, photo: &Photo<'_>) -> Option<Self> {
        let [seen, down] = leaf.size()?;
        if !(seen >= LEAST && down >= LEAST && seen < 1e6 && down < 1e6) {
            return None;
        }
        let scale = (ACROSS / seen).min(1.0);
        let [width, height] = [seen * scale, (down * scale).min(4.0 * ACROSS)].map(|n| n as usize);
        let samples = (1.0 / scale).ceil().min(SAMPLES) as usize;
        let mut data = vec![f32::NAN; width * height];
        let [left, top] = [width, height].map(|n| (MARGIN * n as f64).ceil() as usize);
        for row in top..height - top {
            for col in left..width - left {
                let place = |x: f64, y: f64| leaf.seen([x / width as f64, y / height as f64]);
                let [x, y] = [col, row].map(|n| n as f64 + 0.5);
                let here = place(x, y)?;
                let ends = [place(x + 0.5, y)?, place(x, y + 0.5)?];
                let [across, along] = ends.map(|end| [end[0] - here[0], end[1] - here[1]]);
                let mut sum = 0.0;
                for i in 0..samples * samples {
                    let [s, t] = [i % samples, i / samples]
                        .map(|k| (2 * k + 1) as f64 / samples as f64 - 1.0);
                    let at = [0, 1].map(|k| here[k] + s * across[k] + t * along[k]);
                    sum += brightness(photo, at);
                }
                data[row * width + col] = sum / (samples * samples) as f32;
            }
        }
        let paper = Paper::new(&data, [width, height]);
        for (i, value) in data.iter_mut().enumerate() {
            let white = paper.at([i % width, i / width]);
            *value = if white > 1.0 && value.is_finite() {
                (1.0 - *value / white).clamp(0.0, 1.0)
            } else {
                0.0
            };
        }
        Some(Ink {
            width,
            height,
            data,
        })
    }
}

/// How bright a photo is between its pixels; not a number outside of it and where it is transparent.
fn brightness(photo: &Photo<'_>, [x, y]: [f64; 2]) -> f32 {
    let [width, height] = [photo.width(), photo.height()];
    if !(x >= 0.0 && y >= 0.0 && x <= (width - 1) as f64 && y <= (height - 1) as f64) {
        return f32::NAN;
    }
    let [col, row] = [x as usize, y as usize];
    let [right, below] = [(col + 1).min(width - 1), (row + 1).min(height - 1)];
    let [s, t] = [lanes::single(x - col as f64), lanes::single(y - row as f64)];
    let pixels = photo.rgba().as_chunks::<4>().0;
    let at = |col: usize, row: usize| {
        let [r, g, b, a] = pixels[row * width + col];
        if a == 0 {
            return f32::NAN;
        }
        0.299 * f32::from(r) + 0.587 * f32::from(g) + 0.114 * f32::from(b)
    };
    (1.0 - t) * ((1.0 - s) * at(col, row) + s * at(right, row))
        + t * ((1.0 - s) * at(col, below) + s * at(right, below))
}

/// How bright the paper is, block by block: shadows are taken out by it.
struct Paper {
    side: usize,
    cols: usize,
    rows: usize,
    levels: Vec<f32>,
}

impl Paper {
    fn new(data: &[f32], [width, height]: [usize; 2]) -> Self {
        let side = width.div_ceil(BLOCKS).max(8);
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
            let mut rest = f64::from(all) * (1.0 - PAPER);
            let level = (0..256).rev().find(|level| {
                rest -= f64::from(counts[*level]);
                rest < 0.0
            });
            levels.push(match level {
                Some(level) => level as f32 + 0.5,
                None => f32::NAN,
            });
        }
        // Where a block has no pixels of its own, at the margins, what those beside it have.
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
        Paper {
            side,
            cols,
            rows,
            levels,
        }
    }

    /// Bilinear between the middles of blocks.
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
