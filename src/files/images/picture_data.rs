//! Compressed data of JPEG and PNG files, for use in other file formats.

use std::borrow::Cow;

use ::png::{ColorType, Transformations};

use super::jpeg::OpenedJpeg;
use super::photo::decode_photo_basic;
use super::png;
use super::print::{OnWhite, PhotoOptions, write_photo};
use crate::dewarp::Photo;
use crate::error::Result;
use crate::files::failure::{in_format, not_read, unsupported};
use crate::files::image_format::Format;

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

impl<'a> PictureData<'a> {
    /// Reads the header of a JPEG or PNG file. The pixels are decoded only of a PNG file with transparency, a palette or
    /// interlacing, and are on white then.
    ///
    /// # Errors
    /// [`Error::Unsupported`](crate::Error::Unsupported) for other files, [`Error::Format`](crate::Error::Format) for a damaged one.
    pub fn new(file: &'a [u8]) -> Result<Self> {
        match Format::detect(file) {
            Some(Format::Png) => Self::from_png(file).map_err(in_format(Format::Png)),
            Some(Format::Jpeg) => Self::from_jpeg(file).map_err(in_format(Format::Jpeg)),
            _ => {
                let reason = "pictures of its pages must be JPEG or PNG files";
                Err(unsupported("PDF", reason))
            }
        }
    }

    fn from_png(file: &[u8]) -> Result<Self> {
        let (reader, size) = png::open(file, Transformations::IDENTITY, usize::MAX)?;
        let info = reader.info();
        let channels = match (info.color_type, info.interlaced) {
            (ColorType::Grayscale, false) => 1,
            (ColorType::Rgb, false) => 3,
            _ => {
                let file = decode_photo_basic(file)?;
                if file.width * file.height < size[0] * size[1] {
                    return Err(not_read("it has too many pixels for one with transparency"));
                }
                let photo = Photo::new(file.width, file.height, &file.rgba)?;
                let opaque = write_photo(&OnWhite(&photo), &PhotoOptions::default())?;
                return Self::from_png(&opaque);
            }
        };
        let mut data = Vec::new();
        // Each chunk has its length and its kind before it, and four bytes of a checksum after it.
        let mut rest = &file[PNG_SIGNATURE_BYTES..];
        while let Some(([l0, l1, l2, l3, kind @ ..], after)) = rest.split_first_chunk::<8>() {
            let length = u32::from_be_bytes([*l0, *l1, *l2, *l3]) as usize;
            let Some((content, after)) = after.split_at_checked(length) else {
                break;
            };
            if kind == b"IDAT" {
                data.extend_from_slice(content);
            }
            rest = after.get(4..).unwrap_or_default();
        }
        Ok(PictureData {
            compression: Compression::Png,
            size: size.map(|side| side as u32),
            bits: info.bit_depth as u8,
            channels,
            data: data.into(),
        })
    }

    fn from_jpeg(file: &'a [u8]) -> Result<Self> {
        let opened = OpenedJpeg::new(file)?;
        let channels = opened.components;
        if !matches!(channels, 1 | 3) {
            let reason = "for a page of a PDF it must be grey or in red, green and blue";
            return Err(not_read(reason));
        }
        Ok(PictureData {
            compression: Compression::Jpeg,
            size: [opened.size.0, opened.size.1].map(|side| side as u32),
            bits: 8,
            channels,
            data: file.into(),
        })
    }
}

/// Number of bytes before the first chunk of a PNG file.
const PNG_SIGNATURE_BYTES: usize = 8;
