//! Search for a curled page by its traced edges and by lines of text that are detected in the photo.

use super::curled_page::CurledPage;
use super::edges::{Edges, Trace};
use super::options::PageOptions;
use super::report::{PageDoubt, PageVerdict};
use super::text;
use crate::dewarp::Photo;
use crate::error::Result;

/// Maximum root mean square residual of detected lines of text, in standard deviations of a traced point, at which they
/// are used. Lines of print have about a quarter of that.
const MAX_FOUND_RESIDUAL: f64 = 1.0;

impl CurledPage {
    /// Finds the page whose edges are traced in a photo, and the baselines of printed text on it, which check the page.
    /// `given` are lines that were traced besides, as in
    /// [`CurledPage::with_lines`].
    ///
    /// Lines that agree with the edges make the page more exact. Lines that do not are not used for the page, but
    /// change the verdict: the page is folded, crumpled or bent both ways. Handwriting, pictures and blank pages have
    /// no lines. [`CurledPage::text`] has the lines that were found, [`PageReport::lines_found`](super::PageReport)
    /// their number.
    ///
    /// Costs about ten times as much as [`CurledPage::new`], and `O(pixels of the page)`, of which there are at most
    /// about four million.
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
        Ok(by_edges.with_detected_lines(edges, given, photo, options))
    }

    /// Checks a page that was found by its edges, and by the lines `given`, by lines of text that are detected in the photo;
    /// fits it again if they agree.
    pub(super) fn with_detected_lines(
        self,
        edges: &[Edges],
        given: &[Vec<Trace>],
        photo: &Photo<'_>,
        options: &PageOptions,
    ) -> Self {
        let by_edges = self;
        let size = [photo.width(), photo.height()];
        let found = text::find_lines(&by_edges, photo);
        let count = found.iter().map(Vec::len).sum();
        if count == 0 {
            return by_edges;
        }
        let by_itself = *by_edges.report();
        let both = Self::solved(edges, [given, &found], size, options);
        let mut page = match &both {
            Ok(page)
                if page.report.verdict != PageVerdict::NotThisKind
                    && page.found_residual < MAX_FOUND_RESIDUAL =>
            {
                page.clone()
            }
            _ => by_edges,
        };
        let report = &mut page.report;
        report.lines_found = count;
        // Lines that are more exact than the edges show the errors of these, and make the page better.
        let calm = report.verdict == PageVerdict::Doubtful && report.lines_disagreement == 0.0;
        if calm && report.error <= by_itself.error {
            (report.verdict, report.doubt) = (by_itself.verdict, by_itself.doubt);
        }
        match both {
            // Neighbouring lines have their residuals in common.
            Ok(both) if both.report.verdict == PageVerdict::NotThisKind => {
                (report.verdict, report.doubt) = (PageVerdict::NotThisKind, None);
                report.residual = report.residual.max(both.report.residual);
                report.disagreement = report.disagreement.max(both.report.disagreement);
                report.lines_disagreement = both.report.lines_disagreement;
            }
            Ok(both) if both.found_residual < MAX_FOUND_RESIDUAL => {}
            _ if report.verdict == PageVerdict::NotThisKind => {}
            _ => {
                report.verdict = PageVerdict::Doubtful;
                report.doubt.get_or_insert(PageDoubt::Disagreement);
            }
        }
        page.found = found;
        page
    }

    /// Baselines of text that [`CurledPage::in_photo`] has found, a list for each page from left to right or from top
    /// to bottom, as points in the photo's pixels.
    pub fn text(&self) -> &[Vec<Trace>] {
        &self.found
    }
}
