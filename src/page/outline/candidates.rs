//! Candidate masks of a page, by thresholds of lightness and colour and by models of both.

use super::colour_model::{ColourModel, opponent_axes};
use super::planes::Planes;

/// Width of the photo's frame that is taken for ground at first, as a share of its sides.
const FRAME_SHARE: f64 = 0.04;

/// Distance from the photo's rim of the middle that is taken for the page at first, as a share of its sides.
const MIDDLE_SHARE: f64 = 0.25;

/// Number of levels of grey that thresholds are chosen from.
const THRESHOLD_LEVELS: usize = 128;

/// Whether each pixel is of the photo's frame, and whether it is of its middle.
fn frame_and_middle(width: usize, height: usize) -> [Vec<bool>; 2] {
    let depth = |i: usize| {
        let share = |at: usize, size: usize| {
            let at = (at as f64 + 0.5) / size as f64;
            at.min(1.0 - at)
        };
        share(i % width, width).min(share(i / width, height))
    };
    let within = |test: &dyn Fn(f64) -> bool| (0..width * height).map(|i| test(depth(i))).collect();
    [
        within(&|depth| depth < FRAME_SHARE),
        within(&|depth| depth > MIDDLE_SHARE),
    ]
}

/// The thresholds that divide values into two, and into three, classes of the least variance (Otsu): one, and two.
fn otsu_thresholds(values: &[f32]) -> Vec<f32> {
    let (low, high) = values.iter().fold((f32::MAX, f32::MIN), |(low, high), v| {
        (low.min(*v), high.max(*v))
    });
    let step = (high - low) / THRESHOLD_LEVELS as f32;
    if !(step > 0.0) {
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

/// The direction in colour that separates middle and frame best (Fisher's linear discriminant), applied to all pixels.
fn discriminant(colours: &[[f32; 3]], frame: &[bool], middle: &[bool]) -> Option<Vec<f32>> {
    let vector = |colour: &[f32; 3]| nalgebra::Vector3::from(*colour).cast::<f64>();
    let statistics = |mask: &[bool]| {
        let own: Vec<_> = (colours.iter().zip(mask))
            .filter_map(|(colour, own)| own.then(|| vector(colour)))
            .collect();
        let count = own.len().max(1) as f64;
        let mean = own.iter().sum::<nalgebra::Vector3<f64>>() / count;
        let scatter = own
            .iter()
            .map(|colour| (colour - mean) * (colour - mean).transpose())
            .sum::<nalgebra::Matrix3<f64>>()
            / count;
        (mean, scatter)
    };
    let ((ground, one), (page, other)) = (statistics(frame), statistics(middle));
    // The square of the noise of a reduced photo, so that the matrix has an inverse.
    let scatter = one + other + nalgebra::Matrix3::identity() * 1e-4;
    let direction = scatter.cholesky()?.solve(&(page - ground));
    let norm = direction.norm();
    if !(norm > 0.0) {
        return None;
    }
    let direction = direction / norm;
    Some(
        colours
            .iter()
            .map(|colour| vector(colour).dot(&direction) as f32)
            .collect(),
    )
}

/// Masks that may be a page, of an image without print; most of them are alike where the page is easily seen.
pub(super) fn candidate_masks(planes: &Planes) -> Vec<Vec<bool>> {
    let [r, g, b] = &planes.channels;
    let colours: Vec<[f32; 3]> = (0..planes.len()).map(|i| [r[i], g[i], b[i]]).collect();
    let [frame, middle] = frame_and_middle(planes.width, planes.height);
    let model = ColourModel::new(planes);
    let pixels = |mask: &'_ [bool]| {
        let found: Vec<usize> = (0..mask.len()).filter(|i| mask[*i]).collect();
        found.into_iter()
    };
    let mut masks = vec![model.refine(model.classify(pixels(&middle), pixels(&frame)))];
    let axis = |k: usize| -> Vec<f32> { colours.iter().map(|c| opponent_axes(*c)[k]).collect() };
    let saturation: Vec<f32> = colours
        .iter()
        .map(|[r, g, b]| r.min(*g).min(*b) - r.max(*g).max(*b))
        .collect();
    let mut features = vec![axis(0), saturation, axis(2)];
    features.extend(discriminant(&colours, &frame, &middle));
    for feature in features {
        for threshold in otsu_thresholds(&feature) {
            let mask: Vec<bool> = feature.iter().map(|value| *value > threshold).collect();
            masks.push(model.refine(mask.clone()));
            masks.push(mask);
        }
    }
    masks
}
