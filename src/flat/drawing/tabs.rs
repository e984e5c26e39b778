//! Tabs to glue along cut creases: trapezoids outside of the sheet.

use super::{distance, length};
use crate::flat::pattern::{Run, Seam};

/// A tab and what it is folded along.
pub(super) struct Tab {
    pub seam: Seam,
    /// Along the crease, as the outline runs.
    pub base: Vec<[f64; 2]>,
    pub depth: f64,
    pub middle: [f64; 2],
}

/// A tab has a base this many times its depth at least.
const ASPECT: f64 = 2.5;

/// A curve that turns by more, in radians, gets another tab.
const BEND: f64 = 0.3;

/// How often a tab that does not fit is made half as deep.
const HALVINGS: usize = 2;

/// An outline's runs, and the points of each in millimetres.
type Outline<'a> = Vec<(&'a Run, Vec<[f64; 2]>)>;

/// The lines to cut, with tabs where there is room for them, and these.
pub(super) fn tabbed(
    outlines: &[Outline<'_>],
    depth: Option<f64>,
) -> (Vec<Vec<[f64; 2]>>, Vec<Tab>) {
    let mut tabs = Vec::new();
    // What tabs must not touch: all outlines, and the tabs there are.
    let mut walls: Vec<[[f64; 2]; 2]> = (outlines.iter().flatten())
        .flat_map(|(_, points)| points.windows(2).map(|p| [p[0], p[1]]))
        .collect();
    let mut cuts = Vec::new();
    for outline in outlines {
        let mut cut = Vec::new();
        for (run, points) in outline {
            // Of the two sides of a crease that of the patch with the lower number has the tabs.
            let own = run.seam.filter(|seam| run.patch == Some(seam.patches[0]));
            let (Some(depth), Some(seam)) = (depth, own) else {
                cut.extend(&points[..points.len() - 1]);
                continue;
            };
            for base in straight_pieces(points) {
                let tab =
                    (0..=HALVINGS).find_map(|k| flap(base, depth / f64::from(1 << k), &walls));
                cut.push(base[0]);
                if let Some((depth, flap)) = tab {
                    let line = [&base[..1], &flap, &base[base.len() - 1..]].concat();
                    walls.extend(line.windows(2).map(|p| [p[0], p[1]]));
                    let corners = [base[0], base[base.len() - 1], flap[0], flap[flap.len() - 1]];
                    tabs.push(Tab {
                        seam,
                        base: base.to_vec(),
                        depth,
                        middle: [0, 1].map(|k| corners.iter().map(|c| c[k]).sum::<f64>() / 4.0),
                    });
                    cut.extend(flap);
                } else {
                    cut.extend(&base[1..base.len() - 1]);
                }
            }
        }
        cuts.push(cut);
    }
    (cuts, tabs)
}

/// A line in pieces that turn by little each.
fn straight_pieces(points: &[[f64; 2]]) -> Vec<&[[f64; 2]]> {
    let heading = |i: usize| {
        let [x, y] = [0, 1].map(|k| points[i + 1][k] - points[i][k]);
        y.atan2(x)
    };
    let mut pieces = Vec::new();
    let mut start = 0;
    for i in 1..points.len() - 1 {
        let turn = heading(i) - heading(start);
        if turn.sin().atan2(turn.cos()).abs() > BEND {
            pieces.push(&points[start..=i]);
            start = i;
        }
    }
    pieces.push(&points[start..]);
    pieces
}

/// The outer line of a tab to the right of its base, if the base is long enough and nothing is in
/// the way.
fn flap(base: &[[f64; 2]], depth: f64, walls: &[[[f64; 2]; 2]]) -> Option<(f64, Vec<[f64; 2]>)> {
    let long = length(base);
    if long < ASPECT * depth {
        return None;
    }
    let mut out = Vec::new();
    let mut gone = 0.0;
    let last = base.len() - 2;
    for (i, piece) in base.windows(2).enumerate() {
        let step = distance(piece[0], piece[1]);
        if step == 0.0 {
            continue;
        }
        let [x, y] = [0, 1].map(|k| (piece[1][k] - piece[0][k]) / step);
        let beside = |along: f64| {
            let [px, py] = piece[0];
            [px + x * along + depth * y, py + y * along - depth * x]
        };
        // Both ends are cut at 45°.
        if gone <= depth && depth <= gone + step {
            out.push(beside(depth - gone));
        } else if gone > depth && gone < long - depth {
            out.push(beside(0.0));
        }
        let end = long - depth;
        if gone <= end && end <= gone + step || i == last && out.len() < 2 {
            out.push(beside(end - gone));
        }
        gone += step;
    }
    let line = [&base[..1], &out, &base[base.len() - 1..]].concat();
    let free = line.windows(2).all(|p| {
        let piece = [p[0], p[1]];
        walls.iter().all(|wall| !crosses(piece, *wall))
    });
    (free && out.len() > 1).then_some((depth, out))
}

/// Whether two lines cross or touch elsewhere than at common ends.
fn crosses([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    if [c, d].contains(&a) || [c, d].contains(&b) {
        return false;
    }
    let side = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    (side(a, b, c) > 0.0) != (side(a, b, d) > 0.0) && (side(c, d, a) > 0.0) != (side(c, d, b) > 0.0)
}
