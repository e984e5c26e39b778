//! Surface of a page in space, by the plainest model that explains its edges and lines in a photo.

use super::curled_page::CurledPage;
use super::edges::{Edges, Trace};
use super::options::PageOptions;
use super::page_warp::PageWarp;
use super::report::{PageModel, PageReport, PageVerdict};
use super::sheet::SheetPage;
use super::working_photo::WorkingPhoto;
use crate::dewarp::Photo;
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
    /// Finds the page whose edges are traced in a photo, at a resolution that does not depend on the photo's: photos of up to
    /// 3072 pixels a side are taken as they are, larger ones are halved for the search. Results are in the photo's own pixels.
    ///
    /// A cylinder is tried first, by [`CurledPage::in_photo`]. If it does not explain the page, and all four edges of one page
    /// are given, [`SheetPage::in_photo`] finds a sheet, which is taken unless it explains the page worse. A bent cylinder that no line confirms gives way to a plane, if that
    /// search finds one.
    ///
    /// # Errors
    /// Those of [`CurledPage::in_photo`] and [`SheetPage::in_photo`].
    pub fn in_photo(
        edges: &[Edges],
        given: &[Vec<Trace>],
        photo: &Photo<'_>,
        options: &PageOptions,
    ) -> Result<Self> {
        let working = WorkingPhoto::new(photo);
        let scale = working.scale;
        let edges: Vec<Edges> = edges
            .iter()
            .map(|edges| scale.working_edges(edges))
            .collect();
        let given: Vec<Vec<Trace>> = (given.iter())
            .map(|lines| lines.iter().map(|line| scale.working_trace(line)).collect())
            .collect();
        let [width, height] = working.size();
        let photo = Photo::new(width, height, working.rgba())?;
        let found = Self::solved(&edges, &given, &photo, &scale.working_options(options))?;
        Ok(match found {
            PageSurface::Curled(page) => PageSurface::Curled(page.in_full_photo(scale)),
            PageSurface::Sheet(page) => PageSurface::Sheet(page.in_full_photo(scale)),
        })
    }

    /// Finds the page in a working photo.
    fn solved(
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
                let sheet = sheet_in_photo(edges, photo, options)?;
                sheet
                    .filter(|sheet| explains_as_well(sheet.report().verdict, page.report().verdict))
            }
            // Errors of a flat page's outline look like a bend.
            (Ok(page), [edges @ Edges::All { .. }]) if has_unconfirmed_bend(page.report()) => {
                let sheet = sheet_in_photo(edges, photo, options)?;
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

    /// Computes the page's warp map, which holds for photos of any resolution of the picture.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn warp(&self) -> Result<PageWarp> {
        match self {
            PageSurface::Curled(page) => page.warp(),
            PageSurface::Sheet(page) => page.warp(),
        }
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

/// Finds a sheet for a page that a cylinder explains in some way; None if these edges are no sheet's.
///
/// # Errors
/// Those of [`SheetPage::in_photo`] that are not about the edges or the camera.
fn sheet_in_photo(
    edges: &Edges,
    photo: &Photo<'_>,
    options: &PageOptions,
) -> Result<Option<SheetPage>> {
    match SheetPage::in_photo(edges, photo, options) {
        Ok(sheet) => Ok(Some(sheet)),
        Err(Error::Edges { .. } | Error::FocalLength) => Ok(None),
        Err(error) => Err(error),
    }
}

/// Whether a sheet with the verdict `sheet` explains a page at least as well as an untrusted cylinder with the verdict
/// `cylinder`: a sheet that is none does not replace a doubtful cylinder.
fn explains_as_well(sheet: PageVerdict, cylinder: PageVerdict) -> bool {
    sheet != PageVerdict::NotThisKind || cylinder == PageVerdict::NotThisKind
}

/// Whether a verdict says that a cylinder does not explain the page, or hardly does.
fn is_untrusted(verdict: PageVerdict) -> bool {
    matches!(verdict, PageVerdict::NotThisKind | PageVerdict::Doubtful)
}

/// Whether a cylinder is bent by its edges alone, without lines of print or traced ones.
fn has_unconfirmed_bend(report: &PageReport) -> bool {
    report.bend > 0.0 && report.lines == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_doubtful_cylinder_stays_where_there_is_no_sheet() {
        use PageVerdict::{Doubtful, NotThisKind, Unrolled};
        assert!(!explains_as_well(NotThisKind, Doubtful));
        assert!(explains_as_well(Doubtful, Doubtful));
        assert!(explains_as_well(Unrolled, Doubtful));
        assert!(explains_as_well(NotThisKind, NotThisKind));
    }
}
