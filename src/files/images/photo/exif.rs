//! What the Exif data of a photo say: how the camera was held, and its focal length. Read by `kamadak-exif`.

use ::exif::{Exif, In, Reader, Tag};

use crate::scene::camera::has_camera_proportions;

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
        let exif = exif.and_then(|exif| {
            // WebP files of some programs have the prefix of JPEG files.
            let exif = exif.strip_prefix(b"Exif\0\0").unwrap_or(exif);
            Reader::new().read_raw(exif.to_vec()).ok()
        });
        let number = |tag| exif.as_ref().and_then(|exif| number(exif, tag));
        PhotoTags {
            orientation: match number(Tag::Orientation) {
                Some(number @ 1..=8) => number as u16,
                _ => 1,
            },
            film35: number(Tag::FocalLengthIn35mmFilm),
            stated: [Tag::PixelXDimension, Tag::PixelYDimension].map(number),
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

fn number(exif: &Exif, tag: Tag) -> Option<u32> {
    exif.get_field(tag, In::PRIMARY)?.value.get_uint(0)
}
