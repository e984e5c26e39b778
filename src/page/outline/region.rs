//! Connected regions of a mask, with holes filled, and their borders.

/// A connected region of a mask, without holes.
pub(super) struct Region {
    /// Whether each pixel of the image belongs to the region, row by row.
    pub mask: Vec<bool>,
    /// Number of pixels in the region.
    pub area: usize,
}

/// Finds the pixels that are connected to `start` and satisfy `takes` (flood fill), and marks them in `seen`.
pub(in crate::page) fn flood(
    start: usize,
    width: usize,
    seen: &mut [bool],
    takes: impl Fn(usize) -> bool,
) -> Vec<usize> {
    let len = seen.len();
    let mut found = vec![start];
    seen[start] = true;
    let mut next = 0;
    while next < found.len() {
        let i = found[next];
        let beside = [
            (!i.is_multiple_of(width)).then(|| i - 1),
            (!(i + 1).is_multiple_of(width)).then_some(i + 1),
            i.checked_sub(width),
            (i + width < len).then_some(i + width),
        ];
        for j in beside.into_iter().flatten() {
            if !seen[j] && takes(j) {
                seen[j] = true;
                found.push(j);
            }
        }
        next += 1;
    }
    found
}

/// Finds the connected components of a mask with at least `min_area` pixels, and fills their holes.
pub(super) fn regions(mask: &[bool], width: usize, min_area: usize) -> Vec<Region> {
    let mut seen = vec![false; mask.len()];
    let mut found = Vec::new();
    for start in 0..mask.len() {
        if mask[start] && !seen[start] {
            let pixels = flood(start, width, &mut seen, |j| mask[j]);
            if pixels.len() >= min_area {
                found.push(without_holes(&pixels, mask.len(), width));
            }
        }
    }
    found
}

/// Makes a region of connected pixels, and of all pixels that they enclose.
fn without_holes(pixels: &[usize], len: usize, width: usize) -> Region {
    let mut own = vec![false; len];
    pixels.iter().for_each(|i| own[*i] = true);
    let mut outside = vec![false; len];
    let height = len / width;
    let rim = (0..width)
        .flat_map(|x| [x, (height - 1) * width + x])
        .chain((0..height).flat_map(|y| [y * width, y * width + width - 1]));
    for start in rim {
        if !own[start] && !outside[start] {
            flood(start, width, &mut outside, |j| !own[j]);
        }
    }
    let mask: Vec<bool> = outside.iter().map(|out| !out).collect();
    let area = mask.iter().filter(|inside| **inside).count();
    Region { mask, area }
}

impl Region {
    /// Traces the pixels along the region's border, clockwise as seen in the image (Moore's algorithm).
    pub fn border(&self, width: usize) -> Vec<[f64; 2]> {
        const NEIGHBOUR_OFFSETS: [[i32; 2]; 8] = [
            [1, 0],
            [1, 1],
            [0, 1],
            [-1, 1],
            [-1, 0],
            [-1, -1],
            [0, -1],
            [1, -1],
        ];
        let height = self.mask.len() / width;
        let has = |[x, y]: [i32; 2]| {
            x >= 0
                && y >= 0
                && (x as usize) < width
                && (y as usize) < height
                && self.mask[y as usize * width + x as usize]
        };
        let Some(first) = self.mask.iter().position(|inside| *inside) else {
            return Vec::new();
        };
        let start = [(first % width) as i32, (first / width) as i32];
        let mut border = vec![start];
        let (mut at, mut way, mut first_way) = (start, 0, None);
        while border.len() < 4 * self.mask.len() {
            // From the pixel to the left of the way back, clockwise.
            let step = (0..8).map(|k| (way + 6 + k) % 8).find(|k| {
                has([
                    at[0] + NEIGHBOUR_OFFSETS[*k][0],
                    at[1] + NEIGHBOUR_OFFSETS[*k][1],
                ])
            });
            let Some(step) = step else { break };
            if at == start && first_way == Some(step) {
                border.pop();
                break;
            }
            first_way = first_way.or(Some(step));
            way = step;
            at = [
                at[0] + NEIGHBOUR_OFFSETS[way][0],
                at[1] + NEIGHBOUR_OFFSETS[way][1],
            ];
            border.push(at);
        }
        border.into_iter().map(|at| at.map(f64::from)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_has_no_hole_and_the_border_of_its_square() {
        let width = 12;
        let inside = |i: usize, from: usize, to: usize| {
            let (x, y) = (i % width, i / width);
            x >= from && x < to && y >= from && y < to
        };
        let mut mask: Vec<bool> = (0..144)
            .map(|i| inside(i, 2, 9) && !inside(i, 4, 7))
            .collect();
        mask[11] = true; // A speck.
        let found = regions(&mask, width, 2);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].area, 49);
        let border = found[0].border(width);
        assert_eq!(border.len(), 24);
        // Clockwise in an image, whose rows go down.
        assert_eq!(border[..3], [[2.0, 2.0], [3.0, 2.0], [4.0, 2.0]]);
        assert_eq!(regions(&mask, width, 1).len(), 2);
    }
}
