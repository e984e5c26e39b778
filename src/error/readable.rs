//! Values in error messages, as people write them.

/// A value that can be written into an error message.
pub trait Readable {
    /// Returns the value as a person would write it: 0.5, 1e300 or infinity.
    fn readable(&self) -> String;
}

/// Range of absolute values that messages write without an exponent.
const PLAIN_MAGNITUDES: std::ops::Range<f64> = 1e-5..1e16;

/// Maximum number of items of a list that a message shows; the rest is an ellipsis.
const MAX_SHOWN_ITEMS: usize = 6;

/// Maximum number of letters of a text that a message shows; the rest is an ellipsis.
const MAX_SHOWN_LETTERS: usize = 80;

/// Number of decimals of a computed number's mantissa in messages: four significant digits in all.
const ROUNDED_DECIMALS: i32 = 3;

impl Readable for f64 {
    fn readable(&self) -> String {
        match *self {
            0.0 => "0".into(),
            f64::INFINITY => "infinity".into(),
            f64::NEG_INFINITY => "-infinity".into(),
            value if value.is_nan() || PLAIN_MAGNITUDES.contains(&value.abs()) => value.to_string(),
            value => format!("{value:e}"),
        }
    }
}

impl Readable for f32 {
    fn readable(&self) -> String {
        f64::from(*self).readable()
    }
}

impl Readable for usize {
    fn readable(&self) -> String {
        self.to_string()
    }
}

impl Readable for u32 {
    fn readable(&self) -> String {
        self.to_string()
    }
}

impl Readable for u8 {
    fn readable(&self) -> String {
        self.to_string()
    }
}

impl Readable for i32 {
    fn readable(&self) -> String {
        self.to_string()
    }
}

impl Readable for str {
    fn readable(&self) -> String {
        match self {
            "" => "\"\"".into(),
            text => match text.char_indices().nth(MAX_SHOWN_LETTERS) {
                Some((end, _)) => format!("{}…", &text[..end]),
                None => text.into(),
            },
        }
    }
}

impl Readable for String {
    fn readable(&self) -> String {
        self.as_str().readable()
    }
}

impl<T: Readable> Readable for [T] {
    fn readable(&self) -> String {
        let shown: Vec<String> = self.iter().take(MAX_SHOWN_ITEMS).map(T::readable).collect();
        let more = if self.len() > shown.len() {
            ", …"
        } else {
            ""
        };
        format!("[{}{more}]", shown.join(", "))
    }
}

impl<T: Readable, const N: usize> Readable for [T; N] {
    fn readable(&self) -> String {
        self.as_slice().readable()
    }
}

impl<T: Readable + ?Sized> Readable for &T {
    fn readable(&self) -> String {
        (**self).readable()
    }
}

/// Writes a computed number with about four significant digits, or with one if it is very large or small.
pub fn rounded(value: f64) -> String {
    if !PLAIN_MAGNITUDES.contains(&value.abs()) {
        return match value.is_normal() {
            true => format!("{value:.0e}"),
            false => value.readable(),
        };
    }
    // Not by way of its text: reading floats would cost each wasm file 15 kB.
    let scale = 10f64.powi(ROUNDED_DECIMALS - value.abs().log10().floor() as i32);
    match scale >= 1.0 {
        true => (value * scale).round() / scale,
        false => value.round(),
    }
    .readable()
}

/// Writes a count with a comma before every three digits, or as "billions of" if it does not fit into 32 bits.
pub(super) fn count(value: usize) -> String {
    if value >= u32::MAX as usize {
        return "billions of".into();
    }
    let digits = value.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_people_write_them() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (0.5, "0.5"),
            (-3.0, "-3"),
            (20_000.0, "20000"),
            (1e-5, "0.00001"),
            (1e300, "1e300"),
            (-2.5e-300, "-2.5e-300"),
            (f64::MAX, "1.7976931348623157e308"),
            (f64::INFINITY, "infinity"),
            (f64::NEG_INFINITY, "-infinity"),
            (f64::NAN, "NaN"),
        ];
        for (value, text) in cases {
            assert_eq!(value.readable(), text);
        }
        assert_eq!(rounded(2.819_865_836_443_307), "2.82");
        assert_eq!(rounded(-0.000_123_456), "-0.0001235");
        assert_eq!(rounded(123_456.7), "123457");
        assert_eq!(rounded(100.0 * 1e-300), "1e-298");
        assert_eq!(rounded(f64::INFINITY), "infinity");
    }

    #[test]
    fn counts_have_separators_and_no_saturated_digits() {
        let cases = [
            (0, "0"),
            (999, "999"),
            (1000, "1,000"),
            (20_971_520, "20,971,520"),
        ];
        for (value, text) in cases {
            assert_eq!(count(value), text);
        }
        for saturated in [u32::MAX as usize, usize::MAX] {
            assert_eq!(count(saturated), "billions of");
        }
    }

    #[test]
    fn long_lists_are_cut_and_texts_without_letters_are_seen() {
        assert_eq!(
            [[0.0, 1e300], [f64::NAN, 2.0]].readable(),
            "[[0, 1e300], [NaN, 2]]"
        );
        assert_eq!([7.0; 100].readable(), "[7, 7, 7, 7, 7, 7, …]");
        assert_eq!("".readable(), "\"\"");
        assert_eq!(
            "ä".repeat(1000).readable().chars().count(),
            MAX_SHOWN_LETTERS + 1
        );
    }
}
