//! Compressed data of JPEG and PNG files, for use in other file formats.

use std::borrow::Cow;

use crate::error::{Error, Result};

/// How the data of a picture are compressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Compression {
    /// The data are a JPEG file.
    Jpeg,
    /// The data are rows with PNG's predictors, compressed by Deflate.
    Png,
}

/// A picture as the data of its file, with what is needed to decode them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PictureData<'a> {
    pub compression: Compression,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Number of bits of each channel.
    pub bits: u8,
    /// Number of channels: 1 for grey, 3 for colours.
    pub channels: u8,
    pub data: Cow<'a, [u8]>,
}

/// The first bytes of every PNG file.
const PNG_SIGNATURE: [u8; 8] = [0x89, b'P', b'N', b'G', 0x0d, 0x0a, 0x1a, 0x0a];

/// The first bytes of every JPEG file.
const JPEG_SIGNATURE: [u8; 2] = [0xff, 0xd8];

impl<'a> PictureData<'a> {
    /// Reads the header of a JPEG or PNG file; the pixels are not decoded.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for other files, and for pictures with transparency, a palette or interlacing;
    /// [`Error::Format`] for a damaged one.
    pub fn new(file: &'a [u8]) -> Result<Self> {
        if file.starts_with(&PNG_SIGNATURE) {
            Self::from_png(file)
        } else if file.starts_with(&JPEG_SIGNATURE) {
            Self::from_jpeg(file)
        } else {
            Err(Error::Unsupported {
                format: "PDF",
                reason: "pictures of its pages must be JPEG or PNG files".into(),
            })
        }
    }

    fn from_png(file: &'a [u8]) -> Result<Self> {
        let mut rest = &file[PNG_SIGNATURE.len()..];
        let (mut header, mut data) = (None, Vec::new());
        while let Some((length, after)) = rest.split_first_chunk::<4>() {
            let Some((kind, after)) = after.split_first_chunk::<4>() else {
                break;
            };
            let Some((content, after)) =
                after.split_at_checked(u32::from_be_bytes(*length) as usize)
            else {
                break;
            };
            match kind {
                b"IHDR" => header = content.first_chunk::<13>(),
                b"IDAT" => data.extend_from_slice(content),
                _ => {}
            }
            // The checksum of four bytes.
            rest = after.get(4..).unwrap_or_default();
        }
        let Some(
            [
                w0,
                w1,
                w2,
                w3,
                h0,
                h1,
                h2,
                h3,
                bits,
                colour,
                _,
                _,
                interlace,
            ],
        ) = header
        else {
            return Err(damaged("PNG"));
        };
        let channels = match (colour, interlace) {
            (0, 0) => 1,
            (2, 0) => 3,
            _ => {
                return Err(Error::Unsupported {
                    format: "PNG",
                    reason: "for a page of a PDF it must be grey or in colours, without transparency, palette and \
                             interlacing"
                        .into(),
                });
            }
        };
        let size = [[*w0, *w1, *w2, *w3], [*h0, *h1, *h2, *h3]].map(u32::from_be_bytes);
        if data.is_empty()
            || size
                .iter()
                .any(|side| *side == 0 || *side > i32::MAX as u32)
        {
            return Err(damaged("PNG"));
        }
        Ok(PictureData {
            compression: Compression::Png,
            size,
            bits: *bits,
            channels,
            data: data.into(),
        })
    }

    fn from_jpeg(file: &'a [u8]) -> Result<Self> {
        let mut rest = &file[JPEG_SIGNATURE.len()..];
        while let [0xff, marker, after @ ..] = rest {
            // Bytes that fill up, and markers without a length.
            if *marker == 0xff {
                rest = &rest[1..];
                continue;
            }
            if matches!(marker, 0x01 | 0xd0..=0xd7) {
                rest = after;
                continue;
            }
            let length = after
                .first_chunk()
                .map(|bytes| usize::from(u16::from_be_bytes(*bytes)));
            let Some(content) = length.and_then(|length| after.get(2..length)) else {
                break;
            };
            // Start of frame, which C4, C8 and CC are not.
            if matches!(marker, 0xc0..=0xcf) && !matches!(marker, 0xc4 | 0xc8 | 0xcc) {
                let Some([bits, h0, h1, w0, w1, channels]) = content.first_chunk() else {
                    break;
                };
                let size = [[*w0, *w1], [*h0, *h1]].map(|side| u32::from(u16::from_be_bytes(side)));
                if !matches!(channels, 1 | 3) {
                    return Err(Error::Unsupported {
                        format: "JPEG",
                        reason: "for a page of a PDF it must be grey or in red, green and blue"
                            .into(),
                    });
                }
                if size.contains(&0) {
                    break;
                }
                return Ok(PictureData {
                    compression: Compression::Jpeg,
                    size,
                    bits: *bits,
                    channels: *channels,
                    data: file.into(),
                });
            }
            rest = &after[2 + content.len()..];
        }
        Err(damaged("JPEG"))
    }
}

fn damaged(format: &'static str) -> Error {
    Error::Format {
        format,
        reason: "its header is incomplete".into(),
    }
}
