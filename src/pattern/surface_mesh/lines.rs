//! The lines that are edges of the mesh: creases and the border, as points at equal distances.

use rustc_hash::{FxHashMap, FxHashSet};

use std::collections::BTreeMap;

use super::border::BorderLines;
use super::nodes::Nodes;
use crate::error::Result;
use crate::math::index::NO_INDEX;
use crate::math::planar::{polygon_area, polyline_length};
use crate::math::union_find::UnionFind;
use crate::shape::patches::NO_PATCH;
use crate::shape::patches::crease::{
    CreaseNode, crease_lines, smooth_polyline, smooth_polyline_within,
};

/// Vertical distance between the two sides of a crease, root mean square along it and in edge lengths of the mesh, above
/// which the surface has a step there. `benches/patterns.md` has what others give.
const MIN_STEP_LENGTHS: f64 = 0.5;

/// Minimum length of a crease between two junctions, in edge lengths of the mesh; a shorter one is one junction of all patches there.
/// `benches/patterns.md` has what others give.
const MIN_CREASE_LENGTHS: f64 = 2.0;

/// Minimum area of a hole, in squared edge lengths of the mesh. `benches/patterns.md` has what others give.
const MIN_HOLE_SQUARES: f64 = 0.5;

/// Points on lines, and the edges between them.
#[derive(Default)]
pub(super) struct Lines {
    /// Positions seen from above.
    pub points: Vec<[f64; 2]>,
    /// For each point the patches that meet there: the patch, its height, and the lowest number of a patch that shares a vertex
    /// with it.
    patches: Vec<Vec<(u32, f64, u32)>>,
    pub edges: Vec<[u32; 2]>,
    /// The edges along the border, from one point to the next; the surface is to their left.
    pub border: FxHashSet<[u32; 2]>,
    /// Number of steps, and area of the walls there.
    pub steps: usize,
    pub step_area: f64,
    ends: FxHashMap<CreaseNode, u32>,
    at: FxHashMap<[u64; 2], u32>,
}

impl Lines {
    /// Finds the lines of a surface, with points at about a given distance from each other.
    pub(super) fn new(
        nodes: &Nodes,
        labels: &[u32],
        border: &BorderLines,
        length: f64,
    ) -> Result<Lines> {
        let mut lines = Lines::default();
        let creases = crease_lines(nodes.lattice, labels);
        let short = lines.merge_junctions(nodes, &creases, length)?;
        for ((patches, line), _) in creases.iter().zip(short).filter(|(_, short)| !short) {
            lines.add_crease(nodes, *patches, line, length);
        }
        for line in &border.lines {
            lines.add_border(nodes, border, line, length);
        }
        Ok(lines)
    }

    /// Lets junctions be one point between which a crease is too short for the mesh. Returns which creases are.
    fn merge_junctions(
        &mut self,
        nodes: &Nodes,
        creases: &[([u32; 2], Vec<CreaseNode>)],
        length: f64,
    ) -> Result<Vec<bool>> {
        let mut numbers: FxHashMap<CreaseNode, u32> = FxHashMap::default();
        let mut all: Vec<CreaseNode> = Vec::new();
        for (_, line) in creases {
            for end in [line[0], line[line.len() - 1]] {
                if end.1 == NO_INDEX && !numbers.contains_key(&end) {
                    numbers.insert(end, all.len() as u32);
                    all.push(end);
                }
            }
        }
        let mut sets = UnionFind::new("pattern", all.len())?;
        let mut short = Vec::with_capacity(creases.len());
        for (_, line) in creases {
            let ends = [line[0], line[line.len() - 1]].map(|end| numbers.get(&end).copied());
            let points: Vec<[f64; 2]> = line.iter().map(|node| nodes.node(*node, []).0).collect();
            short.push(match ends {
                [Some(a), Some(b)]
                    if a != b && polyline_length(&points) < MIN_CREASE_LENGTHS * length =>
                {
                    sets.union(a, b);
                    true
                }
                _ => false,
            });
        }
        let mut groups: BTreeMap<u32, Vec<CreaseNode>> = BTreeMap::new();
        for (number, node) in (0..).zip(all) {
            groups.entry(sets.find(number)).or_default().push(node);
        }
        for group in groups.into_values() {
            let places = group.iter().map(|node| nodes.node(*node, []).0);
            let sum = places.fold([0.0; 2], |sum, at| [0, 1].map(|k| sum[k] + at[k]));
            let mut at = sum.map(|x| x / group.len() as f64);
            if group.len() > 1 {
                let ends = |line: &[CreaseNode]| {
                    group.contains(&line[0]) || group.contains(&line[line.len() - 1])
                };
                let own = creases.iter().filter(|(_, line)| ends(line));
                let mut patches: Vec<u32> = own.flat_map(|(patches, _)| *patches).collect();
                patches.sort_unstable();
                patches.dedup();
                at = nodes.common_point(at, &patches, MIN_CREASE_LENGTHS * length);
            }
            let number = self.point(at);
            self.ends
                .extend(group.into_iter().map(|node| (node, number)));
        }
        Ok(short)
    }

    fn add_crease(&mut self, nodes: &Nodes, patches: [u32; 2], line: &[CreaseNode], length: f64) {
        // A patch of a few vertices says nothing beyond them.
        let known = |[a, b]: [f64; 2]| {
            [
                if a.is_finite() { a } else { b },
                if b.is_finite() { b } else { a },
            ]
        };
        let points = line.iter().map(|node| match self.ends.get(node) {
            Some(number) => {
                let [x, y] = self.points[*number as usize];
                let [a, b] = known(patches.map(|patch| nodes.height_at([x, y], patch)));
                [x, y, a, b]
            }
            None => {
                let ([x, y], heights) = nodes.node(*node, patches);
                let [a, b] = known(heights);
                [x, y, a, b]
            }
        });
        let points: Vec<[f64; 4]> = points.collect();
        let squares = points
            .iter()
            .map(|[_, _, a, b]| (a - b).powi(2))
            .sum::<f64>();
        let gap = (squares / points.len() as f64).sqrt();
        let is_step = gap > MIN_STEP_LENGTHS * length;
        let points = smooth_polyline(points);
        if is_step {
            self.steps += 1;
            let plan: Vec<[f64; 2]> = points.iter().map(|[x, y, ..]| [*x, *y]).collect();
            self.step_area += gap * polyline_length(&plan);
        }
        let ends = [line[0], line[line.len() - 1]].map(Some);
        let placed = self.place(resampled(points, length), ends);
        for (number, [_, _, a, b]) in placed {
            self.meet(number, patches, [a, b], is_step);
        }
    }

    /// Adds the border as lines between the points that have to be on it: corners, and ends of creases.
    fn add_border(&mut self, nodes: &Nodes, border: &BorderLines, line: &[u32], length: f64) {
        // The points of the line, each with its patch on the line after it, and its key if it is an end.
        let mut points: Vec<([f64; 3], u32, Option<CreaseNode>)> = Vec::with_capacity(line.len());
        for (k, vertex) in line.iter().enumerate() {
            let next = line[(k + 1) % line.len()];
            let [here, there] = [*vertex, next].map(|v| nodes.label(v));
            let [x, y] = nodes.plan(*vertex);
            let key = border.is_fixed(*vertex).then_some((*vertex, *vertex));
            if !border.is_beside_corner(*vertex) {
                points.push(([x, y, nodes.height(*vertex, here)], here, key));
            }
            if here != there {
                let node = ((*vertex).min(next), (*vertex).max(next));
                let ([x, y], [z]) = nodes.node(node, [there]);
                points.push(([x, y, z], there, Some(node)));
            }
        }
        let Some(start) = points.iter().position(|(_, _, key)| key.is_some()) else {
            let plan: Vec<[f64; 2]> = points.iter().map(|([x, y, _], ..)| [*x, *y]).collect();
            if polygon_area(&plan).abs() >= MIN_HOLE_SQUARES * length * length {
                let patch = points[0].1;
                let all = points.iter().map(|(point, ..)| *point);
                let closed = all.chain([points[0].0]).collect();
                let closed = smooth_border(nodes, closed, patch);
                self.add_border_piece(patch, resampled(closed, length), [None; 2]);
            }
            return;
        };
        points.rotate_left(start);
        points.push(points[0]);
        let mut from = 0;
        for to in 1..points.len() {
            if points[to].2.is_none() {
                continue;
            }
            let mut piece: Vec<[f64; 3]> =
                points[from..=to].iter().map(|(point, ..)| *point).collect();
            let patch = points[from].1;
            // At its end the piece has the height of its own patch.
            if let Some(last) = piece.last_mut()
                && let Some((p, q)) = points[to].2.filter(|(p, q)| p != q)
            {
                last[2] = nodes.node((p, q), [patch]).1[0];
            }
            self.add_border_piece(
                patch,
                resampled(smooth_border(nodes, piece, patch), length),
                [points[from].2, points[to].2],
            );
            from = to;
        }
    }

    fn add_border_piece(
        &mut self,
        patch: u32,
        points: Vec<[f64; 3]>,
        ends: [Option<CreaseNode>; 2],
    ) {
        let placed = self.place(points, ends);
        self.border
            .extend(placed.windows(2).map(|pair| [pair[0].0, pair[1].0]));
        for (number, [_, _, z]) in placed {
            self.meet(number, [patch; 2], [z; 2], false);
        }
    }

    /// Adds the points of a line and the edges between them. Returns the number of each point.
    fn place<const N: usize>(
        &mut self,
        points: Vec<[f64; N]>,
        ends: [Option<CreaseNode>; 2],
    ) -> Vec<(u32, [f64; N])> {
        let last = points.len() - 1;
        let is_closed = ends[0] == ends[1] && points[0][..2] == points[last][..2];
        let mut numbers: Vec<(u32, [f64; N])> = Vec::with_capacity(points.len());
        for (k, point) in points.into_iter().enumerate() {
            let key = match k {
                0 => ends[0],
                _ if k == last => ends[1],
                _ => None,
            };
            let number = match (
                key.and_then(|key| self.ends.get(&key)),
                k == last && is_closed,
            ) {
                (Some(number), _) => *number,
                (_, true) => numbers[0].0,
                _ => self.point([point[0], point[1]]),
            };
            if let Some(key) = key {
                self.ends.insert(key, number);
            }
            if let Some((before, _)) = numbers.last().filter(|(before, _)| *before != number) {
                self.edges.push([*before, number]);
            }
            numbers.push((number, point));
        }
        numbers
    }

    /// Returns the group of patches that a patch meets at a point without a step, and the mean of their heights there; the height is
    /// `None` for points on no line, and for patches that are not known to meet there.
    pub(super) fn meeting(&self, point: u32, patch: u32) -> (u32, Option<f64>) {
        let known = self
            .patches
            .get(point as usize)
            .map(Vec::as_slice)
            .unwrap_or_default();
        let Some((_, _, group)) = known.iter().find(|(own, ..)| *own == patch) else {
            return (NO_PATCH, None);
        };
        let own = known.iter().filter(|(_, _, lowest)| lowest == group);
        let heights = own.map(|(_, z, _)| *z).filter(|z| z.is_finite());
        let (sum, count) = heights.fold((0.0, 0.0), |(sum, n), z| (sum + z, n + 1.0));
        (*group, (count > 0.0).then(|| sum / count))
    }

    /// Returns the number of the point at a position.
    fn point(&mut self, at: [f64; 2]) -> u32 {
        // Without a negative zero.
        let at = at.map(|x| x + 0.0);
        let next = self.points.len() as u32;
        let number = *self.at.entry(at.map(f64::to_bits)).or_insert(next);
        if number == next {
            self.points.push(at);
            self.patches.push(Vec::new());
        }
        number
    }

    /// Lets two patches meet at a point; they share a vertex there unless there is a step between them.
    fn meet(&mut self, point: u32, patches: [u32; 2], heights: [f64; 2], is_step: bool) {
        let all = &mut self.patches[point as usize];
        let mut lowest = [0; 2];
        for ((lowest, patch), height) in lowest.iter_mut().zip(patches).zip(heights) {
            *lowest = match all.iter().find(|(own, ..)| *own == patch) {
                Some((_, _, lowest)) => *lowest,
                None => {
                    all.push((patch, height, patch));
                    patch
                }
            };
        }
        if !is_step {
            let [a, b] = lowest;
            let joined = all.iter_mut().filter(|(_, _, lowest)| *lowest == a.max(b));
            joined.for_each(|(_, _, lowest)| *lowest = a.min(b));
        }
    }
}

/// Smooths the border of a patch, seen from above: the border of a surface on a lattice is known to half a spacing. Points that move stay
/// on the patch.
fn smooth_border(nodes: &Nodes, line: Vec<[f64; 3]>, patch: u32) -> Vec<[f64; 3]> {
    let plan: Vec<[f64; 2]> = line.iter().map(|[x, y, _]| [*x, *y]).collect();
    let reach = 0.5 * nodes.lattice.lattice().spacing();
    let moved = smooth_polyline_within(&plan, reach).into_iter();
    let place = |([x, y, z], [u, v]): (&[f64; 3], [f64; 2])| {
        // Beyond the surface it goes on as it does on the other side of the point.
        let ahead = nodes.height_at([u, v], patch);
        let behind = nodes.height_at([2.0 * x - u, 2.0 * y - v], patch);
        let heights = [ahead, 2.0 * z - behind];
        let height = heights.into_iter().find(|height| height.is_finite());
        match height.filter(|_| [u, v] != [*x, *y]) {
            Some(height) => [u, v, height],
            None => [*x, *y, *z],
        }
    };
    line.iter().zip(moved).map(place).collect()
}

/// Points at equal distances along a line, seen from above; the ends stay.
fn resampled<const N: usize>(line: Vec<[f64; N]>, length: f64) -> Vec<[f64; N]> {
    let steps: Vec<f64> = (line.windows(2))
        .map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]))
        .collect();
    let whole: f64 = steps.iter().sum();
    let last = line.len() - 1;
    let is_closed = line[0][..2] == line[last][..2];
    let count = ((whole / length).round() as usize).max(if is_closed { 3 } else { 1 });
    let mut points = Vec::with_capacity(count + 1);
    let (mut k, mut before) = (0, 0.0);
    for i in 0..count {
        let wanted = whole * i as f64 / count as f64;
        while k + 1 < steps.len() && before + steps[k] < wanted {
            before += steps[k];
            k += 1;
        }
        let share = if steps[k] > 0.0 {
            ((wanted - before) / steps[k]).min(1.0)
        } else {
            0.0
        };
        points.push(std::array::from_fn(|d| {
            line[k][d] + share * (line[k + 1][d] - line[k][d])
        }));
    }
    points[0] = line[0];
    points.push(line[last]);
    points
}
