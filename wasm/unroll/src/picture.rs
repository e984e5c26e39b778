//! Surfaces as pictures, and pictures on a canvas.

use js_sys::{Object, Reflect, Uint8ClampedArray, global};
use wasm_bindgen::prelude::*;
use web_sys::{
    CanvasRenderingContext2d, HtmlCanvasElement, ImageData, OffscreenCanvas,
    OffscreenCanvasRenderingContext2d,
};

use developable::patches::PatchOptions;
use developable::picture::{Curvature, Picture, PictureOptions, Style};
use developable_wasm::options::{entries, option, unknown};
use developable_wasm::photo::extent_from;
use developable_wasm::scene::{Scene, check_spacing, is_image};
use developable_wasm::{Failure, Result};

/// A surface as pixels: an `ImageData` where there are such, else a plain object that says the same.
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

/// The same on a canvas, which becomes as large as the picture.
#[wasm_bindgen]
pub fn draw(canvas: JsValue, field: JsValue, options: JsValue) -> Result<()> {
    let canvas = Canvas::new(canvas)?;
    canvas.put(&drawn(field, options)?)
}

/// The picture that the options of `types.d.ts` ask for.
fn drawn(field: JsValue, options: JsValue) -> Result<Picture> {
    let (mut style, mut light, mut kind, mut limit) = (String::from("shaded"), None, None, None);
    let (mut wanted, mut patching) = (PictureOptions::default(), PatchOptions::default());
    let (mut spacing, number) = (None, "must be a number");
    for (name, value) in entries(&options)? {
        match name.as_str() {
            "style" => style = option("style", value, "must be a text")?,
            "light" => light = Some(option("light", value, "must be three numbers")?),
            "curvature" => kind = Some(option::<String>("curvature", value, "must be a text")?),
            "limit" => limit = Some(option("limit", value, number)?),
            "width" => wanted = wanted.width(option("width", value, "must be a whole number")?),
            "extent" => wanted = wanted.extent(extent_from(value)?),
            "bend" => patching = patching.bend(option("bend", value, number)?),
            "fold" => patching = patching.fold(option("fold", value, number)?),
            "smallest" => patching = patching.smallest(option("smallest", value, number)?),
            "spacing" => spacing = Some(option("spacing", value, number)?),
            _ => {
                let known = "style, light, curvature, limit, width, extent, bend, fold, smallest \
                             and spacing";
                return Err(unknown(&name, known));
            }
        }
    }
    let style = match style.as_str() {
        "shaded" => light.map_or(Style::shaded(), |light| Style::Shaded { light }),
        "curvature" => Style::Curvature {
            kind: match kind.as_deref() {
                None | Some("gaussian") => Curvature::Gaussian,
                Some("kappa2") => Curvature::Kappa2,
                Some(_) => return Err(Failure::option("curvature is gaussian or kappa2")),
            },
            limit,
        },
        "patches" => Style::Patches(patching),
        _ => return Err(Failure::option("style is shaded, curvature or patches")),
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

/// A canvas that can be drawn to, of a page or of none.
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

/// A canvas has a context of one kind only, and none once it was handed over.
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

/// What the browser says no to.
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
