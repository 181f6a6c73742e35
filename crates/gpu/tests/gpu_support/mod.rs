//! What the tests on a device need: the device.
#![allow(dead_code, reason = "each test binary uses its part")]

pub mod device;

use crate::emit_support::missing;
use device::{Gpu, INSTALL};

/// The device, or none where the test is to be skipped.
pub fn gpu() -> Option<Gpu> {
    match Gpu::open() {
        Ok(gpu) => Some(gpu),
        Err(reason) => {
            missing(&format!("no Vulkan adapter ({reason})"), INSTALL);
            None
        }
    }
}
