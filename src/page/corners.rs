//! Checks of a page's traced edges: their direction and order by the corners at their ends, and whether they cross.

use super::traced_line::{EDGE_SEGMENTS, TracedLine, TracedPage};
use crate::error::{Error, Result};
use crate::math::planar::{
    distance, distance_to_segment, orientation, polygon_contains, segments_intersect,
};

/// Maximum error of what is traced by hand, as a share of the edge's chord: the distance between the ends of two edges that
/// share a corner, or of a line of text outside of its page.
pub(super) const MAX_TRACING_ERROR: f64 = 0.05;

/// Whether four corners are in clockwise order as seen in the image and form a convex quadrilateral.
pub(super) fn is_convex(corners: &[[f64; 2]; 4]) -> bool {
    (0..4).all(|k| orientation(corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4]) > 0.0)
}

/// Orients both bent edges of a page alike, so that the corners lie clockwise in the photo, and checks that they can
/// belong to a page.
///
/// # Errors
/// [`Error::Edges`].
pub(super) fn arrange(pair: &mut [TracedLine; 2]) -> Result<()> {
    let names = pair.each_ref().map(|line| line.name);
    // Whether the corners make a page that is seen from the front, and from behind.
    let senses = |pair: &[TracedLine; 2]| {
        let [[a, b], [d, c]] = pair.each_ref().map(TracedLine::ends);
        [is_convex(&[a, b, c, d]), is_convex(&[d, c, b, a])]
    };
    // One of them may run backwards; which one, the sense of the corners tells.
    let is_crossed = senses(pair) == [false; 2];
    if is_crossed {
        pair[1].points.reverse();
    }
    let [is_seen, is_behind] = senses(pair);
    if !is_seen && !is_behind {
        return Err(Error::edges(format!(
            "the ends of the {} and {} edges are no corners of a page: they do not make a convex quadrilateral",
            names[0], names[1]
        )));
    }
    if is_behind {
        // Both run backwards, or each is called by the other's name.
        let axis = usize::from(names[0] == "right");
        let runs_on = |line: &TracedLine| line.ends()[1][axis] >= line.ends()[0][axis];
        if !is_crossed && pair.iter().any(runs_on) {
            let way = ["left to right", "top to bottom"][axis];
            return Err(Error::edges(format!(
                "the {} and {} edges show the page from behind: exchange them, or list the points of both from {way}",
                names[0], names[1]
            )));
        }
        pair.iter_mut().for_each(|line| line.points.reverse());
    }
    check_no_crossing(&pair[0], &pair[1])
}

/// At most about as many points of a traced edge as crossings and places beside it are looked for with, its ends among them.
fn thinned(line: &TracedLine) -> Vec<[f64; 2]> {
    let step = line.points.len().div_ceil(EDGE_SEGMENTS);
    let last = line.ends()[1];
    (line.points.iter().copied().step_by(step))
        .chain([last])
        .collect()
}

/// Returns an error if the two bent edges of a page cross each other in the photo.
fn check_no_crossing(first: &TracedLine, second: &TracedLine) -> Result<()> {
    let (one, other) = (thinned(first), thinned(second));
    // Edges that touch count, too.
    let meet = |s: [[f64; 2]; 2], t: [[f64; 2]; 2]| {
        segments_intersect(s, t)
            || distance_to_segment(s[0], t) == 0.0
            || distance_to_segment(t[0], s) == 0.0
    };
    let meets_other =
        |s: &&[[f64; 2]]| (other.windows(2)).any(|t| meet([s[0], s[1]], [t[0], t[1]]));
    let Some([[x, y], ..]) = one.windows(2).find(meets_other) else {
        return Ok(());
    };
    Err(Error::edges(format!(
        "the {} and {} edges cross at about ({x:.0}, {y:.0}); a page's edges do not",
        first.name, second.name
    )))
}

/// Orders the two pages of a spread, and checks that the second page's edges begin at the gutter, where the first
/// page's edges end.
///
/// # Errors
/// [`Error::Edges`].
pub(super) fn arrange_spread(one: &mut TracedPage, other: &mut TracedPage) -> Result<()> {
    let gaps = |one: &TracedPage, other: &TracedPage| {
        [0, 1].map(|e| distance(one.pair()[e].ends()[1], other.pair()[e].ends()[0]))
    };
    if gaps(other, one).iter().sum::<f64>() < gaps(one, other).iter().sum() {
        std::mem::swap(one, other);
    }
    let apart = gaps(one, other);
    let (one, other) = (one.pair(), other.pair());
    for (e, apart) in apart.into_iter().enumerate() {
        if apart > MAX_TRACING_ERROR * one[e].chord().max(other[e].chord()) {
            return Err(Error::edges(format!(
                "the {} edges of the two pages end {apart:.0} pixels apart; the pages of a \
                     spread share the gutter, so that one edge begins where the other ends",
                one[e].name
            )));
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
        let [a, b] = [first.ends()[k], second.ends()[k]];
        let off = |from, to| distance(from, a).max(distance(to, b));
        let [from, to] = side.ends();
        let apart = off(from, to).min(off(to, from));
        if apart > MAX_TRACING_ERROR * side.chord().max(first.chord()) {
            return Err(Error::edges(format!(
                "the {} edge ends {apart:.0} pixels from the corner that the {} and {} edges \
                     have there; all four edges go from corner to corner",
                side.name, first.name, second.name
            )));
        }
    }
    Ok(())
}

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
    let mut outline = thinned(first);
    outline.extend(thinned(second).into_iter().rev());
    let slack = MAX_TRACING_ERROR * first.chord().max(second.chord());
    let sides = || (outline.iter().copied()).zip(outline.iter().cycle().skip(1).copied());
    let is_beside = |at| sides().any(|(p, q)| distance_to_segment(at, [p, q]) < slack);
    for at @ [x, y] in points {
        if !polygon_contains(&outline, *at) && !is_beside(*at) {
            return Err(Error::edges(format!(
                "line {number} of the text (the first is line 0) has a point at ({x:.0}, \
                     {y:.0}), which is not between the {} and {} edges of its page",
                first.name, second.name
            )));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_that_touch_cross_from_either_side() {
        let line = |points: &[[f64; 2]]| TracedLine {
            name: "top",
            points: points.to_vec(),
        };
        let [valley, peak] = [[0.0, 10.0], [10.0, 0.0]]
            .map(|[ends, middle]| line(&[[0.0, ends], [5.0, middle], [10.0, ends]]));
        for edge in [[0.0, 0.0], [10.0, 10.0]] {
            let straight = line(&[[0.0, edge[0]], [10.0, edge[1]]]);
            for bent in [&valley, &peak] {
                assert!(check_no_crossing(bent, &straight).is_err());
                assert!(check_no_crossing(&straight, bent).is_err());
            }
        }
        let apart = line(&[[0.0, 11.0], [10.0, 11.0]]);
        assert!(check_no_crossing(&valley, &apart).is_ok());
    }
}
