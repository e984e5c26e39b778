//! One patch, extended a cell beyond its creases and laid flat by itself.
//!
//! The lattice's triangles that a crease runs through cut its corner. So each patch gets them for
//! itself, with heights of its own at the corners that belong to others, as its vertices nearby have
//! it. Where two patches so extended meet is where the crease is.

use crate::error::{Error, Result, try_filled};
use crate::flat::unroll::pieces::Point;
use crate::flat::unroll::{UnrollOptions, Unrolling, unroll_mesh};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::Lattice;
use crate::scene::triangulation::Triangulation;
use crate::scene::view::Frame;
use crate::shape::patches::extend::extended;

/// A part of the lattice, from an even row on, so that its rows are shifted alike.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    top: usize,
    left: usize,
    bottom: usize,
    right: usize,
}

impl Window {
    /// Around the vertices of each patch, one cell larger.
    pub(super) fn around(lattice: &Lattice, labels: &[u32], count: usize) -> Vec<Window> {
        let nothing = Window {
            top: usize::MAX,
            left: usize::MAX,
            bottom: 0,
            right: 0,
        };
        let mut windows = vec![nothing; count];
        for (i, label) in labels.iter().enumerate() {
            if let Some(window) = windows.get_mut(*label as usize) {
                let (row, col) = (i / lattice.cols(), i % lattice.cols());
                window.top = window.top.min(row.saturating_sub(1) & !1);
                window.left = window.left.min(col.saturating_sub(1));
                window.bottom = window.bottom.max((row + 1).min(lattice.rows() - 1));
                window.right = window.right.max((col + 1).min(lattice.cols() - 1));
            }
        }
        windows
    }
}

pub(super) struct Leaf {
    flat: Unrolling,
    window: Window,
}

impl Leaf {
    /// The patch with all triangles that one of its vertices is in; `None` if there is none.
    pub(super) fn new(
        surface: &Heightfield,
        labels: &[u32],
        patch: u32,
        window: Window,
        options: &UnrollOptions,
    ) -> Result<Option<Leaf>> {
        let whole = surface.lattice();
        if window.top > window.bottom {
            return Ok(None);
        }
        let (rows, cols) = (
            window.bottom - window.top + 1,
            window.right - window.left + 1,
        );
        let lattice = Lattice::new(rows, cols, whole.spacing())?
            .with_origin(whole.position(window.top, window.left))?;
        let index = |i: usize| whole.index(window.top + i / cols, window.left + i % cols);
        let mut heights = try_filled("patch", lattice.len(), f64::NAN)?;
        for (i, height) in heights.iter_mut().enumerate() {
            let k = index(i);
            let beside = || {
                let around = whole.neighbours(k / whole.cols(), k % whole.cols());
                (around.into_iter().flatten()).any(|(r, c)| labels[whole.index(r, c)] == patch)
            };
            if labels[k] == patch {
                *height = surface.heights()[k];
            } else if !surface.heights()[k].is_nan() && beside() {
                *height = extended(surface, labels, patch, k);
            }
        }
        let field = Heightfield::new(lattice, heights)?;
        let own = |corners: [usize; 3]| corners.iter().any(|i| labels[index(*i)] == patch);
        let mesh = match Triangulation::of_some(&field, &Frame::default(), own) {
            Err(Error::Unsupported { .. }) => return Ok(None),
            other => other?,
        };
        let flat = unroll_mesh(mesh, options)?;
        Ok(Some(Leaf { flat, window }))
    }

    pub(super) fn flat(&self) -> &Unrolling {
        &self.flat
    }

    /// Which of the leaf's vertices a vertex of the whole lattice is.
    fn number(&self, vertex: [usize; 2]) -> Option<usize> {
        let [row, col] = vertex;
        let lattice = self.flat.mesh().lattice();
        let (row, col) = (
            row.checked_sub(self.window.top)?,
            col.checked_sub(self.window.left)?,
        );
        if row >= lattice.rows() || col >= lattice.cols() {
            return None;
        }
        let index = lattice.index(row, col) as u32;
        self.flat.mesh().vertices().binary_search(&index).ok()
    }

    /// Height of the extended patch at a row and column of the whole lattice; NaN where it does
    /// not reach.
    pub(super) fn height(&self, vertex: [usize; 2]) -> f64 {
        let number = self.number(vertex);
        number.map_or(f64::NAN, |n| self.flat.mesh().positions()[n][2])
    }

    /// Its place on the plane likewise.
    pub(super) fn place(&self, vertex: [usize; 2]) -> Point {
        self.number(vertex)
            .map_or(Point::new(f64::NAN, f64::NAN), |n| {
                let [x, y] = self.flat.places()[n];
                Point::new(x, y)
            })
    }
}
