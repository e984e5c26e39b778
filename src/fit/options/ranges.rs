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
const MAX_PASSES: usize = 20;

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
        if let Some(tolerance) = self.tolerance
            && !(tolerance.distance(1.0) > 0.0 && tolerance.distance(1.0).is_finite())
        {
            let requirement =
                "must be a distance above zero, or a share of the height range such as 0.5%";
            return Err(Error::option(
                "tolerance",
                tolerance.distance(1.0),
                requirement,
            ));
        }
        if self.tolerance.is_some() && self.lambda_or_default() != Lambda::Auto {
            return Err(Error::option(
                "tolerance",
                "given",
                "has no effect beside a number for lambda, which it decides",
            ));
        }
        let lambda = self.lambda_or_default().value();
        if !LAMBDA_RANGE.contains(&lambda) {
            return Err(Error::option(
                "lambda",
                lambda,
                "must lie between 1e-12 and 1e15",
            ));
        }
        if let Some(gap) = self.gap
            && !(gap > 0.0 && gap < 1.0)
        {
            return Err(Error::option(
                "gap",
                gap,
                "must lie between 0 and 1, both excluded",
            ));
        }
        if self.reweighting > MAX_PASSES {
            return Err(Error::option(
                "reweighting",
                self.reweighting,
                "must be at most 20",
            ));
        }
        if let Some(weight) = self.tie_break
            && !LAMBDA_RANGE.contains(&weight)
        {
            return Err(Error::option(
                "tie_break",
                weight,
                "must lie between 1e-12 and 1e15",
            ));
        }
        for (name, radius) in [
            ("bend_radius", self.bend_radius),
            ("crease_radius", self.crease_radius),
        ] {
            if radius.is_some_and(|radius| !RADIUS_RANGE.contains(&radius)) {
                return Err(Error::option(
                    name,
                    radius.unwrap_or_default(),
                    "must lie between 1e-6 and 1e6",
                ));
            }
        }
        if let Some(flatness) = self.flatness
            && !(0.0..=1.0).contains(&flatness)
        {
            return Err(Error::option(
                "flatness",
                flatness,
                "must lie between 0 and 1",
            ));
        }
        if let Some(passes) = self.crease_passes
            && passes > MAX_PASSES
        {
            return Err(Error::option("crease_passes", passes, "must be at most 20"));
        }
        if self.max_iterations == 0 {
            return Err(Error::option("max_iterations", 0, "must be at least 1"));
        }
        if let Some(threads) = self.threads
            && !(1..=MAX_THREADS).contains(&threads)
        {
            return Err(Error::option(
                "threads",
                threads,
                "must be a whole number from 1 to 256",
            ));
        }
        Ok(())
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
