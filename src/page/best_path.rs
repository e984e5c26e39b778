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

/// Finds the path with the largest sum of worths minus its changes of direction: it is straight in strips of `strip` rows, moves
/// sideways by at most half as many places in each, and each place by which that changes costs 1. `worth` is given row by row,
/// `width` places each.
pub(super) fn smooth_path(worth: &[f32], width: usize, strip: usize) -> Vec<usize> {
    let half = strip / 2;
    // Numbers of slopes begin at the steepest one to the left.
    let slopes = 2 * half + 1;
    let place = |from: usize, slope: usize, row: usize| {
        let sideways = ((slope as isize - half as isize) * row as isize).div_euclid(strip as isize);
        from.checked_add_signed(sideways).filter(|at| *at < width)
    };
    // A state is a place between two strips with the slope before it.
    let mut sums = vec![0.0; width * slopes];
    let mut sources: Vec<Vec<usize>> = Vec::new();
    for rows in worth.chunks(strip * width) {
        let before = std::mem::replace(&mut sums, vec![f32::NEG_INFINITY; width * slopes]);
        let mut source = vec![0; width * slopes];
        for (from, slope) in (0..width * slopes).map(|i| (i / slopes, i % slopes)) {
            let Some(to) = place(from, slope, strip) else {
                continue;
            };
            let reached = |last: usize| before[from * slopes + last] - last.abs_diff(slope) as f32;
            let last = highest(0..slopes, reached);
            let own = (rows.chunks_exact(width).enumerate())
                .filter_map(|(row, worth)| Some(worth[place(from, slope, row)?]));
            sums[to * slopes + slope] = reached(last) + own.sum::<f32>();
            source[to * slopes + slope] = from * slopes + last;
        }
        sources.push(source);
    }
    let mut state = highest(0..sums.len(), |state| sums[state]);
    let mut path = Vec::new();
    for source in sources.iter().rev() {
        let (from, slope) = (source[state] / slopes, state % slopes);
        path.extend((0..strip).rev().filter_map(|row| place(from, slope, row)));
        state = source[state];
    }
    path.reverse();
    path.truncate(worth.len() / width);
    path
}

/// Position of the highest point of the parabola through three equidistant values, in steps from the middle one, from −0.5 to 0.5;
/// 0 where it has none.
pub(super) fn parabola_peak(values: [f32; 3]) -> f64 {
    let [a, b, c] = values.map(f64::from);
    let bend = 2.0 * b - a - c;
    if bend > 1e-6 {
        (0.5 * (c - a) / bend).clamp(-0.5, 0.5)
    } else {
        0.0
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_path_follows_a_slanting_edge_past_brighter_specks_beside_it() {
        let (width, rows) = (60, 100);
        let edge = |row: usize| 10 + row * 3 / 8;
        let mut worth = vec![-0.5_f32; width * rows];
        for row in 0..rows {
            worth[row * width + edge(row)] = 0.3;
            if row % 20 < 6 {
                worth[row * width + edge(row) + 6 - row % 2] = 0.5;
            }
        }
        let smooth = smooth_path(&worth, width, 8);
        assert_eq!(smooth.len(), rows);
        for (row, at) in smooth.iter().enumerate() {
            assert!(at.abs_diff(edge(row)) <= 1, "{row}: {at}, {}", edge(row));
        }
    }
}
