//! A file that is written to memory, and that reports lack of memory as an error.

use std::io::{self, Write};

use crate::error::{Error, Result};

/// The bytes of a file that is written to memory; writing fails if there is not enough memory.
#[derive(Default)]
pub(crate) struct Buffer(Vec<u8>);

impl Write for Buffer {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0
            .try_reserve(bytes.len())
            .map_err(|_| io::ErrorKind::OutOfMemory)?;
        self.0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Buffer {
    /// Returns the bytes of the finished file, or an error if there was not enough memory; `what` names the file in the
    /// error.
    pub(crate) fn finish(self, what: &'static str, written: io::Result<()>) -> Result<Vec<u8>> {
        match written {
            Ok(()) => Ok(self.0),
            Err(_) => Err(Error::OutOfMemory {
                what,
                bytes: self.0.len(),
            }),
        }
    }
}

/// Reserves memory for so many bytes more, with room for growth; an error if there is not enough memory.
pub(super) fn reserve(bytes: &mut Vec<u8>, what: &'static str, more: usize) -> Result<()> {
    (bytes.try_reserve(more)).map_err(|_| Error::OutOfMemory { what, bytes: more })
}
