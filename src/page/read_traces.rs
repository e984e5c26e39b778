//! Reading of traced edges and lines of text: checks them and brings them into a common order.

use super::corners::{MAX_TRACING_ERROR, arrange, arrange_spread, check_on_page, check_sides};
use super::edges::{Edges, Trace};
use super::traced_line::{BentEdges, TracedLine, TracedPage};
use crate::error::{Error, Result};
use crate::math::planar::{polyline_length, principal_line};

/// Number of points at which each cubic Bézier curve of a trace is sampled.
const BEZIER_SAMPLES: usize = 12;

/// Maximum number of points of one traced edge; more are an error.
const MAX_EDGE_POINTS: usize = 100_000;

/// Ratio of the length of the polyline through an edge's points as given to that through the sorted points, above which
/// the points are taken for disordered and are sorted.
const DISORDER_LENGTH_RATIO: f64 = 1.5;

/// Maximum number of lines of text that the caller may trace on all pages.
const MAX_TEXT_LINES: usize = 500;

/// Checks all traces and brings them into a common order: the pages of a spread from left to right, or from top to bottom.
/// `text` are lines of text that the caller traced, page by page.
///
/// # Errors
/// Those of [`PageSurface::new`](super::PageSurface::new) about edges and lines.
pub(super) fn read_traces(
    pages: &[Edges],
    text: &[Vec<Trace>],
    photo: [usize; 2],
) -> Result<Vec<TracedPage>> {
    if !(1..=2).contains(&pages.len()) {
        return Err(Error::option(
            "edges",
            pages.len(),
            "must be those of one page, or of the two pages of a spread",
        ));
    }
    if text.len() > pages.len() {
        return Err(Error::option(
            "text",
            text.len(),
            "must be the lines of text of each page, in the order of the edges",
        ));
    }
    let requested = text.iter().map(Vec::len).sum();
    if requested > MAX_TEXT_LINES {
        return Err(Error::TooLarge {
            what: "list of lines of text",
            requested,
            limit: MAX_TEXT_LINES,
        });
    }
    let mut found = Vec::with_capacity(pages.len());
    for (number, page) in pages.iter().enumerate() {
        let mut page = read_page(page, photo)?;
        for (line, trace) in text.get(number).into_iter().flatten().enumerate() {
            let traced = read_line(TEXT_LINE_NAME, trace, photo)?;
            check_on_page(page.pair(), &traced.points, line)?;
            page.text.push(traced);
        }
        found.push(page);
    }
    if let [one, other] = &mut found[..] {
        if (one.bent == Some(BentEdges::LeftRight)) != (other.bent == Some(BentEdges::LeftRight)) {
            return Err(Error::edges(
                "the two pages of a spread must both have `top` and `bottom`, or both `left` and `right`",
            ));
        }
        arrange_spread(one, other)?;
    }
    Ok(found)
}

/// Makes a page that fills a photo of `photo` (width and height) pixels, of which no edge is seen, with rulings from top to
/// bottom, as in a book.
pub(super) fn page_that_fills(photo: [usize; 2]) -> TracedPage {
    let [right, bottom] = photo.map(|n| n as f64 - 1.0);
    let corners = [[0.0, 0.0], [right, 0.0], [0.0, bottom], [right, bottom]];
    let edges = [
        ("top", [0, 1]),
        ("bottom", [2, 3]),
        ("left", [0, 2]),
        ("right", [1, 3]),
    ];
    TracedPage {
        edges: edges.map(|(name, ends)| TracedLine {
            name,
            points: ends.map(|end| corners[end]).to_vec(),
        }),
        bent: Some(BentEdges::TopBottom),
        is_seen: false,
        text: Vec::new(),
    }
}

/// Reads the edges of one page. Edges that are not traced are straight.
fn read_page(page: &Edges, photo: [usize; 2]) -> Result<TracedPage> {
    let read = |name, trace| read_line(name, trace, photo);
    let straight = |name, [one, other]: &[TracedLine; 2], end: usize| TracedLine {
        name,
        points: vec![one.ends()[end], other.ends()[end]],
    };
    let ([top, bottom], [left, right], bent) = match page {
        Edges::TopBottom { top, bottom } => {
            let mut pair = [read("top", top)?, read("bottom", bottom)?];
            arrange(&mut pair)?;
            let sides = [straight("left", &pair, 0), straight("right", &pair, 1)];
            (pair, sides, Some(BentEdges::TopBottom))
        }
        Edges::LeftRight { left, right } => {
            // Turned by 90°, the right edge is the top one, and the left one the bottom.
            let mut sides = [read("right", right)?, read("left", left)?];
            arrange(&mut sides)?;
            sides.reverse();
            let pair = [straight("top", &sides, 0), straight("bottom", &sides, 1)];
            (pair, sides, Some(BentEdges::LeftRight))
        }
        Edges::All {
            top,
            bottom,
            left,
            right,
        } => {
            let mut pair = [read("top", top)?, read("bottom", bottom)?];
            let mut sides = [read("left", left)?, read("right", right)?];
            // Each begins at the edge that it shares its first corner with.
            pair.iter_mut().for_each(|edge| edge.begin_at(&sides[0]));
            sides.iter_mut().for_each(|side| side.begin_at(&pair[0]));
            arrange(&mut pair)?;
            check_sides(&pair, &sides)?;
            (pair, sides, None)
        }
    };
    Ok(TracedPage {
        edges: [top, bottom, left, right],
        bent,
        is_seen: true,
        text: Vec::new(),
    })
}

/// Name of a line of text among the names of edges, in error messages.
const TEXT_LINE_NAME: &str = "text";

/// Description of the edge or line of text with this name, for error messages.
fn described(name: &str) -> String {
    match name {
        TEXT_LINE_NAME => "a line of text".into(),
        edge => format!("the {edge} edge"),
    }
}

/// Checks one traced edge or line of text, and converts it to points.
///
/// # Errors
/// [`Error::Edges`], [`Error::NotFinite`], [`Error::TooLarge`].
fn read_line(name: &'static str, trace: &Trace, photo: [usize; 2]) -> Result<TracedLine> {
    let given = match trace {
        Trace::Points(points) | Trace::Beziers(points) => points,
    };
    if given.len() > MAX_EDGE_POINTS {
        return Err(Error::TooLarge {
            what: "edge",
            requested: given.len(),
            limit: MAX_EDGE_POINTS,
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
    let points = match trace {
        Trace::Points(points) => {
            let mut points = points.clone();
            points.dedup();
            sort_along_chord(&mut points);
            points
        }
        Trace::Beziers(control) => {
            if control.len() < 4 || control.len() % 3 != 1 {
                return Err(Error::edges(format!(
                    "{} has {} control points; cubic Bézier curves that follow each other have \
                         4, 7, 10 and so on",
                    described(name),
                    control.len()
                )));
            }
            let mut points = sample_beziers(control);
            points.dedup();
            points
        }
    };
    let ends = match &points[..] {
        [first, .., last] if first != last => [*first, *last],
        _ => {
            return Err(Error::edges(format!(
                "{} must go from one {} to the other, through at least 2 different points",
                described(name),
                if name == TEXT_LINE_NAME {
                    "end"
                } else {
                    "corner"
                },
            )));
        }
    };
    let [width, height] = photo.map(|n| n as f64);
    let slack = MAX_TRACING_ERROR * width.hypot(height);
    let outside = |p: &&[f64; 2]| {
        let within = |v: f64, end: f64| (-slack..=end + slack).contains(&v);
        !(within(p[0], width) && within(p[1], height))
    };
    if let Some([x, y]) = points.iter().chain(&ends).find(outside) {
        return Err(Error::edges(format!(
            "{} has a point at ({x:.0}, {y:.0}), outside of the photo of {width} by {height} \
                 pixels; give the places in pixels of this very photo",
            described(name),
        )));
    }
    Ok(TracedLine { name, points })
}

/// Sorts points by their positions along their main direction if they are in disorder.
fn sort_along_chord(points: &mut [[f64; 2]]) {
    if points.len() < 4 {
        return;
    }
    let (_, [cos, sin]) = principal_line(points);
    let along = |p: &[f64; 2]| cos * p[0] + sin * p[1];
    let mut sorted = points.to_vec();
    sorted.sort_by(|p, q| along(p).total_cmp(&along(q)));
    // Noise makes the path through the points a little longer, disorder much longer.
    if polyline_length(points) > DISORDER_LENGTH_RATIO * polyline_length(&sorted) {
        let turned = along(&points[0]) > along(&points[points.len() - 1]);
        if turned {
            sorted.reverse();
        }
        points.copy_from_slice(&sorted);
    }
}

/// Samples cubic Bézier curves that follow each other, given by their control points.
fn sample_beziers(control: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut points = vec![control[0]];
    for start in (0..control.len() - 1).step_by(3) {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| control[start + i]);
        for i in 1..=BEZIER_SAMPLES {
            let t = i as f64 / BEZIER_SAMPLES as f64;
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
