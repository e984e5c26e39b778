//! The header of a PLY file: its encoding, elements and properties.

use std::collections::VecDeque;

use super::values::{Encoding, number_type};
use crate::error::Result;
use crate::files::failure::damaged;
use crate::files::number_type::NumberType;

/// A property of an element: one value, or a list whose length comes first.
pub(super) struct Property {
    pub(super) name: String,
    /// Type of a list's length; `None` for a property of one value.
    pub(super) length: Option<NumberType>,
    pub(super) kind: NumberType,
}

/// A kind of element, such as `vertex`, and how many of it follow.
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

/// What a PLY file says of its contents.
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Names of texture pictures in comments (`TextureFile NAME`, as MeshLab writes them), in their order.
    pub(super) textures: Vec<String>,
}

impl Header {
    /// Parses a header whose lines end with LF, CR, or both; returns it with the bytes after it.
    pub(super) fn parse(bytes: &[u8]) -> Result<(Self, &[u8])> {
        let first = bytes.iter().position(|b| matches!(b, b'\r' | b'\n'));
        let alone = first.is_some_and(|at| bytes[at] == b'\r' && bytes.get(at + 1) != Some(&b'\n'));
        let end = if alone { b'\r' } else { b'\n' };
        let mut header = Header {
            encoding: Encoding::Ascii,
            elements: Vec::new(),
            textures: Vec::new(),
        };
        let mut rest = bytes;
        loop {
            let at = rest.iter().position(|b| *b == end);
            let line = String::from_utf8_lossy(&rest[..at.unwrap_or(rest.len())]);
            let line = line.trim();
            let ended = line == "end_header";
            if !ended {
                header.add(line)?;
            }
            match at {
                Some(at) => rest = &rest[at + 1..],
                None if ended => rest = &[],
                None => return Err(damaged("its header has no end")),
            }
            if ended {
                return Ok((header, rest));
            }
        }
    }

    fn add(&mut self, line: &str) -> Result<()> {
        let mut words: VecDeque<&str> = line.split_whitespace().collect();
        let unclear = || damaged(format!("its header has the line {line:?}"));
        match words.pop_front() {
            Some("format") => {
                self.encoding = match words.pop_front() {
                    Some("ascii") => Encoding::Ascii,
                    Some("binary_little_endian") => Encoding::LittleEndian,
                    Some("binary_big_endian") => Encoding::BigEndian,
                    _ => return Err(unclear()),
                };
            }
            Some("comment") => {
                let text = line["comment".len()..].trim();
                let texture = text.strip_prefix("TextureFile").map(str::trim);
                self.textures.extend(texture.map(String::from));
            }
            Some("element") => {
                let (Some(name), Some(count)) = (words.pop_front(), words.pop_front()) else {
                    return Err(unclear());
                };
                self.elements.push(Element {
                    name: name.into(),
                    count: count.parse().map_err(|_| unclear())?,
                    properties: Vec::new(),
                });
            }
            Some("property") => {
                let mut scalar = || words.pop_front().and_then(number_type);
                let (length, kind) = match scalar() {
                    Some(kind) => (None, Some(kind)),
                    // The word taken was `list`, or is none that is known.
                    None => (scalar(), scalar()),
                };
                let is_list = line.split_whitespace().nth(1) == Some("list");
                let (Some(kind), true, Some(name)) =
                    (kind, is_list == length.is_some(), words.pop_front())
                else {
                    return Err(unclear());
                };
                let element = self.elements.last_mut().ok_or_else(unclear)?;
                element.properties.push(Property {
                    name: name.into(),
                    length,
                    kind,
                });
            }
            // `obj_info`, and what other programs add, say nothing of the values.
            _ => {}
        }
        Ok(())
    }
}
