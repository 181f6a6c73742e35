//! The verb as its users call it.

#[path = "../../../../tests/common/mod.rs"]
mod common;
#[path = "../../../../tests/kernel_support/mod.rs"]
mod kernel_support;

mod ends;
mod fit;
mod kernels;
mod search;
