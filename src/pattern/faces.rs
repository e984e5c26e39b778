//! The triangles of a sheet, with their positions on the surface and on the flat sheet.

use super::outline::Layout;
use super::seam_graph::SeamGraph;
use crate::heights::heightfield::Heightfield;
use crate::scene::mesh::TexturedTriangle;

/// The triangles of a sheet, with their positions on the surface and on the flat sheet. Each triangle of the
/// lattice belongs to the patch that most of its corners belong to, so that adjacent sheets have no space between
/// them.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Faces {
    /// Position of each of the sheet's vertices on the surface in space.
    pub built: Vec<[f64; 3]>,
    /// Position of each of the sheet's vertices on the flat sheet.
    pub flat: Vec<[f64; 2]>,
    /// Numbers of the three vertices of each of the sheet's triangles, counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
    /// Part of its texture that each of the sheet's triangles shows; empty unless a mesh with texture coordinates was laid flat as it
    /// is.
    pub textured: Vec<Option<TexturedTriangle>>,
}

pub(super) fn faces(
    surface: &Heightfield,
    net: &SeamGraph,
    layout: &Layout,
    patches: &[u32],
) -> Faces {
    let mut faces = Faces::default();
    let lattice = surface.lattice();
    for patch in patches {
        let Some(flat_patch) = net.flat_patches[*patch as usize].as_ref() else {
            continue;
        };
        let mut numbers = vec![u32::MAX; flat_patch.places().len()];
        for (_, corners) in flat_patch.pieces() {
            let corners = corners.map(|corner| {
                let number = &mut numbers[corner as usize];
                if *number == u32::MAX {
                    *number = faces.flat.len() as u32;
                    let [row, col] = flat_patch.vertex(corner as usize);
                    let [x, y] = lattice.position(row, col);
                    let z = surface.height(row, col);
                    let z = if z.is_nan() {
                        flat_patch.height([row, col])
                    } else {
                        z
                    };
                    let place =
                        layout.motions[*patch as usize].apply(flat_patch.places()[corner as usize]);
                    faces.built.push([x, y, z]);
                    faces.flat.push([place.re, place.im]);
                }
                *number
            });
            faces.triangles.push(corners);
        }
    }
    faces
}
