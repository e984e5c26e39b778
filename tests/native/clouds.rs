//! Point clouds: what is seen of them, and files of them.

use developable::{Frame, Mesh, Resolution, Samples, View, sample};

use crate::native::common::Random;

/// Points over a square from 0 to `side`, about so many for each unit of area, the same each time.
fn scattered(side: f64, density: f64, height: impl Fn(f64, f64) -> f64) -> Vec<[f64; 3]> {
    let mut random = Random::new(1);
    let mut share = || random.uniform();
    (0..(side * side * density) as usize)
        .map(|_| {
            let (x, y) = (side * share(), side * share());
            [x, y, height(x, y)]
        })
        .collect()
}

fn look(points: Vec<[f64; 3]>, view: View) -> (Mesh, Samples) {
    let mesh = Mesh::cloud(points).unwrap();
    let samples = sample(&mesh, view, Resolution::Spacing(1.0)).unwrap();
    (mesh, samples)
}

/// Position and height of every vertex of the lattice.
fn vertices(samples: &Samples) -> impl Iterator<Item = ([f64; 2], f64)> {
    let field = samples.heightfield();
    let lattice = field.lattice();
    (0..lattice.rows())
        .flat_map(move |r| (0..lattice.cols()).map(move |c| (r, c)))
        .map(move |(r, c)| (lattice.position(r, c), field.height(r, c)))
}

const DOWN: View = View::Along([0.0, 0.0, -1.0]);

#[test]
fn a_tilted_plane_is_met_exactly_and_reaches_its_outline() {
    let tilt = |x: f64, y: f64| 3.0 + 0.5 * x - 0.25 * y;
    let (_, samples) = look(scattered(20.0, 6.0, tilt), DOWN);
    let mut seen = 0;
    for ([x, y], z) in vertices(&samples) {
        // How far inside of the square.
        let inside = x.min(y).min(20.0 - x).min(20.0 - y);
        if z.is_finite() {
            seen += 1;
            assert!((z - tilt(x, y)).abs() < 1e-9, "{x} {y} {z}");
            assert!(inside > -0.5, "{x} {y}");
        } else {
            assert!(inside < 0.7, "{x} {y}");
        }
    }
    assert!(seen > 400);
}

#[test]
fn every_view_has_its_axes() {
    // Points of 10x + 11y + 9.5z = 1, seen from all sides.
    let plane = |x: f64, y: f64| (1.0 - 10.0 * x - 11.0 * y) / 9.5;
    let mesh = Mesh::cloud(scattered(8.0, 60.0, plane)).unwrap();
    for name in ["-x", "+x", "-y", "+y", "-z", "+z", "best-fit"] {
        let samples = sample(&mesh, name.parse().unwrap(), Resolution::Spacing(0.5)).unwrap();
        let seen: Vec<_> = vertices(&samples).filter(|(_, z)| z.is_finite()).collect();
        assert!(seen.len() > 60, "{name}");
        for ([x, y], z) in seen {
            let [x, y, z] = samples.frame().to_world([x, y, z]);
            assert!((10.0 * x + 11.0 * y + 9.5 * z - 1.0).abs() < 1e-7, "{name}");
            assert!(x > -0.6 && y > -0.6 && x < 8.6 && y < 8.6, "{name}");
        }
    }
    let best = View::BestFit.frame(&mesh).unwrap().towards;
    let normal = [10.0, 11.0, 9.5].map(|v| v / 311.25f64.sqrt());
    assert!(
        (0..3).all(|k| (best[k] - normal[k]).abs() < 1e-9),
        "{best:?}"
    );
}

#[test]
fn a_sphere_is_met_to_second_order() {
    let radius: f64 = 40.0;
    let cap = |x: f64, y: f64| (radius * radius - (x - 10.0).powi(2) - (y - 10.0).powi(2)).sqrt();
    let (_, samples) = look(scattered(20.0, 8.0, cap), DOWN);
    for ([x, y], z) in vertices(&samples).filter(|(_, z)| z.is_finite()) {
        assert!((z - cap(x, y)).abs() < 1.0 / radius, "{x} {y} {z}");
    }
}

#[test]
fn holes_stay_holes() {
    let away = |x: f64, y: f64| (x - 10.0).hypot(y - 10.0);
    let points = scattered(20.0, 8.0, |x, y| x + y);
    let points = points
        .into_iter()
        .filter(|[x, y, _]| away(*x, *y) > 4.0)
        .collect();
    let (_, samples) = look(points, DOWN);
    let hole: Vec<_> = vertices(&samples)
        .filter(|([x, y], _)| away(*x, *y) < 3.5)
        .collect();
    assert!(hole.len() > 30 && hole.iter().all(|(_, z)| z.is_nan()));
    assert!(vertices(&samples).any(|([x, y], z)| away(x, y) < 4.5 && z.is_finite()));
}

#[test]
fn what_is_behind_is_out_of_sight() {
    let mut points = scattered(20.0, 6.0, |_, _| 0.0);
    points.extend(
        scattered(20.0, 6.0, |_, _| 9.0)
            .into_iter()
            .filter(|p| p[0] < 10.0),
    );
    let mesh = Mesh::cloud(points).unwrap();
    let back: View = "+z".parse().unwrap();
    for (view, front) in [(DOWN, 9.0), (back, 0.0)] {
        let samples = sample(&mesh, view, Resolution::Spacing(1.0)).unwrap();
        for ([x, y], z) in vertices(&samples).filter(|(_, z)| z.is_finite()) {
            let [x, _, z] = samples.frame().to_world([x, y, z]);
            let nearer_edge = (x - 10.0).abs() < 1.0;
            let expected = if x < 10.0 { front } else { 0.0 };
            assert!(nearer_edge || (z - expected).abs() < 1e-9, "{x} {z}");
        }
    }
}

#[test]
fn colours_are_the_nearest_points() {
    let points = scattered(6.0, 5.0, |x, _| x / 3.0);
    let (mesh, samples) = look(points.clone(), DOWN);
    let colors: Vec<[f32; 3]> = (0..points.len()).map(|i| [i as f32, 0.5, 0.0]).collect();
    let carried = samples.carry(&mesh, &colors).unwrap();
    for (i, ([x, y], z)) in vertices(&samples).enumerate() {
        if z.is_nan() {
            assert!(carried[i][0].is_nan() && samples.hit(i).is_none());
            continue;
        }
        let away = |p: &[f64; 3]| (p[0] - x).hypot(p[1] - y);
        let nearest = (0..points.len())
            .min_by(|a, b| away(&points[*a]).total_cmp(&away(&points[*b])))
            .unwrap();
        assert_eq!(carried[i], colors[nearest]);
        assert_eq!(samples.hit(i).unwrap().index, nearest);
    }
}

#[test]
fn degenerate_clouds() {
    let code = |points: Vec<[f64; 3]>, view: View| {
        Mesh::cloud(points)
            .and_then(|mesh| sample(&mesh, view, Resolution::Across(9)))
            .map_or_else(|e| e.code(), |_| "OK")
    };
    assert_eq!(code(vec![], DOWN), "UNSUPPORTED");
    assert_eq!(code(vec![[0.0, f64::NAN, 0.0]], DOWN), "NOT_FINITE");
    assert_eq!(code(vec![[1.0; 3]; 5], DOWN), "UNSUPPORTED");
    assert_eq!(code(vec![[1.0; 3]; 5], View::BestFit), "UNSUPPORTED");
    // A line is seen as what it is, without a plane.
    let line = (0..50).map(|i| [f64::from(i) / 5.0, 0.0, 1.5]).collect();
    let (_, samples) = look(line, DOWN);
    let heights: Vec<_> = vertices(&samples).filter(|(_, z)| z.is_finite()).collect();
    assert!(heights.len() > 5 && heights.iter().all(|(_, z)| (z - 1.5).abs() < 1e-12));
    // Far from the origin, and of any size.
    for size in [1e-200, 1e-6, 1e6, 1e150] {
        let points = scattered(20.0, 6.0, |x, y| x - y);
        let points = points.iter().map(|p| p.map(|v| size * (v + 1e3))).collect();
        let mesh = Mesh::cloud(points).unwrap();
        let samples = sample(&mesh, DOWN, Resolution::Across(15)).unwrap();
        for ([x, y], z) in vertices(&samples).filter(|(_, z)| z.is_finite()) {
            assert!(
                (z - (x - y + 1e3 * size)).abs() < 1e-6 * size,
                "{size}: {x} {y} {z}"
            );
        }
    }
    let frame = Frame::default();
    assert_eq!(frame.view([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
}

#[cfg(feature = "meshes")]
mod files {
    use developable::files::meshes::{read_mesh, write_ply};

    #[test]
    fn files_without_faces_are_clouds() {
        let obj =
            "# scan\nv 0 0 0.5 1 0 0\n v 1 0 0.25 0 1 0\nv\t0 1 0.125 0 0 1\nvn 0 0 1\nl 1 2\n";
        let mesh = read_mesh(obj.as_bytes(), None).unwrap();
        assert!(mesh.is_cloud());
        assert_eq!(
            mesh.positions(),
            [[0.0, 0.0, 0.5], [1.0, 0.0, 0.25], [0.0, 1.0, 0.125]]
        );
        assert_eq!(
            mesh.colors().unwrap(),
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        );
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/meshes/points.ply");
        let mesh = read_mesh(&std::fs::read(path).unwrap(), None).unwrap();
        assert!(mesh.is_cloud());
        assert_eq!(mesh.positions()[2], [3.5, 2.0, 1.0]);
        assert_eq!(mesh.colors().unwrap()[2], [0.0, 0.0, 1.0]);
        // And back.
        let again = read_mesh(&write_ply(&mesh).unwrap(), None).unwrap();
        assert_eq!(again, mesh);
    }

    #[test]
    fn nothing_is_no_cloud() {
        for empty in [
            "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n\
             property float z\nend_header\n",
            "v 1 2\n",
        ] {
            assert!(read_mesh(empty.as_bytes(), None).is_err(), "{empty}");
        }
    }
}

#[test]
fn too_few_points_for_a_vertex_with_six_neighbours_are_said() {
    let mesh = |count| Mesh::cloud(scattered(1.0, count, |x, y| x + y)).unwrap();
    let error = sample(&mesh(3.0), DOWN, Resolution::Auto).unwrap_err();
    assert_eq!(
        error.to_string(),
        "point cloud: 3 points are too few for a surface; give more of them"
    );
    assert!(sample(&mesh(60.0), DOWN, Resolution::Auto).is_ok());
}
