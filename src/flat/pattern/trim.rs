//! Specks at a border that nearly all strain of a part is in: where a surface ends in a steep point, a
//! few vertices may be torn apart however the part is cut.

use std::collections::VecDeque;

use super::labels::Labels;
use super::leaf::Leaf;
use crate::lattice::hexagonal::Lattice;
use crate::math::hash::NumberMap;

/// The share of a part's vertices that a speck has at most.
const SHARE: f64 = 0.002;

/// What a part without its specks is to be strained by at most, as a share of the limit.
const REST: f64 = 0.5;

/// The fewest vertices without which a part would surely be strained less than the limit; nothing if
/// these are more than `most`, away from its border, or all that holds it together.
pub(super) fn specks(
    lattice: &Lattice,
    labels: &Labels,
    part: u32,
    leaf: &Leaf,
    limit: f64,
    most: usize,
) -> Option<Vec<usize>> {
    let mut burden = leaf.burden(lattice);
    let most = most.min((SHARE * burden.len() as f64) as usize);
    burden.sort_by(|a, b| b.1.total_cmp(&a.1));
    let all: f64 = burden.iter().map(|(_, square)| square).sum();
    let rms = leaf.strain().rms();
    let allowed = all * (REST * limit / rms).powi(2);
    let mut left = all;
    let mut speck = NumberMap::default();
    for (i, square) in &burden {
        if left <= allowed {
            break;
        }
        left -= square;
        speck.insert(*i, ());
    }
    if speck.len() > most {
        return None;
    }
    let around = |i: usize| {
        let neighbours = lattice.neighbours(i / lattice.cols(), i % lattice.cols());
        neighbours.map(|vertex| vertex.map(|(row, col)| lattice.index(row, col)))
    };
    let own = |i: &usize| labels.of[*i] == part;
    let groups = |inside: &dyn Fn(&usize) -> bool| {
        let mut seen = NumberMap::default();
        let mut groups = Vec::new();
        for (first, _) in burden.iter().filter(|(i, _)| inside(i)) {
            if seen.insert(*first, ()).is_some() {
                continue;
            }
            let mut group = vec![*first];
            let mut queue = VecDeque::from([*first]);
            while let Some(i) = queue.pop_front() {
                for k in around(i).into_iter().flatten() {
                    if own(&k) && inside(&k) && seen.insert(k, ()).is_none() {
                        group.push(k);
                        queue.push_back(k);
                    }
                }
            }
            groups.push(group);
        }
        groups
    };
    let whole = groups(&|i| !speck.contains_key(i)).len() == 1;
    let at_border = |group: &Vec<usize>| {
        let out = |k: Option<usize>| k.is_none_or(|k| !own(&k));
        group.iter().any(|i| around(*i).into_iter().any(out))
    };
    let specks = groups(&|i| speck.contains_key(i));
    (whole && specks.iter().all(at_border)).then(|| specks.concat())
}
