//! Growth of connected regions.

use rustc_hash::FxHashSet;

/// Connected members from one on, the nearest along edges first, that are admitted one after another: `around` has the numbers of
/// the neighbours of each, and `admits` gets those that are members already and the next one.
pub(super) fn grow(
    around: &[Vec<u32>],
    seed: u32,
    admits: impl Fn(&[u32], u32) -> bool,
) -> Vec<u32> {
    let mut seen = FxHashSet::from_iter([seed]);
    let (mut members, mut next) = (vec![seed], 0);
    while let Some(member) = members.get(next).copied() {
        next += 1;
        for other in &around[member as usize] {
            if !seen.contains(other) && admits(&members, *other) {
                seen.insert(*other);
                members.push(*other);
            }
        }
    }
    members
}
