//! One patch, extended a cell beyond its creases and laid flat by itself.
//!
//! A crease runs through triangles of the lattice whose corners belong to two patches. Each of the two patches gets
//! its own copy of such a triangle, and at the corners of the other patch the height is extrapolated from its own
//! vertices. The crease is the intersection of the two extended patches. Parts that were cut from one patch are not
//! extrapolated: they keep the heights of the surface across their common border.

use super::labels::Labels;
use super::window::Window;
use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::Lattice;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;
use crate::shape::patches::extrapolate::extrapolated_height;
use crate::unroll::arap_mesh::{ArapMesh, StoppingCriteria};
use crate::unroll::flat_triangle::{FlatTriangle, Point};
use crate::unroll::plan;

/// Distance in space between the two sides of a seam, in lattice spacings, above which the surface counts as torn
/// there.
pub(super) const MIN_TEAR_GAP_SPACINGS: f64 = 0.5;

/// Minimum number of vertices of a part that may be cut into smaller parts.
pub(super) const MIN_CUT_VERTICES: usize = 24;

/// How a patch's flat positions were relaxed last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Relaxation {
    /// The patch still has to be laid flat on this lattice: its positions come from a coarser one, or from before some
    /// vertices were left out.
    Outstanding,
    /// The patch was laid flat by itself.
    Alone,
    /// The patch was laid flat together with its sheet, and the sheet checked.
    WithSheet,
}

/// A patch, extended one cell beyond its creases and laid flat by itself.
pub(super) struct FlatPatch {
    mesh: Triangulation,
    /// The mesh's triangles, each in a plane of its own.
    triangles: Vec<FlatTriangle>,
    /// Flat positions of the vertices from when the patch was laid flat by itself; the current positions, which may
    /// differ, are in `places`.
    alone: Vec<Point>,
    places: Vec<Point>,
    pub relaxation: Relaxation,
    window: Window,
    /// Whether each vertex of the flat layout belongs to the patch itself, and not to a neighbour.
    own: Vec<bool>,
}

/// Strain of a flat layout as sums over its triangles: the area of its triangles, the integral of the squared strain,
/// and the number of flipped triangles.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Strain {
    pub area: f64,
    /// Integral of the squared strain over the area of the triangles.
    pub squares: f64,
    /// Number of triangles that lie upside down in the layout.
    pub flipped: usize,
}

impl Strain {
    /// Computes the root mean square of the strain; infinite where a layout is not finite.
    pub(super) fn rms(&self) -> f64 {
        let rms = match self.area > 0.0 {
            true => (self.squares / self.area).sqrt(),
            false => 0.0,
        };
        if rms.is_nan() { f64::INFINITY } else { rms }
    }

    pub(super) fn with(self, other: Strain) -> Strain {
        Strain {
            area: self.area + other.area,
            squares: self.squares + other.squares,
            flipped: self.flipped + other.flipped,
        }
    }
}

impl FlatPatch {
    /// Lays a patch flat, with all triangles that have at least one of its vertices; `None` if there is no such
    /// triangle.
    pub(super) fn new(
        surface: &Heightfield,
        labels: &Labels,
        patch: u32,
        window: Window,
        until: StoppingCriteria,
    ) -> Result<Option<FlatPatch>> {
        let Some((mesh, own)) = FlatPatch::mesh(surface, labels, patch, window)? else {
            return Ok(None);
        };
        let triangles = flat_triangles(&mesh);
        let mut places = plan(&mesh, 1.0);
        let pieces = triangles
            .iter()
            .copied()
            .zip(mesh.triangles().iter().copied());
        ArapMesh::new(&places, pieces.collect(), Vec::new())?.lay_flat(&mut places, until)?;
        Ok(Some(FlatPatch {
            triangles,
            relaxation: Relaxation::Alone,
            window,
            own,
            alone: places.clone(),
            places,
            mesh,
        }))
    }

    /// Creates a patch with given positions, which is not relaxed. Vertices without a given position are placed next to
    /// those that have one; `None` if some vertices cannot be placed that way.
    pub(super) fn at(
        surface: &Heightfield,
        labels: &Labels,
        patch: u32,
        window: Window,
        start: impl Fn([usize; 2]) -> Option<Point>,
    ) -> Result<Option<FlatPatch>> {
        let Some((mesh, own)) = FlatPatch::mesh(surface, labels, patch, window)? else {
            return Ok(None);
        };
        let cols = mesh.lattice().cols();
        let vertices = mesh.vertices().iter().map(|v| *v as usize);
        let known: Vec<Option<Point>> = vertices
            .map(|v| start([window.top + v / cols, window.left + v % cols]))
            .collect();
        let Some(places) = spread(&mesh, known) else {
            return Ok(None);
        };
        Ok(Some(FlatPatch {
            triangles: flat_triangles(&mesh),
            mesh,
            alone: places.clone(),
            places,
            relaxation: Relaxation::Outstanding,
            window,
            own,
        }))
    }

    /// Creates the mesh of all triangles with a vertex of a patch, and tells for each vertex of the mesh whether it
    /// belongs to the patch; `None` if there is no triangle.
    fn mesh(
        surface: &Heightfield,
        labels: &Labels,
        patch: u32,
        window: Window,
    ) -> Result<Option<(Triangulation, Vec<bool>)>> {
        let whole = surface.lattice();
        if window.is_empty() {
            return Ok(None);
        }
        let (rows, cols) = (
            window.bottom - window.top + 1,
            window.right - window.left + 1,
        );
        let lattice = Lattice::new(rows, cols, whole.spacing())?
            .with_origin(whole.position(window.top, window.left))?;
        let index = |i: usize| whole.index(window.top + i / cols, window.left + i % cols);
        let of = &labels.of;
        let mut heights = try_filled("patch", lattice.len(), f64::NAN)?;
        for (i, height) in heights.iter_mut().enumerate() {
            let k = index(i);
            let beside = || {
                let around = whole.neighbours(k / whole.cols(), k % whole.cols());
                (around.into_iter().flatten()).any(|(r, c)| of[whole.index(r, c)] == patch)
            };
            let z = surface.heights()[k];
            if of[k] == patch {
                *height = z;
            } else if !z.is_nan() && beside() {
                let own = extrapolated_height(surface, of, patch, k);
                // Between parts of one patch a step of the surface is a tear as well.
                let near = (z - own).abs() <= MIN_TEAR_GAP_SPACINGS * whole.spacing();
                let goes_on = labels.are_one(of[k], patch) && (near || own.is_nan());
                *height = if goes_on { z } else { own };
            }
        }
        let field = Heightfield::new(lattice, heights)?;
        let own = |corners: [usize; 3]| corners.iter().any(|i| of[index(*i)] == patch);
        let mesh = match Triangulation::of_some(&field, &Frame::default(), own) {
            Err(Error::Unsupported { .. }) => return Ok(None),
            other => other?,
        };
        let own = mesh.vertices().iter();
        let own = own.map(|v| of[index(*v as usize)] == patch).collect();
        Ok(Some((mesh, own)))
    }

    pub(super) fn places(&self) -> &[Point] {
        &self.places
    }

    /// Returns the positions of the patch's vertices on the surface in space.
    pub(super) fn positions(&self) -> &[[f64; 3]] {
        self.mesh.positions()
    }

    pub(super) fn is_own(&self, vertex: usize) -> bool {
        self.own[vertex]
    }

    pub(super) fn set_places(&mut self, places: Vec<Point>) {
        self.places = places;
    }

    /// Returns the flat positions of the vertices from when the patch was laid flat by itself; `None` if these are
    /// still the current ones.
    pub(super) fn moved_from(&self) -> Option<Vec<Point>> {
        (self.alone != self.places).then(|| self.alone.clone())
    }

    /// Counts the vertices that belong to the patch.
    pub(super) fn size(&self) -> usize {
        self.own.iter().filter(|own| **own).count()
    }

    /// Returns whether the part has fewer than [`MIN_CUT_VERTICES`] vertices and is too small to be cut.
    pub(super) fn is_too_small_to_cut(&self) -> bool {
        self.size() < MIN_CUT_VERTICES
    }

    /// Returns the triangles of the patch, each in a plane of its own, with the numbers of their corners. A
    /// triangle with only one corner that belongs to the patch is left out, unless there are no others.
    #[inline]
    pub(super) fn pieces(&self) -> impl Iterator<Item = (FlatTriangle, [u32; 3])> + '_ {
        let inside = |corners: &[u32; 3]| {
            let own = corners.iter().filter(|v| self.own[**v as usize]);
            own.count() > 1
        };
        let some = self.mesh.triangles().iter().any(inside);
        self.all_pieces()
            .filter(move |(_, corners)| !some || inside(corners))
    }

    /// Returns all triangles of the extended patch, each in a plane of its own, with the numbers of their corners.
    pub(super) fn all_pieces(&self) -> impl Iterator<Item = (FlatTriangle, [u32; 3])> + '_ {
        let corners = self.mesh.triangles().iter().copied();
        self.triangles.iter().copied().zip(corners)
    }

    /// Computes the strain of the patch at the current flat positions of its vertices.
    pub(super) fn strain(&self) -> Strain {
        self.strain_of(|_| true)
    }

    /// Computes the strain of those triangles that have at least one of the wanted vertices as a corner.
    pub(super) fn strain_of(&self, wanted: impl Fn(u32) -> bool) -> Strain {
        let mut sum = Strain::default();
        for (piece, corners) in self.pieces().filter(|(piece, _)| piece.exists()) {
            if !corners.iter().any(|corner| wanted(*corner)) {
                continue;
            }
            let [long, short] = piece.singular_values(corners.map(|v| self.places[v as usize]));
            sum.area += piece.area();
            sum.squares += 0.5 * piece.area() * ((long - 1.0).powi(2) + (short - 1.0).powi(2));
            sum.flipped += usize::from(short <= 0.0 || short.is_nan());
        }
        sum
    }

    /// Computes the contribution of each vertex of the patch to the strain: returns its index in the whole lattice, and
    /// the sum over its triangles of squared strain times area.
    pub(super) fn vertex_strain_energy(&self, whole: &Lattice) -> Vec<(usize, f64)> {
        let mut shares = vec![0.0; self.places.len()];
        for (piece, corners) in self.pieces().filter(|(piece, _)| piece.exists()) {
            let [long, short] = piece.singular_values(corners.map(|v| self.places[v as usize]));
            let square = piece.area() * ((long - 1.0).powi(2) + (short - 1.0).powi(2));
            for v in corners {
                shares[v as usize] += square;
            }
        }
        let own = (0..shares.len()).filter(|v| self.own[*v]);
        own.map(|v| (self.index(whole, v), shares[v])).collect()
    }

    /// Lists the vertices of the patch that are corners of flipped triangles, by their index in the whole lattice.
    pub(super) fn flipped(&self, whole: &Lattice) -> Vec<usize> {
        let upside_down = |(piece, corners): &(FlatTriangle, [u32; 3])| {
            let [_, short] = piece.singular_values(corners.map(|v| self.places[v as usize]));
            piece.exists() && (short <= 0.0 || short.is_nan())
        };
        let pieces = self.pieces().filter(upside_down);
        let corners = pieces.flat_map(|(_, corners)| corners);
        let own = corners.map(|v| v as usize).filter(|v| self.own[*v]);
        own.map(|v| self.index(whole, v)).collect()
    }

    /// Returns the index in the whole lattice of one of the patch's vertices.
    fn index(&self, whole: &Lattice, number: usize) -> usize {
        let [row, col] = self.vertex(number);
        whole.index(row, col)
    }

    /// Returns row and column in the whole lattice of one of the patch's vertices.
    #[inline]
    pub(super) fn vertex(&self, number: usize) -> [usize; 2] {
        let (index, cols) = (
            self.mesh.vertices()[number] as usize,
            self.mesh.lattice().cols(),
        );
        [
            self.window.top + index / cols,
            self.window.left + index % cols,
        ]
    }

    /// Returns the number within the patch of a vertex, given by its row and column in the whole lattice; `None` if the
    /// vertex is not in the patch.
    #[inline]
    pub(super) fn number(&self, vertex: [usize; 2]) -> Option<usize> {
        let [row, col] = vertex;
        let lattice = self.mesh.lattice();
        let (row, col) = (
            row.checked_sub(self.window.top)?,
            col.checked_sub(self.window.left)?,
        );
        if row >= lattice.rows() || col >= lattice.cols() {
            return None;
        }
        let index = lattice.index(row, col) as u32;
        self.mesh.vertices().binary_search(&index).ok()
    }

    /// Returns the height of the extended patch at a row and column of the whole lattice; NaN outside of the patch.
    pub(super) fn height(&self, vertex: [usize; 2]) -> f64 {
        let number = self.number(vertex);
        number.map_or(f64::NAN, |n| self.mesh.positions()[n][2])
    }

    /// Returns the flat position of the vertex at a row and column of the whole lattice; NaN outside of the patch.
    pub(super) fn place(&self, vertex: [usize; 2]) -> Point {
        self.number(vertex)
            .map_or(Point::new(f64::NAN, f64::NAN), |n| self.places[n])
    }
}

/// Moves each triangle of a mesh to a plane of its own.
fn flat_triangles(mesh: &Triangulation) -> Vec<FlatTriangle> {
    let corners = mesh.triangles().iter();
    corners
        .map(|corners| FlatTriangle::from_points(corners.map(|v| mesh.positions()[v as usize])))
        .collect()
}

/// Completes the flat positions of a mesh's vertices from some known positions: in each triangle two known corners
/// determine the third. `None` if a vertex cannot be reached.
fn spread(mesh: &Triangulation, mut known: Vec<Option<Point>>) -> Option<Vec<Point>> {
    let mut missing = known.iter().filter(|place| place.is_none()).count();
    while missing > 0 {
        let mut sums = vec![(Point::default(), 0.0); known.len()];
        for corners in mesh.triangles() {
            for k in 0..3 {
                let [a, b, c] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| corners[k] as usize);
                let (None, Some(p), Some(q)) = (known[a], known[b], known[c]) else {
                    continue;
                };
                let points = [b, c, a].map(|v| mesh.positions()[v]);
                let piece = FlatTriangle::from_points(points);
                if piece.exists() {
                    let (sum, count) = &mut sums[a];
                    *sum += p + (q - p) * piece.third_corner();
                    *count += 1.0;
                }
            }
        }
        let before = missing;
        for (place, (sum, count)) in known.iter_mut().zip(sums) {
            if count > 0.0 && place.is_none() {
                *place = Some(sum / count);
                missing -= 1;
            }
        }
        if missing == before {
            return None;
        }
    }
    known.into_iter().collect()
}
