//! From traces to a page.

use super::cylinder::Cylinder;
use super::edges::{Edges, Trace};
use super::estimate::{Estimate, between, estimate};
use super::known::{focal_length, sides};
use super::line::Line;
use super::misfit::Misfit;
use super::options::{Format, PageOptions};
use super::prior::Prior;
use super::report::{Findings, PageReport};
use super::solve::{Residuals, Traces};
use super::start;
use super::trace::traced;
use crate::error::{Error, Result, positive};

/// A page that is curled one way, or the two pages of a spread, in space.
#[derive(Debug, Clone)]
pub struct CurledPage {
    pub(super) cylinder: Cylinder,
    pub(super) photo: [usize; 2],
    /// Whether the curve runs down the page.
    pub(super) sideways: bool,
    /// Length of the cylinder's unit, in millimetres where these are known.
    pub(super) unit: f64,
    pub(super) millimetres: bool,
    /// Lines of text that were found in the photo, by page.
    pub(super) found: Vec<Vec<Trace>>,
    /// How far their points are off, as a root mean square, over the accuracy of traced ones.
    pub(super) found_off: f64,
    pub(super) report: PageReport,
}

/// Degrees of the curve's direction that are tried, each from the one before.
const DEGREES: [usize; 11] = [0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 14];

/// Focal lengths that cameras have, over the photo's longer side.
const USUAL: [f64; 2] = [0.35, 4.0];

/// Those that are looked for.
const RANGE: [f64; 2] = [0.2, 15.0];

impl CurledPage {
    /// The page whose edges are traced in a photo of so many pixels (width and height); with two
    /// pairs of edges, the two pages of a spread, which share the gutter: the left one's edges end
    /// where the right one's begin.
    ///
    /// Costs `O(traced points)`, some tens of milliseconds.
    ///
    /// # Errors
    /// [`Error::Edges`] for edges that cannot be those of a page: with fewer than two points, with
    /// corners that make no convex quadrilateral, crossing, exchanged or outside of the photo, or of
    /// other proportions than the format's. [`Error::FocalLength`] if the focal length is not given
    /// and cannot be found. [`Error::NotFinite`] for a coordinate that is no number (its row is the
    /// point), [`Error::Option`] for a number out of its range, [`Error::Empty`] for a photo
    /// without pixels, [`Error::TooLarge`] for an edge of more than 100,000 points.
    pub fn new(edges: &[Edges], photo: [usize; 2], options: &PageOptions) -> Result<Self> {
        Self::with_lines(edges, &[], photo, options)
    }

    /// The same with lines of text besides, traced like edges but from where they begin to where they
    /// end, for each page in the order of `edges`. Lines of text are level on the flat page. Where the
    /// bent edges are those above and below the text, each is a further cross-section; where they are
    /// those beside it, each is a ruling, and straight. By them a page that is folded or bent both ways
    /// between its edges is seen to be, and one whose edges nothing checks is checked.
    ///
    /// The print may be turned on its page by half a degree or so. Of all lines 800 points are looked
    /// at, of one at most 24.
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

    /// By lines of text that are given, and by others that were found in the photo.
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
        if !centre.iter().all(|v| v.abs() <= 10.0 * diagonal) {
            let requirement = "must be two numbers, in pixels, not far outside of the photo";
            return Err(Error::option("centre", format!("{centre:?}"), requirement));
        }
        let accuracy = match options.accuracy {
            Some(accuracy) => positive("accuracy", accuracy)?,
            None => (diagonal / 2500.0).max(0.3),
        };
        let focal = focal_length(options.focal_length, longer, diagonal)?;
        let sides = sides(options.format)?;
        let (all, sideways) = traced(edges, text, photo)?;
        let traces = Traces::new(&all, sideways)?;
        let pages: Vec<[Line; 2]> = all.into_iter().map(|page| page.pair).collect();
        let mut prior = Prior {
            focal: focal.map(|[value, deviation]| [value.ln(), deviation]),
            ratio: None,
            accuracy,
        };
        let candidates = match focal {
            Some([value, _]) => vec![value],
            None => {
                let found = start::focal(&pages, centre);
                let usual = [0.5, 0.75, 1.1, 2.0, 5.0].map(|share| share * longer);
                found
                    .into_iter()
                    .filter(|f| within(*f, longer))
                    .chain(usual)
                    .collect()
            }
        };
        let search = Search {
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
            let own = read(sides.ratio(read(ratio.unwrap_or_else(|| apparent(&pages)))));
            prior.ratio = Some([own.ln(), FORMAT]);
            let bound = search.best(&candidates, &prior);
            if let (Some((free, residuals)), Some(_), Some(_)) = (&found, &bound, focal) {
                let off = (free.length / own).ln().abs();
                let own = Prior {
                    ratio: None,
                    ..prior
                };
                let spread = estimate(free, &traces, residuals, &own, 0.0);
                let slack = spread.map_or(0.1, |estimate| 4.0 * estimate.bound);
                if off > (0.04 + slack).min(0.25) {
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
        let unsure = options.centre.map_or(0.004 * diagonal, |_| 0.0);
        // What a curve of the next degrees would add is left open, too.
        let spare = traces.count() - cylinder.parameters() as f64;
        let wider = cylinder
            .clone()
            .with_degree(cylinder.degree() + if spare > 6.0 { 2 } else { 0 });
        let estimate = estimate(&wider, &traces, &residuals, &prior, unsure);
        let estimate = match (estimate, focal) {
            (Some(found), None) if found.focal > FOUND => {
                search.whatever_the_focal_length(found, &cylinder, &prior, longer)
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
            found_off: Misfit::together(&traces.misfits(&residuals)[2])
                .map_or(0.0, |all| all.all.sqrt() / accuracy),
            report: PageReport {
                ratio: if sideways { 1.0 / ratio } else { ratio },
                ..report
            },
        };
        page.measure(format.and_then(|sides| sides.millimetres), options)?;
        Ok(page)
    }

    /// How it was found, and how far it is to be trusted.
    pub fn report(&self) -> &PageReport {
        &self.report
    }

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
                let ends = format!("from {:?} to {:?}", ruler.from, ruler.to);
                return Err(Error::option(
                    "ruler",
                    ends,
                    "must begin and end on the page",
                ));
            };
            let found = (from[0] - to[0]).hypot(from[1] - to[1]);
            if found.is_nan() || found <= 0.01 * width.min(height) {
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

fn unsolved() -> Error {
    Error::edges(
        "no page was found whose edges these could be; check that the corners are at their ends, \
         and the focal length",
    )
}

/// Relative standard deviation of a format's proportions.
const FORMAT: f64 = 0.002;

/// A focal length that is known to so little is not found.
const FOUND: f64 = 0.05;

fn within(focal: f64, longer: f64) -> bool {
    (RANGE[0] * longer..=RANGE[1] * longer).contains(&focal)
}

/// Length over width of the first page as it is seen.
fn apparent(pages: &[[Line; 2]]) -> f64 {
    let [first, second] = &pages[0];
    let ruling = |end: usize| {
        let [p, q] = [first.ends()[end], second.ends()[end]];
        (p[0] - q[0]).hypot(p[1] - q[1])
    };
    (ruling(0) + ruling(1)) / (first.chord() + second.chord())
}

struct Search<'a> {
    pages: &'a [[Line; 2]],
    traces: &'a Traces,
    centre: [f64; 2],
}

impl Search<'_> {
    /// The closed form.
    fn start(&self, focal: f64) -> Option<Cylinder> {
        let mut start = start::cylinder(self.pages, self.centre, focal)?;
        if self.traces.text() > 0 {
            start.skews = vec![0.0; self.pages.len()];
        }
        Some(start)
    }

    /// The estimate where the focal length is open, if the page is nearly the same for all that it
    /// may be, as one that is flat and seen from straight above.
    fn whatever_the_focal_length(
        &self,
        found: Estimate,
        cylinder: &Cylinder,
        prior: &Prior,
        longer: f64,
    ) -> Option<Estimate> {
        /// Largest displacement, over a page's width.
        const SAME: f64 = 0.01;
        let middle = cylinder.focal.clamp(USUAL[0] * longer, USUAL[1] * longer);
        let mut bound = found.bound;
        for sign in [-2.0, 2.0] {
            let focal = middle * (sign * found.focal.min(10.0)).exp();
            let focal = focal.clamp(USUAL[0] * longer, USUAL[1] * longer);
            let held = Prior {
                focal: Some([focal.ln(), 1e-3]),
                ..*prior
            };
            let start = self.start(focal)?;
            let (other, _) = self
                .traces
                .solve(start.with_degree(cylinder.degree()), &held)?;
            bound = bound.max(between(cylinder, &other)?);
        }
        (bound < SAME).then(|| Estimate {
            expected: found.expected.clamp(bound / 2.0, bound),
            bound,
            ..found
        })
    }

    /// The best cylinder of any degree that the traces support, from the best of several focal
    /// lengths.
    fn best(&self, focal: &[f64], prior: &Prior) -> Option<(Cylinder, Residuals)> {
        let count = self.traces.count();
        let starts: Vec<Cylinder> = (focal.iter()).filter_map(|f| self.start(*f)).collect();
        let parameters = |degree: usize| {
            (starts.first()).map_or(0, |c| c.clone().with_degree(degree).parameters()) as f64
        };
        let known = f64::from(prior.focal.is_some()) + f64::from(prior.ratio.is_some());
        // Akaike's criterion, corrected for few points. Lines of text are many points in the page's
        // middle, and would have a curve that swings at its ends: with them parameters cost as much
        // as in Schwarz's.
        let price = if self.traces.text() > 0 {
            count.ln().max(2.0)
        } else {
            2.0
        };
        let criterion = |residuals: &Residuals, degree: usize| {
            let p = parameters(degree) - known;
            let squares = residuals.cost * prior.accuracy.powi(2) + count * 0.05f64.powi(2);
            let spare = (count - p - 1.0).max(0.2);
            count * (squares / count).ln() + price * p * (1.0 + (p + 1.0) / spare)
        };
        let supported = |degree: usize| count + known - parameters(degree) >= 2.0;
        let lowest =
            |one: Option<(Cylinder, Residuals)>, other: Option<(Cylinder, Residuals)>| match (
                one, other,
            ) {
                (Some(one), Some(other)) if one.1.cost <= other.1.cost => Some(one),
                (one, None) => one,
                (_, other) => other,
            };
        let mut best: Option<(Cylinder, Residuals, f64)> = None;
        let mut before: Option<(Cylinder, Residuals)> = None;
        let mut worse = 0;
        for degree in DEGREES {
            if degree > 0 && !supported(degree) {
                break;
            }
            let mut found = before
                .clone()
                .and_then(|(cylinder, _)| self.traces.solve(cylinder.with_degree(degree), prior));
            // The closed form, with its curve and without.
            if degree == 0 || degree == 4 {
                for start in &starts {
                    let start = start.clone().with_degree(degree);
                    found = lowest(found, self.traces.solve(start, prior));
                }
            }
            let Some((cylinder, residuals)) = found else {
                continue;
            };
            let value = criterion(&residuals, degree);
            before = Some((cylinder.clone(), residuals.clone()));
            if best.as_ref().is_none_or(|(_, _, least)| value < *least) {
                best = Some((cylinder, residuals, value));
                worse = 0;
            } else {
                worse += 1;
                if worse > 3 && degree > 4 {
                    break;
                }
            }
        }
        best.map(|(cylinder, residuals, _)| (cylinder, residuals))
    }
}

fn report(
    cylinder: &Cylinder,
    pages: &[[Line; 2]],
    traces: &Traces,
    residuals: &Residuals,
    estimate: Estimate,
    accuracy: f64,
) -> PageReport {
    let [edges, text, found] = traces.misfits(residuals);
    let common = traces.common(residuals);
    // Of the edge that fits worst, or of all lines of text.
    let lines = Misfit::together(&[&text[..], &found].concat());
    let worst = |of: fn(&Misfit) -> f64, of_lines: f64| {
        let squares = edges.iter().map(of);
        squares.fold(of_lines, f64::max).sqrt()
    };
    let residual = worst(|own| own.all, lines.map_or(0.0, |own| own.all));
    let smooth = worst(|own| own.smooth, common);
    let lines = || pages.iter().flatten();
    let seen = lines().map(Line::chord).sum::<f64>() / lines().count() as f64;
    let mut bow = traces.bows(cylinder).unwrap_or(vec![f64::INFINITY; 2]);
    bow.sort_by(|p, q| q.total_cmp(p));
    let fewest = lines()
        .map(|line| line.independent)
        .fold(f64::INFINITY, f64::min);
    let lines_found = found.len();
    let findings = Findings {
        estimate,
        edges,
        text,
        common,
        accuracy,
        seen,
        bow: [bow[0], bow[1]],
        fewest,
        hidden: cylinder.hides_itself(),
    };
    PageReport {
        verdict: findings.verdict(),
        error: 100.0 * estimate.expected,
        error_bound: 100.0 * estimate.bound,
        focal_length: cylinder.focal,
        focal_deviation: 100.0 * estimate.focal,
        tilt: cylinder.axes.column(1).z.abs().min(1.0).acos().to_degrees(),
        bend: cylinder.bend().to_degrees(),
        residual,
        disagreement: 100.0 * smooth / seen,
        lines: traces.text(),
        lines_found,
        lines_used: lines_found,
        lines_disagreement: 100.0 * common.sqrt() / seen,
        ratio: cylinder.length,
    }
}
