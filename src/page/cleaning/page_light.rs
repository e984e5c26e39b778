//! Estimate of the light on a flat page, and its removal.

use super::Light;
use super::fill::fill_gaps;
use super::paper::find_paper;
use crate::error::{Result, try_filled};
use crate::page::outline::{LOG_OFFSET, MAX_REDUCED_SIDE, Planes, box_mean, closed};

/// Maximum width of a stroke or a bar of print, as a share of the page's longer side, that does not count as paper whatever its
/// colour: 12 mm on A4, since heads of tables have 10 mm, with edges that are blurred and tilted. A narrower shadow is taken
/// for print, too.
const MAX_STROKE_SHARE: f64 = 0.042;

/// Share of the estimated paper's brightness from which a pixel becomes white, so that the grain of paper and camera
/// disappears.
const WHITE_SHARE: f32 = 0.94;

/// Minimum share of a page's cells that show plain paper for its light to be evened: below it is a picture.
const MIN_PAPER_SHARE: f64 = 0.25;

/// Number of samples over the half width of the widest bar of print, where the ground's median is taken over twice that width.
const MEDIAN_SAMPLES: usize = 4;

/// Maximum width, in cells, of a fringe of the table at the page's rim: 1.5 mm on A4, where next to nothing is printed.
const FRINGE_CELLS: usize = 4;

/// Radius, in cells, by which the light is smoothed.
const SMOOTHING_RADIUS: usize = 1;

/// Square cells of a flat page: the number of pixels along a side of one, and the numbers of their columns and rows.
#[derive(Debug, Clone, Copy)]
struct Cells {
    side: usize,
    columns: usize,
    rows: usize,
}

/// Sums of colours over the cells of a flat page, from which the light on the page is estimated.
#[derive(Debug, Clone)]
pub struct LightEstimator {
    /// Number of columns of the page's image.
    width: usize,
    cells: Cells,
    /// Sums of red, green and blue over the opaque pixels of each cell, and the number of these.
    sums: Vec<[u32; 4]>,
}

impl LightEstimator {
    /// Makes the estimator of a page of `width` by `height` pixels.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(width: usize, height: usize) -> Result<Self> {
        let cell = width.max(height).div_ceil(MAX_REDUCED_SIDE).max(1);
        let (columns, rows) = (width.div_ceil(cell), height.div_ceil(cell));
        Ok(LightEstimator {
            width,
            cells: Cells {
                side: cell,
                columns,
                rows,
            },
            sums: try_filled("light of a page", columns * rows, [0; 4])?,
        })
    }

    /// Adds one row of RGBA pixels, counted from the top.
    ///
    /// # Panics
    /// If the page has no such row.
    pub fn add_row(&mut self, row: usize, rgba: &[u8]) {
        debug_assert_eq!(rgba.len(), 4 * self.width);
        let Cells { side, columns, .. } = self.cells;
        let sums = &mut self.sums[row / side * columns..][..columns];
        for (sum, pixels) in sums.iter_mut().zip(rgba.chunks(4 * side)) {
            for [red, green, blue, alpha] in pixels.as_chunks().0 {
                if *alpha == u8::MAX {
                    for (sum, value) in sum.iter_mut().zip([*red, *green, *blue, 1]) {
                        *sum += u32::from(value);
                    }
                }
            }
        }
    }

    /// Estimates the light on the page: the colour of the paper in each cell, where print is suppressed by a grey
    /// closing, and pictures and coloured areas by interpolation from the paper around them. A page whose print is lighter
    /// than what is between it keeps its light.
    pub fn finish(self) -> PageLight {
        let Cells {
            side,
            columns,
            rows,
        } = self.cells;
        let kept = |is_dark| PageLight {
            cells: self.cells,
            gains: None,
            is_dark,
        };
        let mut known: Vec<bool> = self.sums.iter().map(|sum| sum[3] > 0).collect();
        let mut raw = Planes {
            width: columns,
            height: rows,
            channels: [0, 1, 2].map(|k| self.sums.iter().map(|sum| logarithm(sum, k)).collect()),
            scale: side as f64,
        };
        fill_gaps(&mut raw.channels, &known, columns, rows);
        let longer = columns.max(rows) as f64;
        let radius = (0.5 * MAX_STROKE_SHARE * longer) as usize;
        let mut paper = closed(&raw, radius);
        if is_dark(&raw, radius) {
            return kept(true);
        }
        let shown = known.iter().filter(|known| **known).count();
        let plain = find_paper(&raw, &paper, &mut known);
        if (plain as f64) < MIN_PAPER_SHARE * shown as f64 || plain == 0 {
            return kept(false);
        }
        fill_gaps(&mut paper.channels, &known, columns, rows);
        darken_fringe(&mut paper, &raw, &known);
        let gains = paper.channels.each_mut().map(|plane| {
            box_mean(plane, columns, rows, SMOOTHING_RADIUS);
            let gain = |light: &f32| 255.0 / (WHITE_SHARE * (light.exp() - LOG_OFFSET).max(1.0));
            plane.iter().map(gain).collect()
        });
        PageLight {
            gains: Some(gains),
            ..kept(false)
        }
    }
}

/// Takes what is dark at the rim of the page beside paper for shaded paper, so that a fringe of the table becomes white.
fn darken_fringe(paper: &mut Planes, raw: &Planes, known: &[bool]) {
    let inside = |at: usize, count: usize| {
        let reach = (2 * FRINGE_CELLS).min((count - 1) / 2);
        at.clamp(reach, count - 1 - reach)
    };
    for i in 0..known.len() {
        let (x, y) = (i % raw.width, i / raw.width);
        let beside = inside(y, raw.height) * raw.width + inside(x, raw.width);
        let (right, below) = (raw.width - 1 - x, raw.height - 1 - y);
        if known[beside] && x.min(y).min(right).min(below) < FRINGE_CELLS {
            for (paper, raw) in paper.channels.iter_mut().zip(&raw.channels) {
                paper[i] = paper[i].min(raw[i]);
            }
        }
    }
}

/// Whether print on a page is lighter than its ground: by which print differs more from the median around it, which is the ground
/// as print covers less than half of it.
fn is_dark(raw: &Planes, radius: usize) -> bool {
    let stride = (radius / MEDIAN_SAMPLES).max(1);
    let columns = raw.width.div_ceil(stride);
    let rows = (0..raw.height).step_by(stride);
    let samples: Vec<f32> = rows
        .flat_map(|y| {
            let cells = (0..raw.width).step_by(stride);
            cells.map(move |x| raw.channels[1][y * raw.width + x])
        })
        .collect();
    let reach = 2 * MEDIAN_SAMPLES;
    let mut window = Vec::new();
    let mut lighter = 0.0;
    for (i, value) in samples.iter().enumerate() {
        let (x, y) = (i % columns, i / columns);
        window.clear();
        let rows = samples.chunks_exact(columns).take(y + reach + 1);
        for row in rows.skip(y.saturating_sub(reach)) {
            window.extend(&row[x.saturating_sub(reach)..(x + reach + 1).min(columns)]);
        }
        let middle = window.len() / 2;
        let difference = value - *window.select_nth_unstable_by(middle, f32::total_cmp).1;
        lighter += f64::from(difference).powi(3);
    }
    lighter > 0.0
}

/// Returns the logarithm of the mean of colour component `k` over a cell.
fn logarithm(sum: &[u32; 4], k: usize) -> f32 {
    (sum[k] as f32 / sum[3].max(1) as f32 + LOG_OFFSET).ln()
}

/// The light on a flat page: the factors by which red, green and blue are multiplied in each cell, so that paper becomes
/// white.
#[derive(Debug, Clone)]
pub struct PageLight {
    cells: Cells,
    /// `None` where the page is not mostly paper.
    gains: Option<[Vec<f32>; 3]>,
    /// Whether print is lighter than what is between it.
    is_dark: bool,
}

impl PageLight {
    /// What happens to the light by [`apply`](Self::apply): a page that is dark or not mostly paper keeps it.
    pub fn kind(&self) -> Light {
        match self.gains {
            Some(_) => Light::Even,
            None => Light::Keep,
        }
    }

    /// Returns the luminance by which a pixel is told to be ink or paper, from 0 to 255 (ITU-R BT.601): paper's white where the
    /// pixel is transparent, and the negative on a dark page, whose print becomes dark.
    pub fn luminance(&self, [red, green, blue, alpha]: &[u8; 4]) -> u8 {
        if *alpha == 0 {
            return u8::MAX;
        }
        let [red, green, blue] = [red, green, blue].map(|value| u32::from(*value));
        let luminance = ((299 * red + 587 * green + 114 * blue + 500) / 1000) as u8;
        match self.is_dark {
            true => u8::MAX - luminance,
            false => luminance,
        }
    }

    /// Evens the light in one row of RGBA pixels, counted from the top; the factors are bilinear between the cells'
    /// centres.
    pub fn apply(&self, row: usize, rgba: &mut [u8]) {
        let Some(gains) = &self.gains else { return };
        let Cells {
            side,
            columns,
            rows,
        } = self.cells;
        let (above, below, down) = neighbours(row, side, rows);
        let line: Vec<[f32; 3]> = (0..columns)
            .map(|col| {
                gains.each_ref().map(|plane| {
                    let upper = plane[above * columns + col];
                    upper + down * (plane[below * columns + col] - upper)
                })
            })
            .collect();
        for (x, pixel) in rgba.as_chunks_mut::<4>().0.iter_mut().enumerate() {
            let (left, right, across) = neighbours(x, side, columns);
            for k in 0..3 {
                let gain = line[left][k] + across * (line[right][k] - line[left][k]);
                // Casts saturate.
                pixel[k] = (f32::from(pixel[k]) * gain + 0.5) as u8;
            }
        }
    }
}

/// Returns the cells before and after a pixel's centre along one axis, and its place between their centres, from 0 to 1.
#[inline]
fn neighbours(pixel: usize, cell: usize, cells: usize) -> (usize, usize, f32) {
    let place = ((pixel as f32 + 0.5) / cell as f32 - 0.5).clamp(0.0, (cells - 1) as f32);
    let before = place as usize;
    (before, (before + 1).min(cells - 1), place - before as f32)
}
