//! Writes drawings as DXF (Drawing Exchange Format), for laser cutters and plotters.
//!
//! A DXF file is pairs of lines: a group code, which states the meaning, and its value. The files are in the format
//! of AutoCAD release 12, which has polylines with arcs and texts, needs no object handles and is read by every
//! program for cutters. (It has no splines, and many cutters support no more than arcs.) (Autodesk, DXF Reference,
//! "ENTITIES Section".)

use std::fmt::Display;
use std::io::{self, Write};

use super::arcs::{Corner, arcs};
use super::layers;
use crate::drawing::{Drawing, Label};
use crate::error::Result;
use crate::files::buffer::Buffer;

/// Layers of the DXF file with their colours, as numbers in AutoCAD's palette.
const LAYER_COLOURS: [(&str, u8); 8] = [
    ("CUT", 7),
    ("MOUNTAIN", 1),
    ("VALLEY", 5),
    ("TAB", 8),
    ("EDGE", 30),
    ("MARK", 3),
    ("LEADER", 9),
    ("LABEL", 9),
];

/// Value of the header variable `$INSUNITS` of the DXF format for millimetres.
const INSUNITS_MILLIMETRES: u8 = 4;

/// Height of a capital letter, in font sizes: DXF gives text heights as the height of capitals.
const CAPITAL_HEIGHT: f64 = 0.72;

/// Writes a drawing as a DXF file (AutoCAD R12, ASCII) in millimetres, with circles, polylines of straight pieces and
/// arcs within a hundredth of a millimetre of the drawing's curves, and texts, on the layers `CUT`, `MOUNTAIN`, `VALLEY`,
/// `TAB`, `EDGE`, `MARK`, `LEADER` and `LABEL`.
///
/// # Errors
/// [`Error::Unsupported`](crate::Error::Unsupported) for a drawing that is not finite,
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory).
pub fn write_dxf(drawing: &Drawing) -> Result<Vec<u8>> {
    drawing.check()?;
    let mut file = GroupCodes(Buffer::default());
    let written = write(&mut file, drawing);
    file.0.finish("DXF file", written)
}

fn write(file: &mut GroupCodes, drawing: &Drawing) -> io::Result<()> {
    file.section("HEADER", |file| {
        file.pair(9, "$ACADVER")?;
        file.pair(1, "AC1009")?;
        file.pair(9, "$INSUNITS")?;
        file.pair(70, INSUNITS_MILLIMETRES)?;
        file.pair(9, "$EXTMIN")?;
        file.point(10, [0.0, 0.0])?;
        file.pair(9, "$EXTMAX")?;
        file.point(10, [drawing.width, drawing.height])
    })?;
    file.section("TABLES", |file| {
        file.pair(0, "TABLE")?;
        file.pair(2, "LAYER")?;
        file.pair(70, LAYER_COLOURS.len())?;
        for (name, color) in LAYER_COLOURS {
            file.pair(0, "LAYER")?;
            file.pair(2, name)?;
            file.pair(70, 0)?;
            file.pair(62, color)?;
            file.pair(6, "CONTINUOUS")?;
        }
        file.pair(0, "ENDTAB")
    })?;
    file.section("ENTITIES", |file| {
        for (kind, lines) in layers(drawing) {
            let layer = kind.name().to_uppercase();
            for (curve, closed) in lines {
                match curve.circle().filter(|_| closed) {
                    Some((centre, radius)) => file.circle(&layer, centre, radius)?,
                    None => file.polyline(&layer, &arcs(curve), closed)?,
                }
            }
        }
        let labels = drawing.sheets.iter().flat_map(|sheet| &sheet.labels);
        labels.into_iter().try_for_each(|label| file.text(label))
    })?;
    file.pair(0, "EOF")
}

/// A DXF file that is being written: pairs of a group code, which states the meaning, and a value.
struct GroupCodes(Buffer);

impl GroupCodes {
    fn pair(&mut self, code: u16, value: impl Display) -> io::Result<()> {
        write!(self.0, "{code}\r\n{value}\r\n")
    }

    /// Writes a point to the DXF file; the group codes of y and z are that of x plus 10 and plus 20.
    fn point(&mut self, code: u16, [x, y]: [f64; 2]) -> io::Result<()> {
        self.pair(code, x)?;
        self.pair(code + 10, y)?;
        self.pair(code + 20, 0.0)
    }

    fn section(
        &mut self,
        name: &str,
        content: impl FnOnce(&mut Self) -> io::Result<()>,
    ) -> io::Result<()> {
        self.pair(0, "SECTION")?;
        self.pair(2, name)?;
        content(self)?;
        self.pair(0, "ENDSEC")
    }

    fn circle(&mut self, layer: &str, centre: [f64; 2], radius: f64) -> io::Result<()> {
        self.pair(0, "CIRCLE")?;
        self.pair(8, layer)?;
        self.point(10, centre)?;
        self.pair(40, radius)
    }

    /// Writes a polyline to the DXF file; the last corner of a closed one, which repeats the first, is left out.
    fn polyline(&mut self, layer: &str, line: &[Corner], closed: bool) -> io::Result<()> {
        let line = match line {
            [all @ .., _] if closed => all,
            all => all,
        };
        self.pair(0, "POLYLINE")?;
        self.pair(8, layer)?;
        // Flag: vertices follow.
        self.pair(66, 1)?;
        self.point(10, [0.0, 0.0])?;
        self.pair(70, u8::from(closed))?;
        for Corner { place, bulge } in line {
            self.pair(0, "VERTEX")?;
            self.pair(8, layer)?;
            self.point(10, *place)?;
            if *bulge != 0.0 {
                self.pair(42, bulge)?;
            }
        }
        self.pair(0, "SEQEND")?;
        self.pair(8, layer)
    }

    /// Writes a label's text to the DXF file, centred on the label's position.
    fn text(&mut self, label: &Label) -> io::Result<()> {
        /// Value of group 72 of the DXF format for text that is centred horizontally.
        const ALIGN_CENTRE: u8 = 1;

        /// Value of group 73 of the DXF format for text that is centred vertically.
        const ALIGN_MIDDLE: u8 = 2;
        self.pair(0, "TEXT")?;
        self.pair(8, "LABEL")?;
        self.point(10, label.place)?;
        self.pair(40, CAPITAL_HEIGHT * label.size)?;
        self.pair(1, encoded(&label.text))?;
        self.pair(50, label.turn)?;
        self.pair(72, ALIGN_CENTRE)?;
        self.point(11, label.place)?;
        self.pair(73, ALIGN_MIDDLE)
    }
}

/// Encodes a text as one line of ASCII, in DXF's notation for other characters.
fn encoded(text: &str) -> String {
    let mut line = String::new();
    for letter in text.chars() {
        match letter {
            '°' => line += "%%d",
            ' '..='~' => line.push(letter),
            _ if letter.is_control() => line.push(' '),
            _ => line += &format!("\\U+{:04X}", u32::from(letter)),
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stay_in_their_line() {
        assert_eq!(encoded("M 50°"), "M 50%%d");
        assert_eq!(encoded("a\r\n0\nEOF\né"), "a  0 EOF \\U+00E9");
    }
}
