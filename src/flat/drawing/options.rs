//! How a pattern is drawn.

/// How a pattern is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct DrawingOptions {
    /// Millimetres for each unit of the surface. Default 1.
    pub scale: f64,
    /// Depth of tabs along cut creases, in millimetres; they are on the side of the patch with
    /// the lower number, in short pieces where that is curved. Default: no tabs.
    pub tabs: Option<f64>,
    /// How far smooth lines may be from those that were found on the lattice, in cells; 0 takes them as they
    /// are. Default 0.5.
    pub smoothing: f64,
}

impl Default for DrawingOptions {
    fn default() -> Self {
        DrawingOptions {
            scale: 1.0,
            tabs: None,
            smoothing: 0.5,
        }
    }
}

impl DrawingOptions {
    /// These options with another scale.
    pub fn scale(self, scale: f64) -> Self {
        DrawingOptions { scale, ..self }
    }

    /// These options with tabs.
    pub fn tabs(self, depth: f64) -> Self {
        DrawingOptions {
            tabs: Some(depth),
            ..self
        }
    }

    /// These options with lines that are smooth within another tolerance.
    pub fn smoothing(self, smoothing: f64) -> Self {
        DrawingOptions { smoothing, ..self }
    }
}
