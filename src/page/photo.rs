//! A page whose photo is there, so that its lines of text can be found in it.

use super::edges::{Edges, Trace};
use super::find::CurledPage;
use super::options::PageOptions;
use super::report::PageVerdict;
use super::text;
use crate::dewarp::Photo;
use crate::error::Result;

/// How far lines that were found may be off, over the accuracy of traced points: print is, at a quarter of that.
const SURE: f64 = 1.0;

impl CurledPage {
    /// The page whose edges are traced in a photo, by its lines of text, too, which are looked for in it: below the
    /// letters of print, on the page that the edges show. `given` are lines that were traced besides, as in
    /// [`CurledPage::with_lines`].
    ///
    /// Lines that agree with the edges make the page more exact. Lines that do not are left out of it, and the
    /// verdict says so: the page is folded, crumpled or bent both ways. Handwriting, pictures and blank pages have
    /// none. What was found is in [`CurledPage::text`], how many in [`PageReport::lines_found`](super::PageReport).
    ///
    /// Costs besides `O(pixels of the page)`, at most some four million, and as much again as the page by itself
    /// some ten times.
    ///
    /// # Errors
    /// Those of [`CurledPage::with_lines`].
    pub fn in_photo(
        edges: &[Edges],
        given: &[Vec<Trace>],
        photo: &Photo<'_>,
        options: &PageOptions,
    ) -> Result<Self> {
        let size = [photo.width(), photo.height()];
        let by_edges = Self::with_lines(edges, given, size, options)?;
        let found = text::find(&by_edges, photo);
        let count = found.iter().map(Vec::len).sum();
        if count == 0 {
            return Ok(by_edges);
        }
        let by_itself = *by_edges.report();
        let both = Self::solved(edges, [given, &found], size, options);
        let mut page = match &both {
            Ok(page)
                if page.report.verdict != PageVerdict::NotThisKind && page.found_off < SURE =>
            {
                page.clone()
            }
            _ => by_edges,
        };
        let report = &mut page.report;
        report.lines_found = count;
        // The edges' own errors show against lines that are more exact, and the page is the better for it.
        let calm = report.verdict == PageVerdict::Doubtful && report.lines_disagreement == 0.0;
        if calm && report.error <= by_itself.error {
            report.verdict = by_itself.verdict;
        }
        let doubtful = |verdict: &mut PageVerdict| {
            if *verdict != PageVerdict::NotThisKind {
                *verdict = PageVerdict::Doubtful;
            }
        };
        match both {
            // Neighbouring lines have in common what they are off.
            Ok(both) if both.report.verdict == PageVerdict::NotThisKind => {
                report.verdict = PageVerdict::NotThisKind;
                report.residual = report.residual.max(both.report.residual);
                report.disagreement = report.disagreement.max(both.report.disagreement);
                report.lines_disagreement = both.report.lines_disagreement;
            }
            Ok(both) if both.found_off < SURE => {}
            _ => doubtful(&mut report.verdict),
        }
        page.found = found;
        Ok(page)
    }

    /// Lines of text that [`CurledPage::in_photo`] has found, for each page in the order of the edges from left to
    /// right or from top to bottom, as points in the photo's pixels below the letters.
    pub fn text(&self) -> &[Vec<Trace>] {
        &self.found
    }
}
