//! Reading of traced edges and lines of text: checks them and brings them into a common order.

use super::corners::{arrange, arrange_spread, check_sides};
use super::edges::{Edges, Trace};
use super::traced_line::{TracedLine, TracedPage, distance};
use crate::error::{Error, Result};

/// Number of points at which each cubic Bézier curve of a trace is sampled.
const BEZIER_SAMPLES: usize = 12;

/// Maximum number of points of one traced edge; more are an error.
const MAX_EDGE_POINTS: usize = 100_000;

/// Minimum distance, in pixels, between the two ends of a traced edge.
const MIN_EDGE_LENGTH: f64 = 2.0;

/// Ratio of the length of the polyline through an edge's points as given to that through the sorted points, above which
/// the points are taken for disordered and are sorted.
const DISORDER_LENGTH_RATIO: f64 = 1.5;

/// Maximum distance of a traced point outside of the photo, as a share of the photo's diagonal; points further away are
/// an error.
const MAX_OUTSIDE_SHARE: f64 = 0.05;

/// Checks all traces and brings them into a common order: page by page, from the start of the bent edges. Returns them,
/// and whether the bent edges are the left and right ones. `text` are lines of text that the caller traced, `seen`
/// those detected in the photo, both page by page; the latter from left to right.
///
/// # Errors
/// Those of [`CurledPage::with_lines`](super::CurledPage::with_lines) about edges and lines.
pub(super) fn read_traces(
    pages: &[Edges],
    [text, seen]: [&[Vec<Trace>]; 2],
    photo: [usize; 2],
) -> Result<(Vec<TracedPage>, bool)> {
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
    let sideways = is_bent_sideways(pages)?;
    let lines = |own: Option<&Vec<Trace>>| -> Result<Vec<TracedLine>> {
        (own.into_iter().flatten())
            .map(|trace| read_line((TEXT_LINE_NAME, trace), photo))
            .collect()
    };
    let mut found = Vec::with_capacity(pages.len());
    for (number, page) in pages.iter().enumerate() {
        // Turned by 90°, the right edge is the top one, and the left one the bottom.
        let ([first, second], sides) = page.named(sideways);
        let mut pair = [read_line(first, photo)?, read_line(second, photo)?];
        arrange(&mut pair)?;
        let sides = match sides {
            Some([start, end]) => Some([read_line(start, photo)?, read_line(end, photo)?]),
            None => None,
        };
        if let Some(sides) = &sides {
            check_sides(&pair, sides)?;
        }
        found.push(TracedPage {
            pair,
            sides,
            text: lines(text.get(number))?,
            found: Vec::new(),
        });
    }
    if let [one, other] = &mut found[..] {
        arrange_spread(one, other)?;
    }
    // Pages on which lines were found are in their order from left to right, not as they are given.
    for (page, own) in found.iter_mut().zip(seen) {
        page.found = lines(Some(own))?;
    }
    Ok((found, sideways))
}

type Named<'a> = (&'static str, &'a Trace);

impl Edges {
    /// Returns the two bent edges and, if all four are given, the two straight ones at the start and the end, with
    /// their names. `sideways` says that the left and right edges are bent.
    fn named(&self, sideways: bool) -> ([Named<'_>; 2], Option<[Named<'_>; 2]>) {
        match self {
            Edges::TopBottom { top, bottom } => ([("top", top), ("bottom", bottom)], None),
            Edges::LeftRight { left, right } => ([("right", right), ("left", left)], None),
            Edges::All {
                top,
                bottom,
                left,
                right,
            } => {
                let upright = [("top", top), ("bottom", bottom)];
                if sideways {
                    ([("right", right), ("left", left)], Some(upright))
                } else {
                    (upright, Some([("left", left), ("right", right)]))
                }
            }
        }
    }
}

/// Whether the left and the right edges are the bent ones. Where all four edges are given, those that are farther from
/// straight in the photo are bent.
fn is_bent_sideways(pages: &[Edges]) -> Result<bool> {
    let mut bows = [0.0; 2];
    let mut told = Vec::new();
    for page in pages {
        match page {
            Edges::TopBottom { .. } => told.push(false),
            Edges::LeftRight { .. } => told.push(true),
            Edges::All {
                top,
                bottom,
                left,
                right,
            } => {
                bows[0] += relative_bow(top) + relative_bow(bottom);
                bows[1] += relative_bow(left) + relative_bow(right);
            }
        }
    }
    if told.iter().any(|sideways| *sideways != told[0]) {
        return Err(Error::edges(
            "the two pages of a spread must both have `top` and `bottom`, or both `left` and `right`",
        ));
    }
    Ok(told.first().copied().unwrap_or(bows[1] > bows[0]))
}

/// Maximum distance of a trace's points from its chord, as a share of the chord's length.
fn relative_bow(trace: &Trace) -> f64 {
    let points = match trace {
        Trace::Points(points) => points.clone(),
        Trace::Beziers(control) if control.len() % 3 == 1 => sample_beziers(control),
        Trace::Beziers(_) => return 0.0,
    };
    let [Some(from), Some(to)] = [points.first(), points.last()] else {
        return 0.0;
    };
    let way = [to[0] - from[0], to[1] - from[1]];
    let squared = way[0] * way[0] + way[1] * way[1];
    (points.iter())
        .map(|p| (way[0] * (p[1] - from[1]) - way[1] * (p[0] - from[0])).abs() / squared)
        .fold(0.0, f64::max)
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
fn read_line((name, trace): (&'static str, &Trace), photo: [usize; 2]) -> Result<TracedLine> {
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
    let (points, independent) = match trace {
        Trace::Points(points) => {
            let mut points = points.clone();
            points.dedup();
            sort_along_chord(&mut points);
            let count = points.len() as f64;
            (points, count)
        }
        Trace::Beziers(control) => {
            if control.len() < 4 || control.len() % 3 != 1 {
                return Err(Error::Edges {
                    reason: format!(
                        "{} has {} control points; cubic Bézier curves that follow each other have \
                         4, 7, 10 and so on",
                        described(name),
                        control.len()
                    ),
                });
            }
            let mut points = sample_beziers(control);
            points.dedup();
            (points, (2 * control.len() / 3 + 2) as f64)
        }
    };
    let ends = match &points[..] {
        [first, .., last] if distance(*first, *last) >= MIN_EDGE_LENGTH => [*first, *last],
        _ => {
            return Err(Error::Edges {
                reason: format!(
                    "{} must go from one {} to the other, through at least 2 different points",
                    described(name),
                    if name == TEXT_LINE_NAME {
                        "end"
                    } else {
                        "corner"
                    },
                ),
            });
        }
    };
    let [width, height] = photo.map(|n| n as f64);
    let slack = MAX_OUTSIDE_SHARE * width.hypot(height);
    let outside = |p: &&[f64; 2]| {
        let within = |v: f64, end: f64| (-slack..=end + slack).contains(&v);
        !(within(p[0], width) && within(p[1], height))
    };
    if let Some([x, y]) = points.iter().chain(&ends).find(outside) {
        return Err(Error::Edges {
            reason: format!(
                "{} has a point at ({x:.0}, {y:.0}), outside of the photo of {width} by {height} \
                 pixels; give the places in pixels of this very photo",
                described(name),
            ),
        });
    }
    Ok(TracedLine {
        name,
        points,
        independent,
    })
}

/// Sorts points by their positions along their main direction if they are in disorder.
fn sort_along_chord(points: &mut [[f64; 2]]) {
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
    // Noise makes the path through the points a little longer, disorder much longer.
    if length(points) > DISORDER_LENGTH_RATIO * length(&sorted) {
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
