//! Writes photos as PDF: one page for each picture.

use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, TextStr};

use super::page_words::{BookWord, Characters, FONT_RESOURCE, write_words};
use super::picture_data::{Compression, PictureData};
use super::print::{PhotoOptions, PhotoRows, is_bilevel, write_photo, write_photo_jpeg};
use crate::error::{Error, Result};
use crate::files::points::{check_page, points};

/// Number of objects of the PDF format for each page: the page, its content and its picture.
const OBJECTS_PER_PAGE: i32 = 3;

/// One page of a PDF file, with a picture that is as large as fits, in the middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BookPage<'a> {
    /// JPEG or PNG file of the picture, as [`write_photo_jpeg`] and [`write_photo`] write it. It goes into the PDF as it
    /// is, without loss, and on white where it is transparent.
    pub picture: &'a [u8],
    /// Width and height of the page, in millimetres.
    pub size: [f64; 2],
    /// Words in the picture, in the order in which they are read. They lie over it as text that is not seen, so that
    /// the page can be searched and copied from.
    pub words: &'a [BookWord<'a>],
}

/// Writes a photo as a PDF file of one page, which the photo fills as a JPEG, or without loss if all its pixels are
/// black or white; the page has the size of the surface in the photo, and the document the title that is given. Print it at 100 %.
///
/// # Errors
/// The errors of [`write_photo_jpeg`]; [`Error::Option`] without a resolution, [`Error::Unsupported`] if a
/// side is below 2 mm or above 5.08 m, the format's limit.
pub fn write_photo_pdf(
    photo: &impl PhotoRows,
    options: &PhotoOptions,
    title: Option<&str>,
) -> Result<Vec<u8>> {
    let Some(dots) = options.dots()? else {
        let requirement = "must be known for a PDF, whose pages are in true size";
        return Err(Error::option(
            "dots_per_millimetre",
            "not given",
            requirement,
        ));
    };
    let size = photo.size().map(|pixels| pixels as f64 / dots);
    check_page(size)?;
    let picture = match is_bilevel(photo)? {
        true => write_photo(photo, options)?,
        false => write_photo_jpeg(photo, options)?,
    };
    let page = BookPage {
        picture: &picture,
        size,
        words: &[],
    };
    write_book(&[page], title)
}

/// Writes a PDF file with one page for each picture, in their order, and with the title that is given.
///
/// # Errors
/// [`Error::Empty`] without pages; [`Error::Unsupported`] if a side of a page is below 2 mm or above 5.08 m, the
/// format's limit, for pictures that are neither JPEG nor PNG, and for words outside of their
/// picture; [`Error::Format`] for a damaged picture; [`Error::TooLarge`] if words have more than 65 535 different
/// characters.
pub fn write_book(pages: &[BookPage<'_>], title: Option<&str>) -> Result<Vec<u8>> {
    if pages.is_empty() {
        return Err(Error::Empty { what: "book" });
    }
    let [catalog, tree] = [1, 2].map(Ref::new);
    let first = |number: usize| 3 + OBJECTS_PER_PAGE * number as i32;
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(tree);
    let [info, font] = [0, 1].map(|k| Ref::new(first(pages.len()) + k));
    let characters = Characters::new(pages.iter().flat_map(|page| page.words))?;
    if !characters.is_empty() {
        characters.write_font(&mut pdf, font);
    }
    if let Some(title) = title {
        pdf.document_info(info).title(TextStr(title));
    }
    pdf.pages(tree)
        .kids((0..pages.len()).map(|number| Ref::new(first(number))))
        .count(pages.len() as i32);
    for (number, page) in pages.iter().enumerate() {
        check_page(page.size)?;
        let picture = PictureData::new(page.picture)?;
        let [object, content, image] = [0, 1, 2].map(|k| Ref::new(first(number) + k));
        let name = Name(b"I");
        let [width, height] = page.size;
        let mut entry = pdf.page(object);
        entry
            .parent(tree)
            .media_box(Rect::new(0.0, 0.0, points(width), points(height)))
            .contents(content);
        let mut resources = entry.resources();
        resources.x_objects().pair(name, image);
        if !page.words.is_empty() && !characters.is_empty() {
            resources.fonts().pair(FONT_RESOURCE, font);
        }
        resources.finish();
        entry.finish();
        let [wide, tall] = picture.size.map(f64::from);
        let scale = (width / wide).min(height / tall);
        let [x, y] = [width - scale * wide, height - scale * tall].map(|rest| points(0.5 * rest));
        let mut drawn = Content::new();
        drawn.save_state();
        drawn.transform([points(scale * wide), 0.0, 0.0, points(scale * tall), x, y]);
        drawn.x_object(name).restore_state();
        if !page.words.is_empty() {
            let to_page = |[column, row]: [f64; 2]| {
                [x + points(scale * column), y + points(scale * (tall - row))]
            };
            let words = (number + 1, page.words);
            write_words(&mut drawn, words, &characters, [wide, tall], to_page)?;
        }
        pdf.stream(content, &drawn.finish());
        write_picture(&mut pdf, image, &picture);
    }
    Ok(pdf.finish())
}

/// Writes a picture as an object of a PDF file.
fn write_picture(pdf: &mut Pdf, place: Ref, picture: &PictureData<'_>) {
    let mut object = pdf.image_xobject(place, &picture.data);
    let [width, height] = picture.size.map(|side| side as i32);
    object.width(width).height(height);
    object.bits_per_component(picture.bits.into());
    match picture.channels {
        1 => object.color_space().device_gray(),
        _ => object.color_space().device_rgb(),
    }
    match picture.compression {
        Compression::Jpeg => {
            object.filter(Filter::DctDecode);
        }
        Compression::Png => {
            object.filter(Filter::FlateDecode);
            object
                .decode_parms()
                .predictor(pdf_writer::types::Predictor::PngOptimum)
                .colors(picture.channels.into())
                .bits_per_component(picture.bits.into())
                .columns(width);
        }
    }
    object.finish();
}
