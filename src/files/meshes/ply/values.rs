//! The values of a PLY file after its header.

use crate::error::Result;
use crate::files::meshes::builder::damaged;

/// Encoding of the values after the header.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// Type of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    /// Returns the type of a given name, in either of the two spellings.
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Scalar::I8,
            "uchar" | "uint8" => Scalar::U8,
            "short" | "int16" => Scalar::I16,
            "ushort" | "uint16" => Scalar::U16,
            "int" | "int32" => Scalar::I32,
            "uint" | "uint32" => Scalar::U32,
            "float" | "float32" => Scalar::F32,
            "double" | "float64" => Scalar::F64,
            _ => return None,
        })
    }

    /// Returns the value that stands for white in a colour of this type.
    pub(super) fn white(self) -> f64 {
        match self {
            Scalar::I8 => i8::MAX.into(),
            Scalar::U8 => u8::MAX.into(),
            Scalar::I16 => i16::MAX.into(),
            Scalar::U16 => u16::MAX.into(),
            Scalar::I32 => i32::MAX.into(),
            Scalar::U32 => u32::MAX.into(),
            Scalar::F32 | Scalar::F64 => 1.0,
        }
    }
}

/// The values that are left in a PLY file, in their order.
pub(super) struct Values<'a> {
    rest: &'a [u8],
    encoding: Encoding,
}

impl<'a> Values<'a> {
    pub(super) fn new(rest: &'a [u8], encoding: Encoding) -> Self {
        Values { rest, encoding }
    }

    /// Reads the next value of a given type.
    pub(super) fn next(&mut self, kind: Scalar) -> Result<f64> {
        if self.encoding == Encoding::Ascii {
            return self.word();
        }
        Ok(match kind {
            Scalar::I8 => i8::from_le_bytes(self.bytes()?).into(),
            Scalar::U8 => u8::from_le_bytes(self.bytes()?).into(),
            Scalar::I16 => i16::from_le_bytes(self.bytes()?).into(),
            Scalar::U16 => u16::from_le_bytes(self.bytes()?).into(),
            Scalar::I32 => i32::from_le_bytes(self.bytes()?).into(),
            Scalar::U32 => u32::from_le_bytes(self.bytes()?).into(),
            Scalar::F32 => f32::from_le_bytes(self.bytes()?).into(),
            Scalar::F64 => f64::from_le_bytes(self.bytes()?),
        })
    }

    /// Reads the bytes of a binary value, the lowest first.
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N]> {
        let (first, rest) = self.rest.split_first_chunk::<N>().ok_or_else(too_short)?;
        self.rest = rest;
        let mut bytes = *first;
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn word(&mut self) -> Result<f64> {
        let text = self.rest.trim_ascii_start();
        if text.is_empty() {
            return Err(too_short());
        }
        let end = text.iter().position(u8::is_ascii_whitespace);
        let (word, rest) = text.split_at(end.unwrap_or(text.len()));
        self.rest = rest;
        let word = String::from_utf8_lossy(word);
        (word.parse()).map_err(|_| damaged("PLY", format!("{word:?} stands where a number should")))
    }
}

fn too_short() -> crate::error::Error {
    damaged(
        "PLY",
        "the file is too short for the elements that its header states",
    )
}
