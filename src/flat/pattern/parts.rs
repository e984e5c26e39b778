//! The patches of a surface, each laid flat, cut into parts until none is strained too much.

use std::collections::BTreeMap;

use super::PatternOptions;
use super::labels::Labels;
use super::leaf::{Leaf, Window};
use crate::error::{Error, Result};
use crate::heights::heightfield::Heightfield;
use crate::shape::patches::Patches;

/// So many parts are no pattern to be built.
const MOST: usize = 1500;

pub(super) struct Parts<'a> {
    pub surface: &'a Heightfield,
    pub labels: Labels,
    pub leaves: Vec<Option<Leaf>>,
    pub options: PatternOptions,
    /// Those that were not looked at yet.
    pending: Vec<u32>,
}

impl<'a> Parts<'a> {
    pub(super) fn new(
        surface: &'a Heightfield,
        patches: &Patches,
        options: &PatternOptions,
    ) -> Result<Self> {
        let count = patches.patches().len();
        let mut parts = Parts {
            surface,
            labels: Labels::new(patches.labels(), count),
            leaves: (0..count).map(|_| None).collect(),
            options: *options,
            pending: Vec::new(),
        };
        parts.lay_flat(&(0..count as u32).collect::<Vec<_>>())?;
        Ok(parts)
    }

    /// The same with other numbers: `order` has for each what it was before.
    pub(super) fn renumbered(mut self, labels: &[u32], order: &[usize]) -> Self {
        let origins = order.iter().map(|old| self.labels.origins[*old]).collect();
        self.labels = Labels {
            of: labels.to_vec(),
            origins,
        };
        self.leaves = order.iter().map(|old| self.leaves[*old].take()).collect();
        self
    }

    fn lay_flat(&mut self, parts: &[u32]) -> Result<()> {
        let count = self.labels.origins.len();
        self.leaves.resize_with(count, || None);
        let windows = Window::around(self.surface.lattice(), &self.labels.of, count);
        for part in parts {
            let leaf = Leaf::new(
                self.surface,
                &self.labels,
                *part,
                windows[*part as usize],
                &self.options.unrolling,
                self.options.max_strain,
            )?;
            self.leaves[*part as usize] = leaf;
        }
        self.pending.extend(parts);
        Ok(())
    }

    /// Cuts what is strained by more than the limit, or upside down.
    pub(super) fn cut_strained(&mut self) -> Result<()> {
        while let Some(part) = self.pending.pop() {
            let Some(leaf) = self.leaves[part as usize].as_ref() else {
                continue;
            };
            let strain = leaf.strain();
            // What is too small to be cut may still do as a part of a sheet.
            if strain.rms() > self.options.max_strain || strain.flipped > 0 {
                self.cut(part)?;
            }
        }
        Ok(())
    }

    /// Cuts one part in two or more, unless it is too small; whether it was cut.
    pub(super) fn cut(&mut self, part: u32) -> Result<bool> {
        let Some(leaf) = self.leaves[part as usize].take() else {
            return Ok(false);
        };
        let cut = self.labels.cut(self.surface, part, &leaf)?;
        let Some(parts) = cut else {
            self.leaves[part as usize] = Some(leaf);
            return Ok(false);
        };
        if self.labels.origins.len() > MOST {
            let reason = format!("the surface would have to be cut into more than {MOST} parts");
            return Err(self.refused(part, reason));
        }
        self.lay_flat(&parts)?;
        Ok(true)
    }

    /// Gives away what is strained too much and too small to be cut.
    pub(super) fn give_away_crumbs(&mut self) -> Result<()> {
        let limit = self.options.max_strain;
        for part in (0..self.leaves.len() as u32).rev() {
            let leaf = self.leaves[part as usize].as_ref();
            let crumb = leaf.is_some_and(|leaf| leaf.is_crumb() && leaf.strain().rms() > limit);
            if crumb {
                self.give_away(part)?;
            }
        }
        Ok(())
    }

    /// Gives a part to that beside it which was of the same patch and has the longest border with it;
    /// whether there is one. Numbers of parts may change.
    pub(super) fn give_away(&mut self, part: u32) -> Result<bool> {
        let lattice = *self.surface.lattice();
        let mut borders: BTreeMap<u32, usize> = BTreeMap::new();
        let own = (0..self.labels.of.len()).filter(|i| self.labels.of[*i] == part);
        let own: Vec<usize> = own.collect();
        for i in &own {
            let around = lattice.neighbours(i / lattice.cols(), i % lattice.cols());
            for (row, col) in around.into_iter().flatten() {
                let other = self.labels.of[lattice.index(row, col)];
                if other != part && self.labels.are_one(other, part) {
                    *borders.entry(other).or_default() += 1;
                }
            }
        }
        let longest = borders.into_iter().max_by_key(|(_, count)| *count);
        let Some((mut other, _)) = longest else {
            return Ok(false);
        };
        for i in own {
            self.labels.of[i] = other;
        }
        // The last part takes the number that is free.
        let last = self.labels.origins.len() as u32 - 1;
        for label in self.labels.of.iter_mut().filter(|label| **label == last) {
            *label = part;
        }
        self.labels.origins.swap_remove(part as usize);
        self.leaves.swap_remove(part as usize);
        if other == last {
            other = part;
        }
        // How it is strained now is for the sheet to say.
        self.lay_flat(&[other])?;
        self.pending.clear();
        Ok(true)
    }

    pub(super) fn refused(&self, part: u32, reason: String) -> Error {
        let cols = self.surface.lattice().cols();
        let own = (0..self.labels.of.len()).filter(|i| self.labels.of[*i] == part);
        let members: Vec<usize> = own.collect();
        let middle = members.get(members.len() / 2).copied().unwrap_or(0);
        Error::NotFlat {
            row: middle / cols,
            col: middle % cols,
            vertices: members.len(),
            reason,
        }
    }
}
