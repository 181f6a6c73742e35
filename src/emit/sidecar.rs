//! What a file without room for a header holds, as a JSON file beside it: written by a bake, read
//! back by an audit.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::container::Described;
use super::manifest::AxisEntry;
use super::texels::Packed;
use super::texture::Texel;
use super::{dds, ktx2};
use crate::data::{Certificate, Container, Smith, TexelFormat};

/// Version of the sidecar's form.
pub const SCHEMA_VERSION: u32 = 1;

/// How the texels lie in the file.
const ORDER: &str = "x (columns) fastest, then y (rows), then z (slices); the channels of a texel together";

/// GPUTextureFormat by name.
const WEBGPU: [[&str; 3]; 4] = [
    ["r8unorm", "rg8unorm", "rgba8unorm"],
    ["r16unorm", "rg16unorm", "rgba16unorm"],
    ["r16float", "rg16float", "rgba16float"],
    ["r32float", "rg32float", "rgba32float"],
];

/// The document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sidecar {
    /// Version of this form: 1.
    pub schema_version: u32,
    /// Table's name.
    pub name: String,
    /// Its quantity.
    pub quantity: String,
    /// Shadowing form, of a quantity that has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub smith: Option<String>,
    /// Roughness to alpha.
    pub alpha_map: String,
    /// Format of the file.
    pub container: Container,
    /// Type of a stored number.
    pub stored: TexelFormat,
    /// DXGI_FORMAT of a DDS file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dxgi_format: Option<String>,
    /// VkFormat of a KTX 2 file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vk_format: Option<String>,
    /// GPUTextureFormat of a texture, as WebGPU calls it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub webgpu_format: Option<String>,
    /// Of a stored number.
    pub byte_order: String,
    /// How the texels lie in the file, in words.
    pub order: String,
    /// Bytes before the first texel.
    pub offset: usize,
    /// Columns, rows, slices.
    pub size: [usize; 3],
    /// Channels by name.
    pub channels: Vec<String>,
    /// Zeros after the channels of each texel.
    pub padding_channels: usize,
    /// What texels were rounded to.
    pub format: TexelFormat,
    /// What the channels mean, by column.
    pub decode: BTreeMap<String, String>,
    /// Axes in the order x, y, z.
    pub axes: Vec<AxisEntry>,
    /// Error of the lookup.
    pub certificate: Certificate,
    /// The lines that every emitted file bears.
    pub header: Vec<String>,
}

impl Sidecar {
    /// That of a file of this container.
    pub fn new(container: Container, described: &Described, packed: &Packed) -> Sidecar {
        let Described { table, decode, certificate, header } = *described;
        let texel = Texel::of(table).filter(|_| matches!(container, Container::Dds | Container::Ktx2));
        let format = |of: Container, name: fn(Texel) -> (&'static str, u32)| {
            texel.filter(|_| container == of).map(|texel| name(texel).0.to_string())
        };
        let formulas = decode.formulas().iter();
        Sidecar {
            schema_version: SCHEMA_VERSION,
            name: table.name.clone(),
            quantity: table.quantity.clone(),
            smith: table.smith.map(|smith| Smith::name(smith).into()),
            alpha_map: table.alpha_map.name().into(),
            container,
            stored: packed.stored,
            dxgi_format: format(Container::Dds, dds::format),
            vk_format: format(Container::Ktx2, ktx2::format),
            webgpu_format: texel.map(|texel| texel.named(WEBGPU).into()),
            byte_order: "little-endian".into(),
            order: ORDER.into(),
            offset: packed.header.len(),
            size: table.size(),
            channels: table.channels.iter().map(|c| c.name.clone()).collect(),
            padding_channels: packed.channels - table.channels.len(),
            format: table.format,
            decode: formulas.map(|(name, formula)| (name.to_string(), formula.to_string())).collect(),
            axes: table.axes.iter().map(AxisEntry::new).collect(),
            certificate: certificate.clone(),
            header: header.to_vec(),
        }
    }

    /// The JSON bytes: keys in a fixed order, a line feed at the end.
    ///
    /// # Errors
    /// A number that is not finite.
    pub fn bytes(&self) -> Result<Vec<u8>, serde_json::Error> {
        let mut bytes = serde_json::to_vec_pretty(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }
}
