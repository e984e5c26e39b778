//! Edges in one order, by the corners at their ends.

use super::line::{Line, Traced, distance};
use crate::error::{Error, Result};

/// Makes both edges run the same way, so that the corners lie clockwise as they are seen, and checks
/// that they can be those of a page.
pub(super) fn arrange([first, second]: &mut [Line; 2]) -> Result<()> {
    let turns = |first: &Line, second: &Line| {
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
        let runs = |line: &Line| {
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
    crossing(first, second)
}

/// Refuses edges that cross each other.
fn crossing(first: &Line, second: &Line) -> Result<()> {
    // A thousand by a thousand segments is enough to tell.
    let thin = |line: &Line| -> Vec<[f64; 2]> {
        let step = line.points.len().div_ceil(1000);
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

/// Checks that the second page begins at the gutter, where the first one ends.
pub(super) fn neighbours(one: &mut Traced, other: &mut Traced) -> Result<()> {
    let gap = |one: &Traced, other: &Traced| -> f64 {
        (0..2)
            .map(|e| distance(one.pair[e].ends()[1], other.pair[e].ends()[0]))
            .sum()
    };
    if gap(other, one) < gap(one, other) {
        std::mem::swap(one, other);
    }
    let (one, other) = (&one.pair, &other.pair);
    for e in 0..2 {
        let apart = distance(one[e].ends()[1], other[e].ends()[0]);
        if apart > 0.05 * one[e].chord().max(other[e].chord()) {
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

/// Checks that the two other edges end at the bent ones' corners, and makes them run from the first
/// bent edge to the second.
pub(super) fn at_corners([first, second]: &[Line; 2], sides: &[Line; 2]) -> Result<()> {
    for (k, side) in sides.iter().enumerate() {
        let corners = [first.ends()[k], second.ends()[k]];
        let off = |ends: [[f64; 2]; 2]| {
            (0..2)
                .map(|e| distance(ends[e], corners[e]))
                .fold(0.0, f64::max)
        };
        let [from, to] = side.ends();
        let apart = off([from, to]).min(off([to, from]));
        if apart > 0.05 * side.chord().max(first.chord()) {
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
