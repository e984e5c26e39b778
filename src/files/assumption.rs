//! What a reader assumed because a file does not say it.

/// Something that a reader assumed because the file does not say it, with the words for whoever reads the result.
///
/// Reports list every assumption, so that nobody has to find out from a wrong size or a missing part of a surface.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Assumption {
    /// What kind of assumption it is, in camel case, such as `"noData"`: stable, for programs.
    pub code: &'static str,
    /// One sentence without a full stop, such as `"-9999 is no data (412 pixels)"`, which follows the word "assumed".
    pub words: String,
    /// Name of the package's option that decides it instead, such as `"noData"`; `None` where there is none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub option: Option<&'static str>,
}

impl Assumption {
    /// Creates an assumption of a kind, with its words and the option that decides it instead.
    pub fn new(
        code: &'static str,
        words: impl Into<String>,
        option: impl Into<Option<&'static str>>,
    ) -> Self {
        Assumption {
            code,
            words: words.into(),
            option: option.into(),
        }
    }
}

/// Rounds a number to a number of digits for a sentence.
#[cfg(any(feature = "formats", feature = "meshes"))]
pub(crate) fn rounded(number: f64, digits: usize) -> f64 {
    let places = digits.saturating_sub(1);
    format!("{number:.places$e}").parse().unwrap_or(number)
}
