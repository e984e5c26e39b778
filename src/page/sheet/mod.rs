//! Pages of any shape from one photo: the isometric sheet whose outline and lines the photo shows.
//!
//! The sheet is a grid of points in space that keeps lengths, bends little, and meets the four edges and the lines of
//! print of the photo; large bends count by their size and not by their square, so that folds form. Focal length,
//! principal point and, of unknown formats, the proportions are found along with it.

mod camera;
mod figures;
mod fit;
#[cfg(test)]
mod fold_tests;
mod folds;
mod grid;
mod level_lines;
mod place_table;
mod plane;
mod polyline;
mod problem;
mod ruled;
mod search;
mod sheet_page;
mod view;

pub(super) use grid::{cell_at, node_shares};
pub(super) use sheet_page::SheetPage;
