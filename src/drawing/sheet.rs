//! The drawn sheet: its cut lines, folds, tabs, marks and labels in millimetres.

use super::curve::Curve;
use super::label::Label;
use super::line::{FLATTENING_TOLERANCE_MM, Line};
use super::pack::Place;
use crate::math::planar::bounds;
use crate::pattern::Sheet;
use crate::scene::mesh::TexturedTriangle;

/// A sheet of a drawing, in the drawing's millimetres. It is rotated to its smallest bounding box if that saves enough
/// area, and never mirrored.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct DrawnSheet {
    /// Name of the sheet that is written above it: `Sheet 1` and so on.
    pub name: String,
    /// Numbers of the patches that the sheet consists of.
    pub patches: Vec<u32>,
    /// Lower left and upper right corner of the sheet's bounding box, in the drawing's millimetres.
    pub bounds: [[f64; 2]; 2],
    /// Cut lines of the sheet, which also go around tabs: closed polylines whose last point is joined to the first.
    /// Points lie within a fiftieth of a millimetre of [`DrawnSheet::curves`].
    pub cuts: Vec<Vec<[f64; 2]>>,
    /// The sheet's cut lines as smooth curves.
    pub curves: Vec<Curve>,
    /// Triangles of the sheet on which a texture is printed.
    pub printed: Vec<PrintedTriangle>,
    /// Lines along which the sheet is folded, without those of tabs.
    pub folds: Vec<Line>,
    /// Lines along which the sheet's tabs (glued flaps) are folded.
    pub tabs: Vec<Line>,
    /// Edges of the surface inside of the sheet's allowance: the lines along which the extra material is sewn or bent
    /// over.
    pub edges: Vec<Curve>,
    /// Marks: short lines across seams, which coincide when both sides of a seam are joined.
    pub marks: Vec<Curve>,
    /// Leader lines, each from a patch that is too small for its number to the number beside the sheet.
    pub leaders: Vec<Curve>,
    /// Texts on and beside the sheet: numbers of patches, letters of seams, angles of folds, the sheet's name.
    pub labels: Vec<Label>,
}

/// A triangle of a sheet on which a part of a texture is printed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct PrintedTriangle {
    /// Corners of the triangle, in the drawing's millimetres.
    pub corners: [[f64; 2]; 3],
    /// Texture coordinates of the corners: shares from the texture's left and bottom.
    pub uvs: [[f64; 2]; 3],
    /// Index of the texture, from 0, in the `textures` of the mesh.
    pub texture: u32,
}

impl PrintedTriangle {
    /// Collects the printed triangles of a sheet; `scale` is in millimetres per unit.
    pub(super) fn all_of(sheet: &Sheet, scale: f64) -> Vec<PrintedTriangle> {
        let faces = &sheet.faces;
        (faces.triangles.iter().zip(&faces.textured))
            .filter_map(|(corners, textured)| {
                let TexturedTriangle { texture, uvs } = (*textured)?;
                let corners = corners.map(|v| faces.flat[v as usize].map(|along| scale * along));
                Some(PrintedTriangle {
                    corners,
                    uvs,
                    texture,
                })
            })
            .collect()
    }
}

impl DrawnSheet {
    /// Computes this sheet rotated and translated to a place in the drawing.
    pub(super) fn moved(mut self, place: &Place) -> Self {
        for triangle in &mut self.printed {
            triangle.corners = triangle.corners.map(|p| place.of(p));
        }
        for line in self.folds.iter_mut().chain(&mut self.tabs) {
            line.curve = line.curve.mapped(|p| place.of(p));
            line.points = line.curve.points(FLATTENING_TOLERANCE_MM);
        }
        let others = [&mut self.edges, &mut self.marks, &mut self.leaders];
        for curve in self.curves.iter_mut().chain(others.into_iter().flatten()) {
            *curve = curve.mapped(|p| place.of(p));
        }
        let ring = |curve: &Curve| {
            let mut points = curve.points(FLATTENING_TOLERANCE_MM);
            // The last point is joined to the first.
            points.pop();
            points
        };
        self.cuts = self.curves.iter().map(ring).collect();
        for label in &mut self.labels {
            label.place = place.of(label.place);
            label.turn_by(place.degrees());
        }
        self.bounds = bounds(self.cuts.iter().flatten());
        // Its name stays above it.
        self.labels.retain(|label| !label.is_sheet());
        self.labels.push(Label::sheet(&self.name, self.bounds));
        self
    }
}
