//! The animation of an assembly as glTF 2.0 in one binary file (GLB): a node for each sheet, which moves to its
//! place while a morph target bends it. (Khronos Group, glTF 2.0 Specification, "Animations", "Morph Targets".)

use super::colour;
use crate::assembly::{Assembly, Pose};
use crate::drawing::beside;
use crate::error::{Error, Result, positive};
use crate::files::failure::unsupported;
use crate::files::glb::{GlbFile, list};
use crate::pattern::Sheet;

/// Duration of one step of the assembly animation, in seconds.
const STEP_SECONDS: f64 = 1.5;

/// Pause between two steps of the assembly animation, in seconds.
const STEP_PAUSE_SECONDS: f64 = 0.5;

/// Writes a GLB file of the assembly: sheets that lie flat beside the surface move to their places one after the other,
/// in the assembly's order, and bend as they move. The file is in metres, with +y up, as viewers expect; `scale` is the
/// number of millimetres in a unit of the surface. The animation is called `Assembly`; at its end the surface is built.
///
/// Halfway a sheet's shape and size are between those at both ends, because morph targets are linear.
///
/// # Errors
/// [`Error::Empty`] without a sheet, [`Error::Option`] for a scale that is not positive and finite,
/// [`Error::Unsupported`] for vertices that are not finite and from 4 GiB.
pub fn write_animation(sheets: &[Sheet], assembly: &Assembly, scale: f64) -> Result<Vec<u8>> {
    let scale = positive("scale", scale)?;
    if sheets.is_empty() {
        return Err(Error::Empty { what: "pattern" });
    }
    let finite = |sheet: &Sheet| {
        let built = sheet.faces.built.iter().flatten();
        (built.chain(sheet.faces.flat.iter().flatten())).all(|v| (scale * v).abs() < 1e30)
    };
    if let Some(number) = sheets.iter().position(|sheet| !finite(sheet)) {
        return Err(unsupported(
            "pattern",
            format!("a vertex of sheet {} is not finite", number + 1),
        ));
    }
    let mut file = File::default();
    let places = beside(&in_millimetres(sheets, scale));
    let ground = FlatPlace::from_sheets(sheets);
    let sizes = scale / 1000.0;
    for (step, part) in assembly.steps.iter().enumerate() {
        let Some(sheet) = sheets.get(part.sheet) else {
            continue;
        };
        let (turn, shift) = places[part.sheet];
        let moved = SheetMotion::new(sheet, turn, shift.map(|v| v / scale), &ground);
        file.sheet(
            part.sheet,
            sheet,
            &moved,
            step as f64 * (STEP_SECONDS + STEP_PAUSE_SECONDS),
            sizes,
        )?;
    }
    file.finish()
}

fn in_millimetres(sheets: &[Sheet], scale: f64) -> Vec<Vec<Vec<[f64; 2]>>> {
    let lines = |sheet: &Sheet| {
        let outlines = sheet.outlines.iter().map(|runs| {
            let points = runs.iter().flat_map(|run| &run.points);
            points.map(|p| p.map(|v| scale * v)).collect()
        });
        outlines.collect()
    };
    sheets.iter().map(lines).collect()
}

/// Place of the flat sheets before they move, in the surface's units: to the left of the surface, at the height of the
/// surface's lowest point.
struct FlatPlace {
    corner: [f64; 2],
    height: f64,
    width: f64,
}

impl FlatPlace {
    fn from_sheets(sheets: &[Sheet]) -> Self {
        let built = || sheets.iter().flat_map(|sheet| &sheet.faces.built);
        let low = |k: usize| built().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let high = built().map(|p| p[0]).fold(f64::NEG_INFINITY, f64::max);
        FlatPlace {
            corner: [low(0), low(1)],
            height: low(2),
            width: high - low(0),
        }
    }
}

/// The motion of a sheet in the assembly animation: the sheet's centre on the flat sheet, and the poses before and
/// after the motion.
struct SheetMotion {
    middle: [f64; 2],
    start: Pose,
    end: Pose,
}

impl SheetMotion {
    fn new(sheet: &Sheet, [cos, sin]: [f64; 2], shift: [f64; 2], ground: &FlatPlace) -> Self {
        let flat = &sheet.faces.flat;
        let count = flat.len().max(1) as f64;
        let middle = [0, 1].map(|k| flat.iter().map(|p| p[k]).sum::<f64>() / count);
        let [x, y] = middle;
        let laid = [cos * x - sin * y + shift[0], sin * x + cos * y + shift[1]];
        let half = 0.5 * sin.atan2(cos);
        SheetMotion {
            middle,
            start: Pose {
                turn: [0.0, 0.0, half.sin(), half.cos()],
                shift: [
                    ground.corner[0] + 1.1 * ground.width + laid[0],
                    ground.corner[1] + laid[1],
                    ground.height,
                ],
            },
            end: Pose::of(&sheet.faces, middle),
        }
    }
}

/// A GLB file of an animation that is being written, and the lists of its text.
#[derive(Default)]
struct File {
    glb: GlbFile,
    meshes: Vec<String>,
    nodes: Vec<String>,
    materials: Vec<String>,
    samplers: Vec<String>,
    channels: Vec<String>,
}

impl File {
    fn sheet(
        &mut self,
        number: usize,
        sheet: &Sheet,
        moved: &SheetMotion,
        time: f64,
        scale: f64,
    ) -> Result<()> {
        let index = self.meshes.len();
        let faces = &sheet.faces;
        let place = |p: [f64; 3]| p.map(|v| (scale * v) as f32);
        let flat: Vec<[f32; 3]> = (faces.flat.iter())
            .map(|p| place([p[0] - moved.middle[0], p[1] - moved.middle[1], 0.0]))
            .collect();
        let bent = faces.built.iter().map(|p| place(moved.end.back(*p)));
        let bends: Vec<[f32; 3]> = (bent.zip(&flat))
            .map(|(p, q)| std::array::from_fn(|k| p[k] - q[k]))
            .collect();
        let position = self.glb.floats(&flat, true)?;
        let target = self.glb.floats(&bends, true)?;
        let indices = self.glb.indices(&faces.triangles)?;
        let [r, g, b] = colour(number).map(|v| linear(f64::from(v) / 255.0));
        self.materials.push(format!(
            r#"{{"doubleSided":true,"pbrMetallicRoughness":{{"baseColorFactor":[{r:.4},{g:.4},{b:.4},1],"metallicFactor":0,"roughnessFactor":0.8}}}}"#
        ));
        self.meshes.push(format!(
            r#"{{"name":"Sheet {0}","weights":[0],"primitives":[{{"attributes":{{"POSITION":{position}}},"indices":{indices},"material":{index},"targets":[{{"POSITION":{target}}}]}}]}}"#,
            number + 1
        ));
        let [start, end] = [&moved.start, &moved.end].map(|pose| place(pose.shift));
        let turns = [&moved.start, &moved.end].map(|pose| pose.turn.map(|v| v as f32));
        self.nodes.push(format!(
            r#"{{"name":"Sheet {}","mesh":{index},"translation":{},"rotation":{}}}"#,
            number + 1,
            list(&start),
            list(&turns[0])
        ));
        let times = [[time as f32], [(time + STEP_SECONDS) as f32]];
        let input = self.glb.floats(&times, true)?;
        for (path, output) in [
            ("translation", self.glb.floats(&[start, end], false)?),
            ("rotation", self.glb.floats(&turns, false)?),
            ("weights", self.glb.floats(&[[0.0], [1.0]], false)?),
        ] {
            // The root is the first node.
            let (sampler, node) = (self.samplers.len(), index + 1);
            self.samplers
                .push(format!(r#"{{"input":{input},"output":{output}}}"#));
            self.channels.push(format!(
                r#"{{"sampler":{sampler},"target":{{"node":{node},"path":"{path}"}}}}"#
            ));
        }
        Ok(())
    }

    fn finish(self) -> Result<Vec<u8>> {
        let join = |parts: &[String]| parts.join(",");
        let sheets: Vec<String> = (1..=self.meshes.len()).map(|n| n.to_string()).collect();
        // Heights point along +z here.
        self.glb.finish(&format!(
            r#""scenes":[{{"nodes":[0]}}],"nodes":[{{"name":"Pattern","rotation":[-0.70710677,0,0,0.70710677],"children":[{}]}},{}],"meshes":[{}],"materials":[{}],"animations":[{{"name":"Assembly","samplers":[{}],"channels":[{}]}}]"#,
            join(&sheets),
            join(&self.nodes),
            join(&self.meshes),
            join(&self.materials),
            join(&self.samplers),
            join(&self.channels),
        ))
    }
}

/// Converts an sRGB colour value from 0 to 1 to linear light.
fn linear(value: f64) -> f64 {
    match value <= 0.04045 {
        true => value / 12.92,
        false => ((value + 0.055) / 1.055).powf(2.4),
    }
}
