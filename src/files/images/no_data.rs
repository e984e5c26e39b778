//! Values that programs write where nothing was measured, and that no tag of the file names.

use crate::files::Assumption;
use crate::files::assumption::rounded;
use crate::files::number_type::NumberType;

/// Replaces a value of no data by NaN wherever it stands among numbers of a type, in which it may be rounded: −9999.9 is
/// another number in 32 bits, and programs write those of 32 bits with more or fewer digits.
pub(super) fn remove(values: &mut [f64], missing: f64, number_type: NumberType) {
    let stored = match number_type {
        NumberType::F16 if missing != 0.0 && missing.is_finite() => {
            let last_bit = (missing.abs().log2().floor() - 10.0).exp2();
            (missing / last_bit).round_ties_even() * last_bit
        }
        _ => missing,
    };
    let is_wide = matches!(number_type, NumberType::F32 | NumberType::F64);
    let is_missing = |value: f64| value == stored || is_wide && value as f32 == stored as f32;
    for value in values.iter_mut().filter(|value| is_missing(**value)) {
        *value = f64::NAN;
    }
}

/// Smallest magnitude that no height, depth or level has: it stands for no data wherever it is the largest value.
const MIN_IMPOSSIBLE_MAGNITUDE: f64 = 1e9;

/// Number of times that an extreme value repeats at least for it to be no data, unless nobody would measure it even once.
const MIN_REPETITIONS: usize = 2;

/// Replaces values that nobody would measure by NaN, and returns what was assumed of them.
///
/// Infinities are no data. So is the smallest or the largest value if it is a number by which programs mark missing
/// values ([`is_marker`]; where the file names its own value, `is_named`, one that nobody would measure), repeats exactly, and lies farther from all other values than these, of which there are several, lie
/// from each other.
pub(super) fn assume_no_data(values: &mut [f64], is_named: bool) -> Vec<Assumption> {
    let mut assumptions = Vec::new();
    let mut remove = |values: &mut [f64], name: String, is_missing: &dyn Fn(f64) -> bool| {
        let mut count = 0;
        for value in values.iter_mut().filter(|value| is_missing(**value)) {
            *value = f64::NAN;
            count += 1;
        }
        if count > 0 {
            let pixels = if count == 1 { "pixel" } else { "pixels" };
            let words = format!("{name} is no data ({count} {pixels})");
            assumptions.push(Assumption::new("noData", words, "noData"));
        }
    };
    remove(values, "infinity".into(), &f64::is_infinite);
    let is_told = |marker: &f64| !is_named || is_never_measured(*marker);
    while let Some(marker) = marker_of(values).filter(is_told) {
        // Nobody reads the 39 digits of the largest number of 32 bits.
        let name = match marker.abs() >= MIN_IMPOSSIBLE_MAGNITUDE {
            true => format!("{:e}", rounded(marker, 3)),
            false => format!("{marker}"),
        };
        remove(values, name, &|value| value == marker);
    }
    assumptions
}

/// The extreme value that stands for no data, if there is one.
fn marker_of(values: &[f64]) -> Option<f64> {
    // The two smallest and the two largest of the distinct values.
    let [mut low, mut high] = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for value in values.iter().copied().filter(|value| !value.is_nan()) {
        if value < low[0] {
            low = [value, low[0]];
        } else if value > low[0] && value < low[1] {
            low[1] = value;
        }
        if value > high[0] {
            high = [value, high[0]];
        } else if value < high[0] && value > high[1] {
            high[1] = value;
        }
    }
    let is_repeated_marker = |value: f64| {
        let count = || values.iter().filter(|other| **other == value).count();
        is_marker(value) && (is_never_measured(value) || count() >= MIN_REPETITIONS)
    };
    let [is_low, is_high] = [low[0], high[0]].map(is_repeated_marker);
    let (below, above) = (low[1] - low[0], high[0] - high[1]);
    // The gap beside an end, and the range of the other values; both ends may be markers.
    let candidates = [
        (is_low, low[0], below, high[0] - low[1]),
        (is_high, high[0], above, high[1] - low[0]),
        (is_low && is_high, low[0], below, high[1] - low[1]),
        (is_low && is_high, high[0], above, high[1] - low[1]),
    ];
    (candidates.into_iter())
        .find(|(may_be, _, gap, range)| *may_be && gap.is_finite() && *range > 0.0 && gap > range)
        .map(|(_, value, ..)| value)
}

/// Whether a number has at least as many nines as are given, and nothing else.
fn is_nines(value: f64, count: usize) -> bool {
    let digits = format!("{}", value.abs()).replace('.', "");
    digits.len() >= count && digits.bytes().all(|digit| digit == b'9')
}

/// Whether a number that is the largest or smallest one stands for no data although it is there once: it is beyond what anybody
/// measures, or has a minus and four or more nines.
fn is_never_measured(value: f64) -> bool {
    value.abs() >= MIN_IMPOSSIBLE_MAGNITUDE || value < 0.0 && is_nines(value, 4)
}

/// Whether a number is one by which programs mark missing values: zero, minus one, one that nobody measures, three or more nines
/// with nothing else, two of them with a minus, or a limit of a number type of 16 or more bits.
fn is_marker(value: f64) -> bool {
    let limits = [65_504.0, 65_535.0, 32_767.0, 32_768.0, 2_147_483_647.0];
    let is_limit = limits
        .iter()
        .any(|limit| (value.abs() - limit).abs() <= 1.0);
    [0.0, -1.0].contains(&value)
        || is_never_measured(value)
        || is_limit
        || is_nines(value, if value < 0.0 { 2 } else { 3 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_of_no_data_is_rounded_as_it_is_stored() {
        // 16-bit floats between 8192 and 16384 are multiples of 8, as numpy.float16 has them.
        for (missing, number_type, stored) in [
            (-9999.0, NumberType::F16, -10000.0),
            (65504.0, NumberType::F16, 65504.0),
            (0.1, NumberType::F16, 0.0999755859375),
            (-9999.9, NumberType::F32, -9999.900390625),
            (-9999.9, NumberType::F64, -9999.9),
            (-3.402_823_5e38, NumberType::F64, f64::from(f32::MIN)),
            (-2_147_483_647.0, NumberType::I32, -2_147_483_647.0),
        ] {
            let mut values = [stored, -2_147_483_648.0];
            remove(&mut values, missing, number_type);
            assert_eq!(
                values.map(f64::is_nan),
                [true, false],
                "{missing} {number_type:?}"
            );
        }
    }

    /// What is assumed of values.
    fn told(mut values: Vec<f64>) -> Vec<String> {
        let before = values.clone();
        let told = assume_no_data(&mut values, false);
        let missing = values.iter().filter(|value| value.is_nan()).count();
        assert_eq!(told.is_empty(), missing == 0, "{before:?}");
        told.into_iter().map(|one| one.words).collect()
    }

    /// What is assumed of values beside heights between 200 and 4800.
    fn assumed(more: &[f64]) -> Vec<String> {
        let heights = (0..100).map(|i| 200.0 + 46.0 * f64::from(i));
        told(heights.chain(more.iter().copied()).collect())
    }

    #[test]
    fn what_programs_write_for_no_data_is_none() {
        for marker in [
            -9999.0,
            -32768.0,
            -32767.0,
            65535.0,
            -3.402_823_466_385_288_6e38,
            1e10,
            1e20,
            -99999.0,
        ] {
            let words = assumed(&[marker; 3]).concat();
            assert!(words.ends_with(" is no data (3 pixels)"), "{words}");
            let named: f64 = words.split(' ').next().unwrap().parse().unwrap();
            assert!((named / marker - 1.0).abs() < 1e-2, "{words}");
        }
        for (more, words) in [
            (&[-3.402_823_5e38; 2][..], "-3.4e38 is no data (2 pixels)"),
            (&[f64::INFINITY], "infinity is no data (1 pixel)"),
            (&[-9999.0], "-9999 is no data (1 pixel)"),
        ] {
            assert_eq!(assumed(more), [words]);
        }
        assert_eq!(assumed(&[-9999.0, 1e20, -9999.0, 1e20]).len(), 2);
        // Zero far from all heights: the frame of a map, or what a camera did not see.
        for (values, words) in [
            (
                [-99.0, -99.0, 250.0, 252.0, 252.0],
                "-99 is no data (2 pixels)",
            ),
            (
                [0.0, 0.0, 2000.0, 2030.0, 2060.0],
                "0 is no data (2 pixels)",
            ),
            ([-1.0, -1.0, 40.0, 41.0, 60.0], "-1 is no data (2 pixels)"),
        ] {
            assert_eq!(told(values.into()), [words]);
        }
    }

    #[test]
    fn what_may_have_been_measured_stays() {
        // Zeros that may be the sea, single outliers, round numbers, and a marker within the range of the others.
        for more in [
            &[0.0; 9][..],
            &[9999.0],
            &[-32768.0],
            &[-10000.0; 3],
            &[20000.0; 9],
            &[999.0; 5],
        ] {
            assert_eq!(assumed(more), [""; 0]);
        }
        // Levels of which the highest is no marker, terraces of two heights, and a mask of 16 bits.
        for values in [
            [0.0, 0.0, 5.0, 6.0, 20.0],
            [0.0, 99.0, 0.0, 99.0, 0.0],
            [0.0, 65535.0, 65535.0, 0.0, 65535.0],
        ] {
            assert_eq!(told(values.into()), [""; 0]);
        }
        let bathymetry = (0..2000).map(|i| -11_000.0 + 9.0 * f64::from(i));
        assert_eq!(told(bathymetry.chain([-9999.0; 4]).collect()), [""; 0]);
        // Beside a named value a plateau at the highest level was measured.
        for (marker, is_told) in [(65535.0, false), (-9999.0, true)] {
            let mut levels = [1.0, 900.0, marker, marker, f64::NAN];
            assert_eq!(assume_no_data(&mut levels, true).is_empty(), !is_told);
            assert_eq!(levels[2].is_nan(), is_told);
        }
    }
}
