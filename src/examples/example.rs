//! Example surfaces by name: cylinder, cone, roof, oloid, page and house.

use std::str::FromStr;

use crate::error::{Error, Result};

/// An example surface, developable except at creases. Each fits a box whose longer side is 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Example {
    /// Part of a circular cylinder over a square, with its axis turned 25° from the image's rows.
    Cylinder,
    /// A circular cone seen from above, without data outside of its base.
    Cone,
    /// Two barrel vaults that cross, and a cone over their crossing, as in [the paper's](crate#references) Fig. 22:
    /// five developable patches between creases.
    Roof,
    /// The upper half of an oloid, the convex hull of two unit circles in perpendicular
    /// planes, each through the other's centre, seen face-on to one of them: a crease along
    /// the other, no data beyond the outline. (Dirnböck and Stachel 1997.)
    Oloid,
    /// A sheet with the proportions of A4, flat on one side and rolled up on a slanting
    /// cylinder on the other, without stretch; no data beyond its edge.
    Page,
    /// A hip roof with a barrel vault before and behind it: its four planes fold from one sheet, and
    /// the vaults, which meet them along curves, are sheets of their own.
    House,
}

impl Example {
    /// List of all examples.
    pub const ALL: [Example; 6] = [
        Example::Cylinder,
        Example::Cone,
        Example::Roof,
        Example::Oloid,
        Example::Page,
        Example::House,
    ];

    /// Name of the example in lower case: `"cylinder"`, `"cone"`, `"roof"`, `"oloid"`, `"page"`, `"house"`.
    pub fn name(self) -> &'static str {
        match self {
            Example::Cylinder => "cylinder",
            Example::Cone => "cone",
            Example::Roof => "roof",
            Example::Oloid => "oloid",
            Example::Page => "page",
            Example::House => "house",
        }
    }
}

impl FromStr for Example {
    type Err = Error;

    /// Finds an example by its [name](Example::name).
    fn from_str(name: &str) -> Result<Self> {
        Example::ALL
            .into_iter()
            .find(|example| example.name() == name)
            .ok_or_else(|| {
                Error::option(
                    "example",
                    name,
                    "must be `cylinder`, `cone`, `roof`, `oloid`, `page` or `house`",
                )
            })
    }
}
