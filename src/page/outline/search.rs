//! Search for pages in a photo: candidate regions, their outlines, and the verdict on the best one.

use super::candidates::candidate_masks;
use super::orientation::quarter_turns;
use super::outline_report::{OutlineReason, OutlineReport, OutlineVerdict, PageOutline};
use super::print::Print;
use super::print_frame::PrintFrame;
use super::quadrilateral::Quadrilateral;
use super::tracing::traced;
use super::views::{View, Views};
use crate::dewarp::Photo;
use crate::math::planar::{distance, polygon_area, polygon_contains};
use crate::page::text::ranking::ranked;

/// Minimum length of a photo's shorter side, in pixels: in a smaller one a page's edges have too few pixels.
pub(super) const MIN_PHOTO_SIDE_PIXELS: usize = 64;

/// Minimum share of the photo's area that a page covers.
/// Its row: `benches/page.md`, Constants of the outline.
const MIN_PAGE_SHARE: f64 = 0.05;

/// Maximum number of candidate regions whose edges are traced.
/// Its row: `benches/page.md`, Constants of the outline.
const MAX_TRACED_CANDIDATES: usize = 6;

/// Distance, as a share of the photo's longer side, up to which two corners count as equal: of two candidates with the same
/// corners only the better one is kept.
/// Its row: `benches/page.md`, Constants of the outline.
pub(super) const SAME_CORNER_SHARE: f64 = 0.03;

/// Minimum score, from 0 to 1, of an outline for the verdict `Found`, and of a further page in the photo.
/// Its row: `benches/page.md`, Constants of the outline.
const MIN_FOUND_SCORE: f64 = 0.45;

/// Minimum score, from 0 to 1, of an outline for the verdict `Doubtful`; below it no page was found.
const MIN_DOUBTFUL_SCORE: f64 = 0.3;

/// Whether two quadrilaterals have equal corners up to a distance `tolerance`; both are clockwise, from any corner on.
fn are_same(one: &[[f64; 2]; 4], other: &[[f64; 2]; 4], tolerance: f64) -> bool {
    (0..4).any(|turn| (0..4).all(|k| distance(one[k], other[(k + turn) % 4]) <= tolerance))
}

/// Whether two quadrilaterals are disjoint: neither contains a corner or the centre of the other one; they may touch.
fn are_apart(one: &[[f64; 2]; 4], other: &[[f64; 2]; 4]) -> bool {
    let free = |a: &[[f64; 2]; 4], b: &[[f64; 2]; 4]| {
        let middle = [0, 1].map(|j| b.iter().map(|p| 0.25 * p[j]).sum());
        // Corners a little towards the middle, so that pages may touch.
        !polygon_contains(a, middle)
            && b.iter().all(|p| {
                !polygon_contains(a, [0, 1].map(|j: usize| p[j] + 0.1 * (middle[j] - p[j])))
            })
    };
    free(one, other) && free(other, one)
}

/// Rotates an outline's lists of corners and edges so that the upper edge of the page as it is read comes first, or the
/// photo's upper edge if the print does not tell.
fn upright(outline: PageOutline, views: &Views) -> PageOutline {
    let first = (0..4).min_by(|a, b| {
        let height = |k: &usize| {
            let [p, q] = [outline.corners[*k], outline.corners[(*k + 1) % 4]];
            // The upper edge is the one that runs to the right most.
            -(q[0] - p[0]) / distance(p, q).max(1e-9)
        };
        height(a).total_cmp(&height(b))
    });
    let outline = outline.turned(first.unwrap_or(0));
    let corners = outline.corners.map(|point| views.raw.reduced_point(point));
    let turns = quarter_turns(&views.raw, &corners);
    outline.turned(turns)
}

/// Finds the outline of the page in a photo: its corners and edges, with a verdict.
pub fn find_outline(photo: &Photo<'_>) -> OutlineReport {
    let views = Views::new(photo);
    if views.raw.width.min(views.raw.height) < MIN_PHOTO_SIDE_PIXELS {
        return report(Vec::new());
    }
    let is_clear = |outlines: &Vec<PageOutline>, min_score: f64| {
        outlines.first().is_some_and(|best| {
            best.score >= min_score && !best.reasons.contains(&OutlineReason::FaintEdge)
        })
    };
    let mut outlines = outlines_in(&views.without_print());
    if !is_clear(&outlines, MIN_DOUBTFUL_SCORE) {
        let others = outlines_in(&views.as_it_is());
        // A pattern has edges of its own, which make doubtful outlines.
        match is_clear(&others, MIN_FOUND_SCORE) {
            true => outlines = others,
            // What is seen around the print tells more than a region without a clear edge.
            false => {
                let around = around_print(&views);
                outlines.splice(
                    ..0,
                    around.filter(|outline| outline.score >= MIN_DOUBTFUL_SCORE),
                );
            }
        }
    }
    let mut report = report(outlines);
    report.pages = (report.pages.into_iter())
        .map(|outline| upright(outline, &views))
        .collect();
    report
}

/// Finds outlines of pages in one view of a photo, the best first.
fn outlines_in(view: &View<'_>) -> Vec<PageOutline> {
    let half = &view.half;
    let min_area = ((MIN_PAGE_SHARE * half.len() as f64) as usize).max(1);
    let tolerance = SAME_CORNER_SHARE * half.longer_side();
    let mut quadrilaterals: Vec<Quadrilateral> = Vec::new();
    for mask in candidate_masks(half) {
        for region in view.regions(&mask, min_area) {
            quadrilaterals.extend(Quadrilateral::new(&region, half.width));
        }
    }
    let unlikeness: Vec<f64> = quadrilaterals.iter().map(|one| -one.likeness).collect();
    let mut distinct: Vec<&Quadrilateral> = Vec::new();
    for one in ranked(&unlikeness).iter().map(|k| &quadrilaterals[*k]) {
        if distinct.len() == MAX_TRACED_CANDIDATES {
            break;
        }
        if !distinct
            .iter()
            .any(|other| are_same(&one.corners(), &other.corners(), tolerance))
        {
            distinct.push(one);
        }
    }
    let mut outlines: Vec<PageOutline> = distinct
        .iter()
        .filter_map(|one| {
            let arcs = one
                .arcs
                .each_ref()
                .map(|arc| arc.iter().map(|p| p.map(|at| 2.0 * at + 0.5)).collect());
            traced(view, arcs, one.likeness)
        })
        .collect();
    // Of a page and a part of it that light or a fold sets off, the page.
    let rank =
        |outline: &PageOutline| outline.score * polygon_area(&outline.corners).abs().powf(0.25);
    outlines.sort_by(|one, other| rank(other).total_cmp(&rank(one)));
    outlines
}

/// Finds a page on a ground of its own colour by its print and the edges around that; such an outline is always doubtful.
fn around_print(views: &Views) -> Option<PageOutline> {
    let print = Print::new(views);
    let (score, arcs) = PrintFrame::new(&views.raw, &print)?.best_outline(&print)?;
    let mut outline = traced(&views.without_print(), arcs, 1.0)?;
    outline.score = score;
    if !outline.reasons.contains(&OutlineReason::FaintEdge) {
        outline.reasons.push(OutlineReason::FaintEdge);
    }
    Some(outline)
}

/// Makes the report of a search: the verdict and its reasons, from outlines of which the best is first. Outlines that
/// are worse, or that overlap the best one, are dropped.
fn report(mut outlines: Vec<PageOutline>) -> OutlineReport {
    let (corners, score, mut reasons) = (outlines.first())
        .map(|best| (best.corners, best.score, best.reasons.clone()))
        .unwrap_or_default();
    let verdict = if score < MIN_DOUBTFUL_SCORE {
        reasons.push(OutlineReason::NoPage);
        OutlineVerdict::NotFound
    } else if score < MIN_FOUND_SCORE || !reasons.is_empty() {
        OutlineVerdict::Doubtful
    } else {
        OutlineVerdict::Found
    };
    if verdict == OutlineVerdict::Doubtful && reasons.is_empty() {
        reasons.push(OutlineReason::UnlikelyShape);
    }
    let others = outlines.split_off(outlines.len().min(1));
    outlines.extend(others.into_iter().filter(|other| {
        verdict != OutlineVerdict::NotFound
            && other.score >= MIN_FOUND_SCORE
            && are_apart(&corners, &other.corners)
    }));
    OutlineReport {
        verdict: if outlines.len() > 1 {
            OutlineVerdict::Several
        } else {
            verdict
        },
        reasons,
        pages: outlines,
    }
}
