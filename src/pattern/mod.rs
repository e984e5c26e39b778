//! Patterns: a surface cut along its creases into sheets that lie flat, with as few cuts as
//! possible.
//!
//! Each patch is laid flat by itself, up to the line where its neighbours' continuations meet its
//! own ([`Sheet::outlines`] says what that line is worth). Patches are then laid beside each other
//! where their sides of a crease fit and nothing comes to lie on anything else, the longest creases
//! first; such a crease is a fold, every other one a cut. Around a vertex where the angles make up
//! a full turn, all creases are folds. What cannot be laid flat without strain is cut until it can.
//!
//! ```
//! use developable::patches::{PatchOptions, Patches};
//! use developable::pattern::{Direction, PatternOptions, pattern};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // A folded card: two patches, one sheet.
//! let card = Heightfield::from_fn(Lattice::new(40, 40, 0.025)?, |x, _| -0.5 * (x - 0.52).abs())?;
//! let patches = Patches::new(&card, &PatchOptions::default())?;
//! let sheets = pattern(&card, &patches, &PatternOptions::default())?.sheets;
//! assert_eq!(sheets.len(), 1);
//! assert_eq!(sheets[0].patches, [0, 1]);
//! let fold = &sheets[0].folds[0];
//! assert_eq!((fold.seam.crease, fold.seam.direction), (0, Direction::Mountain));
//! # Ok(())
//! # }
//! ```

mod assembly;
mod check;
mod faces;
mod fine;
mod labels;
mod layout;
mod leaf;
mod line;
mod meeting;
mod mesh;
mod net;
mod outline;
mod parts;
mod refold;
mod sew;
mod shape;
mod simple;
mod spots;
mod trim;

use super::unroll::UnrollOptions;
use crate::error::{Error, Result, positive};
use crate::heights::heightfield::Heightfield;
use crate::shape::patches::Patches;
use assembly::{Assembled, Assembly, assembled, drawn};
pub use faces::Faces;
use fine::{Coarse, refined};
pub use meeting::Meeting;
pub use mesh::{MeshPattern, pattern_mesh};
use parts::Parts;
pub(crate) use simple::without_loops;

/// What may stay together.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PatternOptions {
    /// How far the two sides of a fold may be from each other on the flat sheet (root of the mean
    /// square), as a share of the fold's length; a quarter of the lattice's spacing is always
    /// allowed. Default 0.005.
    pub gap: f64,
    /// The most strain that a sheet may be laid flat with (root of the mean square over its area).
    /// Default 0.01.
    pub max_strain: f64,
    /// How patches are laid flat.
    pub unrolling: UnrollOptions,
    /// Whether sheets are folded back to see how near they come to the surface; that takes about as long
    /// as laying them flat. Default `false`.
    pub refold: bool,
}

impl Default for PatternOptions {
    fn default() -> Self {
        PatternOptions {
            gap: 0.005,
            max_strain: 0.01,
            unrolling: UnrollOptions::default(),
            refold: false,
        }
    }
}

impl PatternOptions {
    /// These options with another gap.
    pub fn gap(self, gap: f64) -> Self {
        PatternOptions { gap, ..self }
    }

    /// These options with another limit of the strain.
    pub fn max_strain(self, max_strain: f64) -> Self {
        PatternOptions { max_strain, ..self }
    }

    /// These options with sheets folded back.
    pub fn refold(self, refold: bool) -> Self {
        PatternOptions { refold, ..self }
    }

    /// These options with another way to lay patches flat.
    pub fn unrolling(self, unrolling: UnrollOptions) -> Self {
        PatternOptions { unrolling, ..self }
    }
}

/// A surface cut into sheets.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Pattern {
    /// The sheets, that with the largest patch first.
    pub sheets: Vec<Sheet>,
    /// The patches of the sheets and the creases between them: those that were given, if none of
    /// them was cut, or else what they were cut into, with the cuts among the creases.
    pub patches: Patches,
    /// What of the surface is on no sheet.
    pub missing: Missing,
}

/// What of a surface is on no sheet, in its units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Missing {
    /// Vertices that were left out because nothing around them lies flat with them: ragged steep
    /// borders and torn points of them, mostly, and a fiftieth of all at most.
    pub vertices: usize,
    /// The area around them.
    pub area: f64,
    /// Steps of the surface, whose sides are cut apart: what would stand between them is not there.
    pub steps: usize,
    /// About how large these are: their lengths times how high they are.
    pub step_area: f64,
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
    /// two; both sides of a cut have the same length but for the strain, and are drawn equally long
    /// ([`Drawing`](super::drawing::Drawing)). Elsewhere they follow the
    /// border of the lattice's whole triangles, its zigzag taken to the middle of its edges.
    pub outlines: Vec<Vec<Run>>,
    /// Where it is folded, by the creases' numbers.
    pub folds: Vec<Fold>,
    /// A place well inside of each patch, in the order of the patches.
    pub spots: Vec<Spot>,
    /// The surface that it is made of.
    pub faces: Faces,
    /// Distance of neighbours on the lattice, which says how fine these lines can be.
    pub spacing: f64,
    /// Area of the surface that it is made of.
    pub area: f64,
    /// What strain is left in it: root of the mean square over its area. 0 for what can be unrolled.
    pub strain: f64,
    /// How far the sides of its folds were from each other at most (root of the mean square along
    /// a fold); the folds lie halfway.
    pub gap: f64,
    /// Small loops in which its outlines crossed themselves, and which were cut off.
    pub loops: usize,
    /// How near it comes to the surface, if that was asked for ([`PatternOptions::refold`]).
    pub refolding: Option<Refolding>,
}

/// How near a sheet comes to the surface where it is folded along its lines and bent until nothing of
/// it is stretched: distances of its vertices, in the surface's units.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Refolding {
    /// Root of the mean square.
    pub rms: f64,
    /// The largest.
    pub maximum: f64,
    /// What is left of strain in it: root of the mean square.
    pub strain: f64,
}

/// A piece of an outline: of one side of a crease, or of the surface's border.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Run {
    /// The crease that is cut here; `None` for the border.
    pub seam: Option<Seam>,
    /// Which of the crease's two patches this is the side of; `None` for the border.
    pub patch: Option<u32>,
    /// Where it begins and ends, if that is inside of the surface.
    pub ends: [Option<Meeting>; 2],
    /// At least two; the first one again at the end where the run is a whole outline.
    pub points: Vec<[f64; 2]>,
}

/// A line along which a sheet is folded.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Fold {
    /// The crease.
    pub seam: Seam,
    /// Where it begins and ends, if that is inside of the surface.
    pub ends: [Option<Meeting>; 2],
    /// At least two; the first one again at the end where it is closed.
    pub points: Vec<[f64; 2]>,
}

/// What becomes of a sheet's edge or of a line on it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Seam {
    /// The crease, by its place in the [`Patches::creases`] of [`Pattern::patches`].
    pub crease: usize,
    /// The patches on either side of it, the lower number first.
    pub patches: [u32; 2],
    /// Which way it is folded.
    pub direction: Direction,
    /// By how much, in radians: 0 is flat.
    pub angle: f64,
    /// Whether it is no crease of the surface but a cut through what was one patch, because that cannot
    /// be laid flat in one piece.
    pub slit: bool,
    /// Whether the surface has a step here: its sides are apart in space, and are not joined.
    pub torn: bool,
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
/// Every sheet has a simple outline and is strained by no more than [`PatternOptions::max_strain`]: what
/// cannot be laid flat so is cut. A patch that is strained by more is cut in two where it is strained
/// most, as often as it takes, and its parts are joined again as far as their sides fit, so that a cone is
/// slit and a dome gets darts. Where a crease's sides fit along a part of it only, it is opened along the
/// rest. Then cuts are closed again, whole or in part, where strain and outlines allow it. What is too small to be
/// cut and lies flat with nothing beside it is left out, a fiftieth of the vertices at most
/// ([`Pattern::missing`]).
///
/// Surfaces of more than twelve thousand vertices are cut on the lattice of twice the spacing, and so on;
/// on their own lattice that costs one unrolling. What is cut there costs an unrolling of each part, two
/// or three for what is cut again, and up to 800 steps of `O(vertices)` for closing cuts.
///
/// # Errors
/// [`Error::Shape`] or [`Error::Mismatch`] if the
/// patches are those of another surface,
/// [`Error::Option`] for a gap or a strain that is not positive and finite,
/// [`Error::NotFlat`] for what no cut makes flat, and what
/// [`unroll`](super::unroll::unroll) has to say.
pub fn pattern(
    surface: &Heightfield,
    patches: &Patches,
    options: &PatternOptions,
) -> Result<Pattern> {
    patches.check_of(surface)?;
    positive("gap", options.gap)?;
    positive("maxStrain", options.max_strain)?;
    drawn(
        surface,
        &whole(surface, patches, options, DIRECT_OUTLINE_DETAIL)?,
    )
}

/// Strain limits on a coarse lattice, as shares of the limit on the fine one, tried in this order: the next is
/// used where sheets were strained too much on the fine lattice.
const COARSE_STRAIN_SHARES: [f64; 2] = [0.9, 0.7];

/// Smallest detail of outlines, in spacings, on a lattice that is not refined: if larger loops are cut off, the
/// two sides of a joint differ.
const DIRECT_OUTLINE_DETAIL: f64 = 0.4;

/// Cuts and joins on a coarse lattice where there are many vertices.
fn whole(
    surface: &Heightfield,
    patches: &Patches,
    options: &PatternOptions,
    mut finest: f64,
) -> Result<Assembled> {
    if let Some(coarse) = Coarse::new(surface, patches)? {
        finest = 1.0;
        for margin in COARSE_STRAIN_SHARES {
            let stricter = options.max_strain(margin * options.max_strain);
            let rough = match whole(&coarse.surface, &coarse.patches, &stricter, finest) {
                Err(Error::NotFlat { .. }) => break,
                other => other?,
            };
            let parts = Parts::none(surface, options);
            if let Ok(found) = refined(surface, patches, &coarse, &rough, parts)? {
                return Ok(found);
            }
        }
    }
    loop {
        match direct(surface, patches, options, finest) {
            Err(Error::NotFlat { .. }) if finest < 1.0 => finest = 1.0,
            other => return other,
        }
    }
}

/// Cuts and joins until every sheet is as it should be.
fn direct(
    surface: &Heightfield,
    patches: &Patches,
    options: &PatternOptions,
    finest: f64,
) -> Result<Assembled> {
    let mut parts = Parts::new(surface, patches, options)?;
    parts.finest = finest;
    parts.cut_strained()?;
    parts.give_away_crumbs()?;
    // What is not as it should be is cut further; what is too small goes to what is beside it, or is
    // left out.
    let mut rounds = 0;
    loop {
        let faults = match assembled(parts, patches, options)? {
            Assembly::Whole(whole) => return Ok(*whole),
            Assembly::Cut(again, faults) => {
                parts = *again;
                faults
            }
        };
        rounds += 1;
        let mut small = Vec::new();
        for (part, reason) in faults {
            if !parts.cut(part)? {
                small.push((part, reason));
            }
        }
        parts.cut_strained()?;
        // Numbers change as parts go: from the last one on.
        small.sort_unstable();
        for (part, reason) in small.into_iter().rev() {
            let gone =
                rounds <= MAX_MERGE_ROUNDS && (parts.give_away(part)? || parts.leave_out(part)?);
            if !gone {
                return Err(parts.refused(part, reason));
            }
        }
    }
}

/// Maximum number of rounds in which parts that are too small to be cut are merged or left out.
const MAX_MERGE_ROUNDS: usize = 24;
