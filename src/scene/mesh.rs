//! Triangle meshes and point clouds, with colours, normals and texture coordinates.

use crate::error::{Error, Result, check_count};

/// A triangle mesh in space, in the user's units and axes, or a point cloud.
///
/// The triangles may be open, intersect, overlap, be degenerate and face either way.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    normals: Option<Vec<[f32; 3]>>,
    colors: Option<Vec<[f32; 3]>>,
    uvs: Option<Vec<[f32; 2]>>,
    textures: Option<Vec<i32>>,
}

/// The part of a texture that a triangle shows.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TexturedTriangle {
    /// Number of the texture.
    pub texture: u32,
    /// Texture coordinates of the triangle's corners: shares from the texture's left and bottom.
    pub uvs: [[f64; 2]; 3],
}

impl Mesh {
    /// Makes a triangle mesh of vertex positions and of triangles, each of which lists three vertices by index.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if there is no triangle, [`Error::Format`] if one
    /// names a vertex that is not there, [`Error::NotFinite`] if a coordinate is
    /// not finite (its row is the vertex, its column the coordinate).
    pub fn new(positions: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self> {
        if triangles.is_empty() {
            return Err(Error::Unsupported {
                format: "mesh",
                reason: "it has no faces; points without any are a point cloud".into(),
            });
        }
        let outside = |t: &[u32; 3]| t.iter().copied().find(|i| *i as usize >= positions.len());
        if let Some((triangle, vertex)) = triangles
            .iter()
            .enumerate()
            .find_map(|(i, t)| outside(t).map(|v| (i, v)))
        {
            return Err(Error::Format {
                format: "mesh",
                reason: format!(
                    "triangle {triangle} names vertex {vertex}, but the mesh has {} vertices, \
                     counted from 0",
                    positions.len()
                ),
            });
        }
        Mesh::of_finite(positions, triangles)
    }

    /// Makes a point cloud: points without triangles.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if there is no point, [`Error::NotFinite`] if a
    /// coordinate is not finite (its row is the point, its column the coordinate).
    pub fn cloud(positions: Vec<[f64; 3]>) -> Result<Self> {
        if positions.is_empty() {
            return Err(Error::Unsupported {
                format: "point cloud",
                reason: "there is no point in it".into(),
            });
        }
        Mesh::of_finite(positions, Vec::new())
    }

    /// Whether the mesh is a point cloud, without triangles.
    pub fn is_cloud(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Returns the mesh with a unit normal for each vertex. Meshes read from files have none.
    ///
    /// # Errors
    /// [`Error::Shape`] if there is not one for each vertex.
    pub fn with_normals(mut self, normals: Vec<[f32; 3]>) -> Result<Self> {
        self.check_each("normals of the mesh", &normals)?;
        self.normals = Some(normals);
        Ok(self)
    }

    /// Returns the corners of the bounding box of all vertices: the smallest and the largest coordinates.
    pub(crate) fn bounds(&self) -> [[f64; 3]; 2] {
        let start = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        self.positions.iter().fold(start, |[low, high], p| {
            [
                std::array::from_fn(|k| low[k].min(p[k])),
                std::array::from_fn(|k| high[k].max(p[k])),
            ]
        })
    }

    /// Returns whether all coordinates are numbers of 32 bits.
    pub(crate) fn has_single_precision(&self) -> bool {
        let mut all = self.positions.as_flattened().iter();
        all.all(|value| f64::from(*value as f32) == *value)
    }

    /// Returns the longest side of the bounding box of all vertices.
    #[cfg(feature = "meshes")]
    pub(crate) fn longest_side(&self) -> f64 {
        let [low, high] = self.bounds();
        (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max)
    }

    /// Returns the mesh with a colour for each vertex: red, green, blue, usually from 0 to 1, in the user's colour
    /// space.
    ///
    /// # Errors
    /// [`Error::Shape`] if there is not one for each vertex.
    pub fn with_colors(mut self, colors: Vec<[f32; 3]>) -> Result<Self> {
        self.check_each("colours of the mesh", &colors)?;
        self.colors = Some(colors);
        Ok(self)
    }

    /// Returns the mesh with texture coordinates for each vertex: shares of the texture's width from the left and of
    /// its height from the bottom, as in OBJ and PLY. (glTF counts from the top; files are converted when they are read
    /// and written.)
    ///
    /// # Errors
    /// [`Error::Shape`] if there is not one pair for each vertex.
    pub fn with_uvs(mut self, uvs: Vec<[f32; 2]>) -> Result<Self> {
        self.check_each("texture coordinates of the mesh", &uvs)?;
        self.uvs = Some(uvs);
        Ok(self)
    }

    /// Returns the mesh with a texture number for each triangle, -1 for none: the image that the texture coordinates of
    /// its corners refer to.
    ///
    /// # Errors
    /// [`Error::Shape`] if there is not one for each triangle.
    pub fn with_textures(mut self, textures: Vec<i32>) -> Result<Self> {
        let triangles = self.triangles.len();
        check_count("textures of the mesh", triangles, 1, textures.len())?;
        self.textures = Some(textures);
        Ok(self)
    }

    fn check_each<const N: usize>(&self, what: &'static str, values: &[[f32; N]]) -> Result<()> {
        check_count(what, self.positions.len(), N, N * values.len())
    }

    /// Positions of the vertices in space.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// Triangles, each as the indices of its three vertices; empty for a point cloud.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Unit normal of each vertex, if there are normals.
    pub fn normals(&self) -> Option<&[[f32; 3]]> {
        self.normals.as_deref()
    }

    /// Colour (red, green, blue) of each vertex, if there are colours.
    pub fn colors(&self) -> Option<&[[f32; 3]]> {
        self.colors.as_deref()
    }

    /// Texture coordinates of each vertex, if there are any: shares from the texture's left and bottom.
    pub fn uvs(&self) -> Option<&[[f32; 2]]> {
        self.uvs.as_deref()
    }

    /// Number of each triangle's texture, -1 for none; None if no textures are set.
    pub fn textures(&self) -> Option<&[i32]> {
        self.textures.as_deref()
    }

    /// Returns the part of its texture that a triangle shows, if it has one.
    pub(crate) fn textured(&self, triangle: usize) -> Option<TexturedTriangle> {
        let uvs = self.uvs.as_ref()?;
        let texture = self.textures.as_ref().map_or(0, |own| own[triangle]);
        Some(TexturedTriangle {
            texture: u32::try_from(texture).ok()?,
            uvs: self.triangles[triangle].map(|v| uvs[v as usize].map(f64::from)),
        })
    }

    /// Returns the mesh with other positions of its vertices, and without normals.
    pub(crate) fn moved_to(self, positions: Vec<[f64; 3]>) -> Result<Self> {
        let moved = Mesh::of_finite(positions, Vec::new())?;
        Ok(Mesh {
            positions: moved.positions,
            normals: None,
            ..self
        })
    }

    /// Returns the mesh with only those triangles that satisfy `wanted`, in the same order; vertices stay.
    pub(super) fn keep(mut self, mut wanted: impl FnMut([u32; 3]) -> bool) -> Self {
        let keep: Vec<bool> = self.triangles.iter().map(|t| wanted(*t)).collect();
        let mut flags = keep.iter();
        self.triangles.retain(|_| flags.next() == Some(&true));
        if let Some(textures) = &mut self.textures {
            let mut flags = keep.iter();
            textures.retain(|_| flags.next() == Some(&true));
        }
        self
    }

    /// Positions of the three corners of a triangle.
    pub(crate) fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|i| self.positions[i as usize])
    }

    /// Makes a mesh without looks of positions that are finite.
    fn of_finite(positions: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self> {
        let place = positions.as_flattened().iter().position(|v| !v.is_finite());
        if let Some((row, col)) = place.map(|place| (place / 3, place % 3)) {
            return Err(Error::NotFinite {
                what: "vertex position of the mesh",
                value: positions[row][col],
                row,
                col,
                advice: "rows are vertices and columns coordinates; repair or remove the vertex",
            });
        }
        Ok(Mesh {
            positions,
            triangles,
            normals: None,
            colors: None,
            uvs: None,
            textures: None,
        })
    }
}
