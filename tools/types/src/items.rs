//! The structures and enumerations that are serialised, as they stand in the sources.

use std::fs;
use std::path::Path;

use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, ExprLit, Fields, Lit, LitStr, Meta, Token, Type};

/// A structure or enumeration that is serialised.
pub struct Item {
    /// Folder of its crate, by which names that several crates have are told apart.
    pub home: String,
    /// Name in Rust.
    pub ident: String,
    /// Name in TypeScript: that of its attribute `serde(rename)`, or else the one in Rust.
    pub name: String,
    pub docs: Vec<String>,
    pub shape: Shape,
}

pub enum Shape {
    /// Fields of an object.
    Object(Vec<Member>),
    /// Names, of which the value is one.
    Names(Vec<Member>),
    /// Another type, which the structure is written as.
    Transparent(Type),
}

/// A field of a structure, or a variant of an enumeration.
pub struct Member {
    pub name: String,
    pub docs: Vec<String>,
    /// Type of the field; none of a variant.
    pub kind: Option<Type>,
}

/// Collects the items that are serialised, in the order of their files' paths: all of `src/`, and those of `wasm/` that have a
/// name for JavaScript. The package does not pass on the others as they are.
pub fn collect(root: &Path) -> Result<Vec<Item>, String> {
    let mut items = Vec::new();
    for home in ["src", "wasm"] {
        walk(root, &root.join(home), &mut items)?;
    }
    Ok(items)
}

fn walk(root: &Path, folder: &Path, items: &mut Vec<Item>) -> Result<(), String> {
    let about = |path: &Path, error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let entries = fs::read_dir(folder).map_err(|error| about(folder, &error))?;
    let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            walk(root, &path, items)?;
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = fs::read_to_string(&path).map_err(|error| about(&path, &error))?;
            let file = syn::parse_file(&text).map_err(|error| about(&path, &error))?;
            let own = path.strip_prefix(root).unwrap_or(&path);
            let depth = if own.starts_with("wasm") { 2 } else { 1 };
            let home = own.iter().take(depth).map(|part| part.to_string_lossy());
            let home = home.collect::<Vec<_>>().join("/");
            items.extend(file.items.iter().filter_map(|item| serialised(&home, item)));
        }
    }
    Ok(())
}

fn serialised(home: &str, item: &syn::Item) -> Option<Item> {
    let (ident, attributes) = match item {
        syn::Item::Struct(item) => (&item.ident, &item.attrs),
        syn::Item::Enum(item) => (&item.ident, &item.attrs),
        _ => return None,
    };
    let metas = metas(attributes);
    let derives = |meta: &Meta| {
        meta.path()
            .segments
            .last()
            .is_some_and(|s| s.ident == "Serialize")
    };
    if !list(&metas, "derive").iter().any(derives) {
        return None;
    }
    let serde = list(&metas, "serde");
    let name = text(&serde, "rename");
    if home != "src" && name.is_none() {
        return None;
    }
    let case = text(&serde, "rename_all").unwrap_or_default();
    let shape = match item {
        syn::Item::Struct(item) => match &item.fields {
            Fields::Unnamed(fields) => Shape::Transparent(fields.unnamed.first()?.ty.clone()),
            fields => Shape::Object(
                (fields.iter())
                    .filter_map(|field| {
                        let ident = field.ident.as_ref()?.to_string();
                        let kind = Some(field.ty.clone());
                        member(&ident, &field.attrs, &case, kind)
                    })
                    .collect(),
            ),
        },
        syn::Item::Enum(item) => Shape::Names(
            (item.variants.iter())
                .filter_map(|variant| {
                    member(&variant.ident.to_string(), &variant.attrs, &case, None)
                })
                .collect(),
        ),
        _ => return None,
    };
    Some(Item {
        home: home.into(),
        ident: ident.to_string(),
        name: name.unwrap_or_else(|| ident.to_string()),
        docs: docs(attributes),
        shape,
    })
}

/// A field or a variant as it is written; none if it is left out.
fn member(ident: &str, attributes: &[Attribute], case: &str, kind: Option<Type>) -> Option<Member> {
    let serde = list(&metas(attributes), "serde");
    if serde.iter().any(|meta| meta.path().is_ident("skip")) {
        return None;
    }
    let name = text(&serde, "rename").unwrap_or_else(|| match case {
        "camelCase" => camel_case(ident),
        "lowercase" => ident.to_lowercase(),
        _ => ident.into(),
    });
    let docs = docs(attributes);
    Some(Member { name, docs, kind })
}

/// Converts a name to the way JavaScript writes it: `gap_ratio` and `GapRatio` become `gapRatio`.
pub fn camel_case(name: &str) -> String {
    let mut after_underscore = false;
    let mut js = String::new();
    for letter in name.chars() {
        if letter != '_' {
            match (after_underscore, js.is_empty()) {
                (true, false) => js.extend(letter.to_uppercase()),
                (_, true) => js.extend(letter.to_lowercase()),
                _ => js.push(letter),
            }
        }
        after_underscore = letter == '_';
    }
    js
}

/// The attributes, with those that a feature turns on.
fn metas(attributes: &[Attribute]) -> Vec<Meta> {
    let mut found = Vec::new();
    for attribute in attributes {
        if attribute.path().is_ident("cfg_attr") {
            found.extend(inner(&attribute.meta).into_iter().skip(1));
        } else {
            found.push(attribute.meta.clone());
        }
    }
    found
}

/// What stands in the attributes of a name, such as `derive`.
fn list(metas: &[Meta], name: &str) -> Vec<Meta> {
    let own = metas.iter().filter(|meta| meta.path().is_ident(name));
    own.flat_map(inner).collect()
}

fn inner(meta: &Meta) -> Vec<Meta> {
    let parse = Punctuated::<Meta, Token![,]>::parse_terminated;
    match meta {
        Meta::List(list) => list.parse_args_with(parse).into_iter().flatten().collect(),
        _ => Vec::new(),
    }
}

/// The text of an attribute such as `rename = "…"`.
fn text(metas: &[Meta], name: &str) -> Option<String> {
    metas.iter().find_map(|meta| match meta {
        Meta::NameValue(pair) if pair.path.is_ident(name) => {
            literal(&pair.value).map(|text| text.value())
        }
        _ => None,
    })
}

fn literal(value: &Expr) -> Option<&LitStr> {
    match value {
        Expr::Lit(ExprLit {
            lit: Lit::Str(text),
            ..
        }) => Some(text),
        _ => None,
    }
}

fn docs(attributes: &[Attribute]) -> Vec<String> {
    let doc = |attribute: &Attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("doc") => {
            literal(&pair.value).map(LitStr::value)
        }
        _ => None,
    };
    attributes.iter().filter_map(doc).collect()
}
