//! Types of numbers in files, and their values as 64-bit floats.

/// Type of the numbers of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberType {
    Bool,
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F16,
    F32,
    F64,
}

/// Types of numbers with their names, NumPy's letters for their kinds, and their numbers of bytes.
const NUMBER_TYPES: [(NumberType, &str, u8, usize); 12] = [
    (NumberType::Bool, "bool", b'b', 1),
    (NumberType::I8, "i8", b'i', 1),
    (NumberType::U8, "u8", b'u', 1),
    (NumberType::I16, "i16", b'i', 2),
    (NumberType::U16, "u16", b'u', 2),
    (NumberType::I32, "i32", b'i', 4),
    (NumberType::U32, "u32", b'u', 4),
    (NumberType::I64, "i64", b'i', 8),
    (NumberType::U64, "u64", b'u', 8),
    (NumberType::F16, "f16", b'f', 2),
    (NumberType::F32, "f32", b'f', 4),
    (NumberType::F64, "f64", b'f', 8),
];

impl NumberType {
    /// Returns the type of NumPy's letter for a kind and of a number of bytes.
    #[cfg(feature = "formats")]
    pub(super) fn from_numpy(kind: u8, bytes: usize) -> Option<Self> {
        let mut types = NUMBER_TYPES.into_iter();
        types
            .find_map(|(known, _, letter, size)| ((letter, size) == (kind, bytes)).then_some(known))
    }

    /// Returns the name of the type: `"u8"`, `"f32"` and so on.
    #[cfg(feature = "formats")]
    pub(super) fn name(self) -> &'static str {
        NUMBER_TYPES[self as usize].1
    }

    /// Returns the number of bytes of a number.
    pub(super) fn bytes(self) -> usize {
        NUMBER_TYPES[self as usize].3
    }

    /// Returns whether numbers of the type are floats.
    #[cfg(feature = "formats")]
    pub(super) fn is_float(self) -> bool {
        NUMBER_TYPES[self as usize].2 == b'f'
    }

    /// Returns the level of white if a picture's numbers of the type are levels, which are whole numbers of 8 or 16 bits from 0 on.
    #[cfg(feature = "formats")]
    pub(super) fn white_level(self) -> Option<f64> {
        match self {
            NumberType::U8 => Some(255.0),
            NumberType::U16 => Some(65535.0),
            _ => None,
        }
    }

    /// Returns the number that stands for 1 where integers are shares: the largest of the type; for floats 1.
    #[cfg(feature = "meshes")]
    pub(super) fn one(self) -> f64 {
        let bits = 8 * self.bytes() as i32;
        match NUMBER_TYPES[self as usize].2 {
            b'u' => 2f64.powi(bits) - 1.0,
            b'i' => 2f64.powi(bits - 1) - 1.0,
            _ => 1.0,
        }
    }

    /// Returns the value of the number that is stored at the start of `bytes`; bytes that are missing count as 0.
    pub(super) fn value(self, bytes: &[u8], is_big_endian: bool) -> f64 {
        let size = self.bytes();
        let mut own = [0; 8];
        let there = size.min(bytes.len());
        own[..there].copy_from_slice(&bytes[..there]);
        if is_big_endian {
            own[..size].reverse();
        }
        let bits = u64::from_le_bytes(own);
        let unused = 64 - 8 * size as u32;
        match self {
            NumberType::F64 => f64::from_bits(bits),
            NumberType::F32 => f32::from_bits(bits as u32).into(),
            NumberType::F16 => half_to_float(bits as u16),
            NumberType::Bool => f64::from(u8::from(bits != 0)),
            _ if NUMBER_TYPES[self as usize].2 == b'i' => {
                ((bits << unused) as i64 >> unused) as f64
            }
            _ => bits as f64,
        }
    }
}

/// Converts the bits of a 16-bit float: a sign, five bits of exponent, ten of fraction.
fn half_to_float(bits: u16) -> f64 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023) / 1024.0);
    let magnitude = match exponent {
        31 if fraction > 0.0 => f64::NAN,
        31 => f64::INFINITY,
        0 => fraction * 2f64.powi(-14),
        _ => (1.0 + fraction) * 2f64.powi(exponent - 15),
    };
    if bits >> 15 == 1 {
        -magnitude
    } else {
        magnitude
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_type_has_its_own_row() {
        for (i, (number_type, ..)) in NUMBER_TYPES.into_iter().enumerate() {
            assert_eq!(number_type as usize, i);
        }
    }

    #[cfg(feature = "images")]
    #[test]
    fn every_16_bit_float_is_what_the_crate_half_makes_of_it() {
        for bits in 0..=u16::MAX {
            let own = half_to_float(bits);
            let theirs = ::exr::prelude::f16::from_bits(bits).to_f64();
            assert!(
                own.to_bits() == theirs.to_bits() || own.is_nan() && theirs.is_nan(),
                "{bits:04x}"
            );
        }
    }
}
