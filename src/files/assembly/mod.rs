//! Files that show how a pattern is assembled: an animation from flat sheets to the built surface (GLB), and a
//! numbered picture from above (SVG).

mod glb;
mod picture;

use crate::picture::colours;
pub use glb::write_animation;
pub use picture::write_assembly_svg;

/// Returns the colour of a sheet, given by the sheet's number; the same in the GLB animation and in the SVG picture.
fn colour(sheet: usize) -> [u8; 3] {
    colours::patch(sheet as u32)
}
