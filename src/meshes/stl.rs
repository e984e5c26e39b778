//! Stereolithography, by way of `stl_io`.

use std::io::Cursor;

use stl_io::create_stl_reader;

use super::{Parts, damaged};
use crate::error::Result;

/// Bytes before the triangles of a binary file, and of each triangle.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// Whether the file has the length that a binary one has to have.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    triangles(bytes).is_some_and(|n| n > 0 && length(n) == Some(bytes.len()))
}

/// The number of triangles that the header of a binary file states.
fn triangles(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u32::from_le_bytes(count.try_into().ok()?) as usize)
}

fn length(triangles: usize) -> Option<usize> {
    triangles.checked_mul(TRIANGLE)?.checked_add(HEADER)
}

pub(super) fn read(bytes: &[u8], parts: &mut Parts) -> Result<()> {
    if bytes.starts_with(b"solid") && !is_binary(bytes) {
        return ascii(bytes, parts);
    }
    match triangles(bytes).and_then(length) {
        Some(needed) if needed <= bytes.len() => {}
        _ => {
            return Err(damaged(
                "STL",
                format!(
                    "the file of {} bytes is too short for the triangles that it states",
                    bytes.len()
                ),
            ));
        }
    }
    if !bytes.starts_with(b"solid") {
        return collect(bytes, parts);
    }
    // Some programs begin binary files like ASCII ones.
    let mut file = bytes.to_vec();
    file[..HEADER - 4].fill(0);
    collect(&file, parts)
}

/// Several solids may follow one another, of which `stl_io` reads one.
fn ascii(bytes: &[u8], parts: &mut Parts) -> Result<()> {
    let ends = bytes.iter().enumerate().filter(|(_, b)| **b == b'\n');
    let lines = std::iter::once(0).chain(ends.map(|(i, _)| i + 1));
    let starts: Vec<usize> = lines
        .filter(|i| bytes[*i..].starts_with(b"solid"))
        .collect();
    for (i, start) in starts.iter().enumerate() {
        let end = starts.get(i + 1).copied().unwrap_or(bytes.len());
        let solid = &bytes[*start..end];
        let line = solid.iter().position(|b| *b == b'\n');
        // A name need not follow, and may be in any encoding, but `stl_io` wants a blank.
        let mut file = b"solid \n".to_vec();
        file.extend_from_slice(&solid[line.map_or(solid.len(), |at| at + 1)..]);
        collect(&file, parts)?;
    }
    Ok(())
}

fn collect(bytes: &[u8], parts: &mut Parts) -> Result<()> {
    let mut cursor = Cursor::new(bytes);
    let reader = create_stl_reader(&mut cursor).map_err(|error| damaged("STL", error))?;
    for triangle in reader {
        let triangle = triangle.map_err(|error| damaged("STL", error))?;
        let start = parts.positions.len() as u32;
        for vertex in triangle.vertices {
            parts.position(<[f32; 3]>::from(vertex).map(f64::from))?;
        }
        parts.triangle([start, start + 1, start + 2])?;
    }
    Ok(())
}
