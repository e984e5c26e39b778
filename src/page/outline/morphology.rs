//! Maximum, minimum and mean filters over squares of pixels, and the grey closing that suppresses print.

use super::planes::Planes;

/// Number of rows that are transposed together: what is written to a row of the result fills a line of the cache.
const TRANSPOSED_ROWS: usize = 16;

/// Exchanges rows and columns of a plane.
fn transposed<T: Copy + Default>(plane: &[T], width: usize) -> Vec<T> {
    let height = plane.len() / width;
    let mut out = vec![T::default(); plane.len()];
    for (band, rows) in plane.chunks(TRANSPOSED_ROWS * width).enumerate() {
        for (x, column) in out.chunks_exact_mut(height).enumerate() {
            let column = &mut column[band * TRANSPOSED_ROWS..];
            for (value, row) in column.iter_mut().zip(rows.chunks_exact(width)) {
                *value = row[x];
            }
        }
    }
    out
}

/// Replaces each pixel by the extreme value (as the function `extreme` chooses) among itself and `radius` neighbours above
/// and below it, by the algorithm of van Herk, Gil and Werman.
pub(in crate::page) fn vertical_extreme<T: Copy>(
    plane: &mut [T],
    width: usize,
    radius: usize,
    extreme: impl Fn(T, T) -> T,
) {
    let (height, window) = (plane.len() / width, 2 * radius + 1);
    let total = height + 2 * radius;
    let row = |i: usize| &plane[i.saturating_sub(radius).min(height - 1) * width..][..width];
    let mut prefix: Vec<T> = (0..total).flat_map(row).copied().collect();
    let mut suffix = prefix.clone();
    let extend = |values: &mut [T], by: &[T]| {
        for (value, by) in values.iter_mut().zip(by) {
            *value = extreme(*value, *by);
        }
    };
    for i in 1..total {
        if !i.is_multiple_of(window) {
            let (before, from) = prefix.split_at_mut(i * width);
            extend(&mut from[..width], &before[(i - 1) * width..]);
        }
        let j = total - 1 - i;
        if !(j + 1).is_multiple_of(window) {
            let (until, after) = suffix.split_at_mut((j + 1) * width);
            extend(&mut until[j * width..], &after[..width]);
        }
    }
    plane.copy_from_slice(&suffix[..plane.len()]);
    extend(plane, &prefix[2 * radius * width..]);
}

/// Returns a plane in which each pixel is the extreme value in a square with sides of `2 radius + 1` pixels around it.
pub(in crate::page) fn square_extreme<T: Copy + Default>(
    plane: &[T],
    width: usize,
    radius: usize,
    extreme: impl Fn(T, T) -> T,
) -> Vec<T> {
    let height = plane.len() / width;
    let mut across = transposed(plane, width);
    vertical_extreme(&mut across, height, radius, &extreme);
    let mut found = transposed(&across, height);
    vertical_extreme(&mut found, width, radius, extreme);
    found
}

/// Applies a grey closing to a plane, by a square with sides of `2 radius + 1` pixels, or an opening if `max` and `min` are
/// exchanged. The image is continued beyond its rim, so that a narrow strip along the rim remains.
pub(in crate::page) fn closed_plane<T: Copy + Default>(
    plane: &[T],
    width: usize,
    radius: usize,
    max: impl Fn(T, T) -> T,
    min: impl Fn(T, T) -> T,
) -> Vec<T> {
    let height = plane.len() / width;
    let padded_width = width + 2 * radius;
    let mut padded = Vec::with_capacity(padded_width * (height + 2 * radius));
    for y in 0..height + 2 * radius {
        let own = &plane[y.saturating_sub(radius).min(height - 1) * width..][..width];
        padded.extend(std::iter::repeat_n(own[0], radius));
        padded.extend(own);
        padded.extend(std::iter::repeat_n(own[width - 1], radius));
    }
    let dilated = square_extreme(&padded, padded_width, radius, max);
    let closed = square_extreme(&dilated, padded_width, radius, min);
    (closed.chunks_exact(padded_width).skip(radius).take(height))
        .flat_map(|row| row[radius..radius + width].iter().copied())
        .collect()
}

/// Applies a grey closing by a square with sides of `2 radius + 1` pixels: dark print narrower than that takes the
/// paper's colour. The image is continued beyond its rim, so that a narrow strip of background along the rim remains. All
/// values have to be finite.
pub(in crate::page) fn closed(planes: &Planes, radius: usize) -> Planes {
    let max = |a: f32, b: f32| if a > b { a } else { b };
    let min = |a: f32, b: f32| if a < b { a } else { b };
    Planes {
        channels: (planes.channels.each_ref())
            .map(|plane| closed_plane(plane, planes.width, radius, max, min)),
        ..*planes
    }
}

/// Replaces each pixel by the mean over a square with sides of `2 radius + 1` pixels around it, clipped to the image.
pub(in crate::page) fn box_mean(plane: &mut [f32], width: usize, height: usize, radius: usize) {
    vertical_mean(plane, width, radius);
    let mut across = transposed(plane, width);
    vertical_mean(&mut across, height, radius);
    plane.copy_from_slice(&transposed(&across, height));
}

/// Replaces each pixel by the mean of itself and `radius` neighbours above and below it, clipped to the image.
pub(super) fn vertical_mean(plane: &mut [f32], width: usize, radius: usize) {
    let height = plane.len() / width;
    let source = plane.to_vec();
    let row = |y: usize| &source[y * width..][..width];
    let mut sums = vec![0.0_f64; width];
    let mut end = 0;
    for (y, out) in plane.chunks_exact_mut(width).enumerate() {
        while end < (y + radius + 1).min(height) {
            for (sum, value) in sums.iter_mut().zip(row(end)) {
                *sum += f64::from(*value);
            }
            end += 1;
        }
        if let Some(left) = y.checked_sub(radius + 1) {
            for (sum, value) in sums.iter_mut().zip(row(left)) {
                *sum -= f64::from(*value);
            }
        }
        let count = (end - y.saturating_sub(radius)) as f64;
        for (value, sum) in out.iter_mut().zip(&sums) {
            *value = (sum / count) as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closings_and_means_are_those_of_each_window() {
        let (width, height) = (13, 9);
        let plane: Vec<f32> = (0..width * height)
            .map(|i| ((i * 7919) % 31) as f32)
            .collect();
        let at = |plane: &[f32], x: isize, y: isize| {
            let [x, y] =
                [(x, width), (y, height)].map(|(v, n)| v.clamp(0, n as isize - 1) as usize);
            plane[y * width + x]
        };
        for radius in [1, 2, 7] {
            let r = radius as isize;
            let window = move |x: isize, y: isize| {
                (y - r..=y + r).flat_map(move |v| (x - r..=x + r).map(move |u| (u, v)))
            };
            let planes = Planes {
                width,
                height,
                channels: [const { Vec::new() }; 3].map(|_: Vec<f32>| plane.clone()),
                scale: 1.0,
            };
            let closing = closed(&planes, radius);
            let mut mean = plane.clone();
            box_mean(&mut mean, width, height, radius);
            let largest = |x, y| {
                let values = window(x, y).map(|(u, v)| at(&plane, u, v));
                values.fold(f32::MIN, f32::max)
            };
            for (i, found) in mean.iter().enumerate() {
                let (x, y) = ((i % width) as isize, (i / width) as isize);
                let expected = window(x, y).map(|(u, v)| largest(u, v));
                let expected = expected.fold(f32::MAX, f32::min);
                assert_eq!(closing.channels[1][i], expected, "{i} of {radius}");
                let inside = window(x, y).filter(|(u, v)| {
                    (0..width as isize).contains(u) && (0..height as isize).contains(v)
                });
                let values: Vec<f32> = inside.map(|(u, v)| at(&plane, u, v)).collect();
                let expected = values.iter().sum::<f32>() / values.len() as f32;
                assert!((found - expected).abs() < 1e-4, "{i} of {radius}");
            }
        }
    }
}
