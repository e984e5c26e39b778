//! Reads and writes stereolithography meshes (STL).

use std::io::{self, Write};

use nalgebra::Vector3;

use super::builder::{DEFAULT_VERTEX_COLOUR, MeshBuilder};
use super::narrow::narrowed;
use super::rows::point;
use crate::error::Result;
use crate::files::Assumption;
use crate::files::buffer::Buffer;
use crate::files::failure::{damaged, unsupported};
use crate::files::mesh_format::{STL_HEADER_BYTES, STL_TRIANGLE_BYTES, is_ascii_stl, stl_length};
use crate::files::number_type::NumberType;
use crate::files::text::{decoded, lines};
use crate::scene::mesh::Mesh;

/// Largest ratio of the length of a binary STL file by its header to the bytes that are there: of other files it is far larger.
const MAX_STL_LENGTH_RATIO: usize = 64;

/// Returns whether a file may be a binary STL file that is cut short, or that fewer bytes than a triangle follow.
pub(super) fn may_be_stl(bytes: &[u8]) -> bool {
    stl_length(bytes).is_some_and(|length| {
        length > STL_HEADER_BYTES
            && length / MAX_STL_LENGTH_RATIO < bytes.len()
            && bytes.len() < length + STL_TRIANGLE_BYTES
    })
}

pub(super) fn read(bytes: &[u8], parts: &mut MeshBuilder) -> Result<()> {
    if is_ascii_stl(bytes) {
        return ascii(bytes, parts);
    }
    let triangles = stl_length(bytes)
        .and_then(|length| bytes.get(STL_HEADER_BYTES..length))
        .ok_or_else(|| {
            let length = bytes.len();
            let reason =
                format!("the file of {length} bytes is too short for the triangles that it states");
            damaged(reason)
        })?;
    let trailing = bytes.len() - STL_HEADER_BYTES - triangles.len();
    if trailing > 0 {
        let words =
            format!("the last {trailing} of its bytes are no triangles: its header states fewer");
        (parts.assumptions).push(Assumption::new("trailingBytes", words, None));
    }
    let triangles = triangles.as_chunks::<STL_TRIANGLE_BYTES>().0;
    let attribute = |triangle: &[u8; STL_TRIANGLE_BYTES]| [triangle[48], triangle[49]];
    let attributes = triangles.iter().map(attribute).map(u16::from_le_bytes);
    let attributes: Vec<u16> = attributes.collect();
    // A program that knows no colours leaves the header as it was, and writes 0 for all attributes.
    let base =
        base_colour(&bytes[..STL_HEADER_BYTES]).filter(|_| attributes.iter().any(|a| *a != 0));
    // MeshLab marks all triangles with colours of their own, too.
    let is_marked = attributes.iter().all(|a| a & COLOUR_BIT != 0);
    let is_plain = base.is_none() || attributes.iter().all(|a| *a == attributes[0]);
    let ignored = COLOUR_BIT * u16::from(is_marked && !is_plain);
    for (triangle, attribute) in triangles.iter().zip(attributes) {
        let start = parts.positions.len() as u32;
        // Three numbers each: a normal, and the corners.
        for corner in triangle.as_chunks::<12>().0.iter().skip(1) {
            parts.position([0, 4, 8].map(|at| NumberType::F32.value(&corner[at..], false)))?;
        }
        parts.triangle([start, start + 1, start + 2])?;
        if let Some(colour) = colour(attribute & !ignored, base) {
            (parts.colors).resize(start as usize, DEFAULT_VERTEX_COLOUR);
            parts.colors.extend([colour; 3]);
        }
    }
    if !parts.colors.is_empty() {
        (parts.colors).resize(parts.positions.len(), DEFAULT_VERTEX_COLOUR);
    }
    Ok(())
}

/// Text in the header of a binary STL file as Magics writes it, which the colour of the whole follows as four bytes.
const COLOUR_LABEL: &[u8] = b"COLOR=";

/// Bit of a triangle's attribute that says, as VisCAM writes it, that the others are its colour, and as Magics does, that they
/// are none.
const COLOUR_BIT: u16 = 1 << 15;

/// Colour of the whole by the header of a file as Magics writes it.
fn base_colour(header: &[u8]) -> Option<[f32; 3]> {
    let mut places = header.windows(COLOUR_LABEL.len() + 3);
    let label = places.find(|place| place.starts_with(COLOUR_LABEL))?;
    let levels = label.last_chunk::<3>()?;
    Some(levels.map(|level| f32::from(level) / f32::from(u8::MAX)))
}

/// Colour of a triangle by its attribute, five bits for each channel, and the colour of the whole if the file is one of Magics.
fn colour(attribute: u16, base: Option<[f32; 3]>) -> Option<[f32; 3]> {
    let channels = [0, 5, 10].map(|bit| f32::from(attribute >> bit & 31) / 31.0);
    let has_bit = attribute & COLOUR_BIT != 0;
    match base {
        Some(base) if has_bit => Some(base),
        Some(_) => Some(channels),
        None => has_bit.then(|| [channels[2], channels[1], channels[0]]),
    }
}

/// Reads the vertices of all solids of an ASCII STL file, three for each triangle.
fn ascii(bytes: &[u8], parts: &mut MeshBuilder) -> Result<()> {
    let text = decoded(bytes);
    let mut ended = false;
    for (row, line) in lines(&text) {
        let mut words = line.split_whitespace();
        let first = words.next().unwrap_or_default();
        ended |= first.eq_ignore_ascii_case("endsolid");
        if !first.eq_ignore_ascii_case("vertex") {
            continue;
        }
        parts.position(point(row, words.take(3))?.0)?;
        let end = parts.positions.len() as u32;
        if end.is_multiple_of(3) {
            parts.triangle([end - 3, end - 2, end - 1])?;
        }
    }
    if !ended || !parts.positions.len().is_multiple_of(3) {
        return Err(damaged("the file ends within a solid"));
    }
    Ok(())
}

/// Writes a mesh's triangles as a binary STL file, each with its own normal; positions are rounded to 32-bit floats.
/// Far from the origin detail is lost: coordinates of 10⁶ are rounded to multiples of 0.06. (STL knows no origin of its
/// own, as GLB does, and not more bits, as PLY and OBJ do.)
///
/// Costs `O(triangles)`.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) for a point cloud,
/// [`Error::NotFinite`](crate::Error::NotFinite) for a position beyond what 32 bits hold,
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn write_stl(mesh: &Mesh) -> Result<Vec<u8>> {
    if mesh.is_cloud() {
        return Err(unsupported(
            "STL",
            "it holds triangles, and a point cloud has none",
        ));
    }
    let positions = narrowed("STL file", mesh, [0.0; 3])?;
    let mut file = Buffer::default();
    let written = write(&mut file, mesh, &positions);
    file.finish("STL file", written)
}

fn write(file: &mut Buffer, mesh: &Mesh, positions: &[[f32; 3]]) -> io::Result<()> {
    file.write_all(&[0; STL_HEADER_BYTES - 4])?;
    file.write_all(&(mesh.triangles().len() as u32).to_le_bytes())?;
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|i| positions[i as usize]);
        for numbers in [normal(mesh.corners(*triangle)), a, b, c] {
            file.write_all(numbers.map(f32::to_le_bytes).as_flattened())?;
        }
        // Attributes, of which there are none.
        file.write_all(&[0; 2])?;
    }
    Ok(())
}

/// Computes the unit normal of a triangle; 0 for a triangle without area.
fn normal(corners: [[f64; 3]; 3]) -> [f32; 3] {
    let [a, b, c] = corners.map(Vector3::from);
    let (u, v) = (b - a, c - a);
    // Scaled first: products would over- or underflow.
    let across = (u / u.amax()).cross(&(v / v.amax()));
    let normal = across.try_normalize(0.0).unwrap_or_default();
    if normal.iter().all(|v| v.is_finite()) {
        normal.map(|v| v as f32).into()
    } else {
        [0.0; 3]
    }
}
