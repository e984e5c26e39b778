//! Finds the files that a mesh file refers to: materials, textures, buffers.

use std::cell::RefCell;

/// A texture picture of a mesh: the bytes of the picture's file, which the caller decodes.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Texture {
    /// Name of the picture's file; empty for a picture within the mesh's file.
    pub name: String,
    /// Bytes of the picture's file, usually PNG or JPEG.
    pub bytes: Vec<u8>,
}

/// Lookup, by name, of the files that lie beside a mesh file; records the names that were not found.
pub(super) struct Beside<'a> {
    files: &'a [(&'a str, &'a [u8])],
    missing: RefCell<Vec<String>>,
}

impl<'a> Beside<'a> {
    pub(super) fn new(files: &'a [(&'a str, &'a [u8])]) -> Self {
        Beside {
            files,
            missing: RefCell::default(),
        }
    }

    /// Finds the file of a given name beside the mesh file, or one whose name agrees without folders: programs often
    /// write paths of another machine.
    pub(super) fn find(&self, name: &str) -> Option<(&'a str, &'a [u8])> {
        let same = |of: fn(&str) -> &str| {
            let matches = |known: &str| of(known).eq_ignore_ascii_case(of(name));
            (self.files.iter().copied()).find(|(known, _)| matches(known))
        };
        let found = same(|name| name).or_else(|| same(last_part));
        let mut missing = self.missing.borrow_mut();
        if found.is_none() && !missing.iter().any(|known| known == name) {
            missing.push(name.into());
        }
        found
    }

    pub(super) fn missing(self) -> Vec<String> {
        self.missing.into_inner()
    }
}

fn last_part(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}
