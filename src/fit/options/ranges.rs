//! Ranges of the options, and which have an effect beside the others.

use super::{Energy, Lambda, Options, Schedule};
use crate::error::{Error, Result};
use crate::fit::threads::MAX_THREADS;

/// Range of the fidelity weight λ: outside of it one of the energy's two terms vanishes beside the other, even in
/// double precision.
pub(crate) const LAMBDA_RANGE: std::ops::RangeInclusive<f64> = 1e-12..=1e15;

/// Range of the Huber penalty's bend radius and crease radius, in normalised coordinates: from far below a spacing to
/// far beyond any surface.
pub(super) const RADIUS_RANGE: std::ops::RangeInclusive<f64> = 1e-6..=1e6;

/// Maximum number of reweighting or crease passes that an option may ask for; further passes do not change the surface.
const MAX_PASSES: f64 = 20.0;

/// Checks that the value of an option, if it is given, is in its range; `requirement` says which that is.
fn check(
    name: &'static str,
    value: Option<f64>,
    is_in_range: fn(f64) -> bool,
    requirement: &'static str,
) -> Result<()> {
    match value {
        Some(value) if !is_in_range(value) => Err(Error::option(name, value, requirement)),
        _ => Ok(()),
    }
}

impl Options {
    /// Checks that every option is within its range and has an effect beside the other options that are given.
    ///
    /// # Errors
    /// [`Error::Option`] with the name of the first option that fails.
    pub fn validate(&self) -> Result<()> {
        self.check_ranges()?;
        self.check_effects()
    }

    fn check_ranges(&self) -> Result<()> {
        let count = |count: Option<usize>| count.map(|count| count as f64);
        let distance = self.tolerance.map(|tolerance| tolerance.distance(1.0));
        let requirement =
            "must be a distance above zero, or a share of the height range such as 0.5%";
        check(
            "tolerance",
            distance,
            |x| x > 0.0 && x < f64::INFINITY,
            requirement,
        )?;
        if self.tolerance.is_some() && self.lambda_or_default() != Lambda::Auto {
            return Err(Error::option(
                "tolerance",
                "given",
                "has no effect beside a number for lambda, which it decides",
            ));
        }
        let lambda = Some(self.lambda_or_default().value());
        for (name, weight) in [("lambda", lambda), ("tie_break", self.tie_break)] {
            let is_in_range = |x| LAMBDA_RANGE.contains(&x);
            check(name, weight, is_in_range, "must lie between 1e-12 and 1e15")?;
        }
        let requirement = "must lie between 0 and 1, both excluded";
        check("gap", self.gap, |x| x > 0.0 && x < 1.0, requirement)?;
        let radii = [
            ("bend_radius", self.bend_radius),
            ("crease_radius", self.crease_radius),
        ];
        for (name, radius) in radii {
            let is_in_range = |x| RADIUS_RANGE.contains(&x);
            check(name, radius, is_in_range, "must lie between 1e-6 and 1e6")?;
        }
        let requirement = "must lie between 0 and 1";
        check(
            "flatness",
            self.flatness,
            |x| (0.0..=1.0).contains(&x),
            requirement,
        )?;
        let passes = [
            ("reweighting", Some(self.reweighting)),
            ("crease_passes", self.crease_passes),
        ];
        for (name, passes) in passes {
            check(
                name,
                count(passes),
                |x| x <= MAX_PASSES,
                "must be at most 20",
            )?;
        }
        let iterations = count(self.max_iterations);
        check(
            "max_iterations",
            iterations,
            |x| x >= 1.0,
            "must be at least 1",
        )?;
        let is_in_range = |x| (1.0..=MAX_THREADS as f64).contains(&x);
        let requirement = "must be a whole number from 1 to 256";
        check("threads", count(self.threads), is_in_range, requirement)
    }

    /// Returns an error for an option that has no effect beside the other options that are given.
    fn check_effects(&self) -> Result<()> {
        if let (Schedule::Paper, Some(gap)) = (self.schedule, self.gap) {
            return Err(Error::option(
                "gap",
                gap,
                "has no effect with the schedule paper, which stops on its residuals: leave one of them out",
            ));
        }
        match self.energy {
            Some(Energy::Huber) => self.check_reweighting(),
            Some(_) => self.check_huber(
                "is a parameter of the energy huber and another energy is given: leave one of them out",
            ),
            None => Ok(()),
        }
    }

    fn check_reweighting(&self) -> Result<()> {
        if self.reweighting == 0 {
            return Ok(());
        }
        Err(Error::option(
            "reweighting",
            self.reweighting,
            "must be 0 for the energy huber, which has crease passes in its place: \
             choose another energy, as nuclear",
        ))
    }

    /// Returns an error with `requirement` as its message if an option is given that only [`Energy::Huber`] has.
    fn check_huber(&self, requirement: &'static str) -> Result<()> {
        let radii_and_slope = [
            ("bend_radius", self.bend_radius),
            ("flatness", self.flatness),
            ("crease_radius", self.crease_radius),
        ];
        for (name, value) in radii_and_slope {
            if let Some(value) = value {
                return Err(Error::option(name, value, requirement));
            }
        }
        if let Some(passes) = self.crease_passes {
            return Err(Error::option("crease_passes", passes, requirement));
        }
        Ok(())
    }

    /// Returns an error for an option that has no effect on an input: [`Options::tie_break`] where no vertex is free,
    /// and parameters of another energy than the input's default where none is given.
    pub(crate) fn check_effects_on(&self, is_design: bool, has_free_vertices: bool) -> Result<()> {
        if let (Some(weight), false) = (self.tie_break, has_free_vertices) {
            return Err(Error::option(
                "tie_break",
                weight,
                "has no effect where every vertex has an input height: leave it out",
            ));
        }
        match (self.energy, is_design) {
            (None, true) => self.check_huber(
                "is a parameter of the energy huber and a design has the energy nuclear unless another one is given: \
                 give the energy huber as well",
            ),
            (None, false) => self.check_reweighting(),
            _ => Ok(()),
        }
    }
}
