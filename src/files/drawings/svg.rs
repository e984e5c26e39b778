//! Writes drawings as SVG: a layer for each kind of line.

use std::fmt::Write as _;

use ::svg::node::element::{ClipPath, Definitions, Element, Group, Image, Path, Text, Title, Use};
use ::svg::{Document, Node};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::printed::{PrintedPart, TextureFile};
use super::{BASELINE_DROP, Kind, LINE_WIDTH_MM, TEXT_GREY_LEVEL, UNTITLED};
use crate::drawing::{Curve, Drawing, LabelKind, Pages, Piece};
use crate::error::Result;

/// Writes a drawing as an SVG file: its unit is the millimetre, its layers are groups with the ids `cut`, `mountain`,
/// `valley`, `tab`, `edge`, `mark`, `leader` and `label`, and each element has the number of its sheet as `data-sheet`
/// and of its crease, if any, as `data-crease`. `title` is that of the document, "Pattern" by default. `textures` are those of the
/// mesh, by their numbers; parts of them are printed below all lines, in a layer with the id `picture`.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) for a drawing that is not finite or larger
/// than [`MAX_SIZE`](crate::drawing::MAX_SIZE).
pub fn write_svg(
    drawing: &Drawing,
    title: Option<&str>,
    textures: &[TextureFile<'_>],
) -> Result<Vec<u8>> {
    drawing.check()?;
    let (width, height) = (number(drawing.width), number(drawing.height));
    let mut document = Document::new()
        .set("width", format!("{width}mm"))
        .set("height", format!("{height}mm"))
        .set("viewBox", format!("0 0 {width} {height}"))
        .set(
            "xmlns:inkscape",
            "http://www.inkscape.org/namespaces/inkscape",
        )
        .add(Title::new(title.unwrap_or(UNTITLED)));
    if let Some(pages) = &drawing.pages {
        document = document
            .set(
                "xmlns:sodipodi",
                "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd",
            )
            .add(paged(pages, drawing.height));
    }
    // Rows count down in SVG.
    let place = |[x, y]: [f64; 2]| [number(x), number(drawing.height - y)];
    if let Some((definitions, picture)) = printed(drawing, textures) {
        document = document.add(definitions).add(picture);
    }
    for kind in Kind::all() {
        let mut layer = layer(kind.name())
            .set("fill", "none")
            .set("stroke", rgb(kind.color()))
            .set("stroke-width", LINE_WIDTH_MM);
        if !kind.dashes().is_empty() {
            let dashes: Vec<String> = kind.dashes().iter().map(f32::to_string).collect();
            layer = layer.set("stroke-dasharray", dashes.join(" "));
        }
        for (number, sheet) in drawing.sheets.iter().enumerate() {
            let path = |curve: &Curve, closed: bool| {
                Path::new()
                    .set("d", data(curve, closed, place))
                    .set("data-sheet", number + 1)
            };
            let folds = match kind {
                Kind::Tab => &sheet.tabs,
                Kind::Mountain | Kind::Valley => &sheet.folds,
                _ => {
                    let (curves, closed) = kind.lines(sheet);
                    for curve in curves {
                        layer = layer.add(path(curve, closed));
                    }
                    continue;
                }
            };
            for fold in folds {
                if kind == Kind::Tab || Kind::of(fold.direction) == kind {
                    let path = path(&fold.curve, false)
                        .set("data-crease", fold.crease)
                        .set("data-angle", self::number(fold.angle));
                    layer = layer.add(match kind {
                        Kind::Tab => path.set("data-direction", Kind::of(fold.direction).name()),
                        _ => path,
                    });
                }
            }
        }
        document = document.add(layer);
    }
    let mut texts = layer("label")
        .set("fill", rgb([TEXT_GREY_LEVEL; 3]))
        .set("font-family", "Helvetica, Arial, sans-serif")
        .set("text-anchor", "middle");
    for (number, sheet) in drawing.sheets.iter().enumerate() {
        for label in &sheet.labels {
            let [x, y] = place(label.place);
            let class = match label.kind {
                LabelKind::Patch => "patch",
                LabelKind::Seam => "seam",
                LabelKind::Fold => "fold",
                LabelKind::Sheet => "sheet",
            };
            let mut text = Text::new(label.text.as_str())
                .set("class", class)
                .set("data-sheet", number + 1)
                .set("x", x.as_str())
                .set("y", y.as_str())
                .set("dy", self::number(BASELINE_DROP * label.size))
                .set("font-size", self::number(label.size));
            if label.turn != 0.0 {
                let turn = self::number(-label.turn);
                text.assign("transform", format!("rotate({turn} {x} {y})"));
            }
            texts = texts.add(text);
        }
    }
    Ok(document.add(texts).to_string().into_bytes())
}

/// Creates the layer of the textures that are printed on the sheets, and the textures and clipping paths that it uses.
fn printed(drawing: &Drawing, textures: &[TextureFile<'_>]) -> Option<(Definitions, Group)> {
    let mut definitions = Definitions::new();
    for (texture, file) in textures.iter().enumerate() {
        let address = format!("data:image/jpeg;base64,{}", STANDARD.encode(file.jpeg));
        definitions = definitions.add(
            Image::new()
                .set("id", format!("texture-{texture}"))
                .set("width", 1)
                .set("height", 1)
                .set("preserveAspectRatio", "none")
                .set("href", address),
        );
    }
    let (mut layer, mut count) = (layer("picture"), 0);
    let parts = drawing.sheets.iter().flat_map(PrintedPart::all_of);
    for part in parts.filter(|part| part.texture < textures.len()) {
        let outline = |[a, b, c]: &[[f64; 2]; 3]| {
            let [a, b, c] =
                [a, b, c].map(|[x, y]| format!("{} {}", number(*x), number(drawing.height - y)));
            format!("M{a}L{b}L{c}Z")
        };
        let outlines: String = part.triangles.iter().map(outline).collect();
        let clip = format!("printed-{count}");
        count += 1;
        definitions = definitions.add(
            ClipPath::new()
                .set("id", clip.as_str())
                .add(Path::new().set("d", outlines)),
        );
        let mut clipped = Group::new().set("clip-path", format!("url(#{clip})"));
        for [[a, b], [c, d], [x, y]] in part.copies() {
            // The rows of a picture count down, and so do those of the file.
            let map = [a, -b, -c, d, x + c, drawing.height - y - d];
            let map: Vec<String> = map.iter().map(|v| format!("{v:.6}")).collect();
            clipped = clipped.add(
                Use::new()
                    .set("href", format!("#texture-{}", part.texture))
                    .set("transform", format!("matrix({})", map.join(" "))),
            );
        }
        layer = layer.add(clipped);
    }
    (count > 0).then_some((definitions, layer))
}

/// Creates the element that tells the program Inkscape where the drawing's pages are; it has no lines, which a cutter
/// would follow.
fn paged(pages: &Pages, height: f64) -> Element {
    let mut view = Element::new("sodipodi:namedview");
    let [width, tall] = pages.paper;
    for page in &pages.pages {
        let [x, y] = page.corner.map(|v| v - pages.blank);
        let mut element = Element::new("inkscape:page");
        let sizes = [
            ("x", x),
            ("y", height - y - tall),
            ("width", width),
            ("height", tall),
        ];
        for (name, value) in sizes {
            element.assign(name, number(value));
        }
        element.assign("inkscape:label", page.name.as_str());
        view.append(element);
    }
    view
}

/// Converts a curve to SVG path data, such as `M0 0L1 0`; `place` converts a point to the file's coordinates.
fn data(curve: &Curve, closed: bool, place: impl Fn([f64; 2]) -> [String; 2]) -> String {
    let at = |point: &[f64; 2]| place(*point).join(" ");
    let mut data = String::new();
    for point in curve.controls().iter().take(1) {
        data = format!("M{}", at(point));
    }
    for piece in curve.pieces() {
        // Writing into a string cannot fail.
        let _ = match &piece {
            Piece::Line([_, to]) => write!(data, "L{}", at(to)),
            Piece::Bezier([_, a, b, to]) => write!(data, "C{} {} {}", at(a), at(b), at(to)),
        };
    }
    if closed {
        data.push('Z');
    }
    data
}

/// Creates an SVG group that drawing programs treat as a layer.
fn layer(name: &str) -> Group {
    Group::new()
        .set("id", name)
        .set("inkscape:groupmode", "layer")
        .set("inkscape:label", name)
}

fn rgb([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Writes a number to four decimals (a length in millimetres to a tenth of a micrometre), without trailing zeros.
fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" => "0".into(),
        text => text.into(),
    }
}
