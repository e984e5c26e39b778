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

/// Lengths of units in millimetres, with the names that programs give them.
#[cfg(any(feature = "images", feature = "meshes"))]
#[rustfmt::skip]
const UNIT_LENGTHS: [(f64, &[&str]); 9] = [
    (1e-6, &["nm"]),
    (1e-3, &["um", "µm", "μm", "\\u00b5m", "micron", "microns"]),
    (1.0, &["mm", "millimeter"]),
    (10.0, &["cm", "centimeter"]),
    (25.4, &["inch", "inches", "\""]),
    (100.0, &["dm"]),
    (304.8, &["ft", "foot", "feet"]),
    (1_200_000.0 / 3937.0, &["us survey foot", "ussurveyfoot", "us-ft", "ftus"]),
    (1000.0, &["m", "metre", "meter", "metres", "meters"]),
];

/// Returns the length in millimetres of a unit of a given name, in letters of any case.
#[cfg(any(feature = "images", feature = "meshes"))]
pub(super) fn millimetres_in(name: &str) -> Option<f64> {
    let name = name.to_ascii_lowercase();
    let mut units = UNIT_LENGTHS.into_iter();
    units.find_map(|(length, names)| names.contains(&name.as_str()).then_some(length))
}
