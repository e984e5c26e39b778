//! Writes drawings as PDF: on one page of the drawing's size, or on pages of paper to be put together.

use pdf_writer::types::LineJoinStyle;
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use super::{BASELINE_DROP, LINE_WIDTH_MM, TEXT_GREY_LEVEL, layers};
use crate::drawing::{Drawing, Label, Pages, Piece, Stock};
use crate::error::{Error, Result};
use crate::files::points::{MAX_PAGE_SIDE_POINTS, POINTS_PER_MM, points};

/// Length of each arm of a registration mark (a cross by which pages are aligned), in millimetres.
const REGISTRATION_ARM_MM: f64 = 4.0;

/// Name of the font in the list of a PDF page's resources.
const FONT_RESOURCE: Name = Name(b"F");

/// Name of the drawing in the list of a PDF page's resources.
const DRAWING_RESOURCE: Name = Name(b"D");

/// Writes a drawing as a PDF file in true size: on the drawing's pages, each with its name and with crosses where it
/// overlaps its neighbours, or on one page of the drawing's size. `stock` arranges the drawing on pages first
/// ([`Drawing::onto`]). Print it at 100 %.
///
/// # Errors
/// [`Error::Unsupported`] for a drawing that is not finite, for a page of more than 5.08 m, the format's
/// limit, and what [`Drawing::onto`] has to say.
pub fn write_pdf(drawing: &Drawing, stock: Option<Stock>) -> Result<Vec<u8>> {
    drawing.check()?;
    let laid = stock.map(|stock| drawing.clone().onto(stock)).transpose()?;
    let drawing = laid.as_ref().unwrap_or(drawing);
    // Numbers of the objects: the first pages and their contents come after these.
    let [catalog, tree, font, form, info] = [1, 2, 3, 4, 5].map(Ref::new);
    let page = |i: usize| Ref::new(6 + 2 * i as i32);
    let content = |i: usize| Ref::new(7 + 2 * i as i32);
    let sheets = match &drawing.pages {
        Some(pages) => spread(pages)?,
        None => vec![whole(drawing)?],
    };
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(tree);
    pdf.document_info(info).title(TextStr("Pattern"));
    let ids = (0..sheets.len()).map(page);
    pdf.pages(tree).kids(ids).count(sheets.len() as i32);
    pdf.type1_font(font)
        .base_font(Name(b"Helvetica"))
        .encoding_predefined(Name(b"WinAnsiEncoding"));
    let figure = figure(drawing);
    let mut object = pdf.form_xobject(form, &figure);
    object.bbox(rect([drawing.width, drawing.height]));
    object.resources().fonts().pair(FONT_RESOURCE, font);
    object.finish();
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

fn whole(drawing: &Drawing) -> Result<Sheet> {
    let size = [drawing.width, drawing.height];
    check_page(size)?;
    let mut page = Content::new();
    page.x_object(DRAWING_RESOURCE);
    Ok((size, page.finish().into_vec()))
}

fn check_page(size: [f64; 2]) -> Result<()> {
    match size
        .iter()
        .any(|side| side * POINTS_PER_MM > MAX_PAGE_SIDE_POINTS)
    {
        true => Err(Error::Unsupported {
            format: "PDF",
            reason: "a page has at most 5.08 metres; choose a smaller scale, or a paper".into(),
        }),
        false => Ok(()),
    }
}

fn spread(pages: &Pages) -> Result<Vec<Sheet>> {
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
        let name = Label::note(&page.name, [0.5 * pages.paper[0], 0.5 * pages.blank]);
        text(&mut out, &name);
        (pages.paper, out.finish().into_vec())
    };
    Ok(pages.pages.iter().map(sheet).collect())
}

/// Creates the PDF content stream of the whole drawing, of which each page shows a part.
fn figure(drawing: &Drawing) -> Vec<u8> {
    let mut out = Content::new();
    out.set_line_width(points(LINE_WIDTH_MM))
        .set_line_join(LineJoinStyle::RoundJoin);
    for (kind, lines) in layers(drawing) {
        let [r, g, b] = kind.color().map(|v| f32::from(v) / 255.0);
        out.set_stroke_rgb(r, g, b);
        let dashes = kind.dashes().iter().map(|d| d * POINTS_PER_MM as f32);
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

fn text(out: &mut Content, label: &Label) {
    // In Latin-1, which agrees with PDF's Windows encoding; other characters become `?`.
    let bytes: Vec<u8> = (label.text.chars())
        .map(|c| u8::try_from(c).unwrap_or(b'?'))
        .collect();
    // A letter of Helvetica is about half as wide as the font is large.
    let half = 0.5 * label.size * bytes.iter().map(|c| width(*c)).sum::<f64>();
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
