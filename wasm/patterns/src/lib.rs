//! Surfaces cut into sheets: drawn, and drawings to files.

use js_sys::{Float64Array, Int32Array, Reflect, Uint8Array, Uint32Array};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use developable::assembly::Assembly;
use developable::drawing::{Bending, Drawing, DrawingOptions, Stock};
use developable::files::assembly::{write_animation, write_assembly_svg};
use developable::files::drawings::{write_dxf, write_pdf, write_svg};
use developable::patches::{Crease, MeshPatches, Patch, PatchOptions, Patches};
use developable::pattern::{MeshPattern, Missing, PatternOptions, Sheet, pattern, pattern_mesh};
use developable_wasm::mesh::MeshInput;
use developable_wasm::options::{entries, option, unknown};
use developable_wasm::scene::{Scene, Settings, check_spacing, is_image};
use developable_wasm::{Failure, Result};

/// What is asked for of a pattern.
#[derive(Default)]
struct Wanted {
    patches: PatchOptions,
    sheets: PatternOptions,
    drawing: DrawingOptions,
    stock: Option<Stock>,
    assembled: bool,
    spacing: Option<f64>,
}

impl Wanted {
    fn of(options: &JsValue) -> Result<Self> {
        let mut settings = Settings::default();
        let (mut wanted, mut sheets) = (PatchOptions::default(), PatternOptions::default());
        let mut drawing = DrawingOptions::default();
        let (mut stock, mut assembled) = (None, false);
        let (mut thickness, mut radius, mut factor) = (None, None, None);
        const NUMBER: &str = "must be a number";
        for (name, value) in entries(options)? {
            match name.as_str() {
                "scale" => drawing = drawing.scale(option("scale", value, NUMBER)?),
                "smoothing" => drawing = drawing.smoothing(option("smoothing", value, NUMBER)?),
                "stock" => stock = Some(stock_option(value)?),
                // 0 is none.
                "marks" | "tabs" if value.as_f64() == Some(0.0) => {}
                "marks" => drawing = drawing.marks(option("marks", value, NUMBER)?),
                "kerf" => drawing = drawing.kerf(option("kerf", value, NUMBER)?),
                "allowance" => drawing = drawing.allowance(option("allowance", value, NUMBER)?),
                "thickness" => thickness = Some(option("thickness", value, NUMBER)?),
                "innerRadius" => radius = Some(option("innerRadius", value, NUMBER)?),
                "kFactor" => factor = Some(option("kFactor", value, NUMBER)?),
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
                    let known = "scale, tabs, marks, kerf, allowance, thickness, innerRadius, kFactor, smoothing, stock, assembly, gap, maxStrain, refold, bend, fold, smallest, \
                                 tolerance, maxIterations and spacing";
                    return Err(unknown(&name, known));
                }
            }
        }
        if let Some(bending) = bending(thickness, radius, factor)? {
            drawing = drawing.bending(bending);
        }
        Ok(Wanted {
            patches: wanted,
            sheets: sheets.unrolling(settings.unrolling),
            drawing,
            stock,
            assembled,
            spacing: settings.spacing,
        })
    }

    /// `Drawing` of `types.d.ts`.
    fn draw(&self, sheets: &[Sheet], missing: &Missing) -> Result<JsValue> {
        let drawn = Drawing::new(sheets, &self.drawing)?;
        let drawn = drawn.missing(missing, self.drawing.scale);
        let drawn = match self.stock {
            Some(stock) => drawn.onto(stock)?,
            None => drawn,
        };
        let value = to_value(&drawn)?;
        if self.assembled {
            let assembly = Assembly::new(sheets);
            let whole = to_value(&assembly)?;
            let model = write_animation(sheets, &assembly, self.drawing.scale)?;
            let picture = write_assembly_svg(sheets)?;
            set(&whole, "model", &Uint8Array::from(&model[..]))?;
            set(&whole, "picture", &Uint8Array::from(&picture[..]))?;
            set(&value, "assembly", &whole)?;
        }
        Ok(value)
    }
}

/// The drawing of a surface's pattern.
#[wasm_bindgen(js_name = pattern)]
pub fn draw_pattern(field: JsValue, options: JsValue) -> Result<JsValue> {
    let wanted = Wanted::of(&options)?;
    check_spacing(wanted.spacing, is_image(&field)?)?;
    let surface = Scene::new(field, wanted.spacing)?.surface;
    let patches = Patches::new(&surface, &wanted.patches)?;
    let found = pattern(&surface, &patches, &wanted.sheets)?;
    wanted.draw(&found.sheets, &found.missing)
}

/// The same of a mesh as it is.
#[wasm_bindgen(js_name = patternMesh)]
pub fn draw_pattern_of_mesh(mesh: JsValue, options: JsValue) -> Result<JsValue> {
    let wanted = Wanted::of(&options)?;
    let (_, found) = sheets_of(mesh, &wanted)?;
    wanted.draw(&found.sheets, &Missing::default())
}

/// `MeshUnrolling` of `types.d.ts`.
#[derive(Serialize)]
struct UnrollingOutput<'a> {
    #[serde(with = "preserve")]
    labels: Int32Array,
    #[serde(with = "preserve")]
    positions: Float64Array,
    #[serde(with = "preserve")]
    places: Float64Array,
    #[serde(with = "preserve")]
    triangles: Uint32Array,
    #[serde(with = "preserve")]
    sheets: Uint32Array,
    patches: &'a [Patch],
    creases: &'a [Crease],
    report: UnrollingReport,
}

#[derive(Serialize)]
struct UnrollingReport {
    sheets: usize,
    area: f64,
    strain: f64,
    gap: f64,
}

/// A mesh as it is laid flat: in sheets, one to the right of the other.
#[wasm_bindgen(js_name = unrollMesh)]
pub fn unroll_mesh(mesh: JsValue, options: JsValue) -> Result<JsValue> {
    let wanted = Wanted::of(&options)?;
    let (patches, found) = sheets_of(mesh, &wanted)?;
    let labels: Vec<i32> = patches.labels().iter().map(|label| *label as i32).collect();
    let (mut positions, mut places, mut triangles, mut sheets) =
        (Vec::new(), Vec::new(), Vec::<[u32; 3]>::new(), Vec::new());
    let mut right = 0.0;
    for (number, sheet) in (0u32..).zip(&found.sheets) {
        let first = positions.len() as u32;
        let xs = sheet.faces.flat.iter().map(|[x, _]| *x);
        let (low, high) = (
            xs.clone().fold(f64::INFINITY, f64::min),
            xs.fold(f64::NEG_INFINITY, f64::max),
        );
        positions.extend(&sheet.faces.built);
        places.extend(sheet.faces.flat.iter().map(|[x, y]| [x - low + right, *y]));
        triangles.extend(sheet.faces.triangles.iter().map(|t| t.map(|v| v + first)));
        sheets.resize(positions.len(), number);
        right += high - low + sheet.spacing;
    }
    let most = |of: fn(&Sheet) -> f64| found.sheets.iter().map(of).fold(0.0, f64::max);
    Ok(to_value(&UnrollingOutput {
        labels: labels.as_slice().into(),
        positions: positions.as_flattened().into(),
        places: places.as_flattened().into(),
        triangles: triangles.as_flattened().into(),
        sheets: sheets.as_slice().into(),
        patches: patches.patches(),
        creases: patches.creases(),
        report: UnrollingReport {
            sheets: found.sheets.len(),
            area: found.sheets.iter().map(|sheet| sheet.area).sum(),
            strain: most(|sheet| sheet.strain),
            gap: most(|sheet| sheet.gap),
        },
    })?)
}

fn sheets_of(mesh: JsValue, wanted: &Wanted) -> Result<(MeshPatches, MeshPattern)> {
    let mesh = from_value::<MeshInput>(mesh)?.into_mesh()?;
    let patches = MeshPatches::new(&mesh, &wanted.patches)?;
    let found = pattern_mesh(&mesh, &patches, &wanted.sheets)?;
    Ok((patches, found))
}

/// How metal is bent, if a thickness was given.
fn bending(
    thickness: Option<f64>,
    radius: Option<f64>,
    factor: Option<f64>,
) -> Result<Option<Bending>> {
    let Some(thickness) = thickness else {
        return match radius.or(factor) {
            None => Ok(None),
            Some(_) => Err(Failure {
                code: "OPTION",
                message: "options `innerRadius` and `kFactor` are about bent metal: give the option `thickness`, too".into(),
            }),
        };
    };
    let metal = Bending::new(thickness);
    let metal = metal.radius(radius.unwrap_or(metal.radius));
    Ok(Some(metal.k_factor(factor.unwrap_or(metal.k_factor))))
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

fn stock_option(value: JsValue) -> Result<Stock> {
    const SIZES: &str = "must be a4, letter, [width, height] of plates or [width] of a roll";
    Ok(match option("stock", value, SIZES)? {
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
            "stock" => stock = Some(stock_option(value)?),
            _ => return Err(unknown(&name, "stock")),
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
    from_value(drawing).map_err(|_| Failure {
        code: "INPUT",
        message: "the drawing must be one that `pattern` or `patternMesh` gave, with nothing taken out or changed".into(),
    })
}
