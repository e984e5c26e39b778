//! Cells of a flat page that show paper, as opposed to pictures, coloured areas and what lies beside the page.

use nalgebra::{SMatrix, Vector3};

use crate::math::least_squares::LeastSquares;
use crate::page::outline::{Planes, box_mean};

/// Minimum brightness of shaded paper, as a share of the brightest paper's: below it a cell counts as dark print.
const MIN_SHADED_BRIGHTNESS: f32 = 0.28;

/// Quantile of the cells' brightness that is taken for the brightest paper's.
const BRIGHT_QUANTILE: f64 = 0.95;

/// Maximum difference of a cell's colour from the paper's, in logarithms of the ratios red to green and blue to green:
/// light in shadows differs by up to 0.15 from the lamp's, and a yellow marker by 0.4.
const MAX_COLOUR_DIFFERENCE: f32 = 0.2;

/// Number of times the paper's colour is fitted to the cells that are near to it.
const COLOUR_FITS: usize = 5;

/// Weight that keeps the gradient of the paper's colour near zero where few cells determine it.
const COLOUR_GRADIENT_RIDGE: f64 = 1.0;

/// Number of cells of which one is taken for the fit of the paper's colour.
const FIT_STRIDE: usize = 7;

/// Maximum difference of a cell from the brightest cells around it for plain paper, in logarithms.
const MAX_PLAIN_DIFFERENCE: f32 = 0.08;

/// Radius, in cells, of the window in which plain paper is counted: 3 mm on A4.
const PLAIN_RADIUS: usize = 8;

/// Minimum share of plain paper in a window: dense text has a third, a photograph next to none.
const MIN_PLAIN_SHARE: f32 = 0.15;

/// Number of cells around what is no paper that are not taken for paper either, because they show both.
const MARGIN_CELLS: usize = 2;

/// Clears in `known` the cells that show no paper. `raw` has the logarithmic colours of the cells, `closed` those
/// without print.
pub(super) fn find_paper(raw: &Planes, closed: &Planes, known: &mut [bool]) {
    let (width, height) = (raw.width, raw.height);
    let brightness =
        |planes: &Planes, i: usize| planes.channels.iter().map(|plane| plane[i]).sum::<f32>() / 3.0;
    let mut bright: Vec<f32> = (0..known.len())
        .filter(|i| known[*i])
        .map(|i| brightness(closed, i))
        .collect();
    if bright.is_empty() {
        return;
    }
    let rank = (BRIGHT_QUANTILE * (bright.len() - 1) as f64) as usize;
    let brightest = *bright.select_nth_unstable_by(rank, f32::total_cmp).1;
    let darkest = brightest + MIN_SHADED_BRIGHTNESS.ln();
    for (i, known) in known.iter_mut().enumerate() {
        *known &= brightness(closed, i) >= darkest;
    }
    let difference = |i: usize| {
        let [red, green, blue] = closed.channels.each_ref().map(|plane| plane[i]);
        [red - green, blue - green]
    };
    let colour = paper_colour(width, height, known, difference);
    let mut plain: Vec<f32> = (0..known.len())
        .map(|i| f32::from(brightness(raw, i) >= brightness(closed, i) - MAX_PLAIN_DIFFERENCE))
        .collect();
    box_mean(&mut plain, width, height, PLAIN_RADIUS);
    let mut other: Vec<f32> = (0..known.len())
        .map(|i| {
            let (found, expected) = (difference(i), colour(i));
            let near = (0..2).all(|k| (found[k] - expected[k]).abs() < MAX_COLOUR_DIFFERENCE);
            f32::from(!(known[i] && near && plain[i] >= MIN_PLAIN_SHARE))
        })
        .collect();
    box_mean(&mut other, width, height, MARGIN_CELLS);
    for (known, other) in known.iter_mut().zip(other) {
        // A sum of whole numbers, which is zero or not.
        *known &= other == 0.0;
    }
}

/// Fits the paper's colour as a linear function over the page, by least squares to the cells that are near to it; the
/// first guess is the median of all `known` cells.
fn paper_colour<D: Fn(usize) -> [f32; 2]>(
    width: usize,
    height: usize,
    known: &[bool],
    difference: D,
) -> impl Fn(usize) -> [f32; 2] + use<D> {
    let place = move |i: usize| {
        let [x, y] = [i % width, i / width].map(|at| at as f64);
        Vector3::new(1.0, x / width as f64 - 0.5, y / height as f64 - 0.5)
    };
    let sampled: Vec<usize> = (0..known.len())
        .step_by(FIT_STRIDE)
        .filter(|i| known[*i])
        .collect();
    let mut fitted = SMatrix::<f64, 3, 2>::zeros();
    for k in 0..2 {
        let mut values: Vec<f32> = sampled.iter().map(|i| difference(*i)[k]).collect();
        let middle = values.len() / 2;
        if !values.is_empty() {
            fitted[(0, k)] = f64::from(*values.select_nth_unstable_by(middle, f32::total_cmp).1);
        }
    }
    let colour = move |fitted: &SMatrix<f64, 3, 2>, i: usize| {
        let expected = fitted.transpose() * place(i);
        [expected[0] as f32, expected[1] as f32]
    };
    for _ in 0..COLOUR_FITS {
        let mut normal =
            LeastSquares::<3, 2>::with_ridge([1e-9, COLOUR_GRADIENT_RIDGE, COLOUR_GRADIENT_RIDGE]);
        for i in &sampled {
            let (found, expected) = (difference(*i), colour(&fitted, *i));
            if (0..2).all(|k| (found[k] - expected[k]).abs() < MAX_COLOUR_DIFFERENCE) {
                normal.add(&place(*i), found.map(f64::from), 1.0);
            }
        }
        match normal.solve() {
            Some(solution) => fitted = solution,
            None => break,
        }
    }
    move |i| colour(&fitted, i)
}
