//! Detection of occlusions without a solve, for JavaScript.

use serde_wasm_bindgen::to_value;
use wasm_bindgen::prelude::*;

use super::results::OcclusionsOutput;
use super::settings::Settings;
use super::source::Source;
use developable::Error;
use developable::{OCCLUSION_THRESHOLD, Occlusions};
use developable_wasm::Result;

/// Detects occlusions in the heights of a height image, after resampling to the lattice, or of a heightfield.
#[wasm_bindgen(js_name = occlusions)]
pub fn detect(field: JsValue, options: JsValue) -> Result<JsValue> {
    let source = Source::new(field)?;
    let settings = Settings::new(&options)?;
    let field = source.heights(&settings)?;
    let lattice = field.lattice();
    let threshold = settings.occlusion_threshold.unwrap_or(OCCLUSION_THRESHOLD);
    let found =
        Occlusions::detect(&field, threshold, settings.normalization).map_err(by_its_name_here)?;
    let image = match source.pixels() {
        Some(image) => Some(image.flags_from(lattice, found.vertices())?),
        None => None,
    };
    Ok(to_value(&OcclusionsOutput {
        rows: lattice.rows(),
        cols: lattice.cols(),
        spacing: lattice.spacing(),
        origin: lattice.origin(),
        vertices: found.vertices().into(),
        edges: found.edges().into(),
        count: found.len(),
        image: image.map(|flags| flags.as_slice().into()),
    })?)
}

fn by_its_name_here(mut error: Error) -> Error {
    if let Error::Option { name, .. } = &mut error {
        *name = "threshold";
    }
    error
}
