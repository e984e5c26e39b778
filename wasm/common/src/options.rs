//! Options of a call, read from a JavaScript object into structures by serde.

use js_sys::{JSON, JsString, Object, Reflect};
use serde::de::value::Error as NoValue;
use serde::de::{DeserializeOwned, Deserializer, Error as _, Visitor};
use serde::forward_to_deserialize_any;
use serde_wasm_bindgen::from_value;
use wasm_bindgen::prelude::*;

use super::{Failure, Result};
use developable::Error;
use developable::checks::Readable;

/// Reader of a call's options, which several structures take; each takes the options that its fields are named after.
/// Every field has a default, for an option that is not given. JavaScript has checked types before, in `pkg/schema/`.
pub struct OptionReader {
    options: Object,
    /// Names of the options that a structure has taken.
    known: Vec<&'static str>,
}

impl OptionReader {
    pub fn new(options: &JsValue) -> Result<Self> {
        let options = match options.is_undefined() {
            true => Some(Object::new()),
            false => options.dyn_ref().cloned(),
        };
        let known = Vec::new();
        match options {
            Some(options) => Ok(OptionReader { options, known }),
            None => Err(Failure::option("the options must be an object")),
        }
    }

    /// Reads a structure from the options that its fields are named after.
    pub fn read<T: DeserializeOwned>(&mut self) -> Result<T> {
        let mut names: &[&str] = &[];
        // Always fails, which is not an error: it is called for the field names alone.
        let _ = T::deserialize(FieldNames(&mut names));
        self.known.extend(names);
        from_value(self.options.clone().into()).map_err(|error| {
            let failure = names.iter().find_map(|name| self.option_failure::<T>(name));
            failure.unwrap_or_else(|| error.into())
        })
    }

    /// Returns the error of an option that the structure cannot be read with; `None` if this one is right.
    fn option_failure<T: DeserializeOwned>(&self, name: &str) -> Option<Failure> {
        // Neither can fail: `pkg/options.js` has made the object, without getters, and the other one is new.
        let value = Reflect::get(&self.options, &name.into()).ok()?;
        if value.is_undefined() {
            return None;
        }
        let alone = Object::new();
        Reflect::set(&alone, &name.into(), &value).ok()?;
        let error = from_value::<T>(alone.into()).err()?.to_string();
        let requirement = match error.split_once("expected ") {
            Some((_, "f64")) => "must be a number".into(),
            Some((_, "usize" | "u32" | "u8")) => "must be a whole number".into(),
            Some((_, what)) => format!("must be {what}"),
            None => format!("cannot be read: {error}"),
        };
        Some(Failure::option(format!(
            "option `{name}` is {}, but {requirement}",
            shown(&value)
        )))
    }

    /// Returns an error if an option was given that no structure has taken.
    pub fn finish(self) -> Result<()> {
        let names = Object::keys(&self.options);
        let mut names = names.iter().map(|name| String::from(JsString::from(name)));
        match names.find(|name| !self.known.contains(&name.as_str())) {
            Some(name) => Err(Failure::option(format!(
                "there is no option `{name}`, only {}",
                self.known.join(", ")
            ))),
            None => Ok(()),
        }
    }
}

/// Reads all options of a call into one structure; an option that is not one of its fields is an error.
pub fn read<T: DeserializeOwned>(options: &JsValue) -> Result<T> {
    let mut reader = OptionReader::new(options)?;
    let found = reader.read()?;
    reader.finish()?;
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

/// Returns a value as messages show it.
fn shown(value: &JsValue) -> String {
    // JSON has no infinity and no NaN. For `undefined`, functions and symbols, `stringify` returns no string.
    if let Some(number) = value.as_f64() {
        return number.readable();
    }
    let json = JSON::stringify(value).ok().map(JsValue::from);
    json.and_then(|text| text.as_string())
        .unwrap_or_else(|| format!("{value:?}"))
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
