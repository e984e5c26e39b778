//! The Stanford format, by way of `ply-rs-bw`.

use std::io::Cursor;

use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

use super::{Parts, damaged, unsupported};
use crate::error::Result;

pub(super) fn read(bytes: &[u8], parts: &mut Parts) -> Result<()> {
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = Parser::<Skipped>::new()
        .read_header(&mut reader)
        .map_err(|error| damaged("PLY", error))?;
    for element in header.elements.values() {
        // Each takes a byte at least, unless it is made of nothing.
        if element.count > bytes.len() || element.properties.is_empty() && element.count > 0 {
            return Err(damaged(
                "PLY",
                format!(
                    "the header states {} elements `{}`, for which the file is too short",
                    element.count, element.name
                ),
            ));
        }
        match element.name.as_str() {
            "vertex" => {
                let vertices = Parser::<Vertex>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(|error| damaged("PLY", error))?;
                vertices.iter().try_for_each(|vertex| vertex.add(parts))?;
            }
            "face" => {
                let faces = Parser::<Face>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(|error| damaged("PLY", error))?;
                for (i, face) in faces.iter().enumerate() {
                    match &face.0 {
                        Some(corners) => parts.fan(corners)?,
                        None => {
                            return Err(damaged(
                                "PLY",
                                format!("face {i} has no list of whole numbers `vertex_indices`"),
                            ));
                        }
                    }
                }
            }
            "tristrips" => {
                return Err(unsupported(
                    "PLY",
                    "triangle strips are not read; save the file with faces",
                ));
            }
            _ => {
                Parser::<Skipped>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(|error| damaged("PLY", error))?;
            }
        }
    }
    Ok(())
}

/// An element that nobody needs.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Skipped
    }
}

/// NaN is what has not been said.
struct Vertex {
    position: [f64; 3],
    color: [f32; 3],
    uv: [f32; 2],
}

impl Vertex {
    fn add(&self, parts: &mut Parts) -> Result<()> {
        parts.position(self.position)?;
        if !self.color.iter().any(|c| c.is_nan()) {
            parts.colors.push(self.color);
        }
        if !self.uv.iter().any(|c| c.is_nan()) {
            parts.uvs.push(self.uv);
        }
        Ok(())
    }
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Vertex {
            position: [f64::NAN; 3],
            color: [f32::NAN; 3],
            uv: [f32::NAN; 2],
        }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some((value, white)) = number(&property) else {
            return PropertyAccessResult::Ignored;
        };
        let color = (value / white) as f32;
        match name {
            "x" => self.position[0] = value,
            "y" => self.position[1] = value,
            "z" => self.position[2] = value,
            "red" => self.color[0] = color,
            "green" => self.color[1] = color,
            "blue" => self.color[2] = color,
            "s" | "u" | "texture_u" => self.uv[0] = value as f32,
            "t" | "v" | "texture_v" => self.uv[1] = value as f32,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

/// A scalar, and what white would be in its type.
fn number(property: &Property) -> Option<(f64, f64)> {
    Some(match property {
        Property::Char(v) => (f64::from(*v), f64::from(i8::MAX)),
        Property::UChar(v) => (f64::from(*v), f64::from(u8::MAX)),
        Property::Short(v) => (f64::from(*v), f64::from(i16::MAX)),
        Property::UShort(v) => (f64::from(*v), f64::from(u16::MAX)),
        Property::Int(v) => (f64::from(*v), f64::from(i32::MAX)),
        Property::UInt(v) => (f64::from(*v), f64::from(u32::MAX)),
        Property::Float(v) => (f64::from(*v), 1.0),
        Property::Double(v) => (*v, 1.0),
        _ => return None,
    })
}

struct Face(Option<Vec<u32>>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Face(None)
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !matches!(name, "vertex_indices" | "vertex_index") {
            return PropertyAccessResult::Ignored;
        }
        self.0 = property.to_u32_list();
        PropertyAccessResult::Set
    }
}
