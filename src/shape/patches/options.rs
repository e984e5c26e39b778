//! Options of the segmentation into patches.

/// Default minimum fold angle of a crease, in radians (about nine degrees). Limits how sharp the rulings of a surface
/// that was fitted to noise may be without counting as creases. Not tuned by measurements; `tests/native/patches.rs` has the
/// surfaces whose patches it must find.
const DEFAULT_FOLD: f64 = 0.15;

/// Default minimum size of a patch, as a share of all vertices. Not tuned by measurements; `tests/native/patches.rs` has the
/// surfaces whose patches it must find.
const DEFAULT_SMALLEST: f64 = 0.005;

/// Options of the segmentation into patches: what counts as a crease and as a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(default, rename_all = "camelCase", deny_unknown_fields)
)]
#[non_exhaustive]
pub struct PatchOptions {
    /// Bend angle, in radians from one vertex to the next, above which a vertex belongs to a crease.
    /// `None`: six times the median of the surface, and at least 0.035 (two degrees).
    pub bend: Option<f64>,
    /// Minimum fold angle of a crease, in radians, on average along it: patches that meet at a smaller angle are
    /// merged. Default 0.15, about nine degrees.
    pub fold: f64,
    /// Minimum size of a patch, as a share of all vertices, of a mesh as a share of its area; smaller patches are merged
    /// with a neighbouring patch. Default 0.005.
    pub smallest: f64,
}

impl Default for PatchOptions {
    fn default() -> Self {
        PatchOptions {
            bend: None,
            fold: DEFAULT_FOLD,
            smallest: DEFAULT_SMALLEST,
        }
    }
}

impl PatchOptions {
    /// Sets the bend angle above which a vertex belongs to a crease, in radians from one vertex to the next, and
    /// returns the options.
    pub fn bend(self, bend: f64) -> Self {
        PatchOptions {
            bend: Some(bend),
            ..self
        }
    }

    /// Sets the minimum fold angle of a crease, in radians, and returns the options.
    pub fn fold(self, fold: f64) -> Self {
        PatchOptions { fold, ..self }
    }

    /// Sets the minimum size of a patch, as a share of all vertices, and returns the options.
    pub fn smallest(self, smallest: f64) -> Self {
        PatchOptions { smallest, ..self }
    }
}
