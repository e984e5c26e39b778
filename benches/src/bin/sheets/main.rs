//! Pages of photos in a folder made flat by traced edges.

use std::path::Path;
use std::time::Instant;

use developable::dewarp::{DewarpOptions, Photo};
use developable::page::{Edges, FocalLength, Format, PageOptions, SheetPage, Trace};

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

fn main() -> Outcome<()> {
    let mut arguments = std::env::args().skip(1);
    let mut next = |what: &str| arguments.next().ok_or(format!("{what} is missing"));
    let (photos, edges, out) = (next("folder of photos")?, next("folder of edges")?, next("folder of results")?);
    let filter = arguments.next().unwrap_or_default();
    std::fs::create_dir_all(&out)?;
    let mut names: Vec<_> = std::fs::read_dir(&edges)?
        .filter_map(|entry| Some(entry.ok()?.path().file_stem()?.to_str()?.to_owned()))
        .filter(|name| name.contains(&filter))
        .collect();
    names.sort();
    let mut report = String::new();
    for name in names {
        let parts: Vec<&str> = name.split('_').collect();
        let path = format!("{photos}/{}/warped_document_{}_{}.jpg", parts[0], parts[1], parts[2]);
        match flat(&path, &format!("{edges}/{name}.json"), &format!("{out}/{name}.png")) {
            Ok(line) => report += &format!("{name} {line}\n"),
            Err(error) => eprintln!("{name} {error}"),
        }
    }
    std::fs::write(format!("{out}/report.txt"), report)?;
    Ok(())
}

fn flat(photo: &str, edges: &str, out: &str) -> Outcome<String> {
    let decoded = developable::files::images::decode_photo(&std::fs::read(photo)?)?;
    let value: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(edges)?)?;
    let trace = |name: &str| -> Outcome<Trace> {
        Ok(Trace::Points(serde_json::from_value(value[name].clone())?))
    };
    let edges = Edges::All { top: trace("top")?, bottom: trace("bottom")?, left: trace("left")?, right: trace("right")? };
    let photo = Photo::new(decoded.width, decoded.height, &decoded.rgba)?;
    let mut options = PageOptions::default().format(Format::A4);
    if std::env::var("NOFOCAL").is_err() {
        options = options.focal_length(FocalLength::Pixels(3004.0));
    }
    let _ = Path::new(out);
    let start = Instant::now();
    let page = SheetPage::in_photo(&edges, &photo, &options)?;
    let time = start.elapsed().as_secs_f64();
    let map = page.warp_map(&DewarpOptions::default().dots(1000.0))?;
    let image = map.image(&photo)?;
    std::fs::write(out, developable::files::images::encode_png_rgba(map.width(), map.height(), &image)?)?;
    Ok(format!("{time:.2}s {}", page.figures()))
}
