//! Divides a drawing over pages of paper, plates or rolls of material.

use super::nest::{Shape, nest_shapes};
use super::options::MAX_SIZE;
use super::pack::{MARGIN_MM, Place, pack_rows};
use super::sheet::DrawnSheet;
use crate::error::{Error, Result, positive};

/// Maximum number of pages that a drawing may be divided over.
pub const MAX_PAGES: usize = 400;

/// Material on which a pattern is printed or from which it is cut, with its size in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(
        rename_all = "camelCase",
        expecting = "expected `a4`, `letter`, [width, height] of plates or [width] of a roll"
    )
)]
#[non_exhaustive]
pub enum Stock {
    /// A4 paper, 210 × 297 mm, with a blank margin of 10 mm.
    A4,
    /// US Letter paper, 8½ × 11 inches, with a blank margin of 10 mm.
    Letter,
    /// Plates of a material such as metal or plywood, of a given width and height in millimetres.
    #[cfg_attr(feature = "serde", serde(untagged))]
    Plate([f64; 2]),
    /// A roll of a material, of a given width in millimetres.
    #[cfg_attr(feature = "serde", serde(untagged, deserialize_with = "roll_width"))]
    Roll(f64),
}

#[cfg(feature = "serde")]
fn roll_width<'de, D: serde::Deserializer<'de>>(sides: D) -> std::result::Result<f64, D::Error> {
    serde::Deserialize::deserialize(sides).map(|[width]: [f64; 1]| width)
}

impl Stock {
    /// Checks the sizes of the material, before a pattern is made that may take minutes.
    ///
    /// # Errors
    /// [`Error::Option`] for sizes that are not positive, finite and at most 50 metres.
    pub fn check(self) -> Result<()> {
        self.size(&[]).map(drop)
    }

    /// Width and height in millimetres of what may lie on one page; `None` for a roll, which has room for any length.
    pub fn room(self) -> Option<[f64; 2]> {
        let free = self.size(&[]).ok()?.map(|side| side - 2.0 * self.blank());
        (!matches!(self, Stock::Roll(_)) && free.iter().all(|side| *side > 0.0)).then_some(free)
    }

    /// Returns width and height of the material in millimetres, the shorter side first for paper; a roll is as long as
    /// the sheets on it need.
    fn size(self, sheets: &[DrawnSheet]) -> Result<[f64; 2]> {
        let side = |name, value| match positive(name, value)? <= MAX_SIZE {
            true => Ok(()),
            false => Err(Error::option(name, value, "must be 50000 at most")),
        };
        match self {
            Stock::A4 => Ok([210.0, 297.0]),
            Stock::Letter => Ok([215.9, 279.4]),
            Stock::Plate([width, height]) => {
                side("stock", width)?;
                side("stock", height)?;
                Ok([width, height])
            }
            Stock::Roll(width) => {
                side("stock", width)?;
                let long = |sheet: &DrawnSheet| {
                    let [low, high] = sheet.bounds;
                    (high[0] - low[0]).hypot(high[1] - low[1]) + MARGIN_MM
                };
                Ok([width, sheets.iter().map(long).sum::<f64>() + MARGIN_MM])
            }
        }
    }

    /// Returns whether the material is paper, so that large sheets may be put together from several pages.
    fn is_paper(self) -> bool {
        matches!(self, Stock::A4 | Stock::Letter)
    }

    fn blank(self) -> f64 {
        if self.is_paper() {
            MARGIN_MM
        } else {
            0.5 * MARGIN_MM
        }
    }
}

/// One printed page or plate, which shows a rectangular part of the drawing.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "DrawingPage")
)]
#[non_exhaustive]
pub struct Page {
    /// Name of the page: its number if it holds whole sheets; column letter and row number from the upper
    /// left, such as `A1`, if it has to be put together with others.
    pub name: String,
    /// Lower left corner of the page's part of the drawing, in the drawing's millimetres.
    pub corner: [f64; 2],
}

/// The printed pages or plates of a drawing, all of one size.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename = "DrawingPages")
)]
#[non_exhaustive]
pub struct Pages {
    /// Width and height of the paper or plate, in millimetres.
    pub paper: [f64; 2],
    /// Width of the blank margin: distance from the paper's left and lower edge to the part of the drawing on it, in
    /// millimetres.
    pub blank: f64,
    /// Width and height of the part of the drawing that each page shows, in millimetres.
    pub part: [f64; 2],
    /// The pages, each with its name and the lower left corner of its part of the drawing.
    pub pages: Vec<Page>,
    /// Positions of alignment marks, in the drawing's millimetres: middles and corners of the strips in which pages
    /// overlap. Each mark is printed on all pages that show its position, so that the pages can be aligned.
    pub marks: Vec<[f64; 2]>,
}

/// Computes the number of pages of a paper size that the sheets of a drawing take.
pub(super) fn page_count(sheets: &[DrawnSheet], stock: Stock) -> usize {
    arrange_on_pages(sheets, stock).map_or(0, |found| found.pages.pages.len())
}

/// Result of arranging sheets on pages: the place of each sheet, the pages, and width and height of the whole drawing.
pub(super) struct Arranged {
    pub places: Vec<Place>,
    pub pages: Pages,
    pub size: [f64; 2],
}

pub(super) fn arrange_on_pages(sheets: &[DrawnSheet], stock: Stock) -> Result<Arranged> {
    let paper = stock.size(sheets)?;
    let blank = stock.blank();
    let mut part = paper.map(|side| side - 2.0 * blank);
    if let Some(side) = paper.iter().find(|side| **side <= 2.0 * blank) {
        return Err(Error::option(
            "stock",
            *side,
            "must be larger than the ten millimetres that stay free along its edges",
        ));
    }
    let shapes: Vec<Shape> = sheets.iter().map(Shape::new).collect();
    let mut found = nest_shapes(&shapes, part);
    let large: Vec<usize> = (0..sheets.len()).filter(|i| found[*i].is_none()).collect();
    if let (Some(first), false) = (large.first(), stock.is_paper()) {
        return Err(no_room(&sheets[*first], &shapes[*first], part));
    }
    let mut places = vec![Place::IDENTITY; sheets.len()];
    let mut pages = Pages {
        paper,
        blank,
        part,
        pages: Vec::new(),
        marks: Vec::new(),
    };
    let mut size = [0.0; 2];
    if !large.is_empty() {
        let (own, whole) = cover_with_pages(&shapes, &large, &mut pages);
        for (i, place) in large.iter().zip(own) {
            places[*i] = place;
        }
        size = whole;
        if pages.part != part {
            // All pages have one orientation, and a shape that fits on a page fits in either.
            part = pages.part;
            found = nest_shapes(&shapes, part);
        }
    }
    // Pages with whole sheets are laid in rows beside the pages of divided sheets.
    let count = found
        .iter()
        .flatten()
        .map(|n| n.page + 1)
        .max()
        .unwrap_or(0);
    if let Stock::Roll(_) = stock {
        let ends = found
            .iter()
            .flatten()
            .zip(&shapes)
            .map(|(nested, shape)| nested.top(shape));
        part[1] = ends.fold(0.0, f64::max);
        pages.part = part;
        pages.paper[1] = part[1] + 2.0 * blank;
    }
    let columns = (count as f64).sqrt().ceil().max(1.0) as usize;
    let step = pages.paper.map(|side| side + 2.0 * MARGIN_MM);
    let left = if size[0] > 0.0 {
        size[0] + 2.0 * MARGIN_MM
    } else {
        0.0
    };
    if count > 0 {
        let rows = count.div_ceil(columns);
        size = [
            left + columns as f64 * step[0] - 2.0 * MARGIN_MM,
            size[1].max(rows as f64 * step[1] - 2.0 * MARGIN_MM),
        ];
    }
    let corner = |page: usize| {
        let (column, row) = (page % columns, page / columns);
        [
            left + column as f64 * step[0] + blank,
            size[1] - row as f64 * step[1] - pages.paper[1] + blank,
        ]
    };
    for (place, nested) in places.iter_mut().zip(&found) {
        if let Some(nested) = nested {
            *place = nested.place.shifted(corner(nested.page));
        }
    }
    let whole: Vec<Page> = (0..count)
        .map(|page| Page {
            name: (page + 1).to_string(),
            corner: corner(page),
        })
        .collect();
    pages.pages.extend(whole);
    Ok(Arranged {
        places,
        pages,
        size,
    })
}

/// Lays sheets' shapes that are larger than a page beside each other and covers them with overlapping pages. Returns
/// the placement of each shape, and width and height of the whole arrangement.
fn cover_with_pages(
    shapes: &[Shape],
    large: &[usize],
    pages: &mut Pages,
) -> (Vec<Place>, [f64; 2]) {
    let least: Vec<Place> = large
        .iter()
        .map(|i| Place::around(&shapes[*i].lines))
        .collect();
    let (places, whole) = pack_rows(&least);
    let boxes: Vec<[[f64; 2]; 2]> = (large.iter().zip(&places))
        .map(|(i, place)| shapes[*i].bounds(place))
        .collect();
    let [width, height] = pages.part;
    let upright = Grid::new(whole, [width, height]);
    let aside = Grid::new(whole, [height, width]);
    let grid = match aside.pages(&boxes).count() < upright.pages(&boxes).count() {
        true => aside,
        false => upright,
    };
    pages.part = grid.part;
    pages.paper = grid.part.map(|side| side + 2.0 * pages.blank);
    // The edges of the outermost pages are those of the drawing.
    let shift = grid.corner.map(|v| pages.blank - v);
    let moved = |p: [f64; 2]| [p[0] + shift[0], p[1] + shift[1]];
    pages
        .pages
        .extend(grid.pages(&boxes).map(|(column, row)| Page {
            corner: moved(grid.page_corner(column, row)),
            ..grid.page(column, row)
        }));
    pages.marks.extend(grid.marks().into_iter().map(moved));
    let size = grid.size().map(|side| side + 2.0 * pages.blank);
    (
        places.iter().map(|place| place.shifted(shift)).collect(),
        size,
    )
}

fn no_room(sheet: &DrawnSheet, shape: &Shape, part: [f64; 2]) -> Error {
    let [low, high] = shape.bounds(&Place::around(&shape.lines));
    let [w, h] = [0, 1].map(|k| high[k] - low[k]);
    Error::Unsupported {
        format: "pattern",
        reason: format!(
            "{} takes {w:.0} × {h:.0} mm, and there is room for {:.0} × {:.0}; choose a smaller scale or a larger \
             plate, or cut the surface into smaller sheets",
            sheet.name, part[0], part[1]
        ),
    }
}

/// Computes the total length that a row of overlapping pages covers, in millimetres.
fn covered(count: usize, side: f64) -> f64 {
    count as f64 * (side - MARGIN_MM) + MARGIN_MM
}

/// A grid of overlapping pages, centred over a rectangle: the number of its columns and rows.
struct Grid {
    columns: usize,
    rows: usize,
    part: [f64; 2],
    corner: [f64; 2],
}

impl Grid {
    fn new(sides: [f64; 2], part: [f64; 2]) -> Self {
        let [columns, rows] = [0, 1].map(|k| {
            let steps = (sides[k] - MARGIN_MM) / (part[k] - MARGIN_MM);
            (steps - 1e-9).ceil().max(1.0) as usize
        });
        let corner =
            [(0, columns), (1, rows)].map(|(k, count)| 0.5 * (sides[k] - covered(count, part[k])));
        Grid {
            columns,
            rows,
            part,
            corner,
        }
    }

    fn size(&self) -> [f64; 2] {
        [(0, self.columns), (1, self.rows)].map(|(k, count)| covered(count, self.part[k]))
    }

    /// Lists column and row, counted from the upper left, of each page of the grid that overlaps a box.
    fn pages(&self, boxes: &[[[f64; 2]; 2]]) -> impl Iterator<Item = (usize, usize)> {
        let all = (0..self.rows).flat_map(|row| (0..self.columns).map(move |column| (column, row)));
        all.filter(|(column, row)| {
            let low = self.page_corner(*column, *row);
            boxes.iter().any(|[min, max]| {
                [0, 1]
                    .iter()
                    .all(|k| min[*k] < low[*k] + self.part[*k] && low[*k] < max[*k])
            })
        })
    }

    fn page_corner(&self, column: usize, row: usize) -> [f64; 2] {
        let place = [column, self.rows - 1 - row];
        [0, 1].map(|k| self.corner[k] + place[k] as f64 * (self.part[k] - MARGIN_MM))
    }

    fn page(&self, column: usize, row: usize) -> Page {
        let mut letters = String::new();
        let mut n = column;
        loop {
            letters.insert(0, char::from(b'A' + (n % 26) as u8));
            match n / 26 {
                0 => break,
                more => n = more - 1,
            }
        }
        Page {
            name: format!("{letters}{}", row + 1),
            corner: self.page_corner(column, row),
        }
    }

    fn marks(&self) -> Vec<[f64; 2]> {
        let along = |k: usize, count: usize| {
            (0..=count).map(move |i| {
                self.corner[k] + 0.5 * MARGIN_MM + i as f64 * (self.part[k] - MARGIN_MM)
            })
        };
        along(1, self.rows)
            .flat_map(|y| along(0, self.columns).map(move |x| [x, y]))
            .collect()
    }
}
