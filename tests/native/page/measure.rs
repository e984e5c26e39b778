//! How far what is on a flat page is from where it belongs.

use developable::page::PageSurface;

use super::scene::Scene;
use crate::native::common::similarity;

/// Root mean square of the displacements after the best similarity, in % of a page's width.
pub fn displacement(page: &PageSurface, scene: &Scene) -> f64 {
    let pages = scene.pages();
    let [width, height] = page.flat_size();
    let mut pairs = Vec::new();
    for i in 0..20 * pages {
        for j in 0..20 {
            let share = [
                (i as f64 + 0.5) / (20 * pages) as f64,
                (j as f64 + 0.5) / 20.0,
            ];
            let pixel = page.photo_place(share);
            let number = i / 20;
            let near = [share[0] * pages as f64 - number as f64, share[1]];
            let truth = scene.on_page(number, near, pixel);
            pairs.push(([share[0] * width, share[1] * height], truth));
        }
    }
    100.0 * similarity(&pairs) / scene.sides[0]
}
