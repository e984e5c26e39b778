//! Documentation of Rust as comments of TypeScript: without links, and with the names that JavaScript has.

use crate::items::{Item, camel_case};

/// Maximum length of a line of a comment.
const MAX_LINE_LENGTH: usize = 120;

/// Makes a comment of paragraphs and of a list below them, in as many lines as it takes.
pub fn comment(paragraphs: &[String], list: &[String], indent: &str) -> String {
    let width = MAX_LINE_LENGTH - indent.len() - " * ".len();
    let mut lines: Vec<String> = Vec::new();
    for (i, paragraph) in paragraphs.iter().enumerate() {
        lines.extend((i > 0).then(String::new));
        lines.extend(wrapped(paragraph, width, ""));
    }
    for item in list {
        lines.extend(wrapped(&format!("- {item}"), width, "  "));
    }
    match &lines[..] {
        [line] if line.chars().count() + " /** */".len() <= width => {
            format!("{indent}/** {line} */\n")
        }
        lines => {
            let lines = lines.iter().map(|line| format!("{indent} * {line}"));
            let lines = lines.map(|line| line.trim_end().to_owned() + "\n");
            format!("{indent}/**\n{}{indent} */\n", lines.collect::<String>())
        }
    }
}

/// Breaks a text into lines of at most `width` letters; all but the first begin with `hang`.
fn wrapped(text: &str, width: usize, hang: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let fits = |line: &&mut String| {
            line.is_empty() || line.chars().count() + 1 + word.chars().count() <= width
        };
        match lines.last_mut().filter(fits) {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) => line.extend([" ", word]),
            None => lines.push(format!("{hang}{word}")),
        }
    }
    lines
}

/// The paragraphs of an item's documentation, as JavaScript has to read them. `items` are those whose names differ there.
pub fn paragraphs(docs: &[String], items: &[Item]) -> Vec<String> {
    let mut paragraphs: Vec<String> = Vec::new();
    let mut is_open = false;
    for line in docs.iter().map(|line| line.trim()) {
        match paragraphs.last_mut() {
            Some(paragraph) if is_open && !line.is_empty() => paragraph.extend([" ", line]),
            _ if line.is_empty() => {}
            _ => paragraphs.push(line.into()),
        }
        is_open = !line.is_empty();
    }
    let told = |paragraph: &String| in_js(&without_links(paragraph), items);
    paragraphs.iter().map(told).collect()
}

/// Replaces links by their texts: `[text](target)` and `` [`name`] ``. A link in parentheses, which says where else to read, is
/// left out.
fn without_links(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(start) = rest.find('[') {
        let (before, link) = rest.split_at(start);
        out.push_str(before);
        let end = link.find(']').unwrap_or(link.len() - 1);
        let (label, mut after) = (&link[1..end], &link[end + 1..]);
        let target = after
            .strip_prefix('(')
            .and_then(|after| after.split_once(')'));
        if target.is_none() && !(label.starts_with('`') && label.ends_with('`')) {
            out.push('[');
            rest = &link[1..];
            continue;
        }
        after = target.map_or(after, |(_, after)| after);
        match (out.strip_suffix(" ("), after.strip_prefix(')')) {
            (Some(before), Some(after)) => {
                out.truncate(before.len());
                rest = after;
            }
            _ => {
                out.push_str(label);
                rest = after;
            }
        }
    }
    out + rest
}

/// Writes names in backticks as JavaScript has them, and what is missing as what it is there.
fn in_js(text: &str, items: &[Item]) -> String {
    let parts = text.split('`').enumerate().map(|(i, part)| match i % 2 {
        0 => part.to_owned(),
        _ => code(part, items),
    });
    parts.collect::<Vec<_>>().join("`")
}

/// `Options::max_iterations` becomes `maxIterations`, `Lambda::Big` the text `'big'`; what is no name of Rust stays.
fn code(text: &str, items: &[Item]) -> String {
    let is_name = |part: &str| part.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let is_type = |part: &str| part.starts_with(|first: char| first.is_ascii_uppercase());
    let parts: Vec<&str> = text.split("::").collect();
    match parts[..] {
        ["None"] => "undefined".into(),
        [.., _, name] if is_type(name) => format!("'{}'", camel_case(name)),
        [.., _, name] => camel_case(name),
        [name] if is_name(name) && is_type(name) => {
            let item = items.iter().find(|item| item.ident == name);
            item.map_or(name, |item| &item.name).into()
        }
        _ => {
            let word = |word: &str| match word.contains('_') && word.is_ascii() {
                true => camel_case(word),
                false => word.into(),
            };
            text.split(' ').map(word).collect::<Vec<_>>().join(" ")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::items::Shape;

    fn told(docs: &str) -> String {
        let item = Item {
            home: "src".into(),
            ident: "Line".into(),
            name: "FoldLine".into(),
            docs: Vec::new(),
            shape: Shape::Names(Vec::new()),
        };
        let lines: Vec<String> = docs.lines().map(String::from).collect();
        paragraphs(&lines, &[item]).join(" | ")
    }

    #[test]
    fn links_and_names_are_those_of_javascript() {
        assert_eq!(
            told(" At most\n [`Options::max_iterations`](crate::Options)."),
            "At most `maxIterations`."
        );
        assert_eq!(
            told("λ is [`Lambda::Big`]; `None` without it."),
            "λ is `'big'`; `undefined` without it."
        );
        assert_eq!(
            told("Edges of a [`Line`]\n\nsee [the list](x) of [0, 1]"),
            "Edges of a `FoldLine` | see the list of [0, 1]"
        );
        assert_eq!(told("A letter ([`Label`](super::Label))."), "A letter.");
        assert_eq!(
            told("`(objective − dual_bound) / objective`"),
            "`(objective − dualBound) / objective`"
        );
    }

    #[test]
    fn comments_break_at_the_width() {
        let long = "word ".repeat(40).trim().to_owned();
        let lines = comment(&[long], &["one".into()], "  ");
        assert!(
            lines.lines().all(|line| line.len() <= MAX_LINE_LENGTH),
            "{lines}"
        );
        assert!(lines.ends_with("   * - one\n   */\n"), "{lines}");
        assert_eq!(comment(&["Short.".into()], &[], ""), "/** Short. */\n");
    }
}
