//! Files that are not read: their contents tell what they are, and errors say what to do about them.

use super::image_format::Format;
use super::mesh_format::MeshFormat;
use super::signature::{begins, contains};
use crate::error::Error;
use crate::files::failure::{damaged, in_format, unsupported};

/// The purpose for which a file is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Purpose {
    #[cfg(feature = "formats")]
    Heights,
    #[cfg(feature = "images")]
    Photo,
    #[cfg(feature = "meshes")]
    Mesh,
}

impl Purpose {
    /// Returns what is wanted, with its article, and the formats of which it is read.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            #[cfg(feature = "formats")]
            Purpose::Heights => (
                "heights",
                "heights are read from PNG, NPY, TIFF, EXR, PFM, PGM, NPZ, JPEG, WebP, GIF, BMP, text, SRTM heights and depths of COLMAP",
            ),
            #[cfg(feature = "images")]
            Purpose::Photo => (
                "a photo",
                "photos are read from JPEG, PNG, WebP, GIF, BMP and TIFF files",
            ),
            #[cfg(feature = "meshes")]
            Purpose::Mesh => (
                "a mesh",
                "meshes are read from OBJ, PLY, STL, glTF, GLB, 3MF, OFF and XYZ",
            ),
        }
    }
}

const SAVE_AS_JPEG: &str = "save it as JPEG or PNG";
const CONVERT_BY_GDAL: &str = "`gdal_translate IN OUT.tif` converts it";
pub(super) const CONVERT_RAW: &str =
    "`gdal_translate IN OUT.tif` converts raw numbers that have a header beside them (.bil, .flt)";
const SAVE_AS_PLY: &str = "let CloudCompare save it as PLY";
const EXPORT_FLOATS: &str =
    "let Gwyddion or the program that wrote it save a TIFF or OpenEXR image of floats, or text";
const SAVE_AS_STL: &str = "let Gmsh save it as STL";
const SAVE_AS_GLB: &str = "let a 3D program such as Blender save it as GLB";
const SAVE_PAGES: &str =
    "save its page as a picture, for example by `pdftoppm -r 300 -jpeg file.pdf page`";
const OPEN_DOCUMENT: &str = "save it as PDF, and the PDF's pages as pictures";
const UNPACK_FIRST: &str = "it is packed: unpack it first";

/// First bytes of a DICOM file: 128 of any kind, then its name.
const DICOM_START: [u8; 132] = {
    let mut start = [b'?'; 132];
    [start[128], start[129], start[130], start[131]] = *b"DICM";
    start
};

/// Formats that are not read: their names, what to do about them, and bytes of which one is in each file. A file begins with
/// them, and a `?` among them stands for any; a tag of XML or HTML may stand further behind.
#[rustfmt::skip]
const FOREIGN_FORMATS: [(&str, &str, &[&[u8]]); 58] = [
    ("AVIF", SAVE_AS_JPEG, &[b"????ftypavi"]),
    ("HEIC", "save it as JPEG (an iPhone shares photos as JPEG with Settings > Camera > Formats > Most Compatible)",
        &[b"????ftyphei", b"????ftyphev", b"????ftypmif1", b"????ftypmsf1"]),
    ("raw photo of a camera", SAVE_AS_JPEG, &[b"????ftypcrx", b"FUJIFILM", b"IIRO", b"IIU\0"]),
    ("film", "save one of its pictures as JPEG or PNG", &[b"????ftyp", b"\x1a\x45\xdf\xa3", b"RIFF????AVI "]),
    ("JPEG XL", SAVE_AS_JPEG, &[b"\xff\x0a", b"\0\0\0\x0cJXL "]),
    ("Photoshop", SAVE_AS_JPEG, &[b"8BPS"]),
    ("PPM", SAVE_AS_JPEG, &[b"P3", b"P6"]),
    ("QOI", SAVE_AS_JPEG, &[b"qoif"]),
    ("DDS", SAVE_AS_JPEG, &[b"DDS "]),
    ("KTX", SAVE_AS_JPEG, &[b"\xabKTX"]),
    ("DICOM", "let ImageJ save it as TIFF", &[&DICOM_START]),
    ("PDF", SAVE_PAGES, &[b"%PDF"]),
    ("PostScript", SAVE_PAGES, &[b"%!PS"]),
    ("document of an office program", OPEN_DOCUMENT, &[b"\xd0\xcf\x11\xe0", b"{\\rtf"]),
    ("PNG", "it was damaged in transfer; copy it anew", &[b"\x89PNG"]),
    ("Radiance HDR", "save it as OpenEXR", &[b"#?RADIANCE", b"#?RGBE"]),
    ("Gwyddion", EXPORT_FLOATS, &[b"GWYP", b"GWYO"]),
    ("Gwyddion Simple Field", EXPORT_FLOATS, &[b"Gwyddion"]),
    ("SDF", EXPORT_FLOATS, &[b"aISO-1.0", b"bISO-1.0"]),
    ("SUR", EXPORT_FLOATS, &[b"DIGITAL SURF", b"DSCOMPRESSED"]),
    ("Nanoscope", EXPORT_FLOATS, &[b"\\*File list"]),
    ("LERC", CONVERT_BY_GDAL, &[b"Lerc", b"CntZImage"]),
    ("binary grid of Surfer", CONVERT_BY_GDAL, &[b"DSBB", b"DSRB"]),
    ("NetCDF", CONVERT_BY_GDAL, &[b"CDF"]),
    ("HDF5 or NetCDF", CONVERT_BY_GDAL, &[b"\x89HDF"]),
    ("header of a raw grid", CONVERT_RAW, &[b"BYTEORDER", b"ENVI"]),
    ("text grid of GRASS", CONVERT_BY_GDAL, &[b"north:"]),
    ("Erdas Imagine", CONVERT_BY_GDAL, &[b"EHFA_HEADER_TAG"]),
    ("NITF", CONVERT_BY_GDAL, &[b"NITF"]),
    ("virtual raster of GDAL", CONVERT_BY_GDAL, &[b"<VRTDataset"]),
    ("FITS", CONVERT_BY_GDAL, &[b"SIMPLE  ="]),
    ("JPEG 2000", CONVERT_BY_GDAL, &[b"????jP  ", b"\xff\x4f\xff\x51"]),
    ("MATLAB", "let MATLAB write its matrix by `writematrix`", &[b"MATLAB 5.0"]),
    ("pickle of Python", "save its array by `numpy.save`", &[b"\x80\x02", b"\x80\x03", b"\x80\x04", b"\x80\x05"]),
    ("LAS", SAVE_AS_PLY, &[b"LASF"]),
    ("E57", SAVE_AS_PLY, &[b"ASTM-E57"]),
    ("PCD", SAVE_AS_PLY, &[b"# .PCD", b"VERSION .7", b"VERSION 0.7"]),
    ("VTK or XDMF", "let ParaView save it as PLY", &[b"# vtk", b"<VTKFile", b"<Xdmf"]),
    ("Gmsh", SAVE_AS_STL, &[b"$MeshFormat"]),
    ("Medit", SAVE_AS_STL, &[b"MeshVersionFormatted"]),
    ("Nastran", SAVE_AS_STL, &[b"BEGIN BULK", b"SOL ", b"CEND", b"NASTRAN ", b"$ Nastran", b"GRID "]),
    ("Abaqus", "let FreeCAD save its mesh as STL", &[b"*HEADING", b"*Heading", b"*heading", b"*NODE", b"*Node", b"*node", b"** "]),
    ("Collada", SAVE_AS_GLB, &[b"<COLLADA"]),
    ("FBX", SAVE_AS_GLB, &[b"Kaydara FBX", b"; FBX"]),
    ("Blender's own format", SAVE_AS_GLB, &[b"BLENDER"]),
    ("VRML", SAVE_AS_GLB, &[b"#VRML"]),
    ("X3D", SAVE_AS_GLB, &[b"<X3D"]),
    ("USD", SAVE_AS_GLB, &[b"#usda", b"PXR-USDC"]),
    ("SketchUp", "let SketchUp save it as STL or GLB", &[b"\xff\xfe\xff\x0eS\0k\0"]),
    ("Rhino", "let Rhino save it as STL or 3MF", &[b"3D Geometry File"]),
    ("AMF", "let the slicer save it as 3MF", &[b"<amf"]),
    ("MTL", "it has the materials of an OBJ file: open that one", &[b"newmtl"]),
    ("drawing or solid of CAD", "let a CAD program such as FreeCAD save it as a mesh (STL or 3MF)",
        &[b"ISO-10303-21", b"DBRep_Draw", b"0\nSECTION", b"0\r\nSECTION", b"  0\nSECTION", b"  0\r\nSECTION"]),
    ("SVG", "it is a drawing, and has no heights", &[b"<svg"]),
    ("web page", "the download has failed or asks to log in: download the file itself", &[b"<html", b"<!DOCTYPE html", b"<!doctype html"]),
    ("pointer of Git LFS", "`git lfs pull` fetches the file itself", &[b"version https://git-lfs"]),
    ("JSON", "a camera's file is given beside its depths", &[b"{"]),
    ("archive", UNPACK_FIRST, &[b"\x1f\x8b", b"7z\xbc\xaf", b"Rar!", b"BZh", b"\xfd7zXZ", b"\x28\xb5\x2f\xfd"]),
];

/// ZIP archives of formats that are not read: their names, what to do about them, and a part of a name in each; the last one
/// is any other.
const FOREIGN_ARCHIVES: [(&str, &str, &[&[u8]]); 4] = [
    ("X3P", EXPORT_FLOATS, &[b"bindata/"]),
    ("USD", SAVE_AS_GLB, &[b".usd"]),
    (
        "document of an office program",
        OPEN_DOCUMENT,
        &[b"word/", b"xl/", b"ppt/", b"content.xml"],
    ),
    ("archive", UNPACK_FIRST, &[b"PK"]),
];

/// Number of bytes at the start of a file within which a tag of XML tells its format.
const HEAD_BYTES: usize = 1000;

/// Returns the name of a format that is not read, and what to do; `None` for files of other or unknown formats.
pub(super) fn foreign(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    let head = &bytes[..bytes.len().min(HEAD_BYTES)];
    let archive = head.starts_with(b"PK\x03\x04");
    let known = match archive {
        true => &FOREIGN_ARCHIVES[..],
        false => &FOREIGN_FORMATS[..],
    };
    let is_told = |part: &&[u8]| match part {
        _ if archive => contains(bytes, part),
        [b'<', ..] => (0..head.len()).any(|at| begins(&head[at..], part)),
        _ => begins(head, part),
    };
    let found = known.iter().find(|(.., parts)| parts.iter().any(is_told))?;
    Some((found.0, found.1))
}

/// Makes the error for a file that is not read for a purpose: what it is, what is read, and what to do.
pub(super) fn refused(bytes: &[u8], purpose: Purpose) -> Error {
    let (wanted, formats) = purpose.words();
    if bytes.is_empty() {
        return in_format(wanted)(damaged("the file is empty"));
    }
    let image = image_format(bytes);
    let (name, advice) = if let Some(mesh) = mesh_format(bytes, image) {
        let kind = match mesh {
            MeshFormat::Xyz => "point cloud",
            _ => "mesh",
        };
        let name = mesh.name();
        let advice = format!("it is a {kind}: read it as one, by a name that ends in .{name}");
        (mesh.title(), advice)
    } else if let Some(image) = image {
        let advice = match purpose {
            #[cfg(feature = "images")]
            Purpose::Photo => "it has heights, and is no photo: read it as heights",
            _ if image == Format::Text => "it is a table of numbers: read it as heights",
            _ => "it is an image: read it as heights or as a photo",
        };
        (image.title(), advice.into())
    } else if let Some((name, advice)) = foreign(bytes) {
        (name, advice.into())
    } else {
        let head = &bytes[..bytes.len().min(HEAD_BYTES)];
        let is_printed = |byte: &u8| *byte >= b' ' || byte.is_ascii_whitespace();
        // UTF-8, whose last letter may be cut.
        let is_text = head.iter().all(is_printed)
            && !std::str::from_utf8(head).is_err_and(|at| at.error_len().is_some());
        let name = if is_text {
            "text"
        } else {
            "a file of unknown format"
        };
        let advice = match purpose {
            #[cfg(feature = "formats")]
            Purpose::Heights if !is_text => CONVERT_RAW,
            _ => "it is of no format that is read",
        };
        (name, advice.into())
    };
    unsupported(name, format!("{advice}; {formats}"))
}

/// Detects the format of an image of heights or of a photo. Text of a format that is not read is no matrix, whatever numbers it has.
fn image_format(bytes: &[u8]) -> Option<Format> {
    Format::detect(bytes).filter(|found| *found != Format::Text || foreign(bytes).is_none())
}

/// Detects the format of a mesh file that has the signature of no image, whose format is `image`: text may be a matrix or a mesh.
fn mesh_format(bytes: &[u8], image: Option<Format>) -> Option<MeshFormat> {
    let may_be_mesh = matches!(image, None | Some(Format::Text));
    may_be_mesh.then(|| MeshFormat::detect(bytes)).flatten()
}

/// Detects the format of a file of heights, of a photo or of a mesh, and returns its name, such as `"png"` or `"stl"`; `None`
/// for other files. Costs `O(bytes)`.
#[cfg(feature = "formats")]
pub fn format_name(bytes: &[u8]) -> Option<&'static str> {
    let image = image_format(bytes);
    mesh_format(bytes, image)
        .map(MeshFormat::name)
        .or(image.map(Format::name))
}

/// Detects the format of an image file of heights from its first bytes, and checks that it is the stated format, if one is
/// stated.
///
/// # Errors
/// [`Error::Format`] for an empty file and one of another format than stated,
/// [`Error::Unsupported`] for a file of no known format.
#[cfg(feature = "formats")]
pub fn announced(bytes: &[u8], stated: Option<Format>) -> crate::Result<Format> {
    let found = image_format(bytes);
    match stated {
        Some(stated) => stated.checked(found),
        None => found
            .filter(|_| mesh_format(bytes, found).is_none())
            .ok_or_else(|| refused(bytes, Purpose::Heights)),
    }
}

#[cfg(all(test, feature = "images", feature = "meshes"))]
mod tests {
    use super::*;

    #[test]
    fn files_are_told_by_their_contents() {
        let dicom = [&[0; 128][..], b"DICM\x02\0"].concat();
        let zip = |names: &str| format!("PK\x03\x04\x14\0\x06\0\x08\0 {names}").into_bytes();
        #[rustfmt::skip]
        let files: [(&[u8], &str); 20] = [
            (b"\0\0\0\x18ftypheic\0\0\0\0", "HEIC"),
            (b"\0\0\0\x20ftypisom\0\0\x02\0isomiso2mp41", "film"),
            (b"<?xml version=\"1.0\"?>\n<COLLADA>", "Collada"),
            (b"GWYPGwyContainer", "Gwyddion"),
            (&zip("[Content_Types].xml word/document.xml"), "document of an office program"),
            (&zip("main.xml bindata/data.bin"), "X3P"),
            (&zip("letter.txt"), "archive"),
            (b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n", "pointer of Git LFS"),
            (b"<!DOCTYPE html><html><head><title>404 Not Found</title>", "web page"),
            (b"\x80\x04\x95numpy", "pickle of Python"),
            (b"MeshVersionFormatted 1\nDimension 3\n", "Medit"),
            (b"*Heading\n** by a solver\n*Node\n", "Abaqus"),
            (b"SOL 101\nCEND\nBEGIN BULK\n", "Nastran"),
            (b"<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">", "VTK or XDMF"),
            (b"qoif\0\0\x01\0\0\0\x01\0\x04\0", "QOI"),
            (b"DDS \x7c\0\0\0", "DDS"),
            (&dicom, "DICOM"),
            (b"BYTEORDER      I\nLAYOUT         BIL\n", "header of a raw grid"),
            (b"north: 4480\nsouth: 4180\n", "text grid of GRASS"),
            (b"hello", ""),
        ];
        for (bytes, name) in files {
            assert_eq!(foreign(bytes).map_or("", |(name, _)| name), name);
        }
    }

    #[test]
    fn what_is_read_for_another_purpose_is_named_with_it() {
        let stl = b"solid a\nfacet normal 0 0 1\n";
        #[rustfmt::skip]
        let files: [(&[u8], Purpose, &str); 8] = [
            (stl, Purpose::Heights, "STL: it is a mesh: read it as one, by a name that ends in .stl"),
            (stl, Purpose::Photo, "STL: it is a mesh"),
            (b"\xff\xd8\xff\xe0", Purpose::Mesh, "JPEG: it is an image"),
            (b"\x93NUMPY\x01\0", Purpose::Photo, "it has heights, and is no photo"),
            (b"Dear Sir or Madam,", Purpose::Mesh, "meshes are read from OBJ, PLY, STL, glTF, GLB, 3MF, OFF and XYZ"),
            (b"*NODE\n1, 0, 0, 0\n", Purpose::Mesh, "let FreeCAD save its mesh as STL"),
            (&[7; 100], Purpose::Photo, "of unknown format"),
            (&[7; 100], Purpose::Heights, "gdal_translate"),
        ];
        for (bytes, purpose, words) in files {
            let told = refused(bytes, purpose).to_string();
            assert!(told.contains(words), "{told}");
        }
        assert_eq!(refused(b"", Purpose::Mesh).code(), "FORMAT");
    }
}
