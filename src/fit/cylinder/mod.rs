//! Fits of cylinders: surfaces whose rulings are all parallel, as pages of books, curled sheets and sheets with
//! parallel folds.
//!
//! A piecewise developable surface is straight along its rulings, but their direction may change from place to place,
//! so that noise is averaged over a neighbourhood only. A cylinder has one
//! profile for all rulings, which is averaged over their whole length. [`fit_cylinder`] finds it, and tests whether
//! its residuals are noise.

mod profile;
mod residual_excess;

use super::input::Input;
use super::tuning::noise::Noise;
use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::Heightfield;
use profile::{Penalty, Profile, ProfileEquations};

/// Verdict on whether the surface of heights is a cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum CylinderVerdict {
    /// The surface is a cylinder: residuals are no more correlated along the rulings than noise is.
    Cylinder,
    /// The surface has another shape, because residuals are correlated along the rulings, or there are too few heights
    /// to tell.
    Other,
}

/// Figures that describe the fit of a cylinder to heights.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct CylinderReport {
    /// Verdict on whether the surface is a cylinder.
    pub verdict: CylinderVerdict,
    /// Direction of the rulings: a unit vector (x, y, height) in the axes of the heights.
    pub rulings: [f64; 3],
    /// Root mean square residual of the heights from the cylinder, in the heights' unit.
    pub residual: f64,
    /// Correlation of the residuals along the rulings, divided by that of noise as smooth as the heights have it: about 1 if the
    /// residuals are noise alone. Up to 1.95 the verdict is a cylinder. NaN if there are too few heights to tell, or too few that
    /// are independent, with the verdict that it is none.
    pub excess: f64,
    /// Number of heights that the cylinder was fitted to.
    pub vertices: usize,
}

/// Cylinder that fits heights best by least squares.
#[derive(Debug, Clone, PartialEq)]
pub struct Cylinder {
    heightfield: Heightfield,
    report: CylinderReport,
}

impl Cylinder {
    /// Returns the heights of the cylinder, wherever the input has a height or a small hole is
    /// [bridged](crate::Bridging).
    pub fn heightfield(&self) -> &Heightfield {
        &self.heightfield
    }

    /// Returns the heights of the cylinder, as [`Cylinder::heightfield`] has them.
    pub fn into_heightfield(self) -> Heightfield {
        self.heightfield
    }

    /// Figures of the fit of the cylinder to the heights.
    pub fn report(&self) -> &CylinderReport {
        &self.report
    }
}

/// Number of stretches of the rulings that are left out one at a time, to choose the penalty of a profile by
/// cross-validation.
const CROSS_VALIDATION_FOLDS: usize = 6;

/// Number of directions of the rulings that are tried before the best one is refined.
const INITIAL_DIRECTIONS: usize = 60;

/// Number of golden-section steps that refine the best direction of the rulings.
const GOLDEN_SECTION_STEPS: usize = 16;

/// Maximum number of heights that the direction of the rulings is found from.
const MAX_DIRECTION_HEIGHTS: usize = 20_000;

/// Penalty of the profiles by which directions of the rulings are compared: so small that they are hardly smoothed.
const DIRECTION_PENALTY: Penalty = Penalty::Squares(0.1);

/// Maximum number of bins, across the rulings, of a cylinder's profile.
const MAX_PROFILE_BINS: usize = 2000;

/// Minimum number of heights that a cylinder is fitted to.
const MIN_HEIGHTS: usize = 400;

/// Minimum number of bins, across the rulings, of a cylinder's profile.
const MIN_PROFILE_BINS: usize = 16;

/// A height with its position in the plane and its weight in the fit.
#[derive(Debug, Clone, Copy)]
struct WeightedHeight {
    at: [f64; 2],
    height: f64,
    weight: f64,
}

/// Axes of a cylinder's profile in the plane, across and along the rulings.
#[derive(Debug, Clone, Copy)]
struct ProfileAxes {
    cos: f64,
    sin: f64,
    start: f64,
    bins: usize,
    first: f64,
    last: f64,
    unit: f64,
}

impl ProfileAxes {
    fn new(points: &[WeightedHeight], angle: f64, spacing: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let span = |of: &dyn Fn(&WeightedHeight) -> f64| {
            (points.iter().map(of)).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
                [low.min(v), high.max(v)]
            })
        };
        let across = span(&|p| cos * p.at[0] + sin * p.at[1]);
        let along = span(&|p| cos * p.at[1] - sin * p.at[0]);
        let unit = spacing.max((across[1] - across[0]) / (MAX_PROFILE_BINS - 2) as f64);
        ProfileAxes {
            cos,
            sin,
            start: across[0],
            bins: ((across[1] - across[0]) / unit).ceil() as usize + 2,
            first: along[0],
            last: along[1],
            unit,
        }
    }

    /// Returns a position's coordinates across the rulings, in bins, and along them, in the heights' unit of length.
    fn place(&self, at: [f64; 2]) -> [f64; 2] {
        let across = (self.cos * at[0] + self.sin * at[1] - self.start) / self.unit;
        [across.max(0.0), self.cos * at[1] - self.sin * at[0]]
    }

    /// Returns the index of the stretch that a position `along` the rulings is on, of `of` equal stretches.
    fn stretch(&self, along: f64, of: usize) -> usize {
        let share = (along - self.first) / (self.last - self.first).max(f64::MIN_POSITIVE);
        ((share * of as f64) as usize).min(of - 1)
    }

    /// Sums up the normal equations of a cylinder's profile from heights.
    fn sums(&self, points: impl Iterator<Item = WeightedHeight>) -> Result<ProfileEquations> {
        let mut sums = ProfileEquations::new(self.bins)?;
        for point in points {
            let [across, along] = self.place(point.at);
            sums.add(across, along, point.height, point.weight);
        }
        Ok(sums)
    }
}

/// Fits a cylinder to heights by least squares, and tests whether their surface is one.
///
/// The penalty of the profile is the one under which five sixths of the rulings predict the other sixth best; noise
/// that is correlated over a few vertices does not matter to that. The surface is a cylinder if means of the residuals
/// over long stretches of the rulings vary no more than short stretches and the smoothness of the noise let expect. Constraints and occlusions of the
/// input are ignored. Costs `O(vertices)`, some hundred passes over at most 20 thousand of them.
///
/// # Errors
/// [`Error::Unsupported`] for less than 400 heights, or if they are in one line; [`Error::OutOfMemory`].
pub fn fit_cylinder(input: impl Into<Input>) -> Result<Cylinder> {
    let input = input.into().bridge()?;
    let lattice = *input.field.lattice();
    let spacing = lattice.spacing();
    let seen = |i: usize| input.confidence.get(i).copied().unwrap_or(1.0);
    let mut points = Vec::new();
    for (i, height) in input.field.heights().iter().enumerate() {
        let weight = seen(i);
        if !height.is_nan() && weight > 0.0 {
            points.push(WeightedHeight {
                at: lattice.position(i / lattice.cols(), i % lattice.cols()),
                height: *height,
                weight,
            });
        }
    }
    let vertices = points.len();
    let few = || Error::Unsupported {
        format: "cylinder",
        reason: format!("{vertices} heights are too few, or too narrow, to find one"),
    };
    if vertices < MIN_HEIGHTS {
        return Err(few());
    }
    let middle = mean(&points);
    for point in &mut points {
        point.at = [point.at[0] - middle[0], point.at[1] - middle[1]];
        point.height -= middle[2];
    }
    let angle = find_direction(&points, spacing)?;
    let axes = ProfileAxes::new(&points, angle, spacing);
    if axes.bins < MIN_PROFILE_BINS {
        return Err(few());
    }
    let profile = select_profile(&points, &axes)?;
    let left = |point: &WeightedHeight| {
        let [across, along] = axes.place(point.at);
        point.height - profile.at(across) - profile.slope * along
    };
    let (mut squares, mut weights) = (0.0, 0.0);
    for point in &points {
        squares += point.weight * left(point).powi(2);
        weights += point.weight;
    }
    let residuals = points.iter().map(|point| {
        let [across, along] = axes.place(point.at);
        residual_excess::FitResidual {
            across: across / axes.bins as f64,
            along,
            value: left(point),
            weight: point.weight,
        }
    });
    let extent = [axes.bins as f64 * axes.unit, axes.last - axes.first];
    let noise = Noise::from_input(&input, input.is_measured)?;
    let length = noise.map_or(0.0, |noise| noise.correlation_length);
    let excess = residual_excess::residual_excess(residuals, extent, length);
    let mut heights = try_filled("cylinder", lattice.len(), f64::NAN)?;
    for (i, (out, height)) in heights.iter_mut().zip(input.field.heights()).enumerate() {
        if !height.is_nan() {
            let at = lattice.position(i / lattice.cols(), i % lattice.cols());
            let [across, along] = axes.place([at[0] - middle[0], at[1] - middle[1]]);
            *out = middle[2] + profile.at(across) + profile.slope * along;
        }
    }
    let length = profile.slope.hypot(1.0);
    let report = CylinderReport {
        verdict: match excess <= residual_excess::MAX_CYLINDER_EXCESS {
            true => CylinderVerdict::Cylinder,
            false => CylinderVerdict::Other,
        },
        rulings: [-axes.sin, axes.cos, profile.slope].map(|v| v / length),
        residual: (squares / weights).sqrt(),
        excess,
        vertices,
    };
    Ok(Cylinder {
        heightfield: Heightfield::new(lattice, heights)?,
        report,
    })
}

/// Returns the mean position (x, y) and the mean height of points.
fn mean(points: &[WeightedHeight]) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for point in points {
        for (sum, value) in sums
            .iter_mut()
            .zip([point.at[0], point.at[1], point.height])
        {
            *sum += value;
        }
    }
    sums.map(|sum| sum / points.len() as f64)
}

/// Finds the direction of the rulings: returns the angle, in radians, of the axis across them for which nearly
/// unsmoothed profiles have the smallest residuals.
fn find_direction(points: &[WeightedHeight], spacing: f64) -> Result<f64> {
    use std::f64::consts::PI;
    let step = points.len().div_ceil(MAX_DIRECTION_HEIGHTS);
    let left = |angle: f64| -> Result<f64> {
        let axes = ProfileAxes::new(points, angle, spacing);
        let sums = axes.sums(points.iter().step_by(step).copied())?;
        Ok(sums.fit(DIRECTION_PENALTY).misfit)
    };
    let mut best = (f64::INFINITY, 0.0);
    for k in 0..INITIAL_DIRECTIONS {
        let angle = k as f64 * PI / INITIAL_DIRECTIONS as f64;
        let found = left(angle)?;
        if found < best.0 {
            best = (found, angle);
        }
    }
    // By golden sections.
    let share = 0.5 * (5.0f64.sqrt() - 1.0);
    let (mut low, mut high) = (
        best.1 - PI / INITIAL_DIRECTIONS as f64,
        best.1 + PI / INITIAL_DIRECTIONS as f64,
    );
    let mut inner = [high - share * (high - low), low + share * (high - low)];
    let mut values = [left(inner[0])?, left(inner[1])?];
    for _ in 0..GOLDEN_SECTION_STEPS {
        if values[0] < values[1] {
            high = inner[1];
            inner = [high - share * (high - low), inner[0]];
            values = [left(inner[0])?, values[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + share * (high - low)];
            values = [values[1], left(inner[1])?];
        }
    }
    Ok(0.5 * (low + high))
}

/// Fits the profile under the penalty that has the smallest prediction error in cross-validation.
fn select_profile(points: &[WeightedHeight], axes: &ProfileAxes) -> Result<Profile> {
    let mut parts = Vec::with_capacity(CROSS_VALIDATION_FOLDS);
    for _ in 0..CROSS_VALIDATION_FOLDS {
        parts.push(ProfileEquations::new(axes.bins)?);
    }
    for point in points {
        let [across, along] = axes.place(point.at);
        // Heights are in units of bins, so that penalties have no unit.
        let height = point.height / axes.unit;
        parts[axes.stretch(along, CROSS_VALIDATION_FOLDS)].add(across, along, height, point.weight);
    }
    let mut all = ProfileEquations::new(axes.bins)?;
    for part in &parts {
        all.add_scaled(part, 1.0);
    }
    let without = |part: &ProfileEquations| {
        let mut others = all.clone();
        others.add_scaled(part, -1.0);
        others
    };
    let folds: Vec<(&ProfileEquations, ProfileEquations)> =
        parts.iter().map(|part| (part, without(part))).collect();
    let half_decades = |from: i32, to: i32| (from..=to).map(|k| 10f64.powf(0.5 * f64::from(k)));
    let penalties =
        (half_decades(-6, 10).map(Penalty::Squares)).chain(half_decades(-6, 4).map(Penalty::Kinks));
    let mut best = (f64::INFINITY, Penalty::Squares(1.0));
    for penalty in penalties {
        let off = (folds.iter())
            .map(|(part, others)| part.squared_residual(&others.fit(penalty)))
            .sum();
        if off < best.0 {
            best = (off, penalty);
        }
    }
    let mut profile = all.fit(best.1);
    for value in &mut profile.values {
        *value *= axes.unit;
    }
    profile.slope *= axes.unit;
    Ok(profile)
}
