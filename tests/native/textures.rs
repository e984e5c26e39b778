//! Textured meshes of other programs (`tests/data/meshes/make-textured.py`), seen and painted.

use developable::dewarp::{Extent, Photo, paint};
use developable::files::images::decode_photo;
use developable::files::meshes::{MeshFile, read_mesh, read_mesh_beside, write_glb};
use developable::{HeightImage, Mesh, Resolution, Samples, View, sample};

fn file(name: &str) -> Vec<u8> {
    let path = format!("{}/tests/data/meshes/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// A file, with those that may lie beside it.
fn read(name: &str, beside: &[&str]) -> MeshFile {
    let files: Vec<_> = beside.iter().map(|name| (*name, file(name))).collect();
    let files: Vec<_> = files.iter().map(|(n, bytes)| (*n, &bytes[..])).collect();
    read_mesh_beside(&file(name), None, &files).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The colour of the sheet above a place, from what the script says: 32 levels for each of the 8
/// pixels, on a fifth of x and of y.
fn shade([x, y]: [f64; 2]) -> [f64; 3] {
    let level = |share: f64| 32.0 * (8.0 * share - 0.5) / 255.0;
    [
        level(x / 5.0 + 0.2),
        level(1.0 - (y / 5.0 + 0.2)),
        128.0 / 255.0,
    ]
}

fn seen(mesh: &Mesh) -> (Samples, Vec<[f32; 2]>, Vec<i32>) {
    let view = View::Along([0.0, 0.0, -1.0]);
    let samples = sample(mesh, view, Resolution::Across(40)).unwrap();
    let uvs = samples.carry(mesh, mesh.uvs().unwrap()).unwrap();
    let textures = samples.textures(mesh).unwrap();
    (samples, uvs, textures)
}

fn close(found: [f32; 3], expected: [f64; 3], tolerance: f64, what: &str) {
    for (found, expected) in found.into_iter().zip(expected) {
        let off = (f64::from(found) - expected).abs();
        assert!(off < tolerance, "{what}: {found} {expected}");
    }
}

/// Paints a mesh's vertices with the texture and looks at each colour; gives the number of those
/// painted, and of those hit that have no texture.
fn check_painted(
    name: &str,
    MeshFile {
        mesh,
        textures,
        missing,
        ..
    }: &MeshFile,
) -> [usize; 2] {
    assert!(missing.is_empty(), "{name}: {missing:?}");
    assert_eq!(textures.len(), 1, "{name}");
    let picture = decode_photo(&textures[0].bytes).unwrap();
    let photo = Photo::new(picture.width, picture.height, &picture.rgba).unwrap();
    let (samples, uvs, numbers) = seen(mesh);
    let own = mesh
        .colors()
        .map(|colors| samples.carry(mesh, colors).unwrap());
    let mut colors = own.unwrap_or_else(|| vec![[f32::NAN; 3]; uvs.len()]);
    paint(&mut colors, &uvs, &photo, |i| numbers[i] == 0);
    let mut count = [0; 2];
    let lattice = *samples.heightfield().lattice();
    for (i, color) in colors.iter().enumerate() {
        if samples.hit(i).is_none() {
            assert_eq!(numbers[i], -1);
        } else if numbers[i] == 0 {
            let place = lattice.position(i / lattice.cols(), i % lattice.cols());
            close(*color, shade(place), 1e-4, name);
            count[0] += 1;
        } else {
            close(*color, [1.0, 0.2, 0.0], 1e-6, name);
            count[1] += 1;
        }
    }
    count
}

#[test]
fn textures_of_every_format_give_their_colours() {
    for (name, beside) in [
        ("textured.obj", &["textured.mtl", "sheet.png"][..]),
        ("textured.obj", &["here/Textured.MTL", "there\\SHEET.png"]),
        ("textured.ply", &["sheet.png"]),
        ("textured.glb", &[]),
        (
            "parts.gltf",
            &[
                "gltf_buffer_0.bin",
                "gltf_buffer_1.bin",
                "gltf_buffer_2.bin",
                "gltf_buffer_3.bin",
            ],
        ),
    ] {
        let found = if beside.first().is_some_and(|b| b.starts_with("here")) {
            // Names of another machine: folders and capitals do not count.
            let (mtl, png) = (file("textured.mtl"), file("sheet.png"));
            let files = [(beside[0], &mtl[..]), (beside[1], &png[..])];
            read_mesh_beside(&file(name), None, &files).unwrap()
        } else {
            read(name, beside)
        };
        let [painted, others] = check_painted(name, &found);
        assert!(painted > 500 && others == 0, "{name}: {painted} {others}");
    }
    let [painted, others] = check_painted("half", &read("half-textured.glb", &[]));
    assert!(painted > 300 && others > 20, "{painted} {others}");
}

#[test]
fn what_is_missing_is_said_and_no_failure() {
    let found = read("textured.obj", &[]);
    assert_eq!(found.missing, ["textured.mtl"]);
    assert!(found.textures.is_empty() && found.mesh.textures().is_none());
    assert_eq!(found.mesh.triangles().len(), 3);
    let found = read("textured.obj", &["textured.mtl"]);
    assert_eq!(found.missing, ["sheet.png"]);
    // What is left is the material's own colour.
    let colors = found.mesh.colors().unwrap();
    assert!(colors.iter().all(|c| *c == [0.4; 3]), "{colors:?}");
    assert_eq!(read("textured.ply", &[]).missing, ["sheet.png"]);
    // Without its buffers there is nothing left of a mesh.
    let error = read_mesh(&file("parts.gltf"), None).unwrap_err();
    assert_eq!(error.code(), "UNSUPPORTED");
    assert!(error.to_string().contains("gltf_buffer_0.bin"), "{error}");
}

/// A triangle with a material of each kind, and the MTL for it.
const MATERIALS: &str = "mtllib my own.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n\
     usemtl red\nf 1/1 2/2 3/3\nusemtl none\nf 1/1 2/2 3/3\nusemtl one\nf 1/1 2/2 3/3\n\
     usemtl two\nf 1/1 2/2 3/3\nusemtl again\nf 1/1 2/2 3/3\n";
const MTL: &str = "newmtl red\nKd 1 0.25 0\nnewmtl one\nKd 0 0 0\nmap_Kd -s 1 1 1 dir/a.png\n\
     newmtl two\nmap_Kd b c.png\nnewmtl again\nmap_Kd a.png\n";

#[test]
fn each_triangle_has_the_texture_of_its_material() {
    let files = [
        ("my own.mtl", MTL.as_bytes()),
        ("a.png", b"A"),
        ("b c.png", b"B"),
    ];
    let found = read_mesh_beside(MATERIALS.as_bytes(), None, &files).unwrap();
    assert!(found.missing.is_empty(), "{:?}", found.missing);
    let names: Vec<_> = found.textures.iter().map(|t| t.name.as_str()).collect();
    assert_eq!(names, ["a.png", "b c.png"], "each once");
    assert_eq!(found.textures[1].bytes, b"B");
    assert_eq!(found.mesh.textures().unwrap(), [-1, -1, 0, 1, 0]);
    let first = |t: usize| found.mesh.colors().unwrap()[found.mesh.triangles()[t][0] as usize];
    assert_eq!([first(0), first(1)], [[1.0, 0.25, 0.0], [1.0; 3]]);
}

#[test]
fn parts_without_textures_need_no_coordinates() {
    let text = MATERIALS.replace("usemtl red\nf 1/1 2/2 3/3", "usemtl red\nf 1 2 3");
    let files = [("my own.mtl", MTL.as_bytes()), ("a.png", b"A")];
    let found = read_mesh_beside(text.as_bytes(), None, &files).unwrap();
    assert_eq!(found.missing, ["b c.png"]);
    assert_eq!(found.mesh.textures().unwrap(), [-1, -1, 0, -1, 0]);
    let corner =
        |t: usize, k: usize| found.mesh.uvs().unwrap()[found.mesh.triangles()[t][k] as usize];
    assert_eq!([corner(2, 1), corner(2, 2)], [[1.0, 0.0], [0.0, 1.0]]);
    // Without any texture they say nothing.
    assert!(read_mesh(text.as_bytes(), None).unwrap().uvs().is_none());
}

#[test]
fn damaged_materials_are_left_out_and_damaged_textures_are_errors() {
    let with = |mtl: &[u8]| {
        let files = [("my own.mtl", mtl), ("a.png", b"A"), ("b c.png", b"B")];
        read_mesh_beside(MATERIALS.as_bytes(), None, &files)
    };
    // A mesh is not refused for its looks.
    for odd in [
        "newmtl red\nKd 1 0.25\n",
        "newmtl\n",
        "newmtl red\nmap_Kd\n",
    ] {
        assert!(with(odd.as_bytes()).is_ok(), "{odd}");
    }
    for length in 0..MTL.len() {
        if let Err(error) = with(&MTL.as_bytes()[..length]) {
            assert_eq!(error.code(), "FORMAT", "{length} bytes: {error}");
        }
    }
    // One number is a grey, and colours by other means are none.
    let grey = with(b"newmtl red\nKd 0.5\n").unwrap().mesh;
    assert_eq!(grey.colors().unwrap()[0], [0.5; 3]);
    assert!(with(b"newmtl red\nKd spectral red.rfl\n").is_ok());
    // What does not matter here may be odd.
    assert!(with(b"\xff\xfe\0\nnewmtl red\nillum 2.0\nKs 1\nNs\n").is_ok());
    // The same bytes under a hundred names do not become a hundred pictures.
    let text = String::from_utf8(file("embedded.gltf")).unwrap();
    let mut json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let number = 100;
    let content = "AAAA".repeat(25_000);
    let buffers = json["buffers"].as_array_mut().unwrap();
    buffers.push(serde_json::json!({
        "uri": format!("data:application/octet-stream;base64,{content}"), "byteLength": 75_000,
    }));
    let views = json["bufferViews"].as_array_mut().unwrap();
    views.push(serde_json::json!({ "buffer": 1, "byteLength": 75_000 }));
    json["images"] = (0..number)
        .map(|_| serde_json::json!({ "bufferView": 2, "mimeType": "image/png" }))
        .collect();
    json["textures"] = (0..number)
        .map(|i| serde_json::json!({ "source": i }))
        .collect();
    json["materials"] = (0..number)
        .map(|i| serde_json::json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": i } } }))
        .collect();
    let primitive = json["meshes"][0]["primitives"][0].clone();
    json["meshes"][0]["primitives"] = (0..number)
        .map(|i| {
            let mut primitive = primitive.clone();
            primitive["material"] = i.into();
            primitive
        })
        .collect();
    let error = read_mesh_beside(json.to_string().as_bytes(), None, &[]).unwrap_err();
    assert!(
        error.to_string().contains("larger than their files"),
        "{error}"
    );
    // An image that is not there.
    json["images"][0]["bufferView"] = 1.into();
    json["bufferViews"][1]["byteLength"] = 9_999_999.into();
    let error = read_mesh_beside(json.to_string().as_bytes(), None, &[]).unwrap_err();
    assert_eq!(error.code(), "FORMAT");
    for name in ["textured.glb", "half-textured.glb"] {
        let whole = file(name);
        for length in 0..whole.len() {
            assert!(
                read_mesh(&whole[..length], None).is_err(),
                "{name} cut to {length}"
            );
        }
    }
}

#[test]
fn a_photo_of_an_image_has_the_same_outline() {
    // Sixteen pixels of heights, a photo of twice as many.
    let image = HeightImage::new(4, 4, vec![0.0; 16]).unwrap();
    let image = image.with_pixel_size(0.5).unwrap();
    let field = image.to_lattice(None).unwrap();
    let uvs = Extent::from_image(&image).uvs(field.lattice()).unwrap();
    for (i, [u, v]) in uvs.iter().enumerate() {
        let cols = field.lattice().cols();
        let [x, y] = field.lattice().position(i / cols, i % cols);
        let expected = [x / 2.0, y / 2.0].map(|share| share.clamp(0.0, 1.0) as f32);
        assert_eq!([*u, *v], expected);
    }
    assert!(uvs.iter().any(|uv| uv[1] > 0.5) && uvs.iter().any(|uv| uv[1] < 0.5));
    let none = Extent {
        min: [0.0; 2],
        max: [1.0, 0.0],
    };
    assert_eq!(none.uvs(field.lattice()).unwrap_err().code(), "EMPTY");
}

#[test]
fn a_texture_takes_the_place_of_colours() {
    let MeshFile { mesh, textures, .. } = read("textured.glb", &[]);
    let mesh = mesh.with_colors(vec![[0.5; 3]; 5]).unwrap();
    let both = write_glb(&mesh, Some(&textures[0].bytes)).unwrap();
    let back = read_mesh_beside(&both, None, &[]).unwrap();
    assert!(back.mesh.colors().is_none(), "they would be multiplied");
    assert_eq!(back.textures, textures);
    assert_eq!(back.mesh.uvs(), mesh.uvs());
    assert_eq!(back.mesh.textures().unwrap(), [0, 0, 0]);
    let colored = write_glb(&mesh, None).unwrap();
    assert!(read_mesh(&colored, None).unwrap().colors().is_some());
}

/// A scanner's atlas: the two halves of a page lie turned and far from each other in the texture.
#[test]
fn charts_do_not_run_into_each_other() {
    let (count, radius) = (60u32, 0.4);
    let (mut positions, mut uvs, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
    let chart = |half: usize, [s, t]: [f64; 2]| match half {
        0 => [0.05 + 0.4 * t, 0.05 + 0.4 * s],
        _ => [0.55 + 0.4 * (s - 0.5), 0.95 - 0.4 * (1.0 - t)],
    };
    for half in 0..2 {
        let first = positions.len() as u32;
        let (cols, rows) = (count / 2, count);
        for i in 0..=cols {
            for j in 0..=rows {
                let s = 0.5 * half as f64 + 0.5 * f64::from(i) / f64::from(cols);
                let t = f64::from(j) / f64::from(rows);
                let angle = (s - 0.5) / radius;
                positions.push([radius * angle.sin(), t, radius * angle.cos()]);
                // The first chart is turned by a quarter and mirrored.
                uvs.push(chart(half, [s, t]).map(|v| v as f32));
                if i < cols && j < rows {
                    let a = first + i * (rows + 1) + j;
                    let [b, c, d] = [a + rows + 1, a + rows + 2, a + 1];
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
    }
    let mesh = Mesh::new(positions, triangles)
        .unwrap()
        .with_uvs(uvs)
        .unwrap();
    let samples = sample(&mesh, View::Along([0.0, 0.0, -1.0]), Resolution::Across(45)).unwrap();
    let carried = samples.carry(&mesh, mesh.uvs().unwrap()).unwrap();
    let sheet = developable::unroll::unroll(samples.heightfield(), &Default::default()).unwrap();
    let options = developable::dewarp::DewarpOptions::default().dots(400.0);
    let registration = developable::dewarp::Registration::Uvs(&carried);
    let map =
        developable::dewarp::WarpMap::new(&sheet, registration, [1000, 1000], &options).unwrap();
    // Where on the page each pixel is from, by the chart that it is in.
    let (mut found, mut foreign) = (Vec::new(), 0);
    for (i, place) in map
        .places()
        .iter()
        .enumerate()
        .filter(|(_, place)| !place[0].is_nan())
    {
        let [u, v] = [f64::from(place[0]) + 0.5, 999.5 - f64::from(place[1])].map(|p| p / 1000.0);
        let first = [(v - 0.05) / 0.4, (u - 0.05) / 0.4];
        let second = [0.5 + (u - 0.55) / 0.4, 1.0 - (0.95 - v) / 0.4];
        let slack = 0.02;
        let is = |[s, t]: [f64; 2], low: f64| {
            (low - slack..low + 0.5 + slack).contains(&s) && (-slack..1.0 + slack).contains(&t)
        };
        let at = match (is(first, 0.0), is(second, 0.5)) {
            (true, false) => first,
            (false, true) => second,
            _ => {
                foreign += 1;
                continue;
            }
        };
        let pixel = [(i % map.width()) as f64, -((i / map.width()) as f64)].map(|p| p / 400.0);
        found.push([at[0] - pixel[0], at[1] - pixel[1]]);
    }
    assert_eq!(foreign, 0, "of {}", found.len());
    for k in 0..2 {
        let mean = found.iter().map(|off| off[k]).sum::<f64>() / found.len() as f64;
        let largest = found
            .iter()
            .map(|off| (off[k] - mean).abs())
            .fold(0.0, f64::max);
        assert!(largest < 0.006, "{largest}");
    }
}
