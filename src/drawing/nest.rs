//! Nests sheets on pages by their outlines, not as boxes: each where it fits lowest, rotated by quarter turns.
//!
//! Sheets and pages are bitmaps on a grid, so that testing whether a sheet fits takes a few machine words for each
//! of its rows. A sheet occupies every cell that it touches, so sheets never overlap.

use super::label::{Label, TEXT_SIZE_MM};
use super::pack::Place;
use super::sheet::DrawnSheet;
use crate::math::planar::bounds;

/// Number of raster cells along the shorter side of a page, for nesting sheets.
const PAGE_CELLS: f64 = 150.0;

/// Maximum number of raster cells along the longer side of a page, for nesting sheets.
const MAX_PAGE_CELLS: f64 = 5000.0;

/// Shape of a sheet for nesting: the closed lines of the sheet and of texts beside it, and width and height of the
/// box for the sheet's name above it.
pub(super) struct Shape {
    pub lines: Vec<Vec<[f64; 2]>>,
    pub name: [f64; 2],
}

impl Shape {
    pub(super) fn new(sheet: &DrawnSheet) -> Self {
        // Numbers beside the sheet count as parts of it.
        let outside = |label: &&Label| label.is_beside(&sheet.leaders);
        let beside = sheet.labels.iter().filter(outside).map(Label::corners);
        Shape {
            lines: sheet.cuts.iter().cloned().chain(beside).collect(),
            name: Label::sheet(&sheet.name, sheet.bounds).extent(),
        }
    }

    /// Computes the bounding box of the shape at a place, without the box for the sheet's name.
    pub(super) fn bounds(&self, place: &Place) -> [[f64; 2]; 2] {
        let points = self.lines.iter().flatten().map(|p| place.of(*p));
        bounds(points.collect::<Vec<_>>().iter())
    }

    /// Computes the corners of the box for a sheet's name, which lies above the sheet's bounding box.
    fn above(&self, [low, high]: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
        let middle = 0.5 * (low[0] + high[0]);
        let [left, right] = [-0.5, 0.5].map(|k| middle + k * self.name[0]);
        let [foot, head] = [high[1], high[1] + self.name[1]];
        vec![[left, foot], [right, foot], [right, head], [left, head]]
    }
}

/// Position of a nested shape: the number of its page, and its rotation and translation relative to the page's lower
/// left corner.
pub(super) struct Nested {
    pub page: usize,
    pub place: Place,
}

impl Nested {
    /// Computes the height of the nested shape's upper end above the page's lower edge, in millimetres.
    pub(super) fn top(&self, shape: &Shape) -> f64 {
        shape.bounds(&self.place)[1][1] + shape.name[1]
    }
}

/// Finds a position on pages of one size for each shape, the largest shape first; `None` for a shape that is larger
/// than a page.
pub(super) fn nest_shapes(shapes: &[Shape], page: [f64; 2]) -> Vec<Option<Nested>> {
    let [short, long] = [page[0].min(page[1]), page[0].max(page[1])];
    let cell = (short / PAGE_CELLS).max(long / MAX_PAGE_CELLS);
    let [columns, rows] = page.map(|side| cells_along(side, cell));
    let options: Vec<Vec<(Place, Mask)>> = (shapes.iter())
        .map(|shape| turned(shape, cell, page))
        .collect();
    let mut order: Vec<usize> = (0..shapes.len()).collect();
    let area = |i: usize| {
        options[i]
            .first()
            .map_or(0, |(_, mask)| mask.columns * mask.rows.len())
    };
    order.sort_by_key(|i| std::cmp::Reverse(area(*i)));
    let mut pages: Vec<Mask> = Vec::new();
    let mut out: Vec<Option<Nested>> = shapes.iter().map(|_| None).collect();
    for i in order {
        let fitting = &options[i];
        if fitting.is_empty() {
            continue;
        }
        let reach = (TEXT_SIZE_MM / cell).ceil() as usize;
        let dilated: Vec<Mask> = fitting
            .iter()
            .map(|(_, mask)| mask.dilated(reach))
            .collect();
        // The lowest place on the first page that has one.
        let spot = |page: &Mask| {
            let places = fitting.iter().zip(&dilated).enumerate();
            let found = places.filter_map(|(k, ((_, mask), dilated))| {
                let [x, y] = page.lowest_free_position(mask, dilated, reach)?;
                Some((y + mask.rows.len(), x, k, [x, y]))
            });
            found.min().map(|(_, _, k, at)| (k, at))
        };
        let known = pages
            .iter()
            .enumerate()
            .find_map(|(n, page)| Some((n, spot(page)?)));
        let (page, (k, at)) = match known {
            Some(known) => known,
            None => {
                pages.push(Mask::empty(columns, rows));
                (pages.len() - 1, (0, [0, 0]))
            }
        };
        let (place, mask) = &fitting[k];
        pages[page].add(mask, at);
        let shift = at.map(|n| n as f64 * cell);
        out[i] = Some(Nested {
            page,
            place: place.shifted(shift),
        });
    }
    out
}

fn cells_along(side: f64, cell: f64) -> usize {
    ((side / cell + 1e-9) as usize).max(1)
}

/// Rotates a shape by each number of quarter turns at which it fits on a page, with its lower left corner at the
/// origin; returns each with a mask of the raster cells that it touches.
fn turned(shape: &Shape, cell: f64, page: [f64; 2]) -> Vec<(Place, Mask)> {
    let least = Place::around(&shape.lines);
    (0..4)
        .filter_map(|k| {
            let place = least.quarters(k);
            let outline = shape.bounds(&place);
            let name = shape.above(outline);
            let [low, high] = bounds(outline.iter().chain(&name));
            if (0..2).any(|k| high[k] - low[k] > page[k] + 1e-9) {
                return None;
            }
            let place = place.shifted(low.map(|v| -v));
            // A shape that fits by less than one cell ends at the page's edge.
            let size = [0, 1].map(|k| {
                let own = ((high[k] - low[k]) / cell) as usize + 1;
                own.min(cells_along(page[k], cell))
            });
            let mut mask = Mask::empty(size[0], size[1]);
            let cells = |p: [f64; 2]| [0, 1].map(|k| p[k] / cell);
            let line = |line: &Vec<[f64; 2]>| line.iter().map(|p| cells(place.of(*p))).collect();
            mask.fill(&shape.lines.iter().map(line).collect::<Vec<_>>());
            let name = name.iter().map(|p| cells([p[0] - low[0], p[1] - low[1]]));
            mask.fill(&[name.collect()]);
            Some((place, mask))
        })
        .collect()
}

/// A bitmap of the raster cells that are occupied, 64 cells to a machine word, row by row.
struct Mask {
    columns: usize,
    rows: Vec<Vec<u64>>,
}

impl Mask {
    fn empty(columns: usize, rows: usize) -> Self {
        Mask {
            columns,
            rows: vec![vec![0; columns.div_ceil(64)]; rows],
        }
    }

    fn set(&mut self, x: usize, y: usize) {
        if let Some(word) = self.rows.get_mut(y).and_then(|row| row.get_mut(x / 64)) {
            *word |= 1 << (x % 64);
        }
    }

    fn has(&self, x: usize, y: usize) -> bool {
        let word = self.rows.get(y).and_then(|row| row.get(x / 64));
        word.is_some_and(|word| word >> (x % 64) & 1 == 1)
    }

    /// Marks the raster cells inside of closed lines, by the even-odd rule, and the cells that these lines touch.
    fn fill(&mut self, lines: &[Vec<[f64; 2]>]) {
        let edges = || {
            lines.iter().flat_map(|line| {
                let next = line.iter().cycle().skip(1);
                line.iter().zip(next).map(|(p, q)| [*p, *q])
            })
        };
        for y in 0..self.rows.len() {
            let level = y as f64 + 0.5;
            let mut crossed: Vec<f64> = edges()
                .filter(|[p, q]| (p[1] > level) != (q[1] > level))
                .map(|[p, q]| p[0] + (q[0] - p[0]) * (level - p[1]) / (q[1] - p[1]))
                .collect();
            crossed.sort_by(f64::total_cmp);
            for span in crossed.chunks_exact(2) {
                for x in span[0].max(0.0) as usize..=span[1].max(0.0) as usize {
                    self.set(x.min(self.columns - 1), y);
                }
            }
        }
        for [p, q] in edges() {
            let steps = (2.0 * (q[0] - p[0]).abs().max((q[1] - p[1]).abs()))
                .ceil()
                .max(1.0);
            for i in 0..=steps as usize {
                let t = i as f64 / steps;
                let [x, y] = [0, 1].map(|k| (p[k] + t * (q[k] - p[k])).max(0.0) as usize);
                self.set(x.min(self.columns - 1), y.min(self.rows.len() - 1));
            }
        }
    }

    /// Computes the dilation of the mask, which enlarges its occupied area by a square of `2 reach + 1` cells a side;
    /// its origin moves by `reach` cells to the lower left.
    fn dilated(&self, reach: usize) -> Mask {
        let mut out = Mask::empty(self.columns + 2 * reach, self.rows.len() + 2 * reach);
        for y in 0..self.rows.len() {
            for x in (0..self.columns).filter(|x| self.has(*x, y)) {
                for dy in 0..=2 * reach {
                    for dx in 0..=2 * reach {
                        out.set(x + dx, y + dy);
                    }
                }
            }
        }
        out
    }

    /// Finds the lowest position of a shape on a page, and of several the leftmost, at which the dilated shape meets no
    /// occupied cell; `None` if there is none.
    fn lowest_free_position(
        &self,
        shape: &Mask,
        dilated: &Mask,
        reach: usize,
    ) -> Option<[usize; 2]> {
        let last = [
            self.columns.checked_sub(shape.columns)?,
            self.rows.len().checked_sub(shape.rows.len())?,
        ];
        for y in 0..=last[1] {
            for x in 0..=last[0] {
                if !self.meets(dilated, x, y, reach) {
                    return Some([x, y]);
                }
            }
        }
        None
    }

    /// Returns whether a dilated shape at a given position meets an occupied cell of the page.
    fn meets(&self, dilated: &Mask, x: usize, y: usize, reach: usize) -> bool {
        dilated.rows.iter().enumerate().any(|(k, row)| {
            let Some(own) = (y + k)
                .checked_sub(reach)
                .and_then(|row| self.rows.get(row))
            else {
                return false;
            };
            row.iter().enumerate().any(|(n, word)| {
                let from = (x + 64 * n) as i64 - reach as i64;
                *word & bits(own, from) != 0
            })
        })
    }

    fn add(&mut self, shape: &Mask, [x, y]: [usize; 2]) {
        for row in 0..shape.rows.len() {
            for column in (0..shape.columns).filter(|c| shape.has(*c, row)) {
                self.set(x + column, y + row);
            }
        }
    }
}

/// Returns the 64 bits of a mask's row from position `from` on, which may be negative; bits outside of the row are 0.
fn bits(row: &[u64], from: i64) -> u64 {
    let word = |n: i64| {
        usize::try_from(n)
            .ok()
            .and_then(|n| row.get(n))
            .copied()
            .unwrap_or(0)
    };
    let (n, shift) = (from.div_euclid(64), from.rem_euclid(64));
    match shift {
        0 => word(n),
        _ => word(n) >> shift | word(n + 1) << (64 - shift),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(line: &[[f64; 2]]) -> Shape {
        Shape {
            lines: vec![line.to_vec()],
            name: [0.0; 2],
        }
    }

    #[test]
    fn right_angles_lie_in_each_other() {
        // Two angles of 180 by 180 with arms of 50 take one page only if one is turned.
        let angle = [
            [0.0, 0.0],
            [180.0, 0.0],
            [180.0, 50.0],
            [50.0, 50.0],
            [50.0, 180.0],
            [0.0, 180.0],
        ];
        let found = nest_shapes(&[shape(&angle), shape(&angle)], [190.0, 277.0]);
        let pages: Vec<usize> = found.iter().flatten().map(|n| n.page).collect();
        assert_eq!(pages, [0, 0]);
        // They do not touch: no point of one is nearer to the other's than the distance.
        let placed: Vec<Vec<[f64; 2]>> = (found.iter().flatten())
            .map(|n| {
                let ring: Vec<[f64; 2]> = angle.iter().map(|p| n.place.of(*p)).collect();
                (0..600)
                    .map(|i| {
                        let (p, q) = (ring[i / 100], ring[(i / 100 + 1) % 6]);
                        let t = (i % 100) as f64 / 100.0;
                        [0, 1].map(|k| p[k] + t * (q[k] - p[k]))
                    })
                    .collect()
            })
            .collect();
        for p in &placed[0] {
            assert!(
                (0..2).all(|k| (-1e-9..=[190.0, 277.0][k] + 1e-9).contains(&p[k])),
                "{p:?}"
            );
            for q in &placed[1] {
                assert!(
                    (p[0] - q[0]).hypot(p[1] - q[1]) >= 0.9 * TEXT_SIZE_MM,
                    "{p:?} {q:?}"
                );
            }
        }
    }

    #[test]
    fn what_is_too_large_has_no_place() {
        let square = |side: f64| shape(&[[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]);
        let shapes = [square(100.0), square(200.0), square(100.0), square(100.0)];
        let found = nest_shapes(&shapes, [190.0, 277.0]);
        assert!(found[1].is_none());
        let pages: Vec<usize> = found.iter().flatten().map(|n| n.page).collect();
        assert_eq!(pages, [0, 0, 1]);
    }

    #[test]
    fn bits_before_a_row_and_behind_it_are_none() {
        let row = [u64::MAX, 1];
        assert_eq!(bits(&row, -3), u64::MAX << 3);
        assert_eq!(bits(&row, 60), 0b11111);
        assert_eq!(bits(&row, 128), 0);
    }
}
