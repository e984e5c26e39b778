//! Checks of a page's traced edges: their direction and order by the corners at their ends, and whether they cross.

use super::traced_line::{TracedLine, TracedPage, distance};
use crate::error::{Error, Result};

/// Maximum number of segments to which a traced edge is thinned before it is checked for crossings with the opposite
/// edge.
const MAX_CROSSING_SEGMENTS: usize = 1000;

/// Maximum distance between the ends of two edges that share a corner, as a share of the edge's chord.
const MAX_CORNER_GAP_SHARE: f64 = 0.05;

/// Orients both bent edges of a page alike, so that the corners lie clockwise in the photo, and checks that they can
/// belong to a page.
///
/// # Errors
/// [`Error::Edges`].
pub(super) fn arrange([first, second]: &mut [TracedLine; 2]) -> Result<()> {
    let turns = |first: &TracedLine, second: &TracedLine| {
        let ([a, b], [d, c]) = (first.ends(), second.ends());
        let corners = [a, b, c, d];
        [0, 1, 2, 3].map(|i| {
            let [p, q, r] = [0, 1, 2].map(|k| corners[(i + k) % 4]);
            (q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0])
        })
    };
    let convex =
        |turns: &[f64; 4]| turns.iter().all(|t| *t > 0.0) || turns.iter().all(|t| *t < 0.0);
    let mut found = turns(first, second);
    if !convex(&found) {
        // One of them may run backwards; which one, the sense of the corners tells.
        second.points.reverse();
        found = turns(first, second);
        if convex(&found) && found[0] < 0.0 {
            first.points.reverse();
            second.points.reverse();
            found = turns(first, second);
        }
        if !convex(&found) {
            return Err(Error::Edges {
                reason: format!(
                    "the ends of the {} and {} edges are no corners of a page: they do not make a \
                     convex quadrilateral",
                    first.name, second.name
                ),
            });
        }
    } else if found[0] < 0.0 {
        // Both run backwards, or each is called by the other's name.
        let sideways = first.name == "right";
        let runs = |line: &TracedLine| {
            let [from, to] = line.ends();
            let k = usize::from(sideways);
            to[k] - from[k]
        };
        if runs(first) >= 0.0 || runs(second) >= 0.0 {
            return Err(Error::Edges {
                reason: format!(
                    "the {} and {} edges show the page from behind: exchange them, or list the \
                     points of both from {}",
                    first.name,
                    second.name,
                    if sideways {
                        "top to bottom"
                    } else {
                        "left to right"
                    }
                ),
            });
        }
        first.points.reverse();
        second.points.reverse();
    }
    check_no_crossing(first, second)
}

/// Returns an error if the two bent edges of a page cross each other in the photo.
fn check_no_crossing(first: &TracedLine, second: &TracedLine) -> Result<()> {
    let thin = |line: &TracedLine| -> Vec<[f64; 2]> {
        let step = line.points.len().div_ceil(MAX_CROSSING_SEGMENTS);
        let mut thin: Vec<_> = line.points.iter().copied().step_by(step).collect();
        thin.push(line.points[line.points.len() - 1]);
        thin
    };
    let side = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    let (one, other) = (thin(first), thin(second));
    for s in one.windows(2) {
        for t in other.windows(2) {
            let apart = |k: usize| {
                s[0][k].max(s[1][k]) < t[0][k].min(t[1][k])
                    || t[0][k].max(t[1][k]) < s[0][k].min(s[1][k])
            };
            if apart(0) || apart(1) {
                continue;
            }
            if side(s[0], s[1], t[0]) * side(s[0], s[1], t[1]) <= 0.0
                && side(t[0], t[1], s[0]) * side(t[0], t[1], s[1]) <= 0.0
            {
                return Err(Error::Edges {
                    reason: format!(
                        "the {} and {} edges cross at about ({:.0}, {:.0}); a page's edges do not",
                        first.name, second.name, s[0][0], s[0][1]
                    ),
                });
            }
        }
    }
    Ok(())
}

/// Orders the two pages of a spread, and checks that the second page's edges begin at the gutter, where the first
/// page's edges end.
///
/// # Errors
/// [`Error::Edges`].
pub(super) fn arrange_spread(one: &mut TracedPage, other: &mut TracedPage) -> Result<()> {
    let gap = |one: &TracedPage, other: &TracedPage| -> f64 {
        (0..2)
            .map(|e| distance(one.pair()[e].ends()[1], other.pair()[e].ends()[0]))
            .sum()
    };
    if gap(other, one) < gap(one, other) {
        std::mem::swap(one, other);
    }
    let (one, other) = (one.pair(), other.pair());
    for e in 0..2 {
        let apart = distance(one[e].ends()[1], other[e].ends()[0]);
        if apart > MAX_CORNER_GAP_SHARE * one[e].chord().max(other[e].chord()) {
            return Err(Error::Edges {
                reason: format!(
                    "the {} edges of the two pages end {apart:.0} pixels apart; the pages of a \
                     spread share the gutter, so that one edge begins where the other ends",
                    one[e].name
                ),
            });
        }
    }
    Ok(())
}

/// Checks that a page's two straight edges, `sides`, end at the corners of its two bent edges.
///
/// # Errors
/// [`Error::Edges`].
pub(super) fn check_sides(
    [first, second]: &[TracedLine; 2],
    sides: &[TracedLine; 2],
) -> Result<()> {
    for (k, side) in sides.iter().enumerate() {
        let corners = [first.ends()[k], second.ends()[k]];
        let off = |ends: [[f64; 2]; 2]| {
            (0..2)
                .map(|e| distance(ends[e], corners[e]))
                .fold(0.0, f64::max)
        };
        let [from, to] = side.ends();
        let apart = off([from, to]).min(off([to, from]));
        if apart > MAX_CORNER_GAP_SHARE * side.chord().max(first.chord()) {
            return Err(Error::Edges {
                reason: format!(
                    "the {} edge ends {apart:.0} pixels from the corner that the {} and {} edges \
                     have there; all four edges go from corner to corner",
                    side.name, first.name, second.name
                ),
            });
        }
    }
    Ok(())
}

/// Maximum distance of a traced line of text outside of its page's outline, as a share of the page's bent edge.
const MAX_OUTSIDE_SHARE: f64 = 0.03;

/// Checks that all points of a traced line of text lie between the two bent edges of its page. `number` is the line's
/// number for the error message.
///
/// # Errors
/// [`Error::Edges`].
pub(super) fn check_on_page(
    [first, second]: [&TracedLine; 2],
    points: &[[f64; 2]],
    number: usize,
) -> Result<()> {
    let thin = |line: &TracedLine| -> Vec<[f64; 2]> {
        let step = line.points.len().div_ceil(200);
        let mut thin: Vec<_> = line.points.iter().copied().step_by(step).collect();
        thin.push(line.points[line.points.len() - 1]);
        thin
    };
    let mut outline = thin(first);
    outline.extend(thin(second).into_iter().rev());
    let slack = MAX_OUTSIDE_SHARE * first.chord().max(second.chord());
    let sides = || (outline.iter().copied()).zip(outline.iter().cycle().skip(1).copied());
    for [x, y] in points {
        let crossed = sides()
            .filter(|(p, q)| {
                (p[1] > *y) != (q[1] > *y) && *x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
            })
            .count();
        let near = || {
            sides().any(|(p, q)| {
                let (way, off) = ([q[0] - p[0], q[1] - p[1]], [x - p[0], y - p[1]]);
                let squared = (way[0] * way[0] + way[1] * way[1]).max(1e-12);
                let t = ((way[0] * off[0] + way[1] * off[1]) / squared).clamp(0.0, 1.0);
                (off[0] - t * way[0]).hypot(off[1] - t * way[1]) < slack
            })
        };
        if crossed % 2 == 0 && !near() {
            return Err(Error::Edges {
                reason: format!(
                    "line {number} of the text (the first is line 0) has a point at ({x:.0}, \
                     {y:.0}), which is not between the {} and {} edges of its page",
                    first.name, second.name
                ),
            });
        }
    }
    Ok(())
}
