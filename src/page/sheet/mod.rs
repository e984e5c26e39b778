//! Pages of any shape from one photo: the isometric sheet whose outline and lines the photo shows.

mod bordered;
mod camera;
mod figures;
mod fit;
mod grid;
mod level_lines;
mod place_table;
mod plane;
mod polyline;
mod problem;
mod search;
mod sheet_page;
mod view;

pub use sheet_page::SheetPage;
