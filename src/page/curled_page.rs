//! Curled pages: the cylinder in space on which a page lies, found from the page's edges as traced in one photo.

use super::closed_form;
use super::cylinder::Cylinder;
use super::edges::{Edges, Trace};
use super::error_estimate::estimate_error;
use super::known_sizes::{focal_length, sides};
use super::options::{FocalLength, Format, PageOptions};
use super::prior::Prior;
use super::read_traces::read_traces;
use super::report::{PageReport, report};
use super::residual_statistics::ResidualStatistics;
use super::search::{CylinderSearch, is_searched};
use super::traced_line::TracedLine;
use super::traces::Traces;
use crate::error::{Error, Readable, Result, positive};

/// A page that is curled in one direction (a cylinder), or the two pages of a spread, in space.
#[derive(Debug, Clone)]
pub struct CurledPage {
    pub(super) cylinder: Cylinder,
    pub(super) photo: [usize; 2],
    /// Whether the left and the right edge are the bent ones, so that the rulings run from left to right.
    pub(super) sideways: bool,
    /// Length of the cylinder's unit, which is the first page's width: in millimetres if the format or a ruler is
    /// known, else in widths of a page.
    pub(super) unit: f64,
    /// Whether lengths of the flat page are in millimetres; otherwise in widths of a page.
    pub(super) millimetres: bool,
    /// Lines of text that were detected in the photo, a list for each page.
    pub(super) found: Vec<Vec<Trace>>,
    /// Root mean square residual of the detected lines of text, in standard deviations of a traced point.
    pub(super) found_residual: f64,
    pub(super) report: PageReport,
}

/// Maximum relative standard deviation of a focal length, estimated from the perspective, that is accepted.
const MAX_FOCAL_DEVIATION: f64 = 0.05;

/// Relative standard deviation of a page's ratio of height to width where the format is given.
const FORMAT_RATIO_DEVIATION: f64 = 0.002;

/// Minimum difference of the logarithms of the observed and the format's ratio of height to width at which edges
/// contradict the format; four times the error bound of the observed ratio is added.
const FORMAT_MISMATCH: f64 = 0.04;

/// Maximum difference of the logarithms of the observed and the format's ratio of height to width that is accepted,
/// however large the error bound.
const MAX_FORMAT_MISMATCH: f64 = 0.25;

/// Assumed relative error bound of the observed ratio of height to width where it cannot be estimated.
const UNKNOWN_RATIO_ERROR: f64 = 0.1;

/// Ratio of the photo's diagonal to the default standard deviation of a traced point; the latter is 2 pixels in a photo
/// of 12 megapixels.
const DIAGONAL_PER_DEFAULT_ACCURACY: f64 = 2500.0;

/// Minimum default standard deviation of a traced point from the page's edge, in pixels.
const MIN_DEFAULT_ACCURACY: f64 = 0.3;

/// Standard deviation of an unknown principal point from the photo's centre, as a share of the photo's diagonal.
const PRINCIPAL_POINT_DEVIATION: f64 = 0.004;

/// Maximum absolute coordinate of a principal point, in diagonals of the photo.
pub(in crate::page) const MAX_CENTRE_DIAGONALS: f64 = 10.0;

/// Field of view along the photo's longer side that a page seen straight on is given, in degrees: that of a phone's main
/// camera.
const USUAL_FIELD_OF_VIEW_DEGREES: f64 = 65.0;

/// Maximum distance of a page's edges from those of a rectangle that faces the camera, in standard deviations of a traced
/// point.
const MAX_FRONTAL_DEVIATIONS: f64 = 3.0;

/// Initial focal lengths of the search where none is given, as multiples of the photo's longer side.
const INITIAL_FOCAL_RATIOS: [f64; 5] = [0.5, 0.75, 1.1, 2.0, 5.0];

/// Minimum number of observations in excess of parameters for the error estimate to add two degrees to the curve's
/// Legendre series.
const MIN_SPARE_DISTANCES: f64 = 6.0;

/// Minimum length of a ruler (a known distance on the page), as a share of the flat page's shorter side.
const MIN_RULER_SHARE: f64 = 0.01;

impl CurledPage {
    /// Finds the page whose edges are traced in a photo of `photo` (width and height) pixels. Two
    /// pairs of edges are those of the two pages of a spread, which share the gutter: the left page's edges end
    /// where the right page's begin.
    ///
    /// Costs `O(traced points)`, some tens of milliseconds.
    ///
    /// # Errors
    /// [`Error::Edges`] for edges that cannot belong to one page: with fewer than two points, with
    /// corners that make no convex quadrilateral, crossing, exchanged or outside of the photo, or of
    /// other proportions than the format's. [`Error::FocalLength`] if the focal length is not given
    /// and cannot be found. [`Error::NotFinite`] for a coordinate that is no number (its row is the
    /// point), [`Error::Option`] for a number out of its range, [`Error::Empty`] for a photo
    /// without pixels, [`Error::TooLarge`] for an edge of more than 100,000 points.
    pub fn new(edges: &[Edges], photo: [usize; 2], options: &PageOptions) -> Result<Self> {
        Self::with_lines(edges, &[], photo, options)
    }

    /// Finds a page by its traced edges and by lines of text, which are traced like edges but from their beginning to
    /// their end, for each page in the order of `edges`. Lines of text are level on the flat page. If the bent edges
    /// are those above and below the text, each line is a further cross-section; if they are those beside it, each line
    /// is a ruling, and straight. Lines of text show whether a page is folded or bent both ways between its edges, and
    /// check pages whose edges do not check each other.
    ///
    /// The print may be turned on its page by about half a degree. At most 800 points of all lines are
    /// used, and at most 24 of one line.
    ///
    /// # Errors
    /// Those of [`CurledPage::new`], and [`Error::Edges`] for a line beside its page, by more than 3 %
    /// of the page's edge; [`Error::Option`] for lines of more pages than there are,
    /// [`Error::TooLarge`] for more than 500 lines.
    pub fn with_lines(
        edges: &[Edges],
        text: &[Vec<Trace>],
        photo: [usize; 2],
        options: &PageOptions,
    ) -> Result<Self> {
        Self::solved(edges, [text, &[]], photo, options)
    }

    /// Finds a page by its edges and by lines of text: `text[0]` are traced by the caller, `text[1]` detected in the
    /// photo.
    ///
    /// # Errors
    /// Those of [`CurledPage::with_lines`].
    pub(super) fn solved(
        edges: &[Edges],
        text: [&[Vec<Trace>]; 2],
        photo: [usize; 2],
        options: &PageOptions,
    ) -> Result<Self> {
        if photo.contains(&0) {
            return Err(Error::Empty { what: "photo" });
        }
        let [width, height] = photo.map(|n| n as f64);
        let (longer, diagonal) = (width.max(height), width.hypot(height));
        let centre = options
            .centre
            .unwrap_or([(width - 1.0) / 2.0, (height - 1.0) / 2.0]);
        if !centre
            .iter()
            .all(|v| v.abs() <= MAX_CENTRE_DIAGONALS * diagonal)
        {
            let requirement = "must be two numbers, in pixels, not far outside of the photo";
            return Err(Error::option("centre", centre, requirement));
        }
        let accuracy = match options.accuracy {
            Some(accuracy) => positive("accuracy", accuracy)?,
            None => (diagonal / DIAGONAL_PER_DEFAULT_ACCURACY).max(MIN_DEFAULT_ACCURACY),
        };
        let focal = focal_length(options.focal_length, longer, diagonal)?;
        let sides = sides(options.format)?;
        let (all, sideways) = read_traces(edges, text, photo)?;
        let traces = Traces::new(&all, sideways)?;
        let pages: Vec<[TracedLine; 2]> = all.into_iter().map(|page| page.pair).collect();
        if focal.is_none() && is_frontal_rectangle(&pages, accuracy) {
            // Its flat page is the same by any focal length.
            let usual = FocalLength::FieldOfView(USUAL_FIELD_OF_VIEW_DEGREES);
            return Self::solved(edges, text, photo, &options.focal_length(usual));
        }
        let mut prior = Prior {
            focal: focal.map(|[value, deviation]| [value.ln(), deviation]),
            ratio: None,
            accuracy,
        };
        let candidates = match focal {
            Some([value, _]) => vec![value],
            None => {
                let found = closed_form::focal_length(&pages, centre);
                let usual = INITIAL_FOCAL_RATIOS.map(|share| share * longer);
                found
                    .into_iter()
                    .filter(|f| is_searched(*f, longer))
                    .chain(usual)
                    .collect()
            }
        };
        let search = CylinderSearch {
            pages: &pages,
            traces: &traces,
            centre,
        };
        let free = search.best(&candidates, &prior);
        let ratio = free.as_ref().map(|(cylinder, _)| cylinder.length);
        let (mut found, mut format) = (free, None);
        if let Some(sides) = sides {
            // Height over width as the page is read, and along the cylinder.
            let read = |ratio: f64| if sideways { 1.0 / ratio } else { ratio };
            let own = read(sides.ratio(read(ratio.unwrap_or_else(|| apparent_ratio(&pages)))));
            prior.ratio = Some([own.ln(), FORMAT_RATIO_DEVIATION]);
            let bound = search.best(&candidates, &prior);
            if let (Some((free, residuals)), Some(_), Some(_)) = (&found, &bound, focal) {
                let off = (free.length / own).ln().abs();
                let own = Prior {
                    ratio: None,
                    ..prior
                };
                let spread = estimate_error(free, &traces, residuals, &own, 0.0);
                let slack = spread.map_or(UNKNOWN_RATIO_ERROR, |estimate| 4.0 * estimate.bound);
                if off > (FORMAT_MISMATCH + slack).min(MAX_FORMAT_MISMATCH) {
                    return Err(Error::Edges {
                        reason: format!(
                            "the page that they show is {:.3} times as high as wide, not {:.3} as \
                             its format is; check the format, whether it lies across, and the \
                             focal length",
                            read(free.length),
                            read(prior.ratio.map_or(1.0, |[ratio, _]| ratio.exp())),
                        ),
                    });
                }
            }
            format = Some(sides);
            found = bound;
        }
        let Some((cylinder, residuals)) = found else {
            return Err(unsolved());
        };
        let unsure = options
            .centre
            .map_or(PRINCIPAL_POINT_DEVIATION * diagonal, |_| 0.0);
        // Higher degrees of the curve are uncertain, too.
        let spare = traces.count() - cylinder.parameters() as f64;
        let wider = cylinder
            .clone()
            .with_degree(cylinder.degree() + if spare > MIN_SPARE_DISTANCES { 2 } else { 0 });
        let estimate = estimate_error(&wider, &traces, &residuals, &prior, unsure);
        let estimate = match (estimate, focal) {
            (Some(found), None) if found.focal > MAX_FOCAL_DEVIATION => {
                search.estimate_for_any_focal_length(found, &cylinder, &prior, longer)
            }
            (found, _) => found,
        };
        let estimate = match estimate {
            Some(estimate) => estimate,
            None if focal.is_none() => return Err(Error::FocalLength),
            None => return Err(unsolved()),
        };
        let report = report(&cylinder, &pages, &traces, &residuals, estimate, accuracy);
        let ratio = ratio.unwrap_or(cylinder.length);
        let mut page = CurledPage {
            cylinder,
            photo,
            sideways,
            unit: 1.0,
            millimetres: false,
            found: Vec::new(),
            found_residual: ResidualStatistics::pooled(&traces.statistics(&residuals)[2])
                .map_or(0.0, |pooled| pooled.mean_square.sqrt() / accuracy),
            report: PageReport {
                ratio: if sideways { 1.0 / ratio } else { ratio },
                ..report
            },
        };
        page.measure(format.and_then(|sides| sides.millimetres), options)?;
        Ok(page)
    }

    /// Verdict and measures of the fit of the page to its traced edges.
    pub fn report(&self) -> &PageReport {
        &self.report
    }

    /// Sets the flat page's unit of length, by the format's width and height in millimetres, or by a ruler in the
    /// options; else to a page's width.
    fn measure(&mut self, sides: Option<[f64; 2]>, options: &PageOptions) -> Result<()> {
        let [width, height] = self.size();
        let pages = self.cylinder.pages.len() as f64;
        // A spread's pages lie along the curve.
        let [across, down] = if self.sideways {
            [1.0, pages]
        } else {
            [pages, 1.0]
        };
        if let Some([w, h]) = sides {
            let mut sides = [w, h];
            // Upright or across.
            if (options.format == Format::A4 || options.format == Format::Letter)
                && (height / down > width / across) != (h > w)
            {
                sides = [h, w];
            }
            let [w, h] = sides;
            self.unit = (w * across / width * h * down / height).sqrt();
            self.millimetres = true;
        } else if let Some(ruler) = options.ruler {
            let length = positive("ruler.length", ruler.length)?;
            let ends = [ruler.from, ruler.to].map(|end| self.flat_place(end));
            let [Some(from), Some(to)] = ends else {
                let ends = format!("from {} to {}", ruler.from.readable(), ruler.to.readable());
                return Err(Error::option(
                    "ruler",
                    ends,
                    "must begin and end on the page",
                ));
            };
            let found = (from[0] - to[0]).hypot(from[1] - to[1]);
            if found.is_nan() || found <= MIN_RULER_SHARE * width.min(height) {
                let requirement = "must be at least a hundredth of the page's side long";
                return Err(Error::option("ruler", found, requirement));
            }
            self.unit = length / found;
            self.millimetres = true;
        } else {
            self.unit = across / width;
        }
        Ok(())
    }
}

/// Whether the edges of a page are those of a rectangle that faces the camera: straight, at right angles and of equal lengths
/// on opposite sides, up to a few standard deviations `accuracy` of a traced point.
fn is_frontal_rectangle(pages: &[[TracedLine; 2]], accuracy: f64) -> bool {
    let [[first, second]] = pages else {
        return false;
    };
    let tolerance = MAX_FRONTAL_DEVIATIONS * accuracy;
    let is_straight = |line: &TracedLine| {
        let [from, to] = line.ends();
        let (chord, normal) = (line.chord(), [from[1] - to[1], to[0] - from[0]]);
        (line.points.iter()).all(|p| {
            let off = (p[0] - from[0]) * normal[0] + (p[1] - from[1]) * normal[1];
            off.abs() <= tolerance * chord
        })
    };
    let ([a, b], [d, c]) = (first.ends(), second.ends());
    let side = |p: [f64; 2], q: [f64; 2]| [q[0] - p[0], q[1] - p[1]];
    let (across, down) = (side(a, b), side(a, d));
    let slip = [0, 1].map(|k| c[k] - d[k] - across[k]);
    let skew = across[0] * down[0] + across[1] * down[1];
    let shorter = across[0].hypot(across[1]).min(down[0].hypot(down[1]));
    is_straight(first)
        && is_straight(second)
        && slip[0].hypot(slip[1]) <= tolerance
        && skew.abs() <= tolerance * shorter
}

/// The error for edges that no curled page explains.
fn unsolved() -> Error {
    Error::edges(
        "no page was found whose edges these could be; check that the corners are at their ends, \
         and the focal length",
    )
}

/// Ratio of length to width of the first page as it appears in the photo: mean chord of the straight edges over that of
/// the bent ones.
fn apparent_ratio(pages: &[[TracedLine; 2]]) -> f64 {
    let [first, second] = &pages[0];
    let ruling = |end: usize| {
        let [p, q] = [first.ends()[end], second.ends()[end]];
        (p[0] - q[0]).hypot(p[1] - q[1])
    };
    (ruling(0) + ruling(1)) / (first.chord() + second.chord())
}
