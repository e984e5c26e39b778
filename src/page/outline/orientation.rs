//! Orientation of a page by its print: lines of text run from left to right.

use super::planes::Planes;
use crate::dewarp::bilinear;
use crate::math::planar::distance;
use crate::page::text::{find_baselines, is_upside_down};

/// Minimum ratio of the lengths of lines of text that run down in the photo and that run across for the page to lie sideways
/// (`benches/outline.md`, Orientation).
const MIN_SIDEWAYS_RATIO: f64 = 1.5;

/// Minimum number of lines of text for a page to be turned by them: pictures and handwriting have a few bands that are none
/// (`benches/outline.md`, Orientation).
const MIN_SIDEWAYS_LINES: usize = 8;

/// Number of corners by which the list of corners has to be rotated to begin with the upper left one of the page as it
/// is read; 0 if the print does not tell. The corners are clockwise, in pixels of the reduced photo.
pub(super) fn quarter_turns(photo: &Planes, corners: &[[f64; 2]; 4]) -> usize {
    let turned = |turn: usize| [0, 1, 2, 3].map(|k| corners[(k + turn) % 4]);
    let size = |[a, b, c, d]: [[f64; 2]; 4]| {
        [[a, b, c, d], [b, c, d, a]].map(|[a, b, c, d]| 0.5 * (distance(a, b) + distance(c, d)))
    };
    let brightness = |[a, b, c, d]: [[f64; 2]; 4], share: [f64; 2]| {
        let place = bilinear(share, [2, 2], |i| [a, b, d, c][i]);
        place.map_or(f32::NAN, |place| photo.colour(place)[1].exp())
    };
    let text = |corners| find_baselines(size(corners), |share| brightness(corners, share));
    let length = |lines: &[Vec<[f64; 2]>]| lines.iter().map(Vec::len).sum::<usize>() as f64;
    let (level, sideways) = (text(*corners), text(turned(1)));
    if sideways.len() < MIN_SIDEWAYS_LINES
        || length(&sideways) < MIN_SIDEWAYS_RATIO * length(&level)
    {
        return 0;
    }
    let first = turned(1);
    match is_upside_down(size(first), |share| brightness(first, share)) {
        true => 3,
        false => 1,
    }
}
