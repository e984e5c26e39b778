//! The files that a mesh's own file names: materials, textures, buffers.

use std::cell::RefCell;

/// A picture that texture coordinates are about: a file as it is, to be decoded by whoever wants
/// its pixels.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Texture {
    /// The name that it was given by; empty for one within the mesh's file.
    pub name: String,
    /// The bytes: a PNG or JPEG file, as a rule.
    pub bytes: Vec<u8>,
}

/// What is there besides the mesh's own file, by the names it goes by, and what has been missed.
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

    /// The file of this name, or else one whose name is the same without folders: the paths that
    /// programs write are often those of another machine.
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
