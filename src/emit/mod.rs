//! Tables and fits to bytes, one file per format. Nothing here touches the file system.

pub mod call;
pub mod compensation;
pub mod container;
pub mod dds;
pub mod exr;
pub mod header;
pub mod include;
pub mod ktx2;
pub mod lookup;
pub mod manifest;
pub mod npy;
pub mod raw;
pub mod sidecar;
pub mod texels;
pub mod texture;
