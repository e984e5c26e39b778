//! The triangles of a sheet, drawn into the flat image.

use super::registration::Places;
use crate::error::{Result, try_filled};
use crate::unroll::Unrolling;

/// A corner of a triangle: where it is in the flat image, in pixels, and what its place in the photo
/// comes from.
#[derive(Clone, Copy)]
struct Corner {
    at: [f64; 2],
    from: [f64; 3],
}

/// Where the flat image lies on the sheet.
pub(super) struct Canvas {
    pub size: [usize; 2],
    pub resolution: f64,
    /// Upper left.
    pub corner: [f64; 2],
}

/// Writes the places of all pixels on the sheet, where there is none yet. Where parts lie on each other
/// the larger one is seen.
pub(super) fn draw(
    sheet: &Unrolling,
    registration: &Places,
    canvas: &Canvas,
    places: &mut [[f32; 2]],
) -> Result<()> {
    let mesh = sheet.mesh();
    let triangles = mesh.triangles();
    let part = |triangle: usize| sheet.parts()[triangles[triangle][0] as usize];
    // The larger part first.
    let mut order = try_filled("flat image", triangles.len(), 0)?;
    for (i, triangle) in order.iter_mut().enumerate() {
        *triangle = i;
    }
    order.sort_by_key(|triangle| part(*triangle));
    for triangle in order {
        let corners = triangles[triangle].map(|v| {
            let [x, y] = sheet.places()[v as usize];
            Corner {
                // Whole numbers at pixels' centres, downwards.
                at: [
                    (x - canvas.corner[0]) * canvas.resolution - 0.5,
                    (canvas.corner[1] - y) * canvas.resolution - 0.5,
                ],
                from: registration.of_vertex(v as usize, mesh.positions()[v as usize]),
            }
        });
        fill(&corners, registration, canvas.size, places);
    }
    Ok(())
}

fn cross(p: [f64; 2], q: [f64; 2], r: [f64; 2]) -> f64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

/// Writes the places of the pixels in a triangle.
fn fill(
    corners: &[Corner; 3],
    registration: &Places,
    [width, height]: [usize; 2],
    places: &mut [[f32; 2]],
) {
    let [a, b, c] = corners.map(|corner| corner.at);
    let area = cross(a, b, c);
    if area == 0.0 || !area.is_finite() {
        return;
    }
    /// How far outside a pixel may lie, in pixels, so that none falls between two triangles.
    const SLACK: f64 = 1e-6;
    let slack = (SLACK * area.abs().sqrt() + 1e-12) / area.abs();
    // Barycentric coordinates are linear along a row; so is what places come from.
    let edges = [(b, c), (c, a), (a, b)];
    let slopes = edges.map(|(from, to)| (from[1] - to[1]) / area);
    let along = mixed(corners, slopes);
    let top = a[1].min(b[1]).min(c[1]) - SLACK;
    let bottom = a[1].max(b[1]).max(c[1]) + SLACK;
    // Casts saturate; an empty range is one that ends before it starts.
    let rows =
        top.ceil().max(0.0) as usize..(bottom.floor() + 1.0).clamp(0.0, height as f64) as usize;
    for row in rows {
        // From the corner that is nearest to the left, so that little is lost by rounding.
        let start = a[0].min(b[0]).min(c[0]).floor().max(0.0);
        let pixel = [start, row as f64];
        let weights = edges.map(|(from, to)| cross(from, to, pixel) / area);
        let (mut first, mut last) = (0.0, width as f64 - 1.0 - start);
        for (weight, slope) in weights.into_iter().zip(slopes) {
            let end = -(weight + slack) / slope;
            if slope > 0.0 {
                first = end.max(first);
            } else if slope < 0.0 {
                last = end.min(last);
            } else if weight < -slack {
                last = -1.0;
            }
        }
        let (first, last) = (first.ceil(), last.floor());
        if last < first {
            continue;
        }
        let mut from = mixed(corners, weights);
        for k in 0..3 {
            from[k] += first * along[k];
        }
        let begin = row * width + (start + first) as usize;
        for place in &mut places[begin..=begin + (last - first) as usize] {
            if place[0].is_nan()
                && let Some(found) = registration.of(from)
            {
                *place = found;
            }
            for k in 0..3 {
                from[k] += along[k];
            }
        }
    }
}

/// What the corners' places come from, in the proportions of the weights.
fn mixed(corners: &[Corner; 3], weights: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let parts = corners.iter().zip(weights);
        parts.map(|(corner, weight)| weight * corner.from[k]).sum()
    })
}
