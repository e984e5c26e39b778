//! Vertices to patches: what does not bend is flooded, then what does is shared out.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::bend::Bend;
use super::patch::NO_PATCH;
use crate::error::{Result, try_filled};
use crate::heights::heightfield::Heightfield;

/// The lower threshold, in terms of the higher one.
const LOW: f64 = 0.4;

/// Fewer vertices between bands are a part of these.
const SPECK: usize = 8;

/// The patch of each vertex, numbered from 0 in no particular order.
pub(super) fn regions(surface: &Heightfield, bend: &Bend, high: f64) -> Result<Vec<u32>> {
    let lattice = surface.lattice();
    let valid = |i: usize| !surface.heights()[i].is_nan();
    let around = |i: usize| {
        let neighbours = lattice.neighbours(i / lattice.cols(), i % lattice.cols());
        (neighbours.into_iter().flatten())
            .map(|(row, col)| lattice.index(row, col))
            .filter(|k| valid(*k))
    };
    // Bands: what bends by more than the lower threshold and hangs together with what bends by
    // more than the higher one.
    let mut band = try_filled("patches", lattice.len(), false)?;
    let mut stack: Vec<usize> = (0..lattice.len())
        .filter(|i| bend.angle[*i] > high)
        .collect();
    for i in &stack {
        band[*i] = true;
    }
    while let Some(i) = stack.pop() {
        for k in around(i) {
            if !band[k] && bend.angle[k] > LOW * high {
                band[k] = true;
                stack.push(k);
            }
        }
    }

    // Vertices without an angle wait, so that no patch leaks around the end of a crease.
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
        if members.len() >= SPECK {
            members.iter().for_each(|i| labels[*i] = count);
            count += 1;
        } else if members.len() > largest.0 {
            largest = (members.len(), members);
        }
    }
    // A surface that is nothing but crease still has a patch.
    if count == 0 {
        largest.1.iter().for_each(|i| labels[*i] = 0);
        count = 1;
    }
    grow(lattice.len(), bend, &mut labels, &valid, around);

    // What no patch has reached: parts of the surface that are all crease or all border.
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

/// Patches take over the vertices beside them, those that bend least first.
fn grow<I: Iterator<Item = usize>>(
    len: usize,
    bend: &Bend,
    labels: &mut [u32],
    valid: &impl Fn(usize) -> bool,
    around: impl Fn(usize) -> I,
) {
    // Positive floats are in the order of their bits. Vertices on the border have no angle; their
    // neighbours' largest makes a crease go on to the end of the surface.
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
    // Of those that bend alike, the one that has waited longest.
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
