//! Writes glTF 2.0 in one binary file (GLB): the bytes of its binary part, and the parts of its text that refer to them.
//!
//! The files written here use so little of the format that their text is written directly. (Khronos Group, glTF 2.0
//! Specification, "GLB File Format".)

use super::buffer::reserve;
use super::failure::unsupported;
use crate::error::Result;

/// OpenGL's number for whole numbers of 32 bits, by which glTF names component types.
const GL_UNSIGNED_INT: u32 = 5125;

/// OpenGL's number for floats of 32 bits, by which glTF names component types.
const GL_FLOAT: u32 = 5126;

/// Number of bytes of a GLB file besides those of its two parts.
const HEADER_BYTES: usize = 28;

/// A GLB file that is being written.
#[derive(Default)]
pub(super) struct GlbFile {
    bin: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
}

impl GlbFile {
    /// Appends bytes to the binary part, beginning at a multiple of four, and returns the number of their buffer view.
    pub(super) fn view<const N: usize>(
        &mut self,
        items: impl ExactSizeIterator<Item = [u8; N]>,
    ) -> Result<usize> {
        let (start, length) = (self.bin.len().next_multiple_of(4), N * items.len());
        reserve_part(&mut self.bin, start.saturating_add(length))?;
        self.bin.resize(start, 0);
        self.bin.extend(items.flatten());
        let view = format!(r#"{{"buffer":0,"byteOffset":{start},"byteLength":{length}}}"#);
        self.views.push(view);
        Ok(self.views.len() - 1)
    }

    /// Appends an array of `count` elements with `components` numbers of a type, and returns its number; `more` are further
    /// properties.
    pub(super) fn accessor(
        &mut self,
        view: usize,
        kind: u32,
        count: usize,
        components: usize,
        more: &str,
    ) -> usize {
        let shape = ["SCALAR", "VEC2", "VEC3", "VEC4"][components - 1];
        self.accessors.push(format!(
            r#"{{"bufferView":{view},"componentType":{kind},"count":{count},"type":"{shape}"{more}}}"#
        ));
        self.accessors.len() - 1
    }

    /// Appends an array of floats, with the smallest and the largest of each component if `is_bounded`.
    pub(super) fn floats<const N: usize>(
        &mut self,
        rows: &[[f32; N]],
        is_bounded: bool,
    ) -> Result<usize> {
        let view = self.view(rows.as_flattened().iter().map(|v| v.to_le_bytes()))?;
        let extreme = |start: f32, pick: fn(f32, f32) -> f32| {
            let limit = |k: usize| rows.iter().map(|row| row[k]).fold(start, pick);
            list(&std::array::from_fn::<f32, N, _>(limit))
        };
        let more = match is_bounded {
            true => format!(
                r#","min":{},"max":{}"#,
                extreme(f32::INFINITY, f32::min),
                extreme(f32::NEG_INFINITY, f32::max)
            ),
            false => String::new(),
        };
        Ok(self.accessor(view, GL_FLOAT, rows.len(), N, &more))
    }

    /// Appends the corners of triangles.
    pub(super) fn indices(&mut self, triangles: &[[u32; 3]]) -> Result<usize> {
        let corners = triangles.as_flattened();
        let view = self.view(corners.iter().map(|i| i.to_le_bytes()))?;
        Ok(self.accessor(view, GL_UNSIGNED_INT, corners.len(), 1, ""))
    }

    /// Returns the file: `content` are the properties of its text that say how the arrays are used.
    ///
    /// # Errors
    /// [`Error::Unsupported`](crate::Error::Unsupported) from 4 GiB, [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub(super) fn finish(mut self, content: &str) -> Result<Vec<u8>> {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let mut text = format!(
            r#"{{"asset":{{"version":"2.0","generator":"developable"}},"scene":0,{content},"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}}"#,
            self.accessors.join(","),
            self.views.join(","),
            self.bin.len()
        );
        while text.len() % 4 > 0 {
            text.push(' ');
        }
        let total = HEADER_BYTES + text.len() + self.bin.len();
        let mut out = Vec::new();
        reserve_part(&mut out, total)?;
        let word = |number: usize| (number as u32).to_le_bytes();
        for part in [
            b"glTF",
            &word(2),
            &word(total),
            &word(text.len()),
            b"JSON",
            text.as_bytes(),
            &word(self.bin.len()),
            b"BIN\0",
            &self.bin,
        ] {
            out.extend_from_slice(part);
        }
        Ok(out)
    }
}

/// Reserves memory for a part of the file, whose length has 32 bits.
fn reserve_part(part: &mut Vec<u8>, bytes: usize) -> Result<()> {
    if bytes > u32::MAX as usize {
        return Err(unsupported("GLB", "files from 4 GiB are not written"));
    }
    let more = bytes - part.len();
    reserve(part, "GLB file", more)
}

/// Writes numbers as a list in JSON, with all digits: readers compare them with the binary ones in 64 bits.
pub(super) fn list(values: &[f32]) -> String {
    let values: Vec<String> = values.iter().map(|v| f64::from(*v).to_string()).collect();
    format!("[{}]", values.join(","))
}
