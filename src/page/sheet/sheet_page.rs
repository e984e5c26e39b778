//! A page of any shape in space, from its four edges in one photo.

use nalgebra::Vector3;

use super::grid::SheetGrid;
use super::place_table::PlaceTable;
use super::plane::CameraPrior;
use super::polyline::Polyline;
use super::search::{FoundSheet, find_sheet};
use super::view::PhotoView;
use crate::dewarp::{DewarpOptions, Photo, WarpMap};
use crate::error::{Error, Readable, Result, positive};
use crate::page::curled_page::MAX_CENTRE_DIAGONALS;
use crate::page::edges::{Edges, Trace};
use crate::page::known_sizes::{Sides, focal_length, sides};
use crate::page::options::{Format, PageOptions};
use crate::page::output::{back_project, grid_mesh, texture_coordinates};
use crate::page::page_warp::PageWarp;
use crate::page::read_traces::read_traces;
use crate::page::report::{PageDoubt, PageModel, PageReport, PageVerdict};
use crate::page::traced_line::{TracedLine, distance};
use crate::page::working_photo::PhotoScale;
use crate::scene::camera::has_camera_proportions;
use crate::scene::mesh::Mesh;

/// A page of any shape in space: a nearly isometric sheet that bends little, fitted to the page's outline and lines of
/// print in one photo.
#[derive(Debug, Clone)]
pub struct SheetPage {
    grid: SheetGrid,
    table: PlaceTable,
    photo: [usize; 2],
    /// Width of the flat page: in millimetres if the format or a ruler is known, else 1.
    unit: f64,
    millimetres: bool,
    /// Lines of print that were detected in the photo; the outer list has one entry, for the one page.
    lines: Vec<Vec<Trace>>,
    report: PageReport,
}

/// Number of segments to which each traced edge is resampled.
const EDGE_SEGMENTS: usize = 160;

/// Assumed focal length where it is not known, as a multiple of the photo's longer side: that of a phone, with a photo
/// that is cropped slightly.
const USUAL_FOCAL_RATIO: f64 = 0.9;

/// Standard deviation of the logarithm of an unknown focal length.
const UNKNOWN_FOCAL_DEVIATION: f64 = 0.2;

/// Assumed focal length of a photo whose proportions are no camera's, as a multiple of its longer side: that of a phone,
/// whose photo was cropped to about three fifths of its sides. Chosen by the table of pages in `benches/page.md`.
const CROPPED_FOCAL_RATIO: f64 = 1.3;

/// Standard deviation of the logarithm of the unknown focal length of a cropped photo.
const CROPPED_FOCAL_DEVIATION: f64 = 0.15;

/// Standard deviation of the coordinates of a cropped photo's principal point, divided by the focal length: about half
/// of what was cut off on one side.
const CROPPED_CENTRE_DEVIATION: f64 = 0.2;

/// Minimum standard deviation of the logarithm of a known focal length, because photos are edited.
const MIN_FOCAL_DEVIATION: f64 = 0.06;

/// Standard deviation of the principal point's coordinates, divided by the focal length: photos are cropped by hand.
const CENTRE_DEVIATION: f64 = 0.12;

/// Relative standard deviation of a page's height over width where the format is known.
const FORMAT_RATIO_DEVIATION: f64 = 0.002;

/// Root mean square distance between sheet and outline, in widths of the page, above which the edges cannot be those of
/// a sheet (verdict `NotThisKind`).
const MAX_OUTLINE_MISFIT: f64 = 0.02;

/// Maximum root mean square distance between sheet and outline, in widths of the page, for the verdict `Unrolled`.
const MAX_TRUSTED_OUTLINE_MISFIT: f64 = 0.003;

/// Maximum root mean square distance between lines of print and the sheet's level lines, in widths of the page, for the
/// verdict `Unrolled`.
const MAX_TRUSTED_LINE_MISFIT: f64 = 0.003;

/// Maximum root mean square curvature without bends across folds, in reciprocal widths of the page, for the verdict
/// `Unrolled`.
const MAX_TRUSTED_CURVATURE: f64 = 0.55;

/// Maximum root mean square strain for the verdict `Unrolled`.
const MAX_TRUSTED_STRAIN: f64 = 0.003;

/// Minimum number of detected lines of print for the verdict `Unrolled`: outlines alone leave much open.
const MIN_TRUSTED_LINES: usize = 8;

/// Ratio of the expected displacement of the flat page to the misfit of outline and lines, both in widths of the page.
const ERROR_PER_MISFIT: f64 = 3.0;

/// Ratio of the expected displacement of the flat page, in widths of the page, to the root mean square curvature without
/// bends across folds.
const ERROR_PER_CURVATURE: f64 = 0.02;

/// Ratio of the displacement that is not exceeded in 95 of 100 cases to the expected one.
const ERROR_BOUND_RATIO: f64 = 2.5;

/// Minimum length of a ruler (a known distance on the page), as a share of the flat page's shorter side.
const MIN_RULER_SHARE: f64 = 0.01;

impl SheetPage {
    /// Finds a page of any shape by its four traced edges in a photo, and by lines of print that are detected in it.
    /// The model is a plane where that explains both, else an isometric sheet, else a slightly strained one.
    ///
    /// Camera and proportions are found, too, within what is usual and what `options` tell. Costs some hundred
    /// milliseconds.
    ///
    /// # Errors
    /// [`Error::Edges`] for edges that cannot belong to one page, or that are not all four;
    /// those of [`CurledPage::new`](super::super::CurledPage::new) about edges and options.
    pub fn in_photo(edges: &Edges, photo: &Photo<'_>, options: &PageOptions) -> Result<Self> {
        let size = [photo.width(), photo.height()];
        let [width, height] = size.map(|n| n as f64);
        let (longer, diagonal) = (width.max(height), width.hypot(height));
        let focal = focal_length(options.focal_length, longer, diagonal)?;
        let format = sides(options.format)?;
        let is_cropped = focal.is_none() && !has_camera_proportions(size);
        let [usual_ratio, usual_deviation, centre_deviation] = if is_cropped {
            [
                CROPPED_FOCAL_RATIO,
                CROPPED_FOCAL_DEVIATION,
                CROPPED_CENTRE_DEVIATION,
            ]
        } else {
            [USUAL_FOCAL_RATIO, UNKNOWN_FOCAL_DEVIATION, CENTRE_DEVIATION]
        };
        let view = PhotoView {
            focal: focal.map_or(usual_ratio * longer, |[focal, _]| focal),
            centre: (options.centre).unwrap_or([(width - 1.0) / 2.0, (height - 1.0) / 2.0]),
        };
        if !(view.centre.iter()).all(|v| v.abs() <= MAX_CENTRE_DIAGONALS * diagonal) {
            let requirement = "must be two numbers, in pixels, not far outside of the photo";
            return Err(Error::option("centre", view.centre, requirement));
        }
        let edges = outline(edges, size)?.map(|line| {
            let points: Vec<_> = (line.points.iter())
                .map(|p| view.to_normalised(*p))
                .collect();
            Polyline::resampled(&points, EDGE_SEGMENTS)
        });
        let length = |k: usize| {
            let points = edges[k].points();
            distance(points[0], points[points.len() - 1])
        };
        let apparent = (length(2) + length(3)) / (length(0) + length(1));
        let ratio = |sides: Sides| [sides.ratio(apparent).ln(), FORMAT_RATIO_DEVIATION];
        let prior = CameraPrior {
            log_scale: 0.0,
            scale_deviation: focal.map_or(usual_deviation, |[_, deviation]| {
                deviation.max(MIN_FOCAL_DEVIATION)
            }),
            centre_deviation,
            log_ratio: format.map(ratio),
        };
        let found = find_sheet(&edges, prior, &view, photo).ok_or_else(|| {
            Error::edges(
                "no page was found whose edges these could be; check that the corners are at their \
                 ends, and the focal length",
            )
        })?;
        let table = PlaceTable::new(&found.sheet.grid, &view)?;
        let pixels =
            |line: &Vec<[f64; 2]>| Trace::Points(line.iter().map(|p| view.to_pixels(*p)).collect());
        let mut page = SheetPage {
            table,
            photo: size,
            unit: 1.0,
            millimetres: false,
            lines: vec![found.lines.iter().map(pixels).collect()],
            report: report(&found, &view, prior.scale_deviation),
            grid: found.sheet.grid,
        };
        page.measure(format.and_then(|sides| sides.millimetres), options)?;
        Ok(page)
    }

    /// Verdict on the page, with the measures of its fit.
    pub fn report(&self) -> &PageReport {
        &self.report
    }

    /// Width and height of the flat page, in millimetres if the format or a ruler is known, else in widths of the page.
    pub fn flat_size(&self) -> [f64; 2] {
        [self.unit, self.unit * self.grid.ratio()]
    }

    /// Whether lengths of the flat page are in millimetres; otherwise in widths of the page.
    pub fn is_millimetres(&self) -> bool {
        self.millimetres
    }

    /// Lines of print across and down the page that were detected in the photo, as points in the photo's pixels.
    pub fn text(&self) -> &[Vec<Trace>] {
        &self.lines
    }

    /// Computes the page's warp map, which holds for photos of any resolution.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn warp(&self) -> Result<PageWarp> {
        let (size, place) = (self.flat_size(), |share| Some(self.table.at(share)));
        PageWarp::from_projection(size, self.millimetres, self.photo, place)
    }

    /// Computes the warp map of the flat page: for each pixel of the flat image its place in the photo, as
    /// [`CurledPage::warp_map`](super::super::CurledPage::warp_map) does.
    ///
    /// # Errors
    /// Those of [`CurledPage::warp_map`](super::super::CurledPage::warp_map).
    pub fn warp_map(&self, options: &DewarpOptions) -> Result<WarpMap> {
        self.warp()?.warp_map(self.photo, options)
    }

    /// Returns this page as it is seen in the photo itself instead of its working photo.
    pub(in crate::page) fn in_full_photo(self, scale: PhotoScale) -> Self {
        let line = |line: &Trace| line.map_points(|point| scale.to_photo(point));
        let lines = self
            .lines
            .iter()
            .map(|lines| lines.iter().map(line).collect());
        SheetPage {
            table: self.table.map_places(|place| scale.to_photo(place)),
            photo: scale.photo,
            lines: lines.collect(),
            report: self.report.in_full_photo(scale),
            ..self
        }
    }

    /// Makes a mesh of the page in space, with texture coordinates for the photo, row by row from the upper left
    /// corner, in the axes of [`CurledPage::mesh`](super::super::CurledPage::mesh).
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn mesh(&self) -> Result<Mesh> {
        let (cols, rows) = (self.grid.cols, self.grid.rows);
        let positions = (self.grid.nodes.iter())
            .map(|node| [node.x, -node.y, -node.z].map(|v| v * self.unit))
            .collect();
        let uvs = (0..cols * rows)
            .map(|i| {
                let share = [
                    (i % cols) as f64 / (cols - 1) as f64,
                    (i / cols) as f64 / (rows - 1) as f64,
                ];
                texture_coordinates(self.table.at(share), self.photo)
            })
            .collect();
        grid_mesh(positions, uvs, cols)
    }

    /// Sets the flat page's unit of length, by the format's width and height in millimetres, or by a ruler in the
    /// options; else it stays the page's width.
    fn measure(&mut self, sides: Option<[f64; 2]>, options: &PageOptions) -> Result<()> {
        let ratio = self.grid.ratio();
        if let Some([w, h]) = sides {
            let named = matches!(options.format, Format::A4 | Format::Letter);
            let [w, h] = if named && (ratio > 1.0) != (h > w) {
                [h, w]
            } else {
                [w, h]
            };
            self.unit = (w * h / ratio).sqrt();
            self.millimetres = true;
        } else if let Some(ruler) = options.ruler {
            let length = positive("ruler.length", ruler.length)?;
            let end = |pixel| back_project(|share| Some(self.table.at(share)), pixel);
            let (Some(from), Some(to)) = (end(ruler.from), end(ruler.to)) else {
                let ends = format!("from {} to {}", ruler.from.readable(), ruler.to.readable());
                return Err(Error::option(
                    "ruler",
                    ends,
                    "must begin and end on the page",
                ));
            };
            let found = (from[0] - to[0]).hypot((from[1] - to[1]) * ratio);
            if found.is_nan() || found <= MIN_RULER_SHARE * ratio.min(1.0) {
                let requirement = "must be at least a hundredth of the page's side long";
                return Err(Error::option("ruler", found, requirement));
            }
            self.unit = length / found;
            self.millimetres = true;
        }
        Ok(())
    }
}

/// Reads the four traced edges of a page, in the order top, bottom, left, right, each from left to right or from top to
/// bottom.
///
/// # Errors
/// [`Error::Edges`] and what else [`read_traces`] finds.
fn outline(edges: &Edges, photo: [usize; 2]) -> Result<[TracedLine; 4]> {
    let (pages, sideways) = read_traces(std::slice::from_ref(edges), [&[], &[]], photo)?;
    let found = pages
        .into_iter()
        .find_map(|page| Some((page.pair, page.sides?)));
    let Some((pair, sides)) = found else {
        return Err(Error::edges(
            "all four edges are needed for a page of any shape",
        ));
    };
    let ([top, bottom], [left, right]) = if sideways {
        let [right, left] = pair;
        (sides, [left, right])
    } else {
        (pair, sides)
    };
    // The bent pair is in order; each of the others begins at the corner that is nearer.
    let starts = if sideways {
        [
            left.ends()[0],
            left.ends()[1],
            left.ends()[0],
            right.ends()[0],
        ]
    } else {
        [
            top.ends()[0],
            bottom.ends()[0],
            top.ends()[0],
            top.ends()[1],
        ]
    };
    let mut lines = [top, bottom, left, right];
    for (line, start) in lines.iter_mut().zip(starts) {
        let [from, to] = line.ends();
        if distance(to, start) < distance(from, start) {
            line.points.reverse();
        }
    }
    Ok(lines)
}

/// Makes the report on a page: the verdict and the measures of its fit. `focal_deviation` is the relative standard
/// deviation of the focal length.
fn report(found: &FoundSheet, view: &PhotoView, focal_deviation: f64) -> PageReport {
    let (figures, grid) = (&found.figures, &found.sheet.grid);
    let lines = found.lines.len();
    let normals = normals(grid);
    let mean = normals.iter().sum::<Vector3<f64>>().normalize();
    let off = |normal: &Vector3<f64>| normal.dot(&mean).clamp(-1.0, 1.0).acos();
    let bend = normals.iter().map(off).fold(0.0, f64::max);
    let hidden = normals
        .iter()
        .zip(&grid.nodes)
        .any(|(normal, node)| normal.dot(node) <= 0.0);
    let trusted = [
        (!hidden, PageDoubt::HiddenPart),
        (lines >= MIN_TRUSTED_LINES, PageDoubt::FewLines),
        (
            found.model == PageModel::Sheet && figures.strain < MAX_TRUSTED_STRAIN,
            PageDoubt::Crumpled,
        ),
        (
            figures.curvature < MAX_TRUSTED_CURVATURE,
            PageDoubt::StrongBend,
        ),
        (
            figures.outline < MAX_TRUSTED_OUTLINE_MISFIT && figures.lines < MAX_TRUSTED_LINE_MISFIT,
            PageDoubt::Disagreement,
        ),
    ];
    let untrusted = trusted.into_iter().find(|(applies, _)| !applies);
    let (verdict, doubt) = if figures.outline > MAX_OUTLINE_MISFIT {
        (PageVerdict::NotThisKind, None)
    } else if found.model == PageModel::Plane {
        (PageVerdict::Flat, None)
    } else if let Some((_, doubt)) = untrusted {
        (PageVerdict::Doubtful, Some(doubt))
    } else {
        (PageVerdict::Unrolled, None)
    };
    let misfit = ERROR_PER_MISFIT * figures.outline.hypot(figures.lines);
    let error = 100.0 * misfit.hypot(ERROR_PER_CURVATURE * figures.curvature);
    let focal = view.focal * grid.camera.log_scale.exp();
    PageReport {
        verdict,
        doubt,
        model: found.model,
        error,
        pinhole_error_bound: ERROR_BOUND_RATIO * error,
        focal_length: focal,
        focal_deviation: 100.0 * focal_deviation,
        tilt: mean.z.abs().min(1.0).acos().to_degrees(),
        bend: if found.model == PageModel::Plane {
            0.0
        } else {
            2.0 * bend.to_degrees()
        },
        residual: figures.outline / found.depth * view.focal,
        disagreement: 100.0 * figures.outline,
        lines,
        lines_found: lines,
        lines_used: lines,
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
