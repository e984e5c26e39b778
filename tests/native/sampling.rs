//! What is seen of a mesh: known shapes, every view, and an independent ray caster.

use developable::{Error, Frame, Mesh, Resolution, Samples, View, sample};
use proptest::prelude::*;

type Point = [f64; 3];

fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: Point, b: Point) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Möller and Trumbore's intersection: how far along the ray, and the least barycentric
/// coordinate, which tells how near to the triangle's border the hit is.
fn intersect(origin: Point, direction: Point, [a, b, c]: [Point; 3]) -> Option<(f64, f64)> {
    let (ab, ac) = (minus(b, a), minus(c, a));
    let p = cross(direction, ac);
    let determinant = dot(ab, p);
    if determinant == 0.0 {
        return None;
    }
    let from = minus(origin, a);
    let u = dot(from, p) / determinant;
    let q = cross(from, ab);
    let v = dot(direction, q) / determinant;
    let t = dot(ac, q) / determinant;
    Some((t, u.min(v).min(1.0 - u - v)))
}

fn negated(v: Point) -> Point {
    v.map(|c| -c)
}

fn corners(mesh: &Mesh, triangle: usize) -> [Point; 3] {
    mesh.triangles()[triangle].map(|i| mesh.positions()[i as usize])
}

/// Every vertex against every triangle. Hits and misses by less than `tolerance` may go either way.
fn check_against_rays(mesh: &Mesh, samples: &Samples, tolerance: f64) {
    let Frame { towards, .. } = *samples.frame();
    let lattice = *samples.heightfield().lattice();
    let far = 1e3;
    for index in 0..lattice.len() {
        let [x, y] = lattice.position(index / lattice.cols(), index % lattice.cols());
        let origin = samples.frame().to_world([x, y, far]);
        let hits = (0..mesh.triangles().len())
            .filter_map(|i| intersect(origin, negated(towards), corners(mesh, i)));
        let (mut surely, mut perhaps) = (f64::NEG_INFINITY, Vec::new());
        for (t, inside) in hits {
            if inside > tolerance {
                surely = surely.max(far - t);
            }
            if inside > -tolerance {
                perhaps.push(far - t);
            }
        }
        let height = samples.heightfield().heights()[index];
        match samples.hit(index) {
            None => {
                assert!(height.is_nan());
                assert_eq!(surely, f64::NEG_INFINITY, "a hit was missed at {x}, {y}");
            }
            Some(hit) => {
                assert!(height > surely - 1e-6, "{height} is behind {surely}");
                assert!(
                    perhaps.iter().any(|z| (z - height).abs() < 1e-4),
                    "{height} is none of {perhaps:?}"
                );
                let corners = corners(mesh, hit.index);
                let point: Point = std::array::from_fn(|k| {
                    (0..3)
                        .map(|j| f64::from(hit.weights[j]) * corners[j][k])
                        .sum()
                });
                let found = samples.frame().view(point);
                for (a, b) in found.into_iter().zip([x, y, height]) {
                    assert!(
                        (a - b).abs() < 1e-5,
                        "{found:?} instead of {x} {y} {height}"
                    );
                }
            }
        }
    }
}

const NAMES: [&str; 6] = ["-x", "+x", "-y", "+y", "-z", "+z"];

fn view(name: &str) -> View {
    name.parse().unwrap()
}

/// A grid over the unit square of the x-y plane, lifted to `z(x, y)`.
fn sheet(cells: usize, place: impl Fn(f64, f64) -> Point) -> Mesh {
    let n = cells + 1;
    let at = |i: usize| i as f64 / cells as f64;
    let positions = (0..n * n).map(|i| place(at(i % n), at(i / n))).collect();
    let index = |x: usize, y: usize| (y * n + x) as u32;
    let triangles = (0..cells * cells)
        .flat_map(|i| {
            let (x, y) = (i % cells, i / cells);
            let [a, b, c, d] = [
                index(x, y),
                index(x + 1, y),
                index(x + 1, y + 1),
                index(x, y + 1),
            ];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    Mesh::new(positions, triangles).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn the_first_hit_is_that_of_a_ray_caster(
        positions in prop::collection::vec(prop::array::uniform3(-1.0f64..1.0), 4..30),
        picks in prop::collection::vec(prop::array::uniform3(0usize..1000), 1..40),
        direction in prop::array::uniform3(-1.0f64..1.0),
        name in prop::option::of(0usize..6),
    ) {
        let triangles = picks.iter().map(|t| t.map(|i| (i % positions.len()) as u32)).collect();
        let mesh = Mesh::new(positions, triangles).unwrap();
        let view = name.map_or(View::Along(direction), |i| view(NAMES[i]));
        match sample(&mesh, view, Resolution::Across(25)) {
            Ok(samples) => check_against_rays(&mesh, &samples, 1e-6),
            // Slivers between the vertices, or nothing but repeated corners.
            Err(error) => prop_assert_eq!(error.code(), "UNSUPPORTED"),
        }
    }

    #[test]
    fn there_are_no_pinholes_along_edges(
        jitter in prop::collection::vec(prop::array::uniform2(-0.3f64..0.3), 81),
        across in 20usize..70,
        turn in 0.0f64..6.3,
    ) {
        // A planar grid whose vertices stay in order; its rows coincide with the lattice's or not.
        let cells = 8;
        let (sin, cos) = turn.sin_cos();
        let mesh = sheet(cells, |x, y| {
            let i = (y * 72.0).round() as usize + (x * 8.0).round() as usize;
            let inner = |v: f64| if v > 0.0 && v < 1.0 { 1.0 / cells as f64 } else { 0.0 };
            let (x, y) = (x + jitter[i][0] * inner(x), y + jitter[i][1] * inner(y));
            [cos * x - sin * y, sin * x + cos * y, 0.0]
        });
        let samples = sample(&mesh, view("-z"), Resolution::Across(across)).unwrap();
        let field = samples.heightfield();
        let lattice = field.lattice();
        for index in 0..lattice.len() {
            let [u, v] = lattice.position(index / lattice.cols(), index % lattice.cols());
            let [x, y] = [cos * u + sin * v, cos * v - sin * u];
            let inside = x.min(y).min(1.0 - x).min(1.0 - y);
            if inside > 1e-9 {
                prop_assert_eq!(field.heights()[index], 0.0);
            } else if inside < -1e-9 {
                prop_assert!(field.heights()[index].is_nan());
            }
        }
    }

    #[test]
    fn frames_are_right_handed_and_lead_back(direction in prop::array::uniform3(-1e3f64..1e3)) {
        let frame = Frame::looking_along(direction).unwrap();
        let Frame { right, up, towards } = frame;
        for (a, b) in [(cross(right, up), towards), (cross(up, towards), right)] {
            prop_assert!(dot(minus(a, b), minus(a, b)) < 1e-24);
        }
        let length = dot(direction, direction).sqrt();
        prop_assert!((dot(direction, towards) + length).abs() < 1e-9 * length);
        prop_assert!(up[1] >= 0.0 && right[1].abs() < 1e-12);
        let point = [1.0, -2.0, 3.5];
        let back = frame.to_world(frame.view(point));
        prop_assert!((0..3).all(|k| (back[k] - point[k]).abs() < 1e-12));
    }
}

#[test]
fn vertices_and_edges_on_the_lattice_itself_are_hit() {
    // Every vertex of the mesh is one of the lattice, every edge runs through others.
    let h = 0.25;
    let row = h * 0.75f64.sqrt();
    let positions: Vec<Point> = (0..25)
        .map(|i| {
            let (r, c) = (i / 5, i % 5);
            let shift = if r % 2 == 1 { h / 2.0 } else { 0.0 };
            [c as f64 * h - shift, -(r as f64) * row, 0.0]
        })
        .collect();
    let triangles = vec![[0, 4, 22], [0, 22, 20], [4, 24, 22]];
    let mesh = Mesh::new(positions, triangles).unwrap();
    let samples = sample(&mesh, view("-z"), Resolution::Spacing(h)).unwrap();
    let field = samples.heightfield();
    for (row, col) in (0..5).flat_map(|r| (r % 2..5).map(move |c| (r, c))) {
        assert_eq!(field.height(row, col), 0.0, "{row} {col}");
    }
}

#[test]
fn a_tilted_plane_from_all_six_sides() {
    // 2x + 3y + 5z = 1, which is no axis's plane.
    let mesh = sheet(5, |x, y| [x, y, (1.0 - 2.0 * x - 3.0 * y) / 5.0]);
    for name in NAMES {
        let samples = sample(&mesh, view(name), Resolution::Across(40)).unwrap();
        let lattice = *samples.heightfield().lattice();
        let mut hits = 0;
        for index in (0..lattice.len()).filter(|i| samples.hit(*i).is_some()) {
            let [u, v] = lattice.position(index / lattice.cols(), index % lattice.cols());
            let z = samples.heightfield().heights()[index];
            let [x, y, z] = samples.frame().to_world([u, v, z]);
            assert!((2.0 * x + 3.0 * y + 5.0 * z - 1.0).abs() < 1e-12, "{name}");
            hits += 1;
        }
        assert!(hits > 100, "{name}: {hits}");
        check_against_rays(&mesh, &samples, 1e-9);
    }
}

#[test]
fn the_axes_of_the_named_views() {
    let table = [
        ("-z", [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
        ("+z", [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]),
        ("-x", [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
        ("+x", [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]),
        ("-y", [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
        ("+y", [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]),
    ];
    let mesh = sheet(1, |x, y| [x, y, x - y]);
    for (name, right, up, towards) in table {
        assert_eq!(
            view(name).frame(&mesh).unwrap(),
            Frame { right, up, towards },
            "{name}"
        );
    }
}

#[test]
fn up_is_up_and_right_is_right() {
    // A step that is high at small x and large y only: the top left quarter of the image.
    let mesh = sheet(8, |x, y| {
        [x, y, if x < 0.45 && y > 0.55 { 3.0 } else { 0.0 }]
    });
    let samples = sample(&mesh, view("-z"), Resolution::Across(33)).unwrap();
    let (rows, cols) = {
        let lattice = samples.heightfield().lattice();
        (lattice.rows(), lattice.cols())
    };
    let height = |row: usize, col: usize| samples.heightfield().height(row, col);
    assert_eq!(height(2, 2), 3.0);
    assert_eq!(height(2, cols - 5), 0.0);
    assert_eq!(height(rows - 3, 2), 0.0);
    // From behind, left and right change places, and what was high is low.
    let behind = sample(&mesh, view("+z"), Resolution::Across(33)).unwrap();
    assert_eq!(behind.heightfield().height(2, cols - 5), -3.0);
    assert_eq!(behind.heightfield().height(2, 2), 0.0);
}

#[test]
fn a_sphere_shows_its_near_half() {
    let (rings, sectors) = (120, 240);
    let positions = (0..=rings)
        .flat_map(|i| (0..sectors).map(move |j| (i, j)))
        .map(|(i, j)| {
            let (polar, around) = (
                std::f64::consts::PI * i as f64 / rings as f64,
                std::f64::consts::TAU * j as f64 / sectors as f64,
            );
            [
                1.0 + polar.sin() * around.cos(),
                2.0 + polar.sin() * around.sin(),
                3.0 + polar.cos(),
            ]
        })
        .collect();
    let triangles = (0..rings * sectors)
        .flat_map(|i| {
            let next = if i % sectors == sectors - 1 {
                i + 1 - sectors
            } else {
                i + 1
            };
            let [a, b, c, d] = [i, next, i + sectors, next + sectors].map(|v| v as u32);
            [[a, c, b], [b, c, d]]
        })
        .collect();
    let mesh = Mesh::new(positions, triangles).unwrap();
    let centre = [1.0, 2.0, 3.0];
    for direction in [[0.0, 0.0, -1.0], [0.3, -2.0, 0.9], [-1.0, 0.0, 0.0]] {
        let samples = sample(&mesh, View::Along(direction), Resolution::Spacing(0.03)).unwrap();
        let lattice = samples.heightfield().lattice();
        let [cx, cy, cz] = samples.frame().view(centre);
        for index in 0..lattice.len() {
            let [x, y] = lattice.position(index / lattice.cols(), index % lattice.cols());
            let squared = 1.0 - (x - cx).powi(2) - (y - cy).powi(2);
            let height = samples.heightfield().heights()[index];
            if squared > 0.01 {
                assert!(
                    (height - cz - squared.sqrt()).abs() < 5e-3,
                    "{x} {y}: {height}"
                );
            } else if squared < 0.0 {
                assert!(height.is_nan());
            }
        }
    }
}

#[test]
fn best_fit_looks_straight_at_a_sheet_from_its_front() {
    // Counter-clockwise as seen from the normal's side.
    let normal = [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0];
    let frame = Frame::looking_along(negated(normal)).unwrap();
    for flip in [false, true] {
        let turned = |x: f64, y: f64| {
            let x = if flip { -x } else { x };
            let bump = 0.02 * (9.0 * x).sin() * (7.0 * y).cos();
            frame.to_world([100.0 + 2.0 * x, y, bump - 5.0])
        };
        let found = View::BestFit.frame(&sheet(20, turned)).unwrap();
        let facing = dot(found.towards, normal);
        assert!((facing.abs() - 1.0).abs() < 1e-3, "{found:?}");
        assert_eq!(facing < 0.0, flip);
    }
    let flat = Mesh::new(vec![[1.0; 3]; 3], vec![[0, 1, 2]]).unwrap();
    assert_eq!(
        View::BestFit.frame(&flat).unwrap_err().code(),
        "UNSUPPORTED"
    );
}

#[test]
fn values_at_vertices_come_along() {
    let mesh = sheet(4, |x, y| [x, y, x * y]);
    let colors: Vec<[f32; 3]> = mesh
        .positions()
        .iter()
        .map(|p| [p[0] as f32, p[1] as f32, 0.5])
        .collect();
    let mesh = mesh.with_colors(colors).unwrap();
    let samples = sample(&mesh, view("-z"), Resolution::Across(30)).unwrap();
    let carried = samples.carry(&mesh, mesh.colors().unwrap()).unwrap();
    let lattice = samples.heightfield().lattice();
    for (i, color) in carried.iter().enumerate() {
        let [x, y] = lattice.position(i / lattice.cols(), i % lattice.cols());
        if samples.hit(i).is_some() {
            assert!(
                (f64::from(color[0]) - x).abs() < 1e-6 && (f64::from(color[1]) - y).abs() < 1e-6
            );
            assert!((color[2] - 0.5).abs() < 1e-6);
        } else {
            assert!(color.iter().all(|c| c.is_nan()));
        }
    }
}

#[test]
fn what_cannot_be_sampled_is_an_error() {
    let mesh = sheet(1, |x, y| [x, y, 0.0]);
    let code = |view: View, resolution| sample(&mesh, view, resolution).unwrap_err().code();
    let down = view("-z");
    assert_eq!(code(down, Resolution::Across(1)), "OPTION");
    assert_eq!(code(down, Resolution::Across(usize::MAX)), "TOO_LARGE");
    assert_eq!(code(down, Resolution::Spacing(0.0)), "OPTION");
    assert_eq!(code(down, Resolution::Spacing(1e-9)), "TOO_LARGE");
    assert_eq!(code(View::Along([0.0; 3]), Resolution::Across(9)), "OPTION");
    assert_eq!(
        code(View::Along([0.0, f64::NAN, 1.0]), Resolution::Across(9)),
        "OPTION"
    );
    // Edge-on.
    assert_eq!(code(view("+x"), Resolution::Across(9)), "UNSUPPORTED");
    assert_eq!("top".parse::<View>().unwrap_err().code(), "OPTION");

    let new = |z: f64, triangle| Mesh::new(vec![[0.0, 0.0, z]; 3], vec![triangle]);
    assert!(new(0.0, [0, 1, 2]).is_ok());
    assert!(matches!(
        new(f64::NAN, [0, 1, 2]),
        Err(Error::NotFinite { row: 0, col: 2, .. })
    ));
    assert_eq!(new(0.0, [0, 1, 3]).unwrap_err().code(), "FORMAT");
    assert_eq!(
        Mesh::new(vec![[0.0; 3]], vec![]).unwrap_err().code(),
        "UNSUPPORTED"
    );
    assert_eq!(mesh.with_uvs(vec![[0.0; 2]]).unwrap_err().code(), "SHAPE");
}

#[test]
fn huge_and_tiny_coordinates() {
    for size in [1e-200, 1e200, f64::MAX / 4.0] {
        let mesh = sheet(3, |x, y| [size * x, size * y, size * (x + y)]);
        for view in [view("-z"), View::BestFit] {
            match sample(&mesh, view, Resolution::Across(10)) {
                Ok(samples) => assert!((0..20).any(|i| samples.hit(i).is_some())),
                Err(error) => assert!(!error.code().is_empty()),
            }
        }
    }
}
