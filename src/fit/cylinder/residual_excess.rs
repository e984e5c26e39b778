//! Test whether the residuals of a cylinder's fit are noise, which is not correlated along the rulings.

/// Minimum weight of a stretch of residuals that is tested, as a share of the weight it would have if all blocks had
/// the same.
const MIN_WEIGHT_SHARE: f64 = 0.25;

/// Number of stripes, side by side across the rulings, that residuals are divided into.
const STRIPE_COUNT: usize = 12;

/// Number of blocks along the rulings that each stripe of residuals is divided into.
const BLOCKS_PER_STRIPE: usize = 48;

/// Share of the rulings at either end whose residuals are left out: depths are biased at outlines.
const END_SHARE: f64 = 0.04;

/// Number of blocks of residuals in half of a long stretch of the rulings, for each length of stretches whose variance
/// is tested.
const LONG_HALF_BLOCKS: [usize; 3] = [
    BLOCKS_PER_STRIPE / 2,
    BLOCKS_PER_STRIPE / 4,
    BLOCKS_PER_STRIPE / 8,
];

/// Number of blocks of residuals in half of a short stretch of the rulings, whose variance that of long stretches is
/// compared with.
const SHORT_HALF_BLOCKS: usize = BLOCKS_PER_STRIPE / 16;

/// Number of parts of the rulings whose mean residuals are tested for correlation.
const CORRELATED_PARTS: usize = 12;

/// Maximum distance, in parts, of two parts of the rulings that are tested for correlation.
const MAX_LAG_PARTS: usize = CORRELATED_PARTS / 2;

/// Minimum product of the ratios that [`variance_ratio`] and [`correlation_ratio`] are expected to find for noise: that of noise of
/// depth images, smoothed by a Gaussian of 2 pixels, on pages half as large as the image.
const MIN_NOISE_PRODUCT: f64 = 4.7;

/// Minimum extent of the heights, in correlation lengths of their noise: on narrower pages noise is taken for a tilt
/// (`benches/verdicts.md`, Smooth noise).
const MIN_EXTENT_LENGTHS: f64 = 14.0;

/// Maximum excess of the residuals' correlation at which a surface counts as a cylinder. Chosen on the pages of
/// `benches/README.md` and three more draws of their noise.
pub(super) const MAX_CYLINDER_EXCESS: f64 = 1.95;

/// Residual of one height from the fitted cylinder.
#[derive(Debug, Clone, Copy)]
pub(super) struct FitResidual {
    /// Position across the rulings, as a share of the cylinder's width, from 0 to 1.
    pub across: f64,
    /// Position along the rulings, in the heights' unit of length.
    pub along: f64,
    /// Height less the height of the cylinder at its position.
    pub value: f64,
    pub weight: f64,
}

/// Sums over a block of residuals: of weight times residual, and of weights.
type BlockSum = [f64; 2];

/// Adds up the sums of several blocks of residuals.
fn sum(blocks: &[BlockSum]) -> BlockSum {
    let add = |[value, weight]: BlockSum, block: &BlockSum| [value + block[0], weight + block[1]];
    blocks.iter().fold([0.0; 2], add)
}

/// Computes the excess of the residuals' correlation along the rulings over that of noise: about 1 for noise. It is the
/// geometric mean of two tests' ratios, each to what is expected of noise with a correlation length: whether means over long
/// stretches vary more than those over short ones and the number of heights let expect, and whether means over parts of the
/// rulings are correlated. `extent` is that of the heights across and along the rulings. NaN if there are too few heights, or
/// too few that are independent.
pub(super) fn residual_excess(
    rest: impl Iterator<Item = FitResidual> + Clone,
    extent: [f64; 2],
    correlation_length: f64,
) -> f64 {
    if extent[0].min(extent[1]) < MIN_EXTENT_LENGTHS * correlation_length {
        return f64::NAN;
    }
    let block = (1.0 - 2.0 * END_SHARE) * extent[1] / BLOCKS_PER_STRIPE as f64;
    let expected = noise_product(correlation_length / block).max(MIN_NOISE_PRODUCT);
    let blocks = block_sums(rest);
    let all: f64 = blocks.iter().flatten().map(|block| block[1]).sum();
    if blocks.iter().flatten().all(|block| block[0] == 0.0) {
        return 0.0;
    }
    // Stretches at the corners of a rotated sheet have too few heights.
    let few = |blocks: usize| {
        MIN_WEIGHT_SHARE * all * blocks as f64 / (STRIPE_COUNT * BLOCKS_PER_STRIPE) as f64
    };
    (variance_ratio(&blocks, few) * correlation_ratio(&blocks, few) / expected).sqrt()
}

/// Returns the product of the ratios that [`variance_ratio`] and [`correlation_ratio`] are expected to find for noise with a
/// Gaussian covariance, whose correlation length is given in blocks.
fn noise_product(correlation_length: f64) -> f64 {
    let correlation = |apart: usize| match apart {
        0 => 1.0,
        apart => (-(0.5 * apart as f64 / correlation_length).powi(2)).exp(),
    };
    // Covariance of the sums over stretches of blocks whose beginnings are so far apart.
    let covariance = |blocks: usize, apart: usize| -> f64 {
        let pairs = (0..blocks).flat_map(|a| (0..blocks).map(move |b| (apart + b).abs_diff(a)));
        pairs.map(correlation).sum()
    };
    let variance = |half: usize| (covariance(half, 0) - covariance(half, half)) / half as f64;
    let stretches = LONG_HALF_BLOCKS.map(|half| (BLOCKS_PER_STRIPE / (2 * half)) as f64);
    let long = LONG_HALF_BLOCKS.iter().zip(stretches);
    let long = long
        .map(|(half, count)| count * variance(*half))
        .sum::<f64>();
    let variances = long / stretches.iter().sum::<f64>() / variance(SHORT_HALF_BLOCKS);
    let length = BLOCKS_PER_STRIPE / CORRELATED_PARTS;
    let squared = |lag: usize| (covariance(length, lag * length) / covariance(length, 0)).powi(2);
    let by_chance = 1.0 + 2.0 * (1..CORRELATED_PARTS).map(squared).sum::<f64>();
    let pairs = |lag: usize| (STRIPE_COUNT * (CORRELATED_PARTS - lag)) as f64;
    let found = (1..=MAX_LAG_PARTS).map(|lag| pairs(lag) * squared(lag) + by_chance);
    variances * found.sum::<f64>() / MAX_LAG_PARTS as f64
}

/// Sums the residuals in each block of each stripe.
fn block_sums(
    rest: impl Iterator<Item = FitResidual> + Clone,
) -> [[BlockSum; BLOCKS_PER_STRIPE]; STRIPE_COUNT] {
    let stripe = |across: f64| ((across * STRIPE_COUNT as f64) as usize).min(STRIPE_COUNT - 1);
    let mut spans = [[f64::INFINITY, f64::NEG_INFINITY]; STRIPE_COUNT];
    for FitResidual { across, along, .. } in rest.clone() {
        let [low, high] = &mut spans[stripe(across)];
        (*low, *high) = (low.min(along), high.max(along));
    }
    let mut blocks = [[[0.0; 2]; BLOCKS_PER_STRIPE]; STRIPE_COUNT];
    for rest in rest {
        let stripe = stripe(rest.across);
        let [low, high] = spans[stripe];
        let share = ((rest.along - low) / (high - low) - END_SHARE) / (1.0 - 2.0 * END_SHARE);
        if (0.0..1.0).contains(&share) {
            let block = &mut blocks[stripe][(share * BLOCKS_PER_STRIPE as f64) as usize];
            block[0] += rest.weight * rest.value;
            block[1] += rest.weight;
        }
    }
    blocks
}

/// Returns the ratio of the residuals' variances over long and over short stretches of the rulings, by the differences
/// between the halves of each stretch. `few` gives the minimum weight that a number of blocks needs in order to count.
fn variance_ratio(
    blocks: &[[BlockSum; BLOCKS_PER_STRIPE]; STRIPE_COUNT],
    few: impl Fn(usize) -> f64,
) -> f64 {
    let squares = |half: usize| {
        let mut total = [0.0; 2];
        for pair in blocks
            .iter()
            .flat_map(|stripe| stripe.chunks_exact(2 * half))
        {
            let ([a, n], [b, m]) = (sum(&pair[..half]), sum(&pair[half..]));
            if n.min(m) > few(half) {
                total[0] += (a / n - b / m).powi(2) / (1.0 / n + 1.0 / m);
                total[1] += 1.0;
            }
        }
        total
    };
    let [long, lengths] = sum(&LONG_HALF_BLOCKS.map(squares));
    let [short, shorts] = squares(SHORT_HALF_BLOCKS);
    (long / lengths) / (short / shorts)
}

/// Returns the mean ratio of the squared correlations between parts of the rulings to those expected by chance (G. E.
/// P. Box, D. A. Pierce, *Distribution of residual autocorrelations*, 1970). `few` gives the minimum weight that a
/// number of blocks needs in order to count.
fn correlation_ratio(
    blocks: &[[BlockSum; BLOCKS_PER_STRIPE]; STRIPE_COUNT],
    few: impl Fn(usize) -> f64,
) -> f64 {
    let length = BLOCKS_PER_STRIPE / CORRELATED_PARTS;
    let means = blocks.map(|stripe| {
        let mut parts = stripe.chunks_exact(length).map(sum);
        [(); CORRELATED_PARTS].map(|()| {
            let [value, weight] = parts.next().unwrap_or_default();
            (weight > few(length)).then(|| value / weight)
        })
    });
    let (mut squares, mut count) = (0.0, 0.0);
    for mean in means.iter().flatten().flatten() {
        squares += mean * mean;
        count += 1.0;
    }
    let mut found = 0.0;
    for lag in 1..=MAX_LAG_PARTS {
        let (mut products, mut pairs) = (0.0, 0.0);
        for stripe in &means {
            for (a, b) in stripe.iter().zip(&stripe[lag..]) {
                if let (Some(a), Some(b)) = (a, b) {
                    products += a * b;
                    pairs += 1.0;
                }
            }
        }
        found += (products * count / squares).powi(2) / pairs;
    }
    found / MAX_LAG_PARTS as f64
}
