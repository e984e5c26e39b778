//! Reads meshes in the Object File Format (OFF), in text.

use super::builder::{MeshBuilder, scale_levels};
use super::corners::Corners;
use super::rows::{numbers, point, whole};
use crate::error::Result;
use crate::files::failure::{damaged, not_read};
use crate::files::text::{decoded, lines};

pub(super) fn read(bytes: &[u8], parts: &mut MeshBuilder) -> Result<()> {
    let text = decoded(bytes);
    let content = |line: &str| line.split('#').next().unwrap_or_default().trim().to_owned();
    let mut rows = lines(&text)
        .map(|(row, line)| (row, content(&line)))
        .filter(|(_, line)| !line.is_empty());
    let mut next = || {
        rows.next()
            .ok_or_else(|| damaged("the file ends too early"))
    };
    let (_, first) = next()?;
    let (header, rest) = first.split_once("OFF").unwrap_or(("", &first));
    if rest.contains("BINARY") {
        return Err(not_read(
            "binary files are not read; save it as text, or as PLY",
        ));
    }
    let counts = match rest.trim() {
        "" => next()?.1,
        counts => counts.to_owned(),
    };
    let counts: Vec<usize> = counts
        .split_whitespace()
        .map_while(|word| word.parse().ok())
        .collect();
    let [vertices, faces, ..] = counts[..] else {
        return Err(damaged(
            "its header does not state the numbers of vertices and faces",
        ));
    };
    // Normals come before colours, which are the last but for texture coordinates; MeshLab puts both the other way round.
    let before = if header.contains("CN") { 3 } else { 0 };
    for _ in 0..vertices {
        let (row, line) = next()?;
        let (position, rest) = point(row, line.split_whitespace())?;
        parts.position(position)?;
        if header.contains('C')
            && let [r, g, b, ..] = rest.get(before..).unwrap_or_default()
        {
            parts.colors.push([*r, *g, *b].map(|v| v as f32));
        }
    }
    scale_levels(parts.colors.iter_mut());
    let mut colors = Vec::new();
    let mut polygons = Vec::new();
    for _ in 0..faces {
        let (row, line) = next()?;
        let mut words = line.split_whitespace();
        let count = numbers(row, words.by_ref().take(1))?;
        let count = count.first().map_or(0, |count| *count as usize);
        let corners = numbers(row, words.by_ref().take(count))?;
        if corners.len() < count {
            return Err(damaged(format!("line {row} has too few vertices")));
        }
        let corners: Result<Vec<u32>> = corners.iter().map(|v| whole(*v)).collect();
        polygons.push(corners?);
        // One number is that of a colour in a file of its own, and a fourth the opacity.
        let rest: Vec<f32> = words.map_while(|word| word.parse().ok()).collect();
        let [r, g, b, ..] = rest[..] else {
            colors.push(None);
            continue;
        };
        colors.push(Some([r, g, b]));
    }
    scale_levels(colors.iter_mut().flatten());
    // Where vertices have colours, these count.
    let is_coloured = parts.colors.is_empty() && colors.iter().any(Option::is_some);
    let mut corners = is_coloured.then(|| Corners::taken_from(parts));
    for (polygon, color) in polygons.iter_mut().zip(colors) {
        if let Some(corners) = &mut corners {
            corners.split(polygon, &[], color, parts)?;
        }
        parts.polygon(polygon)?;
    }
    Ok(())
}
