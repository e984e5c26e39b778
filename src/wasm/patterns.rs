//! Drawings of patterns to files.

use js_sys::Uint8Array;
use serde_wasm_bindgen::from_value;
use wasm_bindgen::prelude::*;

use super::options::{entries, option, unknown};
use super::{Failure, Result};
use crate::drawing::{Drawing, Paper};
use crate::patterns::{write_dxf, write_pdf, write_svg};

/// SVG file of a drawing.
#[wasm_bindgen(js_name = writeSvg)]
pub fn write_svg_file(drawing: JsValue) -> Result<Uint8Array> {
    Ok(write_svg(&drawn(drawing)?)?.as_slice().into())
}

/// PDF file of a drawing, on one page or on those of a paper.
#[wasm_bindgen(js_name = writePdf)]
pub fn write_pdf_file(drawing: JsValue, options: JsValue) -> Result<Uint8Array> {
    let mut paper = None;
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "paper" => paper = Some(option::<Paper>("paper", value, "must be a4 or letter")?),
            _ => return Err(unknown(&name, "paper")),
        }
    }
    Ok(write_pdf(&drawn(drawing)?, paper)?.as_slice().into())
}

/// DXF file of a drawing.
#[wasm_bindgen(js_name = writeDxf)]
pub fn write_dxf_file(drawing: JsValue) -> Result<Uint8Array> {
    Ok(write_dxf(&drawn(drawing)?)?.as_slice().into())
}

/// `Drawing` of `types.d.ts`.
fn drawn(drawing: JsValue) -> Result<Drawing> {
    from_value(drawing).map_err(|error| Failure {
        code: "INPUT",
        message: format!("the drawing must be one that `pattern` gave: {error}"),
    })
}
