//! The library as JavaScript sees it, behind `pkg/direct.js`: plain objects and
//! typed arrays in and out, errors with a `code`. Nothing is computed here.
//!
//! This crate has what the other crates in `wasm/` share; each of those becomes one wasm file.

pub mod arrays;
pub mod bytes;
pub mod camera;
pub mod fields;
pub mod file;
pub mod flat;
pub mod frame;
pub mod mesh;
pub mod options;
pub mod photo;
pub mod scene;
pub mod triangulation;

use developable::Error;
use js_sys::{Function, Reflect};
use wasm_bindgen::prelude::*;

/// Result of every function that is exported to JavaScript: a value, or an error that JavaScript throws.
pub type Result<T> = std::result::Result<T, Failure>;

/// Makes every panic a JavaScript exception with the panic's message. The caller must discard the wasm instance after
/// one.
#[wasm_bindgen(js_name = reportPanics)]
pub fn report_panics() {
    std::panic::set_hook(Box::new(|panic| {
        wasm_bindgen::throw_str(&panic.to_string())
    }));
}

/// Sets the function that is called with the fraction of a call's work that is done, from 0 to 1; undefined for none. What it
/// throws is left to it.
#[wasm_bindgen]
pub fn watch(listener: Option<Function>) {
    developable::progress::listen(listener.map(|listener| -> developable::progress::Listener {
        Box::new(move |fraction| {
            let _ = listener.call1(&JsValue::NULL, &fraction.into());
        })
    }));
}

/// An error that is thrown in JavaScript as an `Error` with a `code`.
pub struct Failure {
    /// Code of the error: one of `ErrorCode` in `errors.d.ts`.
    pub code: &'static str,
    /// Message of the error: what is wrong, where, and what to do.
    pub message: String,
}

impl Failure {
    /// Makes an error about an option that has a wrong value or an unknown name.
    pub fn option(message: impl Into<String>) -> Self {
        Failure {
            code: "OPTION",
            message: message.into(),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = error.code();
        let message = match error {
            Error::Option {
                name,
                value,
                requirement,
            } => {
                format!("option `{}` is {value}, but {requirement}", in_js(name))
            }
            other => other.to_string(),
        };
        Failure { code, message }
    }
}

/// Converts an option's Rust name to the way JavaScript writes it: `max_iterations` becomes `maxIterations`.
fn in_js(name: &str) -> String {
    let mut after_underscore = false;
    let mut js = String::with_capacity(name.len());
    for letter in name.chars() {
        if letter != '_' {
            // ASCII only: the tables of Unicode would add 10 kB to each wasm file.
            js.push(if after_underscore {
                letter.to_ascii_uppercase()
            } else {
                letter
            });
        }
        after_underscore = letter == '_';
    }
    js
}

/// An object of the wrong shape, which the checks in JavaScript should have refused.
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
