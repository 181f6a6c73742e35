//! Dynamic occlusion culling by depth that arrives late, on the CPU: an occlusion buffer is made
//! from depth that is frames old, compared with the depth of the frame, and boxes are tested
//! against both.
//!
//! | module | purpose |
//! |---|---|
//! | [`camera`], [`raster`] | what is seen of boxes and triangles: their depth |
//! | [`world`], [`site`] | procedural worlds, or the mesh of a file; what is culled; where cameras stand |
//! | [`film`] | a camera's path, frame by frame |
//! | [`depth`], [`reproject`], [`grid`] | buffers, and the passes that make and fill them |
//! | [`passes`] | the reconstruction |
//! | [`cull`] | boxes tested against a buffer |
//! | [`measure`] | errors, holes by their cause, boxes wrongly culled and kept |
//! | [`study`] | everything that is measured of a scene |
//! | [`times`] | how long passes take on a machine |
//! | [`page`] | what a page shows of it |

/// Hash of the code of this package, which results follow from.
pub const CODE: &str = env!("LOBEFIT_OCCLUSION");

pub mod camera;
pub mod choice;
pub mod cull;
pub mod depth;
pub mod film;
pub mod grid;
pub mod measure;
pub mod page;
pub mod passes;
pub mod raster;
pub mod reproject;
pub mod site;
pub mod study;
pub mod times;
pub mod world;
