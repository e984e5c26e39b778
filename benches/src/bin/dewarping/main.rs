//! How well pages are made flat, as JSON: synthetic ones, of which every point's place is known, with
//! the flaws of scans, by the surface as it is scanned, smoothed, and fitted.
//!
//! `npm run bench -- dewarping` runs this program.

mod measure;
mod page;
mod print;
mod scan;

use std::error::Error;

use developable::dewarp::Extent;
use developable::{Heightfield, Lattice, Options, fit};
use serde::Serialize;

use measure::{Truth, measure};
use page::{HEIGHT, Page};
use print::{ACROSS, DOWN};
use scan::{SCANS, smoothed};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Vertices of the scan across the page.
const RESOLUTION: f64 = 200.0;

/// What is known of a page besides its heights.
struct Scene {
    photo: Vec<u8>,
    width: usize,
    height: usize,
    extent: Extent,
    /// The page's own image.
    original: Vec<u8>,
    exact: Heightfield,
}

#[derive(Serialize)]
struct Row {
    page: &'static str,
    scan: &'static str,
    surface: String,
    vertices: usize,
    #[serde(flatten)]
    truth: Truth,
}

fn main() -> Outcome<()> {
    let mut rows = Vec::new();
    for (name, page) in page::all() {
        let page = page.as_ref();
        let exact = exact(page)?;
        let scene = photograph(page, &exact);
        // Fitted or smoothed, there are as many.
        let vertices = exact.heights().iter().filter(|z| !z.is_nan()).count();
        let measured = |field: &Heightfield| measure(page, &scene, field);
        let mut add = |scan, surface: String, truth: Truth| {
            rows.push(Row {
                page: name,
                scan,
                surface,
                vertices,
                truth,
            });
        };
        add("exact", "as it is".into(), measured(&exact)?);
        for (scan, flaws) in SCANS {
            let scanned = flaws(&exact)?;
            add(scan, "as it is".into(), measured(&scanned)?);
            // Of plain smoothing whatever does best, which nobody knows without the truth.
            let (mut field, mut done) = (scanned.clone(), 0);
            let mut best: Option<(usize, Truth)> = None;
            for steps in [1, 2, 4, 8, 16, 32, 64, 128, 256] {
                field = smoothed(&field, steps - done)?;
                done = steps;
                let truth = measured(&field)?;
                if best
                    .as_ref()
                    .is_none_or(|(_, least)| truth.bend < least.bend)
                {
                    best = Some((steps, truth));
                }
            }
            if let Some((steps, truth)) = best {
                add(scan, format!("smoothed, {steps} steps"), truth);
            }
            let medium = Options::paper();
            let fitted = fit(&scanned, &medium)?;
            add(scan, "fitted".into(), measured(fitted.heightfield())?);
            let reweighted = fit(&scanned, &medium.reweighting(1))?;
            add(
                scan,
                "fitted, reweighted".into(),
                measured(reweighted.heightfield())?,
            );
            let scans = Options::default();
            let by_itself = fit(&scanned, &scans)?;
            add(
                scan,
                "huber, λ auto".into(),
                measured(by_itself.heightfield())?,
            );
        }
    }
    println!("{}", serde_json::to_string(&rows)?);
    Ok(())
}

/// The page on a lattice, seen from above.
fn exact(page: &dyn Page) -> Outcome<Heightfield> {
    let border = (0..=400).flat_map(|i| {
        let t = f64::from(i) / 400.0;
        [[t, 0.0], [t, HEIGHT], [0.0, HEIGHT * t], [1.0, HEIGHT * t]].map(|p| page.seen(p))
    });
    let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for seen in border {
        for k in 0..2 {
            min[k] = min[k].min(seen[k]);
            max[k] = max[k].max(seen[k]);
        }
    }
    let lattice = Lattice::covering(min, max, 1.0 / RESOLUTION)?;
    Ok(Heightfield::from_fn(lattice, |x, y| {
        let [u, v] = page.on_page([x, y]);
        let inside = (0.0..=1.0).contains(&u) && (0.0..=HEIGHT).contains(&v);
        if inside {
            page.height([x, y])
        } else {
            f64::NAN
        }
    })?)
}

/// What a camera far above sees.
fn photograph(page: &dyn Page, surface: &Heightfield) -> Scene {
    let extent = Extent::from_heightfield(surface);
    let size = |k: usize| ((extent.max[k] - extent.min[k]) * ACROSS as f64) as usize;
    let (width, height) = (size(0), size(1));
    let place = |x: f64, y: f64| {
        let (s, t) = (x / width as f64, y / height as f64);
        page.on_page([
            extent.min[0] + s * (extent.max[0] - extent.min[0]),
            extent.max[1] - t * (extent.max[1] - extent.min[1]),
        ])
    };
    Scene {
        photo: print::image(width, height, place),
        width,
        height,
        extent,
        original: print::image(ACROSS, DOWN, print::point_of),
        exact: surface.clone(),
    }
}
