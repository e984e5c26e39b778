//! Files that show how a pattern is assembled: an animation from flat sheets to the built surface (GLB), and a
//! numbered picture from above (SVG).

mod glb;
mod picture;

use crate::picture::colours;
pub use glb::write_animation;
pub use picture::write_assembly_svg;

/// Colour of a sheet, the same in both files.
fn colour(sheet: usize) -> [u8; 3] {
    colours::patch(sheet as u32)
}
