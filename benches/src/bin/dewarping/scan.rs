//! The flaws of scans, and plain smoothing.

use developable::Heightfield;

use crate::Outcome;

type Flaws = fn(&Heightfield) -> Outcome<Heightfield>;

/// What may be wrong with a scan, by name.
pub const SCANS: [(&str, Flaws); 2] = [("noise of 1 %", noisy), ("voxels", voxels)];

/// Normal noise with a standard deviation of 1 % of the heights' range.
fn noisy(exact: &Heightfield) -> Outcome<Heightfield> {
    let amplitude = 0.01 * range(exact);
    let mut state = 1u64;
    let mut uniform = || {
        // A linear congruential generator (Knuth's MMIX); its upper bits are good enough for noise.
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    // The sum of twelve uniform numbers is as good as normal.
    changed(exact, |_, z| {
        z + amplitude * ((0..12).map(|_| uniform()).sum::<f64>() - 6.0)
    })
}

/// The staircase of a volume scan: heights in whole multiples of the lattice's spacing.
fn voxels(exact: &Heightfield) -> Outcome<Heightfield> {
    let step = exact.lattice().spacing();
    changed(exact, |_, z| (z / step).round() * step)
}

fn range(field: &Heightfield) -> f64 {
    let known = || field.heights().iter().copied().filter(|z| !z.is_nan());
    known().fold(f64::MIN, f64::max) - known().fold(f64::MAX, f64::min)
}

/// Each height and those around it, averaged so many times.
pub fn smoothed(field: &Heightfield, steps: usize) -> Outcome<Heightfield> {
    let lattice = *field.lattice();
    let mut field = field.clone();
    for _ in 0..steps {
        field = changed(&field, |i, z| {
            let around = lattice.neighbours(i / lattice.cols(), i % lattice.cols());
            let heights = around
                .into_iter()
                .flatten()
                .map(|(r, c)| field.height(r, c));
            let (sum, n) = heights
                .filter(|z| !z.is_nan())
                .fold((0.0, 0.0), |(s, n), z| (s + z, n + 1.0));
            // As much weight as all of the neighbours together.
            if n > 0.0 { 0.5 * (z + sum / n) } else { z }
        })?;
    }
    Ok(field)
}

fn changed(field: &Heightfield, mut change: impl FnMut(usize, f64) -> f64) -> Outcome<Heightfield> {
    let heights = field
        .heights()
        .iter()
        .enumerate()
        .map(|(i, z)| change(i, *z))
        .collect();
    Ok(Heightfield::new(*field.lattice(), heights)?)
}
