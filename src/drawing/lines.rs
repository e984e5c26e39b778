//! The outlines and folds of one sheet as smooth curves in millimetres, before the sheet is placed in the drawing.

use super::circle::with_arcs;
use super::curve::Curve;
use super::line::Line;
use super::options::DrawingOptions;
use super::smooth::curve_through;
use crate::pattern::{Run, Sheet};

/// Maximum distance of a drawn curve from the line that was laid flat, in mean edge lengths of the mesh that was cut.
const CURVE_TOLERANCE_LENGTHS: f64 = 0.05;

/// The outlines and folds of one sheet as smooth curves in millimetres, before the sheet is placed in the drawing.
pub(super) struct Lines<'a> {
    pub outlines: Vec<Vec<(&'a Run, Curve)>>,
    pub folds: Vec<Line>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(sheet: &'a Sheet, options: &DrawingOptions) -> Self {
        let curve = |points: &[[f64; 2]]| {
            let curve = match sheet.exact {
                true => with_arcs(points, f64::INFINITY),
                false => curve_through(points, CURVE_TOLERANCE_LENGTHS * sheet.spacing),
            };
            curve.mapped(|p| p.map(|v| options.scale * v))
        };
        let runs = |outline: &'a Vec<Run>| {
            let runs = outline.iter();
            runs.map(|run| (run, curve(&run.points))).collect()
        };
        let folds = sheet.folds.iter().filter(|fold| fold.is_made());
        Lines {
            outlines: sheet.outlines.iter().map(runs).collect(),
            folds: folds
                .map(|fold| Line::of_fold(fold, curve(&fold.points), options))
                .collect(),
        }
    }
}
