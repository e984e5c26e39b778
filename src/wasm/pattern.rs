//! Surfaces cut into sheets, drawn.

use serde_wasm_bindgen::to_value;
use wasm_bindgen::prelude::*;

use super::Result;
use super::options::{entries, option, unknown};
use super::sheets::{Scene, Settings, check_spacing, is_image};
use crate::drawing::{Drawing, DrawingOptions};
use crate::patches::{PatchOptions, Patches};
use crate::pattern::{PatternOptions, pattern};

/// The drawing of a surface's pattern.
#[wasm_bindgen(js_name = pattern)]
pub fn draw_pattern(field: JsValue, options: JsValue) -> Result<JsValue> {
    let mut settings = Settings::default();
    let (mut wanted, mut sheets) = (PatchOptions::default(), PatternOptions::default());
    let mut drawing = DrawingOptions::default();
    const NUMBER: &str = "must be a number";
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "scale" => drawing = drawing.scale(option("scale", value, NUMBER)?),
            "tabs" => drawing = drawing.tabs(option("tabs", value, NUMBER)?),
            "gap" => sheets = sheets.gap(option("gap", value, NUMBER)?),
            "bend" => wanted = wanted.bend(option("bend", value, NUMBER)?),
            "fold" => wanted = wanted.fold(option("fold", value, NUMBER)?),
            "smallest" => wanted = wanted.smallest(option("smallest", value, NUMBER)?),
            _ if settings.take(&name, &value)? => {}
            _ => {
                let known = "scale, tabs, gap, bend, fold, smallest, tolerance, maxIterations and \
                             spacing";
                return Err(unknown(&name, known));
            }
        }
    }
    check_spacing(settings.spacing, is_image(&field)?)?;
    let surface = Scene::new(field, settings.spacing)?.surface;
    let patches = Patches::new(&surface, &wanted)?;
    let sheets = pattern(&surface, &patches, &sheets.unrolling(settings.unrolling))?;
    Ok(to_value(&Drawing::new(&sheets, &drawing)?)?)
}
