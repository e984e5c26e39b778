//! Reading and writing of PNG, NPY, OBJ and photo files, and colours of vertices from photos.

use js_sys::{Float32Array, Float64Array, Int32Array, Uint8Array};
use serde::Deserialize;
use serde_wasm_bindgen::{from_value, preserve};
use wasm_bindgen::prelude::*;

use developable::Error;
use developable::checks::{check_count, check_photo};
use developable::dewarp::{self, Extent};
use developable::files::images::{
    BookPage, BookWord, PhotoOptions, PhotoRows, decode_basic, decode_photo_basic, format_name,
    write_basic, write_book, write_photo, write_photo_jpeg, write_photo_pdf,
};
use developable::files::wavefront::{write_mtl, write_obj};
use developable_wasm::Result;
use developable_wasm::arrays::filled;
use developable_wasm::bytes::copied;
use developable_wasm::fields::LatticeInput;
use developable_wasm::file::{ReadOptions, output, photo_output, written};
use developable_wasm::options::read as read_options;
use developable_wasm::photo::{Pixels, extent_from};
use developable_wasm::triangulation::mesh_of;

/// Decodes a PNG or NPY file of heights; returns JavaScript's `ReadResult` object.
#[wasm_bindgen]
pub fn read(bytes: &Uint8Array, options: JsValue) -> Result<JsValue> {
    let options: ReadOptions = read_options(&options)?;
    let file = copied(bytes)?;
    output(decode_basic(&file, options.format()?, &options.decoding())?)
}

/// Detects the format of a file by its first bytes; returns its name, or `undefined` for an unknown one.
#[wasm_bindgen(js_name = formatOf)]
pub fn format_of(bytes: &Uint8Array) -> Result<Option<String>> {
    Ok(format_name(&copied(bytes)?).map(String::from))
}

/// Writes heights to a PNG or NPY file.
#[wasm_bindgen(js_name = writeImage)]
pub fn write_image(image: JsValue, format: &str) -> Result<Uint8Array> {
    written(from_value(image)?, format, write_basic)
}

/// Options of writing an OBJ file: JavaScript's `WriteObjOptions` object.
#[derive(Default, Deserialize)]
#[serde(default)]
struct ObjInput {
    /// Name of the material file that the OBJ file refers to.
    materials: Option<String>,
}

/// Writes a heightfield or mesh to an OBJ file, in the axes of its frame.
#[wasm_bindgen(js_name = writeObj)]
pub fn write_obj_file(field: JsValue, options: JsValue) -> Result<Uint8Array> {
    let ObjInput { materials } = read_options(&options)?;
    let file = write_obj(&mesh_of(field)?, materials.as_deref())?;
    Ok(file.as_slice().into())
}

/// Writes an MTL file of one material whose texture is the file with the name `picture`.
#[wasm_bindgen(js_name = writeMtl)]
pub fn write_mtl_file(picture: &str) -> Result<Uint8Array> {
    Ok(write_mtl(picture)?.as_slice().into())
}

/// Decodes a PNG or JPEG file to a photo; returns JavaScript's `Photo` object.
#[wasm_bindgen(js_name = readPhoto)]
pub fn read_photo(bytes: &Uint8Array) -> Result<JsValue> {
    let file = copied(bytes)?;
    photo_output(&decode_photo_basic(&file)?)
}

/// Computes texture coordinates of a lattice's vertices in a photo that shows a rectangle of the plane: `extent` has
/// its left, bottom, right and top side; `undefined` stands for the rectangle that the vertices cover.
#[wasm_bindgen(js_name = planeUvs)]
pub fn plane_uvs(field: JsValue, extent: JsValue) -> Result<Float32Array> {
    let field = from_value::<LatticeInput>(field)?.into_heightfield()?;
    let extent = match from_value(extent)? {
        None => Extent::from_heightfield(&field),
        Some(sides) => extent_from(sides)?,
    };
    let uvs = extent.uvs(field.lattice())?;
    Ok(uvs.as_flattened().into())
}

/// Colours vertices from one photo by their texture coordinates: those whose entry of `texture_of` is `number`, or all
/// if there are no such entries. Returns the colours of all vertices.
#[wasm_bindgen]
pub fn paint(
    colors: &Float32Array,
    uvs: &Float32Array,
    photo: JsValue,
    texture_of: Option<Int32Array>,
    number: i32,
) -> Result<Float32Array> {
    let pixels = Pixels::new(photo)?;
    let photo = pixels.photo()?;
    let mut painted = filled(colors.length(), 0.0f32)?;
    colors.copy_to(painted.as_flattened_mut());
    let mut places = filled(uvs.length(), 0.0f32)?;
    uvs.copy_to(places.as_flattened_mut());
    check_count("texture coordinates", painted.len(), 1, places.len())?;
    let numbers = texture_of.map(|numbers| numbers.to_vec());
    let wanted = |i: usize| numbers.as_ref().is_none_or(|n| n.get(i) == Some(&number));
    dewarp::paint(&mut painted, &places, &photo, wanted);
    Ok(painted.as_flattened().into())
}

/// Photo in JavaScript's memory, which is copied row by row while it is written to a file, since there may not be
/// memory for two.
struct Rows<'a> {
    size: [usize; 2],
    rgba: &'a Uint8Array,
}

impl PhotoRows for Rows<'_> {
    fn size(&self) -> [usize; 2] {
        self.size
    }

    fn read(&self, row: usize, line: &mut [u8]) {
        let length = line.len() as u32;
        let start = row as u32 * length;
        self.rgba.subarray(start, start + length).copy_to(line);
    }
}

/// Options of writing a photo: JavaScript's `WritePhotoOptions` object.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct WritePhotoInput {
    format: PhotoFormat,
    quality: Option<u8>,
    dots_per_millimetre: Option<f64>,
    title: Option<String>,
}

/// Kind of a file that a photo is written to.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
enum PhotoFormat {
    #[default]
    Png,
    Jpeg,
    Pdf,
}

/// Writes a photo to a PNG, JPEG or PDF file, as the option `format` says.
#[wasm_bindgen(js_name = writePhoto)]
pub fn write_photo_file(
    width: usize,
    height: usize,
    rgba: &Uint8Array,
    options: JsValue,
) -> Result<Uint8Array> {
    let input: WritePhotoInput = read_options(&options)?;
    let mut wanted = PhotoOptions::default();
    wanted.quality = input.quality.unwrap_or(wanted.quality);
    wanted.dots_per_millimetre = input.dots_per_millimetre;
    // Checks that the photo has the right number of bytes, and at least one.
    check_photo("photo", height, width, rgba.length() as usize / 4)?;
    if width == 0 || height == 0 {
        return Err(Error::Empty { what: "photo" }.into());
    }
    let size = [width, height];
    let photo = Rows { size, rgba };
    let file = match input.format {
        PhotoFormat::Png => write_photo(&photo, &wanted)?,
        PhotoFormat::Jpeg => write_photo_jpeg(&photo, &wanted)?,
        PhotoFormat::Pdf => write_photo_pdf(&photo, &wanted, input.title.as_deref())?,
    };
    Ok(file.as_slice().into())
}

/// One page of a PDF file, as `writeBook` in `pkg/direct.js` passes it.
#[derive(Deserialize)]
struct BookPageInput {
    #[serde(with = "preserve")]
    picture: Uint8Array,
    size: [f64; 2],
    /// Texts of the words in the picture.
    texts: Vec<String>,
    /// Boxes of these words, four numbers each.
    #[serde(with = "preserve")]
    boxes: Float64Array,
}

/// Options of `writeBook`.
#[derive(Deserialize)]
struct WriteBookInput {
    title: Option<String>,
}

/// Writes a PDF file with one page for each JPEG or PNG file.
#[wasm_bindgen(js_name = writeBook)]
pub fn write_book_file(pages: JsValue, options: JsValue) -> Result<Uint8Array> {
    let WriteBookInput { title } = read_options(&options)?;
    let given: Vec<BookPageInput> = from_value(pages)?;
    let mut pictures = Vec::new();
    for page in &given {
        pictures.push(copied(&page.picture)?);
    }
    let words: Vec<Vec<BookWord<'_>>> = (given.iter())
        .map(|BookPageInput { texts, boxes, .. }| {
            let boxes = boxes.to_vec();
            (texts.iter().zip(boxes.as_chunks().0))
                .map(|(text, &bounds)| BookWord { text, bounds })
                .collect()
        })
        .collect();
    let pages: Vec<BookPage<'_>> = (pictures.iter().zip(&given).zip(&words))
        .map(|((picture, BookPageInput { size, .. }), words)| BookPage {
            picture,
            size: *size,
            words,
        })
        .collect();
    Ok(write_book(&pages, title.as_deref())?.as_slice().into())
}
