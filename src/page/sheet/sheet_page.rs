//! A page of any shape in space, from its outline in one photo.

use super::fit::FittedSheet;
use super::place_table::PlaceTable;
use super::plane::CameraPrior;
use super::polyline::Polyline;
use super::search::{knob, search};
use super::view::PhotoView;
use crate::dewarp::{DewarpOptions, Photo, WarpMap};
use crate::error::{Error, Result, checked_cells, positive, try_filled};
use crate::math::lanes;
use crate::page::edges::Edges;
use crate::page::known_sizes::{focal_length, sides};
use crate::page::options::PageOptions;
use crate::page::read_traces::read_traces;
use crate::page::traced_line::{TracedLine, distance};

/// A page of any shape in space, from its four edges in one photo.
#[derive(Debug, Clone)]
pub struct SheetPage {
    sheet: FittedSheet,
    table: PlaceTable,
}

/// Number of segments of an edge.
const EDGE_SEGMENTS: usize = 160;

impl SheetPage {
    /// Finds the page whose four edges are traced in a photo.
    ///
    /// # Errors
    /// Those of [`CurledPage::new`](super::super::CurledPage::new).
    pub fn in_photo(edges: &Edges, photo: &Photo<'_>, options: &PageOptions) -> Result<Self> {
        let size = [photo.width(), photo.height()];
        let [width, height] = size.map(|n| n as f64);
        let (longer, diagonal) = (width.max(height), width.hypot(height));
        let (mut pages, sideways) = read_traces(std::slice::from_ref(edges), [&[], &[]], size)?;
        let page = pages.remove(0);
        let Some(others) = page.sides else {
            return Err(Error::edges("a sheet needs all four edges"));
        };
        let [first, second] = page.pair;
        let [start, end] = others;
        let lines = if sideways {
            [start, end, second, first]
        } else {
            [first, second, start, end]
        };
        let lines = oriented(lines);
        let focal = focal_length(options.focal_length, longer, diagonal)?;
        let view = PhotoView {
            focal: focal.map_or(knob("FNOM", 0.9) * longer, |f| f[0]),
            centre: options.centre.unwrap_or([(width - 1.0) / 2.0, (height - 1.0) / 2.0]),
        };
        let format = sides(options.format)?;
        let edges = lines.map(|line| {
            let points: Vec<_> = line.points.iter().map(|p| view.to_normalised(*p)).collect();
            Polyline::resampled(&points, EDGE_SEGMENTS)
        });
        let length = |k: usize| {
            let points = edges[k].points();
            distance(points[0], points[points.len() - 1])
        };
        let apparent = (length(2) + length(3)) / (length(0) + length(1));
        let prior = CameraPrior {
            log_scale: 0.0,
            scale_deviation: if focal.is_some() { knob("SDEV", 0.06) } else { knob("SDEVU", 0.3) },
            centre_deviation: knob("CDEV", 0.12),
            log_ratio: format.map(|sides| [sides.ratio(apparent).ln(), 0.002]),
        };
        let soft = knob("SOFT", 0.0) > 0.0;
        let Some((sheet, _)) = search(&edges, prior, &view, photo, soft) else {
            return Err(Error::edges("no page was found whose edges these could be"));
        };
        let table = PlaceTable::new(&sheet.grid, &view)?;
        Ok(SheetPage { sheet, table })
    }

    pub fn figures(&self) -> String {
        format!("cost {:.3} lines {} s {:.3}", self.sheet.cost, self.sheet.levels.len(), self.sheet.grid.camera.log_scale.exp())
    }

    /// Warp map.
    ///
    /// # Errors
    /// Those of [`CurledPage::warp_map`](super::super::CurledPage::warp_map).
    pub fn warp_map(&self, options: &DewarpOptions) -> Result<WarpMap> {
        let size = [1.0, self.sheet.grid.ratio()];
        let resolution = match options.dots {
            Some(dots) => positive("dots", dots)?,
            None => (self.table.area() / (size[0] * size[1])).sqrt(),
        };
        let [width, height] = size.map(|side| (side * resolution).round().max(1.0) as usize);
        checked_cells("flat image", height, width)?;
        let mut places = try_filled("flat image", width * height, [f32::NAN; 2])?;
        for (i, place) in places.iter_mut().enumerate() {
            let share = [
                ((i % width) as f64 + 0.5) / width as f64,
                ((i / width) as f64 + 0.5) / height as f64,
            ];
            *place = self.table.at(share).map(lanes::single);
        }
        Ok(WarpMap::from_places([width, height], resolution, [0.0, size[1]], places))
    }
}

/// Edges in the order top, bottom, left, right, each from left to right or from top to bottom.
fn oriented(mut lines: [TracedLine; 4]) -> [TracedLine; 4] {
    let [top, bottom] = [lines[0].ends(), lines[1].ends()];
    // The pair of edges that was arranged fixes the others.
    let [left, right] = [lines[2].ends(), lines[3].ends()];
    let _ = (top, bottom, left, right);
    let cost = |a: [f64; 2], b: [f64; 2]| distance(a, b);
    let mut best = (f64::INFINITY, 0);
    for flips in 0..16 {
        let e = [0, 1, 2, 3].map(|k| {
            let [p, q] = lines[k].ends();
            if flips >> k & 1 == 1 { [q, p] } else { [p, q] }
        });
        let sum = cost(e[0][0], e[2][0]) + cost(e[0][1], e[3][0]) + cost(e[1][0], e[2][1]) + cost(e[1][1], e[3][1]);
        if sum < best.0 {
            best = (sum, flips);
        }
    }
    for (k, line) in lines.iter_mut().enumerate() {
        if best.1 >> k & 1 == 1 {
            line.points.reverse();
        }
    }
    lines
}
