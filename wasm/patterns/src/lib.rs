//! Surfaces cut into sheets: drawn, and drawings to files.

use js_sys::{Reflect, Uint8Array};
use serde::Deserialize;
use serde_wasm_bindgen::{from_value, to_value};
use wasm_bindgen::prelude::*;

use developable::assembly::Assembly;
use developable::drawing::{Drawing, DrawingOptions, Stock};
use developable::files::assembly::{write_animation, write_assembly_svg};
use developable::files::drawings::{write_dxf, write_pdf, write_svg};
use developable::patches::{PatchOptions, Patches};
use developable::pattern::{PatternOptions, pattern};
use developable_wasm::options::{entries, option, unknown};
use developable_wasm::scene::{Scene, Settings, check_spacing, is_image};
use developable_wasm::{Failure, Result};

/// The drawing of a surface's pattern.
#[wasm_bindgen(js_name = pattern)]
pub fn draw_pattern(field: JsValue, options: JsValue) -> Result<JsValue> {
    let mut settings = Settings::default();
    let (mut wanted, mut sheets) = (PatchOptions::default(), PatternOptions::default());
    let mut drawing = DrawingOptions::default();
    let (mut stock, mut assembled) = (None, false);
    const NUMBER: &str = "must be a number";
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "scale" => drawing = drawing.scale(option("scale", value, NUMBER)?),
            "smoothing" => drawing = drawing.smoothing(option("smoothing", value, NUMBER)?),
            "paper" => stock = Some(paper(value)?),
            "marks" => drawing = drawing.marks(option("marks", value, NUMBER)?),
            "kerf" => drawing = drawing.kerf(option("kerf", value, NUMBER)?),
            "allowance" => drawing = drawing.allowance(option("allowance", value, NUMBER)?),
            "assembly" => assembled = option("assembly", value, "must be true or false")?,
            "tabs" => drawing = drawing.tabs(option("tabs", value, NUMBER)?),
            "gap" => sheets = sheets.gap(option("gap", value, NUMBER)?),
            "maxStrain" => sheets = sheets.max_strain(option("maxStrain", value, NUMBER)?),
            "refold" => {
                sheets = sheets.refold(option("refold", value, "must be true or false")?);
            }
            "bend" => wanted = wanted.bend(option("bend", value, NUMBER)?),
            "fold" => wanted = wanted.fold(option("fold", value, NUMBER)?),
            "smallest" => wanted = wanted.smallest(option("smallest", value, NUMBER)?),
            _ if settings.take(&name, &value)? => {}
            _ => {
                let known = "scale, tabs, marks, kerf, allowance, smoothing, paper, assembly, gap, maxStrain, refold, bend, fold, smallest, \
                             tolerance, maxIterations and spacing";
                return Err(unknown(&name, known));
            }
        }
    }
    check_spacing(settings.spacing, is_image(&field)?)?;
    let surface = Scene::new(field, settings.spacing)?.surface;
    let patches = Patches::new(&surface, &wanted)?;
    let found = pattern(&surface, &patches, &sheets.unrolling(settings.unrolling))?;
    let drawn = Drawing::new(&found.sheets, &drawing)?;
    let drawn = drawn.missing(&found.missing, drawing.scale);
    let drawn = match stock {
        Some(stock) => drawn.onto(stock)?,
        None => drawn,
    };
    let value = to_value(&drawn)?;
    if assembled {
        let assembly = Assembly::new(&found.sheets);
        let whole = to_value(&assembly)?;
        let model = write_animation(&found.sheets, &assembly, drawing.scale)?;
        let picture = write_assembly_svg(&found.sheets)?;
        set(&whole, "model", &Uint8Array::from(&model[..]))?;
        set(&whole, "picture", &Uint8Array::from(&picture[..]))?;
        set(&value, "assembly", &whole)?;
    }
    Ok(value)
}

fn set(object: &JsValue, name: &str, value: &JsValue) -> Result<()> {
    // A plain object takes what it is given.
    Reflect::set(object, &name.into(), value).map_err(|error| Failure {
        code: "INPUT",
        message: format!("{error:?}"),
    })?;
    Ok(())
}

/// `Stock` of `types.d.ts`.
#[derive(Deserialize)]
#[serde(untagged)]
enum Paper {
    Named(Named),
    Plate([f64; 2]),
    Roll([f64; 1]),
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Named {
    A4,
    Letter,
}

fn paper(value: JsValue) -> Result<Stock> {
    const SIZES: &str = "must be a4, letter, [width, height] of plates or [width] of a roll";
    Ok(match option("paper", value, SIZES)? {
        Paper::Named(Named::A4) => Stock::A4,
        Paper::Named(Named::Letter) => Stock::Letter,
        Paper::Plate(sides) => Stock::Plate(sides),
        Paper::Roll([width]) => Stock::Roll(width),
    })
}

/// SVG file of a drawing.
#[wasm_bindgen(js_name = writeSvg)]
pub fn write_svg_file(drawing: JsValue) -> Result<Uint8Array> {
    Ok(write_svg(&drawn(drawing)?)?.as_slice().into())
}

/// PDF file of a drawing, on one page or on those of a stock.
#[wasm_bindgen(js_name = writePdf)]
pub fn write_pdf_file(drawing: JsValue, options: JsValue) -> Result<Uint8Array> {
    let mut stock = None;
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "paper" => stock = Some(paper(value)?),
            _ => return Err(unknown(&name, "paper")),
        }
    }
    Ok(write_pdf(&drawn(drawing)?, stock)?.as_slice().into())
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
