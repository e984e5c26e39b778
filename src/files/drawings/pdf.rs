//! Writes drawings as PDF: on one page of the drawing's size, or on pages of paper to be put together.

use pdf_writer::types::LineJoinStyle;
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use super::printed::{PrintedPart, TextureFile};
use super::{BASELINE_DROP, LINE_WIDTH_MM, TEXT_GREY_LEVEL, UNTITLED, layers};
use crate::drawing::{Drawing, Label, Pages, Piece, Stock};
use crate::error::Result;
use crate::files::points::{check_page, points};

/// Length of each arm of a registration mark (a cross by which pages are aligned), in millimetres.
const REGISTRATION_ARM_MM: f64 = 4.0;

/// Name of the font in the list of a PDF page's resources.
const FONT_RESOURCE: Name = Name(b"F");

/// Name of the drawing in the list of a PDF page's resources.
const DRAWING_RESOURCE: Name = Name(b"D");

/// Length of the scale line by which the size of a print is checked, in millimetres.
const SCALE_LINE_MM: f64 = 100.0;

/// Length of the marks at both ends of the scale line, in millimetres.
const SCALE_TICK_MM: f64 = 2.0;

/// Minimum width of a page for a scale line and what is said beside it, in millimetres.
const MIN_SCALED_PAGE_MM: f64 = 150.0;

/// Height of the foot with the scale line: the blank margin of paper at least, and what is added below a drawing on one
/// page of its size, in millimetres.
const FOOT_MM: f64 = 10.0;

/// Height of the scale line above the page's lower edge, in millimetres: text and ticks stay 5 mm from it, which most
/// printers leave blank.
const SCALE_LINE_HEIGHT_MM: f64 = 7.0;

/// The text beside the scale line.
const SCALE_WORDS: &str = "100 mm: print at 100 %";

/// Maximum number of characters of a title on a page.
const MAX_TITLE_LENGTH: usize = 28;

/// Options of writing a drawing as a PDF file.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct PdfOptions<'a> {
    /// Pages on which the drawing is arranged first ([`Drawing::onto`]). Default: its own, or one of its size.
    pub stock: Option<Stock>,
    /// Title of the document, which is also written on each page. Default: "Pattern", and none on the pages.
    pub title: Option<&'a str>,
    /// Textures of the mesh, by their numbers, of which the drawing's sheets show parts. Default: none.
    pub textures: &'a [TextureFile<'a>],
}

impl<'a> PdfOptions<'a> {
    /// Sets the pages on which the drawing is arranged, and returns the options.
    pub fn stock(self, stock: Option<Stock>) -> Self {
        PdfOptions { stock, ..self }
    }

    /// Sets the title, and returns the options.
    pub fn title(self, title: Option<&'a str>) -> Self {
        PdfOptions { title, ..self }
    }

    /// Sets the textures of the mesh, by their numbers, and returns the options.
    pub fn textures(self, textures: &'a [TextureFile<'a>]) -> Self {
        PdfOptions { textures, ..self }
    }
}

/// Writes a drawing as a PDF file in true size: on the drawing's pages, each with its name and with crosses where it
/// overlaps its neighbours, or on one page of the drawing's size with a foot below. Margins and foot have the title and
/// a line of 100 mm. Print it at 100 %.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) for a drawing that is not finite, for a page of more than 5.08 m, the format's
/// limit, and what [`Drawing::onto`] has to say.
pub fn write_pdf(drawing: &Drawing, options: &PdfOptions<'_>) -> Result<Vec<u8>> {
    drawing.check()?;
    let title = options.title.unwrap_or_default();
    let laid = options
        .stock
        .map(|stock| drawing.clone().onto(stock))
        .transpose()?;
    let drawing = laid.as_ref().unwrap_or(drawing);
    // Numbers of the objects: the first pages and their contents come after these.
    let [catalog, tree, font, form, info] = [1, 2, 3, 4, 5].map(Ref::new);
    let page = |i: usize| Ref::new(6 + 2 * i as i32);
    let content = |i: usize| Ref::new(7 + 2 * i as i32);
    let sheets = match &drawing.pages {
        Some(pages) => spread(pages, title)?,
        None => vec![whole(drawing, title)?],
    };
    let count = sheets.len();
    // Textures come after all pages.
    let texture = |i: usize| Ref::new(6 + (2 * count + i) as i32);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(tree);
    pdf.document_info(info)
        .title(TextStr(options.title.unwrap_or(UNTITLED)));
    let ids = (0..count).map(page);
    pdf.pages(tree).kids(ids).count(count as i32);
    pdf.type1_font(font)
        .base_font(Name(b"Helvetica"))
        .encoding_predefined(Name(b"WinAnsiEncoding"));
    let figure = figure(drawing, options.textures.len());
    let mut object = pdf.form_xobject(form, &figure);
    object.bbox(rect([drawing.width, drawing.height]));
    let mut resources = object.resources();
    resources.fonts().pair(FONT_RESOURCE, font);
    let mut pictures = resources.x_objects();
    for i in 0..options.textures.len() {
        pictures.pair(Name(&texture_name(i)), texture(i));
    }
    pictures.finish();
    resources.finish();
    object.finish();
    for (i, TextureFile { jpeg, size }) in options.textures.iter().enumerate() {
        let mut picture = pdf.image_xobject(texture(i), jpeg);
        let [width, height] = size.map(|side| side as i32);
        picture.width(width).height(height).bits_per_component(8);
        picture.color_space().device_rgb();
        picture.filter(Filter::DctDecode);
        picture.finish();
    }
    for (i, (size, marks)) in sheets.into_iter().enumerate() {
        let mut entry = pdf.page(page(i));
        entry
            .parent(tree)
            .media_box(rect(size))
            .contents(content(i));
        let mut resources = entry.resources();
        resources.fonts().pair(FONT_RESOURCE, font);
        resources.x_objects().pair(DRAWING_RESOURCE, form);
        resources.finish();
        entry.finish();
        pdf.stream(content(i), &marks);
    }
    Ok(pdf.finish())
}

/// Width and height of a PDF page in millimetres, and the page's content stream.
type Sheet = ([f64; 2], Vec<u8>);

fn whole(drawing: &Drawing, title: &str) -> Result<Sheet> {
    let mut size = [drawing.width, drawing.height];
    let scaled = drawing.width >= MIN_SCALED_PAGE_MM;
    if scaled {
        size[1] += FOOT_MM;
    }
    check_page(size)?;
    let mut page = Content::new();
    if scaled {
        foot(&mut page, 0.0, title);
        page.transform([1.0, 0.0, 0.0, 1.0, 0.0, points(FOOT_MM)]);
    }
    page.x_object(DRAWING_RESOURCE);
    Ok((size, page.finish().into_vec()))
}

/// Draws the scale line at the lower edge of a page, from `left` in millimetres, and says beside it what it is for.
fn foot(out: &mut Content, left: f64, title: &str) {
    grey(out);
    out.set_line_width(points(LINE_WIDTH_MM));
    let right = left + SCALE_LINE_MM;
    let [low, high] = [-0.5, 0.5].map(|share| SCALE_LINE_HEIGHT_MM + share * SCALE_TICK_MM);
    let line = [left, right].map(|x| [[x, low], [x, high]]);
    for [from, to] in [
        line[0],
        line[1],
        [left, right].map(|x| [x, SCALE_LINE_HEIGHT_MM]),
    ] {
        out.move_to(points(from[0]), points(from[1]));
        out.line_to(points(to[0]), points(to[1])).stroke();
    }
    let title: String = title.chars().take(MAX_TITLE_LENGTH).collect();
    let words = match title.is_empty() {
        true => SCALE_WORDS.into(),
        false => format!("{SCALE_WORDS}  |  {title}"),
    };
    let mut label = Label::note(&words, [0.0, SCALE_LINE_HEIGHT_MM]);
    label.place[0] = right + 2.0 + 0.5 * text_width(&label);
    text(out, &label);
}

fn spread(pages: &Pages, title: &str) -> Result<Vec<Sheet>> {
    check_page(pages.paper)?;
    let [width, height] = pages.part;
    let sheet = |page: &crate::drawing::Page| {
        let [x, y] = page.corner;
        let mut out = Content::new();
        let shift = [pages.blank - x, pages.blank - y];
        out.save_state();
        let [left, low, right, up] = [pages.blank, pages.blank, width, height].map(points);
        out.rect(left, low, right, up).clip_nonzero().end_path();
        out.transform([1.0, 0.0, 0.0, 1.0, points(shift[0]), points(shift[1])]);
        out.x_object(DRAWING_RESOURCE).restore_state();
        grey(&mut out);
        out.set_line_width(points(0.5 * LINE_WIDTH_MM));
        for [mx, my] in &pages.marks {
            let inside = (x..=x + width).contains(mx) && (y..=y + height).contains(my);
            if inside {
                let [mx, my] = [mx + shift[0], my + shift[1]];
                for [dx, dy] in [[REGISTRATION_ARM_MM, 0.0], [0.0, REGISTRATION_ARM_MM]] {
                    out.move_to(points(mx - dx), points(my - dy));
                    out.line_to(points(mx + dx), points(my + dy)).stroke();
                }
            }
        }
        let mut middle = 0.5 * pages.paper[0];
        if pages.blank >= FOOT_MM && pages.paper[0] >= MIN_SCALED_PAGE_MM {
            foot(&mut out, pages.blank, title);
            // At the right end, since the line is where it would be otherwise.
            middle = pages.paper[0] - 1.5 * pages.blank;
        }
        text(
            &mut out,
            &Label::note(&page.name, [middle, 0.5 * pages.blank]),
        );
        (pages.paper, out.finish().into_vec())
    };
    Ok(pages.pages.iter().map(sheet).collect())
}

/// Name of a texture in the list of the drawing's resources.
fn texture_name(number: usize) -> Vec<u8> {
    format!("T{number}").into_bytes()
}

/// Prints the parts of textures that the drawing's sheets show.
fn print(out: &mut Content, drawing: &Drawing, textures: usize) {
    let parts = drawing.sheets.iter().flat_map(PrintedPart::all_of);
    for part in parts.filter(|part| part.texture < textures) {
        out.save_state();
        for corners in &part.triangles {
            let [a, b, c] = corners.map(|p| p.map(points));
            out.move_to(a[0], a[1]).line_to(b[0], b[1]);
            out.line_to(c[0], c[1]).close_path();
        }
        out.clip_nonzero().end_path();
        for map in part.copies() {
            let [[a, b], [c, d], [x, y]] = map.map(|column| column.map(points));
            out.save_state().transform([a, b, c, d, x, y]);
            out.x_object(Name(&texture_name(part.texture)))
                .restore_state();
        }
        out.restore_state();
    }
}

/// Creates the PDF content stream of the whole drawing, of which each page shows a part.
fn figure(drawing: &Drawing, textures: usize) -> Vec<u8> {
    let mut out = Content::new();
    print(&mut out, drawing, textures);
    out.set_line_width(points(LINE_WIDTH_MM))
        .set_line_join(LineJoinStyle::RoundJoin);
    for (kind, lines) in layers(drawing) {
        let [r, g, b] = kind.color().map(|v| f32::from(v) / 255.0);
        out.set_stroke_rgb(r, g, b);
        let dashes = kind.dashes().iter().map(|d| points(f64::from(*d)));
        out.set_dash_pattern(dashes, 0.0);
        for (line, closed) in lines {
            if let Some([x, y]) = line.controls().first() {
                out.move_to(points(*x), points(*y));
            }
            for piece in line.pieces() {
                match piece {
                    Piece::Line([_, [x, y]]) => out.line_to(points(x), points(y)),
                    Piece::Bezier([_, a, b, to]) => {
                        let [a, b, to] = [a, b, to].map(|p| p.map(points));
                        out.cubic_to(a[0], a[1], b[0], b[1], to[0], to[1])
                    }
                };
            }
            match closed {
                true => out.close_and_stroke(),
                false => out.stroke(),
            };
        }
    }
    grey(&mut out);
    for label in drawing.sheets.iter().flat_map(|sheet| &sheet.labels) {
        text(&mut out, label);
    }
    out.finish().into_vec()
}

fn grey(out: &mut Content) {
    let grey = f32::from(TEXT_GREY_LEVEL) / 255.0;
    out.set_fill_gray(grey).set_stroke_gray(grey);
}

/// Converts a text to Latin-1, which agrees with PDF's Windows encoding; other characters become `?`.
fn latin(text: &str) -> Vec<u8> {
    let byte = |c| u8::try_from(c).unwrap_or(b'?');
    text.chars().map(byte).collect()
}

/// Returns the width of a label's text, in millimetres.
fn text_width(label: &Label) -> f64 {
    label.size * latin(&label.text).iter().map(|c| width(*c)).sum::<f64>()
}

fn text(out: &mut Content, label: &Label) {
    let bytes = latin(&label.text);
    let half = 0.5 * text_width(label);
    let (sin, cos) = label.turn.to_radians().sin_cos();
    let (x, y) = (-half, -BASELINE_DROP * label.size);
    let start = [
        label.place[0] + cos * x - sin * y,
        label.place[1] + sin * x + cos * y,
    ];
    let [c, s] = [cos as f32, sin as f32];
    out.begin_text().set_font(FONT_RESOURCE, points(label.size));
    out.set_text_matrix([c, s, -s, c, points(start[0]), points(start[1])]);
    out.show(Str(&bytes)).end_text();
}

/// Returns the width of a character of the font Helvetica, in font sizes; labels consist of these characters.
fn width(character: u8) -> f64 {
    match character {
        b'i' | b'j' | b'l' => 0.222,
        b' ' | b'f' | b't' | b'I' => 0.278,
        b'r' => 0.333,
        0xb0 => 0.4,
        b'c' | b'k' | b's' | b'v' | b'x' | b'y' | b'z' => 0.5,
        b'w' => 0.722,
        b'm' => 0.833,
        b'A'..=b'Z' => 0.667,
        _ => 0.556,
    }
}

fn rect([width, height]: [f64; 2]) -> Rect {
    Rect::new(0.0, 0.0, points(width), points(height))
}
