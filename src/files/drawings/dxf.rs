//! Drawing Exchange Format of AutoCAD 2000, for cutters.

use ::dxf::entities::{Entity, EntityType, LwPolyline, Text};
use ::dxf::enums::{
    AcadVersion, DrawingUnits, HorizontalTextJustification, Units, VerticalTextJustification,
};
use ::dxf::tables::Layer;
use ::dxf::{Color, Drawing as File, LwPolylineVertex, Point};

use super::{Kind, layers};
use crate::error::Result;
use crate::files::buffer::Buffer;
use crate::flat::drawing::Drawing;

/// Bit of a polyline's flags.
const CLOSED: i32 = 1;

/// A DXF file of a drawing (AutoCAD 2000, ASCII) in millimetres, with polylines and texts on the
/// layers `CUT`, `MOUNTAIN`, `VALLEY`, `TAB` and `LABEL`.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) for a drawing that is not finite,
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn write_dxf(drawing: &Drawing) -> Result<Vec<u8>> {
    drawing.check()?;
    let mut file = File::new();
    let header = &mut file.header;
    header.version = AcadVersion::R2000;
    header.default_drawing_units = Units::Millimeters;
    header.drawing_units = DrawingUnits::Metric;
    header.minimum_drawing_extents = Point::new(0.0, 0.0, 0.0);
    header.maximum_drawing_extents = Point::new(drawing.width, drawing.height, 0.0);
    // The same file each time.
    header.fingerprint_guid = Default::default();
    header.version_guid = Default::default();
    header.creation_date = Default::default();
    header.creation_date_universal = Default::default();
    header.update_date = Default::default();
    header.update_date_universal = Default::default();
    for (name, color) in [
        ("CUT", 7),
        ("MOUNTAIN", 1),
        ("VALLEY", 5),
        ("TAB", 8),
        ("LABEL", 9),
    ] {
        file.add_layer(Layer {
            name: name.into(),
            color: Color::from_index(color),
            ..Layer::default()
        });
    }
    for (kind, lines) in layers(drawing) {
        for (points, closed) in lines {
            let vertices = points.iter().map(|[x, y]| LwPolylineVertex {
                x: *x,
                y: *y,
                ..LwPolylineVertex::default()
            });
            let line = LwPolyline {
                flags: if closed { CLOSED } else { 0 },
                vertices: vertices.collect(),
                ..LwPolyline::default()
            };
            add(&mut file, layer(kind), EntityType::LwPolyline(line));
        }
    }
    for label in drawing.sheets.iter().flat_map(|sheet| &sheet.labels) {
        let place = Point::new(label.place[0], label.place[1], 0.0);
        let text = Text {
            // The height of capitals, not of the font.
            text_height: 0.72 * label.size,
            location: place.clone(),
            second_alignment_point: place,
            horizontal_text_justification: HorizontalTextJustification::Center,
            vertical_text_justification: VerticalTextJustification::Middle,
            rotation: label.turn,
            value: label.text.replace('°', "%%d"),
            ..Text::default()
        };
        add(&mut file, "LABEL", EntityType::Text(text));
    }
    let mut out = Buffer::default();
    let written = file.save(&mut out).map_err(std::io::Error::other);
    out.finish("DXF file", written)
}

fn layer(kind: Kind) -> &'static str {
    match kind {
        Kind::Mountain => "MOUNTAIN",
        Kind::Valley => "VALLEY",
        Kind::Tab => "TAB",
        Kind::Cut => "CUT",
    }
}

fn add(file: &mut File, layer: &str, specific: EntityType) {
    let mut entity = Entity::new(specific);
    entity.common.layer = layer.into();
    file.add_entity(entity);
}
