//! Whether what is left of heights is noise, which does not go on along the rulings.

/// Stripes across the rulings, and the blocks into which each is cut along them.
const STRIPES: usize = 12;
const BLOCKS: usize = 48;

/// Share of the rulings at either end that is not looked at: depths are biased at outlines.
const ENDS: f64 = 0.04;

/// Blocks in half a long stretch, and in half the short one that it is compared with.
const LONG: [usize; 3] = [24, 12, 6];
const SHORT: usize = 3;

/// Parts of the rulings whose means are correlated, and how far apart they are at most.
const PARTS: usize = 12;
const LAGS: usize = 6;

/// What both tests come to for noise that is alike over a part of the short stretch, as depths' is: smoothed by a
/// Gaussian of 2 pixels, on pages half as large as the image.
const USUAL: f64 = 4.7;

/// Most of the excess that a cylinder has.
pub(super) const MOST: f64 = 1.95;

/// What is left of a height, at a share of the way across the rulings and at a place along them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rest {
    pub across: f64,
    pub along: f64,
    pub value: f64,
    pub weight: f64,
}

/// Sums over blocks: of weighted values, and of weights.
type Sum = [f64; 2];

fn sum(blocks: &[Sum]) -> Sum {
    let add = |[value, weight]: Sum, block: &Sum| [value + block[0], weight + block[1]];
    blocks.iter().fold([0.0; 2], add)
}

/// How much more of what is left goes on along the rulings than of noise, which has about 1: the geometric mean of
/// two tests. Means over long stretches vary no more than the number of their heights lets expect from short ones;
/// and means over parts of the rulings are not correlated. It is not a number where there is too little to tell.
pub(super) fn excess(rest: impl Iterator<Item = Rest> + Clone) -> f64 {
    let blocks = blocks(rest);
    let all: f64 = blocks.iter().flatten().map(|block| block[1]).sum();
    if blocks.iter().flatten().all(|block| block[0] == 0.0) {
        return 0.0;
    }
    // Corners of a sheet that lies askew have few.
    let few = |blocks: usize| 0.25 * all * blocks as f64 / (STRIPES * BLOCKS) as f64;
    (variances(&blocks, few) * correlations(&blocks, few) / USUAL).sqrt()
}

fn blocks(rest: impl Iterator<Item = Rest> + Clone) -> [[Sum; BLOCKS]; STRIPES] {
    let stripe = |across: f64| ((across * STRIPES as f64) as usize).min(STRIPES - 1);
    let mut spans = [[f64::INFINITY, f64::NEG_INFINITY]; STRIPES];
    for Rest { across, along, .. } in rest.clone() {
        let [low, high] = &mut spans[stripe(across)];
        (*low, *high) = (low.min(along), high.max(along));
    }
    let mut blocks = [[[0.0; 2]; BLOCKS]; STRIPES];
    for rest in rest {
        let stripe = stripe(rest.across);
        let [low, high] = spans[stripe];
        let share = ((rest.along - low) / (high - low) - ENDS) / (1.0 - 2.0 * ENDS);
        if (0.0..1.0).contains(&share) {
            let block = &mut blocks[stripe][(share * BLOCKS as f64) as usize];
            block[0] += rest.weight * rest.value;
            block[1] += rest.weight;
        }
    }
    blocks
}

/// The variance of long stretches over that of short ones: by differences between both halves of each.
fn variances(blocks: &[[Sum; BLOCKS]; STRIPES], few: impl Fn(usize) -> f64) -> f64 {
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
    let [long, lengths] = sum(&LONG.map(squares));
    let [short, shorts] = squares(SHORT);
    (long / lengths) / (short / shorts)
}

/// Squares of the correlations between parts of the rulings, over what they have by chance (G. E. P. Box, D. A. Pierce,
/// *Distribution of residual autocorrelations*, 1970).
fn correlations(blocks: &[[Sum; BLOCKS]; STRIPES], few: impl Fn(usize) -> f64) -> f64 {
    let length = BLOCKS / PARTS;
    let means = blocks.map(|stripe| {
        let mut parts = stripe.chunks_exact(length).map(sum);
        [(); PARTS].map(|()| {
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
    for lag in 1..=LAGS {
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
    found / LAGS as f64
}
