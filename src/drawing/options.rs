//! Options of a drawing: its scale, tabs, marks, kerf and allowance.

use super::bending::Bending;
use crate::error::{Error, Result, positive};

/// Options of a drawing: its scale, its tabs and marks, kerf, allowance and bending.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(default, rename_all = "camelCase", deny_unknown_fields)
)]
#[non_exhaustive]
pub struct DrawingOptions {
    /// Scale of the drawing: number of millimetres for each unit of the surface. Default 1.
    pub scale: f64,
    /// Depth of tabs (glued flaps) along cut creases, in millimetres. Tabs are on the side with more room;
    /// along a curve, and along a line that is joined to one, there are several short ones. Default: no tabs.
    pub tabs: Option<f64>,
    /// Distance between marks (short lines for alignment) along joints, in millimetres, at the same points on both
    /// sides. Default: no marks.
    pub marks: Option<f64>,
    /// Kerf: width of the line that a laser or a saw takes away, in millimetres. Cut lines are moved outwards by half
    /// of it, but for slits and holes that would close: these are cut where they are. Default 0.
    pub kerf: f64,
    /// Allowance: width of the strip outside of all edges that is sewn or bent over, in millimetres. Cut lines are
    /// moved outwards by it, but for slits and holes that would close. Default 0.
    pub allowance: f64,
    /// How metal is bent along folds, from which the bend allowance follows. Folds must be straight and go from edge to
    /// edge. Default: no bend allowance.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub bending: Option<Bending>,
    /// Whether all texts are left out except the sheets' names. Default `false`.
    pub plain: bool,
    /// Whether the texture of a mesh is printed on its sheets. Default `false`.
    pub printed: bool,
}

impl Default for DrawingOptions {
    fn default() -> Self {
        DrawingOptions {
            scale: 1.0,
            tabs: None,
            marks: None,
            kerf: 0.0,
            allowance: 0.0,
            bending: None,
            plain: false,
            printed: false,
        }
    }
}

/// Maximum width or height of a drawing, in millimetres.
pub const MAX_SIZE: f64 = 50_000.0;

/// Minimum distance between the lines along which a bend is scored, and between marks along a joint, in millimetres. No table chose it: it is
/// the width of a scoring tool.
pub(super) const MIN_LINE_DISTANCE_MM: f64 = 1.0;

/// Maximum kerf (width that a cutter takes away) and maximum allowance (extra width along edges), in millimetres.
const MAX_OFFSET_MM: f64 = 1000.0;

impl DrawingOptions {
    /// Checks the ranges of all drawing options, before a pattern is made that may take minutes.
    ///
    /// # Errors
    /// [`Error::Option`] for an option that is out of its range.
    pub fn check(&self) -> Result<()> {
        positive("scale", self.scale)?;
        self.tabs.map(|t| positive("tabs", t)).transpose()?;
        if let Some(marks) = self
            .marks
            .filter(|d| !(MIN_LINE_DISTANCE_MM..=MAX_SIZE).contains(d))
        {
            return Err(Error::option(
                "marks",
                marks,
                "must be from 1 to 50000, or 0 for none",
            ));
        }
        for (name, value) in [("kerf", self.kerf), ("allowance", self.allowance)] {
            if !(0.0..=MAX_OFFSET_MM).contains(&value) {
                return Err(Error::option(name, value, "must be from 0 to 1000"));
            }
        }
        self.bending.map_or(Ok(()), |bending| bending.check())?;
        if self.printed && self.bending.is_some() {
            return Err(Error::option(
                "printed",
                "true",
                "must be left out where metal is bent, which stretches what is printed on it",
            ));
        }
        Ok(())
    }

    /// Sets the scale of the drawing, in millimetres for each unit of the surface, and returns the options.
    pub fn scale(self, scale: f64) -> Self {
        DrawingOptions { scale, ..self }
    }

    /// Adds tabs of a given depth, in millimetres, along cut creases, and returns the options.
    pub fn tabs(self, depth: f64) -> Self {
        DrawingOptions {
            tabs: Some(depth),
            ..self
        }
    }

    /// Adds marks at a given distance from each other, in millimetres, along seams, and returns the options.
    pub fn marks(self, distance: f64) -> Self {
        DrawingOptions {
            marks: Some(distance),
            ..self
        }
    }

    /// Sets the kerf, the width in millimetres that the cutter takes away, and returns the options.
    pub fn kerf(self, kerf: f64) -> Self {
        DrawingOptions { kerf, ..self }
    }

    /// Sets the allowance, the width in millimetres of the extra strip along all edges, and returns the options.
    pub fn allowance(self, allowance: f64) -> Self {
        DrawingOptions { allowance, ..self }
    }

    /// Sets how metal is bent along folds, for a bend allowance, and returns the options.
    pub fn bending(self, bending: Bending) -> Self {
        DrawingOptions {
            bending: Some(bending),
            ..self
        }
    }

    /// Sets whether all texts are left out except the sheets' names, and returns the options.
    pub fn plain(self, plain: bool) -> Self {
        DrawingOptions { plain, ..self }
    }

    /// Sets whether the texture of a mesh is printed on its sheets, and returns the options.
    pub fn printed(self, printed: bool) -> Self {
        DrawingOptions { printed, ..self }
    }
}
