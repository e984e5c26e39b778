//! Depth cameras: known surfaces, intersected with every pixel's ray, have to come back.

use developable::{Depth, HeightImage, Intrinsics, Mesh, Resolution, Samples, View, sample};

const WIDTH: usize = 80;
const HEIGHT: usize = 60;

/// Off centre, and with pixels that are not square.
fn camera() -> Intrinsics {
    Intrinsics::new(90.0, 110.0, 37.5, 31.0)
}

type Point = [f64; 3];

fn dot(a: Point, b: Point) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The way along the ray of a pixel on which one goes 1 ahead: x to the right, y up, z backwards.
fn ray(i: usize) -> Point {
    let (col, row) = ((i % WIDTH) as f64, (i / WIDTH) as f64);
    [(col - 37.5) / 90.0, (31.0 - row) / 110.0, -1.0]
}

/// The image of a surface that each ray meets at so many times its length, or not at all.
fn image(meets: impl Fn(Point) -> Option<f64>, depth: Depth) -> HeightImage {
    let value = |i: usize| {
        let t = meets(ray(i)).unwrap_or(0.0);
        if depth == Depth::Ray {
            t * dot(ray(i), ray(i)).sqrt()
        } else {
            t
        }
    };
    let values = (0..WIDTH * HEIGHT).map(value).collect();
    HeightImage::new(WIDTH, HEIGHT, values).unwrap()
}

/// A plane that the camera sees at a slant: no axis is a symmetry.
const NORMAL: Point = [0.36, 0.48, 0.8];
const AWAY: f64 = -3.0;

fn plane(ray: Point) -> Option<f64> {
    Some(AWAY / dot(NORMAL, ray))
}

const CENTRE: Point = [0.3, -0.2, -5.0];

/// The nearer side of a ball of radius 1.5.
fn ball(ray: Point) -> Option<f64> {
    let (a, b) = (dot(ray, ray), dot(ray, CENTRE));
    let root = b * b - a * (dot(CENTRE, CENTRE) - 2.25);
    (root > 0.0).then(|| (b - root.sqrt()) / a)
}

fn heights(samples: &Samples) -> Vec<Point> {
    let field = samples.heightfield();
    let lattice = field.lattice();
    (0..lattice.rows())
        .flat_map(|r| (0..lattice.cols()).map(move |c| (r, c)))
        .map(|(r, c)| {
            let [x, y] = lattice.position(r, c);
            [x, y, field.height(r, c)]
        })
        .filter(|p| p[2].is_finite())
        .map(|p| samples.frame().to_world(p))
        .collect()
}

fn see(mesh: &Mesh, view: View) -> Samples {
    sample(mesh, view, Resolution::Across(70)).unwrap()
}

const AHEAD: View = View::Along([0.0, 0.0, -1.0]);

#[test]
fn pixels_are_vertices_on_their_rays() {
    for (depth, scale) in [
        (Depth::Planar, 1.0),
        (Depth::Ray, 1.0),
        (Depth::Planar, 0.001),
    ] {
        let values = image(plane, depth).scaled(1.0 / scale).unwrap();
        let camera = Intrinsics {
            depth,
            depth_scale: scale,
            ..camera()
        };
        let mesh = camera.back_project(&values).unwrap();
        assert_eq!(mesh.positions().len(), WIDTH * HEIGHT);
        assert_eq!(mesh.triangles().len(), 2 * (WIDTH - 1) * (HEIGHT - 1));
        for (i, p) in mesh.positions().iter().enumerate() {
            let expected = ray(i).map(|v| v * plane(ray(i)).unwrap());
            assert!((0..3).all(|k| (p[k] - expected[k]).abs() < 1e-12), "{i}");
        }
        // Left and right, up and down: the first pixel is at the top left.
        let [first, last] = [mesh.positions()[0], mesh.positions()[WIDTH * HEIGHT - 1]];
        assert!(first[0] < 0.0 && first[1] > 0.0 && last[0] > 0.0 && last[1] < 0.0);
        let uvs = mesh.uvs().unwrap();
        let close = |a: [f32; 2], b: [f32; 2]| (0..2).all(|k| (a[k] - b[k]).abs() < 1e-6);
        assert!(close(uvs[0], [0.5 / 80.0, 59.5 / 60.0]));
        assert!(close(uvs[WIDTH * HEIGHT - 1], [79.5 / 80.0, 0.5 / 60.0]));
        // Every triangle faces the camera.
        for t in mesh.triangles() {
            let [a, b, c] = t.map(|i| mesh.positions()[i as usize]);
            let (u, v): (Point, Point) = (
                std::array::from_fn(|k| b[k] - a[k]),
                std::array::from_fn(|k| c[k] - a[k]),
            );
            let normal = [
                u[1] * v[2] - u[2] * v[1],
                u[2] * v[0] - u[0] * v[2],
                u[0] * v[1] - u[1] * v[0],
            ];
            assert!(dot(normal, a) < 0.0);
        }
    }
}

#[test]
fn a_plane_is_a_plane_along_the_axis_and_straight_on() {
    let mesh = camera().back_project(&image(plane, Depth::Planar)).unwrap();
    for view in [AHEAD, View::BestFit, View::Along([-0.3, -0.2, -1.0])] {
        let points = heights(&see(&mesh, view));
        assert!(points.len() > 1000);
        for p in points {
            assert!((dot(NORMAL, p) - AWAY).abs() < 1e-9, "{p:?}");
        }
    }
    let best = see(&mesh, View::BestFit);
    let towards = best.frame().towards;
    assert!(
        (0..3).all(|k| (towards[k] - NORMAL[k]).abs() < 1e-9),
        "{towards:?}"
    );
    let flat = best
        .heightfield()
        .heights()
        .iter()
        .filter(|z| z.is_finite());
    assert!(flat.into_iter().all(|z| (z - AWAY).abs() < 1e-9));
}

#[test]
fn a_ball_is_a_ball() {
    for depth in [Depth::Planar, Depth::Ray] {
        let camera = Intrinsics { depth, ..camera() };
        let mesh = camera.back_project(&image(ball, depth)).unwrap();
        for view in [AHEAD, View::Along([-0.4, 0.2, -1.0])] {
            let points = heights(&see(&mesh, view));
            assert!(points.len() > 700, "{}", points.len());
            for p in points {
                let away: Point = std::array::from_fn(|k| p[k] - CENTRE[k]);
                let radius = dot(away, away).sqrt();
                // Chords of triangles cut the ball; the more the nearer to its outline.
                assert!(radius < 1.5 + 1e-9 && radius > 1.5 - 0.03, "{radius}");
            }
        }
    }
}

#[test]
fn jumps_are_not_bridged() {
    let step = |ray: Point| Some(if ray[0] < 0.0 { 1.0 } else { 2.0 });
    let image_of_step = image(step, Depth::Planar);
    let bare = Intrinsics {
        margin: 0,
        ..camera()
    };
    let mesh = bare.back_project(&image_of_step).unwrap();
    let far = |i: &u32| mesh.positions()[*i as usize][2] < -1.5;
    let sides = mesh
        .triangles()
        .iter()
        .map(|t| t.iter().filter(|i| far(i)).count());
    assert!(sides.into_iter().all(|n| n == 0 || n == 3));
    // One column of squares less.
    assert_eq!(mesh.triangles().len(), 2 * (WIDTH - 2) * (HEIGHT - 1));
    // Two pixels less on either side.
    let mesh = camera().back_project(&image_of_step).unwrap();
    assert_eq!(mesh.triangles().len(), 2 * (WIDTH - 6) * (HEIGHT - 1));

    // A surface is lost where it is steeper than ten to one against the line of sight.
    let slope = |steep: f64| move |ray: Point| Some(1.0 / (1.0 - steep * (ray[0] - 0.1)));
    let narrow = |steep: f64| {
        let image = image(slope(steep), Depth::Planar);
        let near = |i: usize| (ray(i)[0] - 0.1).abs() < 0.05 && ray(i)[1].abs() < 0.05;
        let keep: Vec<u8> = (0..WIDTH * HEIGHT).map(|i| near(i).into()).collect();
        camera().back_project(&image.masked(&keep).unwrap())
    };
    assert!(narrow(5.0).is_ok());
    assert_eq!(narrow(16.0).unwrap_err().code(), "UNSUPPORTED");
}

#[test]
fn what_has_no_depth_is_left_out() {
    let mut values = image(plane, Depth::Planar).into_values();
    // One pixel each of what is no depth, far from one another.
    let at = |row: usize, col: usize| row * WIDTH + col;
    for (i, none) in [(at(9, 9), 0.0), (at(9, 40), f64::NAN), (at(40, 9), -2.0)] {
        values[i] = none;
    }
    let image = HeightImage::new(WIDTH, HEIGHT, values).unwrap();
    let mesh = camera().back_project(&image).unwrap();
    // Each takes part in four squares, of which a triangle each is left.
    assert_eq!(mesh.triangles().len(), 2 * (WIDTH - 1) * (HEIGHT - 1) - 12);
    let used = |i: usize| mesh.triangles().iter().flatten().any(|v| *v as usize == i);
    assert!(!used(at(9, 9)) && !used(at(9, 40)) && !used(at(40, 9)) && used(at(9, 10)));
}

#[test]
fn cameras_that_cannot_be_are_refused() {
    let image = image(plane, Depth::Planar);
    let refused = |change: fn(&mut Intrinsics)| {
        let mut camera = camera();
        change(&mut camera);
        camera.back_project(&image).unwrap_err()
    };
    let message = |change| refused(change).to_string();
    assert!(message(|c| c.fx = 0.0).contains("`fx`"));
    assert!(message(|c| c.fy = -1.0).contains("`fy`"));
    assert!(message(|c| c.cx = f64::NAN).contains("`cx`"));
    assert!(message(|c| c.cy = f64::INFINITY).contains("`cy`"));
    assert!(message(|c| c.depth_scale = 0.0).contains("`depth_scale`"));
    assert!(message(|c| c.cx = 80.0).contains("images of another size"));
    assert!(message(|c| c.size = Some([60, 80])).contains("lies on its side"));
    // Nothing overflows into a panic.
    for scale in [1e-320, 1e-300, 1e300, 1e308] {
        let mut camera = camera();
        camera.depth_scale = scale;
        if let Err(error) = camera.back_project(&image) {
            assert!(["NOT_FINITE", "UNSUPPORTED"].contains(&error.code()));
        }
    }
    let nothing = HeightImage::new(80, 60, vec![0.0; 4800]).unwrap();
    let error = camera().back_project(&nothing).unwrap_err();
    assert!(
        error.to_string().contains("no three neighbouring pixels"),
        "{error}"
    );
}
