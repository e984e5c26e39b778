//! Heights of a cylinder: of what is bent about parallel rulings, as pages of books, curled sheets and sheets with parallel
//! folds are.
//!
//! A piecewise developable surface is straight along its rulings, but which way they run may change from place to place,
//! so that noise is averaged over a neighbourhood only. Where the rulings of the whole surface are parallel there is one
//! profile for all of them, and what is known of it grows with their length. [`fit_cylinder`] finds it, and says whether
//! what it leaves of the heights is noise.

mod noise;
mod profile;

use super::input::Input;
use crate::error::{Error, Result, try_filled};
use crate::heights::heightfield::Heightfield;
use profile::{Penalty, Profile, Sums};

/// Whether heights are those of a cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum CylinderVerdict {
    /// What it leaves of them does not go on along the rulings any more than noise does.
    Cylinder,
    /// It does, or there are too few to tell: they are of another shape.
    Other,
}

/// How near heights are to a cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub struct CylinderReport {
    /// Whether they are those of one.
    pub verdict: CylinderVerdict,
    /// The direction of the rulings: a unit vector in the axes of the heights.
    pub rulings: [f64; 3],
    /// Root of the mean square of what the cylinder leaves of the heights, in their unit.
    pub residual: f64,
    /// How much of what it leaves goes on along the rulings: about 1 for a cylinder and noise, and below 1.95; not a
    /// number where there is too little to tell.
    pub excess: f64,
    /// Heights that it was fitted to.
    pub vertices: usize,
}

/// The cylinder next to some heights.
#[derive(Debug, Clone, PartialEq)]
pub struct Cylinder {
    heightfield: Heightfield,
    report: CylinderReport,
}

impl Cylinder {
    /// Its heights wherever the input has one, and where small holes are [bridged](crate::Bridging).
    pub fn heightfield(&self) -> &Heightfield {
        &self.heightfield
    }

    /// The same.
    pub fn into_heightfield(self) -> Heightfield {
        self.heightfield
    }

    /// How near it is.
    pub fn report(&self) -> &CylinderReport {
        &self.report
    }
}

/// Stretches of the rulings that are left out one at a time, to choose the penalty.
const FOLDS: usize = 6;

/// Directions that are tried at first, and rounds that narrow the best one down.
const DIRECTIONS: usize = 60;
const ROUNDS: usize = 16;

/// Most heights that are looked at to find the direction, and most bins of a profile.
const LOOKS: usize = 20_000;
const BINS: usize = 2000;

/// Fewest heights, and bins, that say anything.
const FEW: usize = 400;
const NARROW: usize = 16;

/// A height where it lies in the plane.
#[derive(Debug, Clone, Copy)]
struct Point {
    at: [f64; 2],
    height: f64,
    weight: f64,
}

/// The axes of a profile in the plane.
#[derive(Debug, Clone, Copy)]
struct Axes {
    cos: f64,
    sin: f64,
    start: f64,
    bins: usize,
    first: f64,
    last: f64,
    unit: f64,
}

impl Axes {
    fn new(points: &[Point], angle: f64, spacing: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let span = |of: &dyn Fn(&Point) -> f64| {
            (points.iter().map(of)).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
                [low.min(v), high.max(v)]
            })
        };
        let across = span(&|p| cos * p.at[0] + sin * p.at[1]);
        let along = span(&|p| cos * p.at[1] - sin * p.at[0]);
        let unit = spacing.max((across[1] - across[0]) / (BINS - 2) as f64);
        Axes {
            cos,
            sin,
            start: across[0],
            bins: ((across[1] - across[0]) / unit).ceil() as usize + 2,
            first: along[0],
            last: along[1],
            unit,
        }
    }

    /// Across the rulings, in bins, and along them, in the heights' unit.
    fn place(&self, at: [f64; 2]) -> [f64; 2] {
        let across = (self.cos * at[0] + self.sin * at[1] - self.start) / self.unit;
        [across.max(0.0), self.cos * at[1] - self.sin * at[0]]
    }

    /// The stretch of the rulings, of so many, that a place along them is on.
    fn stretch(&self, along: f64, of: usize) -> usize {
        let share = (along - self.first) / (self.last - self.first).max(f64::MIN_POSITIVE);
        ((share * of as f64) as usize).min(of - 1)
    }

    fn sums(&self, points: impl Iterator<Item = Point>) -> Result<Sums> {
        let mut sums = Sums::new(self.bins)?;
        for point in points {
            let [across, along] = self.place(point.at);
            sums.add(across, along, point.height, point.weight);
        }
        Ok(sums)
    }
}

/// Finds the cylinder next to heights, by least squares, and says whether they are those of one.
///
/// How smooth its profile is, or how straight between kinks, is what predicts each sixth of the rulings best from the
/// other five; noise that is alike from vertex to vertex is no help there, and does no harm. It is a cylinder if what
/// is left over half the length of the rulings varies no more than what is left over short stretches lets expect.
/// Constraints and occlusions of the input are not looked at. Costs `O(vertices)`, some hundred passes over at most
/// 20 thousand of them.
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
            points.push(Point {
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
    if vertices < FEW {
        return Err(few());
    }
    let middle = mean(&points);
    for point in &mut points {
        point.at = [point.at[0] - middle[0], point.at[1] - middle[1]];
        point.height -= middle[2];
    }
    let angle = direction(&points, spacing)?;
    let axes = Axes::new(&points, angle, spacing);
    if axes.bins < NARROW {
        return Err(few());
    }
    let profile = chosen(&points, &axes)?;
    let left = |point: &Point| {
        let [across, along] = axes.place(point.at);
        point.height - profile.at(across) - profile.slope * along
    };
    let (mut squares, mut weights) = (0.0, 0.0);
    for point in &points {
        squares += point.weight * left(point).powi(2);
        weights += point.weight;
    }
    let excess = noise::excess(points.iter().map(|point| {
        let [across, along] = axes.place(point.at);
        noise::Rest {
            across: across / axes.bins as f64,
            along,
            value: left(point),
            weight: point.weight,
        }
    }));
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
        verdict: match excess <= noise::MOST {
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

fn mean(points: &[Point]) -> [f64; 3] {
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

/// The angle of the profile's axis by which all but unsmoothed profiles leave least.
fn direction(points: &[Point], spacing: f64) -> Result<f64> {
    use std::f64::consts::PI;
    let step = points.len().div_ceil(LOOKS);
    let left = |angle: f64| -> Result<f64> {
        let axes = Axes::new(points, angle, spacing);
        let sums = axes.sums(points.iter().step_by(step).copied())?;
        Ok(sums.fit(Penalty::Squares(0.1)).misfit)
    };
    let mut best = (f64::INFINITY, 0.0);
    for k in 0..DIRECTIONS {
        let angle = k as f64 * PI / DIRECTIONS as f64;
        let found = left(angle)?;
        if found < best.0 {
            best = (found, angle);
        }
    }
    // By golden sections.
    let share = 0.5 * (5.0f64.sqrt() - 1.0);
    let (mut low, mut high) = (
        best.1 - PI / DIRECTIONS as f64,
        best.1 + PI / DIRECTIONS as f64,
    );
    let mut inner = [high - share * (high - low), low + share * (high - low)];
    let mut values = [left(inner[0])?, left(inner[1])?];
    for _ in 0..ROUNDS {
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

/// The profile under the penalty that predicts stretches best which it was not fitted to.
fn chosen(points: &[Point], axes: &Axes) -> Result<Profile> {
    let mut parts = Vec::with_capacity(FOLDS);
    for _ in 0..FOLDS {
        parts.push(Sums::new(axes.bins)?);
    }
    for point in points {
        let [across, along] = axes.place(point.at);
        // In bins, so that penalties have no unit.
        let height = point.height / axes.unit;
        parts[axes.stretch(along, FOLDS)].add(across, along, height, point.weight);
    }
    let mut all = Sums::new(axes.bins)?;
    for part in &parts {
        all.plus(part, 1.0);
    }
    let without = |part: &Sums| {
        let mut others = all.clone();
        others.plus(part, -1.0);
        others
    };
    let folds: Vec<(&Sums, Sums)> = parts.iter().map(|part| (part, without(part))).collect();
    let half_decades = |from: i32, to: i32| (from..=to).map(|k| 10f64.powf(0.5 * f64::from(k)));
    let penalties =
        (half_decades(-6, 10).map(Penalty::Squares)).chain(half_decades(-6, 4).map(Penalty::Kinks));
    let mut best = (f64::INFINITY, Penalty::Squares(1.0));
    for penalty in penalties {
        let off = (folds.iter())
            .map(|(part, others)| part.off(&others.fit(penalty)))
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
