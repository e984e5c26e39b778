//! Creases of a mesh made smooth, in space, before the mesh is cut: both sides of a cut are then one smooth line.

use nalgebra::Vector3;

use crate::math::index::NO_INDEX;
use crate::math::statistics::median;
use crate::scene::half_edges::{half_edge_ends, twin_half_edges};
use crate::shape::patches::chains::chains;
use crate::shape::patches::crease::smooth_polyline;

/// Minimum cosine of the angle by which a triangle may turn when a corner of it is moved onto a smooth crease.
/// `benches/patterns.md` has what others give.
const MIN_TURN_COSINE: f64 = 0.5;

/// Median distance of a line's points from cubics through their neighbours, in edge lengths, up to which the line is smooth.
/// `benches/patterns.md` has what others give.
const MAX_SMOOTH_DISTANCE_LENGTHS: f64 = 0.05;

/// Maximum number of times that the way of a vertex onto a smooth crease is halved. `benches/patterns.md` has what others give.
const MAX_HALVINGS: usize = 4;

/// Whether a line is one that follows the edges of a mesh, and not a smooth one: by the distances of its points from cubics through their
/// neighbours, of which the median counts, since a smooth line may have corners.
fn zigzags(line: &[[f64; 3]]) -> bool {
    let places: Vec<Vector3<f64>> = line.iter().map(|p| Vector3::from(*p)).collect();
    let edges = places.windows(2).map(|p| (p[1] - p[0]).norm());
    let edge = edges.sum::<f64>() / places.len() as f64;
    let away = places
        .windows(5)
        .map(|p| (p[2] - ((p[1] + p[3]) * 4.0 - p[0] - p[4]) / 6.0).norm());
    median(&mut away.collect::<Vec<f64>>())
        .is_some_and(|away| away > MAX_SMOOTH_DISTANCE_LENGTHS * edge)
}

/// Moves the vertices on the lines between patches so that these lines, which zigzag along edges of the mesh, are smooth. A vertex
/// stays where a triangle around it would turn over.
pub(super) fn smooth_creases(places: &mut [Vector3<f64>], triangles: &[[u32; 3]], patches: &[u32]) {
    let twins = twin_half_edges(triangles);
    let is_crease = |side: u32, twin: u32| {
        twin != NO_INDEX && side < twin && patches[side as usize / 3] != patches[twin as usize / 3]
    };
    let edges: Vec<[u32; 2]> = (0u32..)
        .zip(&twins)
        .filter(|(side, twin)| is_crease(*side, **twin))
        .map(|(side, _)| half_edge_ends(triangles, side))
        .collect();
    let mut moved: Vec<(u32, Vector3<f64>)> = Vec::new();
    for chain in chains(&edges, |_| false) {
        let line: Vec<[f64; 3]> = (chain.vertices.iter())
            .map(|v| places[*v as usize].into())
            .collect();
        if !zigzags(&line) {
            continue;
        }
        let smooth = smooth_polyline(line);
        moved.extend(
            chain
                .vertices
                .iter()
                .copied()
                .zip(smooth.into_iter().map(Vector3::from)),
        );
    }
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); places.len()];
    for (t, corners) in (0u32..).zip(triangles) {
        corners.iter().for_each(|v| around[*v as usize].push(t));
    }
    let normal = |places: &[Vector3<f64>], t: u32| {
        let [a, b, c] = triangles[t as usize].map(|v| places[v as usize]);
        (b - a).cross(&(c - a)).normalize()
    };
    let given = places.to_vec();
    for (vertex, place) in &moved {
        places[*vertex as usize] = *place;
    }
    // Vertices go back by half of their way until no triangle has turned.
    for round in 0..=MAX_HALVINGS {
        let turned = |v: u32| {
            let has_turned =
                |t: &u32| normal(&given, *t).dot(&normal(places, *t)) < MIN_TURN_COSINE;
            around[v as usize].iter().any(has_turned)
        };
        let back: Vec<u32> = moved
            .iter()
            .map(|(v, _)| *v)
            .filter(|v| turned(*v))
            .collect();
        for v in back.into_iter().map(|v| v as usize) {
            let share = if round < MAX_HALVINGS { 0.5 } else { 0.0 };
            places[v] = given[v] + (places[v] - given[v]) * share;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A level strip of squares, seven wide, each divided into two triangles, and patches on both sides of a line.
    fn strip(rows: u32, line: impl Fn(u32) -> u32) -> (Vec<Vector3<f64>>, Vec<[u32; 3]>, Vec<u32>) {
        let vertex = |row: u32, col: u32| 8 * row + col;
        let places =
            (0..8 * (rows + 1)).map(|v| Vector3::new(f64::from(v % 8), f64::from(v / 8), 0.0));
        let (mut triangles, mut patches) = (Vec::new(), Vec::new());
        for (row, col) in (0..rows).flat_map(|row| (0..7).map(move |col| (row, col))) {
            let [a, b] = [vertex(row, col), vertex(row, col + 1)];
            let [c, d] = [vertex(row + 1, col + 1), vertex(row + 1, col)];
            triangles.extend([[a, b, c], [a, c, d]]);
            patches.extend([u32::from(col >= line(row)); 2]);
        }
        (places.collect(), triangles, patches)
    }

    #[test]
    fn a_zigzag_becomes_straight_and_no_triangle_turns() {
        let (mut places, triangles, patches) = strip(30, |row| 3 + row % 2);
        let given = places.clone();
        smooth_creases(&mut places, &triangles, &patches);
        let moved = || (0..places.len()).filter(|v| places[*v] != given[*v]);
        assert!(moved().count() > 40);
        let off = moved().map(|v| (places[v].x - 3.5).abs());
        assert!(off.sum::<f64>() < 0.25 * moved().count() as f64);
        for corners in &triangles {
            let [a, b, c] = corners.map(|v| places[v as usize]);
            assert!((b - a).cross(&(c - a)).z > 0.0);
        }
    }

    #[test]
    fn a_straight_line_stays() {
        let (mut places, triangles, patches) = strip(30, |_| 3);
        let given = places.clone();
        smooth_creases(&mut places, &triangles, &patches);
        assert_eq!(places, given);
    }
}
