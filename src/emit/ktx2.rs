//! KTX 2 textures: 3-D, or 2-D for two axes, one level, no supercompression, texels tightly packed.
//!
//! Layout and values: Khronos, "KTX File Format Specification", version 2.0, sections 3 to 5, and
//! "Khronos Data Format Specification", version 1.3, section 5 (the basic descriptor block).

use super::texels::Packed;
use super::texture::{Field, Texel, Texture, TextureError};
use crate::data::{Container, Table};

/// Identifier.
const IDENTIFIER: &[u8; 12] = b"\xabKTX 20\xbb\r\n\x1a\n";

/// Bytes before the data format descriptor: identifier, nine fields, the index of descriptor,
/// key/value data and supercompression data, and the index of one level.
const DESCRIPTOR: u32 = 12 + 36 + 32 + 24;

/// KHR_DF_MODEL_RGBSDA, primaries not stated (the texels are no colours), KHR_DF_TRANSFER_LINEAR,
/// and no flags.
const MODEL: u32 = 1 | (1 << 16);

/// KHR_DF_CHANNEL_RGBSDA_RED, _GREEN, _BLUE, _ALPHA.
const CHANNELS: [u32; 4] = [0, 1, 2, 15];

/// KHR_DF_SAMPLE_DATATYPE_FLOAT and _SIGNED.
const FLOAT: u32 = 0x80 | 0x40;

/// Values of a sample of floats that stand for -1 and 1, as singles whatever the sample's size.
const ENDS: [u32; 2] = [(-1.0_f32).to_bits(), 1.0_f32.to_bits()];

/// VkFormat by name and number.
pub fn format(texel: Texel) -> (&'static str, u32) {
    texel.named([
        [("R8_UNORM", 9), ("R8G8_UNORM", 16), ("R8G8B8A8_UNORM", 37)],
        [("R16_UNORM", 70), ("R16G16_UNORM", 77), ("R16G16B16A16_UNORM", 91)],
        [("R16_SFLOAT", 76), ("R16G16_SFLOAT", 83), ("R16G16B16A16_SFLOAT", 97)],
        [("R32_SFLOAT", 100), ("R32G32_SFLOAT", 103), ("R32G32B32A32_SFLOAT", 109)],
    ])
}

/// The data format descriptor: its size and one basic block with a sample per stored channel.
fn descriptor(texel: Texel) -> Vec<Field> {
    let (channels, bits) = (texel.channels, 8 * texel.channel_bytes());
    // Of integers those that stand for 0 and 1.
    let (kind, [lower, upper]) = texel.format.steps().map_or((FLOAT, ENDS), |steps| (0, [0, steps as u32]));
    let block = 24 + 16 * channels;
    let mut fields = vec![
        ("dfdTotalSize", 4 + block),
        ("dfd.vendorId", 0),
        ("dfd.versionNumber", 2 | (block << 16)),
        ("dfd.colorModel", MODEL),
        ("dfd.texelBlockDimension", 0),
        ("dfd.bytesPlane0", texel.bytes()),
        ("dfd.bytesPlane4", 0),
    ];
    for (k, channel) in (0..channels).zip(CHANNELS) {
        fields.extend([
            ("dfd.channelType", (k * bits) | ((bits - 1) << 16) | ((channel | kind) << 24)),
            ("dfd.samplePosition", 0),
            ("dfd.sampleLower", lower),
            ("dfd.sampleUpper", upper),
        ]);
    }
    fields
}

/// Key/value data, keys in order, every pair padded to four bytes.
fn pairs(texture: &Texture) -> Vec<u8> {
    // Columns to the right, rows down, slices inwards, as they are counted.
    let orientation = if texture.solid { "rdi" } else { "rd" };
    let writer = concat!("lobefit ", env!("CARGO_PKG_VERSION"));
    let mut bytes = Vec::new();
    for (key, value) in [("KTXorientation", orientation), ("KTXwriter", writer)] {
        let pair = format!("{key}\0{value}\0");
        bytes.extend((pair.len() as u32).to_le_bytes());
        bytes.extend(pair.bytes());
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    bytes
}

/// The numbers after the identifier, up to and with the descriptor, and the key/value data; of 0 layers for a
/// texture that is no array.
fn header(texture: &Texture, layers: u32) -> (Vec<Field>, Vec<u8>) {
    let Texture { size: [width, height, depth], solid, texel, .. } = *texture;
    let (descriptor, pairs) = (descriptor(texel), pairs(texture));
    let described = 4 * descriptor.len() as u32;
    let keyed = pairs.len() as u32;
    let length = u64::from(texture.pitch) * u64::from(height) * u64::from(depth) * u64::from(layers.max(1));
    let [low, high] = [length as u32, (length >> 32) as u32];
    let mut fields = vec![
        ("vkFormat", format(texel).1),
        ("typeSize", texel.channel_bytes()),
        ("pixelWidth", width),
        ("pixelHeight", height),
        ("pixelDepth", if solid { depth } else { 0 }),
        ("layerCount", layers),
        ("faceCount", 1),
        ("levelCount", 1),
        ("supercompressionScheme", 0),
        ("dfdByteOffset", DESCRIPTOR),
        ("dfdByteLength", described),
        ("kvdByteOffset", DESCRIPTOR + described),
        ("kvdByteLength", keyed),
    ];
    // Numbers of 64 bits, low half first.
    fields.extend([("sgdByteOffset", 0), ("sgdByteOffset", 0), ("sgdByteLength", 0), ("sgdByteLength", 0)]);
    let first = (DESCRIPTOR + described + keyed).next_multiple_of(alignment(texel));
    fields.extend([("byteOffset", first), ("byteOffset", 0), ("byteLength", low), ("byteLength", high)]);
    fields.extend([("uncompressedByteLength", low), ("uncompressedByteLength", high)]);
    fields.extend(descriptor);
    (fields, pairs)
}

/// A level begins at a multiple of the least common multiple of a texel's bytes, a power of two,
/// and 4.
fn alignment(texel: Texel) -> u32 {
    texel.bytes().max(4)
}

/// How a file holds a validated table.
///
/// # Errors
/// More channels than four, an axis longer than 2^32 - 1 or a row of as many bytes.
pub fn packed(table: &Table) -> Result<Packed, TextureError> {
    in_layers(table, 0)
}

/// The file of tables of one shape and format, each a layer of an array.
///
/// # Errors
/// As [`packed`].
pub fn layers(tables: &[&Table]) -> Result<Vec<u8>, TextureError> {
    let mut bytes = Vec::new();
    for table in tables {
        let file = in_layers(table, tables.len() as u32)?;
        let texels = file.header.len();
        bytes.extend(&file.file(table)[if bytes.is_empty() { 0 } else { texels }..]);
    }
    Ok(bytes)
}

fn in_layers(table: &Table, layers: u32) -> Result<Packed, TextureError> {
    let texture = Texture::new(table, Container::Ktx2)?;
    let (fields, pairs) = header(&texture, layers);
    let mut packed = texture.packed(IDENTIFIER, fields, &pairs);
    let first = packed.header.len().next_multiple_of(alignment(texture.texel) as usize);
    packed.header.resize(first, 0);
    Ok(packed)
}
