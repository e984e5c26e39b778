//! Sheets as they are drawn: their outlines, folds and places to write on.

use super::body::Body;
use super::join::Joined;
use super::lay::FlatPart;
use super::meeting::Meetings;
use super::seams::Seams;
use crate::error::Result;
use crate::pattern::crumbs::remove_crumbs;
use crate::pattern::shape::{MIN_OUTLINE_AREA, drop_empty_lines};
use crate::pattern::spots::label_spot;
use crate::pattern::{Direction, Faces, Fold, Missing, Run, Seam, Sheet};
use crate::scene::half_edges::half_edge_ends;
use crate::shape::patches::{Crease, Patch};

/// Minimum area of a closed line around a sheet that follows the mesh's own border, as a share of the sheet's area; far
/// below any triangle's.
const MIN_OUTLINE_SHARE: f64 = 1e-6;

/// A mesh cut into flat sheets.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshPattern {
    /// The sheets; the first is the one with the largest patch. They are seen from outside, the side that the
    /// mesh's triangles face.
    pub sheets: Vec<Sheet>,
    /// The patches of the sheets, the largest area first: the connected components of the patches that were given,
    /// or the parts that these were cut into.
    pub patches: Vec<Patch>,
    /// The creases between the patches, with the cuts inside of patches among them.
    pub creases: Vec<Crease>,
    /// Vertices and area of the mesh that are on no sheet.
    pub missing: Missing,
}

pub(super) fn draw_sheets(
    body: &Body,
    seams: &Seams,
    sheets: &[Joined],
    mut missing: Missing,
) -> Result<MeshPattern> {
    let creases = seams.all.iter().map(|seam| Crease {
        patches: seam.parts,
        points: (seam.vertices.iter())
            .map(|v| body.places[*v as usize].into())
            .collect(),
        length: seam.length,
        fold: seam.angle.abs(),
    });
    let meetings = Meetings::new(body, seams, sheets);
    let mut sheets: Vec<Sheet> = sheets
        .iter()
        .map(|sheet| draw(body, seams, &meetings, sheet))
        .collect();
    let patches = patches(body);
    remove_crumbs(&mut sheets, &patches, &mut missing, |_| false);
    sheets.sort_by_key(|sheet| sheet.patches[0]);
    Ok(MeshPattern {
        sheets,
        patches,
        creases: creases.collect(),
        missing,
    })
}

fn patches(body: &Body) -> Vec<Patch> {
    let mut found = vec![(Vec::<u32>::new(), 0.0); body.count as usize];
    for (part, corners) in body.parts.iter().zip(&body.triangles) {
        let [a, b, c] = corners.map(|v| body.places[v as usize]);
        let (vertices, area) = &mut found[*part as usize];
        vertices.extend(corners);
        *area += 0.5 * (b - a).cross(&(c - a)).norm();
    }
    let counted = found.into_iter().map(|(mut vertices, area)| {
        vertices.sort_unstable();
        vertices.dedup();
        Patch {
            vertices: vertices.len(),
            area,
        }
    });
    counted.collect()
}

fn draw(body: &Body, seams: &Seams, meetings: &Meetings, sheet: &Joined) -> Sheet {
    let laid = &sheet.laid;
    let seam = |number: usize| {
        let own = &seams.all[number];
        Seam {
            crease: number,
            patches: own.parts,
            direction: match own.angle >= 0.0 {
                true => Direction::Mountain,
                false => Direction::Valley,
            },
            angle: own.angle.abs(),
            slit: own.smooth,
            torn: false,
        }
    };
    let place = |vertex: u32| {
        let place = laid.places[vertex as usize];
        [place.re, place.im]
    };
    // A cut that is within the sheet and hardly opens is no outline, but a hole of the mesh is, however small.
    let mut lines = laid.outlines();
    let is_cut = |side: &u32| {
        let member = laid.members[*side as usize / 3];
        seams.of(3 * member + side % 3).is_some()
    };
    let least = |line: &Vec<u32>| match line.iter().all(is_cut) {
        true => MIN_OUTLINE_AREA * body.spacing * body.spacing,
        false => MIN_OUTLINE_SHARE * laid.area,
    };
    drop_empty_lines(&mut lines, least, |line| {
        let starts = line
            .iter()
            .map(|side| half_edge_ends(&laid.triangles, *side)[0]);
        starts.map(|vertex| laid.places[vertex as usize]).collect()
    });
    let mut outlines: Vec<(f64, Vec<Run>)> = (lines.iter())
        .map(|line| {
            let runs = runs(body, seams, laid, line);
            let long = (line.iter())
                .map(|side| {
                    let [a, b] =
                        half_edge_ends(&laid.triangles, *side).map(|v| laid.places[v as usize]);
                    (b - a).norm()
                })
                .sum();
            let run = |(number, sides): (Option<usize>, Vec<u32>)| {
                let mut points: Vec<[f64; 2]> = (sides.iter())
                    .map(|side| place(half_edge_ends(&laid.triangles, *side)[0]))
                    .collect();
                points.push(place(
                    half_edge_ends(&laid.triangles, sides[sides.len() - 1])[1],
                ));
                let part = body.parts[laid.members[sides[0] as usize / 3] as usize];
                let [first, last] = [sides[0], sides[sides.len() - 1]];
                let [from, to] = [(first, 0), (last, 1)].map(|(side, end)| {
                    laid.source[half_edge_ends(&laid.triangles, side)[end] as usize]
                });
                Run {
                    // A run that is a whole outline has no ends.
                    ends: [from, to].map(|v| meetings.at(v).filter(|_| from != to)),
                    seam: number.map(seam),
                    patch: number.map(|_| part),
                    points,
                }
            };
            (long, runs.into_iter().map(run).collect())
        })
        .collect();
    outlines.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let folded = sheet
        .whole
        .iter()
        .filter(|number| !seams.all[**number].smooth);
    let mut folds: Vec<Fold> = folded
        .map(|number| Fold {
            bend: None,
            // All cuts of a closed mesh are connected, so a fold ends on the outline.
            ends: [None; 2],
            seam: seam(*number),
            points: along(seams, laid, *number).into_iter().map(place).collect(),
        })
        .collect();
    folds.sort_by_key(|fold| fold.seam.crease);
    Sheet {
        patches: sheet.parts.clone(),
        outlines: outlines.into_iter().map(|(_, runs)| runs).collect(),
        folds,
        spots: sheet
            .parts
            .iter()
            .map(|part| {
                let own = laid.members.iter().zip(&laid.triangles);
                let own = own.filter(|(t, _)| body.parts[**t as usize] == *part);
                let own: Vec<[u32; 3]> = own.map(|(_, corners)| *corners).collect();
                label_spot(*part, &own, &laid.places)
            })
            .collect(),
        faces: Faces {
            built: (laid.source.iter())
                .map(|v| body.places[*v as usize].into())
                .collect(),
            flat: (0..laid.places.len() as u32).map(place).collect(),
            triangles: laid.triangles.clone(),
            textured: Vec::new(),
        },
        spacing: body.spacing,
        area: laid.area,
        strain: laid.strain,
        seam_gap: sheet.gap,
        loops: 0,
        refolding: None,
        exact: false,
    }
}

/// Divides a sheet's outline, a closed line of half-edges, into runs along one side of a seam or the border each.
/// Returns for each run the number of its seam, `None` on the border, and its half-edges.
fn runs(
    body: &Body,
    seams: &Seams,
    laid: &FlatPart,
    line: &[u32],
) -> Vec<(Option<usize>, Vec<u32>)> {
    let own = |side: u32| 3 * laid.members[side as usize / 3] + side % 3;
    let key = |side: u32| {
        let seam = seams.of(own(side));
        (seam, seam.map(|_| body.parts[own(side) as usize / 3]))
    };
    let n = line.len();
    let start = (0..n).find(|i| key(line[*i]) != key(line[(*i + n - 1) % n]));
    let start = start.unwrap_or(0);
    let mut runs: Vec<(Option<usize>, Vec<u32>)> = Vec::new();
    let mut last = None;
    for side in line[start..].iter().chain(&line[..start]) {
        match runs.last_mut() {
            Some((_, sides)) if last == Some(key(*side)) => sides.push(*side),
            _ => runs.push((key(*side).0, vec![*side])),
        }
        last = Some(key(*side));
    }
    runs
}

/// Lists the vertices of a sheet along one of its folds.
fn along(seams: &Seams, laid: &FlatPart, number: usize) -> Vec<u32> {
    let seam = &seams.all[number];
    let vertex = |body_side: u32, end: u32| {
        let t = laid.members.binary_search(&(body_side / 3)).unwrap_or(0);
        laid.triangles[t][((body_side + end) % 3) as usize]
    };
    // The half-edges of a side may run against the seam.
    let forwards = |k: usize| {
        let [one, _] = seam.sides[k];
        laid_source(laid, one, 0) == seam.vertices[k]
    };
    let mut line = Vec::with_capacity(seam.vertices.len());
    for (k, [one, _]) in seam.sides.iter().enumerate() {
        let [from, to] = match forwards(k) {
            true => [0, 1],
            false => [1, 0],
        };
        if k == 0 {
            line.push(vertex(*one, from));
        }
        line.push(vertex(*one, to));
    }
    line
}

/// Finds the vertex of the whole mesh at an end of one of the sheet's half-edges.
fn laid_source(laid: &FlatPart, side: u32, end: u32) -> u32 {
    let t = laid.members.binary_search(&(side / 3)).unwrap_or(0);
    laid.source[laid.triangles[t][((side + end) % 3) as usize] as usize]
}
