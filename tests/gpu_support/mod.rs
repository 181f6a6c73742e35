//! What the tests on a device need: the device, and a bound on what arithmetic may make of a formula there.

pub mod accuracy;
pub mod device;
