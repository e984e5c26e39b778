//! Where a seam is divided of which only a part fits.

use crate::unroll::flat_triangle::Point;

/// Minimum number of nodes (ends of edges) of each part of a seam that is divided.
/// `benches/patterns.md` has what others give.
const MIN_SEAM_PART_NODES: usize = 4;

/// Computes where to divide a seam, as node numbers along it, first and last included: around the longest part whose
/// sides fit.
pub(super) fn divided(sides: &[Vec<Point>; 2], gap: f64, fine: f64) -> Vec<usize> {
    let last = sides[0].len() - 1;
    let whole = vec![0, last];
    // Prefix sums of lengths and moments, so that the gap of any part takes constant time.
    let mut lengths = vec![0.0; last + 1];
    for i in 0..last {
        lengths[i + 1] = lengths[i] + (sides[0][i + 1] - sides[0][i]).norm();
    }
    let zero = (Point::default(), Point::default(), Point::default(), 0.0);
    let mut moments = vec![zero];
    for (p, q) in sides[0].iter().zip(&sides[1]) {
        let (a, b, c, d) = moments[moments.len() - 1];
        moments.push((
            a + p,
            b + q,
            c + p.conj() * q,
            d + p.norm_sqr() + q.norm_sqr(),
        ));
    }
    let fits = |from: usize, to: usize| {
        let ((a, b, c, d), (e, f, g, h)) = (moments[to + 1], moments[from]);
        let count = (to + 1 - from) as f64;
        let (p, q) = (a - e, b - f);
        let correlation = c - g - p.conj() * q / count;
        let squares = d - h - (p.norm_sqr() + q.norm_sqr()) / count;
        let apart = ((squares - 2.0 * correlation.norm()) / count)
            .max(0.0)
            .sqrt();
        apart <= (gap * (lengths[to] - lengths[from])).max(fine)
    };
    if last < 8 || fits(0, last) {
        return whole;
    }
    let mut best = (0.0, 0, 0);
    for from in (0..last).step_by(1 + last / 128) {
        // Longest part that fits from here: search with growing steps, then with shrinking ones.
        let (mut to, mut step) = (from + 2, 1);
        while to + step <= last && fits(from, to + step) {
            to += step;
            step *= 2;
        }
        while step > 0 {
            if to + step <= last && fits(from, to + step) {
                to += step;
            }
            step /= 2;
        }
        let is_long = to <= last && to - from >= MIN_SEAM_PART_NODES;
        if is_long && fits(from, to) && lengths[to] - lengths[from] > best.0 {
            best = (lengths[to] - lengths[from], from, to);
        }
    }
    let (_, mut from, mut to) = best;
    if to == 0 {
        return whole;
    }
    if from < MIN_SEAM_PART_NODES {
        from = 0;
    }
    if last - to < MIN_SEAM_PART_NODES {
        to = last;
    }
    let mut ends = vec![0, from, to, last];
    ends.dedup();
    ends
}
