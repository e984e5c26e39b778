//! Wavefront OBJ, by way of `tobj`.

use std::path::Path;

use tobj::{LoadError, LoadOptions, MTLLoadResult, load_obj_buf};

use super::{Parts, damaged};
use crate::error::Result;

pub(super) fn read(bytes: &[u8], parts: &mut Parts) -> Result<()> {
    check_indices(bytes)?;
    let cloud = !lines(bytes).any(|line| line.starts_with(b"f"));
    let options = LoadOptions {
        triangulate: true,
        single_index: true,
        ignore_points: !cloud,
        ignore_lines: true,
    };
    // Names may be in any encoding.
    let mut text = String::from_utf8_lossy(bytes);
    if cloud {
        // `tobj` gives the vertices of faces only: here each is one.
        let points = lines(bytes).filter(is_vertex).count();
        let faces = (1..=points).map(|i| format!("\nf {i}"));
        text.to_mut().extend(faces);
    }
    let no_materials = |_: &Path| -> MTLLoadResult { Err(LoadError::OpenFileFailed) };
    let (models, _) = load_obj_buf(&mut text.as_bytes(), &options, no_materials)
        .map_err(|error| damaged("OBJ", error))?;
    for model in models {
        let mesh = model.mesh;
        let start = parts.positions.len() as u32;
        for p in mesh.positions.chunks_exact(3) {
            parts.position([p[0], p[1], p[2]])?;
        }
        for t in mesh.indices.chunks_exact(3).filter(|_| !cloud) {
            parts.triangle([0, 1, 2].map(|k| start + t[k]))?;
        }
        let colors = mesh.vertex_color.chunks_exact(3);
        parts
            .colors
            .extend(colors.map(|c| [0, 1, 2].map(|k| c[k] as f32)));
        let uvs = mesh.texcoords.chunks_exact(2);
        parts.uvs.extend(uvs.map(|c| [c[0] as f32, c[1] as f32]));
    }
    Ok(())
}

/// The lines of a file, without the blanks that they begin with.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    bytes.split(|b| *b == b'\n').map(<[u8]>::trim_ascii_start)
}

/// Whether a line is one of a vertex.
pub(super) fn is_vertex(line: &&[u8]) -> bool {
    line.starts_with(b"v ") || line.starts_with(b"v\t")
}

/// No index can be larger than the file is long. `tobj` multiplies them unchecked, which could
/// overflow.
fn check_indices(bytes: &[u8]) -> Result<()> {
    for (i, line) in lines(bytes).enumerate() {
        let Some((b'f' | b'l' | b'p', rest)) = line.split_first() else {
            continue;
        };
        // The first number that does not fit: digits alone count, whatever is between them.
        let too_large = |digits: &[u8]| {
            digits.iter().fold(0usize, |n, d| {
                n.saturating_mul(10).saturating_add(usize::from(d - b'0'))
            }) > bytes.len()
        };
        if rest.split(|b| !b.is_ascii_digit()).any(too_large) {
            return Err(damaged(
                "OBJ",
                format!("line {} names a vertex that cannot be there", i + 1),
            ));
        }
    }
    Ok(())
}
