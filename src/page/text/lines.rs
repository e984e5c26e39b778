//! Detection of the baselines of lines of text on flattened pages.

use super::bands::StripProfiles;
use super::baseline::Baseline;
use super::ink::InkImage;
use super::ranking::ranked;

/// Half x-heights of the letters for which lines of text are searched, in pixels of the ink image.
const X_HEIGHT_SCALES: [f64; 6] = [1.5, 2.2, 3.2, 4.7, 6.8, 10.0];

/// Finds the baselines on one flat page that is seen with `size` (width and height, in pixels), as points in shares of its
/// width and height. `brightness` gives the photo's at such shares.
pub(in crate::page) fn find_baselines(
    size: [f64; 2],
    brightness: impl Fn([f64; 2]) -> f32,
) -> Vec<Vec<[f64; 2]>> {
    let ink = InkImage::new(size, brightness);
    let strips = StripProfiles::new(&ink);
    let mut by_scale: Vec<Vec<Baseline>> = X_HEIGHT_SCALES
        .iter()
        .map(|sigma| {
            let (fine, own) = (strips.smoothed(0.5 * sigma), strips.smoothed(*sigma));
            (own.bands(*sigma, strips.step).iter())
                .filter_map(|band| Baseline::new(band, &fine, *sigma, strips.step))
                .collect()
        })
        .collect();
    // The scale with the most text comes first.
    let points = |lines: &Vec<Baseline>| lines.iter().map(|line| line.points.len()).sum::<usize>();
    let sizes: Vec<f64> = by_scale.iter().map(|own| -(points(own) as f64)).collect();
    let mut chosen: Vec<Baseline> = Vec::new();
    for line in (ranked(&sizes).into_iter()).flat_map(|k| std::mem::take(&mut by_scale[k])) {
        if !chosen.iter().any(|other| line.covers(other)) {
            chosen.push(line);
        }
    }
    let levels: Vec<f64> = chosen.iter().map(|line| line.level).collect();
    let [width, height] = [ink.width, ink.height].map(|n| n as f64);
    (ranked(&levels).into_iter())
        .map(|k| {
            (chosen[k].points.iter())
                // Rows are counted at their middles.
                .map(|[x, y]| [x / width, (y + 0.5) / height])
                .collect()
        })
        .collect()
}

/// Whether the print on one flat page, which is seen as for [`find_baselines`], seems to be upside down.
pub(in crate::page) fn is_upside_down(
    size: [f64; 2],
    brightness: impl Fn([f64; 2]) -> f32,
) -> bool {
    StripProfiles::new(&InkImage::new(size, brightness)).upside_down() > 0.0
}
