//! Reads the materials of OBJ meshes (MTL): their diffuse colours and the names of their pictures.

use super::beside::Beside;
use super::builder::DEFAULT_VERTEX_COLOUR;
use crate::files::text::{decoded, lines};

/// A material of an OBJ mesh.
pub(super) struct Material {
    pub(super) name: String,
    pub(super) color: [f32; 3],
    /// Name of the file of the texture picture.
    pub(super) picture: Option<String>,
}

/// Reads the material files that a statement `mtllib` names: several names, or one with blanks in it. A mesh is not
/// refused for its looks: what is not understood is left out.
pub(super) fn library(names: &str, beside: &Beside) -> Vec<Material> {
    let whole = |name: &str| name.to_ascii_lowercase().ends_with(".mtl");
    let names: Vec<&str> = match names.split_whitespace().all(whole) {
        true => names.split_whitespace().collect(),
        false => vec![names],
    };
    let files = names.into_iter().filter_map(|name| beside.find(name));
    files.flat_map(|(_, bytes)| materials(bytes)).collect()
}

fn materials(bytes: &[u8]) -> Vec<Material> {
    let mut found: Vec<Material> = Vec::new();
    for (_, line) in lines(&decoded(bytes)) {
        let line = line.trim();
        let (statement, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        match (statement, found.last_mut()) {
            ("newmtl", _) => found.push(Material {
                name: rest.into(),
                color: DEFAULT_VERTEX_COLOUR,
                picture: None,
            }),
            ("Kd", Some(material)) => {
                // A colour given as a spectrum or in another colour space is not read.
                let numbers: Vec<f32> = rest
                    .split_whitespace()
                    .map_while(|w| w.parse().ok())
                    .collect();
                match numbers.as_slice() {
                    [grey] => material.color = [*grey; 3],
                    [r, g, b, ..] => material.color = [*r, *g, *b],
                    _ => {}
                }
            }
            ("map_Kd", Some(material)) => material.picture = picture(rest),
            _ => {}
        }
    }
    found
}

/// Returns the name of a picture's file without the options before it (`-s 1 1 1`) and without quotation marks.
fn picture(text: &str) -> Option<String> {
    let name = match text.starts_with('-') {
        true => text.split_whitespace().last()?,
        false => text,
    };
    let name = name.trim_matches('"');
    (!name.is_empty()).then(|| name.into())
}
