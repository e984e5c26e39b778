//! The library as JavaScript sees it, behind `pkg/direct.js`: plain objects and
//! typed arrays in and out, errors with a `code`. Nothing is computed here.

#[cfg(any(feature = "js-files", feature = "meshes"))]
mod arrays;
#[cfg(any(
    feature = "js-files",
    feature = "js-images",
    feature = "js-unroll",
    feature = "meshes"
))]
mod bytes;
#[cfg(feature = "meshes")]
mod camera;
#[cfg(feature = "js-solver")]
mod examples;
#[cfg(any(
    feature = "js-files",
    feature = "js-images",
    feature = "js-patterns",
    feature = "js-solver",
    feature = "js-unroll",
    feature = "meshes"
))]
mod fields;
#[cfg(any(feature = "js-files", feature = "js-images"))]
mod file;
#[cfg(feature = "js-files")]
mod files;
#[cfg(any(feature = "js-files", feature = "meshes"))]
mod frame;
#[cfg(feature = "js-images")]
mod images;
#[cfg(feature = "meshes")]
mod meshes;
#[cfg(feature = "js-solver")]
mod occlusions;
mod options;
#[cfg(feature = "js-patterns")]
mod patterns;
#[cfg(any(feature = "js-files", feature = "js-unroll"))]
mod photo;
#[cfg(feature = "js-solver")]
mod results;
#[cfg(any(feature = "js-patterns", feature = "js-unroll"))]
mod scene;
#[cfg(feature = "js-solver")]
mod settings;
#[cfg(feature = "js-unroll")]
mod sheets;
#[cfg(feature = "js-solver")]
mod solver;
#[cfg(feature = "js-solver")]
mod source;
#[cfg(feature = "meshes")]
mod surfaces;
#[cfg(any(feature = "js-files", feature = "meshes"))]
mod triangulation;

use js_sys::Reflect;
use wasm_bindgen::prelude::*;

use crate::error::Error;

type Result<T> = std::result::Result<T, Failure>;

/// Turns panics into JS exceptions that say what happened. The caller has to
/// give the instance up after one.
#[wasm_bindgen(js_name = reportPanics)]
pub fn report_panics() {
    std::panic::set_hook(Box::new(|panic| {
        wasm_bindgen::throw_str(&panic.to_string())
    }));
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
