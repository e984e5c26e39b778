//! The outlines and folds of one sheet as smooth curves in millimetres, before the sheet is placed in the drawing.

use super::circle::with_arcs;
use super::curve::Curve;
use super::line::Line;
use super::options::DrawingOptions;
use super::smooth::curve_through;
use crate::pattern::{Run, Sheet};

/// Maximum distance of a drawn curve from the line that was laid flat, in mean edge lengths of the mesh that was cut.
const CURVE_TOLERANCE_LENGTHS: f64 = 0.05;

/// Maximum distance of a drawn curve from that line in millimetres, which is about what scissors and knives keep to: the edges of CAD are
/// long, and of a slit whose sides are nearer to each other one side was drawn across the other (`benches/patterns.md`, Curves).
const MAX_CURVE_DISTANCE_MM: f64 = 0.1;

/// The outlines and folds of one sheet as smooth curves in millimetres, before the sheet is placed in the drawing.
pub(super) struct Lines<'a> {
    pub outlines: Vec<Vec<(&'a Run, Curve)>>,
    pub folds: Vec<Line>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(sheet: &'a Sheet, options: &DrawingOptions) -> Self {
        let tolerance = f64::min(
            CURVE_TOLERANCE_LENGTHS * sheet.spacing,
            MAX_CURVE_DISTANCE_MM / options.scale,
        );
        let curve = |points: &[[f64; 2]]| {
            let curve = match sheet.exact {
                true => with_arcs(points, f64::INFINITY),
                false => curve_through(points, tolerance),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::heights::heightfield::Heightfield;
    use crate::lattice::hexagonal::Lattice;
    use crate::math::planar::{distance, nearest_on_segment};
    use crate::pattern::{PatternOptions, pattern};
    use crate::shape::patches::{PatchOptions, Patches};

    /// A cone that is drawn small and so large that its edges are 30 mm long.
    #[test]
    fn curves_keep_to_a_tenth_of_a_millimetre_however_long_the_edges_are() {
        let cone = |x: f64, y: f64| 0.8 - 0.6 * (x - 0.5).hypot(y - 0.5);
        let field = Heightfield::from_fn(Lattice::new(30, 30, 1.0 / 30.0).unwrap(), cone).unwrap();
        let patches = Patches::new(&field, &PatchOptions::default()).unwrap();
        let sheets = pattern(&field, &patches, &PatternOptions::default())
            .unwrap()
            .sheets;
        for scale in [10.0, 1000.0] {
            let options = DrawingOptions::default().scale(scale);
            let limit =
                MAX_CURVE_DISTANCE_MM.min(CURVE_TOLERANCE_LENGTHS * scale * sheets[0].spacing);
            let mut off = 0.0f64;
            for lines in sheets.iter().map(|sheet| Lines::new(sheet, &options)) {
                for (run, curve) in lines.outlines.iter().flatten() {
                    let line: Vec<[f64; 2]> =
                        run.points.iter().map(|p| p.map(|v| scale * v)).collect();
                    for place in curve.points(1e-3) {
                        let away = |pair: &[[f64; 2]]| {
                            distance(place, nearest_on_segment(place, [pair[0], pair[1]]))
                        };
                        off = line.windows(2).map(away).fold(f64::MAX, f64::min).max(off);
                    }
                }
            }
            assert!(off < 1.1 * limit, "{scale}: {off} mm of {limit}");
        }
    }
}
