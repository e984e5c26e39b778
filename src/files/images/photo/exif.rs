//! What the Exif data of a photo say: how the camera was held, and its focal length.

use crate::files::number_type::NumberType;
use crate::scene::camera::has_camera_proportions;

/// Tags of Exif data by their numbers.
#[derive(Clone, Copy)]
enum Tag {
    /// How the camera was held.
    Orientation = 0x112,
    /// Where the directory of the tags about the camera is.
    Camera = 0x8769,
    Width = 0xa002,
    Height = 0xa003,
    FocalLengthIn35mmFilm = 0xa405,
}

/// What a photo's tags say about how it was taken.
pub(crate) struct PhotoTags {
    /// How the camera was held, as TIFF's orientation number from 1 (upright) to 8. An invalid number counts as 1, since
    /// damaged metadata need not mean a damaged picture.
    pub orientation: u16,
    film35: Option<u32>,
    /// Width and height of the photo that the tags state.
    stated: [Option<u32>; 2],
}

impl PhotoTags {
    /// Reads Exif data as they are stored in a file, in the form of a TIFF file; none count as empty ones.
    pub fn read(exif: Option<&[u8]>) -> Self {
        // WebP files of some programs have the prefix of JPEG files.
        let exif = exif.map(|exif| exif.strip_prefix(b"Exif\0\0").unwrap_or(exif));
        let photo = exif.and_then(Directory::first);
        let camera = photo.and_then(|photo| {
            let start = photo.number(Tag::Camera)? as usize;
            Some(Directory { start, ..photo })
        });
        let number = |tag| camera?.number(tag);
        PhotoTags {
            orientation: match photo.and_then(|photo| photo.number(Tag::Orientation)) {
                Some(number @ 1..=8) => number as u16,
                _ => 1,
            },
            film35: number(Tag::FocalLengthIn35mmFilm),
            stated: [Tag::Width, Tag::Height].map(number),
        }
    }

    /// Focal length for 35 mm film of a photo of the given width and height; `None` if the photo was cropped: its
    /// proportions are no camera's, or the photo's size in the Exif data has others. Programs that crop a photo keep the
    /// data of its camera, and some state the new size.
    pub fn film35(&self, (width, height): (usize, usize)) -> Option<f64> {
        let length = self.film35.filter(|length| *length > 0)?;
        if let [Some(w @ 1..), Some(h @ 1..)] = self.stated {
            let ratio = |a: f64, b: f64| a.max(b) / a.min(b);
            let off = ratio(width as f64, height as f64) / ratio(f64::from(w), f64::from(h));
            if (off - 1.0).abs() > 0.01 {
                return None;
            }
        }
        has_camera_proportions([width, height]).then_some(f64::from(length))
    }
}

/// A directory of tags in Exif data, which have the form of a TIFF file.
#[derive(Clone, Copy)]
struct Directory<'a> {
    exif: &'a [u8],
    is_big_endian: bool,
    start: usize,
}

impl<'a> Directory<'a> {
    /// Finds the first directory; `None` for other bytes.
    fn first(exif: &'a [u8]) -> Option<Self> {
        let is_big_endian = match exif.get(..4)? {
            b"II*\0" => false,
            b"MM\0*" => true,
            _ => return None,
        };
        let mut directory = Directory {
            exif,
            is_big_endian,
            start: 0,
        };
        directory.start = directory.value(4, NumberType::U32)? as usize;
        Some(directory)
    }

    /// Returns the first number of a tag; `None` where it is not there, or none is.
    fn number(&self, tag: Tag) -> Option<u32> {
        let entries = self.value(self.start, NumberType::U16)? as usize;
        let mut places = (0..entries).map_while(|k| self.start.checked_add(2 + 12 * k));
        let entry = places.find(|at| self.value(*at, NumberType::U16) == Some(tag as u32))?;
        let kind = match self.value(entry + 2, NumberType::U16)? {
            1 => NumberType::U8,
            3 => NumberType::U16,
            4 => NumberType::U32,
            _ => return None,
        };
        let bytes = (self.value(entry + 4, NumberType::U32)? as usize).checked_mul(kind.bytes())?;
        match bytes {
            0 => None,
            1..=4 => self.value(entry + 8, kind),
            // More than four bytes lie elsewhere.
            _ => self.value(self.value(entry + 8, NumberType::U32)? as usize, kind),
        }
    }

    fn value(&self, at: usize, kind: NumberType) -> Option<u32> {
        let bytes = self.exif.get(at..at.checked_add(kind.bytes())?)?;
        Some(kind.value(bytes, self.is_big_endian) as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tag's entry: its number, the type of its values, how many there are, and the bytes of the first or their place.
    fn entry(tag: u16, kind: u16, count: u32, value: [u8; 4]) -> Vec<u8> {
        [
            &tag.to_be_bytes()[..],
            &kind.to_be_bytes(),
            &count.to_be_bytes(),
            &value,
        ]
        .concat()
    }

    #[test]
    fn tags_are_read_from_their_directories() {
        let file = [
            b"MM\0*\0\0\0\x08\0\x02".to_vec(),
            entry(0x112, 3, 1, [0, 6, 0, 0]),
            entry(0x8769, 4, 1, [0, 0, 0, 38]),
            vec![0; 4],
            vec![0, 3],
            entry(0xa002, 4, 1, [0, 0, 0x0f, 0xa0]),
            entry(0xa003, 3, 1, [0x0b, 0xb8, 0, 0]),
            entry(0xa405, 3, 3, [0, 0, 0, 80]),
            vec![0; 4],
            vec![0, 26, 0, 1, 0, 2],
        ]
        .concat();
        let tags = PhotoTags::read(Some(&file));
        assert_eq!(
            (tags.orientation, tags.stated),
            (6, [Some(4000), Some(3000)])
        );
        assert_eq!(tags.film35((4000, 3000)), Some(26.0));
        // Wherever it ends, and with every byte damaged.
        for end in 0..file.len() {
            PhotoTags::read(Some(&file[..end]));
            let mut damaged = file.clone();
            damaged[end] = 0xff;
            PhotoTags::read(Some(&damaged));
        }
        assert_eq!(PhotoTags::read(Some(b"")).orientation, 1);
    }
}
