//! Weight λ of the fidelity term, as a preset or a number.

use std::str::FromStr;

use crate::error::{Error, Result};

/// Weight λ of the fidelity term in the energy, for coordinates normalised to the unit square. The presets are the
/// paper's (Sec. 5).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Lambda {
    /// λ = 10⁵: for heavy, widespread noise, or for few large patches.
    Small,
    /// λ = 10⁶: the weight of [`Options::paper`](crate::Options::paper).
    Medium,
    /// λ = 10⁷: for input that is developable except for small artefacts.
    Big,
    /// Any weight λ of the squared distance from the input, from 10⁻¹² to 10¹⁵, for heights normalised to the unit square.
    Value(f64),
    /// Chosen from the input: λ follows from the size of its noise, and is corrected on a coarse lattice where the surface
    /// there is farther from the heights than noise explains. With [`Energy::Huber`](crate::Energy::Huber) the parameters
    /// of the penalty are those that predict held-out heights best (cross-validation on a coarser lattice). Heights without noise stay within 0.2 % of
    /// their range. An input whose noise cannot be measured, such as a [design](crate::Input::design), gets
    /// [`Lambda::Medium`]. [`Report::lambda_choice`](crate::Report::lambda_choice) reports the choice.
    #[default]
    Auto,
}

impl Lambda {
    /// Returns the preset with the name `small`, `medium`, `big` or `auto`, in upper or lower case; `None` for any
    /// other name.
    pub fn named(name: &str) -> Option<Self> {
        match name.to_ascii_lowercase().as_str() {
            "small" => Some(Lambda::Small),
            "medium" => Some(Lambda::Medium),
            "big" => Some(Lambda::Big),
            "auto" => Some(Lambda::Auto),
            _ => None,
        }
    }

    /// Returns λ as a number. [`Lambda::Auto`] has none before a solve and counts as [`Lambda::Medium`].
    pub fn value(self) -> f64 {
        match self {
            Lambda::Small => 1e5,
            Lambda::Medium | Lambda::Auto => 1e6,
            Lambda::Big => 1e7,
            Lambda::Value(value) => value,
        }
    }
}

impl From<f64> for Lambda {
    fn from(value: f64) -> Self {
        Lambda::Value(value)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Lambda {
    fn deserialize<D: serde::Deserializer<'de>>(
        deserializer: D,
    ) -> std::result::Result<Self, D::Error> {
        deserializer.deserialize_any(LambdaVisitor)
    }
}

/// Deserialisation visitor that reads λ as a number or the name of a preset.
#[cfg(feature = "serde")]
struct LambdaVisitor;

#[cfg(feature = "serde")]
impl serde::de::Visitor<'_> for LambdaVisitor {
    type Value = Lambda;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("small, medium, big, auto or a number above zero")
    }

    fn visit_f64<E>(self, value: f64) -> std::result::Result<Lambda, E> {
        Ok(Lambda::Value(value))
    }

    fn visit_i64<E>(self, value: i64) -> std::result::Result<Lambda, E> {
        Ok(Lambda::Value(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> std::result::Result<Lambda, E> {
        Ok(Lambda::Value(value as f64))
    }

    fn visit_str<E: serde::de::Error>(self, name: &str) -> std::result::Result<Lambda, E> {
        Lambda::named(name).ok_or_else(|| E::invalid_value(serde::de::Unexpected::Str(name), &self))
    }
}

impl FromStr for Lambda {
    type Err = Error;

    /// Reads λ from text: `small`, `medium`, `big`, `auto` or a number.
    fn from_str(text: &str) -> Result<Self> {
        let number = || text.parse().ok().map(Lambda::Value);
        Lambda::named(text).or_else(number).ok_or_else(|| {
            Error::option(
                "lambda",
                text,
                "must be small, medium, big, auto or a number above zero",
            )
        })
    }
}
