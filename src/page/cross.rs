//! What checks a page's bent edges: lines of text, and its straight edges.
//!
//! A line of text is level on the flat page, so it is a further cross-section where the edges above
//! and below the text are bent, and a ruling where those beside it are. Its level is not known, and
//! the print may be turned a little on the page. The straight edges are the first and the last
//! ruling.

use nalgebra::{DMatrix, DVector};

use super::cylinder::{Cylinder, DIFFERENCE_STEP};
use super::huber::{huber_cost, huber_weight};
use super::line::{Line, Traced};
use super::misfit::Misfit;
use super::prior::Prior;
use crate::error::{Error, Result};

/// A line of text, or a straight edge.
#[derive(Debug, Clone)]
struct Cross {
    page: usize,
    /// Whether it is a ruling, and not a cross-section.
    ruling: bool,
    /// Where it is, as a share of the page; of text that is open.
    level: Option<f64>,
    /// Whether it is text that was found, not traced by anybody.
    found: bool,
    points: Vec<[f64; 2]>,
    weight: f64,
}

/// All of them.
#[derive(Debug, Clone, Default)]
pub(super) struct Crosses {
    list: Vec<Cross>,
    /// Whether there are lines of text.
    pub text: usize,
}

/// One of them on a cylinder: its points' distances from their line.
#[derive(Debug, Clone)]
pub(super) struct Off {
    points: Vec<Distance>,
    /// Where it is on the page.
    level: f64,
}

#[derive(Debug, Clone, Copy)]
struct Distance {
    /// In pixels, across the line.
    pixels: f64,
    /// Where on the line.
    along: f64,
    /// Pixels for a unit of length on the page.
    scale: f64,
    /// What the weight of an outlier comes down to.
    trust: f64,
}

/// A point's place on the page, and its coordinate across its line.
type Raw = ([f64; 2], f64);

/// Most lines of text.
const MOST: usize = 500;

/// Points of a line that are looked at, at most, and of all.
const EACH: usize = 24;
const ALL: usize = 800;

/// The same of text that was found: it lies nearer to its line than what a hand traces.
const EACH_FOUND: usize = 12;
const ALL_FOUND: usize = 400;

/// Most independent points that the errors of tracing one are taken for.
const INDEPENDENT: f64 = 8.0;

/// How far beside the page a line may be traced, as a share of the page's edge.
const BESIDE: f64 = 0.03;

impl Crosses {
    /// # Errors
    /// [`Error::Edges`] for lines beside the page.
    pub fn new(pages: &[Traced], sideways: bool) -> Result<Self> {
        let text: usize = pages.iter().map(|page| page.text.len()).sum();
        if text > MOST {
            return Err(Error::TooLarge {
                what: "list of lines of text",
                requested: text,
                limit: MOST,
            });
        }
        let found: usize = pages.iter().map(|page| page.found.len()).sum();
        let each = EACH.min((ALL / text.max(1)).max(2));
        let each_found = EACH_FOUND.min((ALL_FOUND / found.max(1)).max(3));
        let mut list = Vec::new();
        for (page, traced) in pages.iter().enumerate() {
            for (number, line) in traced.text.iter().enumerate() {
                let cross = Cross::new(line, page, each);
                beside(&traced.pair, &cross.points, number)?;
                list.push(Cross {
                    ruling: sideways,
                    ..cross
                });
            }
            for line in &traced.found {
                list.push(Cross {
                    ruling: sideways,
                    found: true,
                    ..Cross::new(line, page, each_found)
                });
            }
            for (line, level) in traced.sides.iter().flatten().zip([0.0, 1.0]) {
                list.push(Cross {
                    ruling: true,
                    level: Some(level),
                    ..Cross::new(line, page, EACH)
                });
            }
        }
        Ok(Crosses {
            list,
            text: text + found,
        })
    }

    /// How many distances count, by their weights.
    pub fn count(&self) -> f64 {
        let own = |cross: &Cross| {
            cross.weight * cross.points.len() as f64 - f64::from(u8::from(cross.level.is_none()))
        };
        self.list.iter().map(own).sum()
    }

    /// Rows in the matrix of derivatives.
    pub fn rows(&self) -> usize {
        self.list.iter().map(|cross| cross.points.len()).sum()
    }

    /// Distances, and what they add to the cost.
    pub fn distances(&self, cylinder: &Cylinder, prior: &Prior) -> Option<(Vec<Off>, f64)> {
        let curve = cylinder.curve();
        let mut found = Vec::with_capacity(self.list.len());
        let mut cost = 0.0;
        for (cross, raw) in self.list.iter().zip(self.raw(cylinder)?) {
            let mut points = Vec::with_capacity(raw.len());
            for ([along, down], _) in &raw {
                let width = cylinder.pages[cross.page].width;
                let seen = |x: f64, y: f64| cylinder.seen(curve.straight(cross.page, x / width), y);
                let by = |dx: f64, dy: f64| -> Option<[f64; 2]> {
                    let [p, q] = [seen(along + dx, down + dy)?, seen(along - dx, down - dy)?];
                    Some([0, 1].map(|k| (p[k] - q[k]) / (2.0 * DIFFERENCE_STEP)))
                };
                let (mut way, mut across) = (by(DIFFERENCE_STEP, 0.0)?, by(0.0, DIFFERENCE_STEP)?);
                if cross.ruling {
                    (way, across) = (across, way);
                }
                let area = way[0] * across[1] - way[1] * across[0];
                points.push(Distance {
                    pixels: 0.0,
                    along: if cross.ruling { *down } else { *along },
                    scale: area.abs() / way[0].hypot(way[1]),
                    trust: 1.0,
                });
            }
            // The level that suits most of the points.
            let passes = if cross.level.is_some() { 1 } else { 3 };
            let mut level = 0.0;
            for _ in 0..passes {
                level = match cross.level {
                    Some(share) => share * cylinder.pages[cross.page].width,
                    None => mean(&points, raw.iter().map(|(_, value)| *value)),
                };
                for (point, (_, value)) in points.iter_mut().zip(&raw) {
                    point.pixels = (value - level) * point.scale;
                    let size = point.pixels.abs() / prior.accuracy;
                    point.trust = huber_weight(size);
                }
            }
            cost += (points.iter())
                .map(|point| cross.weight * huber_cost(point.pixels.abs() / prior.accuracy))
                .sum::<f64>();
            found.push(Off { points, level });
        }
        cost.is_finite().then_some((found, cost))
    }

    /// What they are on a cylinder, line by line.
    fn raw(&self, cylinder: &Cylinder) -> Option<Vec<Vec<Raw>>> {
        let curve = cylinder.curve();
        (self.list.iter())
            .map(|cross| {
                let skew = match cross.level {
                    None => cylinder.skews.get(cross.page).copied().unwrap_or(0.0),
                    Some(_) => 0.0,
                };
                (cross.points.iter())
                    .map(|p| {
                        let place = cylinder.place(&curve, cross.page, *p)?;
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

    /// Writes the rows of the matrix from `first` on: derivatives by the column's parameter, of which
    /// `plus` and `minus` are half a step away; an open level follows.
    pub fn column(
        &self,
        first: usize,
        off: &[Off],
        [plus, minus]: [&Cylinder; 2],
        prior: &Prior,
        mut write: impl FnMut(usize, f64),
    ) -> Option<()> {
        let (plus_raw, minus_raw) = (self.raw(plus)?, self.raw(minus)?);
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
                None => mean(&own.points, changes.iter().copied()),
            };
            for (change, point) in changes.iter().zip(&own.points) {
                let factor = (cross.weight * point.trust).sqrt() / prior.accuracy;
                write(row, -factor * point.scale * (change - shift));
                row += 1;
            }
        }
        Some(())
    }

    /// The weighted distances, as [`Crosses::column`] has their derivatives.
    pub fn values(&self, first: usize, off: &[Off], prior: &Prior, values: &mut DVector<f64>) {
        let mut row = first;
        for (cross, own) in self.list.iter().zip(off) {
            for point in &own.points {
                values[row] = (cross.weight * point.trust).sqrt() / prior.accuracy * point.pixels;
                row += 1;
            }
        }
    }

    /// Derivatives by the principal point.
    pub fn shifted(
        &self,
        first: usize,
        off: &[Off],
        cylinder: &Cylinder,
        prior: &Prior,
        matrix: &mut DMatrix<f64>,
    ) -> Option<()> {
        for k in 0..2 {
            // In pixels, of which a step as of other parameters is too small.
            let focal = cylinder.focal;
            let moved = [1.0, -1.0].map(|sign| {
                let mut moved = cylinder.clone();
                moved.centre[k] += sign * DIFFERENCE_STEP * focal;
                moved
            });
            let [plus, minus] = &moved;
            self.column(first, off, [plus, minus], prior, |row, value| {
                matrix[(row, k)] = value / focal;
            })?;
        }
        Some(())
    }

    /// The weighted sum of squares of the distances, in pixels².
    pub fn squares(&self, off: &[Off]) -> f64 {
        (self.list.iter().zip(off))
            .map(|(cross, own)| {
                cross.weight * own.points.iter().map(|p| p.pixels * p.pixels).sum::<f64>()
            })
            .sum()
    }

    /// How the distances are spread along each straight edge, along each line of text that was given, and along
    /// each that was found.
    pub fn misfits(&self, off: &[Off]) -> [Vec<Misfit>; 3] {
        let mut found = [const { Vec::new() }; 3];
        for (cross, own) in self.list.iter().zip(off) {
            let pixels: Vec<f64> = own.points.iter().map(|point| point.pixels).collect();
            let count = cross.weight * pixels.len() as f64;
            let kind = usize::from(cross.level.is_none()) + usize::from(cross.found);
            found[kind].push(Misfit::new(&pixels, count));
        }
        found
    }

    /// The mean product of the distances of neighbouring lines of text at the same places, in pixels²,
    /// and over how many: what lines have in common is no error of tracing them.
    pub fn common(&self, off: &[Off]) -> (f64, f64) {
        /// So many lines may stand between, in columns beside.
        const COLUMNS: usize = 6;
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
            // The next one below in the same column.
            let below = (order[i + 1..].iter().take(COLUMNS))
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

    /// How far from straight those are seen that are cross-sections, in pixels, by their points.
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

impl Off {
    /// The distance at a place along the line, in pixels.
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

impl Cross {
    fn new(line: &Line, page: usize, most: usize) -> Self {
        let last = line.points.len() - 1;
        let step = last.div_ceil(most - 1).max(1);
        let mut points: Vec<_> = (line.points[..last].iter().copied())
            .step_by(step)
            .collect();
        points.push(line.points[last]);
        let weight = (line.independent.min(INDEPENDENT) / points.len() as f64).min(1.0);
        Cross {
            page,
            ruling: false,
            level: None,
            found: false,
            points,
            weight,
        }
    }
}

/// The mean that the level of a line is.
fn mean(points: &[Distance], values: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for (point, value) in points.iter().zip(values) {
        let weight = point.trust * point.scale * point.scale;
        sum += weight * value;
        weights += weight;
    }
    sum / weights
}

/// Refuses lines of text that are not on the page.
fn beside([first, second]: &[Line; 2], points: &[[f64; 2]], number: usize) -> Result<()> {
    let thin = |line: &Line| -> Vec<[f64; 2]> {
        let step = line.points.len().div_ceil(200);
        let mut thin: Vec<_> = line.points.iter().copied().step_by(step).collect();
        thin.push(line.points[line.points.len() - 1]);
        thin
    };
    let mut outline = thin(first);
    outline.extend(thin(second).into_iter().rev());
    let slack = BESIDE * first.chord().max(second.chord());
    let sides = || (outline.iter().copied()).zip(outline.iter().cycle().skip(1).copied());
    for [x, y] in points {
        let crossed = sides()
            .filter(|(p, q)| {
                (p[1] > *y) != (q[1] > *y) && *x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
            })
            .count();
        let near = || {
            sides().any(|(p, q)| {
                let (way, off) = ([q[0] - p[0], q[1] - p[1]], [x - p[0], y - p[1]]);
                let squared = (way[0] * way[0] + way[1] * way[1]).max(1e-12);
                let t = ((way[0] * off[0] + way[1] * off[1]) / squared).clamp(0.0, 1.0);
                (off[0] - t * way[0]).hypot(off[1] - t * way[1]) < slack
            })
        };
        if crossed % 2 == 0 && !near() {
            return Err(Error::Edges {
                reason: format!(
                    "line {number} of the text (the first is line 0) has a point at ({x:.0}, \
                     {y:.0}), which is not between the {} and {} edges of its page",
                    first.name, second.name
                ),
            });
        }
    }
    Ok(())
}
