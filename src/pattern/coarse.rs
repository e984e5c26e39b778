//! A surface and its patches sampled on the lattice of twice the spacing, on which its cuts are decided.

use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::Heightfield;
use crate::lattice::coarsening::{coarse_lattice, fine_vertex, parents};
use crate::lattice::hexagonal::Lattice;
use crate::shape::patches::{NO_PATCH, Patches};

/// Maximum number of vertices of a surface that is cut into sheets without doing so on a coarser lattice first.
/// `benches/patterns.md` has what it costs and gains.
const MAX_DIRECT_VERTICES: usize = 20_000;

/// A surface and its patches, sampled at every second vertex of the lattice on which the surface is given.
pub(super) struct Coarse {
    pub surface: Heightfield,
    pub patches: Patches,
    /// For each patch of the coarse lattice the number of the same patch on the fine lattice.
    pub order: Vec<usize>,
}

impl Coarse {
    /// Samples the surface on the lattice of twice the spacing; `None` if it has at most [`MAX_DIRECT_VERTICES`]
    /// vertices, or if too few would be left.
    pub(super) fn new(surface: &Heightfield, patches: &Patches) -> Result<Option<Coarse>> {
        let valid = surface.heights().iter().filter(|z| !z.is_nan()).count();
        let fine = *surface.lattice();
        if valid <= MAX_DIRECT_VERTICES || fine.rows() < 8 || fine.cols() < 8 {
            return Ok(None);
        }
        let lattice = coarse_lattice(&fine)?;
        let mut heights = try_filled("pattern", lattice.len(), f64::NAN)?;
        let mut labels = try_filled("pattern", lattice.len(), NO_PATCH)?;
        for i in 0..lattice.len() {
            if let Some(k) = on_fine(&lattice, &fine, i) {
                heights[i] = surface.heights()[k];
                labels[i] = patches.labels()[k];
            }
        }
        let coarse = Heightfield::new(lattice, heights)?;
        match patches.divided(&coarse, labels) {
            Ok((patches, order)) => Ok(Some(Coarse {
                surface: coarse,
                patches,
                order,
            })),
            // All of the surface is too narrow for the coarse lattice.
            Err(Error::Unsupported { .. } | Error::NoInterior { .. }) => Ok(None),
            Err(other) => Err(other),
        }
    }
}

/// Converts the index of a vertex of the coarse lattice to the index of the vertex of the fine lattice at the same
/// place.
fn on_fine(coarse: &Lattice, fine: &Lattice, i: usize) -> Option<usize> {
    let (row, col) = fine_vertex(i / coarse.cols(), i % coarse.cols());
    fine.contains(row, col)
        .then(|| fine.index(row as usize, col as usize))
}

/// Returns the indices of the one or two coarse vertices at or beside a vertex of the fine lattice.
pub(super) fn on_coarse(coarse: &Lattice, row: usize, col: usize) -> impl Iterator<Item = usize> {
    let inside = |(row, col): &(isize, isize)| coarse.contains(*row, *col);
    let found: Vec<usize> = (parents(row, col).iter().filter(|vertex| inside(vertex)))
        .map(|(row, col)| coarse.index(*row as usize, *col as usize))
        .collect();
    found.into_iter()
}
