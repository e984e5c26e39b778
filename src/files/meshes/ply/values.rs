//! The values of a PLY file after its header.

use crate::error::Result;
use crate::files::failure::damaged;
use crate::files::number_type::NumberType;

/// Encoding of the values after the header.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// Returns the type of numbers of a given name, in either of the two spellings.
pub(super) fn number_type(name: &str) -> Option<NumberType> {
    Some(match name {
        "char" | "int8" => NumberType::I8,
        "uchar" | "uint8" => NumberType::U8,
        "short" | "int16" => NumberType::I16,
        "ushort" | "uint16" => NumberType::U16,
        "int" | "int32" => NumberType::I32,
        "uint" | "uint32" => NumberType::U32,
        "float" | "float32" => NumberType::F32,
        "double" | "float64" => NumberType::F64,
        _ => return None,
    })
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
    pub(super) fn next(&mut self, kind: NumberType) -> Result<f64> {
        if self.encoding == Encoding::Ascii {
            return self.word();
        }
        let (bytes, rest) = (self.rest.split_at_checked(kind.bytes())).ok_or_else(too_short)?;
        self.rest = rest;
        Ok(kind.value(bytes, self.encoding == Encoding::BigEndian))
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
        (word.parse()).map_err(|_| damaged(format!("{word:?} stands where a number should")))
    }
}

fn too_short() -> crate::error::Error {
    damaged("the file is too short for the elements that its header states")
}
