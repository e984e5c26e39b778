//! Solver for whole meshes, which fits surfaces in space without a view, and their curvatures and rulings.

use js_sys::{Float64Array, Uint8Array};
use serde::{Deserialize, Serialize};
use serde_wasm_bindgen::{from_value, preserve, to_value};
use wasm_bindgen::prelude::*;

use developable::analysis::{DEFAULT_GAUSSIAN_THRESHOLD, MeshCurvatures, Summary};
use developable::rulings::{Ruling, Rulings, TraceOptions};
use developable::{MeshKnown, MeshOptions, MeshReport, Status};
use developable_wasm::Result;
use developable_wasm::arrays::groups;
use developable_wasm::bytes::copied;
use developable_wasm::mesh::MeshInput;
use developable_wasm::options::{OptionReader, read};

/// Positions of a fitted surface's vertices and the report, written as fields of JavaScript's `MeshSurface` object; the
/// rest of the mesh stays as it was.
#[derive(Serialize)]
struct Output<'a> {
    #[serde(with = "preserve")]
    positions: Float64Array,
    report: &'a MeshReport,
}

/// The option of a fit that marks vertices which keep their positions: a `Uint8Array`, or `undefined` for none.
#[derive(Default, Deserialize)]
#[serde(default)]
struct HeldInput {
    #[serde(with = "preserve")]
    held: JsValue,
}

/// A solve over a whole mesh that runs in steps, so that JavaScript can show progress and cancel it.
#[wasm_bindgen]
pub struct MeshSolver {
    solver: developable::MeshSolver,
}

#[wasm_bindgen]
impl MeshSolver {
    /// Makes a solver for a whole mesh. The option `held` marks vertices that keep their positions.
    #[wasm_bindgen(js_name = onMesh)]
    pub fn on_mesh(mesh: JsValue, options: JsValue) -> Result<MeshSolver> {
        let mesh = from_value::<MeshInput>(mesh)?;
        let mut known = MeshKnown::default();
        if let Some(confidence) = groups::<1>(&mesh.confidence)? {
            let confidence = confidence.as_flattened().iter().map(|c| f64::from(*c));
            known = known.with_confidence(confidence.collect())?;
        }
        let mesh = mesh.into_mesh()?;
        let mut reader = OptionReader::new(&options)?;
        let settings: MeshOptions = reader.read()?;
        let HeldInput { held } = reader.read()?;
        reader.finish()?;
        if let Some(held) = held.dyn_ref::<Uint8Array>() {
            let held = copied(held)?;
            known = known.with_held(held.into_iter().map(|held| held != 0).collect());
        }
        Ok(MeshSolver {
            solver: developable::MeshSolver::new(mesh, known, &settings)?,
        })
    }

    /// Runs about `work` conjugate-gradient iterations; returns whether the solve is still running.
    pub fn advance(&mut self, work: usize) -> Result<bool> {
        Ok(self.solver.advance(work)? == Status::Running)
    }

    /// Returns the progress of the fit as a JavaScript object.
    pub fn progress(&self) -> Result<JsValue> {
        Ok(to_value(&self.solver.progress())?)
    }

    /// Stops a running solve; its surface is then that of the pass under way.
    pub fn cancel(&mut self) -> Result<()> {
        Ok(self.solver.cancel()?)
    }

    /// Returns the surface after the last finished pass, or as it was when the solve was cancelled: positions of its vertices, and
    /// the report.
    pub fn surface(&self) -> Result<JsValue> {
        let surface = self.solver.surface()?;
        Ok(to_value(&Output {
            positions: surface.mesh().positions().as_flattened().into(),
            report: surface.report(),
        })?)
    }
}

/// Curvatures at the vertices of a mesh, positive where it bends as a ball does and NaN where triangles do not surround a vertex, with their statistics.
#[derive(Serialize)]
#[serde(rename = "MeshAnalysis", rename_all = "camelCase")]
struct AnalysisOutput {
    /// Gaussian curvature at each vertex: angle deficit divided by the vertex's share of the area, in the surface's unit of length to the power −2.
    #[serde(with = "preserve")]
    gaussian: Float64Array,
    /// Principal curvature of larger magnitude at each vertex, in the inverse of the surface's unit of length.
    #[serde(with = "preserve")]
    kappa1: Float64Array,
    /// Principal curvature of smaller magnitude at each vertex; 0 on a developable surface.
    #[serde(with = "preserve")]
    kappa2: Float64Array,
    /// Density of the energy at each vertex, `|kappa1| + |kappa2|`.
    #[serde(with = "preserve")]
    nuclear_norm: Float64Array,
    /// Unit vector x, y, z at each vertex along which the mesh bends by `kappa2`, up to its sign; `rulings` gives smoothed directions.
    #[serde(with = "preserve")]
    rulings: Float64Array,
    /// Statistics of the curvatures. `size` is the diameter of the mesh's bounding sphere, and the sum of nuclear norms is weighted by area.
    summary: Summary,
}

/// Options of an analysis: JavaScript's `MeshAnalyzeOptions` object.
#[derive(Default, Deserialize)]
#[serde(default)]
struct ThresholdInput {
    threshold: Option<f64>,
}

/// Computes curvatures at a mesh's vertices, and statistics that say how developable the mesh is.
#[wasm_bindgen(js_name = analyze)]
pub fn analyze_mesh(mesh: JsValue, options: JsValue) -> Result<JsValue> {
    let ThresholdInput { threshold } = read(&options)?;
    let mesh = from_value::<MeshInput>(mesh)?.into_mesh()?;
    let found = MeshCurvatures::new(&mesh)?;
    Ok(to_value(&AnalysisOutput {
        summary: found.summary(&mesh, threshold.unwrap_or(DEFAULT_GAUSSIAN_THRESHOLD))?,
        gaussian: found.gaussian.as_slice().into(),
        kappa1: found.kappa1.as_slice().into(),
        kappa2: found.kappa2.as_slice().into(),
        nuclear_norm: found.nuclear_norm.as_slice().into(),
        rulings: found.rulings.as_flattened().into(),
    })?)
}

/// Rulings of a mesh: the directions in which it does not bend, and lines along them.
#[derive(Serialize)]
#[serde(rename = "MeshRulings")]
struct RulingsOutput<'a> {
    /// Unit vector x, y, z along the ruling at each vertex, up to its sign; NaN where triangles do not surround the vertex.
    #[serde(with = "preserve")]
    directions: Float64Array,
    /// Confidence in the direction at each vertex, from 0 to 1.
    #[serde(with = "preserve")]
    confidence: Float64Array,
    /// Traced rulings, each with a point on every edge that it crosses.
    lines: &'a [Ruling],
}

/// Computes the rulings (straight lines in the surface) of a mesh: a direction at each vertex, and traced lines.
#[wasm_bindgen(js_name = rulings)]
pub fn mesh_rulings(mesh: JsValue, options: JsValue) -> Result<JsValue> {
    let wanted: TraceOptions = read(&options)?;
    let mesh = from_value::<MeshInput>(mesh)?.into_mesh()?;
    let found = Rulings::new(&mesh)?;
    Ok(to_value(&RulingsOutput {
        directions: found.directions().as_flattened().into(),
        confidence: found.confidence().into(),
        lines: &found.trace(&wanted)?,
    })?)
}
