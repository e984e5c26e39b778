//! Specks at a border that nearly all strain of a part is in: where a surface ends in a steep point, a
//! few vertices may be torn apart however the part is cut.

use super::labels::{Labels, around, hanging_together};
use super::leaf::Leaf;
use crate::lattice::hexagonal::Lattice;
use crate::math::hash::NumberMap;

/// The share of a part's vertices that a speck has at most.
const SHARE: f64 = 0.002;

/// Those of a vertex inside a lattice.
const NEIGHBOURS: usize = 6;

/// What a part without its specks is to be strained by at most, as a share of the limit.
const REST: f64 = 0.5;

/// The fewest vertices without which a part would surely be strained less than the limit; nothing if
/// there are none, or more than `most`, or away from its border, or all that holds it together.
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
    if speck.is_empty() || speck.len() > most {
        return None;
    }
    let together = |inside: &dyn Fn(usize) -> bool| {
        let members = burden.iter().map(|(i, _)| *i).filter(|i| inside(*i));
        hanging_together(lattice, members, |_, _| true)
    };
    let whole = together(&|i| !speck.contains_key(&i)).len() == 1;
    let is_outermost = |i: usize| {
        let own = around(lattice, i).filter(|k| labels.of[*k] == part);
        own.count() < NEIGHBOURS
    };
    let specks = together(&|i| speck.contains_key(&i));
    let at_border = |group: &Vec<usize>| group.iter().any(|i| is_outermost(*i));
    (whole && specks.iter().all(at_border)).then(|| specks.concat())
}
