//! Meshes from files: those of other programs, and damage.

use std::io::Write;
use std::path::PathBuf;

use developable::files::meshes::{MeshFormat, read_mesh};
use developable::{Error, Mesh};

use crate::native::common::Random;

const FILES: [&str; 15] = [
    "ascii.stl",
    "binary.stl",
    "colours.obj",
    "embedded.gltf",
    "fan.glb",
    "numpy-ascii.stl",
    "numpy-binary.stl",
    "polygons-ascii.ply",
    "polygons-be.ply",
    "polygons-le.ply",
    "strip.glb",
    "trimesh-ascii.ply",
    "trimesh-binary.ply",
    "turned.glb",
    "points.ply",
];

fn file(name: &str) -> Vec<u8> {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "tests", "data", "meshes", name]
        .iter()
        .collect();
    std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn read(name: &str) -> Mesh {
    read_mesh(&file(name), None).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// What `tests/data/meshes/make.py` starts from.
const POSITIONS: [[f64; 3]; 5] = [
    [0.0, 0.5, 0.25],
    [3.0, 0.0, 0.5],
    [3.5, 2.0, 1.0],
    [-0.5, 2.25, 1.5],
    [1.0, 3.0, 0.125],
];
const TRIANGLES: [[usize; 3]; 3] = [[0, 1, 2], [0, 2, 3], [3, 2, 4]];
const COLORS: [[u8; 3]; 5] = [
    [255, 0, 51],
    [0, 102, 0],
    [0, 0, 255],
    [153, 153, 0],
    [10, 20, 30],
];

/// The transform of the files' nodes.
fn turned([x, y, z]: [f64; 3]) -> [f64; 3] {
    [10.0 - 2.0 * y, 20.0 + 2.0 * x, 30.0 + 2.0 * z]
}

/// Triangles as corners, to the last thousandth, whatever their order and that of their corners.
fn soup(triangles: impl Iterator<Item = [[f64; 3]; 3]>) -> Vec<[[i64; 3]; 3]> {
    let mut soup: Vec<_> = triangles
        .map(|t| {
            let mut corners = t.map(|p| p.map(|v| (v * 1000.0).round() as i64));
            corners.sort();
            corners
        })
        .collect();
    soup.sort();
    soup
}

fn expected(triangles: &[[usize; 3]], place: fn([f64; 3]) -> [f64; 3]) -> Vec<[[i64; 3]; 3]> {
    soup(triangles.iter().map(|t| t.map(|i| place(POSITIONS[i]))))
}

fn found(mesh: &Mesh) -> Vec<[[i64; 3]; 3]> {
    soup(
        mesh.triangles()
            .iter()
            .map(|t| t.map(|i| mesh.positions()[i as usize])),
    )
}

/// The number in make.py's lists of the vertex that lies there.
fn number(position: [f64; 3], place: fn([f64; 3]) -> [f64; 3]) -> usize {
    let near = |p: [f64; 3]| (0..3).all(|k| (p[k] - position[k]).abs() < 1e-3);
    POSITIONS.into_iter().position(|p| near(place(p))).unwrap()
}

#[test]
fn meshes_of_other_programs() {
    for name in FILES
        .iter()
        .filter(|n| !n.ends_with("glb") && **n != "points.ply")
    {
        let mesh = read(name);
        let place = if *name == "embedded.gltf" {
            turned
        } else {
            |p| p
        };
        assert_eq!(found(&mesh), expected(&TRIANGLES, place), "{name}");
    }
    assert_eq!(found(&read("turned.glb")), expected(&TRIANGLES, turned));
    assert_eq!(found(&read("strip.glb")), expected(&TRIANGLES, turned));
    assert_eq!(
        found(&read("fan.glb")),
        expected(&[[2, 3, 0], [2, 0, 1]], turned)
    );
}

#[test]
fn colours_and_texture_coordinates() {
    for name in [
        "colours.obj",
        "polygons-ascii.ply",
        "polygons-be.ply",
        "trimesh-binary.ply",
    ] {
        let mesh = read(name);
        let colors = mesh
            .colors()
            .unwrap_or_else(|| panic!("{name} has no colours"));
        for (position, color) in mesh.positions().iter().zip(colors) {
            let expected = COLORS[number(*position, |p| p)];
            for (found, expected) in color.iter().zip(expected) {
                assert!((found - f32::from(expected) / 255.0).abs() < 1e-6, "{name}");
            }
        }
    }
    assert!(read("turned.glb").colors().is_some());
    for name in ["strip.glb", "fan.glb", "embedded.gltf"] {
        let mesh = read(name);
        for (position, uv) in mesh.positions().iter().zip(mesh.uvs().unwrap()) {
            let [x, y, _] = POSITIONS[number(*position, turned)];
            // The files count from the top.
            assert_eq!(
                uv.map(f64::from),
                [x / 4.0 + 0.25, 0.75 - y / 4.0],
                "{name}"
            );
        }
    }
    assert!(read("binary.stl").colors().is_none());
}

#[test]
fn obj_in_all_its_shapes() {
    let text = "# Andr\u{e9}\nv 0 0 0\nv 1 0 0\nv 1 1 5.000000000001\nv 0 1 0\n\
                vt 0 0\nvn 0 0 1\no one\nf 1/1/1 2/1/1 -2/1/1 -1/1/1\ng two\n\
                usemtl none\nf 1//1 2//1 3//1\nl 1 2\np 1\n";
    // Names in Latin-1 are no damage.
    let latin: Vec<u8> = text.chars().map(|c| c as u8).collect();
    for bytes in [text.as_bytes(), &latin] {
        let mesh = read_mesh(bytes, None).unwrap();
        assert_eq!(mesh.triangles().len(), 3);
        assert!(mesh.positions().iter().any(|p| p[2] == 5.000000000001));
        assert!(mesh.uvs().is_none(), "only some vertices have them");
    }
    for bad in [
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 6148914691236517206\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9223372036854775808\n",
        "v 0 0\nf 1 1 1\n",
    ] {
        assert_eq!(
            read_mesh(bad.as_bytes(), None).unwrap_err().code(),
            "FORMAT",
            "{bad}"
        );
    }
    let code = |text: &str| read_mesh(text.as_bytes(), None).unwrap_err().code();
    assert_eq!(code("v 0 nan 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "NOT_FINITE");
    assert_eq!(
        code("v 0 1e999 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        "NOT_FINITE"
    );
}

#[test]
fn solids_that_follow_one_another() {
    let twice = [
        file("numpy-ascii.stl"),
        file("ascii.stl").trim_ascii_start().to_vec(),
    ]
    .concat();
    let mesh = read_mesh(&twice, None).unwrap();
    assert_eq!(mesh.triangles().len(), 6);
    assert_eq!(found(&mesh)[0], found(&mesh)[1]);
}

#[test]
fn what_is_not_read_is_said() {
    let error = |bytes: &[u8], format| read_mesh(bytes, format).unwrap_err();
    let draco = error(&file("draco.glb"), None);
    assert_eq!(draco.code(), "UNSUPPORTED");
    assert!(
        draco.to_string().contains("KHR_draco_mesh_compression"),
        "{draco}"
    );
    assert_eq!(error(b"", None).code(), "FORMAT");
    assert_eq!(error(b"hello", None).code(), "UNSUPPORTED");
    for format in [
        MeshFormat::Obj,
        MeshFormat::Ply,
        MeshFormat::Stl,
        MeshFormat::Gltf,
        MeshFormat::ThreeMf,
        MeshFormat::Off,
    ] {
        let error = error(b"hello", Some(format));
        assert!(
            matches!(error, Error::Format { .. } | Error::Unsupported { .. }),
            "{error}"
        );
        assert_eq!(format.name().parse(), Ok(format));
    }
    assert_eq!("fbx".parse::<MeshFormat>().unwrap_err().code(), "OPTION");
    let external = String::from_utf8(file("embedded.gltf")).unwrap();
    let external = external.replace("data:application/octet-stream;base64,", "a.bin?");
    assert_eq!(error(external.as_bytes(), None).code(), "UNSUPPORTED");
}

/// A 3MF archive of the given files.
fn archive(files: &[(&str, &str)]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, text) in files {
        zip.start_file(*name, zip::write::SimpleFileOptions::default())
            .unwrap();
        zip.write_all(text.as_bytes()).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

/// A file of a slicer that keeps each object in a model of its own, and supports beside what is printed.
#[test]
fn objects_of_3mf_may_lie_in_further_models() {
    let triangle = |side: f64| {
        format!(
            "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"{side}\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"{side}\" \
             z=\"0\"/></vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh>"
        )
    };
    let model = |content: String| {
        format!(
            "<model unit=\"millimeter\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" \
             xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\">{content}</model>"
        )
    };
    let main = model(format!(
        "<resources><object id=\"1\"><components><component p:path=\"/3D/a.model\" objectid=\"1\" \
         transform=\"1 0 0 0 1 0 0 0 1 10 0 0\"/></components></object><object id=\"2\" type=\"support\">{}</object></resources>\
         <build><item objectid=\"1\"/><item objectid=\"2\"/></build>",
        triangle(99.0)
    ));
    let part = model(format!(
        "<resources><object id=\"1\">{}</object></resources><build/>",
        triangle(5.0)
    ));
    let relations = "<Relationships><Relationship Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" \
                     Target=\"/3D/3dmodel.model\"/></Relationships>";
    let bytes = archive(&[
        ("3D/a.model", &part),
        ("_rels/.rels", relations),
        ("3D/3dmodel.model", &main),
    ]);
    let mesh = read_mesh(&bytes, None).unwrap();
    assert_eq!(mesh.triangles().len(), 1);
    assert_eq!(mesh.positions()[1], [15.0, 0.0, 0.0]);
}

#[test]
fn stl_files_may_be_cut_short_or_go_on() {
    let whole = file("binary.stl");
    let mut longer = whole.clone();
    longer.extend([7; 33]);
    assert_eq!(
        read_mesh(&longer, None).unwrap(),
        read_mesh(&whole, None).unwrap()
    );
    // Programs begin the header of binary files as those of text begin.
    longer[..11].copy_from_slice(b"solid a.stl");
    assert_eq!(
        read_mesh(&longer, None).unwrap(),
        read_mesh(&whole, None).unwrap()
    );
    let error = read_mesh(&whole[..whole.len() - 40], None).unwrap_err();
    assert!(error.to_string().contains("too short"), "{error}");
}

/// A result, or a short message.
fn survives(bytes: &[u8], format: Option<MeshFormat>) -> bool {
    let result = read_mesh(bytes, format);
    if let Err(error) = &result {
        let message = error.to_string();
        assert!(message.len() < 1000 && !message.contains('\n'), "{message}");
        assert!(
            ["FORMAT", "UNSUPPORTED", "NOT_FINITE", "TOO_LARGE"].contains(&error.code()),
            "{error:?}"
        );
    }
    result.is_ok()
}

fn format_of(name: &str) -> MeshFormat {
    name.rsplit('.').next().unwrap().parse().unwrap()
}

#[test]
fn files_cut_short_at_every_length() {
    for name in FILES {
        let whole = file(name);
        for length in 0..whole.len() {
            survives(&whole[..length], None);
            let read = survives(&whole[..length], Some(format_of(name)));
            // Text cut in its last numbers is a file all the same.
            let binary = name.ends_with("glb") || name.contains("binary") || name.contains("-le");
            assert!(
                !(read && binary && length + 4 < whole.len()),
                "{name} cut to {length}"
            );
        }
    }
}

#[test]
fn files_with_bytes_that_are_wrong() {
    let mut random = Random::new(7);
    let mut random = || random.bits(31);
    for name in FILES.iter().chain(&["draco.glb"]) {
        let whole = file(name);
        for i in 0..4000 {
            let mut bytes = whole.clone();
            for _ in 0..=i % 4 {
                let at = random() as usize % bytes.len();
                bytes[at] = match random() % 4 {
                    0 => 255,
                    1 => 0,
                    2 => b'0' + (random() % 10) as u8,
                    _ => bytes[at] ^ (1 << (random() % 8)),
                };
            }
            survives(&bytes, None);
            survives(&bytes, Some(format_of(name)));
        }
    }
}

#[test]
fn counts_that_no_file_could_hold() {
    let ply = |format: &str, elements: &str| {
        format!("ply\nformat {format} 1.0\n{elements}end_header\n0 0 0\n")
    };
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        for elements in [
            "element vertex 4294967295\nproperty float x\n",
            "element vertex 18446744073709551615\nproperty float x\n",
            "element vertex 99999999999999999999999\nproperty float x\n",
            "element nothing 4000000000\n",
            "element face 1\nproperty list uint int vertex_indices\n",
            "element face 2\nproperty list double int vertex_indices\n",
        ] {
            assert!(
                !survives(ply(format, elements).as_bytes(), None),
                "{elements}"
            );
        }
    }
    // A list of almost 2³² entries, of which none is there.
    let mut list = b"ply\nformat binary_little_endian 1.0\nelement face 1\n\
                     property list uint int vertex_indices\nend_header\n"
        .to_vec();
    list.extend([0xfe, 0xff, 0xff, 0xff]);
    assert!(!survives(&list, None));

    let mut stl = file("binary.stl");
    stl[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(!survives(&stl, Some(MeshFormat::Stl)));
    let mut nan = file("binary.stl");
    nan[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(read_mesh(&nan, None).unwrap_err().code(), "NOT_FINITE");
    let zero = [&[0; 80][..], &[0; 4]].concat();
    assert_eq!(
        read_mesh(&zero, Some(MeshFormat::Stl)).unwrap_err().code(),
        "UNSUPPORTED"
    );
}

/// The JSON of `embedded.gltf` with something else in it.
fn altered(from: &str, to: &str) -> Vec<u8> {
    let compact: String = String::from_utf8(file("embedded.gltf"))
        .unwrap()
        .split_whitespace()
        .collect();
    assert!(compact.contains(from), "{from} in {compact}");
    compact.replacen(from, to, 1).into_bytes()
}

#[test]
fn scenes_that_make_no_sense() {
    assert!(survives(&altered("\"count\":5", "\"count\":5"), None));
    for (from, to) in [
        ("\"count\":5", "\"count\":4294967295"),
        ("\"count\":5", "\"count\":0"),
        ("\"count\":9", "\"count\":10"),
        ("\"byteStride\":20", "\"byteStride\":4"),
        ("\"byteStride\":20", "\"byteStride\":252"),
        ("\"byteOffset\":12", "\"byteOffset\":18446744073709551600"),
        ("\"indices\":2", "\"indices\":7"),
        ("\"indices\":2", "\"indices\":0"),
        ("\"children\":[1]", "\"children\":[0]"),
        ("\"children\":[1]", "\"children\":[1,1]"),
        ("\"children\":[1]", "\"children\":[9]"),
        ("\"POSITION\":0", "\"POSITION\":3"),
        ("\"TEXCOORD_0\":1", "\"TEXCOORD_0\":3"),
        ("\"mode\":4", "\"mode\":9"),
        ("\"scene\":0", "\"scene\":3"),
        ("\"scale\":[2", "\"scale\":[1e309"),
        ("base64,", "base64,*"),
    ] {
        assert!(!survives(&altered(from, to), None), "{to}");
    }
    // Deeply nested text.
    survives("[".repeat(1 << 20).as_bytes(), Some(MeshFormat::Gltf));
    survives("{\"a\":".repeat(1 << 18).as_bytes(), None);
}
