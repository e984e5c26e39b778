//! Search for the plainest model of a page (plane, firm sheet or crumpled sheet) that explains its outline and its
//! lines of print in a photo.

use super::figures::SheetFigures;
use super::fit::FittedSheet;
use super::folds::find_folds;
use super::level_lines::{find_level_lines, traced_level_lines};
use super::place_table::PlaceTable;
use super::plane::{CameraPrior, Homography, grid_rows};
use super::polyline::Polyline;
use super::problem::{SheetProblem, SheetWeights};
use super::view::PhotoView;
use crate::dewarp::Photo;
use crate::math::planar::{distance, line_intersection};
use crate::page::report::PageModel;
use crate::page::text::GreyPhoto;
use crate::page::traced_line::BentEdges;
use crate::progress;

/// Result of the search for a page of any shape: the fitted sheet, its model and its measures.
#[derive(Debug, Clone)]
pub(super) struct FoundSheet {
    pub sheet: FittedSheet,
    pub model: PageModel,
    pub figures: SheetFigures,
    /// Cost of the sheet that explains the photo best: the sum of the robust penalties of its weighted residuals.
    pub cost: f64,
    /// Lines of print in the photo that were detected, in normalised image coordinates (pixels from the principal point,
    /// over the focal length).
    pub lines: Vec<Vec<[f64; 2]>>,
    /// Number of lines of print, traced and detected, to which the sheet was fitted.
    pub count: usize,
    /// Mean depth of the initial plane, in widths of the page.
    pub depth: f64,
}

/// Print of a page: traced lines of text, in normalised image coordinates, and the photo in which further ones are detected.
struct PagePrint<'a> {
    traced: &'a [Vec<[f64; 2]>],
    photo: Option<&'a GreyPhoto>,
    view: &'a PhotoView,
}

/// Numbers of grid columns for the first fits, before lines of print are known; coarse grids find the large bends in
/// few steps.
/// Its row: `benches/page.md`, Models.
const COARSE_GRID_COLS: [usize; 2] = [9, 13];

/// Number of columns of a sheet's grid when it is fitted to lines of print.
const FINE_GRID_COLS: usize = 25;

/// Number of times that lines of print are detected in the flattened photo and the sheet is fitted to them.
/// Its row: `benches/page.md`, Models.
const LINE_DETECTION_ROUNDS: usize = 3;

/// Weights of the residuals in the fit of a sheet of smooth paper, which is firm against strain.
/// Chosen by `benches/page.md`, Beside other ways.
pub(super) const FIRM_PAPER_WEIGHTS: SheetWeights = SheetWeights {
    isometry: 300.0,
    bending: [1.5; 2],
    outline: 350.0,
    corners: 300.0,
    lines: 400.0,
};

/// Weights of the residuals in the fit of a sheet of crumpled paper, which wrinkles finer than the sheet's grid
/// shorten.
/// Its row: `benches/page.md`, Models.
const CRUMPLED_PAPER_WEIGHTS: SheetWeights = SheetWeights {
    isometry: 80.0,
    bending: [3.5; 2],
    ..FIRM_PAPER_WEIGHTS
};

/// Stiffness against bending of lines across a page's rulings, and along them, in the fit of a page that is curled in one
/// direction. Chosen by simulated pages of which two edges are traced.
const RULED_BENDING: [f64; 2] = [0.15, 30.0];

/// Factor of the weights of edges and corners of a page that fills the photo: they are its sides, from which the page's own may
/// be as far as it is bent. Chosen by a curled page whose tilt the lines of print alone hardly show.
const UNSEEN_EDGE_FACTOR: f64 = 0.1;

/// Factor by which the first fit of a sheet weighs strain less and bends more: a sheet that is firm against strain would stay
/// in the initial plane, a limper one would end in ripples. Chosen by `benches/page.md`, Models.
const INITIAL_WEIGHT_RATIO: f64 = 4.0;

/// Distance between lines of print and the lines on a firm sheet that they belong to, in widths of the page, above which
/// the sheet is fitted again with the weights for crumpled paper: a sheet that wrinkles shorten does not meet them.
/// Chosen with the weights for crumpled paper by `benches/page.md`, Models.
const MAX_FIRM_LINE_MISFIT: f64 = 0.00065;

/// Excess of a plane's cost over that of the sheet up to which the plane is accepted as the page's model: a page lying flat lifts
/// off its support by a millimetre on A4. Chosen by `benches/page.md`, Models.
const MAX_PLANE_EXCESS_COST: f64 = 6.0;

/// What is traced of a page in a photo, in normalised image coordinates.
pub(super) struct PageTraces {
    /// Upper, lower, left and right edge.
    pub edges: [Polyline; 4],
    /// The bent edges, if the others are straight: the page is curled in one direction.
    pub bent: Option<BentEdges>,
    /// Whether the edges are seen; else the page reaches to about there.
    pub is_seen: bool,
    /// Lines of text.
    pub lines: Vec<Vec<[f64; 2]>>,
}

impl PageTraces {
    /// Weights of the fit of smooth paper.
    fn firm_weights(&self) -> SheetWeights {
        let bending = self.bent.map_or(FIRM_PAPER_WEIGHTS.bending, ruled_bending);
        let edges = if self.is_seen {
            1.0
        } else {
            UNSEEN_EDGE_FACTOR
        };
        SheetWeights {
            bending,
            outline: edges * FIRM_PAPER_WEIGHTS.outline,
            corners: edges * FIRM_PAPER_WEIGHTS.corners,
            ..FIRM_PAPER_WEIGHTS
        }
    }

    /// Fits a coarse sheet to the edges alone, from the plane of the corners; returns it with its problem and the initial
    /// guesses of pages that are curled in one direction. None if it is not in front of the camera.
    fn coarse_fit(
        &self,
        prior: CameraPrior,
    ) -> Option<(SheetProblem, FittedSheet, Vec<FittedSheet>)> {
        let edges = &self.edges;
        let apparent = apparent_ratio(edges);
        let homography = Homography::new(corners(edges))?;
        let start = homography.sheet(COARSE_GRID_COLS[0], &prior, apparent)?;
        let depth = start.nodes.iter().map(|p| p.z).sum::<f64>() / start.nodes.len() as f64;
        let ruled = [false, true].into_iter().filter_map(|sideways| {
            homography.ruled_sheet(COARSE_GRID_COLS[0], edges, sideways, &prior, apparent)
        });
        let starts: Vec<FittedSheet> = std::iter::once(start)
            .chain(ruled)
            .map(FittedSheet::new)
            .collect();
        let weights = self.firm_weights();
        let mut problem = SheetProblem {
            edges: edges.clone(),
            lines: Vec::new(),
            traced: 0,
            folds: Vec::new(),
            prior,
            ratio: prior.ratio(apparent),
            depth,
            weights: SheetWeights {
                isometry: weights.isometry / INITIAL_WEIGHT_RATIO,
                bending: weights.bending.map(|own| INITIAL_WEIGHT_RATIO * own),
                ..weights
            },
        };
        let limp = problem.solve(starts[0].clone())?;
        problem.weights = weights;
        let coarse = problem.refined(limp, &COARSE_GRID_COLS)?;
        Some((problem, coarse, starts))
    }
}

/// Stiffness against bending of lines across and down a page whose edges `bent` are bent and whose others are straight.
fn ruled_bending(bent: BentEdges) -> [f64; 2] {
    let [across, along] = RULED_BENDING;
    match bent {
        BentEdges::TopBottom => [across, along],
        BentEdges::LeftRight => [along, across],
    }
}

/// Finds the plainest model of a page that explains its edges and the lines of print that the photo shows between them. Of
/// several kinds of prior knowledge `priors`, such as of a format that may lie across, that is taken by which a sheet explains
/// the edges best. None if no model does.
pub(super) fn find_sheet(
    traces: &PageTraces,
    priors: &[CameraPrior],
    view: &PhotoView,
    photo: Option<&Photo<'_>>,
) -> Option<FoundSheet> {
    let edges = &traces.edges;
    let apparent = apparent_ratio(edges);
    let (mut problem, coarse, starts) = (priors.iter())
        .filter_map(|prior| traces.coarse_fit(*prior))
        .min_by(|(_, one, _), (_, other, _)| one.cost.total_cmp(&other.cost))?;
    let coarse = problem.with_lowest_cost(coarse, &starts[1..]);
    progress::reach(0.1);
    let table = PlaceTable::new(&coarse.grid, view).ok()?;
    let photo = photo.map(|photo| GreyPhoto::new(photo, table.seen_size()[0]));
    let print = PagePrint {
        traced: &traces.lines,
        photo: photo.as_ref(),
        view,
    };
    let (mut sheet, mut figures) =
        progress::part(0.4, || problem.with_lines(coarse.clone(), &starts, &print))?;
    let mut model = PageModel::Sheet;
    if traces.bent.is_some() {
        model = PageModel::Cylinder;
    } else if figures.lines > MAX_FIRM_LINE_MISFIT {
        let mut crumpled = problem.clone();
        crumpled.weights = CRUMPLED_PAPER_WEIGHTS;
        let found = progress::part(0.6, || crumpled.with_lines(sheet.clone(), &starts, &print));
        if let Some(found) = found {
            (sheet, figures) = found;
            (problem, model) = (crumpled, PageModel::SoftSheet);
        }
    }
    // A page that is curled in one direction explains edges and lines better than a sheet that is equally firm in both, and
    // better than one that may wrinkle: a strong curl is no crumple.
    let curled = (traces.bent.is_none()).then_some([BentEdges::TopBottom, BentEdges::LeftRight]);
    for (end, bent) in [0.8, 1.0].into_iter().zip(curled.into_iter().flatten()) {
        let mut ruled = problem.clone();
        ruled.weights = SheetWeights {
            bending: ruled_bending(bent),
            ..traces.firm_weights()
        };
        ruled.lines.clear();
        ruled.folds.clear();
        let own = progress::part(end, || ruled.curled_fit(&coarse, &starts, &print));
        let Some(own) = own else {
            continue;
        };
        if own.1.outline.hypot(own.1.lines) < figures.outline.hypot(figures.lines) {
            ((sheet, figures), problem, model) = (own, ruled, PageModel::Cylinder);
        }
    }
    // What unseen edges leave open counts in full for the error.
    let mut as_seen = problem.clone();
    as_seen.weights.outline = FIRM_PAPER_WEIGHTS.outline;
    as_seen.weights.corners = FIRM_PAPER_WEIGHTS.corners;
    let cost = as_seen.with_cost(sheet.clone())?.cost;
    let plane = (straight_corners(edges)).and_then(|straight| {
        let traced = corners(edges);
        let both = [0, 1, 2, 3].map(|k| [0, 1].map(|j| 0.5 * (traced[k][j] + straight[k][j])));
        plane(&problem, Homography::new(both)?, apparent)
    });
    if let Some((flat, own)) = plane
        && flat.cost < sheet.cost + MAX_PLANE_EXCESS_COST
    {
        (sheet, figures, model) = (flat, own, PageModel::Plane);
    }
    Some(FoundSheet {
        sheet,
        model,
        figures,
        cost,
        depth: problem.depth,
        count: problem.lines.len(),
        lines: (problem.lines.into_iter().skip(problem.traced))
            .map(|line| line.points)
            .collect(),
    })
}

impl SheetProblem {
    /// Fits a sheet on grids with the given numbers of columns, one after the other. None if the sheet is not in front
    /// of the camera.
    fn refined(&self, mut sheet: FittedSheet, grids: &[usize]) -> Option<FittedSheet> {
        for cols in grids {
            let rows = grid_rows(*cols, sheet.grid.ratio());
            sheet.grid = sheet.grid.resampled([*cols, rows]);
            sheet = self.solve(sheet)?;
        }
        Some(sheet)
    }

    /// Fits a page that is curled in one direction; returns it with its measures. None if it explains the edges worse than the
    /// coarse sheet `firm`, or is not in front of the camera.
    fn curled_fit(
        &mut self,
        firm: &FittedSheet,
        starts: &[FittedSheet],
        print: &PagePrint<'_>,
    ) -> Option<(FittedSheet, SheetFigures)> {
        let coarse = self.refined(firm.clone(), &COARSE_GRID_COLS)?;
        let coarse = self.with_lowest_cost(coarse, &starts[1..]);
        let explains = self.figures(&coarse)?.outline < self.figures(firm)?.outline;
        explains.then(|| self.with_lines(coarse, starts, print))?
    }

    /// Fits coarse sheets from the initial guesses `starts`, with the lines of print where `sheet` has them; returns that
    /// with the lowest cost, or `sheet` itself if its cost is not higher.
    fn with_lowest_cost(&self, sheet: FittedSheet, starts: &[FittedSheet]) -> FittedSheet {
        let levels = sheet.levels.clone();
        let fits = starts.iter().filter_map(|start| {
            let start = FittedSheet {
                levels: levels.clone(),
                ..start.clone()
            };
            self.refined(start, &COARSE_GRID_COLS)
        });
        fits.fold(
            sheet,
            |best, found| {
                if found.cost < best.cost { found } else { best }
            },
        )
    }

    /// Detects lines of print and folds in the photo as flattened by a sheet, fits the sheet on the fine grid to outline
    /// and lines, and repeats that; returns it with its measures. When lines are known, the search begins once more from the
    /// initial guesses `starts`, because the outline alone may have led to a local minimum.
    fn with_lines(
        &mut self,
        mut sheet: FittedSheet,
        starts: &[FittedSheet],
        print: &PagePrint<'_>,
    ) -> Option<(FittedSheet, SheetFigures)> {
        let PagePrint { photo, view, .. } = *print;
        for round in 0..LINE_DETECTION_ROUNDS {
            let table = PlaceTable::new(&sheet.grid, view).ok()?;
            self.lines = traced_level_lines(&table, view, print.traced);
            self.traced = self.lines.len();
            self.lines
                .extend(photo.map_or_else(Vec::new, |photo| find_level_lines(&table, view, photo)));
            self.folds = photo.map_or_else(Vec::new, |photo| {
                find_folds(&table, view, photo, sheet.cost)
            });
            sheet.levels = self.expected_levels();
            if round > 0
                && !self.lines.is_empty()
                && let Some(coarse) = self.refined(sheet.clone(), &COARSE_GRID_COLS[1..])
            {
                let cost = coarse.cost;
                let best = self.with_lowest_cost(coarse, starts);
                if best.cost < cost {
                    sheet = best;
                }
            }
            sheet = self.refined(sheet, &[FINE_GRID_COLS])?;
            progress::reach((round + 1) as f64 / LINE_DETECTION_ROUNDS as f64);
        }
        let figures = self.figures(&sheet)?;
        Some((sheet, figures))
    }
}

/// Makes a sheet in the plane of a homography, with the positions of the lines of print on it, and its misfits. None if it is not in front of the camera.
fn plane(
    problem: &SheetProblem,
    homography: Homography,
    apparent: f64,
) -> Option<(FittedSheet, SheetFigures)> {
    let grid = homography.sheet(FINE_GRID_COLS, &problem.prior, apparent)?;
    let sheet = problem.with_cost(problem.with_levels(&FittedSheet::new(grid))?)?;
    let figures = problem.figures(&sheet)?;
    Some((sheet, figures))
}

/// Corners at the ends of the upper and lower edge, clockwise from the upper left one.
fn corners([top, bottom, ..]: &[Polyline; 4]) -> [[f64; 2]; 4] {
    let ends = |edge: &Polyline| [edge.points()[0], edge.points()[edge.points().len() - 1]];
    let ([a, b], [d, c]) = (ends(top), ends(bottom));
    [a, b, c, d]
}

/// Corners where straight lines fitted to the edges intersect, clockwise from the upper left one. None if two lines are
/// parallel.
fn straight_corners(edges: &[Polyline; 4]) -> Option<[[f64; 2]; 4]> {
    let [top, bottom, left, right] = [0, 1, 2, 3].map(|k| edges[k].line());
    let meet = |one, other| line_intersection(one, other, 0.0);
    Some([
        meet(top, left)?,
        meet(top, right)?,
        meet(bottom, right)?,
        meet(bottom, left)?,
    ])
}

/// Ratio of height to width of the page as seen in the photo, along the chords of its edges.
fn apparent_ratio(edges: &[Polyline; 4]) -> f64 {
    let [a, b, c, d] = corners(edges);
    (distance(a, d) + distance(b, c)) / (distance(a, b) + distance(d, c))
}
