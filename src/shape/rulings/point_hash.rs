//! A spatial hash that tells whether a point is near others.

use std::collections::HashMap;

/// A spatial hash (points sorted into cubic cells) of points in `N` dimensions, each with an attribute.
pub(super) struct PointHash<const N: usize, T> {
    /// Side of the cells into which space is divided, in the points' unit.
    pub cell_size: f64,
    cells: HashMap<[i64; N], Vec<([f64; N], T)>>,
}

impl<const N: usize, T> PointHash<N, T> {
    pub(super) fn new(cell_size: f64) -> Self {
        PointHash {
            cell_size,
            cells: HashMap::new(),
        }
    }

    fn cell(&self, place: [f64; N]) -> [i64; N] {
        place.map(|v| (v / self.cell_size).floor() as i64)
    }

    pub(super) fn add(&mut self, place: [f64; N], kind: T) {
        let cell = self.cell(place);
        self.cells.entry(cell).or_default().push((place, kind));
    }

    /// Returns whether a point whose attribute satisfies `counts` is nearer to a position than a distance, which is at
    /// most the side of a cell.
    pub(super) fn has_neighbour(
        &self,
        place: [f64; N],
        distance: f64,
        counts: impl Fn(&T) -> bool,
    ) -> bool {
        let middle = self.cell(place);
        let far = |p: &[f64; N]| (0..N).map(|k| (p[k] - place[k]).powi(2)).sum::<f64>();
        (0..3usize.pow(N as u32)).any(|number| {
            let mut cell = middle;
            for (k, index) in cell.iter_mut().enumerate() {
                *index += (number / 3usize.pow(k as u32) % 3) as i64 - 1;
            }
            let there = self.cells.get(&cell).into_iter().flatten();
            let mut near = there.filter(|(p, _)| far(p) < distance * distance);
            near.any(|(_, kind)| counts(kind))
        })
    }
}
