//! Words over the picture of a PDF page, which are not seen but found, marked and copied.

use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, TextRenderingMode};
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, Str};

use crate::error::{Error, Result};
use crate::files::failure::unsupported;

/// A word that was recognised in the picture of a page, or a line of several.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BookWord<'a> {
    /// Characters of the word in the order in which they are read. A word of white space alone is left out.
    pub text: &'a str,
    /// Left, top, width and height of its box in pixels of the picture, from the picture's upper left corner.
    pub bounds: [f64; 4],
}

/// Name of the font, in the resources of a page.
pub(super) const FONT_RESOURCE: Name<'_> = Name(b"F");

/// Name by which programs know a font whose glyphs are empty, as text over scanned pages has it.
const FONT_NAME: Name<'_> = Name(b"GlyphLessFont");

/// Units of the font per em, as is usual in PDF and in the format of fonts; a character's box is as high.
const UNITS_PER_EM: u16 = 1000;

/// Width of every character, in units of the font; PDF's format stretches it to the width of a word's box.
const CHARACTER_WIDTH: u16 = 500;

/// Maximum length by which a word's box may stand out of the picture, in pixels: boxes are often rounded to whole ones.
const MAX_BOX_OVERHANG: f64 = 1.0;

/// Character collection of the font, whose numbers mean nothing by themselves.
const CHARACTER_COLLECTION: SystemInfo<'_> = SystemInfo {
    registry: Str(b"Adobe"),
    ordering: Str(b"Identity"),
    supplement: 0,
};

/// The different characters of all words in ascending order; the font numbers them from 1.
pub(super) struct Characters(Vec<char>);

impl Characters {
    /// Collects the characters of the words of all pages.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if there are more than a font can number.
    pub(super) fn new<'a>(words: impl Iterator<Item = &'a BookWord<'a>>) -> Result<Self> {
        let mut characters = Vec::new();
        for character in words.flat_map(|word| word.text.trim().chars()) {
            if let Err(place) = characters.binary_search(&character) {
                characters.insert(place, character);
            }
            let (requested, limit) = (characters.len(), usize::from(u16::MAX));
            if requested > limit {
                let what = "the font of all different characters in the words";
                return Err(Error::TooLarge {
                    what,
                    requested,
                    limit,
                });
            }
        }
        Ok(Self(characters))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Numbers of a word's characters from left to right, in two bytes each, as the font has them.
    fn encode(&self, text: &str) -> Vec<u8> {
        let number = |character| self.0.partition_point(|other| *other <= character) as u16;
        bytes_of(
            &left_to_right(text)
                .into_iter()
                .map(number)
                .collect::<Vec<_>>(),
        )
    }

    /// Writes the font as six objects from `first` on: each character is an empty glyph, and known by its Unicode.
    pub(super) fn write_font(&self, pdf: &mut Pdf, first: Ref) {
        let [descendant, descriptor, file, glyphs, unicode] =
            [1, 2, 3, 4, 5].map(|k| Ref::new(first.get() + k));
        pdf.type0_font(first)
            .base_font(FONT_NAME)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(descendant)
            .to_unicode(unicode);
        pdf.cid_font(descendant)
            .subtype(CidFontType::Type2)
            .base_font(FONT_NAME)
            .system_info(CHARACTER_COLLECTION)
            .font_descriptor(descriptor)
            .default_width(CHARACTER_WIDTH.into())
            .cid_to_gid_map_stream(glyphs);
        let [wide, high] = [CHARACTER_WIDTH, UNITS_PER_EM].map(f32::from);
        pdf.font_descriptor(descriptor)
            .name(FONT_NAME)
            .flags(FontFlags::FIXED_PITCH | FontFlags::SYMBOLIC)
            .bbox(Rect::new(0.0, 0.0, wide, high))
            .italic_angle(0.0)
            .ascent(high)
            .descent(0.0)
            .cap_height(high)
            .stem_v(0.0)
            .font_file2(file);
        let font = empty_font();
        let mut stream = pdf.stream(file, &font);
        stream.pair(Name(b"Length1"), font.len() as i32);
        stream.finish();
        // Two bytes for each number, of which 0 is one too: all are the font's only glyph.
        pdf.stream(glyphs, &vec![0; 2 * (self.0.len() + 1)]);
        pdf.stream(unicode, self.unicode_map().as_bytes());
    }

    /// The map from the font's numbers to characters in UTF-16, in the format of PostScript's character maps.
    fn unicode_map(&self) -> String {
        /// Maximum number of lines in a block, by the format.
        const MAX_BLOCK_LINES: usize = 100;
        let mut map = String::from(
            "/CIDInit /ProcSet findresource begin 12 dict begin begincmap\n\
             /CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def\n\
             /CMapName /Adobe-Identity-UCS def /CMapType 2 def\n\
             1 begincodespacerange <0000> <FFFF> endcodespacerange\n",
        );
        let mut number = 0;
        for block in self.0.chunks(MAX_BLOCK_LINES) {
            map += &format!("{} beginbfchar\n", block.len());
            for character in block {
                number += 1;
                map += &format!("<{number:04X}> <");
                for unit in character.encode_utf16(&mut [0; 2]) {
                    map += &format!("{unit:04X}");
                }
                map += ">\n";
            }
            map += "endbfchar\n";
        }
        map + "endcmap CMapName currentdict /CMap defineresource pop end end"
    }
}

/// Writes the words of one page as text that is not painted, each in a font as high as its box and stretched to its width.
/// `to_page` returns the place on the page, in points, of a place in the picture, which is `size` pixels large, and
/// `number` is the page's from 1.
///
/// # Errors
/// [`Error::Unsupported`] for a box that is not within the picture.
pub(super) fn write_words(
    content: &mut Content,
    (number, words): (usize, &[BookWord<'_>]),
    characters: &Characters,
    size: [f64; 2],
    to_page: impl Fn([f64; 2]) -> [f32; 2],
) -> Result<()> {
    content
        .begin_text()
        .set_text_rendering_mode(TextRenderingMode::Invisible);
    for (k, word) in words.iter().enumerate() {
        let text = word.text.trim();
        if text.is_empty() {
            continue;
        }
        let [left, top, width, height] = word.bounds;
        let [x, y] = to_page([left, top + height]);
        let [right, upper] = to_page([left + width, top]);
        let natural = text.chars().count() as f32 * f32::from(CHARACTER_WIDTH)
            / f32::from(UNITS_PER_EM)
            * (upper - y);
        let stretch = 100.0 * (right - x) / natural;
        let within = |start: f64, length: f64, side: f64| {
            start >= -MAX_BOX_OVERHANG && start + length <= side + MAX_BOX_OVERHANG && length > 0.0
        };
        let fits = within(left, width, size[0]) && within(top, height, size[1]);
        if !(fits && stretch.is_normal() && stretch > 0.0) {
            let [wide, tall] = size;
            let reason = format!(
                "word {} of page {number} has the box [{left}, {top}, {width}, {height}] (left, top, width, height), which is empty or not \
                 within its picture of {wide} × {tall} pixels",
                k + 1
            );
            return Err(unsupported("PDF", reason));
        }
        content
            .set_font(FONT_RESOURCE, upper - y)
            .set_horizontal_scaling(stretch)
            .set_text_matrix([1.0, 0.0, 0.0, 1.0, x, y])
            .show(Str(&characters.encode(text)));
    }
    content.end_text();
    Ok(())
}

/// Characters from left to right, as PDF has them. Text that begins with a letter of a script from right to left is
/// turned round, but for numbers and other words within.
fn left_to_right(text: &str) -> Vec<char> {
    let mut characters: Vec<char> = text.chars().collect();
    if !text
        .chars()
        .find(|c| c.is_alphabetic())
        .is_some_and(is_right_to_left)
    {
        return characters;
    }
    characters.reverse();
    for others in characters.split_mut(|&c| is_right_to_left(c)) {
        let is_kept = |c: &char| c.is_alphabetic() || is_digit(*c);
        let (first, last) = (
            others.iter().position(is_kept),
            others.iter().rposition(is_kept),
        );
        if let (Some(first), Some(last)) = (first, last) {
            others[first..=last].reverse();
        }
    }
    characters
}

/// Whether it is a letter or a mark of Hebrew, Arabic or another script from right to left, by Unicode's blocks.
fn is_right_to_left(character: char) -> bool {
    let blocks = matches!(character, '\u{590}'..='\u{8FF}' | '\u{FB1D}'..='\u{FDFF}' | '\u{FE70}'..='\u{FEFF}'
        | '\u{10800}'..='\u{10FFF}' | '\u{1E800}'..='\u{1EFFF}');
    blocks && !is_digit(character)
}

/// Whether it is a decimal digit, which scripts from right to left write from left to right, too.
fn is_digit(character: char) -> bool {
    character.is_ascii_digit() || matches!(character, '\u{660}'..='\u{669}' | '\u{6F0}'..='\u{6F9}')
}

/// A TrueType font with one glyph, which is empty. PDF readers want a font with the text, even if nothing of it is painted.
fn empty_font() -> Vec<u8> {
    /// Length of the header, in bytes.
    const HEADER_BYTES: usize = 12;
    /// Length of a table's entry after the header, in bytes.
    const ENTRY_BYTES: usize = 16;
    let [wide, high] = [CHARACTER_WIDTH, UNITS_PER_EM];
    let head = [1, 0, 1, 0, 0, 0, 0x5F0F, 0x3CF5, 0, high];
    let head = [&head[..], &[0; 10], &[wide, high, 0, 8, 2, 0, 0, 0]].concat();
    let hhea = [&[1, 0, high, 0, 0, wide, 0, 0, wide, 1][..], &[0; 7], &[1]].concat();
    let maxp = [&[1, 0, 1, 0, 0, 0, 0, 2][..], &[0; 8]].concat();
    // Words of two bytes, an even number of them, by the names of the tables in OpenType's specification.
    let tables: [(&[u8; 4], &[u16]); 6] = [
        (b"glyf", &[0, 0, 0, wide, high, 0]),
        (b"head", &head),
        (b"hhea", &hhea),
        (b"hmtx", &[wide, 0]),
        (b"loca", &[0, 6]),
        (b"maxp", &maxp),
    ];
    // The version and, for six tables, what a binary search among them begins with.
    let mut font = bytes_of(&[1, 0, 6, 64, 2, 32]);
    let mut data = Vec::new();
    for (tag, words) in tables {
        let table = bytes_of(words);
        let start = HEADER_BYTES + ENTRY_BYTES * tables.len() + data.len();
        let pairs = words.chunks_exact(2);
        let checksum = pairs.fold(0_u32, |sum, pair| {
            sum.wrapping_add(u32::from(pair[0]) << 16 | u32::from(pair[1]))
        });
        font.extend(tag);
        for value in [checksum, start as u32, table.len() as u32] {
            font.extend(value.to_be_bytes());
        }
        data.extend(table);
    }
    font.extend(data);
    font
}

/// Words of two bytes in the order of the font's format.
fn bytes_of(words: &[u16]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_be_bytes()).collect()
}
