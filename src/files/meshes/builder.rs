//! Builds a mesh from the vertices and triangles that a file's decoder adds, and reports what is wrong with them.

use nalgebra::Vector3;

use super::beside::Texture;
use crate::error::{Error, MAX_CELLS, Result};
use crate::files::Assumption;
use crate::files::failure::{damaged, not_read};
use crate::math::planar::Point2;
use crate::math::polygon::{MAX_POLYGON_CORNERS, triangulate};
use crate::scene::mesh::Mesh;

/// Colour of a vertex for which the mesh file states no colour: white, as in the glTF format.
pub(super) const DEFAULT_VERTEX_COLOUR: [f32; 3] = [1.0; 3];

/// Texture coordinates, far outside of any picture, that mark a vertex without texture coordinates.
pub(super) const NO_UV: [f32; 2] = [f32::MIN; 2];

/// Texture number of a triangle that has no texture.
pub(super) const NO_TEXTURE: i32 = -1;

/// A mesh under construction, to which a file's decoder adds vertices and triangles one by one.
#[derive(Default)]
pub(super) struct MeshBuilder {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) colors: Vec<[f32; 3]>,
    pub(super) uvs: Vec<[f32; 2]>,
    /// Texture number of each triangle; shorter than the list of triangles where the last ones have no texture.
    pub(super) textures: Vec<i32>,
    pub(super) pictures: Vec<Texture>,
    /// Number of polygons that could not be divided into triangles that do not overlap.
    pub(super) crossed_polygons: usize,
    /// Whether the file has lines between vertices, which are left out.
    pub(super) has_lines: bool,
    /// What the decoder assumed.
    pub(super) assumptions: Vec<Assumption>,
    /// Number of bytes left for further texture pictures; all pictures together may not exceed the size of the given
    /// files.
    pub(super) room: usize,
}

impl MeshBuilder {
    pub(super) fn position(&mut self, position: [f64; 3]) -> Result<()> {
        push(&mut self.positions, position, 3 * MAX_CELLS)
    }

    pub(super) fn triangle(&mut self, triangle: [u32; 3]) -> Result<()> {
        push(&mut self.triangles, triangle, MAX_CELLS)
    }

    /// Adds a polygon as triangles that do not overlap, unless its sides cross or it has too many corners.
    pub(super) fn polygon(&mut self, corners: &[u32]) -> Result<()> {
        if corners.len() < 4 {
            return self.fan(corners);
        }
        let Some(points) = self.concave(corners) else {
            return self.fan(corners);
        };
        let Some(triangles) = triangulate(vec![points]) else {
            self.crossed_polygons += 1;
            return self.fan(corners);
        };
        let mut triangles = triangles.into_iter();
        triangles.try_for_each(|triangle| self.triangle(triangle.map(|k| corners[k])))
    }

    /// Returns the corners of a polygon in the coordinate plane to which it is nearest, anticlockwise; `None` if the triangles
    /// of a fan do not overlap, or a corner is not there.
    fn concave(&self, corners: &[u32]) -> Option<Vec<Point2>> {
        let place = |vertex: &u32| self.positions.get(*vertex as usize).copied();
        let points: Vec<[f64; 3]> = corners.iter().map(place).collect::<Option<_>>()?;
        let first = Vector3::from(*points.first()?);
        let off: Vec<Vector3<f64>> = points.iter().map(|p| Vector3::from(*p) - first).collect();
        let areas = || off.windows(2).map(|edge| edge[0].cross(&edge[1]));
        // The areas of triangles that overlap come to more than the polygon's, but for rounding to 32 bits.
        let normal: Vector3<f64> = areas().sum();
        let sum: f64 = areas().map(|area| area.dot(&normal).abs()).sum();
        if sum <= (1.0 + f64::from(f32::EPSILON)) * normal.norm_squared() {
            return None;
        }
        let axis = normal.iamax();
        let [x, y] = match normal[axis] > 0.0 {
            true => [(axis + 1) % 3, (axis + 2) % 3],
            false => [(axis + 2) % 3, (axis + 1) % 3],
        };
        Some(off.iter().map(|p| Point2::new(p[x], p[y])).collect())
    }

    /// Adds triangles that all share the first of the corners.
    pub(super) fn fan(&mut self, corners: &[u32]) -> Result<()> {
        let [first, rest @ ..] = corners else {
            return Ok(());
        };
        rest.windows(2)
            .try_for_each(|edge| self.triangle([*first, edge[0], edge[1]]))
    }

    /// Adds a strip of triangles, each of which shares an edge with the one before.
    pub(super) fn strip(&mut self, corners: &[u32]) -> Result<()> {
        let mut triangles = corners.windows(3).enumerate();
        triangles.try_for_each(|(i, t)| match i % 2 {
            0 => self.triangle([t[0], t[1], t[2]]),
            _ => self.triangle([t[1], t[0], t[2]]),
        })
    }

    /// Sets the colour of all vertices that were added since vertex number `start`.
    pub(super) fn material(&mut self, start: usize, color: [f32; 3]) {
        let vertices = self.positions.len() - start;
        self.colors.extend(std::iter::repeat_n(color, vertices));
    }

    /// Marks the vertices added since texture coordinates were last given as having none, while other vertices may have
    /// some.
    pub(super) fn no_uvs(&mut self) {
        self.uvs.resize(self.positions.len(), NO_UV);
    }

    /// Returns the number of a texture picture, given by name and bytes; a picture without a name gets a new number.
    pub(super) fn picture(&mut self, name: &str, bytes: &[u8]) -> Result<i32> {
        let known = (self.pictures.iter()).position(|p| !name.is_empty() && p.name == name);
        if let Some(number) = known {
            return Ok(number as i32);
        }
        // Several names may refer to the same bytes.
        self.room = (self.room.checked_sub(bytes.len()))
            .ok_or_else(|| damaged("together its textures are larger than their files"))?;
        self.pictures.push(Texture {
            name: name.into(),
            bytes: bytes.into(),
        });
        Ok(self.pictures.len() as i32 - 1)
    }

    /// Sets the texture of all triangles that have none yet.
    pub(super) fn texture(&mut self, number: i32) {
        self.textures.resize(self.triangles.len(), number);
    }

    /// Finishes the mesh and returns it with what was assumed. Where there are vertices but no
    /// triangles, it is a point cloud if files of the format can hold one. Colours and texture coordinates that only
    /// some of the vertices have are left out.
    pub(super) fn into_mesh(mut self, can_be_cloud: bool) -> Result<(Mesh, Vec<Assumption>)> {
        let (vertices, triangles) = (self.positions.len(), self.triangles.len());
        if vertices == 0 && triangles == 0 {
            let reason = "there are neither faces nor points in it";
            return Err(not_read(reason));
        }
        let cloud = self.triangles.is_empty() && vertices > 0 && can_be_cloud;
        if self.has_lines && cloud {
            let words =
                "the lines in it are left out, and their ends are a point cloud: it has no faces";
            self.assumptions
                .push(Assumption::new("points", words, None));
        }
        if self.crossed_polygons > 0 {
            let words = format!(
                "sides cross in {} of its polygons, or are more than {MAX_POLYGON_CORNERS}: their triangles overlap",
                self.crossed_polygons
            );
            self.assumptions
                .push(Assumption::new("polygons", words, None));
        }
        let mut mesh = if cloud {
            Mesh::cloud(self.positions)
        } else {
            Mesh::new(self.positions, self.triangles)
        }?;
        if self.colors.len() == vertices
            && self
                .colors
                .iter()
                .any(|color| *color != DEFAULT_VERTEX_COLOUR)
        {
            mesh = mesh.with_colors(self.colors)?;
        }
        let textured = self.textures.iter().any(|number| *number != NO_TEXTURE);
        let complete = self.uvs.len() == vertices;
        if complete && (textured || !self.uvs.contains(&NO_UV)) {
            let without = self.uvs.iter_mut().filter(|uv| **uv == NO_UV);
            without.for_each(|uv| *uv = [0.0; 2]);
            mesh = mesh.with_uvs(self.uvs)?;
            if textured {
                self.textures.resize(triangles, NO_TEXTURE);
                mesh = mesh.with_textures(self.textures)?;
            }
        }
        Ok((mesh, self.assumptions))
    }
}

/// Largest channel of a colour from 0 to 1 that is brighter than white, as renders have them; more are levels up to 255.
const MAX_LIGHT: f32 = 16.0;

/// Brings colours from 0 to 255 to those from 0 to 1, if all are whole numbers and some are more than 1, or some are more than
/// any light.
pub(super) fn scale_levels<'a>(colors: impl Iterator<Item = &'a mut [f32; 3]>) {
    let colors: Vec<_> = colors.collect();
    let components = || colors.iter().flat_map(|color| color.iter());
    let are_whole = || components().all(|v| v.fract() == 0.0);
    let largest = components().copied().fold(0.0, f32::max);
    if largest > MAX_LIGHT || largest > 1.0 && are_whole() {
        colors
            .into_iter()
            .for_each(|color| *color = color.map(|v| v / 255.0));
    }
}

fn push<T>(list: &mut Vec<T>, value: T, limit: usize) -> Result<()> {
    if list.len() >= limit {
        return Err(Error::TooLarge {
            what: "mesh",
            requested: limit + 1,
            limit,
        });
    }
    // Memory is checked only where the list has to grow, because only that takes time.
    if list.len() == list.capacity() {
        list.try_reserve(1).map_err(|_| Error::OutOfMemory {
            what: "mesh",
            bytes: list.len() * size_of::<T>(),
        })?;
    }
    list.push(value);
    Ok(())
}
