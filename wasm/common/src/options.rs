//! Options of a call, read from a JavaScript object into the structures of the library.

use js_sys::{Array, JsString, Object, Reflect};
use serde::de::value::Error as NoValue;
use serde::de::{DeserializeOwned, Deserializer, Error as _, Visitor};
use serde::forward_to_deserialize_any;
use serde_wasm_bindgen::from_value;
use wasm_bindgen::prelude::*;

use super::{Failure, Result};
use developable::Error;

/// Options of a call as JavaScript passes them, which can be read into several structures; each takes the options that
/// its fields are named after. JavaScript has checked ranges and types before, in `pkg/schema/`.
pub struct Given {
    options: Object,
    /// Names of the options that have been read.
    known: Vec<&'static str>,
}

impl Given {
    pub fn new(options: &JsValue) -> Result<Self> {
        let options = match options.is_undefined() {
            true => Some(Object::new()),
            false => options.dyn_ref().cloned(),
        };
        let known = Vec::new();
        match options {
            Some(options) => Ok(Given { options, known }),
            None => Err(Failure::option("the options must be an object")),
        }
    }

    /// Reads a structure from the options; fields for options that are not given have their defaults.
    pub fn read<T: DeserializeOwned>(&mut self) -> Result<T> {
        let mut names: &[&str] = &[];
        // Always fails, which is not an error: it is called for the field names alone.
        let _ = T::deserialize(FieldNames(&mut names));
        self.known.extend(names);
        Ok(from_value(self.options.clone().into())?)
    }

    /// Returns the value of one option; `undefined` if it is not given.
    pub fn value(&mut self, name: &'static str) -> JsValue {
        self.known.push(name);
        // Cannot fail: `options.js` has made the object, without getters.
        Reflect::get(&self.options, &name.into()).unwrap_or_default()
    }

    /// Returns the value of an option that is a number; `None` if it is not given.
    pub fn number(&mut self, name: &'static str) -> Option<f64> {
        self.value(name).as_f64()
    }

    /// Returns the value of an option that is true or false; `None` if it is not given.
    pub fn flag(&mut self, name: &'static str) -> Option<bool> {
        self.value(name).as_bool()
    }

    /// Returns an error if an option was given that nothing has read.
    pub fn finish(self) -> Result<()> {
        let names = Object::keys(&self.options);
        let mut names = names.iter().map(|name| String::from(JsString::from(name)));
        match names.find(|name| !self.known.contains(&name.as_str())) {
            Some(name) => Err(unknown(&name, &self.known.join(", "))),
            None => Ok(()),
        }
    }
}

/// Reads all options of a call into one structure; an option that is not one of its fields is an error.
pub fn read<T: DeserializeOwned>(options: &JsValue) -> Result<T> {
    let mut given = Given::new(options)?;
    let found = given.read()?;
    given.finish()?;
    Ok(found)
}

/// Serde deserialiser that records the field names of a structure and yields no values.
struct FieldNames<'a>(&'a mut &'static [&'static str]);

impl<'de> Deserializer<'de> for FieldNames<'_> {
    type Error = NoValue;

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        _: V,
    ) -> std::result::Result<V::Value, NoValue> {
        *self.0 = fields;
        Err(NoValue::custom(""))
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> std::result::Result<V::Value, NoValue> {
        Err(NoValue::custom(""))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 u8 u16 u32 u64 f32 f64 char str string bytes byte_buf option unit unit_struct newtype_struct seq
        tuple tuple_struct map enum identifier ignored_any
    }
}

/// Lists the names and values of an options object, without those that are `undefined`. For options whose values need
/// checks of their own.
pub fn entries(options: &JsValue) -> Result<Vec<(String, JsValue)>> {
    let Given { options, .. } = Given::new(options)?;
    Ok(Object::entries(&options)
        .iter()
        .map(|entry| Array::from(&entry))
        .filter(|entry| !entry.get(1).is_undefined())
        .map(|entry| (String::from(JsString::from(entry.get(0))), entry.get(1)))
        .collect())
}

/// Reads the value of the option `name` into a type that says what is allowed; the error for another value states the
/// `requirement`.
pub fn option<T: DeserializeOwned>(
    name: &'static str,
    value: JsValue,
    requirement: &'static str,
) -> Result<T> {
    from_value(value.clone()).map_err(|_| {
        // JSON has no infinity and no NaN. For `undefined`, functions and symbols, `stringify` returns no string.
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

/// Renames the option in an error from its name in Rust to its name in JavaScript, where these differ.
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
