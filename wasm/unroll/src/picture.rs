//! Pictures of surfaces, as pixels or on a canvas, for JavaScript.

use js_sys::{Object, Reflect, Uint8ClampedArray, global};
use serde::Deserialize;
use wasm_bindgen::prelude::*;
use web_sys::{
    CanvasRenderingContext2d, HtmlCanvasElement, ImageData, OffscreenCanvas,
    OffscreenCanvasRenderingContext2d,
};

use developable::patches::PatchOptions;
use developable::picture::{Curvature, Picture, PictureOptions, Style};
use developable_wasm::options::OptionReader;
use developable_wasm::photo::extent_from;
use developable_wasm::scene::{Scene, check_spacing, is_image};
use developable_wasm::{Failure, Result};

use super::spacing_of;

/// Draws a surface seen from above to pixels: returns an `ImageData` where the platform has it, else a plain object
/// with the same fields.
#[wasm_bindgen]
pub fn picture(field: JsValue, options: JsValue) -> Result<JsValue> {
    let picture = drawn(field, options)?;
    if Reflect::has(&global(), &"ImageData".into()) == Ok(true) {
        return Ok(image_data(&picture)?.into());
    }
    let plain = Object::new();
    for (name, value) in [
        ("width", picture.width().into()),
        ("height", picture.height().into()),
        ("data", Uint8ClampedArray::from(picture.rgba()).into()),
    ] {
        // Cannot fail: the object is new and extensible.
        let _ = Reflect::set(&plain, &name.into(), &value);
    }
    Ok(plain.into())
}

/// Draws a surface seen from above to a canvas, which is resized to the picture.
#[wasm_bindgen]
pub fn draw(canvas: JsValue, field: JsValue, options: JsValue) -> Result<()> {
    let canvas = Canvas::new(canvas)?;
    canvas.put(&drawn(field, options)?)
}

/// Options of a picture, read from JavaScript's `PictureOptions` object, without those of patches.
#[derive(Default, Deserialize)]
#[serde(default)]
struct PictureInput {
    style: StyleInput,
    light: Option<[f64; 3]>,
    curvature: CurvatureInput,
    limit: Option<f64>,
    width: Option<usize>,
    extent: Option<[f64; 4]>,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
enum StyleInput {
    #[default]
    Shaded,
    Curvature,
    Patches,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
enum CurvatureInput {
    #[default]
    Gaussian,
    Kappa2,
}

/// Draws the picture of a surface that the options ask for.
fn drawn(field: JsValue, options: JsValue) -> Result<Picture> {
    let mut reader = OptionReader::new(&options)?;
    let patching: PatchOptions = reader.read()?;
    let PictureInput {
        style,
        light,
        curvature,
        limit,
        width,
        extent,
    } = reader.read()?;
    let spacing = spacing_of(reader)?;
    let mut wanted = PictureOptions::default();
    wanted.width = width;
    wanted.extent = extent.map(extent_from).transpose()?;
    let style = match style {
        StyleInput::Shaded => light.map_or(Style::shaded(), |light| Style::Shaded { light }),
        StyleInput::Curvature => Style::Curvature {
            kind: match curvature {
                CurvatureInput::Gaussian => Curvature::Gaussian,
                CurvatureInput::Kappa2 => Curvature::Kappa2,
            },
            limit,
        },
        StyleInput::Patches => Style::Patches(patching),
    };
    let image = is_image(&field)?;
    check_spacing(spacing, image)?;
    let scene = Scene::new(field, spacing)?;
    if image && wanted.extent.is_none() {
        wanted = wanted.extent(scene.extent);
    }
    Ok(Picture::new(&scene.surface, &wanted.style(style))?)
}

fn image_data(picture: &Picture) -> Result<ImageData> {
    // An array of its own: an `ImageData` keeps what it is given, and wasm's memory moves.
    let data = Uint8ClampedArray::from(picture.rgba());
    let [width, height] = [picture.width(), picture.height()].map(|n| n as u32);
    ImageData::new_with_js_u8_clamped_array_and_sh(&data, width, height).map_err(refused)
}

/// A canvas with its 2D context: an element of a web page, or an offscreen one.
enum Canvas {
    Element(HtmlCanvasElement, CanvasRenderingContext2d),
    Offscreen(OffscreenCanvas, OffscreenCanvasRenderingContext2d),
}

impl Canvas {
    fn new(canvas: JsValue) -> Result<Self> {
        let canvas = match canvas.dyn_into::<HtmlCanvasElement>() {
            Ok(canvas) => {
                let context = context(canvas.get_context("2d"))?;
                return Ok(Canvas::Element(canvas, context));
            }
            Err(other) => other,
        };
        match canvas.dyn_into::<OffscreenCanvas>() {
            Ok(canvas) => {
                let context = context(canvas.get_context("2d"))?;
                Ok(Canvas::Offscreen(canvas, context))
            }
            Err(_) => Err(input(
                "the canvas must be an HTMLCanvasElement or an OffscreenCanvas".into(),
            )),
        }
    }

    fn put(&self, picture: &Picture) -> Result<()> {
        let image = image_data(picture)?;
        let [width, height] = [image.width(), image.height()];
        match self {
            Canvas::Element(canvas, context) => {
                canvas.set_width(width);
                canvas.set_height(height);
                context.put_image_data(&image, 0.0, 0.0)
            }
            Canvas::Offscreen(canvas, context) => {
                canvas.set_width(width);
                canvas.set_height(height);
                context.put_image_data(&image, 0.0, 0.0)
            }
        }
        .map_err(refused)
    }
}

/// Returns the 2D context of a canvas, or an error if there is none: a canvas has contexts of one kind only, and none
/// once control was transferred to a worker.
fn context<T: JsCast>(found: std::result::Result<Option<Object>, JsValue>) -> Result<T> {
    (found.ok().flatten())
        .and_then(|context| context.dyn_into().ok())
        .ok_or_else(|| {
            input(
                "the canvas has no 2d context: it has one of another kind, or was handed over"
                    .into(),
            )
        })
}

/// Makes an error of an exception that the browser threw when a picture was to be shown.
fn refused(error: JsValue) -> Failure {
    let message = error.dyn_ref::<js_sys::Error>().map(js_sys::Error::message);
    let message = message.map_or_else(|| format!("{error:?}"), String::from);
    input(format!("the picture cannot be shown: {message}"))
}

fn input(message: String) -> Failure {
    Failure {
        code: "INPUT",
        message,
    }
}
