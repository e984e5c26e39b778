//! Statistics of curvatures, and deviations between surfaces.

use super::curvature::Curvatures;
use crate::error::{Error, Result, positive};
use crate::heights::heightfield::Heightfield;
use crate::heights::normalization::Normalization;
use crate::math::statistics::median;

/// Default threshold of the Gaussian curvature, in coordinates scaled to the unit square, above which a vertex counts
/// as curved in two directions: the curvature of a sphere whose radius is the longer side of the surface.
pub const DEFAULT_GAUSSIAN_THRESHOLD: f64 = 1.0;

/// Statistics of a surface's curvatures, as in one row of the [paper](crate#references)'s Table 1.
///
/// Curvatures are in coordinates scaled to the unit square, as λ is, so that surfaces of any size compare:
/// `κ` times the longer side, `K` times its square.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename = "AnalysisSummary", rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct Summary {
    /// Number of vertices of the surface that have curvatures.
    pub vertices: usize,
    /// Longer side of a heightfield seen from above, in the surface's units; for a mesh the diameter of its bounding
    /// sphere.
    pub size: f64,
    /// Threshold of the Gaussian curvature `|K|` for [`Summary::gaussian_above`], in coordinates scaled to the unit
    /// square.
    pub threshold: f64,
    /// Share of the vertices whose Gaussian curvature `|K|` is above the threshold, from 0 to 1.
    pub gaussian_above: f64,
    /// Median of the Gaussian curvature's magnitude `|K|`; 0, like all other figures, if no vertex has curvatures.
    pub median_gaussian: f64,
    /// Median of the smaller principal curvature's magnitude `|κ₂|`; 0 if no vertex has curvatures.
    pub median_kappa2: f64,
    /// Sum of the Hessians' nuclear norms `‖H‖_*` over the vertices: the energy without its fidelity term.
    pub nuclear_norm: f64,
    /// Histogram of `|K|`, the magnitude of the Gaussian curvature, over the vertices.
    pub gaussian: Histogram,
    /// Histogram of `|κ₂|`, the magnitude of the smaller principal curvature, over the vertices.
    pub kappa2: Histogram,
}

/// Histogram of magnitudes of curvatures in bins of half a decade, which are the same for all surfaces.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Histogram {
    /// Upper ends of the bins, ascending: bin `i` counts magnitudes from `edges[i − 1]` to below
    /// `edges[i]`, the first bin all smaller ones, and the last bin, which has no upper end, all larger ones.
    pub edges: Vec<f64>,
    /// Number of vertices in each bin of the histogram; there is one bin more than edges.
    pub counts: Vec<usize>,
}

impl Summary {
    /// Computes statistics of a heightfield's curvatures. Costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::Option`] unless the threshold is positive and finite, [`Error::Shape`] if the
    /// curvatures are those of another lattice.
    pub fn new(surface: &Heightfield, curvatures: &Curvatures, threshold: f64) -> Result<Self> {
        let threshold = positive("threshold", threshold)?;
        let lattice = surface.lattice();
        check_same_shape(lattice.len(), surface, curvatures.gaussian.len())?;
        let scale = Normalization::UnitSquare.factor(surface);
        let magnitudes = |field: &[f64], factor: f64| -> Vec<f64> {
            let there = field.iter().filter(|value| !value.is_nan());
            there.map(|value| value.abs() / factor).collect()
        };
        Ok(Summary::from_magnitudes(CurvatureMagnitudes {
            gaussian: magnitudes(&curvatures.gaussian, scale * scale),
            kappa2: magnitudes(&curvatures.kappa2, scale),
            nuclear_norm: magnitudes(&curvatures.nuclear_norm, scale).iter().sum(),
            size: 1.0 / scale,
            threshold,
        }))
    }

    /// Computes the statistics from the magnitudes of the curvatures at all vertices.
    pub(super) fn from_magnitudes(measured: CurvatureMagnitudes) -> Self {
        let CurvatureMagnitudes {
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
            gaussian: Histogram::from_magnitudes(&gaussian),
            kappa2: Histogram::from_magnitudes(&kappa2),
            median_gaussian: median(&mut gaussian).unwrap_or(0.0),
            median_kappa2: median(&mut kappa2).unwrap_or(0.0),
        }
    }
}

/// Magnitudes of a surface's curvatures in coordinates scaled to the unit square, from which a [`Summary`] is computed,
/// with the surface's size.
pub(super) struct CurvatureMagnitudes {
    pub gaussian: Vec<f64>,
    pub kappa2: Vec<f64>,
    pub nuclear_norm: f64,
    pub size: f64,
    pub threshold: f64,
}

impl Histogram {
    /// Counts magnitudes of curvatures in the bins of a histogram.
    fn from_magnitudes(magnitudes: &[f64]) -> Self {
        /// Number of a histogram's bins with two ends: half decades from 10⁻⁵ to 10⁶.
        const BOUNDED_BINS: i32 = 22;
        /// Exponent of ten of the lowest edge between the bins of a curvature histogram.
        const LOWEST_EDGE_EXPONENT: f64 = -5.0;
        let edges: Vec<f64> = (0..=BOUNDED_BINS)
            .map(|i| 10f64.powf(0.5 * f64::from(i) + LOWEST_EDGE_EXPONENT))
            .collect();
        let mut counts = vec![0; edges.len() + 1];
        for value in magnitudes {
            counts[edges.partition_point(|edge| edge <= value)] += 1;
        }
        Histogram { edges, counts }
    }
}

/// Deviation of one surface from another on the same lattice, in the surfaces' unit of height, over the vertices
/// where both have a height.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Deviation {
    /// Number of vertices where both compared surfaces have a height.
    pub vertices: usize,
    /// Root mean square difference of height between the two surfaces, in their unit.
    pub rms: f64,
    /// Largest difference of height between the two surfaces, in their unit.
    pub maximum: f64,
}

impl Deviation {
    /// Measures how far two surfaces deviate from each other; costs `O(vertices)`.
    ///
    /// # Errors
    /// [`Error::Shape`] if their lattices have different shapes.
    pub fn between(a: &Heightfield, b: &Heightfield) -> Result<Self> {
        check_same_shape(a.lattice().len(), a, b.heights().len())?;
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

/// Checks that a field has as many values as a surface has vertices.
fn check_same_shape(expected: usize, surface: &Heightfield, found: usize) -> Result<()> {
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
        let histogram = Histogram::from_magnitudes(&magnitudes);
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
