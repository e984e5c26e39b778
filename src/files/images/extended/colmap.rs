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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::Unit;
    use crate::files::image_format::Format;
    use crate::files::images::{DecodeOptions, DepthEvidence};

    #[test]
    fn depths_are_read_row_by_row() {
        let depths = [1.5_f32, 0.0, 2.5, 3.0, 4.0, 5.0];
        let mut file = b"3&2&1&".to_vec();
        depths
            .iter()
            .for_each(|depth| file.extend(depth.to_le_bytes()));
        assert_eq!(Format::detect(&file), Some(Format::Colmap));
        let found = decode(&file).unwrap();
        assert_eq!(found.size, (3, 2));
        assert_eq!(
            (found.values, found.no_data),
            (depths.map(f64::from).to_vec(), Some(0.0))
        );
        // They are depths, in a unit of their own and not in millimetres, however large they are.
        let large: Vec<u8> = file[..6]
            .iter()
            .copied()
            .chain([300_f32; 6].map(f32::to_le_bytes).concat())
            .collect();
        let read = decode(&large)
            .and_then(|file| file.finish(Format::Colmap, &DecodeOptions::default()))
            .unwrap();
        assert_eq!(
            (read.depths, read.depth_unit),
            (DepthEvidence::Certain, Unit::Metre)
        );
        let error = decode(&file[..file.len() - 1]).unwrap_err();
        assert!(error.to_string().contains("it is cut short"), "{error}");
        assert_eq!(decode(b"3&2&3&").unwrap_err().code(), "UNSUPPORTED");
    }
}
