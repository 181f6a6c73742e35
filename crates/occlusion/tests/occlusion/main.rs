//! The simulation of occlusion culling: its parts against their definitions, its hard cases, and
//! that the conservative mode hides nothing that is seen.

mod conservative;
mod hard;
mod mesh;
mod parts;
mod study;
