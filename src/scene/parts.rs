//! Removal of small connected components from a mesh.

use super::mesh::Mesh;
use crate::error::{Result, try_filled};
use crate::math::union_find::UnionFind;

/// Number of triangles below which a connected component is a scrap, as a share of the largest component's.
const MAX_SCRAP_SHARE: f64 = 0.25;

impl Mesh {
    /// Removes scraps from the mesh: connected components with less than a quarter of the largest one's triangles. In
    /// depths cropped to a page, scraps are mostly background that is visible beside a bent edge. Vertices keep their
    /// indices. Linear cost.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
    pub fn without_scraps(self) -> Result<Mesh> {
        let mut sets = UnionFind::new("parts of a mesh", self.positions().len())?;
        for [a, b, c] in self.triangles() {
            sets.union(*a, *b);
            sets.union(*b, *c);
        }
        let mut counts = try_filled("parts of a mesh", self.positions().len(), 0usize)?;
        for triangle in self.triangles() {
            counts[sets.find(triangle[0]) as usize] += 1;
        }
        let most = counts.iter().copied().max().unwrap_or(0);
        Ok(self.keep(|[first, ..]| {
            counts[sets.find(first) as usize] as f64 >= MAX_SCRAP_SHARE * most as f64
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_small_beside_the_largest_part_goes() {
        // Strips of 8, 1, 2 and 3 triangles.
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for (strip, count) in [8u32, 1, 2, 3].into_iter().enumerate() {
            let first = positions.len() as u32;
            let place = |k: u32| [f64::from(k / 2), f64::from(k % 2), strip as f64];
            positions.extend((0..count + 2).map(place));
            triangles.extend((0..count).map(|k| [first + k, first + k + 1, first + k + 2]));
        }
        let mesh = Mesh::new(positions, triangles).unwrap();
        let uvs = vec![[0.5; 2]; mesh.positions().len()];
        let kept = mesh
            .clone()
            .with_uvs(uvs)
            .unwrap()
            .without_scraps()
            .unwrap();
        let heights = kept
            .triangles()
            .iter()
            .map(|t| kept.positions()[t[0] as usize][2]);
        let count = |strip: f64| heights.clone().filter(|z| *z == strip).count();
        assert_eq!([0.0, 1.0, 2.0, 3.0].map(count), [8, 0, 2, 3]);
        assert_eq!(kept.positions(), mesh.positions());
        assert!(kept.uvs().is_some());
    }
}
