//! Surface of a page in space, by the plainest model that explains its edges and lines in a photo.

use std::ops::Range;

use super::curled_page::CurledPage;
use super::edges::{Edges, Trace};
use super::options::PageOptions;
use super::pixel_grid::PixelGrid;
use super::report::{PageModel, PageReport, PageVerdict};
use super::sheet::SheetPage;
use crate::dewarp::{DewarpOptions, Photo, WarpMap};
use crate::error::{Error, Result};
use crate::scene::mesh::Mesh;

/// The surface of a page in space: a cylinder or, for a page that is folded, crumpled or bent both ways, a sheet.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum PageSurface {
    /// A page that is curled in one direction (a cylinder), or the two pages of a spread.
    Curled(CurledPage),
    /// A page of any shape, as a nearly isometric sheet.
    Sheet(SheetPage),
}

impl PageSurface {
    /// Finds the page whose edges are traced in a photo. A cylinder is tried first, by [`CurledPage::in_photo`]. If it
    /// does not explain the page, and all four edges of one page are given, [`SheetPage::in_photo`] finds a sheet. A bent
    /// cylinder that no line confirms gives way to a plane, if that search finds one.
    ///
    /// # Errors
    /// Those of [`CurledPage::in_photo`] and [`SheetPage::in_photo`].
    pub fn in_photo(
        edges: &[Edges],
        given: &[Vec<Trace>],
        photo: &Photo<'_>,
        options: &PageOptions,
    ) -> Result<Self> {
        let size = [photo.width(), photo.height()];
        let curled = CurledPage::with_lines(edges, given, size, options).map(|page| {
            // Lines of text do not rescue a cylinder that does not explain the edges.
            let is_hopeless = page.report().verdict == PageVerdict::NotThisKind
                && matches!(edges, [Edges::All { .. }]);
            if is_hopeless {
                page
            } else {
                page.with_detected_lines(edges, given, photo, options)
            }
        });
        let sheet = match (&curled, edges) {
            (Ok(page), [edges @ Edges::All { .. }]) if is_untrusted(page.report().verdict) => {
                SheetPage::in_photo(edges, photo, options).ok()
            }
            // Errors of a flat page's outline look like a bend.
            (Ok(page), [edges @ Edges::All { .. }]) if has_unconfirmed_bend(page.report()) => {
                let sheet = SheetPage::in_photo(edges, photo, options).ok();
                sheet.filter(|sheet| sheet.report().model == PageModel::Plane)
            }
            (Err(Error::Edges { .. } | Error::FocalLength), [edges @ Edges::All { .. }]) => {
                Some(SheetPage::in_photo(edges, photo, options)?)
            }
            _ => None,
        };
        match sheet {
            Some(sheet) => Ok(PageSurface::Sheet(sheet)),
            None => curled.map(PageSurface::Curled),
        }
    }

    /// Verdict on the page, with the measures of its fit.
    pub fn report(&self) -> &PageReport {
        match self {
            PageSurface::Curled(page) => page.report(),
            PageSurface::Sheet(page) => page.report(),
        }
    }

    /// Width and height of the flat page, in millimetres if the format or a ruler is known, else in widths of a page.
    pub fn flat_size(&self) -> [f64; 2] {
        match self {
            PageSurface::Curled(page) => page.flat_size(),
            PageSurface::Sheet(page) => page.flat_size(),
        }
    }

    /// Whether lengths of the flat page are in millimetres; otherwise in widths of a page.
    pub fn is_millimetres(&self) -> bool {
        match self {
            PageSurface::Curled(page) => page.is_millimetres(),
            PageSurface::Sheet(page) => page.is_millimetres(),
        }
    }

    /// Lines of text that were detected in the photo, a list for each page, as points in the photo's pixels.
    pub fn text(&self) -> &[Vec<Trace>] {
        match self {
            PageSurface::Curled(page) => page.text(),
            PageSurface::Sheet(page) => page.text(),
        }
    }

    /// Computes the warp map of the flat page: for each pixel of the flat image its place in the photo.
    ///
    /// # Errors
    /// Those of [`CurledPage::warp_map`].
    pub fn warp_map(&self, options: &DewarpOptions) -> Result<WarpMap> {
        match self {
            PageSurface::Curled(page) => page.warp_map(options),
            PageSurface::Sheet(page) => page.warp_map(options),
        }
    }

    /// Makes the pixel grid of the flat image.
    ///
    /// # Errors
    /// Those of [`CurledPage::warp_map`].
    pub fn pixel_grid(&self, options: &DewarpOptions) -> Result<PixelGrid> {
        match self {
            PageSurface::Curled(page) => page.pixel_grid(options),
            PageSurface::Sheet(page) => page.pixel_grid(options),
        }
    }

    /// Resamples a photo to some rows of the flat image, as [`WarpMap::image_rows`] of the whole map does, with the map of
    /// these rows alone in memory.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    ///
    /// # Panics
    /// If `rgba` does not have four bytes for each pixel of these rows, or the image not as many rows.
    pub fn image_rows(
        &self,
        flat: &PixelGrid,
        photo: &Photo<'_>,
        rows: Range<usize>,
        rgba: &mut [u8],
    ) -> Result<()> {
        // How finely a pixel samples the photo depends on the next row's places.
        let band = rows.start.saturating_sub(1)..(rows.end + 1).min(flat.height);
        let within = rows.start - band.start..rows.end - band.start;
        let map = match self {
            PageSurface::Curled(page) => page.warp_rows(flat, band)?,
            PageSurface::Sheet(page) => page.warp_rows(flat, band)?,
        };
        map.image_rows(photo, within, rgba);
        Ok(())
    }

    /// Makes a mesh of the page in space, with texture coordinates for the photo.
    ///
    /// # Errors
    /// Those of [`CurledPage::mesh`].
    pub fn mesh(&self) -> Result<Mesh> {
        match self {
            PageSurface::Curled(page) => page.mesh(),
            PageSurface::Sheet(page) => page.mesh(),
        }
    }
}

/// Whether a verdict says that a cylinder does not explain the page, or hardly does.
fn is_untrusted(verdict: PageVerdict) -> bool {
    matches!(verdict, PageVerdict::NotThisKind | PageVerdict::Doubtful)
}

/// Whether a cylinder is bent by its edges alone, without lines of print or traced ones.
fn has_unconfirmed_bend(report: &PageReport) -> bool {
    report.bend > 0.0 && report.lines == 0
}
