//! Cuts closed again, as far as every sheet stays what it has to be, and seams divided where only a part of them fits.

use super::divide::divided;
use super::join::{Joined, Limits, NEGLIGIBLE_GAP_LENGTHS, SheetPair, Sheets, Trial};
use crate::error::Result;
use crate::progress;
use crate::scene::half_edges::next_half_edge;
use crate::unroll::flat_triangle::Point;

/// Maximum strain of the triangles along a closed seam, as a multiple of the limit for the sheet.
/// `benches/patterns.md` has what others give.
const MAX_SEAM_STRAIN_FACTOR: f64 = 2.0;

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
        self.seams.divide(self.body, seam, at)
    }

    /// Closes cuts again where the sheets stay valid: those inside of patches before creases, the longest first.
    pub(super) fn close_cuts(&mut self) -> Result<()> {
        // Along one or two edges nothing says how two sheets lie.
        let is_open = |seam: &usize| !self.whole[*seam] && self.seams.all[*seam].sides.len() > 2;
        let mut pending: Vec<usize> = (0..self.seams.all.len()).filter(is_open).collect();
        pending.sort_by(|a, b| {
            let [a, b] = [a, b].map(|seam| &self.seams.all[*seam]);
            b.smooth.cmp(&a.smooth).then(b.length.total_cmp(&a.length))
        });
        let count = pending.len() as f64;
        for (tried, seam) in (1u32..).zip(pending) {
            if !self.whole[seam] {
                progress::part(f64::from(tried) / count, || self.close(seam))?;
            }
        }
        Ok(())
    }

    /// Tries to close one cut, that is to join its two sides.
    fn close(&mut self, seam: usize) -> Result<()> {
        let [a, b] = self.seams.all[seam]
            .parts
            .map(|part| self.of[part as usize]);
        if let Some(found) = self.closed(seam, [a, b])? {
            self.all[a.max(b)] = None;
            self.put(a.min(b), found);
        }
        Ok(())
    }

    fn closed(&self, seam: usize, numbers: [usize; 2]) -> Result<Option<Joined>> {
        let both = SheetPair::new(self, seam, numbers);
        let limit = self.limits.strain;
        // A crease is closed only if that adds no strain: one whose two sides fit only with strain cannot be folded.
        let strains = both.all().map(|sheet| sheet.laid.strain);
        let most = match self.seams.all[seam].smooth {
            true => limit,
            false => strains.fold(0.0, f64::max).min(limit),
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
