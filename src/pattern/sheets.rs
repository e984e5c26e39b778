//! The types of a pattern: sheets, their outlines and folds.

use super::faces::Faces;
use crate::shape::patches::{Crease, Patch};

/// A surface cut into flat sheets.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Pattern {
    /// The flat sheets; the first is the one with the largest patch. Those of a heightfield are seen from above, those of a mesh
    /// from outside, the side that its triangles face.
    pub sheets: Vec<Sheet>,
    /// The patches of the sheets, the largest area first: the connected components of the patches that were given, or the parts
    /// that these were cut into.
    pub patches: Vec<Patch>,
    /// The creases between the patches, with the cuts inside of patches among them.
    pub creases: Vec<Crease>,
    /// Vertices, area and steps of the surface that are on no sheet.
    pub missing: Missing,
    /// The flat faces that stand for the surface, if it was simplified.
    pub simplified: Option<Simplified>,
}

/// Flat faces that stand for a surface which is simplified.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "SimplifiedSurface")
)]
#[non_exhaustive]
pub struct Simplified {
    /// Number of the faces.
    pub faces: usize,
    /// Root mean square distance of the surface's vertices from the faces: in the surface's unit, in drawings in millimetres.
    pub distance: f64,
}

/// What of a surface is on no sheet: vertices that were left out, and steps, with their areas in the surface's units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "MissingSurface", rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Missing {
    /// Number of vertices that were left out of the pattern because they do not lie flat and are too few to be cut further,
    /// mostly at ragged steep borders and torn tips, or are on sheets of less than a thousandth of the area.
    pub vertices: usize,
    /// Area around the vertices that were left out, in the surface's units squared.
    pub area: f64,
    /// Number of steps of the surface, which are edges where it jumps in height. The surface is cut at a step, and the
    /// steep wall between its two sides is on no sheet.
    pub steps: usize,
    /// Approximate area of the walls at steps, in the surface's units squared: their lengths times their heights.
    pub step_area: f64,
}

/// A flat sheet to be cut out, seen from above, the side of larger heights. Lengths are in the surface's units.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sheet {
    /// Numbers of the patches that the sheet consists of, ascending.
    pub patches: Vec<u32>,
    /// Outlines of the sheet: closed lines, the longest first, each divided into runs that begin where the run
    /// before ends. The sheet is to the left, so outlines of holes run clockwise.
    ///
    /// Along a crease of a heightfield the outline is the line in which the continuations of both patches meet, smoothed in space.
    /// Both sides of a cut are equally long, as far as the limit of strain allows
    /// ([`Totals::mismatch`](crate::drawing::Totals::mismatch)). Along the border of a heightfield the outline
    /// is within half a spacing of the midpoints of the lattice's border edges.
    pub outlines: Vec<Vec<Run>>,
    /// Lines along which the sheet is folded, in the order of their creases' numbers.
    pub folds: Vec<Fold>,
    /// For each patch, in the order of the patches, a place for its label far from the patch's border. Parts of one patch that were
    /// joined again have one label, with the lowest of their numbers.
    pub spots: Vec<Spot>,
    /// Triangles of the sheet, with their positions on the surface and in the plane.
    pub faces: Faces,
    /// Mean edge length of the mesh that was cut: the resolution of the sheet's outlines and folds.
    pub spacing: f64,
    /// Area of the surface that the sheet covers, in the surface's units squared.
    pub area: f64,
    /// Strain of the sheet, root mean square over its area; 0 for a sheet that is exactly developable.
    pub strain: f64,
    /// Largest seam gap of a fold: root mean square distance between its two sides before they were joined.
    pub seam_gap: f64,
    /// Points inside of the surface where cuts or folds end, each on one of the sheets that meet there.
    pub junctions: Vec<Junction>,
    /// Distance of the refolded sheet from the surface; `None` unless
    /// [`PatternOptions::refold`](super::PatternOptions::refold) is set.
    pub refolding: Option<Refolding>,
    /// Whether the sheet consists of faces moved into the plane as they are, so that its arcs are those of circles.
    pub exact: bool,
}

/// Distance between the surface and a sheet that was folded along its folds and bent in space with the least
/// strain, measured at the sheet's vertices in the surface's units.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Refolding {
    /// Root mean square distance of the refolded sheet's vertices from the surface, in the surface's units.
    pub rms: f64,
    /// Largest distance of a refolded sheet's vertex from the surface, in the surface's units.
    pub maximum: f64,
    /// Root mean square strain, over the area, that is left in the folded sheet.
    pub strain: f64,
}

/// A piece of an outline that follows one side of a crease, or the surface's border.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Run {
    /// The crease that is cut along this run; `None` along the border.
    pub seam: Option<Seam>,
    /// Number of the patch whose side of the crease the run follows; `None` along the border.
    pub patch: Option<u32>,
    /// Polyline of the run on the flat sheet: at least two points; the first one is repeated at the end where the run
    /// is a whole outline.
    pub points: Vec<[f64; 2]>,
}

/// A line along which a sheet is folded.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Fold {
    /// The crease along which the sheet is folded.
    pub seam: Seam,
    /// The bend that the fold is a part of, where the surface turns by several folds beside each other.
    pub bend: Option<Bend>,
    /// Polyline of the fold on the flat sheet: at least two points; the first one is repeated at the end where the fold
    /// is closed.
    pub points: Vec<[f64; 2]>,
}

impl Fold {
    /// Whether the fold is one to make: it belongs to a smooth bend, or its angle does not round to 0°, which is
    /// what drawings would call it.
    pub(crate) fn is_made(&self) -> bool {
        self.bend.is_some() || self.seam.angle.to_degrees().round() > 0.0
    }
}

/// A smooth bend of a model with exact faces: a piece of a cylinder or cone, which is folded along several lines.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Bend {
    /// Number of the bend, the same for all of its folds and for no other bend's.
    pub number: u32,
    /// Angle by which all folds of the bend turn together, in radians, and the line along which a bend all around is cut.
    pub angle: f64,
    /// Radius of the surface in the bend, in the surface's units; the mean one of a cone.
    pub radius: f64,
    /// Length of the flat facets across the bend for each radian that it turns, in the surface's units: the radius of a circle, and
    /// a little less of its chords.
    pub chord_radius: f64,
    /// Whether the fold is the one in the middle of the bend.
    pub is_middle: bool,
}

/// A point inside of the surface where cuts or folds end, with the angles around it, measured within four fifths of the shortest seam
/// that ends there and within twenty edge lengths of the mesh that was cut.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Junction {
    /// Position of the point on the surface, in the surface's units.
    pub place: [f64; 3],
    /// The crease that is cut and ends at the point, the lowest of several, by its index in [`Pattern::creases`]; `None` if only folds end
    /// there.
    pub crease: Option<usize>,
    /// Sum of the angles of the surface around the point, in radians: 2π where the surface could be laid flat in
    /// one piece, less at the tip of a cone, more at a saddle.
    pub surface: f64,
    /// Sum of the angles of the flat pieces around the point, in radians.
    pub flat: f64,
}

/// A crease or cut on the border of a sheet or within it: the patches on either side, the fold angle and the kind.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Seam {
    /// The crease that the seam follows, by its index in [`Pattern::creases`].
    pub crease: usize,
    /// Numbers of the patches on either side of the seam, the lower one first.
    pub patches: [u32; 2],
    /// Whether the crease is a mountain or a valley fold.
    pub direction: Direction,
    /// Fold angle of the crease in radians: 0 where the surface is smooth.
    pub angle: f64,
    /// Whether this is a cut inside of a patch that cannot be laid flat in one piece, and not a crease of the
    /// surface.
    pub slit: bool,
}

/// The direction in which a sheet is folded, seen from above.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "FoldDirection", rename_all = "lowercase")
)]
#[non_exhaustive]
pub enum Direction {
    /// A ridge: the fold points towards the viewer.
    Mountain,
    /// A groove: the fold points away from the viewer.
    Valley,
}

impl Direction {
    /// Returns the direction of a fold that is a ridge or a groove.
    pub(super) fn from_ridge(is_ridge: bool) -> Direction {
        match is_ridge {
            true => Direction::Mountain,
            false => Direction::Valley,
        }
    }
}

/// A position on a flat sheet for the number of a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Spot {
    /// Number of the patch that the position is for.
    pub patch: u32,
    /// Position of the label on the flat sheet, in the surface's units.
    pub place: [f64; 2],
    /// Approximate distance from the label's place to the patch's border, in the surface's units.
    pub room: f64,
}
