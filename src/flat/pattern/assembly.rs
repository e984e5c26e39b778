//! Parts joined to sheets, each of which is checked as it is drawn.

use std::collections::HashMap;

use super::check::{crossing, join, strains};
use super::faces::faces;
use super::layout::{Arrangement, apart, arranged};
use super::leaf::Strain;
use super::net::Net;
use super::outline::{Layout, Motion};
use super::parts::Parts;
use super::shape::{folds, outlines};
use super::spots::spots;
use super::{Direction, Pattern, PatternOptions, Run, Seam, Sheet};
use crate::error::Result;
use crate::flat::unroll::pieces::Point;
use crate::shape::patches::Patches;

pub(super) enum Assembly<'a> {
    Whole(Pattern),
    /// The parts, the numbers of those that cannot be sheets as they are, and why.
    Cut(Parts<'a>, Vec<(u32, String)>),
}

/// What is wrong with a sheet.
enum Fault {
    /// How much, and the parts that are strained more than they may be.
    Strain(f64, Vec<u32>),
    /// Parts with triangles upside down.
    Flipped(Vec<u32>),
    /// Where.
    Crossing(Point),
}

impl Fault {
    fn reason(&self, limit: f64) -> String {
        match self {
            Fault::Strain(strain, _) => format!(
                "its strain would be {:.2} %, more than the limit of {:.2} %",
                100.0 * strain,
                100.0 * limit
            ),
            Fault::Flipped(_) => "triangles of it would lie upside down".into(),
            Fault::Crossing(_) => "its outline would cross itself".into(),
        }
    }
}

/// A sheet that is as it should be: where its vertices lie, by patch, where they were moved.
type Kept = HashMap<(Vec<u32>, Vec<usize>), Vec<(u32, Vec<Point>)>>;

/// Joins parts as far as their sides fit, they are not strained by it, and outlines stay simple.
pub(super) fn assembled<'a>(
    parts: Parts<'a>,
    patches: &Patches,
    options: &PatternOptions,
) -> Result<Assembly<'a>> {
    let surface = parts.surface;
    let (patches, mut parts) = match parts.leaves.len() == patches.patches().len() {
        true => (patches.clone(), parts),
        false => {
            let (divided, order) = patches.divided(surface, parts.labels.of.clone())?;
            let parts = parts.renumbered(divided.labels(), &order);
            (divided, parts)
        }
    };
    let leaves = std::mem::take(&mut parts.leaves);
    let mut net = Net::new(surface, &parts.labels, leaves, options.gap)?;
    let mut barred = vec![false; net.seams.len()];
    let mut kept: Kept = HashMap::new();
    let arrangement = loop {
        let mut arrangement = arranged(&net, options.gap, &barred);
        // What is wrong with a part by itself needs no joint unrolling to be seen.
        let alone = arrangement
            .sheets
            .iter()
            .filter(|(members, _)| members.len() == 1);
        let single: Vec<(u32, String)> = alone
            .filter_map(|(members, _)| {
                let fault = fault(&net, &arrangement.layout, members, options.max_strain)?;
                Some((members[0], fault.reason(options.max_strain)))
            })
            .collect();
        if !single.is_empty() {
            parts.leaves = net.leaves;
            return Ok(Assembly::Cut(parts, single));
        }
        let mut moved: Vec<(u32, Vec<Point>)> = Vec::new();
        let mut faults = Vec::new();
        for (members, gap) in &mut arrangement.sheets {
            let folded = folded(&net, &arrangement.layout, members);
            let key = (members.clone(), folded.clone());
            let before = |net: &Net| -> Vec<(u32, Vec<Point>)> {
                let places =
                    |p: &u32| Some((*p, net.leaves[*p as usize].as_ref()?.places().to_vec()));
                members.iter().filter_map(places).collect()
            };
            if let Some(places) = kept.get(&key) {
                if !places.is_empty() {
                    moved.extend(before(&net));
                }
                for (patch, places) in places {
                    net.set_places(*patch, places.clone());
                    arrangement.layout.motions[*patch as usize] = Motion::NONE;
                }
            } else {
                let rest = before(&net);
                let gap = |seam: &usize| apart(&net, &arrangement.layout, *seam);
                let loose: Vec<f64> = folded.iter().map(gap).collect();
                let joined = join(&mut net, &mut arrangement.layout, members, &folded)?;
                if joined {
                    moved.extend(rest);
                }
                if let Some(fault) = fault(&net, &arrangement.layout, members, options.max_strain) {
                    let seams = worst(&net, &arrangement.layout, &loose, &folded, &fault);
                    faults.push(seams);
                    continue;
                }
                let places = if joined { before(&net) } else { Vec::new() };
                kept.insert(key, places);
            }
            *gap = (folded.iter())
                .map(|seam| apart(&net, &arrangement.layout, *seam))
                .fold(0.0, f64::max);
        }
        if faults.is_empty() {
            break arrangement;
        }
        for (patch, places) in moved {
            net.set_places(patch, places);
        }
        for seams in faults {
            for seam in seams {
                barred[seam] = true;
            }
        }
    };
    let sheets = drawn(&net, &arrangement, &patches, &parts);
    Ok(Assembly::Whole(Pattern { sheets, patches }))
}

fn folded(net: &Net, layout: &Layout, members: &[u32]) -> Vec<usize> {
    let own = |seam: &usize| layout.folded[*seam] && members.contains(&net.seams[*seam].patches[0]);
    (0..net.seams.len()).filter(own).collect()
}

fn fault(net: &Net, layout: &Layout, members: &[u32], limit: f64) -> Option<Fault> {
    let (sum, all) = strains(net, members);
    // Some of them at once, so that few joint unrollings are needed.
    let those = |wrong: &dyn Fn(&Strain) -> bool| -> Vec<u32> {
        let mut found: Vec<&(u32, Strain)> = all.iter().filter(|(_, s)| wrong(s)).collect();
        found.sort_by(|a, b| b.1.rms().total_cmp(&a.1.rms()));
        found.truncate(found.len().div_ceil(3));
        found.into_iter().map(|(patch, _)| *patch).collect()
    };
    if sum.rms() > limit {
        return Some(Fault::Strain(sum.rms(), those(&|s| s.rms() > limit)));
    }
    if sum.flipped > 0 {
        return Some(Fault::Flipped(those(&|s| s.flipped > 0)));
    }
    let lines: Vec<Vec<[f64; 2]>> = (shape_of(net, layout, members).into_iter())
        .map(|runs| {
            let points = runs.into_iter().flat_map(|mut run| {
                run.points.pop();
                run.points
            });
            points.collect()
        })
        .collect();
    crossing(&lines).map(Fault::Crossing)
}

/// The outlines of a sheet, with no creases told from each other.
fn shape_of(net: &Net, layout: &Layout, members: &[u32]) -> Vec<Vec<Run>> {
    outlines(net, layout, members, |number| Seam {
        crease: number,
        patches: net.seams[number].patches,
        direction: Direction::Mountain,
        angle: 0.0,
        slit: false,
    })
}

/// The folds that are to be cut: of those of a strained patch, if it has any, those that fit worst
/// where the patches lie loose; for an outline that crosses itself the nearest one.
fn worst(net: &Net, layout: &Layout, loose: &[f64], folded: &[usize], fault: &Fault) -> Vec<usize> {
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
            let gaps = || folded.iter().copied().zip(loose.iter().copied());
            let largest = |patch: Option<&u32>| {
                let beside =
                    |seam: usize| patch.is_none_or(|p| net.seams[seam].patches.contains(p));
                let own = gaps().filter(|(seam, _)| beside(*seam));
                own.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(seam, _)| seam)
            };
            let mut seams: Vec<usize> = patches.iter().filter_map(|p| largest(Some(p))).collect();
            if seams.is_empty() {
                seams.extend(largest(None));
            }
            seams
        }
    }
}

fn drawn(net: &Net, arrangement: &Arrangement, patches: &Patches, parts: &Parts) -> Vec<Sheet> {
    let layout = &arrangement.layout;
    let places = spots(parts.surface, patches.labels(), net, layout);
    let seam = |number: usize| {
        let seam = &net.seams[number];
        Seam {
            crease: seam.crease,
            patches: seam.patches,
            direction: match seam.rise > 0.0 {
                true => Direction::Mountain,
                false => Direction::Valley,
            },
            angle: patches.creases()[seam.crease].fold,
            slit: seam.smooth,
        }
    };
    let sheets = arrangement.sheets.iter().map(|(members, gap)| {
        let outlines = outlines(net, layout, members, seam);
        let own = |patch: &u32| patches.patches()[*patch as usize].area;
        let (strain, _) = strains(net, members);
        Sheet {
            folds: folds(net, layout, members, &outlines, seam),
            outlines,
            spots: members.iter().map(|p| places[*p as usize]).collect(),
            faces: faces(parts.surface, net, layout, members),
            spacing: net.spacing,
            area: members.iter().map(own).sum(),
            strain: strain.rms(),
            gap: *gap,
            patches: members.clone(),
        }
    });
    sheets.collect()
}
