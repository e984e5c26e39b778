//! A mesh cut into sheets that lie flat.
//!
//! Parts with too much strain are cut in two by planes, until each part lies flat by itself. Then parts are joined along the seams
//! whose sides fit, and cuts are closed again where a sheet's strain and outline allow it. Creases are edges of the mesh, so both
//! sides of every seam are the same line in space.

mod body;
mod close;
mod divide;
mod draw;
mod join;
mod junction;
mod lay;
mod parts;
mod reach;
mod refold;
mod seams;

use nalgebra::Vector3;

use super::options::PatternOptions;
use super::sheets::{Missing, Pattern};
use crate::error::{Result, positive};
use crate::progress;
use body::Body;
use join::{Limits, join_parts};
pub(super) use parts::MAX_OMITTED_SHARE;
use parts::flat_parts;
use seams::Seams;

/// A mesh to be cut into sheets.
pub(super) struct PatchedMesh {
    pub places: Vec<Vector3<f64>>,
    pub triangles: Vec<[u32; 3]>,
    /// Number of the patch of each triangle.
    pub patches: Vec<u32>,
    /// Minimum fold angle of a line inside of a patch that counts as a crease, in radians.
    pub bend: f64,
    /// Width of creases, on either side: fold angles are measured at this distance.
    pub crease_width: f64,
}

/// Cuts a mesh into flat sheets; the first is the one with the largest patch.
pub(super) fn cut_into_sheets(mesh: PatchedMesh, options: &PatternOptions) -> Result<Pattern> {
    let limits = Limits {
        gap: positive("maxSeamGap", options.max_seam_gap)?,
        strain: positive("maxStrain", options.max_strain)?,
        until: options.relaxation(),
    };
    positive("tolerance", options.unrolling.tolerance)?;
    let body = Body::new(mesh.places, mesh.triangles, mesh.patches)?;
    let (body, parts, missing): (Body, _, Missing) =
        progress::part(0.6, || flat_parts(body, limits))?;
    let seams = Seams::new(&body, mesh.bend, mesh.crease_width);
    let (seams, sheets) = progress::part(0.95, || join_parts(&body, seams, parts, limits))?;
    draw::draw_sheets(&body, &seams, &sheets, missing, options.refold)
}
