//! OpenEXR images: flat layers of half, single and integer channels of any names, the largest
//! resolution level.

use std::cell::Cell;
use std::io::{Cursor, Read, Seek, SeekFrom};

use ::exr::error::Error;
use ::exr::image::{AnyChannels, Layer};
use ::exr::meta::MetaData;
use ::exr::meta::attribute::AttributeValue;
use ::exr::meta::header::Header;
use ::exr::prelude::{Compression, FlatSamples, ReadChannels, ReadLayers, SampleType, read as reader};

use super::packed::Source;
use super::{Image, claimed, guarded};
use crate::foreign::{Channel, ForeignError, ForeignTable, Hints, Step, limits};

/// The tables of an image: one per layer, or the one that is asked for.
pub fn read(bytes: &[u8], file: &str, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    guarded(file, "EXR", || decode(Source { bytes, file }, hints))
}

fn decode(source: Source, hints: &Hints) -> Result<Vec<ForeignTable>, ForeignError> {
    let reached = Cell::new(0);
    let watched = || Watched { bytes: Cursor::new(source.bytes), reached: &reached };
    let damaged = |e: Error, what: &str| match e {
        Error::NotSupported(what) => source.unsupported(
            0,
            format!("an EXR file with {what}"),
            "save it uncompressed or with ZIP, as flat scan lines",
        ),
        e => {
            let (length, at) = (source.bytes.len(), reached.get());
            let message = if at < length as u64 {
                format!(
                    "{e}: read so far of the {length} bytes of the file, {what} being read: it is damaged"
                )
            } else {
                format!(
                    "{e}: the file ends after {length} bytes, {what} being read: it is cut short or damaged"
                )
            };
            source.malformed(at, message)
        }
    };
    let header = MetaData::read_from_buffered(watched(), false);
    let meta = header.map_err(|e| damaged(e, "the header and the list of where its texels begin"))?;
    check(source, &meta.headers)?;
    let texels = texels(&meta.headers);
    let image = reader()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(watched())
        .map_err(|e| damaged(e, &texels))?;
    let mut images: Vec<Image> = image.layer_data.iter().map(|layer| flat(source.file, layer)).collect();
    if let Some(asked) = &hints.layer {
        images = named(source.file, images, asked)?;
    }
    images.into_iter().map(|image| image.table(hints)).collect()
}

/// What the texels are, for messages.
fn texels(headers: &[Header]) -> String {
    let of = |h: &Header| {
        format!("{} x {} texels of {} channels", h.layer_size.0, h.layer_size.1, h.channels.list.len())
    };
    format!("its {}", headers.iter().map(of).collect::<Vec<_>>().join(" and "))
}

/// Bytes that are read, with how far.
struct Watched<'a> {
    bytes: Cursor<&'a [u8]>,
    /// End of what was read last.
    reached: &'a Cell<u64>,
}

impl Read for Watched<'_> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        let count = self.bytes.read(into)?;
        self.reached.set(self.bytes.position());
        Ok(count)
    }
}

impl Seek for Watched<'_> {
    fn seek(&mut self, to: SeekFrom) -> std::io::Result<u64> {
        self.bytes.seek(to)
    }
}

/// Refuses sizes beyond the limits, and what a table is not made of, before texels are read.
fn check(source: Source, headers: &[Header]) -> Result<(), ForeignError> {
    let (mut values, mut length) = (0, 0);
    for header in headers {
        let size = [header.layer_size.0 as u64, header.layer_size.1 as u64];
        values += claimed(source.file, &size, header.channels.list.len() as u64)?;
        length += size[0] * size[1] * header.channels.list.iter().map(|c| bytes(c.sample_type)).sum::<u64>();
        if header.deep {
            return Err(source.unsupported(0, "an EXR file of deep texels", "save it as flat scan lines"));
        }
        if let Some(channel) = header.channels.list.iter().find(|c| c.sampling.0 != 1 || c.sampling.1 != 1) {
            let what = format!("channel {} with fewer samples than texels", channel.name);
            return Err(source.unsupported(0, what, "save it with one sample per texel"));
        }
    }
    if values > limits::VALUES {
        return Err(ForeignError::too_large(source.file, "values of all layers", values, limits::VALUES));
    }
    if length > limits::EXPANSION * source.bytes.len() as u64 {
        let message = format!(
            "{} bytes cannot hold the {length} of its texels: a size in the header is wrong",
            source.bytes.len()
        );
        return Err(source.malformed(0, message));
    }
    Ok(())
}

fn bytes(kind: SampleType) -> u64 {
    match kind {
        SampleType::F16 => 2,
        SampleType::F32 | SampleType::U32 => 4,
    }
}

fn flat(file: &str, layer: &Layer<AnyChannels<FlatSamples>>) -> Image {
    let list = &layer.channel_data.list;
    let has = |kind: SampleType| list.iter().any(|c| sample_type(&c.sample_data) == kind);
    let kinds = [(SampleType::F16, "half"), (SampleType::F32, "single"), (SampleType::U32, "32-bit integer")];
    let words: Vec<&str> = kinds.iter().filter(|(kind, _)| has(*kind)).map(|(_, word)| *word).collect();
    let lossy = match layer.encoding.compression {
        Compression::B44 | Compression::B44A => ", compressed with loss (B44)",
        Compression::PXR24 if has(SampleType::F32) => ", compressed with loss (PXR24)",
        Compression::DWAA(_) | Compression::DWAB(_) => ", compressed with loss (DWA)",
        _ => "",
    };
    let step = match (has(SampleType::U32), has(SampleType::F16)) {
        (true, _) => Step::Decimals(0),
        (_, true) => Step::Half,
        _ => Step::None,
    };
    Image {
        file: file.into(),
        name: layer.attributes.layer_name.as_ref().map_or(String::new(), ToString::to_string),
        kind: format!("EXR, {}{lossy}", words.join(" and ")),
        size: vec![layer.size.0, layer.size.1],
        channels: in_order(list.iter().map(|c| channel(c.name.to_string(), &c.sample_data)).collect()),
        step,
        note: match layer.attributes.other.iter().find(|(name, _)| *name == "lobefit") {
            Some((_, AttributeValue::Text(text))) => text.to_string(),
            _ => String::new(),
        },
    }
}

fn sample_type(samples: &FlatSamples) -> SampleType {
    match samples {
        FlatSamples::F16(_) => SampleType::F16,
        FlatSamples::F32(_) => SampleType::F32,
        FlatSamples::U32(_) => SampleType::U32,
    }
}

fn channel(name: String, samples: &FlatSamples) -> Channel {
    let values: Vec<f64> = match samples {
        FlatSamples::F16(values) => values.iter().map(|v| v.to_f64()).collect(),
        FlatSamples::F32(values) => values.iter().map(|v| f64::from(*v)).collect(),
        FlatSamples::U32(values) => values.iter().map(|v| f64::from(*v)).collect(),
    };
    Channel { name, values: values.into() }
}

/// Channels of colours in the order in which a reader names them, in each layer by itself: a file holds them
/// by the alphabet, A and B before R. Without red, A and B are no colours.
fn in_order(mut channels: Vec<Channel>) -> Vec<Channel> {
    let split = |c: &Channel| {
        let (layer, name) = c.name.rsplit_once('.').unwrap_or(("", &c.name));
        (layer.to_string(), "RGBA".find(name).filter(|_| name.len() == 1))
    };
    for layer in channels.chunk_by_mut(|a, b| split(a).0 == split(b).0) {
        let place = |c: &Channel| split(c).1;
        if layer.iter().all(|c| place(c).is_some()) && layer.iter().any(|c| place(c) == Some(0)) {
            layer.sort_by_key(place);
        }
    }
    channels
}

/// The layer of a name: a part of the file, or the channels `name.*` of one.
fn named(file: &str, images: Vec<Image>, asked: &str) -> Result<Vec<Image>, ForeignError> {
    let prefix = format!("{asked}.");
    let mut known: Vec<String> = Vec::new();
    for image in &images {
        known.push(image.name.clone());
        let prefixes = image.channels.iter().filter_map(|c| c.name.rsplit_once('.'));
        known.extend(prefixes.map(|(prefix, _)| prefix.to_string()));
    }
    known.dedup();
    let part = images.iter().position(|image| image.name == asked);
    let inside = images.iter().position(|i| i.channels.iter().any(|c| c.name.starts_with(&prefix)));
    let Some(index) = part.or(inside) else {
        return Err(ForeignError::no_such(file, "layer", asked, &known));
    };
    let mut found: Vec<Image> = images.into_iter().skip(index).take(1).collect();
    if part.is_none() {
        for image in &mut found {
            image.name = asked.into();
            image.channels.retain(|c| c.name.starts_with(&prefix));
            image.channels.iter_mut().for_each(|c| c.name = c.name[prefix.len()..].into());
        }
    }
    Ok(found)
}
