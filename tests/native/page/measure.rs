//! How far what is on a flat page is from where it belongs.

use developable::page::CurledPage;

use super::scene::Scene;

/// A place on the flat page, and where what is there belongs.
type Pair = ([f64; 2], [f64; 2]);

/// Root mean square of the displacements after the best similarity, in % of a page's width.
pub fn displacement(page: &CurledPage, scene: &Scene) -> f64 {
    let pages = scene.pages();
    let [width, height] = page.flat_size();
    let mut pairs = Vec::new();
    for i in 0..20 * pages {
        for j in 0..20 {
            let share = [
                (i as f64 + 0.5) / (20 * pages) as f64,
                (j as f64 + 0.5) / 20.0,
            ];
            let pixel = page.photo_place(share).unwrap();
            let number = i / 20;
            let near = [share[0] * pages as f64 - number as f64, share[1]];
            let truth = scene.on_page(number, near, pixel);
            pairs.push(([share[0] * width, share[1] * height], truth));
        }
    }
    100.0 * similarity(&pairs) / scene.sides[0]
}

/// What is left of the distances between pairs after turning, scaling and shifting the first ones:
/// regression of complex numbers.
fn similarity(pairs: &[Pair]) -> f64 {
    let n = pairs.len() as f64;
    let (mut from, mut to) = ([0.0; 2], [0.0; 2]);
    for (p, q) in pairs {
        for k in 0..2 {
            from[k] += p[k] / n;
            to[k] += q[k] / n;
        }
    }
    let (mut re, mut im, mut pp, mut qq) = (0.0, 0.0, 0.0, 0.0);
    for (p, q) in pairs {
        let [a, b] = [p[0] - from[0], p[1] - from[1]];
        let [c, d] = [q[0] - to[0], q[1] - to[1]];
        re += a * c + b * d;
        im += a * d - b * c;
        pp += a * a + b * b;
        qq += c * c + d * d;
    }
    ((qq - (re * re + im * im) / pp).max(0.0) / n).sqrt()
}
