//! Fit of a cylinder to heights, for JavaScript.

use js_sys::Float64Array;
use serde::Serialize;
use serde_wasm_bindgen::{preserve, to_value};
use wasm_bindgen::prelude::*;

use super::settings::Settings;
use super::source::Source;
use developable::{CylinderReport, fit_cylinder};
use developable_wasm::Result;

/// Heights of a fitted cylinder and the report, written as JavaScript's `FittedCylinder` object.
#[derive(Serialize)]
struct CylinderOutput {
    rows: usize,
    cols: usize,
    spacing: f64,
    origin: [f64; 2],
    #[serde(with = "preserve")]
    heights: Float64Array,
    report: CylinderReport,
}

/// Fits a cylinder (a surface with parallel rulings) to the heights of a heightfield.
#[wasm_bindgen(js_name = fitCylinder)]
pub fn cylinder(field: JsValue) -> Result<JsValue> {
    let settings = Settings::default();
    let (input, _) = Source::lattice(field)?.input(&settings)?;
    let found = fit_cylinder(input)?;
    let lattice = found.heightfield().lattice();
    Ok(to_value(&CylinderOutput {
        rows: lattice.rows(),
        cols: lattice.cols(),
        spacing: lattice.spacing(),
        origin: lattice.origin(),
        heights: found.heightfield().heights().into(),
        report: *found.report(),
    })?)
}
