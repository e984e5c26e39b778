//! Kinds of photo files, told by their first bytes, and what to do about those that are not read.

use crate::error::{Error, Result};

/// Kind of a photo's file that is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PhotoKind {
    Png,
    Jpeg,
    WebP,
    Gif,
    Bmp,
    Tiff,
}

/// First bytes of the files that are read.
const MAGIC_BYTES: [(&[u8], PhotoKind); 8] = [
    (b"\xff\xd8\xff", PhotoKind::Jpeg),
    (b"\x89PNG\r\n\x1a\n", PhotoKind::Png),
    (b"GIF8", PhotoKind::Gif),
    (b"BM", PhotoKind::Bmp),
    (b"II*\0", PhotoKind::Tiff),
    (b"MM\0*", PhotoKind::Tiff),
    (b"II+\0", PhotoKind::Tiff),
    (b"MM\0+", PhotoKind::Tiff),
];

/// What to do about a photo that is not read.
const SAVE_AS_JPEG: &str = "save it as JPEG or PNG";

impl PhotoKind {
    /// Tells the kind of a photo's file by its first bytes.
    ///
    /// # Errors
    /// [`Error::Format`] for an empty file, [`Error::Unsupported`] for any other file, with its kind and what to do.
    pub fn of_file(bytes: &[u8]) -> Result<Self> {
        if bytes.is_empty() {
            return Err(Error::Format {
                format: "a photo",
                reason: "the file is empty".into(),
            });
        }
        let found = MAGIC_BYTES
            .iter()
            .find(|(magic, _)| bytes.starts_with(magic));
        match (found, bytes) {
            (Some((_, kind)), _) => Ok(*kind),
            (
                None,
                [
                    b'R',
                    b'I',
                    b'F',
                    b'F',
                    _,
                    _,
                    _,
                    _,
                    b'W',
                    b'E',
                    b'B',
                    b'P',
                    ..,
                ],
            ) => Ok(PhotoKind::WebP),
            _ => Err(unsupported(bytes)),
        }
    }

    /// Name of the kind in messages.
    pub fn title(self) -> &'static str {
        match self {
            PhotoKind::Png => "PNG",
            PhotoKind::Jpeg => "JPEG",
            PhotoKind::WebP => "WebP",
            PhotoKind::Gif => "GIF",
            PhotoKind::Bmp => "BMP",
            PhotoKind::Tiff => "TIFF",
        }
    }
}

/// The error for a file that is no photo that is read.
fn unsupported(bytes: &[u8]) -> Error {
    let brand = match bytes {
        [_, _, _, _, b'f', b't', b'y', b'p', brand @ ..] => brand.get(..4).unwrap_or_default(),
        _ => b"",
    };
    let (format, advice) = match (brand, bytes) {
        (b"avif" | b"avis", _) => ("AVIF", SAVE_AS_JPEG),
        (b"heic" | b"heix" | b"heim" | b"heis" | b"hevc" | b"hevx" | b"mif1" | b"msf1", _) => (
            "HEIC",
            "save it as JPEG (an iPhone shares photos as JPEG with Settings > Camera > Formats > Most Compatible)",
        ),
        (_, [b'%', b'P', b'D', b'F', ..]) => (
            "PDF",
            "save its page as a picture, for example by `pdftoppm -r 300 -jpeg file.pdf page`",
        ),
        (_, [b'\x89', b'P', b'N', b'G', ..]) => ("PNG", "it was damaged in transfer; copy it anew"),
        _ => ("this file", SAVE_AS_JPEG),
    };
    Error::Unsupported {
        format,
        reason: format!("photos are read from JPEG, PNG, WebP, GIF, BMP and TIFF files; {advice}"),
    }
}
