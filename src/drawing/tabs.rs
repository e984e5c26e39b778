//! Adds tabs (glued flaps) along cut creases: trapezoids outside of the sheet, a comb of short ones along a curve.

use super::curve::{Curve, POLYLINE_CORNER_ANGLE};
use super::line::FLATTENING_TOLERANCE_MM;
use crate::math::planar::{distance, polyline_length, segments_intersect};
use crate::pattern::{Run, Seam};

/// A tab (a glued flap at an edge), and the line that the tab is folded along.
pub(super) struct Tab {
    pub seam: Seam,
    /// Fold line between tab and sheet, in the direction of the outline.
    pub base: Curve,
    pub depth: f64,
    pub middle: [f64; 2],
}

/// Maximum angle, in radians, by which a tab's fold line turns in all.
const MAX_TAB_BEND: f64 = 0.3;

/// Minimum length of a tab's fold line, in millimetres.
const MIN_TAB_LENGTH_MM: f64 = 2.0;

/// Maximum inset of a tab's ends, which are cut at 45°, as a share of the length of the tab's fold line.
const MAX_TAB_INSET_SHARE: f64 = 0.3;

/// Maximum depth of a tab, as a multiple of the length of its fold line.
const MAX_TAB_DEPTH_SHARE: f64 = 1.5;

/// Maximum number of times that the depth of a tab that does not fit is halved.
const MAX_TAB_HALVINGS: usize = 2;

/// The closed outline of a sheet as a list of runs (pieces along one side of a crease or along the border), each with
/// its curve in millimetres.
type Outline<'a> = Vec<(&'a Run, Curve)>;

/// Adds tabs (glued flaps) to the outlines of a sheet where there is room. Returns the cut lines and the tabs.
pub(super) fn add_tabs(outlines: &[Outline<'_>], depth: Option<f64>) -> (Vec<Curve>, Vec<Tab>) {
    let mut tabs = Vec::new();
    // Tabs are on the side of the patch with the lower number. The two sides of a step are not glued, so they have
    // no tabs.
    let tabbed = |run: &Run| {
        let first = |seam: &Seam| run.patch == Some(seam.patches[0]) && !seam.torn;
        let own = run.seam.filter(first);
        depth.zip(own)
    };
    let parts = |(run, curve): &(&Run, Curve)| match tabbed(run) {
        Some(_) => bases(curve),
        None => vec![curve.clone()],
    };
    let pieces: Vec<Vec<Vec<Curve>>> = (outlines.iter())
        .map(|outline| outline.iter().map(parts).collect())
        .collect();
    // Segments that tabs must not touch: all outlines, and the tabs added so far.
    let mut walls: Vec<[[f64; 2]; 2]> = Vec::new();
    if depth.is_some() {
        for piece in pieces.iter().flatten().flatten() {
            walls.extend(
                piece
                    .points(FLATTENING_TOLERANCE_MM)
                    .windows(2)
                    .map(|p| [p[0], p[1]]),
            );
        }
    }
    let mut cuts = Vec::new();
    for (outline, pieces) in outlines.iter().zip(pieces) {
        let mut cut = Curve::of(Vec::new());
        for ((run, curve), bases) in outline.iter().zip(pieces) {
            let Some((depth, seam)) = tabbed(run) else {
                cut.append(curve);
                continue;
            };
            for base in bases {
                let points = base.points(FLATTENING_TOLERANCE_MM);
                let tab = (0..=MAX_TAB_HALVINGS)
                    .find_map(|k| flap(&points, depth / f64::from(1 << k), &walls));
                let Some((depth, flap)) = tab else {
                    cut.append(&base);
                    continue;
                };
                let line = [points[0], flap[0], flap[1], points[points.len() - 1]];
                walls.extend(line.windows(2).map(|p| [p[0], p[1]]));
                tabs.push(Tab {
                    seam,
                    base,
                    depth,
                    middle: [0, 1].map(|k| line.iter().map(|c| c[k]).sum::<f64>() / 4.0),
                });
                cut.append(&Curve::through(&line));
            }
        }
        cuts.push(cut);
    }
    (cuts, tabs)
}

/// Divides a curve into fold lines of tabs: each line turns by at most [`MAX_TAB_BEND`] and, where possible, is at
/// least [`MIN_TAB_LENGTH_MM`] long.
fn bases(curve: &Curve) -> Vec<Curve> {
    let points = curve.points(FLATTENING_TOLERANCE_MM);
    let heading = |i: usize| {
        let [x, y] = [0, 1].map(|k| points[i + 1][k] - points[i][k]);
        y.atan2(x)
    };
    let whole = polyline_length(&points);
    let mut ends = vec![0.0];
    let (mut gone, mut turned) = (0.0, 0.0);
    for i in 1..points.len() - 1 {
        gone += distance(points[i - 1], points[i]);
        let turn = heading(i) - heading(i - 1);
        let turn = turn.sin().atan2(turn.cos());
        turned += turn;
        let room =
            gone - ends[ends.len() - 1] >= MIN_TAB_LENGTH_MM && whole - gone >= MIN_TAB_LENGTH_MM;
        if turn.abs() > POLYLINE_CORNER_ANGLE || (turned.abs() > MAX_TAB_BEND && room) {
            ends.push(gone);
            turned = 0.0;
        }
    }
    let shares: Vec<f64> = ends[1..].iter().map(|end| end / whole).collect();
    curve.split(&shares)
}

/// Computes the outer corners of a tab to the right of its fold line; `None` if the fold line is too short or something
/// is in the way.
fn flap(base: &[[f64; 2]], depth: f64, walls: &[[[f64; 2]; 2]]) -> Option<(f64, [[f64; 2]; 2])> {
    let (from, to) = (base[0], base[base.len() - 1]);
    let long = distance(from, to);
    if long * MAX_TAB_DEPTH_SHARE < depth || long == 0.0 {
        return None;
    }
    let inset = depth.min(MAX_TAB_INSET_SHARE * long);
    let along = [0, 1].map(|k| (to[k] - from[k]) / long);
    let beside = |s: f64| {
        [
            from[0] + along[0] * s + along[1] * depth,
            from[1] + along[1] * s - along[0] * depth,
        ]
    };
    let corners = [beside(inset), beside(long - inset)];
    let line = [from, corners[0], corners[1], to];
    let free = line.windows(2).all(|p| {
        let piece = [p[0], p[1]];
        walls.iter().all(|wall| !crosses(piece, *wall))
    });
    free.then_some((depth, corners))
}

/// Returns whether two line segments cross, or touch elsewhere than at common ends.
fn crosses([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let same = |p: [f64; 2], q: [f64; 2]| distance(p, q) < 1e-6;
    if [a, b].iter().any(|p| same(*p, c) || same(*p, d)) {
        return false;
    }
    segments_intersect([a, b], [c, d])
}
