//! A spatial hash that tells whether a point is near others.

use rustc_hash::FxHashMap;

/// A spatial hash (points sorted into cubic cells) of points in space, each with an attribute.
pub(super) struct PointHash<T> {
    /// Side of the cells into which space is divided, in the points' unit.
    pub cell_size: f64,
    cells: FxHashMap<[i64; 3], Vec<([f64; 3], T)>>,
}

impl<T> PointHash<T> {
    pub(super) fn new(cell_size: f64) -> Self {
        PointHash {
            cell_size,
            cells: FxHashMap::default(),
        }
    }

    fn cell(&self, place: [f64; 3]) -> [i64; 3] {
        place.map(|v| (v / self.cell_size).floor() as i64)
    }

    pub(super) fn add(&mut self, place: [f64; 3], kind: T) {
        let cell = self.cell(place);
        self.cells.entry(cell).or_default().push((place, kind));
    }

    /// Returns whether a point whose attribute satisfies `counts` is nearer to a position than a distance, which is at
    /// most the side of a cell.
    pub(super) fn has_neighbour(
        &self,
        place: [f64; 3],
        distance: f64,
        counts: impl Fn(&T) -> bool,
    ) -> bool {
        let middle = self.cell(place);
        let far = |p: &[f64; 3]| (0..3).map(|k| (p[k] - place[k]).powi(2)).sum::<f64>();
        (0..27).any(|number| {
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
