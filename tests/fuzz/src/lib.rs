//! Fuzz targets: one for each decoder. Whatever the bytes, there has to be a result or an error,
//! and what was read has to be fit for use.

pub use libfuzzer_sys::fuzz_target;

pub use developable::files::images::Format;
use developable::files::images::{DecodeOptions, decode, decode_photo, decode_with, npz_arrays};
pub use developable::files::meshes::MeshFormat;
use developable::files::meshes::read_mesh_beside;
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
            let _ = decode_with(bytes, None, &DecodeOptions::default().array(&array.name));
        }
    }
}

/// Decodes a picture with its colours.
pub fn read_photo(bytes: &[u8]) {
    if let Ok(photo) = decode_photo(bytes) {
        assert_eq!(photo.rgba.len(), 4 * photo.width * photo.height);
    }
}

/// Decodes, and looks at what comes out from two sides.
pub fn look_at(bytes: &[u8], format: MeshFormat) {
    look_beside(bytes, format, &[]);
}

/// A triangle for each of the first materials, `a` and `b`.
const TRIANGLES: &[u8] = b"mtllib m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n\
                           usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n";

/// Decodes the materials of a mesh.
pub fn look_with(materials: &[u8]) {
    let files = [("m", materials), ("p", &b"a picture"[..])];
    look_beside(TRIANGLES, MeshFormat::Obj, &files);
}

fn look_beside(bytes: &[u8], format: MeshFormat, files: &[(&str, &[u8])]) {
    if let Ok(file) = read_mesh_beside(bytes, Some(format), files) {
        let numbers = file.mesh.textures().unwrap_or_default();
        let there = |number: &i32| *number < file.textures.len() as i32;
        assert!(numbers.iter().all(there));
        for view in [View::Along([0.0, 0.0, -1.0]), View::BestFit] {
            let _ = sample(&file.mesh, view, Resolution::Across(16));
        }
    }
}
