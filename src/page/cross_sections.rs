//! Lines of text and straight edges as cross-sections and rulings, which check a page's bent edges.
//!
//! A line of text is level on the flat page, so it is a further cross-section where the edges above
//! and below the text are bent, and a ruling where those beside it are. Its level is not known, and
//! the print may be rotated a little on the page. The straight edges are the first and the last
//! ruling.

use nalgebra::{DMatrix, DVector};

use super::corners::check_on_page;
use super::cylinder::{Cylinder, DIFFERENCE_STEP};
use super::prior::Prior;
use super::residual_statistics::ResidualStatistics;
use super::robust_fit;
use super::traced_line::{TracedLine, TracedPage};
use crate::error::{Error, Result};

/// A line of text or a straight edge of a page, traced in the photo: a cross-section or a ruling of the page's
/// cylinder.
#[derive(Debug, Clone)]
struct CrossSection {
    page: usize,
    /// Whether the line is a ruling of the cylinder (straight in space); otherwise it is a cross-section (bent like the
    /// edges).
    ruling: bool,
    /// Known position of a straight edge across itself, as a share of the page's width; None for a line of text, whose
    /// position is estimated from its points.
    level: Option<f64>,
    /// Whether the line is text that was detected in the photo, not traced by the caller.
    found: bool,
    points: Vec<[f64; 2]>,
    weight: f64,
}

/// Lines of text and straight edges of all pages of a photo, as observations for the cylinder's least-squares fit.
#[derive(Debug, Clone, Default)]
pub(super) struct CrossSections {
    list: Vec<CrossSection>,
    /// Number of lines of text: those that the caller traced and those that were detected, together.
    pub text: usize,
}

/// Distances between one line of text (or straight edge) as traced and as the cylinder predicts it.
#[derive(Debug, Clone)]
pub(super) struct LineResiduals {
    points: Vec<PointResidual>,
    /// Position across the line, in widths of the first page, at which the line lies on the flat page.
    level: f64,
}

#[derive(Debug, Clone, Copy)]
struct PointResidual {
    /// Distance of the point from its line, across the line, in pixels of the photo.
    pixels: f64,
    /// Position of the point along its line, in widths of the first page.
    along: f64,
    /// Pixels of the photo per unit of length on the page, in the direction across the line.
    scale: f64,
    /// Robust weight of the point: 1, or less for an outlier.
    trust: f64,
}

/// A traced point's position on the flat page, and its coordinate across its line; both in widths of the first page.
type LinePoint = ([f64; 2], f64);

/// Maximum number of traced lines of text in one photo; more are an error.
const MAX_TEXT_LINES: usize = 500;

/// Maximum number of points of one traced line of text, or straight edge, to which the page's cylinder is fitted.
const MAX_POINTS_PER_LINE: usize = 24;

/// Maximum number of points of all traced lines of text together to which the page's cylinder is fitted.
const MAX_TEXT_POINTS: usize = 800;

/// Maximum number of points of one line of text detected in the photo to which the page's cylinder is fitted. Fewer
/// than of a traced line, for they are more exact.
const MAX_POINTS_PER_FOUND_LINE: usize = 12;

/// Maximum number of points of all lines of text detected in the photo together to which the page's cylinder is fitted.
const MAX_FOUND_POINTS: usize = 400;

/// Maximum number of independent points that one line of text counts as: errors of tracing are correlated along a line.
const MAX_INDEPENDENT_POINTS: f64 = 8.0;

impl CrossSections {
    /// Collects the lines of text and straight edges of all pages, thinned to the maximum number of points. `sideways`
    /// says that the left and right edges are bent, so that lines of text are rulings.
    ///
    /// # Errors
    /// [`Error::Edges`] for lines beside the page, [`Error::TooLarge`] for too many lines.
    pub fn new(pages: &[TracedPage], sideways: bool) -> Result<Self> {
        let text: usize = pages.iter().map(|page| page.text.len()).sum();
        if text > MAX_TEXT_LINES {
            return Err(Error::TooLarge {
                what: "list of lines of text",
                requested: text,
                limit: MAX_TEXT_LINES,
            });
        }
        let found: usize = pages.iter().map(|page| page.found.len()).sum();
        let each = MAX_POINTS_PER_LINE.min((MAX_TEXT_POINTS / text.max(1)).max(2));
        let each_found = MAX_POINTS_PER_FOUND_LINE.min((MAX_FOUND_POINTS / found.max(1)).max(3));
        let mut list = Vec::new();
        for (page, traced) in pages.iter().enumerate() {
            for (number, line) in traced.text.iter().enumerate() {
                let cross = CrossSection::new(line, page, each);
                check_on_page(&traced.pair, &cross.points, number)?;
                list.push(CrossSection {
                    ruling: sideways,
                    ..cross
                });
            }
            for line in &traced.found {
                list.push(CrossSection {
                    ruling: sideways,
                    found: true,
                    ..CrossSection::new(line, page, each_found)
                });
            }
            for (line, level) in traced.sides.iter().flatten().zip([0.0, 1.0]) {
                list.push(CrossSection {
                    ruling: true,
                    level: Some(level),
                    ..CrossSection::new(line, page, MAX_POINTS_PER_LINE)
                });
            }
        }
        Ok(CrossSections {
            list,
            text: text + found,
        })
    }

    /// Number of independent distances of all lines: the sum of their points' weights, less one for each line whose
    /// position is estimated.
    pub fn count(&self) -> f64 {
        let own = |cross: &CrossSection| {
            cross.weight * cross.points.len() as f64 - f64::from(u8::from(cross.level.is_none()))
        };
        self.list.iter().map(own).sum()
    }

    /// Number of points of all lines: the rows that they take in the Jacobian of the least-squares problem.
    pub fn rows(&self) -> usize {
        self.list.iter().map(|cross| cross.points.len()).sum()
    }

    /// Computes the residuals of all lines on a cylinder, and the sum of their Huber penalties. None if a part of the
    /// page is not in front of the camera.
    pub fn residuals(
        &self,
        cylinder: &Cylinder,
        prior: &Prior,
    ) -> Option<(Vec<LineResiduals>, f64)> {
        let curve = cylinder.curve();
        let mut found = Vec::with_capacity(self.list.len());
        let mut cost = 0.0;
        for (cross, raw) in self.list.iter().zip(self.line_points(cylinder)?) {
            let mut points = Vec::with_capacity(raw.len());
            for ([along, down], _) in &raw {
                let width = cylinder.pages[cross.page].width;
                let seen =
                    |x: f64, y: f64| cylinder.project(curve.at_extended(cross.page, x / width), y);
                let by = |dx: f64, dy: f64| -> Option<[f64; 2]> {
                    let [p, q] = [seen(along + dx, down + dy)?, seen(along - dx, down - dy)?];
                    Some([0, 1].map(|k| (p[k] - q[k]) / (2.0 * DIFFERENCE_STEP)))
                };
                let (mut way, mut across) = (by(DIFFERENCE_STEP, 0.0)?, by(0.0, DIFFERENCE_STEP)?);
                if cross.ruling {
                    (way, across) = (across, way);
                }
                let area = way[0] * across[1] - way[1] * across[0];
                points.push(PointResidual {
                    pixels: 0.0,
                    along: if cross.ruling { *down } else { *along },
                    scale: area.abs() / way[0].hypot(way[1]),
                    trust: 1.0,
                });
            }
            // The level by iteratively reweighted least squares.
            let passes = if cross.level.is_some() { 1 } else { 3 };
            let mut level = 0.0;
            for _ in 0..passes {
                level = match cross.level {
                    Some(share) => share * cylinder.pages[cross.page].width,
                    None => weighted_mean(&points, raw.iter().map(|(_, value)| *value)),
                };
                for (point, (_, value)) in points.iter_mut().zip(&raw) {
                    point.pixels = (value - level) * point.scale;
                    let size = point.pixels.abs() / prior.accuracy;
                    point.trust = robust_fit::weight(size / robust_fit::OUTLIER_DEVIATIONS);
                }
            }
            cost += (points.iter())
                .map(|point| {
                    cross.weight * robust_fit::outlier_penalty(point.pixels / prior.accuracy)
                })
                .sum::<f64>();
            found.push(LineResiduals { points, level });
        }
        cost.is_finite().then_some((found, cost))
    }

    /// Back-projects the points of each line from the photo to a cylinder. None if a line of sight does not meet the
    /// cylinder.
    fn line_points(&self, cylinder: &Cylinder) -> Option<Vec<Vec<LinePoint>>> {
        let curve = cylinder.curve();
        (self.list.iter())
            .map(|cross| {
                let skew = match cross.level {
                    None => cylinder.skews.get(cross.page).copied().unwrap_or(0.0),
                    Some(_) => 0.0,
                };
                (cross.points.iter())
                    .map(|p| {
                        let place = cylinder.back_project(&curve, cross.page, *p)?;
                        let [along, down] = place;
                        let value = if cross.ruling {
                            along + skew * down
                        } else {
                            down - skew * along
                        };
                        Some((place, value))
                    })
                    .collect()
            })
            .collect()
    }

    /// Writes one column of the Jacobian, from row `first` on: the derivatives of all weighted residuals by one
    /// parameter. The cylinders `plus` and `minus` are those with this parameter raised and lowered. Estimated
    /// positions of lines change with the points.
    pub fn write_derivatives(
        &self,
        first: usize,
        off: &[LineResiduals],
        [plus, minus]: [&Cylinder; 2],
        prior: &Prior,
        mut write: impl FnMut(usize, f64),
    ) -> Option<()> {
        let (plus_raw, minus_raw) = (self.line_points(plus)?, self.line_points(minus)?);
        let mut row = first;
        for (((cross, own), p), m) in self.list.iter().zip(off).zip(plus_raw).zip(minus_raw) {
            let level = |of: &Cylinder| {
                (cross.level).map_or(0.0, |share| share * of.pages[cross.page].width)
            };
            let fixed = level(plus) - level(minus);
            let changes: Vec<f64> = (p.iter().zip(&m))
                .map(|((_, p), (_, m))| (p - m - fixed) / (2.0 * DIFFERENCE_STEP))
                .collect();
            let shift = match cross.level {
                Some(_) => 0.0,
                None => weighted_mean(&own.points, changes.iter().copied()),
            };
            for (change, point) in changes.iter().zip(&own.points) {
                let factor = (cross.weight * point.trust).sqrt() / prior.accuracy;
                write(row, -factor * point.scale * (change - shift));
                row += 1;
            }
        }
        Some(())
    }

    /// Writes the weighted residuals of all lines into `values`, from row `first` on, in the order of
    /// [`CrossSections::write_derivatives`].
    pub fn write_residuals(
        &self,
        first: usize,
        off: &[LineResiduals],
        prior: &Prior,
        values: &mut DVector<f64>,
    ) {
        let mut row = first;
        for (cross, own) in self.list.iter().zip(off) {
            for point in &own.points {
                values[row] = (cross.weight * point.trust).sqrt() / prior.accuracy * point.pixels;
                row += 1;
            }
        }
    }

    /// Writes the derivatives of all weighted residuals by the two coordinates of the principal point into the first
    /// two columns of `matrix`, from row `first` on.
    pub fn principal_point_jacobian(
        &self,
        first: usize,
        off: &[LineResiduals],
        cylinder: &Cylinder,
        prior: &Prior,
        matrix: &mut DMatrix<f64>,
    ) -> Option<()> {
        for k in 0..2 {
            // The principal point is in pixels, so its step is a share of the focal length.
            let focal = cylinder.focal;
            let moved = [1.0, -1.0].map(|sign| {
                let mut moved = cylinder.clone();
                moved.centre[k] += sign * DIFFERENCE_STEP * focal;
                moved
            });
            let [plus, minus] = &moved;
            self.write_derivatives(first, off, [plus, minus], prior, |row, value| {
                matrix[(row, k)] = value / focal;
            })?;
        }
        Some(())
    }

    /// Returns the weighted sum of squares of the residuals of all lines' points, in pixels².
    pub fn squares(&self, off: &[LineResiduals]) -> f64 {
        (self.list.iter().zip(off))
            .map(|(cross, own)| {
                cross.weight * own.points.iter().map(|p| p.pixels * p.pixels).sum::<f64>()
            })
            .sum()
    }

    /// Returns residual statistics for each line, in three lists: straight edges, traced lines of text, detected lines
    /// of text.
    pub fn statistics(&self, off: &[LineResiduals]) -> [Vec<ResidualStatistics>; 3] {
        let mut found = [const { Vec::new() }; 3];
        for (cross, own) in self.list.iter().zip(off) {
            let pixels: Vec<f64> = own.points.iter().map(|point| point.pixels).collect();
            let count = cross.weight * pixels.len() as f64;
            let kind = usize::from(cross.level.is_none()) + usize::from(cross.found);
            found[kind].push(ResidualStatistics::new(&pixels, count));
        }
        found
    }

    /// Covariance of the residuals of neighbouring lines of text at equal positions along them, in pixels², and the
    /// number of independent points in the estimate. Errors of tracing are independent from line to line; errors of the
    /// model are not.
    pub fn covariance(&self, off: &[LineResiduals]) -> (f64, f64) {
        /// Maximum number of lines of other columns that are passed over in the search for the next line below in one
        /// column.
        const MAX_LINES_BETWEEN: usize = 6;
        let (mut sum, mut points, mut count) = (0.0, 0.0, 0.0);
        let mut order: Vec<usize> = (0..off.len())
            .filter(|i| self.list[*i].level.is_none())
            .collect();
        order.sort_by(|i, j| {
            let key = |i: usize| (self.list[i].page, off[i].level);
            let ((p, x), (q, y)) = (key(*i), key(*j));
            p.cmp(&q).then(x.total_cmp(&y))
        });
        for (i, one) in order.iter().enumerate() {
            // The next line below in the same column.
            let below = (order[i + 1..].iter().take(MAX_LINES_BETWEEN))
                .filter(|other| self.list[**other].page == self.list[*one].page)
                .map(|other| -> Vec<f64> {
                    let own = off[*one].points.iter();
                    own.filter_map(|p| Some(p.pixels * off[*other].at(p.along)?))
                        .collect()
                })
                .find(|products| !products.is_empty());
            if let Some(products) = below {
                sum += products.iter().sum::<f64>();
                points += products.len() as f64;
                count += self.list[*one].weight * products.len() as f64;
            }
        }
        if count > 0.0 {
            (sum / points, count)
        } else {
            (0.0, 0.0)
        }
    }

    /// Maximum distance in the photo, in pixels, of each cross-section's points from the chord between the
    /// cross-section's ends.
    pub fn bows(&self) -> Vec<f64> {
        (self.list.iter())
            .filter(|cross| !cross.ruling)
            .map(|cross| {
                let [from, to] = [cross.points[0], cross.points[cross.points.len() - 1]];
                let way = [to[0] - from[0], to[1] - from[1]];
                let length = way[0].hypot(way[1]);
                (cross.points.iter())
                    .map(|p| (way[0] * (p[1] - from[1]) - way[1] * (p[0] - from[0])).abs() / length)
                    .fold(0.0, f64::max)
            })
            .collect()
    }
}

impl LineResiduals {
    /// Interpolates the residuals of a line's points linearly: the residual, in pixels, at position `along`, in widths
    /// of the first page. None beyond the line's ends.
    fn at(&self, along: f64) -> Option<f64> {
        self.points.windows(2).find_map(|pair| {
            let (from, to) = (pair[0], pair[1]);
            let share = (along - from.along) / (to.along - from.along);
            (0.0..=1.0)
                .contains(&share)
                .then_some(from.pixels + share * (to.pixels - from.pixels))
        })
    }
}

impl CrossSection {
    /// Makes a cross-section of a traced line, thinned to at most `most` points.
    fn new(line: &TracedLine, page: usize, most: usize) -> Self {
        let last = line.points.len() - 1;
        let step = last.div_ceil(most - 1).max(1);
        let mut points: Vec<_> = (line.points[..last].iter().copied())
            .step_by(step)
            .collect();
        points.push(line.points[last]);
        let weight = (line.independent.min(MAX_INDEPENDENT_POINTS) / points.len() as f64).min(1.0);
        CrossSection {
            page,
            ruling: false,
            level: None,
            found: false,
            points,
            weight,
        }
    }
}

/// Estimates the position of a line across itself: the mean of its points' coordinates `values`, weighted by Huber
/// weight and squared scale.
fn weighted_mean(points: &[PointResidual], values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for (point, value) in points.iter().zip(values) {
        let weight = point.trust * point.scale * point.scale;
        sum += weight * value;
        weights += weight;
    }
    sum / weights
}
