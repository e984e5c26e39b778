//! Mesh files as other programs write them: small ones, with what is known of them.

use std::io::{Cursor, Write};

use developable::files::Unit;
use developable::files::images::{Format, decode, format_name};
use developable::files::meshes::{FileUnit, MeshFile, MeshFormat, read_mesh, read_mesh_beside};
use developable::{Resolution, View, sample};

fn read(text: &str) -> MeshFile {
    read_mesh_beside(text.as_bytes(), None, &[]).unwrap_or_else(|error| panic!("{error}: {text}"))
}

const SQUARE: &str = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const CORNERS: &str = "0 0 0\n9 0 0\n9 9 0\n0 9 0\n";

#[test]
fn ply_with_every_line_end_and_further_elements() {
    let header = format!(
        "ply \nformat  ascii 1.0\nobj_info made by hand\n{SQUARE}element edge 1\nproperty int \
         vertex1\nproperty int vertex2\nelement  face 1\nproperty list uint8 int32 \
         vertex_indices\nproperty uchar flags\ncomment late\nelement material 0\nproperty int \
         id\nend_header\n"
    );
    for end in ["\n", "\r\n", "\r"] {
        let text = format!("{header}{CORNERS}0 1\n4 0 1 2 3 7\n").replace('\n', end);
        // The signature may be in capitals, as trimesh and assimp read it, too.
        for text in [text.replacen("ply", "PLY", 1), text] {
            let mesh = read(&text).mesh;
            assert_eq!(mesh.positions().len(), 4, "{end:?}");
            assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
        }
    }
}

#[test]
fn ply_with_triangle_strips() {
    let text = format!(
        "ply\nformat ascii 1.0\n{SQUARE}element tristrips 1\nproperty list int int \
         vertex_indices\nend_header\n{CORNERS}8 0 1 3 2 -1 0 1 2\n"
    );
    assert_eq!(
        read(&text).mesh.triangles(),
        [[0, 1, 3], [3, 1, 2], [0, 1, 2]]
    );
}

#[test]
fn ply_with_texture_coordinates_at_corners() {
    let text = format!(
        "ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment TextureFile b \
         c.png\n{SQUARE}element face 2\nproperty list uchar int vertex_indices\nproperty list \
         uchar float texcoord\nproperty int texnumber\nend_header\n{CORNERS}3 0 1 2 6 0 0 1 0 1 \
         1 1\n3 0 2 3 6 0 0 1 1 0 0.5 0\n"
    );
    let files = [("a.png", &b"A"[..]), ("b c.png", b"B")];
    let file = read_mesh_beside(text.as_bytes(), None, &files).unwrap();
    let mesh = &file.mesh;
    // Corners with the same coordinates share their vertex.
    assert_eq!(mesh.positions().len(), 4);
    assert_eq!(mesh.uvs().unwrap()[3], [0.0, 0.5]);
    assert_eq!(mesh.textures().unwrap(), [1, 0]);
    assert_eq!(file.textures.len(), 2);
}

#[test]
fn obj_is_not_refused_for_its_looks() {
    let text = "mtllib none.mtl\nv 0 0 0 1 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nusemtl\nf 1 2 \\\n3 \
                4\nf -4/7/8 -3 -2 # comment\nl 1 2\n";
    let file = read(text);
    assert_eq!(file.mesh.triangles().len(), 3);
    assert_eq!(file.missing, ["none.mtl"]);
    assert_eq!(
        file.mesh.colors().unwrap()[..2],
        [[1.0, 0.0, 0.0], [1.0; 3]]
    );
    let wide: Vec<u8> = ("\u{feff}".to_owned() + text)
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    assert_eq!(read_mesh(&wide, None).unwrap(), file.mesh);
    let form = "v 0 0 0\nv 1 0 0\ncstype bezier\ndeg 1\ncurv 0 1 1 2\nend\n";
    let error = read_mesh(form.as_bytes(), None).unwrap_err();
    assert!(error.to_string().contains("free-form"), "{error}");
}

#[test]
fn off_with_colours_and_normals() {
    let faces = "4 0 1 2 3\n";
    let plain = format!("# by hand\n\nOFF\n# comment\n4 1 0\n\n{CORNERS}{faces}");
    assert_eq!(read(&plain).mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    let rows = "0 0 0  0 0 1  255 0 0 255\n9 0 0  0 0 1  0 255 0 255\n9 9 0  0 0 1  0 0 0 255\n";
    let colored = format!("CNOFF 3 1 0\n{rows}3 0 1 2 9 9 9\n");
    let colors = read(&colored).mesh.colors().unwrap()[0];
    assert_eq!(colors, [1.0, 0.0, 0.0]);
    // As MeshLab writes it: colours before normals.
    let rows = "0 0 0  0 255 0 255  0 0 1\n9 0 0  0 255 0 255  0 0 1\n9 9 0  0 255 0 255  0 0 1\n";
    let swapped = read(&format!("NCOFF\n3 1 0\n{rows}3 0 1 2\n"));
    assert_eq!(swapped.mesh.colors().unwrap()[2], [0.0, 1.0, 0.0]);
}

/// Colour of each triangle, which its three corners have.
fn face_colors(file: &MeshFile) -> Vec<[f32; 3]> {
    let colors = file.mesh.colors().unwrap();
    let of_face = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|corner| colors[corner as usize]);
        assert!(a == b && b == c, "{a:?} {b:?} {c:?}");
        a
    };
    file.mesh.triangles().iter().map(of_face).collect()
}

#[test]
fn faces_have_colours_of_their_own() {
    let [red, violet, white] = [[1.0, 0.0, 0.0], [0.2, 0.0, 1.0], [1.0; 3]];
    // Bytes with opacity, shares, and a number in a table of colours.
    for (first, second, colors) in [
        ("255 0 0 255", "51 0 255", [red, violet]),
        ("1.0 0 0", "0.2 0 1", [red, violet]),
        ("1.0 0 0", "7", [red, white]),
    ] {
        let off = format!("OFF\n4 2 0\n{CORNERS}3 0 1 2 {first}\n3 0 2 3 {second}\n");
        assert_eq!(face_colors(&read(&off)), colors, "{off}");
    }
    let same = format!("OFF\n4 2 0\n{CORNERS}3 0 1 2 9 0 0\n3 0 2 3 9 0 0\n");
    assert_eq!(read(&same).mesh.positions().len(), 4);
    // As MeshLab writes it.
    let colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let faces = "element face 2\nproperty list uchar int vertex_indices\n";
    let ply = |vertex: &str, rows: &str| {
        let head = format!("ply\nformat ascii 1.0\n{SQUARE}{vertex}{faces}{colors}end_header\n");
        read(&format!("{head}{rows}3 0 1 2 255 0 0\n3 0 2 3 51 0 255\n"))
    };
    assert_eq!(face_colors(&ply("", CORNERS)), [red, violet]);
    let rows = CORNERS.replace('\n', " 0 255 0\n");
    assert_eq!(face_colors(&ply(colors, &rows)), [[0.0, 1.0, 0.0]; 2]);
}

/// A binary STL file of triangles whose last two bytes are given.
fn stl(header: &[u8], attributes: &[u16]) -> Vec<u8> {
    let mut bytes = [header, &vec![0; 80 - header.len()]].concat();
    bytes.extend((attributes.len() as u32).to_le_bytes());
    for (row, attribute) in attributes.iter().enumerate() {
        let x = row as f32;
        for number in [0.0, 0.0, 1.0, x, 0.0, 0.0, x + 20.0, 0.0, 0.0, x, 20.0, 0.0] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(attribute.to_le_bytes());
    }
    bytes
}

#[test]
fn triangles_of_stl_have_the_colours_of_viscam_and_magics() {
    let colors = |header: &[u8], attributes: &[u16]| {
        let file = read_mesh_beside(&stl(header, attributes), None, &[]).unwrap();
        file.mesh.colors().is_some().then(|| face_colors(&file))
    };
    let (bit, five, ten) = (1 << 15, 31 << 5, 31 << 10);
    // Blue is lowest, and a triangle without the bit has no colour.
    let viscam = colors(b"made by hand", &[3, bit | 31, bit | ten, bit | five]);
    let expected = [[1.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(viscam, Some(expected.into()));
    // Red is lowest, and a triangle with the bit has the colour of the whole.
    let magics = colors(
        b"Magics COLOR=\xff\x33\0\xff,MATERIAL=",
        &[31, bit | 31, ten],
    );
    let expected = [[1.0, 0.0, 0.0], [1.0, 0.2, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(magics, Some(expected.into()));
    assert_eq!(colors(b"", &[0, 9]), None);
    // As MeshLab writes it: the bit is set although each has a colour.
    let meshlab = colors(b"COLOR=\x7f\x7f\x7f ", &[bit | 31, bit | five]);
    assert_eq!(meshlab, Some(vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]));
    let same = colors(b"COLOR=\xff\x33\0\xff", &[bit; 2]);
    assert_eq!(same, Some(vec![[1.0, 0.2, 0.0]; 2]));
    // By a program that has kept the header.
    assert_eq!(colors(b"COLOR=\xff\x33\0\xff", &[0, 0]), None);
}

#[test]
fn the_rest_of_an_stl_file_that_states_fewer_triangles_is_said() {
    let mut bytes = stl(b"", &[0; 5]);
    let told = |bytes: &[u8]| {
        let file = read_mesh_beside(bytes, Some(MeshFormat::Stl), &[]).unwrap();
        let told = file
            .assumptions
            .iter()
            .find(|one| one.code == "trailingBytes");
        (
            file.mesh.triangles().len(),
            told.map(|one| one.words.clone()),
        )
    };
    assert_eq!(told(&bytes), (5, None));
    bytes[80] = 2;
    let (triangles, words) = told(&bytes);
    assert_eq!(triangles, 2);
    assert!(words.unwrap().contains("the last 150 of its bytes"));
}

#[test]
fn letters_are_no_meshes() {
    let names = [
        "Ply is what wood comes in.\n",
        "OFF and on\n",
        "Solid advice:\nnone\n",
    ];
    for letter in names {
        let letter = letter.repeat(9);
        assert_eq!(MeshFormat::detect(letter.as_bytes()), None, "{letter}");
    }
}

#[test]
fn obj_colours_may_have_an_opacity() {
    let text = "v 0 0 0 1 0.5 0 0.25\nv 1 0 0 1 0.5 0 1\nv 0 1 0 1 0.5 0 1\nf 1 2 3\n";
    assert_eq!(face_colors(&read(text)), [[1.0, 0.5, 0.0]]);
}

#[test]
fn obj_colours_may_go_up_to_255() {
    let colors = |last: &str| {
        let text = format!("v 0 0 0 255 0 51\nv 1 0 0 0 0 0\nv 0 1 0 {last}\nf 1 2 3\n");
        read(&text).mesh.colors().unwrap().to_vec()
    };
    assert_eq!(colors("0 0 1")[0], [1.0, 0.0, 0.2]);
    // Some programs write them with decimals.
    assert_eq!(
        colors("0 0 127.5")[0..=2],
        [[1.0, 0.0, 0.2], [0.0; 3], [0.0, 0.0, 0.5]]
    );
    // Bright ones are no levels.
    let bright = read("v 0 0 0 1.5 0 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
    assert_eq!(bright.mesh.colors().unwrap()[0], [1.5, 0.0, 0.0]);
}

#[test]
fn ply_colours_of_every_type_are_shares_or_levels() {
    for (kind, half) in [
        ("uchar", "51"),
        ("ushort", "13107"),
        ("int", "51"),
        ("float", "0.2"),
        ("float", "51.0"),
        ("double", "51"),
    ] {
        let white = half.parse::<f64>().unwrap() * 5.0;
        let colors: String = ["red", "green", "blue"]
            .map(|name| format!("property {kind} {name}\n"))
            .concat();
        let faces = "element face 1\nproperty list uchar int vertex_indices\n";
        for (of_vertex, of_face) in [(&colors[..], ""), ("", &colors)] {
            let [vertex, face] = [of_vertex, of_face].map(|kinds| match kinds {
                "" => String::new(),
                _ => format!(" {half} 0 {white}"),
            });
            let rows = CORNERS.replace('\n', &format!("{vertex}\n"));
            let text = format!(
                "ply\nformat ascii 1.0\n{SQUARE}{of_vertex}{faces}{of_face}end_header\n{rows}4 0 1 2 3{face}\n"
            );
            assert_eq!(face_colors(&read(&text)), [[0.2, 0.0, 1.0]; 2], "{text}");
        }
    }
}

#[test]
fn a_file_that_is_much_longer_than_an_stl_file_says_is_none() {
    let mut bytes = vec![7; 84 + 2 * 50];
    bytes[80..84].copy_from_slice(&2u32.to_le_bytes());
    let code = |bytes: &[u8]| read_mesh(bytes, None).map_err(|error| error.code());
    bytes.extend([0; 10]);
    assert!(code(&bytes).is_ok());
    bytes.extend([0; 90]);
    assert_eq!(code(&bytes), Err("UNSUPPORTED"));
}

/// Area of each triangle of a mesh, below 0 where it faces downwards.
fn areas(file: &MeshFile) -> Vec<f64> {
    let area = |t: &[u32; 3]| {
        let [a, b, c] = file.mesh.corners(*t);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    };
    file.mesh.triangles().iter().map(area).collect()
}

#[test]
fn concave_polygons_have_triangles_that_do_not_overlap() {
    // The letter L from one of its tips, on a slope; and a plate with a hole, to which a slit leads.
    let letter = "0 5 5\n0 0 0\n4 0 4\n4 2 6\n2 2 4\n2 5 7\n";
    let plate = "0 0 0\n10 0 0\n10 10 0\n0 10 0\n4 4 0\n4 6 0\n6 6 0\n6 4 0\n";
    for (points, face, area) in [
        (letter, "2 3 4 5 0 1", 14.0),
        (plate, "0 1 2 3 0 4 5 6 7 4", 96.0),
    ] {
        let (count, corners) = (points.lines().count(), face.split(' ').count());
        let off = read(&format!("OFF {count} 1 0\n{points}{corners} {face}\n"));
        let header = SQUARE.replace('4', &count.to_string());
        let ply = read(&format!(
            "ply\nformat ascii 1.0\n{header}element face 1\nproperty list uchar int vertex_indices\nend_header\n\
             {points}{corners} {face}\n"
        ));
        let from_one: Vec<String> = (face.split(' '))
            .map(|v| (v.parse::<u32>().unwrap() + 1).to_string())
            .collect();
        let vertices: String = points.lines().map(|line| format!("v {line}\n")).collect();
        let obj = read(&format!("{vertices}f {}\n", from_one.join(" ")));
        for file in [off, ply, obj] {
            let areas = areas(&file);
            assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
            assert!(
                (areas.iter().sum::<f64>() - area).abs() < 1e-12,
                "{areas:?}"
            );
            assert!(file.assumptions.iter().all(|one| one.code != "polygons"));
        }
    }
    // Convex polygons stay fans, bent ones too; sides that cross are told.
    let bent = read("OFF 4 1 0\n0 0 0\n4 0 1\n4 4 0\n0 4 1\n4 0 1 2 3\n");
    assert_eq!(bent.mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    let crossed = read("OFF 4 1 0\n0 0 0\n4 0 0\n1 4 0\n4 4 0\n4 0 1 2 3\n");
    assert_eq!(crossed.mesh.triangles().len(), 2);
    assert_eq!(crossed.assumptions[0].code, "polygons");
}

/// A glTF file of one triangle with 8-bit positions, whose second corner stands apart (sparse).
const SPARSE: &str = r#"{"asset":{"version":"2.0"},
"extensionsRequired":["KHR_materials_unlit","KHR_mesh_quantization"],
"nodes":[{"mesh":0,"rotation":[0,0,1,0],"translation":[0,0,5]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"_FEATURE_ID_0":1}}]}],
"accessors":[{"bufferView":0,"componentType":5120,"count":3,"type":"VEC3","sparse":{"count":1,
"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":1,"byteOffset":1}}},
{"componentType":5126,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":12,"byteStride":4},{"buffer":0,"byteOffset":12,"byteLength":4}],
"buffers":[{"byteLength":16,"uri":"data:;base64,AAAAAAEAAAAAAgAAAQMAAA=="}]}"#;

#[test]
fn gltf_is_not_refused_for_its_looks() {
    let file = read(SPARSE);
    // Half a turn about z, then 5 up.
    let expected = [[0.0, 0.0, 5.0], [-3.0, 0.0, 5.0], [0.0, -2.0, 5.0]];
    let positions = file.mesh.positions().as_flattened();
    for (found, wanted) in positions.iter().zip(expected.as_flattened()) {
        assert!((found - wanted).abs() < 1e-12, "{positions:?}");
    }
    assert_eq!(file.unit, Some(Unit::Metre));
    assert!(file.assumptions.is_empty());
}

#[test]
fn units_by_what_the_file_says_or_by_its_size() {
    let square = |side: f64| read(&format!("v 0 0 0\nv {side} 0 0\nv 0 {side} 0\nf 1 2 3\n"));
    for (side, unit, word) in [
        (60.0, Some(Unit::Millimetre), "lengths are millimetres"),
        // An inch or a metre: nothing in a file of a few units says which.
        (
            2.0,
            None,
            "too short for millimetres, and may be inches or metres",
        ),
        (0.06, None, "too short for millimetres"),
        (1.2e4, None, "no unit"),
    ] {
        let file = square(side);
        assert_eq!(file.unit, unit, "{side}");
        assert!(file.assumptions[0].words.contains(word), "{side}");
        assert_eq!(file.assumptions[0].option, Some("unit"));
    }
    // A house of twelve metres in UTM, in millimetres nearby.
    let house = "v 432123.4 5412345.6 251.2\nv 432135.4 5412345.6 251.2\nv 432123.4 5412353.6 254.2\nf 1 2 3\n";
    let (on_map, nearby) = (
        read(house),
        read(&house.replace("432", "").replace("5412", "")),
    );
    assert_eq!(on_map.unit, Some(Unit::Metre));
    assert!(
        on_map.assumptions[0]
            .words
            .contains("5412346 are those of a map")
    );
    assert_eq!(nearby.unit, Some(Unit::Millimetre));
    let inches = square(2.5).in_unit(FileUnit::new("inch").unwrap()).unwrap();
    assert_eq!(inches.unit, Some(Unit::Millimetre));
    assert_eq!(inches.mesh.positions()[1], [63.5, 0.0, 0.0]);
    assert!(inches.assumptions.is_empty());
}

#[test]
fn half_of_a_folded_sheet_is_hidden() {
    let text = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 0 0 5\nv 10 0 5\nv 10 10 5\nv 0 10 \
                5\nf 1 2 3 4\nf 5 6 7 8\n";
    let mesh = read(text).mesh;
    let down = View::Along([0.0, 0.0, -1.0]);
    let samples = sample(&mesh, down, Resolution::Across(40)).unwrap();
    assert!((samples.hidden_share(&mesh) - 0.5).abs() < 1e-12);
}

/// A 3MF archive as slicers write it: content types, relations, and the model, compressed.
fn archive(model: &str) -> Vec<u8> {
    let mut file = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let compressed = zip::write::SimpleFileOptions::default();
    for (name, text) in [
        ("[Content_Types].xml", "<Types/>"),
        ("_rels/.rels", "<Relationships/>"),
        ("Metadata/thumbnail.png", "no picture"),
        ("3D/3dmodel.model", model),
    ] {
        file.start_file(name, compressed).unwrap();
        file.write_all(text.as_bytes()).unwrap();
    }
    file.finish().unwrap().into_inner()
}

/// A model in inches: a triangle, and an object that uses it twice, moved and turned a quarter about z.
const MODEL: &str = r##"<?xml version="1.0" encoding="UTF-8"?>
<model unit="inch" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
 xmlns:m="http://schemas.microsoft.com/3dmanufacturing/material/2015/02">
 <metadata name="Application">a slicer</metadata>
 <resources>
  <m:colorgroup id="9"><m:color color="#FF0000FF"/></m:colorgroup>
  <object id="1" type="model" pid="9" pindex="0"><mesh>
   <vertices><vertex x="0" y="0" z="0"/><vertex x="2" y="0" z="0"/><vertex x="0" y="1" z="0.5"/></vertices>
   <triangles><triangle v1="0" v2="1" v3="2" p1="0"/></triangles>
  </mesh></object>
  <object id="2" type="model"><components>
   <component objectid="1" transform="1 0 0 0 1 0 0 0 1 10 0 0"/>
   <component objectid="1" transform="0 1 0 -1 0 0 0 0 1 0 0 3"/>
  </components></object>
 </resources>
 <build><item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 100 0"/></build>
</model>"##;

#[test]
fn three_mf_with_its_unit_and_components() {
    let file = read_mesh_beside(&archive(MODEL), None, &[]).unwrap();
    assert_eq!(file.unit, Some(Unit::Millimetre));
    assert!(file.assumptions.is_empty(), "{:?}", file.assumptions);
    assert_eq!(file.mesh.triangles(), [[0, 1, 2], [3, 4, 5]]);
    assert_eq!(face_colors(&file), [[1.0, 0.0, 0.0]; 2]);
    let inches = [
        [10.0, 100.0, 0.0],
        [12.0, 100.0, 0.0],
        [10.0, 101.0, 0.5],
        [0.0, 100.0, 3.0],
        [0.0, 102.0, 3.0],
        [-1.0, 100.0, 3.5],
    ];
    let found = file.mesh.positions().as_flattened();
    for (found, inches) in found.iter().zip(inches.as_flattened()) {
        assert!((found - 25.4 * inches).abs() < 1e-9, "{found} {inches}");
    }
    // Without a unit lengths are millimetres, and a further model that the archive lacks is missed.
    let plain = MODEL.replace(" unit=\"inch\"", "");
    let file = read_mesh_beside(&archive(&plain), None, &[]).unwrap();
    assert_eq!(
        (file.unit, file.mesh.positions()[1]),
        (Some(Unit::Millimetre), [12.0, 100.0, 0.0])
    );
    let several = MODEL.replace(
        "<component objectid",
        "<component p:path=\"/3D/a.model\" objectid",
    );
    let several = several.replace("xml:lang", "xmlns:p=\"http://p\" xml:lang");
    let error = read_mesh_beside(&archive(&several), None, &[]).unwrap_err();
    assert!(error.to_string().contains("is not there"), "{error}");
    let missing = MODEL.replace("objectid=\"1\"", "objectid=\"7\"");
    assert!(read_mesh_beside(&archive(&missing), None, &[]).is_err());
}

#[test]
fn three_mf_with_colours_of_materials_and_corners() {
    let model = |attributes: &str, rows: &str| {
        let text = format!(
            r##"<model unit="millimeter"><resources>
<basematerials id="1"><base name="a" displaycolor="#FF0000"/><base name="b" displaycolor="#0033ffff"/></basematerials>
<colorgroup id="2"><color color="#00FF00"/><color color="#000000"/><color color="#FFFFFF"/></colorgroup>
<object id="3" {attributes}><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="9" y="0" z="0"/><vertex x="9" y="9" z="0"/>
<vertex x="0" y="9" z="0"/></vertices><triangles>{rows}</triangles></mesh></object>
</resources><build><item objectid="3"/></build></model>"##
        );
        read_mesh_beside(&archive(&text), None, &[]).unwrap()
    };
    let [red, blue, white] = [[1.0, 0.0, 0.0], [0.0, 0.2, 1.0], [1.0; 3]];
    let [first, second] = [r#"v1="0" v2="1" v3="2""#, r#"v1="0" v2="2" v3="3""#];
    for (attributes, own, colors) in [
        (r#"pid="1" pindex="1""#, "", [blue, blue]),
        (r#"pid="1" pindex="1""#, r#"p1="0""#, [blue, red]),
        ("", r#"pid="1" p1="0""#, [white, red]),
    ] {
        let file = model(
            attributes,
            &format!("<triangle {first}/><triangle {second} {own}/>"),
        );
        assert_eq!(face_colors(&file), colors, "{attributes} {own}");
    }
    let rows = format!(
        r#"<triangle {first} pid="2" p1="0" p2="1" p3="2"/><triangle {second} pid="2" p1="0" p2="2" p3="9"/>"#
    );
    let file = model("", &rows);
    let corners =
        |t: usize| file.mesh.triangles()[t].map(|v| file.mesh.colors().unwrap()[v as usize]);
    // A corner whose colour is not there leaves its triangle without one.
    assert_eq!(
        (corners(0), corners(1)),
        ([[0.0, 1.0, 0.0], [0.0; 3], white], [white; 3])
    );
    let plain = model("", &format!("<triangle {first}/><triangle {second}/>"));
    assert_eq!(
        (plain.mesh.colors(), plain.mesh.positions().len()),
        (None, 4)
    );
}

/// A glTF file of a square, whose picture is used by a quarter, turned: the example of the specification of
/// `KHR_texture_transform`, "the lower left quadrant of the source image, rotated clockwise 90°".
const TURNED: &str = r#"{"asset":{"version":"2.0"},"extensionsUsed":["KHR_texture_transform"],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":
{"offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5]}}}}}],
"textures":[{"source":0}],"images":[{"uri":"a.png"}],
"accessors":[{"bufferView":0,"componentType":5121,"count":3,"type":"VEC3"},
{"bufferView":0,"componentType":5121,"count":3,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":12,"byteStride":4}],
"buffers":[{"byteLength":12,"uri":"data:;base64,AAAAAAEAAAAAAQAA"}]}"#;

#[test]
fn gltf_turns_texture_coordinates_as_the_specification_says() {
    let file = read_mesh_beside(TURNED.as_bytes(), None, &[("a.png", b"A")]).unwrap();
    // The corners (0, 0), (1, 0), (0, 1) lie at the lower left, the left and the bottom of the picture; upwards from its lower
    // edge, as meshes here count.
    let expected = [[0.0, 0.0], [0.0, 0.5], [0.5, 0.0]];
    let found = file.mesh.uvs().unwrap().as_flattened();
    for (found, expected) in found.iter().zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
}

#[test]
fn what_a_mesh_file_lacks_is_said() {
    let flat = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n";
    let error = read_mesh(flat.as_bytes(), None).unwrap_err();
    assert_eq!(error.code(), "UNSUPPORTED");
    assert!(error.to_string().contains("no property `z`"), "{error}");
    let edges = format!(
        "ply\nformat ascii 1.0\n{SQUARE}element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n{CORNERS}0 1\n"
    );
    for (text, is_said) in [
        ("v 0 0 0\nv 90 0 0\nl 1 2\n", true),
        (&edges, true),
        ("v 0 0 0\nv 90 0 0\n", false),
        ("v 0 0 0\nv 90 0 0\nv 0 90 0\nl 1 2\nf 1 2 3\n", false),
    ] {
        let file = read(text);
        let told = file.assumptions.iter().any(|one| one.code == "points");
        assert_eq!(told, is_said, "{text}");
    }
}

#[test]
fn points_in_text_are_a_cloud_unless_they_lie_on_a_grid() {
    // As CloudCompare writes them, with colours or with intensities.
    let scattered = |more: &str| -> String {
        let line = |i: u32| {
            let [x, y] =
                [f64::from(i * 37 % 101), f64::from(i * i % 97)].map(|v| 1.003 * v + 0.1 * v.sin());
            format!("{x:.4} {y:.4} {:.4}{more}\n", 40.0 + 0.1 * x)
        };
        (0..80).map(line).collect()
    };
    let coloured = read(&format!("//X Y Z R G B\n{}", scattered(" 255 128 0"))).mesh;
    assert!(coloured.is_cloud() && coloured.positions().len() == 80);
    assert_eq!(coloured.colors().unwrap()[7], [1.0, 128.0 / 255.0, 0.0]);
    // As scanners write them, after a line with their number.
    let counted = read(&format!("80\n{}", scattered(" -1042 255 128 0"))).mesh;
    assert_eq!(counted.colors(), coloured.colors());
    let plain = scattered(" 0.5");
    assert!(read(&plain).mesh.colors().is_none());
    let error = decode(plain.as_bytes(), None).unwrap_err().to_string();
    assert!(
        error.contains("point cloud") && error.contains(".xyz"),
        "{error}"
    );
    assert_eq!(
        decode(plain.as_bytes(), Some(Format::Text)).unwrap().width,
        4
    );
    let grid: String = (0..80)
        .map(|i| format!("{} {} {}\n", i % 8, i / 8, i * i % 7))
        .collect();
    assert_eq!(format_name(grid.as_bytes()), Some("text"));
}

/// A triangle of 16-bit integers that are shares of 1, with colours of 8 bits and texture coordinates of 16.
const NORMALIZED: &str = r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"buffers":[{"byteLength":48,"uri":"a.bin"}],
"extensionsRequired":["KHR_mesh_quantization"],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1,"TEXCOORD_0":2}}]}],
"bufferViews":[{"buffer":0,"byteLength":24,"byteStride":8},{"buffer":0,"byteOffset":24,"byteLength":12},{"buffer":0,"byteOffset":36,"byteLength":12}],
"accessors":[{"bufferView":0,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"},
{"bufferView":2,"componentType":5123,"normalized":true,"count":3,"type":"VEC2"}]}"#;

#[test]
fn integers_of_gltf_are_shares_where_it_says_so() {
    let places: [i16; 12] = [32_767, 0, 0, 0, -32_768, 32_767, 0, 0, 0, -16_384, 0, 0];
    let colors = [255_u8, 51, 0, 255, 0, 102, 255, 255, 153, 0, 0, 255];
    let uvs: [u16; 6] = [0, 65_535, 13_107, 65_535, 65_535, 52_428];
    let mut bytes: Vec<u8> = places.iter().flat_map(|v| v.to_le_bytes()).collect();
    bytes.extend(colors);
    bytes.extend(uvs.iter().flat_map(|v| v.to_le_bytes()));
    let read = |text: &str| {
        read_mesh_beside(text.as_bytes(), None, &[("a.bin", &bytes)])
            .unwrap()
            .mesh
    };
    // By the specification, "Animations": a signed integer c of 16 bits is max(c / 32767, -1), an unsigned one c / 65535.
    let mesh = read(NORMALIZED);
    assert_eq!(
        mesh.positions(),
        [
            [1.0, 0.0, 0.0],
            [-1.0, 1.0, 0.0],
            [0.0, -16_384.0 / 32_767.0, 0.0]
        ]
    );
    assert_eq!(
        mesh.colors().unwrap(),
        [[1.0, 0.2, 0.0], [0.0, 0.4, 1.0], [0.6, 0.0, 0.0]]
    );
    for (found, expected) in mesh
        .uvs()
        .unwrap()
        .as_flattened()
        .iter()
        .zip([0.0, 0.0, 0.2, 0.0, 1.0, 0.2])
    {
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
    let plain = read(&NORMALIZED.replacen(r#""normalized":true,"#, "", 1));
    assert_eq!(plain.positions()[1], [-32_768.0, 32_767.0, 0.0]);
    // Of 8 bits: the bytes ff 7f 00, 00 80 and so on.
    let small = read(&NORMALIZED.replacen("5122", "5120", 1));
    assert_eq!(
        small.positions(),
        [
            [-1.0 / 127.0, 1.0, 0.0],
            [0.0, -1.0, -1.0 / 127.0],
            [0.0, 0.0, 0.0]
        ]
    );
}
