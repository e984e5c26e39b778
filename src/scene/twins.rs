//! Which sides of triangles lie on each other.

/// Of a side without another one.
pub(crate) const NONE: u32 = u32::MAX;

/// Side `3 t + k` goes from corner `k` of triangle `t` to the next one.
pub(crate) fn ends(triangles: &[[u32; 3]], side: u32) -> [u32; 2] {
    let (triangle, k) = (&triangles[side as usize / 3], side as usize % 3);
    [triangle[k], triangle[(k + 1) % 3]]
}

/// The next side of the same triangle.
pub(crate) fn next(side: u32) -> u32 {
    match side % 3 {
        2 => side - 2,
        _ => side + 1,
    }
}

/// For each side the one of another triangle that has the same ends; [`NONE`] on borders. The triangles are
/// those of a surface: two at most along each edge.
pub(crate) fn twins(triangles: &[[u32; 3]]) -> Vec<u32> {
    let sides = 0..3 * triangles.len() as u32;
    let mut sorted: Vec<(u32, u32, u32)> = sides
        .map(|side| {
            let [a, b] = ends(triangles, side);
            (a.min(b), a.max(b), side)
        })
        .collect();
    sorted.sort_unstable();
    let mut twins = vec![NONE; sorted.len()];
    for pair in sorted.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if let [(.., one), (.., other)] = pair {
            (twins[*one as usize], twins[*other as usize]) = (*other, *one);
        }
    }
    twins
}
