//! One page of any shape in space, from its edges and lines of text in one photo.

use nalgebra::Vector3;

use super::grid::{SheetGrid, node_shares};
use super::place_table::PlaceTable;
use super::plane::CameraPrior;
use super::polyline::Polyline;
use super::search::{FoundSheet, PageTraces, find_sheet};
use super::view::PhotoView;
use crate::dewarp::Photo;
use crate::error::{Error, Result};
use crate::math::lanes;
use crate::page::known_sizes::{focal_length, principal_point, sides};
use crate::page::options::PageOptions;
use crate::page::report::{PageDoubt, PageModel, PageReport, PageVerdict};
use crate::page::traced_line::{EDGE_SEGMENTS, TracedPage};
use crate::scene::camera::has_camera_proportions;

/// A page of any shape in space: a nearly isometric sheet that bends little, fitted to the page's outline and lines of
/// print in one photo. Lengths are in widths of the page.
#[derive(Debug, Clone)]
pub(in crate::page) struct SheetPage {
    grid: SheetGrid,
    table: PlaceTable,
    /// Lines of print that were detected in the photo, in its pixels.
    pub lines: Vec<Vec<[f64; 2]>>,
    pub report: PageReport,
}

/// Assumed focal length where it is not known, as a multiple of the photo's longer side: that of a phone, with a photo
/// that is cropped slightly.
/// Its row: `benches/page.md`, Constants of the outline.
const USUAL_FOCAL_RATIO: f64 = 0.9;

/// Standard deviation of the logarithm of an unknown focal length. Chosen by `benches/page.md`, Models.
const UNKNOWN_FOCAL_DEVIATION: f64 = 0.2;

/// Assumed focal length of a photo whose proportions are no camera's, as a multiple of its longer side: that of a phone,
/// whose photo was cropped to about three fifths of its sides. Chosen by the table of pages in `benches/page.md`.
const CROPPED_FOCAL_RATIO: f64 = 1.3;

/// Standard deviation of the logarithm of a known focal length, because photos are edited.
const KNOWN_FOCAL_DEVIATION: f64 = 0.06;

/// Standard deviation of the principal point's coordinates, divided by the focal length: photos are cropped by hand.
/// Chosen by `benches/page.md`, Models.
const CENTRE_DEVIATION: f64 = 0.12;

/// Relative standard deviation of a page's height over width where the format is known.
const FORMAT_RATIO_DEVIATION: f64 = 0.002;

/// Root mean square distance of edges and lines of print from those of a page that is curled in one direction, in widths of
/// the page, above which it is folded or bent otherwise (verdict `NotThisKind`). Simulated pages that are traced 2 pixels of 12
/// megapixels off have up to 0.0017, and from 0.0024 on where they are folded by 14°.
const MAX_CYLINDER_MISFIT: f64 = 0.0021;

/// Maximum expected error of the flat page for a verdict other than `Doubtful`, and maximum root mean square distance of a sheet
/// from the outline for one other than `NotThisKind`, in % of the page's width.
/// Chosen by `benches/page.md`, Expected error.
const MAX_TRUSTED_ERROR: f64 = 1.5;

/// Minimum number of lines of print that check how a page is bent: outlines alone leave much open.
const MIN_CHECKING_LINES: usize = 8;

/// Expected displacement of the flat page, in % of its width, if the fit of the sheet has a cost of 1. Chosen by
/// `benches/page.md`, Expected error.
const ERROR_AT_UNIT_COST: f64 = 0.65;

/// Power of the cost of the sheet's fit with which the expected displacement grows. Chosen by `benches/page.md`, Expected
/// error.
const ERROR_COST_POWER: f64 = 0.38;

/// Ratio of the displacement that is not exceeded in 95 of 100 cases to the expected one. Chosen by `benches/page.md`, Expected
/// error.
const ERROR_BOUND_RATIO: f64 = 2.0;

impl SheetPage {
    /// Finds a page by its traced edges and lines of text in a photo of `size` (width and height) pixels, and by lines of
    /// print that are detected in `photo`, if that is given. The model is a plane where that explains all, else
    /// whichever explains edges and lines better of an isometric sheet (slightly strained if it is crumpled) and one that is curled
    /// in one direction.
    ///
    /// Camera and proportions are found, too, within what is usual and what `options` tell. Costs some hundred
    /// milliseconds.
    ///
    /// # Errors
    /// [`Error::Edges`] for edges that cannot belong to one page, [`Error::Option`].
    pub fn new(
        page: &TracedPage,
        size: [usize; 2],
        photo: Option<&Photo<'_>>,
        options: &PageOptions,
    ) -> Result<Self> {
        let [width, height] = size.map(|n| n as f64);
        let longer = width.max(height);
        let focal = focal_length(options.focal_length, [width, height])?;
        let is_cropped = focal.is_none() && !has_camera_proportions(size);
        let usual_ratio = if is_cropped {
            CROPPED_FOCAL_RATIO
        } else {
            USUAL_FOCAL_RATIO
        };
        let view = PhotoView {
            focal: focal.unwrap_or(usual_ratio * longer),
            centre: principal_point(options, [width, height])?,
        };
        let seen = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
            points.iter().map(|p| view.to_normalised(*p)).collect()
        };
        let traces = PageTraces {
            edges: (page.edges.each_ref())
                .map(|edge| Polyline::resampled(&seen(&edge.points), EDGE_SEGMENTS)),
            bent: page.bent,
            is_seen: page.is_seen,
            lines: page.text.iter().map(|line| seen(&line.points)).collect(),
        };
        // Nothing is known between corners alone.
        let has_inner_points = page.pair().iter().any(|edge| edge.points.len() > 2);
        let prior = CameraPrior {
            scale_deviation: focal.map_or(UNKNOWN_FOCAL_DEVIATION, |_| KNOWN_FOCAL_DEVIATION),
            centre_deviation: CENTRE_DEVIATION,
            log_ratio: None,
        };
        let priors = sides(options.format)?.map_or(vec![prior], |sides| {
            let known = |ratio: f64| CameraPrior {
                log_ratio: Some([ratio.ln(), FORMAT_RATIO_DEVIATION]),
                ..prior
            };
            sides.ratios().into_iter().map(known).collect()
        });
        let found = find_sheet(&traces, &priors, &view, photo).ok_or_else(|| {
            Error::edges(
                "no page was found whose edges these could be; check that the corners are at their ends",
            )
        })?;
        let pixels = |line: &Vec<[f64; 2]>| line.iter().map(|p| view.to_pixels(*p)).collect();
        let mut page = SheetPage {
            table: PlaceTable::new(&found.sheet.grid, &view)?,
            lines: found.lines.iter().map(pixels).collect(),
            report: report(&found, &view, [page.is_seen, has_inner_points]),
            grid: found.sheet.grid,
        };
        if page.report.verdict == PageVerdict::Unrolled && page.may_be_spread() {
            (page.report.verdict, page.report.doubt) =
                (PageVerdict::Doubtful, Some(PageDoubt::Spread));
        }
        Ok(page)
    }

    /// Whether the page may be both pages of an open book: it is wider than high, and no line of print crosses its middle.
    fn may_be_spread(&self) -> bool {
        let crosses = |line: &Vec<[f64; 2]>| {
            let ([first, ..], [.., last]) = (&line[..], &line[..]) else {
                return false;
            };
            let ends = [*first, *last].map(|end| self.table.back_project(end));
            matches!(ends, [Some([left, _]), Some([right, _])] if left < 0.5 && right > 0.5)
        };
        self.ratio() < 1.0 && !self.lines.is_empty() && !self.lines.iter().any(crosses)
    }

    /// Whether the page shows enough lines of print for these to check how it is bent.
    pub fn has_print(&self) -> bool {
        self.report.lines >= MIN_CHECKING_LINES
    }

    /// Ratio of the flat page's height to its width.
    pub fn ratio(&self) -> f64 {
        self.grid.ratio()
    }

    /// Places in the photo, in pixels, at the nodes of a grid over the flat page, bilinear in between.
    pub fn table(&self) -> &PlaceTable {
        &self.table
    }

    /// Vertices of the page in space, row by row from the upper left corner, with their texture coordinates in a photo of
    /// `photo` (width and height) pixels, and the number of vertices in a row. The axes are x to the right, y up, z towards the
    /// viewer, with the camera at the origin; the page's width is `width`.
    pub fn vertices(&self, width: f64, photo: [usize; 2]) -> (Vec<[f64; 3]>, Vec<[f32; 2]>, usize) {
        let (cols, rows) = (self.grid.cols, self.grid.rows);
        let positions = (self.grid.nodes.iter())
            .map(|node| [node.x, -node.y, -node.z].map(|v| v * width))
            .collect();
        let uvs = node_shares([cols, rows])
            .map(|share| {
                let [x, y] = self.table.at(share);
                let [width, height] = photo.map(|n| n as f64);
                [(x + 0.5) / width, 1.0 - (y + 0.5) / height].map(lanes::single)
            })
            .collect();
        (positions, uvs, cols)
    }
}

/// Makes the report on a page: the verdict and the measures of its fit. The edges may not be
/// seen, or not be traced between the corners.
fn report(
    found: &FoundSheet,
    view: &PhotoView,
    [is_seen, has_inner_points]: [bool; 2],
) -> PageReport {
    let (figures, grid) = (&found.figures, &found.sheet.grid);
    let normals = normals(grid);
    let mean = normals.iter().sum::<Vector3<f64>>().normalize();
    let off = |normal: &Vector3<f64>| normal.dot(&mean).clamp(-1.0, 1.0).acos();
    let bend = normals.iter().map(off).fold(0.0, f64::max);
    let hidden = normals
        .iter()
        .zip(&grid.nodes)
        .any(|(normal, node)| normal.dot(node) <= 0.0);
    // Its own limit tells whether two edges and lines that are traced by hand are those of a cylinder.
    let is_cylinder = found.model == PageModel::Cylinder;
    let error = ERROR_AT_UNIT_COST * found.cost.powf(ERROR_COST_POWER);
    let is_plane = found.model == PageModel::Plane;
    let has_lines = found.count >= MIN_CHECKING_LINES;
    // How far a page that fills the photo reaches beyond it says how little is known, not that it is no such page.
    let contradiction = if is_seen { figures.outline } else { 0.0 };
    let (verdict, doubt) = if 100.0 * contradiction > MAX_TRUSTED_ERROR
        || (is_cylinder && contradiction.hypot(figures.lines) > MAX_CYLINDER_MISFIT)
    {
        (PageVerdict::NotThisKind, None)
    } else if is_plane && is_seen && (has_inner_points || has_lines) {
        (PageVerdict::Flat, None)
    } else if hidden {
        (PageVerdict::Doubtful, Some(PageDoubt::HiddenPart))
    } else if error > MAX_TRUSTED_ERROR && !(is_cylinder && is_seen) {
        let doubt = match found.model {
            PageModel::SoftSheet => PageDoubt::Crumpled,
            _ => PageDoubt::LargeError,
        };
        (PageVerdict::Doubtful, Some(doubt))
    } else if is_seen && has_lines {
        (PageVerdict::Unrolled, None)
    } else {
        (PageVerdict::Unchecked, None)
    };
    let focal = view.focal * grid.camera.log_scale.exp();
    PageReport {
        verdict,
        doubt,
        model: found.model,
        error,
        error_bound: ERROR_BOUND_RATIO * error,
        focal_length: focal,
        tilt: mean.z.abs().min(1.0).acos().to_degrees(),
        bend: if is_plane {
            0.0
        } else {
            2.0 * bend.to_degrees()
        },
        residual: figures.outline / found.depth * view.focal,
        disagreement: 100.0 * figures.outline,
        lines: found.count,
        lines_found: found.lines.len(),
        lines_disagreement: 100.0 * figures.lines,
        ratio: grid.ratio(),
    }
}

/// Unit normals of the sheet's cells, one for each node (of the cell to its lower right, or the nearest one); they
/// point away from the camera where the page's face is visible.
fn normals(grid: &SheetGrid) -> Vec<Vector3<f64>> {
    let (cols, rows) = (grid.cols, grid.rows);
    (0..cols * rows)
        .map(|i| {
            let (x, y) = ((i % cols).min(cols - 2), (i / cols).min(rows - 2));
            let at = |dx: usize, dy: usize| grid.nodes[(y + dy) * cols + x + dx];
            let cross = (at(1, 1) - at(0, 0)).cross(&(at(0, 1) - at(1, 0)));
            cross / cross.norm().max(1e-300)
        })
        .collect()
}
