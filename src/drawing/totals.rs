//! Summary of a drawing: numbers of sheets, seams, folds and tabs, and their total lengths.

use crate::math::planar::{distance, polyline_length};
use std::collections::BTreeMap;

use super::lines::Lines;
use super::sheet::DrawnSheet;
use crate::pattern::{Direction, Junction, Missing, Sheet, Simplified};

/// Minimum length of a joint whose sides are compared, as a share of the side of a square with the area of all
/// sheets.
const MIN_COMPARED_JOINT_SHARE: f64 = 0.1;

/// Summary of a drawing: numbers of sheets, seams, folds, tabs and pages; total lengths in millimetres; strain and
/// gaps.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "DrawingSummary", rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Totals {
    /// Number of sheets on the drawing.
    pub sheets: usize,
    /// Number of creases that are cut over their whole length or a part of it.
    pub seams: usize,
    /// Number of slits: cuts inside of a patch, made because the patch cannot be laid flat in one piece.
    pub slits: usize,
    /// Total length of the cuts along creases, in millimetres, each counted once.
    pub seam_length: f64,
    /// Total length of the slits (cuts inside of a patch), in millimetres, each counted once.
    pub slit_length: f64,
    /// Largest difference between the lengths of a joint's two sides, as a share of the longer one. Joints shorter than
    /// a tenth of the side of a square with the area of all sheets are ignored, as are steps of the surface, whose two
    /// sides are not joined.
    pub mismatch: f64,
    /// The joint with the largest difference between the lengths of its two sides, if any joint is compared.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub worst_joint: Option<WorstJoint>,
    /// Number of points inside of the surface where cuts or folds end and where the angles of the flat pieces were
    /// compared with that of the surface. Angles are measured within four fifths of the shortest seam that ends there,
    /// and within twenty spacings.
    pub points: usize,
    /// The point where the angles of the flat pieces differ most from that of the surface, if any was compared.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub worst_angle: Option<WorstAngle>,
    /// Number of creases along which a sheet is folded.
    pub folds: usize,
    /// Number of tabs (glued flaps) on the drawing.
    pub tabs: usize,
    /// Number of creases that are cut and have a tab on neither side, for want of room; 0 if no tabs are wanted.
    pub untabbed: usize,
    /// Number of cuts without a letter, for want of room on one side or both.
    #[cfg_attr(feature = "serde", serde(default))]
    pub unlettered: usize,
    /// Total length of all cut lines, in millimetres.
    pub cut_length: f64,
    /// Total length of all mountain folds, without those of tabs, in millimetres.
    pub mountain_length: f64,
    /// Total length of all valley folds, without those of tabs, in millimetres.
    pub valley_length: f64,
    /// Total area of the sheets without tabs, in square millimetres.
    pub area: f64,
    /// Largest strain (relative change of length) of a sheet, root mean square over its area; 0 if all sheets are
    /// exactly developable.
    pub strain: f64,
    /// Largest seam gap of a fold in millimetres: root mean square distance between the fold's two sides.
    pub seam_gap: f64,
    /// Largest root mean square distance between a refolded sheet and the surface, in millimetres; `None` unless
    /// [`PatternOptions::refold`](crate::pattern::PatternOptions::refold) was set.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub refolding: Option<f64>,
    /// Part of the surface that is on no sheet, if it is known ([`Drawing::of`](super::Drawing::of));
    /// areas in square millimetres.
    pub missing: Option<Missing>,
    /// The flat faces that stand for the surface, if it was simplified ([`Drawing::of`](super::Drawing::of)).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub simplified: Option<Simplified>,
    /// Number of pages of A4 paper that the drawing takes.
    pub a4: usize,
    /// Number of pages of Letter paper that the drawing takes.
    pub letter: usize,
}

/// The joint whose two sides differ most in length on the drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct WorstJoint {
    /// Number of the joint's crease, whose letter is on both sides of it ([`Label`](super::Label)).
    pub crease: usize,
    /// Numbers, from 0, of the patches on the two sides of the cut crease, in the order of `lengths`; on the drawing they are
    /// counted from 1.
    pub patches: [u32; 2],
    /// Lengths of the joint's two sides, in millimetres.
    pub lengths: [f64; 2],
}

/// Point of the surface where the sum of the angles of the flat pieces around it differs most from the angle of the
/// surface around it; angles in degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct WorstAngle {
    /// Position of the point on the surface in space, in the surface's units.
    pub place: [f64; 3],
    /// Number, from 0, of the crease that is cut at the point, the lowest of several, if any; its letter is on the drawing
    /// ([`Label`](super::Label)).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub crease: Option<usize>,
    /// Sum of the angles of the flat pieces that meet at the point, in degrees.
    pub flat: f64,
    /// Angle of the surface around the point, in degrees: 360° where the surface could be laid flat in one piece.
    pub surface: f64,
}

/// A crease that is cut, with the length of its side on either patch.
struct Joint {
    crease: usize,
    patches: [u32; 2],
    slit: bool,
    sides: [f64; 2],
}

impl Joint {
    /// Computes the difference between the lengths of the joint's two sides, as a share of the longer one.
    fn mismatch(&self) -> f64 {
        let [a, b] = self.sides;
        (a - b).abs() / a.max(b)
    }
}

fn joints(lines: &[Lines<'_>]) -> Vec<Joint> {
    let mut joints: BTreeMap<usize, Joint> = BTreeMap::new();
    for (run, curve) in lines.iter().flat_map(|own| own.outlines.iter().flatten()) {
        if let (Some(seam), Some(patch)) = (run.seam, run.patch) {
            let joint = joints.entry(seam.crease).or_insert(Joint {
                crease: seam.crease,
                patches: seam.patches,
                slit: seam.slit,
                sides: [0.0; 2],
            });
            joint.sides[usize::from(patch == seam.patches[1])] += curve.length();
        }
    }
    joints.into_values().collect()
}

pub(super) fn summary(
    drawn: &[DrawnSheet],
    sheets: &[Sheet],
    lines: &[Lines<'_>],
    scale: f64,
) -> Totals {
    let joints = joints(lines);
    let junctions = || sheets.iter().flat_map(|sheet| &sheet.junctions);
    let difference = |junction: &Junction| (junction.flat - junction.surface).abs();
    let folds = |direction: Direction| -> f64 {
        let lines = drawn.iter().flat_map(|sheet| &sheet.folds);
        let own = lines.filter(|line| line.direction == direction);
        // Not `sum`, which is −0 of nothing.
        own.map(|line| line.length).fold(0.0, |a, b| a + b)
    };
    let around = |cut: &Vec<[f64; 2]>| -> f64 {
        let closing = match (cut.last(), cut.first()) {
            (Some(last), Some(first)) => distance(*last, *first),
            _ => 0.0,
        };
        polyline_length(cut) + closing
    };
    let (creases, slits): (Vec<&Joint>, _) = joints.iter().partition(|joint| !joint.slit);
    let area = sheets.iter().map(|sheet| sheet.area).sum::<f64>();
    let least = MIN_COMPARED_JOINT_SHARE * scale * area.sqrt();
    let counts = |joint: &&Joint| joint.sides[0].min(joint.sides[1]) >= least;
    let worst = joints.iter().filter(counts);
    let worst = worst.max_by(|a, b| a.mismatch().total_cmp(&b.mismatch()));
    let long = |joints: &[&Joint]| -> f64 {
        joints
            .iter()
            .map(|j| 0.5 * (j.sides[0] + j.sides[1]))
            .fold(0.0, |a, b| a + b)
    };
    Totals {
        sheets: drawn.len(),
        seams: creases.len(),
        slits: slits.len(),
        seam_length: long(&creases),
        slit_length: long(&slits),
        mismatch: worst.map_or(0.0, Joint::mismatch),
        worst_joint: worst.map(|joint| WorstJoint {
            crease: joint.crease,
            patches: joint.patches,
            lengths: joint.sides,
        }),
        points: junctions().count(),
        worst_angle: junctions()
            .max_by(|a, b| difference(a).total_cmp(&difference(b)))
            .map(|junction| WorstAngle {
                place: junction.place,
                crease: junction.crease,
                flat: junction.flat.to_degrees(),
                surface: junction.surface.to_degrees(),
            }),
        folds: drawn.iter().map(|sheet| sheet.folds.len()).sum(),
        tabs: drawn.iter().map(|sheet| sheet.tabs.len()).sum(),
        untabbed: 0,
        unlettered: 0,
        cut_length: drawn.iter().flat_map(|sheet| &sheet.cuts).map(around).sum(),
        mountain_length: folds(Direction::Mountain),
        valley_length: folds(Direction::Valley),
        area: scale * scale * area,
        strain: sheets.iter().map(|sheet| sheet.strain).fold(0.0, f64::max),
        seam_gap: scale
            * sheets
                .iter()
                .map(|sheet| sheet.seam_gap)
                .fold(0.0, f64::max),
        refolding: (sheets.iter().filter_map(|sheet| sheet.refolding))
            .map(|refolding| scale * refolding.rms)
            .reduce(f64::max),
        missing: None,
        simplified: None,
        a4: 0,
        letter: 0,
    }
}
