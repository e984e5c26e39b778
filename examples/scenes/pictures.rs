//! Scenes as pictures: the input, the truth, the nuclear norm's surface and ours, shaded, and below them
//! how far each is from the truth.

use std::fs;
use std::path::Path;

use developable::dewarp::Photo;
use developable::files::images::{PhotoOptions, write_photo};
use developable::picture::{Picture, PictureOptions};
use developable::{HeightImage, Heightfield, Lattice, Options, fit};

use super::distance::Distance;
use super::noise::Noise;
use super::shapes::{self, Scene};

/// Half-decades about `8/σh` among which the best λ is picked.
const DECADES: [f64; 8] = [-2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5];

/// Which scenes, under which noise.
const SHOWN: [(&str, Noise); 6] = [
    ("wave", Noise::White(0.05)),
    ("fan", Noise::White(0.02)),
    ("groin", Noise::White(0.02)),
    ("valley", Noise::White(0.01)),
    ("cones", Noise::Correlated(0.01)),
    ("facets", Noise::Voxels(0.03)),
];

/// Vertices from one side to the other, and pixels.
const SIZE: usize = 200;
const WIDTH: usize = 240;

/// Pixels between two pictures.
const MARGIN: usize = 8;

type Error = Box<dyn std::error::Error>;

/// Writes a PNG file for each, and the page `scenes.md` that shows them.
pub fn write(folder: &Path) -> Result<(), Error> {
    fs::create_dir_all(folder.join("scenes"))?;
    let mut page = String::from(
        "# Scenes, seen\n\n\
         Written by `cargo run --release --example scenes -- pictures docs`. From left to right: the noisy \
         input; the truth; the surface by the nuclear norm, with the λ of six that is best for it by the \
         truth; the surface by the energy `huber` with λ by itself, without any parameter. Below each, its \
         heights less the true ones: blue where it is too low, red where it is too high, the ends of the \
         scale being twice the noise's standard deviation in all of them.\n",
    );
    for (name, noise) in SHOWN {
        let scene = shapes::all().into_iter().find(|scene| scene.name == name);
        let scene = scene.ok_or("no such scene")?;
        let (sheet, caption) = show(&scene, noise)?;
        let photo = Photo::new(sheet.width, sheet.rgba.len() / 4 / sheet.width, &sheet.rgba)?;
        fs::write(
            folder.join(format!("scenes/{name}.png")),
            write_photo(&photo, &PhotoOptions::default())?,
        )?;
        page += &format!("\n## {name}, {noise}\n\n![{name}](scenes/{name}.png)\n\n{caption}\n");
        eprintln!("{name}");
    }
    fs::write(folder.join("scenes.md"), page)?;
    Ok(())
}

fn show(scene: &Scene, noise: Noise) -> Result<(Sheet, String), Error> {
    let lattice = Lattice::covering([0.0, 0.0], [1.0, 1.0], 1.0 / SIZE as f64)?;
    let truth = Heightfield::from_fn(lattice, scene.height)?;
    let input = noise.add_to(&truth)?;
    let first = 8.0 * SIZE as f64 / noise.sigma(&truth);
    let solve = |options: Options| -> Result<(Distance, Heightfield), Error> {
        let surface = fit(&input, &options)?.into_heightfield();
        Ok((Distance::between(&truth, &surface), surface))
    };
    let mut nuclear = solve(Options::paper().lambda(first))?;
    for decade in DECADES {
        let other = solve(Options::paper().lambda(first * 10f64.powf(decade)))?;
        if other.0.normals < nuclear.0.normals {
            nuclear = other;
        }
    }
    let own = solve(Options::default())?;
    let before = Distance::between(&truth, &input);
    let caption = format!(
        "Mean angle between normals and the true ones: {:.2}° in the input, {:.2}° by the nuclear norm, \
         {:.2}° by `huber`.",
        before.normals, nuclear.0.normals, own.0.normals
    );
    let mut sheet = Sheet::default();
    let columns = [&input, &truth, &nuclear.1, &own.1];
    sheet.add(
        &columns
            .map(shaded)
            .into_iter()
            .collect::<Result<Vec<_>, _>>()?,
    );
    let end = 2.0 * noise.sigma(&truth);
    let errors = columns.map(|surface| error(surface, &truth, end));
    sheet.add(&errors.into_iter().collect::<Result<Vec<_>, _>>()?);
    Ok((sheet, caption))
}

/// RGBA, of one width.
#[derive(Default)]
struct Sheet {
    width: usize,
    rgba: Vec<u8>,
}

impl Sheet {
    /// Adds a row of pictures, each with its rows of pixels.
    fn add(&mut self, pictures: &[Vec<Vec<u8>>]) {
        let rows = pictures.iter().map(Vec::len).max().unwrap_or(0);
        self.width = pictures.len() * (WIDTH + MARGIN) - MARGIN;
        for row in 0..rows {
            for (i, picture) in pictures.iter().enumerate() {
                let margin = if i == 0 { 0 } else { 4 * MARGIN };
                self.rgba.resize(self.rgba.len() + margin, 0);
                self.rgba
                    .extend(picture.get(row).map_or(&[0; 4 * WIDTH][..], Vec::as_slice));
            }
        }
        self.rgba
            .resize(self.rgba.len() + 4 * MARGIN * self.width, 0);
    }
}

fn shaded(surface: &Heightfield) -> Result<Vec<Vec<u8>>, Error> {
    let picture = Picture::new(surface, &PictureOptions::default().width(WIDTH))?;
    Ok(picture
        .rgba()
        .chunks(4 * WIDTH)
        .map(<[u8]>::to_vec)
        .collect())
}

/// Blue, white and red for `-end`, 0 and `end`.
fn error(surface: &Heightfield, truth: &Heightfield, end: f64) -> Result<Vec<Vec<u8>>, Error> {
    let pairs = surface.heights().iter().zip(truth.heights());
    let difference = Heightfield::new(*truth.lattice(), pairs.map(|(a, b)| a - b).collect())?;
    let like = HeightImage::new(WIDTH, WIDTH, vec![0.0; WIDTH * WIDTH])?
        .with_pixel_size(1.0 / WIDTH as f64)?;
    let image = difference.to_image(&like)?;
    let pixel = |z: &f64| {
        let share = (z / end).clamp(-1.0, 1.0);
        let rest = (255.0 * (1.0 - share.abs())).round() as u8;
        match share < 0.0 {
            true => [rest, rest, 255, 255],
            false => [255, rest, rest, 255],
        }
    };
    let rows = image.values().chunks(WIDTH);
    Ok(rows
        .map(|row| row.iter().flat_map(pixel).collect())
        .collect())
}
