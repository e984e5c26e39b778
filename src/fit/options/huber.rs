//! Parameters of the Huber penalty.

use super::Options;

/// Parameters of the Huber penalty ([`Energy::Huber`]): bend radius, flatness and crease radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HuberOptions {
    pub bend_radius: f64,
    pub flatness: f64,
    pub crease_radius: f64,
}

impl HuberOptions {
    /// Default Huber parameters, for smooth bends, and creases that are much sharper.
    pub(crate) const SMOOTH: HuberOptions = HuberOptions {
        bend_radius: 0.1,
        flatness: 0.3,
        crease_radius: 0.1,
    };

    /// Parameters for a surface of unknown kind: never far from the best for smooth bends, for creases and for flat
    /// facets.
    pub(crate) const ANY: HuberOptions = HuberOptions {
        bend_radius: 0.2,
        flatness: 0.5,
        crease_radius: 0.1,
    };

    pub(crate) const fn new(bend_radius: f64, flatness: f64, crease_radius: f64) -> Self {
        HuberOptions {
            bend_radius,
            flatness,
            crease_radius,
        }
    }

    /// Returns these parameters, each replaced by the value that `options` give, if they give one.
    pub(crate) fn within(self, options: &Options) -> Self {
        HuberOptions {
            bend_radius: options.bend_radius.unwrap_or(self.bend_radius),
            flatness: options.flatness.unwrap_or(self.flatness),
            crease_radius: options.crease_radius.unwrap_or(self.crease_radius),
        }
    }

    /// Returns the options with these Huber parameters, in place of any that were given.
    pub(crate) fn of(self, options: &Options) -> Options {
        options
            .bend_radius(self.bend_radius)
            .flatness(self.flatness)
            .crease_radius(self.crease_radius)
    }
}
