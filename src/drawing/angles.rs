//! Compares the angles of the flat pieces around a point with the angle of the surface there.

use crate::math::planar::polyline_length;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::curve::Curve;
use super::line::{FLATTENING_TOLERANCE_MM, place_at};
use super::lines::Lines;
use crate::pattern::{Junction, Run, Sheet};
use crate::unroll::flat_triangle::Point;

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

impl WorstAngle {
    pub(super) fn difference(&self) -> f64 {
        (self.flat - self.surface).abs()
    }
}

/// Sum of the angles of the flat pieces around a point of the surface where cuts or folds end, over the pieces added so
/// far.
struct PointAngles {
    meeting: Junction,
    /// Number of ends of cut edges that were found at the point: twice the number of cuts when all are found, because
    /// both sides of a cut are edges of flat pieces.
    ends: usize,
    angle: f64,
    crease: Option<usize>,
}

/// Compares the angles of the flat pieces with the angle of the surface at each point inside of the surface where
/// cuts or folds end; points that cannot be measured are left out.
pub(super) fn angles(sheets: &[Sheet], lines: &[Lines<'_>], scale: f64) -> Vec<WorstAngle> {
    let mut all: BTreeMap<usize, PointAngles> = BTreeMap::new();
    let mut add = |meeting: &Junction, ends: usize, angle: f64, crease: Option<usize>| {
        let around = all.entry(meeting.number).or_insert(PointAngles {
            meeting: *meeting,
            ends: 0,
            angle: 0.0,
            crease: None,
        });
        around.ends += ends;
        around.angle += angle;
        around.crease = [around.crease, crease].into_iter().flatten().min();
    };
    for fold in sheets.iter().flat_map(|sheet| &sheet.folds) {
        (fold.ends.iter().flatten()).for_each(|meeting| add(meeting, 0, 0.0, None));
    }
    for outline in lines.iter().flat_map(|own| &own.outlines) {
        for (k, (run, _)) in outline.iter().enumerate() {
            if is_within(run) {
                continue;
            }
            let crease = run.seam.map(|seam| seam.crease);
            let ends = run.ends.iter().flatten();
            ends.for_each(|meeting| add(meeting, 1, 0.0, crease));
            if let Some(meeting) = run.ends[1] {
                add(&meeting, 0, corner(outline, k, &meeting, scale), None);
            }
        }
    }
    let compared = all.into_values().filter_map(|around| {
        let Junction {
            cuts,
            angle: surface,
            ..
        } = around.meeting;
        // Ends may be missing because they were cut off with a loop.
        (around.ends == 2 * cuts).then(|| {
            // Angles are known modulo 2π: a slit that is hardly open has an angle near 2π or near 0.
            let turns = ((surface - around.angle) / TAU).round();
            let flat = if cuts == 0 {
                TAU
            } else {
                around.angle + turns * TAU
            };
            WorstAngle {
                place: around.meeting.place,
                crease: around.crease,
                flat: flat.to_degrees(),
                surface: surface.to_degrees(),
            }
        })
    });
    compared.collect()
}

/// Returns whether a run (a piece of an outline between two seams) is degenerate: it begins and ends at the same
/// meeting point of seams and is shorter than the radius in which angles are measured there.
fn is_within(run: &Run) -> bool {
    match run.ends {
        [Some(from), Some(to)] => {
            from.number == to.number && polyline_length(&run.points) < from.reach
        }
        _ => false,
    }
}

/// Computes the angle of a flat sheet at the corner between outline piece `k` and the next one, in radians, measured at
/// the same distance from the corner as the angle of the surface.
fn corner(outline: &[(&Run, Curve)], k: usize, meeting: &Junction, scale: f64) -> f64 {
    let count = outline.len();
    let mut next = (1..=count).map(|i| (k + i) % count);
    let next = next.find(|i| !is_within(outline[*i].0)).unwrap_or(k);
    let reach = scale * meeting.reach;
    let mut back = outline[k].1.points(FLATTENING_TOLERANCE_MM);
    back.reverse();
    let [back, on] = [back, outline[next].1.points(FLATTENING_TOLERANCE_MM)].map(|points| {
        let [from, to] = [0.5, 1.0].map(|share| place_at(&points, share * reach).0);
        Point::new(to[0] - from[0], to[1] - from[1])
    });
    (on.conj() * back).arg().rem_euclid(TAU)
}
