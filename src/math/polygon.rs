//! Polygons in the plane, with holes, divided into triangles by ear clipping.

use super::planar::{Point2, orientation, polygon_area, segments_intersect};

/// Maximum number of corners of a polygon: cutting off ears costs the square of it, and the cube at worst, a second for these.
pub(crate) const MAX_POLYGON_CORNERS: usize = 600;

/// Triangles of the polygon within closed lines, by the numbers of their points; outer lines are anticlockwise and holes
/// clockwise. `None` if lines cross.
pub(crate) fn triangulate(lines: Vec<Vec<Point2>>) -> Option<Vec<[usize; 3]>> {
    let points: Vec<Point2> = lines.concat();
    let mut first = 0;
    let (mut outer, mut holes) = (Vec::new(), Vec::new());
    for line in &lines {
        let numbers: Vec<usize> = (first..first + line.len()).collect();
        first += line.len();
        match polygon_area(line) > 0.0 {
            true => outer.push(numbers),
            false => holes.push(numbers),
        }
    }
    if points.len() > MAX_POLYGON_CORNERS {
        return None;
    }
    let [mut ring] = <[Vec<usize>; 1]>::try_from(outer).ok()?;
    while !holes.is_empty() {
        // The shortest bridge to a hole that crosses no line.
        let mut bridges: Vec<(f64, usize, usize, usize)> = Vec::new();
        for (i, a) in ring.iter().enumerate() {
            for (hole, line) in holes.iter().enumerate() {
                let far = |b: &usize| (points[*b] - points[*a]).norm();
                bridges.extend(line.iter().enumerate().map(|(k, b)| (far(b), i, hole, k)));
            }
        }
        bridges.sort_by(|a, b| a.0.total_cmp(&b.0));
        let crosses = |a: usize, b: usize| {
            let mut edges = std::iter::once(&ring)
                .chain(&holes)
                .flat_map(|line| (0..line.len()).map(|k| [line[k], line[(k + 1) % line.len()]]));
            edges.any(|[c, d]| {
                let meets = [c, d].iter().any(|v| [a, b].contains(v));
                !meets && segments_intersect([points[a], points[b]], [points[c], points[d]])
            })
        };
        let is_free = |bridge: &&(f64, usize, usize, usize)| {
            !crosses(ring[bridge.1], holes[bridge.2][bridge.3])
        };
        let (_, i, hole, k) = *bridges.iter().find(is_free)?;
        let mut line = holes.swap_remove(hole);
        line.rotate_left(k);
        line.extend([line[0], ring[i]]);
        ring.splice(i + 1..i + 1, line);
    }
    clip_ears(ring, &points)
}

/// Triangles of a polygon by the numbers of its corners, which go around it anticlockwise and may come twice where it touches
/// itself; `None` if its sides cross.
fn clip_ears(mut ring: Vec<usize>, points: &[Point2]) -> Option<Vec<[usize; 3]>> {
    let corner = |ring: &[usize], k: usize| {
        let n = ring.len();
        [(k + n - 1) % n, k, (k + 1) % n].map(|k| ring[k])
    };
    let turn = |[a, b, c]: [usize; 3]| orientation(points[a], points[b], points[c]);
    // How wide the ear at a corner is; `None` where there is no ear.
    let width = |ring: &[usize], k: usize| {
        let [a, b, c] = corner(ring, k);
        let is_inside = |v: &usize| {
            let is_corner = [a, b, c].iter().any(|own| points[*own] == points[*v]);
            let sides = [[a, b, *v], [b, c, *v], [c, a, *v]];
            !is_corner && sides.into_iter().all(|side| turn(side) >= 0.0)
        };
        let is_ear = turn([a, b, c]) > 0.0 && !ring.iter().any(is_inside);
        is_ear.then(|| turn([a, b, c]) / (points[c] - points[a]).norm_sqr())
    };
    let all =
        |ring: &[usize]| -> Vec<Option<f64>> { (0..ring.len()).map(|k| width(ring, k)).collect() };
    let mut widths = all(&ring);
    let mut triangles = Vec::new();
    while ring.len() > 3 {
        // What an ear has in it may have been cut off.
        if widths.iter().all(Option::is_none) {
            widths = all(&ring);
        }
        // The ear with the largest smallest side keeps slivers few.
        let (_, ear) = (widths.iter().enumerate())
            .filter_map(|(k, width)| Some(((*width)?, k)))
            .max_by(|a, b| a.0.total_cmp(&b.0))?;
        triangles.push(corner(&ring, ear));
        ring.remove(ear);
        widths.remove(ear);
        for k in [(ear + ring.len() - 1) % ring.len(), ear % ring.len()] {
            widths[k] = width(&ring, k);
        }
    }
    let last = [ring[0], ring[1], ring[2]];
    if turn(last) > 0.0 {
        triangles.push(last);
    }
    (turn(last) >= 0.0).then_some(triangles)
}
