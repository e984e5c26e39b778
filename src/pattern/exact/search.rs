//! The search for a net with fewer pieces and shorter cuts.

use oorandom::Rand64;
use rustc_hash::FxHashSet;

use super::net::Net;
use crate::error::Result;
use crate::math::motion::Motion;
use crate::math::union_find::UnionFind;

/// Work of the search for fewer pieces and shorter cuts, in triangles that are placed or compared.
/// `benches/patterns.md` has what others give.
const SEARCH_WORK: usize = 6_000_000;

/// Largest distance, in facets, from the hinge about which the search takes a net apart.
/// `benches/patterns.md` has what others give.
const MAX_RUIN_RADIUS: u32 = 3;

impl Net<'_> {
    /// Number of pieces, and cost of all cuts; edges that are to be joined and are not cost more than any pieces.
    fn cost(&self, pieces: usize) -> (usize, f64) {
        let cut = self
            .hinges
            .iter()
            .zip(&self.is_joined)
            .filter(|(_, joined)| !**joined);
        let open = cut.filter(|(hinge, _)| !self.is_closed(hinge.side));
        let wrong = self.hinges.len() * self.open_joins().count();
        (pieces + wrong, open.map(|(hinge, _)| hinge.cost).sum())
    }

    /// Cost of the forest of the costliest hinges, if nothing overlaps: no forest has a lower one.
    fn least_cost(&self) -> Result<(usize, f64)> {
        let mut forest = UnionFind::new("facets", self.pieces.len())?;
        let mut least = (self.pieces.len(), 0.0);
        // The costliest hinges come first.
        for hinge in &self.hinges {
            let [a, b] = hinge.facets;
            if self.choices.cut.contains(&hinge.facets) || forest.find(a) == forest.find(b) {
                least.1 += hinge.cost;
            } else {
                least.0 -= 1;
                forest.union(a, b);
            }
        }
        Ok(least)
    }

    /// Takes the net apart around one cut after another and joins it again in another order; keeps what is better
    /// (ruin and recreate).
    pub(super) fn improve(&mut self) -> Result<()> {
        let mut random = Rand64::new(0);
        let count = |net: &Net| {
            net.pieces
                .iter()
                .filter(|piece| !piece.facets.is_empty())
                .count()
        };
        let mut best = self.cost(count(self));
        let least = self.least_cost()?;
        let limit = self.work + SEARCH_WORK;
        while self.work < limit && (best.0 > least.0 || best.1 > least.1 + self.solid.rounding) {
            let cuts: Vec<u32> = (0..self.hinges.len() as u32)
                .filter(|hinge| {
                    let hinge = *hinge as usize;
                    !self.is_joined[hinge] && !self.is_closed(self.hinges[hinge].side)
                })
                .collect();
            // The pieces on both sides of each cut.
            let beside = |hinge: &u32| {
                let both = self.hinges[*hinge as usize].facets;
                both.map(|facet| self.piece_of[facet as usize])
            };
            let mut apart: Vec<u32> = (cuts.iter().map(beside))
                .filter(|[a, b]| a != b)
                .flatten()
                .collect();
            apart.sort_unstable();
            apart.dedup();
            let mut choose = |all: &[u32]| all[random.rand_range(0..all.len() as u64) as usize];
            // Cuts between pieces come first, all pieces alike, however few of the cuts are theirs.
            let from: Vec<u32> = match !apart.is_empty() && choose(&[0, 1, 1, 1]) == 1 {
                true => {
                    let piece = choose(&apart);
                    let own = cuts.iter().filter(|hinge| {
                        let [a, b] = beside(hinge);
                        a != b && (a == piece || b == piece)
                    });
                    own.copied().collect()
                }
                false => cuts,
            };
            let start = choose(&from);
            // The smaller of two pieces anew from the cut on, or what is around the cut.
            let [one, other] = beside(&start).map(|piece| &self.pieces[piece as usize].facets);
            let near = match one != other && choose(&[0, 1]) == 1 {
                true if one.len() < other.len() => one.clone(),
                true => other.clone(),
                false => self.within(start, choose(&[0, 1, 2, MAX_RUIN_RADIUS])),
            };
            self.work += self.hinges.len() + self.pieces.len();
            let saved = self.ruin(&near);
            let mut order: Vec<(f64, u32)> = (saved.hinges.iter())
                .map(|hinge| {
                    (
                        self.hinges[*hinge as usize].cost * (0.3 + random.rand_float()),
                        *hinge,
                    )
                })
                .collect();
            // What has to be joined comes first, and the cut about which all was taken apart.
            order
                .iter_mut()
                .filter(|(_, hinge)| *hinge == start || self.is_to_be_joined(*hinge as usize))
                .for_each(|(w, _)| *w = f64::INFINITY);
            order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            for (_, hinge) in order {
                self.join(hinge as usize);
            }
            let found = self.cost(count(self));
            let is_better = found.0 < best.0 || (found.0 == best.0 && found.1 <= best.1);
            match is_better {
                true => best = found,
                false => self.restore(saved),
            }
        }
        Ok(())
    }

    /// Facets within so many hinges of those on both sides of a hinge.
    fn within(&self, start: u32, radius: u32) -> Vec<u32> {
        let mut near: Vec<u32> = self.hinges[start as usize].facets.to_vec();
        for _ in 0..radius {
            let hinges = near.iter().flat_map(|facet| &self.around[*facet as usize]);
            let mut facets: Vec<u32> = hinges
                .flat_map(|hinge| self.hinges[*hinge as usize].facets)
                .collect();
            facets.append(&mut near);
            facets.sort_unstable();
            facets.dedup();
            near = facets;
        }
        near
    }

    /// Removes the joined hinges of some facets, and makes the pieces that they belong to anew without them.
    fn ruin(&mut self, near: &[u32]) -> Saved {
        let mut touched: Vec<u32> = near
            .iter()
            .map(|facet| self.piece_of[*facet as usize])
            .collect();
        touched.sort_unstable();
        touched.dedup();
        let facets: Vec<u32> = (touched.iter())
            .flat_map(|piece| &self.pieces[*piece as usize].facets)
            .copied()
            .collect();
        let is_touched = |facet: &u32| {
            touched
                .binary_search(&self.piece_of[*facet as usize])
                .is_ok()
        };
        let mut hinges: Vec<u32> = (facets.iter())
            .flat_map(|facet| &self.around[*facet as usize])
            .copied()
            .filter(|hinge| self.hinges[*hinge as usize].facets.iter().all(is_touched))
            .collect();
        hinges.sort_unstable();
        hinges.dedup();
        let saved = Saved {
            facets: (facets.iter())
                .map(|f| (*f, self.piece_of[*f as usize], self.motions[*f as usize]))
                .collect(),
            joined: hinges
                .iter()
                .map(|hinge| self.is_joined[*hinge as usize])
                .collect(),
            hinges,
        };
        for facet in near {
            for hinge in &self.around[*facet as usize] {
                self.is_joined[*hinge as usize] = false;
            }
        }
        // Of what is left of a piece the largest connected part stays where it is, and the others become pieces.
        let mut free: Vec<u32> = (0..self.pieces.len() as u32)
            .filter(|piece| self.pieces[*piece as usize].facets.is_empty())
            .collect();
        for piece in touched {
            let mut parts = self.connected(&self.pieces[piece as usize].facets);
            parts.sort_by_key(Vec::len);
            parts.pop();
            for part in parts {
                self.remove(&part);
                let number = free.pop().unwrap_or(part[0]);
                part.iter().for_each(|facet| self.insert(number, *facet));
            }
        }
        saved
    }

    /// Divides facets of a piece into those that joined hinges connect.
    fn connected(&self, facets: &[u32]) -> Vec<Vec<u32>> {
        let mut seen: FxHashSet<u32> = FxHashSet::default();
        let mut parts = Vec::new();
        for first in facets {
            if !seen.insert(*first) {
                continue;
            }
            let (mut part, mut next) = (vec![*first], 0);
            while let Some(facet) = part.get(next).copied() {
                next += 1;
                for hinge in &self.around[facet as usize] {
                    if self.is_joined[*hinge as usize] {
                        let both = self.hinges[*hinge as usize].facets;
                        part.extend(both.into_iter().filter(|facet| seen.insert(*facet)));
                    }
                }
            }
            parts.push(part);
        }
        parts
    }

    fn restore(&mut self, saved: Saved) {
        let moved: Vec<_> = (saved.facets.into_iter())
            .filter(|(facet, piece, motion)| {
                let facet = *facet as usize;
                self.piece_of[facet] != *piece || self.motions[facet] != *motion
            })
            .collect();
        self.remove(&moved.iter().map(|(facet, ..)| *facet).collect::<Vec<_>>());
        for (facet, piece, motion) in moved {
            self.motions[facet as usize] = motion;
            self.insert(piece, facet);
        }
        for (hinge, joined) in saved.hinges.iter().zip(saved.joined) {
            self.is_joined[*hinge as usize] = joined;
        }
    }
}

/// The part of a net that was taken apart, as it was before.
struct Saved {
    facets: Vec<(u32, u32, Motion)>,
    hinges: Vec<u32>,
    joined: Vec<bool>,
}
