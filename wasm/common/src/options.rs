//! Options from plain JS objects, with errors that name the option. (Derived
//! deserialisers would pass over unknown names and not say which value is wrong.)

use js_sys::{Array, JsString, Object};
use serde::de::DeserializeOwned;
use serde_wasm_bindgen::from_value;
use wasm_bindgen::prelude::*;

use super::{Failure, Result};
use developable::{Error, Lambda};

/// What an options object says, without what is undefined in it.
pub fn entries(options: &JsValue) -> Result<Vec<(String, JsValue)>> {
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
        .map(|entry| (String::from(JsString::from(entry.get(0))), entry.get(1)))
        .collect())
}

pub fn option<T: DeserializeOwned>(
    name: &'static str,
    value: JsValue,
    requirement: &'static str,
) -> Result<T> {
    from_value(value.clone()).map_err(|_| {
        // JSON has no infinity and no NaN; and of `undefined`, functions and symbols there is none: then this is no string.
        if let Some(number) = value.as_f64() {
            return Failure::from(Error::option(name, number, requirement));
        }
        let json = js_sys::JSON::stringify(&value);
        let shown = json.ok().and_then(|text| JsValue::from(text).as_string());
        Failure::from(Error::option(
            name,
            shown.unwrap_or_else(|| format!("{value:?}")),
            requirement,
        ))
    })
}

/// A number, or the name of one.
pub fn lambda(value: JsValue) -> Result<Lambda> {
    const REQUIREMENT: &str = "must be small, medium, big, auto or a number above zero";
    if let Some(number) = value.as_f64() {
        return Ok(Lambda::Value(number));
    }
    let name: String = option("lambda", value, REQUIREMENT)?;
    Lambda::named(&name)
        .ok_or_else(|| Error::option("lambda", format!("{name:?}"), REQUIREMENT).into())
}

/// The error of a Rust option as one of the JS option that it stands for, where that has another name.
pub fn renamed(mut error: Error, rust: &str, js: &'static str) -> Failure {
    if let Error::Option { name, .. } = &mut error
        && *name == rust
    {
        *name = js;
    }
    error.into()
}

pub fn unknown(name: &str, known: &str) -> Failure {
    Failure::option(format!("there is no option `{name}`, only {known}"))
}
