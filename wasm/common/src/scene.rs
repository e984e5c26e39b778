//! The surface that a call gets from JavaScript, as a height image or a heightfield, and the part of the plane it
//! covers.

use serde::Deserialize;
use serde_wasm_bindgen::from_value;
use wasm_bindgen::prelude::*;

use super::Result;
use super::fields::{ImageInput, LatticeInput};
use developable::Error;
use developable::Heightfield;
use developable::dewarp::Extent;

/// A surface as a heightfield, and the part of the plane that a photo of it shows.
pub struct Scene {
    pub surface: Heightfield,
    /// Rectangle of the plane that a photo of the surface shows unless the caller says otherwise: that of the height
    /// image, or of the vertices.
    pub extent: Extent,
}

/// The field by which `input.js` tells a height image from a heightfield.
#[derive(Deserialize)]
struct Kind {
    kind: String,
}

/// The option that the calls about surfaces share.
#[derive(Default, Deserialize)]
#[serde(default)]
pub struct SpacingInput {
    /// Spacing of the lattice that a height image is resampled to; `None`: its pixel size.
    pub spacing: Option<f64>,
}

/// Whether a JavaScript field is a height image, for which the option `spacing` is allowed; otherwise it is a
/// heightfield or `undefined`.
pub fn is_image(field: &JsValue) -> Result<bool> {
    Ok(!field.is_undefined() && from_value::<Kind>(field.clone())?.kind == "image")
}

/// Returns an error if a lattice spacing is given for a heightfield, whose lattice has its own. `images` says whether
/// an input is a height image.
pub fn check_spacing(spacing: Option<f64>, images: bool) -> Result<()> {
    match spacing {
        Some(spacing) if !images => {
            let requirement = "must be left out: a lattice has the spacing of its input";
            Err(Error::option("spacing", spacing, requirement).into())
        }
        _ => Ok(()),
    }
}

impl Scene {
    pub fn new(field: JsValue, spacing: Option<f64>) -> Result<Self> {
        if is_image(&field)? {
            let input: ImageInput = from_value(field)?;
            let image = input.heights("height image", &input.data)?;
            return Ok(Scene {
                surface: image.to_lattice(spacing)?,
                extent: Extent::from_image(&image),
            });
        }
        let input: LatticeInput = from_value(field)?;
        let surface = input.heights("heightfield", &input.heights)?;
        Ok(Scene {
            extent: Extent::from_heightfield(&surface),
            surface,
        })
    }
}
