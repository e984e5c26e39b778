//! Surfaces cut into flat sheets, drawings of these, and drawings written to files, for JavaScript.

use js_sys::{Float64Array, Int32Array, Reflect, Uint8Array, Uint32Array};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use developable::Mesh;
use developable::assembly::Assembly;
use developable::drawing::{Bending, Drawing, DrawingOptions, Stock};
use developable::explore::Trials;
use developable::files::Unit;
use developable::files::assembly::{write_animation, write_assembly_svg};
use developable::files::drawings::{PdfOptions, TextureFile, write_dxf, write_pdf, write_svg};
use developable::patches::{Crease, MeshPatches, Patch, PatchOptions};
use developable::pattern::{
    FlatOptions, MeshKind, Missing, NetOptions, Pattern, PatternOptions, RecognizedMesh, Shape,
    Sheet, Simplified, lay_flat, sheet_metal,
};
use developable::unroll::UnrollOptions;
use developable_wasm::mesh::MeshInput;
use developable_wasm::options::{OptionReader, read};
use developable_wasm::scene::{Scene, check_spacing, is_image};
use developable_wasm::{Failure, Result};

/// Options of a pattern (a surface cut into flat sheets) and of its drawing, read from JavaScript.
struct Wanted {
    patches: PatchOptions,
    sheets: PatternOptions,
    drawing: DrawingOptions,
    own: PatternInput,
}

/// Options of a pattern besides those of the library's structures.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct PatternInput {
    scale: Option<f64>,
    thickness: Option<f64>,
    inner_radius: Option<f64>,
    k_factor: Option<f64>,
    stock: Option<Stock>,
    assembly: bool,
    spacing: Option<f64>,
    exact: Option<bool>,
    /// Largest extent of the model, in millimetres.
    size: Option<f64>,
    /// Pairs of patches whose common edges are cut, and are folds, by their numbers on drawings, which begin with 1.
    cut: Vec<[u32; 2]>,
    join: Vec<[u32; 2]>,
    /// Maximum number of flat faces that stand for the surface; 0 for none.
    faces: Option<usize>,
    /// Whether the blank of a solid of sheet metal is wanted.
    blank: bool,
}

impl Wanted {
    /// Reads the options of a pattern. Without a scale a surface whose unit is known is drawn in true size.
    fn of(surface: &JsValue, options: &JsValue) -> Result<Self> {
        let mut reader = OptionReader::new(options)?;
        let unrolling: UnrollOptions = reader.read()?;
        let (patches, sheets): (PatchOptions, PatternOptions) = (reader.read()?, reader.read()?);
        let mut drawing: DrawingOptions = reader.read()?;
        let own: PatternInput = reader.read()?;
        reader.finish()?;
        let unit = Reflect::get(surface, &"unit".into())
            .ok()
            .and_then(|unit| Unit::from_symbol(&unit.as_string()?));
        let scale = own.scale.or(unit.map(Unit::millimetres));
        drawing.scale = scale.unwrap_or(drawing.scale);
        // 0 means no tabs, or no marks.
        drawing.tabs = drawing.tabs.filter(|depth| *depth != 0.0);
        drawing.marks = drawing.marks.filter(|distance| *distance != 0.0);
        if let Some(bending) =
            // That of a blank is known once its mesh is.
            bending(
                own.thickness.or(own.blank.then_some(1.0)),
                own.inner_radius,
                own.k_factor,
            )?
        {
            drawing = drawing.bending(bending);
        }
        drawing.check()?;
        own.stock.map(Stock::check).transpose()?;
        Ok(Wanted {
            patches,
            sheets: sheets.unrolling(unrolling),
            drawing,
            own,
        })
    }

    /// Sets the scale at which a mesh is as large as is wanted.
    fn scale_to(&mut self, mesh: &Mesh) -> Result<()> {
        let Some(size) = self.own.size else {
            return Ok(());
        };
        let extent = |k: usize| {
            let all = mesh.positions().iter().map(|p| p[k]);
            all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
        };
        let largest = (0..3).map(extent).fold(0.0, f64::max);
        if self.own.scale.is_some() || size.is_nan() || size <= 0.0 {
            return Err(Failure {
                code: "OPTION",
                message:
                    "option `size` must be above 0, and instead of `scale`: give one of the two"
                        .into(),
            });
        }
        self.drawing = self.drawing.scale(size / largest);
        Ok(())
    }

    /// Sets the thickness of a blank, in millimetres, unless the options give one; likewise the radius of its sharp bends.
    fn set_thickness(&mut self, thickness: f64) {
        if let Some(metal) = &mut self.drawing.bending {
            metal.thickness = self.own.thickness.unwrap_or(thickness);
            metal.radius = self.own.inner_radius.unwrap_or(metal.thickness);
        }
    }

    fn net_options(&self) -> NetOptions {
        // Numbers of patches begin with 1 on drawings.
        let numbered = |pairs: &[[u32; 2]]| {
            let pairs = pairs.iter();
            pairs
                .map(|pair| pair.map(|number| number.saturating_sub(1)))
                .collect()
        };
        NetOptions {
            room: self.room(),
            cut: numbered(&self.own.cut),
            join: numbered(&self.own.join),
        }
    }

    /// Width and height, in the mesh's units, that a sheet may have to lie on one page with its tabs.
    fn room(&self) -> Option<[f64; 2]> {
        let beside =
            2.0 * (self.drawing.tabs.unwrap_or(0.0) + self.drawing.allowance + self.drawing.kerf);
        let sides = (self.own.stock?)
            .room()?
            .map(|side| (side - beside) / self.drawing.scale);
        Some(sides)
    }

    fn lay_flat(&self, surface: Shape) -> Result<Pattern> {
        let options = FlatOptions {
            patches: self.patches,
            sheets: self.sheets,
            net: self.net_options(),
            exact: self.own.exact,
            faces: self.own.faces,
        };
        Ok(lay_flat(surface, &options)?)
    }

    /// Lays a surface flat and draws its sheets; returns JavaScript's `Drawing` object, with the assembly if it is wanted.
    fn draw(&self, surface: Shape) -> Result<JsValue> {
        let found = self.lay_flat(surface)?;
        let (drawn, sheets) = (Drawing::of(&found, &self.drawing)?, &found.sheets);
        let drawn = match self.own.stock {
            Some(stock) => drawn.onto(stock)?,
            None => drawn,
        };
        let value = to_value(&drawn)?;
        if self.own.assembly {
            let assembly = Assembly::new(sheets);
            let whole = to_value(&assembly)?;
            let model = write_animation(sheets, &assembly, self.drawing.scale)?;
            let picture = write_assembly_svg(sheets)?;
            set(&whole, "model", &Uint8Array::from(&model[..]))?;
            set(&whole, "picture", &Uint8Array::from(&picture[..]))?;
            let all = Joined::of(sheets);
            let positions = Float64Array::from(all.positions.as_flattened());
            set(&whole, "positions", &positions)?;
            let triangles = Uint32Array::from(all.triangles.as_flattened());
            set(&whole, "triangles", &triangles)?;
            set(&whole, "sheets", &Uint32Array::from(&all.sheets[..]))?;
            set(&value, "assembly", &whole)?;
        }
        Ok(value)
    }
}

/// Cuts heights into flat sheets and draws them; returns JavaScript's `Drawing` object.
#[wasm_bindgen(js_name = pattern)]
pub fn draw_pattern(field: JsValue, options: JsValue) -> Result<JsValue> {
    let wanted = Wanted::of(&field, &options)?;
    check_spacing(wanted.own.spacing, is_image(&field)?)?;
    let surface = Scene::new(field, wanted.own.spacing)?.surface;
    wanted.draw(Shape::Heights(&surface))
}

/// Values of λ and of the minimum patch size that an exploration tries, read from JavaScript; or only the λ that suits
/// a mesh's noise, from which they are chosen.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct TrialsInput {
    lambdas: Option<Vec<f64>>,
    smallest: Option<Vec<f64>>,
    mesh_lambda: Option<f64>,
}

#[derive(Serialize)]
struct TrialsOutput {
    lambdas: Vec<f64>,
    smallest: Vec<f64>,
}

/// Returns the values of λ and of the minimum patch size of an exploration, which makes a pattern for each pair, in the
/// order in which they are tried.
#[wasm_bindgen]
pub fn trials(given: JsValue) -> Result<JsValue> {
    let given: TrialsInput = read(&given)?;
    let default = given
        .mesh_lambda
        .map_or_else(Trials::default, Trials::for_mesh);
    let Trials { lambdas, smallest } = Trials {
        lambdas: given.lambdas.unwrap_or(default.lambdas),
        smallest: given.smallest.unwrap_or(default.smallest),
    }
    .in_order();
    Ok(to_value(&TrialsOutput { lambdas, smallest })?)
}

/// Cuts a whole mesh into flat sheets and draws them; returns JavaScript's `Drawing` object.
#[wasm_bindgen(js_name = patternMesh)]
pub fn draw_pattern_of_mesh(mesh: JsValue, options: JsValue) -> Result<JsValue> {
    let mut wanted = Wanted::of(&mesh, &options)?;
    let mut mesh = from_value::<MeshInput>(mesh)?.into_mesh()?;
    wanted.scale_to(&mesh)?;
    if wanted.own.blank {
        let metal = sheet_metal(&mesh)?.ok_or_else(|| Failure {
            code: "UNSUPPORTED",
            message: "no sheet metal was recognised, which has two parallel skins at a constant distance: leave out `blank`".into(),
        })?;
        wanted.set_thickness(metal.thickness * wanted.drawing.scale);
        mesh = metal.skin;
    }
    wanted.draw(Shape::Mesh(&mesh))
}

/// What a mesh is.
#[derive(Serialize, Default)]
#[serde(rename = "RecognizedMesh")]
struct RecognizedOutput {
    /// Whether a fit gains anything, and how the mesh is laid flat without one.
    kind: MeshKind,
    /// Thickness of a solid of sheet metal, in the mesh's unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    thickness: Option<f64>,
    /// Number of the flat faces of a mesh with noise.
    #[serde(skip_serializing_if = "Option::is_none")]
    faces: Option<usize>,
    /// Standard deviation of the vertices from these faces, in the mesh's unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    noise: Option<f64>,
}

/// Recognises exact and noisy meshes, and solids of sheet metal; returns JavaScript's `RecognizedMesh` object.
#[wasm_bindgen(js_name = recognizeMesh)]
pub fn recognize_mesh(mesh: JsValue) -> Result<JsValue> {
    let mesh = from_value::<MeshInput>(mesh)?.into_mesh()?;
    let RecognizedMesh { kind, faces, .. } = RecognizedMesh::of(&mesh)?;
    let mut found = RecognizedOutput {
        kind,
        ..RecognizedOutput::default()
    };
    match kind {
        MeshKind::Faces | MeshKind::Bends => {
            found.thickness = sheet_metal(&mesh)?.map(|metal| metal.thickness);
        }
        MeshKind::NoisyFaces => {
            (found.faces, found.noise) = faces.map(|faces| (faces.count, faces.noise)).unzip();
        }
        _ => {}
    }
    Ok(to_value(&found)?)
}

/// Patches of a mesh (regions without a crease inside), that with the largest area first, and the creases between them.
#[derive(Serialize)]
#[serde(rename = "MeshPatchMap")]
struct PatchesOutput<'a> {
    /// Number of the patch of each triangle of the mesh, −1 for none.
    #[serde(with = "preserve")]
    labels: Int32Array,
    /// The patches, in the order of their numbers.
    patches: &'a [Patch],
    /// The creases between the patches.
    creases: &'a [Crease],
    /// Angle between neighbouring triangles, in radians, above which an edge counted as part of a crease.
    bend: f64,
}

/// Segments a mesh into patches and finds the creases between them; returns JavaScript's `MeshPatchMap` object.
#[wasm_bindgen(js_name = patches)]
pub fn patches_of_mesh(mesh: JsValue, options: JsValue) -> Result<JsValue> {
    let wanted: PatchOptions = read(&options)?;
    let mesh = from_value::<MeshInput>(mesh)?.into_mesh()?;
    let found = MeshPatches::new(&mesh, &wanted)?;
    // In JavaScript the label of no patch is −1.
    let labels: Vec<i32> = found.labels().iter().map(|label| *label as i32).collect();
    Ok(to_value(&PatchesOutput {
        labels: labels.as_slice().into(),
        patches: found.patches(),
        creases: found.creases(),
        bend: found.bend(),
    })?)
}

/// Sheets of a mesh laid flat, one to the right of the other, seen from the side that the triangles face. They have more vertices than the mesh, since it is cut.
#[derive(Serialize)]
#[serde(rename = "MeshUnrolling")]
struct UnrollingOutput<'a> {
    /// Coordinates x, y, z of each vertex of the sheets on the mesh, in the mesh's unit of length.
    #[serde(with = "preserve")]
    positions: Float64Array,
    /// Coordinates x, y of each vertex of the sheets in one plane, where the sheets lie side by side, in the mesh's unit of length; y points up.
    #[serde(with = "preserve")]
    places: Float64Array,
    /// Three vertices of the sheets for each of their triangles, counted from 0, counter-clockwise.
    #[serde(with = "preserve")]
    triangles: Uint32Array,
    /// Number of the sheet of each vertex, from 0.
    #[serde(with = "preserve")]
    sheets: Uint32Array,
    /// The two singular values of each triangle's map from the mesh to the plane, the larger one first.
    #[serde(with = "preserve")]
    stretches: Float64Array,
    /// The patches of the sheets, that with the largest area first.
    patches: &'a [Patch],
    /// The creases and cuts between the patches.
    creases: &'a [Crease],
    /// Measures of the sheets: number, area, strain and gaps at folds, and what is on no sheet.
    report: UnrollingReport,
}

/// Measures of a mesh laid flat.
#[derive(Serialize)]
#[serde(rename = "MeshUnrollingReport", rename_all = "camelCase")]
struct UnrollingReport {
    /// Number of sheets.
    sheets: usize,
    /// Area of the sheets, in the mesh's unit squared.
    area: f64,
    /// Root mean square strain of the worst sheet, as a share.
    strain: f64,
    /// Root mean square distance between the two sides of a fold, in the mesh's unit of length, of the worst sheet.
    seam_gap: f64,
    /// Parts of the mesh that cannot be laid flat and are on no sheet; all 0 if there are none.
    missing: Missing,
    /// The flat faces that stand for the mesh, if no cut lays it flat or so few are wanted; the distance in the mesh's unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    simplified: Option<Simplified>,
}

/// Lays a mesh flat, as its pattern, and its sheets side by side; returns JavaScript's `MeshUnrolling` object.
#[wasm_bindgen(js_name = unroll)]
pub fn unroll_mesh(mesh: JsValue, options: JsValue) -> Result<JsValue> {
    let wanted = Wanted::of(&mesh, &options)?;
    let mesh = from_value::<MeshInput>(mesh)?.into_mesh()?;
    let found = wanted.lay_flat(Shape::Mesh(&mesh))?;
    let all = Joined::of(&found.sheets);
    let (mut places, mut right) = (Vec::new(), 0.0);
    for sheet in &found.sheets {
        let xs = sheet.faces.flat.iter().map(|[x, _]| *x);
        let (low, high) = (
            xs.clone().fold(f64::INFINITY, f64::min),
            xs.fold(f64::NEG_INFINITY, f64::max),
        );
        places.extend(sheet.faces.flat.iter().map(|[x, y]| [x - low + right, *y]));
        right += high - low + sheet.spacing;
    }
    let stretches: Vec<_> = (found.sheets.iter())
        .flat_map(|sheet| sheet.faces.stretches())
        .collect();
    let most = |of: fn(&Sheet) -> f64| found.sheets.iter().map(of).fold(0.0, f64::max);
    Ok(to_value(&UnrollingOutput {
        positions: all.positions.as_flattened().into(),
        places: places.as_flattened().into(),
        triangles: all.triangles.as_flattened().into(),
        sheets: all.sheets.as_slice().into(),
        stretches: stretches.as_flattened().into(),
        patches: &found.patches,
        creases: &found.creases,
        report: UnrollingReport {
            sheets: found.sheets.len(),
            area: found.sheets.iter().map(|sheet| sheet.area).sum(),
            strain: most(|sheet| sheet.strain),
            seam_gap: most(|sheet| sheet.seam_gap),
            missing: found.missing,
            simplified: found.simplified,
        },
    })?)
}

/// The triangles of all sheets as one mesh, where they are on the surface.
struct Joined {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// Number of the sheet of each vertex.
    sheets: Vec<u32>,
}

impl Joined {
    fn of(all: &[Sheet]) -> Self {
        let (mut positions, mut triangles, mut sheets) = (Vec::new(), Vec::new(), Vec::new());
        for (number, Sheet { faces, .. }) in (0u32..).zip(all) {
            let first = positions.len() as u32;
            positions.extend(&faces.built);
            triangles.extend(faces.triangles.iter().map(|t| t.map(|v| v + first)));
            sheets.resize(positions.len(), number);
        }
        Joined {
            positions,
            triangles,
            sheets,
        }
    }
}

/// Reads the bending parameters of sheet metal: thickness, inner radius and k-factor. None without a thickness.
fn bending(
    thickness: Option<f64>,
    radius: Option<f64>,
    factor: Option<f64>,
) -> Result<Option<Bending>> {
    let Some(thickness) = thickness else {
        return match radius.or(factor) {
            None => Ok(None),
            Some(_) => Err(Failure {
                code: "OPTION",
                message: "options `innerRadius` and `kFactor` are about bent metal: give the option `thickness`, too".into(),
            }),
        };
    };
    let metal = Bending::new(thickness);
    let metal = metal.radius(radius.unwrap_or(metal.radius));
    Ok(Some(metal.k_factor(factor.unwrap_or(metal.k_factor))))
}

fn set(object: &JsValue, name: &str, value: &JsValue) -> Result<()> {
    // A plain object takes what it is given.
    Reflect::set(object, &name.into(), value).map_err(|error| Failure {
        code: "INPUT",
        message: format!("{error:?}"),
    })?;
    Ok(())
}

/// Writes a drawing to an SVG file.
#[wasm_bindgen(js_name = writeSvg)]
pub fn write_svg_file(drawing: JsValue, options: JsValue) -> Result<Uint8Array> {
    let FileInput { title, .. } = read(&options)?;
    let textures = Textures::of(&drawing)?;
    let svg = write_svg(&drawn(drawing)?, title.as_deref(), &textures.files())?;
    Ok(svg.as_slice().into())
}

/// A texture from JavaScript: a JPEG file of three channels.
#[derive(Deserialize)]
struct TextureInput {
    #[serde(with = "preserve")]
    jpeg: Uint8Array,
    width: u32,
    height: u32,
}

/// The textures of a drawing: files, with width and height in pixels.
struct Textures(Vec<(Vec<u8>, [u32; 2])>);

impl Textures {
    fn of(drawing: &JsValue) -> Result<Textures> {
        let given = Reflect::get(drawing, &"textures".into()).unwrap_or_default();
        let given: Option<Vec<TextureInput>> = from_value(given).map_err(|error| Failure {
            code: "INPUT",
            message: format!(
                "the drawing's textures must be JPEG files with width and height: {error}"
            ),
        })?;
        let copied = |own: TextureInput| (own.jpeg.to_vec(), [own.width, own.height]);
        let textures = given.unwrap_or_default().into_iter();
        Ok(Textures(textures.map(copied).collect()))
    }

    fn files(&self) -> Vec<TextureFile<'_>> {
        let files = self.0.iter();
        files
            .map(|(jpeg, size)| TextureFile { jpeg, size: *size })
            .collect()
    }
}

/// Options of writing an SVG or a PDF file: JavaScript's `WriteSvgOptions` or `WritePdfOptions` object.
#[derive(Default, Deserialize)]
#[serde(default)]
struct FileInput {
    stock: Option<Stock>,
    title: Option<String>,
}

/// Writes a drawing to a PDF file, on one page, or on pages of the option `stock`.
#[wasm_bindgen(js_name = writePdf)]
pub fn write_pdf_file(drawing: JsValue, options: JsValue) -> Result<Uint8Array> {
    let FileInput { stock, title } = read(&options)?;
    let textures = Textures::of(&drawing)?;
    let files = textures.files();
    let options = PdfOptions::default()
        .stock(stock)
        .title(title.as_deref())
        .textures(&files);
    Ok(write_pdf(&drawn(drawing)?, &options)?.as_slice().into())
}

/// Writes a drawing to a DXF file.
#[wasm_bindgen(js_name = writeDxf)]
pub fn write_dxf_file(drawing: JsValue) -> Result<Uint8Array> {
    Ok(write_dxf(&drawn(drawing)?)?.as_slice().into())
}

/// Reads a drawing from JavaScript's `Drawing` object, which must be unchanged.
fn drawn(drawing: JsValue) -> Result<Drawing> {
    from_value(drawing).map_err(|_| Failure {
        code: "INPUT",
        message: "the drawing must be one that `pattern` gave, with nothing taken out or changed"
            .into(),
    })
}
