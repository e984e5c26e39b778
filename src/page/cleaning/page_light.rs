//! Estimate of the light on a flat page, and its removal.

use super::Light;
use super::fill::fill_gaps;
use super::paper::find_paper;
use crate::error::{Result, try_filled};
use crate::page::outline::{Planes, box_mean, closed};

/// Number of cells along a page's longer side in which the light is estimated: 0.4 mm on A4, so that the edge of a hard
/// shadow is followed.
const CELLS_ALONG_SIDE: usize = 800;

/// Maximum width of a stroke or a bar of print, as a share of the page's longer side, that does not count as paper whatever its
/// colour: 12 mm on A4, since heads of tables have 10 mm, with edges that are blurred and tilted. A narrower shadow is taken
/// for print, too.
const MAX_STROKE_SHARE: f64 = 0.042;

/// Number added to a colour component (0 to 255) before its logarithm is taken, so that noise of dark pixels counts
/// little.
const LOG_OFFSET: f32 = 8.0;

/// Share of the estimated paper's brightness from which a pixel becomes white, so that the grain of paper and camera
/// disappears.
const WHITE_SHARE: f32 = 0.94;

/// Minimum share of a page's cells that show paper for its light to be evened: below it is a picture.
const MIN_PAPER_SHARE: f64 = 0.25;

/// Radius, in cells, by which the light is smoothed.
const SMOOTHING_RADIUS: usize = 1;

/// Sums of colours over the cells of a flat page, from which the light on the page is estimated.
#[derive(Debug, Clone)]
pub struct LightEstimator {
    /// Number of columns of the page's image.
    width: usize,
    /// Number of pixels along a side of a cell.
    cell: usize,
    columns: usize,
    rows: usize,
    /// Sums of red, green and blue over the opaque pixels of each cell, and the number of these.
    sums: Vec<[u32; 4]>,
}

impl LightEstimator {
    /// Makes the estimator of a page of `width` by `height` pixels.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn new(width: usize, height: usize) -> Result<Self> {
        let cell = width.max(height).div_ceil(CELLS_ALONG_SIDE).max(1);
        let (columns, rows) = (width.div_ceil(cell), height.div_ceil(cell));
        Ok(LightEstimator {
            width,
            cell,
            columns,
            rows,
            sums: try_filled("light of a page", columns * rows, [0; 4])?,
        })
    }

    /// Adds one row of RGBA pixels, counted from the top.
    ///
    /// # Panics
    /// If the page has no such row.
    pub fn add_row(&mut self, row: usize, rgba: &[u8]) {
        debug_assert_eq!(rgba.len(), 4 * self.width);
        let sums = &mut self.sums[row / self.cell * self.columns..][..self.columns];
        for (sum, pixels) in sums.iter_mut().zip(rgba.chunks(4 * self.cell)) {
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
    /// closing, and pictures and coloured areas by interpolation from the paper around them.
    pub fn finish(self) -> PageLight {
        let (columns, rows) = (self.columns, self.rows);
        let mut known: Vec<bool> = self.sums.iter().map(|sum| sum[3] > 0).collect();
        let mut raw = Planes {
            width: columns,
            height: rows,
            channels: [0, 1, 2].map(|k| self.sums.iter().map(|sum| logarithm(sum, k)).collect()),
            scale: self.cell as f64,
        };
        fill_gaps(&mut raw.channels, &known, columns, rows);
        let longer = columns.max(rows) as f64;
        let radius = (0.5 * MAX_STROKE_SHARE * longer) as usize;
        let mut paper = closed(&raw, radius);
        let shown = known.iter().filter(|known| **known).count();
        find_paper(&raw, &paper, &mut known);
        let found = known.iter().filter(|known| **known).count();
        if (found as f64) < MIN_PAPER_SHARE * shown as f64 || found == 0 {
            return PageLight {
                gains: None,
                ..self.into()
            };
        }
        fill_gaps(&mut paper.channels, &known, columns, rows);
        let gains = paper.channels.each_mut().map(|plane| {
            box_mean(plane, columns, rows, SMOOTHING_RADIUS);
            let gain = |light: &f32| 255.0 / (WHITE_SHARE * (light.exp() - LOG_OFFSET).max(1.0));
            plane.iter().map(gain).collect()
        });
        PageLight {
            gains: Some(gains),
            ..self.into()
        }
    }
}

/// Returns the logarithm of the mean of colour component `k` over a cell.
fn logarithm(sum: &[u32; 4], k: usize) -> f32 {
    (sum[k] as f32 / sum[3].max(1) as f32 + LOG_OFFSET).ln()
}

/// The light on a flat page: the factors by which red, green and blue are multiplied in each cell, so that paper becomes
/// white.
#[derive(Debug, Clone)]
pub struct PageLight {
    cell: usize,
    columns: usize,
    rows: usize,
    /// `None` where the page is not mostly paper.
    gains: Option<[Vec<f32>; 3]>,
}

impl From<LightEstimator> for PageLight {
    fn from(
        LightEstimator {
            cell,
            columns,
            rows,
            ..
        }: LightEstimator,
    ) -> Self {
        PageLight {
            cell,
            columns,
            rows,
            gains: None,
        }
    }
}

impl PageLight {
    /// Whether light was found that can be evened; otherwise the page is not mostly paper, and [`apply`](Self::apply)
    /// changes nothing.
    pub fn is_even(&self) -> bool {
        self.gains.is_some()
    }

    /// What happens to the light by [`apply`](Self::apply).
    pub fn kind(&self) -> Light {
        match self.is_even() {
            true => Light::Even,
            false => Light::Keep,
        }
    }

    /// Evens the light in one row of RGBA pixels, counted from the top; the factors are bilinear between the cells'
    /// centres.
    pub fn apply(&self, row: usize, rgba: &mut [u8]) {
        let Some(gains) = &self.gains else { return };
        let (above, below, down) = neighbours(row, self.cell, self.rows);
        let line: Vec<[f32; 3]> = (0..self.columns)
            .map(|col| {
                gains.each_ref().map(|plane| {
                    let upper = plane[above * self.columns + col];
                    upper + down * (plane[below * self.columns + col] - upper)
                })
            })
            .collect();
        for (x, pixel) in rgba.as_chunks_mut::<4>().0.iter_mut().enumerate() {
            let (left, right, across) = neighbours(x, self.cell, self.columns);
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
