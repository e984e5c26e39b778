//! What a sheet has to be: joined without strain, and within a simple outline.

use super::layout::apart;
use super::leaf::Strain;
use super::net::{Net, is_triangle};
use super::outline::{Layout, Motion};
use crate::error::Result;
use crate::flat::unroll::joint::Joint;
use crate::flat::unroll::overlap::crossings;
use crate::flat::unroll::pieces::Point;

/// Sides that are no further apart, in spacings, need no joint unrolling.
const CLOSE: f64 = 0.05;

/// So many nodes beside the place where three patches meet are not tied: where more meet they are not
/// where they should be.
const LOOSE: usize = 3;

/// Change of the energy in one step of it that is none.
const TOLERANCE: f64 = 1e-8;

/// Lays the patches of a sheet flat together, tied along its folds, where these do not fit as they
/// are. Returns whether that was done; the patches then lie where they are to be, and their motions are
/// none.
pub(super) fn join(
    net: &mut Net,
    layout: &mut Layout,
    patches: &[u32],
    folded: &[usize],
) -> Result<bool> {
    if folded
        .iter()
        .all(|seam| apart(net, layout, *seam) <= CLOSE * net.spacing)
    {
        return Ok(false);
    }
    let mut joint = Joint {
        pieces: Vec::new(),
        ties: Vec::new(),
    };
    let mut places: Vec<Point> = Vec::new();
    let mut starts = Vec::new();
    for patch in patches {
        let first = places.len() as u32;
        starts.push(first);
        let Some(leaf) = net.leaves[*patch as usize].as_ref() else {
            continue;
        };
        let motion = layout.motions[*patch as usize];
        places.extend(leaf.places().iter().map(|place| motion.of(*place)));
        let pieces = leaf.all_pieces().filter(|(piece, _)| piece.exists());
        joint
            .pieces
            .extend(pieces.map(|(piece, corners)| (piece, corners.map(|v| first + v))));
    }
    for seam in folded {
        let seam = &net.seams[*seam];
        let last = seam.nodes.len() - 1;
        let from = if is_triangle(seam.nodes[0]) { LOOSE } else { 0 };
        let to = if is_triangle(seam.nodes[last]) {
            last.saturating_sub(LOOSE)
        } else {
            last
        };
        for node in seam.nodes.iter().take(to + 1).skip(from) {
            let mean = |side: usize| {
                let patch = seam.patches[side];
                let first = starts[patches.binary_search(&patch).ok()?];
                Some(net.mean(*node, patch)?.map(|(v, w)| (first + v, w)))
            };
            if let (Some(one), Some(other)) = (mean(0), mean(1)) {
                joint.ties.push([one, other]);
            }
        }
    }
    joint.relax(&mut places, TOLERANCE)?;
    for (k, patch) in patches.iter().enumerate() {
        let end = starts.get(k + 1).map_or(places.len(), |end| *end as usize);
        net.set_places(*patch, places[starts[k] as usize..end].to_vec());
        layout.motions[*patch as usize] = Motion::NONE;
    }
    Ok(true)
}

/// The strain of a sheet, and that of each of its patches.
pub(super) fn strains(net: &Net, patches: &[u32]) -> (Strain, Vec<(u32, Strain)>) {
    let leaf = |patch: &u32| net.leaves[*patch as usize].as_ref();
    let of = |patch: &u32| Some((*patch, leaf(patch)?.strain()));
    let all: Vec<(u32, Strain)> = patches.iter().filter_map(of).collect();
    let sum = all
        .iter()
        .fold(Strain::default(), |sum, (_, strain)| sum.with(*strain));
    (sum, all)
}

/// The first place where lines cross each other or themselves; each is closed.
pub(super) fn crossing(lines: &[Vec<[f64; 2]>]) -> Option<Point> {
    let (mut places, mut edges) = (Vec::new(), Vec::new());
    for line in lines {
        let (first, count) = (places.len() as u32, line.len() as u32);
        places.extend(line.iter().map(|[x, y]| Point::new(*x, *y)));
        edges.extend((0..count).map(|k| [first + k, first + (k + 1) % count]));
    }
    let found = crossings(&places, &edges).into_iter().next()?;
    Some(places[edges[found[0]][0] as usize])
}
