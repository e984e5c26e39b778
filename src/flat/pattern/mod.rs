//! Patterns: a surface cut along its creases into sheets that lie flat, with as few cuts as
//! possible.
//!
//! Each patch is laid flat by itself, up to the line where its neighbours' continuations meet its
//! own ([`Sheet::outlines`] says what that line is worth). Patches are then laid beside each other
//! where their sides of a crease fit and nothing comes to lie on anything else, the longest creases
//! first; such a crease is a fold, every other one a cut. Around a vertex where the angles make up
//! a full turn, all creases are folds.
//!
//! ```
//! use developable::patches::{PatchOptions, Patches};
//! use developable::pattern::{Direction, PatternOptions, pattern};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // A folded card: two patches, one sheet.
//! let card = Heightfield::from_fn(Lattice::new(40, 40, 0.025)?, |x, _| -0.5 * (x - 0.52).abs())?;
//! let patches = Patches::new(&card, &PatchOptions::default())?;
//! let sheets = pattern(&card, &patches, &PatternOptions::default())?;
//! assert_eq!(sheets.len(), 1);
//! assert_eq!(sheets[0].patches, [0, 1]);
//! let fold = &sheets[0].folds[0];
//! assert_eq!((fold.seam.crease, fold.seam.direction), (0, Direction::Mountain));
//! # Ok(())
//! # }
//! ```

mod layout;
mod leaf;
mod line;
mod net;
mod outline;
mod shape;
mod spots;

use super::unroll::UnrollOptions;
use crate::error::{Result, positive};
use crate::heights::heightfield::Heightfield;
use crate::shape::patches::Patches;
use layout::arranged;
use net::Net;
use shape::{folds, outlines};
use spots::spots;

/// What may stay together.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PatternOptions {
    /// How far the two sides of a fold may be from each other on the flat sheet (root of the mean
    /// square), as a share of the fold's length; a quarter of the lattice's spacing is always
    /// allowed. Default 0.005.
    pub gap: f64,
    /// How patches are laid flat.
    pub unrolling: UnrollOptions,
}

impl Default for PatternOptions {
    fn default() -> Self {
        PatternOptions {
            gap: 0.005,
            unrolling: UnrollOptions::default(),
        }
    }
}

impl PatternOptions {
    /// These options with another gap.
    pub fn gap(self, gap: f64) -> Self {
        PatternOptions { gap, ..self }
    }

    /// These options with another way to lay patches flat.
    pub fn unrolling(self, unrolling: UnrollOptions) -> Self {
        PatternOptions { unrolling, ..self }
    }
}

/// A sheet to be cut out, as it is seen from above, from where the heights point. Lengths are in
/// the surface's units.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sheet {
    /// Its patches, ascending.
    pub patches: Vec<u32>,
    /// Where it is cut: closed lines, the sheet to the left of them, so that holes run clockwise;
    /// the longest first. Each run begins where the one before ends.
    ///
    /// Along creases they are where the patches' continuations meet, smoothed over a spacing or
    /// two; both sides of a cut have the same length but for the strain. Elsewhere they follow the
    /// border of the lattice's whole triangles, its zigzag taken to the middle of its edges.
    pub outlines: Vec<Vec<Run>>,
    /// Where it is folded, by the creases' numbers.
    pub folds: Vec<Fold>,
    /// A place well inside of each patch, in the order of the patches.
    pub spots: Vec<Spot>,
    /// Area of the surface that it is made of.
    pub area: f64,
    /// What strain is left in the patches: root of the mean square. 0 for what can be unrolled.
    pub strain: f64,
    /// How far the sides of its folds were from each other at most (root of the mean square along
    /// a fold); the folds lie halfway.
    pub gap: f64,
}

/// A piece of an outline: of one side of a crease, or of the surface's border.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Run {
    /// The crease that is cut here; `None` for the border.
    pub seam: Option<Seam>,
    /// Which of the crease's two patches this is the side of; `None` for the border.
    pub patch: Option<u32>,
    /// At least two; the first one again at the end where the run is a whole outline.
    pub points: Vec<[f64; 2]>,
}

/// A line along which a sheet is folded.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Fold {
    /// The crease.
    pub seam: Seam,
    /// At least two; the first one again at the end where it is closed.
    pub points: Vec<[f64; 2]>,
}

/// What becomes of a sheet's edge or of a line on it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Seam {
    /// The crease, by its place in [`Patches::creases`].
    pub crease: usize,
    /// The patches on either side of it, the lower number first.
    pub patches: [u32; 2],
    /// Which way it is folded.
    pub direction: Direction,
    /// By how much, in radians: 0 is flat.
    pub angle: f64,
}

/// Which way a sheet is folded, seen from above.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
#[non_exhaustive]
pub enum Direction {
    /// A ridge: the fold points to the viewer.
    Mountain,
    /// A groove.
    Valley,
}

/// A place to write on.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Spot {
    /// The patch.
    pub patch: u32,
    /// The place.
    pub place: [f64; 2],
    /// About how far it is from the patch's border.
    pub room: f64,
}

/// Cuts a surface into sheets, that with the largest patch first.
///
/// Costs one unrolling of each patch, `O(vertices)` altogether, and for each crease a walk around
/// the sheets on either side.
///
/// # Errors
/// [`Error::Shape`](crate::Error::Shape) or [`Error::Mismatch`](crate::Error::Mismatch) if the
/// patches are those of another surface,
/// [`Error::Option`](crate::Error::Option) for a gap that is not positive and finite, and what
/// [`unroll`](super::unroll::unroll) has to say.
pub fn pattern(
    surface: &Heightfield,
    patches: &Patches,
    options: &PatternOptions,
) -> Result<Vec<Sheet>> {
    patches.check_of(surface)?;
    let gap = positive("gap", options.gap)?;
    let net = Net::new(surface, patches, &options.unrolling)?;
    let arrangement = arranged(&net, gap);
    let places = spots(surface, patches.labels(), &net, &arrangement.layout);
    let seam = |crease: usize| Seam {
        crease,
        patches: net.seams[crease].patches,
        direction: match net.seams[crease].rise > 0.0 {
            true => Direction::Mountain,
            false => Direction::Valley,
        },
        angle: patches.creases()[crease].fold,
    };
    let sheets = arrangement.sheets.iter().map(|(members, gap)| {
        let outlines = outlines(&net, &arrangement.layout, members, seam);
        let flat = |patch: &u32| net.leaves[*patch as usize].as_ref().map(|leaf| leaf.flat());
        let (mut squares, mut area) = (0.0, 0.0);
        for sheet in members.iter().filter_map(flat) {
            let report = sheet.report();
            squares += report.area * report.distortion.rms.powi(2);
            area += report.area;
        }
        let own = |patch: &u32| patches.patches()[*patch as usize].area;
        Sheet {
            folds: folds(&net, &arrangement.layout, members, &outlines, seam),
            outlines,
            spots: members.iter().map(|p| places[*p as usize]).collect(),
            area: members.iter().map(own).sum(),
            strain: if area > 0.0 {
                (squares / area).sqrt()
            } else {
                0.0
            },
            gap: *gap,
            patches: members.clone(),
        }
    });
    Ok(sheets.collect())
}
