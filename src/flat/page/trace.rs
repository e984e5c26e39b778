//! Edges as they were traced: checked, and brought into one order.

use super::{Edges, Trace};
use crate::error::{Error, Result};

/// An edge from its first corner to its last, in the order of the cylinder.
#[derive(Debug, Clone)]
pub(super) struct Line {
    /// What the user calls it.
    pub name: &'static str,
    /// Its points, corners included.
    pub points: Vec<[f64; 2]>,
    /// How many independent points that are.
    pub independent: f64,
}

/// Points of a cubic Bézier curve that are looked at.
const STEPS: usize = 12;

/// Most points of one edge.
const MOST: usize = 100_000;

/// How far beyond the photo a point may lie, as a share of the photo's diagonal.
const BEYOND: f64 = 0.05;

/// The two edges of each page: the cylinder's first and second, both from the curve's start to its
/// end, so that the corners lie clockwise in the photo.
pub(super) fn lines(pages: &[Edges], photo: [usize; 2]) -> Result<Vec<[Line; 2]>> {
    if !(1..=2).contains(&pages.len()) {
        return Err(Error::option(
            "edges",
            pages.len(),
            "must be those of one page, or of the two pages of a spread",
        ));
    }
    let sideways = matches!(pages[0], Edges::LeftRight { .. });
    if pages
        .iter()
        .any(|page| matches!(page, Edges::LeftRight { .. }) != sideways)
    {
        return Err(Error::edges(
            "the two pages of a spread must both have `top` and `bottom`, or both `left` and `right`",
        ));
    }
    let mut found = Vec::with_capacity(pages.len());
    for page in pages {
        // Turned by 90°, the right edge is the top one, and the left one the bottom.
        let (first, second) = match page {
            Edges::TopBottom { top, bottom } => (("top", top), ("bottom", bottom)),
            Edges::LeftRight { left, right } => (("right", right), ("left", left)),
        };
        let mut pair = [line(first, photo)?, line(second, photo)?];
        arrange(&mut pair)?;
        found.push(pair);
    }
    if let [one, other] = &mut found[..] {
        neighbours(one, other)?;
    }
    Ok(found)
}

fn line((name, trace): (&'static str, &Trace), photo: [usize; 2]) -> Result<Line> {
    let given = match trace {
        Trace::Points(points) | Trace::Beziers(points) => points,
    };
    if given.len() > MOST {
        return Err(Error::TooLarge {
            what: "edge",
            requested: given.len(),
            limit: MOST,
        });
    }
    if let Some((row, col)) = given
        .iter()
        .enumerate()
        .find_map(|(i, p)| p.iter().position(|v| !v.is_finite()).map(|k| (i, k)))
    {
        return Err(Error::NotFinite {
            what: "edge",
            value: given[row][col],
            row,
            col,
            advice: "rows are its points and columns x and y; leave the point out",
        });
    }
    let (points, independent) = match trace {
        Trace::Points(points) => {
            let mut points = points.clone();
            points.dedup();
            order(&mut points);
            let count = points.len() as f64;
            (points, count)
        }
        Trace::Beziers(control) => {
            if control.len() < 4 || control.len() % 3 != 1 {
                return Err(Error::Edges {
                    reason: format!(
                        "the {name} edge has {} control points; cubic Bézier curves that follow \
                         each other have 4, 7, 10 and so on",
                        control.len()
                    ),
                });
            }
            let mut points = sampled(control);
            points.dedup();
            (points, (2 * control.len() / 3 + 2) as f64)
        }
    };
    let ends = match &points[..] {
        [first, .., last] if distance(*first, *last) >= 2.0 => [*first, *last],
        _ => {
            return Err(Error::Edges {
                reason: format!(
                    "the {name} edge must go from one corner to another, through at least 2 \
                     different points"
                ),
            });
        }
    };
    let [width, height] = photo.map(|n| n as f64);
    let slack = BEYOND * width.hypot(height);
    let outside = |p: &&[f64; 2]| {
        let within = |v: f64, end: f64| (-slack..=end + slack).contains(&v);
        !(within(p[0], width) && within(p[1], height))
    };
    if let Some([x, y]) = points.iter().chain(&ends).find(outside) {
        return Err(Error::Edges {
            reason: format!(
                "the {name} edge has a point at ({x:.0}, {y:.0}), outside of the photo of {width} \
                 by {height} pixels; give the places in pixels of this very photo"
            ),
        });
    }
    Ok(Line {
        name,
        points,
        independent,
    })
}

/// Puts points in order along the edge, unless they nearly are. An edge is taken for a graph over
/// its chord then.
fn order(points: &mut [[f64; 2]]) {
    let length =
        |points: &[[f64; 2]]| -> f64 { points.windows(2).map(|w| distance(w[0], w[1])).sum() };
    if points.len() < 4 {
        return;
    }
    let n = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
    let moment = |j: usize, k: usize| -> f64 {
        (points.iter())
            .map(|p| (p[j] - mean[j]) * (p[k] - mean[k]))
            .sum()
    };
    let angle = 0.5 * (2.0 * moment(0, 1)).atan2(moment(0, 0) - moment(1, 1));
    let (sin, cos) = angle.sin_cos();
    let along = |p: &[f64; 2]| cos * p[0] + sin * p[1];
    let mut sorted = points.to_vec();
    sorted.sort_by(|p, q| along(p).total_cmp(&along(q)));
    // Noise takes a little back and forth; disorder takes a lot.
    if length(points) > 1.5 * length(&sorted) {
        let turned = along(&points[0]) > along(&points[points.len() - 1]);
        if turned {
            sorted.reverse();
        }
        points.copy_from_slice(&sorted);
    }
}

fn sampled(control: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut points = vec![control[0]];
    for start in (0..control.len() - 1).step_by(3) {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| control[start + i]);
        for i in 1..=STEPS {
            let t = i as f64 / STEPS as f64;
            let s = 1.0 - t;
            points.push([0, 1].map(|k| {
                s * s * s * a[k]
                    + 3.0 * s * s * t * b[k]
                    + 3.0 * s * t * t * c[k]
                    + t * t * t * d[k]
            }));
        }
    }
    points
}

impl Line {
    pub fn ends(&self) -> [[f64; 2]; 2] {
        [self.points[0], self.points[self.points.len() - 1]]
    }

    pub fn chord(&self) -> f64 {
        let [from, to] = self.ends();
        distance(from, to)
    }
}

/// Makes both edges run the same way, so that the corners lie clockwise as they are seen, and checks
/// that they can be those of a page.
fn arrange([first, second]: &mut [Line; 2]) -> Result<()> {
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
fn neighbours(one: &mut [Line; 2], other: &mut [Line; 2]) -> Result<()> {
    let gap = |one: &[Line; 2], other: &[Line; 2]| -> f64 {
        (0..2)
            .map(|e| distance(one[e].ends()[1], other[e].ends()[0]))
            .sum()
    };
    if gap(other, one) < gap(one, other) {
        std::mem::swap(one, other);
    }
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

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}
