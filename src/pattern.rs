//! Patterns: a surface cut along its creases into sheets that lie flat, with as few cuts as
//! possible.
//!
//! Patches that meet at a fold stay together where the sheet of both lies flat without stretch and
//! without lying on itself. The longest creases are tried first.
//!
//! ```
//! use developable::patches::{PatchOptions, Patches};
//! use developable::pattern::{PatternOptions, pattern};
//! use developable::{Heightfield, Lattice};
//! # fn main() -> developable::Result<()> {
//! // A folded card: two patches, one sheet.
//! let card = Heightfield::from_fn(Lattice::new(40, 40, 0.025)?, |x, _| -0.5 * (x - 0.52).abs())?;
//! let patches = Patches::new(&card, &PatchOptions::default())?;
//! let sheets = pattern(&card, &patches, &PatternOptions::default())?;
//! assert_eq!(sheets.len(), 1);
//! assert_eq!(sheets[0].patches, [0, 1]);
//! assert_eq!(sheets[0].folds, [0]); // along the first crease
//! # Ok(())
//! # }
//! ```

use crate::error::{Result, check_shape, positive};
use crate::heightfield::Heightfield;
use crate::patches::{NO_PATCH, Patches};
use crate::triangulation::Triangulation;
use crate::unroll::{UnrollOptions, Unrolling, unroll_mesh};
use crate::view::Frame;

/// What may stay together.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PatternOptions {
    /// Largest root mean square of the strains that a joint sheet may have within its patches.
    /// (The triangles across a fold cut its corner, and are strained wherever it runs between the
    /// lattice's edges.) Default 0.002.
    pub strain: f64,
    /// How sheets are laid flat.
    pub unrolling: UnrollOptions,
}

impl Default for PatternOptions {
    fn default() -> Self {
        PatternOptions {
            strain: 0.002,
            unrolling: UnrollOptions::default(),
        }
    }
}

impl PatternOptions {
    /// These options with another strain.
    pub fn strain(self, strain: f64) -> Self {
        PatternOptions { strain, ..self }
    }
}

/// A sheet to be cut out.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Sheet {
    /// Its patches, ascending.
    pub patches: Vec<u32>,
    /// The creases along which it is folded, by their place in [`Patches::creases`], ascending.
    pub folds: Vec<usize>,
    /// The sheet, flat. It ends with the last whole triangles of its patches, up to a cell before
    /// a crease that is cut.
    pub flat: Unrolling,
}

/// Cuts a surface into sheets, that with the largest patch first.
///
/// Each crease costs an unrolling: `O(creases · vertices)`.
///
/// # Errors
/// [`Error::Shape`](crate::Error::Shape) if the patches are those of another lattice,
/// [`Error::Option`](crate::Error::Option) for a strain that is not positive and finite, and what
/// [`unroll`](crate::unroll::unroll) has to say.
pub fn pattern(
    surface: &Heightfield,
    patches: &Patches,
    options: &PatternOptions,
) -> Result<Vec<Sheet>> {
    let lattice = surface.lattice();
    let labels = patches.labels();
    check_shape("patches", lattice.rows(), lattice.cols(), labels.len())?;
    let strain = positive("strain", options.strain)?;
    let mut sheets: Vec<Option<Sheet>> = Vec::new();
    for patch in 0..patches.patches().len() as u32 {
        // A patch without a whole triangle is none that could be cut out.
        let flat = flat(surface, labels, &[patch], &[], options).ok();
        sheets.push(flat.map(|flat| Sheet {
            patches: vec![patch],
            folds: Vec::new(),
            flat,
        }));
    }
    let creases = patches.creases();
    let mut order: Vec<usize> = (0..creases.len()).collect();
    order.sort_by(|a, b| creases[*b].length.total_cmp(&creases[*a].length));
    for crease in order {
        let of = |patch: u32| {
            let holds = |sheet: &Sheet| sheet.patches.contains(&patch);
            sheets.iter().position(|s| s.as_ref().is_some_and(holds))
        };
        let [one, other] = creases[crease].patches;
        let (Some(a), Some(b)) = (of(one), of(other)) else {
            continue;
        };
        // Two folds between the same sheets would close a ring; the second one stays cut.
        if a == b {
            continue;
        }
        let (Some(first), Some(second)) = (&sheets[a], &sheets[b]) else {
            continue;
        };
        let mut joint = [&first.patches[..], &second.patches].concat();
        let mut folds = [&first.folds[..], &second.folds, &[crease]].concat();
        joint.sort_unstable();
        folds.sort_unstable();
        let pairs: Vec<[u32; 2]> = folds.iter().map(|fold| creases[*fold].patches).collect();
        let flat = flat(surface, labels, &joint, &pairs, options)?;
        let report = flat.report();
        let lies_flat = strain_within(&flat, labels) <= strain
            && report.distortion.flipped == 0
            && report.crossings == 0;
        if lies_flat {
            sheets[a.max(b)] = None;
            sheets[a.min(b)] = Some(Sheet {
                patches: joint,
                folds,
                flat,
            });
        }
    }
    Ok(sheets.into_iter().flatten().collect())
}

/// Root mean square of the strains over the triangles of which all corners are in one patch.
fn strain_within(flat: &Unrolling, labels: &[u32]) -> f64 {
    let mesh = flat.mesh();
    let (mut squares, mut areas) = (0.0, 0.0);
    for (triangle, [long, short]) in mesh.triangles().iter().zip(flat.stretches()) {
        let [a, b, c] = triangle.map(|v| labels[mesh.vertices()[v as usize] as usize]);
        if a == b && b == c {
            let [x, y, z] = mesh.normal(*triangle);
            let area = x.hypot(y).hypot(z);
            areas += area;
            squares += area * 0.5 * ((long - 1.0).powi(2) + (short - 1.0).powi(2));
        }
    }
    if areas > 0.0 {
        (squares / areas).sqrt()
    } else {
        0.0
    }
}

/// Some patches laid flat, joined only along the folds between given pairs.
fn flat(
    surface: &Heightfield,
    labels: &[u32],
    patches: &[u32],
    folds: &[[u32; 2]],
    options: &PatternOptions,
) -> Result<Unrolling> {
    let joined = |a: usize, b: usize| {
        let (a, b) = (labels[a], labels[b]);
        a == b || folds.contains(&[a.min(b), a.max(b)])
    };
    let mesh = Triangulation::of_some(surface, &Frame::default(), |corners| {
        let inside = |i: usize| labels[i] != NO_PATCH && patches.contains(&labels[i]);
        let [a, b, c] = corners;
        corners.into_iter().all(inside) && joined(a, b) && joined(b, c) && joined(c, a)
    })?;
    unroll_mesh(mesh, &options.unrolling)
}
