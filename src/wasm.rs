//! The library as JavaScript sees it, behind `pkg/direct.js`: plain objects and
//! typed arrays in and out, errors with a `code`. Nothing is computed here.

use js_sys::{Array, Float64Array, Object, Reflect, Uint8Array};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use crate::error::{Error, checked_cells, try_filled};
use crate::heightfield::{HeightImage, Heightfield};
use crate::lattice::Lattice;
use crate::solver::{Lambda, Normalization, Options, Report, Schedule, Status};

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
    pub fn advance(&mut self, work: usize) -> bool {
        self.solver.advance(work) == Status::Running
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

/// `HeightImage` of `types.d.ts`.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ImageInput {
    width: usize,
    height: usize,
    #[serde(with = "preserve")]
    data: JsValue,
    #[serde(default, with = "preserve")]
    mask: JsValue,
    no_data: Option<f64>,
    pixel_size: Option<f64>,
    height_scale: Option<f64>,
}

impl ImageInput {
    fn into_image(self) -> Result<HeightImage> {
        let values = values(
            "height image",
            self.height,
            self.width,
            &self.data,
            self.no_data,
        )?;
        let mut image = HeightImage::new(self.width, self.height, values)?;
        if let Some(mask) = mask(&self.mask) {
            image = image.masked(&mask)?;
        }
        if let Some(scale) = self.height_scale {
            image = image.scaled(scale)?;
        }
        Ok(image.with_pixel_size(self.pixel_size.unwrap_or(1.0))?)
    }
}

/// `Heightfield` of `types.d.ts`.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct LatticeInput {
    rows: usize,
    cols: usize,
    spacing: f64,
    #[serde(with = "preserve")]
    heights: JsValue,
    origin: Option<[f64; 2]>,
    #[serde(default, with = "preserve")]
    mask: JsValue,
    no_data: Option<f64>,
}

impl LatticeInput {
    fn into_heightfield(self) -> Result<Heightfield> {
        let lattice = Lattice::new(self.rows, self.cols, self.spacing)?
            .with_origin(self.origin.unwrap_or_default())?;
        let values = values(
            "heightfield",
            self.rows,
            self.cols,
            &self.heights,
            self.no_data,
        )?;
        let mut field = Heightfield::new(lattice, values)?;
        if let Some(mask) = mask(&self.mask) {
            field = field.masked(&mask)?;
        }
        Ok(field)
    }
}

/// `Surface` of `types.d.ts`.
#[derive(Serialize)]
struct SurfaceOutput<'a> {
    rows: usize,
    cols: usize,
    spacing: f64,
    origin: [f64; 2],
    #[serde(with = "preserve")]
    heights: Float64Array,
    #[serde(skip_serializing_if = "Option::is_none")]
    image: Option<ImageOutput>,
    report: &'a Report,
}

/// A `HeightImage` of `types.d.ts` that is a result.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct ImageOutput {
    width: usize,
    height: usize,
    pixel_size: f64,
    #[serde(with = "preserve")]
    data: Float64Array,
}

impl From<&HeightImage> for ImageOutput {
    fn from(image: &HeightImage) -> Self {
        ImageOutput {
            width: image.width(),
            height: image.height(),
            pixel_size: image.pixel_size(),
            data: image.values().into(),
        }
    }
}

/// A copy of a typed array of any kind, with NaN for `no_data`. The size is
/// checked before anything is allocated.
fn values(
    what: &'static str,
    rows: usize,
    cols: usize,
    data: &JsValue,
    no_data: Option<f64>,
) -> Result<Vec<f64>> {
    let data = match data.dyn_ref::<Float64Array>() {
        Some(data) => data.clone(),
        None => Float64Array::new(data),
    };
    let expected = checked_cells(what, rows, cols)?;
    let found = data.length() as usize;
    if found != expected {
        return Err(Failure::from(Error::Shape {
            what,
            rows,
            cols,
            expected,
            found,
        }));
    }
    let mut values = try_filled(what, found, 0.0)?;
    data.copy_to(&mut values);
    if let Some(no_data) = no_data {
        for value in values.iter_mut().filter(|value| **value == no_data) {
            *value = f64::NAN;
        }
    }
    Ok(values)
}

fn mask(mask: &JsValue) -> Option<Vec<u8>> {
    mask.dyn_ref::<Uint8Array>().map(Uint8Array::to_vec)
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

/// What an options object says, without what is undefined in it.
fn entries(options: &JsValue) -> Result<Vec<(String, JsValue)>> {
    if options.is_undefined() {
        return Ok(Vec::new());
    }
    let Some(options) = options.dyn_ref::<Object>() else {
        return Err(Failure::option("the options must be an object"));
    };
    Ok(Object::entries(options)
        .iter()
        .map(|entry| Array::from(&entry))
        .filter(|entry| !entry.get(1).is_undefined())
        .map(|entry| {
            (
                String::from(js_sys::JsString::from(entry.get(0))),
                entry.get(1),
            )
        })
        .collect())
}

fn option<T: DeserializeOwned>(
    name: &'static str,
    value: JsValue,
    requirement: &'static str,
) -> Result<T> {
    from_value(value.clone()).map_err(|_| {
        let shown = js_sys::JSON::stringify(&value).ok().map(String::from);
        Failure::from(Error::option(
            name,
            shown.unwrap_or_else(|| format!("{value:?}")),
            requirement,
        ))
    })
}

fn unknown(name: &str, known: &str) -> Failure {
    Failure::option(format!("there is no option `{name}`, only {known}"))
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
