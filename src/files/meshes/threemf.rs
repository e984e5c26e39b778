//! Reads 3MF meshes: a ZIP archive with a model in XML, which states its unit, with the colours of materials and of corners.

use std::collections::HashMap;
use std::io::{Cursor, Read};

use nalgebra::{Matrix4, Vector4};
use roxmltree::{Document, Node};
use zip::ZipArchive;

use super::builder::{DEFAULT_VERTEX_COLOUR, MeshBuilder};
use super::corners::Corners;
use super::unit::FileUnit;
use crate::error::{Error, MAX_CELLS, Result};
use crate::files::failure::{damaged, undecodable};

/// Maximum size of the text of a model, in bytes: about that of the largest mesh.
const MAX_MODEL_BYTES: u64 = 64 * MAX_CELLS as u64;

/// Maximum number of components within components.
const MAX_COMPONENT_DEPTH: usize = 16;

/// Maximum number of components of a model, each counted as often as it is used.
const MAX_COMPONENTS: usize = 1_000_000;

/// Types of objects that only hold others while these are printed, or are nothing that is printed.
const SUPPORT_TYPES: [&str; 3] = ["support", "solidsupport", "other"];

pub(super) fn read(bytes: &[u8], parts: &mut MeshBuilder) -> Result<FileUnit> {
    let texts = models(bytes)?;
    let documents = (texts.iter())
        .map(|(name, text)| Ok((name.as_str(), Document::parse(text)?)))
        .collect::<std::result::Result<Vec<_>, roxmltree::Error>>()
        .map_err(undecodable)?;
    let Some((path, main)) = documents.first() else {
        return Err(damaged("there is no model in the archive"));
    };
    let root = main.root_element();
    let unit = FileUnit::new(root.attribute("unit").unwrap_or("millimeter"))
        .map_err(|_| damaged("the unit of its model is not known"))?;
    let nodes = || {
        let documents = documents.iter();
        documents.flat_map(|(path, document)| document.descendants().map(move |node| (*path, node)))
    };
    let objects = nodes()
        .filter(|(_, node)| node.tag_name().name() == "object")
        .filter_map(|(path, node)| Some(((path, node.attribute("id")?), node)))
        .collect();
    let palettes = nodes()
        .filter_map(|(path, node)| Some(((path, node.attribute("id")?), palette(node)?)))
        .collect();
    let mut model = Model {
        objects,
        palettes,
        parts,
        added: 0,
    };
    let items = (root.descendants()).filter(|node| node.tag_name().name() == "item");
    for item in items {
        model.add(path, item, &transform(item)?, 0)?;
    }
    Ok(unit)
}

/// Returns the paths and texts of the models in the archive, first the one that is built: others, in folders below, have
/// objects that it names.
fn models(bytes: &[u8]) -> Result<Vec<(String, String)>> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(undecodable)?;
    let mut names: Vec<String> = (archive.file_names())
        .filter(|name| name.to_ascii_lowercase().ends_with(".model"))
        .map(String::from)
        .collect();
    let mut left = MAX_MODEL_BYTES;
    let mut read = |name: String| {
        let file = archive.by_name(&name).map_err(undecodable)?;
        let mut text = String::new();
        let read = file.take(left + 1).read_to_string(&mut text);
        let length = read.map_err(undecodable)? as u64;
        left = left.checked_sub(length).ok_or(Error::TooLarge {
            what: "mesh",
            requested: MAX_MODEL_BYTES as usize + 1,
            limit: MAX_MODEL_BYTES as usize,
        })?;
        Ok((name.trim_start_matches('/').to_owned(), text))
    };
    let relations = read("_rels/.rels".into()).ok();
    let main = relations.and_then(|(_, text)| main_model(&text));
    names.sort_by_key(|name| {
        (
            Some(name.trim_start_matches('/')) != main.as_deref(),
            name.len(),
        )
    });
    names.into_iter().map(&mut read).collect()
}

/// Path of the model that is built, by the relations of the archive.
fn main_model(relations: &str) -> Option<String> {
    let document = Document::parse(relations).ok()?;
    let is_model =
        |node: &Node| (node.attribute("Type")).is_some_and(|kind| kind.ends_with("/3dmodel"));
    let path = document.descendants().find(is_model)?.attribute("Target")?;
    Some(path.trim_start_matches('/').to_owned())
}

/// Colours of the materials or corners that a resource lists; `None` for other resources.
fn palette(resource: Node) -> Option<Vec<[f32; 3]>> {
    let name = match resource.tag_name().name() {
        "basematerials" => "displaycolor",
        "colorgroup" => "color",
        _ => return None,
    };
    let elements = resource.children().filter(Node::is_element);
    Some(elements.map(|one| colour(one.attribute(name))).collect())
}

/// Parses a colour `#RRGGBB` with or without an opacity behind it; white for another text.
fn colour(text: Option<&str>) -> [f32; 3] {
    let digits = text.and_then(|text| text.trim().get(1..7));
    let levels = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
    levels.map_or(DEFAULT_VERTEX_COLOUR, |levels| {
        let [_, rgb @ ..] = levels.to_be_bytes();
        rgb.map(|level| f32::from(level) / 255.0)
    })
}

/// The objects and colours of all models, by the paths of these and their own names, and the mesh that is built of them.
struct Model<'a, 'b> {
    objects: HashMap<(&'a str, &'a str), Node<'a, 'a>>,
    palettes: HashMap<(&'a str, &'a str), Vec<[f32; 3]>>,
    parts: &'b mut MeshBuilder,
    /// Number of components that were added.
    added: usize,
}

impl<'a> Model<'a, '_> {
    /// Adds the object that a build item or a component of the model at `path` names, unless it only supports others.
    fn add(
        &mut self,
        path: &'a str,
        item: Node<'a, 'a>,
        transform: &Matrix4<f64>,
        depth: usize,
    ) -> Result<()> {
        if depth > MAX_COMPONENT_DEPTH {
            return Err(damaged("its components are within each other"));
        }
        self.added += 1;
        if self.added > MAX_COMPONENTS {
            return Err(damaged("its components repeat too often"));
        }
        // The attribute of the extension for objects in further models.
        let mut attributes = item.attributes();
        let path = attributes
            .find(|attribute| attribute.name() == "path")
            .map_or(path, |attribute| attribute.value().trim_start_matches('/'));
        let object = item
            .attribute("objectid")
            .and_then(|id| self.objects.get(&(path, id)))
            .copied();
        let object = object.ok_or_else(|| damaged("an object is not there"))?;
        if object
            .attribute("type")
            .is_some_and(|kind| SUPPORT_TYPES.contains(&kind))
        {
            return Ok(());
        }
        for child in object.children() {
            match child.tag_name().name() {
                "mesh" => self.mesh(path, object, child, transform)?,
                "components" => {
                    for component in child.children().filter(Node::is_element) {
                        self.add(
                            path,
                            component,
                            &(transform * self::transform(component)?),
                            depth + 1,
                        )?;
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn mesh(
        &mut self,
        path: &'a str,
        object: Node<'a, 'a>,
        mesh: Node<'a, 'a>,
        transform: &Matrix4<f64>,
    ) -> Result<()> {
        let start = self.parts.positions.len();
        let (mut corners, mut triangles) = (Corners::default(), Vec::new());
        for node in mesh.descendants() {
            match node.tag_name().name() {
                "vertex" => {
                    let [x, y, z] = ["x", "y", "z"].map(|name| number::<f64>(node, name));
                    let point = transform * Vector4::new(x?, y?, z?, 1.0);
                    corners.positions.push([point.x, point.y, point.z]);
                }
                "triangle" => {
                    let [a, b, c] = ["v1", "v2", "v3"].map(|name| number::<u32>(node, name));
                    triangles.push(([a?, b?, c?], self.colors(path, object, node)));
                }
                _ => {}
            }
        }
        let is_coloured = triangles.iter().any(|(_, colors)| colors.is_some());
        if !is_coloured {
            let positions = &corners.positions;
            (positions.iter()).try_for_each(|position| self.parts.position(*position))?;
        }
        for (triangle, colors) in triangles {
            let mut own = triangle.map(|vertex| vertex.saturating_add(start as u32));
            for (k, vertex) in own.iter_mut().enumerate().filter(|_| is_coloured) {
                let color = colors.map(|colors| colors[k]);
                *vertex = corners.vertex(triangle[k] as usize, None, color, self.parts)?;
            }
            self.parts.triangle(own)?;
        }
        let known = self.parts.colors.len();
        self.parts.material(known, DEFAULT_VERTEX_COLOUR);
        Ok(())
    }

    /// Colours of the corners of a triangle: by its own resource, or that of its object.
    fn colors(&self, path: &str, object: Node, triangle: Node) -> Option<[[f32; 3]; 3]> {
        let own = triangle.attribute("pid");
        let palette = &self
            .palettes
            .get(&(path, own.or(object.attribute("pid"))?))?;
        let first =
            (triangle.attribute("p1")).or(object.attribute("pindex").filter(|_| own.is_none()));
        let color = |index: Option<&str>| palette.get(index?.parse::<usize>().ok()?).copied();
        let first_color = color(first)?;
        let other = |name: &str| {
            triangle
                .attribute(name)
                .map_or(Some(first_color), |index| color(Some(index)))
        };
        Some([first_color, other("p2")?, other("p3")?])
    }
}

fn number<T: std::str::FromStr>(node: Node, name: &str) -> Result<T> {
    let value = node
        .attribute(name)
        .and_then(|text| text.trim().parse().ok());
    value.ok_or_else(|| damaged(format!("a vertex or triangle has no number `{name}`")))
}

/// Reads the transform of a build item or component: four rows of three numbers, by which a row (x, y, z, 1) is
/// multiplied.
fn transform(node: Node) -> Result<Matrix4<f64>> {
    let Some(text) = node.attribute("transform") else {
        return Ok(Matrix4::identity());
    };
    let numbers: Vec<f64> = text
        .split_whitespace()
        .map_while(|word| word.parse().ok())
        .collect();
    let rows: [f64; 12] =
        (numbers.try_into()).map_err(|_| damaged("a transform does not have twelve numbers"))?;
    let mut matrix = Matrix4::identity();
    for (i, value) in rows.into_iter().enumerate() {
        matrix[(i % 3, i / 3)] = value;
    }
    Ok(matrix)
}
