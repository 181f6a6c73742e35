//! The simplex method and the texel optimiser: tests that stand beside them and see what is private of
//! them. Their files are compiled here once more, and the library is not.
#![allow(dead_code, reason = "what of these files no test calls")]

#[path = "../src/rational/simplex.rs"]
mod simplex;
#[path = "../src/texels.rs"]
mod texels;
