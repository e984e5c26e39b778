//! A phone's depths and photo of a bent page: where on the page is what the flat image shows?

use std::collections::HashSet;

use crate::native::common::similarity;
use developable::dewarp::{DewarpOptions, Registration, Verdict, WarpMap};
use developable::unroll::{UnrollOptions, Unrolling, unroll};
use developable::{
    Camera, Distortion, Error, HeightImage, Heightfield, Intrinsics, Pose, Resolution, View, sample,
};

type Point = [f64; 3];

/// An A4 page in metres, curled about an axis along its height, tilted before a camera.
struct Scene {
    radius: f64,
    tilt: f64,
    away: f64,
    lens: Distortion,
    /// By how much the page is turned before the camera, in radians.
    roll: f64,
    /// Where the camera of the photo is beside that of the depths: to its right, in metres.
    baseline: f64,
}

const PAGE: [f64; 2] = [0.21, 0.297];
const DEPTHS: [usize; 2] = [256, 192];
const PHOTO: [usize; 2] = [1600, 1200];
const FOCAL: f64 = 205.0;

/// A phone's: the numbers are for the depths.
fn intrinsics(lens: Distortion) -> Intrinsics {
    Intrinsics {
        size: Some(DEPTHS),
        distortion: lens,
        ..Intrinsics::new(FOCAL, FOCAL, 126.0, 97.0)
    }
}

impl Scene {
    fn new(radius: f64, tilt: f64) -> Self {
        Scene {
            radius,
            tilt: tilt.to_radians(),
            away: 0.43,
            lens: Distortion::default(),
            roll: 0.0,
            baseline: 0.0,
        }
    }

    /// The point that a ray from `origin` meets first, as a place on the page: its arc and its height.
    /// The axes are x to the right, y down, z ahead.
    fn meets(&self, origin: Point, ray: Point) -> Option<(f64, [f64; 2])> {
        // Into the page's own axes: turned about the horizontal.
        let (sin, cos) = self.tilt.sin_cos();
        let (roll_sin, roll_cos) = self.roll.sin_cos();
        let turn = |[x, y, z]: Point| {
            let (x, y) = (roll_cos * x + roll_sin * y, roll_cos * y - roll_sin * x);
            [x, cos * y + sin * z, cos * z - sin * y]
        };
        let o = turn([origin[0], origin[1], origin[2] - self.away]);
        let d = turn(ray);
        // The cylinder's axis is behind the page: x² + (z − r)² = r².
        let centre = self.radius;
        let a = d[0] * d[0] + d[2] * d[2];
        let b = o[0] * d[0] + (o[2] - centre) * d[2];
        let c = o[0] * o[0] + (o[2] - centre).powi(2) - self.radius.powi(2);
        let root = (b * b - a * c).sqrt();
        let t = (-b - root) / a;
        let p: Point = std::array::from_fn(|k| o[k] + t * d[k]);
        let arc = self.radius * p[0].atan2(centre - p[2]);
        let inside = arc.abs() <= PAGE[0] / 2.0 && p[1].abs() <= PAGE[1] / 2.0;
        (root.is_finite() && inside).then_some((t, [arc, p[1]]))
    }

    /// The ray of a pixel of an image `scale` times as fine as the depths, by bisection of Brown's
    /// polynomial along the radius (there is no tangential part).
    fn ray(&self, [col, row]: [f64; 2], scale: f64) -> Point {
        let x = ((col + 0.5) / scale - 0.5 - 126.0) / FOCAL;
        let y = ((row + 0.5) / scale - 0.5 - 97.0) / FOCAL;
        let seen = x.hypot(y);
        let lens = |r: f64| r * (1.0 + self.lens.k1 * r * r + self.lens.k2 * r.powi(4));
        let (mut low, mut high) = (0.0, 2.0 * seen);
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            if lens(middle) < seen {
                low = middle
            } else {
                high = middle
            }
        }
        let stretch = if seen > 0.0 { low / seen } else { 1.0 };
        [x * stretch, y * stretch, 1.0]
    }

    /// The place in the photo of a place on the page, by bisection from what all pixels see.
    fn seen_at(&self, [s, t]: [f64; 2]) -> [f64; 2] {
        let scale = PHOTO[0] as f64 / DEPTHS[0] as f64;
        let wanted = [PAGE[0] * (s - 0.5), PAGE[1] * (t - 0.5)];
        let off = |pixel: [f64; 2]| {
            let found = self.meets([0.0; 3], self.ray(pixel, scale));
            found.map_or(f64::INFINITY, |(_, [x, y])| {
                (x - wanted[0]).hypot(y - wanted[1])
            })
        };
        let (mut best, mut step) = ([0.0; 2], 40.0);
        for i in 0..40 * 30 {
            let pixel = [i % 40, i / 40].map(|k| k as f64 * step);
            best = if off(pixel) < off(best) { pixel } else { best };
        }
        while step > 0.01 {
            for i in 0..9 {
                let pixel = [
                    best[0] + (i % 3 - 1) as f64 * step,
                    best[1] + (i / 3 - 1) as f64 * step,
                ];
                best = if off(pixel) < off(best) { pixel } else { best };
            }
            step *= 0.7;
        }
        best
    }

    /// The photo's place of each corner of the page, or of a part of it this far from its edges.
    fn corners(&self, within: f64) -> Vec<[f64; 2]> {
        let [low, high] = [within, 1.0 - within];
        let shares = [[low, low], [high, low], [high, high], [low, high]];
        shares.map(|share| self.seen_at(share)).to_vec()
    }

    fn depths(&self) -> HeightImage {
        let value = |i: usize| {
            let at = [(i % DEPTHS[0]) as f64, (i / DEPTHS[0]) as f64];
            self.meets([0.0; 3], self.ray(at, 1.0))
                .map_or(0.0, |(t, _)| t)
        };
        let values = (0..DEPTHS[0] * DEPTHS[1]).map(value).collect();
        HeightImage::new(DEPTHS[0], DEPTHS[1], values).unwrap()
    }

    fn camera(&self) -> Camera {
        let mut pose = Pose::default();
        pose.translation[0] = -self.baseline;
        Camera::new(intrinsics(self.lens)).at(pose)
    }

    /// What the depths give, and how they are turned.
    fn surface(&self, view: View) -> (Heightfield, developable::Frame) {
        let mesh = intrinsics(self.lens).back_project(&self.depths()).unwrap();
        let seen = sample(&mesh, view, Resolution::Auto).unwrap();
        (seen.heightfield().clone(), *seen.frame())
    }

    /// Distances between places on the page and in the flat image after the best similarity, root of
    /// the mean square, in shares of the page's width.
    fn error(&self, map: &WarpMap) -> f64 {
        let scale = PHOTO[0] as f64 / DEPTHS[0] as f64;
        let origin = [self.baseline, 0.0, 0.0];
        let mut pairs = Vec::new();
        for (i, place) in map.places().iter().enumerate() {
            if place[0].is_nan() {
                continue;
            }
            let ray = self.ray(place.map(f64::from), scale);
            if let Some((_, truth)) = self.meets(origin, ray) {
                let flat = [(i % map.width()) as f64, (i / map.width()) as f64];
                pairs.push((flat, truth));
            }
        }
        assert!(pairs.len() > 10_000, "{}", pairs.len());
        similarity(&pairs) / PAGE[0]
    }
}

fn map_of_depths(scene: &Scene, depths: &HeightImage, view: View) -> (WarpMap, Unrolling) {
    let mesh = intrinsics(scene.lens).back_project(depths).unwrap();
    let seen = sample(&mesh, view, Resolution::Auto).unwrap();
    let sheet = unroll(seen.heightfield(), &UnrollOptions::default()).unwrap();
    let registration = Registration::Camera(scene.camera(), *seen.frame());
    let map = WarpMap::new(&sheet, registration, PHOTO, &DewarpOptions::default()).unwrap();
    (map, sheet)
}

fn map_of(scene: &Scene, view: View) -> (WarpMap, Verdict) {
    let (map, sheet) = map_of_depths(scene, &scene.depths(), view);
    let verdict = map.verdict(sheet.report());
    (map, verdict)
}

#[test]
fn a_tilted_curled_page_is_where_the_camera_saw_it() {
    for view in [
        View::BestFit,
        View::Along([0.0, 0.0, -1.0]),
        View::Along([0.2, 0.3, -1.0]),
    ] {
        let scene = Scene::new(0.12, 25.0);
        let (map, verdict) = map_of(&scene, view);
        assert!(scene.error(&map) < 0.002, "{view:?}: {}", scene.error(&map));
        assert_eq!(verdict, Verdict::Unrolled);
    }
}

#[test]
fn the_lens_and_the_place_of_the_photos_camera_count() {
    let mut scene = Scene::new(0.12, 20.0);
    scene.lens = Distortion {
        k1: 0.12,
        k2: -0.05,
        ..Distortion::default()
    };
    scene.baseline = 0.025;
    let (map, _) = map_of(&scene, View::BestFit);
    let right = scene.error(&map);
    assert!(right < 0.002, "{right}");
    // Left out, either shows.
    for (lens, baseline) in [(Distortion::default(), 0.025), (scene.lens, 0.0)] {
        let (surface, frame) = scene.surface(View::BestFit);
        let sheet = unroll(&surface, &UnrollOptions::default()).unwrap();
        let wrong = Scene {
            lens,
            baseline,
            ..scene
        }
        .camera();
        let registration = Registration::Camera(wrong, frame);
        let map = WarpMap::new(&sheet, registration, PHOTO, &DewarpOptions::default()).unwrap();
        let error = scene.error(&map);
        assert!(error > 2.0 * right, "{error} {right}");
    }
}

#[test]
fn a_page_is_flat_only_if_the_photo_is_right_as_it_is() {
    let flat = 1e4;
    let (_, facing) = map_of(&Scene::new(flat, 0.0), View::BestFit);
    assert_eq!(facing, Verdict::Flat);
    // A plane that is seen at a slant: its photo is a trapezium.
    let tilted = Scene::new(flat, 20.0);
    let (map, verdict) = map_of(&tilted, View::BestFit);
    assert_eq!(verdict, Verdict::Unrolled);
    assert!(tilted.error(&map) < 0.001, "{}", tilted.error(&map));
}

#[test]
fn texture_coordinates_are_as_good() {
    let scene = Scene::new(0.12, 25.0);
    let mesh = intrinsics(scene.lens)
        .back_project(&scene.depths())
        .unwrap();
    let seen = sample(&mesh, View::BestFit, Resolution::Auto).unwrap();
    let uvs = seen.carry(&mesh, mesh.uvs().unwrap()).unwrap();
    let sheet = unroll(seen.heightfield(), &UnrollOptions::default()).unwrap();
    let registration = Registration::Uvs(&uvs);
    let map = WarpMap::new(&sheet, registration, PHOTO, &DewarpOptions::default()).unwrap();
    assert!(scene.error(&map) < 0.002, "{}", scene.error(&map));
}

#[test]
fn cameras_that_cannot_be_are_refused() {
    let scene = Scene::new(0.12, 25.0);
    let (surface, frame) = scene.surface(View::BestFit);
    let sheet = unroll(&surface, &UnrollOptions::default()).unwrap();
    let error = |camera: Camera, photo: [usize; 2]| {
        let registration = Registration::Camera(camera, frame);
        let options = DewarpOptions::default();
        WarpMap::new(&sheet, registration, photo, &options)
            .unwrap_err()
            .to_string()
    };
    let camera = scene.camera();
    assert!(error(camera, [1200, 1600]).contains("lies on its side"));
    assert!(error(camera, [1600, 900]).contains("another part of the scene"));
    let mut outside = camera;
    outside.intrinsics.cx = 800.0;
    assert!(error(outside, PHOTO).contains("images of another size"));
    let mirrored = Pose {
        rotation: [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        ..Pose::default()
    };
    assert!(error(camera.at(mirrored), PHOTO).contains("rotation"));
    let mut behind = Pose::default();
    behind.translation[2] = -2.0;
    assert!(error(camera.at(behind), PHOTO).contains("the camera looks elsewhere"));
    assert!(matches!(
        Intrinsics::with_field_of_view(180.0, PHOTO),
        Err(Error::Option { .. })
    ));
}

#[test]
fn a_field_of_view_is_across_the_longer_side() {
    let camera = Intrinsics::with_field_of_view(90.0, [400, 300]).unwrap();
    assert!((camera.fx - 200.0).abs() < 1e-12 && camera.fx == camera.fy);
    // The middle of the image, and its right edge at 45°.
    assert_eq!(camera.project([0.0, 0.0, -1.0]), Some([199.5, 149.5]));
    let [col, row] = camera.project([2.0, 0.0, -2.0]).unwrap();
    assert!((col - 399.5).abs() < 1e-9 && (row - 149.5).abs() < 1e-9);
    // Up is towards lower rows; behind is nowhere.
    assert!(camera.project([0.0, 1.0, -2.0]).unwrap()[1] < 149.0);
    assert_eq!(camera.project([0.0, 0.0, 1.0]), None);
}

/// Sensors see a mixture of page and table at the page's outline.
#[test]
fn flying_pixels_are_taken_away() {
    let scene = Scene::new(0.12, 0.0);
    let (page, table) = (scene.depths(), 0.54);
    let [width, height] = DEPTHS;
    let there = |col: usize, row: usize| page.values()[row * width + col] > 0.0;
    let depth = |col: usize, row: usize| {
        if there(col, row) {
            page.values()[row * width + col]
        } else {
            table
        }
    };
    let values: Vec<f64> = (0..width * height)
        .map(|i| {
            let (col, row) = (i % width, i / width);
            let inner = (1..width - 1).contains(&col) && (1..height - 1).contains(&row);
            let mut around = vec![depth(col, row)];
            if inner {
                around.extend([
                    depth(col - 1, row),
                    depth(col + 1, row),
                    depth(col, row - 1),
                    depth(col, row + 1),
                ]);
            }
            around.iter().sum::<f64>() / around.len() as f64
        })
        .collect();
    let mixed = HeightImage::new(width, height, values.clone()).unwrap();
    let camera = intrinsics(scene.lens);
    let far_off = |margin: usize| {
        let mesh = Intrinsics { margin, ..camera }
            .back_project(&mixed)
            .unwrap();
        let mut wrong = 0;
        for triangle in mesh.triangles() {
            for v in triangle.map(|v| v as usize) {
                let (col, row) = (v % width, v / width);
                wrong += usize::from((values[v] - depth(col, row)).abs() > 0.005);
            }
        }
        wrong
    };
    assert!(far_off(0) > 100, "{}", far_off(0));
    assert_eq!(far_off(2), 0);
    // Most of the page is still there.
    let mesh = camera.back_project(&mixed).unwrap();
    let mut used = vec![false; width * height];
    for v in mesh.triangles().as_flattened() {
        used[*v as usize] = true;
    }
    let kept = (0..used.len())
        .filter(|i| used[*i] && page.values()[*i] > 0.0)
        .count();
    let all = page.values().iter().filter(|d| **d > 0.0).count();
    assert!(kept as f64 > 0.85 * all as f64, "{kept} of {all}");
    // Cut out along its very outline: the jump is beside what is kept, and shows all the same.
    let keep: Vec<u8> = page.values().iter().map(|d| u8::from(*d > 0.0)).collect();
    let cut = camera.back_project_within(&mixed, &keep).unwrap();
    let used: HashSet<u32> = cut.triangles().as_flattened().iter().copied().collect();
    assert!(used.iter().all(|v| keep[*v as usize] != 0));
    assert!(
        used.len() as f64 > 0.98 * kept as f64,
        "{} of {kept}",
        used.len()
    );
    let off = |v: &u32| (values[*v as usize] - page.values()[*v as usize]).abs() > 0.005;
    assert!(!used.iter().any(off));
    let masked = camera
        .back_project(&mixed.clone().masked(&keep).unwrap())
        .unwrap();
    assert!(masked.triangles().as_flattened().iter().any(off));
    let error = camera.back_project_within(&mixed, &keep[1..]).unwrap_err();
    assert_eq!(error.code(), "SHAPE");
}

/// Between the nodes of a coarse grid the map is what it was, at the border of the sheet as well.
#[test]
fn a_grid_of_some_thousand_points_says_the_same() {
    let (map, _) = map_of(&Scene::new(0.12, 25.0), View::BestFit);
    let grid = map.grid(0.25, 20_000).unwrap();
    assert!(grid.places.len() < 5000, "{}", grid.places.len());
    let (mut squares, mut largest, mut count) = (0.0f64, 0.0f64, 0.0);
    for (i, place) in map.places().iter().enumerate() {
        if place[0].is_nan() {
            continue;
        }
        let pixel = [(i % map.width()) as f64, (i / map.width()) as f64];
        let [x, y] = grid.at(pixel).unwrap();
        let error = (x - f64::from(place[0])).hypot(y - f64::from(place[1]));
        squares += error * error;
        largest = largest.max(error);
        count += 1.0;
    }
    assert!(largest <= 0.25, "{largest}");
    // And what it says of itself is so.
    assert!((grid.maximum - largest).abs() < 1e-6);
    assert!((grid.rms - (squares / count).sqrt()).abs() < 1e-6);
    // Beside the page there is nothing, and farther than a step from a part of it.
    assert!(grid.at([-1.0, 5.0]).is_none());
    let [width, height] = PHOTO.map(|n| n as f64);
    let half = [[0.0, 0.0], [width, 0.0], [0.0, height]];
    let corner = map.clone().crop(&half).unwrap();
    let grid = corner.grid(0.25, 20_000).unwrap();
    let last = [corner.width() as f64 - 1.0, corner.height() as f64 - 1.0];
    assert!(grid.maximum < 0.25 && grid.at(last).is_none() && grid.at([9.0, 9.0]).is_some());
    assert!(map.grid(0.0, 100).is_err() && map.grid(0.25, 3).is_err());
    // Too few are as good as they can be, and say so.
    let few = map.grid(1e-3, 200).unwrap();
    assert!(few.places.len() <= 200 && few.maximum > 1e-3);
}

/// The sheet ends with the last whole triangles; what is wanted ends at the page's corners.
#[test]
fn a_page_is_cut_out_as_a_rectangle_to_its_very_corners() {
    let scene = Scene::new(0.12, 25.0);
    // Two pixels less of the page, as beside its outline depths are not to be trusted.
    let depths = scene.depths();
    let there = |i: usize| depths.values().get(i).is_some_and(|depth| *depth > 0.0);
    let inner = |i: usize| {
        let way = 2 * DEPTHS[0];
        [i + 2, i - 2, i + way, i - way].into_iter().all(there)
    };
    let keep: Vec<u8> = (0..depths.values().len())
        .map(|i| u8::from(there(i) && inner(i)))
        .collect();
    let (map, _) = map_of_depths(&scene, &depths.masked(&keep).unwrap(), View::BestFit);
    let corners = scene.corners(0.002);
    let page = map.clone().cut(Some(&corners), false, true).unwrap();
    assert!(page.places().iter().all(|place| !place[0].is_nan()));
    let size = [page.width(), page.height()].map(|n| n as f64 / page.resolution());
    for k in 0..2 {
        let wrong = size[k] / (0.996 * PAGE[k]) - 1.0;
        assert!(wrong.abs() < 0.006, "{size:?}");
        // The sheet itself is shorter by more.
        let bare = [map.width(), map.height()][k] as f64 / map.resolution();
        assert!(bare < 0.975 * PAGE[k], "{bare}");
    }
    assert!(scene.error(&page) < 0.003, "{}", scene.error(&page));
    // Where the sheet was continued it is right to a millimetre, too.
    let scale = PHOTO[0] as f64 / DEPTHS[0] as f64;
    for (col, row) in [(3, 3), (page.width() - 4, page.height() - 4)] {
        let place = page.places()[row * page.width() + col].map(f64::from);
        let (_, found) = scene.meets([0.0; 3], scene.ray(place, scale)).unwrap();
        let at = [col, row].map(|n| (n as f64 + 0.5) / page.resolution());
        for k in 0..2 {
            let wanted = at[k] + 0.002 * PAGE[k] - 0.5 * PAGE[k];
            assert!((found[k] - wanted).abs() < 0.0012, "{found:?} {at:?}");
        }
    }
    // Without the rectangle it ends at the straight lines between the corners on the sheet.
    let cut = map.clone().crop(&corners).unwrap();
    let there = cut
        .places()
        .iter()
        .filter(|place| !place[0].is_nan())
        .count();
    assert!(
        there.abs_diff(page.places().len()) < page.places().len() / 50,
        "{there}"
    );
    assert!(scene.error(&cut) < 0.003);
    assert!(cut.loss() < 0.01, "{}", cut.loss());
}

/// A hand covers a known share of the page, corner and all, farther than the sheet is continued.
#[test]
fn the_share_of_a_page_that_is_missing_is_told() {
    let scene = Scene::new(0.3, 20.0);
    let depths = scene.depths();
    let covered = [0.4, 0.5];
    let keep: Vec<u8> = (0..depths.values().len())
        .map(|i| {
            let pixel = [i % DEPTHS[0], i / DEPTHS[0]].map(|n| n as f64);
            let on_page = scene.meets([0.0; 3], scene.ray(pixel, 1.0));
            let shares = on_page.map(|(_, at)| [0, 1].map(|k| at[k] / PAGE[k] + 0.5));
            u8::from(shares.is_some_and(|share| (0..2).any(|k| share[k] > covered[k])))
        })
        .collect();
    let (map, sheet) = map_of_depths(&scene, &depths.masked(&keep).unwrap(), View::BestFit);
    assert_eq!(map.loss(), 0.0);
    let corners = scene.corners(0.002);
    for trim in [false, true] {
        let page = map.clone().cut(Some(&corners), true, trim).unwrap();
        // The sheet is continued into the hole by 6 % of the longer side, or a bit more where the page is measured too long.
        let longer = PAGE[0].max(PAGE[1]);
        let hole = |margin: f64| {
            let sides = [0, 1].map(|k| covered[k] - margin * longer / PAGE[k]);
            sides[0] * sides[1]
        };
        assert!(
            (hole(0.075)..hole(0.045)).contains(&page.loss()),
            "{trim}: {} of {}",
            page.loss(),
            hole(0.06)
        );
        // Far more is lost than a page may lack; what is there is right, as the map of the whole sheet says.
        assert_eq!(map.verdict(sheet.report()), Verdict::Unrolled);
        assert_eq!(page.verdict(sheet.report()), Verdict::Doubtful, "{trim}");
        let size = [page.width(), page.height()].map(|n| n as f64 / page.resolution());
        assert!(
            (0..2).all(|k| (size[k] / PAGE[k] - 1.0).abs() < 0.02),
            "{trim}: {size:?}"
        );
    }
}

#[test]
fn a_page_that_lies_askew_comes_out_upright() {
    let mut scene = Scene::new(0.12, 20.0);
    scene.roll = 0.12;
    let (map, _) = map_of(&scene, View::BestFit);
    // The direction of the page's edges in the flat image, by the places on the page of two pixels.
    let askew = |map: &WarpMap| {
        let scale = PHOTO[0] as f64 / DEPTHS[0] as f64;
        let (width, height) = (map.width(), map.height());
        let at = |col: usize| {
            let place = map.places()[height / 2 * width + col].map(f64::from);
            scene.meets([0.0; 3], scene.ray(place, scale)).unwrap().1
        };
        let [from, to] = [at(width / 4), at(3 * width / 4)];
        (to[1] - from[1]).atan2(to[0] - from[0])
    };
    assert!((askew(&map).abs() - 0.12).abs() < 0.01, "{}", askew(&map));
    let upright = map.clone().cut(None, true, false).unwrap();
    assert!(askew(&upright).abs() < 0.008, "{}", askew(&upright));
    assert!(scene.error(&upright) < 0.003);
    let corners = scene.corners(0.002);
    let page = map.clone().cut(Some(&corners), true, true).unwrap();
    assert!(askew(&page).abs() < 0.004, "{}", askew(&page));
    assert!(page.places().iter().all(|place| !place[0].is_nan()));
    let size = [page.width(), page.height()].map(|n| n as f64 / page.resolution());
    assert!(
        (0..2).all(|k| (size[k] / (0.996 * PAGE[k]) - 1.0).abs() < 0.006),
        "{size:?}"
    );
    assert!(scene.error(&page) < 0.003, "{}", scene.error(&page));
    // A part of it, beyond which the sheet goes on.
    let part = map.cut(Some(&scene.corners(0.2)), true, true).unwrap();
    let size = [part.width(), part.height()].map(|n| n as f64 / part.resolution());
    assert!(
        (0..2).all(|k| (size[k] / (0.6 * PAGE[k]) - 1.0).abs() < 0.008),
        "{size:?}"
    );
}

/// The edges of a curled page that is seen at a slant are bent in the photo, outwards or inwards.
#[test]
fn a_curled_page_is_cropped_along_its_own_edges() {
    for (radius, tilt) in [(0.1, 45.0), (0.1, -30.0), (0.12, 25.0), (0.3, 20.0)] {
        let scene = Scene::new(radius, tilt);
        let page = scene.depths();
        // The table on which the page lies with its two straight edges.
        let (sin, cos) = scene.tilt.sin_cos();
        let low = radius * (1.0 - (0.5 * PAGE[0] / radius).cos());
        let mut random = oorandom::Rand64::new(5);
        let values: Vec<f64> = (0..DEPTHS[0] * DEPTHS[1])
            .map(|i| {
                let ray = scene.ray([(i % DEPTHS[0]) as f64, (i / DEPTHS[0]) as f64], 1.0);
                let table = (low + cos * scene.away) / (cos * ray[2] - sin * ray[1]);
                let there = page.values()[i];
                let depth = if there > 0.0 { there } else { table };
                depth + 5e-4 * (2.0 * random.rand_float() - 1.0)
            })
            .collect();
        let depths = HeightImage::new(DEPTHS[0], DEPTHS[1], values).unwrap();
        let camera = intrinsics(scene.lens);
        let corners = scene.corners(0.002);
        let region = developable::Region::Polygon(PHOTO, &corners);
        let keep = camera.within(&depths, &region, None).unwrap();
        let count =
            |wanted: &dyn Fn(usize) -> bool| (0..keep.len()).filter(|i| wanted(*i)).count() as f64;
        let of_page = count(&|i| page.values()[i] > 0.0);
        let outline = [&corners[..], &corners[..1]].concat();
        let seen = |i: usize| {
            let scale = PHOTO[0] as f64 / DEPTHS[0] as f64;
            let at = [i % DEPTHS[0], i / DEPTHS[0]].map(|k| (k as f64 + 0.5) * scale - 0.5);
            let sides = outline.windows(2);
            sides
                .map(|s| {
                    let way = [0, 1].map(|k| s[1][k] - s[0][k]);
                    let off = [0, 1].map(|k| at[k] - s[0][k]);
                    way[0] * off[1] - way[1] * off[0]
                })
                .all(|side| side > 0.0)
        };
        let straight = |i: usize| u8::from(seen(i));
        let lost = |keep: &dyn Fn(usize) -> u8| {
            count(&|i| page.values()[i] > 0.0 && keep(i) == 0) / of_page
        };
        let table = |keep: &dyn Fn(usize) -> u8| {
            count(&|i| page.values()[i] == 0.0 && keep(i) != 0) / of_page
        };
        let own = |i: usize| keep[i];
        assert!(
            lost(&own) < 0.025
                && lost(&own) < 0.5 * lost(&straight)
                && table(&own) < table(&straight) + 0.005,
            "{radius} {tilt}: {} lost for {}, {} of the table for {}",
            lost(&own),
            lost(&straight),
            table(&own),
            table(&straight)
        );
        // Under a page that rises high the table is seen, too.
        if radius < 0.12 {
            continue;
        }
        let mesh = camera.back_project_within(&depths, &keep).unwrap();
        let seen = sample(&mesh, View::BestFit, Resolution::Auto).unwrap();
        let surface =
            developable::fit(seen.heightfield(), &developable::Options::default()).unwrap();
        let sheet = unroll(surface.heightfield(), &UnrollOptions::default()).unwrap();
        let registration = Registration::Camera(scene.camera(), *seen.frame());
        let map = WarpMap::new(&sheet, registration, PHOTO, &DewarpOptions::default()).unwrap();
        let flat = map.cut(Some(&corners), true, true).unwrap();
        let size = [flat.width(), flat.height()].map(|n| n as f64 / flat.resolution());
        assert!(
            flat.loss() < 0.02 && (0..2).all(|k| (size[k] / (0.996 * PAGE[k]) - 1.0).abs() < 0.02),
            "{radius} {tilt}: {size:?}, {} lost",
            flat.loss()
        );
        assert!(scene.error(&flat) < 0.01, "{}", scene.error(&flat));
    }
}
