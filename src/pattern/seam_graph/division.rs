//! Seams divided where only a part of them can be joined, and put together again.

use super::{MIN_SEAM_PART_NODES, NEGLIGIBLE_GAP_LENGTHS, Seam, SeamGraph};
use crate::unroll::flat_triangle::Point;

impl SeamGraph {
    /// Divides each seam whose sides do not fit as a whole, around the longest part of it whose sides do. `gap` is the
    /// maximum seam gap, as a share of the length, as in [`PatternOptions`](crate::pattern::PatternOptions).
    pub(in crate::pattern) fn divide_by_fit(&mut self, gap: f64) {
        for number in 0..self.seams.len() {
            if self.is_torn(number) {
                continue;
            }
            let seam = &self.seams[number];
            let ends = divided(&seam.sides, gap, NEGLIGIBLE_GAP_LENGTHS * self.spacing);
            for at in ends[1..ends.len() - 1].iter().rev() {
                self.cut_off(number, *at);
            }
        }
        self.index();
    }

    /// Divides a seam in two at one of its inner nodes. Returns the number of the second part.
    pub(in crate::pattern) fn divide(&mut self, seam: usize, at: usize) -> usize {
        let number = self.cut_off(seam, at);
        self.index();
        number
    }

    /// Divides a seam where the kind of its nodes changes; `kinds` holds one of two kinds for each node. Returns the
    /// number of each part and the kind of its nodes. Parts of fewer than
    /// [`MIN_SEAM_PART_NODES`](super::MIN_SEAM_PART_NODES) nodes are merged with a neighbour.
    pub(in crate::pattern) fn divide_where(
        &mut self,
        seam: usize,
        kinds: &[bool],
    ) -> Vec<(usize, bool)> {
        let mut runs: Vec<(usize, bool)> = Vec::new();
        for kind in kinds {
            match runs.last_mut() {
                Some((count, last)) if last == kind => *count += 1,
                _ => runs.push((1, *kind)),
            }
        }
        // Merge each short run with the one before it, or after it if it is the first.
        while let Some(k) = runs
            .iter()
            .position(|(count, _)| *count < MIN_SEAM_PART_NODES)
        {
            if runs.len() == 1 {
                break;
            }
            let (count, _) = runs.remove(k);
            runs[k.saturating_sub(1)].0 += count;
            let mut merged: Vec<(usize, bool)> = Vec::new();
            for (count, kind) in runs {
                match merged.last_mut() {
                    Some((all, last)) if *last == kind => *all += count,
                    _ => merged.push((count, kind)),
                }
            }
            runs = merged;
        }
        let mut parts = Vec::new();
        let mut from = kinds.len();
        for (count, kind) in runs.iter().rev() {
            from -= count;
            let part = if from == 0 {
                seam
            } else {
                self.cut_off(seam, from)
            };
            parts.push((part, *kind));
        }
        self.index();
        parts
    }

    pub(super) fn cut_off(&mut self, seam: usize, at: usize) -> usize {
        let number = self.seams.len();
        let first = &mut self.seams[seam];
        let rest = Seam {
            from: first.from + at,
            nodes: first.nodes[at..].to_vec(),
            sides: [0, 1].map(|side| first.sides[side][at..].to_vec()),
            ..*first
        };
        first.nodes.truncate(at + 1);
        first
            .sides
            .iter_mut()
            .for_each(|side| side.truncate(at + 1));
        self.parts[rest.crease].push(number);
        self.seams.push(rest);
        number
    }

    /// Lists the numbers of the seams that a crease is divided into, from its beginning to its end.
    pub(in crate::pattern) fn parts(&self, crease: usize) -> Vec<usize> {
        let mut parts = self.parts[crease].clone();
        parts.sort_by_key(|seam| self.seams[*seam].from);
        parts
    }

    /// Merges neighbouring seams of a crease that are both folds or both open.
    pub(in crate::pattern) fn join_parts(&mut self, folded: &mut Vec<bool>) {
        let (mut seams, mut flags): (Vec<Seam>, Vec<bool>) = (Vec::new(), Vec::new());
        let mut old: Vec<Option<Seam>> = std::mem::take(&mut self.seams)
            .into_iter()
            .map(Some)
            .collect();
        for crease in 0..self.parts.len() {
            let mut parts = std::mem::take(&mut self.parts[crease]);
            parts.sort_by_key(|seam| old[*seam].as_ref().map_or(0, |seam| seam.from));
            for number in parts {
                let Some(seam) = old[number].take() else {
                    continue;
                };
                match seams.last_mut() {
                    Some(last)
                        if last.crease == crease && flags.last() == Some(&folded[number]) =>
                    {
                        last.nodes.extend(&seam.nodes[1..]);
                        for (side, more) in last.sides.iter_mut().zip(&seam.sides) {
                            side.extend(&more[1..]);
                        }
                    }
                    _ => {
                        self.parts[crease].push(seams.len());
                        seams.push(seam);
                        flags.push(folded[number]);
                    }
                }
            }
        }
        self.seams = seams;
        *folded = flags;
        self.index();
    }
}

/// Computes where to divide a seam, as node numbers along it, first and last included: around the longest part whose
/// sides fit.
pub(in crate::pattern) fn divided(sides: &[Vec<Point>; 2], gap: f64, fine: f64) -> Vec<usize> {
    let last = sides[0].len() - 1;
    let whole = vec![0, last];
    // Prefix sums of lengths and moments, so that the gap of any part takes constant time.
    let mut lengths = vec![0.0; last + 1];
    for i in 0..last {
        lengths[i + 1] = lengths[i] + (sides[0][i + 1] - sides[0][i]).norm();
    }
    let zero = (Point::default(), Point::default(), Point::default(), 0.0);
    let mut moments = vec![zero];
    for (p, q) in sides[0].iter().zip(&sides[1]) {
        let (a, b, c, d) = moments[moments.len() - 1];
        moments.push((
            a + p,
            b + q,
            c + p.conj() * q,
            d + p.norm_sqr() + q.norm_sqr(),
        ));
    }
    let fits = |from: usize, to: usize| {
        let ((a, b, c, d), (e, f, g, h)) = (moments[to + 1], moments[from]);
        let count = (to + 1 - from) as f64;
        let (p, q) = (a - e, b - f);
        let correlation = c - g - p.conj() * q / count;
        let squares = d - h - (p.norm_sqr() + q.norm_sqr()) / count;
        let apart = ((squares - 2.0 * correlation.norm()) / count)
            .max(0.0)
            .sqrt();
        apart <= (gap * (lengths[to] - lengths[from])).max(fine)
    };
    if last < 8 || fits(0, last) {
        return whole;
    }
    let mut best = (0.0, 0, 0);
    for from in (0..last).step_by(1 + last / 128) {
        // Longest part that fits from here: search with growing steps, then with shrinking ones.
        let (mut to, mut step) = (from + 2, 1);
        while to + step <= last && fits(from, to + step) {
            to += step;
            step *= 2;
        }
        while step > 0 {
            if to + step <= last && fits(from, to + step) {
                to += step;
            }
            step /= 2;
        }
        let is_long = to <= last && to - from >= MIN_SEAM_PART_NODES;
        if is_long && fits(from, to) && lengths[to] - lengths[from] > best.0 {
            best = (lengths[to] - lengths[from], from, to);
        }
    }
    let (_, mut from, mut to) = best;
    if to == 0 {
        return whole;
    }
    if from < MIN_SEAM_PART_NODES {
        from = 0;
    }
    if last - to < MIN_SEAM_PART_NODES {
        to = last;
    }
    let mut ends = vec![0, from, to, last];
    ends.dedup();
    ends
}
