//! Units of length.

/// Unit of the lengths of a file or a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Unit {
    /// Millimetre, 10⁻³ m.
    #[cfg_attr(feature = "serde", serde(rename = "mm"))]
    Millimetre,
    /// Metre, the SI unit of length.
    #[cfg_attr(feature = "serde", serde(rename = "m"))]
    Metre,
}

impl Unit {
    /// Returns the symbol of the unit of length, `"mm"` or `"m"`.
    pub fn symbol(self) -> &'static str {
        match self {
            Unit::Millimetre => "mm",
            Unit::Metre => "m",
        }
    }

    /// Returns the unit with a given symbol; `None` for another text than `"mm"` or `"m"`.
    pub fn from_symbol(symbol: &str) -> Option<Self> {
        [Unit::Millimetre, Unit::Metre]
            .into_iter()
            .find(|unit| unit.symbol() == symbol)
    }

    /// Returns the number of millimetres in one unit of length: the scale of a drawing in true size.
    pub fn millimetres(self) -> f64 {
        match self {
            Unit::Millimetre => 1.0,
            Unit::Metre => 1000.0,
        }
    }
}
