//! Heightfields from files, so that native code and wasm get the same bits.

use std::error::Error;

use developable::Heightfield;
use developable::files::images;

use crate::task::{Input, Lattice};

pub fn read(input: &Input) -> Result<Heightfield, Box<dyn Error>> {
    let file = images::decode(&std::fs::read(&input.file)?, None)?;
    let (rows, cols) = (file.height, file.width);
    let keep: Vec<u8> = file
        .values
        .iter()
        .map(|value| u8::from(Some(*value) != input.no_data))
        .collect();
    let image = file.into_image()?.masked(&keep)?;
    Ok(match input.lattice {
        Lattice::Square => image.with_pixel_size(input.spacing)?.to_lattice(None)?,
        Lattice::Hex => Heightfield::new(
            developable::Lattice::new(rows, cols, input.spacing)?,
            image.values().to_vec(),
        )?,
    })
}
