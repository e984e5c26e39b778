//! Reads Wavefront OBJ meshes and their materials by the `tobj` crate.

use std::path::Path;

use tobj::{LoadError, LoadOptions, MTLLoadResult, Material, load_mtl_buf, load_obj_buf};

use super::beside::Beside;
use super::builder::{DEFAULT_VERTEX_COLOUR, MeshBuilder, NO_TEXTURE, damaged};
use crate::error::Result;

pub(super) fn read(bytes: &[u8], beside: &Beside, parts: &mut MeshBuilder) -> Result<()> {
    // Names may be in any encoding.
    let mut text = String::from_utf8_lossy(bytes);
    check_indices(&text)?;
    let cloud = !lines(bytes).any(|line| line.starts_with(b"f"));
    let options = LoadOptions {
        triangulate: true,
        single_index: true,
        ignore_points: !cloud,
        ignore_lines: true,
    };
    if cloud {
        // `tobj` gives the vertices of faces only: here each is one.
        let points = lines(bytes).filter(is_vertex).count();
        let faces = (1..=points).map(|i| format!("\nf {i}"));
        text.to_mut().extend(faces);
    }
    let materials = |path: &Path| -> MTLLoadResult {
        let file = beside.find(&path.to_string_lossy());
        let (_, file) = file.ok_or(LoadError::OpenFileFailed)?;
        load_mtl_buf(&mut looks(file).ok_or(LoadError::ColorParseError)?.as_bytes())
    };
    let (models, materials) = load_obj_buf(&mut text.as_bytes(), &options, materials)
        .map_err(|error| damaged("OBJ", error))?;
    let materials = match materials {
        Err(LoadError::OpenFileFailed) => Vec::new(),
        other => other.map_err(|error| damaged("MTL", error))?,
    };
    for model in models {
        let mesh = model.mesh;
        let start = parts.positions.len() as u32;
        for p in mesh.positions.chunks_exact(3) {
            parts.position([p[0], p[1], p[2]])?;
        }
        for t in mesh.indices.chunks_exact(3).filter(|_| !cloud) {
            parts.triangle([0, 1, 2].map(|k| start + t[k]))?;
        }
        let material = mesh.material_id.and_then(|id| materials.get(id));
        if mesh.vertex_color.is_empty() {
            let diffuse = material.and_then(|material| material.diffuse);
            let color = diffuse.map_or(DEFAULT_VERTEX_COLOUR, |color| color.map(|v| v as f32));
            parts.material(start as usize, color);
        }
        let colors = mesh.vertex_color.chunks_exact(3);
        parts
            .colors
            .extend(colors.map(|c| [0, 1, 2].map(|k| c[k] as f32)));
        let picture = material.and_then(texture);
        let number = match picture.and_then(|name| beside.find(name)) {
            Some((name, bytes)) => parts.picture(name, bytes)?,
            None => NO_TEXTURE,
        };
        parts.texture(number);
        let uvs = mesh.texcoords.chunks_exact(2);
        parts.uvs.extend(uvs.map(|c| [c[0] as f32, c[1] as f32]));
        if mesh.texcoords.is_empty() {
            parts.no_uvs();
        }
    }
    Ok(())
}

/// Copies from a material file (MTL) the lines with names, colours and pictures, so that `tobj` can parse them; a
/// colour of one number is written with three. `None` if a colour has another number of components, for which `tobj`
/// would panic.
fn looks(bytes: &[u8]) -> Option<String> {
    let mut kept = String::new();
    for line in lines(bytes) {
        let line = String::from_utf8_lossy(line);
        let words = line.split_whitespace().count();
        let second = line.split_whitespace().nth(1);
        match line.split_whitespace().next() {
            // A colour given as a spectrum or in another colour space is not supported.
            Some("Kd") if matches!(second, Some("spectral" | "xyz")) => {}
            Some("Kd") if words == 2 => {
                let grey = second.unwrap_or_default();
                kept.push_str(&format!("Kd {grey} {grey} {grey}\n"));
            }
            Some("Kd") if words != 4 => return None,
            Some("Kd" | "map_Kd" | "newmtl") => {
                kept.push_str(line.trim());
                kept.push('\n');
            }
            _ => {}
        }
    }
    Some(kept)
}

/// Returns the file name of a material's texture picture, without the options before it (`-s 1 1 1`).
fn texture(material: &Material) -> Option<&str> {
    let name = material.diffuse_texture.as_deref()?;
    match name.strip_prefix('-') {
        Some(options) => options.split_whitespace().last(),
        None => Some(name),
    }
}

/// Iterates over the lines of an OBJ or MTL file, without blanks at their beginnings.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    bytes.split(|b| *b == b'\n').map(<[u8]>::trim_ascii_start)
}

/// Returns whether a line of an OBJ file states a vertex.
pub(super) fn is_vertex(line: &&[u8]) -> bool {
    line.starts_with(b"v ") || line.starts_with(b"v\t")
}

/// Checks that no index in an OBJ file exceeds the length of the file, and that no relative index reaches back beyond
/// the elements so far: `tobj` computes with indices unchecked, which could overflow.
fn check_indices(text: &str) -> Result<()> {
    // Of positions, texture coordinates and normals, which a corner names in this order.
    let mut counts = [0; 3];
    for (i, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => counts[0] += 1,
            Some("vt") => counts[1] += 1,
            Some("vn") => counts[2] += 1,
            Some("f" | "l" | "p") => {
                let fits = |corner: &str| {
                    let numbers = corner.split('/').zip(counts);
                    numbers
                        .into_iter()
                        .all(|(number, count)| match number.strip_prefix('-') {
                            Some(back) => whole(back) <= count,
                            None => whole(number) <= text.len(),
                        })
                };
                if !words.all(fits) {
                    return Err(damaged(
                        "OBJ",
                        format!("line {} names a vertex that cannot be there", i + 1),
                    ));
                }
            }
            _ => {}
        }
    }
    Ok(())
}

/// Parses the digits of a number in an OBJ file and saturates where it is too large; what is not a digit is left to the
/// later parser.
fn whole(text: &str) -> usize {
    let digits = text.bytes().filter(u8::is_ascii_digit);
    digits.fold(0, |n, digit| {
        n.saturating_mul(10).saturating_add((digit - b'0').into())
    })
}
