//! What a pattern is: sheets, their outlines and folds.

use super::faces::Faces;
use super::meeting::Meeting;
use crate::shape::patches::Patches;

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
    /// ([`Drawing`](crate::drawing::Drawing)). Elsewhere they follow the
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
    /// How near it comes to the surface, if that was asked for ([`PatternOptions::refold`](super::PatternOptions::refold)).
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
