//! Reads heights from one channel of OpenEXR images and writes them, by the `exr` crate.

use std::io::Cursor;

use ::exr::block::UncompressedBlock;
use ::exr::block::reader::ChunksReader;
use ::exr::error::Error as ExrError;
use ::exr::meta::attribute::{AttributeValue, ChannelDescription, SampleType, Text};
use ::exr::meta::header::{Header, LayerAttributes};
use ::exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, Vec2, WritableImage, f16,
};

use super::samples::narrowed;
use crate::error::{Error, Result, checked_cells, try_filled};
use crate::files::Assumption;
use crate::files::buffer::reserve;
use crate::files::failure::{check_length, damaged, not_read, undecodable};
use crate::files::images::decoded::{StoredImage, recorded_sides};
use crate::files::images::grey::{Channels, grey};
use crate::files::number_type::NumberType;
use crate::heights::heightfield::HeightImage;

/// Name of the OpenEXR attribute that holds the pixel size; only files written by this library have it.
const PIXEL_SIZE: &str = "developable:pixelSize";

/// Decodes the channel of a given name, or the one that has heights by its name.
pub(super) fn decode(bytes: &[u8], channel: Option<&str>) -> Result<StoredImage> {
    let reader = ::exr::block::read(Cursor::new(bytes), false).map_err(failed)?;
    let (layer, chosen) = choose_channels(reader.headers(), channel)?;
    let header = &reader.headers()[layer];
    let Vec2(width, height) = header.layer_size;
    let len = checked_cells("EXR image", height, width)?;
    if len == 0 {
        return Err(Error::Empty { what: "EXR image" });
    }
    let pixel_bytes = header.channels.bytes_per_pixel;
    check_length(bytes, len.saturating_mul(pixel_bytes))?;
    let number_type = match header.channels.list[chosen.heights[0]].sample_type {
        SampleType::U32 => NumberType::U32,
        SampleType::F16 => NumberType::F16,
        SampleType::F32 => NumberType::F32,
    };
    let pixel_size = match header.own_attributes.other.get(&Text::from(PIXEL_SIZE)) {
        Some(AttributeValue::F64(size)) if size.is_finite() && *size > 0.0 => Some(*size),
        _ => None,
    };

    let channels = header.channels.clone();
    let wanted: Vec<usize> = (chosen.heights.iter().chain(&chosen.alpha))
        .copied()
        .collect();
    let planes = wanted
        .iter()
        .map(|_| try_filled("EXR image", len, f64::NAN));
    let mut planes = planes.collect::<Result<Vec<_>>>()?;
    let mut missing = wanted.len() * len;
    let mut blocks = reader
        .filter_chunks(false, |_, tile, block| {
            block.layer == layer && tile.is_largest_resolution_level()
        })
        .map_err(failed)?
        .sequential_decompressor(false);
    while let Some(block) = blocks.decompress_next_block() {
        let block: UncompressedBlock = block.map_err(failed)?;
        if block.index.layer != layer || block.index.level != Vec2(0, 0) {
            return Err(damaged("a block is not where it should be"));
        }
        for line in block.lines(&channels) {
            let Some(plane) = wanted.iter().position(|k| *k == line.location.channel) else {
                continue;
            };
            let Vec2(x, y) = line.location.position;
            let row = y * width + x..y * width + x + line.location.sample_count;
            let outside = || damaged("a block lies outside of the image");
            let out = planes[plane].get_mut(row).ok_or_else(outside)?;
            missing = missing.saturating_sub(out.len());
            match channels.list[wanted[plane]].sample_type {
                SampleType::F32 => fill(out, line.read_samples::<f32>()),
                SampleType::F16 => fill(out, line.read_samples::<f16>()),
                SampleType::U32 => fill(out, line.read_samples::<u32>()),
            }
            .map_err(failed)?;
        }
    }
    if missing > 0 {
        return Err(damaged("a part of the image is missing"));
    }
    let size = (width, height);
    let layout = Channels {
        colours: chosen.heights.len(),
        alpha: chosen.alpha.map(|_| chosen.heights.len()),
    };
    let values = grey(size, &layout, |i, k| planes[k][i])?;
    Ok(StoredImage {
        sides: pixel_size.and_then(recorded_sides),
        // Pictures have levels from 0 to 1: whole numbers are what they say.
        height_scale: Some(1.0),
        assumptions: chosen.assumption.into_iter().collect(),
        ..StoredImage::new(size, values, number_type)
    })
}

/// Puts the samples of a line in their places.
fn fill<T: Into<f64>>(
    out: &mut [f64],
    samples: impl Iterator<Item = std::result::Result<T, ExrError>>,
) -> std::result::Result<(), ExrError> {
    for (z, sample) in out.iter_mut().zip(samples) {
        *z = sample?.into();
    }
    Ok(())
}

/// Channels of an OpenEXR layer from which heights and alpha are read, by their indices in the layer's list of
/// channels.
struct ChosenChannels {
    heights: Vec<usize>,
    alpha: Option<usize>,
    /// What is said where other channels have heights, too.
    assumption: Option<Assumption>,
}

/// A channel of an OpenEXR file: its layer and its index there, the group to which it belongs, and its name, in small letters.
struct NamedChannel {
    layer: usize,
    index: usize,
    group: String,
    name: String,
    /// Group and name as the file has them.
    full: String,
}

/// Names of channels of heights or depths, the surest first.
const HEIGHT_NAMES: [&str; 6] = ["z", "depth", "height", "elevation", "displacement", "y"];

/// Finds the channels of an OpenEXR file that hold heights, or the one of a given name; returns the number of their layer and the
/// channels.
fn choose_channels(layers: &[Header], wanted: Option<&str>) -> Result<(usize, ChosenChannels)> {
    let flat = layers.iter().enumerate().filter(|(_, header)| !header.deep);
    let named: Vec<NamedChannel> = flat.flat_map(named_channels).collect();
    let Some((layer, chosen)) = heights_among(&named, layers, wanted) else {
        let names: Vec<&str> = named.iter().map(|channel| &*channel.full).collect();
        let names = format!("`{}`", names.join("`, `"));
        return Err(not_read(match wanted {
            _ if named.is_empty() => "deep data; only flat images are read".into(),
            Some(wanted) => format!("it has no channel `{wanted}`, only {names}"),
            None => format!(
                "its channels are {names}; `Z`, `depth`, `height` or `Y` is read, grey `R`, `G`, `B`, or the only one there is; \
                 choose one by the option `array`"
            ),
        }));
    };
    // The decoder assumes longer lines than subsampled channels have.
    let is_plain = |channel: &ChannelDescription| channel.sampling == Vec2(1, 1);
    if !layers[layer].channels.list.iter().all(is_plain) {
        let reason = "subsampled channels; write it with one sample for each pixel";
        return Err(not_read(reason));
    }
    Ok((layer, chosen))
}

/// The channels of a layer. Their names begin with their group, or it is the layer of that name.
fn named_channels((layer, header): (usize, &Header)) -> impl Iterator<Item = NamedChannel> {
    let layer_name = header.own_attributes.layer_name.as_ref();
    (header.channels.list.iter().enumerate()).map(move |(index, channel)| {
        let own = channel.name.to_string();
        let full = match layer_name.filter(|_| !own.contains('.')) {
            Some(layer_name) => format!("{layer_name}.{own}"),
            None => own,
        };
        let lower = full.to_lowercase();
        let (group, name) = lower.rsplit_once('.').unwrap_or(("", &lower));
        NamedChannel {
            layer,
            index,
            group: group.to_owned(),
            name: name.to_owned(),
            full,
        }
    })
}

/// Chooses among the channels of all layers, since a picture often stands before its depths.
fn heights_among(
    named: &[NamedChannel],
    layers: &[Header],
    wanted: Option<&str>,
) -> Option<(usize, ChosenChannels)> {
    // Blender calls the value of its depth pass `Depth.Z` or `Depth.V`; other passes have a `Z` of their own.
    let of_depth = |one: &NamedChannel| one.group.rsplit('.').next() == Some("depth");
    let beside = |one: &NamedChannel, wanted: &str| {
        named.iter().find(|other| {
            (other.layer, &other.group, &*other.name) == (one.layer, &one.group, wanted)
        })
    };
    let is_grey =
        |one: &NamedChannel| one.name == "r" && beside(one, "g").and(beside(one, "b")).is_some();
    // The first of them is the surest one.
    let rank = |one: &NamedChannel| {
        if let Some(wanted) = wanted {
            return one.full.eq_ignore_ascii_case(wanted).then_some(0);
        }
        // The coordinates of a normal or of a place in the scene are no depths.
        let is_of_vector = !one.group.is_empty() && beside(one, "x").is_some();
        let name = HEIGHT_NAMES
            .iter()
            .position(|name| *name == one.name && !is_of_vector);
        let behind = HEIGHT_NAMES.len();
        match name {
            _ if of_depth(one) && ["v", "z"].contains(&&*one.name) => Some(0),
            Some(place) => Some(1 + place),
            None if is_grey(one) => Some(behind + if of_depth(one) { 1 } else { 2 }),
            None => (layers[one.layer].channels.list.len() == 1).then_some(behind + 3),
        }
    };
    let best = named.iter().filter_map(rank).min()?;
    let mut meant = named.iter().filter(|one| rank(one) == Some(best));
    let chosen = meant.next()?;
    let others: Vec<&str> = meant.map(|other| &*other.full).collect();
    let assumption = (!others.is_empty()).then(|| {
        let words = format!(
            "`{}` is meant, and not `{}`",
            chosen.full,
            others.join("`, `")
        );
        Assumption::new("channel", words, "array")
    });
    let colours = match wanted.is_none() && is_grey(chosen) {
        true => &["r", "g", "b"][..],
        false => &[&*chosen.name],
    };
    let heights = colours.iter().filter_map(|name| beside(chosen, name));
    let chosen_channels = ChosenChannels {
        heights: heights.map(|one| one.index).collect(),
        alpha: (beside(chosen, "a").map(|one| one.index)).filter(|index| *index != chosen.index),
        assumption,
    };
    Some((chosen.layer, chosen_channels))
}

fn failed(error: ExrError) -> Error {
    match error {
        ExrError::NotSupported(what) => not_read(what),
        other => undecodable(other),
    }
}

/// Writes a height image as an OpenEXR file, of which an attribute records the pixel size.
pub(super) fn write_exr(image: &HeightImage) -> Result<Vec<u8>> {
    let heights = narrowed("EXR image", image)?;
    // Blocks that do not shrink are stored as they are, each with a few bytes of its own.
    let enough = 4 * heights.len() + 32 * image.height() + 4096;
    let mut file = Vec::new();
    reserve(&mut file, "EXR file", enough)?;
    let mut file = Cursor::new(file);
    let mut attributes = LayerAttributes::default();
    attributes.other.insert(
        Text::from(PIXEL_SIZE),
        AttributeValue::F64(image.pixel_size()),
    );
    let channel = AnyChannel::new("Z", FlatSamples::F32(heights));
    let layer = Layer::new(
        (image.width(), image.height()),
        attributes,
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort([channel].into_iter().collect()),
    );
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut file)
        .map_err(failed)?;
    Ok(file.into_inner())
}

#[cfg(test)]
mod tests {
    use ::exr::meta::attribute::IntegerBounds;
    use ::exr::meta::header::ImageAttributes;

    use super::*;

    /// An OpenEXR file of layers, each with its name and its channels, of which a value fills the two pixels.
    fn layers(stated: &[(&str, &[(&str, f32)])]) -> Vec<u8> {
        let layers = stated.iter().map(|(name, channels)| {
            let filled = |(name, value): &(&str, f32)| {
                AnyChannel::new(*name, FlatSamples::F32(vec![*value; 2]))
            };
            Layer::new(
                (2, 1),
                LayerAttributes::named(*name),
                Encoding::UNCOMPRESSED,
                AnyChannels::sort(channels.iter().map(filled).collect()),
            )
        });
        let mut file = Cursor::new(Vec::new());
        let attributes = ImageAttributes::new(IntegerBounds::from_dimensions((2, 1)));
        let image = Image::from_layers(attributes, layers.collect::<Vec<_>>());
        image.write().non_parallel().to_buffered(&mut file).unwrap();
        file.into_inner()
    }

    #[test]
    fn depths_are_found_behind_the_picture() {
        let black = [("R", 0.0), ("G", 0.0), ("B", 0.0)];
        let coloured = [("R", 0.1), ("G", 0.2), ("B", 0.3)];
        let grey = [("R", 5.0), ("G", 5.0), ("B", 5.0)];
        for parts in [
            [("rgba", &black[..]), ("deep", &[("Z", 5.0)][..])],
            [("beauty", &coloured), ("Depth", &grey)],
            [("beauty", &coloured), ("", &[("height", 5.0)])],
            [
                ("beauty", &coloured),
                ("", &[("depth.V", 5.0), ("depth.R", 4.0)]),
            ],
        ] {
            let read = decode(&layers(&parts), None).unwrap();
            assert_eq!((read.values, read.assumptions.len()), (vec![5.0; 2], 0));
        }
    }

    #[test]
    fn one_of_several_depths_is_said_and_can_be_chosen() {
        let file = layers(&[
            ("left", &[("Z", 5.0)]),
            ("Right", &[("Z", 7.0), ("A", 1.0)]),
        ]);
        let read = decode(&file, None).unwrap();
        assert_eq!(read.values, [5.0; 2]);
        assert_eq!(
            read.assumptions[0].words,
            "`left.Z` is meant, and not `Right.Z`"
        );
        let read = decode(&file, Some("right.Z")).unwrap();
        assert_eq!((read.values, read.assumptions.len()), (vec![7.0; 2], 0));
        let error = decode(&file, Some("Z")).unwrap_err().to_string();
        assert!(
            error.contains("only `left.Z`, `Right.A`, `Right.Z`"),
            "{error}"
        );
    }

    #[test]
    fn coordinates_of_a_normal_are_no_depths() {
        let normals = [("N.X", 0.0), ("N.Y", 0.0), ("N.Z", 1.0)];
        let error = decode(&layers(&[("", &normals)]), None).unwrap_err();
        assert!(error.to_string().contains("`N.Z`"), "{error}");
        let points = [("X", 1.0), ("Y", 2.0), ("Z", 5.0)];
        assert_eq!(
            decode(&layers(&[("", &points)]), None).unwrap().values,
            [5.0; 2]
        );
    }
}
