//! Reads depth maps of COLMAP: `width&height&channels&`, then 32-bit floats, row by row, 0 where there is no depth.

use crate::error::Result;
use crate::files::failure::{damaged, not_read};
use crate::files::image_format::colmap_head;
use crate::files::images::decoded::StoredImage;
use crate::files::images::raw_pixels::raw_pixels;
use crate::files::number_type::NumberType;

pub(super) fn decode(bytes: &[u8]) -> Result<StoredImage> {
    let Some(([width, height, channels], head)) = colmap_head(bytes) else {
        return Err(damaged("its head is no `width&height&channels&`"));
    };
    if channels != 1 {
        let reason = format!("it has {channels} channels, and depths have one");
        return Err(not_read(reason));
    }
    let size = (width, height);
    let values = raw_pixels(size, &bytes[head..], NumberType::F32, false)?;
    Ok(StoredImage {
        no_data: Some(0.0),
        ..StoredImage::new(size, values, NumberType::F32)
    })
}
