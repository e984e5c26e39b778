//! Options of the search for patches.

/// What counts as a crease and as a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PatchOptions {
    /// Angle, in radians, by which the surface bends from one vertex to the next on a crease.
    /// `None`: six times its median, and at least 0.035 (two degrees).
    pub bend: Option<f64>,
    /// Angle, in radians, between the surface on either side of a crease, on average along it:
    /// patches that fold by less are one. Default 0.15, about nine degrees.
    pub fold: f64,
    /// Share of all vertices that a patch has at least; smaller ones become part of those around
    /// them. Default 0.005.
    pub smallest: f64,
}

impl Default for PatchOptions {
    fn default() -> Self {
        PatchOptions {
            bend: None,
            fold: 0.15,
            smallest: 0.005,
        }
    }
}

impl PatchOptions {
    /// These options with another angle from vertex to vertex.
    pub fn bend(self, bend: f64) -> Self {
        PatchOptions {
            bend: Some(bend),
            ..self
        }
    }

    /// These options with another angle between patches.
    pub fn fold(self, fold: f64) -> Self {
        PatchOptions { fold, ..self }
    }

    /// These options with another share.
    pub fn smallest(self, smallest: f64) -> Self {
        PatchOptions { smallest, ..self }
    }
}
