//! The outlines and folds of one sheet as smooth curves in millimetres, before the sheet is placed in the drawing.

use super::circle::with_arcs;
use super::curve::Curve;
use super::line::Line;
use super::options::DrawingOptions;
use super::smooth::{Smooth, smooth_lines};
use crate::pattern::{Run, Sheet};

/// The outlines and folds of one sheet as smooth curves in millimetres, before the sheet is placed in the drawing.
pub(super) struct Lines<'a> {
    pub outlines: Vec<Vec<(&'a Run, Curve)>>,
    pub folds: Vec<Line>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(sheet: &'a Sheet, options: &DrawingOptions) -> Self {
        let scaled = |curve: &Curve| curve.mapped(|p| p.map(|v| options.scale * v));
        let smooth = match sheet.exact {
            true => Smooth {
                outlines: (sheet.outlines.iter())
                    .map(|outline| outline.iter().map(|run| with_arcs(&run.points)).collect())
                    .collect(),
                folds: sheet
                    .folds
                    .iter()
                    .map(|fold| Curve::through(&fold.points))
                    .collect(),
            },
            false => smooth_lines(sheet, options.smoothing),
        };
        let runs = |(outline, curves): (&'a Vec<Run>, &Vec<Curve>)| {
            outline.iter().zip(curves.iter().map(scaled)).collect()
        };
        let folds = sheet.folds.iter().zip(&smooth.folds);
        Lines {
            outlines: sheet
                .outlines
                .iter()
                .zip(&smooth.outlines)
                .map(runs)
                .collect(),
            folds: folds
                .filter(|(fold, _)| fold.is_made())
                .map(|(fold, curve)| Line::of_fold(fold, scaled(curve), options))
                .collect(),
        }
    }
}
