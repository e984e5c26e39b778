//! Opens TIFF files for the `tiff` crate, and decompresses strips and tiles that Zstandard or LZW have compressed, as GDAL writes
//! them.
//!
//! The crate takes the C library for the first, and takes some data of the second for cut short. So such a file is written anew
//! for it in memory, with the same directory but plain strips, whose prediction it undoes.

use std::borrow::Cow;
use std::io::{Cursor, ErrorKind, Read};

use ::ruzstd::decoding::StreamingDecoder;
use ::tiff::decoder::{ChunkType, Decoder, DecodingResult, Limits};
use ::tiff::tags::{ByteOrder, CompressionMethod, Tag};
use ::tiff::{TiffError, TiffUnsupportedError};
use ::weezl::decode::Decoder as LzwDecoder;
use ::weezl::{BitOrder, LzwStatus};

use crate::error::{Error, Result};
use crate::files::failure::{damaged, not_read, undecodable};

pub(crate) type File<'a> = Decoder<Cursor<Cow<'a, [u8]>>>;

/// Opens a TIFF file with a decoder that may allocate `max_bytes` itself: for a compressed strip, and the values of a tag.
pub(crate) fn open<'a>(bytes: &'a [u8], max_bytes: usize) -> Result<File<'a>> {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = max_bytes;
    limits.intermediate_buffer_size = max_bytes;
    let open = |bytes: Cow<'a, [u8]>| -> Result<File<'a>> {
        let file = Decoder::new(Cursor::new(bytes)).map_err(failed)?;
        Ok(file.with_limits(limits.clone()))
    };
    let mut file = open(bytes.into())?;
    let kind = file
        .find_tag_unsigned(Tag::NewSubfileType)
        .map_err(failed)?;
    if kind.unwrap_or(0) & REDUCED_IMAGE_BIT != 0 {
        let reason = "its first image is a reduced one, as in a raw photo of a camera; save the photo as JPEG";
        return Err(not_read(reason));
    }
    let [offsets, _] = chunk_tags(&file);
    if (file.get_tag_u64_vec(offsets)).is_ok_and(|offsets| offsets.contains(&0)) {
        let reason =
            "strips or tiles that are left out; `gdal_translate IN.tif OUT.tif` writes them all";
        return Err(not_read(reason));
    }
    match inflated(bytes, &mut file, max_bytes)? {
        Some(inflated) => open(inflated.into()),
        None => Ok(file),
    }
}

/// Bit of the TIFF tag `NewSubfileType` of an image that is another one at a lower resolution.
pub(super) const REDUCED_IMAGE_BIT: u16 = 1;

/// Number of the TIFF type of unsigned numbers of 32 bits.
const LONG: u64 = 4;
/// Number of the TIFF type of unsigned numbers of 64 bits.
const LONG8: u64 = 16;

/// Tags of the places and lengths of a picture's strips or tiles.
fn chunk_tags(file: &File) -> [Tag; 2] {
    match file.get_chunk_type() {
        ChunkType::Strip => [Tag::StripOffsets, Tag::StripByteCounts],
        ChunkType::Tile => [Tag::TileOffsets, Tag::TileByteCounts],
    }
}

/// Returns the file with plain strips or tiles; `None` if those of its first image are compressed neither by Zstandard nor by LZW.
/// They have `max_bytes` together at most.
fn inflated(bytes: &[u8], file: &mut File, max_bytes: usize) -> Result<Option<Vec<u8>>> {
    let method = file.find_tag_unsigned(Tag::Compression).map_err(failed)?;
    let inflate = match method.map(CompressionMethod::from_u16_exhaustive) {
        Some(CompressionMethod::ZSTD) => inflate_zstandard,
        Some(CompressionMethod::LZW) => inflate_lzw,
        _ => return Ok(None),
    };
    let tags = chunk_tags(file);
    let [offsets, counts] = tags.map(|tag| file.get_tag_u64_vec(tag).map_err(failed));
    let mut plain = bytes.to_vec();
    let mut places = [Vec::new(), Vec::new()];
    for (offset, count) in offsets?.into_iter().zip(counts?) {
        let end = offset.saturating_add(count).min(usize::MAX as u64) as usize;
        let compressed =
            (bytes.get(offset as usize..end)).ok_or_else(|| damaged("it is cut short"))?;
        let start = plain.len();
        if !compressed.is_empty() {
            inflate(compressed, &mut plain, bytes.len() + max_bytes)?;
        }
        places[0].push(start as u64);
        places[1].push((plain.len() - start) as u64);
    }
    let directory = Directory::of(file);
    let [offsets, counts] = places;
    for (tag, values) in [
        (Tag::Compression, vec![1]),
        (tags[0], offsets),
        (tags[1], counts),
    ] {
        let replaced = directory.replace(&mut plain, tag, &values);
        replaced.ok_or_else(|| damaged("its directory is cut short"))?;
    }
    Ok(Some(plain))
}

/// Reads the mask that a file has for its image number `index`, whose tags the file is at.
pub(super) fn mask(file: &mut File, index: usize) -> Result<Vec<u8>> {
    let directory = Directory::of(file);
    // The decoder takes bits of grey, but none of a mask.
    let bytes = file.inner().get_mut().to_mut();
    directory.replace(bytes, Tag::PhotometricInterpretation, &[1]);
    file.seek_to_image(index).map_err(failed)?;
    match file.read_image().map_err(failed)? {
        DecodingResult::U8(bytes) => Ok(bytes),
        _ => Err(not_read("a mask of other numbers than bits")),
    }
}

/// Makes bytes of 0 or 255 of the bits of rows of `width`, each of which begins at a byte.
pub(crate) fn unpacked_bits(rows: &[u8], width: usize) -> Vec<u8> {
    let is_set = |row: &[u8], x: usize| row[x / 8] << (x % 8) & 0x80 != 0;
    let rows = rows.chunks_exact(width.div_ceil(8));
    rows.flat_map(|row| (0..width).map(move |x| if is_set(row, x) { u8::MAX } else { 0 }))
        .collect()
}

/// Appends decompressed data, up to a length of the whole.
fn inflate_zstandard(compressed: &[u8], plain: &mut Vec<u8>, max_length: usize) -> Result<()> {
    let decoder = StreamingDecoder::new(compressed).map_err(undecodable)?;
    let left = max_length.saturating_sub(plain.len());
    let read = decoder.take(left as u64 + 1).read_to_end(plain);
    read.map_err(undecodable)?;
    check_inflated(plain, max_length)
}

/// Number of bytes that LZW decodes at a time.
const LZW_BLOCK_BYTES: usize = 1 << 16;

/// Appends decompressed data, up to a length of the whole. What follows the end of the code is padding, and the end may be missing.
fn inflate_lzw(mut compressed: &[u8], plain: &mut Vec<u8>, max_length: usize) -> Result<()> {
    let mut decoder = LzwDecoder::with_tiff_size_switch(BitOrder::Msb, 8);
    loop {
        let start = plain.len();
        plain.resize(start + LZW_BLOCK_BYTES, 0);
        let step = decoder.decode_bytes(compressed, &mut plain[start..]);
        plain.truncate(start + step.consumed_out);
        compressed = &compressed[step.consumed_in..];
        check_inflated(plain, max_length)?;
        if !matches!(step.status.map_err(undecodable)?, LzwStatus::Ok) {
            return Ok(());
        }
    }
}

fn check_inflated(plain: &[u8], max_length: usize) -> Result<()> {
    let reason = "more compressed data than are read; `gdal_translate -co COMPRESS=DEFLATE IN.tif OUT.tif` writes one that is read";
    (plain.len() <= max_length)
        .then_some(())
        .ok_or_else(|| not_read(reason))
}

/// One of the first four bytes of a BigTIFF file, which tells it from another TIFF.
const BIG_TIFF_MARK: u8 = 43;

/// Where the directory of an image lies in a TIFF file, and how numbers are stored there.
struct Directory {
    start: usize,
    order: ByteOrder,
    /// Whether offsets and counts have 64 bits instead of 32.
    is_big: bool,
}

impl Directory {
    /// The directory of the image that a decoder is at.
    fn of(file: &mut File) -> Self {
        let mark = file.inner().get_ref().get(2..4);
        let is_big = mark.is_some_and(|mark| mark.contains(&BIG_TIFF_MARK));
        Directory {
            start: file.ifd_pointer().map_or(0, |place| place.0 as usize),
            order: file.byte_order(),
            is_big,
        }
    }

    /// Replaces the values of a tag of the directory; `None` if it is not there or cut short.
    fn replace(&self, file: &mut Vec<u8>, tag: Tag, values: &[u64]) -> Option<()> {
        let (head, width, kind) = match self.is_big {
            true => (8, 8, LONG8),
            false => (2, 4, LONG),
        };
        let entries = self.number(file, self.start, head)? as usize;
        let mut places = (0..entries).map(|k| self.start + head + k * (4 + 2 * width));
        let entry = places.find(|at| self.number(file, *at, 2) == Some(u64::from(tag.to_u16())))?;
        let place = file.len();
        let value = match values {
            [value] => *value,
            _ => {
                file.resize(place + width * values.len(), 0);
                for (k, value) in values.iter().enumerate() {
                    self.store(file, place + k * width, width, *value)?;
                }
                place as u64
            }
        };
        self.store(file, entry + 2, 2, kind)?;
        self.store(file, entry + 4, width, values.len() as u64)?;
        self.store(file, entry + 4 + width, width, value)
    }

    fn number(&self, file: &[u8], at: usize, width: usize) -> Option<u64> {
        let bytes = file.get(at..at.checked_add(width)?)?.iter();
        let append = |number: u64, byte: &u8| number << 8 | u64::from(*byte);
        Some(match self.order {
            ByteOrder::BigEndian => bytes.fold(0, append),
            ByteOrder::LittleEndian => bytes.rev().fold(0, append),
        })
    }

    fn store(&self, file: &mut [u8], at: usize, width: usize, value: u64) -> Option<()> {
        let bytes = file.get_mut(at..at + width)?;
        bytes.copy_from_slice(&value.to_le_bytes()[..width]);
        if self.order == ByteOrder::BigEndian {
            bytes.reverse();
        }
        Some(())
    }
}

pub(crate) fn failed(error: TiffError) -> Error {
    match error {
        TiffError::UnsupportedError(TiffUnsupportedError::UnsupportedCompressionMethod(method)) => {
            let number = method.to_u16();
            let name = match number {
                34712 => " (JPEG 2000)",
                34887 => " (LERC)",
                34925 => " (LZMA)",
                50001 => " (WebP)",
                50002 => " (JPEG XL)",
                _ => "",
            };
            not_read(format!(
                "the compression {number}{name}; `gdal_translate -co COMPRESS=DEFLATE IN.tif OUT.tif` \
                     writes one that is read"
            ))
        }
        TiffError::UnsupportedError(what) => not_read(what),
        TiffError::IoError(cause) if cause.kind() == ErrorKind::UnexpectedEof => {
            damaged("it is cut short")
        }
        other => undecodable(other),
    }
}
