//! Names of the schedules, the energies and the border's conditions.

use std::str::FromStr;

use crate::error::{Error, Result};

/// Schedule of a solve: how ADMM's iterations run and when they stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Deserialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum Schedule {
    /// Default schedule: few conjugate-gradient iterations in each z-step, over-relaxation and balancing of the
    /// relative residuals; stops at the certified relative duality gap [`Options::gap`](crate::Options::gap).
    #[default]
    Default,
    /// The paper's schedule (Sec. 4.1): z-steps solved to a tight tolerance, residual balancing after Boyd et al. that
    /// changes ρ at a larger ratio of the residuals; stops when the residuals are small. The duality gap is reported
    /// all the same.
    Paper,
}

impl FromStr for Schedule {
    type Err = Error;

    /// Reads a schedule from its name, `default` or `paper`.
    fn from_str(text: &str) -> Result<Self> {
        match text {
            "default" => Ok(Schedule::Default),
            "paper" => Ok(Schedule::Paper),
            _ => Err(Error::option("schedule", text, "must be default or paper")),
        }
    }
}

/// Penalty of the Hessian `H` of heights, which is minimised together with the fidelity term.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "camelCase")
)]
#[non_exhaustive]
pub enum Energy {
    /// Penalty `Σ ‖H‖_*`, the nuclear norm of the Hessian: piecewise developable surfaces (paper, Eq. 15). The default
    /// of a [design](crate::Input::design).
    Nuclear,
    /// Penalty `Σ ‖H‖_F`, the Frobenius norm of the Hessian: rounds off creases (paper, Fig. 21).
    Frobenius,
    /// Penalty `Σ ‖H‖_*²`, the squared nuclear norm of the Hessian: rounds off creases (paper, Fig. 21).
    SquaredNuclear,
    /// Penalty `Σ n₃ ‖H‖_*`, the nuclear norm of the second fundamental form, with the factor `n₃ = (1 + |∇z|²)^-½`
    /// computed from the input once: convex (paper, Fig. 7, right).
    SecondFormOfInput,
    /// Penalty `Σ n₃ ‖H‖_*` with the factor `n₃ = (1 + |∇z|²)^-½` of the surface itself, updated in each iteration: not
    /// convex (paper, Fig. 7, centre right). The duality gap is certified for the energy with the last factor kept.
    SecondForm,
    /// Huber penalty `Σ φ(‖H‖_*)`: `φ` is quadratic for small bends and linear for large ones, with the slope `min(α +
    /// s/δ, 1)` at the size `s`. The surface stays smooth where it bends smoothly, without the flat strips of the
    /// nuclear norm, and can still crease and stay developable. Up to
    /// [`Options::crease_passes`](crate::Options::crease_passes) further solves lower the cost of bends tighter than
    /// [`Options::crease_radius`](crate::Options::crease_radius), so that creases keep their angle. Objective and
    /// duality gap of the report belong to the last solve's energy. The default of every input that is not a design.
    #[default]
    Huber,
}

impl FromStr for Energy {
    type Err = Error;

    /// Reads an energy from its name: `nuclear`, `frobenius`, `squaredNuclear`, `secondFormOfInput`, `secondForm` or
    /// `huber`.
    fn from_str(text: &str) -> Result<Self> {
        match text {
            "nuclear" => Ok(Energy::Nuclear),
            "frobenius" => Ok(Energy::Frobenius),
            "squaredNuclear" => Ok(Energy::SquaredNuclear),
            "secondFormOfInput" => Ok(Energy::SecondFormOfInput),
            "secondForm" => Ok(Energy::SecondForm),
            "huber" => Ok(Energy::Huber),
            _ => Err(Error::option(
                "energy",
                text,
                "must be nuclear, frobenius, squaredNuclear, secondFormOfInput, secondForm or huber",
            )),
        }
    }
}

/// Boundary condition at the border of the surface, under [`Energy::Huber`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Border {
    /// Free border, without bending moment. The surface of least energy is then too straight along it.
    Free,
    /// Border loaded with the bending moments found inside the surface in the pass before, continued to the border
    /// where they would not fold it. The first pass has a free border.
    #[default]
    Loaded,
}
