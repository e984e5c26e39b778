//! Formats of files that are not read, by their first bytes, with what to do about each.

/// What to do about a photo that is not read.
pub(super) const SAVE_AS_JPEG: &str = "save it as JPEG or PNG";

/// What to do about a photo in Apple's format.
const SHARE_AS_JPEG: &str = "save it as JPEG (an iPhone shares photos as JPEG with Settings > Camera > Formats > Most Compatible)";

/// What to do about a grid of heights that GDAL reads.
const TRANSLATE: &str = "`gdal_translate IN OUT.tif` converts it";

/// What to do about a file of Gwyddion.
const EXPORT_FLOATS: &str =
    "let Gwyddion save it as a TIFF or OpenEXR image of floats, or as an ASCII data matrix";

/// What to do about a cloud of points.
const SAVE_AS_PLY: &str = "let CloudCompare save it as PLY";

/// What to do about a scene.
const SAVE_AS_GLB: &str = "let a 3D program such as Blender save it as GLB";

/// What to do about a drawing or a solid.
const SAVE_AS_MESH: &str = "let a CAD program such as FreeCAD save it as a mesh (STL or 3MF)";

/// First bytes, of which a `?` stands for any, the name of the format, and what to do. A tag of XML may stand further behind.
const FOREIGN_FORMATS: [(&[u8], &str, &str); 33] = [
    (b"????ftypavi", "AVIF", SAVE_AS_JPEG),
    (b"????ftyphei", "HEIC", SHARE_AS_JPEG),
    (b"????ftyphev", "HEIC", SHARE_AS_JPEG),
    (b"????ftypmif1", "HEIC", SHARE_AS_JPEG),
    (b"????ftypmsf1", "HEIC", SHARE_AS_JPEG),
    (
        b"%PDF",
        "PDF",
        "save its page as a picture, for example by `pdftoppm -r 300 -jpeg file.pdf page`",
    ),
    (
        b"\x89PNG",
        "PNG",
        "it was damaged in transfer; copy it anew",
    ),
    (b"GWYP", "Gwyddion", EXPORT_FLOATS),
    (b"GWYO", "Gwyddion", EXPORT_FLOATS),
    (
        b"Gwyddion Simple Field",
        "Gwyddion Simple Field",
        EXPORT_FLOATS,
    ),
    (b"Lerc", "LERC", TRANSLATE),
    (b"CntZImage", "LERC", TRANSLATE),
    (b"DSBB", "binary grid of Surfer", TRANSLATE),
    (b"DSRB", "binary grid of Surfer", TRANSLATE),
    (b"CDF", "NetCDF", TRANSLATE),
    (b"\x89HDF", "HDF5 or NetCDF", TRANSLATE),
    (b"SIMPLE  =", "FITS", TRANSLATE),
    (b"????jP  ", "JPEG 2000", TRANSLATE),
    (b"LASF", "LAS", SAVE_AS_PLY),
    (b"ASTM-E57", "E57", SAVE_AS_PLY),
    (b"# .PCD", "PCD", SAVE_AS_PLY),
    (b"<COLLADA", "Collada", SAVE_AS_GLB),
    (b"Kaydara FBX", "FBX", SAVE_AS_GLB),
    (b"; FBX", "FBX", SAVE_AS_GLB),
    (b"BLENDER", "Blender's own format", SAVE_AS_GLB),
    (b"#VRML", "VRML", SAVE_AS_GLB),
    (b"<X3D", "X3D", SAVE_AS_GLB),
    (b"ISO-10303-21", "STEP", SAVE_AS_MESH),
    (b"0\nSECTION", "DXF", SAVE_AS_MESH),
    (b"0\r\nSECTION", "DXF", SAVE_AS_MESH),
    (b"  0\nSECTION", "DXF", SAVE_AS_MESH),
    (b"  0\r\nSECTION", "DXF", SAVE_AS_MESH),
    (b"<svg", "SVG", "it is a drawing, and has no heights"),
];

/// Number of bytes at the start of a file within which a tag of XML tells its format.
const HEAD_BYTES: usize = 1000;

/// Returns the name of a format that is not read, and what to do; `None` for files of other or unknown formats.
pub(super) fn foreign(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    let head = &bytes[..bytes.len().min(HEAD_BYTES)];
    let is_in = |magic: &[u8]| match magic {
        [b'<', ..] => (0..head.len()).any(|at| begins(&head[at..], magic)),
        _ => begins(head, magic),
    };
    let found = FOREIGN_FORMATS.iter().find(|(magic, ..)| is_in(magic))?;
    Some((found.1, found.2))
}

/// Whether a file begins with given bytes, of which a `?` stands for any.
pub(super) fn begins(bytes: &[u8], magic: &[u8]) -> bool {
    bytes.len() >= magic.len() && magic.iter().zip(bytes).all(|(m, b)| *m == b'?' || m == b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_told_by_their_first_bytes() {
        let name = |bytes: &[u8]| foreign(bytes).map(|(name, _)| name);
        assert_eq!(name(b"\0\0\0\x18ftypheic\0\0\0\0"), Some("HEIC"));
        assert_eq!(name(b"<?xml version=\"1.0\"?>\n<COLLADA>"), Some("Collada"));
        assert_eq!(name(b"GWYPGwyContainer"), Some("Gwyddion"));
        assert_eq!(name(b"hello"), None);
    }
}
