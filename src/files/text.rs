//! The text of mesh files in whatever encoding and with whatever line ends.

use std::borrow::Cow;

/// Decodes text: UTF-8, or UTF-16 of either byte order that begins with its mark. What is not valid becomes `�`, because
/// names may be in any encoding. Every line ends with LF.
pub(super) fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    let wide = |from: fn([u8; 2]) -> u16| {
        let units = bytes[2..].chunks_exact(2).map(move |b| from([b[0], b[1]]));
        let characters = char::decode_utf16(units);
        characters.map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER))
    };
    let text = match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => String::from_utf8_lossy(rest),
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes).collect(),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes).collect(),
        _ => String::from_utf8_lossy(bytes),
    };
    match text.contains('\r') {
        true => Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n")),
        false => text,
    }
}

/// Parses a number, or R's name of a missing one.
pub(super) fn number(word: &str) -> Option<f64> {
    match word {
        "NA" => Some(f64::NAN),
        _ => word.parse().ok(),
    }
}

/// Iterates over the lines of a decoded text, with the number of each line's first row, from
/// 1; a `\` at the end of a line joins the next one to it.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut rows = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (row, first) = rows.next()?;
        let mut line = Cow::Borrowed(first);
        while let Some(end) = line.trim_ascii_end().strip_suffix('\\').map(str::len) {
            let Some((_, next)) = rows.next() else { break };
            let whole = line.to_mut();
            whole.truncate(end);
            whole.push(' ');
            whole.push_str(next);
        }
        Some((row + 1, line))
    })
}
