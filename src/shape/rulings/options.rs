//! Options of tracing rulings.

use crate::error::{Error, Result, positive};

/// Default distance between traced rulings, in spacings of the lattice or edge lengths of the mesh, for a picture in
/// which lines can be told apart.
const DEFAULT_SEPARATION_SPACINGS: f64 = 10.0;

/// Default minimum confidence of a ruling's direction. Not tuned by measurements; the confidence is one half where the surface
/// bends by 0.0005 radians from one vertex to the next.
const DEFAULT_MIN_CONFIDENCE: f64 = 0.3;

/// Default bend angle of a crease where rulings end, in radians from one vertex to the next (eleven degrees). No table
/// chose it.
pub(super) const DEFAULT_CREASE_BEND: f64 = 0.2;

/// Options of tracing rulings: distance between rulings, and where rulings end.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(default, rename_all = "camelCase", deny_unknown_fields)
)]
#[non_exhaustive]
pub struct TraceOptions {
    /// Distance from other rulings at which one begins, in three dimensions and in the surface's unit of length; along their
    /// courses two may come as near as half of it. `None`: ten mean edge lengths.
    pub separation: Option<f64>,
    /// Minimum confidence of the ruling's direction, from 0 to 1: a ruling ends where it is lower. Default 0.3.
    pub confidence: f64,
    /// Bend angle above which a vertex belongs to a crease, in radians from one vertex to the next: a ruling ends
    /// there. Default 0.2.
    pub crease: f64,
}

impl Default for TraceOptions {
    fn default() -> Self {
        TraceOptions {
            separation: None,
            confidence: DEFAULT_MIN_CONFIDENCE,
            crease: DEFAULT_CREASE_BEND,
        }
    }
}

impl TraceOptions {
    /// Sets the distance between rulings, in the surface's units, and returns the options.
    pub fn separation(self, separation: f64) -> Self {
        TraceOptions {
            separation: Some(separation),
            ..self
        }
    }

    /// Sets the minimum confidence of a ruling's direction, from 0 to 1, and returns the options.
    pub fn confidence(self, confidence: f64) -> Self {
        TraceOptions { confidence, ..self }
    }

    /// Sets the bend angle above which a vertex counts as a crease where rulings end, in radians from one vertex to the
    /// next, and returns the options.
    pub fn crease(self, crease: f64) -> Self {
        TraceOptions { crease, ..self }
    }

    /// Checks the ranges of all options, and returns the distance between rulings; `spacing` is the distance between
    /// vertices, from which the default follows.
    pub(super) fn checked_separation(&self, spacing: f64) -> Result<f64> {
        positive("crease", self.crease)?;
        if !(0.0..=1.0).contains(&self.confidence) {
            let requirement = "must be from 0 to 1";
            return Err(Error::option("confidence", self.confidence, requirement));
        }
        match self.separation {
            Some(separation) => positive("separation", separation),
            None => Ok(DEFAULT_SEPARATION_SPACINGS * spacing),
        }
    }
}
