//! Joins the parts of a surface to flat sheets, and checks each sheet as it is drawn.

use super::check::{SheetMesh, are_close, strains};
use super::crumbs::remove_crumbs;
use super::faces::faces;
use super::fault::{Fault, SHEET_RELAXATION, fault, folds_of};
use super::flat_patch::Relaxation;
use super::junction::Junctions;
use super::label_spot::label_spot;
use super::layout::{Arrangement, arrange_patches, seam_gap};
use super::options::PatternOptions;
use super::outline::Layout;
use super::parts::Parts;
use super::refold::refold_sheet;
use super::seam_graph::SeamGraph;
use super::sew::close_cuts;
use super::sheet_lines::{folds, outlines};
use super::sheets::{Direction, Missing, Pattern, Run, Seam, Sheet};
use crate::error::Result;
use crate::heights::heightfield::Heightfield;
use crate::math::planar::{polygon_area, polyline_length};
use crate::math::union_find::UnionFind;
use crate::progress;
use crate::shape::patches::Patches;
use crate::unroll::arap_mesh::StoppingCriteria;
use crate::unroll::flat_triangle::Point;

/// Result of joining the parts of a surface: valid flat sheets, or parts that have to be cut further.
pub(super) enum Assembly {
    /// All parts of the surface are on valid flat sheets.
    Whole(Box<AssembledSheets>),
    /// The parts of the surface, and for each part that has to be cut its number and the reason; no numbers if vertices
    /// at a part's border were removed instead.
    Cut(Box<Parts>, Vec<(u32, String)>),
}

/// All flat sheets of a pattern, with the positions of their patches in the plane.
pub(super) struct AssembledSheets {
    pub parts: Parts,
    pub patches: Patches,
    pub net: SeamGraph,
    pub arrangement: Arrangement,
}

/// Stopping criteria of the solver that lays a sheet flat when its patches start near their final positions.
const SHEET_SETTLING: StoppingCriteria = StoppingCriteria {
    relative_tolerance: 2e-3,
    max_steps: 12,
    ..SHEET_RELAXATION
};

/// Joins parts of the surface to flat sheets, as far as the sides of their common seams fit, the strain stays
/// within the limit and the sheets' outlines do not cross themselves.
pub(super) fn assemble_sheets(
    parts: Parts,
    patches: &Patches,
    options: &PatternOptions,
) -> Result<Assembly> {
    let (mut parts, patches) = parts.numbered(patches)?;
    let mut flat_patches = std::mem::take(&mut parts.flat_patches);
    // Sheets are arranged anew.
    for flat_patch in flat_patches.iter_mut().flatten() {
        if flat_patch.relaxation == Relaxation::WithSheet {
            flat_patch.relaxation = Relaxation::Alone;
        }
    }
    let decided = parts.finest * parts.surface.lattice().spacing();
    let mut net = SeamGraph::new(&parts.surface, &parts.labels, flat_patches, decided)?;
    net.divide_by_fit(options.max_seam_gap);
    // A part that is invalid by itself is found without unrolling its sheet.
    let limit = options.max_strain;
    let loose = Layout::loose(&net);
    let alone = (0..)
        .zip(&net.flat_patches)
        .filter_map(|(part, flat_patch)| {
            let relaxation = flat_patch.as_ref()?.relaxation;
            (relaxation != Relaxation::Outstanding).then_some(part)
        });
    let mut wrong: Vec<(u32, String)> = alone
        .filter_map(|part| Some((part, fault(&net, &loose, &[part], limit)?.reason(limit))))
        .collect();
    if wrong.is_empty() {
        let mut arrangement = arrange_patches(&net, options.max_seam_gap);
        let settled = progress::part(0.4, || settle(&parts, &mut net, &mut arrangement))?;
        match settled {
            FlatteningOutcome::Opened(found) => wrong = found,
            FlatteningOutcome::Removable(part, removed) => {
                parts.flat_patches = net.flat_patches;
                parts.leave_out_vertices(part, removed)?;
                return Ok(Assembly::Cut(Box::new(parts), Vec::new()));
            }
        }
        if wrong.is_empty() {
            close_cuts(&mut net, &mut arrangement, limit, |_| true)?;
            return Ok(Assembly::Whole(Box::new(AssembledSheets {
                parts,
                patches,
                net,
                arrangement,
            })));
        }
    }
    parts.flat_patches = net.flat_patches;
    Ok(Assembly::Cut(Box::new(parts), wrong))
}

/// Result of laying the patches of all sheets flat together.
pub(super) enum FlatteningOutcome {
    /// Folds of invalid sheets were opened; a patch of each sheet that is invalid nevertheless, and the reason.
    Opened(Vec<(u32, String)>),
    /// The invalid sheet would be valid without some border vertices; holds the number of the part and these vertices.
    Removable(u32, Vec<usize>),
}

/// Lays the patches of each sheet flat together, and opens folds of invalid sheets unless removing a few
/// border vertices would make them valid. Sheets that have not changed since are kept.
pub(super) fn settle(
    parts: &Parts,
    net: &mut SeamGraph,
    arrangement: &mut Arrangement,
) -> Result<FlatteningOutcome> {
    let limit = parts.options.max_strain;
    let mut pending = std::mem::take(&mut arrangement.sheets);
    let layout = &mut arrangement.layout;
    let mut wrong = Vec::new();
    while let Some(members) = pending.pop() {
        let done = arrangement.sheets.len() as f64 + 1.0;
        let end = done / (done + pending.len() as f64);
        let relaxations: Vec<Relaxation> = members
            .iter()
            .filter_map(|p| Some(net.flat_patches[*p as usize].as_ref()?.relaxation))
            .collect();
        let is_relaxed = relaxations.iter().all(|how| *how == Relaxation::WithSheet);
        if is_relaxed {
            arrangement.sheets.push(members);
            continue;
        }
        let folded = folds_of(net, layout, &members);
        if relaxations.contains(&Relaxation::Outstanding) || !are_close(net, layout, &folded) {
            let mut tied = SheetMesh::new(net, layout, &members, &folded)?;
            progress::part(end, || tied.relax(net, layout, SHEET_SETTLING))?;
            // Most sheets are within the strain limit already.
            if strains(net, &members).0.rms() > limit {
                progress::part(end, || tied.relax(net, layout, SHEET_RELAXATION))?;
            }
        } else if folded.is_empty() {
            members.iter().for_each(|patch| net.lay_alone(*patch));
        }
        let fault = fault(net, layout, &members, limit);
        let removed = fault
            .as_ref()
            .and_then(|fault| removable_vertices(parts, net, fault));
        if let Some((part, removed)) = removed {
            arrangement.sheets.append(&mut pending);
            arrangement.sheets.push(members);
            return Ok(FlatteningOutcome::Removable(part, removed));
        }
        match fault {
            Some(fault) if !folded.is_empty() => {
                for seam in folds_to_open(net, layout, &folded, &fault) {
                    layout.folded[seam] = false;
                }
                pending.extend(connected(net, layout, &members)?);
            }
            other => {
                let reason = other.map(|fault| (members[0], fault.reason(limit)));
                wrong.extend(reason);
                for part in &members {
                    if let Some(flat_patch) = &mut net.flat_patches[*part as usize] {
                        flat_patch.relaxation = Relaxation::WithSheet;
                    }
                }
                arrangement.sheets.push(members);
            }
        }
    }
    Ok(FlatteningOutcome::Opened(wrong))
}

/// Finds the few vertices of one part whose removal would make an invalid sheet valid; returns the part's number and
/// the vertices.
fn removable_vertices(parts: &Parts, net: &SeamGraph, fault: &Fault) -> Option<(u32, Vec<usize>)> {
    let (invalid, part_fault) = fault.part_fault(parts.options.max_strain)?;
    invalid.iter().find_map(|part| {
        let flat_patch = net.flat_patches[*part as usize].as_ref()?;
        let removed = parts.removable_vertices(*part, flat_patch, part_fault)?;
        Some((*part, removed))
    })
}

/// Finds the connected components of a sheet's patches, where folds connect two patches.
fn connected(net: &SeamGraph, layout: &Layout, members: &[u32]) -> Result<Vec<Vec<u32>>> {
    let mut sets = UnionFind::new("pattern", members.len())?;
    let place = |patch: u32| members.binary_search(&patch).ok();
    for seam in folds_of(net, layout, members) {
        let [one, other] = net.seams[seam].patches.map(place);
        if let (Some(one), Some(other)) = (one, other) {
            sets.union(one as u32, other as u32);
        }
    }
    let mut groups: Vec<Vec<u32>> = vec![Vec::new(); members.len()];
    for (k, patch) in members.iter().enumerate() {
        groups[sets.find(k as u32) as usize].push(*patch);
    }
    groups.retain(|group| !group.is_empty());
    Ok(groups)
}

/// Chooses the folds of an invalid sheet that are opened: the one nearest to where an outline crosses itself, or else,
/// for each of the strained patches, the one whose sides are furthest apart.
fn folds_to_open(net: &SeamGraph, layout: &Layout, folded: &[usize], fault: &Fault) -> Vec<usize> {
    match fault {
        Fault::Crossing(place) => {
            let away = |seam: &usize| {
                let side = layout.side(net, *seam, 0).into_iter();
                side.map(|p| (p - place).norm())
                    .fold(f64::INFINITY, f64::min)
            };
            let nearest = folded.iter().copied();
            let nearest = nearest.min_by(|a, b| away(a).total_cmp(&away(b)));
            nearest.into_iter().collect()
        }
        Fault::Strain(_, patches) | Fault::Flipped(patches) => {
            let largest = |patch: Option<&u32>| {
                let beside =
                    |seam: &usize| patch.is_none_or(|p| net.seams[*seam].patches.contains(p));
                let own = folded.iter().copied().filter(beside);
                let pull = |seam: &usize| seam_gap(net, layout, *seam);
                own.max_by(|a, b| pull(a).total_cmp(&pull(b)))
            };
            let mut seams: Vec<usize> = patches.iter().filter_map(|p| largest(Some(p))).collect();
            if seams.is_empty() {
                seams.extend(largest(None));
            }
            seams.sort_unstable();
            seams.dedup();
            seams
        }
    }
}

/// Creates the pattern: outlines, folds, label positions, strain and area of all sheets.
pub(super) fn draw_sheets(surface: &Heightfield, whole: &AssembledSheets) -> Result<Pattern> {
    let AssembledSheets {
        parts,
        patches,
        net,
        arrangement,
    } = whole;
    let layout = &arrangement.layout;
    let spot = |patch: &u32| {
        let flat_patch = net.flat_patches[*patch as usize].as_ref();
        flat_patch.map(|flat_patch| {
            let motion = layout.motions[*patch as usize];
            let places: Vec<Point> = flat_patch
                .places()
                .iter()
                .map(|p| motion.apply(*p))
                .collect();
            let own: Vec<[u32; 3]> = flat_patch.pieces().map(|(_, corners)| corners).collect();
            label_spot(*patch, &own, &places)
        })
    };
    let seam = |number: usize| {
        let seam = &net.seams[number];
        Seam {
            crease: seam.crease,
            patches: seam.patches,
            direction: Direction::from_ridge(seam.rise > 0.0),
            angle: patches.creases()[seam.crease].fold,
            slit: seam.smooth,
            torn: net.is_torn(number),
        }
    };
    let junctions = Junctions::new(&parts.surface, &parts.labels, net, layout)?;
    let sheets = arrangement.sheets.iter().map(|members| {
        let (outlines, loops) = outlines(net, layout, members, &junctions, seam);
        let own = |patch: &u32| patches.patches()[*patch as usize].area;
        let (strain, _) = strains(net, members);
        let folded = folds_of(net, layout, members);
        let gaps = folded.iter().map(|seam| seam_gap(net, layout, *seam));
        Ok(Sheet {
            folds: folds(net, layout, members, &outlines, &junctions, seam),
            outlines,
            spots: members.iter().filter_map(spot).collect(),
            faces: faces(&parts.surface, net, layout, members),
            spacing: net.spacing,
            area: members.iter().map(own).sum(),
            strain: strain.rms(),
            seam_gap: gaps.fold(0.0, f64::max),
            patches: members.clone(),
            loops,
            refolding: match parts.options.refold {
                true => Some(refold_sheet(net, members, &folded)?),
                false => None,
            },
            exact: false,
        })
    });
    let mut sheets = sheets.collect::<Result<Vec<Sheet>>>()?;
    // A sheet of a few vertices whose outline was cut off with a loop is no sheet.
    let least = net.spacing.powi(2);
    let is_empty = |sheet: &Sheet| sheet.outlines.iter().all(|line| outline_area(line) < least);
    let mut missing = missing(surface, whole)?;
    remove_crumbs(&mut sheets, patches.patches(), &mut missing, is_empty);
    sheets.sort_by_key(|sheet| sheet.patches[0]);
    Ok(Pattern {
        sheets,
        patches: patches.clone(),
        missing,
    })
}

/// Computes the area that an outline encloses.
fn outline_area(line: &[Run]) -> f64 {
    let points = line
        .iter()
        .flat_map(|run| &run.points[..run.points.len() - 1]);
    polygon_area(&points.copied().collect::<Vec<_>>()).abs()
}

/// Computes how many vertices and how much area of the surface are in no patch, and the number and area of the surface's
/// steps (edges where it jumps in height).
fn missing(surface: &Heightfield, whole: &AssembledSheets) -> Result<Missing> {
    let net = &whole.net;
    let torn = (0..net.seams.len()).filter(|seam| net.is_torn(*seam));
    let high = |seam: usize| net.seams[seam].apart * polyline_length(&net.seams[seam].sides[0]);
    let left_out = whole.parts.left_out();
    let area = match left_out {
        0 => 0.0,
        _ => {
            let all = Patches::area(surface)?;
            all - whole
                .patches
                .patches()
                .iter()
                .map(|patch| patch.area)
                .sum::<f64>()
        }
    };
    Ok(Missing {
        vertices: left_out,
        area,
        steps: torn.clone().count(),
        // Not a sum, which is -0 of nothing.
        step_area: torn.map(high).fold(0.0, |sum, area| sum + area),
    })
}
