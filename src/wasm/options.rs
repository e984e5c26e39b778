//! Options from plain JS objects, with errors that name the option. (Derived
//! deserialisers would pass over unknown names and not say which value is wrong.)

use js_sys::{Array, JsString, Object};
use serde::de::DeserializeOwned;
use serde_wasm_bindgen::from_value;
use wasm_bindgen::prelude::*;

use super::{Failure, Result};
use crate::error::Error;
use crate::solver::{Lambda, Normalization, Options, Schedule};

/// `SolverOptions` of `types.d.ts`; the lattice spacing is none of the solver's.
pub(super) fn solver_options(options: &JsValue) -> Result<(Options, Option<f64>)> {
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
pub(super) fn entries(options: &JsValue) -> Result<Vec<(String, JsValue)>> {
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

pub(super) fn option<T: DeserializeOwned>(
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

pub(super) fn unknown(name: &str, known: &str) -> Failure {
    Failure::option(format!("there is no option `{name}`, only {known}"))
}
