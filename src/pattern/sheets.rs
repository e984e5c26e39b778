//! What a pattern is: sheets, their outlines and folds.

use super::faces::Faces;
use super::meeting::Meeting;
use crate::shape::patches::Patches;

/// A heightfield cut into sheets.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Pattern {
    /// The sheets, that with the largest patch first.
    pub sheets: Vec<Sheet>,
    /// The patches of the sheets and the creases between them: those that were given, if none of
    /// them was cut, or else what they were cut into, with the cuts among the creases.
    pub patches: Patches,
    /// Vertices, area and steps of the surface that are on no sheet.
    pub missing: Missing,
}

/// Vertices, area and steps of a surface that are on no sheet, in the surface's units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Missing {
    /// Number of vertices that were left out because nothing around them lies flat with them: ragged steep
    /// borders and torn tips, mostly, and a fiftieth of all at most.
    pub vertices: usize,
    /// Area around the vertices that were left out.
    pub area: f64,
    /// Number of steps of the surface, whose sides are cut apart: the wall between them is missing.
    pub steps: usize,
    /// Approximate area of the walls at steps: their lengths times their heights.
    pub step_area: f64,
}

/// A sheet to be cut out, as it is seen from above, from where the heights point. Lengths are in
/// the surface's units.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sheet {
    /// Numbers of the sheet's patches, ascending.
    pub patches: Vec<u32>,
    /// Closed lines along which the sheet is cut, the longest first. The sheet is to their left, so that
    /// holes run clockwise; each run begins where the one before ends.
    ///
    /// Along creases they are where the patches' continuations meet, smoothed over a spacing or
    /// two; both sides of a cut have the same length but for the strain, and are drawn equally long
    /// ([`Drawing`](crate::drawing::Drawing)). Elsewhere they follow the
    /// border of the lattice's whole triangles, its zigzag taken to the middle of its edges.
    pub outlines: Vec<Vec<Run>>,
    /// Lines along which the sheet is folded, by the numbers of their creases.
    pub folds: Vec<Fold>,
    /// A place well inside of each patch, in the order of the patches.
    pub spots: Vec<Spot>,
    /// Triangles of the sheet, built and flat.
    pub faces: Faces,
    /// Spacing of the lattice, or mean edge length of the mesh: the resolution of these lines.
    pub spacing: f64,
    /// Area of the surface that the sheet is made of.
    pub area: f64,
    /// Strain of the sheet: root of the mean square over its area; 0 for what can be unrolled.
    pub strain: f64,
    /// Largest distance between the sides of a fold (root of the mean square along it); the folds lie
    /// halfway.
    pub gap: f64,
    /// Number of small loops in which outlines crossed themselves, and which were cut off.
    pub loops: usize,
    /// Distance of the folded sheet from the surface, if that was asked for
    /// ([`PatternOptions::refold`](super::PatternOptions::refold)).
    pub refolding: Option<Refolding>,
}

/// Distance of a sheet from the surface when it is folded along its lines and bent until nothing is
/// stretched: distances of its vertices, in the surface's units.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Refolding {
    /// Root mean square of the distances.
    pub rms: f64,
    /// Largest of the distances.
    pub maximum: f64,
    /// Strain that is left in the folded sheet: root of the mean square.
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
    /// Points inside of the surface where the run begins and ends; `None` at the border.
    pub ends: [Option<Meeting>; 2],
    /// At least two points; the first one is repeated at the end where the run is a whole outline.
    pub points: Vec<[f64; 2]>,
}

/// A line along which a sheet is folded.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Fold {
    /// The crease that is folded.
    pub seam: Seam,
    /// Points inside of the surface where the fold begins and ends; `None` at the border.
    pub ends: [Option<Meeting>; 2],
    /// At least two points; the first one is repeated at the end where the fold is closed.
    pub points: Vec<[f64; 2]>,
}

/// A crease or cut as it is on a sheet: its patches, its fold and its kind.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Seam {
    /// The crease, by its place in the [`Patches::creases`] of [`Pattern::patches`].
    pub crease: usize,
    /// The patches on either side of it, the lower number first.
    pub patches: [u32; 2],
    /// Whether the crease is a mountain or a valley fold.
    pub direction: Direction,
    /// Fold angle in radians: 0 is flat.
    pub angle: f64,
    /// Whether it is a cut inside of a patch, which cannot be laid flat in one piece, and no crease of the
    /// surface.
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
    /// A groove: the fold points away from the viewer.
    Valley,
}

/// A place on a sheet for the number of a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Spot {
    /// Number of the patch.
    pub patch: u32,
    /// Position on the sheet.
    pub place: [f64; 2],
    /// Approximate distance of the place from the patch's border.
    pub room: f64,
}
