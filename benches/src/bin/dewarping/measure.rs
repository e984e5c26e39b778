//! How true a flat layout of a page is.

use std::collections::HashMap;

use blazediff_ssim::{MsSsimOptions, Plane, Rgba8, SsimOptions, ms_ssim};
use developable::dewarp::{DewarpOptions, Photo, WarpMap};
use developable::unroll::{UnrollOptions, unroll};
use developable::{Heightfield, Quadratic, Triangulation};
use nalgebra::{Complex, Matrix2, Vector2};
use serde::Serialize;

use crate::page::{HEIGHT, Page, Point};
use crate::print::{self, ACROSS, DOWN, GRID};
use crate::{Outcome, Scene};

/// All against the page itself, as shares.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Truth {
    /// Mean of the larger strain of each triangle, and the share of them where it is above 1 %.
    pub stretch: f64,
    pub above: f64,
    /// Standard deviation of the points of a grid line from the straight line through them, in widths
    /// of the page, over all lines.
    pub bend: f64,
    /// Width over height against the page's own.
    pub aspect: f64,
    /// The share of the true creases' curvature that is there, on the lattice; none where no crease is.
    pub kept: Option<f64>,
    /// Multi-scale structural similarity of the flat image and the page's, 1 for the same. NaN, in JSON
    /// null, where they are so unlike that it is a root of a negative number.
    pub similarity: f64,
}

/// Unrolls a surface and makes the photo flat by it.
pub fn measure(page: &dyn Page, scene: &Scene, surface: &Heightfield) -> Outcome<Truth> {
    let sheet = unroll(surface, &UnrollOptions::default())?;
    let mesh = sheet.mesh();
    let true_place = |v: u32| {
        let [x, y, _] = mesh.positions()[v as usize];
        page.on_page([x, y])
    };
    let on_the_page = |[u, v]: Point| (0.0..=1.0).contains(&u) && (0.0..=HEIGHT).contains(&v);

    let (mut strains, mut above, mut count) = (0.0, 0.0, 0.0);
    let mut pairs = Vec::new();
    for triangle in mesh.triangles() {
        let truth = triangle.map(true_place);
        if !truth.iter().all(|place| on_the_page(*place)) {
            continue;
        }
        let strain = strain(truth, triangle.map(|v| sheet.places()[v as usize]));
        strains += strain;
        above += f64::from(strain > 0.01);
        count += 1.0;
        pairs.push((truth[0], sheet.places()[triangle[0] as usize]));
    }

    let layout = Layout::new(mesh, sheet.places());
    let line = |points: &dyn Fn(f64) -> Point| {
        let found = (5..=95).filter_map(|i| layout.place(page.seen(points(f64::from(i) / 100.0))));
        straightness(&found.collect::<Vec<_>>())
    };
    let upright: Vec<_> = (1..10)
        .map(|i| line(&|t| [f64::from(i) * GRID, HEIGHT * t]))
        .collect();
    let level: Vec<_> = (1..14)
        .map(|i| line(&|t| [t, f64::from(i) * GRID]))
        .collect();
    let bends: Vec<f64> = upright.iter().chain(&level).map(|line| line.1).collect();
    let apart = |lines: &[(Point, f64)]| {
        let (first, last) = (lines[0].0, lines[lines.len() - 1].0);
        (last[0] - first[0]).hypot(last[1] - first[1]) / (lines.len() - 1) as f64
    };

    let photo = Photo::new(scene.width, scene.height, &scene.photo)?;
    let size = [scene.width, scene.height];
    let options = DewarpOptions::default().dots(ACROSS as f64);
    let map = WarpMap::new(&sheet, scene.extent, size, &options)?;
    let flat = map.image(&photo)?;
    // On the page's own pixels, to which it is turned and shifted.
    let turn = Rigid::between(&pairs);
    let aligned = print::resampled(&flat, [map.width(), map.height()], |[u, v]| {
        let [x, y] = turn.apply([u, v]);
        [
            (x - map.corner()[0]) * map.resolution(),
            (map.corner()[1] - y) * map.resolution(),
        ]
    });
    Ok(Truth {
        stretch: strains / count,
        above: above / count,
        bend: (bends.iter().map(|b| b * b).sum::<f64>() / bends.len() as f64).sqrt(),
        aspect: apart(&upright) / apart(&level) - 1.0,
        kept: kept(&scene.exact, surface),
        similarity: similarity(&aligned, &scene.original)?,
    })
}

/// What bends tighter, in widths of the page, is a crease.
const CREASE: f64 = 0.1;

/// The nuclear norm of a surface's Hessians at creases of the true one and their neighbours, as a share of
/// its own.
fn kept(exact: &Heightfield, surface: &Heightfield) -> Option<f64> {
    let lattice = exact.lattice();
    let around = |vertex: usize| {
        let ring = lattice.neighbours(vertex / lattice.cols(), vertex % lattice.cols());
        ring.map(|n| n.map(|(row, col)| lattice.index(row, col)))
    };
    let bend = |field: &Heightfield, vertex: usize| -> Option<f64> {
        let heights = field.heights();
        let ring = around(vertex).map(|n| n.map_or(f64::NAN, |n| heights[n]));
        let hessian = Quadratic::fit(heights[vertex], ring, lattice.spacing()).hessian;
        let bend = hessian.nuclear_norm();
        bend.is_finite().then_some(bend)
    };
    let is_crease = |vertex: usize| bend(exact, vertex).is_some_and(|s| s > 1.0 / CREASE);
    let near = (0..lattice.len())
        .filter(|v| is_crease(*v) || around(*v).into_iter().flatten().any(is_crease));
    let (mut found, mut whole) = (0.0, 0.0);
    for vertex in near {
        if let (Some(a), Some(b)) = (bend(surface, vertex), bend(exact, vertex)) {
            found += a;
            whole += b;
        }
    }
    (whole > 0.0).then(|| found / whole)
}

/// The larger strain of a triangle's map, from its corners before and after.
fn strain(before: [Point; 3], after: [Point; 3]) -> f64 {
    let sides =
        |[a, b, c]: [Point; 3]| Matrix2::new(b[0] - a[0], c[0] - a[0], b[1] - a[1], c[1] - a[1]);
    let Some(inverse) = sides(before).try_inverse() else {
        return 0.0;
    };
    let values = (sides(after) * inverse).singular_values();
    (values.max() - 1.0).max(1.0 - values.min())
}

/// Mean of points, and their standard deviation from the straight line through them.
fn straightness(points: &[Point]) -> (Point, f64) {
    let n = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    let mut moments = Matrix2::zeros();
    for p in points {
        let d = Vector2::new(p[0] - mean[0], p[1] - mean[1]);
        moments += d * d.transpose() / n;
    }
    (mean, moments.symmetric_eigenvalues().min().max(0.0).sqrt())
}

/// A turn and a shift.
struct Rigid {
    turn: Complex<f64>,
    shift: Complex<f64>,
}

impl Rigid {
    /// That which takes the first of each pair closest to the second.
    fn between(pairs: &[(Point, Point)]) -> Self {
        let complex = |[x, y]: Point| Complex::new(x, y);
        let n = pairs.len() as f64;
        let from = pairs.iter().map(|p| complex(p.0)).sum::<Complex<f64>>() / n;
        let to = pairs.iter().map(|p| complex(p.1)).sum::<Complex<f64>>() / n;
        let product = |p: &(Point, Point)| (complex(p.0) - from).conj() * (complex(p.1) - to);
        let turn: Complex<f64> = pairs.iter().map(product).sum();
        let turn = turn / turn.norm();
        Rigid {
            turn,
            shift: to - turn * from,
        }
    }

    fn apply(&self, [x, y]: Point) -> Point {
        let place = self.turn * Complex::new(x, y) + self.shift;
        [place.re, place.im]
    }
}

/// Where what is seen at a point has come to lie, linear within each triangle.
struct Layout<'a> {
    mesh: &'a Triangulation,
    places: &'a [Point],
    /// Triangles by the square of the lattice's spacing that a corner of theirs is in.
    near: HashMap<[i64; 2], Vec<u32>>,
}

impl<'a> Layout<'a> {
    fn new(mesh: &'a Triangulation, places: &'a [Point]) -> Self {
        let mut layout = Layout {
            mesh,
            places,
            near: HashMap::new(),
        };
        for (number, triangle) in mesh.triangles().iter().enumerate() {
            for v in triangle {
                let [x, y, _] = mesh.positions()[*v as usize];
                let near = layout.near.entry(layout.square([x, y])).or_default();
                near.push(number as u32);
            }
        }
        layout
    }

    fn square(&self, seen: Point) -> [i64; 2] {
        seen.map(|x| (x / self.mesh.lattice().spacing()).floor() as i64)
    }

    fn place(&self, seen: Point) -> Option<Point> {
        let [i, j] = self.square(seen);
        let around = (-1..=1).flat_map(|di| (-1..=1).map(move |dj| [i + di, j + dj]));
        for number in around.filter_map(|square| self.near.get(&square)).flatten() {
            let triangle = self.mesh.triangles()[*number as usize];
            let [a, b, c] = triangle.map(|v| {
                let [x, y, _] = self.mesh.positions()[v as usize];
                Vector2::new(x, y)
            });
            let inverse = Matrix2::from_columns(&[b - a, c - a]).try_inverse()?;
            let w = inverse * (Vector2::from(seen) - a);
            if w.x >= -1e-9 && w.y >= -1e-9 && w.x + w.y <= 1.0 + 1e-9 {
                let [p, q, r] = triangle.map(|v| self.places[v as usize]);
                let weighted = |k: usize| (1.0 - w.x - w.y) * p[k] + w.x * q[k] + w.y * r[k];
                return Some([weighted(0), weighted(1)]);
            }
        }
        None
    }
}

fn similarity(found: &[u8], original: &[u8]) -> Outcome<f64> {
    let plane = |rgba| Plane::from_rgba8(Rgba8::new(rgba, ACROSS, DOWN));
    let (found, original) = (plane(found)?, plane(original)?);
    let score = ms_ssim(
        &found,
        &original,
        &SsimOptions::default(),
        &MsSsimOptions::default(),
    )?;
    Ok(score.score)
}
