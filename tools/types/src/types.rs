//! Declarations in TypeScript.

use syn::{GenericArgument, PathArguments, Type, TypePath};

use crate::docs::{comment, paragraphs};
use crate::items::{Item, Member, Shape};

/// Writes the declarations of all items, in the order of their names.
pub fn declarations(items: &[Item]) -> Result<String, String> {
    let mut sorted: Vec<&Item> = items.iter().collect();
    sorted.sort_by_key(|item| &item.name);
    if let Some(pair) = sorted.windows(2).find(|pair| pair[0].name == pair[1].name) {
        return Err(format!(
            "{} and {} both have the name {}: rename one by an attribute of serde",
            pair[0].home, pair[1].home, pair[0].name
        ));
    }
    sorted
        .iter()
        .map(|item| Scope { items, item }.declaration())
        .collect()
}

/// Writes lists of the names of some enumerations, as JavaScript.
pub fn names(items: &[Item], wanted: &[&str]) -> Result<String, String> {
    let list = |wanted: &&str| {
        let item = items.iter().find(|item| item.name == *wanted);
        let Some(Shape::Names(names)) = item.map(|item| &item.shape) else {
            return Err(format!("there is no enumeration {wanted}"));
        };
        let names: Vec<_> = (names.iter())
            .map(|one| format!("'{}'", one.name))
            .collect();
        Ok(format!(
            "\nexport const {wanted} = [{}];\n",
            names.join(", ")
        ))
    };
    wanted.iter().map(list).collect()
}

/// An item, and those that its fields may be of.
struct Scope<'a> {
    items: &'a [Item],
    item: &'a Item,
}

impl Scope<'_> {
    fn declaration(&self) -> Result<String, String> {
        let Item {
            name, docs, shape, ..
        } = self.item;
        let fault = |what: &str| format!("{}: {name} {what}", self.item.home);
        if docs.is_empty() {
            return Err(fault("has no documentation"));
        }
        let docs = paragraphs(docs, self.items);
        Ok(match shape {
            Shape::Object(fields) => {
                let fields = fields
                    .iter()
                    .map(|field| self.field(field))
                    .collect::<Result<String, _>>()?;
                format!(
                    "\n{}export interface {name} {{\n{fields}}}\n",
                    comment(&docs, &[], "")
                )
            }
            Shape::Names(names) => {
                let told = |variant: &Member| {
                    let docs = paragraphs(&variant.docs, self.items).join(" ");
                    format!("`'{}'`: {docs}", variant.name)
                };
                let told: Vec<String> = names.iter().map(told).collect();
                let union: Vec<String> = names
                    .iter()
                    .map(|variant| format!("'{}'", variant.name))
                    .collect();
                format!(
                    "\n{}export type {name} = {};\n",
                    comment(&docs, &told, ""),
                    union.join(" | ")
                )
            }
            Shape::Transparent(kind) => {
                let kind = self
                    .written(kind)
                    .ok_or_else(|| fault("is of a type without a name in TypeScript"))?;
                format!(
                    "\n{}export type {name} = {kind};\n",
                    comment(&docs, &[], "")
                )
            }
        })
    }

    fn field(&self, field: &Member) -> Result<String, String> {
        let Member { name, docs, kind } = field;
        let fault = |what: &str| format!("{}: {}.{name} {what}", self.item.home, self.item.name);
        if docs.is_empty() {
            return Err(fault("has no documentation"));
        }
        let kind = kind.as_ref().ok_or_else(|| fault("has no type"))?;
        let (mark, kind) = match argument(kind, "Option") {
            Some(kind) => ("?", kind),
            None => ("", kind),
        };
        let kind = self
            .written(kind)
            .ok_or_else(|| fault("is of a type without a name in TypeScript"))?;
        Ok(format!(
            "{}  {name}{mark}: {kind};\n",
            comment(&paragraphs(docs, self.items), &[], "  ")
        ))
    }

    /// The type in TypeScript.
    fn written(&self, kind: &Type) -> Option<String> {
        match kind {
            Type::Array(array) => {
                let syn::Expr::Lit(syn::ExprLit {
                    lit: syn::Lit::Int(length),
                    ..
                }) = &array.len
                else {
                    return None;
                };
                let one = self.written(&array.elem)?;
                Some(format!(
                    "[{}]",
                    vec![one; length.base10_parse().ok()?].join(", ")
                ))
            }
            Type::Reference(reference) => match &*reference.elem {
                Type::Slice(slice) => self.listed(&slice.elem),
                other => self.written(other),
            },
            Type::Path(path) => match (argument(kind, "Vec"), argument(kind, "Nullable")) {
                (Some(one), _) => self.listed(one),
                (_, Some(one)) => Some(format!("{} | null", self.written(one)?)),
                _ => self.named(path),
            },
            _ => None,
        }
    }

    fn listed(&self, one: &Type) -> Option<String> {
        Some(format!("{}[]", self.written(one)?))
    }

    fn named(&self, path: &TypePath) -> Option<String> {
        let name = path.path.segments.last()?.ident.to_string();
        Some(match name.as_str() {
            "f64" | "f32" | "usize" | "u32" | "u16" | "u8" | "i32" => "number".into(),
            "bool" => "boolean".into(),
            "String" | "str" => "string".into(),
            array if array.ends_with("Array") => format!("{array}<ArrayBuffer>"),
            _ => {
                let own = |item: &&Item| item.ident == name;
                let near = self
                    .items
                    .iter()
                    .filter(own)
                    .find(|item| item.home == self.item.home);
                let found = near.or_else(|| self.items.iter().find(own))?;
                found.name.clone()
            }
        })
    }
}

/// The type that a generic one of a name is made of: `T` of `Option<T>`.
fn argument<'a>(kind: &'a Type, name: &str) -> Option<&'a Type> {
    let Type::Path(path) = kind else { return None };
    let segment = path
        .path
        .segments
        .last()
        .filter(|segment| segment.ident == name)?;
    let PathArguments::AngleBracketed(arguments) = &segment.arguments else {
        return None;
    };
    arguments.args.iter().find_map(|argument| match argument {
        GenericArgument::Type(kind) => Some(kind),
        _ => None,
    })
}
