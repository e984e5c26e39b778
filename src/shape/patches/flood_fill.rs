//! Segments a heightfield by hysteresis thresholding, flood fill and region growing.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::bend_angles::BendAngles;
use super::patch::NO_PATCH;
use crate::error::{Result, try_filled};
use crate::heights::heightfield::Heightfield;

/// Ratio of the lower to the higher threshold of the bend angle (hysteresis). Limits how far a crease reaches from the
/// vertices that bend most. `benches/patterns.md` has what others give.
const LOW_TO_HIGH_BEND_ANGLE_RATIO: f64 = 0.4;

/// Minimum number of vertices of a region between creases; smaller ones are part of the creases around them.
const MIN_REGION_VERTICES: usize = 8;

/// Divides a heightfield into regions between creases. Returns the number of each vertex's region, from 0,
/// [`NO_PATCH`] where there is no height; `high` is the higher threshold of the bend angle, in radians. Costs `O(n
/// log n)` for `n` vertices.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub(super) fn segment(surface: &Heightfield, bend: &BendAngles, high: f64) -> Result<Vec<u32>> {
    let lattice = surface.lattice();
    let valid = |i: usize| !surface.heights()[i].is_nan();
    let around = |i: usize| {
        let neighbours = lattice.neighbours(i / lattice.cols(), i % lattice.cols());
        (neighbours.into_iter().flatten())
            .map(|(row, col)| lattice.index(row, col))
            .filter(|k| valid(*k))
    };
    // Bands of creases: vertices above the lower threshold that are connected with one above the higher threshold.
    let mut band = try_filled("patches", lattice.len(), false)?;
    let mut stack: Vec<usize> = (0..lattice.len())
        .filter(|i| bend.angle[*i] > high)
        .collect();
    for i in &stack {
        band[*i] = true;
    }
    while let Some(i) = stack.pop() {
        for k in around(i) {
            if !band[k] && bend.angle[k] > LOW_TO_HIGH_BEND_ANGLE_RATIO * high {
                band[k] = true;
                stack.push(k);
            }
        }
    }

    // Vertices without an angle come later, so that no patch leaks around the end of a crease.
    let open = |i: usize| !bend.angle[i].is_nan() && !band[i];
    let mut labels = try_filled("patches", lattice.len(), NO_PATCH)?;
    let mut seen = try_filled("patches", lattice.len(), false)?;
    let mut count = 0;
    let mut largest: (usize, Vec<usize>) = (0, Vec::new());
    for first in (0..lattice.len()).filter(|i| open(*i)) {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        let mut members = vec![first];
        let mut next = 0;
        while let Some(i) = members.get(next).copied() {
            next += 1;
            for k in around(i) {
                if open(k) && !seen[k] {
                    seen[k] = true;
                    members.push(k);
                }
            }
        }
        if members.len() >= MIN_REGION_VERTICES {
            members.iter().for_each(|i| labels[*i] = count);
            count += 1;
        } else if members.len() > largest.0 {
            largest = (members.len(), members);
        }
    }
    // A surface that consists of creases alone still has one patch.
    if count == 0 {
        largest.1.iter().for_each(|i| labels[*i] = 0);
        count = 1;
    }
    grow_regions(lattice.len(), bend, &mut labels, &valid, around);

    // Components that no region has reached: all of their vertices are creases or border.
    for first in 0..lattice.len() {
        if valid(first) && labels[first] == NO_PATCH {
            labels[first] = count;
            let mut stack = vec![first];
            while let Some(i) = stack.pop() {
                for k in around(i) {
                    if labels[k] == NO_PATCH {
                        labels[k] = count;
                        stack.push(k);
                    }
                }
            }
            count += 1;
        }
    }
    Ok(labels)
}

/// Grows the regions over the vertices beside them that have no region yet, those with the smallest bend angle
/// first.
fn grow_regions<I: Iterator<Item = usize>>(
    len: usize,
    bend: &BendAngles,
    labels: &mut [u32],
    valid: &impl Fn(usize) -> bool,
    around: impl Fn(usize) -> I,
) {
    // Bits of positive floats are in their order. Vertices on the border have no angle; the largest of their
    // neighbours continues a crease to the end of the surface.
    let key = |i: usize| -> u64 {
        let angle = bend.angle[i];
        let angles = around(i).map(|k| bend.angle[k]);
        let angle = if angle.is_nan() {
            angles.fold(0.0, f64::max)
        } else {
            angle
        };
        angle.to_bits()
    };
    // Among equal angles the vertex that has waited longest comes first.
    let mut waiting = 0u64;
    let mut queue = BinaryHeap::new();
    let mut offer = |queue: &mut BinaryHeap<_>, labels: &[u32], i: usize| {
        for k in around(i) {
            if labels[k] == NO_PATCH {
                waiting += 1;
                queue.push(Reverse((key(k), waiting, k, labels[i])));
            }
        }
    };
    for i in (0..len).filter(|i| valid(*i)) {
        if labels[i] != NO_PATCH {
            offer(&mut queue, labels, i);
        }
    }
    while let Some(Reverse((_, _, i, label))) = queue.pop() {
        if labels[i] == NO_PATCH {
            labels[i] = label;
            offer(&mut queue, labels, i);
        }
    }
}
