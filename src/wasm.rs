//! The library as JavaScript sees it, behind `pkg/direct.js`: plain objects and
//! typed arrays in and out, errors with a `code`. Nothing is computed here.

mod examples;
mod fields;
#[cfg(feature = "formats")]
mod files;
mod options;

use js_sys::Reflect;
use serde_wasm_bindgen::{from_value, to_value};
use wasm_bindgen::prelude::*;

use crate::error::Error;
use crate::heightfield::HeightImage;
use crate::solver::Status;
use fields::{ImageInput, ImageOutput, LatticeInput, SurfaceOutput};
use options::solver_options;

type Result<T> = std::result::Result<T, Failure>;

/// Turns panics into JS exceptions that say what happened. The caller has to
/// give the instance up after one.
#[wasm_bindgen(js_name = reportPanics)]
pub fn report_panics() {
    std::panic::set_hook(Box::new(|panic| {
        wasm_bindgen::throw_str(&panic.to_string())
    }));
}

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

/// What becomes a JS `Error` with a `code`.
pub struct Failure {
    code: &'static str,
    message: String,
}

impl Failure {
    fn option(message: impl Into<String>) -> Self {
        Failure {
            code: "OPTION",
            message: message.into(),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Failure {
            code: error.code(),
            message: error.to_string(),
        }
    }
}

/// Something that JS should not have let through.
impl From<serde_wasm_bindgen::Error> for Failure {
    fn from(error: serde_wasm_bindgen::Error) -> Self {
        Failure {
            code: "INPUT",
            message: error.to_string(),
        }
    }
}

impl From<Failure> for JsValue {
    fn from(failure: Failure) -> Self {
        let error = js_sys::Error::new(&failure.message);
        // Cannot fail: the object is new and extensible.
        let _ = Reflect::set(&error, &"code".into(), &failure.code.into());
        error.into()
    }
}
