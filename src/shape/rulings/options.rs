//! Options of tracing rulings.

use crate::error::{Error, Result, positive};

/// Default distance between traced rulings, in spacings of the lattice or edge lengths of the mesh, for a picture in
/// which lines can be told apart.
const DEFAULT_SEPARATION_SPACINGS: f64 = 10.0;

/// Default minimum confidence of a ruling's direction. No table chose it; the confidence is one half where the surface
/// bends by 0.0005 radians from one vertex to the next.
const DEFAULT_MIN_CONFIDENCE: f64 = 0.3;

/// Default bend angle of a crease where rulings end, in radians from one vertex to the next (eleven degrees). No table
/// chose it.
const DEFAULT_CREASE_BEND: f64 = 0.2;

/// Options of tracing rulings: how far apart they are and where they end.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(default, rename_all = "camelCase", deny_unknown_fields)
)]
#[non_exhaustive]
pub struct TraceOptions {
    /// Distance between rulings, in the surface's units: as seen from above on a heightfield, in space on a mesh.
    /// `None`: ten spacings, or mean lengths of an edge.
    pub separation: Option<f64>,
    /// Minimum confidence of the direction, from 0 to 1: a ruling ends where it is lower. Default 0.3.
    pub confidence: f64,
    /// Bend angle of a crease, in radians from one vertex to the next: a ruling ends where the surface bends by more.
    /// Default 0.2.
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
    /// Returns these options with another distance between rulings, in the surface's units.
    pub fn separation(self, separation: f64) -> Self {
        TraceOptions {
            separation: Some(separation),
            ..self
        }
    }

    /// These options with another minimum confidence.
    pub fn confidence(self, confidence: f64) -> Self {
        TraceOptions { confidence, ..self }
    }

    /// These options with another bend angle of a crease.
    pub fn crease(self, crease: f64) -> Self {
        TraceOptions { crease, ..self }
    }

    /// Checks all options, and returns the distance between rulings for a given distance between vertices.
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
