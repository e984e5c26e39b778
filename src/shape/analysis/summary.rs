//! Fields in figures.

use super::curvature::Curvatures;
use crate::error::{Error, Result, positive};
use crate::heights::heightfield::Heightfield;
use crate::heights::normalization::Normalization;

/// The Gaussian curvature, in normalised coordinates, from which on a vertex counts as curved in
/// two directions, unless another one is asked for: that of a sphere whose radius is the longer
/// side of the surface.
pub const THRESHOLD: f64 = 1.0;

/// What the curvatures of a surface come to: one row of the [paper](crate#references)'s Table 1.
///
/// All in coordinates scaled to the unit square, as λ is, so that surfaces of any size compare:
/// `κ` times the longer side, `K` times its square.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Summary {
    /// Vertices that have curvatures.
    pub vertices: usize,
    /// The longer side of the surface seen from above, in its own units.
    pub size: f64,
    /// The `|K|` above which a vertex counts.
    pub threshold: f64,
    /// Share of the vertices with `|K|` above the threshold, from 0 to 1.
    pub gaussian_above: f64,
    /// Median of `|K|`.
    pub median_gaussian: f64,
    /// Median of `|κ₂|`.
    pub median_kappa2: f64,
    /// Sum of `‖H‖_*` over the vertices: the energy without its fidelity term.
    pub nuclear_norm: f64,
    /// How often which `|K|` occurs.
    pub gaussian: Histogram,
    /// How often which `|κ₂|` occurs.
    pub kappa2: Histogram,
}

/// How often magnitudes occur, in bins of half a decade that are always the same, so that
/// histograms compare.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Histogram {
    /// Where bins end, ascending: bin `i` holds the magnitudes from `edges[i − 1]` up to, but
    /// without, `edges[i]`; the first one all below, and the last one, which has no end, all above.
    pub edges: Vec<f64>,
    /// Number of vertices in each bin, one bin more than edges.
    pub counts: Vec<usize>,
}

impl Summary {
    /// The figures of a surface whose curvatures are given. Costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::Option`] unless the threshold is positive and finite, [`Error::Shape`] if the
    /// curvatures are those of another lattice.
    pub fn new(surface: &Heightfield, curvatures: &Curvatures, threshold: f64) -> Result<Self> {
        let threshold = positive("threshold", threshold)?;
        let lattice = surface.lattice();
        same_shape(lattice.len(), surface, curvatures.gaussian.len())?;
        let scale = Normalization::UnitSquare.factor(surface);
        let magnitudes = |field: &[f64], factor: f64| -> Vec<f64> {
            let there = field.iter().filter(|value| !value.is_nan());
            there.map(|value| value.abs() / factor).collect()
        };
        Ok(Summary::of(Measured {
            gaussian: magnitudes(&curvatures.gaussian, scale * scale),
            kappa2: magnitudes(&curvatures.kappa2, scale),
            nuclear_norm: magnitudes(&curvatures.nuclear_norm, scale).iter().sum(),
            size: 1.0 / scale,
            threshold,
        }))
    }

    pub(super) fn of(measured: Measured) -> Self {
        let Measured {
            mut gaussian,
            mut kappa2,
            nuclear_norm,
            size,
            threshold,
        } = measured;
        let above = gaussian.iter().filter(|k| **k > threshold).count();
        Summary {
            vertices: gaussian.len(),
            size,
            threshold,
            gaussian_above: above as f64 / gaussian.len().max(1) as f64,
            nuclear_norm,
            gaussian: Histogram::of(&gaussian),
            kappa2: Histogram::of(&kappa2),
            median_gaussian: median(&mut gaussian),
            median_kappa2: median(&mut kappa2),
        }
    }
}

/// Magnitudes of curvatures, in normalised coordinates.
pub(super) struct Measured {
    pub gaussian: Vec<f64>,
    pub kappa2: Vec<f64>,
    pub nuclear_norm: f64,
    pub size: f64,
    pub threshold: f64,
}

impl Histogram {
    fn of(magnitudes: &[f64]) -> Self {
        /// From a hundred-thousandth to a million, in half decades.
        const BINS: i32 = 22;
        let edges: Vec<f64> = (0..=BINS)
            .map(|i| 10f64.powf(0.5 * f64::from(i) - 5.0))
            .collect();
        let mut counts = vec![0; edges.len() + 1];
        for value in magnitudes {
            counts[edges.partition_point(|edge| edge <= value)] += 1;
        }
        Histogram { edges, counts }
    }
}

/// How far a surface is from another one on the same lattice, in their units, over the vertices
/// where both have a height.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Deviation {
    /// Number of these vertices.
    pub vertices: usize,
    /// Root of the mean square of the difference.
    pub rms: f64,
    /// Largest difference.
    pub maximum: f64,
}

impl Deviation {
    /// Between two surfaces; costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::Shape`] if their lattices have different shapes.
    pub fn between(a: &Heightfield, b: &Heightfield) -> Result<Self> {
        same_shape(a.lattice().len(), a, b.heights().len())?;
        let pairs = a.heights().iter().zip(b.heights());
        let differences = pairs.map(|(a, b)| (a - b).abs()).filter(|d| !d.is_nan());
        let (mut vertices, mut squares, mut maximum) = (0, 0.0, 0.0f64);
        for difference in differences {
            vertices += 1;
            squares += difference * difference;
            maximum = maximum.max(difference);
        }
        Ok(Deviation {
            vertices,
            rms: (squares / vertices.max(1) as f64).sqrt(),
            maximum,
        })
    }
}

fn same_shape(expected: usize, surface: &Heightfield, found: usize) -> Result<()> {
    if expected == found {
        return Ok(());
    }
    Err(Error::Shape {
        what: "surface to compare with",
        rows: surface.lattice().rows(),
        cols: surface.lattice().cols(),
        expected,
        found,
    })
}

/// The middle one of some numbers, the higher of two; NaN of none. Linear cost.
fn median(values: &mut [f64]) -> f64 {
    let middle = values.len() / 2;
    if values.is_empty() {
        return f64::NAN;
    }
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::hexagonal::Lattice;

    fn sphere(size: f64) -> Heightfield {
        let lattice = Lattice::new(41, 41, size / 40.0).unwrap();
        Heightfield::from_fn(lattice, |x, y| {
            let (x, y) = (x - 0.5 * size, y + 0.5 * size);
            (4.0 * size * size - x * x - y * y).sqrt()
        })
        .unwrap()
    }

    #[test]
    fn figures_do_not_depend_on_the_unit() {
        let of = |surface: Heightfield, threshold| {
            Summary::new(&surface, &Curvatures::new(&surface).unwrap(), threshold).unwrap()
        };
        let (small, large) = (of(sphere(1.0), 0.2), of(sphere(1000.0), 0.2));
        // A sphere of twice the longer side, odd rows reaching half a spacing further.
        assert!(
            (small.median_gaussian - 0.25).abs() < 0.01,
            "{}",
            small.median_gaussian
        );
        assert_eq!((small.gaussian_above, large.gaussian_above), (1.0, 1.0));
        assert_eq!(small.gaussian.counts, large.gaussian.counts);
        let same = |a: f64, b: f64| (a - b).abs() < 1e-6 * a;
        assert!(same(small.median_gaussian, large.median_gaussian));
        assert!(same(small.median_kappa2, large.median_kappa2));
        assert!(same(small.nuclear_norm, large.nuclear_norm));
        assert_eq!(of(sphere(1.0), 0.3).gaussian_above, 0.0);
    }

    #[test]
    fn every_vertex_is_in_one_bin() {
        let magnitudes = [0.0, 1e-5, 0.9, 1.0, 1.1, 5.0, 1e9];
        let histogram = Histogram::of(&magnitudes);
        assert_eq!(histogram.counts.iter().sum::<usize>(), magnitudes.len());
        assert_eq!(
            (histogram.counts[0], *histogram.counts.last().unwrap()),
            (1, 1)
        );
        let one = histogram.edges.iter().position(|e| *e == 1.0).unwrap();
        assert_eq!((histogram.counts[one], histogram.counts[one + 1]), (1, 2));
    }

    #[test]
    fn deviations_are_over_what_both_have() {
        let lattice = Lattice::new(1, 4, 1.0).unwrap();
        let field = |heights: [f64; 4]| Heightfield::new(lattice, heights.to_vec()).unwrap();
        let d = Deviation::between(
            &field([1.0, 2.0, f64::NAN, 4.0]),
            &field([1.0, 5.0, 3.0, 0.0]),
        )
        .unwrap();
        assert_eq!((d.vertices, d.maximum), (3, 4.0));
        assert!((d.rms - (25.0f64 / 3.0).sqrt()).abs() < 1e-15);
        let other = Heightfield::new(Lattice::new(1, 3, 1.0).unwrap(), vec![0.0; 3]).unwrap();
        assert_eq!(
            Deviation::between(&field([0.0; 4]), &other)
                .unwrap_err()
                .code(),
            "SHAPE"
        );
    }
}
