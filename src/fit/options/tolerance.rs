//! Distance from the input that a surface may have.

use std::str::FromStr;

use crate::error::{Error, Result};

/// Root mean square distance from the input that a surface may have.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Tolerance {
    /// A distance in the unit of the heights.
    Distance(f64),
    /// A share of the height range of the input, such as 0.005 for 0.5 %.
    Share(f64),
}

impl Tolerance {
    /// Returns the distance that is allowed for heights of a range.
    pub(crate) fn distance(self, range: f64) -> f64 {
        match self {
            Tolerance::Distance(distance) => distance,
            Tolerance::Share(share) => share * range,
        }
    }
}

impl From<f64> for Tolerance {
    fn from(distance: f64) -> Self {
        Tolerance::Distance(distance)
    }
}

impl FromStr for Tolerance {
    type Err = Error;

    /// Reads a tolerance from text: a distance in the unit of the heights, or a share of their range such as `0.5%`.
    fn from_str(text: &str) -> Result<Self> {
        let tolerance = match text.strip_suffix('%') {
            Some(percent) => percent
                .trim_end()
                .parse()
                .ok()
                .map(|x: f64| Tolerance::Share(0.01 * x)),
            None => text.parse().ok().map(Tolerance::Distance),
        };
        let is_positive = |tolerance: &Tolerance| {
            tolerance.distance(1.0) > 0.0 && tolerance.distance(1.0).is_finite()
        };
        tolerance.filter(is_positive).ok_or_else(|| {
            Error::option(
                "tolerance",
                text,
                "must be a distance above zero, or a share of the height range such as 0.5%",
            )
        })
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Tolerance {
    fn deserialize<D: serde::Deserializer<'de>>(
        deserializer: D,
    ) -> std::result::Result<Self, D::Error> {
        deserializer.deserialize_any(ToleranceVisitor)
    }
}

/// Deserialisation visitor that reads a tolerance as a number, or as a map with a `share` of the height range.
#[cfg(feature = "serde")]
struct ToleranceVisitor;

#[cfg(feature = "serde")]
impl<'de> serde::de::Visitor<'de> for ToleranceVisitor {
    type Value = Tolerance;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("a distance above zero, or a share of the height range")
    }

    fn visit_f64<E>(self, value: f64) -> std::result::Result<Tolerance, E> {
        Ok(Tolerance::Distance(value))
    }

    fn visit_i64<E>(self, value: i64) -> std::result::Result<Tolerance, E> {
        Ok(Tolerance::Distance(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> std::result::Result<Tolerance, E> {
        Ok(Tolerance::Distance(value as f64))
    }

    fn visit_map<M: serde::de::MapAccess<'de>>(
        self,
        mut map: M,
    ) -> std::result::Result<Tolerance, M::Error> {
        match map.next_entry::<String, f64>()? {
            Some((name, share)) if name == "share" => Ok(Tolerance::Share(share)),
            _ => Err(serde::de::Error::invalid_type(
                serde::de::Unexpected::Map,
                &self,
            )),
        }
    }
}
