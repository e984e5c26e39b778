//! Maximum, minimum and mean filters over squares of pixels, and the grey closing that suppresses print.

use super::planes::Planes;

/// Applies a filter of one line of pixels to all rows, then to all columns.
fn apply_separably(
    plane: &mut [f32],
    width: usize,
    height: usize,
    mut filter: impl FnMut(&mut [f32]),
) {
    for row in plane.chunks_exact_mut(width) {
        filter(row);
    }
    let mut column = vec![0.0; height];
    for x in 0..width {
        for (value, row) in column.iter_mut().zip(plane.chunks_exact(width)) {
            *value = row[x];
        }
        filter(&mut column);
        for (value, row) in column.iter().zip(plane.chunks_exact_mut(width)) {
            row[x] = *value;
        }
    }
}

/// Replaces each pixel of a line by the extreme value (as the function `extreme` chooses) among itself and `radius`
/// neighbours on either side, by the algorithm of van Herk, Gil and Werman.
fn running_extreme(line: &mut [f32], radius: usize, extreme: fn(f32, f32) -> f32) {
    let (n, window) = (line.len(), 2 * radius + 1);
    let padded = |i: usize| line[i.saturating_sub(radius).min(n - 1)];
    let total = n + 2 * radius;
    let mut prefix: Vec<f32> = (0..total).map(padded).collect();
    let mut suffix = prefix.clone();
    for i in 1..total {
        if !i.is_multiple_of(window) {
            prefix[i] = extreme(prefix[i], prefix[i - 1]);
        }
        let j = total - 1 - i;
        if !(j + 1).is_multiple_of(window) {
            suffix[j] = extreme(suffix[j], suffix[j + 1]);
        }
    }
    for (i, value) in line.iter_mut().enumerate() {
        *value = extreme(suffix[i], prefix[i + 2 * radius]);
    }
}

/// Applies a grey closing by a square with sides of `2 radius + 1` pixels: dark print narrower than that takes the
/// paper's colour. The image is continued beyond its rim, so that a narrow strip of background along the rim remains.
pub(in crate::page) fn closed(planes: &Planes, radius: usize) -> Planes {
    let (width, height) = (planes.width + 2 * radius, planes.height + 2 * radius);
    let channels = planes.channels.each_ref().map(|plane| {
        let row = |y: usize| {
            let y = y.saturating_sub(radius).min(planes.height - 1);
            &plane[y * planes.width..(y + 1) * planes.width]
        };
        let mut padded = Vec::with_capacity(width * height);
        for y in 0..height {
            let own = row(y);
            padded.extend(std::iter::repeat_n(own[0], radius));
            padded.extend(own);
            padded.extend(std::iter::repeat_n(own[planes.width - 1], radius));
        }
        for extreme in [f32::max, f32::min] {
            apply_separably(&mut padded, width, height, |line| {
                running_extreme(line, radius, extreme);
            });
        }
        (padded.chunks_exact(width).skip(radius).take(planes.height))
            .flat_map(|row| row[radius..radius + planes.width].iter().copied())
            .collect()
    });
    Planes {
        channels,
        ..*planes
    }
}

/// Replaces each pixel by the mean over a square with sides of `2 radius + 1` pixels around it, clipped to the image.
pub(in crate::page) fn box_mean(plane: &mut [f32], width: usize, height: usize, radius: usize) {
    let mut sums = Vec::new();
    apply_separably(plane, width, height, |line| {
        sums.clear();
        sums.push(0.0);
        let mut sum = 0.0_f64;
        for value in line.iter() {
            sum += f64::from(*value);
            sums.push(sum);
        }
        let n = line.len();
        for (i, value) in line.iter_mut().enumerate() {
            let (from, to) = (i.saturating_sub(radius), (i + radius + 1).min(n));
            *value = ((sums[to] - sums[from]) / (to - from) as f64) as f32;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_and_means_are_those_of_each_window() {
        let line: Vec<f32> = (0..23).map(|i| ((i * 7919) % 31) as f32).collect();
        for radius in [1, 2, 5, 30] {
            let window = |i: usize| &line[i.saturating_sub(radius)..(i + radius + 1).min(23)];
            let mut largest = line.clone();
            running_extreme(&mut largest, radius, f32::max);
            let mut mean = line.clone();
            box_mean(&mut mean, 23, 1, radius);
            for i in 0..23 {
                let expected = window(i).iter().copied().fold(f32::MIN, f32::max);
                assert_eq!(largest[i], expected, "{i} of {radius}");
                let expected = window(i).iter().sum::<f32>() / window(i).len() as f32;
                assert!((mean[i] - expected).abs() < 1e-4, "{i} of {radius}");
            }
        }
    }
}
