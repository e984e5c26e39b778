//! The best path across an image, by dynamic programming: along a page's edge, or along a fold.

/// Finds the path with the largest sum of worths minus the cost of its sideways steps: in each row its place, which moves by
/// at most one from row to row (Viterbi algorithm). Of equal ones the lowest place is taken. `rows` have the worth of each
/// place and are of equal length.
pub(super) fn best_path<'a>(rows: impl Iterator<Item = &'a [f32]>, step_cost: f32) -> Vec<usize> {
    let mut sums: Vec<f32> = Vec::new();
    let mut sources: Vec<Vec<u32>> = Vec::new();
    for row in rows {
        let before = std::mem::replace(&mut sums, row.to_vec());
        if before.is_empty() {
            continue;
        }
        let mut source = vec![0; row.len()];
        for (place, (sum, source)) in sums.iter_mut().zip(&mut source).enumerate() {
            let reached = |from: usize| before[from] - if from == place { 0.0 } else { step_cost };
            let near = place.saturating_sub(1)..(place + 2).min(before.len());
            let from = highest(near, reached);
            *sum += reached(from);
            *source = from as u32;
        }
        sources.push(source);
    }
    let mut path = vec![highest(0..sums.len(), |place| sums[place])];
    for source in sources.iter().rev() {
        path.push(source[path[path.len() - 1]] as usize);
    }
    path.reverse();
    path
}

/// The first place with the highest value.
fn highest(places: std::ops::Range<usize>, value: impl Fn(usize) -> f32) -> usize {
    let first = places.start;
    places.fold(first, |best, place| {
        if value(place) > value(best) {
            place
        } else {
            best
        }
    })
}
