//! A drawing spread over sheets of paper that are put together again.

use super::Drawing;
use crate::error::{Error, Result};

/// Most pages that a drawing is spread over.
pub const MAX_PAGES: usize = 400;

/// What a printer leaves blank on each side at most, in millimetres.
const BLANK: f64 = 10.0;

/// How far neighbouring pages overlap.
const OVERLAP: f64 = 10.0;

/// A size of paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "lowercase")
)]
#[non_exhaustive]
pub enum Paper {
    /// 210 × 297 mm.
    A4,
    /// 8½ × 11 inches.
    Letter,
}

impl Paper {
    /// Its sides in millimetres, the shorter one first.
    pub fn size(self) -> [f64; 2] {
        match self {
            Paper::A4 => [210.0, 297.0],
            Paper::Letter => [215.9, 279.4],
        }
    }
}

/// One page: a part of the drawing.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Page {
    /// Its column's letter and its row's number, from the upper left: `A1`.
    pub name: String,
    /// Lower left corner of the part, in the drawing's millimetres.
    pub corner: [f64; 2],
}

/// How a drawing is spread over pages: all of one size, those that show a part of a sheet, row by
/// row.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Pages {
    /// Width and height of the paper, upright or on its side, whichever takes fewer pages.
    pub paper: [f64; 2],
    /// Where the drawing's part begins on the paper, from its left and lower edge.
    pub blank: f64,
    /// Width and height of the part on each page.
    pub part: [f64; 2],
    /// The pages.
    pub pages: Vec<Page>,
    /// Places of the drawing that lie in the middle of where pages overlap, and at its corners:
    /// with a mark at each, on every page that shows it, the pages can be laid on each other.
    pub marks: Vec<[f64; 2]>,
}

impl Pages {
    /// Spreads a drawing over pages of a size.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for more than [`MAX_PAGES`].
    pub fn new(drawing: &Drawing, paper: Paper) -> Result<Self> {
        let count = Pages::count(drawing, paper);
        if count > MAX_PAGES {
            return Err(Error::Unsupported {
                format: "pattern",
                reason: format!(
                    "it takes {count} pages of this size, more than the limit of {MAX_PAGES}; \
                     choose a smaller scale, larger paper or one large page"
                ),
            });
        }
        let [short, long] = paper.size();
        let upright = Grid::new(drawing, [short, long]);
        let aside = Grid::new(drawing, [long, short]);
        let grid = match aside.pages(drawing).count() < upright.pages(drawing).count() {
            true => aside,
            false => upright,
        };
        Ok(Pages {
            paper: grid.part.map(|side| side + 2.0 * BLANK),
            blank: BLANK,
            part: grid.part,
            pages: grid.pages(drawing).map(|(c, r)| grid.page(c, r)).collect(),
            marks: grid.marks(),
        })
    }

    /// How many pages a drawing takes.
    pub fn count(drawing: &Drawing, paper: Paper) -> usize {
        let [short, long] = paper.size();
        let count = |sides| Grid::new(drawing, sides).pages(drawing).count();
        count([short, long]).min(count([long, short]))
    }
}

/// All pages there could be; the drawing is in their middle.
struct Grid {
    columns: usize,
    rows: usize,
    part: [f64; 2],
    corner: [f64; 2],
}

impl Grid {
    fn new(drawing: &Drawing, paper: [f64; 2]) -> Self {
        let part = paper.map(|side| side - 2.0 * BLANK);
        let sides = [drawing.width, drawing.height];
        let [columns, rows] = [0, 1].map(|k| {
            let steps = (sides[k] - OVERLAP) / (part[k] - OVERLAP);
            (steps - 1e-9).ceil().max(1.0) as usize
        });
        let corner = [(0, columns), (1, rows)].map(|(k, count)| {
            let whole = count as f64 * (part[k] - OVERLAP) + OVERLAP;
            0.5 * (sides[k] - whole)
        });
        Grid {
            columns,
            rows,
            part,
            corner,
        }
    }

    /// Column and row, from the upper left, of each page that shows a part of a sheet.
    fn pages(&self, drawing: &Drawing) -> impl Iterator<Item = (usize, usize)> {
        let all = (0..self.rows).flat_map(|row| (0..self.columns).map(move |column| (column, row)));
        all.filter(|(column, row)| {
            let low = self.page_corner(*column, *row);
            drawing.sheets.iter().any(|sheet| {
                let [min, max] = sheet.bounds;
                [0, 1]
                    .iter()
                    .all(|k| min[*k] < low[*k] + self.part[*k] && low[*k] < max[*k])
            })
        })
    }

    fn page_corner(&self, column: usize, row: usize) -> [f64; 2] {
        let place = [column, self.rows - 1 - row];
        [0, 1].map(|k| self.corner[k] + place[k] as f64 * (self.part[k] - OVERLAP))
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
            (0..=count)
                .map(move |i| self.corner[k] + 0.5 * OVERLAP + i as f64 * (self.part[k] - OVERLAP))
        };
        along(1, self.rows)
            .flat_map(|y| along(0, self.columns).map(move |x| [x, y]))
            .collect()
    }
}
