//! Cuts closed again, as far as every sheet stays what it has to be, and seams divided where only a part of them fits.

use super::divide::divided;
use super::join::{Joined, Limits, NEGLIGIBLE_GAP_LENGTHS, SheetPair, Sheets, Trial};
use crate::error::Result;
use crate::progress;
use crate::scene::half_edges::next_half_edge;
use crate::unroll::flat_triangle::Point;

/// Maximum strain of a sheet after a crease was closed, as a share of the limit, unless the sheets on either side
/// of the crease had more strain before. `benches/patterns.md` has what others give.
const CREASE_STRAIN_SHARE: f64 = 0.1;

/// Maximum strain of the triangles along a closed seam, as a multiple of the limit for the sheet.
/// `benches/patterns.md` has what others give.
const MAX_SEAM_STRAIN_FACTOR: f64 = 2.0;

/// Minimum number of nodes of each half of a seam that is divided because it cannot be closed as a whole.
/// `benches/patterns.md` has what others give.
const MIN_HALVED_SEAM_NODES: usize = 12;

/// Maximum squared gap of a cut, as a multiple of the area times the squared strain that its sheet may have, at which it
/// is tried to close the cut: where two sides are pulled together by a distance, a strip about as wide is strained. Of the
/// cuts closed on the scans of `benches/patterns.md` the largest ratio was 0.96.
const MAX_CLOSED_GAP_RATIO: f64 = 2.0;

/// Maximum depth, in edge lengths of the mesh, by which two sheets may reach into each other where the cut between them is tried to
/// be closed: laying them flat together moves their outlines by less. Of the cuts closed on the scans of
/// `benches/patterns.md` the largest depth was 1.44.
const MAX_CLOSED_OVERLAP_LENGTHS: f64 = 2.0;

impl Sheets<'_> {
    /// Divides each seam whose sides do not fit as a whole, around the longest part of it whose sides do.
    pub(super) fn divide_by_fit(&mut self) {
        for number in 0..self.seams.all.len() {
            let sides = &self.seams.all[number].sides;
            let at = |corner: u32| self.at[corner as usize];
            let line = |first: u32, rest: &mut dyn Iterator<Item = u32>| -> Vec<Point> {
                std::iter::once(first).chain(rest).map(at).collect()
            };
            let [side, twin] = sides[0];
            let lines = [
                line(
                    side,
                    &mut sides.iter().map(|[side, _]| next_half_edge(*side)),
                ),
                line(
                    next_half_edge(twin),
                    &mut sides.iter().map(|[_, twin]| *twin),
                ),
            ];
            let fine = NEGLIGIBLE_GAP_LENGTHS * self.body.spacing;
            let ends = divided(&lines, self.limits.gap, fine);
            for at in ends[1..ends.len() - 1].iter().rev() {
                self.divide(number, *at);
            }
        }
    }

    /// Divides a seam in two before one of its edges. Returns the number of the second one.
    fn divide(&mut self, seam: usize, at: usize) -> usize {
        self.whole.push(self.whole[seam]);
        self.doubtful.push(self.doubtful[seam]);
        self.seams.divide(self.body, seam, at)
    }

    /// Closes cuts again where the sheets stay valid: those inside of patches before creases, the longest first. A cut that
    /// cannot be closed as a whole is halved, and each half is tried.
    pub(super) fn close_cuts(&mut self) -> Result<()> {
        // Along one or two edges nothing says how two sheets lie.
        let is_open = |seam: &usize| !self.whole[*seam] && self.seams.all[*seam].sides.len() > 2;
        let mut pending: Vec<usize> = (0..self.seams.all.len()).filter(is_open).collect();
        let mut tried = 0.0;
        loop {
            // The last one is the next.
            pending.sort_by(|a, b| {
                let [a, b] = [a, b].map(|seam| &self.seams.all[*seam]);
                a.smooth.cmp(&b.smooth).then(a.length.total_cmp(&b.length))
            });
            let Some(seam) = pending.pop() else {
                return Ok(());
            };
            tried += 1.0;
            let end = tried / (tried + pending.len() as f64);
            if self.whole[seam] || progress::part(end, || self.close(seam))? {
                continue;
            }
            let edges = self.seams.all[seam].sides.len();
            if edges >= 2 * MIN_HALVED_SEAM_NODES && self.seams.all[seam].smooth {
                pending.extend([seam, self.divide(seam, edges / 2)]);
            }
        }
    }

    /// Tries to close one cut, that is to join its two sides. Returns whether the sheet is valid then.
    fn close(&mut self, seam: usize) -> Result<bool> {
        let [a, b] = self.seams.all[seam]
            .parts
            .map(|part| self.of[part as usize]);
        let Some(found) = self.closed(seam, [a, b])? else {
            return Ok(false);
        };
        self.all[a.max(b)] = None;
        self.put(a.min(b), found);
        Ok(true)
    }

    fn closed(&self, seam: usize, numbers: [usize; 2]) -> Result<Option<Joined>> {
        let both = SheetPair::new(self, seam, numbers);
        let limit = self.limits.strain;
        // A crease is closed only if that adds hardly any strain: one whose two sides fit only with strain cannot be folded.
        let strains = both.all().map(|sheet| sheet.laid.strain);
        let most = match self.seams.all[seam].smooth {
            true => limit,
            false => strains
                .fold(CREASE_STRAIN_SHARE * limit, f64::max)
                .min(limit),
        };
        let left = |sheet: &Joined| sheet.laid.area * most.powi(2) - sheet.laid.energy();
        let energy_left: f64 = both.all().map(left).sum();
        let apart = both.gap(seam);
        if apart.powi(2) > MAX_CLOSED_GAP_RATIO * energy_left
            || both.reach_into_each_other(MAX_CLOSED_OVERLAP_LENGTHS * self.body.spacing)
        {
            return Ok(None);
        }
        // Also the other seams whose sides coincide then.
        let others = (0..self.seams.all.len()).filter(|other| *other != seam && both.has(*other));
        let gaps = others.map(|other| (other, both.gap(other)));
        let closed = gaps.filter(|(_, gap)| *gap <= NEGLIGIBLE_GAP_LENGTHS * self.body.spacing);
        let along: Vec<(usize, f64)> = std::iter::once((seam, apart)).chain(closed).collect();
        let limits = Limits {
            strain: most,
            ..self.limits
        };
        let mut found = both.laid(&along, limits, Trial::Close)?;
        if found.is_none() && along.len() > 1 {
            found = both.laid(&along[..1], limits, Trial::Close)?;
        }
        // A large strain in a small place hardly changes the strain of the whole sheet.
        let beside = self.seams.all[seam]
            .sides
            .as_flattened()
            .iter()
            .map(|side| side / 3);
        let beside: Vec<u32> = beside.collect();
        Ok(found.filter(|found| {
            found.laid.strain_of(self.body, &beside) <= MAX_SEAM_STRAIN_FACTOR * limit
        }))
    }
}
