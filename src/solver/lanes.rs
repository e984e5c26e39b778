//! Sums that vectorise: the additions run in a fixed number of lanes, so that
//! the result depends neither on the machine nor on its vector width.

const LANES: usize = 8;

/// `Σ f(i)` for `i` in `0..n`, with `f` called once for each `i` in order.
#[inline(always)]
pub(crate) fn sum(n: usize, mut f: impl FnMut(usize) -> f64) -> f64 {
    let mut lanes = [0.0; LANES];
    let whole = n - n % LANES;
    let mut i = 0;
    while i < whole {
        for (lane, total) in lanes.iter_mut().enumerate() {
            *total += f(i + lane);
        }
        i += LANES;
    }
    for (lane, total) in lanes.iter_mut().enumerate().take(n - whole) {
        *total += f(i + lane);
    }
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_term_once_and_in_order() {
        for n in [0, 1, 7, 8, 9, 16, 29] {
            let mut next = 0;
            let total = super::sum(n, |i| {
                assert_eq!(i, next);
                next += 1;
                i as f64
            });
            assert_eq!(total, (n * n.saturating_sub(1) / 2) as f64);
        }
    }
}
