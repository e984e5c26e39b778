//! Solver for heightfields that runs in steps, as JavaScript calls it.

use serde_wasm_bindgen::to_value;
use wasm_bindgen::prelude::*;

use super::results::{ImageOutput, SurfaceOutput};
use super::settings::Settings;
use super::source::Source;
use developable::{HeightImage, Status};
use developable_wasm::Result;

/// Solver for heights, with its input, which is kept for restarts and for resampling the surface to the image.
#[wasm_bindgen]
pub struct Solver {
    solver: developable::Solver,
    source: Source,
    /// Height image that fitted surfaces are resampled to, with small holes bridged; None for an input on a lattice.
    pixels: Option<HeightImage>,
    settings: Settings,
}

#[wasm_bindgen]
impl Solver {
    /// Makes a solver for the heights of a height image, which are resampled to the lattice, or of a heightfield.
    #[wasm_bindgen(constructor)]
    pub fn new(field: JsValue, options: JsValue) -> Result<Solver> {
        let source = Source::new(field)?;
        let settings = Settings::new(&options)?;
        let (input, pixels) = source.input(&settings)?;
        Ok(Solver {
            solver: developable::Solver::new(input, &settings.options)?,
            source,
            pixels,
            settings,
        })
    }

    /// Restarts the solve with other options on the same input, with a warm start from the last surface.
    pub fn restart(&mut self, options: JsValue) -> Result<()> {
        let settings = Settings::new(&options)?;
        if settings.leave_input(&self.settings) {
            self.solver.restart(&settings.options)?;
        } else {
            let (input, pixels) = self.source.input(&settings)?;
            self.solver.restart_with(input, &settings.options)?;
            self.pixels = pixels;
        }
        self.settings = settings;
        Ok(())
    }

    /// Restarts the solve with other heights, with a warm start from the last surface.
    #[wasm_bindgen(js_name = restartWith)]
    pub fn restart_with(&mut self, field: JsValue, options: JsValue) -> Result<()> {
        let source = Source::new(field)?;
        let settings = Settings::new(&options)?;
        let (input, pixels) = source.input(&settings)?;
        self.solver.restart_with(input, &settings.options)?;
        self.pixels = pixels;
        self.source = source;
        self.settings = settings;
        Ok(())
    }

    /// Runs about `work` conjugate-gradient iterations; returns whether the solve is still running.
    pub fn advance(&mut self, work: usize) -> Result<bool> {
        Ok(self.solver.advance(work)? == Status::Running)
    }

    /// Returns the progress of the solve at its last check (energy, dual bound and gap) as a JavaScript object.
    pub fn progress(&self) -> Result<JsValue> {
        Ok(to_value(&self.solver.progress())?)
    }

    /// Stops a running solve; its surface is then the best one so far.
    pub fn cancel(&mut self) {
        self.solver.cancel();
    }

    /// Returns the best surface so far, resampled to the image if the input was one: JavaScript's `Surface` object.
    pub fn surface(&self) -> Result<JsValue> {
        let surface = self.solver.surface()?;
        let field = surface.heightfield();
        let image = match &self.pixels {
            Some(image) => Some(field.to_image(image)?),
            None => None,
        };
        let measured = self.source.measured_pixels();
        let distance = |image: &HeightImage| Some(image.distance(measured?));
        Ok(to_value(&SurfaceOutput {
            rows: field.lattice().rows(),
            cols: field.lattice().cols(),
            spacing: field.lattice().spacing(),
            origin: field.lattice().origin(),
            heights: field.heights().into(),
            pixel_distance: image.as_ref().and_then(distance),
            image: image.as_ref().map(ImageOutput::from),
            report: surface.report(),
        })?)
    }
}
