//! Fuzz targets: one for each decoder. Whatever the bytes, there has to be a result or an error,
//! and what was read has to be fit for use.

pub use libfuzzer_sys::fuzz_target;

pub use developable::formats::Format;
use developable::formats::{decode, decode_npz, npz_arrays};
pub use developable::meshes::MeshFormat;
use developable::meshes::read_mesh;
use developable::{Resolution, View, sample};

/// The fuzz target of a format of height images.
#[macro_export]
macro_rules! image {
    ($format:ident) => {
        $crate::fuzz_target!(|bytes: &[u8]| $crate::read_image(bytes, $crate::Format::$format));
    };
}

/// The fuzz target of a format of meshes.
#[macro_export]
macro_rules! mesh {
    ($format:ident) => {
        $crate::fuzz_target!(|bytes: &[u8]| $crate::look_at(bytes, $crate::MeshFormat::$format));
    };
}

/// Decodes, and makes heights of what comes out.
pub fn read_image(bytes: &[u8], format: Format) {
    if let Ok(file) = decode(bytes, Some(format)) {
        assert_eq!(file.values.len(), file.width * file.height);
        let _ = file.into_image();
    }
    if format == Format::Npz {
        for array in npz_arrays(bytes).unwrap_or_default() {
            let _ = decode_npz(bytes, Some(&array.name));
        }
    }
}

/// Decodes, and looks at what comes out from two sides.
pub fn look_at(bytes: &[u8], format: MeshFormat) {
    if let Ok(mesh) = read_mesh(bytes, Some(format)) {
        for view in [View::Along([0.0, 0.0, -1.0]), View::BestFit] {
            let _ = sample(&mesh, view, Resolution::Across(16));
        }
    }
}
