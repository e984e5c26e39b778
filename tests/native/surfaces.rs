//! Surfaces as files of meshes, taken apart by hand: every number against the lattice's definition.

use developable::files::meshes::{read_mesh, write_glb, write_ply, write_stl};
use developable::files::wavefront::write_obj;
use developable::{Frame, Heightfield, Lattice, Mesh, Result, Triangulation};
use serde_json::Value;

const SPACING: f64 = 0.3;
const ROWS: usize = 4;
const COLS: usize = 5;
/// The vertices without heights: a corner.
const MISSING: usize = 4;

/// Where lattice vertex `i` lies in the plane, from the definition.
fn plane(i: usize) -> [f64; 2] {
    let (row, col) = (i / COLS, i % COLS);
    let shift = if row % 2 == 1 { 0.5 } else { 0.0 };
    [
        1.0 + SPACING * (col as f64 - shift),
        2.0 - SPACING * row as f64 * 0.75f64.sqrt(),
    ]
}

/// No flip or turn leaves it as it is.
fn height([x, y]: [f64; 2]) -> f64 {
    0.5 * x + 2.0 * y
}

fn lattice() -> Lattice {
    let lattice = Lattice::new(ROWS, COLS, SPACING).unwrap();
    lattice.with_origin([1.0, 2.0]).unwrap()
}

fn surface() -> Heightfield {
    let heights = (0..ROWS * COLS)
        .map(|i| {
            if i == MISSING {
                f64::NAN
            } else {
                height(plane(i))
            }
        })
        .collect();
    Heightfield::new(lattice(), heights).unwrap()
}

fn colors() -> Vec<[f32; 3]> {
    let share = |i: usize, k: usize| ((37 * i + 91 * k) % 256) as f32 / 255.0;
    (0..ROWS * COLS)
        .map(|i| [share(i, 0), share(i, 1), share(i, 2)])
        .collect()
}

fn uvs() -> Vec<[f32; 2]> {
    let at = |i: usize| [(i % COLS) as f32 / 8.0, (i / COLS) as f32 / 4.0];
    (0..ROWS * COLS).map(at).collect()
}

/// Looking along -y: the image's x, y, z are the mesh's x, -z, y.
fn frame() -> Frame {
    Frame::looking_along([0.0, -1.0, 0.0]).unwrap()
}

fn place([x, y, z]: [f64; 3]) -> [f64; 3] {
    [x, z, -y]
}

fn mesh() -> Mesh {
    Triangulation::new(&surface(), &frame())
        .and_then(|t| t.with_colors(&colors()))
        .and_then(|t| t.with_uvs(&uvs()))
        .unwrap()
        .into_mesh()
}

/// Lattice vertices in the order of the mesh's.
fn used() -> impl Iterator<Item = usize> {
    (0..ROWS * COLS).filter(|i| *i != MISSING)
}

/// Position of each vertex of the mesh, from the definition.
fn positions() -> Vec<[f64; 3]> {
    used()
        .map(|i| {
            let [x, y] = plane(i);
            place([x, y, height([x, y])])
        })
        .collect()
}

/// The one normal of the plane.
fn normal() -> [f64; 3] {
    let length = (0.25 + 4.0 + 1.0f64).sqrt();
    place([-0.5, -2.0, 1.0].map(|v| v / length))
}

fn close(found: impl IntoIterator<Item = f64>, expected: [f64; 3], tolerance: f64) {
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() <= tolerance, "{found} {expected}");
    }
}

/// Every triangle has the lattice's size and turns towards the viewer; there are 3 strips of 2 · 4,
/// less the one at the missing corner.
fn check_triangles(triangles: &[[usize; 3]], positions: &[[f64; 3]]) {
    assert_eq!(triangles.len(), 24 - 1);
    let area = SPACING * SPACING * 3f64.sqrt() / 4.0;
    for t in triangles {
        // Back in the plane of the lattice.
        let [a, b, c] = t.map(|i| [positions[i][0], -positions[i][2]]);
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!((twice / 2.0 - area).abs() < 1e-6, "{twice}");
    }
}

struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (head, tail) = self.0.split_at(N);
        self.0 = tail;
        head.try_into().unwrap()
    }

    fn f32(&mut self) -> f64 {
        f32::from_le_bytes(self.take()).into()
    }

    fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }

    fn u32(&mut self) -> usize {
        u32::from_le_bytes(self.take()) as usize
    }

    fn many<T>(&mut self, n: usize, mut each: impl FnMut(&mut Self) -> T) -> Vec<T> {
        (0..n).map(|_| each(self)).collect()
    }
}

#[test]
fn the_mesh_is_the_lattice() {
    let triangulation = Triangulation::new(&surface(), &frame()).unwrap();
    let lattice: Vec<u32> = used().map(|i| i as u32).collect();
    assert_eq!(triangulation.vertices(), lattice);
    let mesh = mesh();
    for (found, expected) in mesh.positions().iter().zip(positions()) {
        close(*found, expected, 1e-15);
    }
    for n in mesh.normals().unwrap() {
        close(n.map(f64::from), normal(), 1e-6);
    }
    let expected: Vec<_> = used().map(|i| colors()[i]).collect();
    assert_eq!(mesh.colors().unwrap(), expected);
    let expected: Vec<_> = used().map(|i| uvs()[i]).collect();
    assert_eq!(mesh.uvs().unwrap(), expected);
    let triangles: Vec<_> = mesh
        .triangles()
        .iter()
        .map(|t| t.map(|i| i as usize))
        .collect();
    check_triangles(&triangles, &positions());
}

#[test]
fn ply_is_exact() {
    let file = write_ply(&mesh()).unwrap();
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 19\nproperty double x\n\
                  property double y\nproperty double z\nproperty float nx\nproperty float ny\n\
                  property float nz\nproperty uchar red\nproperty uchar green\n\
                  property uchar blue\nproperty float s\nproperty float t\nelement face 23\n\
                  property list uchar int vertex_indices\nend_header\n";
    assert_eq!(String::from_utf8_lossy(&file[..header.len()]), header);
    let mut rest = Bytes(&file[header.len()..]);
    for (i, p) in used().zip(positions()) {
        close(rest.many(3, Bytes::f64), p, 1e-15);
        close(rest.many(3, Bytes::f32), normal(), 1e-6);
        let expected = [0, 91, 182].map(|k| ((37 * i + k) % 256) as u8);
        assert_eq!(rest.take::<3>(), expected);
        let [s, t] = [rest.f32(), rest.f32()];
        assert_eq!([s, t], uvs()[i].map(f64::from));
    }
    let triangles = rest.many(23, |rest| {
        assert_eq!(rest.take::<1>(), [3]);
        [rest.u32(), rest.u32(), rest.u32()]
    });
    check_triangles(&triangles, &positions());
    assert!(rest.0.is_empty());
    // Back again it is the same, but for normals, which are not read.
    let back = read_mesh(&file, None).unwrap();
    assert_eq!(back.positions(), mesh().positions());
    assert_eq!(back.triangles(), mesh().triangles());
    assert_eq!(back.colors(), mesh().colors());
    assert_eq!(back.uvs(), mesh().uvs());
}

#[test]
fn stl_has_the_triangles() {
    let file = write_stl(&mesh()).unwrap();
    assert_eq!(file.len(), 84 + 23 * 50);
    assert!(!file.starts_with(b"solid"));
    let mut rest = Bytes(&file[80..]);
    assert_eq!(rest.u32(), 23);
    let mut corners = Vec::new();
    for _ in 0..23 {
        close(rest.many(3, Bytes::f32), normal(), 1e-5);
        for _ in 0..3 {
            let found = [rest.f32(), rest.f32(), rest.f32()];
            let expected = positions()
                .into_iter()
                .map(|p| p.map(|v| f64::from(v as f32)));
            assert!(
                expected
                    .into_iter()
                    .any(|p| (0..3).all(|k| (p[k] - found[k]).abs() < 1e-7))
            );
            corners.push(found);
        }
        assert_eq!(rest.take::<2>(), [0, 0]);
    }
    let triangles: Vec<_> = (0..23).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    check_triangles(&triangles, &corners);
}

/// The JSON of a GLB file and its binary part.
fn glb(file: &[u8]) -> (Value, &[u8]) {
    let mut rest = Bytes(file);
    assert_eq!(rest.take(), *b"glTF");
    assert_eq!((rest.u32(), rest.u32()), (2, file.len()));
    let length = rest.u32();
    assert_eq!((rest.take(), length % 4), (*b"JSON", 0));
    let (json, tail) = rest.0.split_at(length);
    let mut rest = Bytes(tail);
    let length = rest.u32();
    assert_eq!((rest.take(), rest.0.len()), (*b"BIN\0", length));
    (serde_json::from_slice(json).unwrap(), rest.0)
}

/// The bytes that an accessor is about, with its number of elements and its types.
fn accessor<'a>(json: &Value, bin: &'a [u8], index: &Value) -> (Bytes<'a>, usize, u64, String) {
    let accessor = &json["accessors"][index.as_u64().unwrap() as usize];
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    assert_eq!(start % 4, 0);
    let length = view["byteLength"].as_u64().unwrap() as usize;
    (
        Bytes(&bin[start..start + length]),
        accessor["count"].as_u64().unwrap() as usize,
        accessor["componentType"].as_u64().unwrap(),
        accessor["type"].as_str().unwrap().into(),
    )
}

/// Its one material shows this image from both sides.
fn check_material(json: &Value, bin: &[u8], image: &[u8]) {
    let primitive = &json["meshes"][0]["primitives"][0];
    let material = &json["materials"][primitive["material"].as_u64().unwrap() as usize];
    assert_eq!(material["doubleSided"], true);
    assert_eq!(
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"],
        0
    );
    let picture = &json["images"][json["textures"][0]["source"].as_u64().unwrap() as usize];
    assert_eq!(picture["mimeType"], "image/jpeg");
    let view = &json["bufferViews"][picture["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    assert_eq!(&bin[start..start + image.len()], image);
    assert_eq!(view["byteLength"], image.len());
}

#[test]
fn glb_has_all_of_it() {
    let image = b"\xff\xd8\xff\xe0 a picture";
    // Colours are in the file without a texture only: the two would be multiplied.
    let textured = write_glb(&mesh(), Some(image)).unwrap();
    let (json, bin) = glb(&textured);
    let plain = &json["meshes"][0]["primitives"][0]["attributes"];
    assert!(plain.get("COLOR_0").is_none());
    check_material(&json, bin, image);

    let file = write_glb(&mesh(), None).unwrap();
    let (json, bin) = glb(&file);
    assert_eq!(json["asset"]["version"], "2.0");
    assert_eq!(json["buffers"][0]["byteLength"], bin.len());
    let node = &json["nodes"][json["scenes"][0]["nodes"][0].as_u64().unwrap() as usize];
    assert_eq!(node.as_object().unwrap().len(), 1, "no transform");
    let primitive = &json["meshes"][0]["primitives"][0];
    let attribute = |name: &str| accessor(&json, bin, &primitive["attributes"][name]);

    let (mut rest, count, component, kind) = attribute("POSITION");
    assert_eq!((count, component, kind.as_str()), (19, 5126, "VEC3"));
    let narrow = positions()
        .into_iter()
        .map(|p| p.map(|v| f64::from(v as f32)));
    for expected in narrow.clone() {
        close(rest.many(3, Bytes::f32), expected, 1e-7);
    }
    for (name, pick) in [("min", f64::min as fn(f64, f64) -> f64), ("max", f64::max)] {
        let index = primitive["attributes"]["POSITION"].as_u64().unwrap() as usize;
        let stated = json["accessors"][index][name].as_array().unwrap();
        let expected: [f64; 3] =
            std::array::from_fn(|k| narrow.clone().map(|p| p[k]).reduce(pick).unwrap());
        close(stated.iter().map(|v| v.as_f64().unwrap()), expected, 1e-7);
    }
    let (mut rest, _, component, kind) = attribute("NORMAL");
    assert_eq!((component, kind.as_str()), (5126, "VEC3"));
    for _ in 0..19 {
        close(rest.many(3, Bytes::f32), normal(), 1e-6);
    }
    let (mut rest, _, component, kind) = attribute("COLOR_0");
    assert_eq!((component, kind.as_str()), (5121, "VEC4"));
    let (mut uv, _, _, kind) = attribute("TEXCOORD_0");
    assert_eq!(kind, "VEC2");
    for i in used() {
        let [r, g, b] = [0, 91, 182].map(|k| ((37 * i + k) % 256) as u8);
        assert_eq!(rest.take(), [r, g, b, 255]);
        let [u, v] = uvs()[i].map(f64::from);
        assert_eq!([uv.f32(), uv.f32()], [u, 1.0 - v], "from the top");
    }
    let (mut rest, count, component, kind) = accessor(&json, bin, &primitive["indices"]);
    assert_eq!((count, component, kind.as_str()), (69, 5125, "SCALAR"));
    let triangles = rest.many(23, |rest| [rest.u32(), rest.u32(), rest.u32()]);
    check_triangles(&triangles, &positions());

    let back = read_mesh(&file, None).unwrap();
    assert_eq!(back.triangles(), mesh().triangles());
    assert_eq!(back.colors(), mesh().colors());
    assert_eq!(back.uvs(), mesh().uvs());
}

#[test]
fn glb_keeps_the_heights_of_coordinates_on_a_map() {
    // Metres, a sheet of three metres at a spacing of a hand's width, two thousand metres up.
    let lattice = Lattice::new(30, 30, 0.1).unwrap();
    let lattice = lattice.with_origin([512_345.678, 5_413_210.987]).unwrap();
    let height = |x: f64, y: f64| 2000.0 + 0.1 * (x - 512_345.0) - 0.2 * (y - 5_413_210.0);
    let surface = Heightfield::from_fn(lattice, height).unwrap();
    for frame in [Frame::default(), frame()] {
        let mesh = Triangulation::new(&surface, &frame).unwrap().into_mesh();
        let back = read_mesh(&write_glb(&mesh, None).unwrap(), None).unwrap();
        for (found, expected) in back.positions().iter().zip(mesh.positions()) {
            close(*found, *expected, 1e-3 * 0.1);
        }
        assert_eq!(back.triangles(), mesh.triangles());
    }
    // In 32 bits alone it would be half a metre off.
    assert!((f64::from(5_413_210.987f32) - 5_413_210.987).abs() > 1e-3);
}

#[test]
fn obj_has_colours_and_texture_coordinates() {
    let text = String::from_utf8(write_obj(&mesh(), None).unwrap()).unwrap();
    let numbers = |key: &str| -> Vec<Vec<f64>> {
        let lines = text.lines().filter_map(|line| line.strip_prefix(key));
        lines
            .map(|l| l.split(' ').map(|n| n.parse().unwrap()).collect())
            .collect()
    };
    for ((i, p), line) in used().zip(positions()).zip(numbers("v ")) {
        close(line[..3].to_vec(), p, 1e-15);
        close(line[3..].to_vec(), colors()[i].map(f64::from), 1e-7);
    }
    let uvs: Vec<Vec<f64>> = used().map(|i| uvs()[i].map(f64::from).to_vec()).collect();
    assert_eq!(numbers("vt "), uvs);
    assert_eq!(text.lines().filter(|l| l.starts_with("f ")).count(), 23);
    assert!(text.lines().any(|l| l == "f 1/1/1 5/5/5 6/6/6"), "{text}");
    let back = read_mesh(text.as_bytes(), None).unwrap();
    assert_eq!(back.triangles().len(), 23);
    assert!(back.colors().is_some() && back.uvs().is_some());
}

#[test]
fn a_bare_surface_has_no_colours() {
    let mesh = Triangulation::new(&surface(), &Frame::default())
        .unwrap()
        .into_mesh();
    let file = write_glb(&mesh, None).unwrap();
    let (json, _) = glb(&file);
    let attributes = json["meshes"][0]["primitives"][0]["attributes"]
        .as_object()
        .unwrap();
    assert_eq!(
        attributes.keys().collect::<Vec<_>>(),
        ["NORMAL", "POSITION"]
    );
    assert!(json.get("images").is_none());
    let ply = write_ply(&mesh).unwrap();
    assert!(!String::from_utf8_lossy(&ply[..300]).contains("red"));
}

#[test]
fn what_cannot_be_written_is_said() {
    let code = |r: Result<Vec<u8>>| r.unwrap_err().code();
    let bare = Triangulation::new(&surface(), &frame()).unwrap();
    assert_eq!(
        code(write_glb(bare.mesh(), Some(b"\x89PNG"))),
        "UNSUPPORTED"
    );
    assert_eq!(code(write_glb(&mesh(), Some(b"GIF89a"))), "UNSUPPORTED");
    assert_eq!(bare.clone().with_colors(&[]).unwrap_err().code(), "SHAPE");
    assert_eq!(bare.with_uvs(&[[0.0; 2]; 7]).unwrap_err().code(), "SHAPE");
    let huge = Mesh::new(
        vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1e39, 0.0]],
        vec![[0, 1, 2]],
    );
    let huge = huge.unwrap();
    let error = write_stl(&huge).unwrap_err().to_string();
    assert!(error.contains("row 2, column 1"), "{error}");
    assert_eq!(code(write_glb(&huge, None)), "NOT_FINITE");
    assert!(write_ply(&huge).is_ok());
    let row = Heightfield::new(Lattice::new(1, 4, 1.0).unwrap(), vec![0.0; 4]).unwrap();
    let error = Triangulation::new(&row, &frame()).unwrap_err();
    assert_eq!(error.code(), "UNSUPPORTED");
    // Points are written where the format knows any.
    let cloud = Mesh::cloud(positions()).unwrap();
    assert_eq!(code(write_stl(&cloud)), "UNSUPPORTED");
    for file in [
        write_glb(&cloud, None),
        write_ply(&cloud),
        write_obj(&cloud, None),
    ] {
        let back = read_mesh(&file.unwrap(), None).unwrap();
        assert!(back.is_cloud() && back.positions().len() == 19);
    }
    // Colours that are no numbers are black, as files cannot say it.
    let nan = bare_colors(f32::NAN);
    assert!(nan.colors().unwrap().iter().all(|c| *c == [0.0; 3]));
}

fn bare_colors(value: f32) -> Mesh {
    let bare = Triangulation::new(&surface(), &frame()).unwrap();
    bare.with_colors(&[[value; 3]; ROWS * COLS])
        .unwrap()
        .into_mesh()
}
