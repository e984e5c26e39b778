//! Order of points along a space-filling curve (Morton 1966), so that neighbours in the order are near each
//! other.

/// Number of bits of each coordinate in a point's key on the space-filling curve: three coordinates make a key of 63
/// bits.
const AXIS_KEY_BITS: u32 = 21;

/// Returns the indices of points in their order along the space-filling curve.
pub(super) fn order(places: impl Iterator<Item = [f64; 3]> + Clone) -> Vec<u32> {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for place in places.clone() {
        for k in 0..3 {
            low[k] = low[k].min(place[k]);
            high[k] = high[k].max(place[k]);
        }
    }
    let size = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let steps = f64::from(1u32 << AXIS_KEY_BITS) - 1.0;
    let mut keys: Vec<(u64, u32)> = (0..)
        .zip(places)
        .map(|(number, place)| {
            let key = (0..3).map(|k| {
                // NaN becomes 0.
                let step = ((place[k] - low[k]) / size * steps) as u64;
                spread(step) << k
            });
            (key.fold(0, |key, bits| key | bits), number)
        })
        .collect();
    keys.sort_unstable();
    keys.into_iter().map(|(_, number)| number).collect()
}

/// Inserts two zero bits after each of the 21 lowest bits of a number.
fn spread(step: u64) -> u64 {
    let mut x = step & 0x1f_ffff;
    for (shift, mask) in [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ] {
        x = (x | x << shift) & mask;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_is_gone_through_by_its_eighths() {
        let cube = |i: usize| [i & 3, i >> 2 & 3, i >> 4].map(|x| x as f64);
        let order = order((0..64).map(cube));
        let mut seen = order.clone();
        seen.sort_unstable();
        assert_eq!(seen, (0..64).collect::<Vec<u32>>());
        for eighth in order.chunks_exact(8) {
            let halves = |i: &u32| cube(*i as usize).map(|x| x >= 2.0);
            assert!(eighth.iter().all(|i| halves(i) == halves(&eighth[0])));
        }
    }
}
