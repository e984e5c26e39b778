//! Least-squares problem of a sheet in space: a nearly isometric grid that bends little and meets a page's outline,
//! corners and lines in the photo.

use nalgebra::Vector3;

use super::grid::{GridPlace, SheetGrid};
use super::plane::CameraPrior;
use super::polyline::Polyline;
use crate::math::planar::difference;
use crate::page::robust_fit;

/// A line that runs across the flat page, parallel to its upper edge: a line of text, a rule or a fold.
#[derive(Debug, Clone)]
pub(super) struct LevelLine {
    /// Points of the line in the photo, in normalised image coordinates (pixels from the principal point, over the
    /// focal length).
    pub points: Vec<[f64; 2]>,
    /// Expected position of the line on the flat page: share of the page's height.
    pub level: f64,
    /// Standard deviation of the line's position, if its expected one is prior knowledge; None if it is only an initial
    /// guess.
    pub level_deviation: Option<f64>,
    /// Length of the line on the flat page, in widths of the page.
    pub length: f64,
}

/// Weights of the kinds of residuals in the fit of a sheet.
#[derive(Debug, Clone, Copy)]
pub(super) struct SheetWeights {
    pub isometry: f64,
    /// Stiffness against bending of lines across the page, and of lines down the page; twist has that of the stiffer ones. A
    /// page that is curled in one direction, a cylinder, is one that is stiff along its rulings.
    pub bending: [f64; 2],
    pub outline: f64,
    pub corners: f64,
    pub lines: f64,
}

/// Data of a sheet's least-squares problem: the page's edges and lines in the photo, prior knowledge, and weights.
#[derive(Debug, Clone)]
pub(super) struct SheetProblem {
    /// Upper, lower, left and right edge of the page in the photo, in normalised image coordinates (pixels from the
    /// principal point, over the focal length).
    pub edges: [Polyline; 4],
    /// Lines of print across the page; the first `traced` ones were traced by the caller.
    pub lines: Vec<LevelLine>,
    /// Number of the lines that were traced by the caller.
    pub traced: usize,
    /// Folds across the page, along which it bends freely.
    pub folds: Vec<LevelLine>,
    pub prior: CameraPrior,
    /// Expected logarithm of the page's height over its width, and its standard deviation.
    pub ratio: [f64; 2],
    /// Mean depth of the initial plane, in widths of the page: factor that converts normalised image distances to
    /// widths of the page.
    pub depth: f64,
    pub weights: SheetWeights,
}

/// One weighted residual of a sheet's least-squares problem with its derivatives.
#[derive(Debug, Clone)]
pub(super) struct ResidualRow {
    pub value: f64,
    /// Numbers of up to four nodes, each with the residual's gradient by the node's position.
    pub nodes: [(usize, Vector3<f64>); 4],
    /// Derivatives of the residual by the logarithm of the focal length, the principal point (2) and the logarithm of
    /// the page's height over its width.
    pub globals: [f64; 4],
    /// Number of a line of print, or of a fold, which are counted after these, and the derivative of the residual by this
    /// line's level; None if it depends on no line.
    pub level: Option<(usize, f64)>,
    /// Square root of the residual's robust weight, which is a factor of value and derivatives: 1, or less for an outlier.
    pub trust: f64,
}

/// Curvature, in reciprocal widths of the page, above which bending is penalised linearly instead of quadratically, so
/// that folds form.
/// Its row: `benches/page.md`, One rule at a time.
const FOLD_CURVATURE: f64 = 1.5;

/// Distance between border and outline, in widths of the page, above which a node is an outlier and counts less.
/// Its row: `benches/page.md`, Models.
const OUTLINE_OUTLIER_DISTANCE: f64 = 0.01;

/// Distance between a line's point and its line on the sheet, in widths of the page, above which the point is an
/// outlier and counts less.
/// Its row: `benches/page.md`, Models.
const LINE_OUTLIER_DISTANCE: f64 = 0.004;

impl ResidualRow {
    fn new(value: f64) -> Self {
        ResidualRow {
            value,
            nodes: [(0, Vector3::zeros()); 4],
            globals: [0.0; 4],
            level: None,
            trust: 1.0,
        }
    }

    /// Penalty of the residual in the robust fit: its square, and less for an outlier.
    pub fn penalty(&self) -> f64 {
        // Of a residual `r` times the threshold: 2 (√(1 + r²) − 1), where `value` is r (1 + r²)^(−1/4).
        self.value * self.value * 2.0 / (1.0 + self.trust * self.trust)
    }
}

impl SheetProblem {
    /// Expected levels of the lines of print and, after them, of the folds.
    pub fn expected_levels(&self) -> Vec<f64> {
        (self.lines.iter().chain(&self.folds))
            .map(|line| line.level)
            .collect()
    }

    /// Calls `sink` with each residual of a sheet whose lines of print, and after these folds, have the given levels. None if
    /// part of the sheet is not in front of the camera.
    pub fn visit(
        &self,
        grid: &SheetGrid,
        levels: &[f64],
        sink: &mut dyn FnMut(&ResidualRow),
    ) -> Option<()> {
        self.visit_isometry(grid, sink);
        self.visit_bending(grid, sink);
        self.visit_outline(grid, sink)?;
        let lines = self.lines.iter().chain(&self.folds);
        self.visit_lines(grid, lines.zip(levels), sink)?;
        let (prior, camera) = (&self.prior, &grid.camera);
        let priors = [
            (camera.log_scale, prior.scale_deviation),
            (camera.centre[0], prior.centre_deviation),
            (camera.centre[1], prior.centre_deviation),
            (grid.log_ratio - self.ratio[0], self.ratio[1]),
        ];
        for (k, (off, deviation)) in priors.into_iter().enumerate() {
            let mut row = ResidualRow::new(off / deviation);
            row.globals[k] = 1.0 / deviation;
            sink(&row);
        }
        Some(())
    }

    /// Mean side length of a cell of the sheet's grid on the flat page, in widths of the page.
    fn cell(grid: &SheetGrid) -> f64 {
        let [across, down] = grid.steps();
        (across * down).sqrt()
    }

    /// Calls `sink` with the isometry residuals: weighted strains of the edges and diagonals of the sheet's cells.
    pub fn visit_isometry(&self, grid: &SheetGrid, sink: &mut dyn FnMut(&ResidualRow)) {
        let [across, down] = grid.steps();
        let weight = self.weights.isometry * Self::cell(grid);
        let (cols, rows) = (grid.cols, grid.rows);
        for i in 0..cols * rows {
            let (right, below) = (i % cols + 1 < cols, i / cols + 1 < rows);
            let left = i % cols > 0;
            let pairs = [
                (right, i + 1, [across, 0.0]),
                (below, i + cols, [0.0, down]),
                (right && below, i + cols + 1, [across, down]),
                (left && below, i + cols - usize::from(left), [across, down]),
            ];
            for (_, j, [dx, dy]) in pairs.into_iter().filter(|pair| pair.0) {
                let way = grid.nodes[j] - grid.nodes[i];
                let flat = dx * dx + dy * dy;
                let squared = way.norm_squared() / flat;
                let mut row = ResidualRow::new(weight * 0.5 * (squared - 1.0));
                let gradient = way * (weight / flat);
                row.nodes[0] = (j, gradient);
                row.nodes[1] = (i, -gradient);
                row.globals[3] = -weight * squared * dy * dy / flat;
                sink(&row);
            }
        }
    }

    /// Calls `sink` with the bending residuals: second differences of the sheet's nodes, reweighted by their sizes so
    /// that large bends count linearly. Bending across a fold is free.
    pub fn visit_bending(&self, grid: &SheetGrid, sink: &mut dyn FnMut(&ResidualRow)) {
        let [across, down] = grid.steps();
        let [wide, high] = self.weights.bending.map(|weight| weight * Self::cell(grid));
        let (cols, rows) = (grid.cols, grid.rows);
        let mut stencil = |nodes: [(usize, f64); 4], factor: f64, weight: f64| {
            let sum: Vector3<f64> = nodes.iter().map(|(i, c)| grid.nodes[*i] * *c).sum();
            let second = sum * factor;
            let trust = robust_fit::weight(second.norm() / FOLD_CURVATURE).sqrt();
            let own = weight * trust * factor;
            for k in 0..3 {
                let mut row = ResidualRow::new(own * sum[k]);
                row.trust = trust;
                for (entry, (i, c)) in row.nodes.iter_mut().zip(nodes) {
                    entry.0 = i;
                    entry.1[k] = own * c;
                }
                sink(&row);
            }
        };
        let last = (rows - 1) as f64;
        let is_folded = |y: usize| {
            let mut distances = self.folds.iter().map(|fold| fold.level * last - y as f64);
            distances.any(|distance| distance.abs() < 1.0)
        };
        for i in 0..cols * rows {
            let (x, y) = (i % cols, i / cols);
            if x > 0 && x + 1 < cols {
                let nodes = [(i - 1, 1.0), (i, -2.0), (i + 1, 1.0), (i, 0.0)];
                stencil(nodes, 1.0 / (across * across), wide);
            }
            if y > 0 && y + 1 < rows && !is_folded(y) {
                let nodes = [(i - cols, 1.0), (i, -2.0), (i + cols, 1.0), (i, 0.0)];
                stencil(nodes, 1.0 / (down * down), high);
            }
            if x + 1 < cols && y + 1 < rows {
                let nodes = [
                    (i, 1.0),
                    (i + 1, -1.0),
                    (i + cols, -1.0),
                    (i + cols + 1, 1.0),
                ];
                let factor = std::f64::consts::SQRT_2 / (across * down);
                stencil(nodes, factor, wide.max(high));
            }
        }
    }

    /// Calls `sink` with the outline residuals: distances of the projected border nodes from the page's edges in the
    /// photo, and of the projected corners from the traced corners.
    pub fn visit_outline(
        &self,
        grid: &SheetGrid,
        sink: &mut dyn FnMut(&ResidualRow),
    ) -> Option<()> {
        let root = Self::cell(grid).sqrt() * self.depth;
        let (cols, rows) = (grid.cols, grid.rows);
        let last = cols * (rows - 1);
        let starts = [
            (0, 1, cols),
            (last, 1, cols),
            (0, cols, rows),
            (cols - 1, cols, rows),
        ];
        for ((start, step, count), edge) in starts.into_iter().zip(&self.edges) {
            for i in 0..count {
                let node = GridPlace::node(start + i * step);
                let near = edge.nearest(grid.seen(&node)?)?;
                if !edge.is_seen(near.position) {
                    continue;
                }
                let off = self.depth * near.distance / OUTLINE_OUTLIER_DISTANCE;
                let weight = self.weights.outline * root;
                sink(&photo_row(
                    grid,
                    &node,
                    near.normal,
                    [near.distance, weight, off],
                )?);
            }
        }
        let [top, bottom] = [0, 1].map(|k| self.edges[k].points());
        let corners = [
            (0, top[0]),
            (cols - 1, top[top.len() - 1]),
            (last, bottom[0]),
            (last + cols - 1, bottom[bottom.len() - 1]),
        ];
        for (node, corner) in corners {
            let node = GridPlace::node(node);
            let away = difference(corner, grid.seen(&node)?);
            let off = self.depth * away[0].hypot(away[1]) / OUTLINE_OUTLIER_DISTANCE;
            let weight = 2.0 * self.weights.corners * root;
            for (distance, normal) in away.into_iter().zip([[1.0, 0.0], [0.0, 1.0]]) {
                sink(&photo_row(grid, &node, normal, [distance, weight, off])?);
            }
        }
        Some(())
    }

    /// Calls `sink` with the residuals of lines, each with its level: distances of their points in the photo from the
    /// sheet's projected lines at these levels.
    pub fn visit_lines<'a>(
        &self,
        grid: &SheetGrid,
        lines: impl Iterator<Item = (&'a LevelLine, &'a f64)>,
        sink: &mut dyn FnMut(&ResidualRow),
    ) -> Option<()> {
        let last = (grid.cols - 1) as f64;
        for (number, (line, level)) in lines.enumerate() {
            if let Some(deviation) = line.level_deviation {
                let mut row = ResidualRow::new((level - line.level) / deviation);
                row.level = Some((number, 1.0 / deviation));
                sink(&row);
            }
            let seen: Option<Vec<_>> = (0..grid.cols)
                .map(|i| grid.seen(&grid.place([i as f64 / last, *level])))
                .collect();
            let seen = Polyline::new(seen?);
            let share = line.length / line.points.len() as f64;
            let weight = self.weights.lines * self.depth * share.sqrt();
            for point in &line.points {
                let near = seen.nearest(*point)?;
                let place = grid.place([near.position / last, *level]);
                // The projection is at the nearest point: its distance from the traced one has the other sign.
                let off = -self.depth * near.distance / LINE_OUTLIER_DISTANCE;
                let distance = [-near.distance, weight, off];
                let mut row = photo_row(grid, &place, near.normal, distance)?;
                let down = grid.sum(&place.nodes, &place.derivative_down);
                let gradient: Vector3<f64> = row.nodes.iter().map(|(_, gradient)| gradient).sum();
                row.level = Some((number, gradient.dot(&down)));
                sink(&row);
            }
        }
        Some(())
    }
}

/// Makes the residual of a place of the sheet in the photo: its distance along an image normal, times a weight, with
/// derivatives by nodes and camera. The third number, in distances from which a place is an outlier, says how much less it counts.
/// None if the place is not in front of the camera.
fn photo_row(
    grid: &SheetGrid,
    place: &GridPlace,
    [nx, ny]: [f64; 2],
    [distance, weight, off]: [f64; 3],
) -> Option<ResidualRow> {
    let trust = robust_fit::weight(off).sqrt();
    let own = weight * trust;
    let mut row = ResidualRow::new(own * distance);
    row.trust = trust;
    let at = grid.sum(&place.nodes, &place.weights);
    let gradient = grid.camera.gradient(at, [nx, ny]) * own;
    row.nodes = std::array::from_fn(|k| (place.nodes[k], gradient * place.weights[k]));
    let seen = difference(grid.camera.centre, grid.camera.project(at)?);
    row.globals = [nx * seen[0] + ny * seen[1], nx, ny, 0.0].map(|d| d * own);
    Some(row)
}
