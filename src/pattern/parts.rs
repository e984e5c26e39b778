//! The patches of a surface, each laid flat, cut into parts until none is strained too much.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::flat_patch::{FlatPatch, MIN_CUT_VERTICES};
use super::labels::Labels;
use super::options::PatternOptions;
use super::trim::{MAX_REMOVED_SHARE, PartFault, removable_vertices};
use super::window::Window;
use crate::error::{Error, Result};
use crate::heights::heightfield::Heightfield;
use crate::lattice::hexagonal::Lattice;
use crate::progress;
use crate::shape::patches::{NO_PATCH, Patches};

/// Maximum number of parts of a surface: a pattern of more parts cannot be assembled in practice.
const MAX_PARTS: usize = 1500;

/// Maximum share of the surface's vertices that may be left out of the pattern: with more it is no pattern of the surface.
pub(super) const MAX_OMITTED_SHARE: f64 = 0.1;

/// Maximum number of border vertices that are removed from a part that is invalid on the fine lattice alone, as a share
/// of its vertices. Most such parts are small and ragged: cut further, they would become sheets of a few vertices.
/// `benches/patterns.md` has what others give.
const MAX_RECUT_REMOVED_SHARE: f64 = 0.15;

/// Maximum number of vertices of the surface that are left out of the pattern in one step.
const MAX_OMITTED_VERTICES: usize = 4 * MIN_CUT_VERTICES;

/// Number of a part that another part was merged into, and the flat layout of both together.
type MergedPart = (u32, Option<FlatPatch>);

/// The parts that a surface is cut into; a part is a patch or a piece of it, which is laid flat by itself.
pub(super) struct Parts {
    /// The surface that is cut; vertices that were left out of the pattern have no height.
    pub surface: Heightfield,
    pub labels: Labels,
    pub flat_patches: Vec<Option<FlatPatch>>,
    pub options: PatternOptions,
    /// Size of the smallest detail of sheets' outlines, in lattice spacings; smaller loops of an outline are cut off.
    pub finest: f64,
    /// For each part the window of the lattice (rows and columns) that encloses it.
    windows: Vec<Window>,
    /// Numbers of the parts whose strain was not yet compared with the limit.
    pending: Vec<u32>,
    /// Number of vertices of the surface that were left out of the pattern so far; `most_left_out` is its maximum.
    left_out: usize,
    most_left_out: usize,
}

fn most_left_out(surface: &Heightfield) -> usize {
    let valid = surface.heights().iter().filter(|z| !z.is_nan()).count();
    (MAX_OMITTED_SHARE * valid as f64) as usize
}

impl Parts {
    pub(super) fn new(
        surface: &Heightfield,
        patches: &Patches,
        options: &PatternOptions,
    ) -> Result<Self> {
        let count = patches.patches().len();
        let labels = Labels::new(patches.labels(), count);
        let lattice = surface.lattice();
        let mut parts = Parts {
            windows: Window::whole(lattice).around(lattice, &labels.of, count),
            surface: surface.clone(),
            labels,
            flat_patches: (0..count).map(|_| None).collect(),
            options: *options,
            finest: 1.0,
            pending: Vec::new(),
            left_out: 0,
            most_left_out: most_left_out(surface),
        };
        parts.lay_flat(&(0..count as u32).collect::<Vec<_>>())?;
        Ok(parts)
    }

    /// Creates an empty set of parts, before [`Parts::with_labels`] divides the surface.
    pub(super) fn none(surface: &Heightfield, options: &PatternOptions) -> Parts {
        Parts {
            surface: surface.clone(),
            labels: Labels::new(&[], 0),
            flat_patches: Vec::new(),
            options: *options,
            finest: 1.0,
            windows: Vec::new(),
            pending: Vec::new(),
            left_out: 0,
            most_left_out: most_left_out(surface),
        }
    }

    /// Replaces the parts by those of given labels, and leaves out vertices without a label. No part is laid flat yet.
    pub(super) fn with_labels(mut self, surface: &Heightfield, labels: Labels) -> Result<Self> {
        let lattice = surface.lattice();
        let keep: Vec<u8> = labels
            .of
            .iter()
            .map(|label| u8::from(*label != NO_PATCH))
            .collect();
        let heights = surface.heights().iter().zip(&keep);
        self.left_out = heights
            .filter(|(z, keep)| !z.is_nan() && **keep == 0)
            .count();
        self.surface = surface.clone().masked(&keep)?;
        let count = labels.origins.len();
        self.windows = Window::whole(lattice).around(lattice, &labels.of, count);
        self.flat_patches = (0..count).map(|_| None).collect();
        self.labels = labels;
        Ok(self)
    }

    /// Renumbers the parts in the order of `patches`; `order` holds the old number of each part.
    pub(super) fn renumber(&mut self, patches: &Patches, order: &[usize]) {
        let origins = order.iter().map(|old| self.labels.origins[*old]).collect();
        self.labels = Labels {
            of: patches.labels().to_vec(),
            origins,
        };
        self.flat_patches = order
            .iter()
            .map(|old| self.flat_patches[*old].take())
            .collect();
        self.windows = order.iter().map(|old| self.windows[*old]).collect();
    }

    /// Returns the number of vertices of the surface that were left out of the pattern.
    pub(super) fn left_out(&self) -> usize {
        self.left_out
    }

    pub(super) fn window(&self, part: u32) -> Window {
        self.windows[part as usize]
    }

    /// Renumbers the parts by area, the largest first, and returns them with the patches that they form, a part being a
    /// patch there.
    pub(super) fn numbered(mut self, patches: &Patches) -> Result<(Self, Patches)> {
        if self.left_out == 0 && self.flat_patches.len() == patches.patches().len() {
            return Ok((self, patches.clone()));
        }
        let (divided, order) = patches.divided(&self.surface, self.labels.of.clone())?;
        self.renumber(&divided, &order);
        Ok((self, divided))
    }

    fn lay_flat(&mut self, parts: &[u32]) -> Result<()> {
        self.flat_patches
            .resize_with(self.labels.origins.len(), || None);
        for (number, part) in (1..).zip(parts) {
            let end = f64::from(number) / parts.len() as f64;
            let flat_patch = progress::part(end, || self.flat_patch(part))?;
            self.flat_patches[*part as usize] = flat_patch;
        }
        self.pending.extend(parts);
        Ok(())
    }

    /// Lays parts flat, and leaves out the few border vertices of a part that hold most of its strain.
    pub(super) fn lay_flat_trimmed(&mut self, parts: &[u32]) -> Result<()> {
        self.lay_flat(parts)?;
        while let Some(part) = self.pending.pop() {
            self.trim(part)?;
        }
        Ok(())
    }

    fn is_strained(&self, part: u32) -> bool {
        let flat_patch = self.flat_patches[part as usize].as_ref();
        flat_patch.is_some_and(|flat_patch| flat_patch.strain().rms() > self.options.max_strain)
    }

    pub(super) fn flat_patch(&self, part: &u32) -> Result<Option<FlatPatch>> {
        FlatPatch::new(
            &self.surface,
            &self.labels,
            *part,
            self.windows[*part as usize],
            self.options.relaxation(),
        )
    }

    fn members(&self, part: u32) -> Vec<usize> {
        let window = self.windows[part as usize];
        let all = window.vertices(self.surface.lattice());
        all.filter(|i| self.labels.of[*i] == part).collect()
    }

    /// Cuts each part whose strain is above the limit or that has flipped triangles, unless removing a few border
    /// vertices is enough.
    pub(super) fn cut_strained(&mut self) -> Result<()> {
        let mut done = 0.0;
        while let Some(part) = self.pending.pop() {
            let flat_patch = self.flat_patches[part as usize].as_ref();
            let flipped = flat_patch.is_some_and(|flat_patch| flat_patch.strain().flipped > 0);
            // A part that is too small to be cut is kept: it may still be valid within a sheet.
            let is_invalid = self.is_strained(part) || flipped;
            // A part that is cut leaves at least one more to do.
            done += 1.0;
            let end = done / (done + 1.0 + self.pending.len() as f64);
            progress::part(end, || match is_invalid && !self.trim(part)? {
                true => self.cut(part).map(drop),
                false => Ok(()),
            })?;
        }
        Ok(())
    }

    /// Cuts a part into two or more and lays these flat. Returns whether the part was large enough to be cut, and the
    /// number of parts below [`MAX_PARTS`].
    pub(super) fn cut(&mut self, part: u32) -> Result<bool> {
        if self.labels.origins.len() >= MAX_PARTS {
            return Ok(false);
        }
        let Some(flat_patch) = self.flat_patches[part as usize].take() else {
            return Ok(false);
        };
        let cut = self.labels.cut(&self.surface, part, &flat_patch)?;
        let Some(parts) = cut else {
            self.flat_patches[part as usize] = Some(flat_patch);
            return Ok(false);
        };
        let region = self.windows[part as usize];
        let count = self.labels.origins.len();
        let found = region.around(self.surface.lattice(), &self.labels.of, count);
        self.windows.resize(count, region);
        for part in &parts {
            self.windows[*part as usize] = found[*part as usize];
        }
        self.lay_flat(&parts)?;
        Ok(true)
    }

    /// Cuts a part into parts that lie flat, and leaves out those that do not and are too small to be cut. The neighbours
    /// keep their positions. Returns whether nothing of the part is invalid any more.
    pub(super) fn cut_alone(&mut self, part: u32) -> Result<bool> {
        let mut open = vec![part];
        let mut is_invalid = true;
        while let Some(part) = open.pop() {
            let flat_patch = self.flat_patches[part as usize].as_ref();
            let strain = flat_patch.map(FlatPatch::strain).unwrap_or_default();
            is_invalid |= strain.rms() > self.options.max_strain || strain.flipped > 0;
            if std::mem::take(&mut is_invalid) {
                let part_fault = match strain.rms() > self.options.max_strain {
                    true => PartFault::Strain(self.options.max_strain),
                    false => PartFault::Flipped,
                };
                let most = |count| self.max_removed(count, MAX_RECUT_REMOVED_SHARE);
                let removed = self.flat_patches[part as usize]
                    .as_ref()
                    .and_then(|flat_patch| {
                        let lattice = self.surface.lattice();
                        removable_vertices(
                            lattice,
                            &self.labels,
                            part,
                            flat_patch,
                            part_fault,
                            most,
                        )
                    });
                if let Some(removed) = removed {
                    self.leave_out_vertices(part, removed)?;
                } else if self.cut(part)? {
                    open.append(&mut self.pending);
                } else {
                    let own = self.members(part);
                    if own.len() > self.most_left_out.saturating_sub(self.left_out) {
                        return Ok(false);
                    }
                    self.leave_out_vertices(part, own)?;
                }
            }
        }
        Ok(true)
    }

    /// Merges each part that is too small to be cut and strained above the limit with a neighbour, or leaves it out of
    /// the pattern.
    pub(super) fn merge_strained_small_parts(&mut self) -> Result<()> {
        let limit = self.options.max_strain;
        for part in (0..self.flat_patches.len() as u32).rev() {
            let flat_patch = self.flat_patches[part as usize].as_ref();
            let is_small_and_strained = flat_patch.is_some_and(|flat_patch| {
                flat_patch.is_too_small_to_cut() && flat_patch.strain().rms() > limit
            });
            if is_small_and_strained && !self.merge_with_neighbour(part)? {
                self.leave_out(part)?;
            }
        }
        Ok(())
    }

    /// Merges a part with a neighbour if both together lie flat. A neighbour cut from the same patch comes first, then
    /// the one with the longest common border. Returns whether such a neighbour was found; numbers of parts may change.
    fn merge_with_neighbour(&mut self, part: u32) -> Result<bool> {
        let own = self.members(part);
        let mut beside: Vec<(u32, usize)> = self.borders(part, &own).into_iter().collect();
        beside.sort_by_key(|(other, count)| Reverse((self.labels.are_one(*other, part), *count)));
        for (other, _) in beside {
            if let Some((number, flat_patch)) = self.merged_with(other, part, &own)? {
                self.flat_patches[number as usize] = flat_patch;
                self.remove(part);
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Merges a part into another if both lie flat together; changes nothing otherwise.
    fn merged_with(&mut self, other: u32, part: u32, own: &[usize]) -> Result<Option<MergedPart>> {
        let before = self.windows[other as usize];
        self.windows[other as usize] = before.with(&self.windows[part as usize]);
        own.iter().for_each(|i| self.labels.of[*i] = other);
        let flat_patch = self.flat_patch(&other)?;
        let limit = self.options.max_strain;
        let flat = flat_patch.as_ref().is_none_or(|flat_patch| {
            let strain = flat_patch.strain();
            strain.rms() <= limit && strain.flipped == 0
        });
        if flat {
            return Ok(Some((other, flat_patch)));
        }
        own.iter().for_each(|i| self.labels.of[*i] = part);
        self.windows[other as usize] = before;
        Ok(None)
    }

    /// Leaves a part out of the pattern, unless more than the maximum number of vertices would be left out. Returns whether the part was left out; numbers of parts may change.
    pub(super) fn leave_out(&mut self, part: u32) -> Result<bool> {
        let own = self.members(part);
        if own.len() > self.most_left_out.saturating_sub(self.left_out) {
            return Ok(false);
        }
        let mut beside: Vec<u32> = self.borders(part, &own).into_keys().collect();
        self.without(own)?;
        let last = self.labels.origins.len() as u32 - 1;
        self.remove(part);
        beside
            .iter_mut()
            .filter(|other| **other == last)
            .for_each(|other| *other = part);
        // The borders of the neighbours have changed.
        self.lay_flat(&beside)?;
        Ok(true)
    }

    /// Leaves out of the pattern the few border vertices of a part that hold most of its strain or are corners of
    /// flipped triangles. Returns whether there were such vertices.
    fn trim(&mut self, part: u32) -> Result<bool> {
        let Some(flat_patch) = self.flat_patches[part as usize].as_ref() else {
            return Ok(false);
        };
        let part_fault = match self.is_strained(part) {
            true => PartFault::Strain(self.options.max_strain),
            false => PartFault::Flipped,
        };
        let lattice = self.surface.lattice();
        let most = |count| self.max_removed(count, MAX_REMOVED_SHARE);
        let own = removable_vertices(lattice, &self.labels, part, flat_patch, part_fault, most);
        let Some(own) = own else {
            return Ok(false);
        };
        let beside: Vec<u32> = self.borders(part, &own).into_keys().collect();
        self.without(own)?;
        self.lay_flat(&[&[part], &beside[..]].concat())?;
        Ok(true)
    }

    /// Finds the few border vertices of a part whose removal would make the sheet valid; `None` if there are none or
    /// the limits of what may be left out are reached.
    pub(super) fn removable_vertices(
        &self,
        part: u32,
        flat_patch: &FlatPatch,
        part_fault: PartFault,
    ) -> Option<Vec<usize>> {
        let lattice = self.surface.lattice();
        let most = |count| self.max_removed(count, MAX_REMOVED_SHARE);
        removable_vertices(lattice, &self.labels, part, flat_patch, part_fault, most)
    }

    /// Leaves out of the pattern some vertices of a part; the other vertices of the part and of its neighbours keep
    /// their flat positions.
    pub(super) fn leave_out_vertices(&mut self, part: u32, removed: Vec<usize>) -> Result<()> {
        let mut changed: Vec<u32> = self.borders(part, &removed).into_keys().collect();
        changed.push(part);
        self.without(removed)?;
        for part in changed {
            let Some(before) = self.flat_patches[part as usize].take() else {
                continue;
            };
            let place = |vertex| Some(before.place(vertex)).filter(|place| !place.re.is_nan());
            let flat_patch =
                FlatPatch::at(&self.surface, &self.labels, part, self.window(part), place)?;
            self.flat_patches[part as usize] = flat_patch;
        }
        Ok(())
    }

    /// Computes the maximum number of vertices that may be left out of the pattern in the next step.
    fn max_omitted_now(&self) -> usize {
        MAX_OMITTED_VERTICES.min(self.most_left_out.saturating_sub(self.left_out))
    }

    /// Maximum number of border vertices that may be left out of a part of `count` vertices in the next step.
    fn max_removed(&self, count: usize, share: f64) -> usize {
        self.max_omitted_now().min((share * count as f64) as usize)
    }

    fn without(&mut self, vertices: Vec<usize>) -> Result<()> {
        self.left_out += vertices.len();
        let mut keep = vec![1u8; self.surface.lattice().len()];
        for i in vertices {
            keep[i] = 0;
            self.labels.of[i] = NO_PATCH;
        }
        let nothing = Heightfield::new(Lattice::new(1, 1, 1.0)?, vec![0.0])?;
        self.surface = std::mem::replace(&mut self.surface, nothing).masked(&keep)?;
        Ok(())
    }

    /// Counts the lattice edges between a part and each of its neighbours.
    fn borders(&self, part: u32, own: &[usize]) -> BTreeMap<u32, usize> {
        let lattice = self.surface.lattice();
        let mut borders: BTreeMap<u32, usize> = BTreeMap::new();
        for i in own {
            let around = lattice.neighbours(i / lattice.cols(), i % lattice.cols());
            for (row, col) in around.into_iter().flatten() {
                let other = self.labels.of[lattice.index(row, col)];
                if other != part && other != NO_PATCH {
                    *borders.entry(other).or_default() += 1;
                }
            }
        }
        borders
    }

    /// Removes a part that has no vertices from the list of parts; the last part takes its number.
    fn remove(&mut self, part: u32) {
        let last = self.labels.origins.len() as u32 - 1;
        if last != part {
            for i in self.members(last) {
                self.labels.of[i] = part;
            }
        }
        self.labels.origins.swap_remove(part as usize);
        self.flat_patches.swap_remove(part as usize);
        self.windows.swap_remove(part as usize);
        self.pending.clear();
    }

    pub(super) fn refused(&self, part: u32, reason: String) -> Error {
        let cols = self.surface.lattice().cols();
        let members = self.members(part);
        let middle = members.get(members.len() / 2).copied().unwrap_or(0);
        Error::NotFlat {
            place: format!("row {}, column {}", middle / cols, middle % cols),
            vertices: members.len(),
            reason: format!(
                "{reason}, and with it more than a tenth of the surface would be left out"
            ),
        }
    }
}
