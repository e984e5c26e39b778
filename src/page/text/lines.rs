//! Lines of text on each page.

use super::bands::Strips;
use super::baseline::{Baseline, together};
use super::ink::{Ink, Leaf};
use super::ranking::ranked;
use crate::dewarp::Photo;
use crate::page::edges::Trace;
use crate::page::find::CurledPage;

/// Half the heights of small letters that are looked for, in pixels of the ink.
const SCALES: [f64; 6] = [1.5, 2.2, 3.2, 4.7, 6.8, 10.0];

/// Most lines of one page.
const MOST: usize = 200;

/// Baselines of the lines of text on each page, in the photo's pixels.
pub(in crate::page) fn find(page: &CurledPage, photo: &Photo<'_>) -> Vec<Vec<Trace>> {
    (0..page.pages())
        .map(|number| on_page(page, number, photo).unwrap_or_default())
        .collect()
}

fn on_page(page: &CurledPage, number: usize, photo: &Photo<'_>) -> Option<Vec<Trace>> {
    let leaf = Leaf::new(page, number);
    let ink = Ink::new(&leaf, photo)?;
    let strips = Strips::new(&ink);
    let mut by_scale: Vec<Vec<Baseline>> = SCALES
        .iter()
        .map(|sigma| {
            let (fine, own) = (strips.smoothed(0.5 * sigma), strips.smoothed(*sigma));
            (own.bands(*sigma, strips.step).iter())
                .filter_map(|band| Baseline::new(band, &fine, *sigma, strips.step))
                .collect()
        })
        .collect();
    // The size that most of the text has comes first.
    let points = |lines: &Vec<Baseline>| lines.iter().map(|line| line.points.len()).sum::<usize>();
    let sizes: Vec<f64> = by_scale.iter().map(|own| -(points(own) as f64)).collect();
    let mut chosen: Vec<Baseline> = Vec::new();
    for line in (ranked(&sizes).into_iter()).flat_map(|k| std::mem::take(&mut by_scale[k])) {
        if !chosen.iter().any(|other| line.covers(other)) {
            chosen.push(line);
        }
    }
    let lines = together(chosen);
    let levels: Vec<f64> = lines.iter().map(|line| line.level).collect();
    let step = lines.len().div_ceil(MOST).max(1);
    let [width, height] = [ink.width, ink.height].map(|n| n as f64);
    (ranked(&levels).into_iter().step_by(step))
        .map(|k| {
            let line = &lines[k];
            let points: Option<Vec<_>> = (line.points.iter())
                // A row's number is that of its middle.
                .map(|[x, y]| leaf.seen([x / width, (y + 0.5) / height]))
                .collect();
            points.map(Trace::Points)
        })
        .collect()
}
