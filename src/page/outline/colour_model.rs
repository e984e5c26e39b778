//! Colour histograms of page and background, and masks of the page by their likelihood ratio.

use super::morphology::box_mean;
use super::planes::Planes;

/// Number of histogram bins for lightness, and for each of the two colour differences.
const BINS_PER_COMPONENT: [usize; 3] = [24, 16, 16];

/// Standard deviation of the noise of a reduced photo, in units of logarithmic colour.
pub(super) const COLOUR_NOISE: f64 = 0.01;

/// Radius, in pixels of the reduced photo at half resolution, of the square over which the probability of being page is
/// averaged.
/// Its row: `benches/page.md`, Constants of the outline.
const SMOOTHING_RADIUS: usize = 2;

/// Colours of a photo's pixels as numbers of histogram bins, by which page and background are told apart.
pub(super) struct ColourModel {
    bins: Vec<u16>,
    /// Lightness and two colour differences of each pixel; the differences do not change with the brightness of the light.
    pub axes: Vec<[f32; 3]>,
    width: usize,
    height: usize,
}

/// Computes the minimum and the maximum of values.
pub(super) fn range(values: impl Iterator<Item = f32>) -> [f32; 2] {
    values.fold([f32::MAX, f32::MIN], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

impl ColourModel {
    /// Assigns each pixel's colour to a histogram bin.
    pub fn new(planes: &Planes) -> Self {
        let [r, g, b] = &planes.channels;
        let axes: Vec<[f32; 3]> = (0..planes.len())
            .map(|i| [(r[i] + g[i] + b[i]) / 3.0, r[i] - g[i], b[i] - g[i]])
            .collect();
        let mut bins = vec![0_u16; axes.len()];
        for (axis, &count) in BINS_PER_COMPONENT.iter().enumerate() {
            let [low, high] = range(axes.iter().map(|colour| colour[axis]));
            let step = ((high - low) / count as f32).max(2.0 * COLOUR_NOISE as f32);
            for (bin, colour) in bins.iter_mut().zip(&axes) {
                let place = ((colour[axis] - low) / step).clamp(0.0, (count - 1) as f32);
                *bin = *bin * count as u16 + place as u16;
            }
        }
        ColourModel {
            bins,
            axes,
            width: planes.width,
            height: planes.height,
        }
    }

    /// Counts the relative frequency of each colour bin among some pixels, smoothed over neighbouring bins. Each bin has one
    /// pixel more, so that no frequency is 0.
    fn histogram(&self, pixels: impl Iterator<Item = usize>) -> Vec<f32> {
        let [n, m, k] = BINS_PER_COMPONENT;
        let mut counts = vec![1.0_f32; n * m * k];
        pixels.for_each(|i| counts[usize::from(self.bins[i])] += 1.0);
        for (stride, length) in [(m * k, n), (k, m), (1, k)] {
            let before = counts.clone();
            for (i, count) in counts.iter_mut().enumerate() {
                let place = (i / stride) % length;
                let lower = if place > 0 { before[i - stride] } else { 0.0 };
                let upper = if place + 1 < length {
                    before[i + stride]
                } else {
                    0.0
                };
                *count = 0.25 * (lower + 2.0 * before[i] + upper);
            }
        }
        let norm = 1.0 / counts.iter().sum::<f32>();
        counts.iter().map(|count| count * norm).collect()
    }

    /// Returns the mask of the pixels whose colour is more frequent among the `page` pixels than among the `ground`
    /// (background) pixels.
    pub fn classify(
        &self,
        page: impl Iterator<Item = usize>,
        ground: impl Iterator<Item = usize>,
    ) -> Vec<bool> {
        let (page, ground) = (self.histogram(page), self.histogram(ground));
        let share: Vec<f32> = page.iter().zip(&ground).map(|(p, q)| p / (p + q)).collect();
        let mut plane: Vec<f32> = self
            .bins
            .iter()
            .map(|bin| share[usize::from(*bin)])
            .collect();
        box_mean(&mut plane, self.width, self.height, SMOOTHING_RADIUS);
        plane.iter().map(|share| *share > 0.5).collect()
    }

    /// Refines a mask of the page: counts the colours inside and outside of it, and classifies all pixels by these histograms.
    pub fn refine(&self, mask: &[bool]) -> Vec<bool> {
        let pixels = |inside: bool| (0..mask.len()).filter(move |i| mask[*i] == inside);
        self.classify(pixels(true), pixels(false))
    }
}
