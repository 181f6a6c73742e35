//! What a file without room for a header holds, as a JSON file beside it.

use std::collections::BTreeMap;

use serde::Serialize;

use super::container::Described;
use super::manifest::AxisEntry;
use super::{dds, npy};
use crate::data::{Certificate, Container, Smith};

/// Version of the sidecar's form.
pub const SCHEMA_VERSION: u32 = 1;

/// How the texels lie in the file.
const ORDER: &str = "x (columns) fastest, then y (rows), then z (slices); the channels of a texel together";

#[derive(Serialize)]
struct Sidecar<'a> {
    schema_version: u32,
    name: &'a str,
    quantity: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    smith: Option<&'static str>,
    alpha_map: &'static str,
    container: &'static str,
    /// Type of a stored number.
    stored: &'static str,
    /// The DXGI_FORMAT of a DDS file.
    #[serde(skip_serializing_if = "Option::is_none")]
    dxgi_format: Option<&'static str>,
    byte_order: &'static str,
    order: &'static str,
    /// Bytes before the first texel.
    offset: usize,
    /// Columns, rows, slices.
    size: [usize; 3],
    channels: Vec<&'a str>,
    /// Zeros after the channels of each texel.
    padding_channels: usize,
    /// What texels were rounded to.
    format: &'static str,
    decode: BTreeMap<&'static str, &'static str>,
    axes: Vec<AxisEntry>,
    certificate: &'a Certificate,
    header: &'a [String],
}

/// The JSON bytes for a file of this container: keys in a fixed order, a line feed at the end.
pub fn encode(container: Container, described: &Described) -> Result<Vec<u8>, serde_json::Error> {
    let Described { table, decode, certificate, header } = *described;
    let is_dds = container == Container::Dds;
    let sidecar = Sidecar {
        schema_version: SCHEMA_VERSION,
        name: &table.name,
        quantity: &table.quantity,
        smith: table.smith.map(Smith::name),
        alpha_map: table.alpha_map.name(),
        container: container.name(),
        stored: if container == Container::Raw { "f32" } else { table.format.name() },
        dxgi_format: dds::format(table).filter(|_| is_dds).map(|(name, _)| name),
        byte_order: "little-endian",
        order: ORDER,
        offset: match container {
            Container::Dds => dds::OFFSET,
            Container::Npy => npy::offset(table),
            _ => 0,
        },
        size: table.size(),
        channels: table.channels.iter().map(|c| c.name.as_str()).collect(),
        padding_channels: if is_dds { dds::stored_channels(table) - table.channels.len() } else { 0 },
        format: table.format.name(),
        decode: decode.formulas().iter().copied().collect(),
        axes: table.axes.iter().map(AxisEntry::new).collect(),
        certificate,
        header,
    };
    let mut bytes = serde_json::to_vec_pretty(&sidecar)?;
    bytes.push(b'\n');
    Ok(bytes)
}
