//! Patterns of meshes as they are, without a view.
//!
//! The way is that of heightfields, on triangles alone: what is strained is cut in two, here by planes, and
//! the parts are joined again as far as their sides fit. Creases are edges already, so that no patch has to be
//! continued beyond them.

mod body;
mod draw;
mod join;
mod lay;
mod meeting;

use std::collections::BTreeMap;

use super::{PatternOptions, Sheet};
use crate::error::{Error, Result, check_count, positive};
use crate::fit::mesh::topology::Topology;
use crate::flat::unroll::joint::Until;
use crate::scene::mesh::Mesh;
use crate::shape::patches::{Crease, MeshPatches, Patch};
use body::{Body, Place, Plane};
use draw::drawn;
use join::{Limits, Seams, joined};
use lay::{Laid, TRIAL};

/// A mesh cut into sheets.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MeshPattern {
    /// The sheets, that with the largest patch first. They are seen from outside, which is the side that the
    /// mesh's triangles face.
    pub sheets: Vec<Sheet>,
    /// The patches of the sheets, that with the largest area first: those that were given, each connected
    /// piece by itself, or what they were cut into.
    pub patches: Vec<Patch>,
    /// The creases between them, cuts through what was one patch among them.
    pub creases: Vec<Crease>,
}

/// More parts than these are no pattern that somebody puts together.
const MOST_PARTS: u32 = 500;

/// Strain above this multiple of the limit is given up where steps hardly change it.
const FAR: f64 = 2.5;

/// Cuts a mesh into sheets, that with the largest patch first: closed, overhanging or in parts.
///
/// Every sheet has a simple outline and is strained by no more than [`PatternOptions::max_strain`]. A patch
/// that cannot be laid flat so is cut in two by a plane, across one of its main axes, where it leaves least
/// strain, as often as it takes; then parts are joined as far as their sides fit, the longest first, so that a
/// tube gets one slit. Both sides of a cut are as long as each other on the mesh, and on the sheets but for
/// their strain. Seams are whole folds or whole cuts. [`PatternOptions::refold`] is for heightfields only.
///
/// Costs an unrolling of each patch, a dozen short ones for each cut and one for each seam that is joined.
///
/// # Errors
/// [`Error::Shape`](crate::Error::Shape) if the patches are those of another mesh,
/// [`Error::Option`](crate::Error::Option) for a gap or a strain that is not positive and finite,
/// [`Error::Topology`](crate::Error::Topology) for what is no surface,
/// [`Error::Unsupported`](crate::Error::Unsupported) for what would be more than 500 parts.
pub fn pattern_mesh(
    mesh: &Mesh,
    patches: &MeshPatches,
    options: &PatternOptions,
) -> Result<MeshPattern> {
    check_count(
        "patches of the mesh",
        mesh.triangles().len(),
        1,
        patches.labels().len(),
    )?;
    let gap = positive("gap", options.gap)?;
    let strain = positive("maxStrain", options.max_strain)?;
    let until = Until {
        tolerance: positive("tolerance", options.unrolling.tolerance)?,
        // Of the two principal strains the energy has the sum of the squares.
        hopeless: FAR * 2.0 * strain * strain,
        steps: options.unrolling.max_iterations,
    };
    let limits = Limits { gap, strain, until };
    let topology = Topology::new(mesh)?;
    let place = |vertex: &u32| Place::from(mesh.positions()[*vertex as usize]);
    let labels = topology.from.iter().map(|t| patches.labels()[*t as usize]);
    let body = Body::new(
        topology.source.iter().map(place).collect(),
        topology.triangles.clone(),
        labels.collect(),
    )?;
    let (body, parts) = flat_parts(body, limits)?;
    let seams = Seams::new(&body, patches.bend());
    let sheets = joined(&body, &seams, parts, limits)?;
    drawn(&body, &seams, &sheets)
}

/// Cuts until every part lies flat; these by their area.
fn flat_parts(mut body: Body, limits: Limits) -> Result<(Body, Vec<Laid>)> {
    let whole = |_: u32| false;
    // What was found to lie flat, with its triangles then: cuts beside it divide some of them.
    let mut flat: BTreeMap<u32, Laid> = BTreeMap::new();
    let mut open: Vec<u32> = (0..body.count).rev().collect();
    loop {
        let Some(part) = open.pop() else {
            let moved = |(part, laid): (&u32, &Laid)| {
                (body.members(*part).len() != laid.members.len()).then_some(*part)
            };
            open = flat.iter().filter_map(moved).collect();
            if open.is_empty() {
                break;
            }
            continue;
        };
        let laid = Laid::new(&body, body.members(part), whole, None, limits.until)?;
        if laid.strain <= limits.strain && !laid.overlaps() {
            flat.insert(part, laid);
            continue;
        }
        flat.remove(&part);
        let worst = body.triangles[laid.members[laid.worst] as usize];
        let worst = worst.map(|v| body.places[v as usize]).iter().sum::<Place>() / 3.0;
        let mut best: Option<(f64, Plane)> = None;
        let alone = body.alone(&laid.members);
        for plane in body.planes(&laid.members, worst) {
            let mut trial = alone.clone();
            let parts = trial.cut(0, &plane)?;
            if parts.len() < 2 || body.count - 1 + trial.count > MOST_PARTS {
                continue;
            }
            let mut energy = 0.0;
            for part in &parts {
                let short = Until {
                    steps: TRIAL,
                    ..limits.until
                };
                let laid = Laid::new(&trial, trial.members(*part), whole, None, short)?;
                energy += laid.area * laid.strain * laid.strain;
            }
            if best.as_ref().is_none_or(|(least, ..)| energy < *least) {
                best = Some((energy, plane));
            }
        }
        let Some((_, plane)) = best else {
            let [x, y, z]: [f64; 3] = worst.into();
            return Err(Error::Unsupported {
                format: "pattern",
                reason: format!(
                    "the mesh around ({x}, {y}, {z}) cannot be laid flat within {MOST_PARTS} parts; smooth it more \
                     (a smaller lambda), take larger patches or allow more strain"
                ),
            });
        };
        open.extend(body.cut(part, &plane)?);
    }
    let numbers = body.sort();
    let mut parts: Vec<(u32, Laid)> = (flat.into_iter())
        .map(|(part, laid)| (numbers[part as usize], laid))
        .collect();
    parts.sort_by_key(|(part, _)| *part);
    let parts = parts.into_iter().map(|(_, laid)| laid).collect();
    Ok((body, parts))
}
