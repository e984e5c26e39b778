//! Bands of ink across a flattened page, tracked from strip to strip: candidates for lines of text.

use super::ink::InkImage;
use super::ranking::ranked;
use crate::page::best_path::parabola_peak;

/// Ink of a page by strips: mean darkness of each row of pixels in each of the vertical strips into which the page is
/// divided.
pub(super) struct StripProfiles {
    /// Width of a vertical strip, in pixels of the ink image.
    pub step: f64,
    profiles: Vec<Vec<f32>>,
}

/// Mean darkness of each row in each vertical strip of a page, smoothed along the columns by a Gaussian.
pub(super) struct SmoothedProfiles(pub Vec<Vec<f32>>);

/// Centre line of a band of ink, which may be a line of text: for each vertical strip that it crosses, the strip's
/// number and the row.
pub(super) type Band = Vec<(usize, f64)>;

/// Number of vertical strips into which a page is divided: each is about two letters of body text on A4 wide.
const STRIPS_ACROSS: usize = 48;

/// Minimum width of a vertical strip, in pixels of the ink image.
/// Its row: `benches/page.md`, One rule at a time.
const MIN_STRIP_PIXELS: usize = 6;

/// Minimum number of vertical strips that a band of ink has to cross to be a line of text.
/// Its row: `benches/page.md`, One rule at a time.
pub(super) const MIN_BAND_STRIPS: usize = 8;

/// Maximum number of consecutive vertical strips in which a band of ink may be interrupted.
/// Its row: `benches/page.md`, Models.
const MAX_MISSING_STRIPS: usize = 2;

/// Minimum contrast of a band of ink: negative second derivative of the darkness across it, times the square of half
/// the searched x-height.
/// Its row: `benches/page.md`, One rule at a time.
const MIN_BAND_CONTRAST: f32 = 0.03;

/// Weight of the print's distance below the page's middle, in shares of the page's height, against the skewness of its letters
/// (`benches/outline.md`, Orientation).
const LOWER_HALF_WEIGHT: f64 = 3.0;

impl StripProfiles {
    /// Computes the mean darkness of each row in each vertical strip of an ink image.
    pub fn new(ink: &InkImage) -> Self {
        let count = STRIPS_ACROSS.min(ink.width / MIN_STRIP_PIXELS).max(1);
        let step = ink.width as f64 / count as f64;
        let edge = |k: usize| ((k as f64 * step) as usize).min(ink.width);
        let blocks: Vec<Vec<f32>> = (0..count)
            .map(|k| {
                let (from, to) = (edge(k), edge(k + 1).max(edge(k) + 1));
                (0..ink.height)
                    .map(|row| {
                        let own = &ink.data[row * ink.width..][from..to];
                        own.iter().sum::<f32>() / (to - from) as f32
                    })
                    .collect()
            })
            .collect();
        // Averaged with the neighbours, which count half.
        let profiles = (0..count)
            .map(|k| {
                let [before, after] = [k.saturating_sub(1), (k + 1).min(count - 1)];
                (0..ink.height)
                    .map(|row| {
                        0.25 * (blocks[before][row] + 2.0 * blocks[k][row] + blocks[after][row])
                    })
                    .collect()
            })
            .collect();
        StripProfiles { step, profiles }
    }

    /// How much the print seems to be upside down; negative where it is upright. Letters end more steeply at their baseline than
    /// above, where more of them go on, and a page has more print in its upper half.
    pub fn upside_down(&self) -> f64 {
        let (mut rise, mut steps, mut print, mut lower) = (0.0, 1e-12, 1e-12, 0.0);
        for profile in &self.profiles {
            for pair in profile.windows(2) {
                let step = f64::from(pair[1] - pair[0]).powi(3);
                rise += step;
                steps += step.abs();
            }
            for (row, ink) in profile.iter().enumerate() {
                print += f64::from(*ink);
                lower += f64::from(*ink) * ((row as f64 + 0.5) / profile.len() as f64 - 0.5);
            }
        }
        rise / steps + LOWER_HALF_WEIGHT * lower / print
    }

    /// Smooths the darkness along the columns by a Gaussian with standard deviation `sigma`, in pixels.
    pub fn smoothed(&self, sigma: f64) -> SmoothedProfiles {
        let reach = (3.0 * sigma).ceil() as usize;
        let kernel: Vec<f32> = (0..=2 * reach)
            .map(|i| (-0.5 * ((i as f64 - reach as f64) / sigma).powi(2)).exp() as f32)
            .collect();
        let norm: f32 = kernel.iter().sum();
        let smooth = |profile: &Vec<f32>| -> Vec<f32> {
            let last = profile.len() as isize - 1;
            (0..=last)
                .map(|row| {
                    let near = |i: usize| {
                        profile[(row + i as isize - reach as isize).clamp(0, last) as usize]
                    };
                    kernel
                        .iter()
                        .enumerate()
                        .map(|(i, k)| k * near(i))
                        .sum::<f32>()
                        / norm
                })
                .collect()
        };
        SmoothedProfiles(self.profiles.iter().map(smooth).collect())
    }
}

impl SmoothedProfiles {
    /// Finds the rows where the vertical strip number `strip` crosses a line of text with half x-height `sigma`: maxima
    /// of the darkness's negative second derivative.
    fn peaks(&self, strip: usize, sigma: f64) -> Vec<f64> {
        let p = &self.0[strip];
        let scale = (sigma * sigma) as f32;
        let bent = |row: usize| scale * (2.0 * p[row] - p[row - 1] - p[row + 1]);
        (2..p.len().saturating_sub(2))
            .filter_map(|row| {
                let [a, b, c] = [bent(row - 1), bent(row), bent(row + 1)];
                (b > MIN_BAND_CONTRAST && b >= a && b > c)
                    .then(|| row as f64 + parabola_peak([a, b, c]))
            })
            .collect()
    }

    /// Tracks bands of ink with half x-height `sigma`, in pixels, from one vertical strip to the next; `step` is the
    /// width of a strip in pixels.
    pub fn bands(&self, sigma: f64, step: f64) -> Vec<Band> {
        struct OpenBand {
            band: Band,
            slope: f64,
        }
        let mut open: Vec<OpenBand> = Vec::new();
        let mut found = Vec::new();
        for strip in 0..self.0.len() {
            let peaks = self.peaks(strip, sigma);
            let mut pairs = Vec::new();
            for (i, one) in open.iter().enumerate() {
                let (last, row) = one.band[one.band.len() - 1];
                let gone = (strip - last) as f64;
                let ahead = row + one.slope * gone * step;
                // Up to half the x-height off in the next strip.
                let reach = sigma * gone.sqrt();
                let from = peaks.partition_point(|y| *y < ahead - reach);
                for (j, y) in peaks.iter().enumerate().skip(from) {
                    if *y > ahead + reach {
                        break;
                    }
                    pairs.push(((y - ahead).abs() * gone, i, j));
                }
            }
            let gaps: Vec<f64> = pairs.iter().map(|pair| pair.0).collect();
            let mut taken = vec![false; peaks.len()];
            let mut continued = vec![false; open.len()];
            for k in ranked(&gaps) {
                let (_, i, j) = pairs[k];
                if taken[j] || continued[i] {
                    continue;
                }
                (taken[j], continued[i]) = (true, true);
                let one = &mut open[i];
                let (last, row) = one.band[one.band.len() - 1];
                let slope = (peaks[j] - row) / ((strip - last) as f64 * step);
                one.slope = 0.75 * one.slope + 0.25 * slope;
                one.band.push((strip, peaks[j]));
            }
            let (on, ended): (Vec<_>, Vec<_>) = open
                .into_iter()
                .partition(|one| strip - one.band[one.band.len() - 1].0 <= MAX_MISSING_STRIPS);
            found.extend(ended.into_iter().map(|one| one.band));
            open = on;
            for (row, _) in peaks.iter().zip(&taken).filter(|(_, taken)| !**taken) {
                open.push(OpenBand {
                    band: vec![(strip, *row)],
                    slope: 0.0,
                });
            }
        }
        found.extend(open.into_iter().map(|one| one.band));
        found.retain(|band| band.len() >= MIN_BAND_STRIPS);
        found
    }

    /// Finds the row of the lower edge of a band of ink in one vertical strip, where the darkness decreases most
    /// steeply. `row` is the band's middle, `sigma` half the x-height. None if there is no such row nearby.
    pub fn baseline(&self, strip: usize, row: f64, sigma: f64) -> Option<f64> {
        let p = &self.0[strip];
        let [from, to] = [0.1, 2.4].map(|k| (row + k * sigma).round());
        let [from, to] = [
            from.max(2.0) as usize,
            to.min(p.len() as f64 - 3.0) as usize,
        ];
        let drop = |row: usize| p[row - 1] - p[row + 1];
        let best = (from..=to).max_by(|i, j| drop(*i).total_cmp(&drop(*j)))?;
        let [a, b, c] = [drop(best - 1), drop(best), drop(best + 1)];
        (b > 0.0 && b >= a && b >= c).then(|| best as f64 + parabola_peak([a, b, c]))
    }
}
