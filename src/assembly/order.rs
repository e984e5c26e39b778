//! Finds the order in which the sheets of a pattern are put together.

use std::collections::BTreeMap;

use crate::drawing::letters;
use crate::pattern::Sheet;

/// The order in which the sheets of a pattern are put together.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename = "AssemblyOrder")
)]
#[non_exhaustive]
pub struct Assembly {
    /// Steps in which the sheets are put together, one for each sheet. The first sheet is the one with the largest
    /// patch; each next one has the longest seams to the sheets already in place.
    pub steps: Vec<Step>,
}

/// One step of the assembly: a sheet, and the seams that join it to the sheets of earlier steps or to itself.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename = "AssemblyStep")
)]
#[non_exhaustive]
pub struct Step {
    /// Number of the sheet that is added in this step, counted from 0; names of sheets count from 1.
    pub sheet: usize,
    /// Seams that are joined in this step, the longest first.
    pub joints: Vec<Joint>,
}

/// A seam that is joined in a step of the assembly: between two sheets, or of a sheet with itself.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename = "AssemblyJoint")
)]
#[non_exhaustive]
pub struct Joint {
    /// Name of the seam on the drawing: one or more letters.
    pub name: String,
    /// Number of the sheet already in place that the seam leads to; for a seam of the sheet with itself, the number
    /// of that sheet.
    pub to: usize,
    /// Length of the seam, in the surface's units.
    pub length: f64,
}

impl Assembly {
    /// Finds the order in which a pattern's sheets are joined. Costs `O(sheets² + runs)`, runs being the pieces of
    /// outlines.
    pub fn new(sheets: &[Sheet]) -> Self {
        Assembly {
            steps: assembly_steps(sheets, &letters(sheets)),
        }
    }
}

/// For each crease the sheets on its two sides, each with the length of the seam on that sheet.
type Seams = BTreeMap<usize, Vec<(usize, f64)>>;

fn assembly_steps(sheets: &[Sheet], letters: &BTreeMap<usize, String>) -> Vec<Step> {
    let mut seams: Seams = BTreeMap::new();
    for (number, sheet) in sheets.iter().enumerate() {
        for run in sheet.outlines.iter().flatten() {
            if let Some(seam) = run.seam {
                let pieces = run.points.windows(2);
                let long = pieces
                    .map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]))
                    .sum();
                seams.entry(seam.crease).or_default().push((number, long));
            }
        }
    }
    let mut there = vec![false; sheets.len()];
    let mut steps = Vec::new();
    for _ in 0..sheets.len() {
        let joints = |sheet: usize| joints(&seams, letters, &there, sheet);
        let reach = |sheet: usize| -> f64 {
            let others = joints(sheet).into_iter().filter(|joint| joint.to != sheet);
            others.map(|joint| joint.length).fold(0.0, |a, b| a + b)
        };
        // Of several with equal length take the first one, which has the larger patch.
        let left = (0..sheets.len()).filter(|sheet| !there[*sheet]).rev();
        let Some(sheet) = left.max_by(|a, b| reach(*a).total_cmp(&reach(*b))) else {
            break;
        };
        let joints = joints(sheet);
        there[sheet] = true;
        steps.push(Step { sheet, joints });
    }
    steps
}

/// Lists the seams of a sheet with the sheets already in place and with itself, the longest first.
fn joints(
    seams: &Seams,
    letters: &BTreeMap<usize, String>,
    there: &[bool],
    sheet: usize,
) -> Vec<Joint> {
    let mut out = Vec::new();
    for (crease, sides) in seams {
        let own: Vec<f64> = sides.iter().filter(|s| s.0 == sheet).map(|s| s.1).collect();
        let other = sides.iter().find(|(other, _)| there[*other]);
        let length: f64 = own.iter().sum();
        let (to, length) = match (own.len(), other) {
            (0, _) => continue,
            (_, Some((other, _))) => (*other, length),
            // Both sides of the seam belong to this sheet.
            (2.., None) => (sheet, 0.5 * length),
            _ => continue,
        };
        let name = letters.get(crease).cloned().unwrap_or_default();
        out.push(Joint { name, to, length });
    }
    out.sort_by(|a, b| b.length.total_cmp(&a.length));
    out
}
