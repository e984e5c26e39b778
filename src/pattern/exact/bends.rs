//! Bends of a net: neighbouring narrow facets of a cylinder or cone, with the angle and the radius of the whole.

use rustc_hash::FxHashMap;

use super::patches::FlatPatches;
use crate::math::planar::Point2;
use crate::math::statistics::median;
use crate::pattern::sheets::{Bend, Fold};
use crate::scene::polyhedron::Polyhedron;

/// Largest distance of pieces of a fold from one line, as a share of its length. No table chose it: they are on it up to rounding.
const PIECE_ROUNDING: f64 = 1e-6;

/// Radius of each bend, at the number of the facet that names it: of the circle whose chords its facets are. Beside it the length of
/// these chords for each radian that the bend turns.
pub(super) fn radii(solid: &Polyhedron, patches: &FlatPatches) -> Vec<Option<[f64; 2]>> {
    let facets = |side: u32| [side, solid.twins[side as usize]].map(|s| solid.facet(s));
    let mut lengths = vec![0.0; solid.normals.len()];
    for side in solid.inner_sides() {
        let [a, b] = facets(side);
        for (own, _) in [(a, b), (b, a)]
            .iter()
            .filter(|(own, other)| patches.goes_on(*own, *other))
        {
            lengths[*own as usize] += solid.length(side);
        }
    }
    // In space a facet is a chord, even if it lies flat as long as its arc.
    let mut chords = vec![0.0; solid.normals.len()];
    for (t, facet) in solid.facets.iter().enumerate() {
        let [a, b, c] = solid.corners(t);
        chords[*facet as usize] += 0.5 * (b - a).cross(&(c - a)).norm();
    }
    // A facet of a bend has a line on either side.
    let width = |areas: &[f64], facet: u32| 2.0 * areas[facet as usize] / lengths[facet as usize];
    // Both radii at each of a bend's inner lines; beside a hole they are none.
    let mut inner = vec![[Vec::new(), Vec::new()]; solid.normals.len()];
    for side in solid.inner_sides() {
        let [a, b] = facets(side);
        if patches.bends[a as usize] == patches.bends[b as usize] {
            let [chord, wide] =
                [&chords, &solid.areas].map(|areas| 0.5 * (width(areas, a) + width(areas, b)));
            let angle = solid.angle(side).abs();
            let [radii, chord_radii] = &mut inner[patches.bends[a as usize] as usize];
            radii.push(0.5 * chord / (0.5 * angle).sin());
            chord_radii.push(wide / angle);
        }
    }
    (inner.iter_mut())
        .map(|[radii, chord_radii]| Some([median(radii)?, median(chord_radii)?]))
        .collect()
}

/// Tells the folds of each bend of a sheet which bend that is; `bend_of` gives the number of a fold's bend, with its
/// radius and the length of its chords for each radian, and `cut_angles` how much a bend all around turns where it is cut.
pub(super) fn mark_bends(
    folds: &mut [Fold],
    cut_angles: &FxHashMap<u32, f64>,
    bend_of: impl Fn(&Fold) -> Option<(u32, [f64; 2])>,
) {
    let mut of: FxHashMap<u32, ([f64; 2], Vec<usize>)> = FxHashMap::default();
    for (k, fold) in folds.iter().enumerate() {
        if let Some((number, radii)) = bend_of(fold) {
            of.entry(number).or_insert((radii, Vec::new())).1.push(k);
        }
    }
    for (number, ([radius, chord_radius], mut own)) in of {
        let middle = |k: usize| {
            let points = &folds[k].points;
            let [from, to] = [points[0], points[points.len() - 1]].map(|[x, y]| Point2::new(x, y));
            (0.5 * (from + to), to - from)
        };
        let (origin, along) = middle(own[0]);
        let away = |k: &usize| (along.conj() * (middle(*k).0 - origin)).im;
        own.sort_by(|a, b| away(a).total_cmp(&away(b)));
        // The pieces of one line have one angle.
        let is_piece = |a: usize, b: usize| {
            folds[a].seam.crease == folds[b].seam.crease
                || (away(&a) - away(&b)).abs() <= PIECE_ROUNDING * along.norm()
        };
        let mut lines = own.clone();
        lines.dedup_by(|a, b| is_piece(*a, *b));
        let angle_of = |k: &usize| folds[*k].seam.angle;
        let folded: f64 = lines.iter().map(angle_of).sum();
        let angle = folded + cut_angles.get(&number).unwrap_or(&0.0);
        let mut turned = 0.0;
        let past = lines.iter().find(|k| {
            turned += angle_of(k);
            turned >= 0.5 * folded - 1e-9
        });
        let central = past.copied();
        let is_middle: Vec<bool> = (own.iter())
            .map(|k| central.is_some_and(|central| is_piece(*k, central)))
            .collect();
        for (k, is_middle) in own.into_iter().zip(is_middle) {
            folds[k].bend = Some(Bend {
                number,
                angle,
                radius,
                chord_radius,
                is_middle,
            });
        }
    }
}
