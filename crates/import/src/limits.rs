//! Bounds on what a foreign file may hold, beside those of any file of text
//! ([`lobefit_strict::limits`]).

/// Most materials of a scene.
pub const MATERIALS: usize = 65_536;
/// Largest index of refraction of glass: where the accuracy promise of its integrals ends.
pub const GLASS_IOR: f64 = 3.0;
/// Most meshes of a glTF file; as many images, textures, buffers and views of buffers.
pub const GLTF_LIST: usize = 1 << 20;
/// Largest glTF file whose triangles are read, bytes.
pub const MESH_BYTES: u64 = 64 << 20;
/// Most nodes and scenes of a glTF file whose triangles are read.
pub const GLTF_NODES: usize = 1 << 16;
/// Most primitives that its nodes draw, and that one mesh has.
pub const PARTS: usize = 1 << 16;
/// Most triangles that its nodes draw.
pub const TRIANGLES: usize = 1 << 20;
/// Most extensions that a glTF file uses.
pub const GLTF_EXTENSIONS: usize = 1024;
/// Most nodes of a MaterialX document: elements, texts and comments, of some 100 bytes each.
pub const XML_NODES: u32 = 1 << 20;
/// Most attributes of an element: finding two of one name takes their square.
pub const XML_ATTRIBUTES: usize = 256;
/// Most declarations of namespaces: each element that has one copies those around it.
pub const XML_NAMESPACES: usize = 64;
/// Most texels of an image.
pub const TEXELS: u64 = 1 << 26;
/// Most texels of all images of a scene, beside those that their bytes allow.
pub const ALL_TEXELS: u64 = 1 << 28;
/// Texels that each byte of images allows: more than pictures have, so that a small file of large images of
/// one colour takes no more time than a large one.
pub const TEXELS_OF_BYTE: u64 = 64;
/// Most bytes that a decoder may take for one image.
pub const DECODED_BYTES: u64 = 256 << 20;
/// Most bytes of a file of one image.
pub const IMAGE_BYTES: u64 = 64 << 20;
/// Most scans of a progressive JPEG: each goes over all its coefficients.
pub const JPEG_SCANS: usize = 32;
