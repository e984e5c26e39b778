//! Flat pages: the surface in space of a page, or of the two pages of a spread, that one photo shows.

use super::edges::{Edges, Trace};
use super::known_sizes::sides;
use super::options::{Format, PageOptions, Ruler};
use super::page_warp::PageWarp;
use super::read_traces::{page_that_fills, read_traces};
use super::report::PageReport;
use super::sheet::{SheetPage, node_shares};
use super::traced_line::BentEdges;
use crate::dewarp::{DewarpOptions, Photo, WarpMap};
use crate::error::{Error, Readable, Result, positive, try_filled};
use crate::math::lanes;
use crate::progress;
use crate::scene::mesh::Mesh;

/// The surface of a page in space, or of the two pages of a spread, each a nearly isometric sheet.
#[derive(Debug, Clone)]
pub struct PageSurface {
    /// One page, or the two of a spread from left to right, or from top to bottom.
    pages: Vec<SheetPage>,
    /// Shares of the flat page's side at which each page ends, from left to right, or from top to bottom.
    ends: Vec<f64>,
    /// Axis along which the pages lie beside each other: 0 from left to right, 1 from top to bottom.
    axis: usize,
    /// Width of each page, in the unit of lengths.
    widths: Vec<f64>,
    photo: [usize; 2],
    size: [f64; 2],
    millimetres: bool,
    text: Vec<Vec<Trace>>,
    report: PageReport,
}

impl PageSurface {
    /// Finds the page whose edges are traced in a photo of `photo` (width and height) pixels, with lines of text that are
    /// traced like edges but from their beginning to their end, for each page in the order of `edges`: they are level on the
    /// flat page. Two pages' edges are those of a spread, which share the gutter: the left page's edges end where the right
    /// page's begin.
    ///
    /// Where only two edges are given, the others are straight, and the page is curled in one direction.
    ///
    /// # Errors
    /// [`Error::Edges`] for edges that cannot belong to one page: with fewer than two points, with corners that make no
    /// convex quadrilateral, crossing, exchanged or outside of the photo; and for a line of text beside its page, by more than
    /// 5 % of the page's edge. [`Error::NotFinite`] for a coordinate that is no number (its row is the point),
    /// [`Error::Option`] for a number out of its range and lines of more pages than there are, [`Error::Empty`] for a photo
    /// without pixels, [`Error::TooLarge`] for an edge of more than 100,000 points or more than 500 lines.
    pub fn new(
        edges: &[Edges],
        text: &[Vec<Trace>],
        photo: [usize; 2],
        options: &PageOptions,
    ) -> Result<Self> {
        Self::solved(edges, text, photo, None, options)
    }

    /// Finds the page whose edges are traced in a photo as [`PageSurface::new`] does, and the lines of printed text on it. The
    /// resolution at which that is done does not depend on the photo's: photos of up to 3072 pixels a side are taken as they
    /// are, larger ones are halved. Results are in the photo's own pixels.
    ///
    /// # Errors
    /// Those of [`PageSurface::new`].
    pub fn in_photo(
        edges: &[Edges],
        text: &[Vec<Trace>],
        photo: &Photo<'_>,
        options: &PageOptions,
    ) -> Result<Self> {
        let size = [photo.width(), photo.height()];
        Self::solved(edges, text, size, Some(photo), options)
    }

    /// Finds the page that fills a photo, so that none of its edges is seen: its lines of print alone show how it is bent. The
    /// flat page is what the photo shows of it, in widths of that.
    ///
    /// # Errors
    /// [`Error::NoPage`] if there are too few lines of print; [`Error::Option`] for a number out of its range.
    pub fn by_print(photo: &Photo<'_>, options: &PageOptions) -> Result<Self> {
        let size = [photo.width(), photo.height()];
        let known = PageOptions {
            format: Format::Unknown,
            ..*options
        };
        let page = SheetPage::new(&page_that_fills(size), size, Some(photo), &known)?;
        if !page.has_print() {
            return Err(Error::NoPage);
        }
        Self::joined(vec![page], 0, size, &known)
    }

    fn solved(
        edges: &[Edges],
        text: &[Vec<Trace>],
        size: [usize; 2],
        photo: Option<&Photo<'_>>,
        options: &PageOptions,
    ) -> Result<Self> {
        if size.contains(&0) {
            return Err(Error::Empty { what: "photo" });
        }
        let traced = read_traces(edges, text, size)?;
        let pages: Result<Vec<SheetPage>> = (1u32..)
            .zip(&traced)
            .map(|(number, page)| {
                progress::part(f64::from(number) / traced.len() as f64, || {
                    SheetPage::new(page, size, photo, options)
                })
            })
            .collect();
        let axis = usize::from(traced[0].bent == Some(BentEdges::LeftRight));
        Self::joined(pages?, axis, size, options)
    }

    /// Puts the pages of a photo of `photo` (width and height) pixels beside each other along an axis, with equal sides where
    /// they meet, and measures them by what is known of their format, or by a ruler.
    fn joined(
        pages: Vec<SheetPage>,
        axis: usize,
        photo: [usize; 2],
        options: &PageOptions,
    ) -> Result<Self> {
        // Lengths of the pages along the axis, in units of the side where they meet.
        let lengths: Vec<f64> = (pages.iter())
            .map(|page| [1.0 / page.ratio(), page.ratio()][axis])
            .collect();
        let (count, total) = (pages.len() as f64, lengths.iter().sum::<f64>());
        let known = sides(options.format)?.and_then(|sides| sides.millimetres(pages[0].ratio()));
        let unit = match known {
            Some([width, height]) => (count * width * height / total).sqrt(),
            // The mean width is 1.
            None => [count / total, 1.0][axis],
        };
        let mut size = [unit; 2];
        size[axis] = unit * total;
        let mut end = 0.0;
        let ends = (lengths.iter())
            .map(|length| {
                end += length / total;
                end
            })
            .collect();
        let widths = (lengths.iter())
            .map(|length| unit * [*length, 1.0][axis])
            .collect();
        let report = (pages.iter())
            .map(|page| page.report)
            .reduce(PageReport::worse)
            .ok_or(Error::Empty { what: "page" })?;
        let points =
            |lines: &Vec<Vec<[f64; 2]>>| lines.iter().cloned().map(Trace::Points).collect();
        let mut surface = PageSurface {
            text: pages.iter().map(|page| points(&page.lines)).collect(),
            pages,
            ends,
            axis,
            widths,
            photo,
            size,
            millimetres: known.is_some(),
            report,
        };
        if let Some(ruler) = options.ruler.filter(|_| known.is_none()) {
            let scale = surface.ruler_scale(&ruler)?;
            surface.size = surface.size.map(|side| side * scale);
            surface.widths.iter_mut().for_each(|width| *width *= scale);
            surface.millimetres = true;
        }
        Ok(surface)
    }

    /// Millimetres in the unit of lengths, by a ruler on the page.
    fn ruler_scale(&self, ruler: &Ruler) -> Result<f64> {
        let length = positive("ruler.length", ruler.length)?;
        let end = |pixel| self.page_place(pixel);
        let (Some(from), Some(to)) = (end(ruler.from), end(ruler.to)) else {
            let ends = format!("from {} to {}", ruler.from.readable(), ruler.to.readable());
            let requirement = "must begin and end on the page";
            return Err(Error::option("ruler", ends, requirement));
        };
        let [width, height] = self.size;
        let found = ((from[0] - to[0]) * width).hypot((from[1] - to[1]) * height);
        Ok(length / positive("ruler", found)?)
    }

    /// Verdict on the page, with the measures of its fit; of a spread that of the worse page.
    pub fn report(&self) -> &PageReport {
        &self.report
    }

    /// Number of pages side by side: 1, or 2 for a spread.
    pub fn pages(&self) -> usize {
        self.pages.len()
    }

    /// Width and height of the flat page, or of both pages of a spread together, in millimetres if the format or a ruler is
    /// known, else in widths of a page.
    pub fn flat_size(&self) -> [f64; 2] {
        self.size
    }

    /// Whether lengths of the flat page are in millimetres; otherwise in widths of a page.
    pub fn is_millimetres(&self) -> bool {
        self.millimetres
    }

    /// Lines of text that were detected in the photo, a list for each page, as points in the photo's pixels.
    pub fn text(&self) -> &[Vec<Trace>] {
        &self.text
    }

    /// Place in the photo, in pixels, at shares of the flat page's width and height.
    pub fn photo_place(&self, mut share: [f64; 2]) -> [f64; 2] {
        let at = share[self.axis];
        let last = self.pages.len() - 1;
        let number = self.ends.iter().take(last).filter(|end| **end < at).count();
        let start = self.start(number);
        share[self.axis] = (at - start) / (self.ends[number] - start);
        self.pages[number].table().at(share)
    }

    /// Share of the flat page's side at which a page of a spread begins.
    fn start(&self, number: usize) -> f64 {
        number
            .checked_sub(1)
            .map_or(0.0, |before| self.ends[before])
    }

    /// Place on the flat page, in shares of its width and height, that the photo shows at a pixel; None beside the page.
    fn page_place(&self, pixel: [f64; 2]) -> Option<[f64; 2]> {
        let mut found = (self.pages.iter().enumerate())
            .filter_map(|(number, page)| Some((number, page.table().back_project(pixel)?)));
        let (number, mut share) = found.next()?;
        let start = self.start(number);
        share[self.axis] = start + share[self.axis] * (self.ends[number] - start);
        Some(share)
    }

    /// Computes the page's warp map, which holds for photos of any resolution of the picture.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn warp(&self) -> Result<PageWarp> {
        // The nodes of the pages' own tables, between which their places are bilinear.
        let mut nodes = self.pages[0].table().nodes();
        nodes[self.axis] = 1 + self.pages.len() * (nodes[self.axis] - 1);
        let mut places = try_filled("page", nodes[0] * nodes[1], [f32::NAN; 2])?;
        for (place, share) in places.iter_mut().zip(node_shares(nodes)) {
            let found = self.photo_place(share);
            *place = [0, 1].map(|k| lanes::single((found[k] + 0.5) / self.photo[k] as f64));
        }
        PageWarp::new(self.size, self.millimetres, nodes, places)
    }

    /// Computes the warp map of the flat page: for each pixel of the flat image its place in the photo. `dots` are
    /// pixels per unit of [`PageSurface::flat_size`], by default as many as give the flat image the number of pixels
    /// that the page covers in the photo; `trim` has no effect, because the page fills its image. The flat image is
    /// transparent where the page is outside of the photo.
    ///
    /// # Errors
    /// [`Error::Option`] for a resolution that is not positive and finite, [`Error::TooLarge`] for an
    /// image of more than [`MAX_CELLS`](crate::MAX_CELLS) pixels, [`Error::OutOfMemory`].
    pub fn warp_map(&self, options: &DewarpOptions) -> Result<WarpMap> {
        self.warp()?.warp_map(self.photo, options)
    }

    /// Makes a mesh of the page in space, with texture coordinates for the photo, row by row from the upper left corner of
    /// each page. The axes are those of [`Intrinsics::back_project`](crate::Intrinsics::back_project): x to the right, y up, z
    /// towards the viewer, the camera at the origin. So [`sample`](crate::sample) with
    /// [`View::BestFit`](crate::View::BestFit) makes it a [`Heightfield`](crate::Heightfield).
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn mesh(&self) -> Result<Mesh> {
        let (mut positions, mut uvs, mut triangles) = (Vec::new(), Vec::new(), Vec::new());
        for (page, width) in self.pages.iter().zip(&self.widths) {
            let first = positions.len();
            let (own, places, cols) = page.vertices(*width, self.photo);
            for row in 1..own.len() / cols {
                for col in 1..cols {
                    let last = (first + row * cols + col) as u32;
                    let [above, before] = [last - cols as u32, last - 1];
                    triangles.extend([[above - 1, before, last], [above - 1, last, above]]);
                }
            }
            positions.extend(own);
            uvs.extend(places);
        }
        Mesh::new(positions, triangles)?.with_uvs(uvs)
    }
}
