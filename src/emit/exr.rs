//! EXR images of tables: one layer, one channel per quantity, with the header as string attributes.
//! Tables of two axes are uncompressed; those of three, megabytes, are compressed without loss
//! (ZIP, blocks of 16 rows). The format has no third dimension: slices lie one below the other,
//! slice z in the rows z * rows to z * rows + rows - 1.

use std::io::Cursor;

use ::exr::image::Blocks;
use ::exr::image::write::WritableImage;
use ::exr::meta::attribute::{AttributeValue, Text};
use ::exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, LineOrder,
    ReadChannels, ReadLayers, SmallVec, read,
};
use half::f16;

use crate::data::{Channel, Table, TexelFormat};

/// A table that could not be turned into an EXR file, or a file that could not be read as one.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExrError {
    /// The encoder refused.
    #[error("{table}: cannot be written as EXR: {reason}")]
    Write {
        /// Table's name.
        table: String,
        /// The encoder's words.
        reason: String,
    },
    /// The decoder refused.
    #[error("not a readable EXR file: {reason}")]
    Read {
        /// The decoder's words.
        reason: String,
    },
}

/// A decoded image: width, height, channels by name.
#[derive(Clone, Debug, PartialEq)]
pub struct Decoded {
    /// Columns.
    pub width: usize,
    /// Rows, those of all slices together.
    pub height: usize,
    /// Channels in the file's order (alphabetical).
    pub channels: Vec<Channel>,
}

/// The bytes of a table: an image of columns x (rows * slices). `header` becomes string attributes
/// of the layer (name, text).
pub fn encode(table: &Table, header: &[(String, String)]) -> Result<Vec<u8>, ExrError> {
    let [columns, rows, slices] = table.size();
    let size = (columns, rows * slices);
    let channels: SmallVec<[AnyChannel<FlatSamples>; 4]> =
        table.channels.iter().map(|c| AnyChannel::new(c.name.as_str(), samples(c, table.format))).collect();
    let mut attributes = LayerAttributes::named(table.name.as_str());
    attributes.software_name = Some(Text::from(concat!("lobefit ", env!("CARGO_PKG_VERSION"))));
    for (name, text) in header {
        attributes.other.insert(Text::from(name.as_str()), AttributeValue::Text(Text::from(text.as_str())));
    }
    let layer = Layer::new(size, attributes, encoding(table), AnyChannels::sort(channels));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .map_err(|e| ExrError::Write { table: table.name.clone(), reason: e.to_string() })?;
    Ok(bytes.into_inner())
}

/// How the texels are stored.
fn encoding(table: &Table) -> Encoding {
    match table.axes.len() {
        3.. => Encoding {
            compression: Compression::ZIP16,
            blocks: Blocks::ScanLines,
            line_order: LineOrder::Increasing,
        },
        _ => Encoding::UNCOMPRESSED,
    }
}

fn samples(channel: &Channel, format: TexelFormat) -> FlatSamples {
    match format {
        TexelFormat::F16 => FlatSamples::F16(channel.texels.iter().map(|t| f16::from_f64(*t)).collect()),
        // EXR has no format of integers / 65535; a single holds each to 3e-8.
        TexelFormat::Unorm8 | TexelFormat::Unorm16 => {
            FlatSamples::F32(channel.texels.iter().map(|t| format.quantise(*t) as f32).collect())
        }
        TexelFormat::F32 => FlatSamples::F32(channel.texels.iter().map(|t| *t as f32).collect()),
    }
}

/// The texels of an EXR file of one layer.
pub fn decode(bytes: &[u8]) -> Result<Decoded, ExrError> {
    let reason = |e: ::exr::error::Error| ExrError::Read { reason: e.to_string() };
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(reason)?;
    let layer = image.layer_data;
    let channels = layer.channel_data.list.iter().map(|c| Channel {
        name: c.name.to_string(),
        texels: c.sample_data.values_as_f32().map(f64::from).collect(),
    });
    Ok(Decoded { width: layer.size.0, height: layer.size.1, channels: channels.collect() })
}
