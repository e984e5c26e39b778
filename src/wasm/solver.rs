//! The solver, in steps.

use serde_wasm_bindgen::{from_value, to_value};
use wasm_bindgen::prelude::*;

use super::fields::{ImageInput, LatticeInput};
use super::options::{entries, option, unknown};
use super::results::{ImageOutput, SurfaceOutput};
use super::{Failure, Result};
use crate::heightfield::HeightImage;
use crate::solver::{Lambda, Normalization, Options, Schedule, Status};

/// A solver and, if its input was one, the image to bring the result back to.
#[wasm_bindgen]
pub struct Solver {
    solver: crate::Solver,
    image: Option<HeightImage>,
}

#[wasm_bindgen]
impl Solver {
    /// A solver on an image's heights, resampled to the lattice.
    #[wasm_bindgen(js_name = onImage)]
    pub fn on_image(image: JsValue, options: JsValue) -> Result<Solver> {
        let image = from_value::<ImageInput>(image)?.into_image()?;
        let (options, spacing) = solver_options(&options)?;
        Ok(Solver {
            solver: crate::Solver::new(&image.to_lattice(spacing)?, &options)?,
            image: Some(image),
        })
    }

    /// A solver on heights that are on the lattice already.
    #[wasm_bindgen(js_name = onLattice)]
    pub fn on_lattice(field: JsValue, options: JsValue) -> Result<Solver> {
        let field = from_value::<LatticeInput>(field)?.into_heightfield()?;
        let (options, spacing) = solver_options(&options)?;
        if spacing.is_some() {
            return Err(Failure::option(
                "option `spacing` is for images; a lattice has the spacing of its input",
            ));
        }
        Ok(Solver {
            solver: crate::Solver::new(&field, &options)?,
            image: None,
        })
    }

    /// Runs about `work` conjugate-gradient iterations; whether to go on.
    pub fn advance(&mut self, work: usize) -> Result<bool> {
        Ok(self.solver.advance(work)? == Status::Running)
    }

    /// Figures of the last check.
    pub fn progress(&self) -> Result<JsValue> {
        Ok(to_value(&self.solver.progress())?)
    }

    /// Stops.
    pub fn cancel(&mut self) {
        self.solver.cancel();
    }

    /// The best surface so far.
    pub fn surface(&self) -> Result<JsValue> {
        let surface = self.solver.surface()?;
        let field = surface.heightfield();
        let image = match &self.image {
            Some(image) => Some(ImageOutput::from(&field.to_image(image)?)),
            None => None,
        };
        Ok(to_value(&SurfaceOutput {
            rows: field.lattice().rows(),
            cols: field.lattice().cols(),
            spacing: field.lattice().spacing(),
            origin: field.lattice().origin(),
            heights: field.heights().into(),
            image,
            report: surface.report(),
        })?)
    }
}

/// `SolverOptions` of `types.d.ts`; the lattice spacing is none of the solver's.
fn solver_options(options: &JsValue) -> Result<(Options, Option<f64>)> {
    let mut out = Options::default();
    let mut spacing = None;
    for (name, value) in entries(options)? {
        match name.as_str() {
            "lambda" => {
                let lambda: Lambda = option(
                    "lambda",
                    value,
                    "must be small, medium, big or a number above zero",
                )?;
                out = out.lambda(lambda);
            }
            "schedule" => {
                let schedule: Schedule = option("schedule", value, "must be default or paper")?;
                out = out.schedule(schedule);
            }
            "gap" => out = out.gap(option("gap", value, "must be a number")?),
            "maxIterations" => {
                out = out.max_iterations(option("maxIterations", value, "must be a whole number")?);
            }
            "normalize" => {
                let normalize = option("normalize", value, "must be true or false")?;
                out = out.normalization(if normalize {
                    Normalization::UnitSquare
                } else {
                    Normalization::Off
                });
            }
            "spacing" => spacing = Some(option("spacing", value, "must be a number")?),
            _ => {
                return Err(unknown(
                    &name,
                    "lambda, schedule, gap, maxIterations, normalize and spacing",
                ));
            }
        }
    }
    Ok((out, spacing))
}
