//! A heightfield as one mesh whose creases are edges.
//!
//! Creases are the lines along which the continuations of two patches meet, smoothed once, in space. A constrained Delaunay
//! triangulation, seen from above, has these lines and the border as edges, and vertices of the lattice between them. So both
//! sides of a crease are the same line in space, and each triangle belongs to one patch.

mod border;
mod lines;
mod loose;
mod nodes;
mod triangulate;

use nalgebra::Vector3;
use rustc_hash::FxHashMap;

use crate::error::Result;
use crate::heights::heightfield::Heightfield;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;
use crate::shape::patches::{NO_PATCH, Patches};
use border::BorderLines;
use lines::Lines;
use loose::without_loose;
use nodes::Nodes;
use triangulate::{regions, triangulate};

/// Number of vertices that a surface is cut into sheets on, at most about; its creases and border add to them.
/// `benches/patterns.md` has what it costs and gains.
const MAX_VERTICES: usize = 20_000;

/// Minimum distance of a vertex from creases and border, in edge lengths of the mesh. `benches/patterns.md` has what others give.
const MIN_LINE_DISTANCE_LENGTHS: f64 = 0.5;

/// A mesh of which each triangle belongs to one patch.
pub(super) struct SurfaceMesh {
    pub places: Vec<Vector3<f64>>,
    pub triangles: Vec<[u32; 3]>,
    /// Number of the patch of each triangle.
    pub patches: Vec<u32>,
    /// Number of creases at which the surface has a step, so that the mesh has two borders there, and the area of the walls
    /// between these: their lengths times their heights.
    pub steps: usize,
    pub step_area: f64,
    /// Length of the mesh's edges seen from above, in lattice spacings.
    pub step: usize,
    /// Number of vertices at the border that do not belong to the surface.
    pub loose: usize,
}

impl SurfaceMesh {
    /// Triangulates a surface, with about as many vertices as it has itself, or as a pattern may have.
    pub(super) fn new(surface: &Heightfield, patches: &Patches) -> Result<SurfaceMesh> {
        let (labels, loose) = without_loose(surface, patches.labels());
        let lattice = Triangulation::of_some(surface, &Frame::default(), |corners| {
            corners.iter().all(|i| labels[*i] != NO_PATCH)
        })?;
        let share = lattice.vertices().len() as f64 / MAX_VERTICES as f64;
        let step = share.sqrt().ceil() as usize;
        let length = step as f64 * surface.lattice().spacing();
        let border = BorderLines::new(&lattice);
        let nodes = Nodes::new(surface, &lattice, &labels, &border);
        let lines = Lines::new(&nodes, &labels, &border, length)?;
        let inner = inner_points(surface, &labels, &lines, step);
        let (sites, triangles) = triangulate(&lines, &inner)?;
        let regions = regions(&nodes, &lines, &sites, &triangles)?;
        let mut mesh = SurfaceMesh {
            places: Vec::with_capacity(sites.len()),
            triangles: Vec::with_capacity(triangles.len()),
            patches: Vec::with_capacity(triangles.len()),
            steps: lines.steps,
            step_area: lines.step_area,
            step,
            loose,
        };
        // Number of the vertex of each point, for each group of patches that meet there without a step.
        let mut numbers: FxHashMap<(u32, u32), u32> = FxHashMap::default();
        for (triangle, patch) in triangles.iter().zip(regions) {
            if patch == NO_PATCH {
                continue;
            }
            let corners = triangle.corners.map(|site| {
                let (group, height) = lines.meeting(site, patch);
                *numbers.entry((site, group)).or_insert_with(|| {
                    let [x, y] = sites[site as usize];
                    let z = height.unwrap_or_else(|| nodes.surface_height([x, y]));
                    mesh.places.push(Vector3::new(x, y, z));
                    mesh.places.len() as u32 - 1
                })
            });
            mesh.triangles.push(corners);
            mesh.patches.push(patch);
        }
        Ok(mesh)
    }
}

/// Vertices of the lattice inside of patches, every `step`-th in each direction.
fn inner_points(
    surface: &Heightfield,
    labels: &[u32],
    lines: &Lines,
    step: usize,
) -> Vec<[f64; 2]> {
    let lattice = surface.lattice();
    let reach = MIN_LINE_DISTANCE_LENGTHS * step as f64 * lattice.spacing();
    let cell = |[x, y]: [f64; 2]| [(x / reach).floor() as i64, (y / reach).floor() as i64];
    let mut near: FxHashMap<[i64; 2], Vec<[f64; 2]>> = FxHashMap::default();
    let middles = lines.edges.iter().map(|ends| {
        let [a, b] = ends.map(|v| lines.points[v as usize]);
        [0, 1].map(|k| 0.5 * (a[k] + b[k]))
    });
    for point in lines.points.iter().copied().chain(middles) {
        near.entry(cell(point)).or_default().push(point);
    }
    let is_free = |at: [f64; 2]| {
        let [i, k] = cell(at);
        (i - 1..=i + 1)
            .flat_map(|i| (k - 1..=k + 1).map(move |k| [i, k]))
            .all(|key| {
                let close = |p: &[f64; 2]| (p[0] - at[0]).hypot(p[1] - at[1]) < reach;
                !near.get(&key).is_some_and(|all| all.iter().any(close))
            })
    };
    let mut points = Vec::new();
    for (i, row) in (0..lattice.rows()).step_by(step).enumerate() {
        // Every second line is shifted by half the distance; odd rows of the lattice are shifted to the left.
        let first = if i % 2 == 1 { (step + row % 2) / 2 } else { 0 };
        for col in (first..lattice.cols()).step_by(step) {
            let at = lattice.position(row, col);
            if labels[lattice.index(row, col)] != NO_PATCH && is_free(at) {
                points.push(at);
            }
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;
    use crate::math::index::NO_INDEX;
    use crate::scene::half_edges::{outlines, twin_half_edges};
    use crate::shape::patches::PatchOptions;

    fn mesh(surface: &Heightfield) -> SurfaceMesh {
        let patches = Patches::new(surface, &PatchOptions::default()).unwrap();
        let mesh = SurfaceMesh::new(surface, &patches).unwrap();
        let count = patches.patches().len();
        assert_eq!(mesh.patches.iter().max(), Some(&(count as u32 - 1)));
        // Seen from above no triangle lies on another.
        assert!(normals(&mesh).iter().all(|normal| normal.z > 0.0));
        mesh
    }

    /// Normal vector of each triangle, as long as its area.
    fn normals(mesh: &SurfaceMesh) -> Vec<Vector3<f64>> {
        let corners = (mesh.triangles.iter()).map(|t| t.map(|v| mesh.places[v as usize]));
        corners
            .map(|[a, b, c]| (b - a).cross(&(c - a)) / 2.0)
            .collect()
    }

    /// Number of closed lines around the mesh, and of its edges between two patches.
    fn lines(mesh: &SurfaceMesh) -> (usize, usize) {
        let twins = twin_half_edges(&mesh.triangles);
        let is_border = |side: u32| twins[side as usize] == NO_INDEX;
        let border = outlines(&twins, 0..twins.len() as u32, is_border);
        let patch = |side: usize| mesh.patches[side / 3];
        let between = (twins.iter().enumerate())
            .filter(|(_, twin)| **twin != NO_INDEX)
            .filter(|(side, twin)| patch(*side) < patch(**twin as usize));
        (border.len(), between.count())
    }

    #[test]
    fn the_upper_side_of_planes_has_its_edges_where_these_meet() {
        let mut random = oorandom::Rand64::new(11);
        let mut next = move || random.rand_float();
        for _ in 0..20 {
            let planes: Vec<[f64; 3]> = (0..4)
                .map(|_| [1.6 * next() - 0.8, 1.6 * next() - 0.8, 0.3 * next()])
                .collect();
            let lattice = Lattice::new(60, 50, 0.02).unwrap();
            let height = |x: f64, y: f64| {
                let heights = planes
                    .iter()
                    .map(|[a, b, c]| a * (x - 0.5) + b * (y + 0.5) + c);
                heights.fold(f64::MIN, f64::max)
            };
            let mesh = mesh(&Heightfield::from_fn(lattice, height).unwrap());
            let off = |p: &Vector3<f64>| (p.z - height(p.x, p.y)).abs() / 0.02;
            let mut off: Vec<f64> = mesh.places.iter().map(off).collect();
            off.sort_by(f64::total_cmp);
            // But for the ends of creases, where too few vertices say how a patch goes on.
            assert!(
                off[off.len() * 98 / 100] < 1e-3,
                "{}",
                off[off.len() * 98 / 100]
            );
            assert!(off[off.len() - 1] < 0.5, "{}", off[off.len() - 1]);
            let covered: f64 = normals(&mesh).iter().map(|normal| normal.z).sum();
            let whole = 49.0 * 0.02 * 59.0 * lattice.row_spacing();
            assert!((covered / whole - 1.0).abs() < 2e-3, "{covered} {whole}");
            let (border, between) = lines(&mesh);
            assert_eq!((border, mesh.steps), (1, 0));
            assert_eq!(mesh.patches.contains(&1), between > 0);
        }
    }

    #[test]
    fn a_step_has_a_border_on_either_side() {
        let lattice = Lattice::new(80, 80, 0.5).unwrap();
        let step = |x: f64, y: f64| 0.1 * y + if x > 19.3 { 3.0 } else { 0.0 };
        let mesh = mesh(&Heightfield::from_fn(lattice, step).unwrap());
        assert_eq!((lines(&mesh), mesh.steps), ((2, 0), 1));
        let wall = 3.0 * 79.0 * lattice.row_spacing();
        assert!(
            (mesh.step_area / wall - 1.0).abs() < 0.03,
            "{}",
            mesh.step_area
        );
        let slope = |normal: &Vector3<f64>| (normal.x / normal.z).abs();
        assert!(normals(&mesh).iter().all(|normal| slope(normal) < 0.01));
    }

    #[test]
    fn a_large_surface_keeps_its_border_and_its_larger_holes() {
        let lattice = Lattice::new(330, 300, 1.0).unwrap();
        let round = |x: f64, y: f64| (x - 150.0).hypot(y + 140.0);
        let one = lattice.position(60, 60);
        let height = |x: f64, y: f64| match round(x, y) < 40.0 || [x, y] == one {
            true => f64::NAN,
            false => 0.3 * (x - 170.2).abs(),
        };
        let mesh = mesh(&Heightfield::from_fn(lattice, height).unwrap());
        assert_eq!((mesh.step, lines(&mesh).0), (3, 2));
        assert!(mesh.places.len() < 15_000);
        let area: f64 = normals(&mesh).iter().map(|normal| normal.norm()).sum();
        let whole = 299.0 * 329.0 * lattice.row_spacing();
        let exact = 1.09f64.sqrt() * (whole - std::f64::consts::PI * 40.0 * 40.0);
        assert!((area / exact - 1.0).abs() < 2e-3, "{area} {exact}");
    }

    #[test]
    fn the_border_of_a_rectangle_has_four_corners() {
        for (rows, cols) in [(30, 30), (30, 31), (31, 30), (31, 31), (57, 24)] {
            let flat = Heightfield::from_fn(Lattice::new(rows, cols, 1.0).unwrap(), |_, _| 0.0);
            let mesh = mesh(&flat.unwrap());
            let next: FxHashMap<u32, u32> = crate::unroll::border(&mesh.triangles)
                .map(|[from, to]| (from, to))
                .collect();
            let place = |v: u32| mesh.places[v as usize];
            let turns = next.iter().map(|(from, here)| {
                let (a, b) = (
                    place(*here) - place(*from),
                    place(next[here]) - place(*here),
                );
                a.cross(&b).z.atan2(a.dot(&b)).to_degrees()
            });
            let (corners, others): (Vec<f64>, Vec<f64>) = turns.partition(|turn| *turn > 45.0);
            assert_eq!(corners.len(), 4, "{rows} × {cols}: {corners:?}");
            assert!(corners.iter().all(|turn| (turn - 90.0).abs() < 1e-6));
            assert!(others.iter().all(|turn| turn.abs() < 1e-6), "{others:?}");
        }
    }

    #[test]
    fn a_spike_at_the_border_is_no_part_of_the_surface() {
        let lattice = Lattice::new(30, 30, 1.0).unwrap();
        let spike = lattice.position(29, 14);
        let height = |x: f64, y: f64| 0.2 * x + if [x, y] == spike { 9.0 } else { 0.0 };
        let mesh = mesh(&Heightfield::from_fn(lattice, height).unwrap());
        assert_eq!(mesh.loose, 1);
        assert!(mesh.places.iter().all(|p| (p.z - 0.2 * p.x).abs() < 1e-9));
    }
}
