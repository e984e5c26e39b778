//! Candidate masks of a page in a photo, by thresholds of lightness and colour and by colour histograms of page and
//! background.

use super::colour_model::{COLOUR_NOISE, ColourModel, range};
use super::planes::Planes;

/// Width of the strip along the photo's rim that is initially taken for background, as a share of the photo's sides.
/// Its row: `benches/page.md`, Constants of the outline.
const FRAME_SHARE: f64 = 0.04;

/// Distance from the photo's rim of the central rectangle that is initially taken for the page, as a share of the
/// photo's sides.
/// Its row: `benches/page.md`, Constants of the outline.
const MIDDLE_SHARE: f64 = 0.25;

/// Number of levels to which pixel values are rounded when Otsu's thresholds are computed.
const THRESHOLD_LEVELS: usize = 128;

/// Pixels in the strip along the photo's rim, and those in the central rectangle.
fn frame_and_middle(width: usize, height: usize) -> [Vec<usize>; 2] {
    let depth = |i: usize| {
        let share = |at: usize, size: usize| {
            let at = (at as f64 + 0.5) / size as f64;
            at.min(1.0 - at)
        };
        share(i % width, width).min(share(i / width, height))
    };
    let pixels = 0..width * height;
    [
        pixels.clone().filter(|i| depth(*i) < FRAME_SHARE).collect(),
        pixels.filter(|i| depth(*i) > MIDDLE_SHARE).collect(),
    ]
}

/// Computes Otsu's thresholds of the values: the one that divides them into two classes of least variance, and the two
/// that divide them into three. Empty if all values are equal.
fn otsu_thresholds(values: &[f32]) -> Vec<f32> {
    let [low, high] = range(values.iter().copied());
    let step = (high - low) / THRESHOLD_LEVELS as f32;
    if step.is_nan() || step <= 0.0 {
        return Vec::new();
    }
    let mut counts = [0.0_f64; THRESHOLD_LEVELS];
    for value in values {
        counts[(((value - low) / step) as usize).min(THRESHOLD_LEVELS - 1)] += 1.0;
    }
    // Sums of counts and of levels below each one.
    let mut sums = [[0.0_f64; 2]; THRESHOLD_LEVELS + 1];
    for (k, count) in counts.iter().enumerate() {
        sums[k + 1] = [sums[k][0] + count, sums[k][1] + count * k as f64];
    }
    // What a class of these levels adds to the variance between classes.
    let between = |from: usize, to: usize| {
        let [count, sum] = [0, 1].map(|j| sums[to][j] - sums[from][j]);
        if count > 0.0 { sum * sum / count } else { 0.0 }
    };
    let (mut one, mut two) = ((f64::MIN, 0), (f64::MIN, [0, 0]));
    for t in 1..THRESHOLD_LEVELS {
        let value = between(0, t) + between(t, THRESHOLD_LEVELS);
        if value > one.0 {
            one = (value, t);
        }
        for u in t + 1..THRESHOLD_LEVELS {
            let value = between(0, t) + between(t, u) + between(u, THRESHOLD_LEVELS);
            if value > two.0 {
                two = (value, [t, u]);
            }
        }
    }
    [two.1[0], one.1, two.1[1]]
        .map(|level| low + step * level as f32)
        .to_vec()
}

/// Projects each pixel's colour (lightness and two colour differences) to the one number that separates the pixels
/// `middle` (page) and `frame` (background) best: Fisher's linear discriminant with independent components.
fn discriminant(axes: &[[f32; 3]], frame: &[usize], middle: &[usize]) -> Vec<f32> {
    let moments = |pixels: &[usize]| {
        let mut sums = [[0.0_f64; 2]; 3];
        let count = (pixels.len() as f64).max(1.0);
        for i in pixels {
            for (sum, value) in sums.iter_mut().zip(axes[*i]) {
                let value = f64::from(value);
                sum[0] += value;
                sum[1] += value * value;
            }
        }
        sums.map(|[sum, squares]| {
            let mean = sum / count;
            (mean, squares / count - mean * mean)
        })
    };
    let (ground, page) = (moments(frame), moments(middle));
    let weights = [0, 1, 2].map(|k| {
        ((page[k].0 - ground[k].0) / (page[k].1 + ground[k].1 + COLOUR_NOISE.powi(2))) as f32
    });
    (axes.iter())
        .map(|colour| (0..3).map(|k| weights[k] * colour[k]).sum())
        .collect()
}

/// Makes candidate masks of the page from a reduced photo whose print is suppressed, each saying for every pixel
/// whether it is page. Most of them are similar if the page is easy to see.
pub(super) fn candidate_masks(planes: &Planes) -> Vec<Vec<bool>> {
    let [frame, middle] = frame_and_middle(planes.width, planes.height);
    let model = ColourModel::new(planes);
    let first = model.classify(middle.iter().copied(), frame.iter().copied());
    let mut masks = vec![model.refine(&first)];
    let axis = |k: usize| model.axes.iter().map(|colour| colour[k]).collect();
    let saturation = (0..planes.len()).map(|i| {
        let [r, g, b] = planes.channels.each_ref().map(|plane| plane[i]);
        r.min(g).min(b) - r.max(g).max(b)
    });
    let features: [Vec<f32>; 4] = [
        axis(0),
        saturation.collect(),
        axis(2),
        discriminant(&model.axes, &frame, &middle),
    ];
    for feature in features {
        for threshold in otsu_thresholds(&feature) {
            let mask: Vec<bool> = feature.iter().map(|value| *value > threshold).collect();
            masks.push(model.refine(&mask));
            masks.push(mask);
        }
    }
    masks
}
